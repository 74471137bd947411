//! The commands for any mesh, driven as a script would: `subdivide`, `bench`, `similarity`.
#![cfg(feature = "graphics")]

#[path = "support/program.rs"]
mod program;

use program::{command, done, finished, folder, names_in, output, png_size, refused, text};
use serde_json::{Value, json};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use tempfile::TempDir;

const CUBE: &str = "v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 -1\nv 1 -1 -1\n\
    f 1 2 4 3\nf 3 4 6 5\nf 5 6 8 7\nf 7 8 2 1\nf 2 8 6 4\nf 7 1 3 5\n";
const CUBE_TRIANGLES: [[u16; 3]; 12] = [
    [0, 1, 3],
    [0, 3, 2],
    [2, 3, 5],
    [2, 5, 4],
    [4, 5, 7],
    [4, 7, 6],
    [6, 7, 1],
    [6, 1, 0],
    [1, 7, 5],
    [1, 5, 3],
    [6, 0, 2],
    [6, 2, 4],
];
const SCHEMES: [&str; 6] = ["sqrt3", "sqrt3-interpolating", "loop", "butterfly", "catmull-clark", "doo-sabin"];

fn cube_corner(i: u16) -> [f32; 3] {
    let places = [[-1, -1, 1], [1, -1, 1], [-1, 1, 1], [1, 1, 1], [-1, 1, -1], [1, 1, -1], [-1, -1, -1], [1, -1, -1]];
    places[i as usize].map(|x| x as f32)
}

fn file(folder: &TempDir, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    path
}

/// What `--json` says of a mesh and some options.
fn facts(input: &Path, more: &[&str]) -> Value {
    let run = done(&[&["subdivide", text(input), "--json"], more].concat());
    serde_json::from_str(&run.stdout).unwrap()
}

/// The OBJ on stdout.
fn obj(input: &Path, more: &[&str]) -> String {
    String::from_utf8(bytes(input, more)).unwrap()
}

