//! A moving head in the words of glTF: skin, targets, animations.

use super::Motion;
use super::joints::{JOINT_NAMES, N_JOINTS, NECK, PARENTS};
use super::targets::{Kind as TargetKind, Moved};
use crate::export::glb::{Kind, Writer};
use glam::{Quat, Vec3};
use gltf_json as json;
use json::accessor::{ComponentType, Type, sparse};
use json::animation::{Channel, Interpolation, Property, Sampler, Target as ChannelTarget};
use json::mesh::{MorphTarget, Semantic};
use json::scene::UnitQuaternion;
use json::validation::{Checked, USize64};
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Writes one head's motion.
pub(in crate::export) struct Mover<'a> {
    motion: &'a Motion,
    /// An accessor of so many zeros.
    zeros: BTreeMap<usize, json::Index<json::Accessor>>,
}

type Accessor = json::Index<json::Accessor>;

impl<'a> Mover<'a> {
    pub fn new(motion: &'a Motion) -> Self {
        Self { motion, zeros: BTreeMap::new() }
    }

    /// Joints, weights and targets of a primitive that has these vertices to draw of a part, ascending.
    pub fn primitive(
        &mut self,
        writer: &mut Writer,
        part: usize,
        vertices: &[usize],
        primitive: &mut json::mesh::Primitive,
    ) {
        let count = vertices.len();
        let (first_joint, first_weight) = (writer.len(Kind::Joints), writer.len(Kind::Weights));
        for &v in vertices {
            let influences = &self.motion.parts[part].influences[v];
            writer.bytes(Kind::Joints).extend(influences.joints);
            writer.bytes(Kind::Weights).extend(influences.weights.into_iter().flat_map(u16::to_le_bytes));
        }
        let joints = writer.accessor(Kind::Joints, first_joint, count, ComponentType::U8, Type::Vec4, None);
        let weights = writer.accessor(Kind::Weights, first_weight, count, ComponentType::U16, Type::Vec4, None);
        writer.root.accessors[weights.value()].normalized = true;
        primitive.attributes.insert(Checked::Valid(Semantic::Joints(0)), joints);
        primitive.attributes.insert(Checked::Valid(Semantic::Weights(0)), weights);

        let highest = vertices.last().map_or(0, |&v| v + 1);
        let mut own = vec![u32::MAX; highest];
        vertices.iter().enumerate().for_each(|(k, &v)| own[v] = k as u32);
        let mut out: Vec<MorphTarget> = Vec::with_capacity(self.motion.targets.len());
        for (k, target) in self.motion.targets.iter().enumerate() {
            let alike = self.motion.targets[..k].iter().position(|t| Arc::ptr_eq(&t.moved, &target.moved));
            let made = match alike {
                Some(alike) => out[alike].clone(),
                None => {
                    let inside = |m: &&Moved| own.get(m.vertex as usize).is_some_and(|&v| v != u32::MAX);
                    let moved: Vec<(u32, &Moved)> =
                        target.moved[part].iter().filter(inside).map(|m| (own[m.vertex as usize], m)).collect();
                    self.target(writer, count, &moved)
                }
            };
            out.push(made);
        }
        primitive.targets = (!out.is_empty()).then_some(out);
    }

