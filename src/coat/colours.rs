//! The colours of a coat on a skin and on its hair: asked once per look, not per frame.

use super::Root;
use super::chart::{Chart, Fibre};
use super::markings::Colouring;
use crate::anatomy::{MarkingKind, Pattern, Region};
use crate::rig::Rig;
use crate::subdiv::{Plan, evaluate_once};
use glam::Vec3;

/// A coat, ready to colour the skin of a plan.
#[derive(Debug)]
pub struct Colours<'a> {
    chart: &'a Chart,
    colouring: Colouring<'a>,
    /// For each marking how much of its regions is at each vertex; empty where it has none.
    patches: Vec<Vec<f32>>,
}

impl<'a> Colours<'a> {
    /// `chart` is that of the plan.
    pub fn new(pattern: &'a Pattern, rig: &Rig, plan: &Plan, chart: &'a Chart) -> Self {
        let regions = rig.half().whole_regions();
        let patch = |kind: MarkingKind, named: &[Region]| match kind {
            MarkingKind::Patch => over_regions(plan, &regions, named),
            _ => Vec::new(),
        };
        let patches = pattern.markings.iter().map(|m| patch(m.kind, &m.regions)).collect();
        Self { chart, colouring: Colouring::new(pattern), patches }
    }

    /// Linear colours of the coat at the skin's vertices, one each. The bits do not depend on the number of threads.
    pub fn of_skin(&self, threads: usize) -> Vec<Vec3> {
        filled(self.chart.len(), threads, |v| self.colouring.at(&self.chart.vertex(v), |i| self.patches[i][v]))
    }

    /// Linear colour of a fibre of the coat at a place between the skin's vertices, given by their weights.
    pub fn between(&self, place: &[(usize, f32)], fibre: Fibre) -> Vec3 {
        let patch = |i: usize| place.iter().fold(0.0, |sum, &(v, weight)| sum + self.patches[i][v] * weight);
        self.colouring.at(&self.chart.between(place, fibre), patch)
    }

    /// Linear colours of hairs, one for each root; `triangles` are those that the roots were made for.
    pub fn of_hair(&self, roots: &[Root], triangles: &[[u32; 3]], threads: usize) -> Vec<Vec3> {
        filled(roots.len(), threads, |i| {
            let root = &roots[i];
            let corners = triangles[root.triangle as usize];
            let patch = |k: usize| root.mixed(corners.map(|v| Vec3::splat(self.patches[k][v as usize]))).x;
            self.colouring.at(&self.chart.root(root, triangles), patch)
        })
    }
}

/// How much of the named regions is at each vertex of a plan, 0 to 1.
fn over_regions(plan: &Plan, regions: &[Region], named: &[Region]) -> Vec<f32> {
    let control: Vec<Vec3> = regions.iter().map(|r| Vec3::splat(f32::from(u8::from(named.contains(r))))).collect();
    evaluate_once(plan, &control).0.into_iter().map(|v| v.x).collect()
}

/// `of(i)` for `n` places; each thread has a part of them.
fn filled(n: usize, threads: usize, of: impl Fn(usize) -> Vec3 + Sync) -> Vec<Vec3> {
    let mut out = vec![Vec3::ZERO; n];
    let part = n.div_ceil(threads.max(1)).max(1);
    if part >= n {
        out.iter_mut().enumerate().for_each(|(i, to)| *to = of(i));
        return out;
    }
    let of = &of;
    std::thread::scope(|scope| {
        for (k, places) in out.chunks_mut(part).enumerate() {
            scope.spawn(move || places.iter_mut().enumerate().for_each(|(i, to)| *to = of(k * part + i)));
        }
    });
    out
}
