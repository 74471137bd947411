//! The directed-edge mesh: what it must hold on every shape, and what it must refuse.

use std::collections::BTreeSet;

use londra::mesh::shapes::{
    Shape, cabinet, disk, fan, grid_with_hole, octahedron, pillow, tetrahedron, torus, triangle, tube,
};
use londra::mesh::{DedgeId, DedgeMesh, FaceId, InvariantError, MeshError, PolygonMesh, VertexId};
use londra::subdiv::{Normals, Plan, PlanError, PlanOptions, Positions, Scheme, TagError, Tags, levels_of};

fn mesh(shape: &Shape) -> DedgeMesh {
    shape.mesh().unwrap_or_else(|e| panic!("{}: {e}", shape.name))
}

#[test]
fn a_shape_of_the_cabinet_breaks_an_invariant() {
    for shape in cabinet() {
        let mesh = mesh(&shape);
        mesh.validate().unwrap_or_else(|e| panic!("{}: {e}", shape.name));
        assert_eq!(mesh.n_vertices(), shape.positions.len());
        assert_eq!(mesh.indices(), shape.triangles.as_flattened(), "{}: origins are not the index buffer", shape.name);
    }
}

#[test]
fn two_shapes_of_the_cabinet_share_a_name() {
    let shapes = cabinet();
    let names: BTreeSet<_> = shapes.iter().map(|s| &s.name).collect();
    assert_eq!(names.len(), shapes.len());
}

#[test]
fn moves_around_a_triangle_do_not_come_back() {
    for shape in cabinet() {
        let mesh = mesh(&shape);
        for d in mesh.dedges() {
            assert_eq!(mesh.next(mesh.next(mesh.next(d))), d);
            assert_eq!(mesh.prev(mesh.next(d)), d);
            assert_eq!(mesh.face(mesh.next(d)), mesh.face(d));
            assert_eq!(mesh.face(d).dedge(d.0 % 3), d);
            assert_eq!(mesh.target(d), mesh.origin(mesh.next(d)));
        }
    }
}

/// The dumb judge: every pair of directed edges is compared.
#[test]
fn twins_differ_from_a_search_over_all_pairs() {
    for shape in cabinet().iter().filter(|s| s.triangles.len() < 130) {
        let mesh = mesh(shape);
        for d in mesh.dedges() {
            let expected =
                mesh.dedges().find(|&t| mesh.origin(t) == mesh.target(d) && mesh.target(t) == mesh.origin(d));
            assert_eq!(mesh.twin(d), expected, "{} {d}", shape.name);
            assert_eq!(mesh.is_boundary_dedge(d), expected.is_none());
        }
    }
}

#[test]
fn a_ring_misses_a_neighbour_or_turns_the_wrong_way() {
    for shape in cabinet() {
        let mesh = mesh(&shape);
        for v in mesh.vertices() {
            let ring: Vec<_> = mesh.ring(v).collect();
            let expected: BTreeSet<_> = mesh
                .dedges()
                .filter_map(|d| match (mesh.origin(d), mesh.target(d)) {
                    (a, b) if a == v => Some(b),
                    (a, b) if b == v => Some(a),
                    _ => None,
                })
                .collect();
            assert_eq!(ring.iter().copied().collect::<BTreeSet<_>>(), expected, "{} {v}", shape.name);
            assert_eq!(ring.len(), expected.len(), "{} {v}: a neighbour twice", shape.name);
            assert_eq!(ring.len(), mesh.valence(v));
            let n_faces = mesh.faces_around(v).count();
            assert_eq!(ring.len(), n_faces + usize::from(mesh.is_boundary_vertex(v)), "{} {v}", shape.name);
            for (i, d) in mesh.outgoing_dedges(v).enumerate() {
                assert_eq!(mesh.origin(d), v);
                assert_eq!(mesh.target(d), ring[i]);
                assert_eq!(
                    mesh.target(mesh.next(d)),
                    ring[(i + 1) % ring.len()],
                    "{} {v}: not counter-clockwise",
                    shape.name
                );
            }
            if mesh.is_boundary_vertex(v) {
                assert!(mesh.twin(mesh.outgoing(v)).is_none(), "{} {v}: does not start at the boundary", shape.name);
            }
        }
    }
}

#[test]
fn euler_characteristic_is_not_that_of_the_surface() {
    let expected = |name: &str| match name {
        "grid(4,3)" | "triangle" => 1,
        "grid_with_hole" | "torus(6,5)" | "tube(7,2)" => 0,
        "two_components" => 3,
        open if open.starts_with("fan") || open.starts_with("disk") => 1,
        _ => 2,
    };
    for shape in cabinet() {
        assert_eq!(mesh(&shape).euler_characteristic(), expected(&shape.name), "{}", shape.name);
    }
}

