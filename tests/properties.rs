//! What subdivision keeps and what it multiplies, on every shape of the cabinet.

use glam::{Mat3, Vec3};
use londra::math::rng::Rng;
use londra::mesh::DedgeMesh;
use londra::mesh::shapes::{Shape, cabinet, icosahedron, pillow, tetrahedron};
use londra::subdiv::{
    self, BoundaryStep, Evaluator, MAX_FACES, Plan, PlanError, PlanOptions, Scheme, Tags, evaluate_once,
};

const LEVELS: u32 = 5;

fn mesh(shape: &Shape) -> DedgeMesh {
    shape.mesh().unwrap_or_else(|e| panic!("{}: {e}", shape.name))
}

fn plan(shape: &Shape, levels: u32) -> Plan {
    Plan::build(&mesh(shape), Scheme::Sqrt3, levels).unwrap_or_else(|e| panic!("{}: {e}", shape.name))
}

/// All meshes of a few steps, from level 0.
fn levels_of(shape: &Shape, levels: u32) -> Vec<DedgeMesh> {
    let options = PlanOptions::new(Scheme::Sqrt3, levels);
    subdiv::levels_of(&mesh(shape), &Tags::default(), &options).unwrap_or_else(|e| panic!("{}: {e}", shape.name))
}

fn jittered(shape: &Shape, seed: u64) -> Vec<Vec3> {
    let mut rng = Rng::new(seed);
    shape.positions.iter().map(|&p| p + Vec3::from_array([0; 3].map(|_| rng.between(-0.2, 0.2)))).collect()
}

fn size(points: &[Vec3]) -> f32 {
    let (low, high) = points.iter().fold((points[0], points[0]), |(l, h), &p| (l.min(p), h.max(p)));
    (high - low).length()
}

#[test]
fn a_refined_mesh_breaks_an_invariant() {
    for shape in cabinet() {
        for (level, mesh) in levels_of(&shape, LEVELS).iter().enumerate() {
            mesh.validate().unwrap_or_else(|e| panic!("{} level {level}: {e}", shape.name));
        }
    }
}

/// The twins that refinement computes against those that are found from the triangles alone.
#[test]
fn refined_connectivity_differs_from_one_built_anew() {
    // The children of a pillow have several edges between the same two vertices, which a triangle list cannot say.
    for shape in cabinet().iter().filter(|s| **s != pillow()) {
        for (level, mesh) in levels_of(shape, 4).iter().enumerate() {
            let (triangles, _) = mesh.indices().as_chunks::<3>();
            let anew = DedgeMesh::from_triangles(mesh.n_vertices(), triangles)
                .unwrap_or_else(|e| panic!("{} level {level}: {e}", shape.name));
            for d in mesh.dedges() {
                assert_eq!(mesh.twin(d), anew.twin(d), "{} level {level} {d}", shape.name);
            }
        }
    }
}

/// Formulas 7 to 9 of Navarro Newball, Wyvill and McCane 2008, all faces being subdividable:
/// NV = OVN + NSF + 2 NBF, NF = 3 ONF, NHE = 3 NF. On a keeping step every face gets a new vertex, so that NSF is all
/// faces and NBF is 0; on a trisecting one NBF is the faces on the boundary and NSF the others.
#[test]
fn counts_per_level_are_not_those_of_formulas_7_to_9() {
    for shape in cabinet() {
        let plan = plan(&shape, LEVELS);
        let meshes = levels_of(&shape, LEVELS);
        for level in 0..=LEVELS {
            let mesh = &meshes[level as usize];
            assert_eq!(plan.n_vertices_at(level), mesh.n_vertices(), "{} level {level}", shape.name);
            assert_eq!(plan.n_faces_at(level), mesh.n_faces(), "{} level {level}", shape.name);
            if level == 0 {
                continue;
            }
            let old = &meshes[level as usize - 1];
            let (ovn, onf) = (old.n_vertices(), old.n_faces());
            let nbf = if level.is_multiple_of(2) { old.n_boundary_edges() } else { 0 };
            let nsf = onf - nbf;
            assert_eq!(mesh.n_vertices(), ovn + nsf + 2 * nbf, "{} level {level}: formula 7", shape.name);
            assert_eq!(mesh.n_faces(), 3 * onf, "{} level {level}: formula 8", shape.name);
            assert_eq!(mesh.n_dedges(), 9 * onf, "{} level {level}: formula 9", shape.name);
            let trisected = if level.is_multiple_of(2) { 3 } else { 1 };
            assert_eq!(mesh.n_boundary_edges(), trisected * old.n_boundary_edges(), "{} level {level}", shape.name);
        }
        assert_eq!(plan.n_vertices(), plan.n_vertices_at(LEVELS));
        assert_eq!(plan.n_faces(), plan.n_faces_at(LEVELS));
        assert_eq!(plan.indices().len(), 3 * plan.n_faces());
        assert_eq!(plan.n_control(), shape.positions.len());
        assert_eq!(plan.levels(), LEVELS);
    }
}

