//! How many samples a pixel of a picture is the mean of.

use super::targets;
use std::str::FromStr;
use thiserror::Error;

/// Samples of one pixel: those that the device takes at a time, in a square of so many pixels a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples {
    side: u32,
}

/// A word that is no number of samples.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{0}` is no number of samples; say 4 (fast), 16, 36 or 64 (smooth)")]
pub struct SamplesError(String);

impl Default for Samples {
    /// Sixteen: hair is finer than a pixel.
    fn default() -> Self {
        Self { side: 2 }
    }
}

impl Samples {
    /// As few as there can be.
    pub const FEWEST: Self = Self { side: 1 };

    /// Every number, fewest first.
    pub const ALL: [Self; 4] = [Self::FEWEST, Self { side: 2 }, Self { side: 3 }, Self { side: 4 }];

    /// How many.
    pub const fn count(self) -> u32 {
        self.side * self.side * targets::SAMPLES
    }

    /// How many times as wide and high the picture is drawn.
    pub(super) const fn side(self) -> u32 {
        self.side
    }
}

impl FromStr for Samples {
    type Err = SamplesError;

    fn from_str(text: &str) -> Result<Self, SamplesError> {
        let count = text.parse::<u32>().ok();
        let found = Self::ALL.into_iter().find(|samples| Some(samples.count()) == count);
        found.ok_or_else(|| SamplesError(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::Samples;

    #[test]
    fn a_number_of_samples_is_refused_without_the_allowed_ones() {
        for samples in Samples::ALL {
            assert_eq!(samples.count().to_string().parse(), Ok(samples));
        }
        for text in ["", "0", "1", "5", "-4", "4.0", "1024"] {
            let error = text.parse::<Samples>().unwrap_err().to_string();
            assert!(Samples::ALL.iter().all(|s| error.contains(&s.count().to_string())), "{error}");
        }
    }
}
