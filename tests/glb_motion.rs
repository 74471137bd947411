//! Exported heads that move, read back with the `gltf` crate, moved as a client moves them, and held against the head that
//! the program itself poses.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;

use glam::{Mat4, Quat, Vec3};
use gltf::animation::util::ReadOutputs;
use londra::anatomy::Breed;
use londra::export::motion::{JOINT_NAMES, Kind, Motion, N_JOINTS, Selection, Source};
use londra::export::{GlbError, GlbOptions, to_glb};
use londra::frame::{Frame, Layers, Part, Pipeline};
use londra::motion::{Activation, Library, Pose, Side};
use settings::World;
use std::collections::BTreeMap;

const LEVEL: u32 = 2;
/// A head with upright ears, one with ears that hang, a flat face.
const BREEDS: [&str; 3] = ["german_shepherd", "beagle", "pug"];

fn library() -> Library {
    Library::embedded().unwrap_or_else(|e| panic!("{e}"))
}

fn pipeline(world: &World) -> Pipeline {
    at_level(world, LEVEL)
}

fn at_level(world: &World, level: u32) -> Pipeline {
    let mut pipeline = world.pipeline(level, 0);
    pipeline.set_uv(true).unwrap();
    let inside = Layers { teeth: true, mouth: true, tongue: true, ..Layers::default() };
    pipeline.set_layers(inside).unwrap();
    pipeline
}

fn exported(world: &World, pipeline: &mut Pipeline, dog: &Breed, units: &str, clips: &str) -> (Vec<u8>, Motion) {
    let library = library();
    let selection = Selection::parse(&library, units, clips).unwrap_or_else(|e| panic!("{e}"));
    let motion = Motion::bake(pipeline, dog, &library, &selection);
    let options = GlbOptions { motion: Some(motion.clone()), ..GlbOptions::default() };
    (to_glb(&pipeline.frame(), &world.table, dog, &options).unwrap_or_else(|e| panic!("{e}")), motion)
}

// ---- a client ----

/// A primitive as a client has it in its memory.
struct Primitive {
    mesh: String,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    joints: Vec<[u16; 4]>,
    weights: Vec<[f32; 4]>,
    /// Of each target.
    moved: Vec<[Vec<Vec3>; 2]>,
}

struct Client {
    document: gltf::Document,
    buffers: Vec<gltf::buffer::Data>,
    primitives: Vec<Primitive>,
    names: Vec<String>,
    binds: Vec<Mat4>,
}

/// What moves at a moment: a turn and a place for each joint, a weight for each target.
#[derive(Clone)]
struct State {
    turns: [Quat; N_JOINTS],
    places: [Vec3; N_JOINTS],
    weights: Vec<f32>,
}

