//! The bits of a frame, every stage, against `tests/frame_hashes.txt`: the breeds that span the others at levels 0, 2 and 4,
//! every other breed at level 1.
//!
//! The same in every profile, on every machine, with any number of threads. `UPDATE_HASHES=1` rewrites the file; a changed
//! line needs a sentence in the changelog that says which stage moved and why.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;

use londra::frame::{Pipeline, StageHashes};
use settings::{SPANNING, World};
use std::fmt::Write as _;
use std::path::PathBuf;

const LEVELS: [u32; 3] = [0, 2, 4];
/// Of the breeds that do not span the others.
const SHALLOW: u32 = 1;

fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/frame_hashes.txt")
}

/// Stages in the order in which a frame goes through them.
fn stages(h: StageHashes) -> [(&'static str, u64); 4] {
    // Indices first: with another topology every later stage differs too.
    [("indices", h.indices), ("control", h.control), ("positions", h.positions), ("normals", h.normals)]
}

fn pipeline(world: &World, level: u32) -> Pipeline {
    Pipeline::new(world.rig.clone(), level).unwrap_or_else(|e| panic!("{e}"))
}

fn hashes(pipeline: &mut Pipeline, breed: &londra::anatomy::Breed) -> StageHashes {
    pipeline.update(breed);
    pipeline.hashes()
}

fn text(world: &World) -> String {
    let mut out = String::from("# breed level stage hash; written by UPDATE_HASHES=1 cargo test --test frame_hash\n");
    let mut add = |level: u32, breeds: &[&londra::anatomy::Breed]| {
        let mut pipeline = pipeline(world, level);
        for breed in breeds {
            for (stage, hash) in stages(hashes(&mut pipeline, breed)) {
                let _ = writeln!(out, "{} {level} {stage} {hash:016x}", breed.id);
            }
        }
    };
    let (spanning, others): (Vec<_>, Vec<_>) = world.breeds.iter().partition(|b| SPANNING.contains(&b.id.as_str()));
    for level in LEVELS {
        add(level, &spanning);
    }
    add(SHALLOW, &others);
    out
}

#[test]
fn a_frame_has_other_bits_than_the_committed_ones() {
    let made = text(&World::embedded());
    if std::env::var_os("UPDATE_HASHES").is_some() {
        std::fs::write(file(), &made).unwrap_or_else(|e| panic!("{}: {e}", file().display()));
        return;
    }
    let committed = std::fs::read_to_string(file()).unwrap_or_default().replace("\r\n", "\n");
    let differing: Vec<&str> = made.lines().filter(|line| !committed.lines().any(|c| c == *line)).collect();
    let named = |line: &str| line.rsplit_once(' ').map_or(line.to_owned(), |(name, _)| name.to_owned());
    // Lines of one breed and level stand in the order of the stages: the first that differs is where it began.
    let mut first: Vec<&str> = Vec::new();
    for line in &differing {
        let head = |l: &str| l.split(' ').take(2).map(str::to_owned).collect::<Vec<_>>();
        if first.last().is_none_or(|before| head(before) != head(line)) {
            first.push(line);
        }
    }
    let list: Vec<String> = first.iter().map(|line| named(line)).collect();
    assert!(
        differing.is_empty(),
        "{} hashes differ from tests/frame_hashes.txt; first differing stage of each frame:\n{}\n\
         If that is meant, run UPDATE_HASHES=1 cargo test --test frame_hash and say why in CHANGELOG.md.",
        differing.len(),
        list.join("\n")
    );
    assert_eq!(made, committed, "tests/frame_hashes.txt has lines that no frame makes");
}

#[test]
fn bits_depend_on_the_number_of_threads() {
    let world = World::embedded();
    for level in LEVELS {
        let mut pipeline = pipeline(&world, level);
        // Two breeds in turn, so that each number of threads computes anew.
        let (a, b) = (world.breed("borzoi"), world.breed("pug"));
        let alone = [hashes(&mut pipeline, a), hashes(&mut pipeline, b)];
        for threads in [2, 8, 1] {
            pipeline.set_threads(threads);
            for (breed, alone) in [a, b].into_iter().zip(alone) {
                for ((stage, expected), (_, found)) in
                    stages(alone).into_iter().zip(stages(hashes(&mut pipeline, breed)))
                {
                    assert_eq!(
                        found, expected,
                        "{} at level {level} with {threads} threads: {stage} differs",
                        breed.id
                    );
                }
            }
        }
    }
}

#[test]
fn bits_depend_on_the_frame_before() {
    let world = World::embedded();
    let mut used = pipeline(&world, 1);
    for breed in world.breeds.iter().rev() {
        hashes(&mut used, breed);
    }
    used.set_level(2).unwrap_or_else(|e| panic!("{e}"));
    for breed in world.spanning() {
        let fresh = hashes(&mut pipeline(&world, 2), breed);
        assert_eq!(hashes(&mut used, breed), fresh, "{} after other heads and another level", breed.id);
    }
}
