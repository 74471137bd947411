//! The three-connected dual: what Guillot and Gourret 2006 promise of it, on every shape.

use glam::Vec3;
use londra::mesh::shapes::{Shape, cabinet, grid, icosahedron, pillow, tetrahedron, torus, triangle};
use londra::mesh::{DedgeMesh, FaceId, MeshError, PolygonMesh, VertexId};
use londra::subdiv::{DualError, Plan, PlanOptions, Rim, Scheme, Tags, ThreeConnected, evaluate_once};

fn mesh(shape: &Shape) -> DedgeMesh {
    shape.mesh().unwrap_or_else(|e| panic!("{}: {e}", shape.name))
}

fn plan(shape: &Shape, scheme: Scheme, levels: u32) -> Plan {
    Plan::build(&mesh(shape), scheme, levels).expect("a plan")
}

/// Whether some removed vertex has no face to replace it: valence 2, or a corner with a single triangle.
fn loses_faces(plan: &Plan, dual: &ThreeConnected) -> bool {
    dual.removed.len() != plan.n_vertices_at(plan.levels() - 1)
}

fn is_simple(mesh: &PolygonMesh) -> bool {
    mesh.vertices().all(|v| {
        let mut ring: Vec<_> = mesh.ring(v).collect();
        let n = ring.len();
        ring.sort_unstable();
        ring.dedup();
        ring.len() == n
    })
}

#[test]
fn an_inner_vertex_has_not_three_neighbours() {
    for scheme in [Scheme::Sqrt3, Scheme::Sqrt3Interpolating] {
        for shape in cabinet().iter().filter(|s| s.name != "pillow") {
            for (levels, rim) in (1..=4).flat_map(|l| [(l, Rim::Born), (l, Rim::Middles)]) {
                let plan = plan(shape, scheme, levels);
                let dual = match ThreeConnected::of(&plan, rim) {
                    Ok(dual) => dual,
                    // Too small for a face of born vertices alone.
                    Err(DualError::NoSurface(MeshError::NoFaces)) if rim == Rim::Born && levels == 1 => continue,
                    Err(error) => panic!("{} level {levels} {rim:?}: {error}", shape.name),
                };
                for v in dual.mesh.vertices().filter(|&v| !dual.mesh.is_boundary_vertex(v)) {
                    assert_eq!(dual.mesh.valence(v), 3, "{} level {levels} {rim:?}: {v}", shape.name);
                }
            }
        }
    }
}

#[test]
fn a_closed_surface_gains_or_loses_a_face_a_vertex_or_a_handle() {
    for shape in cabinet().iter().filter(|s| s.name != "pillow" && s.mesh().unwrap().n_boundary_edges() == 0) {
        for levels in 1..=4 {
            let plan = plan(shape, Scheme::Sqrt3, levels);
            let dual = ThreeConnected::of(&plan, Rim::Born).unwrap_or_else(|e| panic!("{} {levels}: {e}", shape.name));
            let n_old = plan.n_vertices_at(levels - 1);
            assert_eq!(dual.mesh.n_faces(), n_old, "{} {levels}", shape.name);
            assert_eq!(dual.removed, (0..n_old as u32).collect::<Vec<_>>());
            assert_eq!(dual.born, (n_old as u32..plan.n_vertices() as u32).collect::<Vec<_>>());
            assert_eq!(dual.mesh.n_boundary_edges(), 0);
            assert_eq!(dual.mesh.euler_characteristic(), mesh(shape).euler_characteristic(), "{}", shape.name);
        }
    }
}

#[test]
fn a_face_is_not_the_ring_of_its_removed_vertex() {
    let plan = plan(&icosahedron(), Scheme::Sqrt3, 3);
    let dual = ThreeConnected::of(&plan, Rim::Born).unwrap();
    let level = DedgeMesh::from_triangles(plan.n_vertices(), plan.indices().as_chunks().0).unwrap();
    for face in dual.mesh.faces() {
        let removed = VertexId(dual.removed[face.index()]);
        let ring: Vec<u32> = level.ring(removed).map(|v| v.0).collect();
        let corners: Vec<u32> = dual.mesh.corners(face).iter().map(|&c| dual.born[c as usize]).collect();
        assert_eq!(corners, ring, "{removed}");
    }
    // Twelve pentagons, the rest hexagons: a fullerene.
    let sizes: Vec<usize> = dual.mesh.faces().map(|f| dual.mesh.corners(f).len()).collect();
    assert_eq!(sizes.iter().filter(|&&n| n == 5).count(), 12);
    assert!(sizes.iter().all(|&n| n == 5 || n == 6));
}

#[test]
fn a_step_that_cuts_the_boundary_leaves_a_vertex_without_three_neighbours() {
    for shape in cabinet().iter().filter(|s| s.mesh().unwrap().n_boundary_edges() > 0) {
        let plan = plan(shape, Scheme::Sqrt3, 4);
        let dual = ThreeConnected::of(&plan, Rim::Born).unwrap_or_else(|e| panic!("{}: {e}", shape.name));
        assert_eq!(dual.mesh.euler_characteristic(), mesh(shape).euler_characteristic(), "{}", shape.name);
        assert_eq!(dual.mesh.boundary_loops().len(), mesh(shape).boundary_loops().len(), "{}", shape.name);
        if !loses_faces(&plan, &dual) {
            assert!(dual.mesh.vertices().all(|v| dual.mesh.valence(v) == 3), "{}", shape.name);
        }
        assert!(dual.middles.is_empty());
    }
}