fn bytes(input: &Path, more: &[&str]) -> Vec<u8> {
    let output = output(&[&["subdivide", text(input), "-o", "-"], more].concat());
    assert_eq!(output.status.code(), Some(0), "{more:?}: {}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

fn triples(obj: &str, word: &str) -> Vec<[f64; 3]> {
    let rows = obj.lines().filter_map(|line| line.strip_prefix(word)?.strip_prefix(' '));
    rows.map(|row| {
        let numbers: Vec<f64> = row.split(' ').map(|n| n.parse().unwrap()).collect();
        [numbers[0], numbers[1], numbers[2]]
    })
    .collect()
}

fn grid(n: usize) -> String {
    let mut text = String::new();
    for i in 0..n * n {
        text += &format!("v {} {} 0\n", i % n, i / n);
    }
    for i in (0..n * n).filter(|i| i % n + 1 < n && i / n + 1 < n) {
        text += &format!("f {} {} {} {}\n", i + 1, i + 2, i + n + 2, i + n + 1);
    }
    text
}

// ---- schemes and options ----

#[test]
fn every_scheme_has_its_counts_on_a_cube() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    // Vertices and faces of level 2.
    let counts = [(56, 108), (56, 108), (98, 192), (98, 192), (98, 96), (96, 98)];
    for (scheme, (vertices, faces)) in SCHEMES.into_iter().zip(counts) {
        let found = facts(&cube, &["--scheme", scheme, "--level", "2"]);
        assert_eq!((&found["vertices"], &found["faces"]), (&json!(vertices), &json!(faces)), "{scheme}");
        assert_eq!(found["levels"].as_array().unwrap().len(), 3);
        assert_eq!(found["levels"][2], json!({ "level": 2, "vertices": vertices, "faces": faces }));
        assert_eq!((&found["euler_characteristic"], &found["boundary_loops"]), (&json!(2), &json!(0)), "{scheme}");
        let valences = found["valence_histogram"].as_object().unwrap();
        assert_eq!(valences.values().map(|n| n.as_u64().unwrap()).sum::<u64>(), vertices);
        for key in ["plan_bytes", "index_bytes", "build_ns", "evaluate_ns"] {
            assert!(found[key].as_u64().unwrap() > 0, "{scheme} {key}");
        }
        assert_eq!(
            (&found["ring_bytes"], &found["frozen_faces"], &found["normals"]),
            (&0.into(), &0.into(), &"none".into())
        );
        // The same by way of the file.
        let made = obj(&cube, &["--scheme", scheme, "--level", "2"]);
        assert_eq!(triples(&made, "v").len() as u64, vertices);
        assert_eq!(made.lines().filter(|l| l.starts_with("f ")).count() as u64, faces);
    }
}

#[test]
fn polygon_schemes_keep_polygons_and_holes_cover_all_triangles_of_a_polygon() {
    let folder = folder();
    let holed = file(&folder, "holed.obj", format!("{CUBE}t hole 1/0/0 4\n"));
    for (scheme, faces) in [("loop", 10), ("catmull-clark", 5)] {
        let found = facts(&holed, &["--scheme", scheme, "--level", "0"]);
        assert_eq!((&found["faces"], &found["boundary_loops"]), (&json!(faces), &json!(1)));
        assert_eq!((&found["boundary_lengths"], &found["euler_characteristic"]), (&json!([4]), &json!(1)));
    }
    let quads = obj(&holed, &["--scheme", "catmull-clark", "--level", "1"]);
    assert!(quads.lines().filter(|l| l.starts_with("f ")).all(|face| face.split(' ').count() == 5));
}

#[test]
fn vertices_that_no_face_uses_are_dropped_with_their_tags() {
    let folder = folder();
    let more = CUBE.replacen("f ", "v 7 7 7\nf ", 1) + "t corner 1/1/0 8 10\n";
    let found = facts(&file(&folder, "more.obj", more), &["--scheme", "loop", "--level", "0"]);
    assert_eq!(found["vertices"], 8);
}

#[test]
fn limits_are_where_deeper_levels_go_and_interpolating_schemes_are_there() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    for scheme in ["sqrt3", "loop"] {
        let limit = triples(&obj(&cube, &["--scheme", scheme, "--level", "0", "--limit"]), "v");
        let deep = triples(&obj(&cube, &["--scheme", scheme, "--level", "6"]), "v");
        for (a, b) in limit.iter().zip(&deep) {
            assert!((0..3).all(|i| (a[i] - b[i]).abs() < 2e-3), "{scheme}: {a:?} {b:?}");
        }
    }
    for scheme in ["sqrt3-interpolating", "butterfly"] {
        let with = obj(&cube, &["--scheme", scheme, "--level", "1", "--limit", "--normals"]);
        assert_eq!(with, obj(&cube, &["--scheme", scheme, "--level", "1", "--normals"]));
        let control = triples(CUBE, "v");
        assert_eq!(triples(&with, "v")[..8], control[..]);
    }
}

#[test]
fn normals_are_unit_vectors_of_the_faces_or_of_the_limit() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    for (more, kind) in [(&["--normals"][..], "faces"), (&["--normals", "--limit"][..], "limit")] {
        let options = [&["--scheme", "loop", "--level", "2"], more].concat();
        assert_eq!(facts(&cube, &options)["normals"], kind);
        let made = obj(&cube, &options);
        let normals = triples(&made, "vn");
        assert_eq!(normals.len(), triples(&made, "v").len());
        for (p, n) in triples(&made, "v").into_iter().zip(normals) {
            assert!((n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-5);
            assert!((0..3).map(|i| p[i] * n[i]).sum::<f64>() > 0.0, "outwards");
        }
    }
}

#[test]
fn a_crease_angle_is_the_same_as_tags_on_those_edges() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let edges = [(0, 1), (1, 3), (3, 2), (2, 0), (3, 5), (5, 4), (4, 2), (5, 7), (7, 6), (6, 4), (7, 1), (0, 6)];
    let tags: String = edges.map(|(a, b)| format!("t crease 2/1/0 {a} {b} 10\n")).concat();
    let tagged = file(&folder, "tagged.obj", format!("{CUBE}{tags}"));
    for scheme in ["sqrt3", "loop", "butterfly", "catmull-clark"] {
        let options = ["--scheme", scheme, "--level", "2"];
        let by_angle = obj(&cube, &[&options[..], &["--crease-angle", "40"]].concat());
        assert_eq!(by_angle, obj(&tagged, &options), "{scheme}");
        assert_ne!(by_angle, obj(&cube, &options), "{scheme}");
        assert_eq!(obj(&cube, &[&options[..], &["--crease-angle", "100"]].concat()), obj(&cube, &options));
        let corners = triples(&by_angle, "v");
        assert!(triples(CUBE, "v").iter().all(|c| corners.contains(c)), "{scheme} keeps corners where creases meet");
    }
}

