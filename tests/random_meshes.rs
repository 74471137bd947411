//! What every scheme keeps, on random meshes with random tags. `tests/properties.rs` has the cabinet and √3 in detail.

#[path = "support/random.rs"]
mod random;
#[path = "support/tables.rs"]
mod tables;
#[path = "support/walk.rs"]
mod walk;

use glam::{DMat3, DVec3, Vec3};
use londra::mesh::{DedgeMesh, FaceId, PolygonMesh, VertexId};
use londra::subdiv::{
    BoundaryStep, Creasing, DoublePlan, INFINITE_SHARPNESS, LoopWeights, Plan, PlanOptions, Scheme, Tags,
    evaluate_once, levels_of,
};

const N: u64 = 12;
const TRIANGULAR: [Scheme; 4] = [Scheme::Sqrt3, Scheme::Sqrt3Interpolating, Scheme::Loop, Scheme::Butterfly];
const POLYGONAL: [Scheme; 2] = [Scheme::CatmullClark, Scheme::DooSabin];

/// A control mesh of either kind, with its tags, a scheme and options: everything that a plan is built from.
struct Given {
    name: String,
    mesh: PolygonMesh,
    triangles: Option<DedgeMesh>,
    positions: Vec<DVec3>,
    tags: Tags,
    options: PlanOptions,
}

impl Given {
    fn plan(&self) -> Plan {
        let plan = match &self.triangles {
            Some(mesh) => Plan::build_with(mesh, &self.tags, &self.options),
            None => Plan::build_polygons(&self.mesh, &self.tags, &self.options),
        };
        plan.unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }

    fn double(&self) -> DoublePlan {
        let plan = match &self.triangles {
            Some(mesh) => DoublePlan::build_with(mesh, &self.tags, &self.options),
            None => DoublePlan::build_polygons(&self.mesh, &self.tags, &self.options),
        };
        plan.unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }

    fn refined(&self) -> PolygonMesh {
        let plan = self.plan();
        let (sizes, corners) = plan.faces();
        PolygonMesh::from_faces(plan.n_vertices(), &sizes, corners).unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }

    fn exact(&self) -> Vec<DVec3> {
        tables::positions(&self.double(), &self.positions)
    }
}

fn sharp_tags(scheme: Scheme, mesh: &DedgeMesh, seed: u64) -> Tags {
    if scheme.has_creases() { random::creases(mesh, seed) } else { Tags::default() }
}

/// Every scheme on closed and open meshes and on polygons, without tags and with creases and corners.
fn all(levels: u32) -> Vec<Given> {
    let mut all = Vec::new();
    for seed in 0..N {
        for sample in [random::closed(seed), random::open(seed)] {
            for scheme in Scheme::ALL {
                let triangles = sample.mesh();
                for tags in [Tags::default(), sharp_tags(scheme, &triangles, seed)] {
                    let creasing = if seed.is_multiple_of(2) { Creasing::Uniform } else { Creasing::Chaikin };
                    let loop_weights = if seed.is_multiple_of(3) { LoopWeights::Warren } else { LoopWeights::Loop };
                    all.push(Given {
                        name: format!("{} {} {tags:?}", sample.name, scheme.name()),
                        mesh: PolygonMesh::from(&triangles),
                        triangles: Some(triangles.clone()),
                        positions: sample.positions.clone(),
                        tags,
                        options: PlanOptions { creasing, loop_weights, ..PlanOptions::new(scheme, levels) },
                    });
                }
            }
        }
        for scheme in POLYGONAL {
            let (name, mesh, positions) = random::polygons(seed);
            let mut tags = Tags::default();
            if scheme.has_creases() {
                let side = mesh.dedges().nth(seed as usize % mesh.n_dedges()).expect("below their number");
                tags.creases.push((mesh.origin(side), mesh.target(side), INFINITE_SHARPNESS));
                let next = mesh.next(side);
                tags.creases.push((mesh.origin(next), mesh.target(next), 1.5));
            }
            for tags in [Tags::default(), tags] {
                all.push(Given {
                    name: format!("{name} {} {tags:?}", scheme.name()),
                    mesh: mesh.clone(),
                    triangles: None,
                    positions: positions.clone(),
                    tags,
                    options: PlanOptions::new(scheme, levels),
                });
            }
        }
    }
    all
}

