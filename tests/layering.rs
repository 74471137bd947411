//! Modules are layers that may only look down: this reads the sources and names every arrow that may not be.
//!
//! It reads text, not syntax: comments and unit tests are cut out, then every `crate::name` counts as an arrow.

use std::fs;
use std::path::{Path, PathBuf};

/// Each module, and the modules it may use beside itself.
const ARROWS: [(&str, &[&str]); 15] = [
    ("math", &[]),
    ("mesh", &["math"]),
    ("subdiv", &["mesh", "math"]),
    ("anatomy", &["math"]),
    ("io", &["mesh", "math"]),
    ("motion", &["anatomy", "math"]),
    ("rig", &["mesh", "motion", "anatomy", "math"]),
    ("coat", &["rig", "subdiv", "anatomy", "mesh", "math"]),
    ("frame", &["coat", "rig", "subdiv", "motion", "anatomy", "mesh", "math"]),
    ("author", &["rig", "anatomy", "subdiv", "mesh", "math"]),
    ("measure", &["frame", "rig", "subdiv", "motion", "anatomy", "mesh", "math"]),
    ("export", &["frame", "rig", "subdiv", "motion", "anatomy", "mesh", "math"]),
    ("render", &["frame", "coat", "subdiv", "anatomy", "math"]),
    ("app", &EVERYTHING),
    ("cli", &EVERYTHING),
];

const EVERYTHING: [&str; 15] = [
    "math", "mesh", "subdiv", "anatomy", "io", "motion", "rig", "coat", "frame", "author", "measure", "export",
    "render", "app", "cli",
];

/// Words, the modules that may say them, and why no other.
const WORDS: [(&[&str], &[&str], &str); 6] = [
    (
        &["std::fs", "std::net", "File::", "std::process"],
        &["app", "cli"],
        "loaders take a name and text or bytes; only app and cli touch the system",
    ),
    (
        &["std::time", "Instant::", "SystemTime::"],
        &["app", "cli"],
        "time is an argument; only app and cli read a clock",
    ),
    (&["winit::"], &["app", "cli"], "the window is one of several hosts"),
    (&["egui::", "egui_winit::", "egui_wgpu::"], &["app", "cli"], "the window is one of several hosts"),
    (&["wgpu::"], &["render", "app"], "only render (and its glue in app) knows the graphics device"),
    (&["gltf_json::", "gltf::"], &["export", "io"], "only export and io know glTF"),
];

/// Layers whose numbers are hashed.
const HASHED: [&str; 11] =
    ["math", "mesh", "subdiv", "anatomy", "io", "motion", "rig", "coat", "frame", "author", "export"];

/// Methods of the standard library whose last bits differ between machines, or that fuse two roundings into one.
const UNPORTABLE: [&str; 18] = [
    "mul_add",
    ".sin()",
    ".cos()",
    ".tan()",
    ".sin_cos()",
    ".asin()",
    ".acos()",
    ".atan()",
    ".atan2(",
    ".sinh()",
    ".cosh()",
    ".tanh()",
    ".exp()",
    ".exp2()",
    ".ln()",
    ".powf(",
    ".cbrt()",
    ".hypot(",
];

struct Source {
    path: PathBuf,
    /// The module of the crate that it belongs to.
    module: String,
    /// Line number and text, without comments and unit tests.
    lines: Vec<(usize, String)>,
}

fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    let mut folders = vec![root.clone()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("the source folder") {
            let path = entry.expect("a readable folder").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                let inside = path.strip_prefix(&root).expect("under src").to_owned();
                let first = inside.iter().next().expect("a name").to_string_lossy();
                let module = first.trim_end_matches(".rs").to_owned();
                if module != "lib" && module != "main" {
                    let lines = code_of(&fs::read_to_string(&path).expect("UTF-8"));
                    found.push(Source { path: Path::new("src").join(inside), module, lines });
                }
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    found
}

/// Unit tests stand at the end of a file; what follows `#[cfg(test)]` in front of a module is not the program.
fn code_of(text: &str) -> Vec<(usize, String)> {
    let lines: Vec<&str> = text.lines().collect();
    let tests = (0..lines.len()).find(|&i| {
        lines[i].trim() == "#[cfg(test)]" && lines.get(i + 1).is_some_and(|next| next.trim_start().starts_with("mod "))
    });
    let code = &lines[..tests.unwrap_or(lines.len())];
    code.iter().enumerate().map(|(i, line)| (i + 1, line.split("//").next().unwrap_or_default().to_owned())).collect()
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The names after each `crate::` of a line, in braces too.
fn arrows(line: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (at, _) in line.match_indices("crate::") {
        if line[..at].ends_with(|c| is_word(c) || c == '$') {
            continue;
        }
        let rest = &line[at + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(group) => {
                let mut depth = 0;
                let top = group.chars().take_while(|&c| {
                    depth += i32::from(c == '{') - i32::from(c == '}');
                    depth >= 0
                });
                let mut depth = 0;
                let flat: String = top
                    .map(|c| {
                        depth += i32::from(c == '{') - i32::from(c == '}');
                        if depth == 0 { c } else { ' ' }
                    })
                    .collect();
                names.extend(flat.split(',').map(|part| part.trim().chars().take_while(|&c| is_word(c)).collect()));
            }
            None => names.push(rest.chars().take_while(|&c| is_word(c)).collect()),
        }
    }
    names.retain(|name: &String| !name.is_empty());
    names
}

fn report(faults: Vec<String>) {
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn a_module_is_in_no_layer() {
    let known = |module: &str| ARROWS.iter().any(|(name, _)| *name == module);
    let unknown = sources().into_iter().filter(|s| !known(&s.module)).map(|s| s.path.display().to_string());
    report(unknown.collect());
}

#[test]
fn an_arrow_points_up_or_sideways() {
    let mut faults = Vec::new();
    for source in sources() {
        let Some((_, allowed)) = ARROWS.iter().find(|(name, _)| *name == source.module) else { continue };
        for (number, line) in &source.lines {
            for name in arrows(line) {
                if name != source.module && !allowed.contains(&name.as_str()) {
                    let (path, module) = (source.path.display(), &source.module);
                    faults.push(format!("{path}:{number}: {module} may not use {name}, only {allowed:?}"));
                }
            }
            if line.contains("super::super") || line.contains("use crate as") || line.contains("crate::*") {
                faults.push(format!("{}:{number}: write `use crate::module::…`", source.path.display()));
            }
        }
    }
    report(faults);
}

#[test]
fn the_arrows_themselves_go_round_in_a_circle() {
    let mut done: Vec<&str> = Vec::new();
    let mut left: Vec<_> = ARROWS.iter().filter(|(name, _)| *name != "app" && *name != "cli").collect();
    while !left.is_empty() {
        let before = left.len();
        left.retain(|(name, uses)| {
            let ready = uses.iter().all(|used| done.contains(used));
            if ready {
                done.push(name);
            }
            !ready
        });
        assert!(left.len() < before, "a circle among {left:?}");
    }
}

#[test]
fn a_lower_layer_names_the_system_the_window_or_the_device() {
    let mut faults = Vec::new();
    for source in sources() {
        for (words, allowed, reason) in WORDS {
            if allowed.contains(&source.module.as_str()) {
                continue;
            }
            for (number, line) in &source.lines {
                for word in words {
                    let named = line.match_indices(word).any(|(at, _)| !line[..at].ends_with(is_word));
                    if named {
                        faults.push(format!("{}:{number}: names {word}: {reason}", source.path.display()));
                    }
                }
            }
        }
    }
    report(faults);
}

#[test]
fn a_hashed_layer_computes_what_differs_between_machines() {
    let mut faults = Vec::new();
    for source in sources() {
        let door = source.path.ends_with("math/ops.rs");
        if door || !HASHED.contains(&source.module.as_str()) {
            continue;
        }
        for (number, line) in &source.lines {
            for word in UNPORTABLE.iter().filter(|word| line.contains(**word)) {
                faults.push(format!("{}:{number}: {word}: use crate::math::ops", source.path.display()));
            }
        }
    }
    report(faults);
}

#[test]
fn the_reader_of_sources_overlooks_an_arrow() {
    let found = |line: &str| arrows(line).join(" ");
    assert_eq!(found("use crate::mesh::DedgeMesh;"), "mesh");
    assert_eq!(found("use crate::{mesh::{Ring, app}, math};"), "mesh math");
    assert_eq!(found("let x = crate::rig::f(crate::frame::g());"), "rig frame");
    assert_eq!(found("use mycrate::mesh;"), "");
    let text = "use crate::a; // crate::b\n#[cfg(test)]\nmod tests {\n use crate::c;\n}";
    let code: String = code_of(text).into_iter().map(|(_, line)| line).collect();
    assert_eq!(found(&code), "a");
}
