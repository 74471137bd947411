//! Exported heads, read back with the `gltf` crate and compared with the frame they came from.
#![cfg(feature = "head")]

#[path = "support/stand_in.rs"]
mod stand_in;

use glam::{Vec2, Vec3};
use gltf::mesh::util::{ReadColors, ReadIndices};
use londra::anatomy::{Breed, ParamTable, library, load_breed};
use londra::export::{GeometryError, GlbError, GlbOptions, to_glb};
use londra::frame::{Frame, Material, MaterialRange, Part, PartTopology, Pipeline, Revisions};
use londra::rig::Rig;
use serde_json::Value;
use stand_in::StandIn;
use std::sync::Arc;

fn table() -> ParamTable {
    ParamTable::embedded().unwrap_or_else(|e| panic!("{e}"))
}

fn breed(table: &ParamTable) -> Breed {
    library::breed(table, "pug").unwrap_or_else(|e| panic!("{e}"))
}

fn export(frame: &Frame<'_>) -> Vec<u8> {
    let table = table();
    to_glb(frame, &table, &breed(&table), &GlbOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn head() -> StandIn {
    StandIn::new(0.06, Vec3::new(0.5, 0.4, 0.25))
}

/// The JSON and the binary chunk, cut by hand after the specification.
fn chunks(glb: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(&glb[..4], b"glTF");
    assert_eq!((word(4), word(8)), (2, glb.len()));
    let json_length = word(12);
    assert_eq!(&glb[16..20], b"JSON");
    assert_eq!(json_length % 4, 0);
    let json = serde_json::from_slice(&glb[20..20 + json_length]).unwrap();
    let at = 20 + json_length;
    assert_eq!(&glb[at + 4..at + 8], b"BIN\0");
    assert_eq!((word(at) % 4, word(at)), (0, glb.len() - at - 8));
    (json, &glb[at + 8..])
}

// ---- a part made by hand, for cases no head has ----

struct Hand {
    topology: Arc<PartTopology>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    colours: Vec<Vec3>,
}

impl Hand {
    /// A strip of `n` vertices on a line of triangles, one material.
    fn strip(n: usize) -> Self {
        let indices: Vec<u32> = (0..n as u32 - 2).flat_map(|i| [i, i + 1, i + 2]).collect();
        let ranges = vec![MaterialRange { material: Material::Coat, start: 0, count: indices.len() as u32 }];
        Self {
            topology: Arc::new(PartTopology { name: "skin", n_vertices: n, indices, ranges }),
            positions: (0..n).map(|i| Vec3::new(i as f32 * 1e-5, (i % 2) as f32 * 1e-3, 0.25)).collect(),
            normals: vec![Vec3::Z; n],
            colours: vec![Vec3::splat(0.5); n],
        }
    }

    fn change(mut self, change: impl FnOnce(&mut Self)) -> Self {
        change(&mut self);
        self
    }

    fn topology(&mut self) -> &mut PartTopology {
        Arc::get_mut(&mut self.topology).unwrap()
    }

    fn frame(&self) -> Frame<'_> {
        let part = Part {
            topology: &self.topology,
            positions: &self.positions,
            normals: &self.normals,
            colours: &self.colours,
            surface: &self.normals,
            flow: &self.normals,
            rest: &self.normals,
            uv: None,
        };
        Frame {
            parts: vec![part],
            control: &[],
            control_indices: &[],
            plan: None,
            is_planned: false,
            whiskers: &[],
            eyes: &[],
            coat: None,
            revisions: Revisions::default(),
        }
    }
}

// ---- what is in the file ----

/// Every mesh, primitive and value equals the frame's; counts, bounds and materials fit.
fn compare(glb: &[u8], frame: &Frame<'_>) {
    let (document, buffers, images) = gltf::import_slice(glb).unwrap_or_else(|e| panic!("{e}"));
    assert!(images.is_empty());
    let meshes: Vec<_> = document.meshes().collect();
    assert_eq!(meshes.len(), frame.parts.len());
    for (mesh, part) in meshes.iter().zip(&frame.parts) {
        assert_eq!(mesh.name(), Some(part.topology.name));
        let primitives: Vec<_> = mesh.primitives().collect();
        assert_eq!(primitives.len(), part.topology.ranges.len());
        for (primitive, range) in primitives.iter().zip(&part.topology.ranges) {
            assert_eq!(primitive.mode(), gltf::mesh::Mode::Triangles);
            assert_eq!(primitive.material().name(), Some(material_name(range.material)));
            compare_primitive(primitive, &buffers, part, range);
        }
    }
}

fn material_name(material: Material) -> &'static str {
    match material {
        Material::Coat => "coat",
        Material::Nose => "nose",
        Material::Lip => "lip",
        Material::Mouth => "mouth",
        Material::Sclera => "sclera",
        Material::Iris => "iris",
        Material::Pupil => "pupil",
        Material::Cap => "neck_cap",
        Material::Bone => "bone",
        Material::Tooth => "tooth",
        Material::Gum => "gum",
        Material::Tongue => "tongue",
        Material::ThirdEyelid => "third_eyelid",
        Material::Tears => "tears",
        Material::Whisker => "whisker",
        Material::Muscle => "muscle",
    }
}