    fn target(&mut self, writer: &mut Writer, count: usize, moved: &[(u32, &Moved)]) -> MorphTarget {
        let [positions, normals] = if moved.is_empty() {
            [self.zeros(writer, count); 2]
        } else if 2 * moved.len() >= count {
            let mut dense = |value: &dyn Fn(&Moved) -> Vec3, has_ends: bool| {
                let mut all = vec![Vec3::ZERO; count];
                moved.iter().for_each(|(v, m)| all[*v as usize] = value(m));
                let first = writer.len(Kind::Targets);
                all.iter().for_each(|d| push(writer.bytes(Kind::Targets), d.to_array()));
                let ends = has_ends.then(|| ends(&all));
                writer.accessor(Kind::Targets, first, count, ComponentType::F32, Type::Vec3, ends)
            };
            [dense(&|m| m.position, true), dense(&|m| m.normal, false)]
        } else {
            let wide = count > 65_535;
            let kind = if wide { Kind::SparseU32 } else { Kind::SparseU16 };
            let component = if wide { ComponentType::U32 } else { ComponentType::U16 };
            let first_index = writer.len(kind);
            for (v, _) in moved {
                if wide {
                    writer.bytes(kind).extend(v.to_le_bytes());
                } else {
                    writer.bytes(kind).extend((*v as u16).to_le_bytes());
                }
            }
            let mut sparse = |value: &dyn Fn(&Moved) -> Vec3, has_ends: bool| {
                let first = writer.len(Kind::SparseValues);
                let mut values: Vec<Vec3> = moved.iter().map(|(_, m)| value(m)).collect();
                values.iter().for_each(|d| push(writer.bytes(Kind::SparseValues), d.to_array()));
                // What is left out is 0.
                values.push(Vec3::ZERO);
                let ends = has_ends.then(|| ends(&values));
                let accessor = writer.accessor(Kind::Zeros, 0, count, ComponentType::F32, Type::Vec3, ends);
                writer.zeros(count);
                writer.root.accessors[accessor.value()].sparse = Some(sparse::Sparse {
                    count: USize64::from(moved.len()),
                    indices: sparse::Indices {
                        buffer_view: view(kind),
                        byte_offset: USize64::from(first_index),
                        component_type: Checked::Valid(json::accessor::IndexComponentType(component)),
                        extensions: None,
                        extras: None,
                    },
                    values: sparse::Values {
                        buffer_view: view(Kind::SparseValues),
                        byte_offset: USize64::from(first),
                        extensions: None,
                        extras: None,
                    },
                    extensions: None,
                    extras: None,
                });
                accessor
            };
            [sparse(&|m| m.position, true), sparse(&|m| m.normal, false)]
        };
        MorphTarget { positions: Some(positions), normals: Some(normals), tangents: None }
    }

    fn zeros(&mut self, writer: &mut Writer, count: usize) -> Accessor {
        *self.zeros.entry(count).or_insert_with(|| {
            writer.zeros(count);
            let ends = ends(&[Vec3::ZERO]);
            writer.accessor(Kind::Zeros, 0, count, ComponentType::F32, Type::Vec3, Some(ends))
        })
    }

    /// Names of the targets, as clients look for them, and weights at rest.
    pub fn mesh(&self, mesh: &mut json::Mesh) -> Result<(), serde_json::Error> {
        let names: Vec<&str> = self.motion.targets.iter().map(|t| t.name.as_str()).collect();
        if !names.is_empty() {
            mesh.weights = Some(vec![0.0; names.len()]);
            mesh.extras = Some(serde_json::value::to_raw_value(&BTreeMap::from([("targetNames", names)]))?);
        }
        Ok(())
    }

    /// What the root says of it, flat.
    pub fn extras(&self, extras: &mut BTreeMap<&str, Value>) {
        let of_kind = |kind| -> String {
            let all = self.motion.targets.iter().filter(|t| t.kind == kind).map(|t| t.name.as_str());
            all.collect::<Vec<&str>>().join(" ")
        };
        let names = [
            ("londra_targets_with_joints", of_kind(TargetKind::Corrective)),
            ("londra_targets_without_joints", of_kind(TargetKind::WithoutJoints)),
        ];
        for (key, names) in names.into_iter().filter(|(_, names)| !names.is_empty()) {
            extras.insert(key, names.into());
        }
    }

    /// Joints and skin; the root of the joints. `meshes`: nodes that are skinned.
    pub fn skeleton(&self, writer: &mut Writer, meshes: &[json::Index<json::Node>]) -> json::Index<json::Node> {
        let first = writer.root.nodes.len();
        let node = |joint: usize| json::Index::new((first + joint) as u32);
        for joint in 0..N_JOINTS {
            let children: Vec<json::Index<json::Node>> =
                (0..N_JOINTS).filter(|&j| PARENTS[j] == Some(joint)).map(node).collect();
            let from = PARENTS[joint].map_or(Vec3::ZERO, |parent| self.motion.joints[parent]);
            writer.root.nodes.push(json::Node {
                name: Some(JOINT_NAMES[joint].to_owned()),
                children: (!children.is_empty()).then_some(children),
                translation: Some((self.motion.joints[joint] - from).to_array()),
                rotation: Some(UnitQuaternion(Quat::IDENTITY.to_array())),
                ..Default::default()
            });
        }
        let start = writer.len(Kind::Binds);
        for at in &self.motion.joints {
            let bind = glam::Mat4::from_translation(-*at);
            push(writer.bytes(Kind::Binds), bind.to_cols_array());
        }
        let binds = writer.accessor(Kind::Binds, start, N_JOINTS, ComponentType::F32, Type::Mat4, None);
        let skin = writer.root.push(json::Skin {
            inverse_bind_matrices: Some(binds),
            joints: (0..N_JOINTS).map(node).collect(),
            name: Some("londra_skin".to_owned()),
            skeleton: Some(node(NECK)),
            extensions: None,
            extras: None,
        });
        for mesh in meshes {
            writer.root.nodes[mesh.value()].skin = Some(skin);
        }
        node(NECK)
    }

