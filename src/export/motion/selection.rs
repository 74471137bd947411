//! Which units and clips a file shall have.

use crate::anatomy::nearest;
use crate::motion::{Library, Moved, RuleKind, Side, UnitError};

/// Units and clips by their numbers in the library, each once, rising.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Units that drive something, and on which side.
    pub units: Vec<(usize, Side)>,
    /// Expressions.
    pub expressions: Vec<usize>,
    /// Clips.
    pub clips: Vec<usize>,
}

/// Why words select nothing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SelectionError {
    /// There is no such unit, or not of one side.
    #[error(transparent)]
    Unit(#[from] UnitError),
    /// A unit that is behaviour over time.
    #[error("{id} is behaviour over time and has no shape: its clip is '{clip}'")]
    Behaviour {
        /// The unit.
        id: String,
        /// The clip that stands for it.
        clip: String,
    },
    /// There is no such expression and no such clip.
    #[error("there is no expression or clip '{word}'{}", did_you_mean(.near))]
    Clip {
        /// What was asked for.
        word: String,
        /// Names that are spelt alike.
        near: Vec<String>,
    },
}

fn did_you_mean(near: &[String]) -> String {
    if near.is_empty() { String::new() } else { format!("; did you mean {}?", near.join(" or ")) }
}

impl Selection {
    /// From `all`, `none`, or names with commas between: of units, and of expressions and clips.
    ///
    /// # Errors
    /// The first name that nothing has, with those that are spelt alike.
    pub fn parse(library: &Library, units: &str, clips: &str) -> Result<Self, SelectionError> {
        let mut out = Self::default();
        let table = &library.units;
        match units.trim() {
            "none" => {}
            "all" => {
                let moving = table.units.iter().enumerate().filter(|(_, unit)| !unit.drives.is_empty());
                out.units = moving.map(|(number, _)| (number, Side::Both)).collect();
            }
            list => {
                for word in words(list) {
                    let (number, side) = table.find(word)?;
                    let unit = &table.units[number];
                    if unit.drives.is_empty() {
                        return Err(SelectionError::Behaviour { id: unit.id.clone(), clip: unit.clip.clone() });
                    }
                    match out.units.iter_mut().find(|(known, _)| *known == number) {
                        Some((_, known)) if *known != side => *known = Side::Both,
                        Some(_) => {}
                        None => out.units.push((number, side)),
                    }
                }
            }
        }
        match clips.trim() {
            "none" => {}
            "all" => {
                out.expressions = (0..library.expressions.len()).collect();
                out.clips = (0..library.clips.len()).collect();
            }
            list => {
                for word in words(list) {
                    let expression = library.expressions.iter().position(|e| e.id == word);
                    let clip = library.clips.iter().position(|c| c.id == word);
                    if expression.is_none() && clip.is_none() {
                        let ids = library.expressions.iter().map(|e| e.id.as_str());
                        let ids = ids.chain(library.clips.iter().map(|c| c.id.as_str())).map(|id| (id, id));
                        let near = nearest(word, ids).into_iter().map(str::to_owned).collect();
                        return Err(SelectionError::Clip { word: word.to_owned(), near });
                    }
                    out.expressions.extend(expression);
                    out.clips.extend(clip);
                }
            }
        }
        out.units.sort_by_key(|(number, _)| *number);
        for numbers in [&mut out.expressions, &mut out.clips] {
            numbers.sort_unstable();
            numbers.dedup();
        }
        Ok(out)
    }

    /// Units that need targets, by number: those that are selected, and on both sides those that the expressions and clips
    /// move, with what comes along with them.
    pub(super) fn moving_units(&self, library: &Library) -> Vec<(usize, Side)> {
        let table = &library.units;
        let mut moves = vec![false; table.units.len()];
        let parts = self.expressions.iter().flat_map(|&k| &library.expressions[k].parts);
        parts.for_each(|part| moves[part.unit] = true);
        let layers = self.clips.iter().flat_map(|&k| &library.clips[k].layers);
        for track in layers.flat_map(|layer| &layer.tracks) {
            if let Moved::Unit(unit) = track.of {
                moves[unit] = true;
            }
        }
        for rule in &table.rules {
            if let RuleKind::Implies(unit, along, _) = rule.kind {
                moves[along] |= moves[unit];
            }
        }
        let selected = |unit: usize| self.units.iter().find(|(number, _)| *number == unit).map(|(_, side)| *side);
        let side = |unit: usize| if moves[unit] { Some(Side::Both) } else { selected(unit) };
        let all = (0..moves.len()).filter(|&unit| !table.units[unit].drives.is_empty());
        all.filter_map(|unit| Some((unit, side(unit)?))).collect()
    }

    /// Whether nothing is selected.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

fn words(list: &str) -> impl Iterator<Item = &str> {
    list.split(',').map(str::trim).filter(|word| !word.is_empty())
}
