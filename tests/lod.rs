//! Level of detail: the right level, no flicker, no jump.

use glam::Vec3;
use londra::mesh::shapes::{Shape, cabinet, grid, icosahedron, torus};
use londra::mesh::{DedgeMesh, FaceId, VertexId};
use londra::subdiv::{
    BoundaryRule, Creasing, Detail, DetailBounds, DetailError, DetailState, Geomorph, GeomorphError, Plan, PlanOptions,
    Scheme, Tags, evaluate_once, levels_of, mean_edge_length,
};

const PAIRS: [(Scheme, u32, u32); 11] = [
    (Scheme::Loop, 0, 1),
    (Scheme::Loop, 1, 2),
    (Scheme::Loop, 0, 3),
    (Scheme::Butterfly, 0, 1),
    (Scheme::Butterfly, 1, 3),
    (Scheme::Sqrt3, 0, 2),
    (Scheme::Sqrt3, 2, 4),
    (Scheme::Sqrt3, 0, 4),
    (Scheme::Sqrt3Interpolating, 0, 2),
    (Scheme::Sqrt3Interpolating, 2, 4),
    (Scheme::Sqrt3, 4, 6),
];

fn mesh(shape: &Shape) -> DedgeMesh {
    shape.mesh().unwrap_or_else(|e| panic!("{}: {e}", shape.name))
}

/// Every fine triangle lies within one coarse one, the right way round, and together they fill it. Worked out on the rows,
/// so that no position has a say.
fn check_cover(name: &str, control: &DedgeMesh, tags: &Tags, options: &PlanOptions, coarse: u32) {
    let name = format!("{name}, {} from {coarse} to {}", options.scheme.name(), options.levels);
    let morph = Geomorph::build(control, tags, options, coarse).unwrap_or_else(|e| panic!("{name}: {e}"));
    let levels = levels_of(control, tags, options).unwrap();
    let (coarse_mesh, fine_mesh) = (&levels[coarse as usize], &levels[options.levels as usize]);
    assert_eq!(morph.table().n_sources(), coarse_mesh.n_vertices(), "{name}");
    assert_eq!(morph.table().n_rows(), fine_mesh.n_vertices(), "{name}");
    let mut covered = vec![0.0_f64; coarse_mesh.n_faces()];
    for face in fine_mesh.faces() {
        let rows = fine_mesh.corners(face).map(|v| morph.table().row(v.index()));
        let mut sources: Vec<u32> = rows.iter().flat_map(|(sources, _)| sources.iter().copied()).collect();
        sources.sort_unstable();
        sources.dedup();
        assert!(sources.len() <= 3, "{name}: {face} lies over more than a triangle: {sources:?}");
        let inside = (0..coarse_mesh.n_faces()).find(|&f| {
            let corners = coarse_mesh.corners(FaceId(f as u32)).map(|v| v.0);
            sources.iter().all(|s| corners.contains(s)) && {
                let area = area_within(corners, rows);
                area > 0.0 && {
                    covered[f] += area;
                    true
                }
            }
        });
        assert!(inside.is_some(), "{name}: {face} lies in no coarse triangle, or upside down: {sources:?}");
    }
    for (f, area) in covered.iter().enumerate() {
        assert!((area - 1.0).abs() < 1e-4, "{name}: coarse triangle {f} is covered {area} times");
    }
}

/// The area of a fine triangle as a part of the coarse one, by barycentric coordinates.
fn area_within(corners: [u32; 3], rows: [(&[u32], &[f32]); 3]) -> f64 {
    let b = rows.map(|(sources, weights)| {
        corners.map(|corner| {
            sources.iter().zip(weights).filter(|(s, _)| **s == corner).map(|(_, &w)| f64::from(w)).sum::<f64>()
        })
    });
    b[0][0] * (b[1][1] * b[2][2] - b[1][2] * b[2][1]) - b[0][1] * (b[1][0] * b[2][2] - b[1][2] * b[2][0])
        + b[0][2] * (b[1][0] * b[2][1] - b[1][1] * b[2][0])
}

#[test]
fn the_fine_level_does_not_start_on_the_coarse_one() {
    // A pillow's two triangles have the same corners, so that the judge cannot tell them apart.
    for shape in cabinet().iter().filter(|s| s.name != "pillow") {
        for (scheme, coarse, fine) in PAIRS.into_iter().filter(|p| p.2 < 6) {
            check_cover(&shape.name, &mesh(shape), &Tags::default(), &PlanOptions::new(scheme, fine), coarse);
        }
    }
}

