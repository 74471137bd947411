//! Noise that is bound to places: the same bits on every machine, from whole numbers alone.

use glam::{IVec3, Vec3};

/// Three random words for a cell; after Jarzynski and Olano 2020, "Hash Functions for GPU Rendering" (pcg3d).
fn scrambled(cell: IVec3, seed: u32) -> [u32; 3] {
    let [mut x, mut y, mut z] =
        cell.to_array().map(|c| (c as u32).wrapping_add(seed).wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    for round in 0..2 {
        x = x.wrapping_add(y.wrapping_mul(z));
        y = y.wrapping_add(z.wrapping_mul(x));
        z = z.wrapping_add(x.wrapping_mul(y));
        if round == 0 {
            x ^= x >> 16;
            y ^= y >> 16;
            z ^= z >> 16;
        }
    }
    [x, y, z]
}

/// A word as a number from 0 to below 1.
fn unit(word: u32) -> f32 {
    (word >> 8) as f32 / (1 << 24) as f32
}

/// Three random numbers for a cell, each 0 to below 1.
pub fn cell(cell: IVec3, seed: u32) -> Vec3 {
    Vec3::from(scrambled(cell, seed).map(unit))
}

/// A random number for a thing that has a number of its own, such as a hair, and a purpose; 0 to below 1.
pub fn of_number(number: u32, purpose: u32) -> f32 {
    let [x, ..] = scrambled(IVec3::new(number as i32, (number >> 7) as i32, purpose as i32), 0x68_61_69_72);
    unit(x)
}

/// Smooth noise with blobs one unit across: three independent channels, each -1 to 1, its mean 0.
pub fn smooth(place: Vec3, seed: u32) -> Vec3 {
    let floor = place.floor();
    let base = floor.as_ivec3();
    let f = place - floor;
    let f = f * f * (Vec3::splat(3.0) - 2.0 * f);
    let corner = |x, y, z| cell(base + IVec3::new(x, y, z), seed);
    let row = |y, z| corner(0, y, z).lerp(corner(1, y, z), f.x);
    let plane = |z| row(0, z).lerp(row(1, z), f.y);
    plane(0).lerp(plane(1), f.z) * 2.0 - Vec3::ONE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_one_sided_or_jumps() {
        let mut sum = Vec3::ZERO;
        let n = 20_000;
        for i in 0..n {
            let place = Vec3::new(i as f32 * 0.37, i as f32 * 0.11 - 900.0, (i % 77) as f32 * 0.53);
            let here = smooth(place, 7);
            assert!(here.abs().max_element() <= 1.0);
            assert!((smooth(place + Vec3::splat(1e-3), 7) - here).length() < 0.02, "{place}");
            sum += here;
        }
        assert!((sum / n as f32).abs().max_element() < 0.03, "{}", sum / n as f32);
    }
}
