//! The ear: a base on the skull, and a leather that is evaluated anew for every setting. It is a bent, swept, cupped
//! strip of thirteen measures, laid over the head without touching it: a linear blend between a pricked and a hanging
//! ear would collapse half way, the measures in between are an ear.

use super::{Pins, sin_cos};
use crate::math::ops;
use crate::rig::handles::EAR_RINGS;
use crate::rig::implicit::{Implicit, Layer};
use crate::rig::proportions::{EarProportions, Proportions};
use glam::{Quat, Vec3, vec3};

const STEPS: usize = 48;
/// Rings of the leather, that which closes it among them.
const SECTIONS: usize = EAR_RINGS + 1;
/// Where the rings of its root stand, as parts of the base's width.
const ROOT: [f32; 4] = [0.10, 0.24, 0.42, 0.64];
/// Where the last ring stands, as a part of the length.
const END: f32 = 0.955;

/// Where the base's front vertex stands: radians from the head's front, towards the crown.
const START: f32 = -0.55;
/// How deep the base is for its width.
const OVAL: f32 = 0.62;
/// How much the first ring is held to the base's shape. The more of the turn between base and leather it takes, the less is
/// left for the second; the rest is spread over the root.
const HOLD: f32 = 0.7;
/// How often a ring is laid anew.
const LAYING: usize = 5;
/// Least distance of the leather from the median plane, head units.
const APART: f32 = 0.3;

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
        let p = centre + (along * -cos + inner * (OVAL * sin)) * (0.5 * e.base);
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

/// One ring of the leather. Its curve across stands in its own frame, so that laying it on the head moves it as one.
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
    /// Depth of the cup, and how much of it lies on the outer side of the centre.
    cup: [f32; 2],
    /// Curvature of the fold here, per head unit.
    bend: f32,
    /// How much the ring still has of the base's shape.
    keep: f32,
    /// What keeps each place off the head.
    push: [Vec3; PLACES],
}

impl Section {
    fn head(&self, v: Vec3) -> Vec3 {
        self.frame[0] * v.x + self.frame[1] * v.y + self.frame[2] * v.z
    }

    /// Position at a place, on the outer (1) or inner (-1) face; where the ring grows out of its base, `place` is even.
    fn at(&self, e: &EarProportions, base: &Base, place: usize, face: f32) -> Vec3 {
        let u = place as f32 / MIDDLE as f32 - 1.0;
        let wall = 0.5 * e.thickness * (1.0 - 0.35 * self.part) * (1.0 - ops::powf(u.abs(), 5.0));
        let bulge = self.cup[0] * (self.cup[1] - u * u);
        let mut p = self.centre + self.head(self.curve[place] + self.outwards[place] * (bulge + face * wall));
        if self.keep > 0.0 {
            let column = place / 2;
            let k = if face < 0.0 { column } else { (12 - column) % 12 };
            // The inner face stays hollow in its middle, as the concha is; beside its margins it goes with the outer one.
            let hold = if face < 0.0 { HOLD - base.hollow * (1.0 - smoothstep(0.4, 0.95, u.abs())) } else { HOLD };
            // The base's shape turns with the leather; in the bow of a fold it is as flat as there is room.
            let own = base.oval[k];
            let deep = if own.z < 0.0 { own.z / (1.0 - own.z * self.bend / 0.6) } else { own.z };
            let fixed = base.at[k] - base.middle;
            let turned = self.head(vec3(own.x, own.y, deep));
            let target = self.centre + fixed.lerp(turned, smoothstep(0.0, 1.0, 1.0 - self.keep));
            p = p + (target - p) * (hold * self.keep);
        }
        p + self.push[place]
    }
}

/// What the leather grows out of.
struct Base {
    at: [Vec3; 12],
    /// The loop about the middle from the leather's front margin on, as its rings have it: across, along, outwards.
    oval: [Vec3; 12],
    middle: Vec3,
    /// How much less the middle of the inner face holds the base's shape.
    hollow: f32,
}

