//! What can be wrong with a file of breeds or parameters, and where.

use super::locate::Place;
use std::fmt;

/// Everything that is wrong with one file. Prints one line per problem, each `name:line:column: message`.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadErrors {
    /// The file's name as the caller gave it.
    pub name: String,
    /// At least one, in the order of the file. A syntax error stands alone.
    pub problems: Vec<Problem>,
}

/// One mistake at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// Where it stands; for a missing field, where its record begins.
    pub place: Place,
    /// What it is.
    pub kind: ProblemKind,
}

/// The kinds of mistakes. Fields are named by their path, as in `coat.markings[0].amount`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProblemKind {
    /// Not RON.
    #[error("syntax error: {0}")]
    Syntax(String),
    /// The file's version is unknown to this program.
    #[error("version is {found}, this program reads whole numbers from 1 to {newest}")]
    Version {
        /// The version in the file.
        found: f64,
        /// The newest version that is understood.
        newest: u32,
    },
    /// A record of another name.
    #[error("expected {expected}(…), found {found}(…)")]
    WrongRecord {
        /// The record that belongs here.
        expected: &'static str,
        /// The one that stands here.
        found: String,
    },
    /// A field must be there.
    #[error("{field} is missing")]
    Missing {
        /// Path of the field.
        field: String,
    },
    /// No such field in a record.
    #[error("unknown field {field}{}; allowed are {}", did_you_mean(nearest), allowed.join(", "))]
    UnknownField {
        /// Path of the field.
        field: String,
        /// Known fields with similar names.
        nearest: Vec<String>,
        /// All known fields.
        allowed: Vec<&'static str>,
    },
    /// The same key twice.
    #[error("{field} is given twice, first in line {first_line}")]
    Duplicate {
        /// Path of the field or key.
        field: String,
        /// Line of the first one.
        first_line: u32,
    },
    /// A value of the wrong type.
    #[error("{field} must be {expected}, found {found}")]
    WrongType {
        /// Path of the field.
        field: String,
        /// What belongs there.
        expected: &'static str,
        /// What stands there.
        found: &'static str,
    },
    /// Infinite or not a number.
    #[error("{field} must be a finite number")]
    NotFinite {
        /// Path of the field.
        field: String,
    },
    /// A number outside its range.
    #[error("{field} is {value}, allowed {min} to {max}")]
    OutOfRange {
        /// Path of the field, or the parameter's id (which carries the unit).
        field: String,
        /// The value in the file.
        value: f64,
        /// Lowest allowed.
        min: f64,
        /// Highest allowed.
        max: f64,
    },
    /// No such parameter.
    #[error("unknown parameter {id}{}", did_you_mean(nearest))]
    UnknownParameter {
        /// The id in the file.
        id: String,
        /// Known ids with similar names.
        nearest: Vec<String>,
    },
    /// No such measure among those that references are of.
    #[error("unknown measure {id}{}; allowed are {}", did_you_mean(nearest), allowed.join(", "))]
    UnknownMeasure {
        /// The id in the file.
        id: String,
        /// Known ids with similar names.
        nearest: Vec<String>,
        /// All known ids.
        allowed: Vec<&'static str>,
    },
    /// A reference that is neither measured nor computed nor estimated.
    #[error("{field} must be measured, computed or estimated, without quotes, found {found}")]
    UnknownStatus {
        /// Path of the field.
        field: String,
        /// What stands there.
        found: String,
    },
    /// No such region.
    #[error("unknown region {name}{}", did_you_mean(nearest))]
    UnknownRegion {
        /// The name in the file.
        name: String,
        /// Known regions with similar names.
        nearest: Vec<String>,
    },
    /// A region that bears no hair.
    #[error("{field}: no hair grows on {name}; leave it out")]
    BareRegion {
        /// Path of the field.
        field: String,
        /// The region.
        name: String,
    },
    /// No such kind of marking.
    #[error("{field}: unknown marking {name}{}; allowed are {}", did_you_mean(nearest), allowed.join(", "))]
    UnknownMarking {
        /// Path of the field.
        field: String,
        /// The name in the file.
        name: String,
        /// Known kinds with similar names.
        nearest: Vec<String>,
        /// All known kinds.
        allowed: Vec<&'static str>,
    },
    /// A word that is not among those that a field may have.
    #[error("{field} must be one of {}, without quotes, found {found}{}", allowed.join(", "), did_you_mean(nearest))]
    UnknownWord {
        /// Path of the field.
        field: String,
        /// What stands there.
        found: String,
        /// Known words with similar names.
        nearest: Vec<String>,
        /// All known words.
        allowed: Vec<&'static str>,
    },
    /// A breed has one coat or several.
    #[error("a breed has either coat: (…) or coats: {{\"name\": (…), …}} with at least one, {found}")]
    CoatOrCoats {
        /// What the file has.
        found: &'static str,
    },
    /// A breed wears a coat that it does not have.
    #[error("wears is {name:?}{}, which is none of coats: {}", did_you_mean(nearest), coats.join(", "))]
    UnknownVariety {
        /// The name in the file.
        name: String,
        /// Coats of the file with similar names.
        nearest: Vec<String>,
        /// All coats of the file.
        coats: Vec<String>,
    },
    /// Coats mixed in leave nothing of the first.
    #[error("{field}: the shares sum to {sum}, which must be below 1: the rest is that of the coat itself")]
    Shares {
        /// Path of the field.
        field: String,
        /// Their sum.
        sum: f64,
    },
    /// Not a paint.
    #[error(
        "{field} must be a colour, \"#rrggbb\" or (red, green, blue) in linear light from 0 to 1, or Eumelanin, \
         Phaeomelanin, Phaeomelanin(intensity) or White, found {found}"
    )]
    BadPaint {
        /// Path of the field.
        field: String,
        /// What stands there.
        found: String,
    },
    /// Not a colour.
    #[error("{field} must be a colour, \"#rrggbb\" or (red, green, blue) in linear light from 0 to 1, found {found}")]
    BadColour {
        /// Path of the field.
        field: String,
        /// What stands there.
        found: String,
    },
    /// A text that must not be empty.
    #[error("{field} must not be empty")]
    Empty {
        /// Path of the field.
        field: String,
    },
    /// A parameter's id that breaks the naming rule.
    #[error("{id} must be lower-case letters, digits and _, and end in {suffix} for the unit {unit}")]
    BadId {
        /// The id in the file.
        id: String,
        /// How it must end, in words.
        suffix: &'static str,
        /// The unit's name in files.
        unit: &'static str,
    },
    /// A lowest value that is not below the highest.
    #[error("the range of {id} is ({min}, {max}): the first number must be the lower one")]
    BadRange {
        /// Whose range.
        id: String,
        /// First number.
        min: f64,
        /// Second number.
        max: f64,
    },
    /// A parameter that follows itself, directly or through others.
    #[error("{} follow each other in a circle", ids.join(", "))]
    Cycle {
        /// The circle, from its first member in the table.
        ids: Vec<String>,
    },
    /// A parameter that follows one that can be zero or negative.
    #[error("{id} follows {target}, whose range begins at {min}: only parameters above 0 can be followed")]
    UnfollowableTarget {
        /// Who follows.
        id: String,
        /// Whom.
        target: String,
        /// Lowest value of the target.
        min: f64,
    },
}

fn did_you_mean(nearest: &[String]) -> String {
    if nearest.is_empty() { String::new() } else { format!(" (did you mean {}?)", nearest.join(" or ")) }
}

impl LoadErrors {
    /// `name:line:column: message` of one problem.
    pub fn line_of(&self, problem: &Problem) -> String {
        format!("{}:{}:{}: {}", self.name, problem.place.line, problem.place.column, problem.kind)
    }
}

impl fmt::Display for LoadErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            f.write_str(&self.line_of(problem))?;
        }
        Ok(())
    }
}

impl std::error::Error for LoadErrors {}
