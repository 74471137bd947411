//! Successive rows of equal length in a compressed table (CSR).
//!
//! Refined meshes are nearly regular, so most rows have one of two lengths; a loop whose length the compiler knows is
//! several times faster than one that it does not.

use std::ops::Range;

/// Rows of the same length, one after another.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    rows: Range<usize>,
    first_entry: usize,
    /// Entries of each row.
    pub(super) row_len: usize,
}

/// The part of a run that lies within the rows asked for.
pub(super) struct Piece {
    /// Rows, counted from the first one asked for.
    pub(super) out: Range<usize>,
    /// Entries of all these rows.
    pub(super) entries: Range<usize>,
    /// Entries of each row.
    pub(super) row_len: usize,
}

/// The runs of a table with these row offsets (one more than there are rows), in order and without gaps.
pub(super) fn runs_of(offsets: &[u32]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (row, ends) in offsets.windows(2).enumerate() {
        let row_len = (ends[1] - ends[0]) as usize;
        match runs.last_mut() {
            Some(run) if run.row_len == row_len => run.rows.end = row + 1,
            _ => runs.push(Run { rows: row..row + 1, first_entry: ends[0] as usize, row_len }),
        }
    }
    runs
}

/// The runs cut to some rows, in order.
pub(super) fn pieces(runs: &[Run], rows: Range<usize>) -> impl Iterator<Item = Piece> + '_ {
    let first = runs.partition_point(|run| run.rows.end <= rows.start);
    runs[first..].iter().take_while(move |run| run.rows.start < rows.end).map(move |run| {
        let (start, end) = (run.rows.start.max(rows.start), run.rows.end.min(rows.end));
        let first_entry = run.first_entry + (start - run.rows.start) * run.row_len;
        Piece {
            out: start - rows.start..end - rows.start,
            entries: first_entry..first_entry + (end - start) * run.row_len,
            row_len: run.row_len,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::{pieces, runs_of};

    #[test]
    fn a_row_is_left_out_or_read_from_elsewhere() {
        let lengths = [3_usize, 3, 7, 7, 7, 1, 3];
        let mut offsets = vec![0_u32];
        offsets.extend(lengths.iter().scan(0, |end, &len| {
            *end += len as u32;
            Some(*end)
        }));
        let runs = runs_of(&offsets);
        assert_eq!(runs.len(), 4);
        for start in 0..=lengths.len() {
            for end in start..=lengths.len() {
                let mut row = start;
                for piece in pieces(&runs, start..end) {
                    for (i, out) in piece.out.enumerate() {
                        assert_eq!(out, row - start);
                        assert_eq!(piece.entries.start + i * piece.row_len, offsets[row] as usize);
                        assert_eq!(piece.row_len, lengths[row]);
                        row += 1;
                    }
                }
                assert_eq!(row, end);
            }
        }
    }
}
