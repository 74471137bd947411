//! Texture coordinates for √3, which turns the edges that a seam runs along.
//!
//! As in [`FaceVaryingPlan`](super::FaceVaryingPlan) the mesh cut open along its seams has a plan of its own, in which
//! seams are boundaries. Over two steps √3 cuts every edge in three, turned or not (Kobbelt 2000), so at even levels the
//! cut mesh has the faces of the surface, and its vertices are vertices of the surface. At odd levels the surface's faces
//! lie across the seam, two on each of its edges, where the cut mesh has two faces on either side that end there:
//!
//! ```text
//!         b                    b         X, Y: in the middle of the faces beside seam edge a-b
//!       / | \                / | \       the surface draws (a, Y, X) and (b, X, Y),
//!     X---+---Y            X---m---Y     the cut mesh (a, b, X) and (b, a, Y);
//!       \ | /                \ | /       with m in the middle of X and Y, all four halves
//!         a                    a         lie in the faces that the surface draws.
//! ```
//!
//! So what is drawn with seams is the same surface to the bit, with the faces across a seam cut in two.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};

use crate::mesh::{DedgeId, DedgeMesh, FaceId, PolygonMesh};

use super::evaluate::Evaluator;
use super::face_varying::{Cut, FaceVaryingError, UvLinear};
use super::level::Level;
use super::plan::Plan;
use super::prepare::{self, Prepared};
use super::refined::VertexParent;
use super::scheme::{BoundaryRule, BoundaryStep, Normals, PlanOptions, Scheme};
use super::steps::{Last, triangle_step};
use super::tags::Tags;
use super::thirds;

const NONE: u32 = u32::MAX;

/// What is drawn of a √3 surface with seams anywhere. Built once for a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct SeamPlan {
    plan: Plan,
    /// For each control vertex of the cut mesh the value it takes.
    sources: Vec<u32>,
    vertices: Vec<[u32; 2]>,
    /// The vertices that follow those of the plan: each in the middle of two of these.
    middles: Vec<[u32; 2]>,
    indices: Vec<u32>,
    face_parent: Vec<u32>,
}

impl SeamPlan {
    /// `surface` is the plan of the surface, built from `control` and `tags`; corners and values as in
    /// [`FaceVaryingPlan::build`](super::FaceVaryingPlan::build).
    ///
    /// # Errors
    /// Numbers that do not fit; another scheme than √3; holes or frozen faces.
    pub fn build(
        surface: &Plan,
        control: &DedgeMesh,
        tags: &Tags,
        corner_values: &[u32],
        n_values: usize,
    ) -> Result<SeamPlan, FaceVaryingError> {
        let (scheme, linear) = (surface.scheme(), UvLinear::CornersOnly);
        if scheme != Scheme::Sqrt3 || !tags.holes.is_empty() || !tags.frozen.is_empty() {
            return Err(FaceVaryingError::Scheme { scheme, linear });
        }
        let polygons = PolygonMesh::from(control);
        let cut = Cut::new(&polygons, tags, corner_values, n_values)?;
        let mesh = DedgeMesh::from_triangles(cut.sources.len(), cut.sector.as_chunks().0)?;
        let cut_tags = cut.tags(&PolygonMesh::from(&mesh), tags, surface.options(), linear);
        let options =
            PlanOptions { boundary: BoundaryRule::EdgeAndCorner, normals: Normals::None, ..*surface.options() };
        let plan = Plan::build_with(&mesh, &cut_tags, &options)?;

        let mut walk = Walk {
            surface: level_0(control, tags, surface.options())?,
            cut: level_0(&mesh, &cut_tags, &options)?,
            vertex: vec![NONE; mesh.n_vertices()],
            dedge: control.dedges().map(|d| d.0).collect(),
        };
        for (corner, &sector) in cut.sector.iter().enumerate() {
            walk.vertex[sector as usize] = control.indices()[corner];
        }
        for step in 0..options.levels / 2 {
            walk = walk.two_steps(surface.options(), &options, 2 * step).ok_or(FaceVaryingError::OtherPlan)?;
        }
        let mut out = SeamPlan {
            sources: cut.sources.clone(),
            vertices: walk.vertex.iter().map(|&v| [v, v]).collect(),
            middles: Vec::new(),
            indices: plan.indices().to_vec(),
            face_parent: plan.face_parent().to_vec(),
            plan,
        };
        if options.levels % 2 == 1 {
            out.cut_faces(&walk);
        }
        let n = surface.n_vertices() as u32;
        if out.vertices.len() != out.plan.n_vertices() + out.middles.len()
            || out.vertices.iter().flatten().any(|&v| v >= n)
        {
            return Err(FaceVaryingError::OtherPlan);
        }
        Ok(out)
    }

