//! The built program, driven as a script would: exit codes, what goes to stdout and what to stderr, what stays untouched.
#![cfg(feature = "graphics")]

#[path = "support/program.rs"]
mod program;

use program::{command, done, finished, folder, londra, names_in, output, png_size, refused, text};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use tempfile::TempDir;

fn rig(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("rigs").join(name)
}

/// A copy of a shipped breed with one text replaced.
fn changed(folder: &TempDir, from: &str, to: &str) -> PathBuf {
    let whole = std::fs::read_to_string(rig("breeds/pug.ron")).unwrap();
    assert!(whole.contains(from), "the pug's file has no {from:?}");
    let path = folder.path().join("changed.ron");
    std::fs::write(&path, whole.replacen(from, to, 1)).unwrap();
    path
}

fn parameters() -> Vec<Value> {
    serde_json::from_str(&done(&["list", "parameters", "--json"]).stdout).unwrap()
}

/// `ID=VALUE` with a measure's value that is some way into its range.
fn a_setting(part: f64) -> String {
    let first = &parameters()[0];
    let (min, max) = (first["min"].as_f64().unwrap(), first["max"].as_f64().unwrap());
    format!("{}={}", first["id"].as_str().unwrap(), min + (max - min) * part)
}

// ---- help ----

#[test]
fn help_and_version_go_to_stdout() {
    assert_eq!(done(&["--version"]).stdout, format!("londra {}\n", env!("CARGO_PKG_VERSION")));
    let help = done(&["--help"]);
    assert_eq!(help.stderr, "");
    for command in
        ["view", "render", "sheet", "export", "hash", "list", "check", "bake", "subdivide", "bench", "similarity"]
    {
        assert!(help.stdout.contains(command));
        let own = done(&[command, "--help"]);
        assert!(own.stdout.contains(&format!("londra {command}")), "{command} shows an example");
    }
}

#[test]
fn unknown_words_are_wrong_use_and_answered_with_the_nearest() {
    refused(&["rendr"], 2, &["render"]);
    refused(&["hash", "--bred", "pug"], 2, &["--breed"]);
    refused(&["hash"], 2, &["--breed"]);
    refused(&["list", "breads"], 2, &["breeds"]);
    refused(
        &["hash", "--breed", "labardor"],
        2,
        &["unknown breed 'labardor'", "did you mean labrador?", "londra list breeds"],
    );
    refused(&["hash", "--breed", "velociraptor"], 2, &["unknown breed 'velociraptor'"]);
    let id = parameters()[0]["id"].as_str().unwrap().to_owned();
    let slip = format!("{}=1", id.replacen('a', "aa", 1));
    refused(&["hash", "--breed", "pug", "--set", &slip], 2, &["unknown parameter", &format!("did you mean {id}")]);
}

// ---- hash ----

#[test]
fn hash_prints_a_line_per_stage_the_same_for_any_number_of_threads() {
    let one = done(&["hash", "--breed", "pug", "--level", "2"]).stdout;
    let stages: Vec<(&str, &str)> = one.lines().map(|l| l.split_once(' ').unwrap()).collect();
    assert_eq!(
        stages.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
        ["control", "positions", "normals", "indices"]
    );
    assert!(stages.iter().all(|(_, hash)| hash.len() == 16 && hash.chars().all(|c| c.is_ascii_hexdigit())));
    for threads in ["1", "2", "8"] {
        assert_eq!(done(&["hash", "--breed", "pug", "--level", "2", "--threads", threads]).stdout, one);
    }
    let json: Value =
        serde_json::from_str(&done(&["hash", "--breed", "pug", "--level", "2", "--json"]).stdout).unwrap();
    assert!(stages.iter().all(|(name, hash)| json[name] == *hash));
}

