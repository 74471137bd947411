//! `londra export`.

use super::args::Export;
use super::rigs::Rigs;
use super::{Failure, output, subject};
use crate::export::{GlbOptions, to_glb};
use serde_json::json;

/// Writes one head as binary glTF.
pub(super) fn run(args: &Export) -> Result<(), Failure> {
    output::check_target(&args.target.output, args.target.report.json)?;
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    pipeline.set_uv(true).map_err(Failure::work)?;
    let frame = pipeline.update(&breed);
    let options = GlbOptions { copyright: args.copyright.clone() };
    let bytes = to_glb(&frame, &rigs.table, &breed, &options).map_err(Failure::work)?;
    let facts = json!({
        "output": args.target.output.display().to_string(), "bytes": bytes.len(), "breed": breed.id,
        "label": breed.label, "level": args.detail.level, "triangles": frame.n_triangles(),
    });
    output::file(&args.target.output, &bytes, args.target.report.json, facts)
}
