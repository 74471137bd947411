//! Masks of √3 subdivision.
//!
//! Kobbelt 2000, "√3-Subdivision", SIGGRAPH: equation 1 (face point), equation 5 with the choice of 8 (old vertices),
//! section 5 (boundary). Navarro Newball, Wyvill and McCane 2008 repeat the relaxation as formula 6.
//!
//! At the boundary every second step trisects the boundary curve with the masks of the cubic B-spline; the other
//! steps leave it. The count of steps runs over the whole plan, so a plan is not the same as plans one after another.

use crate::math::ops;

use super::mask::{CurveMask, RingMask};

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
