//! Which faces of a control mesh are flat enough to be left alone.
//!
//! Navarro Newball, Wyvill and McCane 2008 leave the function open that tells non-subdividable faces. Ours: a face is flat
//! where no face of its two-ring is turned from it by more than a bound. The two-ring is what the position of its corners
//! depends on in the next two steps, after which every edge of it has been cut once: in a plane all of that stays in the
//! plane, so that leaving the face alone changes nothing but the triangles.

use glam::{DVec3, Vec3};

use crate::math::ops;
use crate::mesh::{DedgeMesh, FaceId};

/// The faces whose normal differs from that of every face in their two-ring (all faces that share a vertex with one that
/// shares a vertex with it) by at most `bound` radians. A face without area is never flat, and neither is one next to it.
///
/// `positions` has one rest position for each vertex. Takes time linear in the faces, times the square of the valence.
///
/// # Panics
/// Where the number of positions is another.
pub fn flat_faces(mesh: &DedgeMesh, positions: &[Vec3], bound: f64) -> Vec<FaceId> {
    assert_eq!(positions.len(), mesh.n_vertices(), "one position for each vertex");
    let normals: Vec<Option<DVec3>> = mesh.faces().map(|face| unit_normal(mesh, positions, face)).collect();
    // Angles up to π have cosines that fall: the comparison needs no arc cosine.
    let least = ops::cos(bound.clamp(0.0, std::f64::consts::PI));
    mesh.faces().filter(|&face| is_flat(mesh, &normals, face, least)).collect()
}

fn unit_normal(mesh: &DedgeMesh, positions: &[Vec3], face: FaceId) -> Option<DVec3> {
    let [a, b, c] = mesh.corners(face).map(|v| positions[v.index()].as_dvec3());
    let normal = (b - a).cross(c - a);
    let length = ops::sqrt(normal.length_squared());
    (length > 0.0 && length.is_finite()).then(|| normal / length)
}

fn is_flat(mesh: &DedgeMesh, normals: &[Option<DVec3>], face: FaceId, least: f64) -> bool {
    let Some(normal) = normals[face.index()] else { return false };
    // Rounding must not make a plane bent.
    let least = least - 1e-12;
    mesh.corners(face).into_iter().flat_map(|v| mesh.faces_around(v)).all(|near| {
        let around = mesh.corners(near).into_iter().flat_map(|v| mesh.faces_around(v));
        { around }.all(|far| normals[far.index()].is_some_and(|other| normal.dot(other) >= least))
    })
}
