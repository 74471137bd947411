//! What of a dog is kept while the rest of it is drawn or inherited.

use super::{Breed, ParamTable, nearest};

/// Measures, and perhaps the coat, that stay what they are in a given dog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Locks {
    /// One per row of the table.
    rows: Vec<bool>,
    coat: bool,
}

/// A word that names nothing that can be locked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "'{word}' cannot be locked{}: say a parameter's id, a group ({}) or coat",
    if nearest.is_empty() { String::new() } else { format!(" (did you mean {}?)", nearest.join(" or ")) },
    groups.join(", ")
)]
pub struct UnknownLock {
    /// What was asked for.
    pub word: String,
    /// Ids and groups with similar names.
    pub nearest: Vec<String>,
    /// All groups.
    pub groups: Vec<String>,
}

impl Locks {
    /// Nothing is kept.
    pub fn none(table: &ParamTable) -> Self {
        Self { rows: vec![false; table.specs.len()], coat: false }
    }

    /// Locks one row of the table; a row that does not exist locks nothing.
    pub fn lock_row(&mut self, row: usize) {
        if let Some(locked) = self.rows.get_mut(row) {
            *locked = true;
        }
    }

    /// Locks what a word names: a parameter by its id, all of a group by its heading (case, spaces, `-` and `_` do not
    /// count), or `coat`: all colours.
    ///
    /// # Errors
    /// A word that names none of these, with the nearest that do.
    pub fn lock(&mut self, table: &ParamTable, word: &str) -> Result<(), UnknownLock> {
        if plain(word) == "coat" {
            self.coat = true;
            return Ok(());
        }
        let mut found = false;
        for (locked, spec) in self.rows.iter_mut().zip(&table.specs) {
            let is_meant = spec.id == word || plain(&spec.group) == plain(word);
            *locked |= is_meant;
            found |= is_meant;
        }
        if found { Ok(()) } else { Err(unknown(table, word)) }
    }

    /// Whether nothing is locked.
    pub fn is_empty(&self) -> bool {
        !self.coat && self.rows().next().is_none()
    }

    /// The locked rows, ascending.
    pub fn rows(&self) -> impl Iterator<Item = usize> + '_ {
        self.rows.iter().enumerate().filter(|(_, locked)| **locked).map(|(row, _)| row)
    }

    /// Gives a dog the locked values of another one, bit for bit.
    pub fn hold(&self, base: &Breed, dog: &mut Breed) {
        for row in self.rows() {
            dog.values[row] = base.values[row];
            dog.set[row] = true;
        }
        if self.coat {
            dog.look = base.look.clone();
        }
    }
}

fn unknown(table: &ParamTable, word: &str) -> UnknownLock {
    let mut groups: Vec<String> = Vec::new();
    for spec in table.specs.iter().filter(|s| !s.group.is_empty()) {
        if !groups.contains(&spec.group) {
            groups.push(spec.group.clone());
        }
    }
    let known = groups.iter().map(|g| (g.as_str(), g.as_str())).chain([("coat", "coat")]);
    let mut near: Vec<String> = nearest(word, known).into_iter().map(str::to_owned).collect();
    near.extend(table.nearest(word).into_iter().map(str::to_owned));
    near.truncate(3);
    UnknownLock { word: word.to_owned(), nearest: near, groups }
}

fn plain(name: &str) -> String {
    name.chars().filter(|c| !matches!(c, ' ' | '-' | '_')).flat_map(char::to_lowercase).collect()
}
