//! Adaptive √3 refinement: deep where it is wanted, and without a T-junction anywhere.
//!
//! Kobbelt 2000, section 4: a face of even generation is split at its middle; the three halves, of odd generation, wait
//! until their mates across the old edges have been split too, and then the edge between them is turned. Asking for a face
//! of odd generation to be split therefore asks for its mate first. Here the same follows from the numbers of uniform
//! refinement alone (see `thirds.rs`): face `e` of level k + 1 is the child of directed edge `e` of level k, and it is there
//! exactly if the faces on both sides of that edge are split. So a mesh is a set of split faces for each level that has,
//! with each face, both its parents; it does not depend on the order of splits.
//!
//! Vertices of different generations meet in one mesh. All of them are put where they go in the limit, so that each lies on
//! the surface of the uniform scheme whatever the depth around it.

use glam::{DVec3, Vec3};

use crate::math::ops;
use crate::mesh::{DedgeId, DedgeMesh, FaceId};

use super::level::Level;
use super::limit::LimitTable;
use super::normals::Rings;
use super::plan::{Counts, Plan, PlanError, check, fingerprint};
use super::prepare::{self, Prepared};
use super::scheme::{BoundaryStep, Normals, PlanOptions, Positions, Scheme};
use super::stencil::StencilTable;
use super::steps::{Last, check_size, triangle_step};
use super::tags::Tags;

/// A face that may be split, at rest.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// Its level: 0 for control faces.
    pub level: u32,
    /// The control face that it descends from.
    pub control_face: FaceId,
    /// Where its corners go in the limit.
    pub corners: [DVec3; 3],
    /// Unit normals of the limit surface there; zero where there is none.
    pub normals: [DVec3; 3],
}

impl Candidate {
    /// The largest angle between the face and the surface at its corners, in radians.
    pub fn bend(&self) -> f64 {
        let [a, b, c] = self.corners;
        let normal = (b - a).cross(c - a);
        let length = ops::sqrt(normal.length_squared());
        if length <= 0.0 {
            return 0.0;
        }
        let least = self.normals.iter().map(|n| n.dot(normal) / length).fold(1.0, f64::min);
        ops::acos(least.clamp(-1.0, 1.0))
    }

    /// The longest side.
    pub fn longest_side(&self) -> f64 {
        let [a, b, c] = self.corners;
        ops::sqrt([a - b, b - c, c - a].map(DVec3::length_squared).into_iter().fold(0.0, f64::max))
    }

    /// How far its middle is from a point.
    pub fn distance(&self, point: DVec3) -> f64 {
        let [a, b, c] = self.corners;
        ops::sqrt(((a + b + c) / 3.0 - point).length_squared())
    }
}

/// One level of uniform refinement, and which of its faces are split.
struct Generation {
    level: Level,
    /// To the next level; none at the deepest.
    table: Option<StencilTable<f64>>,
    limit: LimitTable<f64>,
    split: Vec<bool>,
}

impl Plan {
    /// A plan that refines by √3 only where `wants` says so, at most `options.levels` deep, and always gives a conforming
    /// mesh. Of the options, boundary rule, creasing and normals (from faces, or none) count; positions are always those of
    /// the limit. `rest` has one position for each control vertex: the criterion sees the surface over them, and what is
    /// evaluated later keeps the mesh.
    ///
    /// Uniform connectivity is worked out to the deepest level that is used, so the time is that of a uniform plan; the
    /// plan itself is as small as its mesh.
    ///
    /// # Errors
    /// As [`Plan::build_with`]; schemes other than √3; frozen faces; limit normals, which a mixed mesh has none of here.
    ///
    /// # Panics
    /// Where the number of rest positions is another.
    pub fn build_adaptive(
        control: &DedgeMesh,
        tags: &Tags,
        options: &PlanOptions,
        rest: &[Vec3],
        wants: &dyn Fn(&Candidate) -> bool,
    ) -> Result<Plan, PlanError> {
        assert_eq!(rest.len(), control.n_vertices(), "one position for each control vertex");
        if options.scheme != Scheme::Sqrt3 || !tags.frozen.is_empty() {
            return Err(PlanError::NotAdaptive { scheme: options.scheme });
        }
        if options.normals == Normals::Limit {
            return Err(PlanError::NoLimits { scheme: options.scheme });
        }
        let options = PlanOptions { positions: Positions::Limit, ..*options };
        check(&options, tags)?;
        let Prepared { level: Last::Triangles(level), vertices, faces, n_control } =
            prepare::triangles(control, tags, &options)?
        else {
            unreachable!("triangles stay triangles")
        };
        check_size(&options, faces.len(), level.n_active)?;
        let rest: Vec<DVec3> = match &vertices {
            Some(vertices) => vertices.iter().map(|&v| rest[v as usize].as_dvec3()).collect(),
            None => rest.iter().map(|p| p.as_dvec3()).collect(),
        };
        let mut generations = wanted(level, &options, rest, &faces, wants);
        close(&mut generations);
        let (triangles, parents) = leaves(&generations);
        let (mut tables, used) = tables(&generations, &triangles);
        if let Some(vertices) = vertices {
            tables.insert(0, StencilTable::selection(n_control, &vertices));
        }
        let number = |v: u32| used.binary_search(&v).map_or(u32::MAX, |i| i as u32);
        let indices: Vec<u32> = triangles.as_flattened().iter().map(|&v| number(v)).collect();
        let mut hash = crate::math::fnv::Fnv64::new();
        hash.u64(fingerprint(control.n_vertices(), &[], control.indices(), tags, &options));
        indices.iter().for_each(|&i| hash.u32(i));
        let mut counts: Vec<Counts> =
            tables.iter().map(|table| Counts { n_vertices: table.n_sources(), n_faces: faces.len() }).collect();
        counts.push(Counts { n_vertices: used.len(), n_faces: triangles.len() });
        let mesh = match DedgeMesh::from_triangles(used.len(), indices.as_chunks().0) {
            Ok(mesh) => mesh,
            Err(error) => unreachable!("a closed set of splits conforms: {error}"),
        };
        let loops = mesh.boundary_loops();
        Ok(Plan {
            options,
            n_control,
            counts,
            tables,
            face_sizes: Vec::new(),
            corners: Vec::new(),
            face_parent: parents.into_iter().map(|f| faces[f as usize]).collect(),
            n_frozen: 0,
            boundary_loops: loops.into_iter().map(|l| l.into_iter().map(|v| v.0).collect()).collect(),
            rings: (options.normals == Normals::Faces).then(|| {
                let n_entries = mesh.n_dedges() + mesh.n_vertices();
                Rings::of(mesh.n_vertices(), n_entries, |v| mesh.ring(v), |v| mesh.is_boundary_vertex(v))
            }),
            limit: None,
            patches: None,
            indices,
            fingerprint: hash.finish(),
        })
    }
}

