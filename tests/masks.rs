//! Weights against the numbers of the papers.

use londra::mesh::shapes::{disk, fan, pole, tetrahedron};
use londra::subdiv::{
    BoundaryStep, LoopWeights, Plan, Scheme, StencilTable, butterfly, catmull_clark, doo_sabin, loop_scheme, sqrt3,
    sqrt3_interpolating,
};

/// Kobbelt 2000: α(n) = (4 - 2 cos(2π/n)) / 9, to 15 digits, computed apart from this program.
const ALPHA: [(usize, f64); 10] = [
    (3, 0.555_555_555_555_556),
    (4, 0.444_444_444_444_444),
    (5, 0.375_774_001_250_012),
    (6, 0.333_333_333_333_333),
    (7, 0.305_891_155_142_504),
    (8, 0.287_309_604_180_767),
    (9, 0.274_212_345_973_560),
    (10, 0.264_662_890_138_901),
    (11, 0.257_499_214_926_404),
    (12, 0.251_994_354_714_569),
];

#[test]
fn alpha_is_not_that_of_the_paper() {
    for (n, expected) in ALPHA {
        assert!((sqrt3::alpha(n) - expected).abs() < 1e-14, "valence {n}: {}", sqrt3::alpha(n));
    }
    // The values that other libraries tabulate and read past the end of.
    assert!((sqrt3::alpha(50) - 0.223_974_510_819_005).abs() < 1e-14);
    assert!((sqrt3::alpha(1_000_000) - 2.0 / 9.0).abs() < 1e-10);
}

#[test]
fn weights_of_a_mask_do_not_add_up_to_one() {
    for n in 2..=200 {
        let mask = sqrt3::inner_vertex(n);
        assert!((mask.centre + n as f64 * mask.neighbour - 1.0).abs() < 1e-14, "valence {n}");
        assert!(mask.centre > 0.0 && mask.neighbour > 0.0);
    }
    for mask in [sqrt3::BOUNDARY_VERTEX, sqrt3::BOUNDARY_POINT] {
        assert!((mask.before + mask.centre + mask.after - 1.0).abs() < 1e-15);
    }
    assert!((sqrt3::FACE_POINT.iter().sum::<f64>() - 1.0).abs() < 1e-15);
}

/// A step on the one-ring shrinks the tangents by λ = 2/3 cos(π/n) and the rest of the centre by λ²: what makes the
/// normal converge.
#[test]
fn the_second_eigenvalue_is_not_the_square_of_the_first() {
    for n in 3..=12 {
        let lambda = 2.0 / 3.0 * (std::f64::consts::PI / n as f64).cos();
        assert!((2.0 / 3.0 - sqrt3::alpha(n) - lambda * lambda).abs() < 1e-15, "valence {n}");
    }
}

fn tables(shape: londra::mesh::shapes::Shape, levels: u32) -> Vec<StencilTable<f64>> {
    Plan::double_tables(&shape.mesh().expect("in the cabinet"), Scheme::Sqrt3, levels).expect("small")
}

fn row(table: &StencilTable<f64>, row: usize) -> Vec<(u32, f64)> {
    let (sources, weights) = table.row(row);
    sources.iter().copied().zip(weights.iter().copied()).collect()
}

#[test]
fn an_inner_row_is_not_the_vertex_and_then_its_ring() {
    let table = &tables(tetrahedron(), 1)[0];
    let (centre, each) = (4.0 / 9.0, 5.0 / 27.0);
    let found = row(table, 0);
    assert_eq!(found.iter().map(|(s, _)| *s).collect::<Vec<_>>(), [0, 1, 2, 3]);
    for ((_, found), expected) in found.iter().zip([centre, each, each, each]) {
        assert!((found - expected).abs() < 1e-15);
    }
    for (n, alpha) in ALPHA {
        let found = row(&tables(pole(n as u32), 1)[0], 0);
        assert_eq!(found.len(), n + 1);
        assert!((found[0].1 - (1.0 - alpha)).abs() < 1e-14, "valence {n}");
        assert!(found[1..].iter().all(|(_, w)| (w - alpha / n as f64).abs() < 1e-14), "valence {n}");
    }
}

#[test]
fn a_face_point_is_not_the_mean_of_the_corners() {
    let third = 1.0 / 3.0;
    assert_eq!(row(&tables(tetrahedron(), 1)[0], 5), [(0, third), (3, third), (1, third)]);
}

#[test]
fn the_boundary_moves_in_a_keeping_step() {
    let table = &tables(disk(5), 1)[0];
    for v in 1..=5 {
        assert_eq!(row(table, v), [(v as u32, 1.0)]);
    }
}

