//! Lays the control mesh on the implicit head.
//!
//! The *start* is the base head moved by the pinned vertices' displacements, spread over the mesh by the bilaplacian
//! (a constant linear map, computed once). Then a fixed number of rounds smooths the displacement from that start and
//! projects to the surface. Both depend on the measures alone, so the result is a function of them; the number of rounds
//! is chosen so that more would move nothing that can be seen (a test measures how little).

use crate::rig::control::{HalfMesh, HalfRings};
use crate::rig::handles::{Handles, NONE};
use crate::rig::implicit::{Implicit, Layer};
use glam::Vec3;
use std::sync::Arc;

/// What a round leaves of the displacement from the start. Below 1 a vertex is drawn back to where the start put it as
/// far as the surface lets it, and the rounds converge geometrically.
const KEEP: f32 = 0.68;

/// Rounds after which vertices leap to where their last two steps lead. Where the start lies deep below a ridge (the edge
/// of a flew, the angle of a jaw) the projection nearly makes up for what [`KEEP`] takes, and a vertex creeps along the
/// ridge by steps of which each is hardly shorter than the one before: their sum is known long before they are done.
const LEAPS: [usize; 3] = [3, 5, 7];
/// The largest ratio of two steps that is believed.
const LEAP_RATIO: f32 = 0.9;
/// Longest leap, head units.
const LEAP: f32 = 1.5;

/// How far the skin around the base of an ear stays from it, as a part of the base's length.
const KEEP_EAR: f32 = 0.1;

/// A constant linear map from the displacements of the held vertices to those of the free ones.
#[derive(Clone, Debug)]
struct Spread {
    free: Vec<u16>,
    held: Vec<u16>,
    /// Row by row: `free.len()` × `held.len()`.
    weights: Vec<f32>,
}

impl Spread {
    /// Minimises the sum of squared Laplacians of one coordinate's displacement. `sign` is the coordinate's factor under
    /// reflection: -1 for x (whose midline is then held at zero), 1 for y and z.
    fn new(rings: &HalfRings, midline: &[bool], held: &[bool], sign: f64) -> Self {
        let n = held.len();
        let fixed = |v: usize| held[v] || (sign < 0.0 && midline[v]);
        let free: Vec<u16> = (0..n).filter(|&v| !fixed(v)).map(|v| v as u16).collect();
        let held: Vec<u16> = (0..n).filter(|&v| held[v]).map(|v| v as u16).collect();
        let mut column = vec![None; n];
        for (k, &v) in free.iter().enumerate() {
            column[v as usize] = Some(k);
        }
        for (k, &v) in held.iter().enumerate() {
            column[v as usize] = Some(free.len() + k);
        }
        let (nf, nh) = (free.len(), held.len());
        let width = nf + nh;
        // Normal equations of the Laplacian rows of the free vertices and of the held ones beside them.
        let mut normal = vec![0.0f64; nf * width];
        let mut row = vec![0.0f64; width];
        for v in 0..n {
            let touches =
                column[v].is_some_and(|c| c < nf) || rings.of(v).any(|(u, _)| column[u].is_some_and(|c| c < nf));
            if !touches {
                continue;
            }
            row.fill(0.0);
            let own = if column[v].is_some_and(|c| c < nf) { 1.0 } else { 0.15 };
            if let Some(c) = column[v] {
                row[c] += own;
            }
            let share = own / rings.valence(v) as f64;
            for (u, across) in rings.of(v) {
                if let Some(c) = column[u] {
                    row[c] -= share * if across { sign } else { 1.0 };
                }
            }
            let entries: Vec<usize> = (0..width).filter(|&c| row[c] != 0.0).collect();
            for &a in entries.iter().filter(|&&a| a < nf) {
                for &b in &entries {
                    normal[a * width + b] += row[a] * row[b];
                }
            }
        }
        let weights = solve(&mut normal, nf, nh);
        Self { free, held, weights }
    }

    fn apply(&self, moved: &[f32], mut write: impl FnMut(usize, f32)) {
        for (row, &v) in self.weights.chunks_exact(self.held.len()).zip(&self.free) {
            // Eight sums side by side, so that the compiler may use vectors; their order is fixed.
            let mut sums = [0.0f32; 8];
            let (w, m) = (row.chunks_exact(8), moved.chunks_exact(8));
            let tail: f32 = w.remainder().iter().zip(m.remainder()).map(|(a, b)| a * b).sum();
            for (w, m) in w.zip(m) {
                for k in 0..8 {
                    sums[k] += w[k] * m[k];
                }
            }
            let [a, b, c, d, e, f, g, h] = sums;
            write(v as usize, ((a + e) + (b + f)) + ((c + g) + (d + h)) + tail);
        }
    }
}

