//! The binary half of a .glb: vertex and index data of every primitive, gathered by kind.
//!
//! Each primitive gets vertices of its own, without those it does not use. Sharing one set of vertices between the primitives
//! of a part would be legal and a little smaller on disk, but clients copy the whole set once per primitive (measured with
//! Blender and Godot), and a validator notes unused vertices. Vertices on a border between materials are doubled with equal
//! normals, so no seam shows.

use crate::frame::{MaterialRange, Part};
use glam::{Vec3, Vec4};

/// Why a frame cannot be written as geometry.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GeometryError {
    /// A slice of a part is not as long as the part has vertices.
    #[error("part {part} has {found} {what} for {expected} vertices")]
    Length {
        /// Name of the part.
        part: &'static str,
        /// Which slice.
        what: &'static str,
        /// Its length.
        found: usize,
        /// The length it must have.
        expected: usize,
    },
    /// A material range that lies outside the indices or cuts through a triangle.
    #[error("part {part} has a material range from {start} over {count} of {n_indices} indices")]
    Range {
        /// Name of the part.
        part: &'static str,
        /// Its start.
        start: u32,
        /// Its length.
        count: u32,
        /// Indices in the part.
        n_indices: usize,
    },
    /// An index without a vertex.
    #[error("part {part} has the index {index} but {n_vertices} vertices")]
    Index {
        /// Name of the part.
        part: &'static str,
        /// The index.
        index: u32,
        /// Vertices in the part.
        n_vertices: usize,
    },
    /// A position, normal or colour that is infinite or not a number.
    #[error("vertex {vertex} of part {part} has no finite {what}")]
    NotFinite {
        /// Name of the part.
        part: &'static str,
        /// Vertex of the part.
        vertex: usize,
        /// Which of its values.
        what: &'static str,
    },
}

/// Data by kind, each little-endian and dense. Positions and normals have 12 bytes per vertex, tangents 16, texture
/// coordinates 8, colours 4.
#[derive(Default)]
pub(super) struct Geometry {
    pub positions: Vec<u8>,
    pub normals: Vec<u8>,
    pub tangents: Vec<u8>,
    pub colours: Vec<u8>,
    pub uvs: Vec<u8>,
    pub indices_u16: Vec<u8>,
    pub indices_u32: Vec<u8>,
    n_vertices: usize,
}

/// Where the data of one primitive lies.
pub(super) struct PrimitiveData {
    /// Its vertices: numbers of the part's vertices to draw, ascending.
    pub vertices: Vec<usize>,
    /// First vertex among all vertices written.
    pub first_vertex: usize,
    pub n_vertices: usize,
    /// Byte at which its texture coordinates begin, if it has any; of its tangents; of its colours.
    pub first_uv_byte: Option<usize>,
    pub first_tangent_byte: Option<usize>,
    pub first_colour_byte: Option<usize>,
    pub min: Vec3,
    pub max: Vec3,
    /// In `indices_u32` rather than in `indices_u16`.
    pub wide: bool,
    /// Byte at which the indices begin in their array.
    pub first_index_byte: usize,
    pub n_indices: usize,
    pub max_index: u32,
}

