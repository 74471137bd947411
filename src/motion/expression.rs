//! Expressions: recipes of units, each with its own course in time. `rigs/expressions/*.ron` as a type.

use super::ease::envelope;
use super::{Activation, Channel, Moment, MotionError, Pose, Side, Sides, UnitTable, unit};
use serde::Deserialize;

/// A recipe.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    /// Name in files and on the command line.
    pub id: String,
    /// As it is published.
    pub label: String,
    /// When it shows itself best, seconds from its start.
    pub still_s: f64,
    /// What it is made of.
    pub parts: Vec<Part>,
    /// What no unit moves, as pupils, or what a unit is part of, as the level of a face.
    pub beside: Vec<Beside>,
}

/// A channel of a recipe, on both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Beside {
    /// Which.
    pub channel: Channel,
    /// How far it goes, in the unit of its id.
    pub value: f32,
    /// When it begins, seconds from the start of the expression.
    pub start_s: f64,
    /// How long it takes to come.
    pub onset_s: f64,
    /// How long it stays.
    pub hold_s: f64,
    /// How long it takes to go.
    pub offset_s: f64,
    /// Where that is known from.
    pub evidence: String,
}

/// A unit of a recipe.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its number.
    pub unit: usize,
    /// On which side.
    pub side: Side,
    /// How strong it gets, 0 to 1.
    pub intensity: f32,
    /// When it begins, seconds from the start of the expression.
    pub start_s: f64,
    /// How long it takes to come.
    pub onset_s: f64,
    /// How long it stays.
    pub hold_s: f64,
    /// How long it takes to go.
    pub offset_s: f64,
    /// How long after its beginning it begins anew; 0 if it does not.
    pub every_s: f64,
    /// Until when, from its beginning on, it may begin anew.
    pub until_s: f64,
    /// What is to be said of it.
    pub note: String,
    /// Where that is known from.
    pub evidence: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: u32,
    id: String,
    label: String,
    still_s: f64,
    units: Vec<Row>,
    #[serde(default)]
    channels: Vec<BesideRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BesideRow {
    channel: Channel,
    value: f32,
    #[serde(default)]
    start_s: f64,
    onset_s: f64,
    hold_s: f64,
    offset_s: f64,
    evidence: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    unit: String,
    #[serde(default)]
    side: Side,
    intensity: f32,
    #[serde(default)]
    start_s: f64,
    onset_s: f64,
    hold_s: f64,
    offset_s: f64,
    #[serde(default)]
    every_s: f64,
    #[serde(default)]
    until_s: f64,
    #[serde(default)]
    note: String,
    evidence: String,
}

/// The longest time in a file, seconds.
const MOST_SECONDS: f64 = 3600.0;

impl Expression {
    /// Reads the text of a file of `rigs/expressions`; `file`: its name, for messages.
    ///
    /// # Errors
    /// Syntax with line and column; a unit that nothing has or that cannot be one-sided, a number out of its range.
    pub fn parse(file: &str, text: &str, units: &UnitTable) -> Result<Self, MotionError> {
        let read: File = ron::from_str(text).map_err(|e| MotionError::syntax(file, e))?;
        MotionError::check_version(file, read.version)?;
        let parts = read.units.into_iter().map(|row| row.read(file, units)).collect::<Result<Vec<_>, _>>()?;
        let beside = read.channels.into_iter().map(|row| row.read(file)).collect::<Result<Vec<_>, _>>()?;
        let expression = Self { id: read.id, label: read.label, still_s: read.still_s, parts, beside };
        if !(0.0..=expression.seconds()).contains(&expression.still_s) {
            let problem = format!("still_s is {}, allowed 0 to {}", expression.still_s, expression.seconds());
            return Err(MotionError::row(file, &expression.id, problem));
        }
        Ok(expression)
    }

    /// How long it takes, seconds.
    pub fn seconds(&self) -> f64 {
        self.parts.iter().map(Part::end_s).chain(self.beside.iter().map(Beside::end_s)).fold(0.0, f64::max)
    }

