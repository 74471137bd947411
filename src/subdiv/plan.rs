//! The plan: everything about a subdivision that does not depend on positions.

use crate::math::fnv::Fnv64;
use crate::mesh::{DedgeId, DedgeMesh, VertexId};

use super::normals::Rings;
use super::refine::{Refined, VertexParent, refine};
use super::scheme::{BoundaryStep, Scheme};
use super::sqrt3;
use super::stencil::{StencilBuilder, StencilTable, Weight};

/// Most faces of a plan's last level: some 10 GB of tables, far beyond what is drawn, and within 32-bit offsets.
pub const MAX_FACES: u64 = 1 << 26;

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The last level would be too large.
    #[error(
        "{levels} levels over {n_control_faces} control faces give more than {MAX_FACES} faces; ask for fewer levels"
    )]
    TooManyFaces {
        /// The depth asked for.
        levels: u32,
        /// Faces of the control mesh.
        n_control_faces: usize,
    },
}

/// Vertices and faces of one level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Counts {
    n_vertices: usize,
    n_faces: usize,
}

/// A control topology, a scheme and a depth, worked out: one stencil table for each step and the faces of the last
/// level. Positions come later, from an [`Evaluator`](super::Evaluator).
///
/// Vertices of a level are numbered canonically: the control vertices first, in their order, then those that each step
/// adds, in the order of the faces they were added for. Rebuilt when topology, scheme or depth changes.
#[derive(Clone, Debug)]
pub struct Plan {
    scheme: Scheme,
    counts: Vec<Counts>,
    tables: Vec<StencilTable>,
    indices: Vec<u32>,
    face_parent: Vec<u32>,
    boundary_loops: Vec<Vec<u32>>,
    pub(super) rings: Rings,
    fingerprint: u64,
}

impl Plan {
    /// Works out `levels` steps over a control mesh, in time and memory linear in the size of the last level.
    /// Level 0 is the control mesh itself.
    ///
    /// # Errors
    /// Where the last level would have more than [`MAX_FACES`] faces; nothing has been allocated then.
    pub fn build(control: &DedgeMesh, scheme: Scheme, levels: u32) -> Result<Plan, PlanError> {
        let steps = Steps::build(control, scheme, levels)?;
        let last = &steps.last;
        let faces_per_control_face = last.n_faces() / control.n_faces();
        let boundary_loops =
            last.boundary_loops().into_iter().map(|vertices| vertices.into_iter().map(|v| v.0).collect()).collect();
        Ok(Plan {
            scheme,
            boundary_loops,
            // Face e of a child comes from face e / 3 of its parent, level by level.
            face_parent: (0..last.n_faces()).map(|f| (f / faces_per_control_face) as u32).collect(),
            rings: Rings::of(last),
            fingerprint: fingerprint(control, scheme, levels),
            counts: steps.counts,
            tables: steps.tables,
            indices: steps.last.indices().to_vec(),
        })
    }

    /// The tables of a plan, one for each step, with weights in double precision: for oracles, not for frames.
    ///
    /// # Errors
    /// As [`Plan::build`].
    pub fn double_tables(
        control: &DedgeMesh,
        scheme: Scheme,
        levels: u32,
    ) -> Result<Vec<StencilTable<f64>>, PlanError> {
        Ok(Steps::build(control, scheme, levels)?.tables)
    }

    /// The scheme of all steps.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// Number of steps, and of the last level.
    pub fn levels(&self) -> u32 {
        self.tables.len() as u32
    }

    /// Number of control vertices: vertices of level 0.
    pub fn n_control(&self) -> usize {
        self.counts[0].n_vertices
    }

    /// Number of vertices of the last level.
    pub fn n_vertices(&self) -> usize {
        self.counts[self.tables.len()].n_vertices
    }

    /// Number of faces of the last level.
    pub fn n_faces(&self) -> usize {
        self.counts[self.tables.len()].n_faces
    }

    /// Number of vertices of a level.
    ///
    /// # Panics
    /// Where the plan has no such level.
    pub fn n_vertices_at(&self, level: u32) -> usize {
        self.counts[level as usize].n_vertices
    }

    /// Number of faces of a level.
    ///
    /// # Panics
    /// Where the plan has no such level.
    pub fn n_faces_at(&self, level: u32) -> usize {
        self.counts[level as usize].n_faces
    }

    /// Index buffer of the last level: three vertices for each face, counter-clockwise.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// For each face of the last level the one control face that it descends from.
    ///
    /// A step turns edges, so that a face may lie half over a neighbour of that control face.
    pub fn face_parent(&self) -> &[u32] {
        &self.face_parent
    }

    /// Boundaries of the last level, each as its vertices with the surface on the left, as
    /// [`DedgeMesh::boundary_loops`] gives them.
    pub fn boundary_loops(&self) -> &[Vec<u32>] {
        &self.boundary_loops
    }

