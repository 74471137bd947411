//! Masks of Catmull-Clark subdivision.
//!
//! Catmull and Clark 1978, "Recursively generated B-spline surfaces on arbitrary topological meshes"; DeRose, Kass and
//! Truong 1998 (creases and boundaries). A face point is the mean of the corners.

use super::mask::CurveMask;

/// The middle of an edge inside the surface: each end, and each of the two face points.
pub const EDGE_POINT: [f64; 2] = [1.0 / 4.0, 1.0 / 4.0];

/// The middle of a sharp edge or of one on the boundary.
pub const CREASE_POINT: [f64; 2] = [0.5, 0.5];

/// An old vertex on a crease or a boundary.
pub const CREASE_VERTEX: CurveMask = CurveMask { before: 1.0 / 8.0, centre: 6.0 / 8.0, after: 1.0 / 8.0 };

/// An old vertex of valence `n` inside the surface: itself, each neighbour along an edge, each face point around.
pub fn inner_vertex(n: usize) -> [f64; 3] {
    let n = n as f64;
    [(n - 2.0) / n, 1.0 / (n * n), 1.0 / (n * n)]
}
