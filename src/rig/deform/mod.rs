//! The function from proportions to the half mesh's control positions, in its written order: features, start, fit,
//! tissue over bone, ear, limit.

mod blink;
mod ear;
mod fit;
mod lids;
mod limit;
mod lips;
mod mouth;
mod nose;
mod stations;
mod tissue;

use super::control::{HalfMesh, HalfRings};
use super::handles::Handles;
use super::implicit::{Implicit, Layer};
use super::proportions::{Measures, Proportions};
use crate::math::ops;
use glam::Vec3;
use std::sync::Arc;

pub(super) use blink::{Lids, place as place_lids, vertices as lid_vertices};
pub use fit::{FitPlan, hollow, layers};
pub use lids::{eye_axes, orbit_axes};
use limit::LimitPlan;
use tissue::TissuePlan;

/// Rounds of the live fit.
pub const ROUNDS: usize = 10;

pub(crate) fn sin_cos(angle: f32) -> (f32, f32) {
    (ops::sin(angle), ops::cos(angle))
}

/// Positions that features fix, while they are being placed.
pub struct Pins<'a> {
    shape: &'a Proportions,
    surface: &'a Implicit,
    handles: &'a Handles,
    at: &'a mut [Vec3],
    buffer: &'a mut Vec<Ray>,
    record: Option<&'a mut PinKinds>,
}

/// Steps of a ray: a fixed number, safeguarded Newton.
const RAY_STEPS: usize = 9;

/// A ray from outside that places a vertex.
#[derive(Clone, Copy, Debug)]
struct Ray {
    vertex: u16,
    from: Vec3,
    towards: Vec3,
    layer: Layer,
    /// Shapes the start of the fit only.
    guide: bool,
}

impl Ray {
    fn new(vertex: u16, from: Vec3, towards: Vec3, layer: Layer) -> Self {
        Self { vertex, from, towards, layer, guide: false }
    }

    fn guide(vertex: u16, from: Vec3, towards: Vec3, layer: Layer) -> Self {
        Self { guide: true, ..Self::new(vertex, from, towards, layer) }
    }

    fn advance(&self, p: Vec3, (f, g): (f32, Vec3)) -> Vec3 {
        p + self.towards * (f / (-g.dot(self.towards)).max(0.6)).clamp(-3.0, 6.0)
    }
}

/// Which vertices the features place: found once, by placing them.
#[derive(Clone, Debug, Default)]
pub struct PinKinds {
    pinned: Vec<bool>,
    guides: Vec<bool>,
}

impl Pins<'_> {
    fn set(&mut self, v: u16, p: Vec3) {
        self.at[v as usize] = p;
        if let Some(kinds) = &mut self.record {
            kinds.pinned[v as usize] = true;
        }
    }

    /// The list of rays, empty; give it back with [`Pins::keep`], so that its memory serves again.
    fn rays(&mut self) -> Vec<Ray> {
        std::mem::take(self.buffer)
    }

    /// Puts a guide where it is wanted.
    fn set_guide(&mut self, v: u16, p: Vec3) {
        self.at[v as usize] = p;
        if let Some(kinds) = &mut self.record {
            kinds.guides[v as usize] = true;
        }
    }

    /// Runs the rays that are left and takes the list back.
    fn keep(&mut self, mut rays: Vec<Ray>) {
        self.trace(&mut rays);
        *self.buffer = rays;
    }

    /// Puts vertices where rays from outside meet the surface, two rays at a time; empties the list.
    fn trace(&mut self, rays: &mut Vec<Ray>) {
        for pair in rays.chunks(2) {
            let (a, b) = (&pair[0], &pair[pair.len() - 1]);
            let (mut p, mut q) = (a.from, b.from);
            for _ in 0..RAY_STEPS {
                if a.layer == b.layer {
                    let [sp, sq] = self.surface.sample2(p, q, a.layer);
                    (p, q) = (a.advance(p, sp), b.advance(q, sq));
                } else {
                    p = a.advance(p, self.surface.sample(p, a.layer));
                    q = b.advance(q, self.surface.sample(q, b.layer));
                }
            }
            for (ray, hit) in [(a, p), (b, q)] {
                self.at[ray.vertex as usize] = hit;
                if let Some(kinds) = &mut self.record {
                    let list = if ray.guide { &mut kinds.guides } else { &mut kinds.pinned };
                    list[ray.vertex as usize] = true;
                }
            }
        }
        rays.clear();
    }

    fn place_all(&mut self) {
        nose::place(self);
        lips::place(self);
        mouth::place(self);
        lids::place(self);
        ear::place_base(self);
        stations::place(self);
    }
}

/// What the deformation needs and no measure changes.
#[derive(Clone, Debug)]
pub struct DeformPlan {
    handles: Handles,
    rings: Arc<HalfRings>,
    fit: FitPlan,
    limit: LimitPlan,
    tissue: TissuePlan,
    base: Vec<Vec3>,
    /// Where the base head's features put the held vertices; elsewhere the base.
    anchors: Vec<Vec3>,
    midline: Vec<bool>,
}

