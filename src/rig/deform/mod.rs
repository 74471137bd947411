//! The function from proportions to the half mesh's control positions, in its written order: features, start, fit, ear,
//! limit.

mod ear;
mod fit;
mod lids;
mod limit;
mod lips;
mod mouth;
mod nose;
mod stations;

use super::control::{HalfMesh, HalfRings};
use super::handles::Handles;
use super::implicit::{Implicit, Layer};
use super::proportions::Proportions;
use crate::math::ops;
use glam::Vec3;

pub use fit::{FitPlan, layers};
pub use lids::eye_axes;
use limit::LimitPlan;

/// Rounds of the live fit.
pub const ROUNDS: usize = 8;

pub(crate) fn sin_cos(angle: f32) -> (f32, f32) {
    (ops::sin(angle), ops::cos(angle))
}

/// Positions that features fix, while they are being placed.
pub struct Pins<'a> {
    shape: &'a Proportions,
    surface: &'a Implicit,
    handles: &'a Handles,
    at: &'a mut [Vec3],
    record: Option<&'a mut PinKinds>,
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

    fn guide(&mut self, v: u16, from: Vec3, towards: Vec3, layer: Layer) {
        self.at[v as usize] = self.hit(from, towards, layer);
        if let Some(kinds) = &mut self.record {
            kinds.guides[v as usize] = true;
        }
    }

    fn trace(&mut self, v: u16, from: Vec3, towards: Vec3, layer: Layer) {
        let p = self.hit(from, towards, layer);
        self.set(v, p);
    }

    /// Where a ray from outside meets the surface: a fixed number of safeguarded Newton steps along it.
    fn hit(&self, from: Vec3, towards: Vec3, layer: Layer) -> Vec3 {
        let mut p = from;
        for _ in 0..12 {
            let (f, g) = self.surface.sample(p, layer);
            p += towards * (f / (-g.dot(towards)).max(0.6)).clamp(-3.0, 6.0);
        }
        p
    }

    fn place_all(&mut self) {
        nose::place(self);
        lips::place(self);
        mouth::place(self);
        lids::place(self);
        stations::place(self);
        ear::place_base(self);
    }
}

/// What the deformation needs and no measure changes.
#[derive(Clone, Debug)]
pub struct DeformPlan {
    handles: Handles,
    rings: HalfRings,
    fit: FitPlan,
    limit: LimitPlan,
    base: Vec<Vec3>,
    midline: Vec<bool>,
}

/// Buffers of one deformation; made once.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    start: Vec<Vec3>,
    moved: Vec<Vec3>,
    held: Vec<f32>,
}

impl DeformPlan {
    /// Finds the pinned vertices by placing the base head's features once, and the operators of the fit.
    pub fn new(half: &HalfMesh, handles: Handles, base_shape: &Proportions) -> Self {
        let n = half.n_half();
        let rings = HalfRings::new(half);
        let base: Vec<Vec3> = half.base.iter().map(|&p| Vec3::from(p)).collect();
        let mut kinds = PinKinds { pinned: vec![false; n], guides: vec![false; n] };
        let mut at = vec![Vec3::ZERO; n];
        let surface = Implicit::new(base_shape);
        Pins { shape: base_shape, surface: &surface, handles: &handles, at: &mut at, record: Some(&mut kinds) }
            .place_all();
        let mut leather = vec![false; n];
        for &v in handles.a.iter().flatten().chain(&handles.a5) {
            leather[v as usize] = true;
        }
        let fit = FitPlan::new(half, &rings, &handles, &kinds.pinned, &kinds.guides, &leather);
        let limit = LimitPlan::new(half, &rings, &handles);
        Self { handles, rings, fit, limit, base, midline: half.midline.clone() }
    }

    /// Control positions of the half (`out`: its length) in the proportions' frame and head units, after `rounds` rounds of
    /// the fit ([`ROUNDS`] live).
    pub fn run(&self, shape: &Proportions, rounds: usize, scratch: &mut Scratch, out: &mut [Vec3]) {
        let surface = Implicit::new(shape);
        self.features(shape, &surface, out);
        for &v in self.handles.a.iter().flatten().chain(&self.handles.a5) {
            out[v as usize] = self.base[v as usize];
        }
        for (&v, &b) in self.handles.a[0].iter().zip(&self.handles.ear_base) {
            // Leather is made last; until then its first ring rides on the base, so that it does not hold the skin back.
            out[v as usize] += out[b as usize] - self.base[b as usize];
        }
        self.fit.start(&self.base, out, &mut scratch.held);
        scratch.start.clear();
        scratch.start.extend_from_slice(out);
        scratch.moved.resize(out.len(), Vec3::ZERO);
        self.fit.relax(&surface, &self.rings, &scratch.start, out, &mut scratch.moved, shape.eye_r, rounds);
        self.finish(shape, &surface, scratch, out);
    }

    /// Places the pinned vertices and guides in `at`.
    pub fn features(&self, shape: &Proportions, surface: &Implicit, at: &mut [Vec3]) {
        Pins { shape, surface, handles: &self.handles, at, record: None }.place_all();
        for (p, mid) in at.iter_mut().zip(&self.midline) {
            if *mid {
                p.x = 0.0;
            }
        }
    }

    /// Ear leather and limit compensation over a fitted skin.
    pub fn finish(&self, shape: &Proportions, surface: &Implicit, scratch: &mut Scratch, at: &mut [Vec3]) {
        ear::leather(shape, surface, &self.handles, at);
        scratch.start.resize(at.len(), Vec3::ZERO);
        scratch.moved.resize(at.len(), Vec3::ZERO);
        self.limit.compensate(&self.rings, at, &mut scratch.start, &mut scratch.moved);
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

    /// Vertices by patch.
    pub fn handles(&self) -> &Handles {
        &self.handles
    }
}