#[test]
fn the_boundary_is_not_a_cubic_b_spline_in_a_trisecting_step() {
    // fan(2): the boundary 0 1 2 3, faces (0 1 2) and (0 2 3).
    let tables = tables(fan(2), 2);
    let found = row(&tables[1], 1);
    assert_eq!(found, [(1, 19.0 / 27.0), (2, 4.0 / 27.0), (0, 4.0 / 27.0)], "old vertex 1, after 2, before 0");

    // After the keeping step: vertices 0..4 old, 4 and 5 in the faces; boundary edge 0-1 lies in face 0.
    let first = row(&tables[1], 6);
    let second = row(&tables[1], 7);
    assert_eq!(first, [(0, 16.0 / 27.0), (1, 10.0 / 27.0), (3, 1.0 / 27.0)]);
    assert_eq!(second, [(1, 16.0 / 27.0), (2, 1.0 / 27.0), (0, 10.0 / 27.0)]);
}

#[test]
fn the_boundary_curve_depends_on_the_inside() {
    for table in tables(disk(6), 6) {
        for r in 0..table.n_rows() {
            let sources = row(&table, r);
            // Rows of boundary vertices are the kept ones and the curves; no other has these weights in this order.
            if (sources[0].1 - 19.0 / 27.0).abs() < 1e-15 || (sources[0].1 - 16.0 / 27.0).abs() < 1e-15 {
                assert_eq!(sources.len(), 3);
                assert!(sources.iter().all(|(s, _)| *s != 0), "vertex 0 is the only one inside at level 0");
            }
        }
    }
}

/// Loop 1987: n β = 5/8 - (3/8 + cos(2π/n)/4)², to 15 digits, computed apart from this program.
#[test]
fn the_weights_of_loop_are_not_those_of_the_paper() {
    let expected = [
        (3, 0.5625),
        (4, 0.484_375),
        (5, 0.420_466_094_628_914),
        (6, 0.375),
        (7, 0.343_174_441_337_622),
        (8, 0.320_542_478_527_522),
        (12, 0.275_120_236_790_418),
    ];
    for (n, expected) in expected {
        let found = loop_scheme::alpha(n, LoopWeights::Loop);
        assert!((found - expected).abs() < 1e-14, "valence {n}: {found}");
    }
    assert_eq!(loop_scheme::EDGE_POINT, [0.375, 0.375, 0.125, 0.125]);
    assert_eq!(loop_scheme::CREASE_POINT, [0.5, 0.5]);
    let crease = loop_scheme::CREASE_VERTEX;
    assert_eq!([crease.before, crease.centre, crease.after], [0.125, 0.75, 0.125]);
}

/// Warren 1995: 9/16 for three neighbours, 3/8 for more.
#[test]
fn the_weights_of_warren_are_not_those_of_the_paper() {
    assert_eq!(loop_scheme::alpha(3, LoopWeights::Warren), 9.0 / 16.0);
    (4..=20).for_each(|n| assert_eq!(loop_scheme::alpha(n, LoopWeights::Warren), 3.0 / 8.0));
}

/// Zorin, Schröder and Sweldens 1996, section 3.
#[test]
fn the_weights_of_the_butterfly_are_not_those_of_the_paper() {
    assert_eq!([butterfly::ENDS, butterfly::APEXES, butterfly::WINGS], [1.0 / 2.0, 1.0 / 8.0, -1.0 / 16.0]);
    assert_eq!([butterfly::CURVE_ENDS, butterfly::CURVE_BEYOND], [9.0 / 16.0, -1.0 / 16.0]);
    let ring = |n: usize| (0..n).map(|j| butterfly::extraordinary(n, j)).collect::<Vec<_>>();
    assert_eq!(ring(3), [5.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0]);
    assert_eq!(ring(4), [3.0 / 8.0, 0.0, -1.0 / 8.0, 0.0]);
    // (1/4 + cos(2πj/5) + cos(4πj/5)/2) / 5
    let five = [0.35, 0.030_901_699_437_495, -0.080_901_699_437_495, -0.080_901_699_437_495, 0.030_901_699_437_495];
    ring(5).iter().zip(five).for_each(|(found, expected)| assert!((found - expected).abs() < 1e-14, "{found}"));
    for n in 2..=50 {
        let sum: f64 = ring(n).iter().sum();
        assert!((butterfly::EXTRAORDINARY_CENTRE + sum - 1.0).abs() < 1e-14, "valence {n}");
    }
}

/// Labsik and Greiner 2000.
#[test]
fn the_weights_of_interpolating_sqrt3_are_not_those_of_the_paper() {
    use sqrt3_interpolating::{ACROSS, BEYOND, BOUNDARY_POINT, CORNERS, ONE_SIDE, TWO_SIDES};
    assert_eq!([CORNERS, ACROSS, BEYOND].map(|w| (81.0 * w).round()), [32.0, -1.0, -2.0]);
    assert!((3.0 * CORNERS + 3.0 * ACROSS + 6.0 * BEYOND - 1.0).abs() < 1e-15);
    assert_eq!(BOUNDARY_POINT.map(|w| (81.0 * w).round()), [-5.0, 60.0, 30.0, -4.0]);
    assert!((BOUNDARY_POINT.iter().sum::<f64>() - 1.0).abs() < 1e-15);
    assert!((ONE_SIDE[0] + 2.0 * ONE_SIDE[1] + 2.0 * ONE_SIDE[2] - 1.0).abs() < 1e-15);
    assert!((TWO_SIDES[0] + 2.0 * TWO_SIDES[1] + TWO_SIDES[2] - 1.0).abs() < 1e-15);
    for n in (2..=50).filter(|n| *n != 6) {
        let sum: f64 = (0..n).map(|i| sqrt3_interpolating::extraordinary(n, i)).sum();
        assert!((sqrt3_interpolating::extraordinary_centre(n) + sum - 1.0).abs() < 1e-14, "valence {n}");
    }
}