    /// One table for each step: table `k` leads from level `k` to level `k + 1`.
    pub fn tables(&self) -> &[StencilTable] {
        &self.tables
    }

    /// 64-bit FNV-1a over the inputs: scheme, depth, number of control vertices, control faces. Equal inputs make
    /// equal plans.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }
}

fn fingerprint(control: &DedgeMesh, scheme: Scheme, levels: u32) -> u64 {
    let mut hash = Fnv64::new();
    hash.bytes(scheme.name().as_bytes());
    hash.u32(levels);
    hash.u64(control.n_vertices() as u64);
    for &index in control.indices() {
        hash.u32(index);
    }
    hash.finish()
}

/// What the steps leave: of the meshes between only their counts.
struct Steps<W> {
    counts: Vec<Counts>,
    tables: Vec<StencilTable<W>>,
    last: DedgeMesh,
}

impl<W: Weight> Steps<W> {
    fn build(control: &DedgeMesh, scheme: Scheme, levels: u32) -> Result<Self, PlanError> {
        let n_control_faces = control.n_faces();
        let n_faces = scheme.faces_per_face().checked_pow(levels).and_then(|n| n.checked_mul(n_control_faces as u64));
        if n_faces.is_none_or(|n| n > MAX_FACES) {
            return Err(PlanError::TooManyFaces { levels, n_control_faces });
        }
        let count = |mesh: &DedgeMesh| Counts { n_vertices: mesh.n_vertices(), n_faces: mesh.n_faces() };
        let mut steps = Steps { counts: vec![count(control)], tables: Vec::new(), last: control.clone() };
        for level in 0..levels {
            let step = BoundaryStep::from_level(level);
            let refined = match scheme {
                Scheme::Sqrt3 => refine(&steps.last, step),
            };
            steps.tables.push(sqrt3_table(&steps.last, &refined, step));
            steps.last = refined.mesh;
            steps.counts.push(count(&steps.last));
        }
        Ok(steps)
    }
}

/// One row for each vertex of the child: the masks of [`sqrt3`] over the parent.
fn sqrt3_table<W: Weight>(parent: &DedgeMesh, child: &Refined, step: BoundaryStep) -> StencilTable<W> {
    let n_entries = parent.n_vertices() + 2 * parent.n_dedges();
    let mut builder = StencilTable::builder(parent.n_vertices(), child.parents.len(), n_entries);
    for &origin in &child.parents {
        match origin {
            VertexParent::Vertex(vertex) if !parent.is_boundary_vertex(vertex) => {
                inner_row(&mut builder, parent, vertex);
            }
            VertexParent::Vertex(vertex) => match step {
                BoundaryStep::Keep => builder.entry(vertex.0, 1.0),
                BoundaryStep::Trisect => curve_row(&mut builder, parent, vertex, sqrt3::BOUNDARY_VERTEX),
            },
            VertexParent::Face(face) => {
                for (corner, weight) in parent.corners(face).into_iter().zip(sqrt3::FACE_POINT) {
                    builder.entry(corner.0, weight);
                }
            }
            VertexParent::FirstThird(dedge) => {
                curve_row(&mut builder, parent, parent.origin(dedge), sqrt3::BOUNDARY_POINT);
            }
            VertexParent::SecondThird(dedge) => {
                curve_row(&mut builder, parent, parent.target(dedge), sqrt3::BOUNDARY_POINT.reversed());
            }
        }
        builder.end_row();
    }
    builder.finish()
}

fn inner_row<W: Weight>(builder: &mut StencilBuilder<W>, mesh: &DedgeMesh, vertex: VertexId) {
    let mask = sqrt3::inner_vertex(mesh.valence(vertex));
    builder.entry(vertex.0, mask.centre);
    for neighbour in mesh.ring(vertex) {
        builder.entry(neighbour.0, mask.neighbour);
    }
}

/// The vertex itself, then its two neighbours along the boundary, as a ring has them: first the one after.
fn curve_row<W: Weight>(
    builder: &mut StencilBuilder<W>,
    mesh: &DedgeMesh,
    vertex: VertexId,
    mask: super::mask::CurveMask,
) {
    let after = mesh.outgoing(vertex);
    builder.entry(vertex.0, mask.centre);
    builder.entry(mesh.target(after).0, mask.after);
    builder.entry(mesh.origin(boundary_before(mesh, after)).0, mask.before);
}

/// The boundary directed edge that ends where this one starts.
fn boundary_before(mesh: &DedgeMesh, boundary: DedgeId) -> DedgeId {
    let mut last = boundary;
    for dedge in mesh.outgoing_dedges(mesh.origin(boundary)) {
        last = dedge;
    }
    last.prev()
}
