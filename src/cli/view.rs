//! `londra view`.

use super::Failure;
use super::args::View;
use super::rigs::{self, Rigs};
use crate::app::{self, Launch};
use std::path::Path;

/// Opens the window.
pub(super) fn run(args: &View) -> Result<(), Failure> {
    let here = Launch::here();
    let folder = rigs::folder().or(here.rigs.clone());
    // A wrong file is told as on every other command, before a window is tried.
    let rigs = Rigs::open_in(folder.clone())?;
    if let Some(file) = &args.file {
        rigs.load(file)?;
    }
    if let Some(missing) = missing_display() {
        return Err(Failure::NoDevice(missing));
    }
    // With a folder in it the word is a path, whatever it ends in.
    let breed = args.file.as_ref().map(|file| Path::new(".").join(file).display().to_string());
    let launch = Launch { breed, rigs: folder, ..here };
    app::run(launch).map_err(|error| match error.is_missing_device() {
        true => Failure::NoDevice(error.to_string()),
        false => Failure::work(error),
    })
}

/// What to say where no window can be opened, before any library tries.
fn missing_display() -> Option<String> {
    let has_one_by_nature = cfg!(any(target_os = "macos", target_os = "windows"));
    let named = ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"];
    if has_one_by_nature || named.iter().any(|name| std::env::var_os(name).is_some_and(|v| !v.is_empty())) {
        return None;
    }
    Some(
        "no display (neither DISPLAY nor WAYLAND_DISPLAY is set) to open a window on; the commands render, sheet, export, \
         hash, list and check work without one"
            .into(),
    )
}
