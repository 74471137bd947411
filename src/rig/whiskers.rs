//! Whiskers: where each grows out of the skin, which way, and how long it is.
//!
//! Five groups, as dogs have them: rows on the whisker pad, under the chin, between the jaws, on the cheek and above the
//! eye. Lengths are common figures for a medium dog (pad 40 to 70 mm, brow 25 to 40, cheek 30 to 50, between the jaws 20
//! to 40) and grow with the head.

use super::control::{ControlError, HalfMesh};
use glam::{Vec2, Vec3, vec2};

/// Where on the head a whisker grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Group {
    /// In five rows on the whisker pad (K42).
    Mystacial,
    /// On the chin.
    Submental,
    /// In a tuft between the jaws (K44).
    Interramal,
    /// In tufts on the cheek (K43).
    Genal,
    /// Above the eye (K45).
    Supraorbital,
}

impl Group {
    /// All, in the order of [`follicles`].
    pub const ALL: [Group; 5] =
        [Group::Mystacial, Group::Submental, Group::Interramal, Group::Genal, Group::Supraorbital];

    /// In lower case.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mystacial => "mystacial",
            Self::Submental => "submental",
            Self::Interramal => "interramal",
            Self::Genal => "genal",
            Self::Supraorbital => "supraorbital",
        }
    }
}

/// A follicle of the left half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Follicle {
    /// Its group.
    pub group: Group,
    /// Row of the group from above, and place in the row from the front; both from 1.
    pub row: u8,
    /// See `row`.
    pub place: u8,
    /// Face of the half control mesh.
    pub face: u32,
    /// Barycentric, of that face's corners.
    pub weights: [f32; 3],
    /// Direction at the root: out of the skin, along the hair that lies there, and across it. Not unit.
    pub lean: Vec3,
    /// On a cranium of 106 mm, millimetres.
    pub length: f32,
}

/// A whisker of one head. Metres, head's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Whisker {
    /// Its group.
    pub group: Group,
    /// Row of the group from above, and place in the row from the front; both from 1.
    pub row: u8,
    /// See `row`.
    pub place: u8,
    /// On the dog's left; the right one is its mirror image.
    pub is_left: bool,
    /// On the skin.
    pub position: Vec3,
    /// Unit, where it leaves the skin.
    pub direction: Vec3,
    /// From root to tip.
    pub length: f32,
}

/// A row of whiskers, evenly spaced between two places of a patch (ring, column) of `assets/head.patch.ron`.
struct Row {
    group: Group,
    patch: char,
    from: Vec2,
    to: Vec2,
    count: u8,
    /// Millimetres, from the first to the last.
    length: [f32; 2],
    lean: Vec3,
}

#[rustfmt::skip]
const ROWS: [Row; 12] = {
    use Group::{Genal, Interramal, Mystacial, Submental, Supraorbital};
    const fn row(group: Group, patch: char, ends: [f32; 4], count: u8, length: [f32; 2], lean: [f32; 3]) -> Row {
        let [a, b, c, d] = ends;
        Row { group, patch, from: vec2(a, b), to: vec2(c, d), count, length, lean: Vec3::from_array(lean) }
    }
    [
        row(Mystacial, 's', [2.75, 6.35, 4.35, 6.30], 4, [24.0, 42.0], [0.66, 0.75, 0.0]),
        row(Mystacial, 's', [2.60, 6.90, 4.75, 6.85], 5, [26.0, 52.0], [0.66, 0.75, 0.0]),
        row(Mystacial, 's', [2.70, 7.45, 4.90, 7.40], 5, [26.0, 60.0], [0.64, 0.77, 0.0]),
        row(Mystacial, 's', [3.20, 7.95, 5.00, 7.90], 5, [24.0, 62.0], [0.62, 0.78, 0.0]),
        row(Mystacial, 's', [3.70, 8.40, 4.90, 8.40], 3, [22.0, 46.0], [0.60, 0.80, 0.0]),
        row(Submental, 'l', [3.35, 11.2, 4.25, 11.2], 2, [12.0, 18.0], [0.70, 0.70, 0.0]),
        row(Submental, 'l', [3.55, 12.3, 4.45, 12.3], 2, [12.0, 20.0], [0.70, 0.70, 0.0]),
        row(Interramal, 'l', [10.7, 13.60, 11.3, 13.70], 3, [22.0, 32.0], [0.60, 0.80, 0.0]),
        row(Genal, 's', [10.2, 6.85, 10.7, 6.95], 3, [32.0, 44.0], [0.60, 0.80, 0.0]),
        row(Genal, 's', [10.1, 7.6, 10.6, 7.7], 2, [30.0, 38.0], [0.60, 0.80, 0.0]),
        row(Supraorbital, 's', [9.25, 1.62, 9.75, 1.55], 3, [25.0, 34.0], [0.70, 0.70, 0.0]),
        row(Supraorbital, 's', [9.40, 1.86, 9.75, 1.84], 2, [26.0, 36.0], [0.70, 0.70, 0.0]),
    ]
};

/// The follicles of the left half, group by group and row by row.
///
/// # Errors
/// Names the place of the control mesh that the rows need and it lacks.
pub fn follicles(half: &HalfMesh) -> Result<Vec<Follicle>, ControlError> {
    let mut all: Vec<Follicle> = Vec::new();
    for (k, row) in ROWS.iter().enumerate() {
        let number = 1 + ROWS[..k].iter().filter(|other| other.group == row.group).count() as u8;
        for i in 0..row.count {
            let t = f32::from(i) / f32::from(row.count - 1).max(1.0);
            let (face, weights) = place(half, row.patch, row.from + (row.to - row.from) * t)?;
            let length = row.length[0] + (row.length[1] - row.length[0]) * t;
            all.push(Follicle { group: row.group, row: number, place: i + 1, face, weights, lean: row.lean, length });
        }
    }
    Ok(all)
}

/// The control face over a place of a patch, and barycentric weights in it.
fn place(half: &HalfMesh, patch: char, at: Vec2) -> Result<(u32, [f32; 3]), ControlError> {
    let [ring, column] = at.to_array().map(|x| x.max(0.0) as usize);
    let mut corners = Vec::with_capacity(4);
    for (i, j) in [(ring, column), (ring + 1, column), (ring, column + 1), (ring + 1, column + 1)] {
        let tag = format!("{patch}.{i}.{j}");
        let vertex = half.tags.iter().position(|t| *t == tag).ok_or(ControlError::Missing(tag))?;
        corners.push((vertex, vec2(i as f32, j as f32)));
    }
    let weights = |face: &[u16; 3]| -> Option<[f32; 3]> {
        let find = |v: u16| corners.iter().find(|c| c.0 == usize::from(v)).map(|c| c.1);
        let [a, b, c] = [find(face[0])?, find(face[1])?, find(face[2])?];
        let area = (b - a).perp_dot(c - a);
        let w = [(b - at).perp_dot(c - at) / area, (c - at).perp_dot(a - at) / area, (a - at).perp_dot(b - at) / area];
        w.iter().all(|&w| w >= -1e-4).then_some(w)
    };
    let found = half.faces.iter().enumerate().find_map(|(f, face)| Some((f as u32, weights(face)?)));
    found.ok_or_else(|| ControlError::Missing(format!("face at {patch}.{}.{}", at.x, at.y)))
}