#[test]
fn closed_counts_differ_from_the_closed_formula() {
    let plan = plan(&icosahedron(), LEVELS);
    for level in 0..=LEVELS {
        let n_faces = 20 * 3_usize.pow(level);
        assert_eq!(plan.n_faces_at(level), n_faces);
        assert_eq!(plan.n_vertices_at(level), 2 + n_faces / 2);
    }
}

#[test]
fn euler_characteristic_or_number_of_boundaries_changes() {
    for shape in cabinet() {
        let meshes = levels_of(&shape, LEVELS);
        for mesh in &meshes {
            assert_eq!(mesh.euler_characteristic(), meshes[0].euler_characteristic(), "{}", shape.name);
            assert_eq!(mesh.boundary_loops().len(), meshes[0].boundary_loops().len(), "{}", shape.name);
        }
    }
}

#[test]
fn an_old_vertex_changes_its_valence_or_a_new_one_has_not_six() {
    for shape in cabinet() {
        let meshes = levels_of(&shape, 4);
        for (level, pair) in meshes.windows(2).enumerate() {
            let [old, new] = pair else { unreachable!() };
            for v in new.vertices().filter(|&v| !new.is_boundary_vertex(v)) {
                let found = new.valence(v);
                let is_old = v.index() < old.n_vertices();
                match BoundaryStep::from_level(level as u32) {
                    BoundaryStep::Keep if is_old => assert_eq!(found, old.valence(v), "{} {v}", shape.name),
                    BoundaryStep::Keep => {
                        // A new vertex has one neighbour less for each side of its face on the boundary…
                        let face = londra::mesh::FaceId((v.index() - old.n_vertices()) as u32);
                        let open = (0..3).filter(|&side| old.is_boundary_dedge(face.dedge(side))).count();
                        assert_eq!(found, 6 - open, "{} {v}", shape.name);
                    }
                    // …and gets it back when that side is trisected.
                    BoundaryStep::Trisect if is_old => {
                        let opposite = old.outgoing_dedges(v).filter(|d| old.is_boundary_dedge(d.next())).count();
                        assert_eq!(found, old.valence(v) + opposite, "{} {v}", shape.name);
                    }
                    BoundaryStep::Trisect => assert_eq!(found, 6, "{} {v}", shape.name),
                }
            }
        }
        for (old, new) in [(&meshes[0], &meshes[2]), (&meshes[2], &meshes[4])] {
            for v in new.vertices() {
                let new_valence = if new.is_boundary_vertex(v) { 4 } else { 6 };
                let expected = if v.index() < old.n_vertices() { old.valence(v) } else { new_valence };
                assert_eq!(new.valence(v), expected, "{} {v} over two steps", shape.name);
            }
        }
    }
}

#[test]
fn weights_of_a_row_do_not_add_up_to_one() {
    for shape in cabinet() {
        let mesh = mesh(&shape);
        let exact = Plan::double_tables(&mesh, Scheme::Sqrt3, 4).expect("small");
        let plan = plan(&shape, 4);
        for (table, double) in plan.tables().iter().zip(&exact) {
            assert_eq!(table.n_rows(), double.n_rows());
            for row in 0..table.n_rows() {
                let sum: f64 = double.row(row).1.iter().sum();
                assert!((sum - 1.0).abs() < 1e-14, "{} row {row}: {sum}", shape.name);
                assert_eq!(table.row(row).0, double.row(row).0);
                for (&w, &d) in table.row(row).1.iter().zip(double.row(row).1) {
                    assert_eq!(w, d as f32);
                    assert!(w > 0.0, "{} row {row}: √3 averages, it does not extrapolate", shape.name);
                }
            }
        }
    }
}

