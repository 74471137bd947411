//! The loops over the rows of a table: short, and each with a length and a pattern of weights that the compiler knows.
//!
//! They read without bounds checks, which would cost as much as the sums. What makes that sound is an invariant of the
//! tables: every source is below the number of sources. It is checked in full when a table is finished or loaded
//! ([`StencilTable`], [`LimitTable`] and [`Rings`](super::normals::Rings) cannot be had otherwise), and the length of the
//! values is checked here.

use glam::Vec3;

use super::lane::Lane;
use super::limit::LimitTable;
use super::normals::unit_vectors;
use super::runs::pieces;
use super::stencil::StencilTable;

/// One value of a table's sources.
#[inline(always)]
#[allow(unsafe_code)]
pub(super) fn fetch<V: Copy>(values: &[V], source: u32) -> V {
    debug_assert!((source as usize) < values.len());
    // SAFETY: `source` comes from a table whose sources are all below its number of sources, and each caller asserts that
    // `values` has that length.
    unsafe { *values.get_unchecked(source as usize) }
}

/// Computes the rows from `first_row` on, one for each place in `out`, and hands each to `put`.
#[inline(always)]
fn apply<T>(table: &StencilTable, first_row: usize, source: &[Lane], out: &mut [T], put: impl Fn(&mut T, Lane) + Copy) {
    assert_eq!(source.len(), table.n_sources, "one value for each source");
    assert!(first_row + out.len() <= table.n_rows, "at most one value for each row");
    for piece in pieces(&table.runs, table.n_rows, first_row..first_row + out.len()) {
        let weights = &table.weights[piece.weights];
        let sources = &table.sources[piece.entries];
        let out = &mut out[piece.out];
        // Equal weights are taken out of the sum: a regular vertex costs two multiplications, not seven.
        match *weights {
            [w] => each::<1, T>(sources, out, |[a], out| put(out, fetch(source, a).scaled(w))),
            [w, v] if w == v => each::<2, T>(sources, out, |[a, b], out| {
                put(out, fetch(source, a).plus(fetch(source, b)).scaled(w));
            }),
            [w, v, u] if w == v && v == u => each::<3, T>(sources, out, |[a, b, c], out| {
                put(out, fetch(source, a).plus(fetch(source, b)).plus(fetch(source, c)).scaled(w));
            }),
            [w, v, u] if v == u => each::<3, T>(sources, out, |[a, b, c], out| {
                let sides = fetch(source, b).plus(fetch(source, c));
                put(out, fetch(source, a).scaled(w).plus(sides.scaled(v)));
            }),
            [w, v, u, t] if w == v && u == t => each::<4, T>(sources, out, |[a, b, c, d], out| {
                let (ends, sides) = (fetch(source, a).plus(fetch(source, b)), fetch(source, c).plus(fetch(source, d)));
                put(out, ends.scaled(w).plus(sides.scaled(u)));
            }),
            [w, v, ref rest @ ..] if rest.len() == 5 && rest.iter().all(|r| *r == v) => {
                each::<7, T>(sources, out, |[s, a, b, c, d, e, f], out| {
                    let ring = fetch(source, a).plus(fetch(source, b)).plus(fetch(source, c));
                    let ring = ring.plus(fetch(source, d)).plus(fetch(source, e)).plus(fetch(source, f));
                    put(out, fetch(source, s).scaled(w).plus(ring.scaled(v)));
                });
            }
            [w, v, ref rest @ ..] if rest.iter().all(|r| *r == v) => {
                for (out, sources) in out.iter_mut().zip(sources.chunks_exact(weights.len())) {
                    let mut ring = fetch(source, sources[1]);
                    for &s in &sources[2..] {
                        ring = ring.plus(fetch(source, s));
                    }
                    put(out, fetch(source, sources[0]).scaled(w).plus(ring.scaled(v)));
                }
            }
            _ => {
                for (out, sources) in out.iter_mut().zip(sources.chunks_exact(weights.len())) {
                    let mut sum = fetch(source, sources[0]).scaled(weights[0]);
                    for (&s, &weight) in sources[1..].iter().zip(&weights[1..]) {
                        sum = sum.plus(fetch(source, s).scaled(weight));
                    }
                    put(out, sum);
                }
            }
        }
    }
}