#[test]
fn what_is_set_and_mixed_changes_the_hash_and_the_same_values_give_the_same() {
    let hash = |more: &[&str]| done(&[&["hash", "--breed", "pug", "--level", "0"], more].concat()).stdout;
    let plain = hash(&[]);
    let (low, high) = (a_setting(0.25), a_setting(0.75));
    assert_ne!(hash(&["--set", &low]), plain);
    assert_eq!(hash(&["--set", &low, "--set", &high]), hash(&["--set", &high]), "the last one holds");
    assert_ne!(hash(&["--blend", "borzoi=0.5"]), plain);
    assert_eq!(hash(&["--blend", "borzoi=0"]), plain);
    assert_eq!(hash(&["--blend", "pug=0.4"]), plain);
    assert_eq!(hash(&["--blend", "borzoi=1"]), done(&["hash", "--breed", "borzoi", "--level", "0"]).stdout);
    assert_eq!(hash(&[]), done(&["hash", "--breed", text(&rig("breeds/pug.ron")), "--level", "0"]).stdout);
}

#[test]
fn values_that_make_no_sense_are_wrong_use() {
    let with = |option: &str, value: &str, words: &[&str]| {
        refused(&["hash", "--breed", "pug", option, value], 2, words);
    };
    let first = &parameters()[0];
    let (id, max) = (first["id"].as_str().unwrap(), first["max"].as_f64().unwrap());
    with("--set", &format!("{id}={}", max + 1.0), &[id, "allowed", &format!("to {max}")]);
    for value in ["nan", "inf", "1e999", "x", ""] {
        with("--set", &format!("{id}={value}"), &["is no number"]);
    }
    with("--set", id, &["ID=VALUE"]);
    with("--blend", "borzoi", &["NAME=WEIGHT"]);
    with("--blend", "borzoi=1.5", &["allowed 0 to 1"]);
    with("--blend", "borzoi=-0.5", &["allowed 0 to 1"]);
    with("--blend", "borzzoi=0.5", &["did you mean borzoi?"]);
    with("--level", "6", &["6"]);
    with("--level", "-1", &[]);
    with("--threads", "0", &[]);
    let run = londra(&["hash", "--breed", "pug", "--blend", "borzoi=0.6", "--blend", "beagle=0.6"]);
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert!(run.stderr.contains("sum to 1.2"), "{}", run.stderr);
}

// ---- list ----

#[test]
fn lists_are_for_people_and_as_json_for_programs() {
    let breeds: Vec<Value> = serde_json::from_str(&done(&["list", "breeds", "--json"]).stdout).unwrap();
    let ids: Vec<&str> = breeds.iter().map(|b| b["id"].as_str().unwrap()).collect();
    assert!(ids.contains(&"pug") && ids.is_sorted());
    let lines = done(&["list", "breeds"]).stdout;
    for breed in &breeds {
        let (id, label) = (breed["id"].as_str().unwrap(), breed["label"].as_str().unwrap());
        assert!(lines.lines().any(|l| l.starts_with(id) && l.ends_with(label)));
    }
    let lines = done(&["list", "parameters"]).stdout;
    for parameter in parameters() {
        assert!(parameter["label"].is_string() && parameter["unit"].is_string() && parameter["default"].is_number());
        assert!(lines.contains(parameter["id"].as_str().unwrap()));
    }
}

// ---- check and broken files ----

#[test]
fn check_finds_every_mistake_at_its_place_and_says_so_on_stdout() {
    let folder = folder();
    let path = changed(&folder, "label:", "lable: \"x\", colour: 3, label:");
    let run = londra(&["check", text(&path)]);
    assert_eq!(run.code, 1);
    let lines: Vec<&str> = run.stdout.lines().collect();
    assert_eq!(lines.len(), 2, "{}", run.stdout);
    for (line, word) in lines.iter().zip(["unknown field lable (did you mean label?)", "unknown field colour"]) {
        let place = line.strip_prefix(&format!("{}:", text(&path))).unwrap();
        let mut parts = place.splitn(3, ':');
        assert!(parts.next().unwrap().parse::<u32>().unwrap() > 0);
        assert!(parts.next().unwrap().parse::<u32>().unwrap() > 0);
        assert!(parts.next().unwrap().trim().starts_with(word), "{line}");
    }
    let json = londra(&["check", "--json", text(&path)]);
    let found: Vec<Value> = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!((json.code, found.len()), (1, 2));
    assert!(found[0]["line"].is_number() && found[0]["column"].is_number() && found[0]["path"] == text(&path));
}

