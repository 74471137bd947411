//! What a user marks on a control mesh: sharp edges and vertices, holes, faces to leave alone.

use crate::mesh::{FaceId, VertexId};

/// Sharpness from this value on never falls: the convention of RenderMan and of OpenSubdiv's files.
pub const INFINITE_SHARPNESS: f32 = 10.0;

/// Marks on the elements of a control mesh. Sharpness counts steps: an edge of sharpness 2 is sharp for two steps and
/// smooth from then on; from [`INFINITE_SHARPNESS`] on it stays sharp for ever. For √3 a step is two steps of the
/// plan, since it divides an edge only in every second one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tags {
    /// Sharp edges, each by its two vertices in any order, with sharpness. Of an edge named twice the last counts.
    pub creases: Vec<(VertexId, VertexId, f32)>,
    /// Sharp vertices. Of a vertex named twice the last counts.
    pub corners: Vec<(VertexId, f32)>,
    /// Faces that are not there: their place becomes a hole with a boundary of its own.
    pub holes: Vec<FaceId>,
    /// Faces that are carried through unchanged (Navarro Newball, Wyvill and McCane 2008: non-subdividable faces).
    pub frozen: Vec<FaceId>,
}

impl Tags {
    /// Whether nothing is marked.
    pub fn is_empty(&self) -> bool {
        self.creases.is_empty() && self.corners.is_empty() && self.holes.is_empty() && self.frozen.is_empty()
    }
}

/// A mark that does not fit the mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TagError {
    /// A crease names two vertices that no edge joins.
    #[error("a crease runs from vertex {from} to {to}, but no edge joins them")]
    NoSuchEdge {
        /// One end.
        from: VertexId,
        /// The other.
        to: VertexId,
    },
    /// A corner names a vertex that the mesh does not have.
    #[error("corner {vertex} does not exist: the mesh has {n_vertices} vertices, numbered from 0")]
    NoSuchVertex {
        /// What is named.
        vertex: VertexId,
        /// How many there are.
        n_vertices: usize,
    },
    /// A hole or a frozen face that the mesh does not have.
    #[error("face {face} is tagged, but the mesh has only {n_faces} faces, numbered from 0")]
    NoSuchFace {
        /// What is named.
        face: FaceId,
        /// How many there are.
        n_faces: usize,
    },
    /// A sharpness below zero or none at all.
    #[error("sharpness {sharpness} is not allowed; give 0 (smooth) to 10 (sharp for ever)")]
    Sharpness {
        /// As given.
        sharpness: f32,
    },
    /// Faces without holes are no mesh any more.
    #[error("without its holes the mesh is no surface: {0}")]
    Holes(#[source] crate::mesh::MeshError),
}
