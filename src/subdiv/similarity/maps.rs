//! Affine maps from a representative to the others, and what runs in real time (thesis, sections 4.7.1 and 4.7.2).

use glam::{Affine3A, DAffine3, DVec3, Vec3};

use super::SimilarityError;
use super::classes::{Classes, Match};
use crate::math::ops;
use crate::mesh::{DedgeMesh, FaceId};
use crate::subdiv::plan::Plan;
use crate::subdiv::scheme::{Normals, PlanOptions, Scheme};
use crate::subdiv::stencil::StencilTable;
use crate::subdiv::tags::Tags;

/// The characteristic matrix of a triangle (figure 4.4): two sides, the normal, and the first corner. None without area.
///
/// The normal has the length of the root of twice the area, so that it grows as the sides do: with a unit normal, which
/// the figure may mean, the map between triangles of different size would flatten what lies above them.
fn characteristic(corners: [Vec3; 3], mirrored: bool) -> Option<DAffine3> {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let cross: DVec3 = (b - a).cross(c - a);
    let length = ops::sqrt(cross.length_squared());
    if length <= 0.0 || !length.is_finite() {
        return None;
    }
    let normal = cross / ops::sqrt(length) * if mirrored { -1.0 } else { 1.0 };
    Some(DAffine3::from_cols(b - a, c - a, normal, a))
}

/// The affine map that carries one triangle onto another, corner `by.corner(i)` of the other being where corner `i` goes, and
/// its outside to the other's outside. None where one has no area.
///
/// Between similar triangles it is a similarity. (The thesis eliminates after Gauss; an inverse of three by three is the
/// same.)
pub fn affine_map(from: [Vec3; 3], to: [Vec3; 3], by: Match) -> Option<DAffine3> {
    let source = characteristic(from, false)?;
    let target = characteristic(by.order().map(|corner| to[corner]), by.mirrored)?;
    Some(target * source.inverse())
}

/// One subdivision of a mesh, by subdividing one triangle of each class and mapping the rest.
///
/// It belongs to one set of positions: the classes and the maps are of them. Each vertex of the finer level is computed
/// once, by the first triangle that has it, so there are no cracks; the thesis leaves them open (section 4.9).
#[derive(Clone, Debug)]
pub struct Mapped {
    /// The points of each representative's patch, one patch after another.
    points: StencilTable,
    /// For each triangle the map from its representative.
    maps: Vec<Affine3A>,
    /// For each triangle where its part of `targets` ends.
    ends: Vec<u32>,
    /// Vertices of the finer level and the points that they are mapped from.
    targets: Vec<(u32, u32)>,
    n_fine: usize,
}

impl Mapped {
    /// For `depth` steps of Loop or butterfly over a mesh without tags, sorted into `classes` by these positions.
    ///
    /// # Errors
    /// Another scheme, positions that do not fit the mesh, a level that is too large.
    pub fn build(
        mesh: &DedgeMesh,
        positions: &[Vec3],
        classes: &Classes,
        scheme: Scheme,
        depth: u32,
    ) -> Result<Mapped, SimilarityError> {
        if !matches!(scheme, Scheme::Loop | Scheme::Butterfly) {
            return Err(SimilarityError::Scheme { scheme });
        }
        if positions.len() != mesh.n_vertices() {
            return Err(SimilarityError::Positions { expected: mesh.n_vertices(), given: positions.len() });
        }
        let options = PlanOptions { normals: Normals::None, ..PlanOptions::new(scheme, depth) };
        let plan = Plan::build_with(mesh, &Tags::default(), &options)?;
        let table = composed(plan.tables(), mesh.n_vertices());
        let patch = Patch::new(depth);

        let n_points = classes.len() * patch.n_points;
        let mut builder = StencilTable::builder(mesh.n_vertices(), n_points, 12 * n_points);
        for &representative in &classes.representatives {
            for vertex in patch.vertices(plan.indices(), representative) {
                let (sources, weights) = table.row(vertex as usize);
                sources.iter().zip(weights).for_each(|(&s, &w)| builder.entry(s, f64::from(w)));
                builder.end_row();
            }
        }
        let corners = |face: FaceId| mesh.corners(face).map(|v| positions[v.index()]);
        let mut mapped = Mapped {
            points: builder.finish(),
            maps: Vec::new(),
            ends: Vec::new(),
            targets: Vec::new(),
            n_fine: plan.n_vertices(),
        };
        let mut done = vec![false; plan.n_vertices()];
        for face in mesh.faces() {
            let (class, by) = (classes.class[face.index()], classes.by[face.index()]);
            let representative = classes.representatives[class as usize];
            let map = affine_map(corners(representative), corners(face), by).unwrap_or(DAffine3::IDENTITY);
            mapped.maps.push(Affine3A::from_cols(
                map.matrix3.x_axis.as_vec3a(),
                map.matrix3.y_axis.as_vec3a(),
                map.matrix3.z_axis.as_vec3a(),
                map.translation.as_vec3a(),
            ));
            for (vertex, place) in patch.vertices(plan.indices(), face).into_iter().zip(&patch.places) {
                if !std::mem::replace(&mut done[vertex as usize], true) {
                    let point = class as usize * patch.n_points + patch.point(by.order().map(|corner| place[corner]));
                    mapped.targets.push((vertex, point as u32));
                }
            }
            mapped.ends.push(mapped.targets.len() as u32);
        }
        Ok(mapped)
    }