#[test]
fn options_of_boundaries_creases_and_masks_change_what_they_are_for() {
    let folder = folder();
    let grid = file(&folder, "grid.obj", grid(4));
    let semi = "t crease 2/1/0 0 1 1.5\nt crease 2/1/0 1 3 3\nt crease 2/1/0 3 5 2.5\n";
    let semi = file(&folder, "semi.obj", format!("{CUBE}{semi}"));
    let differ = |input: &Path, base: &[&str], option: &[&str], usual: &[&str]| {
        let plain = obj(input, base);
        assert_eq!(plain, obj(input, &[base, usual].concat()), "{usual:?} is the default");
        assert_ne!(plain, obj(input, &[base, option].concat()), "{option:?} changes something");
    };
    let level_2 = ["--scheme", "loop", "--level", "2"];
    let by_corner = ["--scheme", "catmull-clark", "--level", "1"];
    differ(&grid, &by_corner, &["--boundary", "edge-and-corner"], &["--boundary", "edge"]);
    differ(&semi, &level_2, &["--creasing", "chaikin"], &["--creasing", "uniform"]);
    differ(&semi, &level_2, &["--loop-weights", "warren"], &["--loop-weights", "loop"]);
    let kept = triples(&obj(&grid, &[&by_corner[..], &["--boundary", "edge-and-corner"]].concat()), "v");
    assert!(kept.contains(&[0.0, 0.0, 0.0]) && kept.contains(&[3.0, 3.0, 0.0]));
}

#[test]
fn the_dual_is_three_connected() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    for scheme in ["sqrt3", "sqrt3-interpolating"] {
        let found = facts(&cube, &["--scheme", scheme, "--level", "2", "--dual"]);
        assert_eq!(found["valence_histogram"], json!({ "3": 36 }), "{scheme}: the vertices born in the last step");
        assert_eq!((&found["faces"], &found["euler_characteristic"]), (&json!(20), &json!(2)), "one for each old one");
    }
    let grid = file(&folder, "grid.obj", grid(5));
    let options = ["--scheme", "sqrt3", "--level", "1"];
    let middles = facts(&grid, &[&options[..], &["--dual=middles"]].concat());
    assert!(middles["valence_histogram"].as_object().unwrap().keys().all(|n| n == "3"), "{middles}");
    let born = facts(&grid, &[&options[..], &["--dual=born", "--normals"]].concat());
    assert!(born["vertices"].as_u64() < middles["vertices"].as_u64());
    let path = folder.path().join("dual.ply");
    done(&["subdivide", text(&cube), "-o", text(&path), "--scheme", "sqrt3", "--level", "2", "--dual", "--normals"]);
    assert_eq!(facts(&path, &["--scheme", "doo-sabin", "--level", "0"])["faces"], 20, "polygons stay polygons");
}

#[test]
fn flat_faces_are_frozen_and_adaptive_refinement_saves_flat_places() {
    let folder = folder();
    // A plain with one hill.
    let hill = grid(9).replacen("v 4 4 0", "v 4 4 2", 1);
    let hill = file(&folder, "hill.obj", hill);
    let uniform = facts(&hill, &["--scheme", "sqrt3", "--level", "4"]);
    let frozen = facts(&hill, &["--scheme", "sqrt3", "--level", "4", "--freeze-flatter-than", "10", "--normals"]);
    let n_frozen = frozen["frozen_faces"].as_u64().unwrap();
    assert!(n_frozen > 20 && frozen["faces"].as_u64() < uniform["faces"].as_u64(), "{frozen}");
    let adaptive = facts(&hill, &["--scheme", "sqrt3", "--level", "4", "--adaptive", "5", "--normals"]);
    assert!(adaptive["faces"].as_u64() < uniform["faces"].as_u64() && adaptive["faces"].as_u64() > Some(128));
    assert_eq!((&adaptive["positions"], &adaptive["normals"]), (&"limit".into(), &"faces".into()));
    for found in [&uniform, &frozen, &adaptive] {
        assert_eq!((&found["euler_characteristic"], &found["boundary_loops"]), (&json!(1), &json!(1)));
    }
}

