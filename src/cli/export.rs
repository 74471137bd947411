//! `londra export`.

use super::args::{Export, Lids};
use super::motion::Director;
use super::rigs::Rigs;
use super::{Failure, output, subject};
use crate::export::{GlbOptions, Textures, to_glb};
use serde_json::json;

/// Writes one head as binary glTF.
pub(super) fn run(args: &Export) -> Result<(), Failure> {
    output::check_target(&args.target.output, args.target.report.json)?;
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    if args.motion.is_asked_for() {
        pipeline.set_layers(pipeline.layers().with_open_mouth()).map_err(Failure::work)?;
    }
    pipeline.set_uv(true).map_err(Failure::work)?;
    let director = Director::new(&args.motion, Lids::default())?;
    director.tell_overruled();
    pipeline.set_pose(director.pose(&rigs, &breed));
    pipeline.update(&breed);
    let frame = pipeline.frame();
    let textures = match (args.textures, pipeline.canvas()) {
        (Some(size), Some(canvas)) => {
            Some(Textures::bake(&frame, &canvas, size, args.detail.threads as usize).map_err(Failure::work)?)
        }
        _ => None,
    };
    let options = GlbOptions { copyright: args.copyright.clone(), textures };
    let bytes = to_glb(&frame, &rigs.table, &breed, &options).map_err(Failure::work)?;
    let facts = json!({
        "output": args.target.output.display().to_string(), "bytes": bytes.len(), "breed": breed.id,
        "label": breed.label, "level": args.detail.level, "triangles": frame.n_triangles(),
        "textures": args.textures,
    });
    output::file(&args.target.output, &bytes, args.target.report.json, facts)
}
