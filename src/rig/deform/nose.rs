//! The nose pad: outline, inset, midline, and the comma of the nostril with its slit to the side.

use super::{Pins, sin_cos};
use crate::math::ops;
use glam::{Vec2, Vec3, vec2, vec3};

/// Front of the pad over a point of its outline's unit square: a superellipsoid that leans back at the top.
fn pad(u: Vec2) -> f32 {
    let e = 1.0 - ops::powf(u.x.abs(), 2.4) - ops::powf(u.y.abs(), 2.4);
    ops::powf(e.max(0.0), 1.0 / 2.4) - 0.28 * u.y
}

/// Rim of the nostril in the pad's unit square, clockwise from up: a round opening below the wing, and at 3 to 5 the
/// slit that runs to the side and down.
const RIM: [(f32, f32); 10] = [
    (0.40, 0.29),
    (0.54, 0.27),
    (0.66, 0.15),
    (0.75, -0.05),
    (0.84, -0.27),
    (0.63, -0.29),
    (0.44, -0.31),
    (0.27, -0.20),
    (0.21, 0.00),
    (0.27, 0.19),
];

/// How far the rim stands out: the wing roofs the slit.
const WING: [f32; 10] = [0.03, 0.07, 0.11, 0.12, 0.02, -0.05, -0.03, 0.0, 0.0, 0.0];

pub(super) fn place(pins: &mut Pins) {
    let s = pins.shape;
    let (nw, nh) = (s.nose_w / 2.0, s.nose_h / 2.0);
    let depth = 0.78 * nh.min(nw * 0.85);
    let centre = s.nose_centre();
    let at = |u: Vec2, z: f32| s.head_from_muzzle(centre + vec3(u.x * nw, u.y * nh, z * depth));
    let outline = |j: usize| {
        let (sin, cos) = sin_cos(core::f32::consts::PI * j as f32 / 9.0);
        let below = 1.0 - 0.42 * ops::powf((-cos).max(0.0), 1.5);
        vec2(if j == 0 || j == 9 { 0.0 } else { ops::powf(sin, 0.85) * below }, cos)
    };
    for j in 0..10 {
        let u = outline(j);
        let lean = -0.27 * (1.0 + u.y) - 0.05;
        pins.set(pins.handles.s[0][j], at(u * 1.04, lean));
        pins.set(pins.handles.n[j], at(u * 0.93, pad(u * 0.93)));
    }
    // The philtrum's groove starts between the nostrils.
    for (v, y) in pins.handles.nm.into_iter().zip([-0.40, 0.22]) {
        pins.set(v, at(vec2(0.0, y), pad(vec2(0.0, y)) - 0.10));
    }
    let middle = vec2(0.50, -0.06);
    for q in 0..10 {
        let u = Vec2::from(RIM[q]);
        pins.set(pins.handles.nr[q], at(u, pad(u * 0.97) + WING[q]));
        // The slit's end is shallow, the round part goes deep.
        let (narrow, deep) = if (3..=5).contains(&q) { (0.42, 0.42) } else { (0.66, 0.5) };
        let inner = middle + (u - middle) * narrow;
        pins.set(pins.handles.ni[q], at(inner, pad(inner * 0.97) - deep));
    }
    let end: Vec3 = at(middle, pad(middle) - 1.0);
    pins.set(pins.handles.np, end);
}
