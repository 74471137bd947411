//! From landmarks to every vertex: the map of space that takes the canonical landmarks to those of a head.
//!
//! Radial basis functions (multiquadrics, Hardy 1971) with an affine part, over the landmarks and their mirror images. The
//! map is linear in the targets, so that all of it is solved when it is made and a head costs one sum for each vertex.

use super::landmarks::LANDMARKS;
use glam::{DVec3, Vec3, dvec3};

/// How far a landmark's influence is rounded, millimetres: without it the surface would have a tip at each.
const ROUNDING: f64 = 10.0;

/// Weights of the landmarks at some points.
#[derive(Clone, Debug)]
pub(super) struct Warp {
    /// For each point and landmark: its weight in x, and in y and z. The landmark's mirror image is in it.
    weights: Vec<[[f32; 2]; LANDMARKS.len()]>,
}

impl Warp {
    /// The map at points of one half of the canonical skull, millimetres.
    pub(super) fn new(points: impl Iterator<Item = Vec3>) -> Warp {
        // The landmarks, then the mirror images of those off the median plane.
        let lateral: Vec<usize> = (0..LANDMARKS.len()).filter(|&k| LANDMARKS[k].canonical.x > 0.0).collect();
        let mut centres: Vec<DVec3> = LANDMARKS.iter().map(|l| l.canonical.as_dvec3()).collect();
        centres.extend(lateral.iter().map(|&k| LANDMARKS[k].canonical.as_dvec3() * dvec3(-1.0, 1.0, 1.0)));
        let row = |p: DVec3| -> Vec<f64> {
            let basis = centres.iter().map(|c| (p.distance_squared(*c) + ROUNDING * ROUNDING).sqrt());
            basis.chain([1.0, p.x, p.y, p.z]).collect()
        };
        let mut matrix: Vec<Vec<f64>> = centres.iter().map(|c| row(*c)).collect();
        for k in 0..4 {
            let affine = centres.iter().map(|c| [1.0, c.x, c.y, c.z][k]);
            matrix.push(affine.chain([0.0; 4]).collect());
        }
        let inverse = inverse(matrix);
        let weights = points.map(|p| {
            let row = row(p.as_dvec3());
            let weight = |k: usize| row.iter().zip(&inverse).map(|(r, column)| r * column[k]).sum::<f64>();
            let mut weights = [[0.0_f32; 2]; LANDMARKS.len()];
            for (k, to) in weights.iter_mut().enumerate() {
                *to = [weight(k) as f32; 2];
            }
            for (i, &k) in lateral.iter().enumerate() {
                let (own, other) = (weight(k), weight(LANDMARKS.len() + i));
                weights[k] = [(own - other) as f32, (own + other) as f32];
            }
            weights
        });
        Warp { weights: weights.collect() }
    }

    /// The points of a head with these landmarks, in the landmarks' unit; one for each point of the map.
    pub(super) fn apply(&self, targets: &[Vec3; LANDMARKS.len()], out: &mut Vec<Vec3>) {
        out.clear();
        out.extend(self.weights.iter().map(|weights| weighed(weights, targets)));
    }

    /// The same of one point of the map, to the bit; nothing for a number that no point has.
    pub(super) fn at(&self, point: usize, targets: &[Vec3; LANDMARKS.len()]) -> Option<Vec3> {
        Some(weighed(self.weights.get(point)?, targets))
    }
}

fn weighed(weights: &[[f32; 2]; LANDMARKS.len()], targets: &[Vec3; LANDMARKS.len()]) -> Vec3 {
    let mut p = Vec3::ZERO;
    for (&[x, yz], t) in weights.iter().zip(targets) {
        p += Vec3::new(x, yz, yz) * *t;
    }
    p
}

/// Gauss and Jordan, with row pivots.
fn inverse(mut a: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let n = a.len();
    for (i, row) in a.iter_mut().enumerate() {
        row.extend((0..n).map(|j| if i == j { 1.0 } else { 0.0 }));
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap_or(k);
        a.swap(k, pivot);
        let scale = 1.0 / a[k][k];
        a[k].iter_mut().for_each(|x| *x *= scale);
        let own = a[k].clone();
        for (i, row) in a.iter_mut().enumerate() {
            let factor = row[k];
            if i != k && factor != 0.0 {
                row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    a.into_iter().map(|row| row[n..].to_vec()).collect()
}

#[cfg(test)]
mod tests {
    use super::{LANDMARKS, Vec3, Warp};

    #[test]
    fn a_landmark_does_not_go_where_it_should() {
        let warp = Warp::new(LANDMARKS.iter().map(|l| l.canonical));
        let mut targets = std::array::from_fn(|k| LANDMARKS[k].canonical * 0.001);
        let mut out = Vec::new();
        for (k, target) in targets.iter_mut().enumerate() {
            *target += Vec3::new(if target.x > 0.0 { 0.004 } else { 0.0 }, 0.002 * (k % 3) as f32, -0.003);
        }
        warp.apply(&targets, &mut out);
        for (k, (p, t)) in out.iter().zip(&targets).enumerate() {
            assert!(p.distance(*t) < 2e-6, "{}: {p} {t}", LANDMARKS[k].id);
        }
    }
}
