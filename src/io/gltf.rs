//! glTF 2.0 (.gltf, .glb): the triangles of a scene, and a mesh as one binary file.
//!
//! After Khronos' "glTF 2.0 Specification", whose sections are given in brackets. Read are the triangles, strips and fans of every
//! mesh of the default scene, placed by their nodes; of a file without scenes every mesh as it lies. What else there is
//! (points, lines, materials, skins, morphs, animations, cameras) is passed over, so a skinned mesh has the shape it
//! was bound in. glTF repeats vertices where normals or texture coordinates differ, so the vertices of each mesh are
//! welded where their bits are equal; those of two meshes are not.
//!
//! The data must lie in the file: as the binary chunk or as base64 text. Files beside it are not opened, since this
//! layer knows no file system. The few JSON objects that are read are declared here, and not taken from a crate: so a
//! file is not refused for a material, and a hostile one takes little memory.

use std::borrow::Cow;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DMat4, DQuat, DVec3};
use serde::Deserialize;
use serde_json::json;

use super::soup::{fan, fits_f32};
use super::{Format, Soup, WriteError, bytes_at, check};

/// What is wrong in a file, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}: {what}")]
pub struct GltfError {
    /// As in `accessors[3]` or `byte 12`.
    pub place: String,
    /// What is wrong there.
    pub what: GltfFault,
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GltfFault {
    /// A binary file that ends too early.
    #[error("{needed} bytes belong here, and {room} are left: the file is cut off or damaged")]
    CutOff {
        /// How many are needed.
        needed: u64,
        /// How many there are.
        room: usize,
    },
    /// Another version.
    #[error("glTF {found} is not read, only 2.x")]
    Version {
        /// As the file says.
        found: String,
    },
    /// A binary file whose first chunk is not its JSON.
    #[error("the first chunk of a .glb is its JSON")]
    NoJson,
    /// Not JSON, or not what glTF means by it.
    #[error("{0}")]
    Json(String),
    /// An extension without which the file makes no sense.
    #[error("the file needs the extension {0}, which is not read: export it without compression or instancing")]
    Extension(String),
    /// Data in another file.
    #[error("the data lie in another file, \"{uri}\", which is not opened: save as .glb, or with the data embedded")]
    External {
        /// As the file says, or its start.
        uri: String,
    },
    /// Data that should be base64 and are not.
    #[error("the embedded data are not base64")]
    NotBase64,
    /// Data without any place.
    #[error("the buffer names no data, and the file has no binary chunk")]
    NoData,
    /// A number that names nothing.
    #[error("{what} {index} does not exist: there are {count}, counted from 0")]
    OutOfRange {
        /// Of which kind.
        what: &'static str,
        /// As the file says.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// Numbers of a type or shape that may not stand here.
    #[error("{found} cannot be {expected}")]
    Type {
        /// As the file says.
        found: String,
        /// What is needed.
        expected: &'static str,
    },
    /// Sparse numbers, or numbers that an extension hides.
    #[error("sparse accessors and accessors without a buffer view are not read: export plain ones")]
    Sparse,
    /// A position that is no number.
    #[error("the position of vertex {vertex} is not finite in 32 bits, placed by its node")]
    NotFinite {
        /// The vertex, from 0.
        vertex: usize,
    },
    /// Corners that do not make up triangles.
    #[error("{corners} corners are no whole number of triangles")]
    NotTriples {
        /// How many there are.
        corners: usize,
    },
    /// A node that is its own ancestor, or has two parents.
    #[error("the node is reached twice: a node has one parent at most")]
    ReachedTwice,
    /// Many copies of a mesh, or of its numbers.
    #[error("the scene has more than {limit} corners of triangles, far more than a file of this size holds")]
    TooLarge {
        /// How many are read from a file of this size.
        limit: usize,
    },
}

/// Reads a file, binary or JSON.
///
/// # Errors
/// The first thing that is wrong.
pub fn read(bytes: &[u8]) -> Result<Soup, GltfError> {
    let (text, binary) = if bytes.starts_with(b"glTF") { chunks(bytes)? } else { (bytes, None) };
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let root: Root =
        serde_json::from_slice(text).map_err(|error| fault("the JSON", GltfFault::Json(error.to_string())))?;
    if !root.asset.version.starts_with("2.") {
        return Err(fault("asset", GltfFault::Version { found: shortened(&root.asset.version) }));
    }
    if let Some(name) = root.extensions_required.iter().find(|name| !leaves_geometry_alone(name)) {
        return Err(fault("extensionsRequired", GltfFault::Extension(shortened(name))));
    }
    let data = root.buffers.iter().enumerate().map(|(i, buffer)| data(buffer, binary.filter(|_| i == 0))).collect();
    // A file without copies has at most one corner for each byte, or three in a strip.
    let limit = bytes.len().saturating_mul(4).max(1 << 22);
    let mut reader = Reader { root: &root, data, soup: Soup::default(), n_corners: 0, limit };
    reader.scene()?;
    Ok(reader.soup)
}

/// Writes one binary file with one mesh: positions, normals where given, and the triangles of the faces that are not
/// holes. `normals` has one unit vector for each position. Polygons are cut into fans from their first corner; texture
/// coordinates and tags are not written.
///
/// # Errors
/// A mesh that is inconsistent or has no face; normals of another number than positions; more than 4 GiB.
pub fn write(soup: &Soup, normals: Option<&[[f64; 3]]>) -> Result<Vec<u8>, WriteError> {
    check(soup, normals)?;
    let indices: Vec<[u32; 3]> = soup.solid_faces().flat_map(fan).collect();
    if indices.is_empty() {
        return Err(WriteError::Empty { format: Format::Glb });
    }
    let to_f32 = |v: &[f64; 3]| v.map(|x| x as f32);
    let mut low = [f32::INFINITY; 3];
    let mut high = [f32::NEG_INFINITY; 3];
    let mut binary = Vec::with_capacity(12 * (soup.positions.len() + indices.len()));
    for position in soup.positions.iter().map(to_f32) {
        for axis in 0..3 {
            low[axis] = low[axis].min(position[axis]);
            high[axis] = high[axis].max(position[axis]);
        }
        binary.extend(position.iter().flat_map(|x| x.to_le_bytes()));
    }
    let vectors =
        |i: usize| json!({ "bufferView": i, "componentType": F32, "count": soup.positions.len(), "type": "VEC3" });
    let view = |offset: usize, end: usize, target: u32| json!({ "buffer": 0, "byteOffset": offset, "byteLength": end - offset, "target": target });
    let mut views = vec![view(0, binary.len(), ARRAY_BUFFER)];
    let mut accessors = vec![vectors(0)];
    accessors[0]["min"] = json!(low);
    accessors[0]["max"] = json!(high);
    let mut attributes = json!({ "POSITION": 0 });
    if let Some(normals) = normals {
        let start = binary.len();
        binary.extend(normals.iter().map(to_f32).flat_map(|v| v.map(f32::to_le_bytes)).flatten());
        attributes["NORMAL"] = json!(views.len());
        accessors.push(vectors(views.len()));
        views.push(view(start, binary.len(), ARRAY_BUFFER));
    }
    let start = binary.len();
    binary.extend(indices.as_flattened().iter().flat_map(|i| i.to_le_bytes()));
    let mut scalars = vectors(views.len());
    scalars["componentType"] = json!(U32);
    scalars["count"] = json!(3 * indices.len());
    scalars["type"] = json!("SCALAR");
    views.push(view(start, binary.len(), ELEMENT_ARRAY_BUFFER));
    accessors.push(scalars);
    let root = json!({
        "asset": { "version": "2.0", "generator": concat!("Londra ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": attributes, "indices": accessors.len() - 1 }] }],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": binary.len() }],
    });
    container(root.to_string().into_bytes(), &binary)
}

