//! The colours of a look on a skin and on its hair: asked once per look, not per frame.

use super::Root;
use super::chart::{Chart, Site};
use super::markings::Colouring;
use crate::anatomy::{Look, MarkingKind, Pattern, Region};
use crate::rig::Rig;
use crate::subdiv::{Plan, evaluate_once};
use glam::Vec3;

/// A look, ready to colour the skin of a plan.
#[derive(Debug)]
pub struct Colours<'a> {
    chart: &'a Chart,
    shares: Vec<Share<'a>>,
}

#[derive(Debug)]
struct Share<'a> {
    share: f32,
    colouring: Colouring<'a>,
    /// For each marking how much of its regions is at each vertex; empty where it has none.
    patches: Vec<Vec<f32>>,
}

impl<'a> Colours<'a> {
    /// `chart` is that of the plan.
    pub fn new(look: &'a Look, rig: &Rig, plan: &Plan, chart: &'a Chart) -> Self {
        let regions = rig.half().whole_regions();
        let share = |(share, pattern): (f32, &'a Pattern)| {
            let patch = |kind: MarkingKind, named: &[Region]| match kind {
                MarkingKind::Patch => over_regions(plan, &regions, named),
                _ => Vec::new(),
            };
            let patches = pattern.markings.iter().map(|m| patch(m.kind, &m.regions)).collect();
            Share { share, colouring: Colouring::new(pattern), patches }
        };
        Self { chart, shares: look.shares().map(share).collect() }
    }

    /// Linear colours of the coat at the skin's vertices, one each. The bits do not depend on the number of threads.
    pub fn of_skin(&self, threads: usize, out: &mut [Vec3]) {
        fill(out, threads, |v| self.at(&self.chart.vertex(v), |patch| patch[v]));
    }

    /// Linear colours of hairs, one for each root; `triangles` are those that the roots were made for.
    pub fn of_hair(&self, roots: &[Root], triangles: &[[u32; 3]], threads: usize, out: &mut [Vec3]) {
        fill(out, threads, |i| {
            let root = &roots[i];
            let corners = triangles[root.triangle as usize];
            self.at(&self.chart.root(root, triangles), |patch| {
                root.mixed(corners.map(|v| Vec3::splat(patch[v as usize]))).x
            })
        });
    }

    fn at(&self, site: &Site, patch: impl Fn(&[f32]) -> f32) -> Vec3 {
        let colours = self.shares.iter().map(|s| s.colouring.at(site, |i| patch(&s.patches[i])) * s.share);
        colours.fold(Vec3::ZERO, |sum, colour| sum + colour)
    }
}

/// How much of the named regions is at each vertex of a plan, 0 to 1.
fn over_regions(plan: &Plan, regions: &[Region], named: &[Region]) -> Vec<f32> {
    let control: Vec<Vec3> = regions.iter().map(|r| Vec3::splat(f32::from(u8::from(named.contains(r))))).collect();
    evaluate_once(plan, &control).0.into_iter().map(|v| v.x).collect()
}

/// Writes `of(i)` to every place; each thread has a part.
fn fill(out: &mut [Vec3], threads: usize, of: impl Fn(usize) -> Vec3 + Sync) {
    let part = out.len().div_ceil(threads.max(1)).max(1);
    if part >= out.len() {
        out.iter_mut().enumerate().for_each(|(i, to)| *to = of(i));
        return;
    }
    let of = &of;
    std::thread::scope(|scope| {
        for (k, part_of_out) in out.chunks_mut(part).enumerate() {
            scope.spawn(move || part_of_out.iter_mut().enumerate().for_each(|(i, to)| *to = of(k * part + i)));
        }
    });
}
