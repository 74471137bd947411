//! What is asked for at one moment: units, and what a clip or life moves beside them.

use super::{Activation, Pose};

/// Units as they are asked for, not yet resolved, and what is added to the pose that they make.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Moment {
    /// By unit.
    pub units: Activation,
    /// By channel and muscle.
    pub direct: Pose,
}

impl Moment {
    /// Adds another one, each value times `weight`.
    pub fn add(&mut self, other: &Self, weight: f32) {
        self.units.add(&other.units, weight);
        self.direct.add(&other.direct, weight);
    }
}

impl From<Activation> for Moment {
    fn from(units: Activation) -> Self {
        Self { units, direct: Pose::default() }
    }
}
