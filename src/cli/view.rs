//! `londra view`: the window, and what its work takes.

use super::args::View;
use super::rigs::{self, Rigs};
use super::{Failure, output};
use crate::app::{self, AppError, Launch};
use serde_json::json;
use std::path::Path;

/// The window that is measured, pixels.
const WINDOW: [u32; 2] = [1280, 800];

/// Opens the window.
pub(super) fn run(args: &View) -> Result<(), Failure> {
    let here = Launch::here();
    let folder = rigs::folder().or(here.rigs.clone());
    // A wrong file is told as on every other command, before a window is tried.
    let rigs = Rigs::open_in(folder.clone())?;
    if let Some(file) = &args.file {
        rigs.load(file)?;
    }
    // With a folder in it the word is a path, whatever it ends in.
    let breed = args.file.as_ref().map(|file| Path::new(".").join(file).display().to_string());
    let (n_strands, condition) = (args.fur.hair, args.fur.condition());
    let launch = Launch { breed, rigs: folder, level: args.level, n_strands, condition, ..here };
    if let Some(n_pictures) = args.measure {
        return measure(&launch, n_pictures, args.size.unwrap_or(WINDOW), args.json);
    }
    if let Some(missing) = missing_display() {
        return Err(Failure::NoDevice(missing));
    }
    app::run(launch).map_err(failure)
}

/// Prints what the window's own work takes.
fn measure(launch: &Launch, n_pictures: u32, window: [u32; 2], as_json: bool) -> Result<(), Failure> {
    let m = app::measure(launch, n_pictures as usize, window).map_err(failure)?;
    let [width, height] = m.picture;
    if as_json {
        return output::json(&json!({
            "pictures": n_pictures, "adapter": m.adapter, "level": m.level, "triangles": m.n_triangles,
            "own_ms": m.own_ms, "own_slow_ms": m.own_slow_ms, "panels_ms": m.panels_ms, "head_ms": m.head_ms,
            "record_ms": m.record_ms, "submit_ms": m.submit_ms, "measure_ms": m.measure_ms,
            "picture": m.picture, "strands": m.n_strands, "draw_ms": m.draw_ms, "drag_ms": m.drag_ms,
        }));
    }
    output::result(&format!(
        "own work {:.2} ms a picture (median of {n_pictures}; one in twenty takes {:.2} or more): panels {:.2}, head \
         {:.2}, uploads and passes {:.2}\nhanding over {:.2} ms; the panel of measurements, while it is open, {:.2} ms more\nthe driver draws \
         {width} x {height} pixels with {} strands in {:.1} ms, {:.1} while something is dragged: all in all {:.1} and {:.1} \
         pictures a second\nlevel {}, {} triangles, {}",
        m.own_ms,
        m.own_slow_ms,
        m.panels_ms,
        m.head_ms,
        m.record_ms,
        m.submit_ms,
        m.measure_ms,
        m.n_strands,
        m.draw_ms,
        m.drag_ms,
        1000.0 / (m.own_ms + m.submit_ms + m.draw_ms),
        1000.0 / (m.own_ms + m.submit_ms + m.drag_ms),
        m.level,
        m.n_triangles,
        m.adapter
    ))
}

fn failure(error: AppError) -> Failure {
    match error.is_missing_device() {
        true => Failure::NoDevice(error.to_string()),
        false => Failure::work(error),
    }
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
