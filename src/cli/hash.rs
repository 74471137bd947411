//! `londra hash`.

use super::args::{Hash, Lids};
use super::motion::Director;
use super::rigs::Rigs;
use super::{Failure, output, subject};
use serde_json::json;

/// Prints one number per stage of a frame.
pub(super) fn run(args: &Hash) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    let director = Director::new(&args.motion, Lids::default())?;
    director.tell_overruled();
    pipeline.set_pose(director.pose(&rigs, &breed));
    pipeline.update(&breed);
    let hashes = pipeline.hashes();
    let stages = [
        ("control", hashes.control),
        ("positions", hashes.positions),
        ("normals", hashes.normals),
        ("indices", hashes.indices),
    ];
    let [control, positions, normals, indices] = stages.map(|(_, hash)| format!("{hash:016x}"));
    if args.report.json {
        return output::json(&json!({
            "breed": breed.id, "label": breed.label, "level": args.detail.level, "control": control,
            "positions": positions, "normals": normals, "indices": indices,
        }));
    }
    output::result(&stages.map(|(stage, hash)| format!("{stage} {hash:016x}")).join("\n"))
}