    /// Number of vertices of the finer level.
    pub fn n_vertices(&self) -> usize {
        self.n_fine
    }

    /// Number of points that are subdivided; all others are mapped.
    pub fn n_points(&self) -> usize {
        self.points.n_rows()
    }

    /// Subdivides the representatives and maps the rest. `points` is scratch that is kept from call to call; `out` has a
    /// place for each vertex of the finer level.
    ///
    /// # Panics
    /// Where a length is another.
    pub fn run(&self, positions: &[Vec3], points: &mut Vec<Vec3>, out: &mut [Vec3]) {
        assert_eq!(out.len(), self.n_fine, "one place for each vertex of the finer level");
        points.resize(self.points.n_rows(), Vec3::ZERO);
        self.points.apply(positions, points);
        let mut start = 0;
        for (map, &end) in self.maps.iter().zip(&self.ends) {
            for &(vertex, point) in &self.targets[start..end as usize] {
                out[vertex as usize] = map.transform_point3(points[point as usize]);
            }
            start = end as usize;
        }
    }
}

/// All steps in one table.
pub(super) fn composed<W: crate::subdiv::stencil::Weight>(
    tables: &[StencilTable<W>],
    n_control: usize,
) -> StencilTable<W> {
    let mut tables = tables.iter();
    let Some(first) = tables.next() else {
        return StencilTable::selection(n_control, &(0..n_control as u32).collect::<Vec<_>>());
    };
    tables.fold(first.clone(), |coarser, table| table.compose(&coarser))
}

/// The points of a triangle that has been cut in four several times: a grid, each point by three whole numbers, how near it
/// is to each corner.
struct Patch {
    n_children: usize,
    n_points: usize,
    /// For each point.
    places: Vec<[u32; 3]>,
    /// For each point a child and a corner of it that lies there.
    corner: Vec<u32>,
    n: u32,
}

impl Patch {
    fn new(depth: u32) -> Patch {
        let n = 1 << depth;
        let mut children = vec![[[n, 0, 0], [0, n, 0], [0, 0, n]]];
        for _ in 0..depth {
            // As `quarters` numbers them.
            let split = |[a, b, c]: [[u32; 3]; 3]| {
                let middle = |p: [u32; 3], q: [u32; 3]| [0, 1, 2].map(|i| (p[i] + q[i]) / 2);
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
            };
            children = children.into_iter().flat_map(split).collect();
        }
        let n_points = ((n + 1) * (n + 2) / 2) as usize;
        let mut patch = Patch {
            n_children: children.len(),
            n_points,
            places: vec![[0; 3]; n_points],
            corner: vec![0; n_points],
            n,
        };
        for (corner, &place) in children.as_flattened().iter().enumerate() {
            let point = patch.point(place);
            patch.places[point] = place;
            patch.corner[point] = corner as u32;
        }
        patch
    }

    /// The number of the point at a place.
    fn point(&self, place: [u32; 3]) -> usize {
        let row = self.n - place[0];
        (row * (row + 1) / 2 + place[2]) as usize
    }

    /// For each point of a triangle's patch the vertex of the finer level.
    fn vertices(&self, indices: &[u32], face: FaceId) -> Vec<u32> {
        let first = 3 * self.n_children * face.index();
        self.corner.iter().map(|&corner| indices[first + corner as usize]).collect()
    }
}
