//! A piece of surface laid flat with little stretch and no fold.
//!
//! Start: Tutte's embedding (Tutte 1963), boundary on a convex curve, holes filled with a fan each; it folds nothing.
//! From there the symmetric Dirichlet energy (Smith and Schaefer 2015), which grows without bound as a triangle
//! collapses, goes down by reweighted local-global steps (SLIM: Rabinovich, Poranne, Panozzo and Sorkine-Hornung 2017),
//! each cut short of the first flip. Everything in f64 with a fixed number of steps.

use super::skyline::Skyline;
use crate::math::ops;

const STEPS: usize = 120;
/// Turns what moves on the spot back a little, so that the system has one solution.
const HOLD: f64 = 1e-7;

/// A piece of surface: a disk, perhaps with holes.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Corners, counter-clockwise.
    pub(super) faces: Vec<[usize; 3]>,
    /// Squared lengths of the sides 0-1, 1-2 and 2-0 of each face.
    pub(super) sides: Vec<[f64; 3]>,
    /// For each vertex whether it must lie on the line x = 0: one run of the outer boundary, the piece on its right; or
    /// nowhere.
    pub(super) on_axis: Vec<bool>,
    /// Faces that are not there but must not fold either: what lies between two banks of a slit. Their shape is free.
    pub(super) air: Vec<[usize; 3]>,
}

/// A triangle at rest: the inverse of its sides' matrix, and its area.
struct Rest {
    inverse: [[f64; 2]; 2],
    area: f64,
}

impl Rest {
    fn new([a, b, c]: [f64; 3]) -> Rest {
        // First corner at the origin, first side along x.
        let l = ops::sqrt(a);
        let x = (a + c - b) / (2.0 * l);
        let y = ops::sqrt((c - x * x).max(1e-6 * a));
        Rest { inverse: [[1.0 / l, -x / (l * y)], [0.0, 1.0 / y]], area: l * y / 2.0 }
    }

    /// The linear map from rest to plane.
    fn jacobian(&self, [p, q, r]: [[f64; 2]; 3]) -> [[f64; 2]; 2] {
        let (e, f) = (sub(q, p), sub(r, p));
        let [[a, b], [_, d]] = self.inverse;
        [[e[0] * a, e[0] * b + f[0] * d], [e[1] * a, e[1] * b + f[1] * d]]
    }

    /// Gradients of the corners' hat functions at rest.
    fn gradients(&self) -> [[f64; 2]; 3] {
        let [[a, b], [_, d]] = self.inverse;
        [[-a, -b - d], [a, b], [0.0, d]]
    }
}

