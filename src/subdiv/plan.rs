//! The plan: everything about a subdivision that does not depend on positions.

use crate::math::fnv::Fnv64;
use crate::mesh::{DedgeMesh, PolygonMesh};

use super::limit::LimitTable;
use super::normals::Rings;
use super::prepare::{self, Prepared};
use super::scheme::{Normals, PlanOptions, Positions, Scheme};
use super::shared_patches::SharedPatches;
use super::stencil::StencilTable;
use super::steps::{Last, Steps};
use super::tags::{TagError, Tags};

/// Most faces of a plan's last level: some 10 GB of tables, far beyond what is drawn, and within 32-bit offsets.
pub const MAX_FACES: u64 = 1 << 26;

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
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
    /// A tag does not fit the mesh.
    #[error(transparent)]
    Tags(#[from] TagError),
    /// The scheme knows no sharp edges.
    #[error("{} has no rule for sharp edges and vertices; use sqrt3, loop, butterfly or catmull-clark", scheme.name())]
    NoCreases {
        /// The scheme asked for.
        scheme: Scheme,
    },
    /// The scheme would cut the edges of frozen faces.
    #[error("{} would cut the edges of frozen faces; only sqrt3 can leave faces alone", scheme.name())]
    NoFrozenFaces {
        /// The scheme asked for.
        scheme: Scheme,
    },
    /// The scheme has no limit masks.
    #[error("{} has no limit masks here; ask for positions of the level and normals from faces", scheme.name())]
    NoLimits {
        /// The scheme asked for.
        scheme: Scheme,
    },
    /// Adaptive refinement is that of √3, without frozen faces.
    #[error("adaptive refinement is for sqrt3 without frozen faces; {} was asked for", scheme.name())]
    NotAdaptive {
        /// The scheme asked for.
        scheme: Scheme,
    },
    /// A polygon mesh for a scheme that refines triangles.
    #[error("{} refines triangles only; cut the polygons into triangles first", scheme.name())]
    NotTriangles {
        /// The scheme asked for.
        scheme: Scheme,
    },
    /// A polygon scheme for what only triangles have.
    #[error("{} refines polygons; this is for triangles only", scheme.name())]
    NotPolygons {
        /// The scheme asked for.
        scheme: Scheme,
    },
}

/// Vertices and faces of one level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Counts {
    pub(super) n_vertices: usize,
    pub(super) n_faces: usize,
}

/// A control topology, a scheme and a depth, worked out: one stencil table for each step and the faces of the last
/// level. Positions come later, from an [`Evaluator`](super::Evaluator).
///
/// Vertices of a level are numbered canonically: those of the level before first, in their order, then those that the
/// step adds, in the order of the faces they were added for. (Doo-Sabin keeps none: its vertices come corner by corner.)
/// Rebuilt when topology, tags or options change.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub(super) options: PlanOptions,
    pub(super) n_control: usize,
    pub(super) counts: Vec<Counts>,
    pub(super) tables: Vec<StencilTable>,
    /// Corners of each face; empty where all are triangles.
    pub(super) face_sizes: Vec<u32>,
    /// The faces themselves; empty where all are triangles.
    pub(super) corners: Vec<u32>,
    pub(super) indices: Vec<u32>,
    pub(super) face_parent: Vec<u32>,
    pub(super) n_frozen: usize,
    pub(super) boundary_loops: Vec<Vec<u32>>,
    pub(super) rings: Option<Rings>,
    pub(super) limit: Option<LimitTable>,
    /// Where they are worth it; an evaluation then takes nothing else.
    pub(super) patches: Option<SharedPatches>,
    pub(super) fingerprint: u64,
}

impl Plan {
    /// Works out `levels` steps over a control mesh, in time and memory linear in the size of the last level.
    /// Level 0 is the control mesh itself.
    ///
    /// # Errors
    /// Where the last level would have more than [`MAX_FACES`] faces; nothing has been allocated then.
    pub fn build(control: &DedgeMesh, scheme: Scheme, levels: u32) -> Result<Plan, PlanError> {
        Plan::build_with(control, &Tags::default(), &PlanOptions::new(scheme, levels))
    }

