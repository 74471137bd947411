//! The eyeball as a mesh of its own: a globe with a bulging cornea, its colours in rings about the optical axis.
//!
//! The borders of pupil and iris are doubled rings of vertices, so that they stay crisp whatever draws them.

use super::parts::{Material, MaterialRange, PartTopology};
use super::uv::Uv;
use crate::math::ops;
use crate::rig::Eye;
use glam::{Vec2, Vec3, vec2, vec3};

/// An eyeball behind its lids, for who draws more of it than its mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Eyeball {
    /// Its place and size.
    pub eye: Eye,
    /// Colour of the iris, linear.
    pub iris: Vec3,
    /// How much wider the pupil is than at rest, as a part of the iris' width.
    pub widened: f32,
    /// The inner margins of the lids, one after the other around the opening: directions from the centre in the eye's own
    /// axes (x, y, z), projected to (x, y) / (1 + z).
    pub lids: [Vec2; 12],
}

impl Eyeball {
    /// Where the pupil ends at rest, as a part of the way from the axis of gaze to the limbus.
    pub const PUPIL: f32 = PUPIL / IRIS;

    /// What a place of the eyeball's texture (0 to 1, from the top left) shows: the unit direction from the centre in the eye's
    /// own axes, and its angle off the gaze as a part of the limbus'.
    pub fn on_texture(&self, place: Vec2) -> (Vec3, f32) {
        let off = vec2(place.x - 0.5, 0.5 - place.y);
        let degrees = (off.length() / TEXTURE_RADIUS * 180.0).min(180.0);
        let [cos_turn, sin_turn] = (off.normalize_or(Vec2::X)).to_array();
        let limbus = Eye::limbus_at(self.eye.limbus(), sin_turn);
        let angle = angle(degrees, limbus);
        let (sin, cos) = ops::sin_cos(angle);
        (vec3(sin * cos_turn, sin * sin_turn, cos), angle / limbus)
    }

    /// `widened`: see [`widened`]; `margins`: of the lids, metres.
    pub(super) fn new(eye: Eye, iris: Vec3, widened: f32, margins: [Vec3; 12]) -> Self {
        let lids = margins.map(|p| {
            let direction = (p - eye.centre).normalize_or(eye.axes[2]);
            let [a, b, g] = eye.axes.map(|axis| axis.dot(direction));
            vec2(a, b) / (1.0 + g).max(0.1)
        });
        Self { eye, iris, widened, lids }
    }
}

const SEGMENTS: usize = 72;
/// Degrees off the optical axis on an eye whose limbus is at `IRIS`; on others they are stretched to their own limbus.
const PUPIL: f32 = 25.0;
const IRIS: f32 = 60.0;
const RINGS: [f32; 21] = [
    0.0, 8.0, 17.0, PUPIL, PUPIL, 29.0, 33.0, 38.0, 42.5, 46.0, 53.0, IRIS, IRIS, 64.0, 69.0, 75.0, 84.0, 100.0, 120.0,
    145.0, 180.0,
];

/// Width of the iris that the channel of the pupils is told for, millimetres.
const IRIS_MM: f32 = 17.0;

/// How much wider a pupil is than at rest, as a part of the iris' width; `millimetres`: of [`crate::motion::Channel::Pupil`].
pub(super) fn widened(millimetres: f32) -> f32 {
    millimetres / IRIS_MM
}

/// Where the tissue of a ring lies whose pupil is so much wider: pressed together or drawn out, and nothing beyond the limbus.
fn with_pupil(degrees: f32, widened: f32) -> f32 {
    let pupil = PUPIL + IRIS * widened;
    match degrees {
        inside if inside <= PUPIL => inside * (pupil / PUPIL),
        iris if iris < IRIS => IRIS - (IRIS - iris) * ((IRIS - pupil) / (IRIS - PUPIL)),
        beyond => beyond,
    }
}

/// How far the pole behind lies from the middle of the texture.
const TEXTURE_RADIUS: f32 = 0.49;

/// The angle off the gaze of what lies so many degrees off it on the eye whose limbus is at [`IRIS`], radians.
fn angle(degrees: f32, limbus: f32) -> f32 {
    let beyond = (degrees - IRIS) / (180.0 - IRIS);
    if beyond <= 0.0 { degrees / IRIS * limbus } else { limbus + beyond * (core::f32::consts::PI - limbus) }
}

/// Number of vertices.
pub(super) const N_VERTICES: usize = RINGS.len() * SEGMENTS;

fn shade(ring: usize, segment: usize, iris: Vec3) -> Vec3 {
    let degrees = RINGS[ring];
    if ring <= 3 {
        return Vec3::splat(0.004);
    }
    if ring > 11 {
        // Sclera, brown towards the limbus.
        let t = ((degrees - IRIS) / 20.0).clamp(0.0, 1.0);
        return vec3(0.15, 0.095, 0.075).lerp(vec3(0.63, 0.56, 0.51), t);
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
    let mut ranges: Vec<MaterialRange> = Vec::new();
    for (i, w) in RINGS.windows(2).enumerate() {
        if w[0] == w[1] {
            continue;
        }
        let material = match w[0] {
            ring if ring < PUPIL => Material::Pupil,
            ring if ring < IRIS => Material::Iris,
            _ => Material::Sclera,
        };
        let start = indices.len() as u32;
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
        let count = indices.len() as u32 - start;
        match ranges.last_mut().filter(|range| range.material == material) {
            Some(range) => range.count += count,
            None => ranges.push(MaterialRange { material, start, count }),
        }
    }
    PartTopology { name, n_vertices: N_VERTICES, indices, ranges }
}

/// Texture coordinates, the same for both eyes: the eye as seen along its axis, the angle to it as the distance from the
/// middle, and the pole behind as the rim. They have no seam.
pub(super) fn uv(topology: &PartTopology) -> Uv {
    let place = |v: usize| {
        let (ring, segment) = (v / SEGMENTS, v % SEGMENTS);
        let (sin, cos) = ops::sin_cos(core::f32::consts::TAU * segment as f32 / SEGMENTS as f32);
        let radius = TEXTURE_RADIUS * RINGS[ring] / 180.0;
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

/// Positions and normals (`positions`, `normals`: [`N_VERTICES`]); `widened`: the pupil, see [`widened`].
pub(super) fn place(eye: &Eye, widened: f32, positions: &mut [Vec3], normals: &mut [Vec3]) {
    let [a, b, g] = eye.axes;
    let limbus = eye.limbus();
    let half_turn = core::f32::consts::PI;
    for j in 0..SEGMENTS {
        let turn = 2.0 * half_turn * j as f32 / SEGMENTS as f32;
        let (sin_turn, cos_turn) = (ops::sin(turn), ops::cos(turn));
        let side = a * cos_turn + b * sin_turn;
        let limbus = Eye::limbus_at(limbus, sin_turn);
        for (i, &degrees) in RINGS.iter().enumerate() {
            let degrees = with_pupil(degrees, widened);
            let t = degrees / IRIS;
            let angle = angle(degrees, limbus);
            let (sin, cos) = (ops::sin(angle), ops::cos(angle));
            let [r, slope] = Eye::profile(t, limbus);
            let out = side * sin + g * cos;
            let along = side * cos - g * sin;
            positions[i * SEGMENTS + j] = eye.centre + out * (eye.radius * r);
            let n = if degrees == 0.0 { out } else { out * r - along * slope };
            normals[i * SEGMENTS + j] = n.normalize_or(out);
        }
    }
}
