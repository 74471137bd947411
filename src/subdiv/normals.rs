//! Vertex normals: area-weighted face normals, gathered around each vertex in one-ring order.
//!
//! A cross product of two sides is twice the area times the unit normal, so the plain sum is the weighted one.
//! Gathering, and not scattering, gives each sum one order whatever the number of threads.
//!
//! Three loops, shaped so that the compiler makes vector instructions of each: cross products of all faces; sums
//! around a block of vertices; unit vectors of the block. They stay four floats wide up to the last.

use glam::Vec3;

use crate::math::ops;
use crate::mesh::DedgeMesh;

use super::lane::Lane;
use super::runs::{Run, pieces, runs_of};

/// The normal where none is defined: the triangles around the vertex have no area, or a position is not finite.
const FALLBACK: Vec3 = Vec3::Y;

/// Below this squared length, in the units of area squared, the sum is scaled up before it is normalised.
const TINY: f32 = 1e-30;
/// Above this one it is scaled down.
const HUGE: f32 = 1e30;

/// Vertices whose sums are made unit vectors together.
const BLOCK: usize = 64;

/// The triangles around each vertex in one-ring order, in compressed form.
#[derive(Clone, Debug)]
pub(super) struct VertexFaces {
    faces: Vec<u32>,
    runs: Vec<Run>,
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
        VertexFaces { faces, runs: runs_of(&offsets) }
    }

    /// Unit normals of the vertices from `first` on, one for each place in `out`.
    pub(super) fn gather(&self, first: usize, face_normals: &[Lane], out: &mut [Vec3]) {
        let mut sums = [Lane::default(); BLOCK];
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let sums = &mut sums[..out.len()];
            let first = first + block * BLOCK;
            for piece in pieces(&self.runs, first..first + sums.len()) {
                let (faces, sums) = (&self.faces[piece.entries], &mut sums[piece.out]);
                match piece.row_len {
                    6 => {
                        for (sum, faces) in sums.iter_mut().zip(faces.as_chunks::<6>().0) {
                            *sum = sum_of(faces, face_normals);
                        }
                    }
                    len => {
                        for (sum, faces) in sums.iter_mut().zip(faces.chunks_exact(len)) {
                            *sum = sum_of(faces, face_normals);
                        }
                    }
                }
            }
            unit_vectors(sums, out);
        }
    }
}

/// In the order of `faces`, of which there is at least one.
#[inline(always)]
fn sum_of(faces: &[u32], face_normals: &[Lane]) -> Lane {
    let mut sum = face_normals[faces[0] as usize];
    for &face in &faces[1..] {
        sum = sum.plus(face_normals[face as usize]);
    }
    sum
}

/// Twice the area times the unit normal, for each triangle (three indices) of `indices`.
pub(super) fn face_normals(indices: &[u32], positions: &[Lane], out: &mut [Lane]) {
    for (out, &[a, b, c]) in out.iter_mut().zip(indices.as_chunks::<3>().0) {
        let (a, b, c) = (positions[a as usize], positions[b as usize], positions[c as usize]);
        *out = b.minus(a).cross(c.minus(a));
    }
}

/// At most [`BLOCK`] sums, and as many places in `out`.
#[inline(always)]
fn unit_vectors(sums: &[Lane], out: &mut [Vec3]) {
    let mut squared = [1.0_f32; BLOCK];
    for (squared, Lane([x, y, z, _])) in squared.iter_mut().zip(sums) {
        *squared = x * x + y * y + z * z;
    }
    let inverse = squared.map(|squared| 1.0 / ops::sqrt(squared));
    for (i, (out, &sum)) in out.iter_mut().zip(sums).enumerate() {
        let sum = Vec3::from(sum);
        *out = if squared[i] > TINY && squared[i] < HUGE { sum * inverse[i] } else { unit_of_extreme(sum) };
    }
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
    use super::{FALLBACK, unit_vectors};
    use glam::Vec3;

    fn unit(sum: Vec3) -> Vec3 {
        let mut out = [Vec3::ZERO];
        unit_vectors(&[sum.into()], &mut out);
        out[0]
    }

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
