//! Refinement that is deep only where it is wanted, and faces that are left alone because they are flat.

use glam::{DVec3, Vec3};
use londra::math::rng::Rng;
use londra::mesh::shapes::{cabinet, grid, grid_with_hole, icosahedron, pillow, torus};
use londra::mesh::{DedgeMesh, FaceId, VertexId};
use londra::subdiv::{
    Candidate, Evaluator, Normals, Plan, PlanError, PlanOptions, Positions, Scheme, Tags, evaluate_once, flat_faces,
};

fn options(levels: u32) -> PlanOptions {
    PlanOptions { positions: Positions::Limit, ..PlanOptions::new(Scheme::Sqrt3, levels) }
}

/// Splitting everything is uniform refinement, pushed to the limit.
#[test]
fn wanting_every_face_is_not_uniform_refinement() {
    for shape in cabinet().iter().filter(|s| **s != pillow()) {
        let mesh = shape.mesh().expect("in the cabinet");
        for levels in 0..=3 {
            let all = |_: &Candidate| true;
            let adaptive = Plan::build_adaptive(&mesh, &Tags::default(), &options(levels), &shape.positions, &all)
                .unwrap_or_else(|e| panic!("{}: {e}", shape.name));
            let uniform = Plan::build_with(&mesh, &Tags::default(), &options(levels)).expect("small");
            assert_eq!(adaptive.n_vertices(), uniform.n_vertices(), "{} level {levels}", shape.name);
            assert_eq!(adaptive.n_faces(), uniform.n_faces(), "{} level {levels}", shape.name);
            let (ours, _) = evaluate_once(&adaptive, &shape.positions);
            let (theirs, _) = evaluate_once(&uniform, &shape.positions);
            for (a, b) in ours.iter().zip(&theirs) {
                assert!((*a - *b).length() < 1e-5, "{} level {levels}: {a} {b}", shape.name);
            }
        }
    }
}

#[test]
fn an_adaptive_mesh_has_a_crack_or_a_wrong_boundary() {
    let mut rng = Rng::new(7);
    for shape in cabinet().iter().filter(|s| **s != pillow()) {
        let mesh = shape.mesh().expect("in the cabinet");
        for round in 0..4 {
            let mut tags = Tags::default();
            for dedge in mesh.dedges().filter(|&d| mesh.twin(d).is_some_and(|t| t > d)) {
                if round > 0 && rng.between(0.0, 1.0) < 0.2 {
                    tags.creases.push((mesh.origin(dedge), mesh.target(dedge), 10.0));
                }
            }
            let seed = rng.between(0.0, 100.0);
            let wants = |c: &Candidate| {
                let middle = (c.corners[0] + c.corners[1] + c.corners[2]) / 3.0;
                let hash = (middle.dot(DVec3::new(12.9, 78.2, 37.7)) + f64::from(seed)) * 43.7;
                hash - hash.floor() < 0.35
            };
            let plan = Plan::build_adaptive(&mesh, &tags, &options(5), &shape.positions, &wants)
                .unwrap_or_else(|e| panic!("{}: {e}", shape.name));
            // Without a T-junction and without a crack it is a manifold with as many boundaries as before.
            let fine = DedgeMesh::from_triangles(plan.n_vertices(), plan.indices().as_chunks().0)
                .unwrap_or_else(|e| panic!("{}: {e}", shape.name));
            assert_eq!(fine.boundary_loops().len(), mesh.boundary_loops().len(), "{}", shape.name);
            assert_eq!(fine.euler_characteristic(), mesh.euler_characteristic(), "{}", shape.name);
            assert_eq!(plan.face_parent().len(), plan.n_faces());
            let (positions, normals) = evaluate_once(&plan, &shape.positions);
            assert!(positions.iter().chain(&normals).all(|p| p.is_finite()), "{}", shape.name);
        }
    }
}

#[test]
fn refinement_by_flatness_or_distance_is_as_deep_far_away_as_near() {
    let shape = torus(12, 8);
    let mesh = shape.mesh().expect("a torus");
    let bent = |bound: f64| {
        Plan::build_adaptive(&mesh, &Tags::default(), &options(6), &shape.positions, &|c| c.bend() > bound)
            .expect("small")
            .n_faces()
    };
    assert!(bent(0.05) > bent(0.1) && bent(0.1) > bent(0.2) && bent(3.2) == mesh.n_faces());
    let eye = DVec3::new(4.0, 0.0, 0.0);
    let near = |c: &Candidate| c.longest_side() > 0.1 * c.distance(eye);
    let plan = Plan::build_adaptive(&mesh, &Tags::default(), &options(6), &shape.positions, &near).expect("small");
    let (positions, _) = evaluate_once(&plan, &shape.positions);
    let longest = |keep: &dyn Fn(Vec3) -> bool| {
        let faces = plan.indices().chunks_exact(3).map(|f| [0, 1, 2].map(|k| positions[f[k] as usize]));
        faces.filter(|f| keep(f[0])).map(|[a, b, _]| (a - b).length()).fold(0.0, f32::max)
    };
    assert!(2.0 * longest(&|p| p.x > 2.0) < longest(&|p| p.x < -2.0));
}

#[test]
fn one_wanted_face_refines_more_than_its_surroundings() {
    let shape = grid(8, 8);
    let mesh = shape.mesh().expect("a grid");
    let wants = |c: &Candidate| c.level < 4 && c.control_face == FaceId(60);
    let plan = Plan::build_adaptive(&mesh, &Tags::default(), &options(4), &shape.positions, &wants).expect("small");
    let of = |face: u32| plan.face_parent().iter().filter(|&&f| f == face).count();
    assert!(of(60) > 27, "{}", of(60));
    assert!((0..10).all(|f| of(f) == 1));
}

