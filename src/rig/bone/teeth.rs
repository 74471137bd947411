//! Forty-two teeth: the adult formula I3/3 C1/1 P4/4 M2/3, each a crown of its own size on the arch of its jaw.

use super::landmarks::Targets;
use crate::math::ops;
use glam::{Vec3, vec3};

/// What kind a tooth is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ToothKind {
    /// Cuts.
    Incisor,
    /// Holds.
    Canine,
    /// Shears.
    Premolar,
    /// The shearing pair: the fourth upper premolar and the first lower molar.
    Carnassial,
    /// Grinds.
    Molar,
}

/// One tooth of the left half.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tooth {
    /// `I1` to `M2` above, `i1` to `m3` below.
    pub name: &'static str,
    /// Its kind.
    pub kind: ToothKind,
    /// Crown at a skull of 200 mm, millimetres: along the arch, across it, and its height.
    pub size: Vec3,
}

const fn tooth(name: &'static str, kind: ToothKind, along: f32, across: f32, height: f32) -> Tooth {
    Tooth { name, kind, size: Vec3::new(along, across, height) }
}

use ToothKind::{Canine, Carnassial, Incisor, Molar, Premolar};

/// The upper left teeth from the middle backwards; sizes are estimates for a mesaticephalic dog of 30 kg.
pub const UPPER: [Tooth; 10] = [
    tooth("I1", Incisor, 4.5, 5.0, 7.5),
    tooth("I2", Incisor, 5.0, 5.5, 8.5),
    tooth("I3", Incisor, 6.0, 6.5, 11.0),
    tooth("C", Canine, 10.5, 7.0, 21.0),
    tooth("P1", Premolar, 6.0, 4.0, 5.5),
    tooth("P2", Premolar, 11.0, 5.0, 7.5),
    tooth("P3", Premolar, 13.0, 5.5, 8.5),
    tooth("P4", Carnassial, 19.0, 9.0, 11.5),
    tooth("M1", Molar, 13.0, 15.0, 7.5),
    tooth("M2", Molar, 7.5, 10.5, 4.5),
];
/// The lower left teeth likewise.
pub const LOWER: [Tooth; 11] = [
    tooth("i1", Incisor, 3.6, 4.5, 6.5),
    tooth("i2", Incisor, 4.4, 5.0, 7.5),
    tooth("i3", Incisor, 5.0, 5.5, 8.5),
    tooth("c", Canine, 10.0, 7.0, 19.5),
    tooth("p1", Premolar, 5.0, 3.5, 4.5),
    tooth("p2", Premolar, 9.0, 5.0, 6.5),
    tooth("p3", Premolar, 10.5, 5.5, 7.5),
    tooth("p4", Premolar, 12.0, 6.0, 9.0),
    tooth("m1", Carnassial, 22.0, 8.5, 13.0),
    tooth("m2", Molar, 9.0, 7.0, 5.5),
    tooth("m3", Molar, 5.0, 4.5, 3.5),
];

const SEGMENTS: usize = 14;
/// Distance from the crown's middle, rim to apex; the first ring is the root, buried in the bone.
const RINGS: [f32; 7] = [0.7, 1.0, 0.86, 0.66, 0.44, 0.22, 0.08];

/// Vertices of one tooth.
pub const TOOTH_VERTICES: usize = RINGS.len() * SEGMENTS + 1;

/// Triangles of one tooth, counter-clockwise from outside. One that hangs down is mirrored, and so is one of the right side.
pub(super) fn indices(first: u32, mirrored: bool, out: &mut Vec<u32>) {
    let mut add = |[a, b, c]: [u32; 3]| out.extend(if mirrored { [a, c, b] } else { [a, b, c] }.map(|v| first + v));
    let n = SEGMENTS as u32;
    for ring in 0..RINGS.len() as u32 - 1 {
        for s in 0..n {
            let (a, b) = (ring * n + s, ring * n + (s + 1) % n);
            add([a, b, b + n]);
            add([a, b + n, a + n]);
        }
    }
    let last = (RINGS.len() as u32 - 1) * n;
    (0..n).for_each(|s| add([last + s, last + (s + 1) % n, last + n]));
}

/// Height of a cusp at `at` whose edges run down over `reach` to both sides; its tip is worn round.
fn blade(u: f32, at: f32, reach: f32) -> f32 {
    let t = (u - at).abs() / reach;
    (1.06 - ops::sqrt(0.015 + t * t)).max(0.0)
}