#[test]
fn middles_of_kept_boundary_edges_do_not_make_the_dual_whole() {
    for shape in cabinet().iter().filter(|s| s.mesh().unwrap().n_boundary_edges() > 0) {
        for levels in [1, 3] {
            let plan = plan(shape, Scheme::Sqrt3, levels);
            let dual =
                ThreeConnected::of(&plan, Rim::Middles).unwrap_or_else(|e| panic!("{} {levels}: {e}", shape.name));
            assert!(!loses_faces(&plan, &dual), "{}", shape.name);
            assert!(dual.mesh.vertices().all(|v| dual.mesh.valence(v) == 3), "{} {levels}", shape.name);
            assert_eq!(dual.mesh.euler_characteristic(), mesh(shape).euler_characteristic(), "{}", shape.name);
            assert_eq!(dual.middles.len(), dual.mesh.n_boundary_edges());
        }
    }
}

#[test]
fn the_strict_dual_of_an_open_shape_has_a_vertex_that_was_not_born() {
    for levels in [1, 3] {
        let plan = plan(&grid(4, 3), Scheme::Sqrt3, levels);
        let dual = ThreeConnected::of(&plan, Rim::Born).unwrap();
        let n_old = plan.n_vertices_at(levels - 1) as u32;
        assert!(dual.middles.is_empty() && dual.born.iter().all(|&v| v >= n_old));
        assert_eq!(dual.born.len(), dual.mesh.n_vertices());
        assert!(is_simple(&dual.mesh));
        assert!(dual.mesh.vertices().all(|v| (2..=4).contains(&dual.mesh.valence(v))));
    }
}

#[test]
fn a_crease_tears_the_dual_or_changes_a_valence() {
    let shape = icosahedron();
    let tags = Tags {
        creases: vec![
            (VertexId(1), VertexId(2), 10.0),
            (VertexId(2), VertexId(3), 10.0),
            (VertexId(3), VertexId(4), 2.0),
            (VertexId(0), VertexId(2), 1.0),
        ],
        corners: vec![(VertexId(2), 10.0)],
        ..Tags::default()
    };
    for levels in 1..=4 {
        let plan = Plan::build_with(&mesh(&shape), &tags, &PlanOptions::new(Scheme::Sqrt3, levels)).unwrap();
        let dual = ThreeConnected::of(&plan, Rim::Born).unwrap();
        assert!(!loses_faces(&plan, &dual));
        assert_eq!(dual.mesh.euler_characteristic(), 2);
        for v in dual.mesh.vertices() {
            assert_eq!(dual.mesh.valence(v), 3, "level {levels}: {v}");
        }
    }
}

#[test]
fn a_hole_is_closed_by_the_dual() {
    let shape = torus(6, 5);
    let tags = Tags { holes: vec![FaceId(7), FaceId(30)], ..Tags::default() };
    for levels in 1..=4 {
        let plan = Plan::build_with(&mesh(&shape), &tags, &PlanOptions::new(Scheme::Sqrt3, levels)).unwrap();
        let dual = ThreeConnected::of(&plan, Rim::Middles).unwrap();
        assert_eq!(dual.mesh.boundary_loops().len(), 2, "level {levels}");
        assert_eq!(dual.mesh.euler_characteristic(), -2);
        assert!(dual.mesh.vertices().all(|v| dual.mesh.valence(v) == 3));
    }
}

#[test]
fn positions_of_the_dual_are_not_those_of_the_level() {
    let shape = grid(3, 3);
    let plan = plan(&shape, Scheme::Sqrt3, 3);
    let (positions, _) = evaluate_once(&plan, &shape.positions);
    let dual = ThreeConnected::of(&plan, Rim::Middles).unwrap();
    let values = dual.values(&positions);
    let (born, middles) = values.split_at(dual.born.len());
    for (value, &v) in born.iter().zip(&dual.born) {
        assert_eq!(*value, positions[v as usize]);
    }
    for (value, &[a, b]) in middles.iter().zip(&dual.middles) {
        assert_eq!(*value, 0.5 * positions[a as usize] + 0.5 * positions[b as usize]);
    }
    let mut by_table = vec![Vec3::ZERO; values.len()];
    dual.table().apply(&positions, &mut by_table);
    assert_eq!(by_table, values);
}

#[test]
fn a_dual_is_made_where_it_means_nothing() {
    for scheme in [Scheme::Loop, Scheme::Butterfly, Scheme::CatmullClark, Scheme::DooSabin] {
        let error = ThreeConnected::of(&plan(&tetrahedron(), scheme, 2), Rim::Born).unwrap_err();
        assert_eq!(error, DualError::Scheme { scheme });
        assert!(error.to_string().contains(scheme.name()));
    }
    assert_eq!(ThreeConnected::of(&plan(&tetrahedron(), Scheme::Sqrt3, 0), Rim::Born), Err(DualError::NoStep));
    let tags = Tags { frozen: vec![FaceId(0)], ..Tags::default() };
    let frozen = Plan::build_with(&mesh(&icosahedron()), &tags, &PlanOptions::new(Scheme::Sqrt3, 2)).unwrap();
    assert_eq!(ThreeConnected::of(&frozen, Rim::Born), Err(DualError::Frozen { n_frozen: 1 }));
    for (shape, levels) in [(triangle(), 1), (pillow(), 1)] {
        let error = ThreeConnected::of(&plan(&shape, Scheme::Sqrt3, levels), Rim::Born).unwrap_err();
        assert!(matches!(error, DualError::NoSurface(_)), "{}: {error}", shape.name);
    }
}
