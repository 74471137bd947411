//! Hot reload: which files on disk have changed.

use notify::{RecursiveMode, Watcher};
use std::path::{Path, PathBuf};

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
