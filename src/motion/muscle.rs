//! Muscles of the face: `rigs/muscles.ron` as a type. Origin and insertion are landmarks, so that every head has its own.

use super::MotionError;
use serde::Deserialize;

/// Text of `rigs/muscles.ron`.
pub const MUSCLES: &str = include_str!("../../rigs/muscles.ron");

/// How a muscle pulls.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum Kind {
    /// From its insertion towards its origin.
    Linear,
    /// Towards its ring's middle.
    Sphincter,
    /// Between bones: it moves the jaw, and stands out at constant volume.
    Chewing,
}

/// Where the skin that a muscle presses together lies in wrinkles, at right angles to its fibres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub enum Wrinkles {
    /// Across the bridge of the nose and the muzzle.
    Nose,
    /// Over the brow and the forehead.
    Brow,
    /// Behind the corner of the mouth.
    Cheek,
}

/// A landmark, or the mean of several.
pub type Anchor = Vec<String>;

/// One muscle, of which there is one on each side.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Muscle {
    /// Name in files.
    pub id: String,
    /// Anatomical name.
    pub name: String,
    /// How it pulls.
    pub kind: Kind,
    /// Landmarks (`S..` of bone, `K..` of skin) from the origin over places on the way to the last before the insertion;
    /// an item of several landmarks is their mean. Of a sphincter, the landmarks of its middle.
    pub path: Vec<Anchor>,
    /// Landmarks of the skin where it inserts; of a chewing muscle, of bone.
    pub insertion: Vec<String>,
    /// Of a chewing muscle, landmarks of the skin over its belly.
    #[serde(default)]
    pub belly: Vec<String>,
    /// By how much it pulls its insertion at full contraction, millimetres on a head with a skull of 200 mm.
    pub pull_mm: f32,
    /// How far along the skin it reaches around its insertion, millimetres on the base head with a skull of 200 mm.
    pub reach_mm: f32,
    /// How much the skin between is thrown up where it is pressed together, 0 to 1.
    #[serde(default)]
    pub gather: f32,
    /// Where that skin lies in wrinkles.
    #[serde(default)]
    pub wrinkles: Option<Wrinkles>,
    /// Lines of landmarks along which its fibres are drawn; without any, from its path to each insertion.
    #[serde(default)]
    pub drawn: Vec<Vec<Anchor>>,
    /// How wide it is drawn, millimetres on a head with a skull of 200 mm.
    #[serde(default = "width")]
    pub width_mm: f32,
    /// Where that is known from.
    pub source: String,
}

fn width() -> f32 {
    7.0
}

/// Every muscle.
#[derive(Clone, Debug, PartialEq)]
pub struct MuscleTable {
    /// In the order of the file.
    pub muscles: Vec<Muscle>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: u32,
    muscles: Vec<Muscle>,
}

impl MuscleTable {
    /// Most muscles that a pose has room for.
    pub const MOST: usize = 40;

    /// Reads the text of `rigs/muscles.ron`; `file`: its name, for messages.
    ///
    /// # Errors
    /// Syntax with line and column; too many muscles, an id that is there twice, a number out of its range.
    pub fn parse(file: &str, text: &str) -> Result<Self, MotionError> {
        let read: File = ron::from_str(text).map_err(|e| MotionError::Syntax(file.to_owned(), e))?;
        let row = |id: &str, problem: String| MotionError::Row { file: file.to_owned(), id: id.to_owned(), problem };
        if read.version != 1 {
            return Err(row("version", format!("is {}, this program reads 1", read.version)));
        }
        if read.muscles.len() > Self::MOST {
            return Err(row("muscles", format!("there are {}, at most {}", read.muscles.len(), Self::MOST)));
        }
        for (i, m) in read.muscles.iter().enumerate() {
            if read.muscles[..i].iter().any(|other| other.id == m.id) {
                return Err(row(&m.id, "is there twice".into()));
            }
            for (name, value, most) in
                [("pull_mm", m.pull_mm, 40.0), ("reach_mm", m.reach_mm, 120.0), ("gather", m.gather, 1.0), ("width_mm", m.width_mm, 60.0)]
            {
                if !(0.0..=most).contains(&value) {
                    return Err(row(&m.id, format!("{name} is {value}, allowed 0 to {most}")));
                }
            }
            if m.path.is_empty() || m.path.iter().any(Vec::is_empty) || m.insertion.is_empty() {
                return Err(row(&m.id, "needs landmarks in path and insertion".into()));
            }
        }
        Ok(Self { muscles: read.muscles })
    }

    /// Those that are part of the program.
    ///
    /// # Errors
    /// Never: a test reads them.
    pub fn embedded() -> Result<Self, MotionError> {
        Self::parse("rigs/muscles.ron", MUSCLES)
    }

    /// Number of the muscle of that id.
    pub fn index_of(&self, id: &str) -> Option<usize> {
        self.muscles.iter().position(|m| m.id == id)
    }
}
