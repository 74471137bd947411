//! What a dog does, in numbers that know no mesh: channels of joints, muscles, DogFACS units, expressions and clips.
//!
//! Time is an argument everywhere; the same arguments give the same bits.

mod act;
mod activation;
mod attention;
mod channel;
mod clip;
mod ease;
mod expression;
mod follow;
mod library;
mod life;
mod moment;
mod muscle;
mod notation;
mod player;
mod pose;
mod resolve;
mod rule;
mod skeleton;
mod spring;
mod target;
mod unit;

pub use act::{Act, Mixed};
pub use activation::{Activation, Side};
pub use attention::{Attention, Stimulus};
pub use channel::Channel;
pub use clip::{Blend, Clip, Layer, Moved, Track};
pub use ease::Ease;
pub use expression::{Beside, Expression, Part};
pub use follow::{Build, Follow};
pub use library::{CLIPS, EXPRESSIONS, Library};
pub use life::{Life, Temper};
pub use moment::Moment;
pub use muscle::{Anchor, Kind, MUSCLES, Muscle, MuscleTable, Wrinkles};
pub use notation::{Mistake, NotationError};
pub use player::{Cue, Player};
pub use pose::Pose;
pub use resolve::Overruled;
pub use rule::{Rule, RuleKind};
pub use skeleton::{ChannelSpec, JointLimits, SKELETON};
pub use spring::{STEP_SECS, Spring, steps_until};
pub use target::Target;
pub use unit::{
    Axis, Cycle, Drive, Gap, Group, LandmarkMotion, Sides, Status, Swing, UNITS, Unit, UnitError, UnitTable,
};

/// Why a table of motion cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum MotionError {
    /// The text is not RON of the right form.
    #[error("{0}:{1}")]
    Syntax(String, Box<ron::error::SpannedError>),
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

impl MotionError {
    /// A text that is not RON of the right form.
    pub(crate) fn syntax(file: &str, error: ron::error::SpannedError) -> Self {
        Self::Syntax(file.to_owned(), Box::new(error))
    }

    /// A mistake in a row.
    pub(crate) fn row(file: &str, id: &str, problem: impl Into<String>) -> Self {
        Self::Row { file: file.to_owned(), id: id.to_owned(), problem: problem.into() }
    }

    /// Refuses a file of another version than 1.
    pub(crate) fn check_version(file: &str, version: u32) -> Result<(), Self> {
        if version == 1 {
            return Ok(());
        }
        Err(Self::row(file, "version", format!("is {version}, this program reads 1")))
    }
}
