//! The frame's inner loop: control positions in, refined positions and normals out.

use glam::Vec3;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::kernels;
use super::lane::Lane;
use super::limit::LimitTable;
use super::normals::Rings;
use super::plan::Plan;
use super::scheme::{Normals, Positions};
use super::stencil::StencilTable;

/// Rows that one task takes: enough to pay for handing it over, few enough to balance.
const CHUNK: usize = 4096;
/// More threads than any machine has use for; a larger number is taken as this one.
const MAX_THREADS: usize = 256;

/// What an [`Evaluator`] lends out until the next call.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// One for each vertex of the plan's last level.
    pub positions: &'a [Vec3],
    /// Unit vectors, as many, as the plan's options say, and none where those want none. +Y where none is defined.
    pub normals: &'a [Vec3],
    /// Three for each face of the last level, counter-clockwise.
    pub indices: &'a [u32],
}

/// Owns the buffers of an evaluation. Once it has seen a plan it allocates nothing more for that plan, with one thread.
///
/// Each value is one sum in one order, so the bits do not depend on the number of threads.
#[derive(Debug)]
pub struct Evaluator {
    fingerprint: u64,
    /// Two levels in turn: the one being read and the one being written.
    coarse: Vec<Lane>,
    fine: Vec<Lane>,
    /// The last level.
    finest: Vec<Lane>,
    /// Where it goes, for plans with limit positions and normals from faces.
    limit: Vec<Lane>,
    /// What [`Evaluator::evaluate`] lends out.
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// None with one thread.
    pool: Option<ThreadPool>,
}

impl Evaluator {
    /// Buffers for a plan, and one thread.
    pub fn new(plan: &Plan) -> Evaluator {
        let mut evaluator = Evaluator {
            fingerprint: plan.fingerprint(),
            coarse: Vec::new(),
            fine: Vec::new(),
            finest: Vec::new(),
            limit: Vec::new(),
            positions: Vec::new(),
            normals: Vec::new(),
            pool: None,
        };
        evaluator.fit(plan);
        evaluator
    }

    /// Sets the number of threads: 0 and 1 mean the caller's own. Where the system gives no more threads, evaluation
    /// stays on the caller's; results are the same.
    pub fn set_threads(&mut self, n: usize) {
        let n = n.clamp(1, MAX_THREADS);
        if n != self.threads() {
            self.pool = if n == 1 { None } else { ThreadPoolBuilder::new().num_threads(n).build().ok() };
        }
    }

    /// The number of threads in use.
    pub fn threads(&self) -> usize {
        self.pool.as_ref().map_or(1, ThreadPool::current_num_threads)
    }

    /// Positions and normals of the plan's last level from `control`: finite positions, one for each control vertex.
    ///
    /// # Panics
    /// Where `control` has another length than the plan has control vertices.
    pub fn evaluate<'a>(&'a mut self, plan: &'a Plan, control: &[Vec3]) -> Surface<'a> {
        self.fit(plan);
        let (mut positions, mut normals) = (std::mem::take(&mut self.positions), std::mem::take(&mut self.normals));
        self.evaluate_into(plan, control, &mut positions, &mut normals);
        (self.positions, self.normals) = (positions, normals);
        Surface { positions: &self.positions, normals: &self.normals, indices: plan.indices() }
    }

    /// As [`evaluate`](Self::evaluate), into the caller's buffers: one place for each vertex of the plan's last level, and
    /// none for normals where the plan has no normals.
    ///
    /// # Panics
    /// Where a length is another.
    pub fn evaluate_into(&mut self, plan: &Plan, control: &[Vec3], positions: &mut [Vec3], normals: &mut [Vec3]) {
        let n = plan.n_vertices();
        let n_normals = if plan.options().normals == Normals::None { 0 } else { n };
        assert!(positions.len() == n && normals.len() == n_normals, "one value for each vertex of the last level");
        self.fit(plan);
        if n_normals == 0 && plan.limit().is_none() {
            return self.refine_into(plan, control, positions);
        }
        self.refine(plan, control);
        let limit_positions = plan.options().positions == Positions::Limit;
        match (plan.limit(), &plan.rings) {
            (Some(limit), None) if n_normals > 0 => {
                let (source, pool) = (&self.finest[..], self.pool.as_ref());
                let limit_out = if limit_positions { &mut *positions } else { &mut [] };
                for_chunks_of_two(pool, limit_out, normals, |first, positions, normals| {
                    kernels::limit_surface(limit, first, source, positions, normals);
                });
                if !limit_positions {
                    unpad(&self.finest, positions);
                }
            }
            (limit, rings) => {
                if let Some(limit) = limit {
                    self.push_to_limit(limit);
                }
                unpad(&self.finest, positions);
                if let Some(rings) = rings {
                    self.find_normals(rings, normals);
                }
            }
        }
    }

    /// The same stencils on any three channels (a colour, a flow): `control` has one value for each control vertex,
    /// `out` one for each vertex of the plan's last level. The surface lent out before is not disturbed.
    ///
    /// # Panics
    /// Where a length is another.
    pub fn evaluate_attribute(&mut self, plan: &Plan, control: &[Vec3], out: &mut [Vec3]) {
        assert_eq!(out.len(), plan.n_vertices(), "one value for each vertex of the last level");
        self.fit(plan);
        match plan.limit().filter(|_| plan.options().positions == Positions::Limit) {
            Some(limit) => {
                self.refine(plan, control);
                self.push_to_limit(limit);
                unpad(&self.finest, out);
            }
            None => self.refine_into(plan, control, out),
        }
    }

