//! Values at the corners of faces: both sides of a seam, the same faces, nothing torn.

use glam::{Vec2, Vec3};
use londra::mesh::shapes::{Shape, cabinet, grid, icosahedron, octahedron, torus};
use londra::mesh::{DedgeMesh, FaceId, PolygonMesh, VertexId};
use londra::subdiv::{
    BoundaryRule, FaceVaryingError, FaceVaryingPlan, Plan, PlanError, PlanOptions, Scheme, Tags, UvLinear,
    evaluate_once,
};

const KEEPING: [Scheme; 3] = [Scheme::Loop, Scheme::Butterfly, Scheme::CatmullClark];
const LINEAR: [UvLinear; 4] = [UvLinear::None, UvLinear::CornersOnly, UvLinear::Boundaries, UvLinear::All];

/// A control mesh with values, and what to do with it.
struct Case {
    mesh: PolygonMesh,
    tags: Tags,
    /// One for each corner.
    values: Vec<u32>,
    n_values: usize,
}

impl Case {
    /// Faces by island, each vertex with a value for each island; number `island * n_vertices + vertex`.
    fn islands(mesh: PolygonMesh, tags: Tags, island: impl Fn(FaceId) -> u32) -> Case {
        let n = mesh.n_vertices() as u32;
        let corners = mesh.faces().flat_map(|f| mesh.corners(f).iter().map(move |v| (f, *v)).collect::<Vec<_>>());
        let values: Vec<u32> = corners.map(|(face, vertex)| island(face) * n + vertex).collect();
        let n_values = values.iter().max().unwrap() + 1;
        Case { mesh, tags, values, n_values: n_values.next_multiple_of(n) as usize }
    }

    fn build(&self, options: PlanOptions, linear: UvLinear) -> Result<(Plan, FaceVaryingPlan), FaceVaryingError> {
        let surface = if options.scheme.is_triangular() {
            let triangles =
                DedgeMesh::from_triangles(self.mesh.n_vertices(), corners(&self.mesh).as_chunks().0).unwrap();
            Plan::build_with(&triangles, &self.tags, &options)?
        } else {
            Plan::build_polygons(&self.mesh, &self.tags, &options)?
        };
        let uvs =
            FaceVaryingPlan::build_polygons(&surface, &self.mesh, &self.tags, &self.values, self.n_values, linear)?;
        check_faces(&surface, &uvs);
        Ok((surface, uvs))
    }
}

fn corners(mesh: &PolygonMesh) -> Vec<u32> {
    mesh.faces().flat_map(|f| mesh.corners(f).to_vec()).collect()
}

fn polygons(shape: &Shape) -> PolygonMesh {
    (&shape.mesh().unwrap()).into()
}

fn check_faces(surface: &Plan, uvs: &FaceVaryingPlan) {
    assert_eq!(uvs.plan().n_faces(), surface.n_faces());
    assert_eq!(uvs.plan().faces().0, surface.faces().0);
    let mapped: Vec<u32> = uvs.plan().indices().iter().map(|&v| uvs.render_vertices()[v as usize]).collect();
    assert_eq!(mapped, surface.indices(), "a corner of the cut mesh is not that of the surface");
    let mut used = vec![false; surface.n_vertices()];
    uvs.render_vertices().iter().for_each(|&v| used[v as usize] = true);
    assert!(used.into_iter().all(|u| u), "a vertex of the surface is drawn nowhere");
}

type Quads = Vec<[u32; 4]>;

