//! DogFACS: every code as a control 0 to 1, `rigs/units.ron` as a type. A unit drives muscles and channels.
//!
//! After Waller, Caeiro, Peirce, Burrows, Kaminski 2013, "DogFACS: The Dog Facial Action Coding System". Which muscle a code
//! belongs to is theirs where a row says sourced; how far what moves, and which channel it takes, is ours.

use super::{Activation, JointLimits, MotionError, MuscleTable, Pose, Rule, Side, Target, rule};
use crate::anatomy::nearest;
use crate::math::ops;
use serde::{Deserialize, Serialize};

/// Text of `rigs/units.ron`.
pub const UNITS: &str = include_str!("../../rigs/units.ron");

/// What part of the head a unit moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Group {
    /// Brows and lids.
    UpperFace,
    /// Nose, lips, cheeks, jaw.
    LowerFace,
    /// Ears.
    Ears,
    /// The head on its neck.
    Head,
    /// Eyeballs.
    Eyes,
    /// The tongue, and what goes with it.
    Tongue,
    /// Behaviour over time: a clip stands for it.
    Gross,
}

impl Group {
    /// Every group, in the order of panels and lists.
    pub const ALL: [Self; 7] =
        [Self::UpperFace, Self::LowerFace, Self::Ears, Self::Head, Self::Eyes, Self::Tongue, Self::Gross];

    /// Its heading.
    pub const fn label(self) -> &'static str {
        match self {
            Self::UpperFace => "upper face",
            Self::LowerFace => "lower face",
            Self::Ears => "ears",
            Self::Head => "head",
            Self::Eyes => "eyes",
            Self::Tongue => "tongue",
            Self::Gross => "behaviour",
        }
    }
}

/// On which sides a unit can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sides {
    /// On each alone.
    Each,
    /// On both together.
    Together,
    /// There is but one.
    Median,
}

/// Whether what a row says is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// Code and muscle from a source; sizes are constructed all the same.
    Sourced,
    /// Constructed from general knowledge.
    Constructed,
}

/// A direction of the head's frame, for a landmark on the dog's left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Axis {
    /// To the dog's left, which is away from the median plane.
    X,
    /// Up.
    Y,
    /// Forward.
    Z,
}

/// What a unit moves, and how far at 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// The channel or muscle.
    pub target: Target,
    /// In the channel's unit, or contraction.
    pub value: f32,
}

/// Where a landmark goes at 1, along one axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LandmarkMotion(
    /// Its id, without a side.
    pub String,
    /// Along which axis.
    pub Axis,
    /// Least, millimetres on a head with a skull of 200 mm.
    pub f32,
    /// Most.
    pub f32,
);

/// How far two landmarks that touch at rest are apart at 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gap(
    /// One landmark's id.
    pub String,
    /// The other's.
    pub String,
    /// Least, millimetres on a head with a skull of 200 mm.
    pub f32,
    /// Most.
    pub f32,
);

/// What of a rhythm is added to a drive, to and fro.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// The channel or muscle.
    pub target: Target,
    /// The one end, in the unit of the target, at 1.
    pub low: f32,
    /// The other.
    pub high: f32,
}

/// A rhythm.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// How often a second.
    pub hz: f32,
    /// What goes to and fro.
    pub swings: Vec<Swing>,
}

/// One code.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Name in files: `AU101`, `AU109_110`, `EAD103`, `AD19`.
    pub id: String,
    /// As it is written: `AU109+110`.
    pub label: String,
    /// Its name.
    pub name: String,
    /// What part of the head it moves.
    pub group: Group,
    /// On which sides.
    pub sides: Sides,
    /// What it moves.
    pub drives: Vec<Drive>,
    /// What of it has a rhythm.
    pub cycle: Option<Cycle>,
    /// The clip that stands for it where it is behaviour over time; empty for a unit that drives something.
    pub clip: String,
    /// Where landmarks go at 1.
    pub landmarks: Vec<LandmarkMotion>,
    /// What parts at 1.
    pub gaps: Vec<Gap>,
    /// How far the ear's opening turns outwards about the ear's length at 1, degrees, least and most, where it does: the landmarks
    /// of the ear's base stay where they are.
    pub opening_deg: Option<(f32, f32)>,
    /// What must be seen at least for the code to be given.
    pub criterion: String,
    /// What this rig does not do of it; empty where nothing is known to be missing.
    pub lacks: String,
    /// Where that is known from.
    pub source: String,
    /// How well.
    pub status: Status,
}

/// Every unit, and the rules between them.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitTable {
    /// In the order of the file.
    pub units: Vec<Unit>,
    /// In the order in which they are applied.
    pub rules: Vec<Rule>,
}

/// Why a word names no unit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnitError {
    /// There is no such code.
    #[error("there is no unit '{word}'{}", did_you_mean(.near))]
    Unknown {
        /// What was asked for.
        word: String,
        /// Ids that are spelt alike.
        near: Vec<String>,
    },
    /// It cannot be one-sided.
    #[error("{id} is not there for one side alone: write {id}")]
    OneSided {
        /// The unit.
        id: String,
    },
}

