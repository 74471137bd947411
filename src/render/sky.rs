//! A small sky: three colours from straight up to straight down, and how much of it each surface gathers.

use glam::Vec3;

/// Radiance, linear, the same all around the vertical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sky {
    pub(super) zenith: Vec3,
    pub(super) horizon: Vec3,
    pub(super) ground: Vec3,
}

impl Sky {
    /// In a direction whose cosine to the vertical is `up`. `sky` of `light.wgsl` says the same.
    pub(super) fn radiance(&self, up: f32) -> Vec3 {
        let t = ((up.abs() - 0.05) / 0.8).clamp(0.0, 1.0);
        let end = if up > 0.0 { self.zenith } else { self.ground };
        self.horizon.lerp(end, t * t * (3.0 - 2.0 * t))
    }

    /// What a matt surface sends back of it, as the factors of the first three Legendre polynomials of the cosine between
    /// its normal and the vertical: the terms that matter of a cosine's convolution, after Ramamoorthi and Hanrahan 2001,
    /// "An efficient representation for irradiance environment maps".
    pub(super) fn gathered(&self) -> [Vec3; 3] {
        const STEPS: u32 = 64;
        let mut sums = [Vec3::ZERO; 3];
        for i in 0..STEPS {
            let up = (i as f32 + 0.5) * (2.0 / STEPS as f32) - 1.0;
            let light = self.radiance(up) * (2.0 / STEPS as f32);
            for (sum, legendre) in sums.iter_mut().zip([1.0, up, 1.5 * up * up - 0.5]) {
                *sum += light * legendre;
            }
        }
        let [a, b, c] = sums;
        // (2 l + 1) / 2 of the projection, times 1, 2/3 and 1/4 of the convolution.
        [a * 0.5, b, c * 0.625]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_even_sky_lights_one_side_more() {
        let [all, up, bent] =
            Sky { zenith: Vec3::ONE, horizon: Vec3::ONE, ground: Vec3::ONE }.gathered().map(|light| light.x);
        assert!((all - 1.0).abs() < 1e-5 && up.abs() < 1e-5 && bent.abs() < 1e-3, "{all} {up} {bent}");
    }

    #[test]
    fn a_surface_below_the_sky_is_darker_than_one_that_turns_from_it() {
        let sky = Sky { zenith: Vec3::ONE, horizon: Vec3::splat(0.5), ground: Vec3::ZERO };
        let [all, up, bent] = sky.gathered().map(|light| light.x);
        let gathered = |c: f32| all + up * c + bent * (1.5 * c * c - 0.5);
        assert!(gathered(1.0) > gathered(0.0) && gathered(0.0) > gathered(-1.0) && gathered(-1.0) >= 0.0);
        assert!(gathered(1.0) < 1.0, "more than all of it");
    }
}