/// A cube from -1 to 1, its faces, and its cross: front, right, back, left in a row, top and bottom above and below the
/// front.
fn cube() -> (Vec<Vec3>, Quads, Quads, Vec<Vec2>) {
    let positions = (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) * 2.0 - 1.0);
    let faces = vec![[4, 5, 7, 6], [5, 1, 3, 7], [1, 0, 2, 3], [0, 4, 6, 2], [6, 7, 3, 2], [0, 1, 5, 4]];
    // Rows of the cross at v = 0 and 1, then the top's and the bottom's far sides.
    let mut uvs: Vec<Vec2> = (0..2).flat_map(|v| (0..5).map(move |u| Vec2::new(u as f32, v as f32))).collect();
    uvs.extend([Vec2::new(1.0, 2.0), Vec2::new(0.0, 2.0), Vec2::new(0.0, -1.0), Vec2::new(1.0, -1.0)]);
    let side = |i: u32| [i, i + 1, i + 6, i + 5];
    let layout = vec![side(0), side(1), side(2), side(3), [5, 6, 10, 11], [12, 13, 1, 0]];
    (positions.collect(), faces, layout, uvs)
}

fn cube_case(scheme: Scheme) -> (Vec<Vec3>, Vec<Vec2>, Case) {
    let (positions, faces, layout, uvs) = cube();
    let split =
        |quads: &[[u32; 4]]| -> Vec<u32> { quads.iter().flat_map(|q| [q[0], q[1], q[2], q[0], q[2], q[3]]).collect() };
    let (sizes, corners, values) = if scheme.is_triangular() {
        (vec![3; 12], split(&faces), split(&layout))
    } else {
        (vec![4; 6], faces.concat(), layout.concat())
    };
    let mesh = PolygonMesh::from_faces(8, &sizes, &corners).unwrap();
    (positions, uvs.clone(), Case { mesh, tags: Tags::default(), values, n_values: uvs.len() })
}

#[test]
fn a_cube_cut_open_is_no_disk_any_more_or_drawn_with_too_many_vertices() {
    for scheme in KEEPING {
        let (_, uvs, case) = cube_case(scheme);
        for linear in LINEAR {
            for levels in 0..=3 {
                let (surface, plan) = case.build(PlanOptions::new(scheme, levels), linear).unwrap();
                assert_eq!(plan.plan().n_control(), uvs.len());
                assert_eq!(plan.plan().boundary_loops().len(), 1);
                // Fourteen sides of the cross; its seven seams have that many vertices less, and one.
                let n_rim = 14 << levels;
                assert_eq!(plan.plan().boundary_loops()[0].len(), n_rim);
                assert_eq!(
                    plan.plan().n_vertices(),
                    surface.n_vertices() + n_rim / 2 - 1,
                    "{} {levels}",
                    scheme.name()
                );
                let refined = plan.evaluate_uvs(&uvs);
                assert_eq!(refined.len(), plan.render_vertices().len());
                let inside = |uv: &Vec2| (-1e-6..=4.0 + 1e-6).contains(&uv.x) && (-1.0..=2.0 + 1e-6).contains(&uv.y);
                // The butterfly may overshoot.
                assert!(scheme == Scheme::Butterfly || refined.iter().all(inside));
                if matches!(linear, UvLinear::Boundaries | UvLinear::All) {
                    let on_grid = |x: f32| (x * (1 << levels) as f32).fract().abs() < 1e-4;
                    let rim = &plan.plan().boundary_loops()[0];
                    assert!(rim.iter().all(|&v| on_grid(refined[v as usize].x) && on_grid(refined[v as usize].y)));
                }
            }
        }
    }
}

#[test]
fn a_constant_does_not_stay_one() {
    let shape = icosahedron();
    for scheme in KEEPING {
        let case = Case::islands(polygons(&shape), Tags::default(), |f| f.0 % 3);
        for linear in LINEAR {
            let (_, plan) = case.build(PlanOptions::new(scheme, 3), linear).unwrap();
            let refined = plan.evaluate_uvs(&vec![Vec2::new(0.25, -3.0); case.n_values]);
            let off = refined.iter().map(|uv| uv.distance(Vec2::new(0.25, -3.0))).fold(0.0, f32::max);
            assert!(off < 2e-6, "{} {linear:?}: {off}", scheme.name());
        }
    }
}

