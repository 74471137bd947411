//! Vertex normals: area-weighted face normals, gathered around each vertex in one-ring order.
//!
//! A cross product of two sides is twice the area times the unit normal, so the plain sum over the faces around a vertex
//! is the weighted one. That sum is the vector area of the polygon that they fill, which depends on its outline alone: a
//! vertex inside the surface drops out, and the outline is taken two sides at a time as quadrilaterals, of which the cross
//! product of the diagonals is twice the vector area. Six triangles cost two cross products.
//!
//! Gathering, and not scattering, gives each sum one order whatever the number of threads.

use glam::Vec3;
use wide::f32x8;

use crate::math::ops;
use crate::mesh::VertexId;

use super::kernels::fetch;
use super::lane::{Lane, Octet, Value};
use super::stencil::all_below;

/// The normal where none is defined: the triangles around the vertex have no area, or a position is not finite.
const FALLBACK: Vec3 = Vec3::Y;

/// Below this squared length, in the units of area squared, the sum is scaled up before it is normalised.
const TINY: f32 = 1e-30;
/// Above this one it is scaled down.
const HUGE: f32 = 1e30;

/// Vertices whose sums are made unit vectors together.
pub(super) const BLOCK: usize = 64;

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
        let mut neighbours = Vec::with_capacity(n_entries);
        let mut runs: Vec<RingRun> = Vec::new();
        for vertex in (0..n_vertices as u32).map(VertexId) {
            let first_entry = neighbours.len();
            if is_boundary(vertex) {
                neighbours.push(vertex.0);
            }
            neighbours.extend(ring(vertex).map(|v| v.0));
            let len = (neighbours.len() - first_entry) as u32;
            if runs.last().is_none_or(|run| run.len != len) {
                runs.push(RingRun { first_vertex: vertex.0, first_entry: first_entry as u32, len });
            }
        }
        // The kernels rely on it.
        assert!(all_below(&neighbours, n_vertices), "a ring names a vertex that does not exist");
        Rings { neighbours, runs, n_vertices }
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
    let mut sums = Sums::default();
    for (block, out) in out.chunks_mut(BLOCK).enumerate() {
        rings.vector_areas(first + block * BLOCK, out.len(), positions, |i, area| sums.set(i, area));
        sums.unit_vectors(out);
    }
}

/// Unit normals of eight heads, of the vertices from `first` on, into as many places from `first` on of each of `heads`.
#[multiversion::multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "x86_64+avx"))]
pub(super) fn octet_normals(rings: &Rings, positions: &[Octet], heads: &mut [&mut [Vec3]]) {
    let mut areas = [Octet::default(); BLOCK];
    let mut first = 0;
    while first < rings.n_vertices {
        let n = BLOCK.min(rings.n_vertices - first);
        rings.vector_areas(first, n, positions, |i, area| areas[i] = area);
        for (i, &area) in areas[..n].iter().enumerate() {
            let squared = area.squared();
            let inverse = f32x8::splat(1.0) / squared.sqrt();
            (area * inverse).scatter(heads, first + i);
            let squared = squared.to_array();
            if squared.iter().any(|&squared| !(squared > TINY && squared < HUGE)) {
                settle_octet(area, first + i, heads);
            }
        }
        first += n;
    }
}

#[cold]
fn settle_octet(area: Octet, vertex: usize, heads: &mut [&mut [Vec3]]) {
    let (x, y, z) = (area.x.to_array(), area.y.to_array(), area.z.to_array());
    for (head, out) in heads.iter_mut().enumerate() {
        let sum = Vec3::new(x[head], y[head], z[head]);
        if is_extreme(sum) {
            out[vertex] = unit_of_extreme(sum);
        }
    }
}

impl Rings {
    /// Twice the vector area around each of `n` vertices from `first` on, handed over with its index from 0.
    #[inline(always)]
    fn vector_areas<V: Value>(&self, first: usize, n: usize, positions: &[V], mut put: impl FnMut(usize, V)) {
        assert_eq!(positions.len(), self.n_vertices, "one position for each vertex");
        let mut run = self.runs.partition_point(|run| run.first_vertex as usize <= first).saturating_sub(1);
        let (mut vertex, end) = (first, (first + n).min(self.n_vertices));
        while vertex < end {
            let RingRun { first_vertex, first_entry, len } = self.runs[run];
            let run_end = self.runs.get(run + 1).map_or(self.n_vertices, |next| next.first_vertex as usize);
            let (stop, len) = (run_end.min(end), len as usize);
            let entry = first_entry as usize + (vertex - first_vertex as usize) * len;
            let outlines = &self.neighbours[entry..entry + (stop - vertex) * len];
            if let (6, (outlines, _)) = (len, outlines.as_chunks::<6>()) {
                for (i, outline) in (vertex - first..stop - first).zip(outlines) {
                    put(i, vector_area(outline, positions));
                }
            } else {
                for (i, outline) in (vertex - first..stop - first).zip(outlines.chunks_exact(len)) {
                    put(i, vector_area(outline, positions));
                }
            }
            vertex = stop;
            run += 1;
        }
    }
}

/// Twice the vector area of a closed outline of two vertices or more.
#[inline(always)]
fn vector_area<V: Value>(outline: &[u32], positions: &[V]) -> V {
    let corner = fetch(positions, outline[0]);
    let mut sum = V::default();
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

/// Vectors that are to become unit vectors, coordinate by coordinate: eight square roots cost as much as one.
pub(super) struct Sums {
    x: [f32; BLOCK],
    y: [f32; BLOCK],
    z: [f32; BLOCK],
}

impl Default for Sums {
    fn default() -> Self {
        Sums { x: [1.0; BLOCK], y: [0.0; BLOCK], z: [0.0; BLOCK] }
    }
}

impl Sums {
    /// Sets one of at most [`BLOCK`] from a lane that holds z, x, y.
    #[inline(always)]
    pub(super) fn set(&mut self, i: usize, sum: Lane) {
        let [z, x, y, _] = sum.0.to_array();
        (self.x[i], self.y[i], self.z[i]) = (x, y, z);
    }

    /// Writes the first `out.len()` of them, at most [`BLOCK`], as unit vectors.
    #[inline(always)]
    pub(super) fn unit_vectors(&self, out: &mut [Vec3]) {
        let mut inverse = [0.0_f32; BLOCK];
        let mut extreme = false;
        for i in 0..BLOCK {
            let (x, y, z) = (self.x[i], self.y[i], self.z[i]);
            let squared = x * x + y * y + z * z;
            extreme |= !(squared > TINY && squared < HUGE);
            inverse[i] = 1.0 / ops::sqrt(squared);
        }
        for (i, out) in out.iter_mut().enumerate() {
            *out = Vec3::new(self.x[i] * inverse[i], self.y[i] * inverse[i], self.z[i] * inverse[i]);
        }
        if extreme {
            self.settle_extremes(out);
        }
    }

    /// Those whose squared length underflows or overflows, or that have none.
    #[cold]
    fn settle_extremes(&self, out: &mut [Vec3]) {
        for (i, out) in out.iter_mut().enumerate() {
            let sum = Vec3::new(self.x[i], self.y[i], self.z[i]);
            if is_extreme(sum) {
                *out = unit_of_extreme(sum);
            }
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
    use super::{FALLBACK, Lane, Sums};
    use glam::Vec3;

    fn unit(sum: Vec3) -> Vec3 {
        let mut out = [Vec3::ZERO];
        let mut sums = Sums::default();
        sums.set(0, Lane::from(Vec3::new(sum.z, sum.x, sum.y)));
        sums.unit_vectors(&mut out);
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