#[test]
fn check_is_content_with_what_is_shipped() {
    let breeds = std::fs::read_dir(rig("breeds")).unwrap().map(|e| e.unwrap().path());
    let paths: Vec<PathBuf> = breeds.chain([rig("anatomy.ron")]).collect();
    let mut args = vec!["check"];
    args.extend(paths.iter().map(|p| text(p)));
    let run = done(&args);
    assert_eq!(run.stdout, "");
    assert_eq!(done(&["check", "--json", text(&paths[0])]).stdout, "[]\n");
}

#[test]
fn a_file_that_cannot_be_used_fails_with_its_name_and_place() {
    let folder = folder();
    let missing = folder.path().join("no.ron");
    refused(&["hash", "--breed", text(&missing)], 1, &["no.ron: no such file"]);
    refused(&["check", text(&missing)], 1, &["no.ron: no such file"]);
    let as_folder = folder.path().join("dir.ron");
    std::fs::create_dir(&as_folder).unwrap();
    refused(&["hash", "--breed", text(&as_folder)], 1, &["is a folder"]);
    let binary = folder.path().join("binary.ron");
    std::fs::write(&binary, [0xff, 0xfe, 0]).unwrap();
    refused(&["hash", "--breed", text(&binary)], 1, &["is not UTF-8 text"]);
    let syntax = changed(&folder, "anatomy:", "anatomy");
    let run = refused(&["export", "--breed", text(&syntax), "-o", "x.glb"], 1, &["changed.ron:", "syntax error"]);
    assert!(run.stderr.starts_with(text(&syntax)), "{}", run.stderr);
    refused(&["hash", "--breed", "pug", "--blend", &format!("{}=0.5", text(&syntax))], 1, &["syntax error"]);
}

#[test]
fn a_folder_of_rigs_overrides_what_is_built_in() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("breeds")).unwrap();
    let borzoi = std::fs::read_to_string(rig("breeds/borzoi.ron")).unwrap();
    std::fs::write(folder.path().join("breeds").join("pug.ron"), &borzoi).unwrap();
    std::fs::write(folder.path().join("breeds").join("zottel.ron"), &borzoi).unwrap();
    let with = |args: &[&str]| finished(command(args).env("LONDRA_RIGS", folder.path()).output().unwrap());
    let expected = done(&["hash", "--breed", "borzoi", "--level", "0"]).stdout;
    assert_eq!(with(&["hash", "--breed", "pug", "--level", "0"]).stdout, expected);
    assert_eq!(with(&["hash", "--breed", "zottel", "--level", "0"]).stdout, expected);
    assert!(with(&["list", "breeds"]).stdout.contains("zottel"));
    std::fs::write(folder.path().join("anatomy.ron"), "Anatomy(version: 1, parameters: [])").unwrap();
    let broken = with(&["list", "parameters"]);
    assert_eq!(broken.code, 1);
    assert!(broken.stderr.contains("anatomy.ron:1:"), "{}", broken.stderr);
    let nowhere = finished(command(&["list", "breeds"]).env("LONDRA_RIGS", "/nowhere/at/all").output().unwrap());
    assert_eq!(nowhere.code, 1);
    assert!(nowhere.stderr.contains("is no folder of breeds"), "{}", nowhere.stderr);
}

// ---- export ----

