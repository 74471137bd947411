//! Limit positions and normals: against the next level, against deep levels, and where they end.

#[path = "support/random.rs"]
mod random;
#[path = "support/tables.rs"]
mod tables;

use glam::DVec3;
use londra::math::rng::Rng;
use londra::mesh::shapes::{disk, fan, pole};
use londra::mesh::{DedgeMesh, VertexId};
use londra::subdiv::{
    BoundaryRule, DoublePlan, INFINITE_SHARPNESS, LimitTable, LoopWeights, PlanOptions, Scheme, Tags, levels_of,
};
use random::Sample;

/// The schemes with limits, as options of level 0.
fn schemes() -> Vec<PlanOptions> {
    let plain = |scheme| PlanOptions::new(scheme, 0);
    vec![
        plain(Scheme::Sqrt3),
        plain(Scheme::Loop),
        PlanOptions { loop_weights: LoopWeights::Warren, ..plain(Scheme::Loop) },
        PlanOptions { boundary: BoundaryRule::EdgeAndCorner, ..plain(Scheme::Sqrt3) },
        PlanOptions { boundary: BoundaryRule::EdgeAndCorner, ..plain(Scheme::Loop) },
    ]
}

/// Positions of a level, its limits and its unit normals.
struct At {
    positions: Vec<DVec3>,
    limits: Vec<DVec3>,
    normals: Vec<DVec3>,
    table: LimitTable<f64>,
}

impl At {
    /// Whether a vertex lies on a curve: its first tangent is the difference of two neighbours.
    fn is_on_curve(&self, vertex: usize) -> bool {
        self.table.row(vertex).1.iter().filter(|w| w[1] != 0.0).count() == 2
    }
}

fn at(mesh: &DedgeMesh, control: &[DVec3], tags: &Tags, options: &PlanOptions, levels: u32) -> At {
    let options = PlanOptions { levels, ..*options };
    let plan = DoublePlan::build_with(mesh, tags, &options).expect("small");
    let positions = tables::positions(&plan, control);
    let table = plan.limit.expect("it has limits");
    let (limits, normals) = tables::limits(&table, &positions);
    At { positions, limits, normals, table }
}

/// Creases and corners that are sharp for ever.
fn sharp(mesh: &DedgeMesh, seed: u64) -> Tags {
    let mut tags = random::creases(mesh, seed);
    tags.creases.iter_mut().for_each(|crease| crease.2 = INFINITE_SHARPNESS);
    tags.corners.iter_mut().for_each(|corner| corner.1 = INFINITE_SHARPNESS);
    tags
}

/// The rule of each control vertex: number of sharp edges, or many for a corner.
fn sharp_edges(mesh: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Vec<usize> {
    let is_sharp = |a: VertexId, b: VertexId| {
        tags.creases.iter().any(|&(c, d, _)| (a, b) == (c, d) || (a, b) == (d, c))
            || mesh.outgoing_dedges(a).any(|d| mesh.target(d) == b && mesh.is_boundary_dedge(d))
            || mesh.outgoing_dedges(b).any(|d| mesh.target(d) == a && mesh.is_boundary_dedge(d))
    };
    let of = |v: VertexId| {
        let is_corner = tags.corners.iter().any(|corner| corner.0 == v)
            || (options.boundary == BoundaryRule::EdgeAndCorner
                && mesh.is_boundary_vertex(v)
                && mesh.faces_around(v).count() == 1);
        if is_corner { 9 } else { mesh.ring(v).filter(|&w| is_sharp(v, w)).count() }
    };
    mesh.vertices().map(of).collect()
}

/// Darts apart, which are taken as smooth and go elsewhere, and what has one as a neighbour on its curve; and normals of
/// corners, which have none in general, and of creases, which have one on each side (see below).
#[test]
fn a_limit_differs_from_that_of_the_next_level() {
    let mut compared = 0;
    for (k, sample) in random::all(16).iter().enumerate() {
        let mesh = sample.mesh();
        let size = tables::size(&sample.positions);
        for tags in [Tags::default(), sharp(&mesh, k as u64)] {
            for options in schemes() {
                let rules = sharp_edges(&mesh, &tags, &options);
                let meshes = levels_of(&mesh, &tags, &PlanOptions { levels: 4, ..options }).expect("small");
                let mut before: Option<At> = None;
                for level in 0..=4 {
                    let here = at(&mesh, &sample.positions, &tags, &options, level);
                    if let Some(before) = before {
                        for v in 0..before.limits.len() {
                            let rule = rules.get(v).copied();
                            let is_dart = |v: usize| rules.get(v) == Some(&1);
                            let mut ring = meshes[level as usize - 1].ring(VertexId(v as u32));
                            if is_dart(v) || (options.scheme == Scheme::Sqrt3 && ring.any(|w| is_dart(w.index()))) {
                                continue;
                            }
                            let what = || format!("{} {:?} {options:?} level {level} vertex {v}", sample.name, tags);
                            let off = before.limits[v].distance(here.limits[v]);
                            assert!(off <= 1e-12 * size, "{}: {off:e}", what());
                            compared += 1;
                            let is_crease = before.is_on_curve(v)
                                && !meshes[level as usize - 1].is_boundary_vertex(VertexId(v as u32));
                            if rule.is_none_or(|n| n <= 2) && !is_crease && before.normals[v] != DVec3::ZERO {
                                let off = before.normals[v].distance(here.normals[v]);
                                assert!(off <= 1e-9, "{}: normal {off:e}", what());
                            }
                        }
                    }
                    before = Some(here);
                }
            }
        }
    }
    eprintln!("{compared} limits compared");
}