#[test]
fn without_a_seam_the_values_do_not_follow_the_surface() {
    for shape in cabinet() {
        for scheme in KEEPING.into_iter().chain([Scheme::Sqrt3, Scheme::Sqrt3Interpolating]) {
            let case = Case::islands(polygons(&shape), Tags::default(), |_| 0);
            let (surface, plan) = case.build(PlanOptions::new(scheme, 2), UvLinear::None).unwrap();
            assert_eq!(plan.plan().n_vertices(), surface.n_vertices());
            let flat = |p: Vec3| Vec2::new(2.0 * p.x - p.z, 1.0 + p.y + 0.5 * p.x);
            let uvs: Vec<Vec2> = shape.positions.iter().map(|&p| flat(p)).collect();
            let (positions, _) = evaluate_once(&surface, &shape.positions);
            for (uv, &vertex) in plan.evaluate_uvs(&uvs).iter().zip(plan.render_vertices()) {
                let expected = flat(positions[vertex as usize]);
                assert!(uv.distance(expected) < 1e-5, "{} {}: {uv} for {expected}", shape.name, scheme.name());
            }
        }
    }
}

#[test]
fn a_seam_bends_what_is_linear_on_a_flat_grid() {
    let quads = |n: u32| -> (PolygonMesh, Vec<Vec3>) {
        let faces = (0..n * n).flat_map(|i| {
            let v = i / n * (n + 1) + i % n;
            [v, v + 1, v + n + 2, v + n + 1]
        });
        let faces: Vec<u32> = faces.collect();
        let points = (0..(n + 1) * (n + 1)).map(|i| Vec3::new((i % (n + 1)) as f32, (i / (n + 1)) as f32, 0.0));
        (PolygonMesh::from_faces(points.len(), &vec![4; (n * n) as usize], &faces).unwrap(), points.collect())
    };
    let triangles = || {
        let shape = grid(4, 4);
        (polygons(&shape), shape.positions.iter().map(|p| p.with_z(0.0)).collect::<Vec<_>>())
    };
    for scheme in KEEPING {
        let (mesh, points) = if scheme.is_triangular() { triangles() } else { quads(4) };
        let per_square = if scheme.is_triangular() { 2 } else { 1 };
        let corners = [0, 4, 20, 24].map(|v| (VertexId(v), 10.0)).to_vec();
        let case = Case::islands(mesh, Tags { corners, ..Tags::default() }, |f| u32::from(f.0 / per_square % 4 >= 2));
        let uvs: Vec<Vec2> = [0.0, 10.0].iter().flat_map(|x| points.iter().map(move |p| p.truncate() + *x)).collect();
        for linear in [UvLinear::Boundaries, UvLinear::All] {
            let (surface, plan) = case.build(PlanOptions::new(scheme, 3), linear).unwrap();
            let (positions, _) = evaluate_once(&surface, &points);
            for (uv, &vertex) in plan.evaluate_uvs(&uvs).iter().zip(plan.render_vertices()) {
                let expected = positions[vertex as usize].truncate();
                let off = uv.distance(expected).min((uv - 10.0).distance(expected));
                assert!(off < 3e-5, "{} {linear:?}: {uv} at {expected}", scheme.name());
            }
        }
    }
}

