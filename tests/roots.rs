//! Hair is rooted in the same place of the head whatever the level of subdivision, on every breed and blend.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;

use glam::Vec3;
use londra::anatomy::{Breed, Region};
use londra::coat::{Chart, Root, n_rooted};
use londra::frame::{Frame, Pipeline};
use rstar::RTree;
use rstar::primitives::GeomWithData;
use settings::World;

const LEVELS: [u32; 3] = [2, 3, 4];
const N: usize = 2_000;

/// How far the root of a level may lie from the finest surface on the base head, head units (10 mm on the default head):
/// coarse triangles cut corners.
const OFF_ON_BASE: [f32; 3] = [0.08, 0.025, 1e-4];
/// How far it may stand from where it stands on the finest level, as parts of the head's size, in the mean and at most.
const OFF: [(f32, f32); 3] = [(4e-4, 5e-3), (1e-4, 1.2e-3), (1e-6, 1e-5)];

/// The same on a head with loose skin, whose folds stand out from the second level on, and there on coarse triangles.
const OFF_FOLDS: [(f32, f32); 3] = [(4e-3, 3e-2), (3e-4, 1.2e-2), OFF[2]];
const FOLDS: [&str; 3] = ["brow_folds_mm", "nose_folds_mm", "cheek_folds_mm"];

/// One level: its heads, where its skin lies on the base head, and which region each of its triangles is of.
struct Level {
    pipeline: Pipeline,
    chart: Chart,
    triangles: Vec<[u32; 3]>,
    regions: Vec<[Region; 3]>,
}

impl Level {
    fn new(world: &World, level: u32) -> Self {
        let mut pipeline = world.pipeline(level, N);
        let chart = Chart::new(&world.rig, pipeline.skin_plan());
        let of_vertex = world.rig.half().whole_regions();
        let control = world.rig.mesh().indices().as_chunks::<3>().0;
        let plan = pipeline.skin_plan().clone();
        let of_face: std::collections::BTreeMap<[u32; 3], u32> =
            plan.indices().as_chunks::<3>().0.iter().copied().zip(plan.face_parent().iter().copied()).collect();
        let frame = pipeline.update(&world.breeds[0]);
        let triangles = frame.parts[0].topology.indices.as_chunks::<3>().0.to_vec();
        let regions = triangles.iter().map(|t| control[of_face[t] as usize].map(|v| of_vertex[v as usize])).collect();
        Self { pipeline, chart, triangles, regions }
    }

    /// The place on the base head of a vertex, and which face of an ear it is on: there two places lie close together.
    fn key(&self, v: u32) -> [f32; 4] {
        let site = self.chart.vertex(v as usize);
        [site.place.x, site.place.y, site.place.z, 3.0 * site.ear.z]
    }
}

/// Where a root of a level stands among the triangles of another one.
struct Place {
    triangle: usize,
    weights: Vec3,
    /// From the root, on the base head, head units.
    distance: f32,
}

/// Looks for places by where they lie on the base head.
struct Finder<'a> {
    level: &'a Level,
    vertices: RTree<GeomWithData<[f32; 4], u32>>,
    around: Vec<Vec<u32>>,
}

impl<'a> Finder<'a> {
    fn new(level: &'a Level) -> Self {
        let vertices = (0..level.chart.len() as u32).map(|v| GeomWithData::new(level.key(v), v)).collect();
        let mut around = vec![Vec::new(); level.chart.len()];
        for (t, corners) in (0..).zip(&level.triangles) {
            corners.iter().for_each(|&v| around[v as usize].push(t));
        }
        Self { level, vertices: RTree::bulk_load(vertices), around }
    }

    fn place(&self, level: &Level, root: &Root) -> Place {
        let site = level.chart.root(root, &level.triangles);
        let key = [site.place.x, site.place.y, site.place.z, 3.0 * site.ear.z];
        let mut best = Place { triangle: 0, weights: Vec3::X, distance: f32::INFINITY };
        for near in self.vertices.nearest_neighbor_iter(key).take(16) {
            for &t in &self.around[near.data as usize] {
                let corners = self.level.triangles[t as usize].map(|v| self.level.chart.vertex(v as usize).place);
                let weights = nearest(corners, site.place);
                let at = corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
                let distance = at.distance(site.place);
                if distance < best.distance {
                    best = Place { triangle: t as usize, weights, distance };
                }
            }
        }
        best
    }
}

