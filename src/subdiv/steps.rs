//! One step after another: refine, write the rows, pass sharpness on. What a step leaves is its table and its counts.

use crate::mesh::DedgeMesh;

use super::corners::{self, PolygonLevel};
use super::level::{Level, Sharpness};
use super::plan::{Counts, MAX_FACES, PlanError, check};
use super::prepare::{self, Prepared};
use super::scheme::{BoundaryStep, PlanOptions, Scheme};
use super::stencil::{StencilTable, Weight};
use super::tags::Tags;
use super::{dual_split, quarters, rows, thirds};

/// The mesh at hand, of one kind or the other.
pub(super) enum Last {
    Triangles(Level),
    Polygons(PolygonLevel),
}

impl Last {
    fn counts(&self) -> Counts {
        match self {
            Last::Triangles(level) => Counts { n_vertices: level.mesh.n_vertices(), n_faces: level.mesh.n_faces() },
            Last::Polygons(level) => Counts { n_vertices: level.mesh.n_vertices(), n_faces: level.mesh.n_faces() },
        }
    }
}

pub(super) struct Steps<W> {
    /// Of each level.
    pub(super) counts: Vec<Counts>,
    /// One for each step, and before them one more where control vertices are left out.
    pub(super) tables: Vec<StencilTable<W>>,
    pub(super) last: Last,
    /// For each face of the last level its control face.
    pub(super) face_parent: Vec<u32>,
}

impl<W: Weight> Steps<W> {
    pub(super) fn build(prepared: Prepared, options: &PlanOptions) -> Result<Steps<W>, PlanError> {
        let Prepared { level, vertices, faces, n_control } = prepared;
        let too_many = PlanError::TooManyFaces { levels: options.levels, n_control_faces: faces.len() };
        match &level {
            Last::Triangles(level) => check_size(options, faces.len(), level.n_active)?,
            // Sides grow by four a step from the start; those of an open mesh under Doo-Sabin by less, which shows below.
            Last::Polygons(level) if options.scheme == Scheme::CatmullClark || level.mesh.n_boundary_edges() == 0 => {
                let growth = 4_u64.checked_pow(options.levels.saturating_sub(1));
                let n_sides = growth.and_then(|growth| growth.checked_mul(level.mesh.n_dedges() as u64));
                if options.levels > 0 && n_sides.is_none_or(|n| n > MAX_FACES) {
                    return Err(too_many);
                }
            }
            Last::Polygons(_) => {}
        }
        let mut steps = Steps { counts: vec![level.counts()], tables: Vec::new(), last: level, face_parent: faces };
        steps.tables.extend(vertices.map(|vertices| StencilTable::selection(n_control, &vertices)));
        for step in 0..options.levels {
            let (table, next) = match &steps.last {
                Last::Triangles(level) => {
                    let (table, next) = triangle_step(level, options, step);
                    (table, Last::Triangles(next))
                }
                Last::Polygons(level) => {
                    // Four sides for each corner, or about as many for Doo-Sabin.
                    if level.mesh.n_dedges() as u64 > MAX_FACES {
                        return Err(too_many);
                    }
                    let (table, next) = polygon_step(level, options);
                    steps.face_parent = polygon_parents(level, &next, options.scheme, &steps.face_parent);
                    (table, Last::Polygons(next))
                }
            };
            steps.tables.push(table);
            steps.last = next;
            steps.counts.push(steps.last.counts());
        }
        if let Last::Triangles(level) = &steps.last {
            steps.face_parent = triangle_parents(level, options, &steps.face_parent);
        }
        Ok(steps)
    }
}

