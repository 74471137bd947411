//! The ear: a base on the skull, and a leather that is evaluated anew for every setting. It is a bent, swept, cupped
//! strip of thirteen measures, laid over the head without touching it: a linear blend between a pricked and a hanging
//! ear would collapse half way, the measures in between are an ear.

use super::{Pins, sin_cos};
use crate::math::ops;
use crate::rig::implicit::{Implicit, Layer};
use crate::rig::proportions::{EarProportions, Proportions};
use glam::{Vec3, vec3};

const STEPS: usize = 48;
/// Where along the leather the rings stand.
const RINGS: [f32; 6] = [0.07, 0.20, 0.38, 0.58, 0.78, 0.955];
/// Gap between leather and skin, head units.
const CLEAR: [f32; 6] = [0.05, 0.14, 0.24, 0.28, 0.30, 0.30];

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

/// The loop on the skull from which the leather rises.
pub(super) fn place_base(pins: &mut Pins) {
    let e = &pins.shape.ear;
    let [_, across, outer] = axes(e);
    let centre = pins.surface.project(e.set, Layer::Whole, 6);
    let normal = pins.surface.sample(centre, Layer::Whole).1.normalize_or(Vec3::Y);
    let along = (across - normal * normal.dot(across)).normalize_or(Vec3::NEG_Z);
    let side = normal.cross(along);
    let inner = if side.dot(outer) > 0.0 { -side } else { side };
    for k in 0..12 {
        let (sin, cos) = sin_cos(core::f32::consts::TAU * k as f32 / 12.0);
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

struct Section {
    centre: Vec3,
    across: Vec3,
    outer: Vec3,
}

/// Centre line and axes at the rings.
fn march(e: &EarProportions, root: Vec3) -> [Section; 6] {
    let [out, across, outer] = axes(e);
    let fold = fold(e);
    let mut p = root;
    let mut ring = 0;
    let section = |p: Vec3, s: f32| {
        let soft = e.fold_softness.max(0.02);
        let bend = fold * smoothstep(e.fold_height - soft, e.fold_height + soft, s);
        let (sb, cb) = sin_cos(bend);
        // The sweep turns the leather about the transverse axis: back for rose ears, forward for button ears.
        let (ss, cs) = sin_cos(-e.sweep * smoothstep(0.0, 0.55, s));
        let turn = |v: Vec3| vec3(v.x, v.y * cs - v.z * ss, v.y * ss + v.z * cs);
        let dir = turn(out * cb - outer * sb);
        let across = turn(across);
        (dir, Section { centre: p, across, outer: dir.cross(across) })
    };
    let mut sections: [Option<Section>; 6] = Default::default();
    for n in 0..STEPS {
        let s = (n as f32 + 0.5) / STEPS as f32;
        let (dir, here) = section(p, s);
        if ring < 6 && s + 0.5 / STEPS as f32 >= RINGS[ring] {
            sections[ring] = Some(here);
            ring += 1;
        }
        p += dir * (e.length / STEPS as f32);
    }
    sections.map(|s| s.unwrap_or(Section { centre: p, across, outer }))
}

/// Position in a section: `u` from the front (-1) to the rear margin (1), on the outer (1) or inner (-1) face.
fn in_section(e: &EarProportions, s: &Section, part: f32, u: f32, face: f32) -> Vec3 {
    let hw = half_width(e, part).max(0.5 * e.thickness);
    let thick = 0.5 * e.thickness * (1.0 - 0.35 * part);
    let bulge = e.cup * hw * (0.5 - u * u);
    let wall = thick * (1.0 - ops::powf(u.abs(), 2.5));
    s.centre + s.across * (hw * u) + s.outer * (bulge + face * wall)
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
    let hang = hang(e);
    drape(e, surface, &mut sections);
    for (r, section) in sections.iter().enumerate() {
        let part = RINGS[r];
        let vertices: &[u16] = if r < 5 { &handles.a[r] } else { &handles.a5 };
        let n = vertices.len();
        let half = n / 2;
        for (k, &v) in vertices.iter().enumerate() {
            let (u, face) = if k <= half {
                (2.0 * k as f32 / half as f32 - 1.0, -1.0)
            } else {
                (1.0 - 2.0 * (k - half) as f32 / half as f32, 1.0)
            };
            let mut p = in_section(e, section, part, u, face);
            if r < 3 {
                // The leather grows out of its base; the inner face stays hollow, as the concha is.
                let hold = if face < 0.0 && k != 0 && k != half { 0.45 + 0.4 * hang } else { 0.85 };
                let rise = section.centre - root;
                let keep = hold * (1.0 - smoothstep(0.0, 0.32, part));
                p = p + (base[k] + rise - p) * keep;
            }
            at[v as usize] = p;
        }
    }
}

/// How much the leather hangs: 0 pricked, 1 folded over.
fn hang(e: &EarProportions) -> f32 {
    smoothstep(0.9, 1.5, fold(e))
}

/// The fold with gravity: a leather that is neither stiff enough to stand nor folded over sinks further than its measure
/// says, as a half-pricked ear does, and does not stick out to the side.
fn fold(e: &EarProportions) -> f32 {
    let over = smoothstep(0.0, 1.6, e.fold);
    e.fold + 3.6 * over * (1.0 - over)
}

/// Moves whole sections along the skin's gradient until the inner face clears the head; leather that is folded over
/// also sinks until it lies on the head.
fn drape(e: &EarProportions, surface: &Implicit, sections: &mut [Section; 6]) {
    let hang = hang(e);
    for _ in 0..6 {
        let mut moves = [Vec3::ZERO; 6];
        for (r, s) in sections.iter_mut().enumerate() {
            let (_, g) = surface.sample(s.centre, Layer::Whole);
            let normal = g.normalize_or_zero();
            let mut gaps = [0.0; 6];
            for (k, us) in [[-1.0, -0.6], [-0.2, 0.2], [0.6, 1.0]].into_iter().enumerate() {
                let [a, b] = us.map(|u| in_section(e, s, RINGS[r], u, -1.0));
                let [a, b] = surface.sample2(a, b, Layer::Whole);
                (gaps[2 * k], gaps[2 * k + 1]) = (a.0, b.0);
            }
            let nearest = gaps.iter().fold(f32::INFINITY, |n, &g| n.min(g));
            let gap = CLEAR[r] - nearest;
            let sink = hang * smoothstep(0.02, 0.35, RINGS[r]);
            // A hanging leather turns until both margins are equally near.
            let width = half_width(e, RINGS[r]).max(0.3);
            let lean = ((gaps[5] - gaps[0]) / (2.0 * width)).clamp(-0.6, 0.6) * 0.35 * sink;
            let along = s.across.cross(s.outer);
            s.across = (s.across - s.outer * lean).normalize_or(s.across);
            s.outer = along.cross(s.across);
            moves[r] = normal * if gap > 0.0 { gap } else { gap * 0.5 * sink };
        }
        for r in 0..6 {
            let (before, after) = (moves[r.max(1) - 1], moves[(r + 1).min(5)]);
            sections[r].centre += (moves[r] * 0.6 + (before + after) * 0.2).clamp_length_max(0.7);
        }
    }
}