/// Weights of the place of a triangle that is nearest to a point; after Ericson 2005, "Real-time collision detection", 5.1.5.
fn nearest([a, b, c]: [Vec3; 3], p: Vec3) -> Vec3 {
    let (ab, ac, ap, bp, cp) = (b - a, c - a, p - a, p - b, p - c);
    let (d1, d2, d3, d4, d5, d6) = (ab.dot(ap), ac.dot(ap), ab.dot(bp), ac.dot(bp), ab.dot(cp), ac.dot(cp));
    if d1 <= 0.0 && d2 <= 0.0 {
        return Vec3::X;
    }
    if d3 >= 0.0 && d4 <= d3 {
        return Vec3::Y;
    }
    if d6 >= 0.0 && d5 <= d6 {
        return Vec3::Z;
    }
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return Vec3::new(1.0 - t, t, 0.0);
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return Vec3::new(1.0 - t, 0.0, t);
    }
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return Vec3::new(0.0, 1.0 - t, t);
    }
    let sum = va + vb + vc;
    Vec3::new(va, vb, vc) / sum
}

fn heads(world: &World) -> Vec<Breed> {
    let mut heads = world.breeds.clone();
    for (k, [a, b]) in world.pairs().into_iter().step_by(13).take(10).enumerate() {
        let share = 0.1 + 0.08 * k as f32;
        heads.push(Breed::blend(&world.table, &[(a, share), (b, 1.0 - share)]));
    }
    heads
}

fn roots(frame: &Frame<'_>) -> Vec<Root> {
    frame.coat.unwrap().roots.to_vec()
}

#[test]
fn a_root_stands_elsewhere_on_another_head_or_level() {
    let world = World::embedded();
    let mut levels = LEVELS.map(|level| Level::new(&world, level));
    let all: Vec<Vec<Root>> = levels.iter().map(|level| roots(&level.pipeline.frame())).collect();
    for (level, roots) in levels.iter().zip(&all) {
        assert_eq!(roots.len(), n_rooted(N));
        for root in roots {
            // What the noise of locks is bound to is where markings find it.
            let site = level.chart.root(root, &level.triangles);
            assert!(site.place.abs_diff_eq(root.place.into(), 1e-5), "{root:?} is at {}", site.place);
        }
    }
    // Each root of a coarse level on the finest one.
    let finest = &levels[LEVELS.len() - 1];
    let finder = Finder::new(finest);
    let places: Vec<Vec<Place>> =
        levels.iter().zip(&all).map(|(level, roots)| roots.iter().map(|r| finder.place(level, r)).collect()).collect();
    for (((level, roots), places), allowed) in levels.iter().zip(&all).zip(&places).zip(OFF_ON_BASE) {
        let name = level.pipeline.level();
        for (root, place) in roots.iter().zip(places) {
            assert!(place.distance < allowed, "level {name}: {} head units off", place.distance);
            let own = level.regions[root.triangle as usize];
            let found = finest.regions[place.triangle];
            assert!(found.iter().any(|r| own.contains(r)), "level {name}: in {own:?} and in {found:?}");
        }
    }
    let triangles = finest.triangles.clone();
    let on_finest = |positions: &[Vec3], place: &Place| {
        let [a, b, c] = triangles[place.triangle].map(|v| positions[v as usize]);
        a * place.weights.x + b * place.weights.y + c * place.weights.z
    };
    for head in heads(&world) {
        let frame = levels[LEVELS.len() - 1].pipeline.update(&head);
        let size = {
            let (low, high) = frame.bounds();
            (high - low).length()
        };
        let skin = frame.parts[0].positions.to_vec();
        for ((((level, roots), places), (mean, most)), off_folds) in
            levels.iter_mut().zip(&all).zip(&places).zip(OFF).zip(OFF_FOLDS)
        {
            let own = level.pipeline.update(&head);
            let positions = own.parts[0].positions;
            let off = roots.iter().zip(places).map(|(root, place)| {
                let at = root.mixed(level.triangles[root.triangle as usize].map(|v| positions[v as usize]));
                at.distance(on_finest(&skin, place)) / size
            });
            let off: Vec<f32> = off.collect();
            let (found, farthest) =
                (off.iter().sum::<f32>() / off.len() as f32, off.iter().copied().fold(0.0, f32::max));
            let name = level.pipeline.level();
            let folded = FOLDS.iter().any(|id| world.table.index_of(id).is_some_and(|k| head.values[k] > 0.0));
            let (mean, most) = if folded { off_folds } else { (mean, most) };
            assert!(found < mean && farthest < most, "{}, level {name}: {found} off, {farthest} at most", head.id);
        }
    }
}