impl Base {
    fn new(e: &EarProportions, at: [Vec3; 12]) -> Self {
        let middle = at.iter().sum::<Vec3>() / 12.0;
        let [out, across, _] = axes(e);
        let around = |k: usize| (at[k] - middle).cross(at[(k + 1) % 12] - middle);
        let normal = (0..12).map(around).sum::<Vec3>();
        let normal = (if normal.dot(out) < 0.0 { -normal } else { normal }).normalize_or(out);
        let along = (across - normal * normal.dot(across)).normalize_or(across);
        let outer = normal.cross(along);
        let own = at.map(|p| vec3((p - middle).dot(along), (p - middle).dot(normal), (p - middle).dot(outer)));
        // By as much as the base stands turned to the leather, its shape is turned back, so that the leather is not wrung.
        let start = ops::atan2(-own[0].z / OVAL, -own[0].x) * (6.0 / core::f32::consts::PI);
        let oval = core::array::from_fn(|k| {
            let place = k as f32 - start + 12.0;
            let before = place.floor();
            own[before as usize % 12].lerp(own[(before as usize + 1) % 12], place - before)
        });
        Self { at, oval, middle, hollow: 0.4 + 0.12 * covers(e) }
    }
}

/// Where along the leather the rings stand: four in its root, whose length goes with the base, the others over what is
/// left, nearest to each other where it folds.
fn parts(e: &EarProportions) -> [f32; SECTIONS] {
    const PIECES: usize = 24;
    let root = (e.base / e.length.max(0.1)).clamp(0.35, 0.8);
    let start = ROOT[ROOT.len() - 1] * root;
    let dense = |s: f32| {
        let off = (s - e.fold_height) / 0.16;
        1.0 + 1.2 * smoothstep(0.0, 1.2, e.fold) / (1.0 + off * off)
    };
    let piece = (END - start) / PIECES as f32;
    let mut sums = [0.0; PIECES + 1];
    for k in 0..PIECES {
        sums[k + 1] = sums[k] + dense(start + (k as f32 + 0.5) * piece);
    }
    core::array::from_fn(|r| match ROOT.get(r) {
        Some(part) => part * root,
        None => {
            let aim = sums[PIECES] * (r + 1 - ROOT.len()) as f32 / (SECTIONS - ROOT.len()) as f32;
            let k = (0..PIECES - 1).find(|&k| sums[k + 1] >= aim).unwrap_or(PIECES - 1);
            start + piece * (k as f32 + (aim - sums[k]) / (sums[k + 1] - sums[k]))
        }
    })
}

/// Half the way over which the sheet bends. Leather folds no sharper than its thickness allows, aslant, where a margin runs
/// along the fold, less sharp than across.
fn softness(e: &EarProportions) -> f32 {
    let least = (1.1 + 0.6 * held(e)) * fold(e) * e.thickness;
    let wanted = e.fold_softness * e.length;
    (wanted * wanted + least * least).sqrt()
}

/// Curvature of the leather at a part of its length, per head unit, as rings at their distance see it.
fn bend(e: &EarProportions, part: f32) -> f32 {
    let reach = softness(e) + 0.06 * e.length;
    let t = (0.5 + 0.5 * (part - e.fold_height) * e.length / reach).clamp(0.0, 1.0);
    fold(e) * 3.0 * t * (1.0 - t) / reach
}

/// Depth of the cup at a part of the length, and how much of it lies outside. Where the leather folds it flattens, as a
/// cup does that is bent across, so that its margins stay on their side of the fold's axis.
fn cup(e: &EarProportions, part: f32) -> [f32; 2] {
    let depth = e.cup * half_width(e, part);
    let bent = depth * bend(e, part) / 0.7;
    let flat = 1.0 / (1.0 + bent * bent).sqrt();
    [depth * flat, 0.5 + 0.4 * (1.0 - flat)]
}