impl Client {
    fn new(glb: &[u8]) -> Self {
        let (document, buffers, _) = gltf::import_slice(glb).unwrap_or_else(|e| panic!("{e}"));
        let mut primitives = Vec::new();
        let mut names: Option<Vec<String>> = None;
        for mesh in document.meshes() {
            let extras: serde_json::Value =
                mesh.extras().as_ref().map_or(serde_json::Value::Null, |e| serde_json::from_str(e.get()).unwrap());
            let own: Vec<String> = extras["targetNames"]
                .as_array()
                .map_or(Vec::new(), |all| all.iter().map(|name| name.as_str().unwrap().to_owned()).collect());
            assert!(names.as_ref().is_none_or(|names| *names == own), "meshes differ in their targets");
            names = Some(own);
            for primitive in mesh.primitives() {
                let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| &data.0[..]));
                let vectors = |all: Vec<[f32; 3]>| all.into_iter().map(Vec3::from).collect::<Vec<Vec3>>();
                let moved = reader.read_morph_targets().map(|(positions, normals, tangents)| {
                    assert!(tangents.is_none());
                    [positions.unwrap().collect(), normals.unwrap().collect()].map(vectors)
                });
                primitives.push(Primitive {
                    mesh: mesh.name().unwrap().to_owned(),
                    positions: vectors(reader.read_positions().unwrap().collect()),
                    normals: vectors(reader.read_normals().unwrap().collect()),
                    joints: reader.read_joints(0).unwrap().into_u16().collect(),
                    weights: reader.read_weights(0).unwrap().into_f32().collect(),
                    moved: moved.collect(),
                });
            }
        }
        let skin = document.skins().next().unwrap();
        let reader = skin.reader(|buffer| buffers.get(buffer.index()).map(|data| &data.0[..]));
        let binds = reader.read_inverse_bind_matrices().unwrap().map(|m| Mat4::from_cols_array_2d(&m)).collect();
        Self { primitives, names: names.unwrap(), binds, document, buffers }
    }

    fn joints(&self) -> Vec<gltf::Node<'_>> {
        self.document.skins().next().unwrap().joints().collect()
    }

    fn rest(&self) -> State {
        let parts: Vec<_> = self.joints().iter().map(|node| node.transform().decomposed()).collect();
        State {
            turns: std::array::from_fn(|j| Quat::from_array(parts[j].1)),
            places: std::array::from_fn(|j| Vec3::from(parts[j].0)),
            weights: vec![0.0; self.names.len()],
        }
    }

    /// Plays an animation at a time.
    fn at(&self, animation: &str, time: f32) -> State {
        let mut state = self.rest();
        let animation = self.document.animations().find(|a| a.name() == Some(animation)).expect("an animation");
        let joints: Vec<usize> = self.joints().iter().map(|node| node.index()).collect();
        for channel in animation.channels() {
            let reader = channel.reader(|buffer| self.buffers.get(buffer.index()).map(|data| &data.0[..]));
            let times: Vec<f32> = reader.read_inputs().unwrap().collect();
            let next = times.partition_point(|t| *t <= time).clamp(1, times.len().max(2) - 1).min(times.len() - 1);
            let before = next.saturating_sub(1);
            let part = match times[next] - times[before] {
                span if span > 0.0 => ((time - times[before]) / span).clamp(0.0, 1.0),
                _ => 0.0,
            };
            let joint = joints.iter().position(|&j| j == channel.target().node().index());
            match reader.read_outputs().unwrap() {
                ReadOutputs::Rotations(all) => {
                    let all: Vec<Quat> = all.into_f32().map(Quat::from_array).collect();
                    state.turns[joint.unwrap()] = all[before].slerp(all[next], part);
                }
                ReadOutputs::Translations(all) => {
                    let all: Vec<Vec3> = all.map(Vec3::from).collect();
                    state.places[joint.unwrap()] = all[before].lerp(all[next], part);
                }
                ReadOutputs::MorphTargetWeights(all) => {
                    let all: Vec<f32> = all.into_f32().collect();
                    let n = self.names.len();
                    state.weights =
                        (0..n).map(|k| all[before * n + k] * (1.0 - part) + all[next * n + k] * part).collect();
                }
                ReadOutputs::Scales(_) => panic!("a joint grows"),
            }
        }
        state
    }

    /// Positions and normals of a primitive: first targets, then joints.
    fn moved(&self, primitive: &Primitive, state: &State) -> Vec<(Vec3, Vec3)> {
        let nodes = self.joints();
        let mut world = vec![Mat4::IDENTITY; N_JOINTS];
        for (j, node) in nodes.iter().enumerate() {
            let parent = nodes.iter().position(|n| n.children().any(|c| c.index() == node.index()));
            let own = Mat4::from_rotation_translation(state.turns[j], state.places[j]);
            world[j] = parent.map_or(Mat4::IDENTITY, |p| world[p]) * own;
        }
        let skin: Vec<Mat4> = world.iter().zip(&self.binds).map(|(world, bind)| *world * *bind).collect();
        let active: Vec<usize> = (0..self.names.len()).filter(|&k| state.weights[k] != 0.0).collect();
        (0..primitive.positions.len())
            .map(|v| {
                let (mut p, mut n) = (primitive.positions[v], primitive.normals[v]);
                for &k in &active {
                    p += primitive.moved[k][0][v] * state.weights[k];
                    n += primitive.moved[k][1][v] * state.weights[k];
                }
                let mut blend = Mat4::ZERO;
                for (&joint, &weight) in primitive.joints[v].iter().zip(&primitive.weights[v]) {
                    blend += skin[usize::from(joint)] * weight;
                }
                (blend.transform_point3(p), blend.transform_vector3(n).normalize_or_zero())
            })
            .collect()
    }
}

