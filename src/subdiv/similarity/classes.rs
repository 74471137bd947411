//! Classes of strictly ε-similar triangles (thesis, definition 4.6.1 and section 4.6).
//!
//! Two triangles are strictly similar where they are ε-similar, and so are the triangles around them, one beside the other,
//! and the valences agree. The figure with the vertices v1 to v9 is not legible in the scan; taken here are all triangles
//! that share a vertex with the one at hand, walked around its corners in order, and the valences of all their vertices.
//!
//! That fixes lengths and angles within the surface, not how it is folded: two such neighbourhoods need not be congruent,
//! and a map from one to the other need not be exact. The thesis asks for equal angles between planes only within patches
//! (figure 4.3). [`Criteria::folds`] asks for them here too.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};

use super::SimilarityError;
use super::measures::{TriangleShape, Weights};
use crate::math::ops;
use crate::mesh::{DedgeId, DedgeMesh, FaceId};

/// When two triangles count as similar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Criteria {
    /// Of the measures.
    pub weights: Weights,
    /// Largest weighted sum of measures between two triangles. The thesis takes 0; rounded positions need more.
    pub epsilon: f64,
    /// Whether the folds around must agree too: largest squared difference of angles between planes, in radians, `epsilon`.
    pub folds: bool,
    /// Whether a mirror image will do. The thesis does not say; an affine map may be one.
    pub mirrored: bool,
}

impl Default for Criteria {
    /// Angles alone, as in the thesis, to 1e-4 rad; mirror images too; folds as they come.
    fn default() -> Criteria {
        Criteria { weights: Weights::default(), epsilon: 1e-8, folds: false, mirrored: true }
    }
}

/// How a triangle lies on another: which of its corners stands for which.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Match {
    /// The corner that stands for corner 0.
    pub turn: u8,
    /// Whether the others follow clockwise.
    pub mirrored: bool,
}

impl Match {
    /// The corner that stands for corner `i`.
    pub fn corner(self, i: usize) -> usize {
        let turn = usize::from(self.turn);
        if self.mirrored { (turn + 3 - i % 3) % 3 } else { (turn + i) % 3 }
    }

    /// All three corners.
    pub fn order(self) -> [usize; 3] {
        [0, 1, 2].map(|i| self.corner(i))
    }

    pub(super) fn all(mirrored: bool) -> impl Iterator<Item = Match> {
        let some = |mirrored| (0..3).map(move |turn| Match { turn, mirrored });
        some(false).chain(some(true).take(if mirrored { 3 } else { 0 }))
    }
}

/// A triangle mesh with the shape of each triangle and the fold at each edge.
#[derive(Clone, Debug)]
pub struct Shapes<'a> {
    mesh: &'a DedgeMesh,
    shapes: Vec<TriangleShape>,
    /// For each directed edge the angle between the planes on both sides, in radians: 0 where flat, positive where convex,
    /// 0 on the boundary.
    folds: Vec<f64>,
    valences: Vec<u32>,
}

/// A triangle met on the walk around another: itself, and which of its corners comes first.
#[derive(Clone, Copy, Debug)]
struct Visit {
    face: u32,
    first: Match,
    /// The edge that was crossed.
    across: u32,
}

/// The surroundings of a triangle as a walk meets them.
#[derive(Clone, Debug, Default)]
struct Walk {
    /// Valences, with boundaries marked, and how many triangles each walk met.
    code: Vec<u32>,
    visits: Vec<Visit>,
}

/// Written to the code where a walk comes to a boundary.
const BOUNDARY: u32 = u32::MAX;

