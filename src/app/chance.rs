//! Random dogs for the window: the seed, what is kept, and the draw.

use super::state::{Document, EditorState};
use crate::anatomy::{Locks, Space, SpaceError};
use crate::math::rng::Rng;
use crate::measure::Folds;
use crate::rig::Rig;
use std::collections::BTreeSet;
use std::sync::Arc;

/// How often a dog is drawn again whose skin folds.
const MOST_DRAWS: u32 = 100;

/// What the next random dog depends on, beside the breeds and the dog that is shown.
#[derive(Default)]
pub struct Chance {
    /// Of the next dog; grows by one with each.
    pub seed: u64,
    /// What the next dog keeps of the one that is shown: groups of the table, `coat`.
    pub kept: BTreeSet<String>,
    /// Made for the first dog.
    folds: Option<Folds>,
}

impl Chance {
    /// Another table has other rows and groups.
    pub(super) fn forget_table(&mut self) {
        self.kept.clear();
        self.folds = None;
    }
}

impl EditorState {
    /// Shows a dog drawn from the covariance of the breeds, and goes on to the next seed. With nothing kept it is the dog
    /// that `londra breed --random` makes of the same seed.
    pub fn random_dog(&mut self) {
        if let Err(error) = self.draw() {
            self.complain(error);
        }
    }

    fn draw(&mut self) -> Result<(), String> {
        let space = Space::new(&self.table, &self.breeds).map_err(|e| e.to_string())?;
        let mut locks = Locks::none(&self.table);
        for word in &self.chance.kept {
            locks.lock(&self.table, word).map_err(|e| e.to_string())?;
        }
        let mut folds = match self.chance.folds.take() {
            Some(folds) => folds,
            None => {
                let rig = Rig::embedded(&self.table).map_err(|e| e.to_string())?;
                Folds::new(Arc::new(rig)).map_err(|e| e.to_string())?
            }
        };
        let seed = self.chance.seed;
        let mut rng = Rng::new(Rng::new(seed).next_u64());
        let draw = || Ok::<_, SpaceError>(space.random(&self.table, &self.breeds, self.breed(), &locks, &mut rng));
        let (mut dog, _) = folds.unfolded(MOST_DRAWS, draw).map_err(|e| e.to_string())?;
        dog.id = format!("random_{seed}_1");
        dog.label = format!("Random {seed}-1");
        self.open(Document::of(dog, None));
        self.chance.folds = Some(folds);
        self.chance.seed = seed.wrapping_add(1);
        Ok(())
    }
}