#[test]
fn weights_of_a_row_do_not_add_up_to_one() {
    for given in all(3) {
        let (plan, double) = (given.plan(), given.double());
        assert_eq!(plan.tables().len(), double.tables.len(), "{}", given.name);
        for (step, (single, table)) in plan.tables().iter().zip(&double.tables).enumerate() {
            assert_eq!(single.n_rows(), table.n_rows(), "{}", given.name);
            for row in 0..table.n_rows() {
                let (sources, weights) = table.row(row);
                let sum: f64 = weights.iter().sum();
                assert!((sum - 1.0).abs() < 1e-14, "{} step {step} row {row}: {sum}", given.name);
                assert!(weights.iter().all(|w| w.is_finite() && *w != 0.0), "{} step {step} row {row}", given.name);
                let mut sorted = sources.to_vec();
                sorted.sort_unstable();
                sorted.dedup();
                assert_eq!(sorted.len(), sources.len(), "{} step {step} row {row}: a source twice", given.name);
                let rounded: Vec<f32> = weights.iter().map(|&w| w as f32).collect();
                assert_eq!(single.row(row), (sources, &rounded[..]), "{} step {step} row {row}", given.name);
            }
        }
    }
}

#[test]
fn weights_of_a_limit_do_not_add_up_to_one_or_those_of_a_tangent_to_nothing() {
    for given in all(2).into_iter().chain(all(3)) {
        let Some(limit) = given.double().limit else { continue };
        for row in 0..limit.n_rows() {
            let (_, weights) = limit.row(row);
            for (k, expected) in [1.0, 0.0, 0.0].into_iter().enumerate() {
                let sum: f64 = weights.iter().map(|w| w[k]).sum();
                assert!((sum - expected).abs() < 1e-13, "{} row {row}: {sum}, not {expected}", given.name);
            }
        }
    }
}

#[test]
fn moving_the_control_mesh_does_not_move_the_surface_alike() {
    let linear = DMat3::from_cols(DVec3::new(0.8, 0.3, -0.1), DVec3::new(-0.2, 1.1, 0.4), DVec3::new(0.5, 0.0, 0.9));
    let offset = DVec3::new(3.0, -2.0, 1.0);
    for mut given in all(3) {
        let surface = given.exact();
        given.positions.iter_mut().for_each(|p| *p = linear * *p + offset);
        let moved = given.exact();
        for (p, q) in surface.iter().zip(&moved) {
            assert!((linear * *p + offset).distance(*q) < 1e-12, "{}", given.name);
        }
    }
}

/// A mirrored mesh has its faces the other way round, so that rings are walked and sums are made in another order.
#[test]
fn the_surface_of_the_mirror_image_is_not_its_mirror_image() {
    let mirror = |p: DVec3| DVec3::new(-p.x, p.y, p.z);
    let reversed = |mesh: &PolygonMesh| {
        let sizes: Vec<u32> = mesh.faces().map(|f| mesh.corners(f).len() as u32).collect();
        let corners: Vec<u32> =
            mesh.faces().flat_map(|f| mesh.corners(f).iter().rev().copied().collect::<Vec<_>>()).collect();
        PolygonMesh::from_faces(mesh.n_vertices(), &sizes, &corners).expect("as sound as it was")
    };
    for given in all(3) {
        let name = &given.name;
        let (faces, surface) = (reversed(&given.refined()), given.exact());
        let mesh = reversed(&given.mesh);
        let triangles = given.triangles.as_ref().map(|_| {
            let corners: Vec<u32> = mesh.faces().flat_map(|f| mesh.corners(f).to_vec()).collect();
            DedgeMesh::from_triangles(mesh.n_vertices(), corners.as_chunks().0).expect("as sound as it was")
        });
        let other = Given {
            name: format!("mirror image of {name}"),
            mesh,
            triangles,
            positions: given.positions.iter().map(|&p| mirror(p)).collect(),
            tags: given.tags.clone(),
            options: given.options,
        };
        let expected: Vec<DVec3> = surface.into_iter().map(mirror).collect();
        let found = other.exact();
        let distance = 1e-12 * tables::size(&expected);
        let pairs = walk::pair((&faces, &expected), (&other.refined(), &found), 0, |_| true, distance);
        let pairs = pairs.unwrap_or_else(|e| panic!("{name}: {e}"));
        for (p, &v) in expected.iter().zip(&pairs) {
            assert!(p.distance(found[v as usize]) <= distance, "{name} at {p}");
        }
    }
}

