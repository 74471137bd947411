//! Values that differ from face to face at the same vertex: texture coordinates with seams.
//!
//! The control mesh is cut open along the seams, and the pieces are a mesh of their own with a plan of their own: seams are
//! boundaries there. Both plans make their faces in the same order with the corners in the same order, so that a corner of
//! the one is a corner of the other, and the vertices of the cut mesh are just those that a renderer needs: each vertex of
//! the surface once for each side of a seam.
//!
//! OpenSubdiv does the same with face-varying channels and leaves the same choices ([`UvLinear`]). Loop, butterfly and
//! Catmull-Clark keep edges, so a seam may run anywhere. √3 turns edges: here a seam must run where it does not, along a
//! crease that lasts or a boundary; [`SeamPlan`](super::SeamPlan) takes seams anywhere.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};

use crate::mesh::{DedgeId, DedgeMesh, FaceId, MeshError, PolygonMesh, VertexId};

use super::evaluate::Evaluator;
use super::plan::{Plan, PlanError};
use super::scheme::{BoundaryRule, Creasing, Normals, PlanOptions, Scheme, Split};
use super::tags::{INFINITE_SHARPNESS, Tags};

/// Where values are interpolated linearly instead of smoothly. Names in brackets are OpenSubdiv's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum UvLinear {
    /// Nowhere: seams are smooth curves (`FVAR_LINEAR_NONE`).
    None,
    /// Corners of the cut mesh with a single face stay (`FVAR_LINEAR_CORNERS_ONLY`).
    #[default]
    CornersOnly,
    /// Seams and boundaries are polylines, cut in equal parts (`FVAR_LINEAR_BOUNDARIES`).
    Boundaries,
    /// Everywhere (`FVAR_LINEAR_ALL`). Not for √3.
    All,
}

/// Why there is no plan for face-varying values.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FaceVaryingError {
    /// One value number is needed for each corner of each face.
    #[error("{given} value numbers for {expected} corners of faces")]
    CornerCount {
        /// Corners of the control mesh.
        expected: usize,
        /// Numbers given.
        given: usize,
    },
    /// A corner names a value that does not exist.
    #[error("a corner of face {face} names value {index}, but there are only {n_values}, numbered from 0")]
    IndexOutOfRange {
        /// The face.
        face: FaceId,
        /// What it names.
        index: u32,
        /// How many values there are.
        n_values: usize,
    },
    /// √3 turns the edge, so that faces would lie over the seam.
    #[error(
        "a seam runs from vertex {from} to {to}, but {} turns that edge: make it a crease that lasts all {levels} levels",
        scheme.name()
    )]
    SeamIsTurned {
        /// One end.
        from: VertexId,
        /// The other.
        to: VertexId,
        /// The scheme.
        scheme: Scheme,
        /// The levels of the plan.
        levels: u32,
    },
    /// Frozen on one side only: the seam would be cut in three on the other.
    #[error("a seam runs from vertex {from} to {to}, with a frozen face on one side only; freeze both or none")]
    SeamOnFrozenRim {
        /// One end.
        from: VertexId,
        /// The other.
        to: VertexId,
    },
    /// The scheme has no such values.
    #[error("{} has no face-varying values of this kind ({linear:?})", scheme.name())]
    Scheme {
        /// The scheme.
        scheme: Scheme,
        /// What was asked for.
        linear: UvLinear,
    },
    /// The plan of the surface belongs to another mesh or to other tags.
    #[error("the plan of the surface was not built from this mesh and these tags")]
    OtherPlan,
    /// The mesh cut open is no surface.
    #[error("cut along its seams the mesh is no surface: {0}")]
    Cut(#[from] MeshError),
    /// There is no plan for the cut mesh.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// A plan for values at the corners of faces, beside the plan of the surface. Built once, for any number of channels.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceVaryingPlan {
    plan: Plan,
    n_values: usize,
    /// For each control vertex of the cut mesh the value it takes.
    sources: Vec<u32>,
    /// For each vertex of the last level of the cut mesh that of the surface.
    vertices: Vec<u32>,
}

impl FaceVaryingPlan {
    /// For a surface of triangles: `surface` is its plan, built from `control` and `tags`. `corner_values` has for each
    /// corner of each control face, in the order of [`DedgeMesh::indices`], the number of its value, below `n_values`. A
    /// seam runs where two faces name different values at either end of their edge.
    ///
    /// A vertex that has the same value on both sides of a seam, where the cut does not end, stays where it is: smoothing
    /// each side for itself would tear it.
    ///
    /// # Errors
    /// Numbers that do not fit; a seam where the scheme turns edges; Doo-Sabin, which keeps neither edges nor vertices.
    pub fn build(
        surface: &Plan,
        control: &DedgeMesh,
        tags: &Tags,
        corner_values: &[u32],
        n_values: usize,
        linear: UvLinear,
    ) -> Result<FaceVaryingPlan, FaceVaryingError> {
        FaceVaryingPlan::build_polygons(surface, &control.into(), tags, corner_values, n_values, linear)
    }

