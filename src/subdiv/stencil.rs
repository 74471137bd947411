//! Stencil tables: rows of sources and weights in compressed form (CSR).
//!
//! The schemes are linear, so that vertices whose surroundings have the same topology share one set of weights whatever
//! their shape. Successive rows of the same length and weights form a run, and a run stores its weights once. Refined
//! meshes are nearly regular: a table has few runs but for the control vertices, takes little more room than its sources,
//! and is applied by loops whose length and weights are known before they start.

use glam::{DVec3, Vec3};

use crate::mesh::{DedgeMesh, VertexId};

use super::mask::{CurveMask, RingMask};
use super::runs::{Run, pieces, row_starts};

/// The type of a table's weights: `f32` for frames, `f64` for oracles.
pub trait Weight: Copy + PartialEq + Send + Sync + std::fmt::Debug {
    /// Rounds a weight of a mask.
    fn from_f64(weight: f64) -> Self;
    /// The weight in double precision.
    fn to_f64(self) -> f64;
}

impl Weight for f32 {
    fn from_f64(weight: f64) -> Self {
        weight as f32
    }
    fn to_f64(self) -> f64 {
        f64::from(self)
    }
}

impl Weight for f64 {
    fn from_f64(weight: f64) -> Self {
        weight
    }
    fn to_f64(self) -> f64 {
        self
    }
}

/// A value that stencils can blend: a position, a colour, a single number.
pub trait Blend<W>: Copy + Send + Sync {
    /// The value times a weight.
    fn scaled(self, weight: W) -> Self;
    /// The sum of two values.
    fn plus(self, other: Self) -> Self;
}

macro_rules! blend {
    ($value:ty, $weight:ty) => {
        impl Blend<$weight> for $value {
            #[inline(always)]
            fn scaled(self, weight: $weight) -> Self {
                self * weight
            }
            #[inline(always)]
            fn plus(self, other: Self) -> Self {
                self + other
            }
        }
    };
}

blend!(Vec3, f32);
blend!(f32, f32);
blend!(DVec3, f64);
blend!(f64, f64);

/// For each vertex of a level, the weighted sum over vertices of a coarser level that gives it.
///
/// Rows are summed in stored order, so that a row has the same bits however the rows are spread over threads.
#[derive(Clone, Debug, PartialEq)]
pub struct StencilTable<W = f32> {
    pub(super) n_sources: usize,
    pub(super) n_rows: usize,
    pub(super) sources: Vec<u32>,
    pub(super) weights: Vec<W>,
    pub(super) runs: Vec<Run>,
}

impl<W: Weight> StencilTable<W> {
    /// A table from rows of (source, weight), each source below `n_sources`.
    pub(super) fn builder(n_sources: usize, n_rows: usize, n_entries: usize) -> StencilBuilder<W> {
        StencilBuilder {
            n_rows_expected: n_rows,
            row: Vec::new(),
            table: StencilTable {
                n_sources,
                n_rows: 0,
                sources: Vec::with_capacity(n_entries),
                weights: Vec::new(),
                runs: Vec::new(),
            },
        }
    }

    /// The table that leaves everything as it is, but for an order: row `i` is source `order[i]`.
    pub(super) fn selection(n_sources: usize, order: &[u32]) -> StencilTable<W> {
        let mut builder = Self::builder(n_sources, order.len(), order.len());
        for &source in order {
            builder.entry(source, 1.0);
            builder.end_row();
        }
        builder.finish()
    }

    /// Number of vertices that rows may name.
    pub fn n_sources(&self) -> usize {
        self.n_sources
    }

    /// Number of rows: vertices of the finer level.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// Number of weights in all rows, counting shared ones as often as they are used.
    pub fn n_entries(&self) -> usize {
        self.sources.len()
    }

    /// Sources of all rows, one after another.
    pub fn sources(&self) -> &[u32] {
        &self.sources
    }

    /// Weights, each list of them once for successive rows that share it: see [`row_starts`](Self::row_starts).
    pub fn weights(&self) -> &[W] {
        &self.weights
    }

    /// For each row where its [`sources`](Self::sources) and its [`weights`](Self::weights) start, and one entry more that
    /// ends the last row.
    pub fn row_starts(&self) -> Vec<[u32; 2]> {
        row_starts(&self.runs, self.n_rows, self.sources.len())
    }

