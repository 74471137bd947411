//! Many heads with one plan: a litter of breeds, a sequence of poses.
//!
//! Eight heads are worked on side by side, one in each lane of a register. The indices of a row are read once for all of
//! them, and nothing has to be shuffled; a head costs a fraction of one evaluated alone, to the same bits.

use glam::Vec3;
use rayon::prelude::*;

use super::evaluate::{Evaluator, n_normals};
use super::kernels;
use super::lane::{HEADS, Octet};
use super::normals::octet_normals;
use super::plan::Plan;

/// Rows that are turned from eight columns into eight heads at a time.
const BLOCK: usize = 64;

/// The buffers of one thread: two levels in turn.
#[derive(Debug, Default)]
pub(super) struct Octets {
    coarse: Vec<Octet>,
    fine: Vec<Octet>,
}

impl Evaluator {
    /// Evaluates many heads: `control` holds the control positions of one head after another, `positions` and `normals`
    /// take the vertices of the last level likewise. Normals are empty where the plan has none. The bits are those of
    /// [`Evaluator::evaluate`], head by head. Heads are spread over the threads.
    ///
    /// Plans with limit positions or limit normals are evaluated one head at a time.
    ///
    /// # Panics
    /// Where the lengths do not fit the same number of heads.
    pub fn evaluate_batch(&mut self, plan: &Plan, control: &[Vec3], positions: &mut [Vec3], normals: &mut [Vec3]) {
        let (n_control, n) = (plan.n_control(), plan.n_vertices());
        let n_heads = control.len() / n_control;
        assert_eq!(control.len(), n_heads * n_control, "whole heads");
        assert_eq!(positions.len(), n_heads * n, "as many positions as heads");
        assert_eq!(normals.len(), n_heads * n_normals(plan), "as many normals as heads, or none");
        if plan.limit().is_some() || plan.patches.is_some() {
            for head in 0..n_heads {
                let normals = match n_normals(plan) {
                    0 => &mut [],
                    n => &mut normals[head * n..(head + 1) * n],
                };
                let control = &control[head * n_control..(head + 1) * n_control];
                self.evaluate_into(plan, control, &mut positions[head * n..(head + 1) * n], normals);
            }
            return;
        }
        let has_normals = !normals.is_empty();
        let mut normals: Vec<&mut [Vec3]> =
            if has_normals { normals.chunks_mut(HEADS * n).collect() } else { Vec::new() };
        normals.resize_with(n_heads.div_ceil(HEADS), || &mut []);
        let litters = control.chunks(HEADS * n_control).zip(positions.chunks_mut(HEADS * n)).zip(normals);
        let (pool, octets) = self.threads_and_octets();
        match pool {
            Some(pool) => pool.install(|| {
                let litters: Vec<_> = litters.collect();
                litters.into_par_iter().for_each_init(Octets::default, |octets, ((control, positions), normals)| {
                    octets.litter(plan, control, positions, normals);
                });
            }),
            None => litters.for_each(|((control, positions), normals)| {
                octets.litter(plan, control, positions, normals);
            }),
        }
    }
}

impl Octets {
    /// At most eight heads.
    fn litter(&mut self, plan: &Plan, control: &[Vec3], positions: &mut [Vec3], normals: &mut [Vec3]) {
        let heads: Vec<&[Vec3]> = control.chunks(plan.n_control()).collect();
        let mut positions: Vec<&mut [Vec3]> = positions.chunks_mut(plan.n_vertices()).collect();
        self.coarse.clear();
        self.coarse.extend((0..plan.n_control()).map(|i| Octet::gather(&heads, i)));
        let wants_normals = plan.rings.is_some();
        let (last, steps) = match plan.tables().split_last() {
            Some((last, steps)) if !wants_normals => (Some(last), steps),
            _ => (None, plan.tables()),
        };
        for table in steps {
            self.fine.resize(table.n_rows(), Octet::default());
            kernels::apply_octets(table, 0, &self.coarse, &mut self.fine);
            std::mem::swap(&mut self.coarse, &mut self.fine);
        }
        match last {
            // Nobody reads the last level again: straight to the heads.
            Some(last) => {
                let mut block = [Octet::default(); BLOCK];
                for first in (0..last.n_rows()).step_by(BLOCK) {
                    let block = &mut block[..BLOCK.min(last.n_rows() - first)];
                    kernels::apply_octets(last, first, &self.coarse, block);
                    scatter(block, first, &mut positions);
                }
            }
            None => scatter(&self.coarse, 0, &mut positions),
        }
        if let Some(rings) = &plan.rings {
            let mut normals: Vec<&mut [Vec3]> = normals.chunks_mut(plan.n_vertices()).collect();
            octet_normals(rings, &self.coarse, &mut normals);
        }
    }
}

/// Places from `first` on of each head.
fn scatter(octets: &[Octet], first: usize, heads: &mut [&mut [Vec3]]) {
    for (i, octet) in octets.iter().enumerate() {
        octet.scatter(heads, first + i);
    }
}
