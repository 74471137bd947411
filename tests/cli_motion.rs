//! The built program moves a head: units, notation, expressions, clips, films, lists.
#![cfg(feature = "graphics")]

#[path = "support/program.rs"]
mod program;

use program::{command, done, finished, folder, names_in, png_size, refused, text};
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

/// Where ffmpeg is installed the film is read back, where it is not one is told how to get it, and either way without one.
#[test]
fn an_mp4_cannot_be_played_or_its_lack_of_an_encoder_is_not_told() {
    let folder = folder();
    let out = folder.path().join("blink.mp4");
    let words = ["render", "--breed", "pug", "--level", "1", "--hair", "off", "--size", "41x31", "--samples", "4"];
    let words: Vec<&str> = words.into_iter().chain(["--clip", "blink", "--fps", "20", "-o", text(&out)]).collect();
    let told = finished(command(&words).env("PATH", folder.path()).output().expect("it runs"));
    assert_eq!(told.code, 1, "{}", told.stderr);
    assert!(told.stderr.contains("ffmpeg, which is not installed"), "{}", told.stderr);
    assert!(!out.exists());
    let Ok(version) = std::process::Command::new("ffmpeg").arg("-version").output() else { return };
    assert!(version.status.success());
    done(&words);
    let read = std::process::Command::new("ffprobe")
        .args(["-v", "error", "-count_frames", "-select_streams", "v:0", "-of", "csv=p=0", "-show_entries"])
        .args(["stream=codec_name,width,height,pix_fmt,color_space,avg_frame_rate,nb_read_frames", text(&out)])
        .output();
    let Ok(read) = read else { return };
    let read = String::from_utf8_lossy(&read.stdout).trim().to_owned();
    // Odd sides get a row and a column more, as players take even ones alone.
    assert_eq!(read, "h264,42,32,yuv420p,bt709,20/1,6");
    let broken = folder.path().join("no such folder").join("blink.mp4");
    let words: Vec<&str> = words.iter().map(|w| if *w == text(&out) { text(&broken) } else { w }).collect();
    refused(&words, 1, &["ffmpeg could not make the film"]);
}

#[test]
fn a_landmark_stays_when_the_jaw_opens_and_the_head_turns() {
    let places = |words: &[&str]| -> Vec<(String, Vec<f64>)> {
        let all: Vec<&str> = ["landmarks", "--breed", "beagle", "--level", "1", "--json"]
            .into_iter()
            .chain(words.iter().copied())
            .collect();
        let rows: Vec<Value> = serde_json::from_str(&done(&all).stdout).expect("an array");
        let place =
            |row: &Value| row["position_mm"].as_array().expect("three").iter().filter_map(Value::as_f64).collect();
        rows.iter().map(|row| (format!("{}{}", row["id"].as_str().expect("an id"), row["side"]), place(row))).collect()
    };
    let moved = |words: &[&str], id: &str| {
        let (rest, now) = (places(&[]), places(words));
        let of =
            |list: &[(String, Vec<f64>)]| list.iter().find(|(own, _)| own.starts_with(id)).expect("there").1.clone();
        of(&rest).iter().zip(of(&now)).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    };
    let open = ["--unit", "AU27=1"];
    assert!(moved(&open, "S32") > 60.0 && moved(&open, "K13") > 60.0, "the chin, on bone and on skin");
    assert_eq!(moved(&open, "S01"), 0.0, "the upper jaw");
    let turned = ["--unit", "AD51=1"];
    assert!(moved(&turned, "S01") > 60.0 && moved(&turned, "K01") > 60.0);
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