/// OpenSubdiv's own numbers for a cube with creases and corners, by way of two OBJ files.
#[test]
fn tags_of_an_obj_do_not_give_the_numbers_of_opensubdiv() {
    let folder = folder();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracle/opensubdiv/loop");
    for (case, more) in [
        ("cube_tri.osd.loop.mix.edge_and_corner.uniform.l3", &[][..]),
        ("cube_tri.osd.loop.vary.edge_and_corner.chaikin.l2", &["--creasing", "chaikin"][..]),
    ] {
        let packed = std::fs::read(root.join(format!("{case}.json.gz"))).unwrap();
        let case: Value = serde_json::from_reader(flate2::read::GzDecoder::new(&packed[..])).unwrap();
        let input = &case["input"];
        let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
        let mut text = String::new();
        for p in list(&input["vertices"]) {
            text += &format!("v {} {} {}\n", p[0], p[1], p[2]);
        }
        for f in list(&input["faces"]) {
            let corner = |i: usize| f[i].as_u64().unwrap() + 1;
            text += &format!("f {} {} {}\n", corner(0), corner(1), corner(2));
        }
        let creases = list(&input["creases"]);
        creases.iter().for_each(|c| text += &format!("t crease 2/1/0 {} {} {}\n", c[0], c[1], c[2]));
        list(&input["corners"]).iter().for_each(|c| text += &format!("t corner 1/1/0 {} {}\n", c[0], c[1]));
        assert!(!creases.is_empty());
        let level = case["level"].to_string();
        let options = ["--scheme", "loop", "--level", &level, "--boundary", "edge-and-corner"];
        let ours = triples(&obj(&file(&folder, "case.obj", text), &[&options, more].concat()), "v");
        let expected = if case["output"].is_object() { &case["output"] } else { &case["sample"] };
        let expected = list(&expected["vertices"]);
        assert!(expected.len() > 20);
        for p in expected {
            let distance = |q: &[f64; 3]| (0..3).map(|i| (q[i] - p[i].as_f64().unwrap()).abs()).fold(0.0, f64::max);
            let nearest = ours.iter().map(distance).fold(f64::INFINITY, f64::min);
            assert!(nearest < 4e-6, "{p} is {nearest} away");
        }
    }
}

// ---- files ----

fn stl() -> String {
    let mut text = String::from("solid cube\n");
    for triangle in CUBE_TRIANGLES {
        text += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in triangle.map(cube_corner) {
            text += &format!("vertex {x} {y} {z}\n");
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid cube\n"
}

/// A cube with a vertex more for each corner of each triangle.
fn three_ds() -> Vec<u8> {
    fn chunk(id: u16, body: &[u8]) -> Vec<u8> {
        [&id.to_le_bytes()[..], &(body.len() as u32 + 6).to_le_bytes(), body].concat()
    }
    let corners: Vec<u16> = CUBE_TRIANGLES.concat();
    let n = corners.len() as u16;
    let places = corners.iter().flat_map(|&c| cube_corner(c)).flat_map(f32::to_le_bytes);
    let points: Vec<u8> = n.to_le_bytes().into_iter().chain(places).collect();
    let faces = (0..n / 3).flat_map(|f| [3 * f, 3 * f + 1, 3 * f + 2, 0]).flat_map(u16::to_le_bytes);
    let faces: Vec<u8> = (n / 3).to_le_bytes().into_iter().chain(faces).collect();
    let mesh = chunk(0x4100, &[chunk(0x4110, &points), chunk(0x4120, &faces)].concat());
    chunk(0x4d4d, &chunk(0x3d3d, &chunk(0x4000, &[&b"cube\0"[..], &mesh].concat())))
}

/// A GLB as text, with its data in the text.
fn gltf(glb: &[u8]) -> String {
    let length = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    let end = 20 + length(12);
    let mut document: Value = serde_json::from_slice(&glb[20..end]).unwrap();
    let data = &glb[end + 8..end + 8 + length(end)];
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut base64 = String::new();
    for three in data.chunks(3) {
        let bits = (0..3).fold(0_u32, |bits, i| bits << 8 | u32::from(*three.get(i).unwrap_or(&0)));
        for i in 0..4 {
            let letter = letters[(bits >> (18 - 6 * i) & 63) as usize] as char;
            base64.push(if i > three.len() { '=' } else { letter });
        }
    }
    document["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{base64}").into();
    document.to_string()
}

#[test]
fn every_format_is_read_from_files_and_from_stdin_and_written() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let options = ["--scheme", "loop", "--level", "0"];
    for name in ["out.obj", "out.ply", "out.glb"] {
        let path = folder.path().join(name);
        let run = done(&[&["subdivide", text(&cube), "-o", text(&path)], &options[..]].concat());
        assert_eq!(run.stdout, "");
        assert!(run.stderr.contains(name));
    }
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    file(&folder, "cube.stl", stl());
    file(&folder, "cube.3ds", three_ds());
    file(&folder, "out.gltf", gltf(&read("out.glb")));
    let names = ["out.obj", "out.ply", "out.glb", "out.gltf", "cube.stl", "cube.3ds"];
    for name in names {
        let found = facts(&folder.path().join(name), &options);
        let counts = [&found["vertices"], &found["faces"], &found["euler_characteristic"]];
        assert_eq!(counts, [&json!(8), &json!(12), &json!(2)], "{name}");
        // By content: from stdin, and under a name that says nothing.
        let anonymous = file(&folder, "mesh.dat", read(name));
        assert_eq!(facts(&anonymous, &options)["vertices"], 8, "{name}");
        let mut child = command(&[&["subdivide", "-", "-o", "-"], &options[..]].concat())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(&read(name)).unwrap();
        let run = finished(child.wait_with_output().unwrap());
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{name}");
        assert_eq!(triples(&run.stdout, "v").len(), 8, "{name}");
    }
    let capitals = file(&folder, "CUBE.OBJ", CUBE);
    assert_eq!(facts(&capitals, &options)["vertices"], 8);
}

#[test]
fn positions_survive_in_all_their_bits() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let fine = file(&folder, "fine.obj", obj(&cube, &["--scheme", "sqrt3", "--level", "3"]));
    assert_eq!(
        obj(&fine, &["--scheme", "sqrt3", "--level", "0"]),
        std::fs::read_to_string(&fine).unwrap(),
        "nine digits hold a number of 32 bits"
    );
}

