//! Control positions whose subdivision limit lies on the fitted surface: subdivision shrinks a mesh, so the control
//! vertices are moved outwards by what their limit lacks, a few times, with a weight for each kind of vertex.
//!
//! Limit of √3 subdivision: `(1 - b) v + b mean(ring)` with `b = 3 a / (1 + 3 a)`, `a = (4 - 2 cos(2 pi / n)) / 9`
//! (Kobbelt 2000, from the left eigenvector of its one-ring matrix); on a boundary `(1 4 1) / 6`.

use crate::math::ops;
use crate::rig::control::{HalfMesh, HalfRings};
use crate::rig::handles::{Handles, NONE};
use glam::Vec3;

const ROUNDS: usize = 2;
/// Longest way from the target, head units.
const CAP: f32 = 0.55;

/// Weights of the compensation and the limit masks.
#[derive(Clone, Debug)]
pub struct LimitPlan {
    active: Vec<(u16, f32, f32)>,
}

impl LimitPlan {
    /// Weights by kind: skin 1, tight loops less, since compensating them everywhere would make them cross.
    pub fn new(half: &HalfMesh, rings: &HalfRings, h: &Handles) -> Self {
        let mut weight = vec![0.65f32; half.n_half()];
        let mut put = |vertices: &[u16], w: f32| {
            for &v in vertices {
                weight[v as usize] = w;
            }
        };
        for i in 3..11 {
            put(&h.mu[i][1..], 0.0);
            put(&h.ml[i][1..], 0.0);
            put(&[h.s[i][9]], 0.35);
            put(&[h.l[i][9]], 0.2);
        }
        put(&[h.s[10][9]], 0.2);
        put(&h.l[3][10..15], 0.25);
        put(&h.orbit, 0.2);
        put(&h.of, 0.2);
        put(&h.er, 0.2);
        for i in 6..10 {
            let row: Vec<u16> = h.s[i][..5].iter().copied().filter(|&v| v != NONE).collect();
            put(&row, 0.25);
        }
        put(&h.ei, 0.0);
        put(&[h.ep, h.np], 0.0);
        for ring in &h.a {
            put(ring, 0.35);
        }
        put(&h.ear_end, 0.5);
        put(&h.s[0], 0.3);
        put(&h.n, 0.3);
        put(&h.nm, 0.4);
        put(&h.nr, 0.3);
        put(&h.ni, 0.0);
        // The neck's boundary is cut off flat: its own curve is its limit.
        if let Some(neck) = half.loops.get("neck") {
            put(neck, 0.0);
        }
        let beta = |v: usize| {
            let n = rings.valence(v) as f32;
            let a = (4.0 - 2.0 * ops::cos(core::f32::consts::TAU / n)) / 9.0;
            3.0 * a / (1.0 + 3.0 * a)
        };
        let active = (0..half.n_half()).filter(|&v| weight[v] > 0.0).map(|v| (v as u16, weight[v], beta(v))).collect();
        Self { active }
    }

    /// Moves `at` so that its limit approaches the positions it had (`target` and `next` are scratch of equal length).
    pub fn compensate(&self, rings: &HalfRings, at: &mut [Vec3], target: &mut [Vec3], next: &mut [Vec3]) {
        target.copy_from_slice(at);
        for _ in 0..ROUNDS {
            next.copy_from_slice(at);
            for &(v, weight, beta) in &self.active {
                let v = v as usize;
                let limit = at[v] * (1.0 - beta) + rings.mean(v, at) * beta;
                let p = at[v] + (target[v] - limit) * (0.8 * weight);
                next[v] = target[v] + (p - target[v]).clamp_length_max(CAP);
            }
            at.copy_from_slice(next);
        }
    }
}
