//! Stencil tables: rows of sources and weights in compressed form (CSR).

use glam::{DVec3, Vec3};

use super::lane::Lane;
use super::runs::{Run, pieces, runs_of};

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

impl Blend<f32> for Lane {
    #[inline(always)]
    fn scaled(self, weight: f32) -> Self {
        Lane::scaled(self, weight)
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Lane::plus(self, other)
    }
}

/// For each vertex of a level, the weighted sum over vertices of a coarser level that gives it.
///
/// Rows are summed in stored order, so that a row has the same bits however the rows are spread over threads.
#[derive(Clone, Debug, PartialEq)]
pub struct StencilTable<W = f32> {
    n_sources: usize,
    offsets: Vec<u32>,
    sources: Vec<u32>,
    weights: Vec<W>,
    /// The rows again, by runs of equal length: most rows are of two lengths, and a loop of known length is faster.
    runs: Vec<Run>,
}

impl<W: Weight> StencilTable<W> {
    /// A table from rows of (source, weight), each source below `n_sources`.
    pub(super) fn builder(n_sources: usize, n_rows: usize, n_entries: usize) -> StencilBuilder<W> {
        let mut offsets = Vec::with_capacity(n_rows + 1);
        offsets.push(0);
        StencilBuilder {
            n_sources,
            offsets,
            sources: Vec::with_capacity(n_entries),
            weights: Vec::with_capacity(n_entries),
        }
    }

    /// Number of vertices that rows may name.
    pub fn n_sources(&self) -> usize {
        self.n_sources
    }

    /// Number of rows: vertices of the finer level.
    pub fn n_rows(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Number of weights in all rows.
    pub fn n_entries(&self) -> usize {
        self.sources.len()
    }

    /// Sources and weights of one row, equally many.
    pub fn row(&self, row: usize) -> (&[u32], &[W]) {
        let entries = self.offsets[row] as usize..self.offsets[row + 1] as usize;
        (&self.sources[entries.clone()], &self.weights[entries])
    }

    /// Computes all rows: `source` has [`n_sources`](Self::n_sources) values, `out` has [`n_rows`](Self::n_rows).
    ///
    /// # Panics
    /// Where a length is another.
    pub fn apply<P: Blend<W>>(&self, source: &[P], out: &mut [P]) {
        self.apply_rows(0, source, out);
    }

    /// Computes the rows from `first_row` on, one for each place in `out`.
    pub(super) fn apply_rows<P: Blend<W>>(&self, first_row: usize, source: &[P], out: &mut [P]) {
        assert_eq!(source.len(), self.n_sources, "one value for each source");
        assert!(first_row + out.len() <= self.n_rows(), "at most one value for each row");
        for piece in pieces(&self.runs, first_row..first_row + out.len()) {
            let (sources, weights) = (&self.sources[piece.entries.clone()], &self.weights[piece.entries]);
            let out = &mut out[piece.out];
            match piece.row_len {
                1 => apply_run::<1, W, P>(sources, weights, source, out),
                3 => apply_run::<3, W, P>(sources, weights, source, out),
                7 => apply_run::<7, W, P>(sources, weights, source, out),
                len => apply_long_run(len, sources, weights, source, out),
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
    n_sources: usize,
    offsets: Vec<u32>,
    sources: Vec<u32>,
    weights: Vec<W>,
}

impl<W: Weight> StencilBuilder<W> {
    /// Adds a source to the row at hand.
    pub(super) fn entry(&mut self, source: u32, weight: f64) {
        debug_assert!((source as usize) < self.n_sources);
        self.sources.push(source);
        self.weights.push(W::from_f64(weight));
    }

    /// Ends the row at hand, which must have a source.
    pub(super) fn end_row(&mut self) {
        debug_assert!(self.sources.len() > *self.offsets.last().unwrap_or(&0) as usize);
        self.offsets.push(self.sources.len() as u32);
    }

    pub(super) fn finish(self) -> StencilTable<W> {
        let runs = runs_of(&self.offsets);
        let StencilBuilder { n_sources, offsets, sources, weights } = self;
        StencilTable { n_sources, offsets, sources, weights, runs }
    }
}

/// Rows of `N` entries each.
#[inline(always)]
fn apply_run<const N: usize, W: Weight, P: Blend<W>>(sources: &[u32], weights: &[W], source: &[P], out: &mut [P]) {
    let (sources, _) = sources.as_chunks::<N>();
    let (weights, _) = weights.as_chunks::<N>();
    for ((out, sources), weights) in out.iter_mut().zip(sources).zip(weights) {
        let mut sum = source[sources[0] as usize].scaled(weights[0]);
        for i in 1..N {
            sum = sum.plus(source[sources[i] as usize].scaled(weights[i]));
        }
        *out = sum;
    }
}

/// Rows of `len` entries each, `len` at least 1.
fn apply_long_run<W: Weight, P: Blend<W>>(len: usize, sources: &[u32], weights: &[W], source: &[P], out: &mut [P]) {
    for ((out, sources), weights) in out.iter_mut().zip(sources.chunks_exact(len)).zip(weights.chunks_exact(len)) {
        let mut sum = source[sources[0] as usize].scaled(weights[0]);
        for (&s, &weight) in sources[1..].iter().zip(&weights[1..]) {
            sum = sum.plus(source[s as usize].scaled(weight));
        }
        *out = sum;
    }
}