#[test]
fn export_writes_the_same_glb_to_a_file_and_to_stdout() {
    let folder = folder();
    let path = folder.path().join("pug.glb");
    let run = done(&["export", "--breed", "pug", "--level", "1", "-o", text(&path)]);
    assert_eq!(run.stdout, "", "the result is the file");
    assert!(run.stderr.contains("pug.glb"));
    let bytes = std::fs::read(&path).unwrap();
    assert!(bytes.starts_with(b"glTF"));
    let piped = output(&["export", "--breed", "pug", "--level", "1", "-o", "-"]);
    assert_eq!((piped.status.code(), piped.stdout == bytes), (Some(0), true));
    assert_eq!(piped.stderr, b"");
    assert_eq!(names_in(folder.path()), ["pug.glb"], "nothing is left behind");

    let json = done(&["export", "--breed", "pug", "--level", "1", "-o", text(&path), "--json"]);
    let facts: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!(facts["bytes"], bytes.len());
    assert_eq!(facts["output"], text(&path));
    refused(&["export", "--breed", "pug", "-o", "-", "--json"], 2, &["--json"]);
}

#[test]
fn a_target_that_cannot_be_written_is_left_as_it_was() {
    let folder = folder();
    let path = folder.path().join("pug.glb");
    std::fs::write(&path, "old").unwrap();
    let mut permissions = std::fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).unwrap();
    let export = |target: &Path, words: &[&str]| {
        refused(&["export", "--breed", "pug", "--level", "0", "-o", text(target)], 1, words);
    };
    export(&path, &["pug.glb", "read-only"]);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "old");
    export(&folder.path().join("no").join("pug.glb"), &["the folder", "does not exist"]);
    export(folder.path(), &["is a folder"]);
    let good = folder.path().join("good.glb");
    std::fs::write(&good, "old").unwrap();
    let broken = changed(&folder, "version: 1", "version: 9");
    refused(&["export", "--breed", text(&broken), "-o", text(&good)], 1, &["version is 9"]);
    assert_eq!(std::fs::read_to_string(&good).unwrap(), "old", "an error keeps the old file");
    assert_eq!(names_in(folder.path()), ["changed.ron", "good.glb", "pug.glb"]);
}

