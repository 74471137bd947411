//! A frame as one binary glTF 2.0 file.
//!
//! Metres, +Y up, nose towards +Z, the dog's left at +X: glTF's own frame, so nothing is converted. The root node
//! `londra_head` carries the breed in its extras as flat scalars (nested values abort some importers) and has one child per
//! part. The same frame, table and breed give the same bytes: no clock, no hash map, keys in a fixed order.
//!
//! The container is written by hand (glTF 2.0 specification, "GLB File Format Specification"), the JSON by `gltf-json`.

use super::geometry::{Geometry, GeometryError, PrimitiveData};
use super::materials::{self, Maps};
use super::motion::{Motion, Mover};
use super::textures::Textures;
use crate::anatomy::{Breed, ParamTable, save_breed};
use crate::frame::{Frame, Material, MaterialRange, Part};
use gltf_json as json;
use json::accessor::{ComponentType, GenericComponentType, Type};
use json::buffer::{Stride, Target};
use json::validation::{Checked, USize64};
use serde_json::Value;
use std::collections::BTreeMap;

/// Version of what the extras mean (`londra_schema`).
pub const SCHEMA: u32 = 1;

/// What a file may hold beside the head.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GlbOptions {
    /// `asset.copyright`; also in the root's extras, since some tools drop it from the asset.
    pub copyright: Option<String>,
    /// The frame's textures: what has them has no colours at its vertices.
    pub textures: Option<Textures>,
    /// How the frame, which is at rest, moves: joints, targets and animations.
    pub motion: Option<Motion>,
}

/// Why a head cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum GlbError {
    /// The frame is broken.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// A .glb holds at most 4 GiB.
    #[error("the head has {bytes} bytes, a .glb holds at most {}: lower the level", u32::MAX)]
    TooLarge {
        /// Size of the file.
        bytes: usize,
    },
    /// Textures of another frame.
    #[error("the textures are those of a skin of {found} vertices, the frame's has {expected}")]
    Textures {
        /// Vertices that the textures are of.
        found: usize,
        /// Vertices to draw of the frame's skin.
        expected: usize,
    },
    /// Motion of another frame.
    #[error("the motion is that of another head: {0} has other vertices to draw, or is not there")]
    Motion(String),
    /// The JSON could not be written.
    #[error("the glTF description could not be written: {0}")]
    Json(#[from] serde_json::Error),
}

/// Writes a frame and the breed it shows.
///
/// # Errors
/// A frame with values that are not finite or do not fit together; textures of another frame; more than 4 GiB.
pub fn to_glb(frame: &Frame<'_>, table: &ParamTable, breed: &Breed, options: &GlbOptions) -> Result<Vec<u8>, GlbError> {
    let mut writer = Writer::default();
    if let Some(textures) = &options.textures {
        writer.textures(textures);
    }
    let mut mover = options.motion.as_ref().map(|motion| fitting(motion, frame)).transpose()?;
    let mut children = writer.parts(frame, breed.look.fur, options.textures.as_ref(), mover.as_mut())?;
    // What is skinned stands beside the head, which cannot move it.
    let mut beside = Vec::new();
    if let Some(mover) = &mover {
        let neck = mover.skeleton(&mut writer, &children);
        mover.animations(&mut writer, neck, &children)?;
        beside = std::mem::replace(&mut children, vec![neck]);
    }
    let binary = writer.buffer();

    let mut root = writer.root;
    let extras = extras(table, breed, options, mover.as_ref())?;
    let nodes = &mut root.nodes;
    nodes.push(json::Node {
        name: Some("londra_head".to_owned()),
        children: (!children.is_empty()).then_some(children),
        extras: Some(extras),
        ..Default::default()
    });
    let head = json::Index::new(nodes.len() as u32 - 1);
    let nodes = std::iter::once(head).chain(beside).collect();
    root.scenes = vec![json::Scene { extensions: None, extras: None, name: Some("londra".to_owned()), nodes }];
    root.scene = Some(json::Index::new(0));
    root.asset.generator = Some(concat!("Londra ", env!("CARGO_PKG_VERSION")).to_owned());
    root.asset.copyright = options.copyright.clone();
    container(root.to_vec()?, binary)
}