    /// Bytes of sources, weights and runs.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&self.sources[..]) + size_of_val(&self.weights[..]) + size_of_val(&self.runs[..])
    }

    /// Sources and weights of one row, equally many.
    ///
    /// # Panics
    /// Where the table has no such row.
    pub fn row(&self, row: usize) -> (&[u32], &[W]) {
        assert!(row < self.n_rows, "row {row} of {}", self.n_rows);
        let run = &self.runs[self.runs.partition_point(|run| run.first_row as usize <= row) - 1];
        let len = run.row_len as usize;
        let entry = run.first_entry as usize + (row - run.first_row as usize) * len;
        (&self.sources[entry..entry + len], &self.weights[run.first_weight as usize..][..len])
    }

    /// Computes all rows: `source` has [`n_sources`](Self::n_sources) values, `out` has [`n_rows`](Self::n_rows).
    ///
    /// # Panics
    /// Where a length is another.
    pub fn apply<P: Blend<W>>(&self, source: &[P], out: &mut [P]) {
        assert_eq!(source.len(), self.n_sources, "one value for each source");
        assert_eq!(out.len(), self.n_rows, "one value for each row");
        for piece in pieces(&self.runs, self.n_rows, 0..out.len()) {
            let weights = &self.weights[piece.weights];
            let rows = self.sources[piece.entries].chunks_exact(weights.len());
            for (out, sources) in out[piece.out].iter_mut().zip(rows) {
                let mut sum = source[sources[0] as usize].scaled(weights[0]);
                for (&s, &weight) in sources[1..].iter().zip(&weights[1..]) {
                    sum = sum.plus(source[s as usize].scaled(weight));
                }
                *out = sum;
            }
        }
    }

    /// The table that does `coarser` and then this one in a single pass: from the sources of `coarser` to the rows of
    /// this. Fatter rows, other order of sums: the values agree within rounding, not in bits.
    ///
    /// # Panics
    /// Where `coarser` has other rows than this table has sources.
    pub fn compose(&self, coarser: &StencilTable<W>) -> StencilTable<W> {
        assert_eq!(coarser.n_rows(), self.n_sources, "the tables follow each other");
        let mut builder = Self::builder(coarser.n_sources, self.n_rows(), 2 * self.n_entries());
        let mut sums = vec![0.0_f64; coarser.n_sources];
        let mut used = vec![false; coarser.n_sources];
        let mut touched: Vec<u32> = Vec::new();
        for row in 0..self.n_rows() {
            let (middles, outer) = self.row(row);
            for (&middle, &outer) in middles.iter().zip(outer) {
                let (sources, inner) = coarser.row(middle as usize);
                for (&source, &inner) in sources.iter().zip(inner) {
                    if !std::mem::replace(&mut used[source as usize], true) {
                        touched.push(source);
                    }
                    sums[source as usize] += outer.to_f64() * inner.to_f64();
                }
            }
            for source in touched.drain(..) {
                builder.entry(source, std::mem::take(&mut sums[source as usize]));
                used[source as usize] = false;
            }
            builder.end_row();
        }
        builder.finish()
    }
}

/// Collects rows.
pub(super) struct StencilBuilder<W> {
    n_rows_expected: usize,
    /// Weights of the row at hand.
    row: Vec<W>,
    table: StencilTable<W>,
}

impl<W: Weight> StencilBuilder<W> {
    /// Adds a source to the row at hand.
    #[inline]
    pub(super) fn entry(&mut self, source: u32, weight: f64) {
        debug_assert!((source as usize) < self.table.n_sources);
        self.table.sources.push(source);
        self.row.push(W::from_f64(weight));
    }

    /// Adds a vertex and its ring to the row at hand.
    #[inline]
    pub(super) fn ring(&mut self, vertex: VertexId, ring: impl Iterator<Item = VertexId>, mask: RingMask) {
        self.entry(vertex.0, mask.centre);
        for neighbour in ring {
            self.entry(neighbour.0, mask.neighbour);
        }
    }

    /// Adds a boundary vertex to the row at hand, then its two neighbours along the boundary, as a ring has them: first
    /// the one after.
    pub(super) fn curve(&mut self, mesh: &DedgeMesh, vertex: VertexId, mask: CurveMask) {
        let after = mesh.outgoing(vertex);
        self.entry(vertex.0, mask.centre);
        self.entry(mesh.target(after).0, mask.after);
        if let Some(before) = mesh.outgoing_dedges(vertex).last() {
            self.entry(mesh.origin(before.prev()).0, mask.before);
        }
    }

    /// Ends the row at hand, which must have a source.
    #[inline]
    pub(super) fn end_row(&mut self) {
        let table = &mut self.table;
        let len = self.row.len();
        debug_assert!(len > 0);
        let shares = table.runs.last().is_some_and(|run| {
            run.row_len as usize == len && table.weights[run.first_weight as usize..][..len] == self.row[..]
        });
        if !shares {
            table.runs.push(Run {
                first_row: table.n_rows as u32,
                first_entry: (table.sources.len() - len) as u32,
                row_len: len as u32,
                first_weight: table.weights.len() as u32,
            });
            table.weights.extend_from_slice(&self.row);
        }
        self.row.clear();
        table.n_rows += 1;
    }

    pub(super) fn finish(self) -> StencilTable<W> {
        debug_assert_eq!(self.table.n_rows, self.n_rows_expected);
        // The kernels rely on it.
        assert!(all_below(&self.table.sources, self.table.n_sources), "a row names a source that does not exist");
        self.table
    }
}

/// Whether all numbers are below a bound: branchless, so that it costs no more than reading them.
#[multiversion::multiversion(targets("x86_64+avx2", "x86_64+sse4.1"))]
pub(super) fn all_below(numbers: &[u32], bound: usize) -> bool {
    let mut largest = 0;
    for &n in numbers {
        largest = if n > largest { n } else { largest };
    }
    numbers.is_empty() || (largest as usize) < bound
}
