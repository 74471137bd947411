//! Vertex normals: area-weighted face normals, gathered around each vertex in one-ring order.
//!
//! A cross product of two sides is twice the area times the unit normal, so the plain sum is the weighted one.
//! Gathering, and not scattering, gives each sum one order whatever the number of threads. Each face is worked out
//! three times, once from each corner: that costs less than to store it and fetch it back from a distant cache.

use glam::Vec3;

use crate::math::ops;
use crate::mesh::VertexId;

use super::lane::Lane;

/// The normal where none is defined: the triangles around the vertex have no area, or a position is not finite.
const FALLBACK: Vec3 = Vec3::Y;

/// Below this squared length, in the units of area squared, the sum is scaled up before it is normalised.
const TINY: f32 = 1e-30;
/// Above this one it is scaled down.
const HUGE: f32 = 1e30;

/// Vertices whose sums are made unit vectors together.
pub(super) const BLOCK: usize = 64;

/// The one-ring of each vertex, in compressed form. Inside the surface the first neighbour stands again at the end, so
/// that successive entries are the triangles there as well as on the boundary.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rings {
    pub(super) neighbours: Vec<u32>,
    pub(super) runs: Vec<RingRun>,
    pub(super) n_vertices: usize,
}

/// Vertices with rings of the same length, one after another; they end where the next run begins.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct RingRun {
    pub(super) first_vertex: u32,
    pub(super) first_entry: u32,
    pub(super) len: u32,
}

impl Rings {
    /// Rings of all vertices, given the neighbours of each and whether it lies on the boundary.
    pub(super) fn of<R: Iterator<Item = VertexId>>(
        n_vertices: usize,
        n_entries: usize,
        ring: impl Fn(VertexId) -> R,
        is_boundary: impl Fn(VertexId) -> bool,
    ) -> Rings {
        let mut neighbours = Vec::with_capacity(n_entries);
        let mut runs: Vec<RingRun> = Vec::new();
        for vertex in (0..n_vertices as u32).map(VertexId) {
            let first_entry = neighbours.len();
            neighbours.extend(ring(vertex).map(|v| v.0));
            if !is_boundary(vertex) {
                neighbours.push(neighbours[first_entry]);
            }
            let len = (neighbours.len() - first_entry) as u32;
            if runs.last().is_none_or(|run| run.len != len) {
                runs.push(RingRun { first_vertex: vertex.0, first_entry: first_entry as u32, len });
            }
        }
        Rings { neighbours, runs, n_vertices }
    }

    /// Bytes of all rings.
    pub(super) fn n_bytes(&self) -> usize {
        size_of_val(&self.neighbours[..]) + size_of_val(&self.runs[..])
    }

    /// Unit normals of the vertices from `first` on, one for each place in `out`. `positions` are those of all.
    pub(super) fn normals(&self, first: usize, positions: &[Lane], out: &mut [Vec3]) {
        let mut sums = [Lane::default(); BLOCK];
        let mut run = self.runs.partition_point(|run| run.first_vertex as usize <= first).saturating_sub(1);
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let (start, end) = (first + block * BLOCK, first + block * BLOCK + out.len());
            let mut vertex = start;
            while vertex < end {
                let RingRun { first_vertex, first_entry, len } = self.runs[run];
                let run_end = self.runs.get(run + 1).map_or(self.n_vertices, |next| next.first_vertex as usize);
                let stop = run_end.min(end);
                let entry = first_entry as usize + (vertex - first_vertex as usize) * len as usize;
                let rings = &self.neighbours[entry..entry + (stop - vertex) * len as usize];
                let sums = &mut sums[vertex - start..stop - start];
                let centres = &positions[vertex..stop];
                for ((sum, &centre), ring) in sums.iter_mut().zip(centres).zip(rings.chunks_exact(len as usize)) {
                    *sum = sum_of(centre, ring, positions);
                }
                vertex = stop;
                if stop == run_end {
                    run += 1;
                }
            }
            unit_vectors(&sums[..out.len()], out);
        }
    }
}

/// The cross products, as z, x, y, of successive sides from the centre. A ring has two entries or more.
///
/// The loop stays a loop: unrolled, the compiler tears the lanes apart.
#[inline(always)]
fn sum_of(centre: Lane, ring: &[u32], positions: &[Lane]) -> Lane {
    let mut last = positions[ring[0] as usize].minus(centre);
    let mut sum = Lane::default();
    for &neighbour in &ring[1..] {
        let side = positions[neighbour as usize].minus(centre);
        sum = sum.plus(last.cross_zxy(side));
        last = side;
    }
    sum
}

/// At most [`BLOCK`] sums as z, x, y, and as many places in `out`.
#[inline(always)]
pub(super) fn unit_vectors(sums: &[Lane], out: &mut [Vec3]) {
    let mut squared = [1.0_f32; BLOCK];
    for (squared, sum) in squared.iter_mut().zip(sums) {
        let [z, x, y, _] = sum.0.to_array();
        *squared = x * x + y * y + z * z;
    }
    let inverse = squared.map(|squared| 1.0 / ops::sqrt(squared));
    for (i, (out, sum)) in out.iter_mut().zip(sums).enumerate() {
        let [z, x, y, _] = sum.0.to_array();
        let sum = Vec3::new(x, y, z);
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
    use super::{FALLBACK, Lane, unit_vectors};
    use glam::Vec3;

    fn unit(sum: Vec3) -> Vec3 {
        let mut out = [Vec3::ZERO];
        unit_vectors(&[Lane::from(Vec3::new(sum.z, sum.x, sum.y))], &mut out);
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
