//! The tongue: at rest inside the lower arch, its tip behind the lower incisors, its back under the palate.
//!
//! Size after common figures for a mesaticephalic dog of 30 kg (skull of 200 mm): 90 to 110 mm long, 35 to 40 wide, 6 to
//! 10 thick, the free part about half. It is as long as its arch lets it be, and as wide as the teeth leave room.

use super::arch::Arch;
use super::{HalfBody, Tissue, off_bone};
use crate::math::ops::{self, smoothstep};
use crate::rig::bone::teeth::{self, TOOTH_VERTICES, ToothKind};
use crate::rig::bone::{BoneField, Targets};
use glam::{Vec3, vec3};

/// Sections from the root to the tip.
pub(super) const SECTIONS: usize = 30;
/// Places around a half section, from the back's midline to the underside's.
pub(super) const AROUND: usize = 11;
/// The tip, a vertex of the tongue's mesh.
pub const TONGUE_TIP: usize = SECTIONS * AROUND + 1;
/// Between tongue and teeth, canonical millimetres.
const GAP: f32 = 1.2;
/// Between tongue and bone, canonical millimetres: under the palate with its ridges; over the floor where the tongue is
/// free, and where it grows out of it.
const COVER: [f32; 3] = [2.6, 2.3, 0.3];

fn at(section: usize, place: usize) -> usize {
    section * AROUND + place
}

