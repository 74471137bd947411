//! What lies between lids and globe: the third eyelid in the medial corner, and the line of tears along the lower lid.
//!
//! Both are closed bodies of the left eye; those of the right one are their mirror images.

use super::deform::orbit_axes;
use super::{Eye, Proportions};
use crate::math::ops;
use crate::mesh::{DedgeMesh, MeshError};
use glam::Vec3;

/// Rows of the third eyelid from below upwards, and columns from its root to its free edge.
const ROWS: usize = 15;
const COLUMNS: usize = 8;
/// Vertices of the third eyelid.
pub const THIRD_EYELID: usize = 2 * ROWS * COLUMNS;

/// Sections of the line of tears, and corners of one.
const SECTIONS: usize = 41;
const CORNERS: usize = 6;
/// Vertices of the line of tears.
pub const TEAR_LINE: usize = SECTIONS * CORNERS + 2;

/// What is seen of the third eyelid, radians of the globe from the medial corner: 1.6 mm on a globe of 20.5 mm.
const SEEN: f32 = 0.16;
/// How much farther it comes out of the corner as the lids close, radians of the globe: a crescent of 1 to 4 mm is seen in all, and
/// it follows the lids in a blink (the muscles that draw the globe back push it out).
const SWEPT: f32 = 0.234;
/// Of it hidden behind the corner, and how far it goes under the lids upwards and downwards.
const HIDDEN: f32 = 0.35;
const HALF_HEIGHT: f32 = 1.0;
/// Above the globe, as parts of its radius: its inner side, its outer side at the root and at the free edge.
const SHEETS: [f32; 3] = [0.008, 0.020, 0.032];

fn on_sheet(sheet: usize, row: usize, column: usize) -> u32 {
    ((sheet * ROWS + row) * COLUMNS + column) as u32
}

/// Triangles of the third eyelid: an outer and an inner sheet and the rim between them.
fn third_eyelid_faces() -> Vec<[u32; 3]> {
    let mut faces = Vec::new();
    let mut cell = |[a, b, c, d]: [u32; 4]| faces.extend([[a, b, c], [a, c, d]]);
    for r in 0..ROWS - 1 {
        for c in 0..COLUMNS - 1 {
            let corners = |sheet| [(r, c), (r, c + 1), (r + 1, c + 1), (r + 1, c)].map(|(r, c)| on_sheet(sheet, r, c));
            cell(corners(0));
            let [a, b, c, d] = corners(1);
            cell([a, d, c, b]);
        }
    }
    for r in 0..ROWS - 1 {
        let [first, last] = [0, COLUMNS - 1];
        cell([on_sheet(0, r + 1, first), on_sheet(1, r + 1, first), on_sheet(1, r, first), on_sheet(0, r, first)]);
        cell([on_sheet(0, r, last), on_sheet(1, r, last), on_sheet(1, r + 1, last), on_sheet(0, r + 1, last)]);
    }
    for c in 0..COLUMNS - 1 {
        let [first, last] = [0, ROWS - 1];
        cell([on_sheet(0, first, c), on_sheet(1, first, c), on_sheet(1, first, c + 1), on_sheet(0, first, c + 1)]);
        cell([on_sheet(0, last, c + 1), on_sheet(1, last, c + 1), on_sheet(1, last, c), on_sheet(0, last, c)]);
    }
    faces
}

/// Triangles of the line of tears: a tube with a pole at each end.
fn tear_line_faces() -> Vec<[u32; 3]> {
    let at = |s: usize, c: usize| (s * CORNERS + c % CORNERS) as u32;
    let [first, last] = [TEAR_LINE as u32 - 2, TEAR_LINE as u32 - 1];
    let mut faces = Vec::new();
    for c in 0..CORNERS {
        for s in 0..SECTIONS - 1 {
            let [a, b, d, e] = [at(s, c), at(s, c + 1), at(s + 1, c + 1), at(s + 1, c)];
            faces.extend([[a, d, b], [a, e, d]]);
        }
        faces.push([first, at(0, c), at(0, c + 1)]);
        faces.push([last, at(SECTIONS - 1, c + 1), at(SECTIONS - 1, c)]);
    }
    faces
}

/// Connectivity of the left third eyelid.
///
/// # Errors
/// Never: a test walks it.
pub fn third_eyelid_mesh() -> Result<DedgeMesh, MeshError> {
    DedgeMesh::from_triangles(THIRD_EYELID, &third_eyelid_faces())
}

