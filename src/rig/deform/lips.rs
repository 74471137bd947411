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
    let raise = (s.muz_w1 / 5.6).min(1.0) * (0.65 + 0.28 * fl) * smoothstep(0.55, 1.0, u);
    side + (corner - side) * u + vec3(0.0, raise, 0.0)
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
    // Undershot jaws carry the lower lip in front of the upper.
    let undershot = smoothstep(-0.6, 0.1, s.jaw_len);
    for (k, u) in edge.iter().enumerate().take(7) {
        let t = k as f32 / 7.0;
        let narrow = 0.82 + (0.92 - 0.82) * t;
        // The sharp edge is lower than the fold of the lining above it, which it would cut; towards the soft corner less.
        let drop = 0.35 * (1.0 - smoothstep(0.55, 0.86, t));
        let mut p = vec3(
            (u.x * narrow - 0.1).max(0.0),
            // Inside the upper lip everywhere, so that nothing is seen between them.
            u.y - drop + (0.30 + 0.1 * s.flew.max(0.0)) * (1.0 - t) + 0.34 * t * (1.0 - t),
            u.z - (0.2 + 0.25 * s.slim()) * (1.0 - t),
        );
        if k == 0 {
            p.x = 0.0;
            p.y -= 0.30 * undershot;
            p.z += (s.jaw_z() - 0.05 - p.z) * undershot;
        }
        pins.set(pins.handles.l[3 + k][9], s.head_from_muzzle(p));
    }
}
