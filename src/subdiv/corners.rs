//! The topology of one Catmull-Clark step: a quadrilateral for each corner of a polygon, by arithmetic alone.
//!
//! The child of directed edge `e`, from `v` in face `f`, is face `e` = (v, middle of e, middle of f, middle of the side
//! before). Its sides are the directed edges `4e` to `4e + 3`.

use crate::mesh::{DedgeId, FaceId, PolygonMesh, VertexId};

use super::level::Sharpness;
use super::rule::{Surroundings, less_one};
use super::scheme::Creasing;

const NONE: u32 = u32::MAX;

/// A polygon mesh in the making, and what is sharp in it.
#[derive(Clone, Debug)]
pub(super) struct PolygonLevel {
    pub(super) mesh: PolygonMesh,
    pub(super) sharpness: Sharpness,
}

impl PolygonLevel {
    /// Sharpness of an edge: infinite on the boundary.
    pub(super) fn edge_sharpness(&self, dedge: DedgeId) -> f32 {
        if self.mesh.twin(dedge).is_none() { f32::INFINITY } else { self.sharpness.dedge(dedge) }
    }

    /// The sharpness of everything around a vertex, in ring order.
    pub(super) fn surroundings(&self, vertex: VertexId, into: &mut Surroundings) {
        into.clear();
        into.vertex = self.sharpness.vertex(vertex);
        for dedge in self.mesh.outgoing_dedges(vertex) {
            into.edges.push(self.edge_sharpness(dedge));
            if self.mesh.twin(self.mesh.prev(dedge)).is_none() {
                into.edges.push(f32::INFINITY);
            }
        }
    }
}

/// A child of a polygon mesh and where its vertices come from: first the old vertices, then the middles of edges (by the
/// side with the lower number), then those of faces.
#[derive(Clone, Debug)]
pub(super) struct RefinedPolygons {
    pub(super) mesh: PolygonMesh,
    /// One side of each edge, in the order of the new vertices.
    pub(super) edges: Vec<DedgeId>,
}

/// Refines the connectivity by one step, in linear time. The caller sees to the size.
pub(super) fn refine(mesh: &PolygonMesh) -> RefinedPolygons {
    let n_vertices = mesh.n_vertices() as u32;
    let mut edges = Vec::with_capacity(mesh.n_dedges() / 2 + 1);
    let mut middle = vec![0_u32; mesh.n_dedges()];
    for dedge in 0..mesh.n_dedges() {
        let twin = mesh.twin[dedge];
        if twin > dedge as u32 {
            middle[dedge] = n_vertices + edges.len() as u32;
            edges.push(DedgeId(dedge as u32));
        } else {
            middle[dedge] = middle[twin as usize];
        }
    }
    let first_face_point = n_vertices + edges.len() as u32;
    let mut origin = Vec::with_capacity(4 * mesh.n_dedges());
    let mut twin = Vec::with_capacity(4 * mesh.n_dedges());
    for dedge in mesh.dedges() {
        let (next, prev) = (mesh.next(dedge), mesh.prev(dedge));
        origin.extend([
            mesh.origin(dedge).0,
            middle[dedge.index()],
            first_face_point + mesh.face(dedge).0,
            middle[prev.index()],
        ]);
        twin.extend([
            mesh.twin(dedge).map_or(NONE, |other| 4 * mesh.next(other).0 + 3),
            4 * next.0 + 2,
            4 * prev.0 + 1,
            mesh.twin(prev).map_or(NONE, |other| 4 * other.0),
        ]);
    }
    let mut outgoing: Vec<u32> = mesh.outgoing.iter().map(|&dedge| 4 * dedge).collect();
    // From the middle of an edge to its end: the boundary side where there is one.
    outgoing.extend(edges.iter().map(|&dedge| 4 * mesh.next(dedge).0 + 3));
    outgoing.extend(mesh.faces().map(|face: FaceId| 4 * mesh.offsets[face.index()] + 2));
    let n_faces = mesh.n_dedges() as u32;
    let mesh = PolygonMesh {
        offsets: (0..=n_faces).map(|f| 4 * f).collect(),
        face: (0..4 * n_faces).map(|d| d / 4).collect(),
        origin,
        twin,
        outgoing,
    };
    if cfg!(debug_assertions) && n_faces < 3000 {
        // While testing: that the arithmetic has made a mesh, and the one that its faces make.
        let anew = PolygonMesh::from_faces(mesh.n_vertices(), &vec![4; n_faces as usize], &mesh.origin);
        debug_assert!(anew.is_ok_and(|anew| anew.twin == mesh.twin), "the child of a step is no mesh");
    }
    RefinedPolygons { mesh, edges }
}

/// What is left of the sharpness after a step.
pub(super) fn child_sharpness(level: &PolygonLevel, child: &PolygonMesh, creasing: Creasing) -> Sharpness {
    let old = &level.sharpness;
    if old.is_empty() {
        return Sharpness::default();
    }
    let mut dedges = vec![0.0; child.n_dedges()];
    let mut around = Surroundings::default();
    for dedge in level.mesh.dedges().filter(|&d| old.dedge(d) > 0.0) {
        let vertex = level.mesh.origin(dedge);
        level.surroundings(vertex, &mut around);
        let place = level.mesh.ring(vertex).position(|v| v == level.mesh.target(dedge));
        let left = place.map_or(0.0, |edge| around.child(edge, creasing));
        let half = 4 * dedge.index();
        dedges[half] = left;
        if child.twin[half] != NONE {
            dedges[child.twin[half] as usize] = left;
        }
    }
    Sharpness { dedges, vertices: old.vertices.iter().map(|&s| less_one(s)).collect() }
}
