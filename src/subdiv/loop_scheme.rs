//! Masks of Loop subdivision.
//!
//! Loop 1987, "Smooth Subdivision Surfaces Based on Triangles", chapter 3 (edge points; old vertices with α = 5/8 -
//! (3/8 + cos(2π/n)/4)²); Warren 1995 (other weights of old vertices, no cosine); Hoppe and others 1994, table 1
//! (creases). The limits are left eigenvectors of one step on the one-ring.

use crate::math::ops;

use super::limit::LimitMask;
use super::mask::{CurveMask, RingMask};
use super::scheme::LoopWeights;

/// The middle of a smooth edge: its two ends, then the two corners across.
pub const EDGE_POINT: [f64; 4] = [3.0 / 8.0, 3.0 / 8.0, 1.0 / 8.0, 1.0 / 8.0];

/// The middle of a sharp edge or of one on the boundary.
pub const CREASE_POINT: [f64; 2] = [0.5, 0.5];

/// An old vertex on a crease or a boundary: the cubic B-spline.
pub const CREASE_VERTEX: CurveMask = CurveMask { before: 1.0 / 8.0, centre: 6.0 / 8.0, after: 1.0 / 8.0 };

/// How much of an old vertex of valence `n` its neighbours make up together.
pub fn alpha(n: usize, weights: LoopWeights) -> f64 {
    match weights {
        LoopWeights::Loop => {
            let c = 3.0 + 2.0 * ops::cos(std::f64::consts::TAU / n as f64);
            (40.0 - c * c) / 64.0
        }
        LoopWeights::Warren if n == 3 => 9.0 / 16.0,
        LoopWeights::Warren => 3.0 / 8.0,
    }
}

/// An old vertex of valence `n` inside the surface.
pub fn inner_vertex(n: usize, weights: LoopWeights) -> RingMask {
    let alpha = alpha(n, weights);
    RingMask { centre: 1.0 - alpha, neighbour: alpha / n as f64 }
}

/// Where a vertex of valence `n` inside the surface goes, and its tangents.
pub fn limit_inner(n: usize, weights: LoopWeights) -> LimitMask {
    // The left eigenvector of eigenvalue 1: a step leaves 3/8 of the vertex in the mean of its ring, and puts α of the
    // ring's mean into the vertex.
    let alpha = alpha(n, weights);
    LimitMask::smooth(n, alpha / (alpha + 3.0 / 8.0))
}

/// Where a vertex on a curve goes.
pub const LIMIT_CURVE: CurveMask = CurveMask { before: 1.0 / 6.0, centre: 4.0 / 6.0, after: 1.0 / 6.0 };

/// The tangent across a curve at a vertex with `k` triangles on this side: weights of the vertex, then of the `k + 1`
/// neighbours there, counter-clockwise. Eigenvalue 3/8 + cos(π/k)/4.
///
/// The formula often quoted (Hoppe and others 1994) is no eigenvector of the masks above from four triangles on.
pub fn across(k: usize) -> Vec<f64> {
    if k == 1 {
        return vec![-2.0, 1.0, 1.0];
    }
    let theta = std::f64::consts::PI / k as f64;
    let half = theta / 2.0;
    let cot = ops::cos(half) / ops::sin(half);
    // At two triangles the quotient is 0/0 in form only: cos θ = 0.
    let end = (ops::sin(theta) - cot) / (2.0 * ops::cos(theta) + 1.0);
    let centre = (2.0 * ops::cos(theta) - 1.0) * end - ops::sin(theta);
    let mut weights = vec![centre, end];
    weights.extend((1..k).map(|i| ops::sin(i as f64 * theta)));
    weights.push(end);
    weights
}