#[test]
fn a_boundary_is_lost_or_runs_the_wrong_way() {
    let loops = |shape: &Shape| {
        let all = mesh(shape).boundary_loops();
        all.into_iter().map(|l| l.into_iter().map(|v| v.0).collect::<Vec<_>>()).collect::<Vec<_>>()
    };
    assert!(loops(&torus(6, 5)).is_empty());
    assert_eq!(loops(&triangle()), [[0, 1, 2]]);
    assert_eq!(loops(&disk(4)), [[1, 2, 3, 4]], "the surface is not on the left");
    assert_eq!(loops(&fan(3)), [[0, 1, 2, 3, 4]]);
    let holed = loops(&grid_with_hole());
    assert_eq!(holed.iter().map(Vec::len).collect::<Vec<_>>(), [20, 4]);
    assert_eq!(loops(&tube(7, 2)).iter().map(Vec::len).collect::<Vec<_>>(), [7, 7]);
    for shape in cabinet() {
        let mesh = mesh(&shape);
        let on_loops: usize = mesh.boundary_loops().iter().map(Vec::len).sum();
        assert_eq!(on_loops, mesh.n_boundary_edges(), "{}", shape.name);
    }
}

#[test]
fn malformed_input_is_accepted_or_blamed_on_the_wrong_element() {
    use MeshError as E;
    let (f, v) = (FaceId, VertexId);
    let cases: Vec<(&str, usize, Vec<[u32; 3]>, MeshError)> = vec![
        ("nothing", 3, vec![], E::NoFaces),
        ("no vertices either", 0, vec![], E::NoFaces),
        ("too many", usize::MAX, vec![[0, 1, 2]], E::TooMany { n_vertices: usize::MAX, n_faces: 1 }),
        (
            "an index one too large",
            4,
            vec![[0, 1, 2], [0, 2, 4]],
            E::IndexOutOfRange { face: f(1), index: 4, n_vertices: 4 },
        ),
        (
            "the index that means none",
            3,
            vec![[0, u32::MAX, 2]],
            E::IndexOutOfRange { face: f(0), index: u32::MAX, n_vertices: 3 },
        ),
        ("a corner twice (ab)", 3, vec![[0, 1, 2], [1, 1, 2]], E::DegenerateTriangle { face: f(1), vertex: v(1) }),
        ("a corner twice (bc)", 3, vec![[0, 2, 2]], E::DegenerateTriangle { face: f(0), vertex: v(2) }),
        ("a corner twice (ca)", 3, vec![[2, 1, 2]], E::DegenerateTriangle { face: f(0), vertex: v(2) }),
        (
            "neighbours that face opposite ways",
            4,
            vec![[0, 1, 2], [0, 1, 3]],
            E::DuplicateDedge { first: f(0), second: f(1), from: v(0), to: v(1) },
        ),
        (
            "an edge with three triangles",
            5,
            vec![[0, 1, 2], [1, 0, 3], [1, 0, 4]],
            E::DuplicateDedge { first: f(1), second: f(2), from: v(1), to: v(0) },
        ),
        (
            "a triangle twice",
            3,
            vec![[0, 1, 2], [1, 2, 0]],
            E::DuplicateDedge { first: f(0), second: f(1), from: v(0), to: v(1) },
        ),
        (
            "a Möbius strip",
            5,
            vec![[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 0], [4, 0, 1]],
            E::DuplicateDedge { first: f(0), second: f(4), from: v(0), to: v(1) },
        ),
        ("a bow tie", 5, vec![[0, 1, 2], [0, 3, 4]], E::NonManifoldVertex { vertex: v(0), reached: 1, faces: 2 }),
        (
            "two closed surfaces that touch",
            7,
            vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2], [0, 4, 5], [0, 6, 4], [0, 5, 6], [4, 6, 5]],
            E::NonManifoldVertex { vertex: v(0), reached: 3, faces: 6 },
        ),
        (
            "a closed and an open surface that touch",
            6,
            vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2], [3, 4, 5]],
            E::NonManifoldVertex { vertex: v(3), reached: 1, faces: 4 },
        ),
        ("a vertex without a triangle", 4, vec![[0, 1, 3]], E::IsolatedVertex { vertex: v(2) }),
    ];
    for (name, n_vertices, triangles, expected) in cases {
        let found = DedgeMesh::from_triangles(n_vertices, &triangles);
        assert_eq!(found.as_ref().err(), Some(&expected), "{name}");
        assert!(expected.to_string().len() > 20, "{name}: the message says too little");
    }
}

