//! How behaviour researchers write what they see: `101+12B+EAD103L`.
//!
//! Codes are joined by `+`; blanks do not count. A code is a number with or without `AU`, `AD` or `EAD` before it; a bare
//! number is an `AU` where there is one, else an `AD`, never an ear's. `109+110` is one unit. Behind a code may stand `L` or
//! `R` for one side and a letter for the intensity, in any order: A to E are 0.2, 0.4, 0.6, 0.8 and 1, none is 1.

use super::{Activation, Sides, UnitError, UnitTable};
use std::fmt::Write;

/// Why a text cannot be read, and where.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("character {place}: {mistake}")]
pub struct NotationError {
    /// Number of the character with which the code begins, from 1 on.
    pub place: usize,
    /// What is wrong there.
    pub mistake: Mistake,
}

/// What is wrong with a code.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Mistake {
    /// Nothing stands before, behind or between `+`.
    #[error("a code such as 101, 12B or EAD103L is missing")]
    Nothing,
    /// It is no code.
    #[error("{0}")]
    Unit(#[from] UnitError),
    /// The half of the one code that has a `+` in it.
    #[error("109 is not there alone: 109+110 is one unit")]
    HalfUnit,
    /// Something else stands behind the number.
    #[error("'{0}' is neither a side (L or R) nor an intensity (A to E)")]
    Tail(String),
    /// Two values for one unit and side.
    #[error("{0} is there twice")]
    Twice(String),
}

/// The unit whose label has a `+` in it, and how its parts begin.
const PAIR: (&str, &str, &str) = ("AU109_110", "109", "110");
const LETTERS: [char; 5] = ['A', 'B', 'C', 'D', 'E'];

impl UnitTable {
    /// Reads notation; an empty text is rest.
    ///
    /// # Errors
    /// [`NotationError`], of the first mistake.
    pub fn parse_notation(&self, text: &str) -> Result<Activation, NotationError> {
        let mut activation = Activation::default();
        if text.trim().is_empty() {
            return Ok(activation);
        }
        let mut items = Vec::new();
        let mut place = 1;
        for part in text.split('+') {
            let blanks = part.chars().take_while(|c| c.is_whitespace()).count();
            let word: String = part.chars().filter(|c| !c.is_whitespace()).flat_map(char::to_uppercase).collect();
            items.push((place + blanks, word));
            place += part.chars().count() + 1;
        }
        let mut items = items.into_iter().peekable();
        while let Some((place, mut word)) = items.next() {
            let wrong = |mistake: Mistake| NotationError { place, mistake };
            if word.is_empty() {
                return Err(wrong(Mistake::Nothing));
            }
            if word.strip_prefix("AU").unwrap_or(&word) == PAIR.1 {
                match items.next_if(|(_, next)| next.starts_with(PAIR.2)) {
                    Some((_, next)) => word = format!("{}{}", PAIR.0, &next[PAIR.2.len()..]),
                    None => return Err(wrong(Mistake::HalfUnit)),
                }
            }
            self.read(&word, &mut activation).map_err(wrong)?;
        }
        Ok(activation)
    }

    /// Writes notation as it is read: in the order of the table, intensities rounded to the nearest letter, nothing below
    /// half of A. Empty at rest.
    pub fn notation(&self, activation: &Activation) -> String {
        let mut text = String::new();
        for (number, unit) in self.units.iter().enumerate() {
            let [left, right] = activation.get(number).map(|value| (5.0 * value).round() as usize);
            let code = unit.label.strip_prefix("AU").unwrap_or(&unit.label);
            let sides = match (left, right) {
                (left, right) if left == right => [("", left), ("", 0)],
                _ => [("L", left), ("R", right)],
            };
            for (side, steps) in sides.into_iter().filter(|(_, steps)| *steps > 0) {
                let joint = if text.is_empty() { "" } else { "+" };
                let letter = if steps < 5 { &"ABCD"[steps - 1..steps] } else { "" };
                // Writing to a String cannot fail.
                let _ = write!(text, "{joint}{code}{side}{letter}");
            }
        }
        text
    }

    fn read(&self, word: &str, activation: &mut Activation) -> Result<(), Mistake> {
        let start = word.find(|c: char| c.is_ascii_digit()).unwrap_or(word.len());
        let is_digit = |c: char| c.is_ascii_digit() || c == '_';
        let end = start + word[start..].find(|c| !is_digit(c)).unwrap_or(word.len() - start);
        let (code, tail) = word.split_at(end);
        let known = |prefix: &str| self.index_of(&format!("{prefix}{code}"));
        let unit = known("").or_else(|| known("AU")).or_else(|| known("AD"));
        let unit = unit.ok_or_else(|| UnitError::Unknown { word: code.to_owned(), near: self.near(code) })?;
        let spec = &self.units[unit];

        let (mut side, mut intensity) = (None, None);
        for c in tail.chars() {
            let letter = LETTERS.iter().position(|&letter| letter == c);
            match (c, letter) {
                ('L' | 'R', _) if side.is_none() => side = Some(c),
                (_, Some(step)) if intensity.is_none() => intensity = Some((step + 1) as f32 / 5.0),
                _ => return Err(Mistake::Tail(tail.to_owned())),
            }
        }
        if side.is_some() && spec.sides != Sides::Each {
            return Err(UnitError::OneSided { id: spec.label.clone() }.into());
        }
        let value = intensity.unwrap_or(1.0);
        let here: &mut [f32] = match side {
            Some('L') => &mut activation.get_mut(unit)[..1],
            Some(_) => &mut activation.get_mut(unit)[1..],
            None => &mut activation.get_mut(unit)[..],
        };
        if here.iter().any(|&now| now > 0.0) {
            return Err(Mistake::Twice(spec.label.clone()));
        }
        here.fill(value);
        Ok(())
    }
}
