//! Wrinkles of skin that muscles press together: ridges at right angles to their fibres, as high as the skin is pressed.
//!
//! They are bound to the base head, so that they stay where they are on the skin, and are geometry of the refined surface:
//! what is drawn, exported and hashed has them.

use super::values::Values;
use crate::math::{noise, ops};
use glam::{Mat3, Vec3, vec3};

/// Direction of the left fibres on the base head, from one ridge to the next metres, and how high a ridge is over its
/// valley where skin is pressed by a tenth, metres: nose, brow, cheek.
const FOLDS: [(Vec3, f32, f32); 3] = [
    (vec3(-0.25, 0.35, -0.90), 0.0085, 0.0012),
    (vec3(-0.30, 0.75, -0.59), 0.0080, 0.0026),
    (vec3(0.15, 0.10, -0.98), 0.0105, 0.0010),
];
/// Highest ridge for the way between two.
const STEEPEST: f32 = 0.22;
/// Pressed less than this it stays smooth.
const LEAST: f32 = 0.015;
/// Mean height of the profile.
const MEAN: f32 = 0.625;
/// How far ridges swing about their line, as a part of the way between two, and over what way, metres.
const SWINGS: (f32, f32) = (0.6, 0.02);

/// Puts ridges on a skin; `pressed`: at each of its vertices, `head`: how the head is turned, `size`: of the head for the
/// base head's.
pub(super) fn wrinkle(skin: &mut Values, pressed: &[Vec3], head: &Mat3, size: f32) {
    for (v, pressed) in pressed.iter().enumerate() {
        if pressed.max_element() < LEAST {
            continue;
        }
        let rest = skin.rest[v];
        let is_left = if rest.x < 0.0 { -1.0 } else { 1.0 };
        let (mut height, mut slope) = (0.0, Vec3::ZERO);
        for ((way, length, high), pressed) in FOLDS.into_iter().zip(pressed.to_array()) {
            if pressed < LEAST {
                continue;
            }
            // Ridges of both sides meet in the median plane.
            let swing = noise::smooth(rest.with_x(rest.x.abs()) / SWINGS.1, 1).x * SWINGS.0;
            let phase = core::f32::consts::TAU * (way.dot(rest.with_x(rest.x.abs())) / length + swing);
            let most = (high * 10.0 * (pressed - LEAST)).min(STEEPEST * length);
            let (sin, cos) = ops::sin_cos(phase);
            // Broad ridges, narrow valleys; what is pressed out of these is in those.
            let g = 0.5 + 0.5 * sin;
            height += most * (1.0 - (1.0 - g) * (1.0 - g) - MEAN);
            let steep = (1.0 - g) * cos;
            let way = vec3(way.x * is_left, way.y, way.z);
            slope += way * (most * steep * core::f32::consts::TAU / length);
        }
        let n = skin.normals[v];
        let slope = *head * slope;
        skin.positions[v] += n * (height * size);
        skin.normals[v] = (n - (slope - n * slope.dot(n))).normalize_or(n);
    }
}