/// Rows of `N` sources each.
#[inline(always)]
fn each<const N: usize, T>(sources: &[u32], out: &mut [T], row: impl Fn([u32; N], &mut T)) {
    let (sources, _) = sources.as_chunks::<N>();
    for (out, &sources) in out.iter_mut().zip(sources) {
        row(sources, out);
    }
}

/// The rows as lanes, for a level that is read again.
#[multiversion::multiversion(targets("x86_64+avx2", "x86_64+avx"))]
pub(super) fn apply_lanes(table: &StencilTable, first_row: usize, source: &[Lane], out: &mut [Lane]) {
    apply(table, first_row, source, out, |out, sum| *out = sum);
}

/// The rows as positions, for a level that is delivered.
#[multiversion::multiversion(targets("x86_64+avx2", "x86_64+avx"))]
pub(super) fn apply_positions(table: &StencilTable, first_row: usize, source: &[Lane], out: &mut [Vec3]) {
    apply(table, first_row, source, out, |out, sum| *out = sum.into());
}

/// Computes limit positions from row `first` on, one for each place in `out`.
pub(super) fn limit_positions(table: &LimitTable, first: usize, source: &[Lane], out: &mut [Lane]) {
    assert_eq!(source.len(), table.n_rows, "one value for each source");
    for piece in pieces(&table.runs, table.n_rows, first..first + out.len()) {
        let weights = &table.weights[piece.weights];
        let rows = table.sources[piece.entries].chunks_exact(weights.len());
        for (out, sources) in out[piece.out].iter_mut().zip(rows) {
            let mut sum = fetch(source, sources[0]).scaled(weights[0][0]);
            for (&s, weights) in sources[1..].iter().zip(&weights[1..]) {
                sum = sum.plus(fetch(source, s).scaled(weights[0]));
            }
            *out = sum;
        }
    }
}

/// Computes limit normals from row `first` on, one for each place in `normals`, and limit positions into as many places or
/// none.
#[multiversion::multiversion(targets("x86_64+avx2", "x86_64+avx"))]
pub(super) fn limit_surface(
    table: &LimitTable,
    first: usize,
    source: &[Lane],
    positions: &mut [Vec3],
    normals: &mut [Vec3],
) {
    assert_eq!(source.len(), table.n_rows, "one value for each source");
    let wants_positions = !positions.is_empty();
    for piece in pieces(&table.runs, table.n_rows, first..first + normals.len()) {
        let weights = &table.weights[piece.weights];
        let sources = &table.sources[piece.entries];
        let normals = &mut normals[piece.out.clone()];
        let positions = if wants_positions { &mut positions[piece.out] } else { &mut [] };
        if let ([w0, w1, ..], (sources, _)) = (weights, sources.as_chunks::<7>())
            && LimitTable::is_regular(weights)
        {
            let (centre, neighbour) = (w0[0], w1[0]);
            unit_vectors(normals, |i| {
                let [v, q0, q1, q2, q3, q4, q5] = sources[i];
                let (q0, q1, q2) = (fetch(source, q0), fetch(source, q1), fetch(source, q2));
                let (q3, q4, q5) = (fetch(source, q3), fetch(source, q4), fetch(source, q5));
                if let Some(out) = positions.get_mut(i) {
                    let ring = q0.plus(q3).plus(q1.plus(q4)).plus(q2.plus(q5));
                    *out = fetch(source, v).scaled(centre).plus(ring.scaled(neighbour)).into();
                }
                // Opposite neighbours come in with opposite weights.
                let (a, b, c) = (q0.minus(q3), q1.minus(q4), q2.minus(q5));
                a.plus(b.minus(c).scaled(0.5)).cross(b.plus(c))
            });
        } else {
            let rows = sources.chunks_exact(weights.len());
            let total = |sources: &[u32], k: usize| {
                let mut sum = Lane::default();
                for (&s, weights) in sources.iter().zip(weights) {
                    sum = sum.plus(fetch(source, s).scaled(weights[k]));
                }
                sum
            };
            for (out, sources) in positions.iter_mut().zip(rows) {
                *out = total(sources, 0).into();
            }
            unit_vectors(normals, |i| {
                let sources = &sources[i * weights.len()..(i + 1) * weights.len()];
                total(sources, 1).cross(total(sources, 2))
            });
        }
    }
}