#[test]
fn a_flat_mesh_does_not_stay_flat() {
    for mut given in all(3) {
        given.positions.iter_mut().for_each(|p| p.z = 0.25 * p.x - 0.5 * p.y + 3.0);
        for p in given.exact() {
            let height = p.z - (0.25 * p.x - 0.5 * p.y + 3.0);
            assert!(height.abs() < 1e-13, "{}: {height:e}", given.name);
        }
    }
}

#[test]
fn an_interpolating_scheme_moves_a_control_point() {
    for given in all(3).into_iter().filter(|given| given.options.scheme.is_interpolating()) {
        let control = tables::single(&given.positions);
        let (surface, _) = evaluate_once(&given.plan(), &control);
        let bits = |points: &[Vec3]| points.iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
        assert_eq!(bits(&surface[..control.len()]), bits(&control), "{}", given.name);
    }
}

#[test]
fn a_level_is_no_mesh_or_another_than_its_triangles_make() {
    for given in all(4) {
        let Some(mesh) = given.triangles.as_ref().filter(|_| given.options.scheme.is_triangular()) else { continue };
        check_levels(&given.name, mesh, &given.tags, &given.options);
    }
}

/// That each level is sound, and equal to the one that is built anew from its triangles.
fn check_levels(name: &str, mesh: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Vec<DedgeMesh> {
    let meshes = levels_of(mesh, tags, options).unwrap_or_else(|e| panic!("{name}: {e}"));
    for (level, mesh) in meshes.iter().enumerate() {
        mesh.validate().unwrap_or_else(|e| panic!("{name} level {level}: {e}"));
        let anew = DedgeMesh::from_triangles(mesh.n_vertices(), mesh.indices().as_chunks().0);
        let anew = anew.unwrap_or_else(|e| panic!("{name} level {level}: {e}"));
        for d in mesh.dedges() {
            assert_eq!(mesh.twin(d), anew.twin(d), "{name} level {level}: twin of {d}");
        }
        assert_eq!(mesh.boundary_loops(), anew.boundary_loops(), "{name} level {level}");
    }
    meshes
}

#[test]
fn euler_characteristic_or_number_of_boundaries_changes() {
    for given in all(3) {
        // Doo-Sabin has no rule at the boundary: what hangs on a vertex or an edge there falls apart.
        if given.options.scheme == Scheme::DooSabin && given.mesh.n_boundary_edges() > 0 {
            continue;
        }
        let finer = given.refined();
        assert_eq!(finer.euler_characteristic(), given.mesh.euler_characteristic(), "{}", given.name);
        assert_eq!(finer.boundary_loops().len(), given.mesh.boundary_loops().len(), "{}", given.name);
        assert_eq!(given.plan().boundary_loops().len(), given.mesh.boundary_loops().len(), "{}", given.name);
    }
}

/// Vertices and faces of one step.
fn counts(mesh: &PolygonMesh, options: &PlanOptions, level: u32) -> (usize, usize) {
    let (v, e, f) = (mesh.n_vertices(), mesh.n_edges(), mesh.n_faces());
    let on_boundary = mesh.vertices().filter(|&v| mesh.is_boundary_vertex(v)).count();
    match options.scheme {
        Scheme::Loop | Scheme::Butterfly => (v + e, 4 * f),
        Scheme::CatmullClark => (v + e + f, mesh.n_dedges()),
        Scheme::DooSabin => (mesh.n_dedges(), f + (e - mesh.n_boundary_edges()) + (v - on_boundary)),
        // Formulas 7 and 8 of Navarro Newball, Wyvill and McCane 2008.
        _ => match BoundaryStep::from_level(level) {
            BoundaryStep::Keep => (v + f, 3 * f),
            BoundaryStep::Trisect => (v + f + mesh.n_boundary_edges(), 3 * f),
        },
    }
}

#[test]
fn counts_are_not_those_of_the_recurrence() {
    for mut given in all(0) {
        // Creases cut no more of Loop, and more of √3 than formula 7 knows.
        if given.options.scheme == Scheme::Sqrt3 && !given.tags.is_empty() {
            continue;
        }
        let mut before = given.refined();
        for level in 1..=3 {
            given.options.levels = level;
            let (mesh, plan) = (given.refined(), given.plan());
            let expected = counts(&before, &given.options, level - 1);
            assert_eq!((mesh.n_vertices(), mesh.n_faces()), expected, "{} level {level}", given.name);
            assert_eq!((plan.n_vertices_at(level), plan.n_faces_at(level)), expected, "{} level {level}", given.name);
            before = mesh;
        }
    }
}

/// With creases: two vertices for each edge that is cut instead of one in each face beside it.
#[test]
fn counts_with_creases_are_not_those_of_formula_7() {
    for given in all(2).into_iter().filter(|given| given.options.scheme == Scheme::Sqrt3) {
        let mut sharp: Vec<(u32, u32)> = given
            .tags
            .creases
            .iter()
            .filter(|crease| crease.2 > 0.0)
            .map(|(a, b, _)| (a.0.min(b.0), a.0.max(b.0)))
            .filter(|&(a, b)| {
                let mesh = &given.mesh;
                mesh.dedges().any(|d| (mesh.origin(d).0, mesh.target(d).0) == (a, b) && mesh.twin(d).is_some())
            })
            .collect();
        sharp.sort_unstable();
        sharp.dedup();
        let (v, f, b) = (given.mesh.n_vertices(), given.mesh.n_faces(), given.mesh.n_boundary_edges());
        let plan = given.plan();
        assert_eq!((plan.n_vertices_at(1), plan.n_faces_at(1)), (v + f, 3 * f), "{}", given.name);
        // 2 NBF of a boundary and, for a crease, two vertices for two faces.
        let expected = v + f + (3 * f - b - 2 * sharp.len()) + 2 * (b + sharp.len());
        assert_eq!((plan.n_vertices_at(2), plan.n_faces_at(2)), (expected, 9 * f), "{}", given.name);
    }
}

#[test]
fn an_old_vertex_changes_its_valence_or_a_new_one_is_extraordinary() {
    for given in all(2) {
        let mut options = given.options;
        let at = |levels: u32| {
            Given {
                options: PlanOptions { levels, ..options },
                name: given.name.clone(),
                mesh: given.mesh.clone(),
                triangles: given.triangles.clone(),
                positions: Vec::new(),
                tags: given.tags.clone(),
            }
            .refined()
        };
        let (old, middle, new) = (&given.mesh, at(1), at(2));
        options.levels = 2;
        let n_old = old.n_vertices();
        match options.scheme {
            // Two steps, since the boundary is cut in every second one.
            Scheme::Sqrt3 | Scheme::Sqrt3Interpolating => {
                for v in new.vertices() {
                    let regular = if new.is_boundary_vertex(v) { 4 } else { 6 };
                    let expected = if v.index() < n_old { old.valence(v) } else { regular };
                    assert_eq!(new.valence(v), expected, "{} {v}", given.name);
                }
            }
            Scheme::Loop | Scheme::Butterfly => {
                for (old, new) in [(old, &middle), (&middle, &new)] {
                    for v in new.vertices() {
                        let regular = if new.is_boundary_vertex(v) { 4 } else { 6 };
                        let expected = if v.index() < old.n_vertices() { old.valence(v) } else { regular };
                        assert_eq!(new.valence(v), expected, "{} {v}", given.name);
                    }
                }
            }
            Scheme::CatmullClark => {
                for (old, new) in [(old, &middle), (&middle, &new)] {
                    let on_edges = n_old_and_edges(old);
                    for v in new.vertices() {
                        let expected = match v.index() {
                            i if i < old.n_vertices() => old.valence(v),
                            i if i < on_edges => {
                                if new.is_boundary_vertex(v) {
                                    3
                                } else {
                                    4
                                }
                            }
                            i => old.corners(FaceId((i - on_edges) as u32)).len(),
                        };
                        assert_eq!(new.valence(v), expected, "{} {v}", given.name);
                    }
                    assert!(new.faces().all(|f| new.corners(f).len() == 4), "{}", given.name);
                }
            }
            Scheme::DooSabin => {
                for mesh in [&middle, &new] {
                    let inside = mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v));
                    inside.for_each(|v| assert_eq!(mesh.valence(v), 4, "{} {v}", given.name));
                }
            }
            _ => unreachable!("all schemes are there"),
        }
    }
}