/// Vertices to draw of a part in the order of its primitives: positions and normals.
fn drawn(frame: &Frame<'_>) -> Vec<(String, Vec<(Vec3, Vec3)>)> {
    let value = |part: &Part<'_>, values: &[Vec3], v: usize| {
        let [a, b] = part.uv.map_or([v as u32; 2], |uv| uv.vertices[v]).map(|v| values[v as usize]);
        if a == b { a } else { 0.5 * (a + b) }
    };
    let mut out = Vec::new();
    for part in &frame.parts {
        let ranges = part.uv.map_or(&part.topology.ranges, |uv| &uv.ranges);
        let indices = part.uv.map_or(&part.topology.indices, |uv| &uv.indices);
        for range in ranges.iter().filter(|r| r.count > 0) {
            let own = &indices[range.start as usize..(range.start + range.count) as usize];
            let used: std::collections::BTreeSet<u32> = own.iter().copied().collect();
            let all = used.into_iter().map(|v| v as usize);
            let values =
                all.map(|v| (value(part, part.positions, v), value(part, part.normals, v).normalize_or_zero()));
            out.push((part.topology.name.to_owned(), values.collect()));
        }
    }
    out
}

/// How far a client's head is from the program's, millimetres: at most and where, in the mean, and at most of whiskers,
/// which turn with the skin at their roots; normals, parts of their length.
#[derive(Debug, Default)]
struct Apart {
    most: f32,
    part: String,
    mean: f32,
    whiskers: f32,
    normal: f32,
}

fn apart(client: &Client, state: &State, frame: &Frame<'_>) -> Apart {
    let wanted = drawn(frame);
    assert_eq!(wanted.len(), client.primitives.len());
    let mut out = Apart::default();
    let mut n = 0;
    for (primitive, (name, wanted)) in client.primitives.iter().zip(&wanted) {
        assert_eq!((&primitive.mesh, primitive.positions.len()), (name, wanted.len()));
        for ((p, normal), (q, wanted)) in client.moved(primitive, state).into_iter().zip(wanted) {
            let d = 1000.0 * p.distance(*q);
            if name == "whiskers" {
                out.whiskers = out.whiskers.max(d);
                continue;
            }
            if d > out.most {
                (out.most, out.part) = (d, name.clone());
            }
            out.normal = out.normal.max(normal.distance(*wanted));
            out.mean += d;
            n += 1;
        }
    }
    out.mean /= n as f32;
    out
}

fn alone(library: &Library, unit: usize, side: Side, strength: f32) -> Pose {
    let mut asked = Activation::default();
    asked.set(unit, side, strength);
    library.limits.clamped(&library.units.drive(&asked))
}

// ---- what is in the file ----

