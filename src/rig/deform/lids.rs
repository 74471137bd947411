//! Lids: margins on the eyeball, a fold around them that runs into the skin, and a pole behind the ball.

use super::{Pins, sin_cos};
use crate::rig::implicit::Layer;
use crate::rig::proportions::Proportions;
use glam::{Vec3, vec3};

/// Axes of the left orbit: lateral, up along the lids, and out of the middle of their slit.
pub fn orbit_axes(s: &Proportions) -> [Vec3; 3] {
    axes(s, s.eye_yaw)
}

/// Axes of the left eyeball at rest. Dogs that look ahead converge a little: a pupil in the middle of the lids looks past
/// the viewer.
pub fn eye_axes(s: &Proportions) -> [Vec3; 3] {
    axes(s, 0.68 * s.eye_yaw)
}

fn axes(s: &Proportions, yaw: f32) -> [Vec3; 3] {
    let (sin, cos) = sin_cos(yaw);
    let gaze = vec3(sin, 0.0, cos);
    let (lateral, up) = (vec3(cos, 0.0, -sin), Vec3::Y);
    let (sc, cc) = sin_cos(s.eye_cant);
    [lateral * cc + up * sc, up * cc - lateral * sc, gaze]
}

pub(super) fn place(pins: &mut Pins) {
    let s = pins.shape;
    let (eye, r) = (s.eye(), s.eye_r);
    let [a, b, g] = orbit_axes(s);
    let on_ball = |x: f32, y: f32, radius: f32| {
        let z = (radius * radius - x * x - y * y).max(0.01);
        eye + (a * x + b * y + g * z.sqrt()) * r
    };
    for k in 0..12 {
        let (sin, cos) = sin_cos(core::f32::consts::TAU * k as f32 / 12.0);
        // The upper lid is the higher arch; the tear duct draws the medial corner down a little.
        let x = -cos * s.eye_w;
        let arch = |full: f32| sin.abs() * (1.0 + full * (1.0 - sin.abs()));
        // Higher towards the nose: an inner half that slopes down reads as anger.
        let plain = if sin > 0.0 { (1.0 + 0.16 * cos) * arch(0.22) } else { -0.78 * arch(0.22) };
        let domed = (1.0 + (0.16 + 0.12 * s.eye_dome) * cos) * arch(0.22 + 0.25 * s.eye_dome);
        let fuller = if sin > 0.0 { (domed - plain) * s.eye_open } else { 0.0 };
        let y = plain * s.eye_open + fuller - if k == 0 { 0.05 } else { 0.0 };
        // A lid that hangs does so most under the middle, and leaves the ball.
        let hang = s.haw / r * if sin < 0.0 { sin * sin * (1.0 - 0.2 * cos) } else { 0.0 };
        // The medial corner stands before the ball, over the rim of the orbit; the third lid lies in it.
        let corner = [1.0, 0.45, 0.1].get(k.min(12 - k)).copied().unwrap_or(0.0);
        let before = g * (r * s.canthus() * corner);
        pins.set(pins.handles.er[k], on_ball(x, y - hang, 1.10 + 0.35 * hang) + before);
        pins.set(pins.handles.ei[k], on_ball(x * 0.965, y * 0.95 - 0.25 * hang, 1.015) + before * 0.8);
        let down = if k == 0 { 0.05 } else { 0.0 };
        // The fold comes forward over more of the lids than their margins do.
        let forward = [1.0, 0.68, 0.2].get(k.min(12 - k)).copied().unwrap_or(0.0);
        let fold = on_ball(
            x * (1.20 + 0.06 * corner),
            (y - fuller) * if sin > 0.0 { 1.32 } else { 1.2 } + 0.4 * fuller - down - 1.05 * hang,
            1.16 + 0.45 * hang,
        ) + g * (r * s.canthus() * forward);
        let skin = pins.surface.project(fold, Layer::Whole, 4);
        pins.set(pins.handles.of[k], fold + (skin - fold) * 0.55);
        // The orbit's loop is free but before the hollow of the stop, and starts around this eye.
        if !(3..11).contains(&k) {
            continue;
        }
        let around = on_ball(x * 1.45, y * 1.75, 1.5);
        let around = pins.surface.project(vec3(around.x.max(0.3 * eye.x), around.y, around.z), Layer::Whole, 4);
        pins.set_guide(pins.handles.orbit[k], around);
    }
    pins.set(pins.handles.ep, eye - g * (0.9 * r));
}