/// Connectivity of the left line of tears.
///
/// # Errors
/// Never: a test walks it.
pub fn tear_line_mesh() -> Result<DedgeMesh, MeshError> {
    DedgeMesh::from_triangles(TEAR_LINE, &tear_line_faces())
}

/// The left third eyelid (`out`: [`THIRD_EYELID`] positions, metres): a crescent on the globe, its free edge hollow
/// towards the pupil. `closed`: how far the lids are shut, 0 to 1.
pub fn third_eyelid(s: &Proportions, eye: &Eye, closed: f32, out: &mut Vec<Vec3>) {
    let [a, b, g] = orbit_axes(s).map(|axis| s.direction(axis));
    // The medial corner of the lids' outer margin, which lies 1.1 radii from the centre.
    let corner = ops::asin((s.eye_w / 1.1).min(0.99));
    out.clear();
    for sheet in 0..2 {
        for r in 0..ROWS {
            let v = 2.0 * r as f32 / (ROWS - 1) as f32 - 1.0;
            let edge = corner - SEEN - SWEPT * closed - 0.45 * v * v;
            let root = corner + HIDDEN;
            // A little below the corner, as the slit slopes down to it.
            let up = HALF_HEIGHT * v - 0.05;
            for c in 0..COLUMNS {
                let u = c as f32 / (COLUMNS - 1) as f32;
                let to_nose = root + (edge - root) * u;
                let (sin, cos) = (ops::sin(to_nose), ops::cos(to_nose));
                let (rise, level) = (ops::sin(up), ops::cos(up));
                let direction = (g * cos - a * sin) * level + b * rise;
                let above = if sheet == 1 { SHEETS[0] } else { SHEETS[1] + (SHEETS[2] - SHEETS[1]) * u * u };
                out.push(eye.centre + direction * (eye.reach(direction) + above * eye.radius));
            }
        }
    }
}

/// The left line of tears (`out`: [`TEAR_LINE`] positions, metres) in the corner between the globe and the lower lid;
/// `margin`: the lid's inner margin from the lateral corner to the medial one, metres.
pub fn tear_line(eye: &Eye, margin: &[Vec3; 7], out: &mut Vec<Vec3>) {
    // Corners of a section: towards the slit and off the globe, parts of the radius; 0.1 is 1 mm.
    const SECTION: [[f32; 2]; CORNERS] =
        [[-0.045, -0.02], [0.055, -0.02], [0.055, 0.004], [0.020, 0.012], [-0.005, 0.028], [-0.045, 0.040]];
    let at = |f: f32| curve(margin, f);
    let last = (SECTIONS - 1) as f32;
    out.clear();
    let mut ends = [Vec3::ZERO; 2];
    for i in 0..SECTIONS {
        let f = 0.03 + 0.94 * i as f32 / last;
        let direction = (at(f) - eye.centre).normalize_or(eye.axes[2]);
        let along = (at((f + 0.01).min(1.0)) - at((f - 0.01).max(0.0))).normalize_or(-eye.axes[0]);
        // The path runs from the lateral to the medial corner below the pupil, so this looks up to the slit.
        let slit = along.cross(direction).normalize_or(eye.axes[1]);
        let slit = if slit.dot(eye.axes[1]) < 0.0 { -slit } else { slit };
        let thin = ops::sqrt((1.0 - ops::powf((2.0 * i as f32 / last - 1.0).abs(), 4.0)).max(0.0)).max(0.15);
        let mut middle = Vec3::ZERO;
        for [up, off] in SECTION {
            let out_of = (direction + slit * (up * thin)).normalize_or(direction);
            let p = eye.centre + out_of * (eye.reach(out_of) + off * thin * eye.radius);
            middle += p / CORNERS as f32;
            out.push(p);
        }
        if i == 0 {
            ends[0] = middle;
        }
        ends[1] = middle;
    }
    out.extend(ends);
}

/// A smooth curve through the points (Catmull and Rom 1974), `f` from 0 to 1.
fn curve(points: &[Vec3; 7], f: f32) -> Vec3 {
    let at = f.clamp(0.0, 1.0) * 6.0;
    let k = (at as usize).min(5);
    let t = at - k as f32;
    let point = |i: isize| points[i.clamp(0, 6) as usize];
    let k = k as isize;
    let (p, q, r, s) = (point(k - 1), point(k), point(k + 1), point(k + 2));
    0.5 * (2.0 * q + (r - p) * t + (2.0 * p - 5.0 * q + 4.0 * r - s) * (t * t) + (3.0 * (q - r) + s - p) * (t * t * t))
}
