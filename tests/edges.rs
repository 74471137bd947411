//! Edges of the skin: where the patch file says, as sharp as an animal's, and where the features want them.
//!
//! Lengths are millimetres at a skull of 200 mm. `--nocapture` prints what was measured.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;

use glam::Vec3;
use londra::frame::skin_tags;
use londra::mesh::{DedgeMesh, FaceId, VertexId};
use londra::rig::Deformed;
use londra::rig::deform::ROUNDS;
use londra::subdiv::{Evaluator, Plan, PlanOptions, Positions, Scheme, Tags};
use settings::World;
use std::collections::BTreeSet;

/// Loops that are edges.
const EDGES: [&str; 4] = ["nose_outline", "upper_lip", "lower_lip", "lid_outer"];

/// The vertices of an edge, in order.
fn edge(world: &World, name: &str) -> Vec<u16> {
    world.rig.half().loops[name].clone()
}

/// Those of them on which the edge goes on to both sides.
fn inner(world: &World, name: &str) -> Vec<usize> {
    let solved: BTreeSet<u16> = world.rig.half().limits.iter().map(|row| row.0).collect();
    edge(world, name).into_iter().filter(|v| solved.contains(v)).map(usize::from).collect()
}

/// Millimetres at 200 of one metre of this head.
fn at_200(world: &World, values: &[f32]) -> f32 {
    200.0 / world.skull_length(values)
}

fn plan(world: &World, tags: &Tags, options: &PlanOptions) -> Plan {
    Plan::build_with(world.rig.mesh(), tags, options).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn an_edge_is_not_marked() {
    let world = World::embedded();
    let half = world.rig.half();
    let marked = |a: u16, b: u16| half.creases.iter().any(|&(c, d, s)| s > 0.0 && [(a, b), (b, a)].contains(&(c, d)));
    let mut n = 0;
    for name in EDGES {
        let chain = edge(&world, name);
        let closing = (name == "lid_outer").then(|| [chain[chain.len() - 1], chain[0]]);
        for [a, b] in chain.windows(2).map(|w| [w[0], w[1]]).chain(closing) {
            assert!(marked(a, b), "{name}: {} to {}", half.tags[a as usize], half.tags[b as usize]);
            n += 1;
        }
    }
    assert_eq!(n, half.creases.len(), "a crease that is none of {EDGES:?}");
}

/// The compensation leaves no more than this between the limit of an edge and its aim.
const OFF: f32 = 0.01;

#[test]
fn an_edge_is_not_where_it_is_wanted() {
    let world = World::embedded();
    let options = PlanOptions { positions: Positions::Limit, ..PlanOptions::new(Scheme::Sqrt3, 2) };
    let limit = plan(&world, &skin_tags(&world.rig), &options);
    let mut evaluator = Evaluator::new(&limit);
    let mut head = Deformed::default();
    let half = world.rig.half();
    let mut worst = (0.0, String::new());
    for breed in &world.breeds {
        world.rig.deform(&breed.values, ROUNDS, &mut head);
        let shape = world.rig.proportions(&breed.values);
        let at = evaluator.evaluate(&limit, &head.control).positions;
        for v in EDGES.into_iter().flat_map(|name| inner(&world, name)) {
            let off = at_200(&world, &breed.values) * shape.metres(head.aims()[v]).distance(at[v]);
            if off > worst.0 {
                worst = (off, format!("{} of {}", half.tags[v], breed.id));
            }
        }
    }
    println!("the limit of an edge lies {:.4} mm from its aim at {}", worst.0, worst.1);
    assert!(worst.0 < OFF, "{worst:?}");
}

/// For each vertex the smallest radius of the bends across its edges.
fn radii(positions: &[Vec3], indices: &[u32]) -> Vec<f32> {
    let triangles: Vec<[u32; 3]> = indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    let mesh = DedgeMesh::from_triangles(positions.len(), &triangles).unwrap_or_else(|e| panic!("{e}"));
    let at = |f: FaceId| mesh.corners(f).map(|v| positions[v.index()]);
    let radius = |[f, g]: [FaceId; 2]| {
        let ([a, b, c], [p, q, r]) = (at(f), at(g));
        let normals = [(b - a).cross(c - a), (q - p).cross(r - p)].map(Vec3::normalize_or_zero);
        let turn = normals[0].dot(normals[1]).clamp(-1.0, 1.0).acos();
        ((a + b + c) / 3.0).distance((p + q + r) / 3.0) / turn.max(1e-4)
    };
    let around = |v: VertexId| {
        let bends = mesh.outgoing_dedges(v).filter_map(|d| mesh.twin(d).map(|t| radius([mesh.face(d), mesh.face(t)])));
        bends.fold(f32::INFINITY, f32::min)
    };
    mesh.vertices().map(around).collect()
}

fn median(mut all: Vec<f32>) -> f32 {
    all.sort_by(f32::total_cmp);
    all[all.len() / 2]
}

/// Largest median radius of an edge over all breeds.
const RADIUS: f32 = 3.0;
/// And as a part of that of the skin beside it, and of what the smooth rule makes of the same control mesh.
const SHARPER: f32 = 0.5;

#[test]
fn an_edge_is_not_sharp() {
    let world = World::embedded();
    let options = PlanOptions::new(Scheme::Sqrt3, 4);
    let plans = [skin_tags(&world.rig), Tags::default()].map(|tags| plan(&world, &tags, &options));
    let mut evaluators = [0, 1].map(|k| Evaluator::new(&plans[k]));
    let mut head = Deformed::default();
    // For each edge: radius there, of the same vertices under the smooth rule, and beside it.
    let mut found: Vec<[Vec<f32>; 3]> = vec![Default::default(); EDGES.len()];
    for breed in &world.breeds {
        world.rig.deform(&breed.values, ROUNDS, &mut head);
        let scale = at_200(&world, &breed.values);
        let [sharp, smooth] = [0, 1].map(|k| {
            let skin = evaluators[k].evaluate(&plans[k], &head.control);
            radii(skin.positions, skin.indices)
        });
        for (name, found) in EDGES.into_iter().zip(&mut found) {
            let own = inner(&world, name);
            let ring = |&v: &usize| world.rig.mesh().ring(VertexId(v as u32)).map(|u| u.index());
            let beside: BTreeSet<usize> = own.iter().flat_map(ring).filter(|u| !own.contains(u)).collect();
            found[0].extend(own.iter().map(|&v| scale * sharp[v]));
            found[1].extend(own.iter().map(|&v| scale * smooth[v]));
            found[2].extend(beside.iter().map(|&v| scale * sharp[v]));
        }
    }
    for (name, found) in EDGES.into_iter().zip(found) {
        let [own, smooth, beside] = found.map(median);
        println!("{name}: radius {own:.2} mm in the median, {beside:.1} beside it, {smooth:.2} if it were smooth");
        assert!(own < RADIUS, "{name}: {own} mm");
        assert!(own < SHARPER * beside && own < SHARPER * smooth, "{name}: {own}, {beside} beside, {smooth} smooth");
    }
}
