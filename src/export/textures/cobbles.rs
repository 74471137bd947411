//! The cobbled leather of a nose, after Worley 1996, "A cellular texture basis function".

use super::smoothstep;
use crate::math::{noise, ops};
use glam::{IVec3, Vec3};

const SEED: u32 = 0x0c0b;

/// At a place in cells: the way from the middle of the nearest cobble, and its height, 1 on a cobble and 0 in a furrow.
pub(super) fn cobble(place: Vec3) -> (Vec3, f32) {
    let base = place.floor();
    let (mut first, mut second, mut outward) = (9.0_f32, 9.0_f32, Vec3::ZERO);
    for i in 0..27 {
        let cell = base.as_ivec3() + IVec3::new(i % 3, (i / 3) % 3, i / 9) - IVec3::ONE;
        let offset = place - (cell.as_vec3() + 0.15 + 0.7 * noise::cell(cell, SEED));
        let distance = offset.length_squared();
        if distance < first {
            (second, first, outward) = (first, distance, offset);
        } else {
            second = second.min(distance);
        }
    }
    (outward, smoothstep(0.0, 0.35, ops::sqrt(second) - ops::sqrt(first)))
}
