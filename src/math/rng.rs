//! A small seeded generator for tests and for sampling parameters. The seed is always written down by the caller.
//!
//! SplitMix64, after Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators".

use super::ops;

/// A stream of numbers that depends on the seed and on nothing else.
#[derive(Clone, Debug)]
pub struct Rng(u64);

impl Rng {
    /// A stream; equal seeds give equal streams.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn next_u64(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// The next 32 bits.
    pub fn next_u32(&mut self) -> u32 {
        (self.next_u64() >> 32) as u32
    }

    /// Evenly spread over 0 (inclusive) to 1 (exclusive).
    pub fn unit_f32(&mut self) -> f32 {
        (self.next_u64() >> 40) as f32 / (1_u32 << 24) as f32
    }

    /// Evenly spread over 0 (inclusive) to 1 (exclusive).
    pub fn unit_f64(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly spread between two numbers.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit_f32()
    }

    /// Normally distributed with mean 0 and variance 1, between -8.6 and 8.6; after Box and Muller 1958, "A note on the
    /// generation of random normal deviates", of whose two numbers the first is taken.
    pub fn normal(&mut self) -> f64 {
        // One less what is below one is above zero, so that its logarithm is finite.
        let radius = ops::sqrt(-2.0 * ops::ln(1.0 - self.unit_f64()));
        radius * ops::cos(std::f64::consts::TAU * self.unit_f64())
    }

    /// Evenly spread over 0 (inclusive) to `n` (exclusive); 0 where `n` is 0. The bias is below n / 2^64.
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.next_u64()) * n as u128) >> 64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::Rng;

    /// First outputs for the seed 1234567, as the reference implementation gives them.
    #[test]
    fn stream_is_not_splitmix64() {
        let mut rng = Rng::new(1_234_567);
        let expected = [6_457_827_717_110_365_317_u64, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423];
        assert_eq!([rng.next_u64(), rng.next_u64(), rng.next_u64()], expected);
    }

    #[test]
    fn a_number_leaves_its_range() {
        let mut rng = Rng::new(7);
        for _ in 0..10_000 {
            assert!((0.0..1.0).contains(&rng.unit_f32()));
            assert!((0.0..1.0).contains(&rng.unit_f64()));
            assert!((-2.0..=3.0).contains(&rng.between(-2.0, 3.0)));
            assert!(rng.below(5) < 5);
        }
        assert_eq!(rng.below(0), 0);
    }

    #[test]
    fn normal_deviates_have_another_mean_variance_or_kurtosis() {
        let mut rng = Rng::new(11);
        const N: usize = 100_000;
        let mut moments = [0.0; 3];
        for _ in 0..N {
            let x = rng.normal();
            assert!(x.abs() < 8.6);
            for (sum, power) in moments.iter_mut().zip([x, x * x, x * x * x * x]) {
                *sum += power / N as f64;
            }
        }
        let [mean, variance, fourth] = moments;
        // Four standard errors each.
        assert!(mean.abs() < 0.013 && (variance - 1.0).abs() < 0.018 && (fourth - 3.0).abs() < 0.13, "{moments:?}");
    }
}