impl<'a> Shapes<'a> {
    /// Measures all triangles.
    ///
    /// # Errors
    /// Where there are not as many positions as vertices.
    pub fn new(mesh: &'a DedgeMesh, positions: &[Vec3]) -> Result<Shapes<'a>, SimilarityError> {
        if positions.len() != mesh.n_vertices() {
            return Err(SimilarityError::Positions { expected: mesh.n_vertices(), given: positions.len() });
        }
        let corners = |face: FaceId| mesh.corners(face).map(|v| positions[v.index()]);
        let shapes = mesh.faces().map(|face| TriangleShape::of(corners(face))).collect();
        let normals: Vec<DVec3> = mesh
            .faces()
            .map(|face| {
                let [a, b, c] = corners(face).map(Vec3::as_dvec3);
                (b - a).cross(c - a).normalize_or_zero()
            })
            .collect();
        let fold = |dedge: DedgeId| {
            let Some(twin) = mesh.twin(dedge) else { return 0.0 };
            let [left, right] = [dedge, twin].map(|d| normals[d.face().index()]);
            let along = (positions[mesh.target(dedge).index()] - positions[mesh.origin(dedge).index()]).as_dvec3();
            ops::atan2(left.cross(right).dot(along.normalize_or_zero()), left.dot(right))
        };
        let folds = mesh.dedges().map(fold).collect();
        Ok(Shapes { mesh, shapes, folds, valences: valences(mesh) })
    }

    /// The mesh that was measured.
    pub fn mesh(&self) -> &'a DedgeMesh {
        self.mesh
    }

    /// The shape of each triangle.
    pub fn shapes(&self) -> &[TriangleShape] {
        &self.shapes
    }

    /// The angle between the planes on both sides of an edge, in radians: 0 where flat or on the boundary, positive where
    /// convex.
    pub fn fold(&self, dedge: DedgeId) -> f64 {
        self.folds[dedge.index()]
    }

    /// Whether `other`, laid on `face` as the match says, is strictly similar to it.
    pub fn are_strictly_similar(&self, face: FaceId, other: FaceId, by: Match, criteria: &Criteria) -> bool {
        if !self.are_alike(criteria, (face.0, Match::default()), (other.0, by)) {
            return false;
        }
        let (mut here, mut there) = (Walk::default(), Walk::default());
        walk(self.mesh, &self.valences, face, Match::default(), &mut here);
        walk(self.mesh, &self.valences, other, by, &mut there);
        here.code == there.code && self.surroundings_agree(criteria, &here, &there)
    }

    fn are_alike(&self, criteria: &Criteria, (a, first): (u32, Match), (b, second): (u32, Match)) -> bool {
        // Corner `first(i)` of the one lies on corner `second(i)` of the other.
        let mut order = [0; 3];
        (0..3).for_each(|i| order[first.corner(i)] = second.corner(i));
        let (a, b) = (&self.shapes[a as usize], &self.shapes[b as usize]);
        criteria.weights.measure_in_order(a, b, order) <= criteria.epsilon
    }

    fn surroundings_agree(&self, criteria: &Criteria, here: &Walk, there: &Walk) -> bool {
        here.visits.iter().zip(&there.visits).all(|(a, b)| {
            self.are_alike(criteria, (a.face, a.first), (b.face, b.first))
                && (!criteria.folds || self.folds_agree(criteria, DedgeId(a.across), DedgeId(b.across)))
        })
    }

    pub(super) fn folds_agree(&self, criteria: &Criteria, a: DedgeId, b: DedgeId) -> bool {
        let difference = self.fold(a) - self.fold(b);
        difference * difference <= criteria.epsilon
    }

