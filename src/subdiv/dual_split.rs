//! The topology of one Doo-Sabin step: a vertex for each corner of each face; a face for each face, for each edge with a
//! face on both sides and for each vertex inside the surface.
//!
//! There is no rule at the boundary: what would need the outside is left out, so that an open surface shrinks.

use crate::mesh::{MeshError, PolygonMesh};

/// Refines the connectivity by one step, in linear time. Vertex `e` of the child belongs to directed edge `e`: to its
/// origin, in its face. Faces come in the order face faces, edge faces (by the side with the lower number), vertex faces.
///
/// # Errors
/// None on a valid mesh; the type is that of the builder which checks it.
pub(super) fn refine(mesh: &PolygonMesh) -> Result<PolygonMesh, MeshError> {
    let mut sizes: Vec<u32> = mesh.faces().map(|face| mesh.corners(face).len() as u32).collect();
    let mut corners: Vec<u32> = (0..mesh.n_dedges() as u32).collect();
    for dedge in mesh.dedges() {
        if let Some(twin) = mesh.twin(dedge).filter(|twin| *twin > dedge) {
            // From the target of the side back to its origin on this side, then over to the other.
            corners.extend([mesh.next(dedge).0, dedge.0, mesh.next(twin).0, twin.0]);
            sizes.push(4);
        }
    }
    for vertex in mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v)) {
        let before = corners.len();
        corners.extend(mesh.outgoing_dedges(vertex).map(|d| d.0));
        let n = (corners.len() - before) as u32;
        // Two faces around a vertex leave two edge faces side by side and no room between.
        if n < 3 {
            corners.truncate(before);
        } else {
            sizes.push(n);
        }
    }
    PolygonMesh::from_faces(mesh.n_dedges(), &sizes, &corners)
}
