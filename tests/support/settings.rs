//! Heads to test: the rig, its breeds, and seeded settings of the sliders.

use londra::anatomy::{Breed, ParamTable, library};
use londra::frame::Pipeline;
use londra::math::rng::Rng;
use londra::rig::Rig;
use std::sync::Arc;

/// Table, rig and breeds of the program.
pub struct World {
    /// The table of measures.
    pub table: Arc<ParamTable>,
    /// The rig made for it.
    #[allow(dead_code)] // not every test file deforms
    pub rig: Arc<Rig>,
    /// Every breed, sorted by id.
    pub breeds: Vec<Breed>,
}

/// Breeds that span the others: what is too dear for every breed takes these, and `LONDRA_SWEEP=all` all.
#[allow(dead_code)] // not every test file asks
pub const SPANNING: [&str; 8] =
    ["beagle", "borzoi", "bulldog", "chihuahua", "dachshund", "german_shepherd", "labrador", "pug"];

/// Breeds with a known fault, as they are: a fold at level 1, or triangles that cross, in the hollow between bridge, stop and
/// eye of the narrowest and the shortest faces, and before a low ear.
#[allow(dead_code)] // not every test file asks
pub const KNOWN_BREEDS: &[&str] = &["bloodhound", "pekingese", "yorkshire_terrier"];

/// A setting of the sliders, and words that say which.
#[allow(dead_code)] // not every test file reads both
pub struct Setting {
    /// How to get it again.
    pub name: String,
    /// One value for each row of the table, SI.
    pub values: Vec<f32>,
}

impl World {
    /// What is part of the program.
    pub fn embedded() -> World {
        let table = ParamTable::embedded().unwrap_or_else(|e| panic!("{e}"));
        let rig = Rig::embedded(&table).unwrap_or_else(|e| panic!("{e}"));
        let breeds = library::ids().map(|id| library::breed(&table, id).unwrap_or_else(|e| panic!("{e}"))).collect();
        World { table: Arc::new(table), rig: Arc::new(rig), breeds }
    }

    /// The row of a measure.
    pub fn row(&self, id: &str) -> usize {
        self.table.index_of(id).unwrap_or_else(|| panic!("rigs/anatomy.ron has no {id}"))
    }

    /// A breed by id.
    #[allow(dead_code)] // not every test file asks
    pub fn breed(&self, id: &str) -> &Breed {
        self.breeds.iter().find(|b| b.id == id).unwrap_or_else(|| panic!("no breed {id}"))
    }

    /// A pipeline of a level of subdivision, with so many strands of hair.
    #[allow(dead_code)]
    pub fn pipeline(&self, level: u32, n_strands: usize) -> Pipeline {
        let mut pipeline = Pipeline::new(self.rig.clone(), level).unwrap_or_else(|e| panic!("{e}"));
        pipeline.set_hair(n_strands);
        pipeline
    }

    /// The breeds that span the others.
    #[allow(dead_code)]
    pub fn spanning(&self) -> impl Iterator<Item = &Breed> {
        self.breeds.iter().filter(|b| SPANNING.contains(&b.id.as_str()))
    }

    /// Pairs of breeds to blend: every pair of the spanning breeds, and each breed with the one 1, 8 and 21 places after it
    /// in the alphabet; with `LONDRA_SWEEP=all` every pair.
    #[allow(dead_code)]
    pub fn pairs(&self) -> Vec<[&Breed; 2]> {
        let n = self.breeds.len();
        let spans = |i: usize| SPANNING.contains(&self.breeds[i].id.as_str());
        let near = |i: usize, j: usize| [1, 8, 21].iter().any(|d| (j + d) % n == i || (i + d) % n == j);
        let all = (0..n).flat_map(|i| (0..i).map(move |j| (i, j)));
        let taken = all.filter(|&(i, j)| sweeps_all() || near(i, j) || spans(i) && spans(j));
        taken.map(|(i, j)| [&self.breeds[i], &self.breeds[j]]).collect()
    }

    /// Two or three breeds mixed with random weights, then every value moved by up to `jitter` of its range.
    #[allow(dead_code)]
    pub fn mixed(&self, seed: u64, jitter: f32) -> Setting {
        let mut rng = Rng::new(seed);
        let n = 2 + rng.below(2);
        let parts: Vec<(&Breed, f32)> =
            (0..n).map(|_| (&self.breeds[rng.below(self.breeds.len())], rng.between(0.05, 1.0))).collect();
        let mut values = Breed::blend(&self.table, &parts).values;
        for (value, spec) in values.iter_mut().zip(&self.table.specs) {
            let (low, high) = (spec.min_si(), spec.max_si());
            *value = (*value + rng.between(-jitter, jitter) * (high - low)).clamp(low, high);
        }
        let ids: Vec<&str> = parts.iter().map(|(b, _)| b.id.as_str()).collect();
        Setting { name: format!("seed {seed}, {}, jitter {jitter}", ids.join("+")), values }
    }

    /// A breed with one slider at one end of its range.
    #[allow(dead_code)]
    pub fn extremes(&self, breed: &Breed) -> Vec<Setting> {
        let one = |row: usize, high: bool| {
            let spec = &self.table.specs[row];
            let mut values = breed.values.clone();
            values[row] = if high { spec.max_si() } else { spec.min_si() };
            let end = if high { spec.max } else { spec.min };
            Setting { name: format!("{} with {}={end}", breed.id, spec.id), values }
        };
        (0..self.table.specs.len()).flat_map(|row| [one(row, false), one(row, true)]).collect()
    }

    /// Skull length of a setting, metres, estimated: cranial and facial length meet at the nasion under 148 degrees,
    /// which fits the shipped breeds to 4 %.
    #[allow(dead_code)]
    pub fn skull_length(&self, values: &[f32]) -> f32 {
        let (c, f) = (values[self.row("cranial_length_mm")], values[self.row("facial_length_mm")]);
        (c * c + f * f + 2.0 * c * f * 0.848).sqrt()
    }
}

/// Whether the large sweeps run in full.
#[allow(dead_code)]
pub fn sweeps_all() -> bool {
    std::env::var("LONDRA_SWEEP").is_ok_and(|v| v == "all")
}
