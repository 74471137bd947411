//! Similar triangles: the thesis's measures, its classes on its own shapes, and maps that lead where subdivision leads.

use std::cell::Cell;

use glam::Vec3;
use londra::mesh::shapes::{Shape, cabinet, fan, grid, icosahedron, octahedron, pole, tetrahedron, torus};
use londra::mesh::{DedgeMesh, FaceId, VertexId};
use londra::subdiv::similarity::SimilarityError;
use londra::subdiv::similarity::classes::{Criteria, Match, Shapes};
use londra::subdiv::similarity::maps::{Mapped, affine_map};
use londra::subdiv::similarity::measures::{TriangleShape, Weights, f1, f2, f3, f4, f5, f6};
use londra::subdiv::similarity::patches::patches;
use londra::subdiv::similarity::report::{ReportOptions, report};
use londra::subdiv::similarity::shared::SharedRows;
use londra::subdiv::{Plan, PlanError, PlanOptions, Scheme, Tags, evaluate_once, levels_of};

fn mesh(shape: &Shape) -> DedgeMesh {
    shape.mesh().unwrap_or_else(|e| panic!("{}: {e}", shape.name))
}

fn level(shape: &Shape, scheme: Scheme, level: u32) -> (DedgeMesh, Vec<Vec3>) {
    let control = mesh(shape);
    let plan = Plan::build(&control, scheme, level).unwrap();
    let mut meshes = levels_of(&control, &Tags::default(), &PlanOptions::new(scheme, level)).unwrap();
    (meshes.pop().unwrap(), evaluate_once(&plan, &shape.positions).0)
}

fn triangle(a: [f32; 2], b: [f32; 2], c: [f32; 2]) -> TriangleShape {
    TriangleShape::of([a, b, c].map(|[x, y]| Vec3::new(x, y, 0.0)))
}

const ROTATIONS: Criteria = Criteria { mirrored: false, ..STRICT };
const STRICT: Criteria = Criteria { weights: Weights::ANGLES, epsilon: 1e-9, folds: true, mirrored: true };

#[test]
fn a_measure_differs_from_its_formula() {
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-9, "{a} is not {b}");
    let right = triangle([0.0, 0.0], [3.0, 0.0], [0.0, 4.0]);
    near(right.area, 6.0);
    near(right.inradius(), 1.0);
    near(right.circumradius(), 2.5);
    near(right.roundness, 0.4);
    near(right.angles.iter().sum::<f64>(), std::f64::consts::PI);
    near(right.sides[0], 5.0);
    let double = triangle([1.0, 1.0], [1.0, 9.0], [-5.0, 1.0]);
    near(f1(&right, &double), 0.0);
    near(f2(&right, &double), 9.0 + 16.0 + 25.0);
    near(f3(&right, &double), 18.0 * 18.0);
    near(f4(&right, &double), 0.75 * 0.75);
    near(f4(&double, &right), 9.0);
    near(f5(&right), 0.36);
    near(f6(&right, &double), 0.0);
    let height = 0.75_f32.sqrt();
    let equilateral = triangle([0.0, 0.0], [1.0, 0.0], [0.5, height]);
    assert!((f5(&equilateral) - 0.25).abs() < 1e-7);
    let half = std::f64::consts::FRAC_PI_6;
    let thin = triangle([0.0, 0.0], [0.0, 1.0], [height, 0.5 + 1.0]);
    // Thirty, thirty and a hundred and twenty degrees against three times sixty.
    assert!((f1(&equilateral, &thin) - (half * half * (1.0 + 1.0 + 4.0))).abs() < 1e-6);
    let flat = triangle([0.0, 0.0], [1.0, 0.0], [2.0, 0.0]);
    assert_eq!((flat.area, flat.inradius(), flat.circumradius()), (0.0, 0.0, f64::INFINITY));
    assert_eq!(f5(&flat), 1.0);
    assert_eq!((f4(&flat, &flat), f4(&right, &flat)), (0.0, f64::INFINITY));
}

