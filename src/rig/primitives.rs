//! Simple bodies as signed distances, eight points at a time, and how they are blended.
//!
//! Smooth minimum: cubic polynomial (I. Quilez, "Smooth minimum", 2013). Ellipsoid distance: first order bound by the
//! two lengths of the scaled point, the same author's "Distance functions". The round cone is a segment with a radius
//! that changes linearly, without the exact tangent correction: smoother to differentiate and close enough here.

use super::lanes::{F8, P8};
use crate::math::ops;
use glam::Vec3;

/// Distance to an ellipsoid, to first order; it may be turned about the x axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ellipsoid {
    centre: Vec3,
    inverse: Vec3,
    turn: Option<(f32, f32)>,
}

impl Ellipsoid {
    pub(super) fn new(centre: Vec3, radii: Vec3) -> Self {
        Self { centre, inverse: radii.max(Vec3::splat(0.05)).recip(), turn: None }
    }
    /// A centre, a slope and a length: the distance is nowhere less than the slope times that from the centre, less the
    /// length.
    ///
    /// The distance is |q|²/|r| - |q|/|r| with q = p/radii, r = q/radii. Its first part is at least 2ρ/(1 + ρ²) of |p|,
    /// where ρ is the ratio of the largest to the smallest radius (by Kantorovich's inequality, 1948), its second
    /// at most the largest radius.
    pub(super) fn bound(&self) -> (Vec3, f32, f32) {
        let (small, large) = (self.inverse.max_element().recip(), self.inverse.min_element().recip());
        (self.centre, 2.0 * small * large / (small * small + large * large), large)
    }
    pub(super) fn turned(centre: Vec3, radii: Vec3, degrees: f32) -> Self {
        let a = degrees.to_radians();
        Self { turn: Some((ops::cos(a), ops::sin(a))), ..Self::new(centre, radii) }
    }
    #[inline(always)]
    pub(super) fn eval(&self, p: P8) -> F8 {
        let mut q = p.minus(self.centre);
        if let Some((c, s)) = self.turn {
            q = q.rotate_x(c, s);
        }
        let i = self.inverse;
        let a = P8 { x: q.x * i.x, y: q.y * i.y, z: q.z * i.z };
        let b = P8 { x: a.x * i.x, y: a.y * i.y, z: a.z * i.z };
        let k0 = a.length_squared().sqrt();
        let k1 = b.length_squared().sqrt().max(F8::splat(1e-6));
        k0.div(k1) * (k0 - 1.0)
    }
}

/// A segment with a radius that changes linearly.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    a: Vec3,
    axis: Vec3,
    inverse_length_squared: f32,
    ra: f32,
    dr: f32,
}

impl Cone {
    /// Centre and radius of a ball about it; the distance from the cone is that from the ball at least.
    pub(super) fn bound(&self) -> (Vec3, f32) {
        (self.a + 0.5 * self.axis, 0.5 * self.axis.length() + self.ra.max(self.ra + self.dr))
    }
    pub(super) fn new(a: Vec3, b: Vec3, ra: f32, rb: f32) -> Self {
        let axis = b - a;
        Self { a, axis, inverse_length_squared: 1.0 / axis.length_squared().max(1e-6), ra, dr: rb - ra }
    }
    #[inline(always)]
    pub(super) fn eval(&self, p: P8) -> F8 {
        let q = p.minus(self.a);
        let t = (q.dot(self.axis) * self.inverse_length_squared).clamp(0.0, 1.0);
        let d = P8 { x: q.x - t * self.axis.x, y: q.y - t * self.axis.y, z: q.z - t * self.axis.z };
        d.length_squared().sqrt() - (t * self.dr + self.ra)
    }
}

/// A box along z whose half width, top and bottom change linearly, narrower at the top, rounded.
#[derive(Clone, Copy, Debug)]
pub(super) struct TaperedBox {
    pub(super) z: (f32, f32),
    pub(super) half_width: (f32, f32),
    pub(super) top: (f32, f32),
    pub(super) bottom: (f32, f32),
    pub(super) arch: f32,
    pub(super) top_width: f32,
    /// How far the sides bulge at half height, and how far they draw in below; parts of the width.
    pub(super) sides: (f32, f32),
    pub(super) rounding: f32,
}

impl TaperedBox {
    #[inline(always)]
    pub(super) fn eval(&self, p: P8) -> F8 {
        let (z0, z1) = self.z;
        let t = ((p.z - z0) * (1.0 / (z1 - z0))).clamp(0.0, 1.0);
        let lerp = |(a, b): (f32, f32)| t * (b - a) + a;
        // The arch of a Roman nose: a parabola over the front two thirds.
        let u = ((t - 0.3) * (1.0 / 0.7)).clamp(0.0, 1.0);
        let top = lerp(self.top) + u * (F8::splat(1.0) - u) * (4.0 * self.arch);
        let bottom = lerp(self.bottom);
        let (mid, half) = ((top + bottom) * 0.5, ((top - bottom) * 0.5).max(F8::splat(0.1)));
        let v = (p.y - bottom).div(half * 2.0).clamp(0.0, 1.0);
        let below = F8::splat(1.0) - v;
        let (bulge, draw) = self.sides;
        let side = v * (self.top_width - 1.0) + 1.0 + v * below * (4.0 * bulge) - below * draw;
        let width = lerp(self.half_width) * side;
        let r = width.min(half) * self.rounding;
        let qx = p.x - (width - r);
        let qy = (p.y - mid).abs() - (half - r);
        let qz = (p.z - (z0 + z1) * 0.5).abs() - (r * -1.0 + (z1 - z0) * 0.5);
        let zero = F8::splat(0.0);
        let out = P8 { x: qx.max(zero), y: qy.max(zero), z: qz.max(zero) };
        out.length_squared().sqrt() + qx.max(qy).max(qz).min(zero) - r
    }
}

/// The smaller of two distances, rounded where they differ by less than `k`.
#[inline(always)]
pub(super) fn smin(a: F8, b: F8, k: f32) -> F8 {
    let h = (F8::splat(k) - (a - b).abs()).max(F8::splat(0.0)) * (1.0 / k);
    a.min(b) - h * h * h * (k / 6.0)
}

/// The larger of two distances, rounded likewise.
#[inline(always)]
pub(super) fn smax(a: F8, b: F8, k: f32) -> F8 {
    -smin(-a, -b, k)
}