/// Of a cusp's height, at a place across the crown: full at the edge, rounded off to the neck.
fn side(v: f32) -> f32 {
    1.0 - v * v * (0.55 + 0.45 * v * v)
}

/// Height of a crown as a part of it, at a place in its outline: `u` along the arch, forwards, `v` across.
fn crown(kind: ToothKind, u: f32, v: f32) -> f32 {
    let r = (u * u + v * v).sqrt().min(1.0);
    let rim = 1.0 - r * r * r * r;
    // A blade rises steeply from its neck.
    let neck = rim * (2.0 - rim);
    match kind {
        Incisor => rim * (1.0 - 0.25 * u * u) * (1.0 - 0.35 * r),
        Canine => ops::powf(1.0 - r, 0.85),
        // Blades: a cusp whose edges run down to both ends of the crown, and a lower one behind it.
        Premolar => neck * (blade(u, 0.08, 1.0) * 0.96).max(blade(u, -0.62, 0.5) * 0.5) * side(v),
        Carnassial => {
            neck * blade(u, 0.1, 0.72).max(blade(u, -0.55, 0.62) * 0.74).max(blade(u, 0.72, 0.45) * 0.5) * side(v)
        }
        Molar => rim * (0.7 + 0.25 * ops::cos(4.8 * u) * (1.0 - v * 0.6)),
    }
}

/// Where a tooth of the left half stands. Metres, head's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seat {
    /// Which tooth it is.
    pub tooth: &'static Tooth,
    /// Middle of the neck, [`SUNK`] below the bone's rim.
    pub root: Vec3,
    /// Unit axes: along the crown, forwards; across it, outwards; towards its tip.
    pub axes: [Vec3; 3],
    /// The crown as it is on this head: along, across, height.
    pub size: Vec3,
    /// From the middle of the neck outwards to the landmarks of the bone.
    pub inset: f32,
}

/// How far a neck is sunk into the bone's rim, canonical millimetres.
pub const SUNK: f32 = 2.2;

/// A canonical millimetre on a head with these landmarks: crowns follow the length of the skull.
pub fn unit(t: &Targets<Vec3>) -> f32 {
    t.prosthion.distance(t.akrokranion) / 200.0
}

/// Incisors of half a jaw.
const INCISORS: usize = 3;
/// Where the lower front ends, as a part of the way from infradentale to the canine.
pub(super) const LOWER_FRONT: f32 = 0.6;

/// Where an incisor's middle stands between the median plane and that of the third.
fn front_share(teeth: &[Tooth], i: usize) -> f32 {
    let front: f32 = teeth[..INCISORS].iter().map(|t| t.size.x).sum();
    let before: f32 = teeth[..i].iter().map(|t| t.size.x).sum();
    (before + 0.5 * teeth[i].size.x) / (front - 0.5 * teeth[INCISORS - 1].size.x)
}

/// Where the edge of a first incisor stands: the part of the way along the arch's front from its middle, and how far behind
/// the arch, canonical millimetres.
pub(super) fn first_edge(upper: bool) -> (f32, f32) {
    let teeth: &[Tooth] = if upper { &UPPER } else { &LOWER };
    (front_share(teeth, 0), 0.5 * teeth[0].size.y)
}

/// The middle of the edge of the left first incisor, of a jaw's teeth as [`place`] makes them or an interpolating scheme
/// refines them; nothing where there are no teeth.
pub fn edge_of_first(teeth: &[Vec3]) -> Option<Vec3> {
    teeth.get(TOOTH_VERTICES - 1).copied()
}

