//! How a value goes from one key to the next.

use serde::Deserialize;

/// The course between two keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
pub enum Ease {
    /// It starts and ends without speed.
    #[default]
    Smooth,
    /// At one speed.
    Linear,
    /// It stays until the next key.
    Hold,
    /// It starts without speed.
    In,
    /// It ends without speed.
    Out,
}

impl Ease {
    /// 0 to 1 for 0 to 1.
    pub fn at(self, x: f32) -> f32 {
        match self {
            Self::Smooth => x * x * (3.0 - 2.0 * x),
            Self::Linear => x,
            Self::Hold => 0.0,
            Self::In => x * x,
            Self::Out => x * (2.0 - x),
        }
    }
}

/// Up within `onset`, there for `hold`, and down within `offset`, all in seconds from `since` 0 on; 0 outside. No duration
/// need be above 0.
pub fn envelope(since: f64, onset: f64, hold: f64, offset: f64) -> f32 {
    let left = onset + hold + offset - since;
    if since < 0.0 || left <= 0.0 {
        return 0.0;
    }
    let part = |of: f64, whole: f64| if of < whole { Ease::Smooth.at((of / whole) as f32) } else { 1.0 };
    part(since, onset).min(part(left, offset))
}
