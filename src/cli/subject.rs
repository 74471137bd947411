//! From `--breed`, `--coat`, `--blend` and `--set` to a breed, and from a breed to a frame.

use super::args::{Changes, Detail};
use super::rigs::Rigs;
use super::{Failure, values};
use crate::anatomy::{Breed, ParamTable};
use crate::frame::Pipeline;
use crate::rig::Rig;
use std::sync::Arc;

/// The breed that the words describe: first the breed in its coat, then what is mixed in, then what is set.
pub(super) fn breed(rigs: &Rigs, word: &str, changes: &Changes) -> Result<Breed, Failure> {
    let mut base = rigs.breed(word)?;
    if let Some(coat) = &changes.coat {
        base.wear(coat).map_err(|error| Failure::Use(error.to_string()))?;
    }
    let others: Vec<(Breed, f32)> = changes
        .blend
        .iter()
        .map(|share| Ok((rigs.breed(&share.breed)?, share.weight)))
        .collect::<Result<_, Failure>>()?;
    let sum: f64 = others.iter().map(|(_, weight)| f64::from(*weight)).sum();
    let left = 1.0 - sum;
    // Weights such as 0.1 + 0.2 + 0.7 may pass 1, or miss it, by their roundings.
    let rounding = 1e-6;
    if left < -rounding {
        let sum = sum as f32;
        return Err(Failure::Use(format!("the weights of --blend sum to {sum}, at most 1 is there to share")));
    }
    let mut parts = vec![(&base, if left > rounding { left as f32 } else { 0.0 })];
    parts.extend(others.iter().map(|(breed, weight)| (breed, *weight)));
    let mut breed = Breed::blend(&rigs.table, &parts);
    for setting in &changes.set {
        set(&rigs.table, &mut breed, &setting.id, setting.value)?;
    }
    Ok(breed)
}

/// Sets a measure in the unit its id ends in, and gives its row.
pub(super) fn set(table: &ParamTable, breed: &mut Breed, id: &str, value: f64) -> Result<usize, Failure> {
    let Some(index) = table.index_of(id) else {
        let near = values::did_you_mean(&table.nearest(id));
        return Err(Failure::Use(format!("unknown parameter '{id}'{near}; 'londra list parameters' names them all")));
    };
    let spec = &table.specs[index];
    if !(spec.min..=spec.max).contains(&value) {
        return Err(Failure::Use(format!("{id} is {value}, allowed {} to {}", spec.min, spec.max)));
    }
    breed.set_value(table, index, spec.to_si(value));
    Ok(index)
}

/// A pipeline for the table of the rigs.
pub(super) fn pipeline(rigs: &Rigs, detail: &Detail) -> Result<Pipeline, Failure> {
    let rig = Arc::new(Rig::embedded(&rigs.table).map_err(Failure::work)?);
    let mut pipeline = Pipeline::new(rig, detail.level).map_err(Failure::work)?;
    pipeline.set_threads(detail.threads as usize);
    Ok(pipeline)
}