/// The motion, if it is that of the frame.
fn fitting<'a>(motion: &'a Motion, frame: &Frame<'_>) -> Result<Mover<'a>, GlbError> {
    let n_drawn = |part: &Part<'_>| part.uv.map_or(part.topology.n_vertices, |uv| uv.vertices.len());
    for (k, part) in frame.parts.iter().enumerate() {
        let moving =
            motion.parts.get(k).filter(|m| m.name == part.topology.name && m.influences.len() == n_drawn(part));
        moving.ok_or_else(|| GlbError::Motion(part.topology.name.to_owned()))?;
    }
    Ok(Mover::new(motion))
}

/// Breed, values and origin as flat scalars. Sorted by key.
fn extras(
    table: &ParamTable,
    breed: &Breed,
    options: &GlbOptions,
    mover: Option<&Mover<'_>>,
) -> Result<Box<serde_json::value::RawValue>, serde_json::Error> {
    let values: BTreeMap<&str, f64> =
        table.specs.iter().zip(&breed.values).map(|(spec, &si)| (spec.id.as_str(), spec.from_si(si))).collect();
    let mut extras: BTreeMap<&str, Value> = BTreeMap::new();
    extras.insert("londra_breed", breed.id.as_str().into());
    extras.insert("londra_label", breed.label.as_str().into());
    extras.insert("londra_origin", "midway between the mandibular condyles".into());
    extras.insert("londra_params", serde_json::to_string(&values)?.into());
    // The whole design: this text, saved as a .ron file, is the breed again.
    extras.insert("londra_ron", save_breed(table, breed).into());
    extras.insert("londra_schema", SCHEMA.into());
    if let Some(copyright) = &options.copyright {
        extras.insert("londra_copyright", copyright.as_str().into());
    }
    if let Some(mover) = mover {
        mover.extras(&mut extras);
    }
    serde_json::value::to_raw_value(&extras)
}

/// The kinds of data, in the order in which they lie in the buffer; pictures come behind them.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Positions,
    Normals,
    Tangents,
    Colours,
    Uvs,
    IndicesU16,
    IndicesU32,
    Joints,
    Weights,
    Targets,
    /// What sparse data stands on.
    Zeros,
    SparseValues,
    SparseU16,
    SparseU32,
    Binds,
    Keys,
}

/// Name, stride and use of each kind's view.
const VIEWS: [(&str, Option<usize>, Option<Target>); 16] = [
    ("positions", Some(12), Some(Target::ArrayBuffer)),
    ("normals", Some(12), Some(Target::ArrayBuffer)),
    ("tangents", Some(16), Some(Target::ArrayBuffer)),
    ("colours", Some(4), Some(Target::ArrayBuffer)),
    ("uvs", Some(8), Some(Target::ArrayBuffer)),
    ("indices_u16", None, Some(Target::ElementArrayBuffer)),
    ("indices_u32", None, Some(Target::ElementArrayBuffer)),
    ("joints", Some(4), Some(Target::ArrayBuffer)),
    ("weights", Some(8), Some(Target::ArrayBuffer)),
    ("targets", Some(12), Some(Target::ArrayBuffer)),
    ("zeros", Some(12), Some(Target::ArrayBuffer)),
    ("sparse_values", None, None),
    ("sparse_indices_u16", None, None),
    ("sparse_indices_u32", None, None),
    ("inverse_binds", None, None),
    ("keys", None, None),
];
/// Kinds that are gathered with the geometry; the others come behind them.
const N_GEOMETRY: usize = Kind::Joints as usize;