#[test]
fn moving_the_control_mesh_does_not_move_the_surface_alike() {
    let linear = Mat3::from_cols(Vec3::new(0.8, 0.3, -0.1), Vec3::new(-0.2, 1.1, 0.4), Vec3::new(0.5, 0.0, 0.9));
    let offset = Vec3::new(3.0, -2.0, 1.0);
    for (seed, shape) in cabinet().iter().enumerate() {
        let plan = plan(shape, 4);
        let control = jittered(shape, seed as u64);
        let moved: Vec<_> = control.iter().map(|&p| linear * p + offset).collect();
        let ((surface, _), (surface_moved, _)) = (evaluate_once(&plan, &control), evaluate_once(&plan, &moved));
        let tolerance = 2e-6 * (size(&moved) + offset.length());
        for (&p, &q) in surface.iter().zip(&surface_moved) {
            assert!((linear * p + offset).distance(q) < tolerance, "{}", shape.name);
        }
    }
}

#[test]
fn the_surface_leaves_the_box_of_its_control_positions() {
    for (seed, shape) in cabinet().iter().enumerate() {
        let control = jittered(shape, seed as u64);
        let (low, high) = control.iter().fold((control[0], control[0]), |(l, h), &p| (l.min(p), h.max(p)));
        let slack = Vec3::splat(1e-5);
        for p in evaluate_once(&plan(shape, 4), &control).0 {
            assert!(p.cmpge(low - slack).all() && p.cmple(high + slack).all(), "{} {p}", shape.name);
        }
    }
}

#[test]
fn level_0_is_not_the_control_mesh() {
    for shape in cabinet() {
        let plan = plan(&shape, 0);
        let mut evaluator = Evaluator::new(&plan);
        let surface = evaluator.evaluate(&plan, &shape.positions);
        assert_eq!(surface.positions, shape.positions);
        assert_eq!(surface.indices, shape.triangles.as_flattened());
        assert!(surface.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-6), "{}", shape.name);
        assert_eq!(plan.face_parent(), (0..shape.triangles.len() as u32).collect::<Vec<_>>());
    }
}

#[test]
fn an_odd_depth_is_not_the_even_one_and_a_step() {
    for shape in cabinet() {
        let (deep, shallow) = (plan(&shape, 3), plan(&shape, 2));
        assert_eq!(deep.tables()[..2], *shallow.tables(), "{}", shape.name);
        let meshes = levels_of(&shape, 3);
        for (plan, mesh) in [(&shallow, &meshes[2]), (&deep, &meshes[3])] {
            assert_eq!(plan.indices(), mesh.indices(), "{}", shape.name);
            let loops: Vec<Vec<u32>> = mesh.boundary_loops().iter().map(|l| l.iter().map(|v| v.0).collect()).collect();
            assert_eq!(plan.boundary_loops(), loops, "{}", shape.name);
        }
    }
}

#[test]
fn a_face_descends_from_a_control_face_that_it_does_not_touch() {
    for shape in cabinet() {
        let plan = plan(&shape, 2);
        let mut children = vec![0; shape.triangles.len()];
        for &parent in plan.face_parent() {
            children[parent as usize] += 1;
        }
        assert!(children.iter().all(|&n| n == 9), "{}: {children:?}", shape.name);
        // In two steps a face of the control mesh sees only itself and what shares a vertex with it.
        for (f, corners) in plan.indices().as_chunks::<3>().0.iter().enumerate() {
            let control = shape.triangles[plan.face_parent()[f] as usize];
            let sources = corners.iter().flat_map(|&v| control_sources(&plan, v));
            assert!(sources.into_iter().any(|s| control.contains(&s)), "{} face {f}", shape.name);
        }
    }
}

fn control_sources(plan: &Plan, vertex: u32) -> Vec<u32> {
    plan.tables()
        .iter()
        .rev()
        .fold(vec![vertex], |vertices, table| vertices.iter().flat_map(|&v| table.row(v as usize).0.to_vec()).collect())
}

#[test]
fn threads_change_a_bit() {
    // Large enough for several chunks.
    let shape = icosahedron();
    let plan = plan(&shape, 7);
    let control = jittered(&shape, 5);
    let bits = |v: &[Vec3]| v.iter().flat_map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    let mut evaluator = Evaluator::new(&plan);
    let surface = evaluator.evaluate(&plan, &control);
    let expected = (bits(surface.positions), bits(surface.normals));
    for threads in [2, 3, 8, 1] {
        evaluator.set_threads(threads);
        assert_eq!(evaluator.threads(), threads);
        let surface = evaluator.evaluate(&plan, &control);
        assert!((bits(surface.positions), bits(surface.normals)) == expected, "{threads} threads");
        let mut attribute = vec![Vec3::ZERO; plan.n_vertices()];
        evaluator.evaluate_attribute(&plan, &control, &mut attribute);
        assert!(bits(&attribute) == expected.0, "{threads} threads: an attribute is not refined as positions are");
    }
}