/// Uniform levels as deep as faces are wanted; in each the faces that the criterion wants split.
fn wanted(
    level: Level,
    options: &PlanOptions,
    mut positions: Vec<DVec3>,
    control_faces: &[u32],
    wants: &dyn Fn(&Candidate) -> bool,
) -> Vec<Generation> {
    let mut generations: Vec<Generation> = Vec::new();
    let mut level = level;
    loop {
        let depth = generations.len() as u32;
        let limit = LimitTable::<f64>::build(&level, options, depth);
        let mut split = vec![false; level.mesh.n_faces()];
        if depth < options.levels {
            let growth = level.mesh.n_faces() / control_faces.len();
            let surface = limit_surface(&limit, &positions);
            for face in level.mesh.faces() {
                let reached = generations.last().is_none_or(|coarse| {
                    parents(coarse, face).into_iter().flatten().any(|parent| coarse.split[parent.index()])
                });
                if reached {
                    let corners = level.mesh.corners(face).map(|v| surface[v.index()]);
                    split[face.index()] = wants(&Candidate {
                        level: depth,
                        control_face: FaceId(control_faces[face.index() / growth]),
                        corners: corners.map(|(position, _)| position),
                        normals: corners.map(|(_, normal)| normal),
                    });
                }
            }
        }
        if !split.contains(&true) {
            generations.push(Generation { level, table: None, limit, split });
            return generations;
        }
        let (table, next) = triangle_step::<f64>(&level, options, depth);
        let mut finer = vec![DVec3::ZERO; table.n_rows()];
        table.apply(&positions, &mut finer);
        positions = finer;
        generations.push(Generation { level, table: Some(table), limit, split });
        level = next;
    }
}

fn limit_surface(limit: &LimitTable<f64>, positions: &[DVec3]) -> Vec<(DVec3, DVec3)> {
    (0..limit.n_rows())
        .map(|row| {
            let (sources, weights) = limit.row(row);
            let mut sums = [DVec3::ZERO; 3];
            for (&source, weights) in sources.iter().zip(weights) {
                for (sum, &weight) in sums.iter_mut().zip(weights) {
                    *sum += weight * positions[source as usize];
                }
            }
            let normal = sums[1].cross(sums[2]);
            let length = ops::sqrt(normal.length_squared());
            (sums[0], if length > 0.0 { normal / length } else { DVec3::ZERO })
        })
        .collect()
}

/// The faces of a level that a face of the next one needs to be split: those on both sides of the directed edge whose child
/// it is, unless the edge stays between them.
fn parents(coarse: &Generation, child: FaceId) -> [Option<FaceId>; 2] {
    let (level, dedge) = (&coarse.level, DedgeId(child.0));
    let across = level.mesh.twin(dedge).filter(|_| !level.is_open(dedge));
    [Some(dedge.face()), across.map(DedgeId::face)]
}