#[test]
fn a_seam_is_another_curve_on_its_other_side() {
    // Two closed seams around a torus, each side with the same control values.
    let shape = torus(6, 5);
    for scheme in KEEPING {
        let case = Case::islands(polygons(&shape), Tags::default(), |f| u32::from(f.0 >= 24));
        for linear in [UvLinear::None, UvLinear::CornersOnly, UvLinear::Boundaries, UvLinear::All] {
            let (surface, plan) = case.build(PlanOptions::new(scheme, 3), linear).unwrap();
            assert!(plan.plan().n_vertices() > surface.n_vertices());
            let values: Vec<Vec3> = shape.positions.iter().chain(&shape.positions).copied().collect();
            let mut evaluator = londra::subdiv::Evaluator::new(plan.plan());
            let refined = plan.evaluate(&mut evaluator, &values);
            let mut sides: Vec<Vec<Vec3>> = vec![Vec::new(); surface.n_vertices()];
            for (&value, &vertex) in refined.iter().zip(plan.render_vertices()) {
                sides[vertex as usize].push(value);
            }
            assert_eq!(sides.iter().filter(|s| s.len() == 2).count(), 2 * 6 * 8);
            for side in sides.iter().filter(|s| s.len() == 2) {
                assert!(side[0].distance(side[1]) < 1e-5, "{} {linear:?}: {} and {}", scheme.name(), side[0], side[1]);
            }
            // And it has no gaps along itself.
            for rim in plan.plan().boundary_loops() {
                let points = rim.iter().chain(&rim[..1]).map(|&v| refined[v as usize]).collect::<Vec<_>>();
                let longest = points.windows(2).map(|p| p[0].distance(p[1])).fold(0.0, f32::max);
                assert!(longest < 3.2 / 8.0 * 1.3, "{} {linear:?}: {longest}", scheme.name());
            }
        }
    }
}

#[test]
fn a_seam_that_ends_inside_tears_its_end() {
    // One face has a value of its own at one corner: both of its sides there are seams, which end at the next vertices.
    let shape = octahedron();
    for scheme in KEEPING {
        let mut case = Case::islands(polygons(&shape), Tags::default(), |_| 0);
        let corner = corners(&case.mesh).iter().position(|&v| v == 2).unwrap();
        case.values[corner] = 6;
        case.n_values = 7;
        let (surface, plan) = case.build(PlanOptions::new(scheme, 2), UvLinear::None).unwrap();
        assert_eq!(plan.plan().n_control(), 7);
        assert_eq!(plan.plan().boundary_loops().len(), 1);
        assert_eq!(plan.plan().n_vertices(), surface.n_vertices() + 7);
    }
}

#[test]
fn a_vertex_with_one_value_on_two_sides_is_torn_apart() {
    // A seam over the pole: it has one value, its neighbours along the seam have two.
    let shape = octahedron();
    let mesh = polygons(&shape);
    let pole = corners(&mesh);
    let in_front = |f: FaceId| shape.triangles[f.index()].iter().all(|&v| v != 2);
    for scheme in KEEPING {
        let mut case = Case::islands(polygons(&shape), Tags::default(), |f| u32::from(in_front(f)));
        for (value, &vertex) in case.values.iter_mut().zip(&pole) {
            *value = if vertex == 0 { 0 } else { *value };
        }
        let (surface, plan) = case.build(PlanOptions::new(scheme, 3), UvLinear::None).unwrap();
        let uvs: Vec<Vec2> = (0..case.n_values).map(|i| Vec2::new(i as f32, (i * i % 7) as f32)).collect();
        let refined = plan.evaluate_uvs(&uvs);
        let copies: Vec<Vec2> =
            (0..refined.len()).filter(|&i| plan.render_vertices()[i] == 0).map(|i| refined[i]).collect();
        assert_eq!(copies, [uvs[0], uvs[0]], "{}", scheme.name());
        assert!(surface.n_vertices() < refined.len());
    }
}

