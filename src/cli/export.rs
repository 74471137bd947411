//! `londra export`.

use super::args::{Export, Lids};
use super::motion::Director;
use super::rigs::Rigs;
use super::{Failure, output, subject};
use crate::export::motion::{Motion, Selection};
use crate::export::{GlbOptions, Textures, to_glb};
use serde_json::json;

/// Writes one head as binary glTF.
pub(super) fn run(args: &Export) -> Result<(), Failure> {
    output::check_target(&args.target.output, args.target.report.json)?;
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    let director = Director::new(&args.motion, Lids::default())?;
    let selection = Selection::parse(&director.library, &args.moving_units, &args.moving_clips)
        .map_err(|error| Failure::Use(format!("{error}; 'londra list' names units, expressions and clips")))?;
    if args.motion.is_asked_for() && !selection.is_empty() {
        let both = "--units and --clips write a head at rest that can move: leave out what poses it, or the two";
        return Err(Failure::Use(both.into()));
    }
    if args.motion.is_asked_for() || !selection.is_empty() {
        pipeline.set_layers(pipeline.layers().with_open_mouth()).map_err(Failure::work)?;
    }
    pipeline.set_uv(true).map_err(Failure::work)?;
    director.tell_overruled();
    let bake = || Motion::bake(&mut pipeline, &breed, &director.library, &selection);
    let motion = (!selection.is_empty()).then(bake);
    pipeline.set_pose(director.pose(&rigs, &breed));
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
