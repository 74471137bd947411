//! Limit positions and tangents: where the vertices of a level go, and how the surface lies there.
//!
//! A mask is a left eigenvector of the scheme's step on the one-ring: of eigenvalue 1 for the position, of the next two
//! for the tangents (Halstead, Kass and DeRose 1993). The rule is that of the vertex at this level: one that is still
//! semi-sharp is taken as sharp for ever, and a dart as smooth, which neither is quite; nor is, with √3, the neighbour of
//! a dart on its crease. A corner has the plane of one triangle at it, which is that of the limit where its side has no
//! more than this one; of more triangles the limit there is no plane in general. `tests/limits.rs` has the rest.

use crate::math::ops;
use crate::mesh::VertexId;

use super::level::Level;
use super::mask::CurveMask;
use super::neighbourhood::Neighbourhood;
use super::rows::sqrt3::{beside_fading, third_of};
use super::rule::Rule;
use super::runs::{Run, row_starts};
use super::scheme::{BoundaryStep, PlanOptions, Scheme};
use super::stencil::{Weight, all_below};
use super::{loop_scheme, sqrt3};

/// Masks of a vertex inside the surface over its ring, counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitMask {
    /// Position: weight of the vertex itself.
    pub centre: f64,
    /// Position: weight of each neighbour.
    pub neighbour: f64,
    n: usize,
}

impl LimitMask {
    /// The mask of valence `n` in which the ring as a whole has the weight `ring`.
    pub fn smooth(n: usize, ring: f64) -> LimitMask {
        LimitMask { centre: 1.0 - ring, neighbour: ring / n as f64, n }
    }

    /// Weights of neighbour `i` in the two tangents, whose cross product points outwards. Their lengths have no meaning.
    pub fn tangents(&self, i: usize) -> [f64; 2] {
        let angle = std::f64::consts::TAU * i as f64 / self.n as f64;
        [ops::cos(angle), ops::sin(angle)]
    }
}

/// For each vertex of a level the weights, over itself and its ring, of its limit position and of two tangents. (Beside a
/// boundary, after an odd number of √3 steps, over a few vertices more.)
///
/// Runs of rows share their weights as in a [`StencilTable`](super::StencilTable).
#[derive(Clone, Debug, PartialEq)]
pub struct LimitTable<W = f32> {
    pub(super) n_rows: usize,
    pub(super) sources: Vec<u32>,
    /// Of the position and of the two tangents.
    pub(super) weights: Vec<[W; 3]>,
    pub(super) runs: Vec<Run>,
}

impl<W: Weight> LimitTable<W> {
    /// Number of rows, and of sources: vertices of the level.
    pub fn n_rows(&self) -> usize {
        self.n_rows
    }

    /// Sources of all rows, one row after another.
    pub fn sources(&self) -> &[u32] {
        &self.sources
    }

