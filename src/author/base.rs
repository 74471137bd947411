//! The base head: a direct fit of the topology to the implicit head of the table's defaults.
//!
//! First guess: a Bézier curve across each ring from its dorsal station to its lip or cheek station, sent outwards to the
//! surface; then relaxation on the surface. Later heads start from this one, so it decides how evenly triangles lie.

use crate::math::ops;
use crate::rig::deform::{DeformPlan, Scratch, hollow, layers};
use crate::rig::handles::NONE;
use crate::rig::implicit::{Implicit, Layer};
use crate::rig::{HalfMesh, HalfRings, Handles, Proportions};
use glam::{Vec3, vec3};

const RELAX: usize = 80;

/// Lip, philtrum or cheek station (column 9) of the rings behind the mouth's corner, head units, default head: where the
/// cheek's flow should run. Rings in front have their pinned lip edge.
const CHEEK: [(f32, f32, f32); 9] = [
    (4.6, -6.1, -1.4),
    (5.2, -6.1, -2.6),
    (5.6, -6.1, -4.0),
    (5.6, -6.2, -5.6),
    (5.2, -6.5, -7.1),
    (4.9, -7.0, -8.6),
    (4.85, -7.7, -9.8),
    (4.9, -8.8, -11.1),
    (5.0, -10.1, -12.7),
];

fn bezier(p: [Vec3; 4], t: f32) -> Vec3 {
    let u = 1.0 - t;
    p[0] * (u * u * u) + p[1] * (3.0 * u * u * t) + p[2] * (3.0 * u * t * t) + p[3] * (t * t * t)
}

/// Where a vertex should go to stand evenly among its neighbours: their mean, the longer edges counting more, so that
/// vertices on the crest of a bump do not gather there.
fn even_mean(rings: &HalfRings, v: usize, at: &[Vec3]) -> Vec3 {
    let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
    for (u, across) in rings.of(v) {
        let p = if across { at[u] * vec3(-1.0, 1.0, 1.0) } else { at[u] };
        let edge = p - at[v];
        let w = edge.length_squared();
        sum += edge * w;
        weight += w;
    }
    sum / weight.max(1e-6)
}

/// Smallest angle of a triangle, radians.
fn smallest_angle(p: [Vec3; 3]) -> f32 {
    let corner = |k: usize| {
        let (a, b) = ((p[(k + 1) % 3] - p[k]).normalize_or_zero(), (p[(k + 2) % 3] - p[k]).normalize_or_zero());
        ops::acos(a.dot(b).clamp(-1.0, 1.0))
    };
    corner(0).min(corner(1)).min(corner(2))
}

/// Slides free vertices along the surface to wherever the smallest angle around them is larger: a search by halving
/// steps in eight directions, a fixed number of sweeps.
fn open_angles(
    half: &HalfMesh,
    plan: &DeformPlan,
    surface: &Implicit,
    free: &std::collections::BTreeSet<u16>,
    at: &mut [Vec3],
) {
    let mut around: Vec<Vec<[usize; 3]>> = vec![Vec::new(); at.len()];
    for f in &half.faces {
        let f = f.map(usize::from);
        for v in f {
            around[v].push(f);
        }
    }
    let layer = layers(plan.handles(), at.len());
    let quality = |at: &[Vec3], v: usize| {
        let (_, outward) = surface.sample(at[v], layer[v]);
        let angle = |f: &[usize; 3]| {
            let p = f.map(|u| at[u]);
            // A triangle turned over counts as worse than any sliver.
            let turned = (p[1] - p[0]).cross(p[2] - p[0]).dot(outward) < 0.0;
            smallest_angle(p) - if turned { 1.0 } else { 0.0 }
        };
        around[v].iter().map(angle).fold(f32::INFINITY, f32::min)
    };
    for sweep in 0..12 {
        let step = if sweep % 4 == 3 { 0.05 } else { 0.12 };
        for &v in free {
            let v = v as usize;
            let (_, g) = surface.sample(at[v], layer[v]);
            let normal = g.normalize_or(Vec3::Y);
            let (a, b) = normal.any_orthonormal_pair();
            let mut best = (quality(at, v), at[v]);
            if best.0 > 0.22 {
                continue;
            }
            let here = at[v];
            for k in 0..8 {
                let turn = core::f32::consts::TAU * k as f32 / 8.0;
                let mut p = here + (a * ops::cos(turn) + b * ops::sin(turn)) * step;
                if half.midline[v] {
                    p.x = 0.0;
                } else if p.x < 0.05 {
                    continue;
                }
                at[v] = surface.project(p, layer[v], 2);
                if half.midline[v] {
                    at[v].x = 0.0;
                }
                let q = quality(at, v);
                if q > best.0 + 1e-4 {
                    best = (q, at[v]);
                }
            }
            at[v] = best.1;
        }
    }
}