#[cfg(unix)]
#[test]
fn a_reader_who_goes_away_is_no_panic() {
    let mut child = command(&["export", "--breed", "pug", "--level", "3", "-o", "-"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let run = finished(child.wait_with_output().unwrap());
    assert_eq!((run.code, run.stderr.as_str()), (0, ""));
}

// ---- pictures ----

#[test]
fn render_draws_a_png_of_the_size_asked_for() {
    let folder = folder();
    let path = folder.path().join("pug.png");
    let common = ["render", "--breed", "pug", "--level", "1", "--size", "96x64"];
    let run = done(&[&common[..], &["-o", text(&path)]].concat());
    assert_eq!(run.stdout, "");
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(png_size(&bytes), (96, 64));
    let piped = output(&[&common[..], &["-o", "-"]].concat());
    assert_eq!(piped.stdout, bytes);
    let other =
        ["--view", "-30,10", "--pitch", "-5", "--lens", "ortho", "--background", "none", "--json", "-o", text(&path)];
    let json = done(&[&common[..], &other[..]].concat());
    let facts: Value = serde_json::from_str(&json.stdout).unwrap();
    assert_eq!((&facts["width"], &facts["height"]), (&96.into(), &64.into()));
    assert_ne!(std::fs::read(&path).unwrap(), bytes);
}

#[test]
fn sheet_draws_the_breeds_and_views_asked_for() {
    let folder = folder();
    let path = folder.path().join("sheet.png");
    let common =
        ["sheet", "--breeds", "pug,borzoi", "--views", "front,-30,10", "--level", "1", "-o", text(&path), "--json"];
    let facts: Value = serde_json::from_str(&done(&[&common[..], &["--size", "200x150"]].concat()).stdout).unwrap();
    assert_eq!(facts["breeds"], serde_json::json!(["pug", "borzoi"]));
    assert_eq!(facts["views"].as_array().unwrap().len(), 2);
    assert_eq!(png_size(&std::fs::read(&path).unwrap()), (200, 150));
    refused(&["sheet", "--breeds", "pug,pgu", "-o", text(&path)], 2, &["unknown breed 'pgu'", "did you mean pug?"]);
}

#[test]
fn words_about_pictures_that_make_no_sense_are_wrong_use() {
    let with = |option: &str, value: &str, words: &[&str]| {
        refused(&["render", "--breed", "pug", option, value, "-o", "x.png"], 2, words);
    };
    with("--view", "behind", &["front, side, three-quarter, top, portrait"]);
    with("--size", "0x10", &["WIDTHxHEIGHT"]);
    with("--size", "10", &["WIDTHxHEIGHT"]);
    with("--background", "whte", &["did you mean white?"]);
    with("--lens", "0", &["focal length"]);
    with("--pitch", "400", &["allowed -90 to 90"]);
    refused(&["render", "--breed", "pug"], 2, &["--output"]);
}

// ---- machines without a display or an adapter ----

#[test]
fn without_a_display_the_window_is_refused_with_one_sentence() {
    for args in [&[][..], &["view"][..], &["view", text(&rig("breeds/pug.ron"))][..]] {
        let run = refused(args, 3, &["no display", "render, sheet, export, hash, list and check work without"]);
        assert_eq!(run.stderr.trim().lines().count(), 1, "{}", run.stderr);
    }
    refused(&["view", "/nowhere/pug.ron"], 1, &["no such file"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_display_that_does_not_answer_is_as_good_as_none() {
    for (variable, value) in [("DISPLAY", ":7777"), ("WAYLAND_DISPLAY", "wayland-7777")] {
        let run = finished(command(&["view"]).env(variable, value).output().unwrap());
        assert_eq!((run.code, run.stdout.as_str()), (3, ""), "{}", run.stderr);
        assert!(run.stderr.contains("no display"), "{}", run.stderr);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn without_an_adapter_pictures_are_refused_with_one_sentence() {
    let folder = folder();
    let path = folder.path().join("pug.png");
    for command_name in ["render", "sheet"] {
        let run = command(&[command_name, "--breed", "pug", "--level", "0", "-o", text(&path)])
            .env("VK_DRIVER_FILES", "/nonexistent")
            .env("VK_ICD_FILENAMES", "/nonexistent")
            .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent")
            .output()
            .unwrap();
        let run = finished(run);
        assert_eq!((run.code, run.stdout.as_str()), (3, ""), "{}", run.stderr);
        let sentence = run.stderr.lines().find(|l| l.starts_with("londra: no graphics adapter"));
        assert!(sentence.is_some_and(|s| s.contains("export, hash, list and check work without")), "{}", run.stderr);
    }
    assert!(names_in(folder.path()).is_empty());
}

// ---- baked assets ----

#[test]
fn bake_proves_the_assets_and_rebuilds_changed_ones() {
    let root = env!("CARGO_MANIFEST_DIR");
    done(&["bake", "--check", "--root", root]);
    let folder = folder();
    refused(&["bake", "--check", "--root", text(folder.path())], 1, &["assets"]);
    std::fs::create_dir(folder.path().join("assets")).unwrap();
    refused(&["bake", "--check", "--root", text(folder.path())], 1, &["head.ron"]);
    assert!(names_in(&folder.path().join("assets")).is_empty(), "--check changes nothing");
    done(&["bake", "--root", text(folder.path())]);
    let baked = std::fs::read(folder.path().join("assets").join("head.ron")).unwrap();
    assert!(baked == std::fs::read(Path::new(root).join("assets").join("head.ron")).unwrap());
    done(&["bake", "--check", "--root", text(folder.path())]);
}
