//! Vertex normals: area-weighted face normals, gathered around each vertex in one-ring order.
//!
//! A cross product of two sides is twice the area times the unit normal, so the plain sum over the faces around a vertex
//! is the weighted one. That sum is the vector area of the polygon that they fill, which depends on its outline alone: a
//! vertex inside the surface drops out, and the outline is taken two sides at a time as quadrilaterals, of which the cross
//! product of the diagonals is twice the vector area. Six triangles cost two cross products.
//!
//! Gathering, and not scattering, gives each sum one order whatever the number of threads.

use std::ops::Range;

use glam::Vec3;
use wide::f32x4;

use crate::math::ops;
use crate::mesh::VertexId;

use super::kernels::fetch;
use super::lane::Lane;
use super::stencil::all_below;

/// The normal where none is defined: the triangles around the vertex have no area, or a position is not finite.
const FALLBACK: Vec3 = Vec3::Y;

/// Below this squared length, in the units of area squared, the sum is scaled up before it is normalised.
pub(super) const TINY: f32 = 1e-30;
/// Above this one it is scaled down.
pub(super) const HUGE: f32 = 1e30;

/// The outline of the faces around each vertex, in compressed form: the one-ring inside the surface; on the boundary the
/// vertex itself and then its ring.
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
        let lists = (0..n_vertices as u32).map(VertexId).map(|vertex| {
            let itself = is_boundary(vertex).then_some(vertex.0);
            itself.into_iter().chain(ring(vertex).map(|v| v.0))
        });
        let rings = Rings::of_lists(lists, n_entries);
        // The kernels rely on it.
        assert!(all_below(&rings.neighbours, n_vertices), "a ring names a vertex that does not exist");
        rings
    }

    /// Rings as given, one after another.
    pub(super) fn of_lists<L: Iterator<Item = u32>>(lists: impl Iterator<Item = L>, n_entries: usize) -> Rings {
        let mut rings = Rings { neighbours: Vec::with_capacity(n_entries), runs: Vec::new(), n_vertices: 0 };
        for list in lists {
            let first_entry = rings.neighbours.len();
            rings.neighbours.extend(list);
            let len = (rings.neighbours.len() - first_entry) as u32;
            if rings.runs.last().is_none_or(|run| run.len != len) {
                let first_vertex = rings.n_vertices as u32;
                rings.runs.push(RingRun { first_vertex, first_entry: first_entry as u32, len });
            }
            rings.n_vertices += 1;
        }
        rings
    }

    /// The vertices of a run, their outlines, and the length of each.
    ///
    /// # Panics
    /// Where there is no such run.
    pub(super) fn run(&self, run: usize) -> (Range<usize>, &[u32], usize) {
        let RingRun { first_vertex, first_entry, len } = self.runs[run];
        let (first, len) = (first_vertex as usize, len as usize);
        let end = self.runs.get(run + 1).map_or(self.n_vertices, |next| next.first_vertex as usize);
        (first..end, &self.neighbours[first_entry as usize..][..len * (end - first)], len)
    }

    /// The ring of one vertex.
    ///
    /// # Panics
    /// Where there is no such vertex.
    pub(super) fn ring(&self, vertex: usize) -> &[u32] {
        assert!(vertex < self.n_vertices, "vertex {vertex} of {}", self.n_vertices);
        let run = self.runs[self.runs.partition_point(|run| run.first_vertex as usize <= vertex) - 1];
        let entry = run.first_entry as usize + (vertex - run.first_vertex as usize) * run.len as usize;
        &self.neighbours[entry..entry + run.len as usize]
    }

    /// For each vertex where its outline starts, and one entry more that ends the last; with an unused second number.
    pub(super) fn starts(&self) -> Vec<[u32; 2]> {
        let mut starts = Vec::with_capacity(self.n_vertices + 1);
        for (i, run) in self.runs.iter().enumerate() {
            let end = self.runs.get(i + 1).map_or(self.n_vertices as u32, |next| next.first_vertex);
            starts.extend((0..end - run.first_vertex).map(|k| [run.first_entry + k * run.len, 0]));
        }
        starts.push([self.neighbours.len() as u32, 0]);
        starts
    }

    /// Bytes of all rings.
    pub(super) fn n_bytes(&self) -> usize {
        size_of_val(&self.neighbours[..]) + size_of_val(&self.runs[..])
    }

    /// Unit normals of the vertices from `first` on, one for each place in `out`. `positions` are those of all.
    pub(super) fn normals(&self, first: usize, positions: &[Lane], out: &mut [Vec3]) {
        assert_eq!(positions.len(), self.n_vertices, "one position for each vertex");
        assert!(first + out.len() <= self.n_vertices, "at most one normal for each vertex");
        normals(self, first, positions, out);
    }
}