const U8: u32 = 5121;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The JSON, padded with blanks; everything else is aligned already, since all our numbers have four bytes.
fn container(mut text: Vec<u8>, binary: &[u8]) -> Result<Vec<u8>, WriteError> {
    text.resize(text.len().next_multiple_of(4), b' ');
    let bytes = 12 + 8 + text.len() + 8 + binary.len();
    let word = |n: usize| u32::try_from(n).map_err(|_| WriteError::TooLarge { format: Format::Glb, bytes });
    let mut out = Vec::with_capacity(bytes);
    out.extend(b"glTF");
    out.extend(2_u32.to_le_bytes());
    out.extend(word(bytes)?.to_le_bytes());
    for (kind, data) in [(b"JSON", &text[..]), (b"BIN\0", binary)] {
        out.extend(word(data.len())?.to_le_bytes());
        out.extend(kind);
        out.extend(data);
    }
    Ok(out)
}

/// JSON and binary chunk of a .glb (4.4).
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), GltfError> {
    let word = |at: usize| bytes_at(bytes, at).map(u32::from_le_bytes);
    let cut_off = |at: usize, needed: u64| {
        let room = bytes.len().saturating_sub(at);
        fault(format!("byte {at}"), GltfFault::CutOff { needed, room })
    };
    let version = word(4).ok_or_else(|| cut_off(4, 4))?;
    if version != 2 {
        return Err(fault("byte 4", GltfFault::Version { found: version.to_string() }));
    }
    let length = word(8).ok_or_else(|| cut_off(8, 4))?;
    if u64::from(length) > bytes.len() as u64 {
        return Err(cut_off(0, u64::from(length)));
    }
    let chunk = |at: usize| -> Result<_, GltfError> {
        let (Some(length), Some(kind)) = (word(at), bytes_at::<4>(bytes, at + 4)) else { return Err(cut_off(at, 8)) };
        let end = (at + 8).saturating_add(length as usize);
        let data = bytes.get(at + 8..end).ok_or_else(|| cut_off(at + 8, u64::from(length)))?;
        Ok((kind, data, end))
    };
    let (kind, text, end) = chunk(12)?;
    if &kind != b"JSON" {
        return Err(fault("byte 12", GltfFault::NoJson));
    }
    let binary = if end < length as usize { Some(chunk(end)?) } else { None };
    Ok((text, binary.filter(|(kind, ..)| kind == b"BIN\0").map(|(_, data, _)| data)))
}

