//! What a vet would measure on the head that is shown, and where it stands among the breeds: for the panel beside the sliders.
//!
//! Only an open panel costs anything: the shown head once for each change of its shape, and the breeds one a picture until
//! all are known, so that no picture waits for the others.

use super::state::EditorState;
use crate::anatomy::Breed;
use crate::measure::{Calliper, Measurement, percentile};
use crate::rig::Rig;
use std::sync::Arc;

/// The width that the index is changed by.
const WIDTH: &str = "zygomatic_width_mm";
/// The index.
const INDEX: &str = "skull_index";

/// As long as the state; the calliper as long as the table.
#[derive(Default)]
pub struct Measures {
    /// The panel is shown.
    pub is_open: bool,
    calliper: Option<Calliper>,
    /// The values that `found` was measured with.
    values: Vec<f32>,
    found: Vec<Measurement>,
    /// Of each breed of the list, in its order, as far as they are known.
    survey: Vec<Vec<Measurement>>,
}

impl Measures {
    /// Every measurement of the head that is shown, in the calliper's order; empty before the panel is shown first.
    pub fn found(&self) -> &[Measurement] {
        &self.found
    }

    /// How many breeds are known.
    pub fn n_surveyed(&self) -> usize {
        self.survey.len()
    }

    /// Where the `k`-th measurement stands among the breeds that are known, 0 to 100.
    pub fn percentile(&self, k: usize) -> Option<f32> {
        percentile(self.found.get(k)?.value, self.survey.iter().filter_map(|list| list.get(k)).map(|m| m.value))
    }

    /// The breeds of the list have changed.
    pub(super) fn forget_breeds(&mut self) {
        self.survey.clear();
    }

    /// Another table has other rows.
    pub(super) fn forget_table(&mut self) {
        *self = Self { is_open: self.is_open, ..Self::default() };
    }

    /// Measures a head that has changed, or else the next breed. Returns whether there is more to do.
    fn update(
        &mut self,
        shown: &Breed,
        breeds: &[Breed],
        rig: impl FnOnce() -> Result<Rig, String>,
    ) -> Result<bool, String> {
        let calliper = match &mut self.calliper {
            Some(calliper) => calliper,
            none => none.insert(Calliper::new(Arc::new(rig()?)).map_err(|e| e.to_string())?),
        };
        if self.values != shown.values {
            self.found = calliper.measure(&shown.values);
            self.values.clone_from(&shown.values);
        } else if let Some(next) = breeds.get(self.survey.len()) {
            self.survey.push(calliper.measure(&next.values));
        }
        Ok(self.survey.len() < breeds.len())
    }
}

impl EditorState {
    /// Brings the measurements up to the head that is shown; a slice of work, once a picture while the panel is open.
    /// Returns whether another picture is wanted for the rest.
    pub fn measure(&mut self) -> bool {
        let mut measures = std::mem::take(&mut self.measures);
        let table = self.table.clone();
        let updated = measures.update(self.breed(), &self.breeds, || Rig::embedded(&table).map_err(|e| e.to_string()));
        self.measures = measures;
        updated.unwrap_or_else(|error| {
            self.complain(error);
            self.measures.is_open = false;
            false
        })
    }

    /// The cephalic index that is shown, and how far a hand can drag it: as far as the zygomatic width goes.
    pub fn skull_index(&self) -> Option<(f32, [f32; 2])> {
        let now = self.measures.found.iter().find(|m| m.id == INDEX).map(|m| m.value).filter(|i| *i > 0.0)?;
        let row = self.table.index_of(WIDTH)?;
        let (spec, width) = (&self.table.specs[row], self.breed().values[row]);
        Some((now, [spec.min_si(), spec.max_si()].map(|end| now * end / width)))
    }

    /// Makes the cephalic index this one by the zygomatic width, which stops at the ends of its range: the index is
    /// 100 width / length on bone, and the length does not depend on the width.
    pub fn set_skull_index(&mut self, index: f32) {
        let Some(((now, _), row)) = self.skull_index().zip(self.table.index_of(WIDTH)) else { return };
        if index.is_finite() && index > 0.0 {
            // Cut off at the ends of the range by the breed.
            let (spec, width) = (&self.table.specs[row], self.breed().values[row] * index / now);
            self.set_value(row, width.clamp(spec.min_si(), spec.max_si()));
        }
    }
}