pub(super) fn triangle_step<W: Weight>(level: &Level, options: &PlanOptions, step: u32) -> (StencilTable<W>, Level) {
    let kind = BoundaryStep::from_level(step);
    let refined = match options.scheme {
        Scheme::Loop | Scheme::Butterfly => quarters::refine(&level.mesh),
        _ => thirds::refine(level, kind),
    };
    let (table, sharpness) = match options.scheme {
        Scheme::Loop => (
            rows::loop_scheme::table(level, &refined, options),
            quarters::child_sharpness(level, &refined, options.creasing),
        ),
        Scheme::Butterfly => (
            rows::butterfly::table(level, &refined, options.creasing),
            quarters::child_sharpness(level, &refined, options.creasing),
        ),
        Scheme::Sqrt3Interpolating => (rows::sqrt3_interpolating::table(&level.mesh, &refined), Sharpness::default()),
        _ => (
            rows::sqrt3::table(level, &refined, kind, options.creasing),
            thirds::child_sharpness(level, &refined, kind, options.creasing),
        ),
    };
    let growth = options.scheme.faces_per_face().unwrap_or(1) as u32;
    let next = Level { mesh: refined.mesh, sharpness, n_active: growth * level.n_active, fixed: level.fixed.clone() };
    (table, next)
}

fn polygon_step<W: Weight>(level: &PolygonLevel, options: &PlanOptions) -> (StencilTable<W>, PolygonLevel) {
    if options.scheme == Scheme::DooSabin {
        let mesh = match dual_split::refine(&level.mesh) {
            Ok(mesh) => mesh,
            Err(error) => unreachable!("the child of a manifold is one: {error}"),
        };
        return (rows::doo_sabin::table(&level.mesh), PolygonLevel { mesh, sharpness: Sharpness::default() });
    }
    let refined = corners::refine(&level.mesh);
    let table = rows::catmull_clark::table(level, &refined, options.creasing);
    let sharpness = corners::child_sharpness(level, &refined.mesh, options.creasing);
    (table, PolygonLevel { mesh: refined.mesh, sharpness })
}

/// Children of a face follow each other, and so do theirs.
fn triangle_parents(level: &Level, options: &PlanOptions, control_faces: &[u32]) -> Vec<u32> {
    let n_frozen = level.mesh.n_faces() - level.n_active as usize;
    let (active, frozen) = control_faces.split_at(control_faces.len() - n_frozen);
    let growth = level.n_active as usize / active.len().max(1);
    debug_assert!(options.levels > 0 || growth <= 1);
    let mut parents = Vec::with_capacity(level.mesh.n_faces());
    active.iter().for_each(|&face| parents.resize(parents.len() + growth, face));
    parents.extend(frozen);
    parents
}

/// The control face of each face of the child. A face that Doo-Sabin puts on an edge or a vertex takes that of its first
/// corner.
fn polygon_parents(level: &PolygonLevel, child: &PolygonLevel, scheme: Scheme, parents: &[u32]) -> Vec<u32> {
    let of_dedge = |dedge: usize| parents[level.mesh.face[dedge] as usize];
    match scheme {
        Scheme::DooSabin => child.mesh.faces().map(|face| of_dedge(child.mesh.corners(face)[0] as usize)).collect(),
        _ => (0..level.mesh.n_dedges()).map(of_dedge).collect(),
    }
}

/// The meshes of all levels of a triangle scheme, from level 0: what a [`Plan`](super::Plan) goes through and does not
/// keep. Frozen faces stand last in each.
///
/// # Errors
/// As [`Plan::build_with`](super::Plan::build_with); also for schemes of polygons.
pub fn levels_of(control: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Result<Vec<DedgeMesh>, PlanError> {
    if !options.scheme.is_triangular() {
        return Err(PlanError::NotPolygons { scheme: options.scheme });
    }
    check(options, tags)?;
    let Prepared { level: Last::Triangles(mut level), faces, .. } = prepare::triangles(control, tags, options)? else {
        unreachable!("triangles stay triangles")
    };
    check_size(options, faces.len(), level.n_active)?;
    let mut meshes = vec![level.mesh.clone()];
    for step in 0..options.levels {
        level = triangle_step::<f32>(&level, options, step).1;
        meshes.push(level.mesh.clone());
    }
    Ok(meshes)
}

pub(super) fn check_size(options: &PlanOptions, n_control_faces: usize, n_active: u32) -> Result<(), PlanError> {
    let growth = options.scheme.faces_per_face().unwrap_or(1);
    let n_faces = growth.checked_pow(options.levels).and_then(|n| n.checked_mul(u64::from(n_active)));
    match n_faces {
        Some(n) if n <= MAX_FACES => Ok(()),
        _ => Err(PlanError::TooManyFaces { levels: options.levels, n_control_faces }),
    }
}
