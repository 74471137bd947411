//! The bits of moving heads against `tests/motion_hashes.txt`: every expression and every clip at given times on a
//! prick-eared, a drop-eared and a flat-faced breed, with everything that a frame can show.
//!
//! The same in every profile, with any number of threads and at any frame rate. `UPDATE_HASHES=1` rewrites the file; a
//! changed line needs a sentence in the changelog that says what moved and why.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;

use londra::anatomy::Breed;
use londra::frame::{Layers, Pipeline, StageHashes};
use londra::motion::{Act, Build, Cue, Library, Pose, Stimulus};
use settings::World;
use std::fmt::Write as _;
use std::path::PathBuf;

const BREEDS: [&str; 3] = ["german_shepherd", "beagle", "pug"];
/// Level from which on pressed skin is wrinkled.
const LEVEL: u32 = 3;
/// Parts of a clip's length, and of an expression's.
const TIMES: [f64; 3] = [0.2, 0.5, 0.8];

fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/motion_hashes.txt")
}

fn pipeline(world: &World, threads: usize) -> Pipeline {
    let mut pipeline = Pipeline::new(world.rig.clone(), LEVEL).expect("a level that is allowed");
    let all = Layers::parse(&Layers::NAMES.join(",")).expect("the names");
    pipeline.set_layers(all).expect("parts");
    pipeline.set_threads(threads);
    pipeline
}

fn breed(world: &World, id: &str) -> Breed {
    world.breeds.iter().find(|b| b.id == id).cloned().expect(id)
}

fn hashes(pipeline: &mut Pipeline, breed: &Breed, pose: Pose) -> StageHashes {
    pipeline.set_pose(pose);
    pipeline.update(breed);
    pipeline.hashes()
}

fn poses(library: &Library) -> Vec<(String, Pose)> {
    let mut out = Vec::new();
    for e in &library.expressions {
        for part in TIMES {
            let time = e.seconds() * part;
            out.push((format!("expression {} {time:.2}", e.id), library.pose(&e.moment(time), 0.0, |_| ())));
        }
    }
    for clip in &library.clips {
        for part in TIMES {
            let time = clip.seconds * part;
            out.push((format!("clip {} {time:.2}", clip.id), library.pose(&clip.at(time), time, |_| ())));
        }
    }
    out
}

#[test]
fn a_moving_head_has_other_bits_than_the_committed_ones() {
    let world = World::embedded();
    let library = Library::embedded().expect("the tables");
    let mut made = String::from(
        "# breed, what it does, seconds, control, positions, normals; written by UPDATE_HASHES=1 cargo test --test motion_hash\n",
    );
    let mut pipeline = pipeline(&world, 1);
    for id in BREEDS {
        let breed = breed(&world, id);
        for (name, pose) in poses(&library) {
            let h = hashes(&mut pipeline, &breed, pose);
            let _ = writeln!(made, "{id} {name} {:016x} {:016x} {:016x}", h.control, h.positions, h.normals);
        }
    }
    if std::env::var_os("UPDATE_HASHES").is_some() {
        std::fs::write(file(), &made).unwrap_or_else(|e| panic!("{}: {e}", file().display()));
        return;
    }
    let committed = std::fs::read_to_string(file()).unwrap_or_default().replace("\r\n", "\n");
    let differing: Vec<&str> = made.lines().filter(|line| !committed.lines().any(|c| c == *line)).collect();
    assert!(
        differing.is_empty(),
        "{} of {} lines differ from tests/motion_hashes.txt, first\n{}\n\
         If that is meant, run UPDATE_HASHES=1 cargo test --test motion_hash and say why in CHANGELOG.md.",
        differing.len(),
        made.lines().count(),
        differing[0]
    );
}

#[test]
fn threads_or_what_was_before_change_a_moving_head() {
    let world = World::embedded();
    let library = Library::embedded().expect("the tables");
    let poses = poses(&library);
    let breed = breed(&world, BREEDS[1]);
    let [mut one, mut three] = [1, 3].map(|threads| pipeline(&world, threads));
    for (name, pose) in poses.iter().step_by(7) {
        let once = hashes(&mut one, &breed, *pose);
        // By way of another pose and another head.
        hashes(&mut three, &self::breed(&world, BREEDS[0]), Pose::default());
        hashes(&mut three, &breed, poses[3].1);
        assert_eq!(once, hashes(&mut three, &breed, *pose), "{name}");
    }
}

#[test]
fn a_frame_rate_changes_a_living_head() {
    let world = World::embedded();
    let library = Library::embedded().expect("the tables");
    let breed = breed(&world, BREEDS[2]);
    let mut pipeline = pipeline(&world, 1);
    let mut at_rate = |rate: f64| {
        let mut act = Act::new(Build::default());
        let pant = library.clips.iter().position(|c| c.id == "pant").expect("a clip");
        act.player.layer(Cue::new(&library, pant, 0.5, 0.3));
        let mut last = Pose::default();
        for frame in 0..=(3.0 * rate) as u32 {
            last = act.pose(&library, f64::from(frame) / rate, |_| Stimulus::default(), |_| ());
        }
        hashes(&mut pipeline, &breed, last)
    };
    let [slow, fast] = [24.0, 120.0].map(&mut at_rate);
    assert_eq!(slow, fast);
}