#[test]
fn a_unit_looks_other_in_a_client() {
    let (world, library) = (World::embedded(), library());
    let mut worst = [0.0_f32; 2];
    let mut faults: Vec<String> = Vec::new();
    println!(
        "{:<62} {:>7} {:>9} {:>9} {:>8} {:>8} {:>8}",
        "difference, mm", "at 1", "at half", "mean", "whiskers", "at half", "normals"
    );
    for id in BREEDS {
        let dog = world.breed(id);
        let mut pipeline = pipeline(&world);
        let (glb, motion) = exported(&world, &mut pipeline, dog, "all", "none");
        let client = Client::new(&glb);
        let number = |unit: usize| format!("{}_", library.units.units[unit].id);
        let unit_of = |reel: &str| {
            // AU109_110 begins with no other unit's id and a letter.
            let is_own = |unit: &usize| {
                reel.strip_prefix(&number(*unit)).is_some_and(|name| name.starts_with(|c: char| c.is_ascii_lowercase()))
            };
            (0..library.units.units.len()).find(is_own).unwrap_or_else(|| panic!("{reel} is of no unit"))
        };
        let reels: Vec<(usize, String)> = motion.clips.iter().map(|c| (unit_of(&c.name), c.name.clone())).collect();
        for (unit, spec) in library.units.units.iter().enumerate() {
            assert_eq!(reels.iter().any(|(of, _)| *of == unit), !spec.drives.is_empty(), "{}", spec.id);
        }
        for (unit, reel) in reels {
            let side = match &reel[reel.len() - 2..] {
                "_L" => Side::Left,
                "_R" => Side::Right,
                _ => Side::Both,
            };
            let mut at = |strength: f32| {
                pipeline.set_pose(alone(&library, unit, side, strength));
                apart(&client, &client.at(&reel, strength), &pipeline.update(dog))
            };
            let (rest, half, full) = (at(0.0), at(0.5), at(1.0));
            let name = format!("{id} {reel}");
            println!(
                "{name:<62} {:7.3} {:9.3} {:9.4} {:8.2} {:8.2} {:8.3}  {}",
                full.most, half.most, half.mean, full.whiskers, half.whiskers, full.normal, half.part
            );
            let mut hold = |holds: bool| {
                if !holds {
                    faults.push(name.clone())
                }
            };
            hold(rest.most < 0.001 && rest.whiskers < 0.001);
            // Both sides' normals in the median plane are a sum before they are made unit.
            // A lower lip that comes to the bone in the median plane from both sides is pushed off it once.
            hold(full.most < 0.15 && full.normal < 0.6);
            hold(half.most < 5.5 && half.mean < 0.3);
            hold(full.whiskers < 3.0 && half.whiskers < 12.0);
            worst = [worst[0].max(full.most), worst[1].max(half.most)];
        }
        // What needs no joints is there without them, side by side.
        for (k, target) in motion.targets.iter().enumerate().filter(|(_, t)| t.kind != Kind::Corrective) {
            let Source::Unit(unit) = target.source else { continue };
            let mut state = client.rest();
            state.weights[k] = 1.0;
            pipeline.set_pose(alone(&library, unit, target.side, 1.0));
            let apart = apart(&client, &state, &pipeline.update(dog));
            if apart.most > 0.05 || apart.normal > 0.02 || apart.whiskers > 0.05 {
                faults.push(format!("{id} {} by its weight alone: {apart:?}", target.name));
            }
        }
    }
    println!("at most {} mm at 1, {} mm at half", worst[0], worst[1]);
    assert!(faults.is_empty(), "{faults:?}");
}

