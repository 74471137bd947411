//! Masks of √3 subdivision.
//!
//! Kobbelt 2000, "√3-Subdivision", SIGGRAPH: equation 1 (face point), equation 5 with the choice of 8 (old vertices),
//! section 5 (boundary). Navarro Newball, Wyvill and McCane 2008 repeat the relaxation as formula 6.
//!
//! At the boundary every second step trisects the boundary curve with the masks of the cubic B-spline; the other
//! steps leave it. The count of steps runs over the whole plan, so a plan is not the same as plans one after another.

use crate::math::ops;

use super::limit::LimitMask;
use super::mask::{CurveMask, RingMask};
use super::scheme::BoundaryStep;

/// A new vertex in the middle of a face: the mean of its three corners (equation 1).
pub const FACE_POINT: [f64; 3] = [1.0 / 3.0; 3];

/// An old boundary vertex in a trisecting step.
pub const BOUNDARY_VERTEX: CurveMask = CurveMask { before: 4.0 / 27.0, centre: 19.0 / 27.0, after: 4.0 / 27.0 };

/// A new boundary vertex in a trisecting step, at a third of the edge from `centre` to `after`.
/// At two thirds it is the same mask, reversed, about the other end.
pub const BOUNDARY_POINT: CurveMask = CurveMask { before: 1.0 / 27.0, centre: 16.0 / 27.0, after: 10.0 / 27.0 };

/// How far an old vertex of valence `n` moves to the mean of its neighbours: (4 - 2 cos(2π/n)) / 9.
pub fn alpha(n: usize) -> f64 {
    (4.0 - 2.0 * ops::cos(std::f64::consts::TAU / n as f64)) / 9.0
}

/// An old vertex of valence `n` inside the surface (equation 5).
pub fn inner_vertex(n: usize) -> RingMask {
    let alpha = alpha(n);
    RingMask { centre: 1.0 - alpha, neighbour: alpha / n as f64 }
}

/// Where a vertex of valence `n` inside the surface goes, and its tangents: β = 3α/(1 + 3α), the left eigenvector of a
/// step that leaves 2/3 of itself in the mean of the ring.
pub fn limit_inner(n: usize) -> LimitMask {
    let alpha = alpha(n);
    LimitMask::smooth(n, 3.0 * alpha / (1.0 + 3.0 * alpha))
}

/// Where a vertex on a curve goes, at every level.
pub const LIMIT_CURVE: CurveMask = CurveMask { before: 1.0 / 6.0, centre: 4.0 / 6.0, after: 1.0 / 6.0 };

/// The tangent across a curve at a vertex with `k` triangles on this side, at a level from which `next` leads on: weights
/// of the vertex, then of the `k + 1` neighbours there, counter-clockwise. Eigenvalue (2 + 2 cos θ)/9 over two steps, θ =
/// π over the triangles there before a keeping step.
pub fn across(k: usize, next: BoundaryStep) -> Vec<f64> {
    let coarse = match next {
        BoundaryStep::Keep => k,
        // A keeping step has put one triangle more on this side.
        BoundaryStep::Trisect => k.saturating_sub(1).max(1),
    };
    let theta = std::f64::consts::PI / coarse as f64;
    let (sine, cosine) = (ops::sin(theta), ops::cos(theta));
    let cot = ops::cos(theta / 2.0) / ops::sin(theta / 2.0);
    let (centre, end) = if coarse == 1 {
        // The curve's own second difference.
        (-2.0, 1.0)
    } else {
        let end = (3.0 * sine - 4.0 * cot) / (3.0 * (1.0 + 2.0 * cosine));
        (-2.0 * end - cot, end)
    };
    match next {
        BoundaryStep::Keep => {
            let mut weights = vec![centre, end];
            weights.extend((1..coarse).map(|i| ops::sin(i as f64 * theta)));
            weights.push(end);
            weights
        }
        BoundaryStep::Trisect => {
            let cot = if coarse == 1 { 0.0 } else { cot };
            let outer = 4.0 / 27.0 * centre + 11.0 / 27.0 * end;
            let mut weights = vec![19.0 / 27.0 * centre + 32.0 / 27.0 * end + cot / 3.0, outer];
            let sine_at = |j: usize| if coarse == 1 { 0.0 } else { ops::sin(j as f64 * theta) };
            weights.extend((0..coarse).map(|j| (sine_at(j) + sine_at(j + 1)) / 3.0));
            weights.push(outer);
            weights
        }
    }
}
