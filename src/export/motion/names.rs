//! Names of targets and animations: letters, digits and `_`, since clients split or change what else there is.

use super::targets::Kind;
use crate::motion::{Side, Unit};

/// A unit's id and its name as one word: `AU101_innerBrowRaiser`.
pub(super) fn of_unit(unit: &Unit) -> String {
    let words = unit.name.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let mut name = format!("{}_", unit.id);
    for (k, word) in words.enumerate() {
        let (first, rest) = word.split_at(1);
        name.push_str(&if k == 0 { first.to_ascii_lowercase() } else { first.to_ascii_uppercase() });
        name.push_str(rest);
    }
    name
}

/// With what the target is and its side behind.
pub(super) fn of_target(unit: &Unit, kind: Kind, side: Side) -> String {
    let mut name = of_unit(unit);
    if kind == Kind::Corrective {
        name.push_str("_corrective");
    }
    with_side(name, side)
}

/// With a side behind it where there is one.
pub(super) fn with_side(mut name: String, side: Side) -> String {
    if side != Side::Both {
        name.push('_');
        name.push_str(side.suffix());
    }
    name
}