    /// The same with tags and options. A polygon scheme takes the triangles as polygons.
    ///
    /// # Errors
    /// Tags that do not fit the mesh or that the scheme has no rule for, limits where the scheme has none, too many faces.
    pub fn build_with(control: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Result<Plan, PlanError> {
        check(options, tags)?;
        if !options.scheme.is_triangular() {
            return Plan::build_polygons(&PolygonMesh::from(control), tags, options);
        }
        let prepared = prepare::triangles(control, tags, options)?;
        let fingerprint = fingerprint(control.n_vertices(), &[], control.indices(), tags, options);
        let sharpness = match &prepared.level {
            Last::Triangles(level) => level.sharpness.clone(),
            Last::Polygons(_) => unreachable!("triangles stay triangles"),
        };
        let mut plan = Plan::finish(prepared, options, control.n_vertices(), fingerprint)?;
        plan.patches = SharedPatches::build(control, tags, &sharpness, &plan);
        Ok(plan)
    }

    /// The same for polygons.
    ///
    /// # Errors
    /// As [`build_with`](Self::build_with), and a scheme that refines triangles only.
    pub fn build_polygons(control: &PolygonMesh, tags: &Tags, options: &PlanOptions) -> Result<Plan, PlanError> {
        check(options, tags)?;
        if options.scheme.is_triangular() {
            return Err(PlanError::NotTriangles { scheme: options.scheme });
        }
        let prepared = prepare::polygons(control, tags, options)?;
        let fingerprint = fingerprint(control.n_vertices(), &control.offsets, &control.origin, tags, options);
        Plan::finish(prepared, options, control.n_vertices(), fingerprint)
    }

    fn finish(
        prepared: Prepared,
        options: &PlanOptions,
        n_control: usize,
        fingerprint: u64,
    ) -> Result<Plan, PlanError> {
        let Steps { mut tables, counts, last, face_parent, .. } = Steps::<f32>::build(prepared, options)?;
        // Without a step, holes still leave control vertices out.
        if tables.len() > options.levels as usize {
            tables.truncate(options.levels as usize + 1);
        }
        let mut plan = Plan {
            options: *options,
            n_control,
            counts,
            tables,
            face_sizes: Vec::new(),
            corners: Vec::new(),
            indices: Vec::new(),
            face_parent,
            n_frozen: 0,
            boundary_loops: Vec::new(),
            rings: None,
            limit: None,
            patches: None,
            fingerprint,
        };
        let wants_rings = options.normals == Normals::Faces;
        let numbers = |loops: Vec<Vec<crate::mesh::VertexId>>| -> Vec<Vec<u32>> {
            loops.into_iter().map(|vertices| vertices.into_iter().map(|v| v.0).collect()).collect()
        };
        match last {
            Last::Triangles(level) => {
                let mesh = &level.mesh;
                plan.boundary_loops = numbers(mesh.boundary_loops());
                if wants_rings {
                    let n_entries = mesh.n_dedges() + mesh.n_vertices();
                    let is_boundary = |v| mesh.is_boundary_vertex(v);
                    plan.rings = Some(Rings::of(mesh.n_vertices(), n_entries, |v| mesh.ring(v), is_boundary));
                }
                if wants_limit(options) {
                    plan.limit = Some(LimitTable::build(&level, options, options.levels));
                }
                plan.n_frozen = mesh.n_faces() - level.n_active as usize;
                plan.indices = level.mesh.origin;
            }
            Last::Polygons(level) => {
                let mesh = level.mesh;
                plan.boundary_loops = numbers(mesh.boundary_loops());
                if wants_rings {
                    let n_entries = mesh.n_dedges() + mesh.n_vertices();
                    let is_boundary = |v| mesh.is_boundary_vertex(v);
                    plan.rings = Some(Rings::of(mesh.n_vertices(), n_entries, |v| mesh.ring(v), is_boundary));
                }
                plan.indices = mesh.triangulated();
                plan.face_sizes = mesh.offsets.windows(2).map(|ends| ends[1] - ends[0]).collect();
                plan.corners = mesh.origin;
            }
        }
        Ok(plan)
    }

    /// The [`fingerprint`](Plan::fingerprint) that [`Plan::build_with`] would give, without building.
    pub fn fingerprint_of(control: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> u64 {
        if options.scheme.is_triangular() {
            fingerprint(control.n_vertices(), &[], control.indices(), tags, options)
        } else {
            Plan::fingerprint_of_polygons(&PolygonMesh::from(control), tags, options)
        }
    }

    /// The same for [`Plan::build_polygons`].
    pub fn fingerprint_of_polygons(control: &PolygonMesh, tags: &Tags, options: &PlanOptions) -> u64 {
        fingerprint(control.n_vertices(), &control.offsets, &control.origin, tags, options)
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
        Ok(DoublePlan::build_with(control, &Tags::default(), &PlanOptions::new(scheme, levels))?.tables)
    }

    /// The options that it was built with.
    pub fn options(&self) -> &PlanOptions {
        &self.options
    }

    /// The scheme of all steps.
    pub fn scheme(&self) -> Scheme {
        self.options.scheme
    }

    /// Number of steps, and of the last level.
    pub fn levels(&self) -> u32 {
        self.options.levels
    }

    /// Number of control vertices: the positions that an evaluation takes.
    pub fn n_control(&self) -> usize {
        self.n_control
    }

    /// Number of vertices of the last level.
    pub fn n_vertices(&self) -> usize {
        self.counts[self.counts.len() - 1].n_vertices
    }

    /// Number of faces of the last level.
    pub fn n_faces(&self) -> usize {
        self.counts[self.counts.len() - 1].n_faces
    }

    /// Number of faces, at the end of each level, that were carried through unchanged.
    pub fn n_frozen_faces(&self) -> usize {
        self.n_frozen
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

    /// Index buffer of the last level: three vertices for each triangle, counter-clockwise. Polygons are cut into fans.
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// The faces of the last level as they are: the number of corners of each, and the corners of all.
    pub fn faces(&self) -> (Vec<u32>, &[u32]) {
        if self.face_sizes.is_empty() {
            (vec![3; self.n_faces()], &self.indices)
        } else {
            (self.face_sizes.clone(), &self.corners)
        }
    }

    /// For each face of the last level the one control face that it descends from; of a face that Doo-Sabin puts on an
    /// edge or a vertex, one of those there.
    ///
    /// A step of √3 turns edges, so that a face may lie half over a neighbour of that control face.
    pub fn face_parent(&self) -> &[u32] {
        &self.face_parent
    }

    /// Boundaries of the last level, each as its vertices with the surface on the left, as
    /// [`DedgeMesh::boundary_loops`] gives them.
    pub fn boundary_loops(&self) -> &[Vec<u32>] {
        &self.boundary_loops
    }

    /// One table for each step, the first from the control vertices. With holes another table comes first, which leaves out
    /// the control vertices that no face uses any more.
    pub fn tables(&self) -> &[StencilTable] {
        &self.tables
    }

    /// Limit positions and tangents of the last level, where the options ask for any.
    pub fn limit(&self) -> Option<&LimitTable> {
        self.limit.as_ref()
    }

    /// For normals from faces: the outline of the faces around each vertex, as where it starts in the list that follows (one
    /// entry more ends the last; the second number is not used), where the plan has such normals.
    pub fn outlines(&self) -> Option<(Vec<[u32; 2]>, &[u32])> {
        self.rings.as_ref().map(|rings| (rings.starts(), &rings.neighbours[..]))
    }

    /// Bytes of the stencil tables and of the limit table: what an evaluation of positions reads. The index buffer and
    /// the rings for normals from faces come on top.
    pub fn n_table_bytes(&self) -> usize {
        self.tables.iter().map(StencilTable::n_bytes).sum::<usize>()
            + self.limit.as_ref().map_or(0, LimitTable::n_bytes)
    }

    /// Bytes of the patches that share their rows, where the plan has them: an evaluation reads them instead of the tables.
    pub fn n_patch_bytes(&self) -> usize {
        self.patches.as_ref().map_or(0, SharedPatches::n_bytes)
    }

    /// Bytes of the index buffer.
    pub fn n_index_bytes(&self) -> usize {
        size_of_val(&self.indices[..])
    }

    /// Bytes of the rings for normals from faces.
    pub fn n_ring_bytes(&self) -> usize {
        self.rings.as_ref().map_or(0, Rings::n_bytes)
    }

    /// 64-bit FNV-1a over the inputs: options, number of control vertices, control faces, tags. Equal inputs make equal
    /// plans.
    pub fn fingerprint(&self) -> u64 {
        self.fingerprint
    }
}

/// The tables of a plan with weights in double precision, and nothing else: what oracles compare.
#[derive(Clone, Debug)]
pub struct DoublePlan {
    /// As [`Plan::tables`].
    pub tables: Vec<StencilTable<f64>>,
    /// As [`Plan::limit`], wherever the scheme has limits.
    pub limit: Option<LimitTable<f64>>,
}

impl DoublePlan {
    /// The tables of [`Plan::build_with`].
    ///
    /// # Errors
    /// The same.
    pub fn build_with(control: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Result<DoublePlan, PlanError> {
        check(options, tags)?;
        if !options.scheme.is_triangular() {
            return DoublePlan::build_polygons(&PolygonMesh::from(control), tags, options);
        }
        DoublePlan::finish(prepare::triangles(control, tags, options)?, options)
    }

    /// The tables of [`Plan::build_polygons`].
    ///
    /// # Errors
    /// The same.
    pub fn build_polygons(control: &PolygonMesh, tags: &Tags, options: &PlanOptions) -> Result<DoublePlan, PlanError> {
        check(options, tags)?;
        if options.scheme.is_triangular() {
            return Err(PlanError::NotTriangles { scheme: options.scheme });
        }
        DoublePlan::finish(prepare::polygons(control, tags, options)?, options)
    }

    fn finish(prepared: Prepared, options: &PlanOptions) -> Result<DoublePlan, PlanError> {
        let Steps { tables, last, .. } = Steps::<f64>::build(prepared, options)?;
        let limit = match last {
            Last::Triangles(level) if options.scheme.has_limits() => {
                Some(LimitTable::build(&level, options, options.levels))
            }
            _ => None,
        };
        Ok(DoublePlan { tables, limit })
    }
}

pub(super) fn wants_limit(options: &PlanOptions) -> bool {
    // Control points of an interpolating scheme are limit points already.
    (options.positions == Positions::Limit && !options.scheme.is_interpolating()) || options.normals == Normals::Limit
}

pub(super) fn check(options: &PlanOptions, tags: &Tags) -> Result<(), PlanError> {
    let scheme = options.scheme;
    let has_sharp_tags = !tags.creases.is_empty() || !tags.corners.is_empty();
    if has_sharp_tags && !scheme.has_creases() {
        return Err(PlanError::NoCreases { scheme });
    }
    if scheme != Scheme::Sqrt3 && !tags.frozen.is_empty() {
        return Err(PlanError::NoFrozenFaces { scheme });
    }
    if wants_limit(options) && !scheme.has_limits() {
        return Err(PlanError::NoLimits { scheme });
    }
    Ok(())
}

pub(super) fn fingerprint(
    n_vertices: usize,
    offsets: &[u32],
    corners: &[u32],
    tags: &Tags,
    options: &PlanOptions,
) -> u64 {
    let mut hash = Fnv64::new();
    hash.bytes(options.scheme.name().as_bytes());
    hash.u32(options.levels);
    hash.bytes(&[
        options.loop_weights as u8,
        options.boundary as u8,
        options.creasing as u8,
        options.positions as u8,
        options.normals as u8,
    ]);
    hash.u64(n_vertices as u64);
    hash.u64(offsets.len() as u64);
    offsets.iter().chain(corners).for_each(|&n| hash.u32(n));
    hash.u64(tags.creases.len() as u64);
    for &(a, b, sharpness) in &tags.creases {
        [a.0, b.0, sharpness.to_bits()].into_iter().for_each(|n| hash.u32(n));
    }
    hash.u64(tags.corners.len() as u64);
    for &(vertex, sharpness) in &tags.corners {
        [vertex.0, sharpness.to_bits()].into_iter().for_each(|n| hash.u32(n));
    }
    for faces in [&tags.holes, &tags.frozen] {
        hash.u64(faces.len() as u64);
        faces.iter().for_each(|face| hash.u32(face.0));
    }
    hash.finish()
}