    /// Makes the buffers fit; does nothing where they do.
    fn fit(&mut self, plan: &Plan) {
        if self.fingerprint == plan.fingerprint() && self.finest.len() == plan.n_vertices() {
            return;
        }
        self.fingerprint = plan.fingerprint();
        let n_between = plan.tables().iter().map(StencilTable::n_sources).max().unwrap_or(0);
        self.coarse.resize(n_between, Lane::default());
        self.fine.resize(n_between, Lane::default());
        self.finest.resize(plan.n_vertices(), Lane::default());
        self.positions.resize(plan.n_vertices(), Vec3::ZERO);
        let n_normals = if plan.options().normals == Normals::None { 0 } else { plan.n_vertices() };
        self.normals.resize(n_normals, Vec3::ZERO);
    }

    /// From control values to those of the last level, in `finest`.
    fn refine(&mut self, plan: &Plan, control: &[Vec3]) {
        match self.refine_but_last(plan, control) {
            Some(last) => apply(self.pool.as_ref(), last, &self.coarse[..last.n_sources()], &mut self.finest),
            None => pad(control, &mut self.finest),
        }
    }

    /// From control values to those of the last level, in `out`.
    fn refine_into(&mut self, plan: &Plan, control: &[Vec3], out: &mut [Vec3]) {
        match self.refine_but_last(plan, control) {
            Some(last) => {
                let source = &self.coarse[..last.n_sources()];
                for_chunks(self.pool.as_ref(), out, |first, out| kernels::apply_positions(last, first, source, out));
            }
            None => out.copy_from_slice(control),
        }
    }

    /// All steps but the last, whose table is returned; its sources are in `coarse` then. None where there is no step.
    fn refine_but_last<'p>(&mut self, plan: &'p Plan, control: &[Vec3]) -> Option<&'p StencilTable> {
        assert_eq!(control.len(), plan.n_control(), "one value for each control vertex");
        let (last, steps) = plan.tables().split_last()?;
        pad(control, &mut self.coarse);
        for table in steps {
            let (source, target) = (&self.coarse[..table.n_sources()], &mut self.fine[..table.n_rows()]);
            apply(self.pool.as_ref(), table, source, target);
            std::mem::swap(&mut self.coarse, &mut self.fine);
        }
        Some(last)
    }

    /// Replaces the values in `finest` by where they go.
    fn push_to_limit(&mut self, limit: &LimitTable) {
        self.limit.resize(self.finest.len(), Lane::default());
        let (source, pool) = (&self.finest[..], self.pool.as_ref());
        for_chunks(pool, &mut self.limit, |first, out| kernels::limit_positions(limit, first, source, out));
        std::mem::swap(&mut self.limit, &mut self.finest);
    }

    fn find_normals(&self, rings: &Rings, normals: &mut [Vec3]) {
        let positions = &self.finest[..];
        for_chunks(self.pool.as_ref(), normals, |first, normals| rings.normals(first, positions, normals));
    }
}

fn apply(pool: Option<&ThreadPool>, table: &StencilTable, source: &[Lane], out: &mut [Lane]) {
    for_chunks(pool, out, |first, out| kernels::apply_lanes(table, first, source, out));
}

/// Runs `work` over chunks of `out`, each with the index of its first place, on as many threads as there are.
fn for_chunks<T: Send>(pool: Option<&ThreadPool>, out: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    match pool {
        Some(pool) if out.len() > CHUNK => pool.install(|| {
            out.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, out)| work(chunk * CHUNK, out));
        }),
        _ => work(0, out),
    }
}

/// The same over two lists side by side; the first may be empty.
fn for_chunks_of_two<T: Send>(
    pool: Option<&ThreadPool>,
    first: &mut [T],
    second: &mut [T],
    work: impl Fn(usize, &mut [T], &mut [T]) + Sync,
) {
    match pool {
        Some(pool) if second.len() > CHUNK => pool.install(|| {
            let n_chunks = second.len().div_ceil(CHUNK);
            let firsts: Vec<&mut [T]> = if first.is_empty() {
                std::iter::repeat_with(|| &mut [][..]).take(n_chunks).collect()
            } else {
                first.chunks_mut(CHUNK).collect()
            };
            let seconds = second.par_chunks_mut(CHUNK);
            seconds.zip(firsts).enumerate().for_each(|(chunk, (second, first))| work(chunk * CHUNK, first, second));
        }),
        _ => work(0, first, second),
    }
}

fn pad(values: &[Vec3], lanes: &mut [Lane]) {
    for (lane, &value) in lanes.iter_mut().zip(values) {
        *lane = value.into();
    }
}

fn unpad(lanes: &[Lane], values: &mut [Vec3]) {
    for (value, &lane) in values.iter_mut().zip(lanes) {
        *value = lane.into();
    }
}

/// Positions and normals in vectors of their own: for examples and single shots. Frames keep an [`Evaluator`].
///
/// # Panics
/// Where `control` has another length than the plan has control vertices.
pub fn evaluate_once(plan: &Plan, control: &[Vec3]) -> (Vec<Vec3>, Vec<Vec3>) {
    let mut evaluator = Evaluator::new(plan);
    evaluator.evaluate(plan, control);
    (evaluator.positions, evaluator.normals)
}