/// Adds what the split faces need: both parents of each, and the other side of a crease that is cut.
fn close(generations: &mut [Generation]) {
    for depth in (0..generations.len()).rev() {
        let (coarser, finer) = generations.split_at_mut(depth);
        let here = &mut finer[0];
        if BoundaryStep::from_level(depth as u32) == BoundaryStep::Trisect {
            for dedge in here.level.mesh.dedges().filter(|&d| here.level.is_divisible(d)) {
                if let Some(twin) = here.level.mesh.twin(dedge)
                    && here.split[dedge.face().index()]
                {
                    here.split[twin.face().index()] = true;
                }
            }
        }
        let Some(coarse) = coarser.last_mut() else { break };
        for face in here.level.mesh.faces().filter(|f| here.split[f.index()]) {
            for parent in parents(coarse, face).into_iter().flatten() {
                coarse.split[parent.index()] = true;
            }
        }
    }
}

/// The triangles that are left, by vertices of uniform refinement (which keep their numbers from level to level), and the
/// control face of each.
fn leaves(generations: &[Generation]) -> (Vec<[u32; 3]>, Vec<u32>) {
    let n_control_faces = generations[0].level.mesh.n_faces();
    let (mut triangles, mut control) = (Vec::new(), Vec::new());
    for (depth, here) in generations.iter().enumerate() {
        let mesh = &here.level.mesh;
        let growth = mesh.n_faces() / n_control_faces;
        let coarse = depth.checked_sub(1).map(|d| &generations[d]);
        let exists = |face: FaceId| {
            coarse.is_none_or(|coarse| {
                parents(coarse, face).into_iter().flatten().all(|parent| coarse.split[parent.index()])
            })
        };
        for face in mesh.faces().filter(|&face| exists(face)) {
            let control_face = (face.index() / growth) as u32;
            if !here.split[face.index()] {
                triangles.push(mesh.corners(face).map(|v| v.0));
                control.push(control_face);
                continue;
            }
            for dedge in [0, 1, 2].map(|side| face.dedge(side)) {
                let mate = mesh.twin(dedge).filter(|_| !here.level.is_open(dedge)).map(DedgeId::face);
                if mate.is_some_and(|mate| !here.split[mate.index()] || !exists(mate)) {
                    // A half that waits for its mate: the side, and the new vertex that its child has on this side.
                    let next = &generations[depth + 1].level.mesh;
                    let apex = next.corners(FaceId(dedge.0))[2];
                    triangles.push([mesh.origin(dedge).0, mesh.target(dedge).0, apex.0]);
                    control.push(control_face);
                }
            }
        }
    }
    (triangles, control)
}

/// The tables that lead from level 0 to the limit positions of all vertices in use, and those vertices, ascending.
///
/// Between the steps stand the vertices that the next step needs, and behind them those that have arrived.
fn tables(generations: &[Generation], triangles: &[[u32; 3]]) -> (Vec<StencilTable>, Vec<u32>) {
    let mut used: Vec<u32> = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let n_at = |depth: usize| generations[depth].level.mesh.n_vertices() as u32;
    let born = |depth: usize| {
        let first = if depth == 0 { 0 } else { n_at(depth - 1) };
        used[used.partition_point(|&v| v < first)..used.partition_point(|&v| v < n_at(depth))].to_vec()
    };
    // What each level has to know, from the deepest up.
    let mut needed: Vec<Vec<u32>> = vec![Vec::new(); generations.len()];
    for depth in (0..generations.len()).rev() {
        let here = &generations[depth];
        let mut sources: Vec<u32> =
            born(depth).iter().flat_map(|&v| here.limit.row(v as usize).0.iter().copied()).collect();
        if let (Some(table), Some(finer)) = (&here.table, needed.get(depth + 1)) {
            sources.extend(finer.iter().flat_map(|&v| table.row(v as usize).0.iter().copied()));
        }
        sources.sort_unstable();
        sources.dedup();
        needed[depth] = sources;
    }
    needed[0] = (0..n_at(0)).collect();
    let mut tables = Vec::new();
    let mut arrived: Vec<u32> = Vec::new();
    for (depth, here) in generations.iter().enumerate() {
        let place = |v: u32| needed[depth].binary_search(&v).map_or(u32::MAX, |i| i as u32);
        let n_sources = needed[depth].len() + arrived.len();
        let finer: &[u32] = needed.get(depth + 1).map_or(&[], |finer| finer);
        let fresh = born(depth);
        let n_rows = finer.len() + arrived.len() + fresh.len();
        let mut builder = StencilTable::builder(n_sources, n_rows, 7 * n_rows);
        for &v in finer {
            let (sources, weights) = here.table.as_ref().map_or((&[][..], &[][..]), |table| table.row(v as usize));
            for (&source, &weight) in sources.iter().zip(weights) {
                builder.entry(place(source), weight);
            }
            builder.end_row();
        }
        // Those that have arrived are older, hence lower: the order stays ascending.
        for i in 0..arrived.len() {
            builder.entry((needed[depth].len() + i) as u32, 1.0);
            builder.end_row();
        }
        for &v in &fresh {
            let (sources, weights) = here.limit.row(v as usize);
            for (&source, weights) in sources.iter().zip(weights).filter(|(_, weights)| weights[0] != 0.0) {
                builder.entry(place(source), weights[0]);
            }
            builder.end_row();
        }
        arrived.extend(fresh);
        tables.push(builder.finish());
    }
    (tables, used)
}
