//! Muscles to be seen: straps of fibres from origin to insertion on a posed head, thicker where they are shorter, since a
//! muscle keeps its volume.

use super::muscles::Spot;
use super::rigid::Rigid;
use super::{OfHead, Places};
use crate::math::ops;
use crate::motion::{Kind, MuscleTable};
use crate::rig::bone::{BoneMesh, LANDMARKS};
use crate::rig::{HalfMesh, Place, RigError};
use glam::{Vec3, vec3};

/// Sections of a strap, and corners of one.
const SECTIONS: usize = 14;
const CORNERS: usize = 10;
/// Vertices of a strap: its sections and its two ends.
pub const STRAP_VERTICES: usize = SECTIONS * CORNERS + 2;
/// How deep under the skin a strap lies that begins or ends there, millimetres.
const DEEP: f32 = 3.0;
/// Thickness of a strap for its width, and of a chewing muscle.
const THICK: [f32; 2] = [0.28, 0.5];
/// How much thicker a contracted muscle is than its length alone makes it.
const HARD: f32 = 0.15;

/// One line of a muscle's fibres on the left side.
#[derive(Clone, Debug)]
struct Line {
    muscle: usize,
    spots: Vec<Vec<Spot>>,
    width_mm: f32,
    kind: Kind,
}

/// The straps of every muscle, immutable.
#[derive(Clone, Debug)]
pub struct Fibres {
    lines: Vec<Line>,
}

impl Fibres {
    pub(super) fn new(table: &MuscleTable, half: &HalfMesh) -> Result<Self, RigError> {
        let skin = half.skin_landmarks();
        let mut lines = Vec::new();
        for (muscle, m) in table.muscles.iter().enumerate() {
            let own: Vec<Vec<Vec<String>>> = if m.drawn.is_empty() {
                let to = |i: &String| m.path.iter().cloned().chain([vec![i.clone()]]).collect();
                m.insertion.iter().map(to).collect()
            } else {
                m.drawn.clone()
            };
            for line in own {
                let spot = |id: &String| Spot::find(id, &skin);
                let spots = line.iter().map(|a| a.iter().map(spot).collect()).collect::<Result<_, _>>()?;
                lines.push(Line { muscle, spots, width_mm: m.width_mm, kind: m.kind });
            }
        }
        Ok(Self { lines })
    }

    /// Number of straps of both sides.
    pub fn n_straps(&self) -> usize {
        2 * self.lines.len()
    }

    /// The muscle of a strap, by its number in the table. The left straps come before the right ones.
    pub fn muscle(&self, strap: usize) -> usize {
        self.lines[strap % self.lines.len()].muscle
    }

    /// How far along its strap a vertex lies, 0 to 1, and whether it is one of every other line of fibres.
    pub fn along(vertex: usize) -> (f32, bool) {
        match vertex.checked_sub(SECTIONS * CORNERS) {
            Some(end) => (end as f32, false),
            None => ((vertex / CORNERS) as f32 / (SECTIONS - 1) as f32, vertex.is_multiple_of(2)),
        }
    }

    /// Triangles of all straps, counter-clockwise from outside.
    pub fn indices(&self) -> Vec<u32> {
        let mut out = Vec::new();
        for strap in 0..self.n_straps() {
            let flips = strap >= self.lines.len();
            let first = (strap * STRAP_VERTICES) as u32;
            let at = |s: usize, c: usize| first + (s * CORNERS + c % CORNERS) as u32;
            let ends = first + (SECTIONS * CORNERS) as u32;
            let mut face = |[a, b, c]: [u32; 3]| out.extend(if flips { [a, c, b] } else { [a, b, c] });
            for c in 0..CORNERS {
                for s in 0..SECTIONS - 1 {
                    face([at(s, c), at(s, c + 1), at(s + 1, c + 1)]);
                    face([at(s, c), at(s + 1, c + 1), at(s + 1, c)]);
                }
                face([ends, at(0, c + 1), at(0, c)]);
                face([ends + 1, at(SECTIONS - 1, c), at(SECTIONS - 1, c + 1)]);
            }
        }
        out
    }