#[test]
fn json_tells_what_was_written() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let path = folder.path().join("out.ply");
    let found = facts(&cube, &["--scheme", "loop", "--level", "1", "-o", text(&path)]);
    assert_eq!(found["output"], text(&path));
    assert_eq!(found["bytes"], std::fs::metadata(&path).unwrap().len());
    assert_eq!(names_in(folder.path()), ["cube.obj", "out.ply"]);
}

// ---- what is refused ----

#[test]
fn words_that_make_no_sense_are_wrong_use() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let cube = text(&cube);
    let with = |more: &[&str], words: &[&str]| {
        refused(&[&["subdivide", cube, "--level", "1"], more].concat(), 2, words);
    };
    with(&["--json"], &["--scheme"]);
    with(&["--scheme", "lop", "--json"], &["loop"]);
    with(&["--scheme", "loop"], &["--output"]);
    with(&["--scheme", "loop", "-o", "-", "--json"], &["--json"]);
    with(&["--scheme", "loop", "-o", "x.stl"], &["x.stl", ".obj, .ply, .glb"]);
    with(&["--scheme", "loop", "-o", "x"], &[".obj, .ply, .glb"]);
    with(&["--scheme", "loop", "--json", "--crease-angle", "181"], &["allowed 0 to 180"]);
    with(&["--scheme", "loop", "--json", "--boundary", "none"], &["edge-and-corner"]);
    with(&["--scheme", "loop", "--json", "--freeze-flatter-than", "5"], &["loop", "only sqrt3"]);
    with(&["--scheme", "loop", "--json", "--adaptive", "5"], &["adaptive refinement is for sqrt3"]);
    with(&["--scheme", "loop", "--json", "--dual"], &["three-connected dual"]);
    with(&["--scheme", "doo-sabin", "--json", "--crease-angle", "30"], &["no rule for sharp edges"]);
    for scheme in ["catmull-clark", "doo-sabin"] {
        with(&["--scheme", scheme, "--json", "--limit"], &["no limit masks"]);
    }
    with(&["--scheme", "sqrt3", "--json", "--adaptive", "5", "--dual"], &["--adaptive", "--dual"]);
    with(&["--scheme", "sqrt3", "--json", "--adaptive", "5", "--freeze-flatter-than", "5"], &["--adaptive"]);
    with(&["--scheme", "sqrt3", "--json", "--freeze-flatter-than", "5", "--dual"], &["--dual"]);
    refused(&["subdivide", cube, "--scheme", "sqrt3", "--level", "0", "--json", "--dual"], 2, &["level 0"]);
    refused(&["subdivide", cube, "--scheme", "loop", "--level", "31", "--json"], 2, &["31"]);
    refused(&["subdivide", "--scheme", "loop", "--level", "1", "--json"], 2, &["<IN>"]);
}