#[test]
fn tags_let_the_fine_level_start_off_the_coarse_one() {
    let shape = icosahedron();
    let creases = vec![
        (VertexId(1), VertexId(2), 10.0),
        (VertexId(2), VertexId(3), 1.5),
        (VertexId(3), VertexId(4), 1.0),
        (VertexId(0), VertexId(2), 0.3),
    ];
    let tags = Tags { creases, corners: vec![(VertexId(2), 1.0)], holes: vec![FaceId(17)], ..Tags::default() };
    let mut frozen = tags.clone();
    frozen.frozen = vec![FaceId(12), FaceId(4), FaceId(13)];
    for (scheme, coarse, fine) in PAIRS.into_iter().filter(|p| p.0.has_creases()) {
        let options = PlanOptions {
            boundary: BoundaryRule::EdgeAndCorner,
            creasing: Creasing::Chaikin,
            ..PlanOptions::new(scheme, fine)
        };
        if fine < 6 {
            check_cover("tags", &mesh(&shape), &tags, &options, coarse);
        }
        if scheme == Scheme::Sqrt3 && fine < 6 {
            check_cover("frozen", &mesh(&shape), &frozen, &options, coarse);
        }
    }
}

#[test]
fn a_morph_ends_beside_the_fine_level_or_jumps_on_its_way() {
    for shape in [grid(4, 3), torus(6, 5), icosahedron()] {
        for (scheme, coarse, fine) in PAIRS {
            let control = mesh(&shape);
            let positions = |levels| evaluate_once(&Plan::build(&control, scheme, levels).unwrap(), &shape.positions).0;
            let (from, to) = (positions(coarse), positions(fine));
            let morph = Geomorph::build(&control, &Tags::default(), &PlanOptions::new(scheme, fine), coarse).unwrap();
            let at = |t: f32| {
                let mut out = vec![Vec3::ZERO; to.len()];
                morph.blend(&from, &to, t, &mut out);
                out
            };
            let bits = |points: &[Vec3]| points.iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
            assert_eq!(bits(&at(1.0)), bits(&to), "{}", shape.name);
            let mut start = vec![Vec3::ZERO; to.len()];
            morph.table().apply(&from, &mut start);
            assert_eq!(bits(&at(0.0)), bits(&start), "{}", shape.name);
            let whole = start.iter().zip(&to).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
            let mut last = at(0.0);
            for i in 1..=100 {
                let here = at(i as f32 / 100.0);
                let moved = here.iter().zip(&last).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
                assert!(moved <= 0.0101 * whole + 1e-6, "{}: {moved} of {whole} at {i} %", shape.name);
                last = here;
            }
        }
    }
}

#[test]
fn areas_at_the_start_differ_from_the_coarse_ones() {
    // A step of √3 leaves a pillow without area.
    let area = |positions: &[Vec3], indices: &[u32]| -> f64 {
        let corners = indices.as_chunks::<3>().0.iter().map(|t| t.map(|v| positions[v as usize].as_dvec3()));
        corners.map(|[a, b, c]| 0.5 * (b - a).cross(c - a).length()).sum()
    };
    for shape in cabinet().iter().filter(|s| s.name != "pillow") {
        for (scheme, coarse, fine) in PAIRS.into_iter().filter(|p| p.2 < 6) {
            let control = mesh(shape);
            let plan = |levels| Plan::build(&control, scheme, levels).unwrap();
            let from = evaluate_once(&plan(coarse), &shape.positions).0;
            let morph = Geomorph::build(&control, &Tags::default(), &PlanOptions::new(scheme, fine), coarse).unwrap();
            let mut start = vec![Vec3::ZERO; morph.table().n_rows()];
            morph.table().apply(&from, &mut start);
            let (coarse_area, fine_area) = (area(&from, plan(coarse).indices()), area(&start, plan(fine).indices()));
            let message = format!("{} {}: {fine_area} for {coarse_area}", shape.name, scheme.name());
            assert!((fine_area / coarse_area - 1.0).abs() < 1e-5, "{message}");
        }
    }
}

#[test]
fn a_geomorph_is_made_where_edges_do_not_meet() {
    let control = mesh(&icosahedron());
    let build =
        |scheme, coarse, fine| Geomorph::build(&control, &Tags::default(), &PlanOptions::new(scheme, fine), coarse);
    let odd = |scheme, coarse, fine| Some(GeomorphError::OddLevel { scheme, coarse, fine });
    assert_eq!(build(Scheme::Sqrt3, 0, 1).err(), odd(Scheme::Sqrt3, 0, 1));
    assert_eq!(build(Scheme::Sqrt3Interpolating, 1, 3).err(), odd(Scheme::Sqrt3Interpolating, 1, 3));
    assert_eq!(build(Scheme::Loop, 2, 2).err(), Some(GeomorphError::Levels { coarse: 2, fine: 2 }));
    let scheme = Scheme::CatmullClark;
    assert_eq!(build(scheme, 0, 1).err(), Some(GeomorphError::Scheme { scheme }));
    assert!(matches!(build(Scheme::Loop, 0, 30).err(), Some(GeomorphError::Plan(_))));
}

fn detail() -> Detail {
    let bounds = DetailBounds { edge_px: 4.0, focal_px: 1000.0, hysteresis: 0.1, morph: 0.5 };
    Detail::new(bounds, &[0.032, 0.016, 0.008, 0.004]).unwrap()
}