#[derive(Default)]
pub(super) struct Writer {
    pub(super) root: json::Root,
    geometry: Geometry,
    /// Of the kinds behind the geometry.
    motion: [Vec<u8>; VIEWS.len() - N_GEOMETRY],
    materials: BTreeMap<Material, json::Index<json::Material>>,
    /// Accessors and the kind of data each points into; the views are known only at the end.
    kinds: Vec<Kind>,
    /// The file of each image of the document.
    images: Vec<Vec<u8>>,
    skin: Option<Maps>,
    eye: Option<Maps>,
}

impl Writer {
    /// Images and textures; the materials that are made afterwards have them.
    fn textures(&mut self, textures: &Textures) {
        let sampler = self.root.push(json::texture::Sampler {
            mag_filter: Some(Checked::Valid(json::texture::MagFilter::Linear)),
            min_filter: Some(Checked::Valid(json::texture::MinFilter::LinearMipmapLinear)),
            wrap_s: Checked::Valid(json::texture::WrappingMode::ClampToEdge),
            wrap_t: Checked::Valid(json::texture::WrappingMode::ClampToEdge),
            ..Default::default()
        });
        let mut add = |name: &str, png: &[u8]| {
            self.images.push(png.to_vec());
            let source = self.root.push(json::Image {
                // Known when the data before it is complete.
                buffer_view: None,
                mime_type: Some(json::image::MimeType("image/png".to_owned())),
                name: Some(name.to_owned()),
                uri: None,
                extensions: None,
                extras: None,
            });
            let name = Some(name.to_owned());
            self.root.push(json::Texture { name, sampler: Some(sampler), source, extensions: None, extras: None })
        };
        let colour = add("skin_colour", &textures.skin_colour);
        let normal = Some(add("skin_normal", &textures.skin_normal));
        let eye = textures.eye_colour.as_ref().map(|png| add("eye_colour", png));
        self.skin = Some(Maps { colour, normal });
        self.eye = eye.map(|colour| Maps { colour, normal: None });
    }

    /// The textures of what is made of a material.
    fn maps(&self, material: Material) -> Option<Maps> {
        match material {
            Material::Coat | Material::Nose | Material::Lip | Material::Mouth => self.skin,
            Material::Sclera | Material::Iris | Material::Pupil => self.eye,
            _ => None,
        }
    }

    /// Meshes and nodes of all parts that have triangles.
    fn parts(
        &mut self,
        frame: &Frame<'_>,
        fur: f32,
        textures: Option<&Textures>,
        mut mover: Option<&mut Mover<'_>>,
    ) -> Result<Vec<json::Index<json::Node>>, GlbError> {
        // Materials stand in the order of the enum, whatever the order of the parts.
        let all = frame.parts.iter().flat_map(ranges).filter(|r| r.count > 0);
        let mut used: Vec<Material> = all.map(|r| r.material).collect();
        used.sort();
        used.dedup();
        for material in used {
            let index = self.root.push(materials::material(material, fur, self.maps(material).as_ref()));
            self.materials.insert(material, index);
        }
        self.name_extensions();

        let mut children = Vec::new();
        for (k, part) in frame.parts.iter().enumerate() {
            let mut primitives = Vec::new();
            let tangents = textures.and_then(|textures| textures.tangents_of(part));
            if let Some(found) = tangents.map(<[_]>::len) {
                let expected = part.uv.map_or(0, |uv| uv.vertices.len());
                if found != expected {
                    return Err(GlbError::Textures { found, expected });
                }
            }
            for range in ranges(part).iter().filter(|r| r.count > 0) {
                let coloured = part.uv.is_none() || self.maps(range.material).is_none();
                let data = self.geometry.push(part, range, tangents, coloured)?;
                let mut primitive = self.primitive(&data, range.material);
                if let Some(mover) = &mut mover {
                    mover.primitive(self, k, &data.vertices, &mut primitive);
                }
                primitives.push(primitive);
            }
            if primitives.is_empty() {
                continue;
            }
            let name = part.topology.name;
            let own = Some(name.to_owned());
            let mut mesh = json::Mesh { extensions: None, extras: None, name: own, primitives, weights: None };
            if let Some(mover) = &mover {
                mover.mesh(&mut mesh)?;
            }
            // Joints have the plain names where there are any, and no two nodes share one.
            let name = Some(if mover.is_some() { format!("mesh_{name}") } else { name.to_owned() });
            let mesh = Some(self.root.push(mesh));
            children.push(self.root.push(json::Node { name, mesh, ..Default::default() }));
        }
        Ok(children)
    }

