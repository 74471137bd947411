//! Many heads with one plan: a litter of breeds, a sequence of poses.
//!
//! One after another, each while its levels are in the cache; several threads each take the next head in turn. (Eight heads
//! side by side, one in each lane, was slower by half: what they deliver then leaves the cache eight streams at a time.)

use glam::Vec3;

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
        let mut normals: Vec<&mut [Vec3]> = match n_normals {
            0 => Vec::new(),
            n_normals => normals.chunks_mut(n_normals).collect(),
        };
        normals.resize_with(n_heads, Default::default);
        let (team, litters) = self.team_and_litters();
        let heads = control.chunks(n_control).zip(positions.chunks_mut(n)).zip(normals);
        team.share_with(litters, heads, |evaluator, ((control, positions), normals)| {
            evaluator.evaluate_into(plan, control, positions, normals);
        });
    }
}
