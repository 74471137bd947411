//! A breed: a value for every measure, and a look.

use super::{Look, ParamTable, Reference, Variety, nearest};

/// Who the dog is. Complete and in range: made by [`super::load_breed`], [`Breed::defaults`] or [`Breed::blend`], changed by
/// [`Breed::set_value`] and [`Breed::unset`].
#[derive(Clone, Debug, PartialEq)]
pub struct Breed {
    /// Short name: the file's name without its ending.
    pub id: String,
    /// Name on the screen.
    pub label: String,
    /// Group of the Fédération Cynologique Internationale, 1 to 10; none for what is no breed of dog.
    pub fci_group: Option<u8>,
    /// What it is held against; of several numbers of one quantity the first. Blends and descendants have none.
    pub references: Vec<Reference>,
    /// One per row of the table, SI, all resolved.
    pub values: Vec<f32>,
    /// One per row: was it set, or does it follow?
    pub set: Vec<bool>,
    /// Colours.
    pub look: Look,
    /// The coats that the breed comes in, in the order of its file; none where it has only one. Blends and descendants
    /// have none.
    pub varieties: Vec<Variety>,
}

/// A word that names no coat of a breed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{id} has no coat '{word}'{}; {}",
    if nearest.is_empty() { String::new() } else { format!(" (did you mean {}?)", nearest.join(" or ")) },
    if coats.is_empty() { "it has only one".to_owned() } else { format!("it comes in {}", coats.join(", ")) }
)]
pub struct UnknownCoat {
    /// Whose coat.
    pub id: String,
    /// What was asked for.
    pub word: String,
    /// Coats with similar names.
    pub nearest: Vec<String>,
    /// All coats.
    pub coats: Vec<String>,
}

impl Breed {
    /// A head of which nothing is set.
    pub fn defaults(table: &ParamTable) -> Self {
        let values = table.specs.iter().map(super::ParamSpec::default_si).collect();
        let (id, label) = ("unnamed".to_owned(), "Unnamed".to_owned());
        let set = vec![false; table.specs.len()];
        Self {
            id,
            label,
            fci_group: None,
            references: Vec::new(),
            values,
            set,
            look: Look::default(),
            varieties: Vec::new(),
        }
    }

    /// Sets row `index` to a value (SI), cut off at the ends of its range; what follows it moves along.
    ///
    /// A value that is not finite, or a row that does not exist, changes nothing.
    pub fn set_value(&mut self, table: &ParamTable, index: usize, si: f32) {
        let (Some(spec), true) = (table.specs.get(index), si.is_finite()) else { return };
        self.values[index] = si.clamp(spec.min_si(), spec.max_si());
        self.set[index] = true;
        table.resolve(&mut self.values, &self.set);
    }

    /// Lets row `index` follow again (or go back to its default); what follows it moves along.
    pub fn unset(&mut self, table: &ParamTable, index: usize) {
        if let Some(set) = self.set.get_mut(index) {
            *set = false;
            table.resolve(&mut self.values, &self.set);
        }
    }

    /// Mixes breeds by mixing their values. Weights are normalised; one that is not finite or not above 0 counts as 0.
    ///
    /// A single breed with weight comes back as it is; with none at all, [`Breed::defaults`]. A value is set in the result
    /// when it is set in one of the breeds, or when following would give another value than the mean: so a file of the
    /// result reproduces it.
    pub fn blend(table: &ParamTable, breeds: &[(&Breed, f32)]) -> Breed {
        let mut weighted: Vec<(&Breed, f64)> = Vec::new();
        for &(breed, weight) in breeds.iter().filter(|(_, w)| w.is_finite() && *w > 0.0) {
            match weighted.iter_mut().find(|(known, _)| *known == breed) {
                Some(entry) => entry.1 += f64::from(weight),
                None => weighted.push((breed, f64::from(weight))),
            }
        }
        match weighted[..] {
            [] => return Self::defaults(table),
            [(only, _)] => return only.clone(),
            _ => {}
        }
        let total: f64 = weighted.iter().map(|(_, w)| w).sum();
        weighted.iter_mut().for_each(|(_, w)| *w /= total);

        let mut values = vec![0.0; table.specs.len()];
        let mut set = vec![false; table.specs.len()];
        for index in table.order() {
            let spec = &table.specs[index];
            let mean: f64 = weighted.iter().map(|(b, w)| f64::from(b.values[index]) * w).sum();
            let mean = (mean as f32).clamp(spec.min_si(), spec.max_si());
            let followed = table.followed(index, &values);
            let follows = weighted.iter().all(|(b, _)| !b.set[index]) && is_same(mean, followed, spec);
            set[index] = !follows;
            values[index] = if follows { followed } else { mean };
        }
        let looks: Vec<(&Look, f64)> = weighted.iter().map(|(b, w)| (&b.look, *w)).collect();
        let join =
            |of: fn(&Breed) -> &str, with: &str| weighted.iter().map(|(b, _)| of(b)).collect::<Vec<_>>().join(with);
        let (id, label) = (join(|b| &b.id, "+"), join(|b| &b.label, " + "));
        let look = Look::blend(&looks);
        Breed { id, label, fci_group: None, references: Vec::new(), values, set, look, varieties: Vec::new() }
    }

    /// Puts on one of the breed's coats.
    ///
    /// # Errors
    /// A name that none of them has.
    pub fn wear(&mut self, coat: &str) -> Result<(), UnknownCoat> {
        if let Some(variety) = self.varieties.iter().find(|v| v.name == coat) {
            self.look = variety.look.clone();
            return Ok(());
        }
        let coats: Vec<String> = self.varieties.iter().map(|v| v.name.clone()).collect();
        let near = nearest(coat, coats.iter().map(|c| (c.as_str(), c.as_str())));
        let near = near.into_iter().map(str::to_owned).collect();
        Err(UnknownCoat { id: self.id.clone(), word: coat.to_owned(), nearest: near, coats })
    }

    /// The name of the coat that it wears; none where that has no name.
    pub fn worn(&self) -> Option<&str> {
        self.varieties.iter().find(|v| v.look == self.look).map(|v| v.name.as_str())
    }

    /// What a quantity is held against: the first reference with that id.
    pub fn reference(&self, id: &str) -> Option<&Reference> {
        self.references.iter().find(|reference| reference.quantity.id == id)
    }
}

/// Equal but for rounding: a millionth of the range is far below what a file's digits or an eye can tell.
fn is_same(a: f32, b: f32, spec: &super::ParamSpec) -> bool {
    (a - b).abs() <= 1e-6 * (spec.max_si() - spec.min_si())
}
