//! The end of the neck: a flat dome over the open boundary that goes on from the skin without an edge, in its coat.

use super::parts::{Material, MaterialRange, PartTopology};
use super::values::Values;
use crate::math::ops;
use crate::subdiv::Plan;
use core::f32::consts::FRAC_PI_2;
use glam::Vec3;

/// Rings between the boundary and the middle, with the boundary.
const RINGS: usize = 6;
/// How high it is, as a part of its mean radius.
const HEIGHT: f32 = 0.22;
/// How bright its middle is: less light reaches it under the hair.
const SHADED: f32 = 0.6;

/// Sine and cosine of a ring's way up the dome.
fn way(ring: usize) -> (f32, f32) {
    let angle = FRAC_PI_2 * ring as f32 / RINGS as f32;
    (ops::sin(angle), ops::cos(angle))
}

/// Rings of each boundary loop one after the other from the loop inwards, and then its middle.
pub(super) fn topology(plan: &Plan) -> PartTopology {
    let (mut indices, mut first) = (Vec::new(), 0);
    for l in plan.boundary_loops() {
        let n = l.len() as u32;
        for i in 0..n {
            let next = (i + 1) % n;
            for outer in (0..RINGS as u32 - 1).map(|ring| first + ring * n) {
                let inner = outer + n;
                indices.extend([outer + i, inner + i, outer + next, outer + next, inner + i, inner + next]);
            }
            let last = first + (RINGS as u32 - 1) * n;
            indices.extend([last + i, first + RINGS as u32 * n, last + next]);
        }
        first += RINGS as u32 * n + 1;
    }
    let ranges = vec![MaterialRange { material: Material::Cap, start: 0, count: indices.len() as u32 }];
    PartTopology { name: "neck_cap", n_vertices: first as usize, indices, ranges }
}

/// Puts it on the skin's boundary; `skin`: its positions, normals, flow and rest positions.
pub(super) fn place(plan: &Plan, skin: &Values, cap: &mut Values) {
    let mut first = 0;
    for l in plan.boundary_loops() {
        let n = l.len();
        let rim = || l.iter().map(|&v| v as usize);
        let mean = |of: &[Vec3]| rim().fold(Vec3::ZERO, |sum, v| sum + of[v]) / n as f32;
        let (middle, rest_middle) = (mean(&skin.positions), mean(&skin.rest));
        let at = |i: usize| skin.positions[l[i % n] as usize] - middle;
        let outwards = (0..n).fold(Vec3::ZERO, |sum, i| sum + at(i + 1).cross(at(i))).normalize_or_zero();
        let height = HEIGHT * (0..n).map(|i| at(i).length()).sum::<f32>() / n as f32;
        for ring in 0..RINGS {
            let (sin, cos) = way(ring);
            for (i, v) in rim().enumerate() {
                let (to, from) = (first + ring * n + i, at(i));
                cap.positions[to] = middle + from * cos + outwards * (height * sin);
                let bulged = from / from.length_squared().max(1e-12) * cos + outwards * (sin / height.max(1e-6));
                // Its edge has the skin's own normal.
                let bulged = bulged.normalize_or(outwards);
                cap.normals[to] = (skin.normals[v] * cos + bulged * sin).normalize_or(outwards);
                cap.flow[to] = outwards * cos - from.normalize_or_zero() * sin;
                cap.rest[to] = rest_middle + (skin.rest[v] - rest_middle) * cos;
            }
        }
        let to = first + RINGS * n;
        (cap.positions[to], cap.normals[to]) = (middle + outwards * height, outwards);
        (cap.flow[to], cap.rest[to]) = (Vec3::ZERO, rest_middle);
        first = to + 1;
    }
}

/// Colours it as the skin at its boundary; `skin`: its colours and surface.
pub(super) fn paint(plan: &Plan, skin: &Values, cap: &mut Values) {
    let mut first = 0;
    for l in plan.boundary_loops() {
        let n = l.len();
        let mean = |of: &[Vec3]| l.iter().fold(Vec3::ZERO, |sum, &v| sum + of[v as usize]) / n as f32;
        let (colour, surface) = (mean(&skin.colours) * SHADED, mean(&skin.surface));
        for ring in 0..RINGS {
            let (sin, _) = way(ring);
            for (i, &v) in l.iter().enumerate() {
                let to = first + ring * n + i;
                cap.colours[to] = skin.colours[v as usize].lerp(colour, sin);
                cap.surface[to] = skin.surface[v as usize].lerp(surface, sin);
            }
        }
        let to = first + RINGS * n;
        (cap.colours[to], cap.surface[to]) = (colour, surface);
        first = to + 1;
    }
}
