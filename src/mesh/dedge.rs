//! The directed-edge mesh.
//!
//! After Campagna, Kobbelt and Seidel 1998, "Directed Edges: A Scalable Representation for Triangle Meshes", and
//! Navarro Newball, Wyvill and McCane 2008, "Efficient mesh generation using subdivision surfaces", formulas 3 to 5.
//! Departures: the origin of a directed edge is stored, not its target, so that the array is the index buffer;
//! and a boundary is a missing twin, not a negative index.

use super::ids::{DedgeId, FaceId, VertexId};
use super::validate::{InvariantError, validate};

/// "No twin" in the array of twins.
pub(crate) const NONE: u32 = u32::MAX;

/// Connectivity of an oriented two-manifold of triangles, with or without boundary, in one or more components.
///
/// Built once from an indexed list ([`DedgeMesh::from_triangles`]) or by a refinement, and immutable from then on.
/// Memory: 24 bytes a face and 4 a vertex.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DedgeMesh {
    /// Vertex where each directed edge starts: three for each face, and thereby the index buffer.
    pub(crate) origin: Vec<u32>,
    /// The directed edge the other way round, or [`NONE`] on the boundary.
    pub(crate) twin: Vec<u32>,
    /// For each vertex a directed edge that starts there: on the boundary the one without a twin.
    pub(crate) outgoing: Vec<u32>,
}

impl DedgeMesh {
    /// Takes the three stored arrays as they are: `origin` and `twin` with one entry for each directed edge (`None`
    /// on the boundary), `outgoing` with one for each vertex.
    ///
    /// # Errors
    /// The first invariant that does not hold.
    pub fn from_parts(
        origin: Vec<u32>,
        twin: Vec<Option<u32>>,
        outgoing: Vec<u32>,
    ) -> Result<DedgeMesh, InvariantError> {
        let twin = twin.into_iter().map(|t| t.unwrap_or(NONE)).collect();
        let mesh = DedgeMesh { origin, twin, outgoing };
        mesh.validate()?;
        Ok(mesh)
    }

    /// Number of vertices.
    pub fn n_vertices(&self) -> usize {
        self.outgoing.len()
    }

    /// Number of triangles.
    pub fn n_faces(&self) -> usize {
        self.origin.len() / 3
    }

    /// Number of directed edges: three for each triangle.
    pub fn n_dedges(&self) -> usize {
        self.origin.len()
    }

    /// Number of edges, each counted once whether it has one side or two.
    pub fn n_edges(&self) -> usize {
        (self.n_dedges() + self.n_boundary_edges()) / 2
    }

    /// Number of edges with a triangle on one side only.
    pub fn n_boundary_edges(&self) -> usize {
        self.twin.iter().filter(|&&t| t == NONE).count()
    }

    /// The index buffer: three vertices for each face, counter-clockwise.
    pub fn indices(&self) -> &[u32] {
        &self.origin
    }

    /// All vertices, in order.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.outgoing.len() as u32).map(VertexId)
    }

    /// All triangles, in order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.n_faces() as u32).map(FaceId)
    }

    /// All directed edges, in order.
    pub fn dedges(&self) -> impl ExactSizeIterator<Item = DedgeId> + use<> {
        (0..self.origin.len() as u32).map(DedgeId)
    }

    /// The vertex where a directed edge starts.
    #[inline(always)]
    pub fn origin(&self, dedge: DedgeId) -> VertexId {
        VertexId(self.origin[dedge.index()])
    }

    /// The vertex where a directed edge ends.
    #[inline(always)]
    pub fn target(&self, dedge: DedgeId) -> VertexId {
        self.origin(dedge.next())
    }

    /// The following side of the same triangle, counter-clockwise.
    #[inline(always)]
    pub fn next(&self, dedge: DedgeId) -> DedgeId {
        dedge.next()
    }

    /// The preceding side of the same triangle.
    #[inline(always)]
    pub fn prev(&self, dedge: DedgeId) -> DedgeId {
        dedge.prev()
    }

    /// The triangle of a directed edge.
    #[inline(always)]
    pub fn face(&self, dedge: DedgeId) -> FaceId {
        dedge.face()
    }

    /// The same edge seen from the triangle on its other side; none on the boundary.
    #[inline(always)]
    pub fn twin(&self, dedge: DedgeId) -> Option<DedgeId> {
        let twin = self.twin[dedge.index()];
        (twin != NONE).then_some(DedgeId(twin))
    }

    /// A directed edge that starts at the vertex: on the boundary the one without a twin, which is the most
    /// clockwise one.
    #[inline(always)]
    pub fn outgoing(&self, vertex: VertexId) -> DedgeId {
        DedgeId(self.outgoing[vertex.index()])
    }

    /// The three vertices of a triangle, counter-clockwise.
    #[inline(always)]
    pub fn corners(&self, face: FaceId) -> [VertexId; 3] {
        [0, 1, 2].map(|side| self.origin(face.dedge(side)))
    }

    /// Whether the directed edge has no twin.
    #[inline(always)]
    pub fn is_boundary_dedge(&self, dedge: DedgeId) -> bool {
        self.twin[dedge.index()] == NONE
    }

    /// Whether the vertex lies on a boundary.
    #[inline(always)]
    pub fn is_boundary_vertex(&self, vertex: VertexId) -> bool {
        self.is_boundary_dedge(self.outgoing(vertex))
    }

    /// The boundaries, each as its vertices in the direction of the directed edges there: the surface lies on the
    /// left. (The missing twins, and so a lid that closes the hole, run the other way.)
    ///
    /// Each loop starts at its smallest vertex; loops come in the order of those. Empty on a closed mesh.
    pub fn boundary_loops(&self) -> Vec<Vec<VertexId>> {
        boundary_loops(self.n_vertices(), |v| self.is_boundary_vertex(v), |v| self.target(self.outgoing(v)))
    }

    /// Vertices - edges + faces: 2 for a sphere, 1 for a disk, 0 for a torus, summed over components.
    pub fn euler_characteristic(&self) -> i64 {
        self.n_vertices() as i64 - self.n_edges() as i64 + self.n_faces() as i64
    }

    /// Checks every invariant of the structure, in linear time.
    ///
    /// # Errors
    /// The first one that does not hold. A mesh from [`DedgeMesh::from_triangles`] or from a refinement has none:
    /// an error here is a bug of the program, not of its input.
    pub fn validate(&self) -> Result<(), InvariantError> {
        validate(self)
    }
}

/// Loops over `next` of the vertices for which `is_boundary` holds, each from its smallest vertex, in that order.
pub(super) fn boundary_loops(
    n_vertices: usize,
    is_boundary: impl Fn(VertexId) -> bool,
    next: impl Fn(VertexId) -> VertexId,
) -> Vec<Vec<VertexId>> {
    let mut seen = vec![false; n_vertices];
    let mut loops = Vec::new();
    for start in (0..n_vertices as u32).map(VertexId).filter(|&v| is_boundary(v)) {
        let mut vertices = Vec::new();
        let mut vertex = start;
        while !std::mem::replace(&mut seen[vertex.index()], true) {
            vertices.push(vertex);
            vertex = next(vertex);
        }
        if !vertices.is_empty() {
            loops.push(vertices);
        }
    }
    loops
}