    /// Weights of the position and of the two tangents, each list of them once for successive rows that share it: see
    /// [`row_starts`](Self::row_starts).
    pub fn weights(&self) -> &[[W; 3]] {
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

    /// Sources of one row, the vertex itself first, and for each its weights in the position and in the two tangents.
    ///
    /// # Panics
    /// Where the table has no such row.
    pub fn row(&self, row: usize) -> (&[u32], &[[W; 3]]) {
        assert!(row < self.n_rows, "row {row} of {}", self.n_rows);
        let run = &self.runs[self.runs.partition_point(|run| run.first_row as usize <= row) - 1];
        let len = run.row_len as usize;
        let entry = run.first_entry as usize + (row - run.first_row as usize) * len;
        (&self.sources[entry..entry + len], &self.weights[run.first_weight as usize..][..len])
    }

    /// Whether these are the weights of a vertex inside the surface with six neighbours.
    #[inline]
    pub(super) fn is_regular(weights: &[[W; 3]]) -> bool {
        const H: f64 = 0.866_025_403_784_438_6;
        const TANGENTS: [[f64; 2]; 7] =
            [[0.0, 0.0], [1.0, 0.0], [0.5, H], [-0.5, H], [-1.0, 0.0], [-0.5, -H], [0.5, -H]];
        weights.len() == 7
            && weights
                .iter()
                .zip(TANGENTS)
                .all(|(w, t)| (w[1].to_f64() - t[0]).abs() < 1e-6 && (w[2].to_f64() - t[1]).abs() < 1e-6)
            && weights[2..].iter().all(|w| w[0] == weights[1][0])
    }

    /// No rows yet.
    pub(super) fn with_capacity(n_entries: usize) -> LimitTable<W> {
        let sources = Vec::with_capacity(n_entries);
        LimitTable { n_rows: 0, sources, weights: Vec::new(), runs: Vec::new() }
    }

    /// Adds a row, equally many sources and weights. Whoever adds sees to it that sources exist.
    pub(super) fn push(&mut self, sources: impl Iterator<Item = u32>, weights: &[[W; 3]]) {
        let len = weights.len();
        let shares = self.runs.last().is_some_and(|run| {
            run.row_len as usize == len && self.weights[run.first_weight as usize..][..len] == *weights
        });
        if !shares {
            self.runs.push(Run {
                first_row: self.n_rows as u32,
                first_entry: self.sources.len() as u32,
                row_len: len as u32,
                first_weight: self.weights.len() as u32,
            });
            self.weights.extend_from_slice(weights);
        }
        self.sources.extend(sources);
        self.n_rows += 1;
    }

    /// The masks of all vertices of a level. `steps` are the steps that led to it.
    pub(super) fn build(level: &Level, options: &PlanOptions, steps: u32) -> LimitTable<W> {
        let n_rows = level.mesh.n_vertices();
        let table = LimitTable::with_capacity(n_rows + level.mesh.n_dedges());
        let mut rows = Rows {
            level,
            options,
            steps,
            table,
            here: Neighbourhood::default(),
            row: Vec::new(),
            rounded: Vec::new(),
            smooth: Vec::new(),
        };
        for vertex in level.mesh.vertices() {
            rows.vertex(vertex);
            rows.write();
        }
        // The kernels rely on it.
        assert!(all_below(&rows.table.sources, n_rows), "a row names a vertex that does not exist");
        rows.table
    }
}

struct Rows<'a, W> {
    level: &'a Level,
    options: &'a PlanOptions,
    steps: u32,
    table: LimitTable<W>,
    here: Neighbourhood,
    /// The row in the making: the vertex, then its whole ring, then what else there is.
    row: Vec<(u32, [f64; 3])>,
    rounded: Vec<[W; 3]>,
    /// For each valence met so far the weights of a smooth vertex and its ring: sines are slow.
    smooth: Vec<Vec<[f64; 3]>>,
}