#[test]
fn an_animation_plays_other_in_a_client() {
    let (world, library) = (World::embedded(), library());
    let mut faults: Vec<String> = Vec::new();
    for id in BREEDS {
        let dog = world.breed(id);
        let mut pipeline = pipeline(&world);
        let (glb, motion) = exported(&world, &mut pipeline, dog, "all", "all");
        let client = Client::new(&glb);
        let seconds = |name: &str| {
            let expression = library.expression(name).map(|e| e.seconds());
            expression.or_else(|| library.clip(name).map(|c| c.seconds))
        };
        for clip in motion.clips.iter().filter(|c| seconds(&c.name).is_some()) {
            let mut worst = Apart::default();
            for step in 0..=4 {
                // On samples, as clients show the still frames in between as lines.
                let time = (seconds(&clip.name).unwrap() * f64::from(step) / 4.0 * 30.0).floor() / 30.0;
                let moment = match library.expression(&clip.name) {
                    Some(expression) => expression.moment(time),
                    None => library.clip(&clip.name).unwrap().at(time),
                };
                pipeline.set_pose(library.pose(&moment, time, |_| ()));
                let apart = apart(&client, &client.at(&clip.name, time as f32), &pipeline.update(dog));
                if apart.most > worst.most {
                    (worst.most, worst.part) = (apart.most, apart.part);
                }
                worst.mean = worst.mean.max(apart.mean);
                worst.whiskers = worst.whiskers.max(apart.whiskers);
            }
            let (name, Apart { most, part, mean, whiskers, .. }) = (&clip.name, worst);
            println!("{id:<16} {name:<24} {most:7.3} mm, {mean:7.4} in the mean, whiskers {whiskers:6.2}  {part}");
            // Skin that keeps off the turning mandible, and a tongue of four joints, are no sums of shapes.
            if most > 6.5 || mean > 0.3 || whiskers > 15.0 {
                faults.push(format!("{id} {name}"));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:?}");
}

/// Folds are there from level 3 on.
#[test]
fn a_head_with_folds_cannot_be_exported_or_rests_elsewhere() {
    let world = World::embedded();
    for id in ["pug", "shar_pei"] {
        let mut pipeline = at_level(&world, 3);
        let (glb, _) = exported(&world, &mut pipeline, world.breed(id), "AU26,AU101", "none");
        let client = Client::new(&glb);
        assert!(apart(&client, &client.rest(), &pipeline.frame()).most < 0.001, "{id}");
    }
}

#[test]
fn targets_joints_or_animations_break_a_rule() {
    let world = World::embedded();
    let mut pipeline = pipeline(&world);
    let (glb, motion) = exported(&world, &mut pipeline, world.breed("beagle"), "all", "all");
    let client = Client::new(&glb);
    let animations: Vec<&str> = motion.clips.iter().map(|c| c.name.as_str()).collect();
    let nodes: Vec<&str> = client.document.nodes().map(|n| n.name().unwrap()).collect();
    for names in [client.names.iter().map(String::as_str).collect(), animations, nodes] {
        let mut seen: Vec<String> = Vec::new();
        for name in names {
            assert!(name.len() <= 63 && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_'), "{name}");
            let plain = name.to_ascii_lowercase();
            assert!(!seen.contains(&plain), "{name} is there twice, case aside");
            seen.push(plain);
        }
    }
    for name in
        ["AU101_innerBrowRaiser_L", "AU26_jawDrop", "AU26_jawDrop_corrective", "EAD103_earsFlattener_corrective_R"]
    {
        assert!(client.names.iter().any(|n| n == name), "no target {name}");
    }
    for name in ["yawn", "blink", "happiness", "AU27_mouthStretch"] {
        assert!(client.document.animations().any(|a| a.name() == Some(name)), "no animation {name}");
    }

    // Joints: the skin's list, unmoved at rest, each bound where it is.
    let joints = client.joints();
    assert_eq!(joints.iter().map(|j| j.name().unwrap()).collect::<Vec<_>>(), JOINT_NAMES);
    let rest = client.rest();
    assert!(rest.turns.iter().all(|q| *q == Quat::IDENTITY));
    let frame = pipeline.frame();
    assert!(apart(&client, &rest, &frame).most < 0.001);
    assert_eq!(client.document.skins().count(), 1);
    let scene = client.document.default_scene().unwrap();
    for node in client.document.nodes().filter(|n| n.mesh().is_some()) {
        assert!(node.skin().is_some() && scene.nodes().any(|root| root.index() == node.index()), "{:?}", node.name());
        assert!(node.mesh().unwrap().weights().unwrap().iter().all(|w| *w == 0.0));
    }
    for primitive in &client.primitives {
        for (joints, weights) in primitive.joints.iter().zip(&primitive.weights) {
            assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-6, "{weights:?}");
            for (k, (joint, weight)) in joints.iter().zip(weights).enumerate() {
                assert!(usize::from(*joint) < N_JOINTS && (*weight > 0.0 || *joint == 0));
                assert!(*weight == 0.0 || !joints[..k].contains(joint), "a joint twice: {joints:?} {weights:?}");
            }
        }
    }
    // Every target moves something.
    for (k, name) in client.names.iter().enumerate() {
        let moves = |p: &Primitive| p.moved[k][0].iter().any(|d| d.length() > 1e-5);
        assert!(client.primitives.iter().any(moves), "{name} moves nothing");
    }
    // Sparse data stands on zeros of its own.
    let json: serde_json::Value = {
        let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
        serde_json::from_slice(&glb[20..20 + length]).unwrap()
    };
    let sparse = json["accessors"].as_array().unwrap().iter().filter(|a| !a["sparse"].is_null());
    let mut n_sparse = 0;
    for accessor in sparse {
        let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        assert_eq!((view["name"].as_str(), view["byteStride"].as_u64()), (Some("zeros"), Some(12)));
        assert!(2 * accessor["sparse"]["count"].as_u64().unwrap() < accessor["count"].as_u64().unwrap());
        n_sparse += 1;
    }
    assert!(n_sparse > 100, "{n_sparse} sparse accessors");

    for animation in client.document.animations() {
        let mut targets = BTreeMap::new();
        for channel in animation.channels() {
            let path = format!("{:?}", channel.target().property());
            let key = (channel.target().node().index(), path);
            assert!(targets.insert(key, ()).is_none(), "{:?} has two channels for one thing", animation.name());
            let reader = channel.reader(|buffer| client.buffers.get(buffer.index()).map(|data| &data.0[..]));
            let times: Vec<f32> = reader.read_inputs().unwrap().collect();
            assert!(times[0] == 0.0 && times.windows(2).all(|t| t[0] < t[1]), "{:?}: {times:?}", animation.name());
            match reader.read_outputs().unwrap() {
                ReadOutputs::Rotations(all) => {
                    let all: Vec<Quat> = all.into_f32().map(Quat::from_array).collect();
                    assert!(all.iter().all(|q| (q.length() - 1.0).abs() < 1e-5));
                    assert!(all.windows(2).all(|q| q[0].dot(q[1]) >= 0.0), "the long way round");
                }
                ReadOutputs::MorphTargetWeights(all) => {
                    let all: Vec<f32> = all.into_f32().collect();
                    assert_eq!(all.len(), times.len() * client.names.len());
                    assert!(all.iter().all(|w| (0.0..=1.0).contains(w)), "{:?}", animation.name());
                }
                _ => {}
            }
        }
    }
}

#[test]
fn the_same_head_twice_has_other_bytes_or_a_still_one_joints() {
    let world = World::embedded();
    let dog = world.breed("pug");
    let [one, eight] = [1, 8].map(|threads| {
        let mut pipeline = pipeline(&world);
        pipeline.set_threads(threads);
        exported(&world, &mut pipeline, dog, "AU26,AU101,EAD103L", "blink").0
    });
    assert!(one == eight, "eight threads give other bytes than one");
    let client = Client::new(&one);
    assert!(client.names.iter().any(|n| n == "EAD103_earsFlattener_corrective_L"));
    assert!(!client.names.iter().any(|n| n == "EAD103_earsFlattener_corrective_R"));
    // A clip brings what it moves along, but no reel.
    assert!(
        client.names.iter().any(|n| n == "AU145_blink_R") && client.at("blink", 0.1).weights.iter().any(|w| *w > 0.5)
    );
    assert_eq!(client.document.animations().count(), 4);

    // Baking leaves the frame as it was, and what is not asked for is not there.
    let mut pipeline = pipeline(&world);
    let still = |pipeline: &mut Pipeline| {
        pipeline.update(dog);
        to_glb(&pipeline.frame(), &world.table, dog, &GlbOptions::default()).unwrap()
    };
    let before = still(&mut pipeline);
    let (_, motion) = exported(&world, &mut pipeline, dog, "AU27", "none");
    assert!(before == still(&mut pipeline), "baking motion moves the head");
    let (document, ..) = gltf::import_slice(&before).unwrap();
    assert_eq!((document.skins().count(), document.animations().count()), (0, 0));
    // Motion of another level is none of this head.
    pipeline.set_level(1).unwrap();
    pipeline.update(dog);
    let options = GlbOptions { motion: Some(motion), ..GlbOptions::default() };
    let error = to_glb(&pipeline.frame(), &world.table, dog, &options).unwrap_err();
    assert!(matches!(error, GlbError::Motion(_)), "{error}");
}

#[test]
fn a_name_that_nothing_has_is_taken_or_the_nearest_is_not_told() {
    let library = library();
    let error = |units: &str, clips: &str| Selection::parse(&library, units, clips).unwrap_err().to_string();
    assert!(error("AU26,AU102", "none").contains("AU101"), "{}", error("AU26,AU102", "none"));
    assert!(error("none", "yaun").contains("yawn"), "{}", error("none", "yaun"));
    assert!(error("AD50", "none").contains("bark"), "{}", error("AD50", "none"));
    assert!(error("AU26L", "none").contains("AU26"));
    assert!(Selection::parse(&library, "none", "none").unwrap().is_empty());
    let both = Selection::parse(&library, "EAD103R, EAD103L", "yawn,happiness,yawn").unwrap();
    assert_eq!((both.units.len(), both.units[0].1), (1, Side::Both));
    assert_eq!((both.expressions.len(), both.clips.len()), (1, 1));
}
