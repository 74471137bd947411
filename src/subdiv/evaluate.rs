//! The frame's inner loop: control positions in, refined positions and normals out.

use glam::Vec3;

use super::kernels;
use super::lane::Lane;
use super::patch_kernels::PatchBuffers;
use super::plan::Plan;
use super::scheme::{Normals, Positions};
use super::stencil::StencilTable;
use super::team::Team;

/// Rows that one task takes: enough to pay for handing it over, few enough to balance.
const CHUNK: usize = 4096;
/// Vertices from which on several threads gain more than it costs to wake them.
const PARALLEL_FROM: usize = 30_000;
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
    team: Team,
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
        if !self.team.is_of(n) {
            self.team = Team::of(n);
        }
    }

    /// The number of threads in use, the caller's own among them.
    pub fn threads(&self) -> usize {
        self.team.size()
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
        self.buffers.surface(plan, control, positions, normals, team_for(&self.team, plan));
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
        self.buffers.attribute(plan, control, out, team_for(&self.team, plan));
    }

    /// For a batch: the threads, and an evaluator for each.
    pub(super) fn team_and_litters(&mut self) -> (&Team, &mut [Evaluator]) {
        self.litters.resize_with(self.team.size(), Evaluator::empty);
        (&self.team, &mut self.litters)
    }

    /// No buffers, and one thread.
    fn empty() -> Evaluator {
        Evaluator {
            buffers: Buffers::default(),
            litters: Vec::new(),
            positions: Vec::new(),
            normals: Vec::new(),
            team: Team::ALONE,
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

/// All of the team if the plan is large enough to gain by it.
fn team_for<'a>(team: &'a Team, plan: &Plan) -> &'a Team {
    if plan.n_vertices() >= PARALLEL_FROM { team } else { &Team::ALONE }
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

    fn surface(&mut self, plan: &Plan, control: &[Vec3], positions: &mut [Vec3], normals: &mut [Vec3], team: &Team) {
        if let Some(patches) = &plan.patches {
            let wanted = plan.options().positions;
            return patches.evaluate(wanted, control, positions, normals, &mut self.patches, team);
        }
        if !needs_lanes(plan) {
            return self.refine_into(plan, control, positions, team);
        }
        self.refine(plan, control, team);
        let n = plan.n_vertices();
        match (plan.limit(), &plan.rings) {
            (Some(limit), None) if !normals.is_empty() => {
                let limit_positions = plan.options().positions == Positions::Limit;
                let (source, limit_out) = (&self.finest[..n], if limit_positions { &mut *positions } else { &mut [] });
                for_chunks_of_two(team, limit_out, normals, |first, positions, normals| {
                    kernels::limit_surface(limit, first, source, positions, normals);
                });
                if !limit_positions {
                    unpad(team, source, positions);
                }
            }
            (_, rings) => {
                self.push(plan, team);
                let source = &self.finest[..n];
                unpad(team, source, positions);
                if let Some(rings) = rings {
                    for_chunks(team, normals, |first, normals| rings.normals(first, source, normals));
                }
            }
        }
    }

    fn attribute(&mut self, plan: &Plan, control: &[Vec3], out: &mut [Vec3], team: &Team) {
        if let Some(patches) = &plan.patches {
            let wanted = plan.options().positions;
            return patches.evaluate(wanted, control, out, &mut [], &mut self.patches, team);
        }
        if plan.limit().is_none() || plan.options().positions == Positions::Level {
            return self.refine_into(plan, control, out, team);
        }
        self.refine(plan, control, team);
        self.push(plan, team);
        unpad(team, &self.finest[..plan.n_vertices()], out);
    }

    /// From control values to those of the last level, in `finest`.
    fn refine(&mut self, plan: &Plan, control: &[Vec3], team: &Team) {
        let finest = &mut self.finest[..plan.n_vertices()];
        match refine_but_last(&mut self.coarse, &mut self.fine, plan, control, team) {
            Some(last) => apply(team, last, &self.coarse[..last.n_sources()], finest),
            None => pad(control, finest),
        }
    }

    /// From control values to those of the last level, in `out`.
    fn refine_into(&mut self, plan: &Plan, control: &[Vec3], out: &mut [Vec3], team: &Team) {
        match refine_but_last(&mut self.coarse, &mut self.fine, plan, control, team) {
            Some(last) => {
                let source = &self.coarse[..last.n_sources()];
                for_chunks(team, out, |first, out| kernels::apply_positions(last, first, source, out));
            }
            None => out.copy_from_slice(control),
        }
    }

    /// Replaces the values in `finest` by where they go, if the plan wants that.
    fn push(&mut self, plan: &Plan, team: &Team) {
        let Some(limit) = plan.limit().filter(|_| pushes(plan)) else { return };
        let n = plan.n_vertices();
        let source = &self.finest[..n];
        for_chunks(team, &mut self.limit[..n], |first, out| kernels::limit_positions(limit, first, source, out));
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
    team: &Team,
) -> Option<&'p StencilTable> {
    let (last, steps) = plan.tables().split_last()?;
    pad(control, coarse);
    for table in steps {
        apply(team, table, &coarse[..table.n_sources()], &mut fine[..table.n_rows()]);
        std::mem::swap(coarse, fine);
    }
    Some(last)
}

fn apply(team: &Team, table: &StencilTable, source: &[Lane], out: &mut [Lane]) {
    for_chunks(team, out, |first, out| kernels::apply_lanes(table, first, source, out));
}

/// Runs `work` over chunks of `out`, each with the index of its first place, on as many threads as there are.
fn for_chunks<T: Send>(team: &Team, out: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    team.share(out.chunks_mut(CHUNK).enumerate(), |(chunk, out)| work(chunk * CHUNK, out));
}

/// The same over two lists side by side; the first may be empty.
fn for_chunks_of_two<T: Send>(
    team: &Team,
    first: &mut [T],
    second: &mut [T],
    work: impl Fn(usize, &mut [T], &mut [T]) + Sync,
) {
    if first.is_empty() {
        return for_chunks(team, second, |at, second| work(at, &mut [], second));
    }
    let pairs = first.chunks_mut(CHUNK).zip(second.chunks_mut(CHUNK)).enumerate();
    team.share(pairs, |(chunk, (first, second))| work(chunk * CHUNK, first, second));
}

fn pad(values: &[Vec3], lanes: &mut [Lane]) {
    for (lane, &value) in lanes.iter_mut().zip(values) {
        *lane = value.into();
    }
}

fn unpad(team: &Team, lanes: &[Lane], values: &mut [Vec3]) {
    for_chunks(team, values, |first, values| {
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