#[test]
fn the_weighted_sum_forgets_a_measure() {
    let (a, b) = (triangle([0.0, 0.0], [3.0, 0.0], [0.0, 4.0]), triangle([0.0, 0.0], [2.0, 0.0], [0.3, 0.7]));
    let values = [f1(&a, &b), f2(&a, &b), f3(&a, &b), f4(&a, &b), f6(&a, &b)];
    for (i, value) in values.into_iter().enumerate() {
        let mut weights = [0.0; 5];
        weights[i] = 1.0;
        assert_eq!(Weights::new(weights).unwrap().measure(&a, &b), value);
    }
    let mixed = Weights::new([0.5, 0.125, 0.125, 0.125, 0.125]).unwrap().measure(&a, &b);
    assert!((mixed - (0.5 * values[0] + 0.125 * values[1..].iter().sum::<f64>())).abs() < 1e-12);
    for weights in [[1.0, 1.0, 0.0, 0.0, 0.0], [2.0, -1.0, 0.0, 0.0, 0.0], [f64::NAN; 5]] {
        assert!(matches!(Weights::new(weights), Err(SimilarityError::Weights { .. })));
    }
}

#[test]
fn an_icosahedron_has_other_classes_than_its_symmetry_has_orbits() {
    // Of the n² parts of a triangle as many are different as its turns (and reflections) leave: Burnside's lemma.
    for (levels, n) in [(0, 1), (1, 2), (2, 4), (3, 8)] {
        let (mesh, positions) = level(&icosahedron(), Scheme::Loop, levels);
        let shapes = Shapes::new(&mesh, &positions).unwrap();
        for folds in [false, true] {
            let turns = shapes.classes(&Criteria { folds, ..ROTATIONS }).len();
            let all = shapes.classes(&Criteria { folds, ..STRICT }).len();
            // All n² stay under no turn, the middle one under two, those along an axis under its reflection.
            let (by_turns, by_reflections) = (n * n + 2, 3 * n);
            let expected = (by_turns / 3, (by_turns + by_reflections) / 6);
            assert_eq!((turns, all), expected, "level {levels}, folds {folds}");
        }
    }
}

#[test]
fn a_torus_has_other_classes_than_its_symmetry() {
    // A turn about the axis carries a row of squares onto itself, a half turn about a diameter one row onto another.
    let (mesh, positions) = level(&torus(24, 12), Scheme::Loop, 0);
    let shapes = Shapes::new(&mesh, &positions).unwrap();
    let criteria = Criteria { epsilon: 1e-8, ..ROTATIONS };
    assert_eq!(shapes.classes(&criteria).len(), 12);
    // Figure 4.9: by area alone, loosely, one triangle makes the whole torus.
    let area =
        Criteria { weights: Weights::new([0.0, 0.0, 1.0, 0.0, 0.0]).unwrap(), epsilon: 0.1, ..Criteria::default() };
    assert_eq!(shapes.classes(&area).len(), 1);
}

#[test]
fn a_triangle_is_in_no_class_or_not_like_its_representative() {
    for shape in cabinet() {
        for criteria in [STRICT, ROTATIONS, Criteria::default()] {
            let (mesh, positions) = level(&shape, Scheme::Loop, 1);
            let shapes = Shapes::new(&mesh, &positions).unwrap();
            let classes = shapes.classes(&criteria);
            assert_eq!(classes.class.len(), mesh.n_faces());
            assert!(!classes.is_empty());
            for face in mesh.faces() {
                let class = classes.class[face.index()] as usize;
                let by = classes.by[face.index()];
                assert!(criteria.mirrored || !by.mirrored);
                let representative = classes.representatives[class];
                assert!(representative <= face);
                let alike = shapes.are_strictly_similar(representative, face, by, &criteria);
                assert!(alike, "{}: {face} is not like {representative}", shape.name);
            }
        }
    }
}

/// A plane of equilateral triangles, bent along a row: lengths and angles stay.
fn bent(angle: f32) -> Shape {
    let n = 14_u32;
    let mut shape = grid(n, n);
    let (sine, cosine) = londra::math::ops::sin_cos(angle);
    for (i, p) in shape.positions.iter_mut().enumerate() {
        let (x, y) = ((i as u32 % (n + 1)) as f32, (i as u32 / (n + 1)) as f32);
        let height = 0.75_f32.sqrt() * (y - 7.0);
        let (flat, up) = if y > 7.0 { (height * cosine, height * sine) } else { (height, 0.0) };
        *p = Vec3::new(x - 0.5 * y, flat, up);
    }
    shape
}