    /// The same for polygons; corners in the order of the faces.
    ///
    /// # Errors
    /// The same.
    pub fn build_polygons(
        surface: &Plan,
        control: &PolygonMesh,
        tags: &Tags,
        corner_values: &[u32],
        n_values: usize,
        linear: UvLinear,
    ) -> Result<FaceVaryingPlan, FaceVaryingError> {
        let scheme = surface.scheme();
        if scheme == Scheme::DooSabin || (linear == UvLinear::All && scheme.split() == Split::Thirds) {
            return Err(FaceVaryingError::Scheme { scheme, linear });
        }
        if surface.n_control() != control.n_vertices() {
            return Err(FaceVaryingError::OtherPlan);
        }
        let cut = Cut::new(control, tags, corner_values, n_values)?;
        if scheme.split() == Split::Thirds {
            cut.check_turned(tags, surface.options())?;
        }
        let sizes: Vec<u32> = control.faces().map(|face| control.corners(face).len() as u32).collect();
        let mesh = PolygonMesh::from_faces(cut.sources.len(), &sizes, &cut.sector)?;
        let uv_tags = cut.tags(&mesh, tags, surface.options(), linear);
        let boundary = if linear == UvLinear::None { BoundaryRule::EdgeOnly } else { BoundaryRule::EdgeAndCorner };
        let options = PlanOptions { boundary, normals: Normals::None, ..*surface.options() };
        let plan = if scheme.is_triangular() {
            let triangles = DedgeMesh::from_triangles(cut.sources.len(), cut.sector.as_chunks().0)?;
            Plan::build_with(&triangles, &uv_tags, &options)?
        } else {
            Plan::build_polygons(&mesh, &uv_tags, &options)?
        };
        let vertices = vertices_of(&plan, surface).ok_or(FaceVaryingError::OtherPlan)?;
        Ok(FaceVaryingPlan { plan, n_values, sources: cut.sources, vertices })
    }

    /// The plan of the cut mesh: its faces are those of the surface's plan, in the same order, with the vertices of the cut
    /// mesh at their corners; its index buffer is what a renderer draws.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// For each vertex that a renderer needs, which is a vertex of the cut mesh's last level, the vertex of the surface's
    /// last level that has its position and normal.
    pub fn render_vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// The value of each control vertex of the cut mesh: what the plan is evaluated with.
    ///
    /// # Panics
    /// Where `values` has another length than was said when it was built.
    pub fn control_values<T: Copy>(&self, values: &[T]) -> Vec<T> {
        assert_eq!(values.len(), self.n_values, "as many values as the plan was built for");
        self.sources.iter().map(|&source| values[source as usize]).collect()
    }

    /// Three channels for each vertex that a renderer needs, from one value for each number. The evaluator is best kept for
    /// this plan alone: it fits its buffers to the plan at hand.
    ///
    /// # Panics
    /// Where `values` has another length than was said when it was built.
    pub fn evaluate(&self, evaluator: &mut Evaluator, values: &[Vec3]) -> Vec<Vec3> {
        let mut out = vec![Vec3::ZERO; self.plan.n_vertices()];
        evaluator.evaluate_attribute(&self.plan, &self.control_values(values), &mut out);
        out
    }

    /// Texture coordinates for each vertex that a renderer needs, with buffers of its own. They change only with the plan.
    ///
    /// # Panics
    /// Where `uvs` has another length than was said when it was built.
    pub fn evaluate_uvs(&self, uvs: &[Vec2]) -> Vec<Vec2> {
        let values: Vec<Vec3> = uvs.iter().map(|uv| uv.extend(0.0)).collect();
        self.evaluate(&mut Evaluator::new(&self.plan), &values).into_iter().map(Vec3::truncate).collect()
    }
}