/// The leather as a sheet that is bent about the fold's line, which runs across it or aslant, and swept.
fn march(e: &EarProportions, root: Vec3) -> [Section; SECTIONS] {
    let [out, across, outer] = axes(e);
    let fold = hung(e);
    let soft = softness(e);
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
    // The leather grows out of its base over this part of its length.
    let grown = (0.8 * e.base / e.length.max(0.1)).clamp(0.18, 0.45);
    let mut sections = [Section::default(); SECTIONS];
    let (mut p, mut ring) = (root, 0);
    // The sweep turns the leather about the transverse axis: back for rose ears, forward for button ears. Wide leather
    // turns over a longer way, so that the margin on the inner side of the turn does not run into itself.
    let wide = 2.2 * e.sweep * 0.5 * e.width / e.length.max(0.1);
    let ramp = (0.55 * 0.55 + wide * wide).sqrt();
    let turn = |s: f32, v: Vec3| {
        let (ss, cs) = sin_cos(-e.sweep * smoothstep(0.0, ramp, s));
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
            let keep = 1.0 - smoothstep(0.0, grown, part);
            let mut section =
                Section { part, cup: cup(e, part), bend: self::bend(e, part), keep, ..Section::default() };
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
    let covered = covers(e);
    let base = Base::new(e, base);
    let mut sections = march(e, base.middle);
    let head = Obstacles { surface, eye: shape.eye(), radius: 1.35 * shape.eye_r };
    lay(e, &head, &base, &mut sections);
    clear(e, &head, &base, &mut sections);
    for (r, section) in sections.iter().enumerate() {
        let vertices: &[u16] = handles.a.get(r).map_or(&handles.ear_end, |ring| ring);
        let n = vertices.len();
        let half = n / 2;
        for (k, &v) in vertices.iter().enumerate() {
            let (column, face) = if k <= half { (k, -1.0) } else { (n - k, 1.0) };
            let mut p = section.at(e, &base, column * (PLACES - 1) / half, face);
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
const BURR: [(usize, usize, f32); 8] =
    [(0, 4, 0.02), (1, 2, 0.06), (1, 3, -0.05), (1, 4, 0.06), (2, 3, -0.04), (3, 2, 0.03), (3, 3, 0.05), (3, 4, 0.04)];

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

/// The fold of a leather that hangs: past straight down it goes no further than the head below it makes it.
fn hung(e: &EarProportions) -> f32 {
    let (fold, most) = (fold(e), e.lift + 1.65);
    let past = fold - most;
    let soft = 0.5 * (past + (past * past + 0.04).sqrt());
    fold - 0.75 * soft * covers(e)
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
/// falls over high in the air. A rose ear, which its own folds hold, lies less.
fn lies(e: &EarProportions, part: f32) -> f32 {
    let in_the_air = smoothstep(0.26, 0.42, e.fold_height);
    let hanging = covers(e) * (1.0 - in_the_air) * smoothstep(e.fold_height - 0.11, e.fold_height + 0.22, part);
    hanging + 0.6 * hang(e) * held(e) * smoothstep(e.fold_height - 0.11, e.fold_height + 0.4, part)
}

/// What the leather may not enter.
struct Obstacles<'a> {
    surface: &'a Implicit,
    eye: Vec3,
    /// Of the eye with its lids.
    radius: f32,
}

/// The nearer of two obstacles, each a distance and an outward normal, rounded where they are equally near.
fn nearer(a: (f32, Vec3), b: (f32, Vec3)) -> (f32, Vec3) {
    const ROUND: f32 = 0.5;
    let h = (0.5 + 0.5 * (b.0 - a.0) / ROUND).clamp(0.0, 1.0);
    (b.0 + (a.0 - b.0) * h - ROUND * h * (1.0 - h), b.1.lerp(a.1, h))
}

impl Obstacles<'_> {
    /// Distance and outward normal at two points: of the head, of its lids, and of the median plane.
    fn sample2(&self, a: Vec3, b: Vec3) -> [(f32, Vec3); 2] {
        let [sa, sb] = self.surface.sample2(a, b, Layer::Whole);
        [(a, sa), (b, sb)].map(|(p, (f, g))| {
            let from_eye = p - self.eye;
            let lids = (from_eye.length() - self.radius, from_eye.normalize_or_zero());
            nearer((p.x - APART, Vec3::X), nearer((f, g.normalize_or_zero()), lids))
        })
    }
}

/// Lays the leather on the head from its root to its tip: each ring turns the rest of the leather about the ring before it
/// until it clears the head, and where it hangs, until it lies on it. Lengths along the leather stay.
fn lay(e: &EarProportions, head: &Obstacles, base: &Base, sections: &mut [Section; SECTIONS]) {
    let (mut turned, mut free, mut before) = (Quat::IDENTITY, base.middle, base.middle);
    let mut roll = 0.0;
    for s in sections.iter_mut() {
        let (frame, own) = (s.frame, s.centre - free);
        free = s.centre;
        let length = own.length();
        let mut way = turned * own;
        let width = half_width(e, s.part).max(0.3);
        let sink = lies(e, s.part);
        for step in 0..LAYING {
            s.centre = before + way;
            let [across, along, outer] = frame.map(|v| turned * v);
            let across = (across - outer * roll).normalize_or(across);
            s.frame = [across, along, along.cross(across)];
            let mut near = [(0.0, Vec3::ZERO); 6];
            for (k, places) in [[0, 2], [6, 6], [10, 12]].into_iter().enumerate() {
                let faces = if k == 1 { [-1.0, 1.0] } else { [-1.0, -1.0] };
                let a = s.at(e, base, places[0], faces[0]);
                let b = s.at(e, base, places[1], faces[1]);
                [near[2 * k], near[2 * k + 1]] = head.sample2(a, b);
            }
            // What is deepest in the head counts most, and what is nearest to it, without a jump from one to another.
            let (mut deep, mut out, mut normal, mut nearest) = (0.0, Vec3::ZERO, Vec3::ZERO, f32::INFINITY);
            for (f, n) in near {
                let depth = (clearance(s.part) - f).max(0.0);
                (deep, out) = (deep + depth, out + n * (depth * depth));
                let apart = f.max(0.0) + 0.3;
                (normal, nearest) = (normal + n / (apart * apart * apart), nearest.min(f));
            }
            let (out, normal) = (out / deep.max(1e-4), normal.normalize_or_zero());
            let gap = nearest - clearance(s.part);
            // Weight: a hanging leather turns down where it is in the air, and glides to the head where that is beside it.
            let beside = vec3(normal.x, 0.0, normal.z) * smoothstep(-0.5, -0.1, normal.y);
            let glide = (gap / 3.0).clamp(0.0, 0.5) * length + way.dot(beside);
            let air = smoothstep(0.3, 2.0, gap);
            let weight = beside * (-0.5 * glide) + Vec3::NEG_Y * (0.3 * air * (length + way.y));
            let push = out + (weight * sink).clamp_length_max(0.1 * length);
            let push = push.clamp_length_max(0.7 * length);
            if step + 1 == LAYING {
                s.centre += push;
                break;
            }
            // Rings of the root, which are near to each other, rather move than turn.
            let lever = (1.0 - s.keep) * length / (length + 0.8 * e.base);
            let aim = (way + push * lever).normalize_or_zero();
            let turn = Quat::from_rotation_arc(way.normalize_or(aim), aim);
            turned = (turn * turned).normalize();
            // A hanging leather rolls until both margins are equally near.
            roll = (roll + ((near[5].0 - near[0].0) / (2.0 * width)).clamp(-0.6, 0.6) * 0.3 * sink).clamp(-0.8, 0.8);
            way = aim * length;
        }
        before = s.centre;
    }
}

/// Moves what is still in the head out of it, both faces of a place alike, so that the leather keeps its thickness.
fn clear(e: &EarProportions, head: &Obstacles, base: &Base, sections: &mut [Section; SECTIONS]) {
    for s in sections.iter_mut() {
        let least = 0.12 + 0.6 * clearance(s.part) + 0.2 * s.keep * covers(e);
        for _ in 0..2 {
            let mut push = [Vec3::ZERO; MIDDLE + 1];
            for (column, push) in push.iter_mut().enumerate() {
                let [inner, outer] = [-1.0, 1.0].map(|face| s.at(e, base, 2 * column, face));
                let [a, b] = head.sample2(inner, outer);
                let [da, db] = [a, b].map(|(f, _)| (least - f).max(0.0));
                *push = (a.1 * (da * da) + b.1 * (db * db)) / (da + db).max(1e-4);
            }
            for place in 0..PLACES {
                let (a, b) = (push[place / 2], push[place.div_ceil(2)]);
                s.push[place] += (a + b) * 0.5;
            }
        }
    }
}
