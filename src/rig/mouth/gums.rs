//! Gums, palate and floor of the mouth: one closed body for each jaw, whose ribs run from the outer side of the bone over
//! the necks of the teeth to the median plane and back inside the bone.
//!
//! The palate carries nine transverse ridges between the canine and the last molar, bowed forwards (nine to ten: Crompton
//! and Musinsky 2011). Heights are reckoned from the necks towards the teeth's tips, canonical millimetres.

use super::HalfBody;
use super::arch::{Arch, PARTS, RIBS, Rib};
use crate::rig::bone::BoneField;
use glam::{Vec3, vec3};

/// Transverse ridges of the palate.
pub const N_RUGAE: usize = 9;
/// Ribs from one ridge to the next.
const PERIOD: usize = 4;
/// The rib of the first ridge.
const FIRST: usize = PARTS[0] + 1;
/// How far a ridge stands out at most, canonical millimetres.
const RIDGE: f32 = 0.9;

/// How far the outer wall reaches down from the necks, upper and lower, canonical millimetres: to where the lips begin, so
/// that nobody looks under it when they part.
const SKIRT: [f32; 2] = [9.0, 10.0];
/// How far the lower wall reaches down on its way to the chin's skin: below the lining of the lip.
const TO_CHIN: f32 = 0.6;
/// Longest such way, canonical millimetres, and in how many steps it is gone.
const CHIN: (f32, usize) = (60.0, 24);
/// Gum over bone at least, canonical millimetres.
const COVER: f32 = 1.2;
/// Skin over gum at least, head units.
pub(super) const LEAST_TISSUE: f32 = 0.1;

/// How far the sulcus, the outer wall and the rest go off the bone at most, canonical millimetres: gum ends on the bone.
const FARTHEST: [f32; 3] = [1.2, 2.2, 5.0];

/// Columns over the gum, from outside: sulcus, outer wall, shoulder, margin, between the teeth, margin, foot.
const GUM: usize = 7;
/// Columns from the gum's foot to the median plane.
const VAULT: usize = 7;
/// Columns of a rib that are seen.
const COLUMNS: usize = GUM + VAULT;

/// What a vertex of the mouth is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tissue {
    /// Around the teeth.
    Gum,
    /// The roof, with its ridges.
    Palate,
    /// Under the tongue.
    Floor,
    /// The tongue's back, rough.
    Tongue,
    /// Its smooth underside.
    TongueUnder,
}

/// Parts of a gum that lie under the skin of the lips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wall {
    /// From the sulcus up.
    Outer,
    /// Over the necks of the teeth.
    Shoulder,
}

fn seen(rib: usize, column: usize) -> usize {
    rib * COLUMNS + column
}

/// A vertex of the side that lies in the bone; it shares the outermost column with the side that is seen.
fn hidden(rib: usize, column: usize) -> usize {
    if column == 0 { seen(rib, 0) } else { RIBS * COLUMNS + rib * (COLUMNS - 1) + column - 1 }
}

/// Topology of the lower body; the upper one is the same turned over.
pub(super) fn body() -> HalfBody {
    let n = RIBS * (2 * COLUMNS - 1);
    let mut body = HalfBody { midline: vec![false; n], faces: Vec::new(), tissue: vec![Tissue::Gum; n] };
    for k in 0..RIBS {
        for c in 0..COLUMNS {
            let middle = k == 0 || c == COLUMNS - 1;
            let tissue = if c + 1 < GUM { Tissue::Gum } else { Tissue::Floor };
            for v in [seen(k, c), hidden(k, c)] {
                body.midline[v] |= middle;
                body.tissue[v] = tissue;
            }
        }
    }
    for k in 0..RIBS - 1 {
        for c in 0..COLUMNS - 1 {
            body.cell([seen(k, c), seen(k + 1, c), seen(k + 1, c + 1), seen(k, c + 1)]);
            body.cell([hidden(k, c), hidden(k, c + 1), hidden(k + 1, c + 1), hidden(k + 1, c)]);
        }
    }
    // The end at the throat.
    let k = RIBS - 1;
    for c in 0..COLUMNS - 1 {
        if c == 0 {
            body.faces.push([seen(k, 0), hidden(k, 1), seen(k, 1)].map(|v| v as u16));
        } else {
            body.cell([seen(k, c), hidden(k, c), hidden(k, c + 1), seen(k, c + 1)]);
        }
    }
    body
}

