//! Text to [`Breed`].

use super::file::{self, BreedFile};
use super::read::Problems;
use super::{Breed, LoadErrors, ParamTable, ProblemKind, QUANTITIES, Quantity, Reference, locate, nearest};

/// Reads a breed. `name` is the file's name or path: it stands in messages, and its stem becomes the breed's id.
///
/// # Errors
/// The first syntax error, or every mistake of meaning: unknown or double or missing fields, wrong types, values out of range
/// or not finite, unknown parameters, measures, markings, regions, colours, versions. Each has its place.
pub fn load_breed(table: &ParamTable, name: &str, text: &str) -> Result<Breed, LoadErrors> {
    let root = locate::parse(name, text)?;
    let mut problems = Problems::default();
    let breed = file::read(&root, &mut problems).map(|file| resolve(table, name, file, &mut problems));
    problems.finish(name, breed)
}

fn resolve(table: &ParamTable, name: &str, file: BreedFile, problems: &mut Problems) -> Breed {
    let mut breed = Breed::defaults(table);
    breed.id = stem(name).to_owned();
    breed.label = file.label;
    breed.fci_group = file.fci_group;
    breed.references = resolve_references(file.references, problems);
    for measure in &file.anatomy {
        let Some(index) = table.index_of(&measure.id) else {
            let near = table.nearest(&measure.id).into_iter().map(str::to_owned).collect();
            problems.push(measure.id_at, ProblemKind::UnknownParameter { id: measure.id.clone(), nearest: near });
            continue;
        };
        let spec = &table.specs[index];
        // NaN stands for a value that has been reported already.
        if measure.value < spec.min || measure.value > spec.max {
            let (field, value, min, max) = (measure.id.clone(), measure.value, spec.min, spec.max);
            problems.push(measure.value_at, ProblemKind::OutOfRange { field, value, min, max });
        } else if !measure.value.is_nan() {
            breed.values[index] = spec.to_si(measure.value);
            breed.set[index] = true;
        }
    }
    table.resolve(&mut breed.values, &breed.set);
    (breed.look, breed.varieties) = (file.look, file.varieties);
    breed
}

fn resolve_references(list: Vec<file::ReferenceFile>, problems: &mut Problems) -> Vec<Reference> {
    let mut references: Vec<Reference> = Vec::new();
    let mut lines = Vec::new();
    for file::ReferenceFile { measure, measure_at, value, value_at, status, source } in list {
        let Some(quantity) = Quantity::from_id(&measure) else {
            let allowed: Vec<&'static str> = QUANTITIES.iter().map(|q| q.id).collect();
            let near = nearest(&measure, allowed.iter().map(|&id| (id, id))).into_iter().map(str::to_owned).collect();
            problems.push(measure_at, ProblemKind::UnknownMeasure { id: measure, nearest: near, allowed });
            continue;
        };
        if value < quantity.min || value > quantity.max {
            let (min, max) = (quantity.min, quantity.max);
            problems.push(value_at, ProblemKind::OutOfRange { field: measure, value, min, max });
            continue;
        }
        let reference = Reference { quantity, value, status, source };
        let is_same = |r: &Reference| (r.quantity, r.status, &r.source) == (quantity, status, &reference.source);
        if let Some(first) = references.iter().position(is_same) {
            let kind = ProblemKind::Duplicate { field: format!("{measure} of this source"), first_line: lines[first] };
            problems.push(measure_at, kind);
            continue;
        }
        references.push(reference);
        lines.push(measure_at.line);
    }
    references
}

/// The file's name without folders and ending.
fn stem(name: &str) -> &str {
    let file = name.rsplit(['/', '\\']).next().unwrap_or(name);
    file.strip_suffix(".ron").unwrap_or(file)
}