#[test]
fn a_malformed_tag_is_accepted_or_blamed_on_the_wrong_element() {
    let mesh = mesh(&tetrahedron());
    let (f, v) = (FaceId, VertexId);
    let crease =
        |from: u32, to: u32, sharpness: f32| Tags { creases: vec![(v(from), v(to), sharpness)], ..Tags::default() };
    let corner = |vertex: u32, sharpness: f32| Tags { corners: vec![(v(vertex), sharpness)], ..Tags::default() };
    let frozen = |face: u32| Tags { frozen: vec![f(face)], ..Tags::default() };
    let holes = |faces: &[u32]| Tags { holes: faces.iter().map(|&face| f(face)).collect(), ..Tags::default() };
    let sqrt3 = PlanOptions::new(Scheme::Sqrt3, 1);
    let no_vertex = |vertex: u32| TagError::NoSuchVertex { vertex: v(vertex), n_vertices: 4 };
    let cases: Vec<(Tags, TagError)> = vec![
        (crease(0, 4, 1.0), no_vertex(4)),
        (crease(u32::MAX, 0, 1.0), no_vertex(u32::MAX)),
        (crease(2, 2, 1.0), TagError::NoSuchEdge { from: v(2), to: v(2) }),
        (crease(0, 1, -0.5), TagError::Sharpness { sharpness: -0.5 }),
        (crease(0, 1, f32::NEG_INFINITY), TagError::Sharpness { sharpness: f32::NEG_INFINITY }),
        (corner(4, 1.0), no_vertex(4)),
        (corner(0, -1.0), TagError::Sharpness { sharpness: -1.0 }),
        (frozen(4), TagError::NoSuchFace { face: f(4), n_faces: 4 }),
        (holes(&[1, 7]), TagError::NoSuchFace { face: f(7), n_faces: 4 }),
        (holes(&[0, 1, 2, 3]), TagError::Holes(MeshError::NoFaces)),
    ];
    for (tags, expected) in cases {
        let found = Plan::build_with(&mesh, &tags, &sqrt3).err();
        assert_eq!(found, Some(PlanError::Tags(expected.clone())), "{tags:?}");
        assert_eq!(levels_of(&mesh, &tags, &sqrt3).err(), found, "{tags:?}");
        assert!(expected.to_string().len() > 30, "{expected}: the message says too little");
        // The same tags on the same faces as polygons.
        if tags.frozen.is_empty() {
            let options = PlanOptions::new(Scheme::CatmullClark, 1);
            let found = Plan::build_polygons(&PolygonMesh::from(&mesh), &tags, &options).err();
            assert_eq!(found, Some(PlanError::Tags(expected)), "{tags:?}");
        }
    }
    assert!(matches!(
        Plan::build_with(&mesh, &crease(0, 1, f32::NAN), &sqrt3),
        Err(PlanError::Tags(TagError::Sharpness { sharpness })) if sharpness.is_nan()
    ));
    // Two holes that leave a bow tie, faces 0 and 2 of a disk of four: the vertex becomes two.
    let split = Plan::build_with(&self::mesh(&disk(4)), &holes(&[0, 2]), &sqrt3).expect("two triangles");
    assert_eq!((split.n_vertices_at(0), split.boundary_loops().len(), split.n_control()), (6, 2, 5));
    // An edge that is not there: across the square of an octahedron.
    let found = Plan::build_with(&self::mesh(&octahedron()), &crease(0, 1, 1.0), &sqrt3).err();
    assert_eq!(found, Some(PlanError::Tags(TagError::NoSuchEdge { from: v(0), to: v(1) })));
}

#[test]
fn an_option_that_a_scheme_has_no_rule_for_is_accepted() {
    let mesh = mesh(&tetrahedron());
    let crease = Tags { creases: vec![(VertexId(0), VertexId(1), 1.0)], ..Tags::default() };
    let corner = Tags { corners: vec![(VertexId(0), 1.0)], ..Tags::default() };
    let frozen = Tags { frozen: vec![FaceId(0)], ..Tags::default() };
    for scheme in Scheme::ALL {
        let options = PlanOptions::new(scheme, 1);
        let error = |tags: &Tags, options: &PlanOptions| Plan::build_with(&mesh, tags, options).err();
        let expected = (!scheme.has_creases()).then_some(PlanError::NoCreases { scheme });
        assert_eq!(error(&crease, &options), expected, "{}", scheme.name());
        assert_eq!(error(&corner, &options), expected, "{}", scheme.name());
        let expected = (scheme != Scheme::Sqrt3).then_some(PlanError::NoFrozenFaces { scheme });
        assert_eq!(error(&frozen, &options), expected, "{}", scheme.name());
        let expected = (!scheme.has_limits()).then_some(PlanError::NoLimits { scheme });
        let limit_normals = PlanOptions { normals: Normals::Limit, ..options };
        assert_eq!(error(&Tags::default(), &limit_normals), expected, "{}", scheme.name());
        // Control points of an interpolating scheme are limit points.
        let limits = PlanOptions { positions: Positions::Limit, ..options };
        let expected = expected.filter(|_| !scheme.is_interpolating());
        assert_eq!(error(&Tags::default(), &limits), expected, "{}", scheme.name());
        let expected = (!scheme.is_triangular()).then_some(PlanError::NotPolygons { scheme });
        assert_eq!(levels_of(&mesh, &Tags::default(), &options).err(), expected, "{}", scheme.name());
    }
}