    fn name_extensions(&mut self) {
        let extensions = self.root.materials.iter().filter_map(|m| m.extensions.as_ref());
        let mut names: Vec<String> = extensions.flat_map(|e| e.others.keys().cloned()).collect();
        names.sort();
        names.dedup();
        self.root.extensions_used = names;
    }

    fn primitive(&mut self, data: &PrimitiveData, material: Material) -> json::mesh::Primitive {
        let ends = Some((data.min.to_array().into(), data.max.to_array().into()));
        let (first, count) = (data.first_vertex, data.n_vertices);
        let float = ComponentType::F32;
        let position = self.accessor(Kind::Positions, first * 12, count, float, Type::Vec3, ends);
        let normal = self.accessor(Kind::Normals, first * 12, count, float, Type::Vec3, None);
        let colour = data.first_colour_byte.map(|first| {
            let colour = self.accessor(Kind::Colours, first, count, ComponentType::U8, Type::Vec4, None);
            self.root.accessors[colour.value()].normalized = true;
            colour
        });
        let (kind, component) = match data.wide {
            true => (Kind::IndicesU32, ComponentType::U32),
            false => (Kind::IndicesU16, ComponentType::U16),
        };
        let ends = Some((vec![0].into(), vec![data.max_index].into()));
        let indices = self.accessor(kind, data.first_index_byte, data.n_indices, component, Type::Scalar, ends);
        let mut attributes = BTreeMap::from([
            (Checked::Valid(json::mesh::Semantic::Positions), position),
            (Checked::Valid(json::mesh::Semantic::Normals), normal),
        ]);
        if let Some(colour) = colour {
            attributes.insert(Checked::Valid(json::mesh::Semantic::Colors(0)), colour);
        }
        if let Some(first) = data.first_tangent_byte {
            let tangent = self.accessor(Kind::Tangents, first, count, float, Type::Vec4, None);
            attributes.insert(Checked::Valid(json::mesh::Semantic::Tangents), tangent);
        }
        if let Some(first) = data.first_uv_byte {
            let uv = self.accessor(Kind::Uvs, first, count, float, Type::Vec2, None);
            attributes.insert(Checked::Valid(json::mesh::Semantic::TexCoords(0)), uv);
        }
        json::mesh::Primitive {
            attributes,
            extensions: None,
            extras: None,
            indices: Some(indices),
            material: self.materials.get(&material).copied(),
            mode: Checked::Valid(json::mesh::Mode::Triangles),
            targets: None,
        }
    }

    /// Data of a kind behind the geometry.
    pub(super) fn bytes(&mut self, kind: Kind) -> &mut Vec<u8> {
        &mut self.motion[kind as usize - N_GEOMETRY]
    }

    /// Bytes of it so far.
    pub(super) fn len(&self, kind: Kind) -> usize {
        self.motion[kind as usize - N_GEOMETRY].len()
    }

    /// Makes sure of so many zero vectors.
    pub(super) fn zeros(&mut self, n: usize) {
        let length = self.len(Kind::Zeros).max(12 * n);
        self.bytes(Kind::Zeros).resize(length, 0);
    }

