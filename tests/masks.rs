//! Weights against the numbers of the papers.

use londra::mesh::shapes::{disk, fan, pole, tetrahedron};
use londra::subdiv::{Plan, Scheme, StencilTable, sqrt3};

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