#[test]
fn holes_and_creases_put_the_faces_out_of_step() {
    let shape = torus(6, 5);
    let creases =
        vec![(VertexId(0), VertexId(1), 10.0), (VertexId(1), VertexId(2), 1.5), (VertexId(6), VertexId(12), 2.0)];
    let tags =
        Tags { creases, corners: vec![(VertexId(9), 10.0)], holes: vec![FaceId(3), FaceId(30)], ..Tags::default() };
    for scheme in KEEPING {
        for boundary in [BoundaryRule::EdgeOnly, BoundaryRule::EdgeAndCorner] {
            for linear in LINEAR {
                for levels in 0..3 {
                    let case = Case::islands(polygons(&shape), tags.clone(), |f| f.0 / 7);
                    let options = PlanOptions { boundary, ..PlanOptions::new(scheme, levels) };
                    let (_, plan) = case.build(options, linear).unwrap();
                    let refined = plan.evaluate_uvs(&vec![Vec2::ONE; case.n_values]);
                    assert!(refined.iter().all(|uv| uv.distance(Vec2::ONE) < 1e-5));
                    // Without a seam the masks are those of the surface.
                    if linear == UvLinear::None && boundary == BoundaryRule::EdgeOnly {
                        let whole = Case::islands(polygons(&shape), tags.clone(), |_| 0);
                        let (surface, plan) = whole.build(options, linear).unwrap();
                        let mut evaluator = londra::subdiv::Evaluator::new(plan.plan());
                        let refined = plan.evaluate(&mut evaluator, &shape.positions);
                        assert_eq!(refined, evaluate_once(&surface, &shape.positions).0);
                    }
                }
            }
        }
    }
}

#[test]
fn linear_everywhere_is_not_linear() {
    let shape = icosahedron();
    for scheme in KEEPING {
        let case = Case::islands(polygons(&shape), Tags::default(), |f| f.0 % 2);
        let (surface, plan) = case.build(PlanOptions::new(scheme, 2), UvLinear::All).unwrap();
        let uvs: Vec<Vec2> = (0..case.n_values).map(|i| Vec2::new((i * 7 % 11) as f32, (i * 5 % 13) as f32)).collect();
        let refined = plan.evaluate_uvs(&uvs);
        // Each control face's values stay within its own, and its corners keep them.
        for (f, &parent) in surface.face_parent().iter().enumerate() {
            let sizes = surface.faces().0[0] as usize;
            let own = &case.values[3 * parent as usize..3 * parent as usize + 3];
            let (mut low, mut high) = (Vec2::MAX, Vec2::MIN);
            for &v in own {
                (low, high) = (low.min(uvs[v as usize]), high.max(uvs[v as usize]));
            }
            for &corner in &plan.plan().faces().1[f * sizes..(f + 1) * sizes] {
                let uv = refined[corner as usize];
                assert!(uv.cmpge(low - 1e-4).all() && uv.cmple(high + 1e-4).all(), "{}: {uv}", scheme.name());
            }
        }
    }
}

#[test]
fn a_seam_over_turned_edges_is_taken() {
    let shape = torus(6, 5);
    let island = |f: FaceId| u32::from(f.0 >= 24);
    let case = |sharpness: Option<f32>| {
        let seam = (0..2).flat_map(|ring| (0..6).map(move |j| (12 * ring + j, 12 * ring + (j + 1) % 6)));
        let creases = sharpness.map_or(Vec::new(), |s| seam.map(|(a, b)| (VertexId(a), VertexId(b), s)).collect());
        Case::islands(polygons(&shape), Tags { creases, ..Tags::default() }, island)
    };
    let mut seam_case = case(None);
    // Rows of twelve faces: 24 on the first two rows, the seams along rings 0 and 2.
    for (scheme, levels) in [(Scheme::Sqrt3, 1), (Scheme::Sqrt3Interpolating, 2)] {
        let error = seam_case.build(PlanOptions::new(scheme, levels), UvLinear::None).unwrap_err();
        assert!(matches!(error, FaceVaryingError::SeamIsTurned { .. }), "{error}");
    }
    assert!(seam_case.build(PlanOptions::new(Scheme::Sqrt3, 0), UvLinear::None).is_ok());
    for (sharpness, levels, is_taken) in
        [(10.0, 6, true), (1.0, 2, true), (1.0, 3, false), (2.0, 4, true), (2.0, 5, false), (0.0, 1, false)]
    {
        let result = case(Some(sharpness)).build(PlanOptions::new(Scheme::Sqrt3, levels), UvLinear::Boundaries);
        assert_eq!(result.is_ok(), is_taken, "sharpness {sharpness}, {levels} levels");
    }
    for linear in [UvLinear::None, UvLinear::CornersOnly, UvLinear::Boundaries] {
        for levels in 1..=5 {
            let case = case(Some(10.0));
            let (surface, plan) = case.build(PlanOptions::new(Scheme::Sqrt3, levels), linear).unwrap();
            let values: Vec<Vec3> = shape.positions.iter().chain(&shape.positions).copied().collect();
            let refined = plan.evaluate(&mut londra::subdiv::Evaluator::new(plan.plan()), &values);
            if linear == UvLinear::None {
                let (positions, _) = evaluate_once(&surface, &shape.positions);
                for (value, &vertex) in refined.iter().zip(plan.render_vertices()) {
                    assert!(value.distance(positions[vertex as usize]) < 1e-5, "a seam on a crease is another curve");
                }
            }
        }
    }
    seam_case.tags.frozen = vec![FaceId(0)];
    let error = seam_case.build(PlanOptions::new(Scheme::Sqrt3, 2), UvLinear::None).unwrap_err();
    assert!(matches!(error, FaceVaryingError::SeamOnFrozenRim { .. } | FaceVaryingError::SeamIsTurned { .. }));
}