#[multiversion::multiversion(targets("x86_64+avx2", "x86_64+avx"))]
fn normals(rings: &Rings, first: usize, positions: &[Lane], out: &mut [Vec3]) {
    assert_eq!(positions.len(), rings.n_vertices, "one position for each vertex");
    rings.for_runs(first, out.len(), |at, len, outlines| {
        let out = &mut out[at];
        if let (6, (outlines, _)) = (len, outlines.as_chunks::<6>()) {
            unit_vectors(out, |i| vector_area(&outlines[i], positions));
        } else {
            unit_vectors(out, |i| vector_area(&outlines[i * len..(i + 1) * len], positions));
        }
    });
}

impl Rings {
    /// The outlines of `n` vertices from `first` on, run by run: places counted from `first`, the length of each outline,
    /// and all of them.
    #[inline(always)]
    fn for_runs(&self, first: usize, n: usize, mut work: impl FnMut(Range<usize>, usize, &[u32])) {
        let mut run = self.runs.partition_point(|run| run.first_vertex as usize <= first).saturating_sub(1);
        let (mut vertex, end) = (first, (first + n).min(self.n_vertices));
        while vertex < end {
            let RingRun { first_vertex, first_entry, len } = self.runs[run];
            let run_end = self.runs.get(run + 1).map_or(self.n_vertices, |next| next.first_vertex as usize);
            let (stop, len) = (run_end.min(end), len as usize);
            let entry = first_entry as usize + (vertex - first_vertex as usize) * len;
            work(vertex - first..stop - first, len, &self.neighbours[entry..entry + (stop - vertex) * len]);
            vertex = stop;
            run += 1;
        }
    }
}

/// Twice the vector area of a closed outline of two vertices or more.
#[inline(always)]
fn vector_area(outline: &[u32], positions: &[Lane]) -> Lane {
    let corner = fetch(positions, outline[0]);
    let mut sum = Lane::default();
    let mut i = 1;
    // From the corner over the next two to the third.
    while i + 2 < outline.len() {
        let (a, b) = (fetch(positions, outline[i]), fetch(positions, outline[i + 1]));
        let c = fetch(positions, outline[i + 2]);
        sum = sum.plus(b.minus(corner).cross(c.minus(a)));
        i += 2;
    }
    if i + 1 < outline.len() {
        let (a, b) = (fetch(positions, outline[i]), fetch(positions, outline[i + 1]));
        sum = sum.plus(a.minus(corner).cross(b.minus(corner)));
    }
    sum
}

/// Fills `out` with unit vectors along `sum(i)`, lanes that hold z, x, y: four at a time, since four square roots cost as
/// much as one.
#[inline(always)]
pub(super) fn unit_vectors(out: &mut [Vec3], mut sum: impl FnMut(usize) -> Lane) {
    let (fours, rest) = out.as_chunks_mut::<4>();
    let n_fours = 4 * fours.len();
    for (k, out) in fours.iter_mut().enumerate() {
        let sums = [sum(4 * k), sum(4 * k + 1), sum(4 * k + 2), sum(4 * k + 3)];
        let [z, x, y, _] = f32x4::transpose([sums[0].0, sums[1].0, sums[2].0, sums[3].0]);
        let squared = x * x + y * y + z * z;
        let inverse = f32x4::splat(1.0) / squared.sqrt();
        let lanes = f32x4::transpose([x * inverse, y * inverse, z * inverse, f32x4::splat(0.0)]);
        for i in 0..4 {
            out[i] = Lane(lanes[i]).into();
        }
        let squared = squared.to_array();
        let fine = |s: f32| s > TINY && s < HUGE;
        if !(fine(squared[0]) & fine(squared[1]) & fine(squared[2]) & fine(squared[3])) {
            settle_extremes(&sums, out);
        }
    }
    for (i, out) in rest.iter_mut().enumerate() {
        let [z, x, y, _] = sum(n_fours + i).0.to_array();
        *out = unit_of(Vec3::new(x, y, z));
    }
}

/// The unit vector along one sum.
pub(super) fn unit_of(sum: Vec3) -> Vec3 {
    let squared = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z;
    let inverse = 1.0 / ops::sqrt(squared);
    if squared > TINY && squared < HUGE {
        Vec3::new(sum.x * inverse, sum.y * inverse, sum.z * inverse)
    } else {
        unit_of_extreme(sum)
    }
}

/// Those whose squared length underflows or overflows, or that have none.
#[cold]
#[inline(never)]
fn settle_extremes(sums: &[Lane; 4], out: &mut [Vec3; 4]) {
    for (sum, out) in sums.iter().zip(out) {
        let [z, x, y, _] = sum.0.to_array();
        let sum = Vec3::new(x, y, z);
        if is_extreme(sum) {
            *out = unit_of_extreme(sum);
        }
    }
}

fn is_extreme(sum: Vec3) -> bool {
    let squared = sum.x * sum.x + sum.y * sum.y + sum.z * sum.z;
    !(squared > TINY && squared < HUGE)
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
        // One of four, and one alone.
        let mut out = [Vec3::ZERO; 5];
        unit_vectors(&mut out, |i| {
            let sum = if i == 1 || i == 4 { sum } else { Vec3::X };
            Lane::from(Vec3::new(sum.z, sum.x, sum.y))
        });
        assert_eq!((out[0], out[1]), (Vec3::X, out[4]));
        out[1]
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
