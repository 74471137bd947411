//! Lip edges: the upper from the philtrum to the commissure, the lower inside it. They are sharp: what is placed here are
//! the control points of the curve that the edge follows.

use super::{Pins, sin_cos};
use crate::math::ops;
use crate::rig::implicit::Layer;
use glam::{Vec3, vec3};

fn smoothstep(a: f32, b: f32, x: f32) -> f32 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Upper lip edge at `t` = 0 (philtrum) to 1 (commissure), muzzle frame, before it is laid on the surface.
fn upper(pins: &Pins, t: f32) -> Vec3 {
    let s = pins.shape;
    let (w0, w1) = (s.muz_w0 / 2.0, s.muz_w1 / 2.0);
    let (fl, lt) = (s.flew, s.lip_t);
    let hang = |lip: f32| lip - 0.75 * fl + 0.95 * (1.0 - lt);
    let (y1, y0) = (hang(s.lip1() + 0.22), hang(s.lip0() + 0.17));
    const FRONT: f32 = 0.3;
    let slim = s.slim();
    let depth = 0.5 + 1.5 * slim;
    let side = vec3(0.62 * w1 + 0.8 * lt * slim, y1, s.muz_len - 0.3 - depth);
    if t < FRONT {
        let (sin, cos) = sin_cos(core::f32::consts::FRAC_PI_2 * t / FRONT);
        let notch = s.lip1() + 0.22 + 0.63 * slim - 0.1 * fl;
        let y = notch + (y1 - notch) * smoothstep(0.0, 0.8 * FRONT, t);
        let x = if t == 0.0 { 0.0 } else { side.x * ops::powf(sin, 0.9) };
        return vec3(x, y, s.muz_len - 0.3 - depth * (1.0 - cos));
    }
    let u = (t - FRONT) / (1.0 - FRONT);
    let corner = vec3(0.9 * w0 + 0.65 * lt, y0, s.corner_z);
    // Where the lip is short it rises as gently.
    let room = (side.distance(corner) / LONG).min(1.0);
    let raise = (s.muz_w1 / 5.6).min(1.0) * room * (0.65 + 0.28 * fl) * smoothstep(0.55, 1.0, u);
    side + (corner - side) * u + vec3(0.0, raise, 0.0)
}

/// Length of the side of a lip whose corner rises in full, head units.
const LONG: f32 = 5.0;

/// How far the lower lip's margin lies inside the upper's, head units: everywhere, how much more for each unit that the jaw
/// juts out below it, and before the corner. On the skin of level 2, which is not yet smooth there, it is half as far.
const INSIDE: [f32; 3] = [0.2, 0.45, 0.08];
/// How far it stands above it: everywhere, how much less for each unit that the jaw juts out, and before the corner, where
/// both come together.
const ABOVE: [f32; 3] = [0.08, 0.02, -0.06];
/// How far below the upper lip's margin the jaw is asked for, from what depth under its skin on it juts out,
/// and the most that counts, head units.
const JUTS: [f32; 3] = [0.9, -0.3, 1.2];

/// Out of the mouth at vertex `k` of the upper lip's edge (muzzle frame): horizontal, across the line of the lips.
pub(super) fn outwards(edge: &[Vec3; 8], k: usize) -> Vec3 {
    let along = edge[(k + 1).min(7)] - edge[k.saturating_sub(1)];
    if k == 0 { Vec3::Z } else { vec3(-along.z, 0.0, along.x).normalize_or(Vec3::Z) }
}

/// The lower lip's edge beside vertex `k` of the upper's (muzzle frame).
fn lower(pins: &Pins, edge: &[Vec3; 8], k: usize) -> Vec3 {
    let t = k as f32 / 7.0;
    // Skin that goes forwards from a margin high up inside the upper lip would come through it.
    let below = pins.shape.head_from_muzzle(edge[k] - Vec3::Y * JUTS[0]);
    let juts = (-pins.surface.distance(below, Layer::Lower) - JUTS[1]).clamp(0.0, JUTS[2]);
    let juts = juts * (1.0 - smoothstep(0.3, 0.86, t));
    let corner = smoothstep(0.7, 0.86, t);
    let inside = INSIDE[0] + INSIDE[1] * juts + INSIDE[2] * corner;
    let above = ABOVE[0] - ABOVE[1] * juts + (ABOVE[2] - ABOVE[0]) * corner;
    let p = edge[k] - outwards(edge, k) * inside + Vec3::Y * above;
    p.with_x(p.x.max(0.0))
}

pub(super) fn place(pins: &mut Pins) {
    let s = pins.shape;
    let mut edge = [Vec3::ZERO; 8];
    for (k, e) in edge.iter_mut().enumerate() {
        let mut p = pins.surface.project(s.head_from_muzzle(upper(pins, k as f32 / 7.0)), Layer::Upper, 6);
        if k == 0 {
            p.x = 0.0;
        }
        *e = s.muzzle_from_head(p);
        pins.set(pins.handles.s[3 + k][9], p);
    }
    // The lower lip runs beside the upper one, just inside it and a little higher, so that nothing is seen between them.
    for k in 0..7 {
        pins.set(pins.handles.l[3 + k][9], s.head_from_muzzle(lower(pins, &edge, k)));
    }
}