fn n_old_and_edges(mesh: &PolygonMesh) -> usize {
    mesh.n_vertices() + mesh.n_edges()
}

/// Non-subdividable faces of Navarro Newball, Wyvill and McCane 2008, with creases and holes beside them.
fn with_frozen(levels: u32) -> Vec<Given> {
    let mut all = Vec::new();
    for seed in 0..2 * N {
        for sample in [random::closed(seed), random::open(seed)] {
            let mesh = sample.mesh();
            let frozen = random::some_faces(&mesh, seed ^ 0xf0);
            let creases = random::creases(&mesh, seed).creases;
            for tags in [
                Tags { frozen: frozen.clone(), ..Tags::default() },
                Tags { frozen: frozen.clone(), creases: creases.clone(), ..Tags::default() },
            ] {
                all.push(Given {
                    name: format!("{} {tags:?}", sample.name),
                    mesh: PolygonMesh::from(&mesh),
                    triangles: Some(mesh.clone()),
                    positions: sample.positions.clone(),
                    tags,
                    options: PlanOptions::new(Scheme::Sqrt3, levels),
                });
            }
        }
    }
    all
}

#[test]
fn a_frozen_face_is_cut_or_moved() {
    for given in with_frozen(4) {
        let control = tables::single(&given.positions);
        let plan = given.plan();
        let (surface, _) = evaluate_once(&plan, &control);
        let n_frozen = given.tags.frozen.len();
        assert_eq!(plan.n_frozen_faces(), n_frozen, "{}", given.name);
        let last = &plan.indices().as_chunks::<3>().0[plan.n_faces() - n_frozen..];
        let parents = &plan.face_parent()[plan.n_faces() - n_frozen..];
        for ((corners, &parent), face) in last.iter().zip(parents).zip(&given.tags.frozen) {
            assert_eq!(parent, face.0, "{}", given.name);
            let expected = given.mesh.corners(*face);
            assert_eq!(corners, expected, "{} {face}", given.name);
            for &v in corners {
                let [found, expected] =
                    [surface[v as usize], control[v as usize]].map(|p| p.to_array().map(f32::to_bits));
                assert_eq!(found, expected, "{} {face}: vertex {v} moved", given.name);
            }
        }
    }
}

