//! The ear: a base on the skull, and a leather that is evaluated anew for every setting. It is a bent, swept, cupped
//! strip of thirteen measures, laid over the head without touching it: a linear blend between a pricked and a hanging
//! ear would collapse half way, the measures in between are an ear.

use super::{Pins, sin_cos};
use crate::math::ops;
use crate::rig::handles::EAR_RINGS;
use crate::rig::implicit::{Implicit, Layer};
use crate::rig::proportions::{EarProportions, Proportions};
use glam::{Vec3, vec3};

const STEPS: usize = 48;
/// Rings of the leather, that which closes it among them.
const SECTIONS: usize = EAR_RINGS + 1;
/// Where the rings of its root stand, as parts of the base's width.
const ROOT: [f32; 4] = [0.10, 0.24, 0.42, 0.64];
/// Where the last ring stands, as a part of the length.
const END: f32 = 0.955;

/// Where the base's front vertex stands: radians from the head's front, towards the crown.
const START: f32 = -0.55;

/// Gap between leather and skin, head units, at a part of the length.
fn clearance(part: f32) -> f32 {
    0.05 + 0.25 * smoothstep(0.0, 0.6, part)
}

fn smoothstep(a: f32, b: f32, x: f32) -> f32 {
    let t = ((x - a) / (b - a).max(1e-3)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Out of the skull, front margin to rear margin, outer face.
fn axes(e: &EarProportions) -> [Vec3; 3] {
    let ((sl, cl), (sb, cb), (st, ct)) = (sin_cos(e.lift), sin_cos(e.back), sin_cos(e.turn));
    let out = vec3(cl, sl * cb, -sl * sb);
    let across = vec3(ct, 0.0, -st);
    let across = (across - out * out.dot(across)).normalize_or(Vec3::NEG_Z);
    [out, across, out.cross(across)]
}

/// The loop on the skull from which the leather rises. Its outline turns with the leather, its vertices do not: they keep
/// their places among those of temple, crown and nape, and the leather's first step takes the turn.
pub(super) fn place_base(pins: &mut Pins) {
    let e = &pins.shape.ear;
    let [_, across, outer] = axes(e);
    let centre = pins.surface.project(e.set, Layer::Whole, 6);
    let normal = pins.surface.sample(centre, Layer::Whole).1.normalize_or(Vec3::Y);
    let along = (across - normal * normal.dot(across)).normalize_or(Vec3::NEG_Z);
    let side = normal.cross(along);
    let inner = if side.dot(outer) > 0.0 { -side } else { side };
    let rearwards = (Vec3::NEG_Z + normal * normal.z).normalize_or(along);
    let turn = ops::atan2(rearwards.dot(inner), rearwards.dot(along));
    for k in 0..12 {
        let (sin, cos) = sin_cos(core::f32::consts::TAU * k as f32 / 12.0 + START - turn);
        let p = centre + (along * -cos + inner * (0.62 * sin)) * (0.5 * e.base);
        let p = pins.surface.project(p, Layer::Whole, 5);
        pins.set(pins.handles.ear_base[k], p);
    }
}

/// Half the width of the leather at a part of its length.
fn half_width(e: &EarProportions, s: f32) -> f32 {
    if s < e.widest {
        let t = smoothstep(0.0, 1.0, s / e.widest.max(0.05));
        return 0.5 * (e.base + (e.width - e.base) * t);
    }
    let t = (s - e.widest) / (1.0 - e.widest);
    let (p, q) = (1.2 + 1.4 * e.tip, 1.0 - 0.5 * e.tip);
    0.5 * e.width * ops::powf(1.0 - ops::powf(t, p), q)
}

/// Places across the leather from the front (-1) to the rear margin (1): all columns of the rings are among them.
const PLACES: usize = 13;
/// The middle one.
const MIDDLE: usize = PLACES / 2;

/// One ring of the leather. Its curve across stands in its own frame, so that draping moves it as one.
#[derive(Clone, Copy, Default)]
struct Section {
    /// Where it stands, as a part of the length.
    part: f32,
    centre: Vec3,
    /// Across, along, outwards, at the middle.
    frame: [Vec3; 3],
    /// From the centre to the leather's middle face at each place, in the frame.
    curve: [Vec3; PLACES],
    /// Outwards at each place, in the frame.
    outwards: [Vec3; PLACES],
}

impl Section {
    fn head(&self, v: Vec3) -> Vec3 {
        self.frame[0] * v.x + self.frame[1] * v.y + self.frame[2] * v.z
    }

    /// Position at a place, on the outer (1) or inner (-1) face.
    fn at(&self, e: &EarProportions, place: usize, face: f32) -> Vec3 {
        let u = place as f32 / MIDDLE as f32 - 1.0;
        let wall = 0.5 * e.thickness * (1.0 - 0.35 * self.part) * (1.0 - ops::powf(u.abs(), 2.5));
        let bulge = e.cup * half_width(e, self.part) * (0.5 - u * u);
        self.centre + self.head(self.curve[place] + self.outwards[place] * (bulge + face * wall))
    }
}

/// Where along the leather the rings stand: four in its root, whose length goes with the base, the others over what is left.
fn parts(e: &EarProportions) -> [f32; SECTIONS] {
    let root = (e.base / e.length.max(0.1)).clamp(0.35, 0.8);
    let end = ROOT[ROOT.len() - 1] * root;
    core::array::from_fn(|r| match ROOT.get(r) {
        Some(part) => part * root,
        None => end + (END - end) * (r + 1 - ROOT.len()) as f32 / (SECTIONS - ROOT.len()) as f32,
    })
}

/// The leather as a sheet that is bent about the fold's line, which runs across it or aslant, and swept.
fn march(e: &EarProportions, root: Vec3) -> [Section; SECTIONS] {
    let [out, across, outer] = axes(e);
    let fold = fold(e);
    let soft = e.fold_softness.max(0.02) * e.length;
    let (ss, cs) = sin_cos(-e.fold_slant);
    // Along the fold's line, and across it in the flat sheet.
    let (line, over) = (across * cs - out * ss, across * ss + out * cs);
    // How far the sheet is bent at a place of it, and its directions across and along there.
    let bend = |a: f32, l: f32| {
        let beyond = (l - e.fold_height * e.length) * cs + a * ss;
        let (sb, cb) = sin_cos(fold * smoothstep(-soft, soft, beyond));
        let over = over * cb - outer * sb;
        (line * cs + over * ss, over * cs - line * ss)
    };
    let parts = parts(e);
    let mut sections = [Section::default(); SECTIONS];
    let (mut p, mut ring) = (root, 0);
    // The sweep turns the leather about the transverse axis: back for rose ears, forward for button ears.
    let turn = |s: f32, v: Vec3| {
        let (ss, cs) = sin_cos(-e.sweep * smoothstep(0.0, 0.55, s));
        vec3(v.x, v.y * cs - v.z * ss, v.y * ss + v.z * cs)
    };
    for n in 0..STEPS {
        let (start, middle) = (n as f32 / STEPS as f32, (n as f32 + 0.5) / STEPS as f32);
        let way = turn(middle, bend(0.0, middle * e.length).1) * e.length;
        while ring < SECTIONS && start + 1.0 / STEPS as f32 >= parts[ring] {
            let part = parts[ring];
            let (across, along) = bend(0.0, part * e.length);
            let flat = [across, along, along.cross(across)];
            let into = |v: Vec3| vec3(v.dot(flat[0]), v.dot(flat[1]), v.dot(flat[2]));
            let mut section = Section { part, ..Section::default() };
            section.centre = p + way * (part - start);
            section.frame = flat.map(|v| turn(part, v));
            let step = half_width(e, part).max(0.5 * e.thickness) / MIDDLE as f32;
            for place in 0..PLACES {
                let (across, along) = bend((place as f32 - MIDDLE as f32) * step, part * e.length);
                section.outwards[place] = into(along.cross(across));
            }
            for side in [-1.0, 1.0] {
                let mut q = Vec3::ZERO;
                for k in 1..=MIDDLE {
                    q += into(bend(side * (k as f32 - 0.5) * step, part * e.length).0) * (side * step);
                    section.curve[if side < 0.0 { MIDDLE - k } else { MIDDLE + k }] = q;
                }
            }
            sections[ring] = section;
            ring += 1;
        }
        p += way / STEPS as f32;
    }
    sections
}

/// Writes the rings of the leather (`at` has the length of the half mesh, the base loop is in place).
pub(super) fn leather(
    shape: &Proportions,
    surface: &Implicit,
    handles: &crate::rig::handles::Handles,
    at: &mut [Vec3],
) {
    let e = &shape.ear;
    let base: [Vec3; 12] = handles.ear_base.map(|v| at[v as usize]);
    let root = base.iter().sum::<Vec3>() / 12.0;
    let mut sections = march(e, root);
    let covered = covers(e);
    drape(e, surface, &mut sections);
    // The leather grows out of its base over this part of its length.
    let grown = (0.6 * e.base / e.length.max(0.1)).clamp(0.18, 0.36);
    for (r, section) in sections.iter().enumerate() {
        let vertices: &[u16] = handles.a.get(r).map_or(&handles.ear_end, |ring| ring);
        let n = vertices.len();
        let half = n / 2;
        let keep = 1.0 - smoothstep(0.0, grown, section.part);
        for (k, &v) in vertices.iter().enumerate() {
            let (column, face) = if k <= half { (k, -1.0) } else { (n - k, 1.0) };
            let mut p = section.at(e, column * (PLACES - 1) / half, face);
            if keep > 0.0 {
                // The inner face stays hollow, as the concha is.
                let hold = if face < 0.0 && k != 0 && k != half { 0.45 - 0.12 * covered } else { 0.85 };
                let rise = section.centre - root;
                p = p + (base[k] + rise - p) * (hold * keep);
            }
            if r < handles.a.len() {
                p += relief(e, section, r, k, 1.0 - covered);
            }
            at[v as usize] = p;
        }
    }
}

/// The burr: how far vertices of the inner face stand out of the concha (ring, column, parts of the base's width).
/// Low in front the tragus, behind the notch the antitragus, and above the hollow that they close the anthelix, a ridge
/// across the wall.
const BURR: [(usize, usize, f32); 10] = [
    (0, 2, 0.03),
    (0, 3, 0.02),
    (0, 4, 0.06),
    (1, 2, 0.09),
    (1, 3, -0.10),
    (1, 4, 0.08),
    (2, 3, -0.05),
    (3, 2, 0.05),
    (3, 3, 0.10),
    (3, 4, 0.05),
];

/// The cutaneous marginal pouch (Henry's pocket) on the rear margin: how deep it is at each ring, parts of half the width.
const POUCH: [(usize, f32); 3] = [(2, 0.12), (3, 0.12), (4, 0.06)];

/// What stands out of the smooth leather at a vertex, or is let into it; the burr as far as it is open.
fn relief(e: &EarProportions, section: &Section, ring: usize, column: usize, open: f32) -> Vec3 {
    let [across, _, outer] = section.frame;
    let burr = BURR.iter().find(|b| (b.0, b.1) == (ring, column)).map_or(0.0, |b| b.2);
    let mut p = outer * (-burr * e.base * open);
    if let Some((_, depth)) = POUCH.iter().find(|p| p.0 == ring) {
        // Its floor lies in the margin; the inner and the outer lip stand beside it.
        let deep = depth * half_width(e, section.part);
        p += match column {
            5 => -outer * (0.3 * deep),
            6 => across * -deep,
            7 => across * (0.5 * deep) + outer * (0.3 * deep),
            _ => Vec3::ZERO,
        };
    }
    p
}

/// How much the leather hangs: 0 pricked, 1 folded over.
fn hang(e: &EarProportions) -> f32 {
    smoothstep(0.9, 1.5, fold(e))
}

/// The fold with gravity: a leather that is neither stiff enough to stand nor folded over sinks further than its measure
/// says, as a half-pricked ear does, and does not stick out to the side.
fn fold(e: &EarProportions) -> f32 {
    let over = smoothstep(0.0, 1.6, e.fold);
    e.fold + 3.6 * over * (1.0 - over) * (1.0 - held(e))
}

/// How much the leather covers its own root: 0 pricked, folded aslant or folded high, 1 hanging.
fn covers(e: &EarProportions) -> f32 {
    hang(e) * (1.0 - held(e))
}

/// How far the slant of its fold holds the leather, as that of a rose ear does, against its weight.
fn held(e: &EarProportions) -> f32 {
    smoothstep(0.1, 0.5, e.fold_slant.abs())
}

/// How much the leather lies on the head at a part of its length: where it hangs, beyond its fold; not a tip that only
/// falls over high in the air, and not a rose ear, which its own folds hold.
fn lies(e: &EarProportions, part: f32) -> f32 {
    let in_the_air = smoothstep(0.26, 0.42, e.fold_height);
    covers(e) * (1.0 - in_the_air) * smoothstep(e.fold_height - 0.11, e.fold_height + 0.22, part)
}

/// Moves whole sections along the skin's gradient until the inner face clears the head; leather that is folded over
/// also sinks until it lies on the head.
fn drape(e: &EarProportions, surface: &Implicit, sections: &mut [Section; SECTIONS]) {
    for _ in 0..6 {
        let mut moves = [Vec3::ZERO; SECTIONS];
        for (r, s) in sections.iter_mut().enumerate() {
            let (_, g) = surface.sample(s.centre, Layer::Whole);
            let normal = g.normalize_or_zero();
            let mut gaps = [0.0; 6];
            for (k, places) in [[0, 2], [5, 7], [10, 12]].into_iter().enumerate() {
                let [a, b] = places.map(|place| s.at(e, place, -1.0));
                let [a, b] = surface.sample2(a, b, Layer::Whole);
                (gaps[2 * k], gaps[2 * k + 1]) = (a.0, b.0);
            }
            let nearest = gaps.iter().fold(f32::INFINITY, |n, &g| n.min(g));
            let gap = clearance(s.part) - nearest;
            let sink = lies(e, s.part);
            // A hanging leather turns until both margins are equally near.
            let width = half_width(e, s.part).max(0.3);
            let lean = ((gaps[5] - gaps[0]) / (2.0 * width)).clamp(-0.6, 0.6) * 0.35 * sink;
            let [across, along, outer] = s.frame;
            let across = (across - outer * lean).normalize_or(across);
            s.frame = [across, along, along.cross(across)];
            moves[r] = normal * if gap > 0.0 { gap } else { gap * 0.5 * sink };
        }
        for r in 0..SECTIONS {
            let (before, after) = (moves[r.max(1) - 1], moves[(r + 1).min(SECTIONS - 1)]);
            sections[r].centre += (moves[r] * 0.6 + (before + after) * 0.2).clamp_length_max(0.7);
        }
    }
}
