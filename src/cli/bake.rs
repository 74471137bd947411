//! `londra bake`.

use super::args::Bake;
use super::{Failure, output};
use crate::app::disk;
use crate::author::bake;

/// Rebuilds the baked assets of a source tree, or proves that they are what the program makes.
pub(super) fn run(args: &Bake) -> Result<(), Failure> {
    if !args.root.join("assets").is_dir() {
        let root = args.root.display();
        return Err(Failure::work(format!("{root}: has no folder assets; run this where Londra's sources are")));
    }
    let mut stale = Vec::new();
    for baked in bake::all().map_err(Failure::work)? {
        let path = args.root.join(baked.path);
        let is_current = match disk::read_text(&path) {
            Ok(text) => text == baked.text,
            Err(disk::FileError::Missing { .. }) => false,
            Err(error) => return Err(error.into()),
        };
        if is_current {
            output::message(&format!("{} is current", path.display()));
        } else if args.check {
            stale.push(path.display().to_string());
        } else {
            disk::write_atomic(&path, baked.text.as_bytes())?;
            output::message(&format!("wrote {}", path.display()));
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    Err(Failure::work(format!(
        "{}: not what the program makes; run 'londra bake' and look at the change",
        stale.join(", ")
    )))
}