    /// Its units, seconds after its start; nothing before and after.
    pub fn at(&self, time: f64) -> Activation {
        let mut out = Activation::default();
        for part in &self.parts {
            let value = part.at(time);
            let [left, right] = out.get(part.unit);
            let most = [left.max(value), right.max(value)];
            *out.get_mut(part.unit) = match part.side {
                Side::Both => most,
                Side::Left => [most[0], right],
                Side::Right => [left, most[1]],
            };
        }
        out
    }

    /// Its units where it shows itself best.
    pub fn still(&self) -> Activation {
        self.at(self.still_s)
    }

    /// What it moves beside units, seconds after its start.
    pub fn beside_at(&self, time: f64) -> Pose {
        let mut pose = Pose::default();
        for beside in &self.beside {
            let part = envelope(time - beside.start_s, beside.onset_s, beside.hold_s, beside.offset_s);
            pose.channel_mut(beside.channel).iter_mut().for_each(|now| *now += beside.value * part);
        }
        pose
    }

    /// All that it asks for, seconds after its start.
    pub fn moment(&self, time: f64) -> Moment {
        Moment { units: self.at(time), direct: self.beside_at(time) }
    }
}

impl Part {
    fn at(&self, time: f64) -> f32 {
        let mut since = time - self.start_s;
        if self.every_s > 0.0 && since > 0.0 {
            // The last beginning of all does not begin anew.
            let last = (self.until_s / self.every_s).floor();
            since -= self.every_s * (since / self.every_s).floor().min(last);
        }
        self.intensity * envelope(since, self.onset_s, self.hold_s, self.offset_s)
    }

    fn end_s(&self) -> f64 {
        let again = if self.every_s > 0.0 { self.every_s * (self.until_s / self.every_s).floor() } else { 0.0 };
        self.start_s + again + self.onset_s + self.hold_s + self.offset_s
    }
}

impl Beside {
    fn end_s(&self) -> f64 {
        self.start_s + self.onset_s + self.hold_s + self.offset_s
    }
}

impl BesideRow {
    fn read(self, file: &str) -> Result<Beside, MotionError> {
        let Self { channel, value, start_s, onset_s, hold_s, offset_s, evidence } = self;
        if !value.is_finite() {
            return Err(MotionError::row(file, channel.id(), format!("value is {value}, which is no number")));
        }
        for (name, seconds) in [("start_s", start_s), ("onset_s", onset_s), ("hold_s", hold_s), ("offset_s", offset_s)]
        {
            check_seconds(file, channel.id(), name, seconds)?;
        }
        Ok(Beside { channel, value, start_s, onset_s, hold_s, offset_s, evidence })
    }
}

fn check_seconds(file: &str, row: &str, name: &str, seconds: f64) -> Result<(), MotionError> {
    match (0.0..=MOST_SECONDS).contains(&seconds) {
        true => Ok(()),
        false => Err(MotionError::row(file, row, format!("{name} is {seconds}, allowed 0 to {MOST_SECONDS}"))),
    }
}

impl Row {
    fn read(self, file: &str, units: &UnitTable) -> Result<Part, MotionError> {
        let number = unit::number(file, &self.unit, &units.units)?;
        let wrong = |problem: String| MotionError::row(file, &self.unit, problem);
        if self.side != Side::Both && units.units[number].sides != Sides::Each {
            return Err(wrong("is not there for one side alone: leave out side".into()));
        }
        if !(0.0..=1.0).contains(&self.intensity) {
            return Err(wrong(format!("intensity is {}, allowed 0 to 1", self.intensity)));
        }
        for (name, seconds) in [
            ("start_s", self.start_s),
            ("onset_s", self.onset_s),
            ("hold_s", self.hold_s),
            ("offset_s", self.offset_s),
            ("every_s", self.every_s),
            ("until_s", self.until_s),
        ] {
            check_seconds(file, &self.unit, name, seconds)?;
        }
        let course = self.onset_s + self.hold_s + self.offset_s;
        if self.every_s > 0.0 && self.every_s < course {
            return Err(wrong(format!("every_s is {}, but its course takes {course}", self.every_s)));
        }
        Ok(Part {
            unit: number,
            side: self.side,
            intensity: self.intensity,
            start_s: self.start_s,
            onset_s: self.onset_s,
            hold_s: self.hold_s,
            offset_s: self.offset_s,
            every_s: self.every_s,
            until_s: self.until_s,
            note: self.note,
            evidence: self.evidence,
        })
    }
}