/// The seats of one jaw's left teeth, from the middle backwards.
pub fn seats(t: &Targets<Vec3>, upper: bool) -> Vec<Seat> {
    let unit = unit(t);
    let (teeth, arch): (&'static [Tooth], [Vec3; 5]) = if upper {
        (&UPPER, [t.prosthion, t.incisor, t.canine, t.maxilla, t.upper_last])
    } else {
        let side = t.infradentale.lerp(t.lower_canine, LOWER_FRONT);
        (
            &LOWER,
            [t.infradentale, vec3(side.x, t.infradentale.y, side.z), t.lower_canine, t.lower_carnassial, t.lower_last],
        )
    };
    let down = if upper { -1.0 } else { 1.0 };
    // Incisors share the front; from the canine on each tooth has its place between the landmarks.
    let canine = INCISORS;
    let carnassial = teeth.iter().position(|t| t.kind == Carnassial).unwrap_or(canine);
    let n = teeth.len();
    let seat = |(i, tooth): (usize, &'static Tooth)| {
        let size = tooth.size * unit;
        // Sum of the crowns from one tooth's middle to another's, in front of this one.
        let run = |from: usize, to: usize| -> f32 {
            (from..to).map(|k| 0.5 * (teeth[k].size.x + teeth[k + 1].size.x)).sum::<f32>()
        };
        let (a, b, share, room) = match i {
            _ if i < canine => (arch[0], arch[1], front_share(teeth, i), 1.0),
            _ if i <= carnassial => {
                let room = arch[2].distance(arch[3]) / (run(canine, carnassial) * unit);
                (arch[2], arch[3], run(canine, i) / run(canine, carnassial), room)
            }
            _ => {
                let room = arch[3].distance(arch[4]) / (run(carnassial, n - 1) * unit);
                (arch[3], arch[4], run(carnassial, i) / run(carnassial, n - 1), room)
            }
        };
        let at = a.lerp(b, share.min(1.15));
        // Along the arch towards the front, and outwards.
        let mut forwards = (a - b).normalize_or(Vec3::Z);
        if i < canine {
            forwards = vec3(-1.0, 0.0, 0.25).normalize();
        }
        // Where the arch is too short for its premolars they turn, up to across.
        let turns = i > canine && i < carnassial;
        let crowded = if turns { room.clamp(0.35, 1.0) } else { 1.0 };
        let turn = ops::acos(crowded);
        let up = Vec3::Y * down;
        let sideways = Vec3::Y.cross(forwards).normalize_or(Vec3::X);
        let sideways = if sideways.x < 0.0 { -sideways } else { sideways };
        let (sin, cos) = (ops::sin(turn), ops::cos(turn));
        let along = forwards * cos + sideways * sin;
        let across = sideways * cos - forwards * sin;
        // Teeth that are too many for their place get smaller at last.
        let fit = if i > canine { (room * 1.25).clamp(0.6, 1.0) } else { 1.0 };
        let size = vec3(size.x * fit, size.y * fit, size.z);
        let inwards = match tooth.kind {
            Incisor => vec3(0.0, 0.0, -0.5 * size.y),
            Canine => -across * (if upper { 0.85 } else { 0.65 } * size.y),
            _ => -across * (0.55 * size.y + 2.0 * unit),
        };
        let root = at + inwards - up * (SUNK * unit);
        Seat { tooth, root, axes: [along, across, up], size, inset: inwards.length() }
    };
    teeth.iter().enumerate().map(seat).collect()
}

/// The teeth of one jaw of one head: left ones, then their mirror images; `out` gets [`TOOTH_VERTICES`] for each.
pub fn place(t: &Targets<Vec3>, upper: bool, out: &mut Vec<Vec3>) {
    out.clear();
    for Seat { tooth, root, axes, size, .. } in seats(t, upper) {
        for (ring, &r) in RINGS.iter().enumerate() {
            for s in 0..SEGMENTS {
                let angle = core::f32::consts::TAU * s as f32 / SEGMENTS as f32;
                let at = [r * ops::cos(angle), r * ops::sin(angle)];
                out.push(root + point(tooth, size, axes, at, ring == 0));
            }
        }
        out.push(root + point(tooth, size, axes, [0.0; 2], false));
    }
    for k in 0..out.len() {
        let p = out[k];
        out.push(vec3(-p.x, p.y, p.z));
    }
}

/// How the crown of a lower canine leans forwards, curves back and leans outwards, parts of its height.
const LOWER_CANINE: [f32; 3] = [0.36, 0.28, 0.10];

/// A point of a crown, from its root: at `u` along the arch and `v` across.
fn point(tooth: &Tooth, size: Vec3, axes: [Vec3; 3], [u, v]: [f32; 2], is_root: bool) -> Vec3 {
    let [along, across, up] = axes;
    let height = if is_root { -0.16 } else { crown(tooth.kind, u, v) };
    let mut p = along * (0.5 * size.x * u) + across * (0.5 * size.y * v) + up * (size.z * height);
    if tooth.kind == Canine {
        // The crown leans forwards and curves back; the lower one outwards too, and forwards, to pass before the upper one.
        let t = height.max(0.0);
        let [lean, curve, outwards] = if up.y < 0.0 { [0.20, 0.30, 0.05] } else { LOWER_CANINE };
        p += along * (size.z * (lean * t - curve * t * t)) + across * (size.z * outwards * t);
    }
    p
}