#[test]
fn an_evaluator_remembers_the_plan_before() {
    let (small, large) = (tetrahedron(), icosahedron());
    let plans =
        [(&large, plan(&large, 4)), (&small, plan(&small, 2)), (&small, plan(&small, 0)), (&large, plan(&large, 3))];
    let mut evaluator = Evaluator::new(&plans[0].1);
    for (shape, plan) in &plans {
        let (positions, normals) = evaluate_once(plan, &shape.positions);
        let surface = evaluator.evaluate(plan, &shape.positions);
        assert_eq!((surface.positions, surface.normals), (&positions[..], &normals[..]), "{}", shape.name);
    }
}

#[test]
fn normals_do_not_point_outwards() {
    for level in 0..=4 {
        let shape = icosahedron();
        let (positions, normals) = evaluate_once(&plan(&shape, level), &shape.positions);
        for (p, n) in positions.iter().zip(&normals) {
            assert!((n.length() - 1.0).abs() < 1e-6);
            assert!(n.dot(p.normalize_or_zero()) > 0.99, "level {level}: {p} {n}");
        }
    }
}

/// The dumb judge: faces in index order, in double precision.
#[test]
fn normals_are_not_weighted_by_area() {
    for (seed, shape) in cabinet().iter().enumerate().filter(|(_, s)| **s != pillow()) {
        let plan = plan(shape, 2);
        let (positions, normals) = evaluate_once(&plan, &jittered(shape, seed as u64));
        let mut sums = vec![glam::DVec3::ZERO; positions.len()];
        for &corners in plan.indices().as_chunks::<3>().0 {
            let [a, b, c] = corners.map(|v| positions[v as usize].as_dvec3());
            corners.iter().for_each(|&v| sums[v as usize] += (b - a).cross(c - a));
        }
        for (v, (sum, n)) in sums.iter().zip(&normals).enumerate() {
            let expected = sum.normalize_or_zero().as_vec3();
            assert!(expected.distance(*n) < 1e-4, "{} vertex {v}: {expected} {n}", shape.name);
        }
    }
}

#[test]
fn flattened_tables_do_not_agree_with_the_steps() {
    for (seed, shape) in cabinet().iter().enumerate() {
        let plan = plan(shape, 4);
        let control = jittered(shape, seed as u64);
        let (stepwise, _) = evaluate_once(&plan, &control);
        let flat = plan.tables().iter().skip(1).fold(plan.tables()[0].clone(), |flat, next| next.compose(&flat));
        assert_eq!(flat.n_sources(), plan.n_control());
        let mut direct = vec![Vec3::ZERO; plan.n_vertices()];
        flat.apply(&control, &mut direct);
        let tolerance = 1e-5 * size(&control);
        for (p, q) in stepwise.iter().zip(&direct) {
            assert!(p.distance(*q) < tolerance, "{}", shape.name);
        }
    }
}

#[test]
fn fingerprint_does_not_tell_plans_apart() {
    let mut all: Vec<u64> = Vec::new();
    // An octahedron is a bipyramid over a square, a triangle a fan of one: the same inputs, the same plan.
    for shape in cabinet().iter().filter(|s| !["octahedron", "triangle"].contains(&s.name.as_str())) {
        for levels in 0..3 {
            let fingerprint = plan(shape, levels).fingerprint();
            assert_eq!(fingerprint, plan(shape, levels).fingerprint());
            assert!(!all.contains(&fingerprint), "{} level {levels}", shape.name);
            all.push(fingerprint);
        }
    }
}

#[test]
fn a_depth_beyond_memory_is_tried() {
    let mesh = mesh(&tetrahedron());
    for levels in [16, 20, 40, 1000, u32::MAX] {
        let error = Plan::build(&mesh, Scheme::Sqrt3, levels).err();
        assert_eq!(error, Some(PlanError::TooManyFaces { levels, n_control_faces: 4 }));
    }
    assert!(4 * 3_u64.pow(15) <= MAX_FACES);
}
