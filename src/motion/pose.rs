//! A pose: how far each joint is turned and each muscle contracted at one moment.

use super::channel::Channel;
use super::muscle::MuscleTable;

/// What a dog does at one moment; at rest by default. Each value is a pair, the dog's left and right; of a median channel
/// the left one counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// By [`Channel`], in the unit of its id.
    channels: [[f32; 2]; Channel::COUNT],
    /// By the number of a muscle in the embedded table, 0 to 1.
    muscles: [[f32; 2]; MuscleTable::MOST],
}

impl Default for Pose {
    fn default() -> Self {
        Self { channels: [[0.0; 2]; Channel::COUNT], muscles: [[0.0; 2]; MuscleTable::MOST] }
    }
}

impl Pose {
    /// Left and right of a channel; twice the same of a median one.
    pub fn channel(&self, channel: Channel) -> [f32; 2] {
        let [left, right] = self.channels[channel as usize];
        if channel.is_median() { [left; 2] } else { [left, right] }
    }

    /// A median channel, or the left one.
    pub fn median(&self, channel: Channel) -> f32 {
        self.channels[channel as usize][0]
    }

    /// Left and right of a channel, to be written.
    pub fn channel_mut(&mut self, channel: Channel) -> &mut [f32; 2] {
        &mut self.channels[channel as usize]
    }

    /// The same pose with another value of a channel on both sides.
    #[must_use]
    pub fn with(mut self, channel: Channel, value: f32) -> Self {
        self.channels[channel as usize] = [value; 2];
        self
    }

    /// The same pose with other values of a channel, left and right.
    #[must_use]
    pub fn with_sides(mut self, channel: Channel, sides: [f32; 2]) -> Self {
        self.channels[channel as usize] = sides;
        self
    }

    /// Contraction of a muscle, left and right; `muscle`: its number in the table.
    pub fn muscle(&self, muscle: usize) -> [f32; 2] {
        self.muscles[muscle]
    }

    /// Contraction of a muscle, left and right, to be written.
    pub fn muscle_mut(&mut self, muscle: usize) -> &mut [f32; 2] {
        &mut self.muscles[muscle]
    }

    /// Adds another pose, each value times `weight`.
    pub fn add(&mut self, other: &Self, weight: f32) {
        let mine = self.channels.iter_mut().chain(&mut self.muscles).flatten();
        for (mine, theirs) in mine.zip(other.channels.iter().chain(&other.muscles).flatten()) {
            *mine += weight * theirs;
        }
    }

    /// Changes every contraction.
    pub(super) fn each_muscle(&mut self, mut change: impl FnMut(&mut f32)) {
        self.muscles.iter_mut().flatten().for_each(&mut change);
    }

    /// Whether nothing moves.
    pub fn is_rest(&self) -> bool {
        *self == Self::default()
    }
}