#[test]
fn a_frozen_region_puts_the_faces_out_of_step() {
    let shape = torus(6, 5);
    // The seam runs around the frozen faces' own middle: between 0 and 1, both frozen.
    let frozen = vec![FaceId(0), FaceId(1)];
    let mut case = Case::islands(polygons(&shape), Tags { frozen, ..Tags::default() }, |_| 0);
    for levels in 1..=4 {
        assert!(case.build(PlanOptions::new(Scheme::Sqrt3, levels), UvLinear::CornersOnly).is_ok());
    }
    case.values[1] = 30;
    case.n_values = 31;
    let error = case.build(PlanOptions::new(Scheme::Sqrt3, 2), UvLinear::None).unwrap_err();
    assert!(matches!(error, FaceVaryingError::SeamOnFrozenRim { .. }), "{error}");
}

#[test]
fn values_that_do_not_fit_are_taken() {
    let (_, _, mut case) = cube_case(Scheme::Loop);
    let options = PlanOptions::new(Scheme::Loop, 1);
    let (surface, _) = case.build(options, UvLinear::None).unwrap();
    let other = Case::islands(polygons(&octahedron()), Tags::default(), |_| 0);
    let build = |case: &Case, surface: &Plan| {
        FaceVaryingPlan::build_polygons(surface, &case.mesh, &case.tags, &case.values, case.n_values, UvLinear::None)
            .err()
    };
    assert_eq!(build(&other, &surface), Some(FaceVaryingError::OtherPlan));
    case.n_values = 13;
    assert!(matches!(build(&case, &surface), Some(FaceVaryingError::IndexOutOfRange { index: 13, n_values: 13, .. })));
    case.values.pop();
    assert_eq!(build(&case, &surface), Some(FaceVaryingError::CornerCount { expected: 36, given: 35 }));
    for (scheme, linear) in [(Scheme::DooSabin, UvLinear::None), (Scheme::Sqrt3, UvLinear::All)] {
        let error = other.build(PlanOptions::new(scheme, 1), linear).unwrap_err();
        assert_eq!(error, FaceVaryingError::Scheme { scheme, linear });
    }
    let bad = Tags { holes: vec![FaceId(99)], ..Tags::default() };
    let surface = Plan::build(&octahedron().mesh().unwrap(), Scheme::Loop, 1).unwrap();
    let error = FaceVaryingPlan::build_polygons(&surface, &other.mesh, &bad, &other.values, 6, UvLinear::None);
    assert!(matches!(error, Err(FaceVaryingError::Plan(PlanError::Tags(_)))));
}
