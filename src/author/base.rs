//! The base head: a direct fit of the topology to the implicit head of the table's defaults.
//!
//! First guess: a Bézier curve across each ring from its dorsal station to its lip or cheek station, sent outwards to the
//! surface; then relaxation on the surface. Later heads start from this one, so it decides how evenly triangles lie.

use crate::rig::deform::{DeformPlan, Scratch};
use crate::rig::handles::NONE;
use crate::rig::implicit::{Implicit, Layer};
use crate::rig::{HalfMesh, Handles, Proportions};
use glam::{Vec3, vec3};

const RELAX: usize = 40;

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

/// Fitted positions of the half mesh for `shape`, before ear leather and limit compensation.
pub fn fit(half: &HalfMesh, handles: &Handles, shape: &Proportions) -> Vec<[f32; 3]> {
    let plan = DeformPlan::new(half, handles.clone(), shape);
    let surface = Implicit::new(shape);
    let mut at = vec![Vec3::ZERO; half.n_half()];
    plan.features(shape, &surface, &mut at);
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
    for _ in 0..RELAX {
        let before = at.clone();
        for &v in &free {
            let v = v as usize;
            at[v] = (before[v] + plan.rings().mean(v, &before)) * 0.5;
            if half.midline[v] {
                at[v].x = 0.0;
            }
        }
        plan.fit().keep_orbit(&mut at, shape.eye_r);
        plan.fit().project(&surface, &mut at);
        plan.fit().project(&surface, &mut at);
    }
    for v in (0..at.len()).filter(|&v| !free.contains(&(v as u16))) {
        at[v] = pinned[v];
    }
    // The leather's base shape is never read but for its place near the head; give it the finished one.
    let mut finished = at.clone();
    plan.finish(shape, &surface, &mut Scratch::default(), &mut finished);
    for &v in handles.a.iter().flatten().chain(&handles.a5) {
        at[v as usize] = finished[v as usize];
    }
    at.into_iter().map(|p| p.to_array()).collect()
}
