//! What a dog does, in numbers that know no mesh: channels of joints, muscles, DogFACS units, expressions and clips.
//!
//! Time is an argument everywhere; the same arguments give the same bits.

mod channel;
mod muscle;
mod pose;
mod skeleton;

pub use channel::Channel;
pub use muscle::{Anchor, Kind, MUSCLES, Muscle, MuscleTable};
pub use pose::Pose;
pub use skeleton::{ChannelSpec, JointLimits, SKELETON};

/// Why a table of motion cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum MotionError {
    /// The text is not RON of the right form.
    #[error("{0}:{1}")]
    Syntax(String, ron::error::SpannedError),
    /// A row is wrong.
    #[error("{file}: {id}: {problem}")]
    Row {
        /// Name of the file.
        file: String,
        /// Id of the row.
        id: String,
        /// What is wrong, and what is allowed.
        problem: String,
    },
}