    pub(super) fn accessor(
        &mut self,
        kind: Kind,
        offset: usize,
        count: usize,
        component: ComponentType,
        type_: Type,
        ends: Option<(Value, Value)>,
    ) -> json::Index<json::Accessor> {
        let (min, max) = ends.unzip();
        self.kinds.push(kind);
        self.root.push(json::Accessor {
            buffer_view: None,
            byte_offset: Some(USize64::from(offset)),
            count: USize64::from(count),
            component_type: Checked::Valid(GenericComponentType(component)),
            extensions: None,
            extras: None,
            type_: Checked::Valid(type_),
            min,
            max,
            name: None,
            normalized: false,
            sparse: None,
        })
    }

    /// Joins the data to one buffer, with a view for each kind that occurs, and points the accessors at their views.
    fn buffer(&mut self) -> Vec<u8> {
        let Geometry { positions, normals, tangents, colours, uvs, indices_u16, indices_u32, .. } =
            std::mem::take(&mut self.geometry);
        let geometry = [positions, normals, tangents, colours, uvs, indices_u16, indices_u32];
        let mut views = [None; VIEWS.len()];
        let mut binary = Vec::new();
        let data = geometry.iter().chain(&self.motion).enumerate().filter(|(_, bytes)| !bytes.is_empty());
        for (slot, bytes) in data {
            let (name, stride, target) = VIEWS[slot];
            views[slot] = Some(self.root.push(json::buffer::View {
                buffer: json::Index::new(0),
                byte_length: USize64::from(bytes.len()),
                byte_offset: Some(USize64::from(binary.len())),
                byte_stride: stride.map(Stride),
                name: Some(name.to_owned()),
                target: target.map(Checked::Valid),
                extensions: None,
                extras: None,
            }));
            binary.extend_from_slice(bytes);
            pad(&mut binary, 0);
        }
        for (i, png) in self.images.iter().enumerate() {
            let view = self.root.push(json::buffer::View {
                buffer: json::Index::new(0),
                byte_length: USize64::from(png.len()),
                byte_offset: Some(USize64::from(binary.len())),
                byte_stride: None,
                name: self.root.images[i].name.clone(),
                target: None,
                extensions: None,
                extras: None,
            });
            self.root.images[i].buffer_view = Some(view);
            binary.extend_from_slice(png);
            pad(&mut binary, 0);
        }
        for (accessor, kind) in self.root.accessors.iter_mut().zip(&self.kinds) {
            accessor.buffer_view = views[*kind as usize];
            if let Some(sparse) = &mut accessor.sparse {
                for view in [&mut sparse.indices.buffer_view, &mut sparse.values.buffer_view] {
                    // The kind stood for it.
                    *view = views[view.value()].unwrap_or(*view);
                }
            }
        }
        if !binary.is_empty() {
            let byte_length = USize64::from(binary.len());
            self.root.push(json::Buffer { byte_length, name: None, uri: None, extensions: None, extras: None });
        }
        binary
    }
}

/// The materials of what is drawn of a part.
fn ranges<'a>(part: &Part<'a>) -> &'a [MaterialRange] {
    match part.uv {
        Some(uv) => &uv.ranges,
        None => &part.topology.ranges,
    }
}

/// Header, JSON chunk, binary chunk; each padded to four bytes.
fn container(mut text: Vec<u8>, binary: Vec<u8>) -> Result<Vec<u8>, GlbError> {
    pad(&mut text, b' ');
    let binary_chunk = if binary.is_empty() { 0 } else { 8 + binary.len() };
    let bytes = 12 + 8 + text.len() + binary_chunk;
    let word = |n: usize| u32::try_from(n).map(u32::to_le_bytes).map_err(|_| GlbError::TooLarge { bytes });
    let mut out = Vec::with_capacity(bytes);
    out.extend(b"glTF");
    out.extend(2_u32.to_le_bytes());
    out.extend(word(bytes)?);
    out.extend(word(text.len())?);
    out.extend(b"JSON");
    out.extend(text);
    if !binary.is_empty() {
        out.extend(word(binary.len())?);
        out.extend(b"BIN\0");
        out.extend(binary);
    }
    Ok(out)
}

fn pad(bytes: &mut Vec<u8>, with: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), with);
}