#[test]
fn a_fold_is_not_seen() {
    let shape = bent(0.7);
    let (mesh, positions) = level(&shape, Scheme::Loop, 0);
    let shapes = Shapes::new(&mesh, &positions).unwrap();
    let unfolded = shapes.classes(&Criteria { folds: false, ..STRICT });
    let folded = shapes.classes(&STRICT);
    assert!(folded.len() > unfolded.len(), "{} and {}", folded.len(), unfolded.len());
    let error = |classes| {
        let mapped = Mapped::build(&mesh, &positions, classes, Scheme::Loop, 2).unwrap();
        let mut out = vec![Vec3::ZERO; mapped.n_vertices()];
        mapped.run(&positions, &mut Vec::new(), &mut out);
        let expected = evaluate_once(&Plan::build(&mesh, Scheme::Loop, 2).unwrap(), &positions).0;
        out.iter().zip(&expected).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
    };
    // Definition 4.6.1 alone lets a flat triangle stand for a folded one.
    assert!(error(&unfolded) > 0.01, "{}", error(&unfolded));
    assert!(error(&folded) < 1e-4, "{}", error(&folded));
}

#[test]
fn a_map_leads_elsewhere() {
    let from = [Vec3::new(0.0, 0.0, 0.0), Vec3::new(2.0, 0.0, 0.0), Vec3::new(0.5, 1.0, 0.0)];
    let turn = glam::Quat::from_rotation_x(0.8) * glam::Quat::from_rotation_y(1.9);
    let to = from.map(|p| turn * p * 3.0 + Vec3::new(1.0, -2.0, 5.0));
    for (by, sign) in [(Match::default(), 1.0), (Match { turn: 0, mirrored: true }, -1.0)] {
        let to = if by.mirrored { [to[0], to[2], to[1]] } else { to };
        let map = affine_map(from, to, by).unwrap();
        for i in 0..3 {
            let there = map.transform_point3(from[i].as_dvec3()).as_vec3();
            assert!(there.distance(to[by.corner(i)]) < 1e-5);
        }
        // The outside goes to the outside, and as far as the sides have grown.
        let above = map.transform_point3(from[0].as_dvec3() + glam::DVec3::Z).as_vec3() - to[0];
        let outside = (to[1] - to[0]).cross(to[2] - to[0]).normalize();
        assert!(above.distance(3.0 * outside) < 1e-4, "{above} for {outside}");
        assert!(map.matrix3.determinant() * sign > 0.0);
    }
    assert!(affine_map([Vec3::ZERO, Vec3::X, 2.0 * Vec3::X], to, Match::default()).is_none());
}

#[test]
fn mapping_leads_elsewhere_than_subdividing() {
    for (shape, scheme) in
        [(icosahedron(), Scheme::Loop), (torus(12, 6), Scheme::Loop), (octahedron(), Scheme::Butterfly)]
    {
        for (from, depth) in [(0, 1), (0, 3), (1, 1), (2, 1), (1, 2)] {
            let (mesh, positions) = level(&shape, scheme, from);
            let classes = Shapes::new(&mesh, &positions).unwrap().classes(&Criteria { epsilon: 1e-9, ..STRICT });
            let mapped = Mapped::build(&mesh, &positions, &classes, scheme, depth).unwrap();
            let expected = evaluate_once(&Plan::build(&mesh, scheme, depth).unwrap(), &positions).0;
            let mut out = vec![Vec3::NAN; mapped.n_vertices()];
            mapped.run(&positions, &mut Vec::new(), &mut out);
            assert_eq!(mapped.n_points(), classes.len() * (((1 << depth) + 1) * ((1 << depth) + 2) / 2));
            let off = out.iter().zip(&expected).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            assert!(off < 1e-4, "{} from {from}, {depth} deep: {off}", shape.name);
        }
    }
}

