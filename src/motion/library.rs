//! All tables of motion that are part of the program.

use super::{
    Activation, Clip, Expression, JointLimits, Moment, MotionError, MuscleTable, Overruled, Pose, UNITS, UnitTable,
};

macro_rules! texts {
    ($folder:literal: $($id:literal)*) => {
        [$((concat!("rigs/", $folder, "/", $id, ".ron"), include_str!(concat!("../../rigs/", $folder, "/", $id, ".ron"))),)*]
    };
}

/// Names and texts of `rigs/expressions`, in the order of panels and lists.
pub const EXPRESSIONS: [(&str, &str); 19] = texts!("expressions":
    "neutral" "anger" "anger_defensive" "affection" "attention" "fear" "happiness" "yawning" "smelling" "panting" "licking"
    "lapping" "barking" "howling" "sleepy" "play_face" "puppy_eyes" "positive_anticipation" "frustration");

/// Names and texts of `rigs/clips`, in the order of panels and lists.
pub const CLIPS: [(&str, &str); 17] = texts!("clips":
    "idle" "blink" "look_around" "ear_flick" "pant" "sniff" "lap" "lick" "nose_lick" "lip_wipe" "chew" "swallow" "bite" "bark"
    "howl" "yawn" "head_shake");

/// Muscles, units, expressions and clips that know each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Library {
    /// Limits of the channels.
    pub limits: JointLimits,
    /// Muscles.
    pub muscles: MuscleTable,
    /// Units and their rules.
    pub units: UnitTable,
    /// Expressions.
    pub expressions: Vec<Expression>,
    /// Clips.
    pub clips: Vec<Clip>,
}

impl Library {
    /// What is part of the program.
    ///
    /// # Errors
    /// Never: a test reads it all.
    pub fn embedded() -> Result<Self, MotionError> {
        let (limits, muscles) = (JointLimits::embedded()?, MuscleTable::embedded()?);
        let units = UnitTable::parse("rigs/units.ron", UNITS, &muscles)?;
        let expressions = EXPRESSIONS.map(|(file, text)| Expression::parse(file, text, &units));
        let clips = CLIPS.map(|(file, text)| Clip::parse(file, text, &units, &muscles));
        Ok(Self {
            limits,
            expressions: expressions.into_iter().collect::<Result<_, _>>()?,
            clips: clips.into_iter().collect::<Result<_, _>>()?,
            muscles,
            units,
        })
    }

    /// The expression of that id.
    pub fn expression(&self, id: &str) -> Option<&Expression> {
        self.expressions.iter().find(|expression| expression.id == id)
    }

    /// The clip of that id.
    pub fn clip(&self, id: &str) -> Option<&Clip> {
        self.clips.iter().find(|clip| clip.id == id)
    }

    /// The pose of what is asked for at a time, in seconds: units resolved, their rhythms going, what goes directly added,
    /// everything inside the limits. `tell` hears what was overruled. Allocates nothing.
    #[must_use]
    pub fn pose(&self, moment: &Moment, time: f64, tell: impl FnMut(Overruled)) -> Pose {
        let resolved = self.units.resolve(&moment.units, tell);
        let mut pose = self.units.drive(&resolved);
        self.units.swing(&resolved, time, &mut pose);
        pose.add(&moment.direct, 1.0);
        self.limits.clamped(&pose)
    }

    /// The pose of units alone, their rhythms standing still.
    #[must_use]
    pub fn pose_of(&self, asked: &Activation) -> Pose {
        self.units.pose(&self.units.resolve(asked, |_| ()), &self.limits)
    }
}
