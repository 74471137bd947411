//! Vertex normals: area-weighted face normals, gathered around each vertex in one-ring order.
//!
//! A cross product of two sides is twice the area times the unit normal, so the plain sum is the weighted one.
//! Gathering, and not scattering, gives each sum one order whatever the number of threads.

use glam::Vec3;

use crate::math::ops;
use crate::mesh::DedgeMesh;

use super::lane::Lane;

/// The normal where none is defined: the triangles around the vertex have no area, or a position is not finite.
const FALLBACK: Vec3 = Vec3::Y;

/// Below this squared length, in the units of area squared, the sum is scaled up before it is normalised.
const TINY: f32 = 1e-30;
/// Above this one it is scaled down.
const HUGE: f32 = 1e30;

/// The triangles around each vertex in one-ring order, in compressed form.
#[derive(Clone, Debug)]
pub(super) struct VertexFaces {
    offsets: Vec<u32>,
    faces: Vec<u32>,
}

impl VertexFaces {
    pub(super) fn of(mesh: &DedgeMesh) -> VertexFaces {
        let mut offsets = Vec::with_capacity(mesh.n_vertices() + 1);
        let mut faces = Vec::with_capacity(mesh.n_dedges());
        offsets.push(0);
        for vertex in mesh.vertices() {
            faces.extend(mesh.faces_around(vertex).map(|f| f.0));
            offsets.push(faces.len() as u32);
        }
        VertexFaces { offsets, faces }
    }

    /// Unit normals of the vertices from `first` on, one for each place in `out`.
    pub(super) fn gather(&self, first: usize, face_normals: &[Lane], out: &mut [Vec3]) {
        let offsets = &self.offsets[first..=first + out.len()];
        for (out, ends) in out.iter_mut().zip(offsets.windows(2)) {
            let faces = &self.faces[ends[0] as usize..ends[1] as usize];
            // No vertex is without a face.
            let mut sum = face_normals[faces[0] as usize];
            for &face in &faces[1..] {
                sum = sum.plus(face_normals[face as usize]);
            }
            *out = unit(sum.into());
        }
    }
}

/// Twice the area times the unit normal, for each triangle (three indices) of `indices`.
pub(super) fn face_normals(indices: &[u32], positions: &[Vec3], out: &mut [Lane]) {
    let (triangles, _) = indices.as_chunks::<3>();
    for (out, &[a, b, c]) in out.iter_mut().zip(triangles) {
        let (a, b, c) = (positions[a as usize], positions[b as usize], positions[c as usize]);
        *out = (b - a).cross(c - a).into();
    }
}

#[inline(always)]
fn unit(sum: Vec3) -> Vec3 {
    let squared = sum.length_squared();
    if squared > TINY && squared < HUGE {
        return sum * (1.0 / ops::sqrt(squared));
    }
    unit_of_extreme(sum)
}

/// A direction whose squared length underflows or overflows, or that is none.
#[cold]
fn unit_of_extreme(sum: Vec3) -> Vec3 {
    let largest = sum.abs().max_element();
    if largest > 0.0 && largest.is_finite() && !sum.is_nan() {
        // In double precision neither the quotient nor its square leaves the range.
        let scaled = sum.as_dvec3() / f64::from(largest);
        return (scaled / ops::sqrt(scaled.length_squared())).as_vec3();
    }
    FALLBACK
}

#[cfg(test)]
mod tests {
    use super::{FALLBACK, unit};
    use glam::Vec3;

    #[test]
    fn a_tiny_huge_or_missing_sum_gives_no_unit_vector() {
        for scale in [1e-42_f32, 1e-25, 1e-10, 1.0, 1e14, 1e18, 1e37] {
            let n = unit(Vec3::new(1.0, 2.0, -2.0) * scale);
            assert!((n - Vec3::new(1.0, 2.0, -2.0) / 3.0).length() < 1e-3, "{scale} {n}");
            assert!((n.length() - 1.0).abs() < 1e-6, "{scale} {n}");
        }
        for nothing in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::new(1.0, f32::NAN, 0.0)] {
            assert_eq!(unit(nothing), FALLBACK);
        }
    }
}