/// Topology: a half tube with a pole at each end.
pub(super) fn body() -> HalfBody {
    let n = SECTIONS * AROUND + 2;
    let mut body = HalfBody { midline: vec![false; n], faces: Vec::new(), tissue: vec![Tissue::Tongue; n] };
    for i in 0..SECTIONS {
        body.midline[at(i, 0)] = true;
        body.midline[at(i, AROUND - 1)] = true;
        (AROUND / 2 + 1..AROUND).for_each(|j| body.tissue[at(i, j)] = Tissue::TongueUnder);
    }
    let (root, tip) = (n - 2, n - 1);
    body.midline[root] = true;
    body.midline[tip] = true;
    for j in 0..AROUND - 1 {
        for i in 0..SECTIONS - 1 {
            body.cell([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
        body.faces.push([root, at(0, j), at(0, j + 1)].map(|v| v as u16));
        body.faces.push([tip, at(SECTIONS - 1, j + 1), at(SECTIONS - 1, j)].map(|v| v as u16));
    }
    body
}

/// Vertices of the whole body by section; root and tip go with the first and the last.
pub(super) fn sections(body: &HalfBody) -> Vec<Vec<u16>> {
    let images = crate::rig::mirror::images(&body.midline);
    let mut out = vec![Vec::new(); SECTIONS];
    for (v, &image) in images.iter().enumerate() {
        let own = match v / AROUND {
            i if i < SECTIONS => i,
            _ if v == SECTIONS * AROUND => 0,
            _ => SECTIONS - 1,
        };
        out[own].push(v as u16);
        if image as usize != v {
            out[own].push(image as u16);
        }
    }
    out
}

/// How far the inner side of a lower canine is from the median plane where a tongue passes, canonical millimetres; where it
/// is farther than that, what it loses of its height for each millimetre.
const PASSES: f32 = 2.2;
const SPREAD: f32 = 8.0;

/// The least height at which a tongue passes between the lower canines, which stand almost together in the narrowest jaws;
/// `below`: the lower teeth.
pub(super) fn over_canines(below: &[Vec3], unit: f32) -> f32 {
    let canine = below.chunks(TOOTH_VERTICES).zip(&teeth::LOWER).find(|(_, tooth)| tooth.kind == ToothKind::Canine);
    let height = |p: &Vec3| p.y - SPREAD * (p.x - PASSES * unit).max(0.0);
    canine.map_or(f32::NEG_INFINITY, |(at, _)| at.iter().map(height).fold(f32::NEG_INFINITY, f32::max))
}

/// Half the width of a tongue that nothing narrows, canonical millimetres.
const WIDEST: f32 = 18.5;
/// How far below its underside, and how far before and behind a section, teeth narrow a tongue that comes out, canonical
/// millimetres.
const UNDER: f32 = 1.0;
const BESIDE: f32 = 6.0;

/// Half the width of a tongue before the teeth at most: as a part of its widest, and of half the width across the lower
/// canines.
const OUTSIDE: [f32; 2] = [0.85, 1.35];

/// What a tooth takes up.
#[derive(Clone, Copy, Debug)]
struct Room {
    low: Vec3,
    high: Vec3,
}

fn rooms(teeth: [&Vec<Vec3>; 2]) -> [Vec<Room>; 2] {
    teeth.map(|vertices| {
        let left = &vertices[..vertices.len() / 2];
        let bounds = left.chunks(TOOTH_VERTICES).map(|tooth| {
            let low = tooth.iter().fold(Vec3::INFINITY, |a, &p| a.min(p));
            let high = tooth.iter().fold(Vec3::NEG_INFINITY, |a, &p| a.max(p));
            Room { low, high }
        });
        bounds.collect()
    })
}

/// A section of the tongue.
#[derive(Clone, Copy, Debug, Default)]
struct Section {
    /// From root to tip, 0 to 1.
    along: f32,
    z: f32,
    middle: f32,
    half_width: f32,
    /// Where the lower gum begins, and the height of its margin.
    gum: f32,
    margin: f32,
    above: f32,
    below: f32,
}

/// Half the width that teeth leave a tongue at each of its sections, metres.
#[derive(Clone, Debug, Default)]
pub(super) struct Passage {
    /// In a shut mouth.
    pub(super) inside: [f32; SECTIONS],
    /// Where it lies on the lower teeth as it comes out.
    pub(super) out: [f32; SECTIONS],
    /// Half of its width before the teeth.
    pub(super) outside: f32,
}

/// Over which part of the way to the teeth a tongue that comes out rises onto them.
pub(super) fn rises(way: f32) -> f32 {
    smoothstep(0.45, 0.92, way)
}

/// Positions of the half, metres; `bones`: skull and mandible; `onto`: the height at which it leaves the mouth.
pub(super) fn place(
    t: &Targets<Vec3>,
    arches: &[Arch; 2],
    teeth: [&Vec<Vec3>; 2],
    bones: &[BoneField; 2],
    onto: f32,
    out: &mut Vec<Vec3>,
) -> Passage {
    let unit = teeth::unit(t);
    let [upper, lower] = arches;
    let [above, below] = rooms(teeth);
    let gap = GAP * unit;
    // The middle incisors end it in front: the upper ones where the lower jaw stands before them.
    let front = above[0].low.z.min(below[0].low.z) - gap;
    let last = t.lower_last.z;
    let back = last - 0.17 * (t.infradentale.z - last);
    let length = (front - back).max(4.0 * unit);
    let mut sections = [Section::default(); SECTIONS];
    for (i, s) in sections.iter_mut().enumerate() {
        // Closer together at the tip, which is round.
        let f = i as f32 / (SECTIONS - 1) as f32;
        let f = f + 0.4 * f * (1.0 - f);
        s.z = back + f * length;
        let (floor, roof) = (lower.rim(s.z, unit), upper.rim(s.z, unit));
        let room = (roof - floor).clamp(2.0 * unit, 11.5 * unit);
        // Thin in front, and the back half grows out of the floor.
        let thick = (0.70 * room).min(8.6 * unit) * (0.66 + 0.34 * smoothstep(1.0, 0.55, f));
        let root = smoothstep(0.50, 0.32, f);
        s.above = 0.5 * thick;
        s.below = 0.5 * thick + root * 0.35 * room;
        s.middle = floor + (0.12 + 0.05 * (1.0 - f)) * room + 0.5 * thick;
        let nominal = WIDEST * unit * (0.80 + 0.20 * smoothstep(0.75, 0.25, f));
        s.half_width = nominal;
        let reach = 0.6 * length / SECTIONS as f32 + 0.3 * unit;
        for tooth in above[1..].iter().chain(&below[1..]) {
            let beside = tooth.low.z - reach < s.z && s.z < tooth.high.z + reach;
            let level = tooth.low.y < s.middle + 0.75 * s.above && tooth.high.y > s.middle - s.below;
            if beside && level {
                s.half_width = s.half_width.min(tooth.low.x - gap);
            }
        }
        s.gum = f32::INFINITY;
        for rib in &lower.ribs {
            let gum = lower.inner(rib, unit);
            if (gum.z - s.z).abs() < reach {
                s.gum = s.gum.min((gum.x - 0.8 * unit).max(0.8 * unit));
            }
        }
        s.margin = floor + 1.6 * unit;
        s.half_width = s.half_width.max(1.5 * unit).min(nominal);
        s.along = f;
    }
    // Narrow places pass smoothly into wide ones.
    for _ in 0..4 {
        let before = sections;
        for i in 1..SECTIONS - 1 {
            let mean = 0.25 * (before[i - 1].half_width + 2.0 * before[i].half_width + before[i + 1].half_width);
            sections[i].half_width = mean.min(before[i].half_width);
        }
    }
    out.clear();
    for s in &sections {
        // Both ends are round, the tip over a longer way.
        let to_end = [(s.along - 0.80) / 0.205, (0.08 - s.along) / 0.09].map(|t| t.max(0.0));
        let round = to_end.map(|t| ops::sqrt((1.0 - t * t).max(0.0))).into_iter().fold(1.0, f32::min).max(0.2);
        let s = Section { half_width: s.half_width * round, ..*s };
        for j in 0..AROUND {
            let angle = core::f32::consts::PI * j as f32 / (AROUND - 1) as f32;
            let (sin, cos) = (ops::sin(angle), ops::cos(angle));
            let x = s.half_width * ops::powf(sin.max(0.0), 0.8);
            let side = if cos > 0.0 { s.above } else { s.below };
            let mut y = side * cos;
            // The median groove.
            y -= match j {
                0 => 0.30 * s.above,
                1 => 0.06 * s.above,
                _ => 0.0,
            };
            let y = s.middle + y;
            // Between the gums, or over them.
            let x = if y < s.margin { x.min(s.gum) } else { x };
            let p = vec3(x, y, s.z);
            let free = smoothstep(0.34, 0.48, s.along);
            let cover = COVER[2] + free * (COVER[1] - COVER[2]);
            let p = (0..2).fold(p, |p, _| off_bone(off_bone(p, &bones[0], COVER[0], unit), &bones[1], cover, unit));
            // Sections stay flat, and each on its side.
            out.push(vec3(p.x.clamp(0.0, x), p.y, s.z));
        }
    }
    let (first, last) = (sections[0], sections[SECTIONS - 1]);
    out.push(vec3(0.0, first.middle - 0.3 * first.below, back - 0.02 * length));
    out.push(vec3(0.0, last.middle, last.z + 0.01 * length));
    let own = &teeth[1][..teeth[1].len() / 2];
    let mut passage = Passage { inside: sections.map(|s| s.half_width), ..Passage::default() };
    for (free, s) in passage.out.iter_mut().zip(&sections) {
        let bottom = s.middle - s.below;
        let level = bottom + (onto - bottom).max(0.0) * rises(s.along) - UNDER * unit;
        let beside = own.iter().filter(|p| (p.z - s.z).abs() < BESIDE * unit && p.y > level);
        let narrowest = beside.fold(WIDEST * unit, |least, p| least.min(p.x - gap));
        *free = narrowest.max(s.half_width);
    }
    let canine = below.iter().zip(&teeth::LOWER).find(|(_, tooth)| tooth.kind == ToothKind::Canine);
    let across = canine.map_or(f32::INFINITY, |(room, _)| room.high.x);
    let widest = passage.inside.into_iter().fold(0.0, f32::max);
    passage.outside = (OUTSIDE[0] * widest).min(OUTSIDE[1] * across);
    passage
}