fn did_you_mean(near: &[String]) -> String {
    if near.is_empty() { String::new() } else { format!(" (did you mean {}?)", near.join(" or ")) }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: u32,
    units: Vec<Row>,
    rules: Vec<rule::Row>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    id: String,
    #[serde(default)]
    label: String,
    name: String,
    group: Group,
    sides: Sides,
    #[serde(default)]
    drives: Vec<(String, f32)>,
    #[serde(default)]
    cycle: CycleRow,
    #[serde(default)]
    clip: String,
    #[serde(default)]
    landmarks: Vec<LandmarkMotion>,
    #[serde(default)]
    gaps: Vec<Gap>,
    #[serde(default)]
    opening_deg: Option<(f32, f32)>,
    criterion: String,
    #[serde(default)]
    lacks: String,
    source: String,
    status: Status,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct CycleRow {
    hz: f32,
    swings: Vec<(String, f32, f32)>,
}

impl UnitTable {
    /// Most units that an activation has room for.
    pub const MOST: usize = 48;

    /// Reads the text of `rigs/units.ron`; `file`: its name, for messages.
    ///
    /// # Errors
    /// Syntax with line and column; too many units, an id that is there twice, a name that nothing has, a number that is
    /// none, a unit that neither drives anything nor names a clip.
    pub fn parse(file: &str, text: &str, muscles: &MuscleTable) -> Result<Self, MotionError> {
        let read: File = ron::from_str(text).map_err(|e| MotionError::syntax(file, e))?;
        MotionError::check_version(file, read.version)?;
        if read.units.len() > Self::MOST {
            let problem = format!("there are {}, at most {}", read.units.len(), Self::MOST);
            return Err(MotionError::row(file, "units", problem));
        }
        let mut units: Vec<Unit> = Vec::with_capacity(read.units.len());
        for row in read.units {
            let unit = row.read(file, muscles)?;
            if units.iter().any(|other| other.id == unit.id) {
                return Err(MotionError::row(file, &unit.id, "is there twice"));
            }
            units.push(unit);
        }
        let rules = read.rules.into_iter().map(|row| Rule::read(file, row, &units)).collect::<Result<_, _>>()?;
        Ok(Self { units, rules })
    }

    /// Number of the unit of that id.
    pub fn index_of(&self, id: &str) -> Option<usize> {
        self.units.iter().position(|unit| unit.id == id)
    }

    /// The unit and the side that a word such as `AU101`, `EAD103L` or `AU109+110` names.
    ///
    /// # Errors
    /// [`UnitError`], with the ids that are spelt alike.
    pub fn find(&self, word: &str) -> Result<(usize, Side), UnitError> {
        let plain = word.trim().to_ascii_uppercase().replace('+', "_");
        if let Some(unit) = self.index_of(&plain) {
            return Ok((unit, Side::Both));
        }
        let (id, side) = match plain.split_at_checked(plain.len().saturating_sub(1)) {
            Some((id, "L")) => (id, Side::Left),
            Some((id, "R")) => (id, Side::Right),
            _ => (plain.as_str(), Side::Both),
        };
        match self.index_of(id) {
            Some(unit) if self.units[unit].sides == Sides::Each => Ok((unit, side)),
            Some(_) => Err(UnitError::OneSided { id: id.to_owned() }),
            None => Err(UnitError::Unknown { word: word.to_owned(), near: self.near(id) }),
        }
    }

    /// Ids that are spelt like a word, with or without the letters before the number, or whose name has it in it.
    pub fn near(&self, word: &str) -> Vec<String> {
        let spellings = |unit: &'_ Unit| -> [String; 3] {
            let number = unit.id.trim_start_matches(|c: char| c.is_ascii_alphabetic());
            [unit.id.clone(), number.to_owned(), unit.name.clone()]
        };
        let all: Vec<(&str, [String; 3])> = self.units.iter().map(|unit| (unit.id.as_str(), spellings(unit))).collect();
        let names = all.iter().flat_map(|(id, spelt)| spelt.iter().map(move |spelt| (*id, spelt.as_str())));
        nearest(word, names).into_iter().map(str::to_owned).collect()
    }

    /// The pose of units that have been resolved, inside the limits. Rhythms stand still. Allocates nothing.
    #[must_use]
    pub fn pose(&self, resolved: &Activation, limits: &JointLimits) -> Pose {
        limits.clamped(&self.drive(resolved))
    }

    /// What units drive that have been resolved, not yet inside the limits: the sum of their drives, of muscles and some
    /// channels the largest.
    pub fn drive(&self, resolved: &Activation) -> Pose {
        // Of wishes in one direction the largest may count, but two directions always work against each other.
        let (mut pose, mut against) = (Pose::default(), Pose::default());
        for (number, unit) in self.units.iter().enumerate() {
            let strength = resolved.get(number);
            if strength == [0.0; 2] {
                continue;
            }
            for drive in &unit.drives {
                let wanted = unit.spread(drive.target, strength).map(|strength| strength * drive.value);
                let into = if drive.value < 0.0 { &mut against } else { &mut pose };
                let takes_largest = drive.target.takes_largest();
                for (now, wanted) in drive.target.of(into).iter_mut().zip(wanted) {
                    *now = match takes_largest {
                        true if wanted.abs() > now.abs() => wanted,
                        true => *now,
                        false => *now + wanted,
                    };
                }
            }
        }
        pose.add(&against, 1.0);
        pose
    }

    /// Adds what goes to and fro.
    pub(super) fn swing(&self, resolved: &Activation, time: f64, pose: &mut Pose) {
        for (number, unit) in self.units.iter().enumerate() {
            let strength = resolved.get(number);
            let Some(cycle) = unit.cycle.as_ref().filter(|_| strength != [0.0; 2]) else { continue };
            let turn = time * f64::from(cycle.hz);
            let phase = (turn - turn.floor()) as f32;
            let wave = ops::sin(std::f32::consts::TAU * phase);
            for swing in &cycle.swings {
                let value = 0.5 * (swing.low + swing.high) + 0.5 * (swing.high - swing.low) * wave;
                let added = unit.spread(swing.target, strength).map(|strength| strength * value);
                for (now, added) in swing.target.of(pose).iter_mut().zip(added) {
                    *now += added;
                }
            }
        }
    }
}

