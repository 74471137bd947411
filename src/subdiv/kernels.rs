//! The loops over the rows of a table: short, and each with a length that the compiler knows.
//!
//! They read without bounds checks, which would cost as much as the sums. What makes that sound is an invariant of the
//! tables: every source is below the number of sources. It is checked in full when a table is finished or loaded
//! ([`StencilTable`], [`LimitTable`] and [`Rings`] cannot be had otherwise), and the length of the values is checked here.

use glam::Vec3;

use super::lane::Lane;
use super::limit::LimitTable;
use super::normals::{BLOCK, Sums};
use super::runs::pieces;
use super::stencil::StencilTable;

/// One value of a table's sources.
#[inline(always)]
#[allow(unsafe_code)]
pub(super) fn fetch(values: &[Lane], source: u32) -> Lane {
    debug_assert!((source as usize) < values.len());
    // SAFETY: `source` comes from a table whose sources are all below its number of sources, and each caller asserts that
    // `values` has that length.
    unsafe { *values.get_unchecked(source as usize) }
}

/// Computes the rows from `first_row` on, one for each place in `out`, and hands each to `put`.
#[inline(always)]
pub(super) fn apply<T>(
    table: &StencilTable,
    first_row: usize,
    source: &[Lane],
    out: &mut [T],
    put: impl Fn(&mut T, Lane) + Copy,
) {
    assert_eq!(source.len(), table.n_sources, "one value for each source");
    assert!(first_row + out.len() <= table.n_rows, "at most one value for each row");
    for piece in pieces(&table.runs, table.n_rows, first_row..first_row + out.len()) {
        let weights = &table.weights[piece.weights];
        let sources = &table.sources[piece.entries];
        let out = &mut out[piece.out];
        match *weights {
            [w] => fixed::<1, T>([w], sources, source, out, put),
            [a, b] => fixed::<2, T>([a, b], sources, source, out, put),
            [a, b, c] => fixed::<3, T>([a, b, c], sources, source, out, put),
            [a, b, c, d] => fixed::<4, T>([a, b, c, d], sources, source, out, put),
            [a, b, c, d, e, f, g] => fixed::<7, T>([a, b, c, d, e, f, g], sources, source, out, put),
            _ => long(weights, sources, source, out, put),
        }
    }
}

/// Rows of `N` entries each.
#[inline(always)]
fn fixed<const N: usize, T>(
    weights: [f32; N],
    sources: &[u32],
    source: &[Lane],
    out: &mut [T],
    put: impl Fn(&mut T, Lane),
) {
    let (sources, _) = sources.as_chunks::<N>();
    for (out, sources) in out.iter_mut().zip(sources) {
        let mut sum = fetch(source, sources[0]).scaled(weights[0]);
        for i in 1..N {
            sum = sum.plus(fetch(source, sources[i]).scaled(weights[i]));
        }
        put(out, sum);
    }
}

/// Rows of any length.
#[inline(always)]
fn long<T>(weights: &[f32], sources: &[u32], source: &[Lane], out: &mut [T], put: impl Fn(&mut T, Lane)) {
    for (out, sources) in out.iter_mut().zip(sources.chunks_exact(weights.len())) {
        let mut sum = fetch(source, sources[0]).scaled(weights[0]);
        for (&s, &weight) in sources[1..].iter().zip(&weights[1..]) {
            sum = sum.plus(fetch(source, s).scaled(weight));
        }
        put(out, sum);
    }
}

/// [`apply`] to lanes, for a level that is read again.
#[multiversion::multiversion(targets("x86_64+avx2", "x86_64+avx"))]
pub(super) fn apply_lanes(table: &StencilTable, first_row: usize, source: &[Lane], out: &mut [Lane]) {
    apply(table, first_row, source, out, |out, sum| *out = sum);
}

/// [`apply`] to positions, for a level that is delivered.
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
    let mut sums = Sums::default();
    for (b, normals) in normals.chunks_mut(BLOCK).enumerate() {
        let start = b * BLOCK;
        for piece in pieces(&table.runs, table.n_rows, first + start..first + start + normals.len()) {
            let weights = &table.weights[piece.weights];
            let sources = &table.sources[piece.entries];
            if let ([w0, w1, ..], (sources, _)) = (weights, sources.as_chunks::<7>())
                && LimitTable::is_regular(weights)
            {
                let (centre, neighbour) = (w0[0], w1[0]);
                for (i, &[v, q0, q1, q2, q3, q4, q5]) in piece.out.zip(sources) {
                    let (v, q0, q1, q2) = (fetch(source, v), fetch(source, q0), fetch(source, q1), fetch(source, q2));
                    let (q3, q4, q5) = (fetch(source, q3), fetch(source, q4), fetch(source, q5));
                    // Opposite neighbours come in with opposite weights, or with the same.
                    let (a, b, c) = (q0.minus(q3), q1.minus(q4), q2.minus(q5));
                    if wants_positions {
                        let ring = q0.plus(q3).plus(q1.plus(q4)).plus(q2.plus(q5));
                        positions[start + i] = v.scaled(centre).plus(ring.scaled(neighbour)).into();
                    }
                    let along = a.plus(b.minus(c).scaled(0.5));
                    sums.set(i, along.cross_zxy(b.plus(c)));
                }
            } else {
                for (i, sources) in piece.out.zip(sources.chunks_exact(weights.len())) {
                    let mut totals = [Lane::default(); 3];
                    for (&s, weights) in sources.iter().zip(weights) {
                        let value = fetch(source, s);
                        for k in 0..3 {
                            totals[k] = totals[k].plus(value.scaled(weights[k]));
                        }
                    }
                    if wants_positions {
                        positions[start + i] = totals[0].into();
                    }
                    sums.set(i, totals[1].cross_zxy(totals[2]));
                }
            }
        }
        sums.unit_vectors(normals);
    }
}
