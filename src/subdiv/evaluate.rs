//! The frame's inner loop: control positions in, refined positions and normals out.

use glam::Vec3;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::kernels;
use super::lane::Lane;
use super::patch_kernels::PatchBuffers;
use super::plan::Plan;
use super::scheme::{Normals, Positions};
use super::stencil::StencilTable;

/// Rows that one task takes: enough to pay for handing it over, few enough to balance.
const CHUNK: usize = 4096;
/// Vertices from which on several threads gain more than it costs to wake them.
const PARALLEL_FROM: usize = 30_000;
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
    buffers: Buffers,
    /// For a batch: one for each thread.
    litters: Vec<Evaluator>,
    /// What [`Evaluator::evaluate`] lends out.
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    /// None with one thread.
    pool: Option<ThreadPool>,
}

impl Evaluator {
    /// Buffers for a plan, and one thread.
    pub fn new(plan: &Plan) -> Evaluator {
        let mut evaluator = Evaluator::empty();
        evaluator.fit(plan);
        evaluator
    }

    /// Sets the number of threads: 0 and 1 mean the caller's own. Where the system gives no more threads, evaluation
    /// stays on the caller's; results are the same. A plan too small to gain by it is evaluated by one thread anyway.
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
        assert_eq!(control.len(), plan.n_control(), "one value for each control vertex");
        assert_eq!(positions.len(), plan.n_vertices(), "one position for each vertex of the last level");
        assert_eq!(normals.len(), n_normals(plan), "one normal for each vertex of the last level, if the plan has any");
        let threads = self.threads();
        self.buffers.fit(plan, threads);
        let buffers = &mut self.buffers;
        in_pool(self.pool.as_ref(), plan, |parallel| buffers.surface(plan, control, positions, normals, parallel));
    }

    /// The same stencils on any three channels (a colour, a flow): `control` has one value for each control vertex,
    /// `out` one for each vertex of the plan's last level. The surface lent out before is not disturbed.
    ///
    /// # Panics
    /// Where a length is another.
    pub fn evaluate_attribute(&mut self, plan: &Plan, control: &[Vec3], out: &mut [Vec3]) {
        assert_eq!(control.len(), plan.n_control(), "one value for each control vertex");
        assert_eq!(out.len(), plan.n_vertices(), "one value for each vertex of the last level");
        let threads = self.threads();
        self.buffers.fit(plan, threads);
        let buffers = &mut self.buffers;
        in_pool(self.pool.as_ref(), plan, |parallel| buffers.attribute(plan, control, out, parallel));
    }

    /// For a batch: the threads, and an evaluator for each.
    pub(super) fn threads_and_litters(&mut self) -> (Option<&ThreadPool>, &mut [Evaluator]) {
        let n = self.threads();
        self.litters.resize_with(n, Evaluator::empty);
        (self.pool.as_ref(), &mut self.litters)
    }

    /// No buffers, and one thread.
    fn empty() -> Evaluator {
        Evaluator {
            buffers: Buffers::default(),
            litters: Vec::new(),
            positions: Vec::new(),
            normals: Vec::new(),
            pool: None,
        }
    }

    /// Makes the buffers fit; does nothing where they do.
    fn fit(&mut self, plan: &Plan) {
        let threads = self.threads();
        self.buffers.fit(plan, threads);
        self.positions.resize(plan.n_vertices(), Vec3::ZERO);
        self.normals.resize(n_normals(plan), Vec3::ZERO);
    }
}

pub(super) fn n_normals(plan: &Plan) -> usize {
    if plan.options().normals == Normals::None { 0 } else { plan.n_vertices() }
}

/// Runs the work in the pool if there is one and the plan is large enough to gain by it; tells it whether it does.
fn in_pool<R: Send>(pool: Option<&ThreadPool>, plan: &Plan, work: impl FnOnce(bool) -> R + Send) -> R {
    match pool {
        Some(pool) if plan.n_vertices() >= PARALLEL_FROM => pool.install(|| work(true)),
        _ => work(false),
    }
}

/// What lies between control positions and the caller's buffers.
#[derive(Debug, Default)]
struct Buffers {
    /// Two levels in turn: the one being read and the one being written.
    coarse: Vec<Lane>,
    fine: Vec<Lane>,
    /// The last level.
    finest: Vec<Lane>,
    /// Where it goes, for plans with limit positions and normals from faces.
    limit: Vec<Lane>,
    /// For plans with patches, which need nothing else: one for each share of the work.
    patches: Vec<PatchBuffers>,
}

impl Buffers {
    /// Grows where a plan needs more; a smaller one uses the front.
    fn fit(&mut self, plan: &Plan, threads: usize) {
        if let Some(patches) = &plan.patches {
            return patches.fit(&mut self.patches, threads);
        }
        let n_between = plan.tables().iter().map(StencilTable::n_sources).max().unwrap_or(0);
        for (buffer, n) in [
            (&mut self.coarse, n_between),
            (&mut self.fine, n_between),
            (&mut self.finest, if needs_lanes(plan) { plan.n_vertices() } else { 0 }),
            (&mut self.limit, if pushes(plan) { plan.n_vertices() } else { 0 }),
        ] {
            if buffer.len() < n {
                buffer.resize(n, Lane::default());
            }
        }
    }

