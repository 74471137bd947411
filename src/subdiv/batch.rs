//! Many heads with one plan: a litter of breeds, a sequence of poses.
//!
//! One after another, each while its levels are in the cache; several threads take a part of the heads each. (Eight heads
//! side by side, one in each lane, was slower by half: what they deliver then leaves the cache eight streams at a time.)

use glam::Vec3;
use rayon::prelude::*;

use super::evaluate::{Evaluator, n_normals};
use super::plan::Plan;

impl Evaluator {
    /// Evaluates many heads: `control` holds the control positions of one head after another, `positions` and `normals`
    /// take the vertices of the last level likewise. Normals are empty where the plan has none. The bits are those of
    /// [`Evaluator::evaluate`], head by head. Heads are spread over the threads.
    ///
    /// # Panics
    /// Where the lengths do not fit the same number of heads.
    pub fn evaluate_batch(&mut self, plan: &Plan, control: &[Vec3], positions: &mut [Vec3], normals: &mut [Vec3]) {
        let (n_control, n, n_normals) = (plan.n_control(), plan.n_vertices(), n_normals(plan));
        let n_heads = control.len() / n_control;
        assert_eq!(control.len(), n_heads * n_control, "whole heads");
        assert_eq!(positions.len(), n_heads * n, "as many positions as heads");
        assert_eq!(normals.len(), n_heads * n_normals, "as many normals as heads, or none");
        let threads = self.threads();
        if threads == 1 || n_heads < threads {
            for head in 0..n_heads {
                let control = &control[head * n_control..(head + 1) * n_control];
                let normals = &mut normals[head * n_normals..(head + 1) * n_normals];
                self.evaluate_into(plan, control, &mut positions[head * n..(head + 1) * n], normals);
            }
            return;
        }
        let part = n_heads.div_ceil(threads);
        let mut normals: Vec<&mut [Vec3]> = match n_normals {
            0 => Vec::new(),
            n_normals => normals.chunks_mut(part * n_normals).collect(),
        };
        normals.resize_with(threads, Default::default);
        let (pool, litters) = self.threads_and_litters();
        let parts = litters.par_iter_mut().zip(control.par_chunks(part * n_control));
        let parts = parts.zip(positions.par_chunks_mut(part * n)).zip(normals.par_iter_mut());
        let work = || {
            parts.for_each(|(((evaluator, control), positions), normals)| {
                evaluator.evaluate_batch(plan, control, positions, normals);
            });
        };
        match pool {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}
