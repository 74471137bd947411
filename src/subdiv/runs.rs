//! Successive rows of equal length and weights in a compressed table (CSR).
//!
//! Refined meshes are nearly regular, so most rows are of one of two kinds; a loop whose length the compiler knows is
//! several times faster than one that it does not.

use std::ops::Range;

/// Rows of the same kind, one after another; they end where the next run begins.
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub(super) struct Run {
    pub(super) first_row: u32,
    pub(super) first_entry: u32,
    /// Entries of each row.
    pub(super) row_len: u32,
    /// Where the weights of a row stand that all rows share.
    pub(super) first_weight: u32,
}

/// The part of a run that lies within the rows asked for.
pub(super) struct Piece {
    /// Rows, counted from the first one asked for.
    pub(super) out: Range<usize>,
    /// Entries of all these rows.
    pub(super) entries: Range<usize>,
    /// Weights of each row; as many as a row has entries.
    pub(super) weights: Range<usize>,
}

/// The runs of a table with `n_rows` rows, cut to some of them, in order.
pub(super) fn pieces(runs: &[Run], n_rows: usize, rows: Range<usize>) -> impl Iterator<Item = Piece> + '_ {
    let first = runs.partition_point(|run| run.first_row as usize <= rows.start).saturating_sub(1);
    let ends = runs[first..].iter().skip(1).map(|run| run.first_row as usize).chain([n_rows]);
    let wanted = rows.clone();
    runs[first..]
        .iter()
        .zip(ends)
        .take_while(move |(run, _)| !wanted.is_empty() && (run.first_row as usize) < wanted.end)
        .map(move |(run, run_end)| {
            let (run_start, len) = (run.first_row as usize, run.row_len as usize);
            let (start, end) = (run_start.max(rows.start), run_end.min(rows.end));
            let first_entry = run.first_entry as usize + (start - run_start) * len;
            Piece {
                out: start - rows.start..end - rows.start,
                entries: first_entry..first_entry + (end - start) * len,
                weights: run.first_weight as usize..run.first_weight as usize + len,
            }
        })
}

/// For each row its first entry and its first weight, and one place more that ends the last row.
pub(super) fn row_starts(runs: &[Run], n_rows: usize, n_entries: usize) -> Vec<[u32; 2]> {
    let mut starts = Vec::with_capacity(n_rows + 1);
    for piece in pieces(runs, n_rows, 0..n_rows) {
        let entries = piece.entries.step_by(piece.weights.len());
        starts.extend(entries.map(|entry| [entry as u32, piece.weights.start as u32]));
    }
    starts.push([n_entries as u32, 0]);
    starts
}

#[cfg(test)]
mod tests {
    use super::{Run, pieces};

    #[test]
    fn a_row_is_left_out_or_read_from_elsewhere() {
        let lengths = [3_u32, 3, 7, 7, 7, 1, 3];
        let mut offsets = vec![0_u32];
        let mut runs: Vec<Run> = Vec::new();
        for (row, &row_len) in lengths.iter().enumerate() {
            if runs.last().is_none_or(|run| run.row_len != row_len) {
                let first_weight = runs.last().map_or(0, |run| run.first_weight + run.row_len);
                runs.push(Run { first_row: row as u32, first_entry: offsets[row], row_len, first_weight });
            }
            offsets.push(offsets[row] + row_len);
        }
        assert_eq!(runs.len(), 4);
        for start in 0..=lengths.len() {
            for end in start..=lengths.len() {
                let mut row = start;
                for piece in pieces(&runs, lengths.len(), start..end) {
                    let len = piece.weights.len();
                    assert_eq!(len, lengths[row] as usize);
                    for (i, out) in piece.out.enumerate() {
                        assert_eq!(out, row - start);
                        assert_eq!(piece.entries.start + i * len, offsets[row] as usize);
                        row += 1;
                    }
                }
                assert_eq!(row, end);
            }
        }
    }
}
