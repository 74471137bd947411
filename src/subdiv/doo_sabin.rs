//! The mask of Doo-Sabin subdivision.
//!
//! Doo and Sabin 1978, "Behaviour of recursive division surfaces near extraordinary points": a new vertex for each corner
//! of each face, from the corners of that face alone.

use crate::math::ops;

/// In a face of `n` corners, the weight of the corner `k` steps on from the one that the new vertex belongs to.
pub fn corner(n: usize, k: usize) -> f64 {
    if k == 0 {
        return (n as f64 + 5.0) / (4.0 * n as f64);
    }
    (3.0 + 2.0 * ops::cos(std::f64::consts::TAU * k as f64 / n as f64)) / (4.0 * n as f64)
}