/// For each vertex of the cut plan that of the surface's, by the corners of their faces; none where these do not agree.
fn vertices_of(cut: &Plan, surface: &Plan) -> Option<Vec<u32>> {
    let ((cut_sizes, cut_corners), (sizes, corners)) = (cut.faces(), surface.faces());
    if cut_sizes != sizes || cut_corners.len() != corners.len() {
        return None;
    }
    let mut vertices = vec![u32::MAX; cut.n_vertices()];
    for (&uv, &vertex) in cut_corners.iter().zip(corners) {
        let known = &mut vertices[uv as usize];
        if *known != u32::MAX && *known != vertex {
            return None;
        }
        *known = vertex;
    }
    Some(vertices)
}

/// Whether each face is listed. Those that do not exist are the plan's to report.
fn marked(faces: &[FaceId], n_faces: usize) -> Vec<bool> {
    let mut marked = vec![false; n_faces];
    for face in faces.iter().filter(|face| face.index() < n_faces) {
        marked[face.index()] = true;
    }
    marked
}

/// A control mesh cut open along its seams.
pub(super) struct Cut<'a> {
    control: &'a PolygonMesh,
    is_hole: Vec<bool>,
    /// For each corner its vertex of the cut mesh.
    pub(super) sector: Vec<u32>,
    /// For each vertex of the cut mesh its value.
    pub(super) sources: Vec<u32>,
    /// Where the vertices of the cut mesh begin that each control vertex has become; one entry more than there are.
    offsets: Vec<u32>,
    values: &'a [u32],
}

