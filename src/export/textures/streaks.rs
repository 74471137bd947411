//! Noise that is smeared along the hair.

use super::smoothstep;
use crate::math::{noise, ops};
use glam::{Vec3, vec3};

/// Most samples to each side.
const MOST: i32 = 9;
/// From one sample to the next, widths of a streak.
const STEP: f32 = 0.9;
/// The root mean square of a streak.
const STRENGTH: f32 = 0.68;
/// That of a weighted sum of samples over the root of the sum of squares: more than the noise's own 0.3, since samples that
/// follow one another are alike.
const OF_SUM: f32 = 0.455;

/// Streaks at a place: three independent channels, about -1 to 1, their means 0. `along`: the unit direction of hair; `width`
/// of a streak and `length`, metres; `seed`: for another set. Line integral convolution after Cabral and Leedom 1993,
/// "Imaging vector fields using line integral convolution", along the tangent.
pub(super) fn streaks(place: Vec3, along: Vec3, width: f32, length: f32, seed: u32) -> Vec3 {
    let half = (0.5 * length / (STEP * width)).clamp(1.0, MOST as f32 - 0.5);
    let (mut sum, mut squares) = (Vec3::ZERO, 0.0);
    for k in -MOST..=MOST {
        let weight = (half + 0.5 - (k as f32).abs()).clamp(0.0, 1.0);
        if weight > 0.0 {
            let at = (place + along * (k as f32 * STEP * width)) / width;
            sum += noise::smooth(turned(at), seed) * weight;
            squares += weight * weight;
        }
    }
    sum * (STRENGTH / OF_SUM / ops::sqrt(squares))
}

/// A channel of [`streaks`] as a number from 0 to 1 whose values are about equally frequent: the logistic curve stands for
/// the normal distribution's.
pub(super) fn rank(streak: f32) -> f32 {
    1.0 / (1.0 + ops::exp(-1.702 / STRENGTH * streak))
}

/// Blobs `width` metres across, about -1 to 1.
pub(super) fn blobs(place: Vec3, width: f32, seed: u32) -> Vec3 {
    let coarse = noise::smooth(turned(place / width), seed);
    let fine = noise::smooth(turned(place * (2.1 / width)), seed ^ 0x2b);
    coarse + fine * 0.5
}

/// How much of a pattern of that width is drawn where a texel has that size: none that texels cannot hold.
pub(super) fn seen(texel: f32, width: f32) -> f32 {
    1.0 - smoothstep(0.6, 1.8, texel / width)
}

/// The lattice of the noise lies askew, or smearing along an axis would draw its cells.
fn turned(p: Vec3) -> Vec3 {
    vec3(p.dot(vec3(0.80, 0.36, -0.48)), p.dot(vec3(-0.60, 0.48, -0.64)), p.dot(vec3(0.0, 0.80, 0.60)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streaks_do_not_run_along_the_hair() {
        let (width, along) = (0.0004, Vec3::Z);
        let (mut there, mut across, mut square, mut tenths) = (0.0, 0.0, 0.0, [0; 10]);
        for i in 0..4000 {
            let place = vec3((i % 63) as f32 * 0.0031, (i / 63) as f32 * 0.0047, 0.1);
            let at = |offset: Vec3| streaks(place + offset, along, width, 0.006, 1).x;
            let here = at(Vec3::ZERO);
            square += here * here;
            tenths[(rank(here) * 10.0) as usize] += 1;
            there += here * at(Vec3::Z * (2.0 * width));
            across += here * at(Vec3::X * (2.0 * width));
        }
        assert!((square / 4000.0 / (STRENGTH * STRENGTH) - 1.0).abs() < 0.25, "strength {}", (square / 4000.0).sqrt());
        assert!(tenths.iter().all(|n| (200..700).contains(n)), "{tenths:?}");
        assert!(there / square > 0.7 && across / square < 0.15, "{} along, {} across", there / square, across / square);
    }
}