fn sub(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Singular values, larger first, of a map that does not flip.
pub(super) fn stretches([[a, b], [c, d]]: [[f64; 2]; 2]) -> (f64, f64) {
    let (p, q) = (ops::hypot(a + d, c - b), ops::hypot(a - d, b + c));
    ((p + q) / 2.0, (p - q) / 2.0)
}

fn energy(rests: &[Rest], faces: &[[usize; 3]], at: &[[f64; 2]]) -> f64 {
    let mut sum = 0.0;
    for (rest, f) in rests.iter().zip(faces) {
        let j = rest.jacobian(f.map(|v| at[v]));
        let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
        if det <= 0.0 {
            return f64::INFINITY;
        }
        let square = j.iter().flatten().map(|x| x * x).sum::<f64>();
        // |J|² + |J⁻¹|²; in the plane the latter is |J|² / det².
        sum += rest.area * (square + square / (det * det));
    }
    sum
}

/// Lays a piece flat: a place for each vertex.
pub(super) fn flatten(piece: &Piece) -> Vec<[f64; 2]> {
    let n = piece.on_axis.len();
    let mut at = tutte(piece);
    let rests: Vec<Rest> = piece.sides.iter().map(|&s| Rest::new(s)).collect();
    let wanted: f64 = rests.iter().map(|r| r.area).sum();
    let has: f64 = piece.faces.iter().map(|f| cross(sub(at[f[1]], at[f[0]]), sub(at[f[2]], at[f[0]])) / 2.0).sum();
    let scale = ops::sqrt(wanted / has);
    at.iter_mut().flatten().for_each(|x| *x *= scale);

    let all: Vec<[usize; 3]> = piece.faces.iter().chain(&piece.air).copied().collect();
    let mut system = Skyline::new(n, &all, 2);
    for _ in 0..STEPS {
        // Air is at rest as it lies: it resists change, not shape.
        let air = piece.air.iter().map(|f| {
            let [p, q, r] = f.map(|v| at[v]);
            let square = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
            let rest = Rest::new([square(p, q), square(q, r), square(r, p)]);
            Rest { area: rest.area * AIR, ..rest }
        });
        let rests: Vec<Rest> = piece.sides.iter().map(|&s| Rest::new(s)).chain(air).collect();
        let before = energy(&rests, &all, &at);
        let target = solve(&mut system, &rests, &all, &piece.on_axis, &at);
        let way: Vec<[f64; 2]> = target.iter().zip(&at).map(|(&t, &p)| sub(t, p)).collect();
        let mut step = (0.9 * first_flip(&all, &at, &way)).min(1.0);
        for _ in 0..30 {
            let next: Vec<[f64; 2]> =
                at.iter().zip(&way).map(|(p, d)| [p[0] + step * d[0], p[1] + step * d[1]]).collect();
            if energy(&rests, &all, &next) < before {
                at = next;
                break;
            }
            step *= 0.5;
        }
    }
    at
}

/// How much air counts against skin.
const AIR: f64 = 1e-3;

/// One global step: the places that best fit each triangle's nearest turn, weighted so that the energy's gradient is met.
fn solve(
    system: &mut Skyline,
    rests: &[Rest],
    faces: &[[usize; 3]],
    on_axis: &[bool],
    at: &[[f64; 2]],
) -> Vec<[f64; 2]> {
    system.clear();
    let mut right = vec![0.0; 2 * at.len()];
    let total: f64 = rests.iter().map(|r| r.area).sum();
    for (rest, f) in rests.iter().zip(faces) {
        let j = rest.jacobian(f.map(|v| at[v]));
        let (turn, weight) = polar(j);
        let g = rest.gradients();
        // weight times turn.
        let wr = [
            [
                weight[0][0] * turn[0][0] + weight[0][1] * turn[1][0],
                weight[0][0] * turn[0][1] + weight[0][1] * turn[1][1],
            ],
            [
                weight[1][0] * turn[0][0] + weight[1][1] * turn[1][0],
                weight[1][0] * turn[0][1] + weight[1][1] * turn[1][1],
            ],
        ];
        for k in 0..3 {
            for x in 0..2 {
                right[2 * f[k] + x] += rest.area * (wr[x][0] * g[k][0] + wr[x][1] * g[k][1]);
            }
            for l in 0..3 {
                let dot = rest.area * (g[k][0] * g[l][0] + g[k][1] * g[l][1]);
                for (x, row) in weight.iter().enumerate() {
                    for (y, weight) in row.iter().enumerate() {
                        system.add(2 * f[k] + x, 2 * f[l] + y, dot * weight);
                    }
                }
            }
        }
    }
    let hold = HOLD * total;
    for (v, p) in at.iter().enumerate() {
        for x in 0..2 {
            system.add(2 * v + x, 2 * v + x, hold);
            right[2 * v + x] += hold * p[x];
        }
        if on_axis[v] {
            system.pin_at_zero(2 * v);
            right[2 * v] = 0.0;
        }
    }
    system.solve(&mut right);
    right.chunks_exact(2).map(|p| [p[0], p[1]]).collect()
}

/// The nearest turn to a map that does not flip, and the square of SLIM's weight for it: of each singular value s
/// (s + 1)(s² + 1) / s³, in the directions of the image.
fn polar([[a, b], [c, d]]: [[f64; 2]; 2]) -> ([[f64; 2]; 2], [[f64; 2]; 2]) {
    let (x, y) = (a + d, c - b);
    let length = ops::hypot(x, y);
    let (cos, sin) = if length > 0.0 { (x / length, y / length) } else { (1.0, 0.0) };
    let turn = [[cos, -sin], [sin, cos]];
    // Stretch in the image: map times the turn's inverse, symmetric.
    let s = [[a * cos - b * sin, a * sin + b * cos], [c * cos - d * sin, c * sin + d * cos]];
    let off = (s[0][1] + s[1][0]) / 2.0;
    let (large, small) = stretches([[a, b], [c, d]]);
    let f = |s: f64| (s + 1.0) * (s * s + 1.0) / (s * s * s);
    let (fl, fs) = (f(large), f(small));
    let gap = large - small;
    // f of a symmetric matrix with two eigenvalues is linear in it.
    let slope = if gap > 1e-12 * large { (fl - fs) / gap } else { 0.0 };
    let base = fs - slope * small;
    (turn, [[base + slope * s[0][0], slope * off], [slope * off, base + slope * s[1][1]]])
}

/// The shortest step at which a triangle collapses; at most ten.
fn first_flip(faces: &[[usize; 3]], at: &[[f64; 2]], way: &[[f64; 2]]) -> f64 {
    let mut first = 10.0f64;
    for &[p, q, r] in faces {
        let (e, f) = (sub(at[q], at[p]), sub(at[r], at[p]));
        let (de, df) = (sub(way[q], way[p]), sub(way[r], way[p]));
        // Twice the area after a step t: c + b t + a t².
        let (a, b, c) = (cross(de, df), cross(e, df) + cross(de, f), cross(e, f));
        let inside = b * b - 4.0 * a * c;
        if inside < 0.0 {
            continue;
        }
        let root = ops::sqrt(inside);
        // Without cancellation; the other root is c over this one.
        let q = -0.5 * (b + if b < 0.0 { -root } else { root });
        for t in [q / a, c / q] {
            if t > 0.0 && t < first {
                first = t;
            }
        }
    }
    first
}

/// The outer boundary first, then holes: each loop with the piece on its left. The outer one is that with vertices on the
/// axis, else the longest.
fn boundaries(piece: &Piece, faces: &[[usize; 3]]) -> Vec<Vec<usize>> {
    let sides = || faces.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let inner: std::collections::BTreeSet<(usize, usize)> = sides().collect();
    let mut next: std::collections::BTreeMap<usize, usize> =
        sides().filter(|&(a, b)| !inner.contains(&(b, a))).collect();
    let mut loops = Vec::new();
    while let Some((first, mut to)) = next.pop_first() {
        let mut chain = vec![first];
        while to != first {
            chain.push(to);
            match next.remove(&to) {
                Some(v) => to = v,
                None => break,
            }
        }
        loops.push(chain);
    }
    let rank = |l: &Vec<usize>| (l.iter().filter(|&&v| piece.on_axis[v]).count(), l.len());
    loops.sort_by_key(|l| std::cmp::Reverse(rank(l)));
    loops
}

/// Boundary on a half circle whose diameter is the axis, or on a circle; every other vertex in the mean of its neighbours.
fn tutte(piece: &Piece) -> Vec<[f64; 2]> {
    let n = piece.on_axis.len();
    let mut faces: Vec<[usize; 3]> = piece.faces.iter().chain(&piece.air).copied().collect();
    let loops = boundaries(piece, &faces);
    for (k, hole) in loops.iter().skip(1).enumerate() {
        // A hole's boundary runs with the piece on its left, so its filling runs the other way.
        faces.extend((0..hole.len()).map(|i| [hole[(i + 1) % hole.len()], hole[i], n + k]));
    }
    let n_all = n + loops.len().saturating_sub(1);
    let mut fixed: Vec<Option<[f64; 2]>> = vec![None; n_all];
    let mut outer = loops.into_iter().next().unwrap_or_default();
    let n_axis = outer.iter().filter(|&&v| piece.on_axis[v]).count();
    // Start where the axis starts.
    let len = outer.len();
    let start = (0..len).find(|&i| piece.on_axis[outer[i]] && !piece.on_axis[outer[(i + len - 1) % len]]).unwrap_or(0);
    outer.rotate_left(start);
    for (i, &v) in outer.iter().enumerate() {
        let place = if i < n_axis {
            [0.0, 1.0 - 2.0 * i as f64 / (n_axis - 1).max(1) as f64]
        } else if n_axis > 0 {
            let turn = (i + 1 - n_axis) as f64 / (len + 1 - n_axis) as f64;
            let angle = core::f64::consts::PI * (turn - 0.5);
            [ops::cos(angle), ops::sin(angle)]
        } else {
            let angle = core::f64::consts::TAU * i as f64 / len as f64;
            [ops::cos(angle), ops::sin(angle)]
        };
        fixed[v] = Some(place);
    }
    let mut system = Skyline::new(n_all, &faces, 1);
    let mut right = [vec![0.0; n_all], vec![0.0; n_all]];
    for f in &faces {
        // Each side inside the disk comes once from either face: half a weight each time is the same for all.
        for (a, b) in [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])] {
            for (a, b) in [(a, b), (b, a)] {
                if fixed[a].is_some() {
                    continue;
                }
                system.add(a, a, 1.0);
                match fixed[b] {
                    None => system.add(a, b, -1.0),
                    Some(p) => (0..2).for_each(|x| right[x][a] += p[x]),
                }
            }
        }
    }
    for (v, place) in fixed.iter().enumerate() {
        if let Some(p) = place {
            system.add(v, v, 1.0);
            (0..2).for_each(|x| right[x][v] = p[x]);
        }
    }
    system.factor();
    right.iter_mut().for_each(|r| system.substitute(r));
    (0..n).map(|v| [right[0][v], right[1][v]]).collect()
}