    fn surface(&mut self, plan: &Plan, control: &[Vec3], positions: &mut [Vec3], normals: &mut [Vec3], parallel: bool) {
        if let Some(patches) = &plan.patches {
            let wanted = plan.options().positions;
            return patches.evaluate(wanted, control, positions, normals, &mut self.patches, parallel);
        }
        if !needs_lanes(plan) {
            return self.refine_into(plan, control, positions, parallel);
        }
        self.refine(plan, control, parallel);
        let n = plan.n_vertices();
        match (plan.limit(), &plan.rings) {
            (Some(limit), None) if !normals.is_empty() => {
                let limit_positions = plan.options().positions == Positions::Limit;
                let (source, limit_out) = (&self.finest[..n], if limit_positions { &mut *positions } else { &mut [] });
                for_chunks_of_two(parallel, limit_out, normals, |first, positions, normals| {
                    kernels::limit_surface(limit, first, source, positions, normals);
                });
                if !limit_positions {
                    unpad(parallel, source, positions);
                }
            }
            (_, rings) => {
                self.push(plan, parallel);
                let source = &self.finest[..n];
                unpad(parallel, source, positions);
                if let Some(rings) = rings {
                    for_chunks(parallel, normals, |first, normals| rings.normals(first, source, normals));
                }
            }
        }
    }

    fn attribute(&mut self, plan: &Plan, control: &[Vec3], out: &mut [Vec3], parallel: bool) {
        if let Some(patches) = &plan.patches {
            let wanted = plan.options().positions;
            return patches.evaluate(wanted, control, out, &mut [], &mut self.patches, parallel);
        }
        if plan.limit().is_none() || plan.options().positions == Positions::Level {
            return self.refine_into(plan, control, out, parallel);
        }
        self.refine(plan, control, parallel);
        self.push(plan, parallel);
        unpad(parallel, &self.finest[..plan.n_vertices()], out);
    }

    /// From control values to those of the last level, in `finest`.
    fn refine(&mut self, plan: &Plan, control: &[Vec3], parallel: bool) {
        let finest = &mut self.finest[..plan.n_vertices()];
        match refine_but_last(&mut self.coarse, &mut self.fine, plan, control, parallel) {
            Some(last) => apply(parallel, last, &self.coarse[..last.n_sources()], finest),
            None => pad(control, finest),
        }
    }

    /// From control values to those of the last level, in `out`.
    fn refine_into(&mut self, plan: &Plan, control: &[Vec3], out: &mut [Vec3], parallel: bool) {
        match refine_but_last(&mut self.coarse, &mut self.fine, plan, control, parallel) {
            Some(last) => {
                let source = &self.coarse[..last.n_sources()];
                for_chunks(parallel, out, |first, out| kernels::apply_positions(last, first, source, out));
            }
            None => out.copy_from_slice(control),
        }
    }

    /// Replaces the values in `finest` by where they go, if the plan wants that.
    fn push(&mut self, plan: &Plan, parallel: bool) {
        let Some(limit) = plan.limit().filter(|_| pushes(plan)) else { return };
        let n = plan.n_vertices();
        let source = &self.finest[..n];
        for_chunks(parallel, &mut self.limit[..n], |first, out| kernels::limit_positions(limit, first, source, out));
        std::mem::swap(&mut self.limit, &mut self.finest);
    }
}

/// Whether the last level is read again, so that it has to be there in lanes.
fn needs_lanes(plan: &Plan) -> bool {
    plan.rings.is_some() || plan.limit().is_some()
}

/// Whether the last level itself is moved to the limit.
fn pushes(plan: &Plan) -> bool {
    plan.limit().is_some() && plan.options().positions == Positions::Limit
}

/// All steps but the last, whose table is returned; its sources are in `coarse` then. None where there is no step.
fn refine_but_last<'p>(
    coarse: &mut Vec<Lane>,
    fine: &mut Vec<Lane>,
    plan: &'p Plan,
    control: &[Vec3],
    parallel: bool,
) -> Option<&'p StencilTable> {
    let (last, steps) = plan.tables().split_last()?;
    pad(control, coarse);
    for table in steps {
        apply(parallel, table, &coarse[..table.n_sources()], &mut fine[..table.n_rows()]);
        std::mem::swap(coarse, fine);
    }
    Some(last)
}

fn apply(parallel: bool, table: &StencilTable, source: &[Lane], out: &mut [Lane]) {
    for_chunks(parallel, out, |first, out| kernels::apply_lanes(table, first, source, out));
}

/// Runs `work` over chunks of `out`, each with the index of its first place, on as many threads as there are.
fn for_chunks<T: Send>(parallel: bool, out: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    if parallel && out.len() > CHUNK {
        out.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, out)| work(chunk * CHUNK, out));
    } else {
        work(0, out);
    }
}

/// The same over two lists side by side; the first may be empty.
fn for_chunks_of_two<T: Send>(
    parallel: bool,
    first: &mut [T],
    second: &mut [T],
    work: impl Fn(usize, &mut [T], &mut [T]) + Sync,
) {
    if !parallel || second.len() <= CHUNK {
        work(0, first, second);
    } else if first.is_empty() {
        second.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, second)| work(chunk * CHUNK, &mut [], second));
    } else {
        let pairs = first.par_chunks_mut(CHUNK).zip(second.par_chunks_mut(CHUNK));
        pairs.enumerate().for_each(|(chunk, (first, second))| work(chunk * CHUNK, first, second));
    }
}

fn pad(values: &[Vec3], lanes: &mut [Lane]) {
    for (lane, &value) in lanes.iter_mut().zip(values) {
        *lane = value.into();
    }
}

fn unpad(parallel: bool, lanes: &[Lane], values: &mut [Vec3]) {
    for_chunks(parallel, values, |first, values| {
        for (value, &lane) in values.iter_mut().zip(&lanes[first..]) {
            *value = lane.into();
        }
    });
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
