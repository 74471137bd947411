//! The built program moves a head: units, notation, expressions, clips, films, lists.
#![cfg(feature = "graphics")]

#[path = "support/program.rs"]
mod program;

use program::{done, folder, names_in, png_size, refused, text};
use serde_json::Value;

const SMALL: [&str; 6] = ["--level", "1", "--breed", "pug", "--json", "--threads=2"];

fn hash(words: &[&str]) -> String {
    let all: Vec<&str> = ["hash"].iter().chain(&SMALL).chain(words).copied().collect();
    let read: Value = serde_json::from_str(&done(&all).stdout).expect("an object");
    read["positions"].as_str().expect("a hash").to_owned()
}

fn list(what: &str) -> Vec<Value> {
    serde_json::from_str(&done(&["list", what, "--json"]).stdout).expect("an array")
}

#[test]
fn words_for_the_same_pose_make_different_heads_or_others_the_same() {
    let rest = hash(&[]);
    let fear = hash(&["--expression", "fear"]);
    assert_ne!(rest, fear);
    assert_eq!(rest, hash(&["--expression", "neutral"]));
    assert_eq!(rest, hash(&["--expression", "fear=0"]));
    assert_ne!(fear, hash(&["--expression", "fear=0.5"]));
    let typed = hash(&["--facs", "101B+EAD103L"]);
    assert_eq!(typed, hash(&["--unit", "AU101=0.4", "--unit", "EAD103L=1"]));
    assert_ne!(typed, hash(&["--unit", "AU101=0.4", "--unit", "EAD103R=1"]));
    assert_eq!(rest, hash(&["--clip", "yawn", "--time", "0"]));
    assert_ne!(rest, hash(&["--clip", "yawn", "--time", "1.5"]));
    assert_eq!(rest, hash(&["--clip", "yawn", "--time", "20"]), "a clip that is over stays as it ended");
    assert_ne!(hash(&["--life=1", "--time", "2"]), hash(&["--life=2", "--time", "2"]));
    assert_eq!(hash(&["--life=1", "--time", "2"]), hash(&["--life=1", "--time", "2.0"]));
}

#[test]
fn wrong_words_are_taken_or_no_cure_is_told() {
    for (words, cure) in [
        (["--unit", "AU28=1"].as_slice(), "did you mean AU25 or AU26 or AU27?"),
        (&["--unit", "AU26L=1"], "AU26 is not there for one side alone"),
        (&["--unit", "AU101=2"], "AU101 is 2, allowed 0 to 1"),
        (&["--unit", "AU101"], "such as AU101=0.7"),
        (&["--unit", "AD76=1"], "--clip chew"),
        (&["--facs", "101+112"], "character 5"),
        (&["--expression", "feer"], "did you mean fear?"),
        (&["--expression", "fear=7"], "allowed 0 to 1"),
        (&["--clip", "yown"], "did you mean yawn?"),
        (&["--clip", "yawn", "--time", "-1"], "allowed 0 to 3600"),
    ] {
        let all: Vec<&str> = ["hash", "--breed", "pug"].iter().chain(words).copied().collect();
        refused(&all, 2, &[cure]);
    }
}

#[test]
fn what_is_overruled_is_not_told() {
    let told = done(&["hash", "--breed", "pug", "--level", "0", "--unit", "AU26=1", "--unit", "AU27=1"]).stderr;
    assert!(told.contains("AU26 goes from 1 to 0 because of AU27"), "{told}");
}

#[test]
fn lists_lack_units_expressions_or_clips() {
    let units = list("units");
    assert_eq!(units.len(), 42);
    let unit = units.iter().find(|u| u["id"] == "AU109_110").expect("the unit with a plus");
    assert_eq!((unit["label"].as_str(), unit["group"].as_str()), (Some("AU109+110"), Some("lower_face")));
    assert!(unit["rules"].as_array().is_some_and(|rules| !rules.is_empty()));
    assert_eq!(unit["landmarks"][0]["id"], "K19");
    assert_eq!(list("expressions").len(), 19);
    assert!(list("clips").iter().any(|c| c["id"] == "head_shake" && c["repeats"] == false));
    for what in ["units", "expressions", "clips"] {
        assert_eq!(done(&["list", what]).stdout.lines().count(), list(what).len(), "{what}");
    }
}

#[test]
fn a_film_has_other_frames_than_asked_for() {
    let folder = folder();
    let film = |words: &[&str], name: &str| {
        let out = folder.path().join(name);
        let common =
            ["render", "--breed", "pug", "--level", "1", "--hair", "off", "--size", "40x30", "--samples", "4", "-o"];
        let all: Vec<&str> = common.iter().copied().chain([text(&out)]).chain(words.iter().copied()).collect();
        done(&all);
    };
    film(&["--clip", "blink", "--frames", "2..5", "--fps", "20"], "f_%02d.png");
    assert_eq!(names_in(folder.path()), ["f_02.png", "f_03.png", "f_04.png"]);
    assert_eq!(png_size(&std::fs::read(folder.path().join("f_02.png")).expect("a frame")), (40, 30));
    // The frame of a film is the picture of that time, but for its camera.
    film(&["--clip", "blink", "--fps", "20"], "blink.gif");
    let bytes = std::fs::read(folder.path().join("blink.gif")).expect("a film");
    let mut decoder = gif::DecodeOptions::new().read_info(&bytes[..]).expect("a GIF");
    assert_eq!((decoder.width(), decoder.height()), (40, 30));
    let mut delays = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        delays.push(frame.delay);
    }
    assert_eq!(delays, [5; 6], "0.3 s at 20 a second");
}

#[test]
fn a_film_without_length_name_or_encoder_is_begun() {
    let film = |words: &[&str], cure: &str| {
        let all: Vec<&str> = ["render", "--breed", "pug"].iter().chain(words).copied().collect();
        refused(&all, 2, &[cure]);
    };
    film(&["-o", "a.gif"], "--frames A..B");
    film(&["--frames", "0..5", "-o", "a.png"], "%04d");
    film(&["--clip", "pant", "--time", "1", "-o", "a.gif"], "leave out --time");
    film(&["--frames", "5..5", "-o", "a.gif"], "such as 0..48");
}

#[test]
fn an_atlas_of_units_misses_one() {
    let folder = folder();
    let out = folder.path().join("units");
    let words =
        ["atlas", "--units", "--group", "eyes", "--group", "head", "--size", "40x40", "-o", text(&out), "--json"];
    let told: Value = serde_json::from_str(&done(&words).stdout).expect("an object");
    let files = told["files"].as_array().expect("an array");
    assert_eq!(files.len(), 12);
    assert_eq!(names_in(&out).len(), 12);
    assert!(names_in(&out).contains(&"AD61.png".to_owned()));
    refused(&["atlas", "--units", "--group", "tail", "-o", text(&out)], 2, &["upper-face"]);
    refused(&["atlas", "--units", "-o", "-"], 2, &["name a folder"]);
}
