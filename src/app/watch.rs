//! Hot reload: which files on disk have changed.

use notify::{RecursiveMode, Watcher};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The table's file in a folder like `rigs/`.
pub(super) const TABLE: &str = "anatomy.ron";

/// Watches folders and tells of every file in them that was written.
pub(super) struct Watch {
    watcher: Option<notify::RecommendedWatcher>,
    folders: Vec<PathBuf>,
}

impl Watch {
    /// `changed` is called on another thread. A system that cannot watch gives a watch that never calls.
    pub(super) fn new(changed: impl Fn(PathBuf) + Send + 'static) -> Self {
        let tell = move |event: notify::Result<notify::Event>| {
            let Ok(event) = event else { return };
            if event.kind.is_modify() || event.kind.is_create() {
                event.paths.into_iter().for_each(&changed);
            }
        };
        Self { watcher: notify::recommended_watcher(tell).ok(), folders: Vec::new() }
    }

    /// Also watches the files of this folder. One that is not there is not watched.
    pub(super) fn add(&mut self, folder: &Path) {
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        if self.folders.iter().any(|known| known == folder) {
            return;
        }
        // The window works without reload, so that failing to watch is no error.
        let watched = self.watcher.as_mut().is_some_and(|w| w.watch(folder, RecursiveMode::NonRecursive).is_ok());
        if watched {
            self.folders.push(folder.to_owned());
        }
    }
}

/// A table that could not be taken because a breed beside it was broken is tried again when a breed has changed: adds it to
/// what is to be read. `problems`: by file name.
pub(super) fn retry_table(changed: &mut BTreeSet<PathBuf>, problems: &BTreeMap<String, String>, rigs: Option<&Path>) {
    let Some(rigs) = rigs else { return };
    if problems.contains_key(TABLE) && changed.iter().any(|p| p.extension().is_some_and(|e| e == "ron")) {
        changed.insert(rigs.join(TABLE));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_held_up_by_a_breed_is_read_again_with_the_breed() {
        let breed = PathBuf::from("rigs/breeds/pug.ron");
        let shader = PathBuf::from("shaders/mesh.wgsl");
        let held_up = BTreeMap::from([(TABLE.to_owned(), "pug.ron:1:1: broken".to_owned())]);
        let read = |changed: &Path, problems: &BTreeMap<String, String>| {
            let mut changed = BTreeSet::from([changed.to_owned()]);
            retry_table(&mut changed, problems, Some(Path::new("rigs")));
            changed.contains(Path::new("rigs/anatomy.ron"))
        };
        assert!(read(&breed, &held_up));
        assert!(!read(&shader, &held_up), "a shader puts no table right");
        assert!(!read(&breed, &BTreeMap::new()), "a table that is right is left alone");
    }
}