    /// `neck`: the root of the joints; `meshes`: nodes with targets.
    pub fn animations(
        &self,
        writer: &mut Writer,
        neck: json::Index<json::Node>,
        meshes: &[json::Index<json::Node>],
    ) -> Result<(), serde_json::Error> {
        for clip in &self.motion.clips {
            let mut animation = Reel::default();
            let node = |joint: usize| json::Index::new((neck.value() - NECK + joint) as u32);
            for track in &clip.rotations {
                let values: Vec<f32> = track.values.iter().flat_map(|q| q.to_array()).collect();
                let sampler = animation.sampler(writer, &track.times, &values, Type::Vec4);
                animation.channel(sampler, node(track.joint), Property::Rotation);
            }
            for track in &clip.translations {
                let values: Vec<f32> = track.values.iter().flat_map(|v| v.to_array()).collect();
                let sampler = animation.sampler(writer, &track.times, &values, Type::Vec3);
                animation.channel(sampler, node(track.joint), Property::Translation);
            }
            let (times, weights) = &clip.weights;
            if !times.is_empty() {
                let sampler = animation.sampler(writer, times, weights, Type::Scalar);
                for &mesh in meshes {
                    animation.channel(sampler, mesh, Property::MorphTargetWeights);
                }
            }
            let extras =
                clip.repeats.then(|| serde_json::value::to_raw_value(&BTreeMap::from([("londra_repeats", true)])));
            writer.root.push(json::Animation {
                name: Some(clip.name.clone()),
                channels: animation.channels,
                samplers: animation.samplers,
                extensions: None,
                extras: extras.transpose()?,
            });
        }
        Ok(())
    }
}

/// An animation in the making.
#[derive(Default)]
struct Reel {
    samplers: Vec<Sampler>,
    channels: Vec<Channel>,
    /// Accessors of times that are there already.
    times: Vec<(Vec<f32>, Accessor)>,
}

impl Reel {
    fn sampler(&mut self, writer: &mut Writer, times: &[f32], values: &[f32], type_: Type) -> json::Index<Sampler> {
        let known = self.times.iter().find(|(known, _)| known == times).map(|(_, accessor)| *accessor);
        let input = known.unwrap_or_else(|| {
            let first = writer.len(Kind::Keys);
            push(writer.bytes(Kind::Keys), times.iter().copied());
            let end = |t: Option<&f32>| -> Value { vec![t.copied().unwrap_or(0.0)].into() };
            let ends = Some((end(times.first()), end(times.last())));
            let made = writer.accessor(Kind::Keys, first, times.len(), ComponentType::F32, Type::Scalar, ends);
            self.times.push((times.to_vec(), made));
            made
        });
        let first = writer.len(Kind::Keys);
        push(writer.bytes(Kind::Keys), values.iter().copied());
        let count = values.len() / type_.multiplicity();
        let output = writer.accessor(Kind::Keys, first, count, ComponentType::F32, type_, None);
        let interpolation = Checked::Valid(Interpolation::Linear);
        self.samplers.push(Sampler { input, output, interpolation, extensions: None, extras: None });
        json::Index::new(self.samplers.len() as u32 - 1)
    }

    fn channel(&mut self, sampler: json::Index<Sampler>, node: json::Index<json::Node>, path: Property) {
        let target = ChannelTarget { node, path: Checked::Valid(path), extensions: None, extras: None };
        self.channels.push(Channel { sampler, target, extensions: None, extras: None });
    }
}

/// Stands for the view of a kind until those are known.
fn view(kind: Kind) -> json::Index<json::buffer::View> {
    json::Index::new(kind as u32)
}

fn push(bytes: &mut Vec<u8>, values: impl IntoIterator<Item = f32>) {
    bytes.extend(values.into_iter().flat_map(f32::to_le_bytes));
}

fn ends(values: &[Vec3]) -> (Value, Value) {
    let low = values.iter().fold(Vec3::INFINITY, |a, &d| a.min(d));
    let high = values.iter().fold(Vec3::NEG_INFINITY, |a, &d| a.max(d));
    (low.to_array().into(), high.to_array().into())
}
