//! The turn and shift that come nearest to what points did.
//!
//! Kabsch 1976, "A solution for the best rotation to relate two sets of vectors"; the rotation is the orthogonal factor of the
//! covariance, by Higham's iteration (1986, "Computing the polar decomposition").

use crate::rig::Rigid;
use glam::{DMat3, DVec3, Mat3, Vec3};

/// Rounds of the iteration, which doubles its digits in each near the end; flat sets need more before.
const ROUNDS: usize = 40;

/// From points at rest to where they are; one of each. The shift alone where they tell no turn.
pub(super) fn rigid_fit(pairs: impl Iterator<Item = (Vec3, Vec3)> + Clone) -> Rigid {
    let n = pairs.clone().count().max(1) as f64;
    let sums = pairs.clone().fold([DVec3::ZERO; 2], |[a, b], (p, q)| [a + p.as_dvec3(), b + q.as_dvec3()]);
    let [from, to] = sums.map(|sum| sum / n);
    let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
    let mut x = pairs.fold(DMat3::ZERO, |sum, (p, q)| sum + outer(q.as_dvec3() - to, p.as_dvec3() - from));
    let size = x.x_axis.length() + x.y_axis.length() + x.z_axis.length();
    x *= 1.0 / size.max(1e-30);
    let turn = if x.determinant() > 1e-12 {
        for _ in 0..ROUNDS {
            x = (x + x.inverse().transpose()) * 0.5;
        }
        x
    } else {
        DMat3::IDENTITY
    };
    let turn = Mat3::from_cols(turn.x_axis.as_vec3(), turn.y_axis.as_vec3(), turn.z_axis.as_vec3());
    Rigid { turn, shift: to.as_vec3() - turn * from.as_vec3() }
}

#[cfg(test)]
mod tests {
    use super::rigid_fit;
    use glam::{Mat3, Vec3, vec3};

    #[test]
    fn a_turn_of_a_flat_set_is_found_wrong() {
        let points: Vec<Vec3> =
            (0..24).map(|i| vec3((i % 6) as f32 * 0.01, (i / 6) as f32 * 0.012, (i % 5) as f32 * 0.0004)).collect();
        for angle in [0.0_f32, 0.3, 1.2, 2.6, -1.9] {
            let turn = Mat3::from_rotation_x(angle) * Mat3::from_rotation_z(0.4 * angle);
            let shift = vec3(0.01, -0.02, 0.3);
            let fit = rigid_fit(points.iter().map(|&p| (p, turn * p + shift)));
            for &p in &points {
                assert!(fit.point(p).distance(turn * p + shift) < 1e-6, "{angle}");
            }
        }
        let fit = rigid_fit([(Vec3::ZERO, Vec3::X)].into_iter());
        assert_eq!((fit.turn, fit.shift), (Mat3::IDENTITY, Vec3::X));
    }
}
