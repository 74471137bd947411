//! Connectivity of polygon meshes as directed edges; no positions inside.
//!
//! The same idea as [`DedgeMesh`] with faces of any size: the sides of a face are successive numbers,
//! so that next and previous need only where the face begins. Catmull-Clark and Doo-Sabin refine these, and the
//! three-connected dual is one.

use super::build::{Buckets, MeshError, check_counts, find_twins, outgoing_of};
use super::dedge::{DedgeMesh, NONE};
use super::ids::{DedgeId, FaceId, VertexId};

/// Connectivity of an oriented two-manifold of polygons, with or without boundary, in one or more components.
///
/// Built once from a list of faces, and immutable from then on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PolygonMesh {
    /// Where the sides of each face begin; one entry more than there are faces.
    pub(crate) offsets: Vec<u32>,
    /// Vertex where each directed edge starts, face after face.
    pub(crate) origin: Vec<u32>,
    /// The directed edge the other way round, or [`NONE`] on the boundary.
    pub(crate) twin: Vec<u32>,
    /// The face of each directed edge.
    pub(crate) face: Vec<u32>,
    /// For each vertex a directed edge that starts there: on the boundary the one without a twin.
    pub(crate) outgoing: Vec<u32>,
}

impl PolygonMesh {
    /// Builds the connectivity of `n_vertices` vertices and faces with `sizes[f]` corners each (three or more), whose
    /// vertex numbers stand one after another in `corners`, counter-clockwise seen from outside. Takes time and memory
    /// linear in both.
    ///
    /// # Errors
    /// What keeps the list from being an oriented two-manifold: see [`MeshError`].
    pub fn from_faces(n_vertices: usize, sizes: &[u32], corners: &[u32]) -> Result<PolygonMesh, MeshError> {
        check_counts(n_vertices, sizes.len(), corners.len())?;
        let n_named: u64 = sizes.iter().map(|&n| u64::from(n)).sum();
        if n_named != corners.len() as u64 {
            return Err(MeshError::CornerCount { named: n_named, given: corners.len() });
        }
        let mut offsets = Vec::with_capacity(sizes.len() + 1);
        let mut face = Vec::with_capacity(corners.len());
        offsets.push(0);
        for (f, &size) in sizes.iter().enumerate() {
            let start = face.len();
            face.resize(start + size as usize, f as u32);
            offsets.push(face.len() as u32);
            check_face(FaceId(f as u32), n_vertices, &corners[start..face.len()])?;
        }
        let buckets = Buckets::by_origin(n_vertices, corners);
        buckets.check_no_isolated()?;
        let mut mesh = PolygonMesh { offsets, origin: corners.to_vec(), twin: Vec::new(), face, outgoing: Vec::new() };
        mesh.twin = find_twins(
            &mesh.origin,
            &buckets,
            |d| mesh.next(DedgeId(d)).0,
            |d| mesh.prev(DedgeId(d)).0,
            |d| FaceId(mesh.face[d as usize]),
        )?;
        mesh.outgoing = outgoing_of(&mesh.twin, &buckets);
        for vertex in mesh.vertices() {
            let faces = buckets.at(vertex.index()).len();
            let reached = mesh.outgoing_dedges(vertex).count();
            if reached != faces {
                return Err(MeshError::NonManifoldVertex { vertex, reached, faces });
            }
        }
        Ok(mesh)
    }

    /// Number of vertices.
    pub fn n_vertices(&self) -> usize {
        self.outgoing.len()
    }

    /// Number of faces.
    pub fn n_faces(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Number of directed edges: as many as all faces have corners.
    pub fn n_dedges(&self) -> usize {
        self.origin.len()
    }

    /// Number of edges, each counted once whether it has one side or two.
    pub fn n_edges(&self) -> usize {
        (self.n_dedges() + self.n_boundary_edges()) / 2
    }

    /// Number of edges with a face on one side only.
    pub fn n_boundary_edges(&self) -> usize {
        self.twin.iter().filter(|&&t| t == NONE).count()
    }

    /// All vertices, in order.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.outgoing.len() as u32).map(VertexId)
    }