#[test]
fn a_mesh_that_cannot_be_subdivided_fails_with_its_name_and_the_element() {
    let folder = folder();
    let refuse = |name: &str, content: &str, scheme: &str, words: &[&str]| {
        let path = file(&folder, name, content);
        let target = folder.path().join("out.obj");
        let args = ["subdivide", text(&path), "-o", text(&target), "--scheme", scheme, "--level", "1"];
        refused(&args, 1, &[&[name], words].concat());
        assert!(!target.exists(), "nothing is written");
    };
    refuse("syntax.obj", "v 0 0\n", "loop", &["OBJ", "line 1"]);
    refuse("far.obj", "v 0 0 0\nf 1 2 3\n", "loop", &["OBJ", "line 2"]);
    refuse("empty.obj", "", "loop", &["no triangles"]);
    refuse("empty.ply", "ply\n", "loop", &["PLY"]);
    refuse("not.glb", "glTF", "loop", &["glTF"]);
    refuse("not.3ds", "MM", "loop", &["3DS"]);
    // An unused vertex comes first, a quadrilateral before the mistake: the numbers are those of the file.
    let three = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n\
        f 2 3 4 5\nf 3 6 7 4\nf 3 4 7\n";
    for scheme in ["loop", "catmull-clark"] {
        // Edge 2 to 3 runs upwards in faces 0 and 2.
        refuse("fin.obj", three, scheme, &["triangles f0 and f2 both run from vertex v2 to v3", "count from 0"]);
    }
    let bow = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n";
    refuse("bow.obj", bow, "sqrt3", &["vertex v0", "hang together"]);
    let twice = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\n";
    refuse("twice.obj", twice, "sqrt3", &["face f0 uses vertex v1 more than once"]);
    let astray = format!("{CUBE}t crease 2/1/0 0 5 3\n");
    refuse("astray.obj", &astray, "loop", &["line 15", "no face has a side from vertex 0 to vertex 5"]);
    let sharp = format!("{CUBE}t crease 2/1/0 0 1 3\n");
    refuse("sharp.obj", &sharp, "doo-sabin", &["doo-sabin has no rule for sharp edges"]);
    refuse("sharp.obj", &sharp, "sqrt3-interpolating", &["no rule for sharp edges"]);
    let gone: String = (0..6).map(|f| format!("t hole 1/0/0 {f}\n")).collect();
    refuse("gone.obj", &format!("{CUBE}{gone}"), "loop", &["without its holes"]);
    refuse("huge.obj", &CUBE.replace('1', "3e38").replace("f 3e38", "f 1"), "butterfly", &[]);
}

#[test]
fn what_is_too_large_or_not_there_fails() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    for scheme in SCHEMES {
        let args = ["subdivide", text(&cube), "--scheme", scheme, "--level", "30", "--json"];
        refused(&args, 1, &["cube.obj", "ask for fewer levels"]);
    }
    let missing = folder.path().join("no.obj");
    refused(&["subdivide", text(&missing), "--scheme", "loop", "--level", "1", "--json"], 1, &["no such file"]);
    let args = ["subdivide", text(folder.path()), "--scheme", "loop", "--level", "1", "--json"];
    refused(&args, 1, &["is a folder"]);
    let nowhere = folder.path().join("no").join("out.obj");
    let args = ["subdivide", text(&cube), "-o", text(&nowhere), "--scheme", "loop", "--level", "1"];
    refused(&args, 1, &["does not exist"]);
    refused(&["bench", text(&missing), "--scheme", "loop", "--level", "1"], 1, &["no such file"]);
    refused(&["similarity", text(&missing)], 1, &["no such file"]);
}

// ---- pictures ----

#[test]
fn a_mesh_is_drawn_where_the_name_says_png() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let path = folder.path().join("cube.png");
    done(&["subdivide", text(&cube), "-o", text(&path), "--scheme", "catmull-clark", "--level", "2"]);
    let quads = std::fs::read(&path).unwrap();
    assert_eq!(png_size(&quads), (360, 360));
    done(&["subdivide", text(&cube), "-o", text(&path), "--scheme", "loop", "--level", "2"]);
    assert_ne!(std::fs::read(&path).unwrap(), quads);
}