impl<W: Weight> Rows<'_, W> {
    fn write(&mut self) {
        self.row.retain(|(_, weights)| *weights != [0.0; 3]);
        self.rounded.clear();
        self.rounded.extend(self.row.iter().map(|(_, weights)| weights.map(W::from_f64)));
        self.table.push(self.row.iter().map(|&(source, _)| source), &self.rounded);
    }

    fn vertex(&mut self, vertex: VertexId) {
        self.row.clear();
        let mesh = &self.level.mesh;
        if self.grows(vertex) {
            return self.grown(vertex);
        }
        if self.level.is_plain() && !mesh.is_boundary_vertex(vertex) {
            self.row.push((vertex.0, [0.0; 3]));
            self.row.extend(mesh.ring(vertex).map(|v| (v.0, [0.0; 3])));
            return self.smooth(true);
        }
        self.here.load(self.level, vertex, self.options.creasing);
        self.row.push((vertex.0, [0.0; 3]));
        self.row.extend(self.here.ring.iter().map(|&v| (v, [0.0; 3])));
        let fixed = self.level.is_fixed(vertex);
        let sharp: Vec<usize> = (0..self.here.ring.len()).filter(|&i| self.here.around.edges[i] > 0.0).collect();
        match Rule::of(sharp.len(), self.here.around.vertex > 0.0) {
            _ if fixed => {
                self.row[0].1[0] = 1.0;
                self.sides(&sharp);
            }
            Rule::Smooth | Rule::Dart => self.smooth(true),
            Rule::Crease => self.curve(&sharp),
            Rule::Corner => {
                self.row[0].1[0] = 1.0;
                self.sides(&sharp);
            }
        }
    }

    /// Whether the next step gives the vertex more neighbours: one that √3 has put into a face with sides to cut. Their
    /// points come to lie between its neighbours in place of a middle of the face.
    fn grows(&self, vertex: VertexId) -> bool {
        self.options.scheme == Scheme::Sqrt3
            && BoundaryStep::from_level(self.steps) == BoundaryStep::Trisect
            && self.level.mesh.outgoing_dedges(vertex).any(|d| self.level.is_divisible(d.next()))
    }

    /// Such a vertex: the masks of the next level, applied to the points of the next step.
    fn grown(&mut self, vertex: VertexId) {
        let mesh = &self.level.mesh;
        let outgoing: Vec<_> = mesh.outgoing_dedges(vertex).collect();
        let cut = outgoing.iter().filter(|d| self.level.is_divisible(d.next())).count();
        let mask = sqrt3::limit_inner(outgoing.len() + cut);
        let row = &mut self.row;
        let mut place = 0;
        // Weights of the next neighbour in turn.
        let mut turn = || {
            let [t1, t2] = mask.tangents(place);
            place += 1;
            [mask.neighbour, t1, t2]
        };
        let mut add = |source: u32, weight: f64, weights: [f64; 3]| {
            let scaled = weights.map(|w| w * weight);
            match row.iter_mut().find(|(s, _)| *s == source) {
                Some((_, sums)) => (0..3).for_each(|k| sums[k] += scaled[k]),
                None => row.push((source, scaled)),
            }
        };
        let centre = [mask.centre, 0.0, 0.0];
        if !beside_fading(self.level, vertex, |source, weight| add(source, weight, centre)) {
            let step = sqrt3::inner_vertex(outgoing.len());
            add(vertex.0, step.centre, centre);
            mesh.ring(vertex).for_each(|v| add(v.0, step.neighbour, centre));
        }
        for side in outgoing {
            let opposite = side.next();
            let ends = [mesh.origin(opposite), mesh.target(opposite)];
            if self.level.is_divisible(opposite) {
                for near_far in [ends, [ends[1], ends[0]]] {
                    let weights = turn();
                    let here = &mut self.here;
                    third_of(self.level, self.options.creasing, here, near_far, opposite, |source, weight| {
                        add(source, weight, weights);
                    });
                }
            } else {
                let weights = turn();
                for (corner, weight) in [vertex, ends[0], ends[1]].into_iter().zip(sqrt3::FACE_POINT) {
                    add(corner.0, weight, weights);
                }
            }
        }
    }

    fn smooth(&mut self, moves: bool) {
        let n = self.row.len() - 1;
        if self.smooth.len() <= n {
            self.smooth.resize(n + 1, Vec::new());
        }
        let weights = &mut self.smooth[n];
        if weights.is_empty() {
            let mask = match self.options.scheme {
                Scheme::Loop => loop_scheme::limit_inner(n, self.options.loop_weights),
                _ => sqrt3::limit_inner(n),
            };
            weights.push([mask.centre, 0.0, 0.0]);
            weights.extend((0..n).map(|i| mask.tangents(i)).map(|[t1, t2]| [mask.neighbour, t1, t2]));
        }
        for (row, weights) in self.row.iter_mut().zip(weights) {
            row.1 = *weights;
        }
        if !moves {
            self.row.iter_mut().for_each(|row| row.1[0] = 0.0);
            self.row[0].1[0] = 1.0;
        }
    }

    /// A vertex that stays. Of a corner the tangents are two of its edges, next to each other along the surface; of a
    /// vertex with no sharp edge those of the smooth surface.
    fn sides(&mut self, sharp: &[usize]) {
        if sharp.is_empty() && !self.level.mesh.is_boundary_vertex(VertexId(self.row[0].0)) {
            return self.smooth(false);
        }
        let first = sharp.first().copied().unwrap_or(0);
        let n = self.row.len() - 1;
        let second = (first + 1) % n;
        self.row[0].1 = [1.0, -1.0, -1.0];
        self.row[1 + first].1[1] = 1.0;
        self.row[1 + second].1[2] = 1.0;
    }

    /// A vertex on a curve: of a crease the side counter-clockwise from its first edge is taken.
    fn curve(&mut self, sharp: &[usize]) {
        let (first, last) = (sharp[0], sharp[1]);
        let CurveMask { before, centre, after } = match self.options.scheme {
            Scheme::Loop => loop_scheme::LIMIT_CURVE,
            _ => sqrt3::LIMIT_CURVE,
        };
        let k = last - first;
        let across = match self.options.scheme {
            Scheme::Loop => loop_scheme::across(k),
            _ => sqrt3::across(k, BoundaryStep::from_level(self.steps)),
        };
        self.row[0].1 = [centre, 0.0, across[0]];
        self.row[1 + first].1 = [after, 1.0, 0.0];
        self.row[1 + last].1 = [before, -1.0, 0.0];
        for (i, weight) in across[1..].iter().enumerate() {
            self.row[1 + first + i].1[2] += weight;
        }
    }
}
