//! What a unit, a cycle or a clip moves: a channel or a muscle, by its name.

use super::{Channel, MuscleTable, Pose};

/// A channel or a muscle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// In the unit of its id.
    Channel(Channel),
    /// By its number in the table; contraction 0 to 1.
    Muscle(usize),
}

impl Target {
    /// The channel or the muscle of that id.
    pub fn named(id: &str, muscles: &MuscleTable) -> Option<Self> {
        Channel::from_id(id).map(Self::Channel).or_else(|| muscles.index_of(id).map(Self::Muscle))
    }

    /// Its name; empty for a muscle that the table does not have.
    pub fn id(self, muscles: &MuscleTable) -> &str {
        match self {
            Self::Channel(channel) => channel.id(),
            Self::Muscle(muscle) => muscles.muscles.get(muscle).map_or("", |muscle| muscle.id.as_str()),
        }
    }

    /// Whether there is but one for the head.
    pub fn is_median(self) -> bool {
        matches!(self, Self::Channel(channel) if channel.is_median())
    }

    /// Whether its sign tells left from right.
    pub fn is_lateral(self) -> bool {
        matches!(self, Self::Channel(channel) if channel.is_lateral())
    }

    /// Whether of two wishes the larger one counts, not their sum; so it is with every muscle.
    pub fn takes_largest(self) -> bool {
        match self {
            Self::Channel(channel) => channel.takes_largest(),
            Self::Muscle(_) => true,
        }
    }

    /// Left and right, to be written; of a median channel the left one counts.
    pub fn of(self, pose: &mut Pose) -> &mut [f32; 2] {
        match self {
            Self::Channel(channel) => pose.channel_mut(channel),
            Self::Muscle(muscle) => pose.muscle_mut(muscle),
        }
    }
}