/// The bytes of a buffer. An error is of no concern until the buffer is used.
fn data<'a>(buffer: &Buffer, binary: Option<&'a [u8]>) -> Result<Cow<'a, [u8]>, GltfFault> {
    let Some(uri) = &buffer.uri else { return binary.map(Cow::Borrowed).ok_or(GltfFault::NoData) };
    let embedded = uri.strip_prefix("data:").ok_or_else(|| GltfFault::External { uri: shortened(uri) })?;
    let text = embedded.split_once(";base64,").ok_or(GltfFault::NotBase64)?.1;
    STANDARD.decode(text).map(Cow::Owned).map_err(|_| GltfFault::NotBase64)
}

/// Whether positions and triangles mean the same without the extension. Numbers of the extension
/// KHR_mesh_quantization are read.
fn leaves_geometry_alone(extension: &str) -> bool {
    let families = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "KHR_lights_", "EXT_lights_"];
    extension == "KHR_mesh_quantization" || families.iter().any(|family| extension.starts_with(family))
}

fn fault(place: impl Into<String>, what: GltfFault) -> GltfError {
    GltfError { place: place.into(), what }
}

/// What a file says, short enough for a message.
fn shortened(text: &str) -> String {
    text.chars().take(80).collect()
}

struct Reader<'a> {
    root: &'a Root,
    data: Vec<Result<Cow<'a, [u8]>, GltfFault>>,
    soup: Soup,
    /// Corners that were read, kept or not.
    n_corners: usize,
    /// Most of them.
    limit: usize,
}

