//! Which edges of a control mesh are bent so much that they are meant to be sharp.
//!
//! Files without tags show their creases by angles alone. The angle between the faces on both sides of an edge is taken
//! from the rest positions, once, so that the topology of a plan does not depend on later ones.

use glam::{DVec3, Vec3};

use crate::math::ops;
use crate::mesh::{FaceId, PolygonMesh, VertexId};

/// The edges whose two faces are turned against each other by more than `bound` radians, each once, as creases that stay
/// sharp for ever: ready for [`Tags::creases`](super::Tags::creases). Boundary edges have one face and are never among
/// them, and neither are edges of faces without area.
///
/// `positions` has one rest position for each vertex. The normal of a polygon that is not flat is that of its vector area.
/// Takes time linear in the edges.
///
/// # Panics
/// Where the number of positions is another.
pub fn creases_by_angle(mesh: &PolygonMesh, positions: &[Vec3], bound: f64) -> Vec<(VertexId, VertexId, f32)> {
    assert_eq!(positions.len(), mesh.n_vertices(), "one position for each vertex");
    let normals: Vec<Option<DVec3>> = mesh.faces().map(|face| unit_normal(mesh, positions, face)).collect();
    // Angles up to π have cosines that fall: the comparison needs no arc cosine. Rounding must not make a plane bent.
    let least = ops::cos(bound.clamp(0.0, std::f64::consts::PI)) - 1e-12;
    let is_bent = |a: FaceId, b: FaceId| match (normals[a.index()], normals[b.index()]) {
        (Some(a), Some(b)) => a.dot(b) < least,
        _ => false,
    };
    let sides = mesh.dedges().filter_map(|side| Some((side, mesh.twin(side).filter(|&twin| side < twin)?)));
    sides
        .filter(|&(side, twin)| is_bent(mesh.face(side), mesh.face(twin)))
        .map(|(side, _)| (mesh.origin(side), mesh.target(side), f32::INFINITY))
        .collect()
}

fn unit_normal(mesh: &PolygonMesh, positions: &[Vec3], face: FaceId) -> Option<DVec3> {
    let corner = |v: u32| positions[v as usize].as_dvec3();
    let corners = mesh.corners(face);
    let first = corner(corners[0]);
    let area: DVec3 = corners[1..].windows(2).map(|w| (corner(w[0]) - first).cross(corner(w[1]) - first)).sum();
    let length = ops::sqrt(area.length_squared());
    (length > 0.0 && length.is_finite()).then(|| area / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    /// Two squares that meet in the edge 1-2, the second turned by `angle`.
    fn hinge(angle: f32) -> (PolygonMesh, Vec<Vec3>) {
        let (sine, cosine) = ops::sin_cos(angle);
        let positions = vec![
            vec3(-1.0, 0.0, 0.0),
            vec3(0.0, 0.0, 0.0),
            vec3(0.0, 1.0, 0.0),
            vec3(-1.0, 1.0, 0.0),
            vec3(cosine, 0.0, sine),
            vec3(cosine, 1.0, sine),
        ];
        let mesh = PolygonMesh::from_faces(6, &[4, 4], &[0, 1, 2, 3, 1, 4, 5, 2]).unwrap();
        (mesh, positions)
    }

    #[test]
    fn an_edge_is_a_crease_from_its_angle_on_and_a_boundary_never() {
        let (mesh, positions) = hinge(0.5);
        let ends = (VertexId(1), VertexId(2), f32::INFINITY);
        assert_eq!(creases_by_angle(&mesh, &positions, 0.49), [ends]);
        assert_eq!(creases_by_angle(&mesh, &positions, 0.51), []);
        let (mesh, positions) = hinge(0.0);
        assert_eq!(creases_by_angle(&mesh, &positions, 0.0), [], "a plane is not bent by rounding");
        let (mesh, positions) = hinge(3.0);
        assert_eq!(creases_by_angle(&mesh, &positions, 4.0), [], "no angle is more than half a turn");
    }

    #[test]
    fn a_face_without_area_makes_no_crease() {
        let (mesh, mut positions) = hinge(1.0);
        (positions[4], positions[5]) = (positions[1], positions[2]);
        assert_eq!(creases_by_angle(&mesh, &positions, 0.1), []);
    }

    #[test]
    fn every_edge_of_a_cube_is_a_crease_below_a_right_angle() {
        let corner = |i: u32| vec3((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32);
        let positions: Vec<Vec3> = (0..8).map(corner).collect();
        let faces = [0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5];
        let mesh = PolygonMesh::from_faces(8, &[4; 6], &faces).unwrap();
        assert_eq!(creases_by_angle(&mesh, &positions, 1.5).len(), 12);
        assert_eq!(creases_by_angle(&mesh, &positions, 1.6).len(), 0);
    }
}