#[test]
fn an_edge_is_longer_than_its_bound() {
    let detail = detail();
    assert_eq!(detail.projected_px(0, 8.0), 4.0);
    for (distance, expected) in [(100.0, 0), (8.0, 0), (7.9, 1), (4.0, 1), (2.1, 2), (1.9, 3), (0.1, 3), (0.0, 3)] {
        assert_eq!(detail.finest_needed(distance), expected, "at {distance} m");
    }
    let mut state = DetailState::default();
    for i in 0..4000 {
        let distance = 0.3 + 12.0 * ((f64::from(i) * 0.618_034) % 1.0) as f32;
        let index = detail.update(&mut state, distance);
        let longest = detail.projected_px(index, distance);
        assert!(longest <= 4.0 * 1.1 || index == 3, "{longest} px at {distance} m");
        assert!(index == 0 || detail.projected_px(index - 1, distance) >= 4.0 * 0.9, "too fine at {distance} m");
    }
}

#[test]
fn a_level_flickers_within_the_band() {
    let detail = detail();
    for (centre, index) in [(8.0_f32, 0), (4.0, 1), (2.0, 2)] {
        for first in [centre * 1.5, centre / 1.5] {
            let mut state = DetailState::default();
            detail.update(&mut state, first);
            let mut changes = 0;
            let mut last = None;
            for i in 0..1000 {
                let distance = centre * (1.0 + 0.08 * if i % 2 == 0 { 1.0 } else { -1.0 });
                let now = detail.update(&mut state, distance);
                assert!(now == index || now == index + 1);
                changes += usize::from(last.is_some_and(|last| last != now));
                last = Some(now);
            }
            assert_eq!(changes, 0, "around {centre} m, from {first} m");
        }
        // Beyond the band it does change, once each way.
        let mut state = DetailState::default();
        detail.update(&mut state, centre * 1.5);
        assert_eq!(detail.update(&mut state, centre * 0.88), index + 1);
        assert_eq!(detail.update(&mut state, centre * 1.12), index);
    }
}

#[test]
fn a_change_of_level_moves_a_vertex() {
    let detail = detail();
    let mut state = DetailState::default();
    let mut last = detail.update(&mut state, 12.0);
    for i in 0..20_000 {
        let distance = 0.2 + 11.8 * (1.0 - (i % 10_000) as f32 / 5000.0).abs();
        let index = detail.update(&mut state, distance);
        if index != last {
            // The finer of the two is still on the coarser, and the coarser is in full.
            let (coarse, fine) = (index.min(last), index.max(last));
            assert_eq!(fine, coarse + 1);
            assert!(detail.morph(fine, distance) < 1e-3, "{coarse} to {fine} at {distance} m");
            assert_eq!(detail.morph(coarse, distance), 1.0, "{coarse} to {fine} at {distance} m");
        }
        last = index;
    }
    for index in 1..4 {
        let mut before = detail.morph(index, 12.0);
        for i in 0..12_000 {
            let now = detail.morph(index, 12.0 - i as f32 / 1000.0);
            assert!(now >= before && now - before < 0.02);
            before = now;
        }
        assert_eq!(before, 1.0);
    }
}

#[test]
fn bounds_that_mean_nothing_are_taken() {
    let with = |change: fn(&mut DetailBounds)| {
        let mut bounds = DetailBounds::default();
        change(&mut bounds);
        Detail::new(bounds, &[1.0])
    };
    assert!(with(|_| {}).is_ok());
    for (name, result) in [
        ("edge_px", with(|b| b.edge_px = 0.0)),
        ("focal_px", with(|b| b.focal_px = f32::NAN)),
        ("hysteresis", with(|b| b.hysteresis = 1.0)),
        ("morph", with(|b| b.morph = -1.0)),
    ] {
        let Err(DetailError::OutOfRange { name: found, .. }) = result else { panic!("{name} was taken") };
        assert_eq!(found, name);
    }
    for lengths in [&[][..], &[1.0, 1.0], &[1.0, 2.0], &[f32::NAN]] {
        assert!(matches!(Detail::new(DetailBounds::default(), lengths), Err(DetailError::Lengths { .. })));
    }
}

#[test]
fn the_mean_edge_does_not_halve_with_a_step_of_loop() {
    let shape = torus(24, 12);
    let length = |levels| {
        let plan = Plan::build(&mesh(&shape), Scheme::Loop, levels).unwrap();
        mean_edge_length(&evaluate_once(&plan, &shape.positions).0, plan.indices())
    };
    for levels in 0..3 {
        let ratio = length(levels) / length(levels + 1);
        assert!((1.9..2.2).contains(&ratio), "{ratio}");
    }
    assert_eq!(mean_edge_length(&[Vec3::ZERO, Vec3::X, Vec3::Y], &[]), 0.0);
}
