//! Control positions whose subdivision limit lies on the fitted surface: subdivision shrinks a mesh, so the control
//! vertices are moved outwards by what their limit lacks, a few times, with a weight for each kind of vertex.
//!
//! Limit of √3 subdivision: `(1 - b) v + b mean(ring)` with `b = 3 a / (1 + 3 a)`, `a = (4 - 2 cos(2 pi / n)) / 9`
//! (Kobbelt 2000, from the left eigenvector of its one-ring matrix). For vertices on sharp edges the control mesh brings
//! the weights along, as the engine has them (`src/author/limits.rs`). There the limit is hardly shrunk across the edge,
//! so they are solved for until it lies where the features want the edge, and the edge is no tight loop any more.

use crate::math::ops;
use crate::rig::control::{HalfMesh, HalfRings};
use crate::rig::handles::{Handles, NONE};
use glam::Vec3;

const ROUNDS: usize = 2;
/// Rounds for the vertices of edges alone; each leaves less than half of what they lack.
const EDGE_ROUNDS: usize = 6;
/// Longest way from the target, head units.
const CAP: f32 = 0.55;

/// Weights of the compensation and the limit masks.
#[derive(Clone, Debug)]
pub struct LimitPlan {
    /// Vertex, weight, weight of its ring in its limit.
    active: Vec<(u16, f32, f32)>,
    edges: Vec<Edge>,
    curves: Vec<Curve>,
}

/// A vertex of an edge that is pinned by control points: the edge is their cubic B-spline. An edge that went through
/// the pins of the lips would swing where they bend most, at the philtrum and at the corner of the mouth.
#[derive(Clone, Debug)]
struct Curve {
    vertex: u16,
    /// Before and after along the edge, each with whether its mirror image is meant.
    neighbours: [(u16, bool); 2],
}

impl Curve {
    /// None where the vertex is no inner one of an edge.
    fn at(half: &HalfMesh, vertex: u16) -> Option<Self> {
        let other = |&(a, b, _): &(u16, u16, f32)| [(a, b), (b, a)].into_iter().find(|e| e.0 == vertex).map(|e| e.1);
        let own: Vec<u16> = half.creases.iter().filter_map(other).collect();
        // In the median plane an edge goes on as its own mirror image.
        let crosses = |v: &u16| half.midline[vertex as usize] && !half.midline[*v as usize];
        let images = own.iter().copied().filter(crosses).map(|v| (v, true));
        let both: Vec<(u16, bool)> = own.iter().map(|&v| (v, false)).chain(images).collect();
        both.try_into().ok().map(|neighbours| Self { vertex, neighbours })
    }
}

/// A value of the half mesh, or its mirror image.
fn side(p: Vec3, across: bool) -> Vec3 {
    if across { Vec3::new(-p.x, p.y, p.z) } else { p }
}

/// Weight of the ring in the limit of a vertex on no edge.
fn smooth(rings: &HalfRings, v: usize) -> f32 {
    let n = rings.valence(v) as f32;
    let a = (4.0 - 2.0 * ops::cos(core::f32::consts::TAU / n)) / 9.0;
    3.0 * a / (1.0 + 3.0 * a)
}

/// A vertex on a sharp edge.
#[derive(Clone, Debug)]
struct Edge {
    vertex: u16,
    /// How far it moves for each unit that its limit lacks.
    gain: f32,
    limit: Vec<(u16, bool, f32)>,
}

impl Edge {
    fn limit(&self, at: &[Vec3]) -> Vec3 {
        self.limit
            .iter()
            .fold(Vec3::ZERO, |sum, &(source, across, weight)| sum + side(at[source as usize], across) * weight)
    }
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
        put(&h.n, 0.3);
        put(&h.nm, 0.4);
        put(&h.nr, 0.3);
        put(&h.ni, 0.0);
        // The neck's boundary is cut off flat: its own curve is its limit.
        if let Some(neck) = half.loops.get("neck") {
            put(neck, 0.0);
        }
        let edge = |(v, row): &(u16, Vec<(u16, bool, f32)>)| {
            let own: f32 = row.iter().filter(|s| s.0 == *v).map(|s| s.2).sum();
            Edge { vertex: *v, gain: 1.0 / own.max(0.5), limit: row.clone() }
        };
        let edges: Vec<Edge> = half.limits.iter().map(edge).collect();
        for edge in &edges {
            weight[edge.vertex as usize] = 0.0;
        }
        let lips = (3..11).flat_map(|i| [h.s[i][9], h.l[i][9]]);
        let curves = lips.filter_map(|v| Curve::at(half, v)).collect();
        let active = (0..half.n_half()).filter(|&v| weight[v] > 0.0);
        let active = active.map(|v| (v as u16, weight[v], smooth(rings, v))).collect();
        Self { active, edges, curves }
    }

    /// Moves `at` so that its limit approaches the positions it had (`target` and `next` are scratch of equal length).
    pub fn compensate(&self, rings: &HalfRings, at: &mut [Vec3], target: &mut [Vec3], next: &mut [Vec3]) {
        target.copy_from_slice(at);
        for curve in &self.curves {
            let [before, after] = curve.neighbours.map(|(v, across)| side(at[v as usize], across));
            target[curve.vertex as usize] = (before + at[curve.vertex as usize] * 4.0 + after) / 6.0;
        }
        for _ in 0..ROUNDS {
            next.copy_from_slice(at);
            for &(v, weight, beta) in &self.active {
                let v = v as usize;
                let limit = at[v] * (1.0 - beta) + rings.mean(v, at) * beta;
                let p = at[v] + (target[v] - limit) * (0.8 * weight);
                next[v] = target[v] + (p - target[v]).clamp_length_max(CAP);
            }
            self.sharpen(at, target, next);
            at.copy_from_slice(next);
        }
        for _ in 0..EDGE_ROUNDS {
            self.sharpen(at, target, next);
            for edge in &self.edges {
                at[edge.vertex as usize] = next[edge.vertex as usize];
            }
        }
    }

    /// Where subdivision takes vertex `v` of the half mesh (`at`: its positions).
    pub fn of(&self, rings: &HalfRings, v: usize, at: &[Vec3]) -> Vec3 {
        match self.edges.iter().find(|edge| edge.vertex as usize == v) {
            Some(edge) => edge.limit(at),
            None => {
                let beta = smooth(rings, v);
                at[v] * (1.0 - beta) + rings.mean(v, at) * beta
            }
        }
    }

    /// One step of the vertices on edges, from `at` to `next`.
    fn sharpen(&self, at: &[Vec3], target: &[Vec3], next: &mut [Vec3]) {
        for edge in &self.edges {
            let v = edge.vertex as usize;
            let p = at[v] + (target[v] - edge.limit(at)) * edge.gain;
            next[v] = target[v] + (p - target[v]).clamp_length_max(CAP);
        }
    }
}