    /// All faces, in order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.n_faces() as u32).map(FaceId)
    }

    /// All directed edges, in order.
    pub fn dedges(&self) -> impl ExactSizeIterator<Item = DedgeId> + use<> {
        (0..self.origin.len() as u32).map(DedgeId)
    }

    /// The vertices of a face, counter-clockwise.
    pub fn corners(&self, face: FaceId) -> &[u32] {
        &self.origin[self.offsets[face.index()] as usize..self.offsets[face.index() + 1] as usize]
    }

    /// The sides of a face, counter-clockwise.
    pub fn sides(&self, face: FaceId) -> impl ExactSizeIterator<Item = DedgeId> + use<> {
        (self.offsets[face.index()]..self.offsets[face.index() + 1]).map(DedgeId)
    }

    /// The vertex where a directed edge starts.
    #[inline]
    pub fn origin(&self, dedge: DedgeId) -> VertexId {
        VertexId(self.origin[dedge.index()])
    }

    /// The vertex where a directed edge ends.
    #[inline]
    pub fn target(&self, dedge: DedgeId) -> VertexId {
        self.origin(self.next(dedge))
    }

    /// The face of a directed edge.
    #[inline]
    pub fn face(&self, dedge: DedgeId) -> FaceId {
        FaceId(self.face[dedge.index()])
    }

    /// The following side of the same face, counter-clockwise.
    #[inline]
    pub fn next(&self, dedge: DedgeId) -> DedgeId {
        let face = self.face[dedge.index()] as usize;
        DedgeId(if dedge.0 + 1 == self.offsets[face + 1] { self.offsets[face] } else { dedge.0 + 1 })
    }

    /// The preceding side of the same face.
    #[inline]
    pub fn prev(&self, dedge: DedgeId) -> DedgeId {
        let face = self.face[dedge.index()] as usize;
        DedgeId(if dedge.0 == self.offsets[face] { self.offsets[face + 1] - 1 } else { dedge.0 - 1 })
    }

    /// The same edge seen from the face on its other side; none on the boundary.
    #[inline]
    pub fn twin(&self, dedge: DedgeId) -> Option<DedgeId> {
        let twin = self.twin[dedge.index()];
        (twin != NONE).then_some(DedgeId(twin))
    }

    /// A directed edge that starts at the vertex: on the boundary the one without a twin.
    #[inline]
    pub fn outgoing(&self, vertex: VertexId) -> DedgeId {
        DedgeId(self.outgoing[vertex.index()])
    }

    /// Whether the vertex lies on a boundary.
    #[inline]
    pub fn is_boundary_vertex(&self, vertex: VertexId) -> bool {
        self.twin(self.outgoing(vertex)).is_none()
    }

    /// The directed edges that start at a vertex, counter-clockwise; on the boundary from the most clockwise one.
    pub fn outgoing_dedges(&self, vertex: VertexId) -> impl Iterator<Item = DedgeId> + '_ {
        let start = self.outgoing(vertex);
        let mut here = Some(start);
        std::iter::from_fn(move || {
            let dedge = here?;
            here = self.twin(self.prev(dedge)).filter(|&onward| onward != start);
            Some(dedge)
        })
    }

    /// The neighbours of a vertex along edges, counter-clockwise; on the boundary from the next vertex along it to the
    /// one before.
    pub fn ring(&self, vertex: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        self.outgoing_dedges(vertex).flat_map(move |dedge| {
            let before = self.prev(dedge);
            let last = self.twin(before).is_none().then(|| self.origin(before));
            std::iter::once(self.target(dedge)).chain(last)
        })
    }

    /// Number of edges at a vertex.
    pub fn valence(&self, vertex: VertexId) -> usize {
        self.ring(vertex).count()
    }

    /// The boundaries, each as its vertices with the surface on the left, as [`DedgeMesh::boundary_loops`] gives them.
    pub fn boundary_loops(&self) -> Vec<Vec<VertexId>> {
        super::dedge::boundary_loops(
            self.n_vertices(),
            |v| self.is_boundary_vertex(v),
            |v| self.target(self.outgoing(v)),
        )
    }

    /// Vertices - edges + faces.
    pub fn euler_characteristic(&self) -> i64 {
        self.n_vertices() as i64 - self.n_edges() as i64 + self.n_faces() as i64
    }

    /// The faces cut into triangles, each as a fan: quadrilaterals and larger faces from their first corner.
    pub fn triangulated(&self) -> Vec<u32> {
        let mut indices = Vec::with_capacity(3 * (self.n_dedges() - 2 * self.n_faces()));
        for face in self.faces() {
            let corners = self.corners(face);
            for pair in corners[1..].windows(2) {
                indices.extend([corners[0], pair[0], pair[1]]);
            }
        }
        indices
    }
}

impl From<&DedgeMesh> for PolygonMesh {
    /// The same mesh, each triangle a polygon with three corners.
    fn from(mesh: &DedgeMesh) -> PolygonMesh {
        PolygonMesh {
            offsets: (0..=mesh.n_faces() as u32).map(|f| 3 * f).collect(),
            origin: mesh.origin.clone(),
            twin: mesh.twin.clone(),
            face: (0..mesh.n_dedges() as u32).map(|d| d / 3).collect(),
            outgoing: mesh.outgoing.clone(),
        }
    }
}

fn check_face(face: FaceId, n_vertices: usize, corners: &[u32]) -> Result<(), MeshError> {
    if corners.len() < 3 {
        return Err(MeshError::TooFewCorners { face, found: corners.len() });
    }
    if let Some(&index) = corners.iter().find(|&&v| v as usize >= n_vertices) {
        return Err(MeshError::IndexOutOfRange { face, index, n_vertices });
    }
    // Quadratic for small faces, which nearly all are; sorted for large ones.
    let repeated = if corners.len() <= 16 {
        corners.iter().enumerate().find(|(i, v)| corners[..*i].contains(v)).map(|(_, &v)| v)
    } else {
        let mut sorted = corners.to_vec();
        sorted.sort_unstable();
        sorted.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0])
    };
    match repeated {
        Some(vertex) => Err(MeshError::DegenerateTriangle { face, vertex: VertexId(vertex) }),
        None => Ok(()),
    }
}
