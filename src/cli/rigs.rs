//! The table of measures and the breeds: those of the program, or those of a folder on disk that overrides them.

use super::{Failure, values};
use crate::anatomy::{Breed, LoadErrors, ParamTable, library, load_breed, nearest};
use crate::app::disk::{self, FileError};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The environment variable that names a folder like `rigs/`.
const FOLDER: &str = "LONDRA_RIGS";

/// Where measures and breeds come from.
pub(super) struct Rigs {
    /// The measures.
    pub table: Arc<ParamTable>,
    folder: Option<PathBuf>,
}

impl Rigs {
    /// The program's own, overridden by what stands in the folder `LONDRA_RIGS`.
    pub fn open() -> Result<Self, Failure> {
        Self::open_in(folder())
    }

    /// The program's own, overridden by what stands in a folder.
    pub fn open_in(folder: Option<PathBuf>) -> Result<Self, Failure> {
        if let Some(folder) = folder.as_ref().filter(|f| !f.is_dir()) {
            return Err(Failure::work(format!(
                "{}: is no folder of breeds, though {FOLDER} names it",
                folder.display()
            )));
        }
        let own = folder.as_ref().map(|f| f.join("anatomy.ron")).filter(|p| p.exists());
        let table = match own {
            Some(path) => ParamTable::parse(&path.display().to_string(), &disk::read_text(&path)?)?,
            None => ParamTable::embedded()?,
        };
        Ok(Self { table: Arc::new(table), folder })
    }

    /// A breed by name, or by a file that ends in `.ron`; behind a colon, which of its coats it wears.
    pub fn breed(&self, word: &str) -> Result<Breed, Failure> {
        // A colon may also stand behind the letter of a drive.
        match word.rsplit_once(':').filter(|(_, coat)| !coat.contains(['/', '\\', '.'])) {
            Some((breed, coat)) => {
                let mut breed = self.in_its_first_coat(breed)?;
                breed.wear(coat).map_err(|error| Failure::Use(error.to_string()))?;
                Ok(breed)
            }
            None => self.in_its_first_coat(word),
        }
    }

    fn in_its_first_coat(&self, word: &str) -> Result<Breed, Failure> {
        if is_file(word) {
            return self.load(Path::new(word));
        }
        if let Some(path) = self.on_disk(word) {
            return self.load(&path);
        }
        if let Some((id, text)) = library::BREEDS.iter().find(|(id, _)| *id == word) {
            return Ok(load_breed(&self.table, &format!("rigs/breeds/{id}.ron"), text)?);
        }
        let ids = self.ids();
        let near = nearest(word, ids.iter().map(|id| (id.as_str(), id.as_str())));
        let near = values::did_you_mean(&near);
        Err(Failure::Use(format!("unknown breed '{word}'{near}; 'londra list breeds' names them all")))
    }

    /// Reads a breed's file.
    pub fn load(&self, path: &Path) -> Result<Breed, Failure> {
        Ok(load_breed(&self.table, &path.display().to_string(), &disk::read_text(path)?)?)
    }

    /// Compares a file with the table: a breed's file, or a table itself.
    pub fn check(&self, path: &Path) -> Result<Result<(), LoadErrors>, FileError> {
        let (name, text) = (path.display().to_string(), disk::read_text(path)?);
        let as_breed = load_breed(&self.table, &name, &text).map(drop);
        let is_table = text.lines().map(str::trim_start).find(|l| !l.is_empty() && !l.starts_with("//"));
        let is_table = is_table.is_some_and(|line| line.starts_with("Anatomy"));
        Ok(if is_table { ParamTable::parse(&name, &text).map(drop) } else { as_breed })
    }

    /// The names of all breeds, sorted.
    pub fn ids(&self) -> Vec<String> {
        let mut ids: Vec<String> = library::ids().map(str::to_owned).collect();
        let folder = self.folder.iter().filter_map(|f| std::fs::read_dir(f.join("breeds")).ok());
        for entry in folder.flatten().flatten() {
            let name = entry.file_name();
            ids.extend(name.to_str().and_then(|n| n.strip_suffix(".ron")).map(str::to_owned));
        }
        ids.sort();
        ids.dedup();
        ids
    }

    fn on_disk(&self, id: &str) -> Option<PathBuf> {
        let plain = id.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | ' '));
        let path = self.folder.as_ref().filter(|_| plain)?.join("breeds").join(format!("{id}.ron"));
        path.exists().then_some(path)
    }
}

/// The folder that the environment names, if it does.
pub(super) fn folder() -> Option<PathBuf> {
    std::env::var_os(FOLDER).filter(|f| !f.is_empty()).map(PathBuf::from)
}

/// Whether a word of the command line is a file's name rather than a breed's.
fn is_file(word: &str) -> bool {
    word.ends_with(".ron") || word.contains(['/', '\\'])
}