fn compare_primitive(
    primitive: &gltf::Primitive<'_>,
    buffers: &[gltf::buffer::Data],
    part: &Part<'_>,
    range: &MaterialRange,
) {
    let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| &data.0[..]));
    let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
    let normals: Vec<[f32; 3]> = reader.read_normals().unwrap().collect();
    let Some(ReadColors::RgbaU8(colours)) = reader.read_colors(0) else { panic!("colours are RGBA bytes") };
    let colours: Vec<[u8; 4]> = colours.collect();
    let indices = reader.read_indices().unwrap();
    assert_eq!(matches!(indices, ReadIndices::U32(_)), positions.len() > 65_535);
    let indices: Vec<u32> = indices.into_u32().collect();

    let (start, end) = (range.start as usize, (range.start + range.count) as usize);
    let source = &part.topology.indices[start..end];
    assert_eq!(indices.len(), source.len());
    assert_eq!((normals.len(), colours.len()), (positions.len(), positions.len()));
    let mut is_used = vec![false; positions.len()];
    for (&compact, &vertex) in indices.iter().zip(source) {
        let (compact, vertex) = (compact as usize, vertex as usize);
        is_used[compact] = true;
        assert_eq!(positions[compact].map(f32::to_bits), part.positions[vertex].to_array().map(f32::to_bits));
        assert_eq!(normals[compact], part.normals[vertex].to_array());
        let [r, g, b] = part.colours[vertex].to_array().map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
        let near = |a: u8, b: u8| a.abs_diff(b) <= 1;
        let [x, y, z, alpha] = colours[compact];
        assert!(near(r, x) && near(g, y) && near(b, z) && alpha == 255, "{:?}", colours[compact]);
    }
    assert!(is_used.iter().all(|&used| used), "vertices that no triangle uses");

    let low = positions.iter().fold(Vec3::INFINITY, |a, &p| a.min(p.into()));
    let high = positions.iter().fold(Vec3::NEG_INFINITY, |a, &p| a.max(p.into()));
    let bounds = primitive.bounding_box();
    assert_eq!((bounds.min, bounds.max), (low.to_array(), high.to_array()));
}

/// Volume enclosed by triangles, positive when they are counter-clockwise from outside, m³.
fn volume(parts: &[&Part<'_>]) -> f64 {
    let corner = |part: &Part<'_>, index: u32| part.positions[index as usize].as_dvec3();
    let triangles = parts.iter().flat_map(|p| p.topology.indices.chunks_exact(3).map(move |t| (p, t)));
    triangles.map(|(p, t)| corner(p, t[0]).dot(corner(p, t[1]).cross(corner(p, t[2]))) / 6.0).sum()
}

/// Outside is outside, in winding and in normals, and the size is that of a dog's head.
fn check_geometry(frame: &Frame<'_>) {
    let (eyes, rest): (Vec<&Part<'_>>, Vec<_>) = frame.parts.iter().partition(|p| p.topology.name.starts_with("eye_"));
    assert_eq!(eyes.len(), 2);
    let head = volume(&rest);
    assert!((2e-4..1e-2).contains(&head), "a head of {head} m³");
    assert!(eyes.iter().all(|&eye| volume(&[eye]) > 1e-7));
    let (mut wrong, mut all) = (0.0, 0.0);
    for part in &frame.parts {
        assert!(part.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-3), "{}", part.topology.name);
        for t in part.topology.indices.chunks_exact(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| part.positions[i as usize]);
            let normal = (b - a).cross(c - a);
            let vertex_normals: Vec3 = t.iter().map(|&i| part.normals[i as usize]).sum();
            all += normal.length();
            wrong += if normal.dot(vertex_normals) < 0.0 { normal.length() } else { 0.0 };
        }
    }
    assert!(wrong < 0.005 * all, "{wrong} of {all}: normals against the winding");
    let (low, high) = frame.bounds();
    assert!((0.1..0.8).contains(&(high - low).length()));
}