/// Fitted positions of the half mesh for `shape`, before ear leather and limit compensation.
pub fn fit(half: &HalfMesh, handles: &Handles, shape: &Proportions) -> Vec<[f32; 3]> {
    let plan = DeformPlan::new(half, handles.clone(), shape);
    let surface = Implicit::new(shape);
    let mut at = vec![Vec3::ZERO; half.n_half()];
    plan.place_features(shape, &surface, &mut at);
    let free: std::collections::BTreeSet<u16> = plan.fit().free().iter().copied().collect();
    let pinned = at.clone();
    for i in 1..20 {
        let top = at[handles.s[i][0] as usize];
        let side = if i <= 10 { at[handles.s[i][9] as usize] } else { CHEEK[i - 11].into() };
        let layer = if i <= 10 { Layer::Upper } else { Layer::Whole };
        let w = top.distance(side);
        let curve = [
            top,
            top + vec3((0.9 * side.x).max(0.55 * w), 0.15 * w, 0.0),
            side + (top - side) * 0.35 + vec3(0.35 * w, 0.0, 0.0),
            side,
        ];
        let middle = vec3(0.0, 0.5 * (top.y + side.y), 0.5 * (top.z + side.z));
        for j in 1..10 {
            let v = handles.s[i][j];
            if v != NONE && free.contains(&v) {
                let guess = bezier(curve, j as f32 / 9.0);
                at[v as usize] = surface.exit(middle, guess, layer, 3.0);
            }
        }
        if i < 4 {
            continue;
        }
        let (lip, bottom) = (at[handles.l[i][9] as usize], at[handles.l[i][14] as usize]);
        let layer = if i <= 10 { Layer::Lower } else { Layer::Whole };
        let knee = vec3(lip.x, 0.35 * lip.y + 0.65 * bottom.y, 0.5 * (lip.z + bottom.z));
        let middle = vec3(0.0, 0.5 * (lip.y + bottom.y), 0.5 * (lip.z + bottom.z));
        for j in 10..14 {
            let v = handles.l[i][j];
            if free.contains(&v) {
                let t = (j - 9) as f32 / 5.0;
                let guess = bezier([lip, lip + (knee - lip) * 0.67, bottom + (knee - bottom) * 0.67, bottom], t);
                at[v as usize] = surface.exit(middle, guess, layer, 3.0);
            }
        }
    }
    let layer = layers(handles, at.len());
    for _ in 0..RELAX {
        let before = at.clone();
        for &v in &free {
            let v = v as usize;
            // Along the surface only: across it the projection would fold what the mean has pulled through an edge.
            let pull = even_mean(plan.rings(), v, &before) * 0.4;
            let normal = surface.sample(before[v], layer[v]).1.normalize_or_zero();
            at[v] = before[v] + pull - normal * (0.85 * normal.dot(pull));
            if half.midline[v] {
                at[v].x = 0.0;
            }
        }
        plan.fit().keep_orbit(&mut at, shape.eye_r);
        plan.fit().project(&surface, &mut at);
        plan.fit().project(&surface, &mut at);
        for v in hollow(handles) {
            at[v as usize] = surface.project(at[v as usize], Layer::Upper, 2);
        }
    }
    for v in (0..at.len()).filter(|&v| !free.contains(&(v as u16))) {
        at[v] = pinned[v];
    }
    open_angles(half, &plan, &surface, &free, &mut at);
    // The leather's base shape is never read but for its place near the head; give it the finished one.
    let mut finished = at.clone();
    plan.finish(shape, &surface, &mut Scratch::default(), &mut finished);
    for &v in handles.a.iter().flatten().chain(&handles.ear_end) {
        at[v as usize] = finished[v as usize];
    }
    at.into_iter().map(|p| p.to_array()).collect()
}