type Parts = (Vec<u32>, Vec<Option<u32>>, Vec<u32>);

fn parts(shape: &Shape) -> Parts {
    let mesh = mesh(shape);
    let twin = mesh.dedges().map(|d| mesh.twin(d).map(|t| t.0)).collect();
    (mesh.indices().to_vec(), twin, mesh.vertices().map(|v| mesh.outgoing(v).0).collect())
}

#[test]
fn sound_parts_are_refused() {
    for shape in cabinet() {
        let (origin, twin, outgoing) = parts(&shape);
        assert_eq!(DedgeMesh::from_parts(origin, twin, outgoing).as_ref(), Ok(&mesh(&shape)), "{}", shape.name);
    }
}

#[test]
fn validate_overlooks_a_corrupted_structure() {
    use InvariantError as E;
    let (d, f, v) = (DedgeId, FaceId, VertexId);
    type Corrupt = fn(&mut Parts);
    let cases: Vec<(Shape, Corrupt, InvariantError)> = vec![
        (triangle(), |(o, t, _)| (*o, *t) = (vec![], vec![]), E::Lengths { origins: 0, twins: 0 }),
        (triangle(), |(o, _, _)| o.push(0), E::Lengths { origins: 4, twins: 3 }),
        (triangle(), |(_, t, _)| t.truncate(2), E::Lengths { origins: 3, twins: 2 }),
        (triangle(), |(o, _, _)| o[1] = 3, E::OriginOutOfRange { dedge: d(1), vertex: v(3) }),
        (triangle(), |(o, _, _)| o[2] = 0, E::DegenerateFace { face: f(0) }),
        (tetrahedron(), |(_, t, _)| t[0] = Some(12), E::TwinOutOfRange { dedge: d(0), twin: d(12) }),
        (tetrahedron(), |(_, t, _)| t[0] = Some(0), E::TwinNotMutual { dedge: d(0), twin: d(0) }),
        (tetrahedron(), |(_, t, _)| t[0] = None, E::TwinNotMutual { dedge: d(5), twin: d(0) }),
        (
            pillow(),
            |(_, t, _)| {
                t.swap(0, 1);
                t.swap(5, 4);
            },
            E::TwinEnds { dedge: d(0), twin: d(4) },
        ),
        (tetrahedron(), |(_, _, g)| g[2] = 99, E::OutgoingOutOfRange { vertex: v(2), dedge: d(99) }),
        (tetrahedron(), |(_, _, g)| g[2] = g[1], E::OutgoingElsewhere { vertex: v(2), dedge: d(1) }),
        (disk(4), |(_, _, g)| g[2] = 2, E::OutgoingNotBoundary { vertex: v(2), boundary: d(4) }),
        (
            tetrahedron(),
            |(o, t, _)| {
                // Two tetrahedra, the second without vertices of its own.
                o.extend_from_within(..);
                t.extend_from_within(..);
                t[12..].iter_mut().for_each(|t| *t = t.map(|t| t + 12));
            },
            E::BrokenRing { vertex: v(0), walked: 3, faces: 6 },
        ),
        (pillow(), |(_, t, g)| (t[0], t[5], g[1]) = (None, None, 5), E::Unjoined { dedge: d(0), other: d(5) }),
    ];
    for (shape, corrupt, expected) in cases {
        let mut broken = parts(&shape);
        corrupt(&mut broken);
        let (origin, twin, outgoing) = broken;
        assert_eq!(DedgeMesh::from_parts(origin, twin, outgoing).err(), Some(expected), "{}", shape.name);
    }
}

#[test]
fn building_takes_more_than_linear_time_at_a_vertex_of_huge_valence() {
    // With a search per directed edge this would take some 10¹¹ steps.
    let shape = londra::mesh::shapes::pole(300_000);
    let mesh = mesh(&shape);
    assert_eq!(mesh.valence(VertexId(0)), 300_000);
    assert_eq!(mesh.euler_characteristic(), 2);
}