    /// Sorts all triangles into classes of strictly similar ones: each into the first class whose representative, its first
    /// triangle, it is similar to. (The thesis unites any two similar ones in turn; with ε above 0 similarity does not pass
    /// on from one to the next, so that chains of it would grow. Its time is quadratic in the triangles; this is that in the
    /// classes.)
    pub fn classes(&self, criteria: &Criteria) -> Classes {
        let mut classes = Classes { class: Vec::new(), by: Vec::new(), representatives: Vec::new() };
        let mut walks: Vec<Walk> = Vec::new();
        let mut by_code: BTreeMap<Vec<u32>, Vec<u32>> = BTreeMap::new();
        let mut here = Walk::default();
        for face in self.mesh.faces() {
            let mut found: Option<(u32, Match)> = None;
            for by in Match::all(criteria.mirrored) {
                walk(self.mesh, &self.valences, face, by, &mut here);
                let candidates = by_code.get(&here.code).into_iter().flatten();
                let fits = |&&class: &&u32| {
                    let representative: FaceId = classes.representatives[class as usize];
                    self.are_alike(criteria, (representative.0, Match::default()), (face.0, by))
                        && self.surroundings_agree(criteria, &walks[class as usize], &here)
                };
                if let Some(&class) = candidates.take_while(|c| found.is_none_or(|(best, _)| **c < best)).find(fits) {
                    found = Some((class, by));
                }
            }
            let (class, by) = found.unwrap_or_else(|| {
                let class = classes.representatives.len() as u32;
                walk(self.mesh, &self.valences, face, Match::default(), &mut here);
                by_code.entry(here.code.clone()).or_default().push(class);
                walks.push(here.clone());
                classes.representatives.push(face);
                (class, Match::default())
            });
            classes.class.push(class);
            classes.by.push(by);
        }
        classes
    }
}

/// Classes of strictly similar triangles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Classes {
    /// For each triangle its class.
    pub class: Vec<u32>,
    /// For each triangle how it lies on its representative.
    pub by: Vec<Match>,
    /// For each class its first triangle.
    pub representatives: Vec<FaceId>,
}

impl Classes {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.representatives.len()
    }

    /// Whether there are none, which no mesh has.
    pub fn is_empty(&self) -> bool {
        self.representatives.is_empty()
    }
}

pub(super) fn valences(mesh: &DedgeMesh) -> Vec<u32> {
    // On the boundary one more, and marked.
    mesh.vertices().map(|v| 2 * mesh.valence(v) as u32 + u32::from(mesh.is_boundary_vertex(v))).collect()
}

/// What a walk around a triangle meets, starting at a corner of choice: the numbers of the vertices, and `mark` of each side
/// that is crossed with the triangle beyond it.
pub(super) fn code_around(
    mesh: &DedgeMesh,
    numbers: &[u32],
    mark: impl Fn(DedgeId, FaceId) -> [u32; 2],
    face: FaceId,
    turn: u8,
) -> Vec<u32> {
    let mut here = Walk::default();
    walk(mesh, numbers, face, Match { turn, mirrored: false }, &mut here);
    let marks = here.visits.iter().flat_map(|visit| mark(DedgeId(visit.across), FaceId(visit.face)));
    here.code.extend(marks);
    here.code
}

/// From a directed edge to the next one around its origin: the edge that is crossed, and where that leads.
type Step = fn(&DedgeMesh, DedgeId) -> (DedgeId, Option<DedgeId>);

fn walk(mesh: &DedgeMesh, valences: &[u32], face: FaceId, by: Match, into: &mut Walk) {
    into.code.clear();
    into.visits.clear();
    for corner in by.order() {
        let start = face.dedge(corner as u32);
        into.code.push(valences[mesh.origin(start).index()]);
        // Counter-clockwise over the side before, or clockwise over the side itself; at a boundary, then the other way.
        let steps: [Step; 2] = [
            |mesh, dedge| (dedge.prev(), mesh.twin(dedge.prev())),
            |mesh, dedge| (dedge, mesh.twin(dedge).map(DedgeId::next)),
        ];
        let first = usize::from(by.mirrored);
        for step in [steps[first], steps[1 - first]] {
            let mut dedge = start;
            let closed = loop {
                let (across, onward) = step(mesh, dedge);
                match onward {
                    None => break false,
                    Some(onward) if onward == start => break true,
                    Some(onward) => {
                        dedge = onward;
                        let first = Match { turn: (dedge.0 % 3) as u8, mirrored: by.mirrored };
                        into.visits.push(Visit { face: dedge.face().0, first, across: across.0 });
                        let order = first.order();
                        into.code.extend(
                            [order[1], order[2]].map(|k| valences[mesh.origin(dedge.face().dedge(k as u32)).index()]),
                        );
                    }
                }
            };
            if closed {
                break;
            }
            into.code.push(BOUNDARY);
        }
    }
}