#[test]
fn what_is_read_back_is_the_frame() {
    let head = head();
    let frame = head.frame();
    compare(&export(&frame), &frame);
    check_geometry(&frame);
}

#[test]
fn every_shipped_breed_is_read_back_as_its_frame_and_is_the_right_way_out() {
    let table = Arc::new(table());
    let rig = Arc::new(Rig::embedded(&table).unwrap());
    let mut pipeline = Pipeline::new(rig, 2).unwrap();
    for id in library::ids() {
        let breed = library::breed(&table, id).unwrap();
        let frame = pipeline.update(&breed);
        let glb = to_glb(&frame, &table, &breed, &GlbOptions::default()).unwrap_or_else(|e| panic!("{id}: {e}"));
        compare(&glb, &frame);
        check_geometry(&frame);
    }
}

#[test]
fn texture_coordinates_are_lost_or_tear_the_skin() {
    let table = Arc::new(table());
    let rig = Arc::new(Rig::embedded(&table).unwrap());
    for level in [1, 2] {
        let mut pipeline = Pipeline::new(rig.clone(), level).unwrap();
        pipeline.set_uv(true).unwrap();
        let breed = breed(&table);
        let frame = pipeline.update(&breed);
        let glb = to_glb(&frame, &table, &breed, &GlbOptions::default()).unwrap();
        let (document, buffers, _) = gltf::import_slice(&glb).unwrap();
        for (mesh, part) in document.meshes().zip(&frame.parts) {
            let mut distinct = std::collections::BTreeSet::new();
            for (k, primitive) in mesh.primitives().enumerate() {
                let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| &data.0[..]));
                let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
                let normals: Vec<[f32; 3]> = reader.read_normals().unwrap().collect();
                let Some(uvs) = reader.read_tex_coords(0) else {
                    assert!(part.uv.is_none(), "{} has lost its texture coordinates", part.topology.name);
                    continue;
                };
                let uvs: Vec<[f32; 2]> = uvs.into_f32().collect();
                assert_eq!((uvs.len(), normals.len()), (positions.len(), positions.len()));
                assert!(uvs.iter().flatten().all(|x| (0.0..=1.0).contains(x)));
                let uv = part.uv.unwrap();
                let range = &uv.ranges[k];
                let source = &uv.indices[range.start as usize..(range.start + range.count) as usize];
                let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
                assert_eq!(indices.len(), source.len());
                for (&compact, &drawn) in indices.iter().zip(source) {
                    let compact = compact as usize;
                    assert_eq!(Vec2::from(uvs[compact]), uv.coordinates[drawn as usize]);
                    let [a, b] = uv.vertices[drawn as usize];
                    if a == b {
                        // Both sides of a seam have the bits of one vertex.
                        let (position, normal) = (part.positions[a as usize], part.normals[a as usize]);
                        assert_eq!(positions[compact].map(f32::to_bits), position.to_array().map(f32::to_bits));
                        assert_eq!(normals[compact], normal.to_array());
                    }
                    let bits = positions[compact].map(|x| if x == 0.0 { 0 } else { x.to_bits() });
                    distinct.insert(bits);
                }
            }
            if let Some(uv) = part.uv.filter(|_| part.topology.name == "skin") {
                let middles: std::collections::BTreeSet<_> =
                    uv.vertices.iter().filter(|[a, b]| a != b).map(|&[a, b]| (a.min(b), a.max(b))).collect();
                assert_eq!(distinct.len(), part.topology.n_vertices + middles.len(), "seams tear the skin");
            }
        }
        assert!(frame.parts.iter().filter(|p| p.uv.is_some()).count() == 3, "skin and eyes");
    }
}