#[cfg(target_os = "linux")]
#[test]
fn without_an_adapter_a_picture_is_refused_and_a_mesh_is_not() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let without = |target: &Path| {
        let args = ["subdivide", text(&cube), "-o", text(target), "--scheme", "loop", "--level", "1"];
        let run = command(&args)
            .env("VK_DRIVER_FILES", "/nonexistent")
            .env("VK_ICD_FILENAMES", "/nonexistent")
            .env("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent")
            .output()
            .unwrap();
        finished(run)
    };
    let run = without(&folder.path().join("out.png"));
    assert_eq!((run.code, run.stdout.as_str()), (3, ""), "{}", run.stderr);
    assert!(run.stderr.contains("londra: no graphics adapter"), "{}", run.stderr);
    assert_eq!(without(&folder.path().join("out.obj")).code, 0);
    assert_eq!(names_in(folder.path()), ["cube.obj", "out.obj"]);
}

// ---- bench and similarity ----

#[test]
fn bench_times_frames_and_says_what_a_plan_costs() {
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let options = ["--scheme", "loop", "--level", "3", "--limit", "--threads", "2", "--json"];
    let run = done(&[&["bench", text(&cube)], &options[..]].concat());
    let found: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((&found["scheme"], &found["level"], &found["threads"]), (&"loop".into(), &3.into(), &2.into()));
    assert_eq!(found["out_vertices"], 386);
    for key in ["median_ns", "ns_per_vertex", "plan_build_ns", "plan_bytes", "copy_ns", "x_copy", "index_bytes"] {
        assert!(found[key].as_f64().unwrap() > 0.0, "{key}: {found}");
    }
    let ratio = found["median_ns"].as_f64().unwrap() / found["copy_ns"].as_f64().unwrap();
    assert!((found["x_copy"].as_f64().unwrap() / ratio - 1.0).abs() < 1e-9);
    // The head's control mesh, with a scheme of polygons and normals from faces.
    let run = done(&["bench", "--scheme", "catmull-clark", "--level", "1", "--normals"]);
    for word in ["head", "catmull-clark level 1", "ns a vertex", "copies", "rings"] {
        assert!(run.stdout.contains(word), "{}", run.stdout);
    }
    refused(&["bench", "--scheme", "butterfly", "--level", "1", "--limit"], 2, &["no limit masks"]);
    refused(&["bench", "--scheme", "loop", "--level", "30"], 1, &["ask for fewer levels"]);
    refused(&["bench", "--scheme", "loop", "--level", "1", "--limit", "--normals"], 2, &["--normals"]);
}

#[test]
fn similarity_reports_on_the_cases_of_the_thesis_and_on_files() {
    let found: Value =
        serde_json::from_str(&done(&["similarity", "icosahedron", "--level", "3", "--json"]).stdout).unwrap();
    assert_eq!((found["steps"].as_array().unwrap().len(), &found["steps"][0]["classes"]), (3, &json!(1)));
    assert_eq!(found["whole"][2]["vertices"], 642);
    assert_eq!(found["shared_rows"]["classes"], 1, "all its triangles have the same surroundings");
    for key in ["similar_ns", "classical_ns", "plan_ns", "prepare_ns"] {
        assert!(found["whole"][2][key].as_f64().unwrap() > 0.0, "{key}");
    }
    let torus = done(&["similarity", "torus"]).stdout;
    assert!(torus.starts_with("torus, loop to level 2") && torus.lines().count() == 7, "{torus}");
    let folder = folder();
    let cube = file(&folder, "cube.obj", CUBE);
    let run = done(&["similarity", text(&cube), "--scheme", "butterfly", "--folds", "--no-mirrored", "--json"]);
    let found: Value = serde_json::from_str(&run.stdout).unwrap();
    assert_eq!((&found["scheme"], &found["level"]), (&"butterfly".into(), &2.into()));
    refused(&["similarity", "icosahedron", "--scheme", "sqrt3"], 2, &["use loop or butterfly"]);
    refused(&["similarity", "icosahedron", "--epsilon=-1"], 2, &["allowed 0 or more"]);
}