impl Reader<'_> {
    /// Every mesh of the default scene, else of the first; without scenes every mesh as it lies (3.5.1).
    fn scene(&mut self) -> Result<(), GltfError> {
        let root = self.root;
        if root.scenes.is_empty() && root.scene.is_none() {
            return (0..root.meshes.len()).try_for_each(|mesh| self.mesh(mesh, DMat4::IDENTITY, "meshes"));
        }
        let scene = find("scene", &root.scenes, "scene", root.scene.unwrap_or(0))?;
        let mut reached = vec![false; root.nodes.len()];
        let mut waiting: Vec<(usize, DMat4)> = Vec::new();
        // The last comes out first. A node is marked when it goes in, so that no more wait than there are.
        let mut enter = |waiting: &mut Vec<_>, user: &str, nodes: &[usize], scene_from_parent| {
            for &index in nodes.iter().rev() {
                find(user, &root.nodes, "node", index)?;
                if std::mem::replace(&mut reached[index], true) {
                    return Err(fault(format!("nodes[{index}]"), GltfFault::ReachedTwice));
                }
                waiting.push((index, scene_from_parent));
            }
            Ok(())
        };
        enter(&mut waiting, "scenes", &scene.nodes, DMat4::IDENTITY)?;
        while let Some((index, scene_from_parent)) = waiting.pop() {
            let node = &root.nodes[index];
            let place = format!("nodes[{index}]");
            let scene_from_node = scene_from_parent * node.parent_from_node();
            if let Some(mesh) = node.mesh {
                // A skinned mesh stays where it was bound, whatever its node says (3.7.3.3).
                self.mesh(mesh, if node.skin.is_some() { DMat4::IDENTITY } else { scene_from_node }, &place)?;
            }
            enter(&mut waiting, &place, &node.children, scene_from_node)?;
        }
        Ok(())
    }

    fn mesh(&mut self, index: usize, scene_from_mesh: DMat4, user: &str) -> Result<(), GltfError> {
        let mesh = find(user, &self.root.meshes, "mesh", index)?;
        let mut soup = Soup::default();
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("meshes[{index}].primitives[{i}]");
            self.n_corners += self.primitive(primitive, scene_from_mesh, &mut soup, &place)?;
        }
        soup.face_sizes = vec![3; soup.corners.len() / 3];
        soup.weld();
        let limit = self.limit;
        // The limit keeps all numbers far below 32 bits, but for files of gigabytes.
        let too_large = || fault(user, GltfFault::TooLarge { limit });
        self.soup.append(&soup.without_unused()).ok_or_else(too_large)
    }

    /// Adds to the soup and returns how many corners it has added.
    fn primitive(
        &self,
        primitive: &Primitive,
        scene_from_mesh: DMat4,
        soup: &mut Soup,
        place: &str,
    ) -> Result<usize, GltfError> {
        const TRIANGLES: u32 = 4;
        const STRIP: u32 = 5;
        const FAN: u32 = 6;
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        // Without positions nothing is drawn (3.7.2.1).
        let Some(positions) = primitive.attributes.position.filter(|_| (TRIANGLES..=FAN).contains(&mode)) else {
            return Ok(0);
        };
        let positions = self.numbers(positions, 3, "positions: VEC3 of floats or quantised", place)?;
        let indices = match primitive.indices {
            Some(indices) => Some(self.numbers(indices, 1, "indices: SCALAR of unsigned integers", place)?),
            None => None,
        };
        let n_indices = indices.as_ref().map_or(positions.count, |indices| indices.count);
        let n_triangles = if mode == TRIANGLES { n_indices / 3 } else { n_indices.saturating_sub(2) };
        if mode == TRIANGLES && !n_indices.is_multiple_of(3) {
            return Err(fault(place, GltfFault::NotTriples { corners: n_indices }));
        }
        if self.n_corners.saturating_add(n_triangles.saturating_mul(3)) > self.limit {
            return Err(fault(place, GltfFault::TooLarge { limit: self.limit }));
        }

        let first_corner = soup.corners.len();
        let mirrored = scene_from_mesh.determinant() < 0.0;
        for i in 0..n_triangles {
            // Orders of (3.7.2.1); a mirror turns them round.
            let [a, b, c] = match mode {
                STRIP => [i, i + 1 + i % 2, i + 2 - i % 2],
                FAN => [i + 1, i + 2, 0],
                _ => [3 * i, 3 * i + 1, 3 * i + 2],
            };
            for corner in if mirrored { [a, c, b] } else { [a, b, c] } {
                let vertex = indices.as_ref().map_or(corner, |indices| indices.integer(corner));
                if vertex >= positions.count {
                    let what = GltfFault::OutOfRange { what: "vertex", index: vertex, count: positions.count };
                    return Err(fault(place, what));
                }
                soup.corners.push(vertex as u32);
            }
        }

        // Of positions that many primitives share, only those used are taken, in their order.
        let mut used = soup.corners[first_corner..].to_vec();
        used.sort_unstable();
        used.dedup();
        let first_vertex = soup.positions.len();
        for &vertex in &used {
            let vertex = vertex as usize;
            let position = DVec3::from(std::array::from_fn(|axis| positions.float(vertex, axis)));
            let position = scene_from_mesh.transform_point3(position).to_array();
            if !position.iter().all(|&x| fits_f32(x)) {
                return Err(fault(place, GltfFault::NotFinite { vertex }));
            }
            soup.positions.push(position);
        }
        for corner in &mut soup.corners[first_corner..] {
            *corner = (first_vertex + used.partition_point(|vertex| vertex < corner)) as u32;
        }
        Ok(3 * n_triangles)
    }

    /// An accessor of `width` components, checked to lie in its buffer (3.6.2). One component is an index.
    fn numbers(
        &self,
        index: usize,
        width: usize,
        expected: &'static str,
        user: &str,
    ) -> Result<Numbers<'_>, GltfError> {
        let root = self.root;
        let accessor = find(user, &root.accessors, "accessor", index)?;
        let place = || format!("accessors[{index}]");
        let component = accessor.component_type;
        let Some(size) = size_of_component(component).filter(|_| match width {
            1 => accessor.kind == "SCALAR" && [U8, U16, U32].contains(&component),
            _ => accessor.kind == "VEC3" && component != U32,
        }) else {
            let found = shortened(&format!("{} of {component}", accessor.kind));
            return Err(fault(place(), GltfFault::Type { found, expected }));
        };
        let view = accessor.buffer_view.filter(|_| accessor.sparse.is_none());
        let view = view.ok_or_else(|| fault(place(), GltfFault::Sparse))?;
        let view_place = format!("bufferViews[{view}]");
        let view = find(&place(), &root.buffer_views, "buffer view", view)?;
        let data = find(&view_place, &self.data, "buffer", view.buffer)?;
        let data = data.as_ref().map_err(|what| fault(format!("buffers[{}]", view.buffer), what.clone()))?;
        let (start, length) = (view.byte_offset, view.byte_length);
        let in_buffer = start.checked_add(length).and_then(|end| data.get(start..end));
        let cut_off = |needed: usize, room| GltfFault::CutOff { needed: needed as u64, room };
        let in_buffer =
            in_buffer.ok_or_else(|| fault(view_place, cut_off(length, data.len().saturating_sub(start))))?;
        let bytes = in_buffer.get(accessor.byte_offset..).unwrap_or_default();
        let stride = view.byte_stride.unwrap_or(size * width);
        if stride < size * width {
            let found = format!("a stride of {stride} bytes");
            return Err(fault(place(), GltfFault::Type { found, expected }));
        }
        let before_last = accessor.count.saturating_sub(1).checked_mul(stride);
        let needed = before_last.and_then(|n| n.checked_add(size * width)).unwrap_or(usize::MAX);
        if accessor.count > 0 && needed > bytes.len() {
            return Err(fault(place(), cut_off(needed, bytes.len())));
        }
        Ok(Numbers { bytes, stride, component, size, count: accessor.count, normalized: accessor.normalized })
    }
}