impl<'a> Cut<'a> {
    pub(super) fn new(
        control: &'a PolygonMesh,
        tags: &Tags,
        values: &'a [u32],
        n_values: usize,
    ) -> Result<Cut<'a>, FaceVaryingError> {
        if values.len() != control.n_dedges() {
            return Err(FaceVaryingError::CornerCount { expected: control.n_dedges(), given: values.len() });
        }
        if let Some(dedge) = control.dedges().find(|d| values[d.index()] as usize >= n_values) {
            let (face, index) = (control.face(dedge), values[dedge.index()]);
            return Err(FaceVaryingError::IndexOutOfRange { face, index, n_values });
        }
        let is_hole = marked(&tags.holes, control.n_faces());
        let (sector, offsets) = (vec![0; values.len()], Vec::with_capacity(control.n_vertices() + 1));
        let mut cut = Cut { control, is_hole, sector, sources: Vec::new(), offsets, values };
        for vertex in control.vertices() {
            cut.offsets.push(cut.sources.len() as u32);
            cut.split(vertex);
        }
        cut.offsets.push(cut.sources.len() as u32);
        Ok(cut)
    }

    /// Whether the faces on both sides of an edge hang together: there are two, and they name the same values.
    fn is_whole(&self, dedge: DedgeId) -> bool {
        self.control.twin(dedge).is_some_and(|twin| {
            let same = |a: DedgeId, b: DedgeId| self.values[a.index()] == self.values[b.index()];
            let hole = |d: DedgeId| self.is_hole[self.control.face(d).index()];
            let (next, twin_next) = (self.control.next(dedge), self.control.next(twin));
            same(dedge, twin_next) && same(next, twin) && hole(dedge) == hole(twin)
        })
    }

    /// Numbers the sectors of faces at a vertex that hang together, counter-clockwise.
    fn split(&mut self, vertex: VertexId) {
        let dedges: Vec<DedgeId> = self.control.outgoing_dedges(vertex).collect();
        let first = self.sources.len();
        for (i, &dedge) in dedges.iter().enumerate() {
            if i == 0 || !self.is_whole(dedge) {
                self.sources.push(self.values[dedge.index()]);
            }
            self.sector[dedge.index()] = self.sources.len() as u32 - 1;
        }
        // Around an inner vertex the last sector may hang together with the first.
        let last = self.sources.len() - 1;
        if last > first && self.is_whole(dedges[0]) {
            self.sources.pop();
            for dedge in dedges.iter().rev().take_while(|d| self.sector[d.index()] as usize == last).collect::<Vec<_>>()
            {
                self.sector[dedge.index()] = first as u32;
            }
        }
    }

    fn sectors(&self, vertex: VertexId) -> std::ops::Range<u32> {
        self.offsets[vertex.index()]..self.offsets[vertex.index() + 1]
    }

    /// Seams between two faces that are there, by the side with the lower number.
    fn seams(&self) -> impl Iterator<Item = (DedgeId, DedgeId)> + '_ {
        let there = |d: DedgeId| !self.is_hole[self.control.face(d).index()];
        self.control.dedges().filter_map(move |dedge| {
            let twin = self.control.twin(dedge).filter(|&twin| dedge < twin && there(dedge) && there(twin))?;
            (!self.is_whole(dedge)).then_some((dedge, twin))
        })
    }

    /// For √3: whether every seam runs where edges stay.
    fn check_turned(&self, tags: &Tags, options: &PlanOptions) -> Result<(), FaceVaryingError> {
        let lasts = |sharpness: f32| {
            let uniform = options.creasing == Creasing::Uniform;
            sharpness >= INFINITE_SHARPNESS
                || (uniform && sharpness > 0.0 && sharpness > (options.levels.saturating_sub(1) / 2) as f32)
        };
        let is_frozen = marked(&tags.frozen, self.control.n_faces());
        // Of an edge named twice the last counts.
        let named = |a: VertexId, b: VertexId| (a.min(b), a.max(b));
        let creases: BTreeMap<_, f32> =
            tags.creases.iter().map(|&(a, b, sharpness)| (named(a, b), sharpness)).collect();
        for (dedge, twin) in self.seams() {
            let (from, to) = (self.control.origin(dedge), self.control.origin(twin));
            let frozen = [dedge, twin].map(|d| is_frozen[self.control.face(d).index()]);
            if frozen[0] != frozen[1] {
                return Err(FaceVaryingError::SeamOnFrozenRim { from, to });
            }
            let is_kept = creases.get(&named(from, to)).is_some_and(|&sharpness| lasts(sharpness));
            if !frozen[0] && options.levels > 0 && !is_kept {
                let (scheme, levels) = (options.scheme, options.levels);
                return Err(FaceVaryingError::SeamIsTurned { from, to, scheme, levels });
            }
        }
        Ok(())
    }

    /// The tags of the control mesh on the cut one, and what makes it linear where it should be.
    pub(super) fn tags(&self, mesh: &PolygonMesh, tags: &Tags, options: &PlanOptions, linear: UvLinear) -> Tags {
        let control = self.control;
        let mut cut = Tags { holes: tags.holes.clone(), frozen: tags.frozen.clone(), ..Tags::default() };
        let known = |v: VertexId| v.index() < control.n_vertices();
        for &(a, b, sharpness) in tags.creases.iter().filter(|c| known(c.0) && known(c.1)) {
            for (from, to) in [(a, b), (b, a)] {
                if let Some(dedge) = control.outgoing_dedges(from).find(|&d| control.target(d) == to) {
                    let ends = [dedge, control.next(dedge)].map(|d| VertexId(self.sector[d.index()]));
                    cut.creases.push((ends[0], ends[1], sharpness));
                }
            }
        }
        for &(vertex, sharpness) in tags.corners.iter().filter(|c| known(c.0)) {
            cut.corners.extend(self.sectors(vertex).map(|s| (VertexId(s), sharpness)));
        }
        let there = |d: DedgeId| !self.is_hole[control.face(d).index()];
        let mut is_used = vec![false; self.sources.len()];
        control.dedges().filter(|&d| there(d)).for_each(|d| is_used[self.sector[d.index()] as usize] = true);
        for vertex in control.vertices() {
            let sectors = self.sectors(vertex);
            // Torn apart with one value, or a corner of the surface itself.
            let mut values: Vec<u32> =
                sectors.clone().filter(|&s| is_used[s as usize]).map(|s| self.sources[s as usize]).collect();
            values.sort_unstable();
            let torn = values.windows(2).any(|pair| pair[0] == pair[1]);
            let is_corner = options.boundary == BoundaryRule::EdgeAndCorner
                && control.outgoing_dedges(vertex).filter(|&d| there(d)).count() == 1;
            if torn || is_corner {
                cut.corners.extend(sectors.map(|s| (VertexId(s), INFINITE_SHARPNESS)));
            }
        }
        match linear {
            UvLinear::None | UvLinear::CornersOnly => {}
            UvLinear::Boundaries => {
                // A hole opens a boundary too.
                let open = |d: DedgeId| mesh.twin(d).is_none() || !there(d);
                let mut on_boundary = vec![false; mesh.n_vertices()];
                for dedge in mesh.dedges().filter(|&d| open(d)) {
                    on_boundary[mesh.origin(dedge).index()] = true;
                    on_boundary[mesh.target(dedge).index()] = true;
                }
                let boundary = mesh.vertices().filter(|v| on_boundary[v.index()]);
                cut.corners.extend(boundary.map(|v| (v, INFINITE_SHARPNESS)));
            }
            UvLinear::All => {
                cut.creases = mesh.dedges().map(|d| (mesh.origin(d), mesh.target(d), INFINITE_SHARPNESS)).collect();
                cut.corners = mesh.vertices().map(|v| (v, INFINITE_SHARPNESS)).collect();
            }
        }
        cut
    }
}
