//! The eyeball as a mesh of its own: a globe with a bulging cornea, its colours in rings about the optical axis.
//!
//! The borders of pupil and iris are doubled rings of vertices, so that they stay crisp whatever draws them.

use super::parts::{Material, MaterialRange, PartTopology};
use super::uv::Uv;
use crate::math::ops;
use crate::rig::Eye;
use glam::{Vec3, vec2, vec3};

const SEGMENTS: usize = 72;
/// Degrees off the optical axis. An iris that fills the fissure: a dog whose white shows looks frightened.
const PUPIL: f32 = 25.0;
const IRIS: f32 = 60.0;
const RINGS: [f32; 21] = [
    0.0, 8.0, 17.0, PUPIL, PUPIL, 29.0, 33.0, 38.0, 42.5, 46.0, 53.0, IRIS, IRIS, 64.0, 69.0, 75.0, 84.0, 100.0, 120.0,
    145.0, 180.0,
];

/// Number of vertices.
pub(super) const N_VERTICES: usize = RINGS.len() * SEGMENTS;

fn shade(ring: usize, segment: usize, iris: Vec3) -> Vec3 {
    let degrees = RINGS[ring];
    if ring <= 3 {
        return Vec3::splat(0.004);
    }
    if ring > 11 {
        // Sclera, reddish and darker towards the limbus.
        let t = ((degrees - IRIS) / 25.0).clamp(0.0, 1.0);
        return vec3(0.20, 0.14, 0.12).lerp(vec3(0.62, 0.55, 0.50), t);
    }
    // Fibres: a fixed pattern around the axis; paler in the middle, a dark ring at the limbus.
    let t = (degrees - PUPIL) / (IRIS - PUPIL);
    let mut seed = crate::math::fnv::Fnv64::new();
    seed.u32(segment as u32);
    let fibre = (seed.finish() >> 40) as f32 / (1u32 << 24) as f32;
    let limbus = 1.0 - 0.75 * ((t - 0.72) / 0.28).clamp(0.0, 1.0);
    let collar = 0.75 + 0.5 * (1.0 - (t - 0.35).abs() * 2.2).max(0.0);
    iris * ((0.72 + 0.5 * fibre) * limbus * collar)
}

/// Indices; the same for every eye.
pub(super) fn topology(name: &'static str) -> PartTopology {
    let mut indices = Vec::new();
    for (i, w) in RINGS.windows(2).enumerate() {
        if w[0] == w[1] {
            continue;
        }
        for j in 0..SEGMENTS {
            let at = |i: usize, j: usize| (i * SEGMENTS + j % SEGMENTS) as u32;
            let (a, b, c, d) = (at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
            if w[0] > 0.0 {
                indices.extend([a, c, b]);
            }
            if w[1] < 180.0 {
                indices.extend([a, d, c]);
            } else if w[0] > 0.0 {
                continue;
            }
        }
    }
    let ranges = vec![MaterialRange { material: Material::Eye, start: 0, count: indices.len() as u32 }];
    PartTopology { name, n_vertices: N_VERTICES, indices, ranges }
}

/// Texture coordinates, the same for both eyes: the eye as seen along its axis, the angle to it as the distance from the
/// middle, and the pole behind as the rim. They have no seam.
pub(super) fn uv(topology: &PartTopology) -> Uv {
    let place = |v: usize| {
        let (ring, segment) = (v / SEGMENTS, v % SEGMENTS);
        let (sin, cos) = ops::sin_cos(core::f32::consts::TAU * segment as f32 / SEGMENTS as f32);
        let radius = 0.49 * RINGS[ring] / 180.0;
        vec2(0.5 + radius * cos, 0.5 - radius * sin)
    };
    Uv {
        vertices: (0..N_VERTICES as u32).map(|v| [v, v]).collect(),
        coordinates: (0..N_VERTICES).map(place).collect(),
        indices: topology.indices.clone(),
        ranges: topology.ranges.clone(),
    }
}

/// Colours (`out`: [`N_VERTICES`]).
pub(super) fn colours(iris: Vec3, out: &mut [Vec3]) {
    for (v, to) in out.iter_mut().enumerate() {
        *to = shade(v / SEGMENTS, v % SEGMENTS, iris);
    }
}

/// Radius and normal's tilt of the profile: the cornea stands out by a fourteenth of the globe.
fn profile(degrees: f32) -> f32 {
    let t = (1.0 - degrees / IRIS).clamp(0.0, 1.0);
    1.0 + 0.055 * t * t * (3.0 - 2.0 * t)
}

/// Positions and normals (`positions`, `normals`: [`N_VERTICES`]).
pub(super) fn place(eye: &Eye, positions: &mut [Vec3], normals: &mut [Vec3]) {
    let [a, b, g] = eye.axes;
    let sides: [Vec3; SEGMENTS] = std::array::from_fn(|j| {
        let turn = core::f32::consts::TAU * j as f32 / SEGMENTS as f32;
        a * ops::cos(turn) + b * ops::sin(turn)
    });
    for (i, &degrees) in RINGS.iter().enumerate() {
        let angle = degrees.to_radians();
        let (sin, cos) = (ops::sin(angle), ops::cos(angle));
        // Slope of the radius over the angle, for the normal of a surface of revolution.
        let h = 0.5;
        let slope = (profile(degrees + h) - profile((degrees - h).max(0.0))) / (2.0 * h).to_radians();
        let r = profile(degrees);
        for (j, &side) in sides.iter().enumerate() {
            let out = side * sin + g * cos;
            let along = side * cos - g * sin;
            positions[i * SEGMENTS + j] = eye.centre + out * (eye.radius * r);
            let n = if degrees == 0.0 { out } else { out * r - along * slope };
            normals[i * SEGMENTS + j] = n.normalize_or(out);
        }
    }
}