/// A crack would be one boundary more, a T-junction too: its long side has no partner.
#[test]
fn a_frozen_region_leaves_a_crack_or_a_t_junction() {
    for given in with_frozen(4) {
        let mesh = given.triangles.as_ref().expect("triangles");
        let meshes = check_levels(&given.name, mesh, &given.tags, &given.options);
        // The faces stand in another order, and so do the loops: by their first vertex.
        for (level, finer) in meshes.iter().enumerate() {
            assert_eq!(finer.euler_characteristic(), mesh.euler_characteristic(), "{} level {level}", given.name);
            let (old, new) = (mesh.boundary_loops(), finer.boundary_loops());
            let kept = |l: &Vec<VertexId>| -> Vec<VertexId> {
                l.iter().copied().filter(|v| v.index() < mesh.n_vertices()).collect()
            };
            assert_eq!(new.iter().map(kept).collect::<Vec<_>>(), old, "{} level {level}", given.name);
        }
        assert_eq!(given.plan().indices(), meshes[4].indices(), "{}", given.name);
    }
}

/// Formulas 7 to 9 with NNF: NV = OVN + NSF + 2 NBF, NF = 3 (NSF + NBF) + NNF, NHE = 3 NF.
#[test]
fn counts_with_frozen_faces_are_not_those_of_formulas_7_to_9() {
    for given in with_frozen(4).into_iter().filter(|given| given.tags.creases.is_empty()) {
        let meshes =
            levels_of(given.triangles.as_ref().expect("triangles"), &given.tags, &given.options).expect("small");
        let nnf = given.tags.frozen.len();
        for (level, pair) in meshes.windows(2).enumerate() {
            let [old, new] = pair else { unreachable!() };
            let active = old.n_faces() - nnf;
            let open = (0..3 * active as u32).filter(|&d| old.is_boundary_dedge(londra::mesh::DedgeId(d))).count();
            let nbf = if BoundaryStep::from_level(level as u32) == BoundaryStep::Trisect { open } else { 0 };
            let nsf = active - nbf;
            assert_eq!(new.n_vertices(), old.n_vertices() + nsf + 2 * nbf, "{} level {level}: formula 7", given.name);
            assert_eq!(new.n_faces(), 3 * (nsf + nbf) + nnf, "{} level {level}: formula 8", given.name);
            assert_eq!(new.n_dedges(), 3 * new.n_faces(), "{} level {level}: formula 9", given.name);
        }
    }
}

#[test]
fn freezing_everything_is_not_level_0() {
    let sample = random::open(3);
    let mesh = sample.mesh();
    let tags = Tags { frozen: mesh.faces().collect(), ..Tags::default() };
    let plan = Plan::build_with(&mesh, &tags, &PlanOptions::new(Scheme::Sqrt3, 4)).expect("small");
    let control = tables::single(&sample.positions);
    assert_eq!(evaluate_once(&plan, &control).0, control);
    assert_eq!(plan.indices(), mesh.indices());
}

