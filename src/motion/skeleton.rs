//! Limits of the channels: `rigs/skeleton.ron` as a type.

use super::{Channel, MotionError, Pose};
use serde::Deserialize;

/// Text of `rigs/skeleton.ron`.
pub const SKELETON: &str = include_str!("../../rigs/skeleton.ron");

/// One channel's joint, limits and source.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChannelSpec {
    /// Which one.
    pub id: Channel,
    /// The joint or soft part that moves: `neck`, `jaw`, `eye`, `lid`, `tongue`, `lips`, `ear`.
    pub joint: String,
    /// Least and most, in the unit of the id.
    pub range: (f32, f32),
    /// Where the limits come from.
    pub source: String,
}

/// The limits of every channel.
#[derive(Clone, Debug, PartialEq)]
pub struct JointLimits {
    specs: Vec<ChannelSpec>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: u32,
    channels: Vec<ChannelSpec>,
}

impl JointLimits {
    /// Reads the text of `rigs/skeleton.ron`; `file`: its name, for messages.
    ///
    /// # Errors
    /// Syntax with line and column; a channel that is missing, there twice, or whose range does not hold its rest, 0.
    pub fn parse(file: &str, text: &str) -> Result<Self, MotionError> {
        let read: File = ron::from_str(text).map_err(|e| MotionError::syntax(file, e))?;
        let row = |id: &str, problem: String| MotionError::Row { file: file.to_owned(), id: id.to_owned(), problem };
        if read.version != 1 {
            return Err(row("version", format!("is {}, this program reads 1", read.version)));
        }
        let mut specs = Vec::with_capacity(Channel::COUNT);
        for &channel in Channel::ALL {
            let mut of = read.channels.iter().filter(|s| s.id == channel);
            let spec = of.next().ok_or_else(|| row(channel.id(), "is missing".into()))?;
            if of.next().is_some() {
                return Err(row(channel.id(), "is there twice".into()));
            }
            let (least, most) = spec.range;
            if !(least <= 0.0 && 0.0 <= most && least.is_finite() && most.is_finite()) {
                return Err(row(channel.id(), format!("range {least} to {most} does not hold 0, the rest")));
            }
            specs.push(spec.clone());
        }
        Ok(Self { specs })
    }

    /// Those that are part of the program.
    ///
    /// # Errors
    /// Never: a test reads them.
    pub fn embedded() -> Result<Self, MotionError> {
        Self::parse("rigs/skeleton.ron", SKELETON)
    }

    /// Row of a channel.
    pub fn of(&self, channel: Channel) -> &ChannelSpec {
        &self.specs[channel as usize]
    }

    /// The pose with every channel inside its limits and every contraction in 0 to 1; what is no number is at rest.
    #[must_use]
    pub fn clamped(&self, pose: &Pose) -> Pose {
        let mut out = *pose;
        let within = |v: f32, (least, most): (f32, f32)| if v.is_nan() { 0.0 } else { v.clamp(least, most) };
        for spec in &self.specs {
            for v in out.channel_mut(spec.id) {
                *v = within(*v, spec.range);
            }
        }
        out.each_muscle(|v| *v = within(*v, (0.0, 1.0)));
        out
    }
}