/// Rows of numbers in a buffer, `count` of them, all there.
struct Numbers<'a> {
    bytes: &'a [u8],
    stride: usize,
    component: u32,
    /// Bytes of a component.
    size: usize,
    count: usize,
    normalized: bool,
}

impl Numbers<'_> {
    /// An unsigned integer.
    fn integer(&self, row: usize) -> usize {
        let at = row * self.stride;
        let bytes = &self.bytes[at..at + self.size];
        bytes.iter().rev().fold(0, |number, &byte| number << 8 | usize::from(byte))
    }

    /// A float, or an integer that means one (3.11).
    fn float(&self, row: usize, axis: usize) -> f64 {
        let at = row * self.stride + axis * self.size;
        let bytes = &self.bytes[at..at + self.size];
        let (number, largest) = match *bytes {
            [a, b, c, d] => return f64::from(f32::from_le_bytes([a, b, c, d])),
            [a, b] if self.component == U16 => (f64::from(u16::from_le_bytes([a, b])), f64::from(u16::MAX)),
            [a, b] => (f64::from(i16::from_le_bytes([a, b])), f64::from(i16::MAX)),
            [a] if self.component == U8 => (f64::from(a), f64::from(u8::MAX)),
            _ => (f64::from(bytes[0] as i8), f64::from(i8::MAX)),
        };
        if self.normalized { (number / largest).max(-1.0) } else { number }
    }
}

