//! Masks of interpolating √3 subdivision.
//!
//! Labsik and Greiner 2000, "Interpolatory √3-Subdivision", sections 3 and 4. The constants near a boundary are those of
//! OpenMesh's `InterpolatingSqrt3LGT`, found by measuring it (the reference data say so) and not from the paper.

use crate::math::ops;

/// The corners of the face.
pub const CORNERS: f64 = 32.0 / 81.0;
/// The corners across its three sides.
pub const ACROSS: f64 = -1.0 / 81.0;
/// The six corners beyond those.
pub const BEYOND: f64 = -2.0 / 81.0;

/// At a third of a boundary edge that is cut: the point before, the near end, the far end, the point after.
pub const BOUNDARY_POINT: [f64; 4] = [-5.0 / 81.0, 60.0 / 81.0, 30.0 / 81.0, -4.0 / 81.0];

/// In a face with one boundary side: its apex, each end of the side, each corner across the inner sides.
pub const ONE_SIDE: [f64; 3] = [1.0 / 2.0, 1.0 / 3.0, -1.0 / 12.0];
/// In a face with two boundary sides: the corner they share, each other corner, the corner across the inner side.
pub const TWO_SIDES: [f64; 3] = [7.0 / 24.0, 3.0 / 8.0, -1.0 / 24.0];

/// An extraordinary vertex of valence `n` in the middle of a face next to it: its own weight.
pub fn extraordinary_centre(n: usize) -> f64 {
    match n {
        2 | 3 => 8.0 / 9.0,
        4 => 7.0 / 9.0,
        _ => {
            let a = shrink(n);
            1.0 - a * a
        }
    }
}

/// The weight of its neighbour `i`, counter-clockwise; neighbours 0 and `n - 1` are corners of the face.
pub fn extraordinary(n: usize, i: usize) -> f64 {
    match n {
        2 => [1.0 / 18.0, 1.0 / 18.0][i],
        3 => [4.0 / 27.0, -5.0 / 27.0, 4.0 / 27.0][i],
        4 => [2.0 / 9.0, -1.0 / 9.0, -1.0 / 9.0, 2.0 / 9.0][i],
        _ => {
            let a = shrink(n);
            let angle = std::f64::consts::TAU * (i as f64 + 0.5) / n as f64;
            (a * a + 2.0 * a * ops::cos(angle) + 2.0 * a * a * ops::cos(2.0 * angle)) / n as f64
        }
    }
}

/// The eigenvalue of the tangents: 2/3 cos(π/n).
fn shrink(n: usize) -> f64 {
    2.0 / 3.0 * ops::cos(std::f64::consts::PI / n as f64)
}