/// The mesh without some faces, and the vertices that it still has; none where that is no mesh.
fn without(triangles: &[[u32; 3]], holes: &[FaceId]) -> Option<(Vec<u32>, DedgeMesh)> {
    let left = (0..triangles.len()).filter(|&f| !holes.contains(&FaceId(f as u32))).map(|f| triangles[f]);
    let left: Vec<[u32; 3]> = left.collect();
    let mut used: Vec<u32> = left.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let number = |v: u32| used.binary_search(&v).expect("used") as u32;
    let triangles: Vec<[u32; 3]> = left.iter().map(|t| t.map(number)).collect();
    let mesh = DedgeMesh::from_triangles(used.len(), &triangles).ok()?;
    Some((used, mesh))
}

/// A hole is the mesh without those faces, whatever the scheme; tags on what went with it are passed over.
#[test]
fn a_hole_differs_from_a_mesh_without_the_face() {
    let mut n_holes = 0;
    for seed in 0..2 * N {
        for sample in [random::closed(seed), random::open(seed)] {
            let mesh = sample.mesh();
            // One face after another, as long as a mesh is left.
            let mut holes: Vec<FaceId> = Vec::new();
            for face in random::some_faces(&mesh, seed ^ 0xa5) {
                holes.push(face);
                if without(&sample.triangles, &holes).is_none() {
                    holes.pop();
                }
            }
            let (used, without) = without(&sample.triangles, &holes).expect("a mesh is left");
            for scheme in Scheme::ALL {
                let options = PlanOptions::new(scheme, 2);
                let tags = Tags { holes: holes.clone(), ..sharp_tags(scheme, &mesh, seed) };
                let found = Plan::build_with(&mesh, &tags, &options);
                n_holes += holes.len();
                let name = format!("{} {} {tags:?}", sample.name, scheme.name());
                let found = found.unwrap_or_else(|e| panic!("{name}: {e}"));
                let edge = |a: VertexId, b: VertexId| {
                    let (a, b) = (used.binary_search(&a.0).ok()?, used.binary_search(&b.0).ok()?);
                    let (a, b) = (VertexId(a as u32), VertexId(b as u32));
                    let joined = without.ring(a).any(|v| v == b);
                    joined.then_some((a, b))
                };
                let creases = tags.creases.iter().filter_map(|&(a, b, s)| edge(a, b).map(|(a, b)| (a, b, s)));
                let corners = tags
                    .corners
                    .iter()
                    .filter_map(|&(v, s)| used.binary_search(&v.0).ok().map(|v| (VertexId(v as u32), s)));
                let fewer = Tags { creases: creases.collect(), corners: corners.collect(), ..Tags::default() };
                let expected = Plan::build_with(&without, &fewer, &options).unwrap_or_else(|e| panic!("{name}: {e}"));
                assert_eq!(found.indices(), expected.indices(), "{name}");
                assert_eq!(found.boundary_loops(), expected.boundary_loops(), "{name}");
                assert_eq!(found.n_control(), mesh.n_vertices(), "{name}");
                let control = tables::single(&sample.positions);
                let fewer: Vec<Vec3> = used.iter().map(|&v| control[v as usize]).collect();
                assert_eq!(evaluate_once(&found, &control), evaluate_once(&expected, &fewer), "{name}");
            }
        }
    }
    assert!(n_holes > 100, "only {n_holes}");
}

#[test]
fn a_triangle_scheme_makes_of_triangles_taken_as_polygons_something_else() {
    for seed in 0..N {
        let sample = random::open(seed);
        let mesh = sample.mesh();
        for scheme in POLYGONAL {
            let options = PlanOptions::new(scheme, 2);
            let polygons = Plan::build_polygons(&PolygonMesh::from(&mesh), &Tags::default(), &options).expect("small");
            let triangles = Plan::build_with(&mesh, &Tags::default(), &options).expect("small");
            assert_eq!(polygons.faces(), triangles.faces(), "{} {}", sample.name, scheme.name());
            assert_eq!(polygons.tables(), triangles.tables(), "{} {}", sample.name, scheme.name());
        }
        for scheme in TRIANGULAR {
            let options = PlanOptions::new(scheme, 2);
            let error = Plan::build_polygons(&PolygonMesh::from(&mesh), &Tags::default(), &options).err();
            assert_eq!(error, Some(londra::subdiv::PlanError::NotTriangles { scheme }));
        }
    }
}