#[test]
fn what_adaptive_refinement_cannot_do_is_no_error() {
    let shape = icosahedron();
    let mesh = shape.mesh().expect("an icosahedron");
    let build = |options: PlanOptions, tags: Tags| {
        Plan::build_adaptive(&mesh, &tags, &options, &shape.positions, &|_| true).err()
    };
    assert_eq!(
        build(PlanOptions::new(Scheme::Loop, 1), Tags::default()),
        Some(PlanError::NotAdaptive { scheme: Scheme::Loop })
    );
    let frozen = Tags { frozen: vec![FaceId(1)], ..Tags::default() };
    assert_eq!(build(options(1), frozen), Some(PlanError::NotAdaptive { scheme: Scheme::Sqrt3 }));
    let normals = PlanOptions { normals: Normals::Limit, ..options(1) };
    assert_eq!(build(normals, Tags::default()), Some(PlanError::NoLimits { scheme: Scheme::Sqrt3 }));
}

/// A flat plate with a bump in one corner.
fn plate() -> (DedgeMesh, Vec<Vec3>) {
    let shape = grid(12, 12);
    let mesh = shape.mesh().expect("a grid");
    let positions = shape
        .positions
        .iter()
        .map(|p| Vec3::new(p.x, p.y, if p.x < 4.0 && p.y < 4.0 { p.x * p.y * 0.1 } else { 0.0 }))
        .collect();
    (mesh, positions)
}

#[test]
fn a_bent_face_is_flat_or_a_flat_one_bent() {
    let (mesh, positions) = plate();
    let flat = flat_faces(&mesh, &positions, 1e-6);
    for face in mesh.faces() {
        let corners = mesh.corners(face).map(|v| positions[v.index()]);
        let far = corners.iter().all(|p| p.x > 7.5 || p.y > 7.5);
        let near = corners.iter().all(|p| p.x < 4.5 && p.y < 4.5);
        let is_flat = flat.contains(&face);
        assert!(is_flat || !far, "{face} is flat");
        assert!(!is_flat || !near, "{face} is bent");
    }
    assert_eq!(flat_faces(&mesh, &positions, 3.2).len(), mesh.n_faces(), "nothing is turned by more than half a turn");
    let sphere = icosahedron();
    assert!(flat_faces(&sphere.mesh().expect("closed"), &sphere.positions, 0.5).is_empty());
    let mut folded = positions.clone();
    folded[0] = folded[1];
    assert!(!flat_faces(&mesh, &folded, 3.2).contains(&FaceId(0)), "a face without area has no direction");
}

#[test]
fn a_frozen_region_moves_is_cut_or_leaves_a_crack() {
    let (mesh, positions) = plate();
    let frozen = flat_faces(&mesh, &positions, 1e-6);
    assert!(!frozen.is_empty());
    let tags = Tags { frozen: frozen.clone(), ..Tags::default() };
    for levels in 0..=4 {
        let plan = Plan::build_with(&mesh, &tags, &PlanOptions::new(Scheme::Sqrt3, levels)).expect("small");
        // Formula 8 of Navarro Newball, Wyvill and McCane 2008: NF = (ONF - NNF) 3 + NNF.
        let active = mesh.n_faces() - frozen.len();
        assert_eq!(plan.n_faces(), active * 3_usize.pow(levels) + frozen.len());
        assert_eq!(plan.n_frozen_faces(), frozen.len());
        let fine = DedgeMesh::from_triangles(plan.n_vertices(), plan.indices().as_chunks().0).expect("no T-junction");
        assert_eq!(fine.euler_characteristic(), 1);
        assert_eq!(fine.boundary_loops().len(), 1);
        let (fine_positions, _) = evaluate_once(&plan, &positions);
        let tail = &plan.indices()[3 * (plan.n_faces() - frozen.len())..];
        for (face, corners) in frozen.iter().zip(tail.chunks_exact(3)) {
            for (vertex, &corner) in mesh.corners(*face).into_iter().zip(corners) {
                assert_eq!(fine_positions[corner as usize], positions[vertex.index()], "level {levels} {face}");
            }
        }
        // A plate that is flat there stays what it was: the bound on the angle bounds what freezing changes.
        let free = Plan::build(&mesh, Scheme::Sqrt3, levels).expect("small");
        let (free_positions, _) = evaluate_once(&free, &positions);
        let farthest = free_positions.iter().map(|p| p.z).fold(0.0, f32::max);
        let ours = fine_positions.iter().map(|p| p.z).fold(0.0, f32::max);
        assert!((farthest - ours).abs() < 1e-4, "level {levels}: {farthest} {ours}");
    }
}

#[test]
fn frozen_faces_with_creases_and_holes_break_the_mesh() {
    let shape = grid_with_hole();
    let mesh = shape.mesh().expect("a grid");
    let tags = Tags {
        frozen: vec![FaceId(0), FaceId(1), FaceId(9), FaceId(20)],
        creases: vec![(VertexId(14), VertexId(15), 10.0), (VertexId(15), VertexId(16), 1.5)],
        holes: vec![FaceId(40), FaceId(44)],
        ..Tags::default()
    };
    for levels in 0..=4 {
        let plan = Plan::build_with(&mesh, &tags, &PlanOptions::new(Scheme::Sqrt3, levels)).expect("small");
        DedgeMesh::from_triangles(plan.n_vertices(), plan.indices().as_chunks().0).expect("conforming");
        let mut evaluator = Evaluator::new(&plan);
        assert!(evaluator.evaluate(&plan, &shape.positions).positions.iter().all(|p| p.is_finite()));
    }
}
