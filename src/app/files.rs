//! Breeds, tables and shaders from the disk, and what is written to it.

use super::disk;
use super::state::{Blend, Document, EditorState};
use crate::anatomy::{Breed, ParamTable, library, load_breed};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Reads a breed; its id is the file's name without ending. The error has the path, and a place where there is one.
pub fn read_breed(table: &ParamTable, path: &Path) -> Result<Breed, String> {
    load_breed(table, &path.display().to_string(), &read_text(path)?).map_err(|e| e.to_string())
}

/// Reads a text.
pub fn read_text(path: &Path) -> Result<String, String> {
    disk::read_text(path).map_err(|e| e.to_string())
}

/// Writes a file whole or not at all.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    disk::write_atomic(path, bytes).map_err(|e| e.to_string())
}

/// The table and the breeds, sorted by id: the program's own, overridden by a folder like `rigs/` where there is one.
pub fn read_rigs(folder: Option<&Path>) -> Result<(Arc<ParamTable>, Vec<Breed>), String> {
    let table = match folder.map(|f| f.join("anatomy.ron")).filter(|p| p.exists()) {
        Some(path) => ParamTable::parse(&path.display().to_string(), &read_text(&path)?),
        None => ParamTable::embedded(),
    };
    let table = table.map_err(|e| e.to_string())?;
    let mut breeds: BTreeMap<String, Breed> = BTreeMap::new();
    for id in library::ids() {
        let on_disk = folder.map(|f| f.join("breeds").join(format!("{id}.ron"))).filter(|p| p.exists());
        if on_disk.is_none() {
            breeds.insert(id.to_owned(), library::breed(&table, id).map_err(|e| e.to_string())?);
        }
    }
    for path in folder.map(|f| breed_files(&f.join("breeds"))).unwrap_or_default() {
        let breed = read_breed(&table, &path)?;
        breeds.insert(breed.id.clone(), breed);
    }
    Ok((Arc::new(table), breeds.into_values().collect()))
}

/// The files that end in `.ron`, sorted; none when the folder cannot be read.
fn breed_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> =
        entries.map(|e| e.path()).filter(|p| p.extension().is_some_and(|e| e == "ron")).collect();
    files.sort();
    files
}

/// The path with the working folder before it, to tell where a file is: a window does not show where it was started.
pub fn in_full(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// The first of NAME.ENDING, NAME-1.ENDING, NAME-2.ENDING… that is not taken.
pub fn free_path(folder: &Path, name: &str, ending: &str) -> PathBuf {
    let plain = folder.join(format!("{name}.{ending}"));
    let numbered = (1u32..).map(|n| folder.join(format!("{name}-{n}.{ending}")));
    std::iter::once(plain).chain(numbered).find(|p| !p.exists()).unwrap_or_else(|| folder.join(name))
}

/// What the window begins with: a breed's file (a word with `.ron` or a folder in it), a breed of the list by id, or
/// the Labrador, which most people know.
pub fn first_document(table: &ParamTable, breeds: &[Breed], word: Option<&str>) -> Result<Document, String> {
    let listed = |id: &str| breeds.iter().find(|b| b.id == id).cloned();
    match word {
        Some(word) if word.ends_with(".ron") || word.contains(['/', '\\']) => {
            let path = PathBuf::from(word);
            Ok(Document::of(read_breed(table, &path)?, Some(path)))
        }
        Some(id) => listed(id).map(|b| Document::of(b, None)).ok_or_else(|| format!("unknown breed {id}")),
        None => {
            let first = listed("labrador").or_else(|| breeds.first().cloned());
            Ok(Document::of(first.unwrap_or_else(|| Breed::defaults(table)), None))
        }
    }
}

/// What is edited, carried over to another table: measures are known by their ids, those that are gone are dropped.
pub fn under_new_table(table: &ParamTable, breeds: &[Breed], state: &EditorState) -> Result<Document, String> {
    let old = state.document();
    let base = match &old.path {
        Some(path) => read_breed(table, path)?,
        None => breeds.iter().find(|b| b.id == old.base.id).cloned().unwrap_or_else(|| Breed::defaults(table)),
    };
    let partner = |blend: &Blend| {
        let partner = breeds.iter().find(|b| b.id == blend.partner.id).cloned()?;
        Some(Blend { partner, weight: blend.weight })
    };
    let id = |index: &usize| &state.table.specs[*index].id;
    let overrides = old.overrides.iter().filter_map(|(i, change)| Some((table.index_of(id(i))?, *change))).collect();
    let blend = old.blend.as_ref().and_then(partner);
    let (path, coat, label) = (old.path.clone(), old.coat.clone(), old.label.clone());
    Ok(Document { base, path, blend, coat, overrides, label })
}