fn smoothstep(a: f32, b: f32, x: f32) -> f32 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// How far the palate's ridges stand out on a rib, 0 to 1.
fn ridge(rib: usize) -> f32 {
    let last = FIRST + PERIOD * (N_RUGAE - 1);
    if rib + 1 < FIRST || rib > last + 1 {
        return 0.0;
    }
    match (rib + PERIOD - FIRST) % PERIOD {
        0 => 1.0,
        2 => 0.0,
        _ => 0.35,
    }
}

/// Positions of the half (metres) over that bone; `under` keeps a point under the skin, the wall deeper than the shoulder,
/// and `inside` says whether one is.
pub(super) fn place(
    arch: &Arch,
    unit: f32,
    bone: &BoneField,
    under: impl Fn(Vec3, Wall) -> Vec3,
    inside: impl Fn(Vec3) -> bool,
    out: &mut Vec<Vec3>,
) {
    out.clear();
    out.resize(RIBS * (2 * COLUMNS - 1), Vec3::ZERO);
    let height = |h: f32| vec3(0.0, arch.up * h, 0.0);
    for k in 0..RIBS {
        plain(arch, k, unit).into_iter().enumerate().for_each(|(c, p)| out[seen(k, c)] = p);
        if arch.up > 0.0 {
            // A lip may hang far below its jaw.
            let from = out[seen(k, 1)];
            let step = CHIN.0 / CHIN.1 as f32;
            let far = (1..=CHIN.1).rfind(|&i| inside(from - height(step * unit * i as f32))).unwrap_or(0);
            let sulcus = &mut out[seen(k, 0)];
            // Behind the corner of the mouth nobody looks.
            let seen = 1.0 - smoothstep(0.5, 0.8, k as f32 / (RIBS - 1) as f32);
            sulcus.y = sulcus.y.min(from.y - TO_CHIN * seen * step * far as f32 * unit);
        }
    }
    // Off the bone: outwards at the sides, towards the teeth's tips elsewhere. Neighbours go along, so that it stays even.
    for c in (0..COLUMNS).filter(|&c| c != 4) {
        let way = |rib: &Rib| match c {
            0 | 1 => rib.outwards,
            2 => (rib.outwards + height(1.0)).normalize(),
            _ => height(1.0),
        };
        let mut moves: Vec<f32> = arch
            .ribs
            .iter()
            .enumerate()
            .map(|(k, r)| clear(out[seen(k, c)], way(r), bone, unit).min(FARTHEST[c.min(2)] * unit))
            .collect();
        for _ in 0..3 {
            let before = moves.clone();
            for k in 1..RIBS - 1 {
                moves[k] = before[k].max(0.25 * (before[k - 1] + 2.0 * before[k] + before[k + 1]));
            }
        }
        for (k, rib) in arch.ribs.iter().enumerate() {
            out[seen(k, c)] += way(rib) * moves[k];
        }
    }
    for k in 0..RIBS {
        // Never past the skin of the lips.
        for c in 0..4 {
            let wall = if c < 2 { Wall::Outer } else { Wall::Shoulder };
            out[seen(k, c)] = under(out[seen(k, c)], wall);
        }
        if arch.up < 0.0 {
            for c in 0..VAULT {
                let t = (c + 1) as f32 / VAULT as f32;
                let ridge = RIDGE * ridge(k) * smoothstep(0.0, 0.35, t) * (1.0 - 0.6 * smoothstep(0.8, 1.0, t));
                out[seen(k, GUM + c)] += height(ridge * unit);
            }
        }
        // The way back, inside the bone.
        let (outer, end) = (out[seen(k, 0)], out[seen(k, COLUMNS - 1)] - height(2.2 * unit));
        for c in 1..COLUMNS {
            let t = c as f32 / (COLUMNS - 1) as f32;
            let mut p = outer.lerp(end, t);
            // Below what is seen, everywhere; deeper over the necks.
            let least = if (2..GUM).contains(&c) { 5.0 } else { 1.2 };
            let over = arch.up * (p.y - out[seen(k, c)].y) + least * unit;
            if over > 0.0 {
                p.y -= arch.up * over;
            }
            out[hidden(k, c)] = p;
        }
    }
}

