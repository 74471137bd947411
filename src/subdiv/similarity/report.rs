//! What similarity is worth: classes, patches and times, level by level, on any mesh (thesis, section 4.8).
//!
//! The thesis shows an icosahedron to level 5 (twice as fast as classical subdivision, at best, from level 4 on) and a torus
//! to level 2 (4.4 times), in diagrams that the scan has lost; the counts in their captions (22345 and 16393) are not those
//! of four triangles for one.

use glam::Vec3;

use super::SimilarityError;
use super::classes::{Criteria, Shapes};
use super::maps::Mapped;
use super::patches::patches;
use super::shared::SharedRows;
use crate::mesh::DedgeMesh;
use crate::subdiv::evaluate::{Evaluator, evaluate_once};
use crate::subdiv::plan::Plan;
use crate::subdiv::scheme::{Normals, PlanOptions, Scheme};
use crate::subdiv::steps::levels_of;
use crate::subdiv::tags::Tags;

/// What to report.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReportOptions {
    /// Loop, as in the thesis, or butterfly.
    pub scheme: Scheme,
    /// The last level.
    pub levels: u32,
    /// When triangles are similar.
    pub criteria: Criteria,
    /// How often each time is taken; the median counts. At least 1.
    pub repeats: u32,
}

impl Default for ReportOptions {
    fn default() -> ReportOptions {
        ReportOptions { scheme: Scheme::Loop, levels: 5, criteria: Criteria::default(), repeats: 5 }
    }
}

/// One way from a level to a finer one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReportRow {
    /// The level whose triangles are compared.
    pub from: u32,
    /// The level that is made of it.
    pub to: u32,
    /// Triangles that are compared.
    pub n_triangles: usize,
    /// Vertices of the finer level.
    pub n_vertices: usize,
    /// Classes of strictly similar triangles.
    pub n_classes: usize,
    /// Classes of strictly similar patches.
    pub n_patch_classes: usize,
    /// Patches of all classes.
    pub n_patches: usize,
    /// Triangles of the largest patch that has another similar to it; 0 without one.
    pub largest_patch: usize,
    /// Points that are subdivided; the rest are mapped.
    pub n_points: usize,
    /// Farthest that a vertex lies from where classical subdivision puts it, as a part of the diagonal of the box around
    /// all: what it costs that strictly similar triangles need not be folded alike.
    pub largest_error: f32,
    /// Sorting into classes and working out the maps, in seconds. Before real time, in the thesis.
    pub preparing_secs: f64,
    /// Subdividing one triangle of each class and mapping the rest.
    pub similar_secs: f64,
    /// Classical: topology worked out anew, then positions.
    pub classical_secs: f64,
    /// Evaluating a plan that is there.
    pub plan_secs: f64,
}

/// All that is known about the similarity in a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// From each level to the next, as in the thesis.
    pub steps: Vec<ReportRow>,
    /// From the control mesh to each level at once.
    pub whole: Vec<ReportRow>,
    /// What is shared by topology, for the last level.
    pub shared: SharedRows,
}

/// Reports on a mesh without tags. `clock` gives seconds since some moment: this layer reads no clock of its own.
///
/// # Errors
/// A scheme that does not cut triangles in four, positions that do not fit the mesh, levels that are too large.
pub fn report(
    control: &DedgeMesh,
    positions: &[Vec3],
    options: &ReportOptions,
    clock: &dyn Fn() -> f64,
) -> Result<Report, SimilarityError> {
    let scheme = options.scheme;
    if !matches!(scheme, Scheme::Loop | Scheme::Butterfly) {
        return Err(SimilarityError::Scheme { scheme });
    }
    if positions.len() != control.n_vertices() {
        return Err(SimilarityError::Positions { expected: control.n_vertices(), given: positions.len() });
    }
    let tags = Tags::default();
    let meshes = levels_of(control, &tags, &PlanOptions::new(scheme, options.levels))?;
    let (mut steps, mut whole) = (Vec::new(), Vec::new());
    for level in 0..options.levels {
        let at_level = evaluate_once(&Plan::build(control, scheme, level)?, positions).0;
        steps.push(row(&meshes[level as usize], &at_level, options, [level, level + 1], clock)?);
        whole.push(row(control, positions, options, [0, level + 1], clock)?);
    }
    let shared = SharedRows::count(control, &tags, &PlanOptions::new(scheme, options.levels))?;
    Ok(Report { steps, whole, shared })
}

fn row(
    mesh: &DedgeMesh,
    positions: &[Vec3],
    options: &ReportOptions,
    [from, to]: [u32; 2],
    clock: &dyn Fn() -> f64,
) -> Result<ReportRow, SimilarityError> {
    let plan_options = PlanOptions { normals: Normals::None, ..PlanOptions::new(options.scheme, to - from) };
    let start = clock();
    let shapes = Shapes::new(mesh, positions)?;
    let classes = shapes.classes(&options.criteria);
    let mapped = Mapped::build(mesh, positions, &classes, options.scheme, to - from)?;
    let preparing_secs = clock() - start;
    let found = patches(&shapes, &classes, &options.criteria);

    let plan = Plan::build_with(mesh, &Tags::default(), &plan_options)?;
    let mut evaluator = Evaluator::new(&plan);
    let expected = evaluator.evaluate(&plan, positions).positions.to_vec();
    let (mut points, mut out) = (Vec::new(), vec![Vec3::ZERO; mapped.n_vertices()]);
    mapped.run(positions, &mut points, &mut out);
    let (low, high) = expected.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), &p| (low.min(p), high.max(p)));
    let farthest = out.iter().zip(&expected).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    let size = high.distance(low);

    let similar_secs = median(options.repeats, clock, &mut || mapped.run(positions, &mut points, &mut out));
    let plan_secs = median(options.repeats, clock, &mut || {
        evaluator.evaluate(&plan, positions);
    });
    let mut failure = None;
    let classical_secs =
        median(options.repeats, clock, &mut || match Plan::build_with(mesh, &Tags::default(), &plan_options) {
            Ok(plan) => {
                Evaluator::new(&plan).evaluate(&plan, positions);
            }
            Err(error) => failure = Some(error),
        });
    if let Some(error) = failure {
        return Err(error.into());
    }
    Ok(ReportRow {
        from,
        to,
        n_triangles: mesh.n_faces(),
        n_vertices: plan.n_vertices(),
        n_classes: classes.len(),
        n_patch_classes: found.len(),
        n_patches: found.iter().map(|class| class.patches.len()).sum(),
        largest_patch: found
            .iter()
            .filter(|class| class.patches.len() > 1)
            .map(|class| class.size())
            .max()
            .unwrap_or(0),
        n_points: mapped.n_points(),
        largest_error: if size > 0.0 { farthest / size } else { 0.0 },
        preparing_secs,
        similar_secs,
        classical_secs,
        plan_secs,
    })
}

fn median(repeats: u32, clock: &dyn Fn() -> f64, work: &mut dyn FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..repeats.max(1))
        .map(|_| {
            let start = clock();
            work();
            clock() - start
        })
        .collect();
    times.sort_unstable_by(f64::total_cmp);
    times[times.len() / 2]
}
