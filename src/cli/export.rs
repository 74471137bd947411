//! `londra export`.

use super::args::{Export, Lids};
use super::motion::Director;
use super::rigs::Rigs;
use super::{Failure, output, subject};
use crate::export::motion::{Motion, Selection};
use crate::export::{GlbOptions, Textures, to_glb};
use crate::frame::Layers;
use serde_json::json;

/// Writes one head as binary glTF.
pub(super) fn run(args: &Export) -> Result<(), Failure> {
    output::check_target(&args.target.output, args.target.report.json)?;
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    pipeline.set_uv(true).map_err(Failure::work)?;
    let director = Director::new(&args.motion, Lids::default())?;
    director.tell_overruled();
    let pose = director.pose(&rigs, &breed);
    let selection = Selection::parse(&director.library, &args.moving_units, &args.moving_clips)
        .map_err(|error| Failure::Use(format!("{error}; 'londra list' names units, expressions and clips")))?;
    let motion = if selection.is_empty() {
        None
    } else if pose.is_rest() {
        // An open mouth shows what is in it.
        let inside = Layers { teeth: true, mouth: true, tongue: true, ..Layers::default() };
        pipeline.set_layers(inside).map_err(Failure::work)?;
        Some(Motion::bake(&mut pipeline, &breed, &director.library, &selection))
    } else {
        let both = "--units and --clips make a head at rest that moves; leave out what poses it, or --units and --clips";
        return Err(Failure::Use(both.into()));
    };
    pipeline.set_pose(pose);
    pipeline.update(&breed);
    let frame = pipeline.frame();
    let textures = match (args.textures, pipeline.canvas()) {
        (Some(size), Some(canvas)) => {
            Some(Textures::bake(&frame, &canvas, size, args.detail.threads as usize).map_err(Failure::work)?)
        }
        _ => None,
    };
    let options = GlbOptions { copyright: args.copyright.clone(), textures, motion };
    let bytes = to_glb(&frame, &rigs.table, &breed, &options).map_err(Failure::work)?;
    let moving = options.motion.as_ref();
    let facts = json!({
        "output": args.target.output.display().to_string(), "bytes": bytes.len(), "breed": breed.id,
        "label": breed.label, "level": args.detail.level, "triangles": frame.n_triangles(),
        "textures": args.textures, "targets": moving.map_or(0, |m| m.targets.len()),
        "animations": moving.map_or(0, |m| m.clips.len()),
    });
    output::file(&args.target.output, &bytes, args.target.report.json, facts)
}
