//! The loops over the rows of a table: short, and each with a length that the compiler knows.

use glam::Vec3;

use super::lane::Lane;
use super::limit::LimitTable;
use super::normals::{BLOCK, unit_vectors};
use super::runs::pieces;
use super::stencil::StencilTable;

/// Computes the rows from `first_row` on, one for each place in `out`.
pub(super) fn apply(table: &StencilTable, first_row: usize, source: &[Lane], out: &mut [Lane]) {
    for piece in pieces(&table.runs, table.n_rows, first_row..first_row + out.len()) {
        let weights = &table.weights[piece.weights];
        let sources = &table.sources[piece.entries];
        let out = &mut out[piece.out];
        match *weights {
            [w] => fixed::<1>([w], sources, source, out),
            [a, b] => fixed::<2>([a, b], sources, source, out),
            [a, b, c] => fixed::<3>([a, b, c], sources, source, out),
            [a, b, c, d] => fixed::<4>([a, b, c, d], sources, source, out),
            [a, b, c, d, e, f, g] => fixed::<7>([a, b, c, d, e, f, g], sources, source, out),
            _ => long(weights, sources, source, out),
        }
    }
}

/// Rows of `N` entries each.
#[inline(always)]
fn fixed<const N: usize>(weights: [f32; N], sources: &[u32], source: &[Lane], out: &mut [Lane]) {
    let (sources, _) = sources.as_chunks::<N>();
    for (out, sources) in out.iter_mut().zip(sources) {
        let mut sum = source[sources[0] as usize].scaled(weights[0]);
        for i in 1..N {
            sum = sum.plus(source[sources[i] as usize].scaled(weights[i]));
        }
        *out = sum;
    }
}

/// Rows of any length.
fn long(weights: &[f32], sources: &[u32], source: &[Lane], out: &mut [Lane]) {
    for (out, sources) in out.iter_mut().zip(sources.chunks_exact(weights.len())) {
        let mut sum = source[sources[0] as usize].scaled(weights[0]);
        for (&s, &weight) in sources[1..].iter().zip(&weights[1..]) {
            sum = sum.plus(source[s as usize].scaled(weight));
        }
        *out = sum;
    }
}

/// Computes limit positions from row `first` on, one for each place in `out`.
pub(super) fn limit_positions(table: &LimitTable, first: usize, source: &[Lane], out: &mut [Lane]) {
    for piece in pieces(&table.runs, table.n_rows, first..first + out.len()) {
        let weights = &table.weights[piece.weights];
        let rows = table.sources[piece.entries].chunks_exact(weights.len());
        for (out, sources) in out[piece.out].iter_mut().zip(rows) {
            let mut sum = source[sources[0] as usize].scaled(weights[0][0]);
            for (&s, weights) in sources[1..].iter().zip(&weights[1..]) {
                sum = sum.plus(source[s as usize].scaled(weights[0]));
            }
            *out = sum;
        }
    }
}

/// Computes limit normals from row `first` on, one for each place in `normals`, and limit positions into as many places or
/// none.
pub(super) fn limit_surface(
    table: &LimitTable,
    first: usize,
    source: &[Lane],
    positions: &mut [Vec3],
    normals: &mut [Vec3],
) {
    let wants_positions = !positions.is_empty();
    let mut block = [Lane::default(); BLOCK];
    for (b, normals) in normals.chunks_mut(BLOCK).enumerate() {
        let start = b * BLOCK;
        for piece in pieces(&table.runs, table.n_rows, first + start..first + start + normals.len()) {
            let weights = &table.weights[piece.weights];
            let rows = table.sources[piece.entries].chunks_exact(weights.len());
            for (i, sources) in piece.out.zip(rows) {
                let mut sums = [Lane::default(); 3];
                for (&s, weights) in sources.iter().zip(weights) {
                    let value = source[s as usize];
                    for k in 0..3 {
                        sums[k] = sums[k].plus(value.scaled(weights[k]));
                    }
                }
                if wants_positions {
                    positions[start + i] = sums[0].into();
                }
                block[i] = sums[1].cross_zxy(sums[2]);
            }
        }
        unit_vectors(&block[..normals.len()], normals);
    }
}