fn size_of_component(component: u32) -> Option<usize> {
    match component {
        5120 | U8 => Some(1),
        5122 | U16 => Some(2),
        U32 | F32 => Some(4),
        _ => None,
    }
}

/// `user` is the place that names the number.
fn find<'t, T>(user: &str, items: &'t [T], what: &'static str, index: usize) -> Result<&'t T, GltfError> {
    items.get(index).ok_or_else(|| fault(user, GltfFault::OutOfRange { what, index, count: items.len() }))
}

/// What we read of the JSON (5).
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
#[derive(Default)]
struct Root {
    asset: Asset,
    extensions_required: Vec<String>,
    scene: Option<usize>,
    scenes: Vec<Scene>,
    nodes: Vec<Node>,
    meshes: Vec<Mesh>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<BufferView>,
    buffers: Vec<Buffer>,
}

#[derive(Default, Deserialize)]
struct Asset {
    version: String,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Scene {
    nodes: Vec<usize>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Node {
    children: Vec<usize>,
    mesh: Option<usize>,
    skin: Option<serde::de::IgnoredAny>,
    matrix: Option<Box<[f64; 16]>>,
    translation: Option<Box<[f64; 3]>>,
    rotation: Option<Box<[f64; 4]>>,
    scale: Option<Box<[f64; 3]>>,
}

impl Node {
    /// The matrix, or scale, then rotation, then translation (3.5.3).
    fn parent_from_node(&self) -> DMat4 {
        if let Some(matrix) = &self.matrix {
            return DMat4::from_cols_array(matrix);
        }
        let vector = |v: &Option<Box<[f64; 3]>>, default| v.as_ref().map_or(default, |v| DVec3::from_array(**v));
        // Rotations are written with few digits, and a scene may be deep.
        let rotation = self.rotation.as_ref().map_or(DQuat::IDENTITY, |q| unit(DQuat::from_array(**q)));
        let (scale, translation) = (vector(&self.scale, DVec3::ONE), vector(&self.translation, DVec3::ZERO));
        DMat4::from_scale_rotation_translation(scale, rotation, translation)
    }
}

/// No rotation where there is no direction.
fn unit(rotation: DQuat) -> DQuat {
    let length = rotation.length();
    if length.is_finite() && length > 0.0 { rotation / length } else { DQuat::IDENTITY }
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Mesh {
    primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
struct Primitive {
    attributes: Attributes,
    indices: Option<usize>,
    mode: Option<u32>,
}

#[derive(Deserialize)]
struct Attributes {
    #[serde(rename = "POSITION")]
    position: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: Option<usize>,
    #[serde(default)]
    byte_offset: usize,
    component_type: u32,
    #[serde(default)]
    normalized: bool,
    count: usize,
    #[serde(rename = "type")]
    kind: String,
    sparse: Option<serde::de::IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct BufferView {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
    byte_stride: Option<usize>,
}

#[derive(Deserialize)]
struct Buffer {
    uri: Option<String>,
}
