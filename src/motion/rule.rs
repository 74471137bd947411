//! Rules between units: what cannot be at once, what contains what, what brings what along. They stand in `rigs/units.ron`.

use super::{MotionError, Unit, unit};
use serde::Deserialize;

/// What holds between units, by their numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum RuleKind {
    /// The same movement in different sizes: what comes out largest stays, the others go. Each unit with its size at 1.
    LargerWins(Vec<(usize, f32)>),
    /// The first contains the second, which goes unless it is the stronger one.
    Supersedes(usize, usize),
    /// Movements that cannot be at once: the largest stays, the others go. Where the second is nearer to it than a quarter,
    /// the largest goes down towards nothing, so that nothing jumps while they change places.
    Excludes(Vec<usize>),
    /// Both pull against each other: their sum is at most 1.
    Opposes(usize, usize),
    /// The first brings the second along, at least so many times its own strength, up to 1.
    Implies(usize, usize, f32),
}

/// A rule, its reason and its source.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// What holds.
    pub kind: RuleKind,
    /// Why, in words for the panel.
    pub why: String,
    /// Where that is known from.
    pub source: String,
    /// Whether it holds on each side alone: where no unit of it is median.
    pub is_by_side: bool,
}

#[derive(Deserialize)]
enum Kind {
    LargerWins(Vec<(String, f32)>),
    Supersedes(String, String),
    Excludes(Vec<String>),
    Opposes(String, String),
    Implies(String, String, f32),
}

/// As the file has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Row {
    rule: Kind,
    why: String,
    source: String,
}

impl Rule {
    /// The units it is about, by their numbers.
    pub fn units(&self) -> Vec<usize> {
        match &self.kind {
            RuleKind::LargerWins(units) => units.iter().map(|&(unit, _)| unit).collect(),
            RuleKind::Excludes(units) => units.clone(),
            RuleKind::Supersedes(a, b) | RuleKind::Opposes(a, b) | RuleKind::Implies(a, b, _) => vec![*a, *b],
        }
    }

    /// Names become numbers.
    pub(super) fn read(file: &str, row: Row, units: &[Unit]) -> Result<Self, MotionError> {
        let number = |id: String| unit::number(file, &id, units);
        let kind = match row.rule {
            Kind::LargerWins(of) => {
                let read = of.into_iter().map(|(id, size)| match size > 0.0 && size.is_finite() {
                    true => Ok((number(id)?, size)),
                    false => {
                        Err(MotionError::row(file, &id, format!("has the size {size} in a rule, allowed above 0")))
                    }
                });
                RuleKind::LargerWins(read.collect::<Result<_, _>>()?)
            }
            Kind::Supersedes(a, b) => RuleKind::Supersedes(number(a)?, number(b)?),
            Kind::Excludes(of) => RuleKind::Excludes(of.into_iter().map(number).collect::<Result<_, _>>()?),
            Kind::Opposes(a, b) => RuleKind::Opposes(number(a)?, number(b)?),
            Kind::Implies(a, b, times) if (0.0..=10.0).contains(&times) => {
                RuleKind::Implies(number(a)?, number(b)?, times)
            }
            Kind::Implies(a, _, times) => {
                return Err(MotionError::row(file, &a, format!("implies {times} times another, allowed 0 to 10")));
            }
        };
        let mut rule = Self { kind, why: row.why, source: row.source, is_by_side: true };
        rule.is_by_side = rule.units().iter().all(|&number| units[number].sides != super::Sides::Median);
        Ok(rule)
    }
}