#[test]
fn the_nodes_are_one_root_with_a_child_per_part() {
    let head = head();
    let glb = export(&head.frame());
    let (document, ..) = gltf::import_slice(&glb).unwrap();
    let scene = document.default_scene().unwrap();
    let roots: Vec<_> = scene.nodes().collect();
    assert_eq!(roots.len(), 1);
    assert_eq!(roots[0].name(), Some("londra_head"));
    let children: Vec<_> = roots[0].children().map(|c| c.name().unwrap().to_owned()).collect();
    let parts: Vec<_> = head.frame().parts.iter().map(|p| p.topology.name.to_owned()).collect();
    assert_eq!(children, parts);
    assert!(document.nodes().all(|n| n.transform().decomposed() == ([0.0; 3], [0.0, 0.0, 0.0, 1.0], [1.0; 3])));
    for name in document.nodes().map(|n| n.name().unwrap().to_owned()) {
        assert!(name.len() <= 63 && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'), "{name}");
    }
}

#[test]
fn the_root_tells_the_breed_and_can_be_opened_again() {
    let (table, head) = (table(), head());
    let (a, b) = (breed(&table), library::breed(&table, "labrador").unwrap());
    let blend = Breed::blend(&table, &[(&a, 0.3), (&b, 0.7)]);
    let options = GlbOptions { copyright: Some("© somebody".into()), ..GlbOptions::default() };
    let glb = to_glb(&head.frame(), &table, &blend, &options).unwrap();
    let (json, _) = chunks(&glb);
    assert_eq!(json["asset"]["generator"], format!("Londra {}", env!("CARGO_PKG_VERSION")));
    assert_eq!(json["asset"]["version"], "2.0");
    assert_eq!(json["asset"]["copyright"], "© somebody");
    let root = json["scenes"][0]["nodes"][0].as_u64().unwrap() as usize;
    let extras = json["nodes"][root]["extras"].as_object().unwrap();
    assert!(extras.values().all(|v| v.is_string() || v.is_number()), "nested extras abort some importers");
    assert_eq!(extras["londra_schema"], 1);
    assert_eq!(extras["londra_breed"], blend.id);
    assert_eq!(extras["londra_copyright"], "© somebody");
    let params = extras["londra_params"].as_str().unwrap();
    let values: std::collections::BTreeMap<String, f64> = serde_json::from_str(params).unwrap();
    assert_eq!(serde_json::to_string(&values).unwrap(), params, "keys are sorted");
    assert_eq!(values.len(), table.specs.len());
    for (spec, si) in table.specs.iter().zip(&blend.values) {
        assert_eq!(spec.to_si(values[&spec.id]).to_bits(), si.to_bits(), "{}", spec.id);
    }
    let again = load_breed(&table, &format!("{}.ron", blend.id), extras["londra_ron"].as_str().unwrap());
    assert_eq!(again.unwrap(), blend);
}

#[test]
fn the_same_head_gives_the_same_bytes() {
    assert_eq!(export(&head().frame()), export(&head().frame()));
}

#[test]
fn materials_look_right_alone_and_require_nothing() {
    let head = head();
    let (json, _) = chunks(&export(&head.frame()));
    assert!(json.get("extensionsRequired").is_none());
    let used: Vec<&str> = json["extensionsUsed"].as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect();
    assert_eq!(used, ["KHR_materials_clearcoat", "KHR_materials_ior", "KHR_materials_sheen"]);
    let materials = json["materials"].as_array().unwrap();
    let names: Vec<&str> = materials.iter().map(|m| m["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["coat", "nose", "sclera"]);
    for material in materials {
        assert_eq!(material["pbrMetallicRoughness"]["metallicFactor"], 0.0);
        assert_eq!(material["pbrMetallicRoughness"]["baseColorFactor"], serde_json::json!([1.0, 1.0, 1.0, 1.0]));
    }
    assert_eq!(materials[2]["extensions"]["KHR_materials_ior"]["ior"], 1.376);
    assert!(materials[0]["extensions"]["KHR_materials_sheen"].is_object());
}

#[test]
fn views_and_accessors_are_aligned_within_bounds_and_targeted() {
    let head = head();
    let glb = export(&head.frame());
    let (json, binary) = chunks(&glb);
    let number = |v: &Value, key: &str| v.get(key).map_or(0, |n| n.as_u64().unwrap() as usize);
    assert_eq!(json["buffers"].as_array().unwrap().len(), 1);
    assert_eq!(number(&json["buffers"][0], "byteLength"), binary.len());
    let views = json["bufferViews"].as_array().unwrap();
    let mut end = 0;
    for view in views {
        assert_eq!(number(view, "byteOffset") % 4, 0);
        assert!(number(view, "byteOffset") >= end && number(view, "byteOffset") < end + 4, "views overlap or gape");
        end = number(view, "byteOffset") + number(view, "byteLength");
    }
    assert!(end <= binary.len() && binary.len() < end + 4);
    let mut is_index = vec![false; json["accessors"].as_array().unwrap().len()];
    for primitive in json["meshes"].as_array().unwrap().iter().flat_map(|m| m["primitives"].as_array().unwrap()) {
        is_index[number(primitive, "indices")] = true;
    }
    for (accessor, is_index) in json["accessors"].as_array().unwrap().iter().zip(is_index) {
        let view = &views[number(accessor, "bufferView")];
        let size = match accessor["componentType"].as_u64().unwrap() {
            5121 => 1,
            5123 => 2,
            _ => 4,
        };
        let width = ["SCALAR", "", "VEC3", "VEC4"].iter().position(|t| accessor["type"] == *t).unwrap() + 1;
        assert_eq!(number(view, "target"), if is_index { 34_963 } else { 34_962 });
        assert_eq!(view.get("byteStride").is_some(), !is_index);
        if !is_index {
            assert_eq!(number(view, "byteStride"), size * width);
        }
        assert_eq!((number(view, "byteOffset") + number(accessor, "byteOffset")) % size, 0);
        assert!(number(accessor, "count") > 0);
        let end = number(accessor, "byteOffset") + number(accessor, "count") * size * width;
        assert!(end <= number(view, "byteLength"));
    }
}

#[test]
fn many_vertices_get_wide_indices_and_few_get_narrow_ones() {
    for n in [3, 65_535, 65_536] {
        let hand = Hand::strip(n);
        compare(&export(&hand.frame()), &hand.frame());
    }
}

#[test]
fn a_range_without_triangles_and_a_frame_without_parts_are_left_out() {
    let hand = Hand::strip(9).change(|h| {
        let empty = MaterialRange { material: Material::Nose, start: 21, count: 0 };
        h.topology().ranges.push(empty);
    });
    let (json, _) = chunks(&export(&hand.frame()));
    assert_eq!(json["materials"].as_array().unwrap().len(), 1);
    assert_eq!(json["meshes"][0]["primitives"].as_array().unwrap().len(), 1);
    let nothing = Frame {
        parts: vec![],
        control: &[],
        control_indices: &[],
        plan: None,
        is_planned: false,
        whiskers: &[],
        eyes: &[],
        coat: None,
        revisions: Revisions::default(),
    };
    assert!(gltf::import_slice(export(&nothing)).is_ok());
}

#[test]
fn a_collapsed_normal_becomes_a_unit_one() {
    let hand = Hand::strip(9).change(|h| h.normals[4] = Vec3::ZERO);
    let (document, buffers, _) = gltf::import_slice(export(&hand.frame())).unwrap();
    let primitive = document.meshes().next().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|b| buffers.get(b.index()).map(|d| &d.0[..]));
    assert!(reader.read_normals().unwrap().all(|n| (Vec3::from(n).length() - 1.0).abs() < 1e-6));
}

#[test]
fn broken_frames_are_refused_with_the_place() {
    let refused = |change: &dyn Fn(&mut Hand)| {
        let hand = Hand::strip(9).change(change);
        let table = table();
        match to_glb(&hand.frame(), &table, &breed(&table), &GlbOptions::default()) {
            Err(GlbError::Geometry(error)) => error,
            other => panic!("{:?}", other.map(|b| b.len())),
        }
    };
    let part = "skin";
    let nan = |what| GeometryError::NotFinite { part, vertex: 4, what };
    assert_eq!(refused(&|h| h.positions[4].x = f32::NAN), nan("position"));
    assert_eq!(refused(&|h| h.normals[4].y = f32::INFINITY), nan("normal"));
    assert_eq!(refused(&|h| h.colours[4].z = f32::NAN), nan("colour"));
    let index = GeometryError::Index { part, index: 9, n_vertices: 9 };
    assert_eq!(refused(&|h| h.topology().indices[3] = 9), index);
    let short = GeometryError::Length { part, what: "normals", found: 8, expected: 9 };
    assert_eq!(refused(&|h| h.normals.truncate(8)), short);
    for (start, count) in [(3, 21), (0, 20), (u32::MAX, 3), (30, 3)] {
        let error = refused(&|h| h.topology().ranges[0] = MaterialRange { material: Material::Coat, start, count });
        assert_eq!(error, GeometryError::Range { part, start, count, n_indices: 21 });
    }
}
