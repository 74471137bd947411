//! Sharpness that ends, of which only Loop has a peer: how each scheme goes from smooth to sharp.

#[path = "support/random.rs"]
mod random;
#[path = "support/tables.rs"]
mod tables;
#[path = "support/walk.rs"]
mod walk;

use glam::DVec3;
use londra::math::rng::Rng;
use londra::mesh::shapes::{disk, fan, grid, pole, tetrahedron};
use londra::mesh::{DedgeMesh, PolygonMesh, VertexId};
use londra::subdiv::{Creasing, DoublePlan, INFINITE_SHARPNESS, Plan, PlanOptions, Scheme, Tags};
use random::Sample;

const CREASED: [Scheme; 4] = [Scheme::Sqrt3, Scheme::Loop, Scheme::Butterfly, Scheme::CatmullClark];

fn samples() -> Vec<Sample> {
    let shapes = [disk(5), fan(3), pole(8), tetrahedron(), grid(4, 3)];
    let jittered = shapes.iter().enumerate().map(|(i, s)| Sample::of(s).jittered(&mut Rng::new(i as u64)));
    jittered.chain((0..5).flat_map(|seed| [random::closed(seed), random::open(seed)])).collect()
}

/// Random creases and corners, all of one sharpness.
fn tags(mesh: &DedgeMesh, seed: u64, sharpness: f32) -> Tags {
    let mut tags = random::creases(mesh, seed);
    tags.creases.iter_mut().for_each(|crease| crease.2 = sharpness);
    tags.corners.iter_mut().for_each(|corner| corner.1 = sharpness);
    tags
}

fn refined(sample: &Sample, tags: &Tags, options: &PlanOptions) -> (PolygonMesh, Vec<DVec3>) {
    let (mesh, at) = (sample.mesh(), || format!("{} {tags:?} {options:?}", sample.name));
    let plan = Plan::build_with(&mesh, tags, options).unwrap_or_else(|e| panic!("{}: {e}", at()));
    let double = DoublePlan::build_with(&mesh, tags, options).unwrap_or_else(|e| panic!("{}: {e}", at()));
    let (sizes, corners) = plan.faces();
    let faces = PolygonMesh::from_faces(plan.n_vertices(), &sizes, corners).unwrap_or_else(|e| panic!("{}: {e}", at()));
    (faces, tables::positions(&double, &sample.positions))
}

/// What holds exactly as sharpness vanishes: at every even level the √3 mesh with creases has the faces of the one
/// without (a pair of steps turns all edges back), and each vertex comes to that of the smooth surface, in proportion to
/// the sharpness. After an odd number of steps the edges of creases are not turned, and only vertices agree.
/// The other schemes have the same faces at every level.
#[test]
fn a_vanishing_sharpness_does_not_lead_to_the_smooth_surface() {
    for scheme in CREASED {
        for (seed, sample) in samples().iter().enumerate() {
            for levels in [2, 4] {
                let options = PlanOptions::new(scheme, levels);
                let smooth = refined(sample, &Tags::default(), &options);
                let size = tables::size(&smooth.1);
                for sharpness in [1e-6, 1e-4] {
                    let tags = tags(&sample.mesh(), seed as u64, sharpness);
                    let blended = refined(sample, &tags, &options);
                    let distance = 2.0 * f64::from(sharpness) * size;
                    let name = format!("{} {} level {levels} sharpness {sharpness}", sample.name, scheme.name());
                    let sides = (&smooth.0, &smooth.1[..]);
                    let found = walk::pair(sides, (&blended.0, &blended.1), sample.positions.len(), |_| true, distance);
                    let matching = found.unwrap_or_else(|e| panic!("{name}: {e}"));
                    for (p, &v) in smooth.1.iter().zip(&matching) {
                        let off = p.distance(blended.1[v as usize]);
                        assert!(off <= distance, "{name}: {off:e} off at {p}");
                    }
                }
            }
        }
    }
}

/// The other end: as long as it lasts for all steps, a sharpness is no different from an infinite one.
#[test]
fn a_sharpness_that_outlasts_the_plan_is_not_infinite() {
    for scheme in CREASED {
        for creasing in [Creasing::Uniform, Creasing::Chaikin] {
            let options = PlanOptions { creasing, ..PlanOptions::new(scheme, 4) };
            for (seed, sample) in samples().iter().enumerate() {
                let of = |sharpness| refined(sample, &tags(&sample.mesh(), seed as u64, sharpness), &options);
                let (lasting, infinite) = (of(9.5), of(INFINITE_SHARPNESS));
                assert!(lasting == infinite, "{} {} {creasing:?}", sample.name, scheme.name());
                assert!(of(INFINITE_SHARPNESS + 7.0) == infinite, "{} {}", sample.name, scheme.name());
            }
        }
    }
}

/// Also where a step is used up: the surface of sharpness 1 lies between those of a little less and a little more.
#[test]
fn the_surface_jumps_as_sharpness_grows() {
    let little = 1e-4_f32;
    for scheme in CREASED {
        for (seed, sample) in samples().iter().enumerate() {
            // For √3 a step of sharpness is two of the plan.
            let options = PlanOptions::new(scheme, if scheme == Scheme::Sqrt3 { 6 } else { 3 });
            let of = |sharpness: f32| refined(sample, &tags(&sample.mesh(), seed as u64, sharpness), &options);
            for sharpness in [0.5, 1.0, 1.5, 2.0, 3.0] {
                let (less, more) = (of(sharpness - little), of(sharpness + little));
                let size = tables::size(&less.1);
                let distance = 4.0 * f64::from(little) * size;
                let name = format!("{} {} sharpness {sharpness}", sample.name, scheme.name());
                let found =
                    walk::pair((&less.0, &less.1), (&more.0, &more.1), sample.positions.len(), |_| true, distance);
                let matching = found.unwrap_or_else(|e| panic!("{name}: {e}"));
                for (p, &v) in less.1.iter().zip(&matching) {
                    let off = p.distance(more.1[v as usize]);
                    assert!(off <= distance, "{name}: {off:e} off at {p}");
                }
            }
        }
    }
}

/// A smooth end of an infinite crease: a second crease that fades away there leaves nothing behind.
#[test]
fn a_fading_crease_bends_the_one_that_stays() {
    for scheme in CREASED {
        for n in 4..=9 {
            let sample = Sample::of(&disk(n)).jittered(&mut Rng::new(n.into()));
            let options = PlanOptions::new(scheme, 4);
            let spoke = |i: u32, sharpness: f32| (VertexId(0), VertexId(1 + i), sharpness);
            let with = |sharpness: f32| {
                let mut creases = vec![spoke(0, INFINITE_SHARPNESS)];
                creases.extend((sharpness > 0.0).then(|| spoke(2, sharpness)));
                refined(&sample, &Tags { creases, ..Tags::default() }, &options)
            };
            let (alone, faded) = (with(0.0), with(1e-5));
            let distance = 1e-4 * tables::size(&alone.1);
            let found =
                walk::pair((&alone.0, &alone.1), (&faded.0, &faded.1), sample.positions.len(), |_| true, distance);
            let matching = found.unwrap_or_else(|e| panic!("{} {}: {e}", sample.name, scheme.name()));
            for (p, &v) in alone.1.iter().zip(&matching) {
                let off = p.distance(faded.1[v as usize]);
                assert!(off <= distance, "{} {}: {off:e} off at {p}", sample.name, scheme.name());
            }
        }
    }
}
