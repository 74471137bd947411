//! The measures f1 to f6 and their weighted sum (thesis, section 4.3).
//!
//! The scanned text is garbled in places. What is taken here: the angle at B is that between A - B and C - B (the text's
//! scalar product has one of them reversed); angles are paired by size, as the text says for sides (f2); and f5 is as
//! printed, (r/R - 1)², which is 1/4 for an equilateral triangle, not 0, since r/R is at most 1/2. Differences of it (f6)
//! are 0 between triangles of the same shape all the same.

use glam::{DVec3, Vec3};

use super::SimilarityError;
use crate::math::ops;

/// What the measures need to know of a triangle. Lengths are in the unit of the positions, angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleShape {
    /// At each corner.
    pub angles: [f64; 3],
    /// Opposite each corner.
    pub sides: [f64; 3],
    /// S.
    pub area: f64,
    /// r over R, the radius of the circle inside over that of the circle around: 1/2 for an equilateral triangle, 0 for one
    /// without area.
    pub roundness: f64,
}

impl TriangleShape {
    /// The shape of a triangle by its corners.
    pub fn of(corners: [Vec3; 3]) -> TriangleShape {
        let p = corners.map(Vec3::as_dvec3);
        let length = |v: DVec3| ops::sqrt(v.length_squared());
        let sides = [0, 1, 2].map(|k| length(p[(k + 2) % 3] - p[(k + 1) % 3]));
        let cross = length((p[1] - p[0]).cross(p[2] - p[0]));
        // The arc cosine of the text loses half the digits of small angles; this is the same angle.
        let angles = [0, 1, 2].map(|k| ops::atan2(cross, (p[(k + 1) % 3] - p[k]).dot(p[(k + 2) % 3] - p[k])));
        let area = cross / 2.0;
        let (sum, product) = (sides.iter().sum::<f64>(), sides.iter().product::<f64>());
        // r = 2S/(a + b + c) and R = abc/4S, the same as the roots in section 4.3.1.
        let roundness = if product > 0.0 { 8.0 * area * area / (sum * product) } else { 0.0 };
        TriangleShape { angles, sides, area, roundness }
    }

    /// r, the radius of the circle inside.
    pub fn inradius(&self) -> f64 {
        let sum = self.sides.iter().sum::<f64>();
        if sum > 0.0 { 2.0 * self.area / sum } else { 0.0 }
    }

    /// R, the radius of the circle around; infinite without area.
    pub fn circumradius(&self) -> f64 {
        if self.area > 0.0 { self.sides.iter().product::<f64>() / (4.0 * self.area) } else { f64::INFINITY }
    }
}

fn sorted(mut values: [f64; 3]) -> [f64; 3] {
    values.sort_unstable_by(f64::total_cmp);
    values
}

fn squares(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// Formula 4.1: the squared differences of the angles, smallest with smallest. 0 between similar triangles.
pub fn f1(a: &TriangleShape, b: &TriangleShape) -> f64 {
    squares(sorted(a.angles), sorted(b.angles))
}

/// Formula 4.3: the squared differences of the sides, shortest with shortest. 0 between congruent triangles.
pub fn f2(a: &TriangleShape, b: &TriangleShape) -> f64 {
    squares(sorted(a.sides), sorted(b.sides))
}

/// Formula 4.5: the squared difference of the areas.
pub fn f3(a: &TriangleShape, b: &TriangleShape) -> f64 {
    (a.area - b.area) * (a.area - b.area)
}

/// Formula 4.7: the square of the areas' ratio less 1. Not symmetric. Of two triangles without area 0; of the first over
/// one without area infinite.
pub fn f4(a: &TriangleShape, b: &TriangleShape) -> f64 {
    let ratio = if a.area == b.area { 1.0 } else { a.area / b.area };
    (ratio - 1.0) * (ratio - 1.0)
}

/// Formula 4.9, as printed: (r/R - 1)², from 1/4 for an equilateral triangle to 1 for one without area.
pub fn f5(triangle: &TriangleShape) -> f64 {
    (triangle.roundness - 1.0) * (triangle.roundness - 1.0)
}

/// Formula 4.10: the squared difference of f5.
pub fn f6(a: &TriangleShape, b: &TriangleShape) -> f64 {
    (f5(a) - f5(b)) * (f5(a) - f5(b))
}

/// Weights of f1, f2, f3, f4 and f6 (formula 4.12): 0 or more, with the sum 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights([f64; 5]);

impl Default for Weights {
    fn default() -> Weights {
        Weights::ANGLES
    }
}

impl Weights {
    /// Angles alone, as the thesis partitions: (1, 0, 0, 0, 0).
    pub const ANGLES: Weights = Weights([1.0, 0.0, 0.0, 0.0, 0.0]);

    /// k1, k2, k3, k4, k6.
    ///
    /// # Errors
    /// One below zero, or a sum that is not 1.
    pub fn new(weights: [f64; 5]) -> Result<Weights, SimilarityError> {
        let sum: f64 = weights.iter().sum();
        if weights.iter().all(|&k| k >= 0.0) && (sum - 1.0).abs() < 1e-9 {
            Ok(Weights(weights))
        } else {
            Err(SimilarityError::Weights { weights })
        }
    }

    /// The weighted sum (formula 4.12), angles and sides paired by size.
    pub fn measure(&self, a: &TriangleShape, b: &TriangleShape) -> f64 {
        self.sum([f1, f2].map(|f| f(a, b)), a, b)
    }

    /// The same with corner `order[i]` of `b` beside corner `i` of `a`: what holds where the corners are known.
    pub fn measure_in_order(&self, a: &TriangleShape, b: &TriangleShape, order: [usize; 3]) -> f64 {
        let ordered = [squares(a.angles, order.map(|i| b.angles[i])), squares(a.sides, order.map(|i| b.sides[i]))];
        self.sum(ordered, a, b)
    }

    fn sum(&self, [first, second]: [f64; 2], a: &TriangleShape, b: &TriangleShape) -> f64 {
        let values = [first, second, f3(a, b), f4(a, b), f6(a, b)];
        // What has no weight must not count even where it is infinite.
        self.0.iter().zip(values).filter(|(k, _)| **k > 0.0).map(|(k, value)| k * value).sum()
    }
}