/// Cholesky in place; returns `-inverse(N_ff) N_fh`, row by row.
fn solve(normal: &mut [f64], nf: usize, nh: usize) -> Vec<f32> {
    let width = nf + nh;
    let at = |r: usize, c: usize| r * width + c;
    for j in 0..nf {
        for k in 0..j {
            let f = normal[at(j, k)];
            if f != 0.0 {
                for i in j..nf {
                    normal[at(i, j)] -= normal[at(i, k)] * f;
                }
            }
        }
        let pivot = normal[at(j, j)].max(1e-12).sqrt();
        for i in j..nf {
            normal[at(i, j)] /= pivot;
        }
    }
    let mut out = vec![0.0f32; nf * nh];
    let mut x = vec![0.0f64; nf];
    for h in 0..nh {
        for i in 0..nf {
            let mut sum = -normal[at(i, nf + h)];
            for k in 0..i {
                sum -= normal[at(i, k)] * x[k];
            }
            x[i] = sum / normal[at(i, i)];
        }
        for i in (0..nf).rev() {
            let mut sum = x[i];
            for k in i + 1..nf {
                sum -= normal[at(k, i)] * x[k];
            }
            x[i] = sum / normal[at(i, i)];
        }
        for (i, x) in x.iter().enumerate() {
            out[i * nh + h] = *x as f32;
        }
    }
    out
}

/// The constant part of the fit.
#[derive(Clone, Debug)]
pub struct FitPlan {
    spread: [Spread; 2],
    /// Free vertices in pairs of one layer, for the two-lane sampler.
    pairs: Vec<(u16, u16, Layer)>,
    free: Vec<u16>,
    orbit: Vec<(u16, u16, u16)>,
    /// The ear's base, and each free vertex around it with its first and last neighbour on it.
    ear: [u16; 12],
    around_ear: Vec<(u16, [u16; 2])>,
    rings: Arc<HalfRings>,
}

/// Buffers of the rounds; made once.
#[derive(Clone, Debug, Default)]
pub struct Buffers {
    /// Where the rounds begin, and what they draw back to.
    pub start: Vec<Vec3>,
    /// Displacement from there.
    pub moved: Vec<Vec3>,
    before: Vec<Vec3>,
    step: Vec<Vec3>,
}

/// What is left of a geometric row of steps after these two (Aitken 1926).
fn leap(before: Vec3, now: Vec3) -> Vec3 {
    let ratio = (now.dot(before) / before.length_squared().max(1e-12)).clamp(0.0, LEAP_RATIO);
    (now * (ratio / (1.0 - ratio))).clamp_length_max(LEAP)
}

/// Vertices in the hollow between bridge, brow and cheek, where the nearest point of the surface jumps from one side to
/// the other: there the smooth start stands.
pub fn hollow(handles: &Handles) -> Vec<u16> {
    handles.s[7][5..6].to_vec()
}

/// Layer of every half vertex: the lips part the surfaces in front of the mouth's corner.
pub fn layers(handles: &Handles, n: usize) -> Vec<Layer> {
    let mut layers = vec![Layer::Whole; n];
    for i in 1..11 {
        for &v in handles.s[i].iter().filter(|&&v| v != NONE) {
            layers[v as usize] = Layer::Upper;
        }
    }
    for i in 3..11 {
        for &v in &handles.l[i][10..15] {
            layers[v as usize] = Layer::Lower;
        }
    }
    layers
}

impl FitPlan {
    /// `pinned` vertices stay where the features put them; `guides` only shape the start.
    pub fn new(
        half: &HalfMesh,
        rings: &Arc<HalfRings>,
        handles: &Handles,
        pinned: &[bool],
        guides: &[bool],
        leather: &[bool],
    ) -> Self {
        let n = half.n_half();
        let held: Vec<bool> = (0..n).map(|v| pinned[v] || guides[v] || leather[v]).collect();
        let free: Vec<u16> = (0..n).filter(|&v| !pinned[v] && !leather[v]).map(|v| v as u16).collect();
        let layer = layers(handles, n);
        let hollow = hollow(handles);
        let mut pairs = Vec::new();
        for kind in [Layer::Upper, Layer::Lower, Layer::Whole] {
            let on_surface = |v: &u16| layer[*v as usize] == kind && !hollow.contains(v);
            let of_kind: Vec<u16> = free.iter().copied().filter(on_surface).collect();
            pairs.extend(of_kind.chunks(2).map(|c| (c[0], c[c.len() - 1], kind)));
        }
        let orbit = (0..12).filter(|&k| !pinned[handles.orbit[k] as usize]);
        let orbit = orbit.map(|k| (handles.orbit[k], handles.of[k], handles.er[k])).collect();
        let ear = handles.ear_base;
        let beside = |&v: &u16| {
            let mut on_base = ear.iter().copied().filter(|&b| rings.of(v as usize).any(|(u, _)| u == b as usize));
            let first = on_base.next()?;
            Some((v, [first, on_base.next_back().unwrap_or(first)]))
        };
        let around_ear = free.iter().filter_map(beside).collect();
        let spread = [-1.0, 1.0].map(|sign| Spread::new(rings, &half.midline, &held, sign));
        Self { spread, pairs, free, orbit, ear, around_ear, rings: rings.clone() }
    }