#[test]
fn a_triangle_is_in_no_patch_or_in_two_or_unlike_its_partner() {
    for (shape, levels) in [(icosahedron(), 0), (icosahedron(), 2), (torus(12, 6), 1), (fan(6), 1), (pole(7), 2)] {
        let (mesh, positions) = level(&shape, Scheme::Loop, levels);
        let shapes = Shapes::new(&mesh, &positions).unwrap();
        let classes = shapes.classes(&STRICT);
        let found = patches(&shapes, &classes, &STRICT);
        let mut seen = vec![0; mesh.n_faces()];
        for class in &found {
            for patch in &class.patches {
                assert_eq!(patch.len(), class.size());
                for (place, &(face, by)) in patch.iter().enumerate() {
                    seen[face.index()] += 1;
                    let (first, straight) = class.patches[0][place];
                    assert_eq!(straight, Match::default());
                    assert!(shapes.are_strictly_similar(first, face, by, &STRICT), "{}: {face}", shape.name);
                    let touches = |other: FaceId| {
                        (0..3).any(|side| mesh.twin(face.dedge(side)).is_some_and(|twin| twin.face() == other))
                    };
                    assert!(place == 0 || patch[..place].iter().any(|(f, _)| touches(*f)), "{}: {face}", shape.name);
                }
            }
        }
        assert!(seen.iter().all(|&n| n == 1), "{} level {levels}: {seen:?}", shape.name);
        assert!(found[0].size() > 1, "{}: no patch grows", shape.name);
    }
    // Two halves of an icosahedron, or more of less.
    let (mesh, positions) = level(&icosahedron(), Scheme::Loop, 0);
    let shapes = Shapes::new(&mesh, &positions).unwrap();
    let found = patches(&shapes, &shapes.classes(&STRICT), &STRICT);
    assert!(found[0].size() >= 5, "{}", found[0].size());
}

#[test]
fn triangles_of_one_topology_do_not_share_rows() {
    let count = |shape: &Shape, scheme, levels| {
        SharedRows::count(&mesh(shape), &Tags::default(), &PlanOptions::new(scheme, levels)).unwrap()
    };
    for scheme in [Scheme::Loop, Scheme::Butterfly, Scheme::Sqrt3, Scheme::Sqrt3Interpolating] {
        for levels in 0..=3 {
            for shape in [tetrahedron(), octahedron(), icosahedron(), torus(7, 6), pole(5), pole(9)] {
                let shared = count(&shape, scheme, levels);
                assert_eq!(shared.n_classes, 1, "{} {} {levels}", shape.name, scheme.name());
                assert_eq!(shared.n_surroundings, 1);
                assert_eq!(shared.n_triangles, shape.triangles.len());
            }
        }
    }
    // What touches a triangle decides its rows in Loop.
    for shape in cabinet() {
        let shared = count(&shape, Scheme::Loop, 3);
        assert!(shared.n_classes <= shared.n_surroundings, "{}: {shared:?}", shape.name);
    }
}

#[test]
fn which_corner_comes_first_changes_the_classes() {
    for shape in [grid(5, 4), torus(6, 5), pole(5)] {
        let mut turned = shape.clone();
        for (f, corners) in turned.triangles.iter_mut().enumerate() {
            corners.rotate_left(f * f % 3);
        }
        for scheme in [Scheme::Loop, Scheme::Butterfly, Scheme::Sqrt3, Scheme::Sqrt3Interpolating] {
            for levels in 1..=3 {
                let count = |s: &Shape| {
                    SharedRows::count(&mesh(s), &Tags::default(), &PlanOptions::new(scheme, levels)).unwrap()
                };
                let (a, b) = (count(&shape), count(&turned));
                assert_eq!(a.n_classes, b.n_classes, "{} {} {levels}", shape.name, scheme.name());
                assert_eq!(a.n_surroundings, b.n_surroundings);
            }
        }
    }
}