    /// The last, odd step: vertices in the middle of faces, and faces on a seam cut in two.
    fn cut_faces(&mut self, walk: &Walk) {
        let n_before = walk.surface.mesh.n_vertices() as u32;
        let middle = |dedge: u32| n_before + DedgeId(dedge).face().0;
        let cut = &walk.cut.mesh;
        self.vertices.extend(cut.faces().map(|face| [middle(walk.dedge[face.dedge(0).index()]); 2]));
        let (mut indices, mut parents) = (Vec::new(), Vec::new());
        for (dedge, (corners, &parent)) in
            cut.dedges().zip(self.indices.as_chunks::<3>().0.iter().zip(&self.face_parent))
        {
            let over = DedgeId(walk.dedge[dedge.index()]);
            let across = walk.surface.mesh.twin(over).filter(|_| !walk.surface.is_open(over));
            // The child of a directed edge has its number.
            match across.filter(|_| cut.is_boundary_dedge(dedge)) {
                None => {
                    indices.extend(corners);
                    parents.push(parent);
                }
                Some(across) => {
                    let &[a, b, x] = corners;
                    let m = self.vertices.len() as u32;
                    self.vertices.push([middle(over.0), middle(across.0)]);
                    self.middles.push([a, b]);
                    indices.extend([a, m, x, m, b, x]);
                    parents.extend([parent; 2]);
                }
            }
        }
        (self.indices, self.face_parent) = (indices, parents);
    }

    /// For each vertex to draw the two vertices of the surface's last level that it lies in the middle of: nearly
    /// everywhere twice the same.
    pub fn render_vertices(&self) -> &[[u32; 2]] {
        &self.vertices
    }

    /// Three of these vertices for each face to draw, counter-clockwise.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// For each face to draw the control face that its values come from.
    pub fn face_parent(&self) -> &[u32] {
        &self.face_parent
    }

    /// Texture coordinates for each vertex to draw, from one for each number. They change only with the plan.
    ///
    /// # Panics
    /// Where `uvs` has another length than was said when it was built.
    pub fn evaluate_uvs(&self, uvs: &[Vec2]) -> Vec<Vec2> {
        let values: Vec<Vec3> = self.sources.iter().map(|&source| uvs[source as usize].extend(0.0)).collect();
        let mut fine = vec![Vec3::ZERO; self.plan.n_vertices()];
        Evaluator::new(&self.plan).evaluate_attribute(&self.plan, &values, &mut fine);
        let mut out: Vec<Vec2> = fine.into_iter().map(Vec3::truncate).collect();
        for [a, b] in &self.middles {
            out.push((out[*a as usize] + out[*b as usize]) * 0.5);
        }
        out
    }
}