    /// Moves the free vertices of `at` (length: the half mesh) from the base by the displacements of the held ones. Those
    /// stand in `at` where the features of this head have put them, in `anchors` where those of the base head do.
    pub fn start(&self, base: &[Vec3], anchors: &[Vec3], at: &mut [Vec3], scratch: &mut Vec<f32>) {
        for (axis, which) in [(0, 0), (1, 1), (2, 1)] {
            let spread = &self.spread[which];
            scratch.clear();
            scratch.extend(spread.held.iter().map(|&v| at[v as usize][axis] - anchors[v as usize][axis]));
            // A guide takes part in the fit: it starts from its own place in the base.
            for (&v, moved) in spread.held.iter().zip(&*scratch) {
                at[v as usize][axis] = base[v as usize][axis] + moved;
            }
            spread.apply(scratch, |v, moved| at[v][axis] = base[v][axis] + moved);
            if axis == 0 {
                for &v in &self.free {
                    let v = v as usize;
                    if base[v].x == 0.0 {
                        at[v].x = 0.0;
                    }
                }
            }
        }
    }

    /// Rounds of smoothing the displacement from where `at` is and projecting to the surface.
    pub fn relax(&self, surface: &Implicit, at: &mut [Vec3], buffers: &mut Buffers, eye_r: f32, rounds: usize) {
        let Buffers { start, moved, before, step } = buffers;
        for list in [&mut *start, &mut *before] {
            list.clear();
            list.extend_from_slice(at);
        }
        moved.resize(at.len(), Vec3::ZERO);
        step.clear();
        step.resize(at.len(), Vec3::ZERO);
        for round in 0..rounds {
            for (m, (a, s)) in moved.iter_mut().zip(at.iter().zip(&*start)) {
                *m = *a - *s;
            }
            for &v in &self.free {
                let v = v as usize;
                at[v] = start[v] + (moved[v] + self.rings.mean(v, moved)) * (0.5 * KEEP);
            }
            self.keep_orbit(at, eye_r);
            self.keep_ear(at);
            self.project(surface, at);
            for &v in &self.free {
                let v = v as usize;
                let now = at[v] - before[v];
                if LEAPS.contains(&round) {
                    at[v] += leap(step[v], now);
                }
                (step[v], before[v]) = (now, at[v]);
            }
        }
        self.project(surface, at);
    }

    /// The orbit's loop stays outside the lid's fold.
    pub fn keep_orbit(&self, at: &mut [Vec3], eye_r: f32) {
        for &(orbit, fold, rim) in &self.orbit {
            let (fold, rim) = (at[fold as usize], at[rim as usize]);
            let out = (fold - rim).normalize_or_zero();
            let lack = (0.26 * eye_r).min(0.35 * fold.x) - (at[orbit as usize] - fold).dot(out);
            if lack > 0.0 {
                at[orbit as usize] += out * lack;
            }
        }
    }

    /// What lies around the ear's base stays so far from it that its triangles are not much smaller than those beside them.
    fn keep_ear(&self, at: &mut [Vec3]) {
        let base = self.ear.map(|b| at[b as usize]);
        let middle = base.iter().sum::<Vec3>() / 12.0;
        let size = base[0].distance(base[6]);
        for &(v, sides) in &self.around_ear {
            let [a, b] = sides.map(|b| at[b as usize]);
            let near = 0.5 * (a + b);
            let out = (near - middle).normalize_or_zero();
            let lack = KEEP_EAR * size - (at[v as usize] - near).dot(out);
            if lack > 0.0 {
                at[v as usize] += out * lack;
            }
        }
    }

    /// One Newton step of every free vertex.
    pub fn project(&self, surface: &Implicit, at: &mut [Vec3]) {
        for &(a, b, layer) in &self.pairs {
            let (a, b) = (a as usize, b as usize);
            let (pa, pb) = (at[a], at[b]);
            let [sa, sb] = surface.sample2(pa, pb, layer);
            let on_midline = |p: Vec3, q: Vec3| if p.x == 0.0 { Vec3::new(0.0, q.y, q.z) } else { q };
            at[a] = on_midline(pa, Implicit::step(pa, sa, 0.8));
            at[b] = on_midline(pb, Implicit::step(pb, sb, 0.8));
        }
    }

    /// Vertices that the fit moves.
    pub fn free(&self) -> &[u16] {
        &self.free
    }
}
