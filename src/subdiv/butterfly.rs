//! Masks of the modified butterfly.
//!
//! Zorin, Schröder and Sweldens 1996, "Interpolating Subdivision for Meshes with Arbitrary Topology", section 3 (the
//! eight-point mask without its free weight, after Dyn, Levin and Gregory 1990; the masks of extraordinary vertices;
//! the four-point mask on boundaries).
//!
//! Near a boundary a corner of the eight-point mask may be missing. It is then completed to a parallelogram, a + b - c,
//! as OpenMesh does, which reproduces linear functions; Zorin's thesis has other masks there. Ours: the same across a
//! crease, so that each of its sides knows nothing of the other.

use crate::math::ops;

/// The ends of the edge.
pub const ENDS: f64 = 1.0 / 2.0;
/// The corners across, left and right.
pub const APEXES: f64 = 1.0 / 8.0;
/// The four wings: corners across the edges that join an end to an apex.
pub const WINGS: f64 = -1.0 / 16.0;

/// The middle of a boundary or sharp edge: the two ends.
pub const CURVE_ENDS: f64 = 9.0 / 16.0;
/// And the next points along the curve on both sides.
pub const CURVE_BEYOND: f64 = -1.0 / 16.0;

/// What remains for the extraordinary vertex itself.
pub const EXTRAORDINARY_CENTRE: f64 = 3.0 / 4.0;

/// Weight of neighbour `j` of an extraordinary vertex of valence `n`, counted counter-clockwise from the other end of the
/// edge.
pub fn extraordinary(n: usize, j: usize) -> f64 {
    match n {
        // Both neighbours of a pillow: the mean of the rule for three, whose two side weights fall on one vertex.
        2 => [5.0 / 12.0, -1.0 / 6.0][j],
        3 => [5.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0][j],
        4 => [3.0 / 8.0, 0.0, -1.0 / 8.0, 0.0][j],
        _ => {
            let angle = std::f64::consts::TAU * j as f64 / n as f64;
            (0.25 + ops::cos(angle) + 0.5 * ops::cos(2.0 * angle)) / n as f64
        }
    }
}