fn level_0(mesh: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Result<Level, FaceVaryingError> {
    match prepare::triangles(mesh, tags, options).map_err(super::plan::PlanError::from)? {
        Prepared { level: Last::Triangles(level), .. } => Ok(level),
        _ => unreachable!("triangles stay triangles"),
    }
}

/// An even level of surface and cut mesh, and which part of the one is which of the other.
struct Walk {
    surface: Level,
    cut: Level,
    /// For each vertex of the cut mesh that of the surface.
    vertex: Vec<u32>,
    /// The same for directed edges.
    dedge: Vec<u32>,
}

/// Where a vertex comes from, two levels up.
enum Origin {
    Vertex(u32),
    Face(FaceId),
    /// At a third of a directed edge from its origin.
    Near(DedgeId),
    /// At two thirds of it.
    Far(DedgeId),
}

impl Walk {
    fn two_steps(self, of_surface: &PlanOptions, of_cut: &PlanOptions, step: u32) -> Option<Walk> {
        let (surface, surface_origins) = two_steps(&self.surface, of_surface, step);
        let (cut, cut_origins) = two_steps(&self.cut, of_cut, step);
        let old = &self.surface.mesh;
        let mut middle = vec![NONE; old.n_faces()];
        let mut near = vec![NONE; old.n_dedges()];
        let mut far = vec![NONE; old.n_dedges()];
        for (v, origin) in (0..).zip(surface_origins) {
            match origin {
                Origin::Vertex(_) => {}
                Origin::Face(face) => middle[face.index()] = v,
                Origin::Near(dedge) => near[dedge.index()] = v,
                Origin::Far(dedge) => far[dedge.index()] = v,
            }
        }
        // What is near one end from one side is far from the other.
        for dedge in old.dedges() {
            if let Some(twin) = old.twin(dedge) {
                let (own, other) = (near[dedge.index()], far[twin.index()]);
                let known = if own == NONE { other } else { own };
                (near[dedge.index()], far[twin.index()]) = (known, known);
            }
        }
        let vertex: Vec<u32> = cut_origins
            .into_iter()
            .map(|origin| match origin {
                Origin::Vertex(v) => self.vertex[v as usize],
                Origin::Face(face) => middle[DedgeId(self.dedge[face.dedge(0).index()]).face().index()],
                Origin::Near(dedge) => near[self.dedge[dedge.index()] as usize],
                Origin::Far(dedge) => far[self.dedge[dedge.index()] as usize],
            })
            .collect();
        // A directed edge is known by its ends.
        let ends = |mesh: &DedgeMesh, d: DedgeId| (mesh.origin(d).0, mesh.target(d).0);
        let by_ends: BTreeMap<(u32, u32), u32> = surface.mesh.dedges().map(|d| (ends(&surface.mesh, d), d.0)).collect();
        let dedge = cut
            .mesh
            .dedges()
            .map(|d| {
                let (a, b) = ends(&cut.mesh, d);
                by_ends.get(&(vertex[a as usize], vertex[b as usize])).copied()
            })
            .collect::<Option<Vec<u32>>>()?;
        Some(Walk { surface, cut, vertex, dedge })
    }
}

/// A keeping step and a trisecting one, and where the vertices come from.
fn two_steps(level: &Level, options: &PlanOptions, step: u32) -> (Level, Vec<Origin>) {
    let first = thirds::refine(level, BoundaryStep::from_level(step)).parents;
    let between = triangle_step::<f32>(level, options, step).1;
    let second = thirds::refine(&between, BoundaryStep::from_level(step + 1)).parents;
    let after = triangle_step::<f32>(&between, options, step + 1).1;
    let origin = |parent| match parent {
        VertexParent::Vertex(v) => match first[v.index()] {
            VertexParent::Face(face) => Origin::Face(face),
            _ => Origin::Vertex(v.0),
        },
        // The child of a directed edge has its number, and begins where it does.
        VertexParent::Face(child) => Origin::Near(DedgeId(child.0)),
        VertexParent::FirstThird(side) => Origin::Near(DedgeId(side.face().0)),
        VertexParent::SecondThird(side) => Origin::Far(DedgeId(side.face().0)),
        VertexParent::Edge(_) => unreachable!("√3 puts no vertex into the middle of an edge"),
    };
    let origins = second.into_iter().map(origin).collect();
    (after, origins)
}
