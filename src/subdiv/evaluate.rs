//! The frame's inner loop: control positions in, refined positions and normals out.

use glam::Vec3;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::lane::Lane;
use super::plan::Plan;
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
    /// Unit vectors, as many: area-weighted over the faces around, +Y where those have no area.
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

    /// As [`evaluate`](Self::evaluate), into the caller's buffers: one place for each vertex of the plan's last level.
    ///
    /// # Panics
    /// Where a length is another.
    pub fn evaluate_into(&mut self, plan: &Plan, control: &[Vec3], positions: &mut [Vec3], normals: &mut [Vec3]) {
        let n = plan.n_vertices();
        assert!(positions.len() == n && normals.len() == n, "one value for each vertex of the last level");
        self.fit(plan);
        self.refine(plan, control);
        unpad(&self.finest, positions);
        self.find_normals(plan, normals);
    }

    /// The same stencils on any three channels (a colour, a flow): `control` has one value for each control vertex,
    /// `out` one for each vertex of the plan's last level. The surface lent out before is not disturbed.
    ///
    /// # Panics
    /// Where a length is another.
    pub fn evaluate_attribute(&mut self, plan: &Plan, control: &[Vec3], out: &mut [Vec3]) {
        assert_eq!(out.len(), plan.n_vertices(), "one value for each vertex of the last level");
        self.fit(plan);
        self.refine(plan, control);
        unpad(&self.finest, out);
    }

    /// Makes the buffers fit; does nothing where they do.
    fn fit(&mut self, plan: &Plan) {
        if self.fingerprint == plan.fingerprint() && self.finest.len() == plan.n_vertices() {
            return;
        }
        self.fingerprint = plan.fingerprint();
        let n_between = plan.n_vertices_at(plan.levels().saturating_sub(1));
        self.coarse.resize(n_between, Lane::default());
        self.fine.resize(n_between, Lane::default());
        self.finest.resize(plan.n_vertices(), Lane::default());
        self.positions.resize(plan.n_vertices(), Vec3::ZERO);
        self.normals.resize(plan.n_vertices(), Vec3::ZERO);
    }

    /// From control values to those of the last level, in `finest`.
    fn refine(&mut self, plan: &Plan, control: &[Vec3]) {
        assert_eq!(control.len(), plan.n_control(), "one value for each control vertex");
        let Some((last, steps)) = plan.tables().split_last() else {
            pad(control, &mut self.finest);
            return;
        };
        pad(control, &mut self.coarse);
        for table in steps {
            let (source, target) = (&self.coarse[..table.n_sources()], &mut self.fine[..table.n_rows()]);
            apply(self.pool.as_ref(), table, source, target);
            std::mem::swap(&mut self.coarse, &mut self.fine);
        }
        apply(self.pool.as_ref(), last, &self.coarse[..last.n_sources()], &mut self.finest);
    }

    fn find_normals(&self, plan: &Plan, normals: &mut [Vec3]) {
        let Evaluator { finest, pool, .. } = self;
        match pool {
            Some(pool) if normals.len() > CHUNK => pool.install(|| {
                normals
                    .par_chunks_mut(CHUNK)
                    .enumerate()
                    .for_each(|(chunk, normals)| plan.rings.normals(chunk * CHUNK, finest, normals));
            }),
            _ => plan.rings.normals(0, finest, normals),
        }
    }
}

fn apply(pool: Option<&ThreadPool>, table: &StencilTable, source: &[Lane], out: &mut [Lane]) {
    match pool {
        Some(pool) if out.len() > CHUNK => pool.install(|| {
            out.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, out)| table.apply_rows(chunk * CHUNK, source, out));
        }),
        _ => table.apply_rows(0, source, out),
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