/// Buffers of one deformation; made once.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    rounds: fit::Buffers,
    held: Vec<f32>,
    rays: Vec<Ray>,
    bone: tissue::Fields,
}

impl Scratch {
    /// What the compensation of the last head aimed at.
    pub(in crate::rig) fn aims(&self) -> &[Vec3] {
        &self.rounds.start
    }
}

impl DeformPlan {
    /// Finds the pinned vertices by placing the base head's features once, and the operators of the fit.
    pub fn new(half: &HalfMesh, handles: Handles, base_shape: &Proportions) -> Self {
        let n = half.n_half();
        let rings = Arc::new(HalfRings::new(half));
        let base: Vec<Vec3> = half.base.iter().map(|&p| Vec3::from(p)).collect();
        let mut kinds = PinKinds { pinned: vec![false; n], guides: vec![false; n] };
        let mut at = vec![Vec3::ZERO; n];
        let surface = Implicit::new(base_shape);
        let buffer = &mut Vec::new();
        Pins { shape: base_shape, surface: &surface, handles: &handles, at: &mut at, buffer, record: Some(&mut kinds) }
            .place_all();
        let mut leather = vec![false; n];
        for &v in handles.a.iter().flatten().chain(&handles.ear_end) {
            leather[v as usize] = true;
        }
        let mut anchors = base.clone();
        for v in 0..n {
            if kinds.pinned[v] || kinds.guides[v] {
                anchors[v] = if half.midline[v] { at[v].with_x(0.0) } else { at[v] };
            }
        }
        let fit = FitPlan::new(half, &rings, &handles, &kinds.pinned, &kinds.guides, &leather);
        let limit = LimitPlan::new(half, &rings, &handles);
        let tissue = TissuePlan::new(&handles);
        Self { handles, rings, fit, limit, tissue, base, anchors, midline: half.midline.clone() }
    }

    /// Control positions of the half (`out`: its length) in the proportions' frame and head units, after `rounds` rounds of
    /// the fit ([`ROUNDS`] live).
    pub fn run(
        &self,
        measures: &Measures,
        shape: &Proportions,
        rounds: usize,
        scratch: &mut Scratch,
        out: &mut [Vec3],
    ) {
        let surface = Implicit::new(shape);
        self.features(shape, &surface, &mut scratch.rays, out);
        for &v in self.handles.a.iter().flatten().chain(&self.handles.ear_end) {
            out[v as usize] = self.base[v as usize];
        }
        for (&v, &b) in self.handles.a[0].iter().zip(&self.handles.ear_base) {
            // Leather is made last; until then its first ring rides on the base, so that it does not hold the skin back.
            out[v as usize] += out[b as usize] - self.anchors[b as usize];
        }
        self.fit.start(&self.base, &self.anchors, out, &mut scratch.held);
        self.fit.relax(&surface, out, &mut scratch.rounds, shape.eye_r, rounds);
        self.tissue.carry(measures, shape, &surface, &mut scratch.bone, out);
        self.finish(shape, &surface, scratch, out);
    }

    /// Places the pinned vertices and guides in `at`.
    fn features(&self, shape: &Proportions, surface: &Implicit, buffer: &mut Vec<Ray>, at: &mut [Vec3]) {
        Pins { shape, surface, handles: &self.handles, at, buffer, record: None }.place_all();
        for (p, mid) in at.iter_mut().zip(&self.midline) {
            if *mid {
                p.x = 0.0;
            }
        }
    }

    /// Places the pinned vertices and guides in `at`, for the author of the base.
    pub fn place_features(&self, shape: &Proportions, surface: &Implicit, at: &mut [Vec3]) {
        self.features(shape, surface, &mut Vec::new(), at);
    }

    /// Ear leather and limit compensation over a fitted skin.
    pub fn finish(&self, shape: &Proportions, surface: &Implicit, scratch: &mut Scratch, at: &mut [Vec3]) {
        ear::leather(shape, surface, &self.handles, at);
        let fit::Buffers { start, moved, .. } = &mut scratch.rounds;
        start.resize(at.len(), Vec3::ZERO);
        moved.resize(at.len(), Vec3::ZERO);
        self.limit.compensate(&self.rings, at, start, moved);
        for (p, mid) in at.iter_mut().zip(&self.midline) {
            if *mid {
                p.x = 0.0;
            }
        }
    }

    /// The fit's constant part, for the author of the base.
    pub fn fit(&self) -> &FitPlan {
        &self.fit
    }

    /// Neighbours in the half mesh.
    pub fn rings(&self) -> &HalfRings {
        &self.rings
    }

    /// Where subdivision takes the vertices of the half mesh.
    fn limit(&self) -> &LimitPlan {
        &self.limit
    }

    /// Vertices by patch.
    pub fn handles(&self) -> &Handles {
        &self.handles
    }
}
