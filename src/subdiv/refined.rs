//! What a step makes of a triangle mesh: a finer one, and where its vertices come from.

use crate::mesh::{DedgeId, DedgeMesh, FaceId, VertexId};

/// What a vertex of the child comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexParent {
    /// The vertex of the same number.
    Vertex(VertexId),
    /// The middle of a face.
    Face(FaceId),
    /// The middle of an edge, named by its side with the lower number.
    Edge(DedgeId),
    /// A third of the way along an edge that is cut, from the origin of the side named.
    FirstThird(DedgeId),
    /// Two thirds of the way along it.
    SecondThird(DedgeId),
}

/// A mesh one step finer.
#[derive(Clone, Debug)]
pub(super) struct Refined {
    /// Its connectivity. For √3, face `e` is the child of directed edge `e` of the parent; for quarters, faces `4f` to
    /// `4f + 3` are the children of face `f`.
    pub(super) mesh: DedgeMesh,
    /// One for each vertex: first the old vertices in their order, then the new ones, face by face, each with the first
    /// face that has it.
    pub(super) parents: Vec<VertexParent>,
}

impl Refined {
    /// While testing: that the arithmetic has made a mesh, before anything walks around a vertex of it and never comes back.
    pub(super) fn debug_assert_sound(&self) {
        if cfg!(debug_assertions)
            && self.mesh.n_faces() < 3000
            && let Err(error) = self.mesh.validate()
        {
            panic!("the child of a step is no mesh: {error}");
        }
    }
}