impl Geometry {
    /// Appends the triangles of one material of a part. `tangents`: one for each vertex to draw, if it shall have any;
    /// `coloured`: whether its vertices have colours.
    pub fn push(
        &mut self,
        part: &Part<'_>,
        range: &MaterialRange,
        tangents: Option<&[Vec4]>,
        coloured: bool,
    ) -> Result<PrimitiveData, GeometryError> {
        check_lengths(part)?;
        let source = indices_of(part, range)?;
        let used = used_vertices(part, source)?;
        let n_vertices = used.len();

        let first_colour_byte = coloured.then_some(self.colours.len());
        let (mut min, mut max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for &vertex in &used {
            let position = finite(part, vertex, "position", value(part, part.positions, vertex))?;
            let normal = unit(finite(part, vertex, "normal", value(part, part.normals, vertex))?);
            let colour = finite(part, vertex, "colour", value(part, part.colours, vertex))?;
            (min, max) = (min.min(position), max.max(position));
            push_vec3(&mut self.positions, position);
            push_vec3(&mut self.normals, normal);
            if coloured {
                self.colours.extend(linear_rgba8(colour));
            }
        }
        let first_tangent_byte = tangents.map(|_| self.tangents.len());
        for tangent in tangents.into_iter().flat_map(|tangents| used.iter().map(|&v| tangents[v])) {
            self.tangents.extend(tangent.to_array().into_iter().flat_map(f32::to_le_bytes));
        }
        let first_uv_byte = part.uv.map(|_| self.uvs.len());
        if let Some(uv) = part.uv {
            for &vertex in &used {
                let place = uv.coordinates[vertex];
                finite(part, vertex, "texture coordinate", place.extend(0.0))?;
                self.uvs.extend(place.to_array().into_iter().flat_map(f32::to_le_bytes));
            }
        }

        // 65535 is the restart value of 16-bit indices and must not occur.
        let wide = n_vertices > 65_535;
        let first_index_byte = if wide { self.indices_u32.len() } else { self.indices_u16.len() };
        for index in source {
            // `used` is sorted and contains every index of the range.
            let compact = used.partition_point(|&v| v < *index as usize) as u32;
            if wide {
                self.indices_u32.extend(compact.to_le_bytes());
            } else {
                self.indices_u16.extend((compact as u16).to_le_bytes());
            }
        }
        let first_vertex = self.n_vertices;
        self.n_vertices += n_vertices;
        let max_index = n_vertices as u32 - 1;
        Ok(PrimitiveData {
            vertices: used,
            first_vertex,
            n_vertices,
            first_uv_byte,
            first_tangent_byte,
            first_colour_byte,
            min,
            max,
            wide,
            first_index_byte,
            n_indices: source.len(),
            max_index,
        })
    }
}

fn check_lengths(part: &Part<'_>) -> Result<(), GeometryError> {
    let expected = part.topology.n_vertices;
    let lengths =
        [("positions", part.positions.len()), ("normals", part.normals.len()), ("colours", part.colours.len())];
    if let Some(uv) = part.uv {
        let (found, wanted) = (uv.coordinates.len(), uv.vertices.len());
        if found != wanted {
            let what = "texture coordinates";
            return Err(GeometryError::Length { part: part.topology.name, what, found, expected: wanted });
        }
        if let Some(&index) = uv.vertices.iter().flatten().find(|&&v| v as usize >= expected) {
            return Err(GeometryError::Index { part: part.topology.name, index, n_vertices: expected });
        }
    }
    match lengths.into_iter().find(|&(_, found)| found != expected) {
        Some((what, found)) => Err(GeometryError::Length { part: part.topology.name, what, found, expected }),
        None => Ok(()),
    }
}

fn indices_of<'a>(part: &Part<'a>, range: &MaterialRange) -> Result<&'a [u32], GeometryError> {
    let MaterialRange { start, count, .. } = *range;
    let indices = part.uv.map_or(&part.topology.indices, |uv| &uv.indices);
    let wrong = GeometryError::Range { part: part.topology.name, start, count, n_indices: indices.len() };
    if !count.is_multiple_of(3) {
        return Err(wrong);
    }
    indices.get(start as usize..(start as usize).saturating_add(count as usize)).ok_or(wrong)
}

/// The vertices that occur in `indices`, ascending.
fn used_vertices(part: &Part<'_>, indices: &[u32]) -> Result<Vec<usize>, GeometryError> {
    let n_vertices = part.uv.map_or(part.topology.n_vertices, |uv| uv.vertices.len());
    let mut is_used = vec![false; n_vertices];
    for &index in indices {
        let used = is_used.get_mut(index as usize);
        *used.ok_or(GeometryError::Index { part: part.topology.name, index, n_vertices })? = true;
    }
    Ok((0..n_vertices).filter(|&v| is_used[v]).collect())
}

/// A value of a vertex to draw, which along the seams of a texture may lie between two vertices of the part.
pub(super) fn value(part: &Part<'_>, values: &[Vec3], vertex: usize) -> Vec3 {
    match part.uv.map(|uv| uv.vertices[vertex]) {
        None => values[vertex],
        Some([a, b]) if a == b => values[a as usize],
        Some([a, b]) => (values[a as usize] + values[b as usize]) * 0.5,
    }
}

fn finite(part: &Part<'_>, vertex: usize, what: &'static str, value: Vec3) -> Result<Vec3, GeometryError> {
    if value.is_finite() { Ok(value) } else { Err(GeometryError::NotFinite { part: part.topology.name, vertex, what }) }
}

/// A format's normal must have unit length. A frame's normals have, but for a vertex whose triangles all have collapsed.
pub(super) fn unit(normal: Vec3) -> Vec3 {
    if (normal.length_squared() - 1.0).abs() < 1e-3 { normal } else { normal.try_normalize().unwrap_or(Vec3::Y) }
}

fn push_vec3(bytes: &mut Vec<u8>, value: Vec3) {
    bytes.extend(value.to_array().into_iter().flat_map(f32::to_le_bytes));
}

fn linear_rgba8(linear: Vec3) -> [u8; 4] {
    let byte = |channel: f32| (channel.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    [byte(linear.x), byte(linear.y), byte(linear.z), 255]
}