#[test]
fn a_crease_a_hole_or_a_frozen_face_has_the_rows_of_none() {
    let shape = torus(9, 9);
    let count = |tags: &Tags, scheme| SharedRows::count(&mesh(&shape), tags, &PlanOptions::new(scheme, 2)).unwrap();
    let crease = Tags { creases: vec![(VertexId(0), VertexId(1), 10.0)], ..Tags::default() };
    let hole = Tags { holes: vec![FaceId(5)], ..Tags::default() };
    let frozen = Tags { frozen: vec![FaceId(5), FaceId(60)], ..Tags::default() };
    for tags in [&crease, &hole] {
        for scheme in [Scheme::Loop, Scheme::Sqrt3] {
            let shared = count(tags, scheme);
            assert!(shared.n_classes > 1 && shared.n_surroundings > 1 && shared.n_classes < 60, "{shared:?}");
        }
    }
    let shared = count(&frozen, Scheme::Sqrt3);
    assert!(shared.n_classes > 2 && shared.n_triangles == 162, "{shared:?}");
}

#[test]
fn sharing_saves_nothing() {
    let shape = torus(24, 16);
    let shared = SharedRows::count(&mesh(&shape), &Tags::default(), &PlanOptions::new(Scheme::Loop, 3)).unwrap();
    assert_eq!(shared.n_classes, 1);
    assert!(20 * shared.shared_bytes < shared.composed_bytes, "{shared:?}");
    assert!(4 * shared.shared_bytes < shared.plan_bytes, "{shared:?}");
}

#[test]
fn a_report_leaves_out_a_level_or_reads_a_clock_of_its_own() {
    let ticks = Cell::new(0.0);
    let clock = || {
        ticks.set(ticks.get() + 1.0);
        ticks.get()
    };
    let shape = icosahedron();
    let options = ReportOptions { levels: 3, repeats: 3, ..ReportOptions::default() };
    let report = report(&mesh(&shape), &shape.positions, &options, &clock).unwrap();
    assert_eq!(
        report.steps.iter().map(|r| (r.from, r.to, r.n_triangles)).collect::<Vec<_>>(),
        [(0, 1, 20), (1, 2, 80), (2, 3, 320)]
    );
    assert_eq!(
        report.whole.iter().map(|r| (r.from, r.to, r.n_classes)).collect::<Vec<_>>(),
        [(0, 1, 1), (0, 2, 1), (0, 3, 1)]
    );
    assert_eq!(report.steps.iter().map(|r| r.n_classes).collect::<Vec<_>>(), [1, 2, 5]);
    assert_eq!(report.whole[2].n_vertices, 642);
    for row in report.steps.iter().chain(&report.whole) {
        // Each span is read with two ticks, whatever has been done between.
        assert_eq!([row.preparing_secs, row.similar_secs, row.classical_secs, row.plan_secs], [1.0; 4]);
        assert!(row.largest_error < 1e-4, "{row:?}");
        assert!(row.n_patches >= row.n_patch_classes && row.largest_patch > 1);
    }
    assert_eq!(ticks.get(), f64::from(6 * (2 + 3 * 3 * 2)));
    assert_eq!(report.shared.n_classes, 1);
}

#[test]
fn what_cannot_be_compared_is() {
    let shape = icosahedron();
    let options = ReportOptions { scheme: Scheme::Sqrt3, ..ReportOptions::default() };
    let error = report(&mesh(&shape), &shape.positions, &options, &|| 0.0).unwrap_err();
    assert_eq!(error, SimilarityError::Scheme { scheme: Scheme::Sqrt3 });
    let error = report(&mesh(&shape), &shape.positions[1..], &ReportOptions::default(), &|| 0.0).unwrap_err();
    assert_eq!(error, SimilarityError::Positions { expected: 12, given: 11 });
    let options = ReportOptions { levels: 40, ..ReportOptions::default() };
    let error = report(&mesh(&shape), &shape.positions, &options, &|| 0.0).unwrap_err();
    assert!(matches!(error, SimilarityError::Plan(PlanError::TooManyFaces { .. })));
    let scheme = Scheme::CatmullClark;
    let error = SharedRows::count(&mesh(&shape), &Tags::default(), &PlanOptions::new(scheme, 1)).unwrap_err();
    assert_eq!(error, PlanError::NotPolygons { scheme });
}
