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
    for command in [
        "view",
        "render",
        "sheet",
        "turntable",
        "atlas",
        "breed",
        "export",
        "hash",
        "measure",
        "landmarks",
        "list",
        "check",
        "uv",
        "bake",
        "subdivide",
        "bench",
        "similarity",
    ] {
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

#[test]
fn any_number_of_breeds_are_mixed() {
    let values = |blend: &[&str]| -> Vec<f64> {
        let mut args = vec!["landmarks", "--breed", "pug", "--level", "0", "--json"];
        blend.iter().for_each(|share| args.extend(["--blend", share]));
        let all: Vec<Value> = serde_json::from_str(&done(&args).stdout).unwrap();
        all.iter().flat_map(|l| l["position_mm"].as_array().unwrap()).map(|x| x.as_f64().unwrap()).collect()
    };
    let ids = ["beagle", "borzoi", "bulldog", "chihuahua", "dachshund", "german_shepherd", "labrador"];
    let share = |id: &str, weight: &str| format!("{id}={weight}");
    let eighths: Vec<String> = ids.iter().map(|id| share(id, "0.125")).collect();
    let eighths: Vec<&str> = eighths.iter().map(String::as_str).collect();
    let all = values(&eighths);
    let mut turned = eighths.clone();
    turned.reverse();
    let far = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(far(&all, &values(&turned)) < 0.01, "the order of shares does not count");
    assert!(far(&all, &values(&eighths[1..])) > 0.5, "what is left of 1 is the breed's own");
    // A hundred hundredths miss 1 by their roundings, and yet leave nothing of the pug.
    let hundredths = vec!["borzoi=0.01"; 100];
    let borzoi = done(&["hash", "--breed", "borzoi", "--level", "0"]).stdout;
    let mut args = vec!["hash", "--breed", "pug", "--level", "0"];
    hundredths.iter().for_each(|share| args.extend(["--blend", share]));
    assert_eq!(done(&args).stdout, borzoi);
}

// ---- breed ----

#[test]
fn a_litter_is_files_that_check_and_hash_accept_the_same_in_every_run() {
    let (first, second) = (folder(), folder());
    let litter = |folder: &TempDir, n: &str| {
        done(&["breed", "pug", "borzoi", "--litter", n, "--seed", "3", "-o", text(folder.path())]).stdout
    };
    let paths = litter(&first, "6");
    let names: Vec<String> = (1..=6).map(|k| format!("pug_x_borzoi_{k}.ron")).collect();
    assert_eq!(names_in(first.path()), names);
    let expected: String = names.iter().map(|name| format!("{}\n", first.path().join(name).display())).collect();
    assert_eq!(paths, expected);
    let mut check = vec!["check"];
    check.extend(paths.lines());
    done(&check);
    // The first two of a litter of six are a litter of two.
    litter(&second, "2");
    let bytes = |folder: &TempDir, name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(names[..2].iter().all(|name| bytes(&first, name) == bytes(&second, name)));
    assert_ne!(bytes(&first, &names[0]), bytes(&first, &names[1]));
    let hash = |breed: &str| done(&["hash", "--breed", breed, "--level", "0"]).stdout;
    assert_ne!(hash(paths.lines().next().unwrap()), hash("pug"));
}

#[test]
fn a_random_dog_keeps_what_is_locked_and_set() {
    let folder = folder();
    let (one, out) = (folder.path().join("one.ron"), text(folder.path()).to_owned());
    assert_eq!(done(&["breed", "--random", "--seed", "7", "-o", text(&one)]).stdout, format!("{}\n", one.display()));
    done(&["breed", "--random", "2", "--seed", "7", "-o", &out]);
    assert_eq!(names_in(folder.path()), ["one.ron", "random_7_1.ron", "random_7_2.ron"]);
    assert_eq!(std::fs::read(&one).unwrap(), std::fs::read(folder.path().join("random_7_1.ron")).unwrap());
    let on_stdout = done(&["breed", "--random", "--seed", "7", "-o", "-"]).stdout;
    assert_eq!(on_stdout, std::fs::read_to_string(&one).unwrap());

    let dogs = |more: &[&str]| -> Vec<Value> {
        let args = [&["breed", "--random", "3", "--seed", "1", "--json"], more].concat();
        serde_json::from_str(&done(&args).stdout).unwrap()
    };
    let free = dogs(&[]);
    assert!(free.iter().all(|d| d["output"].is_null() && d["values"]["ear_length_mm"].is_number()));
    let locked = dogs(&["--base", "pug", "--lock", "ears", "--lock", "stop_angle_deg", "--set", "facial_length_mm=40"]);
    for dog in &locked {
        let values = &dog["values"];
        assert_eq!(values["ear_length_mm"], 42.5);
        assert_eq!(values["stop_angle_deg"], 108.0);
        assert_eq!(values["facial_length_mm"], 40.0);
    }
    assert_ne!(locked[0]["values"]["cranial_length_mm"], locked[1]["values"]["cranial_length_mm"]);
    let args = ["breed", "pug", "borzoi", "--litter", "3", "--base", "beagle", "--lock", "nose", "--json"];
    let puppies: Vec<Value> = serde_json::from_str(&done(&args).stdout).unwrap();
    let beagle = std::fs::read_to_string(rig("breeds/beagle.ron")).unwrap();
    for puppy in &puppies {
        let width = puppy["values"]["nose_width_mm"].as_f64().unwrap();
        assert!(beagle.contains(&format!("\"nose_width_mm\": {width:?}")), "{width}");
    }
}

#[test]
fn breeding_that_makes_no_sense_is_refused_and_writes_nothing() {
    let folder = folder();
    let out = text(folder.path());
    let with = |args: &[&str], words: &[&str]| {
        refused(&[&["breed"], args, &["-o", out]].concat(), 2, words);
    };
    with(&[], &["two parents", "--random"]);
    with(&["pug", "--litter", "2"], &["two parents, not 1"]);
    with(&["pug", "pug", "pug", "--litter", "2"], &["two parents, not 3"]);
    with(&["pug", "borzoi"], &["--litter 6"]);
    with(&["pug", "borzzoi", "--litter", "2"], &["unknown breed 'borzzoi'", "did you mean borzoi?"]);
    with(&["pug", "borzoi", "--litter", "0"], &["1..=1000"]);
    with(&["pug", "borzoi", "--litter", "1000000"], &["1..=1000"]);
    with(&["--random", "0"], &["1..=1000"]);
    with(&["pug", "borzoi", "--litter", "2", "--random"], &["cannot be used with"]);
    with(&["--random", "--lock", "ears"], &["--base"]);
    with(&["--random", "--base", "pug", "--lock", "eers"], &["did you mean Ears", "Lips and jaw"]);
    with(&["--random", "--set", "ear_cup=9"], &["ear_cup is 9, allowed 0 to 0.9"]);
    with(&["--random", "--seed", "x"], &["--seed"]);
    refused(&["breed", "pug", "borzoi", "--litter", "2"], 2, &["--output"]);
    let file = folder.path().join("all.ron");
    refused(&["breed", "--random", "2", "-o", text(&file)], 2, &["2 dogs are 2 files"]);
    refused(&["breed", "--random", "-o", "-", "--json"], 2, &["-o -"]);
    let nowhere = folder.path().join("nowhere").join("dogs");
    refused(&["breed", "--random", "2", "-o", text(&nowhere)], 1, &["dogs: the folder cannot be made"]);
    assert!(names_in(folder.path()).is_empty());
    let plain = folder.path().join("plain");
    std::fs::write(&plain, "x").unwrap();
    refused(&["breed", "--random", "2", "-o", text(&plain)], 1, &["plain: is no folder"]);
    let new = folder.path().join("new");
    done(&["breed", "--random", "2", "-o", text(&new)]);
    assert_eq!(names_in(&new), ["random_0_1.ron", "random_0_2.ron"]);
}

// ---- landmarks ----

#[test]
fn landmarks_are_a_table_for_people_and_an_array_for_programs() {
    let all: Vec<Value> =
        serde_json::from_str(&done(&["landmarks", "--breed", "labrador", "--level", "2", "--json"]).stdout).unwrap();
    let table = done(&["landmarks", "--breed", "labrador", "--level", "2"]).stdout;
    assert_eq!(table.lines().count(), all.len());
    for (line, landmark) in table.lines().zip(&all) {
        let word = |key: &str| landmark[key].as_str().unwrap().to_owned();
        assert!(line.starts_with(&word("id")) && line.ends_with(&word("name")), "{line}");
        assert_eq!(word("layer"), if word("id").starts_with('S') { "bone" } else { "skin" });
        assert_eq!(landmark["position_mm"].as_array().unwrap().len(), 3);
        assert!(landmark["pixel"].is_null() && landmark["visible"].is_null());
    }
    let set = done(&["landmarks", "--breed", "labrador", "--level", "2", "--set", "facial_length_mm=60"]).stdout;
    assert_ne!(set, table);
    let args = ["landmarks", "--breed", "labrador", "--level", "2", "--whiskers", "--json"];
    let whiskers: serde_json::Value = serde_json::from_str(&done(&args).stdout).unwrap();
    let whiskers = whiskers.as_array().unwrap();
    assert!(whiskers.len() > 40 && whiskers.len().is_multiple_of(2));
    assert!(whiskers.iter().all(|w| w["length_mm"].as_f64().is_some_and(|mm| mm > 5.0)), "{whiskers:?}");
    assert_eq!(done(&args[..6]).stdout.lines().count(), whiskers.len());
    refused(&["landmarks", "--breed", "labrador", "--size", "10x10"], 2, &["--view"]);
    refused(&["landmarks", "--breed", "labrador", "--view", "behind"], 2, &["is no view"]);
    refused(&["landmarks"], 2, &["--breed"]);
}

#[test]
fn a_front_view_shows_the_nose_in_the_middle_and_not_the_occiput() {
    let args = ["landmarks", "--breed", "labrador", "--level", "2", "--view", "front", "--size", "400x300", "--json"];
    let all: Vec<Value> = serde_json::from_str(&done(&args).stdout).unwrap();
    let of = |id: &str, side: &str| all.iter().find(|l| l["id"] == id && l["side"] == side).unwrap();
    let pixel = |l: &Value| [0, 1].map(|i| l["pixel"][i].as_f64().unwrap());
    assert_eq!((&of("K01", "M")["visible"], &of("K25", "M")["visible"]), (&Value::Bool(true), &Value::Bool(false)));
    assert!((pixel(of("K01", "M"))[0] - 200.0).abs() < 0.02);
    for left in all.iter().filter(|l| l["side"] == "L") {
        let right = of(left["id"].as_str().unwrap(), "R");
        let ([a, b], [c, d]) = (pixel(left), pixel(right));
        assert!((a + c - 400.0).abs() < 0.05 && (b - d).abs() < 0.05, "{left} {right}");
        // The dog's left is on the right of its picture.
        assert!(a > c && left["visible"] == right["visible"], "{left} {right}");
    }
}

// ---- measure and layers ----

#[test]
fn a_measure_has_no_value_unit_or_rank() {
    let found: Value = serde_json::from_str(&done(&["measure", "--breed", "pug", "--json"]).stdout).unwrap();
    assert_eq!((&found["breed"], &found["class"]), (&Value::from("pug"), &Value::from("brachycephalic")));
    let list = found["measurements"].as_array().unwrap();
    assert!(list.len() >= 25);
    for m in list {
        // An undershot jaw stands before the upper one.
        assert!(m["value"].as_f64().is_some_and(|v| v > 0.0 || m["id"] == "overjet"), "{m}");
        assert!(m["percentile"].as_f64().is_some_and(|p| (0.0..=100.0).contains(&p)), "{m}");
        assert!(["bone", "skin"].contains(&m["on"].as_str().unwrap()), "{m}");
    }
    let of = |set: &str| {
        let found: Value =
            serde_json::from_str(&done(&["measure", "--breed", "labrador", "--set", set, "--json"]).stdout).unwrap();
        let list = found["measurements"].as_array().unwrap().clone();
        list.iter().find(|m| m["id"] == "zygomatic_width").unwrap()["value"].as_f64().unwrap()
    };
    assert!((of("zygomatic_width_mm=100") - 100.0).abs() < 0.1 && (of("zygomatic_width_mm=120") - 120.0).abs() < 0.1);
    let table = done(&["measure", "--breed", "borzoi"]).stdout;
    let measured = table.lines().filter(|l| l.contains("  bone: ") || l.contains("  skin: ")).count();
    assert!(table.starts_with("Borzoi: dolichocephalic") && measured == list.len(), "{table}");
    refused(&["measure"], 2, &["--breed"]);
}

#[test]
fn a_reference_is_told_without_its_status_source_or_deviation() {
    let found: Value = serde_json::from_str(&done(&["measure", "--breed", "wolf", "--json"]).stdout).unwrap();
    let list = found["measurements"].as_array().unwrap();
    let of = |id: &str| list.iter().find(|m| m["id"] == id).unwrap();
    let width = of("zygomatic_width");
    let reference = &width["references"][0];
    assert_eq!((&reference["status"], &reference["value"]), (&Value::from("measured"), &Value::from(142.5)));
    assert!(reference["source"].as_str().unwrap().contains("two skulls"));
    let off = width["value"].as_f64().unwrap() - 142.5;
    assert!((reference["deviation"].as_f64().unwrap() - off).abs() < 2e-3, "{width}");
    assert!((reference["deviation_percent"].as_f64().unwrap() - off / 1.425).abs() < 2e-3, "{width}");
    assert!(of("orbital_angle")["references"].as_array().unwrap().is_empty());
    assert_eq!(found["references"][0]["measure"], "body_mass");
    let table = done(&["measure", "--breed", "wolf"]).stdout;
    for word in ["off by ", "; measured: two skulls", "; computed: condylobasal", "; estimated: ", "body mass: 40 kg"] {
        assert!(table.contains(word), "{word}: {table}");
    }
    let mix = ["measure", "--breed", "wolf", "--blend", "pug=0.5"];
    assert!(!done(&mix).stdout.contains("off by"), "a mix is held against nothing");
    let breeds: Value = serde_json::from_str(&done(&["list", "breeds", "--json"]).stdout).unwrap();
    let pug = breeds.as_array().unwrap().iter().find(|b| b["id"] == "pug").unwrap();
    assert_eq!((&pug["fci_group"], &pug["reference_class"]), (&Value::from(9), &Value::from("brachycephalic")));
    assert!(pug["references"].as_array().unwrap().len() > 5);
}

#[test]
fn layers_that_are_none_are_drawn() {
    for (layers, word) in [("fur", "no layer `fur`"), ("skin=2", "skin=0 to skin=1"), ("bone=0.5", "only skin")] {
        refused(&["render", "--breed", "pug", "--layers", layers, "-o", "x.png"], 2, &[word]);
    }
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
        let coats: Vec<&str> = breed["coats"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        let end = if coats.is_empty() { label.to_owned() } else { format!("{label} ({})", coats.join(", ")) };
        assert!(lines.lines().any(|l| l.starts_with(id) && l.ends_with(&end)), "{id}");
    }
    let lines = done(&["list", "parameters"]).stdout;
    for parameter in parameters() {
        assert!(parameter["label"].is_string() && parameter["unit"].is_string() && parameter["default"].is_number());
        assert!(lines.contains(parameter["id"].as_str().unwrap()));
    }
}

#[test]
fn a_coat_is_put_on_that_the_breed_does_not_have() {
    let folder = folder();
    let glb = |args: &[&str]| {
        let out = folder.path().join("dog.glb");
        done(&[&["export", "--level", "1", "-o", text(&out)], args].concat());
        std::fs::read(&out).unwrap()
    };
    let yellow = glb(&["--breed", "labrador"]);
    assert!(yellow == glb(&["--breed", "labrador", "--coat", "yellow"]), "the first coat is another one");
    let black = glb(&["--breed", "labrador", "--coat", "black"]);
    assert!(yellow != black, "the coat is not seen");
    assert!(black == glb(&["--breed", "labrador:black"]), "two ways to a coat differ");
    let names = ["labrador has no coat 'blak' (did you mean black?)", "yellow, black, chocolate"];
    refused(&["hash", "--breed", "labrador", "--coat", "blak"], 2, &names);
    refused(&["hash", "--breed", "labrador:blak"], 2, &names);
    refused(&["hash", "--breed", "rottweiler", "--coat", "red"], 2, &["rottweiler has no coat 'red'; it has only one"]);
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
    let broken = changed(&folder, "version: 2", "version: 9");
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
fn a_sheet_has_not_a_picture_for_each_dress() {
    let folder = folder();
    let path = folder.path().join("gallery.png");
    let sheet = ["sheet", "--breeds", "pug", "--views", "side", "--level", "1", "--hair", "2000", "-o", text(&path)];
    let size = |dress: &str| {
        done(&[&sheet[..], &["--dress", dress]].concat());
        png_size(&std::fs::read(&path).unwrap())
    };
    let (one, all) = (size("coat"), size("clay,skin,coat"));
    assert_eq!(all, (3 * one.0, one.1));
    refused(&["sheet", "--dress", "cloth", "-o", text(&path)], 2, &["clay", "skin", "coat"]);
}

#[test]
fn an_atlas_has_not_a_strip_for_each_measure_of_its_groups() {
    let folder = folder();
    let path = folder.path().join("atlas.png");
    let small = ["atlas", "--size", "24x30", "--group", "neck", "--json", "-o", text(&path)];
    let facts: Value = serde_json::from_str(&done(&small).stdout).unwrap();
    let neck: Vec<Value> = parameters().into_iter().filter(|p| p["group"] == "Neck").map(|p| p["id"].clone()).collect();
    let drawn = facts["parameters"].as_array().unwrap();
    assert_eq!(drawn.iter().map(|p| p["id"].clone()).collect::<Vec<_>>(), neck);
    for parameter in drawn {
        assert!(parameter["change"].as_f64().unwrap() > 2.0, "nothing is seen of {parameter}");
    }
    let (width, height) = png_size(&std::fs::read(&path).unwrap());
    assert_eq!((&facts["files"][0]["width"], &facts["files"][0]["height"]), (&width.into(), &height.into()));
    assert!(width >= 3 * 3 * 24 && height > 30);

    let split = ["atlas", "--size", "16x16", "--split", "--group", "Neck", "--group", "nose", "--view", "side"];
    let run = done(&[&split[..], &["--breed", "pug", "--columns", "1", "-o", text(&path)]].concat());
    assert!(run.stderr.contains("atlas_nose.png") && run.stderr.contains("atlas_neck.png"), "{}", run.stderr);
    assert_eq!(names_in(folder.path()), ["atlas.png", "atlas_neck.png", "atlas_nose.png"]);

    refused(&["atlas", "--split", "-o", "-"], 2, &["--split writes several files"]);
    refused(
        &["atlas", "--group", "eers", "-o", "a.png"],
        2,
        &["unknown group 'eers'", "did you mean ears?", "lips-and-jaw"],
    );
    refused(&["atlas", "--columns", "0", "-o", "a.png"], 2, &["--columns"]);
}

#[test]
fn lines_are_not_drawn_over_a_sheet() {
    let folder = folder();
    let draw = |name: &str, lines: &[&str]| {
        let path = folder.path().join(name);
        let sheet =
            ["sheet", "--breeds", "pug", "--views", "side", "--level", "1", "--size", "80x90", "-o", text(&path)];
        done(&[&sheet[..], lines].concat());
        std::fs::read(&path).unwrap()
    };
    let [plain, control, refined] =
        [draw("a.png", &[]), draw("b.png", &["--wireframe"]), draw("c.png", &["--wireframe=refined"])];
    assert_eq!(png_size(&plain), png_size(&control));
    assert!(plain != control && control != refined && plain != refined);
    refused(&["sheet", "--wireframe=thin", "-o", "a.png"], 2, &["control", "refined"]);
}

#[test]
fn presets_grounds_samples_and_close_ups_change_nothing() {
    let folder = folder();
    let path = folder.path().join("a.png");
    let draw = |options: &[&str]| {
        let common = ["render", "--breed", "pug", "--level", "1", "--size", "48x48", "-o", text(&path)];
        done(&[&common[..], options].concat());
        std::fs::read(&path).unwrap()
    };
    let words: [&[&str]; 6] = [
        &["--hair", "low"],
        &["--preset", "silhouette"],
        &["--preset", "silhouette", "--hair", "low"],
        &["--hair", "low", "--background", "transparent"],
        &["--hair", "low", "--samples", "4"],
        &["--hair", "low", "--at", "K29R", "--zoom", "6"],
    ];
    let pictures = words.map(draw);
    for (i, one) in pictures.iter().enumerate() {
        assert!(pictures[..i].iter().all(|other| other != one), "{:?} is like another", words[i]);
    }
    assert!(
        draw(&["--hair", "10000", "--preset", "studio", "--background", "gradient", "--samples", "16"]) == pictures[0]
    );
    refused(&["render", "--breed", "pug", "--at", "K99", "-o", text(&path)], 2, &["no landmark 'K99'", "such as K29"]);
}

#[test]
fn a_word_about_the_coat_of_today_changes_nothing_or_is_not_known_to_a_command() {
    let folder = folder();
    let path = folder.path().join("a.png");
    let draw = |options: &[&str]| {
        let common =
            ["render", "--breed", "pug", "--level", "1", "--size", "48x48", "--hair", "3000", "-o", text(&path)];
        done(&[&common[..], options].concat());
        std::fs::read(&path).unwrap()
    };
    let words: [&[&str]; 6] = [
        &[],
        &["--fur-length", "2"],
        &["--fur-density", "0.2"],
        &["--clipped", "1"],
        &["--wet", "1"],
        &["--grey", "0.8"],
    ];
    let pictures = words.map(draw);
    for (i, one) in pictures.iter().enumerate() {
        assert!(pictures[..i].iter().all(|other| other != one), "{:?} is like another", words[i]);
    }
    for command in ["render", "sheet", "atlas", "view"] {
        let help = done(&[command, "--help"]).stdout;
        assert!(words.iter().flat_map(|w| w.first()).all(|word| help.contains(word)), "{command}");
        assert!(help.contains("--hair"), "{command}");
    }
    refused(&["sheet", "--wet", "2", "-o", "a.png"], 2, &["0 to 1"]);
    refused(&["view", "--fur-length", "4"], 2, &["0 to 3"]);
}

#[test]
fn what_a_picture_costs_is_not_told_by_pass_and_level_of_hair() {
    let told = done(&["bench", "--passes", "--level", "0", "--size", "32x24", "--breed", "pug", "--draft", "--json"]);
    let told: Value = serde_json::from_str(&told.stdout).unwrap();
    let levels = told["levels"].as_array().unwrap();
    let names: Vec<&str> = levels.iter().map(|l| l["hair"].as_str().unwrap()).collect();
    assert_eq!(names, ["off", "low", "medium", "high"]);
    for level in levels {
        assert_eq!(level["ms"].as_object().unwrap().len(), 5);
        assert!(level["picture_ms"].as_f64().unwrap() > 0.0);
    }
    refused(&["bench", "--passes", "--normals"], 2, &["cannot be used with"]);
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
    with("--background", "transparant", &["did you mean transparent?"]);
    with("--preset", "sepia", &["studio, daylight, clay, plate, x-ray, silhouette"]);
    with("--samples", "8", &["say 4 (fast), 16, 36 or 64"]);
    with("--zoom", "0", &["allowed 1"]);
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

// ---- textures and turns ----

#[test]
fn a_texture_is_not_in_the_file_or_has_a_size_that_nobody_asked_for() {
    let folder = folder();
    let path = folder.path().join("pug.glb");
    let target = path.to_str().unwrap();
    let words = ["export", "--breed", "pug", "--level", "1", "--textures", "256", "-o", target, "--json"];
    let facts: Value = serde_json::from_str(&done(&words).stdout).unwrap();
    assert_eq!(facts["textures"], 256);
    let (document, ..) = gltf::import(&path).unwrap();
    assert_eq!(document.images().count(), 3);
    for size in ["255", "1000", "8192", "many"] {
        refused(
            &["export", "--breed", "pug", "--textures", size, "-o", target],
            2,
            &["take 256, 512, 1024, 2048 or 4096"],
        );
    }
}

#[test]
fn a_head_that_shall_move_elsewhere_stands_still_or_does_what_nobody_asked_for() {
    let folder = folder();
    let path = folder.path().join("pug.glb");
    let target = path.to_str().unwrap();
    let export = |words: &[&'static str]| {
        let all = ["export", "--breed", "pug", "--level", "1", "-o", target, "--json"];
        let all: Vec<&str> = all.into_iter().chain(words.iter().copied()).collect();
        let facts: Value = serde_json::from_str(&done(&all).stdout).unwrap();
        let (document, ..) = gltf::import(&path).unwrap();
        assert_eq!(facts["animations"], document.animations().count());
        assert_eq!(facts["bytes"], std::fs::metadata(&path).unwrap().len());
        document
    };
    let moving = export(&["--units", "AU26,EAD103L", "--clips", "blink,yawning", "--textures", "256"]);
    let names: Vec<&str> = moving.animations().filter_map(|a| a.name()).collect();
    assert_eq!(names, ["AU26_jawDrop", "EAD103_earsFlattener_L", "yawning", "blink"]);
    let still = export(&["--units", "none", "--clips", "none"]);
    assert_eq!((still.skins().count(), still.animations().count()), (0, 0));
    let refuse = |words: &[&'static str], hints: &[&str]| {
        let all: Vec<&str> =
            ["export", "--breed", "pug", "-o", target].into_iter().chain(words.iter().copied()).collect();
        refused(&all, 2, hints);
    };
    refuse(&["--units", "AU102"], &["AU102", "AU101"]);
    refuse(&["--clips", "yaun"], &["yaun", "yawn"]);
    refuse(&["--units", "AD50"], &["behaviour over time", "bark"]);
    refuse(&["--units", "AU26", "--unit", "AU26=1"], &["at rest"]);
}

#[test]
fn a_turn_has_other_pictures_than_its_frames() {
    let folder = folder();
    let pattern = folder.path().join("turn_%02d.png");
    let target = pattern.to_str().unwrap();
    let words =
        ["turntable", "--breed", "pug", "--level", "1", "--hair", "off", "--size", "48x32", "--frames", "3", "--json"];
    let turn = |target| [&words[..], &["-o", target]].concat();
    let facts: Value = serde_json::from_str(&done(&turn(target)).stdout).unwrap();
    assert_eq!(facts["frames"], 3);
    let frames: Vec<Vec<u8>> =
        (0..3).map(|k| std::fs::read(folder.path().join(format!("turn_{k:02}.png"))).unwrap()).collect();
    assert!(frames.iter().all(|png| png_size(png) == (48, 32)));
    assert!(frames[0] != frames[1] && frames[1] != frames[2] && frames[0] != frames[2]);
    assert_eq!(names_in(folder.path()).len(), 3);
    refused(&turn("turn.png"), 2, &["as in turn_%04d.png"]);
}