    /// Positions of all straps, [`STRAP_VERTICES`] each, on a posed head: `control`: its control positions, `places`: of
    /// its bones; `contraction`: of a muscle (left, right).
    pub(super) fn place(
        &self,
        half: &HalfMesh,
        mirror: &[u32],
        head: &OfHead,
        (control, places): (&[Vec3], &Places),
        contraction: impl Fn(usize) -> [f32; 2],
        out: &mut Vec<Vec3>,
    ) {
        out.clear();
        let rest = Places::default();
        for side in 0..2 {
            for line in &self.lines {
                let path = |control: &[Vec3], places: &Places| -> Vec<Vec3> {
                    let at = |spot: &Spot| spot_at(*spot, side, half, mirror, head, control, places);
                    line.spots.iter().map(|item| item.iter().map(at).sum::<Vec3>() / item.len() as f32).collect()
                };
                let (now, before) = (path(control, places), path(&head.rest, &rest));
                let length = |p: &[Vec3]| p.windows(2).map(|w| w[0].distance(w[1])).sum::<f32>().max(1e-5);
                let hard = 1.0 + HARD * contraction(line.muscle)[side];
                let thick = ops::sqrt(length(&before) / length(&now)) * hard;
                strap(&now, line, thick * head.unit, &places.head, out);
            }
        }
    }
}

/// A landmark of a posed head, the left one (0) or the right one.
fn spot_at(
    spot: Spot,
    side: usize,
    half: &HalfMesh,
    mirror: &[u32],
    head: &OfHead,
    control: &[Vec3],
    places: &Places,
) -> Vec3 {
    let of_side = |v: usize| if side == 0 { v } else { mirror[v] as usize };
    let sunk = |v: usize| control[of_side(v)] - places.head.direction(head.normals[of_side(v)]) * (DEEP * head.unit);
    match spot {
        Spot::Skin(Place::Vertex(v)) => sunk(v as usize),
        Spot::Skin(Place::Face(f)) => half.faces[f as usize].iter().map(|&v| sunk(usize::from(v))).sum::<Vec3>() / 3.0,
        Spot::Bone(k) => {
            let p = head.bone[k];
            let p = if side == 0 { p } else { vec3(-p.x, p.y, p.z) };
            let on_mandible = LANDMARKS[k].on == Some(BoneMesh::Mandible);
            if on_mandible { places.mandible.point(p) } else { places.head.point(p) }
        }
    }
}

/// A tube of an oval section along a smooth curve through the points (Catmull and Rom 1974).
fn strap(path: &[Vec3], line: &Line, unit: f32, head: &Rigid, out: &mut Vec<Vec3>) {
    let n = path.len() - 1;
    let at = |i: isize| path[i.clamp(0, n as isize) as usize];
    let curve = |f: f32| {
        let x = f * n as f32;
        let k = (x as usize).min(n.saturating_sub(1));
        let t = x - k as f32;
        let k = k as isize;
        let (p, q, r, s) = (at(k - 1), at(k), at(k + 1), at(k + 2));
        0.5 * (2.0 * q
            + (r - p) * t
            + (2.0 * p - 5.0 * q + 4.0 * r - s) * (t * t)
            + (3.0 * (q - r) + s - p) * (t * t * t))
    };
    let is_chewing = line.kind == Kind::Chewing;
    let (width, thick) = (0.5 * line.width_mm * unit, THICK[usize::from(is_chewing)]);
    for s in 0..SECTIONS {
        let f = s as f32 / (SECTIONS - 1) as f32;
        let middle = curve(f);
        let along = (curve((f + 0.02).min(1.0)) - curve((f - 0.02).max(0.0))).normalize_or(Vec3::Z);
        // Out of the head: from a line through its middle.
        let p = head.back(middle);
        let outwards = head.direction(vec3(p.x, p.y - 0.02, 0.0)).normalize_or(Vec3::Y);
        let flat = (outwards - along * outwards.dot(along)).normalize_or(along.any_orthonormal_vector());
        let across = along.cross(flat);
        let belly = ops::sin(core::f32::consts::PI * f).max(0.0);
        let wide = width * if is_chewing { 0.30 + 0.70 * ops::sqrt(belly) } else { 0.45 + 0.55 * belly };
        for c in 0..CORNERS {
            let (sin, cos) = ops::sin_cos(core::f32::consts::TAU * c as f32 / CORNERS as f32);
            out.push(middle + across * (cos * wide) + flat * (sin * wide * thick));
        }
    }
    out.extend([curve(0.0), curve(1.0)]);
}