/// What is seen of a rib, before it keeps off the bone.
fn plain(arch: &Arch, k: usize, unit: f32) -> [Vec3; COLUMNS] {
    let height = |h: f32| vec3(0.0, arch.up * h, 0.0);
    let rib = arch.ribs[k];
    let Rib { neck, middle, outwards, half, bone, margin } = rib;
    let wall = (bone + if arch.up > 0.0 { 0.8 } else { 1.4 } * unit).max(half + 1.6 * unit);
    let inner = (neck - middle).length();
    let along = k as f32 / (RIBS - 1) as f32;
    // Behind the corner of the mouth cheeks lie close.
    let skirt = if arch.up > 0.0 { SKIRT[1] } else { SKIRT[0] } * (1.0 - 0.65 * smoothstep(0.55, 0.9, along));
    // Never past the median plane.
    let edge = rib.edge(unit);
    let edge_in = edge.min(0.55 * inner);
    let foot = (edge + 2.2 * unit).min(0.75 * inner);
    // Inside the teeth the rib runs to the median plane.
    let inwards = (middle - neck).normalize_or(-outwards);
    let mut out = [neck; COLUMNS];
    let gum = [
        outwards * (if arch.up > 0.0 { 0.65 } else { 1.0 } * wall) - height(skirt * unit),
        // Close to the necks above, or the teeth of the other jaw would be behind it.
        outwards * (0.25 * edge + 0.75 * wall) - height(3.5 * unit),
        outwards * (0.80 * edge + 0.20 * wall) + height(0.6 * margin),
        outwards * edge + height(margin),
        height(margin),
        inwards * edge_in + height(margin),
        inwards * foot + height(1.2 * unit),
    ];
    gum.into_iter().enumerate().for_each(|(c, offset)| out[c] += offset);
    let foot = out[GUM - 1];
    let deep = if arch.up < 0.0 {
        2.6 * smoothstep(0.08, 0.3, along) * (1.0 - 0.5 * smoothstep(0.7, 1.0, along))
    } else {
        // Under the tongue; the symphysis lies high in front.
        0.6 + 4.4 * smoothstep(0.1, 0.3, along)
    };
    for c in 0..VAULT {
        let t = (c + 1) as f32 / VAULT as f32;
        // Across: flat in the middle, steeper at the gum.
        let across = 1.0 - (1.0 - t) * (1.0 - t);
        let flat = vec3(foot.x * (1.0 - t), foot.y, foot.z + (middle.z - foot.z) * across);
        out[GUM + c] = flat - height(deep * across * unit);
    }
    out
}

/// How far a point goes along a way to be clear of the bone by [`COVER`].
fn clear(p: Vec3, way: Vec3, bone: &BoneField, unit: f32) -> f32 {
    let mut moved = 0.0;
    for _ in 0..3 {
        let (d, g) = bone.sample(p + way * moved, 0.1 * unit);
        let over = COVER * unit - d;
        if over <= 0.0 {
            break;
        }
        moved = (moved + over / g.dot(way).max(0.4)).min(5.0 * unit);
    }
    moved
}