impl Unit {
    /// How strongly a target is driven, left and right: a one-sided unit pulls a median target as strongly as its stronger
    /// side, or towards its side where the target's sign tells left from right.
    fn spread(&self, target: Target, [left, right]: [f32; 2]) -> [f32; 2] {
        let is_mirrored = self.sides == Sides::Each && target.is_lateral();
        match (target.is_median(), is_mirrored) {
            (true, true) => [left - right; 2],
            (true, false) => [left.max(right); 2],
            (false, true) => [left, -right],
            (false, false) => [left, right],
        }
    }
}

impl Row {
    fn read(self, file: &str, muscles: &MuscleTable) -> Result<Unit, MotionError> {
        let wrong = |problem: String| MotionError::row(file, &self.id, problem);
        let target = |id: &str| {
            Target::named(id, muscles).ok_or_else(|| wrong(format!("'{id}' is neither a channel nor a muscle")))
        };
        let finite = |id: &str, value: f32| match value.is_finite() {
            true => Ok(value),
            false => Err(wrong(format!("{id} is {value}, a number is wanted"))),
        };
        let drives =
            self.drives.iter().map(|(id, value)| Ok(Drive { target: target(id)?, value: finite(id, *value)? }));
        let drives: Vec<Drive> = drives.collect::<Result<_, MotionError>>()?;
        let swings =
            self.cycle.swings.iter().map(|(id, low, high)| {
                Ok(Swing { target: target(id)?, low: finite(id, *low)?, high: finite(id, *high)? })
            });
        let swings: Vec<Swing> = swings.collect::<Result<_, MotionError>>()?;
        if !swings.is_empty() && !(0.1..=20.0).contains(&self.cycle.hz) {
            return Err(wrong(format!("its rhythm has {} Hz, allowed 0.1 to 20", self.cycle.hz)));
        }
        if drives.is_empty() && self.clip.is_empty() {
            return Err(wrong("drives nothing and names no clip".into()));
        }
        let of_ear = self.opening_deg.iter().map(|&(least, most)| ("opening_deg", least, most));
        let landmarks = self.landmarks.iter().map(|m| (m.0.as_str(), m.2, m.3));
        let least_to_most = landmarks.chain(self.gaps.iter().map(|g| (g.0.as_str(), g.2, g.3))).chain(of_ear);
        for (id, least, most) in least_to_most {
            if !(least <= most && least.is_finite() && most.is_finite()) {
                return Err(wrong(format!("{id} moves from {least} to {most}: the least comes first")));
            }
        }
        Ok(Unit {
            label: if self.label.is_empty() { self.id.clone() } else { self.label },
            id: self.id,
            name: self.name,
            group: self.group,
            sides: self.sides,
            drives,
            cycle: (!swings.is_empty()).then_some(Cycle { hz: self.cycle.hz, swings }),
            clip: self.clip,
            landmarks: self.landmarks,
            gaps: self.gaps,
            opening_deg: self.opening_deg,
            criterion: self.criterion,
            lacks: self.lacks,
            source: self.source,
            status: self.status,
        })
    }
}

/// Number of a unit that a file names.
pub(super) fn number(file: &str, id: &str, units: &[Unit]) -> Result<usize, MotionError> {
    units.iter().position(|unit| unit.id == id).ok_or_else(|| {
        let near = nearest(id, units.iter().map(|unit| (unit.id.as_str(), unit.id.as_str())));
        let near: Vec<String> = near.into_iter().map(str::to_owned).collect();
        MotionError::row(file, id, format!("is no unit{}", did_you_mean(&near)))
    })
}