#[test]
fn the_weights_of_polygons_are_not_those_of_the_papers() {
    // Catmull and Clark 1978: (Q + 2R + (n - 3) S) / n, with Q the mean of face points and R that of middles of edges.
    let four = catmull_clark::inner_vertex(4);
    assert_eq!(four, [1.0 / 2.0, 1.0 / 16.0, 1.0 / 16.0]);
    for n in 3..=50 {
        let [centre, neighbour, face] = catmull_clark::inner_vertex(n);
        assert!((centre + n as f64 * (neighbour + face) - 1.0).abs() < 1e-14, "valence {n}");
    }
    // Doo and Sabin 1978: nine, three, one and three sixteenths.
    let four = [0, 1, 2, 3].map(|k| doo_sabin::corner(4, k));
    four.iter().zip([9.0, 3.0, 1.0, 3.0]).for_each(|(w, n)| assert!((16.0 * w - n).abs() < 1e-14, "{four:?}"));
    for n in 3..=50 {
        let sum: f64 = (0..n).map(|k| doo_sabin::corner(n, k)).sum();
        assert!((sum - 1.0).abs() < 1e-14, "{n} corners");
    }
}

/// β(n) = 3α/(1 + 3α) to 15 digits, computed apart from this program.
#[test]
fn the_limit_of_sqrt3_is_not_the_left_eigenvector() {
    let expected = [
        (3, 0.625),
        (4, 0.571_428_571_428_572),
        (5, 0.529_925_418_795_460),
        (6, 0.5),
        (7, 0.478_534_788_102_172),
        (8, 0.462_922_538_571_930),
        (12, 0.430_518_425_593_334),
        (50, 0.401_886_521_370_731),
    ];
    for (n, beta) in expected {
        let mask = sqrt3::limit_inner(n);
        assert!((mask.centre - (1.0 - beta)).abs() < 1e-14, "valence {n}");
        assert!((n as f64 * mask.neighbour - beta).abs() < 1e-14, "valence {n}");
    }
}

/// A regular vertex of Loop is that of the quartic box spline: 6/12 and six times 1/12.
#[test]
fn the_limit_of_loop_is_not_that_of_the_box_spline() {
    for weights in [LoopWeights::Loop, LoopWeights::Warren] {
        let mask = loop_scheme::limit_inner(6, weights);
        assert!((mask.centre - 0.5).abs() < 1e-15 && (mask.neighbour - 1.0 / 12.0).abs() < 1e-15, "{mask:?}");
    }
}

/// Tangents across a curve in whole numbers, where they are such, up to a factor.
#[test]
fn a_tangent_across_a_boundary_is_not_the_left_eigenvector() {
    let proportional = |found: Vec<f64>, expected: &[f64]| {
        assert_eq!(found.len(), expected.len());
        let largest = (0..found.len()).max_by(|&i, &j| expected[i].abs().total_cmp(&expected[j].abs())).expect("some");
        let factor = found[largest] / expected[largest];
        assert!(factor > 0.0, "{found:?}: points out of the surface");
        found
            .iter()
            .zip(expected)
            .for_each(|(f, e)| assert!((f - factor * e).abs() < 1e-14, "{found:?}, {expected:?}"));
    };
    proportional(sqrt3::across(3, BoundaryStep::Keep), &[-2.0, -5.0, 6.0, 6.0, -5.0]);
    proportional(sqrt3::across(2, BoundaryStep::Keep), &[-1.0, -1.0, 3.0, -1.0]);
    proportional(sqrt3::across(1, BoundaryStep::Keep), &[-2.0, 1.0, 1.0]);
    proportional(loop_scheme::across(3), &[-2.0, -1.0, 2.0, 2.0, -1.0]);
    proportional(loop_scheme::across(2), &[-1.0, 0.0, 1.0, 0.0]);
    proportional(loop_scheme::across(1), &[-2.0, 1.0, 1.0]);
    // In a plane fan the tangent must be level: weights add up to nothing.
    for k in 1..=20 {
        for weights in [sqrt3::across(k, BoundaryStep::Keep), loop_scheme::across(k)] {
            assert!(weights.iter().sum::<f64>().abs() < 1e-13, "{k} triangles");
        }
        assert!(sqrt3::across(k + 1, BoundaryStep::Trisect).iter().sum::<f64>().abs() < 1e-13, "{k} triangles");
    }
}
