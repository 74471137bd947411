//! Level of detail by distance: which level to draw, and how to get from one to the next without a jump.
//!
//! A level is fine enough where its edges, projected, are not longer than a bound in pixels. Around each change of level
//! lies a band of distances in which nothing changes, so that a head that sways does not flicker. A change itself moves
//! nothing: [`Geomorph`] starts the finer level on the triangles of the coarser one, and lets go only beyond the band.
//!
//! Szinek 2003, section 4.2, asks for a level by distance and leaves it open; all of this is ours.

use glam::Vec3;

use crate::math::ops;
use crate::mesh::{DedgeId, DedgeMesh};

use super::level::{Level, Sharpness};
use super::plan::{PlanError, check};
use super::prepare::{self, Prepared};
use super::refined::{Refined, VertexParent};
use super::scheme::{BoundaryStep, PlanOptions, Scheme, Split};
use super::stencil::StencilTable;
use super::steps::{Last, check_size};
use super::tags::Tags;
use super::{quarters, thirds};

/// What to draw how finely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DetailBounds {
    /// Longest projected edge, in pixels. More than 0.
    pub edge_px: f32,
    /// Focal length in pixels: half the height of the picture over the tangent of half the vertical angle of view.
    pub focal_px: f32,
    /// Half the width of the band around a change of level, as a part of `edge_px`: 0 to below 1. A tenth keeps a level
    /// from 90 to 110 % of the bound.
    pub hysteresis: f32,
    /// How much longer than where the band ends the coarser level's edges must have become for the finer one to be reached
    /// in full, as a part of that length. Never longer than until the next change.
    pub morph: f32,
}

impl Default for DetailBounds {
    /// Edges of 4 pixels, a band of a tenth to either side, half as much again for the morph; a picture of 1080 rows and
    /// a lens of 50 mm on 24 mm film.
    fn default() -> DetailBounds {
        DetailBounds { edge_px: 4.0, focal_px: 2250.0, hysteresis: 0.1, morph: 0.5 }
    }
}

/// Bounds that no level can meet.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DetailError {
    /// A number out of its range, or none.
    #[error("{name} is {value}; it must be {allowed}")]
    OutOfRange {
        /// Which.
        name: &'static str,
        /// As given.
        value: f32,
        /// In words.
        allowed: &'static str,
    },
    /// There are no levels to choose from, or a finer one has longer edges.
    #[error("level of detail needs edge lengths above 0, each shorter than the one before; got {lengths:?}")]
    Lengths {
        /// As given.
        lengths: Vec<f32>,
    },
}

/// Levels to choose from, with the length of their edges, and the bounds to choose by. Immutable: what changes from frame
/// to frame is a [`DetailState`].
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    bounds: DetailBounds,
    /// In metres, falling.
    lengths: Vec<f32>,
}

/// What was drawn last: an index into the levels of a [`Detail`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DetailState {
    /// The index.
    pub index: usize,
}

impl Detail {
    /// `edge_lengths_m`: for each level to choose from, coarsest first, the length of its edges in metres, as
    /// [`mean_edge_length`] gives it.
    ///
    /// # Errors
    /// A bound out of range; no levels, or lengths that do not fall.
    pub fn new(bounds: DetailBounds, edge_lengths_m: &[f32]) -> Result<Detail, DetailError> {
        let positive = |x: f32| x > 0.0 && x.is_finite();
        let rows = [
            ("edge_px", bounds.edge_px, positive(bounds.edge_px), "more than 0 and finite"),
            ("focal_px", bounds.focal_px, positive(bounds.focal_px), "more than 0 and finite"),
            ("hysteresis", bounds.hysteresis, (0.0..1.0).contains(&bounds.hysteresis), "0 or more and below 1"),
            ("morph", bounds.morph, positive(bounds.morph), "more than 0 and finite"),
        ];
        if let Some(&(name, value, _, allowed)) = rows.iter().find(|row| !row.2) {
            return Err(DetailError::OutOfRange { name, value, allowed });
        }
        let falls = edge_lengths_m.windows(2).all(|pair| pair[1] < pair[0]);
        if edge_lengths_m.is_empty() || !falls || !edge_lengths_m.iter().all(|&l| positive(l)) {
            return Err(DetailError::Lengths { lengths: edge_lengths_m.to_vec() });
        }
        Ok(Detail { bounds, lengths: edge_lengths_m.to_vec() })
    }

    /// How long an edge of a level is in the picture, in pixels, seen from the front at `distance_m` from the lens.
    /// At no distance or behind the lens: infinitely long.
    ///
    /// # Panics
    /// Where there is no such level.
    pub fn projected_px(&self, index: usize, distance_m: f32) -> f32 {
        if distance_m > 0.0 { self.bounds.focal_px * self.lengths[index] / distance_m } else { f32::INFINITY }
    }

    /// The coarsest level whose edges keep the bound, without regard to what was drawn before; the finest where none does.
    pub fn finest_needed(&self, distance_m: f32) -> usize {
        self.first_within(distance_m, self.bounds.edge_px)
    }

    /// The level to draw after what was drawn before. It changes only where the level at hand is too coarse by more than the
    /// band, or a coarser one would do with as much to spare; within the band it stays, whichever it is.
    pub fn update(&self, state: &mut DetailState, distance_m: f32) -> usize {
        let band = self.bounds.edge_px * self.bounds.hysteresis;
        state.index = state.index.min(self.lengths.len() - 1);
        if self.projected_px(state.index, distance_m) > self.bounds.edge_px + band {
            // Only as fine as needed: the band of the level that is chosen must not begin with a change back.
            state.index = self.first_within(distance_m, self.bounds.edge_px + band);
        } else {
            state.index = state.index.min(self.first_within(distance_m, self.bounds.edge_px - band));
        }
        state.index
    }

    /// How far level `index` has left the level before it: 0 on its triangles, 1 itself. A function of distance alone, 0 in
    /// all of the band of the change between the two, so that no change moves anything. 1 for the coarsest level.
    ///
    /// # Panics
    /// Where there is no such level.
    pub fn morph(&self, index: usize, distance_m: f32) -> f32 {
        let Some(coarser) = index.checked_sub(1) else { return 1.0 };
        let start = self.bounds.edge_px * (1.0 + self.bounds.hysteresis);
        let ratio = self.lengths[coarser] / self.lengths[index];
        // In full before the next change, which comes where the edges at hand have grown to `start`.
        let width = self.bounds.morph.min(ratio - 1.0);
        let t = ((self.projected_px(coarser, distance_m) / start - 1.0) / width).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }

    fn first_within(&self, distance_m: f32, bound_px: f32) -> usize {
        let within = |&index: &usize| self.projected_px(index, distance_m) <= bound_px;
        (0..self.lengths.len()).find(within).unwrap_or(self.lengths.len() - 1)
    }
}

/// Mean length of the sides of all triangles, in the unit of the positions: an edge between two triangles counts twice, one
/// on the boundary once. 0 without triangles.
///
/// # Panics
/// Where `indices` names a position that is not there.
pub fn mean_edge_length(positions: &[Vec3], indices: &[u32]) -> f32 {
    let mut sum = 0.0_f64;
    for corners in indices.as_chunks::<3>().0 {
        let [a, b, c] = corners.map(|v| positions[v as usize].as_dvec3());
        sum += [b - a, c - b, a - c].into_iter().map(|side| ops::sqrt(side.length_squared())).sum::<f64>();
    }
    (sum / indices.len().max(1) as f64) as f32
}

/// Why there is no geomorph.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GeomorphError {
    /// The scheme refines polygons, whose faces lie in no plane.
    #[error("{} refines polygons, whose faces lie in no plane: there is nothing to start on", scheme.name())]
    Scheme {
        /// The scheme.
        scheme: Scheme,
    },
    /// The fine level must be finer.
    #[error("a geomorph leads from a level to a finer one, not from {coarse} to {fine}")]
    Levels {
        /// The coarse level.
        coarse: u32,
        /// The fine one: the levels of the options.
        fine: u32,
    },
    /// One step of √3 turns every edge, so that levels an odd number of steps apart have none in common; and two steps must
    /// begin with the one that keeps boundaries.
    #[error("levels {coarse} and {fine}: for {} both must be even, since one step turns every edge", scheme.name())]
    OddLevel {
        /// The scheme.
        scheme: Scheme,
        /// The coarse level.
        coarse: u32,
        /// The fine one.
        fine: u32,
    },
    /// There is no plan to begin with.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// Where the vertices of a fine level lie on the triangles of a coarse one, as a table: they cover these exactly, each fine
/// triangle within one coarse one.
///
/// Loop and butterfly: an old vertex stays, a new one starts in the middle of its edge. √3, two steps at a time: what the
/// first step puts into a face starts in its middle, what the second puts into a child of a turned edge starts on a third
/// of that edge, and so do the points of a boundary or crease that is cut.
///
/// Built when the plans are; as immutable.
#[derive(Clone, Debug, PartialEq)]
pub struct Geomorph {
    table: StencilTable,
    coarse: u32,
    fine: u32,
}

impl Geomorph {
    /// From level `coarse` to the level of the options. Control mesh, tags and options are those of the two plans.
    ///
    /// # Errors
    /// Levels that do not follow each other or, for √3, are not both even; a polygon scheme; whatever keeps the fine plan
    /// from being built.
    pub fn build(
        control: &DedgeMesh,
        tags: &Tags,
        options: &PlanOptions,
        coarse: u32,
    ) -> Result<Geomorph, GeomorphError> {
        let (scheme, fine) = (options.scheme, options.levels);
        if !scheme.is_triangular() {
            return Err(GeomorphError::Scheme { scheme });
        }
        if coarse >= fine {
            return Err(GeomorphError::Levels { coarse, fine });
        }
        let stride = if scheme.split() == Split::Thirds { 2 } else { 1 };
        if !coarse.is_multiple_of(stride) || !fine.is_multiple_of(stride) {
            return Err(GeomorphError::OddLevel { scheme, coarse, fine });
        }
        check(options, tags)?;
        let prepared = prepare::triangles(control, tags, options).map_err(PlanError::from)?;
        let Prepared { level: Last::Triangles(mut level), faces, .. } = prepared else {
            unreachable!("triangles stay triangles")
        };
        check_size(options, faces.len(), level.n_active)?;
        let mut table: Option<StencilTable> = None;
        for step in (0..fine).step_by(stride as usize) {
            let (flat, next) = match scheme.split() {
                Split::Thirds => flat_ninths(&level, options),
                _ => flat_quarters(&level, options),
            };
            if step >= coarse {
                table = Some(table.map_or_else(|| flat.clone(), |before| flat.compose(&before)));
            }
            level = next;
        }
        let Some(table) = table else { return Err(GeomorphError::Levels { coarse, fine }) };
        Ok(Geomorph { table, coarse, fine })
    }

    /// The coarse level.
    pub fn coarse(&self) -> u32 {
        self.coarse
    }

    /// The fine level.
    pub fn fine(&self) -> u32 {
        self.fine
    }

    /// One row for each vertex of the fine level, over the vertices of the coarse one: at most three sources, the corners of
    /// one coarse triangle.
    pub fn table(&self) -> &StencilTable {
        &self.table
    }

    /// Positions of the fine level at `t` between the coarse one (0) and itself (1), from those of the two plans. At 1 the
    /// bits are those of `fine_positions`, at 0 those of the table's rows.
    ///
    /// # Panics
    /// Where a length is not the number of vertices of its level; `out` is as long as `fine_positions`.
    pub fn blend(&self, coarse_positions: &[Vec3], fine_positions: &[Vec3], t: f32, out: &mut [Vec3]) {
        assert_eq!(fine_positions.len(), out.len(), "one place for each vertex of the fine level");
        self.table.apply(coarse_positions, out);
        if t <= 0.0 {
            return;
        }
        if t >= 1.0 {
            out.copy_from_slice(fine_positions);
            return;
        }
        for (out, &fine) in out.iter_mut().zip(fine_positions) {
            *out = *out * (1.0 - t) + fine * t;
        }
    }
}

/// The next level of Loop and butterfly, and its vertices on the triangles of this one.
fn flat_quarters(level: &Level, options: &PlanOptions) -> (StencilTable, Level) {
    let child = quarters::refine(&level.mesh);
    let mesh = &level.mesh;
    let mut builder = StencilTable::builder(mesh.n_vertices(), child.parents.len(), 2 * child.parents.len());
    for &parent in &child.parents {
        match parent {
            VertexParent::Edge(dedge) => {
                builder.entry(mesh.origin(dedge).0, 0.5);
                builder.entry(mesh.target(dedge).0, 0.5);
            }
            VertexParent::Vertex(vertex) => builder.entry(vertex.0, 1.0),
            _ => unreachable!("a quarter has its corners on vertices and edges"),
        }
        builder.end_row();
    }
    let sharpness = quarters::child_sharpness(level, &child, options.creasing);
    (builder.finish(), next_level(level, child, sharpness, 4))
}

/// The level after the next of √3, from an even one, and its vertices on the triangles of this one.
fn flat_ninths(level: &Level, options: &PlanOptions) -> (StencilTable, Level) {
    let kept = thirds::refine(level, BoundaryStep::Keep);
    let sharpness = thirds::child_sharpness(level, &kept, BoundaryStep::Keep, options.creasing);
    let first_parents = kept.parents.clone();
    let between = next_level(level, kept, sharpness, 3);
    let cut = thirds::refine(&between, BoundaryStep::Trisect);
    let sharpness = thirds::child_sharpness(&between, &cut, BoundaryStep::Trisect, options.creasing);

    let mesh = &level.mesh;
    let mut builder = StencilTable::builder(mesh.n_vertices(), cut.parents.len(), 3 * cut.parents.len());
    const NEAR: f64 = 2.0 / 3.0;
    const FAR: f64 = 1.0 / 3.0;
    for &parent in &cut.parents {
        match parent {
            VertexParent::Vertex(vertex) => match first_parents[vertex.index()] {
                VertexParent::Face(face) => mesh.corners(face).into_iter().for_each(|v| builder.entry(v.0, FAR)),
                _ => builder.entry(vertex.0, 1.0),
            },
            // A face between has the number of the directed edge that it is the child of.
            VertexParent::Face(face) => {
                let dedge = DedgeId(face.0);
                let (near, far) = (mesh.origin(dedge).0, mesh.target(dedge).0);
                if level.is_open(dedge) {
                    // The rim of a frozen region is neither turned nor cut: (a, b, middle) has a middle of its own.
                    builder.entry(near, 4.0 / 9.0);
                    builder.entry(far, 4.0 / 9.0);
                    builder.entry(mesh.origin(dedge.prev()).0, 1.0 / 9.0);
                } else {
                    builder.entry(near, NEAR);
                    builder.entry(far, FAR);
                }
            }
            // Cut edges are those of this level, between old vertices.
            VertexParent::FirstThird(dedge) => {
                builder.entry(between.mesh.origin(dedge).0, NEAR);
                builder.entry(between.mesh.target(dedge).0, FAR);
            }
            VertexParent::SecondThird(dedge) => {
                builder.entry(between.mesh.target(dedge).0, NEAR);
                builder.entry(between.mesh.origin(dedge).0, FAR);
            }
            VertexParent::Edge(_) => unreachable!("√3 puts no vertex into the middle of an edge"),
        }
        builder.end_row();
    }
    (builder.finish(), next_level(&between, cut, sharpness, 3))
}

fn next_level(level: &Level, child: Refined, sharpness: Sharpness, growth: u32) -> Level {
    Level { mesh: child.mesh, sharpness, n_active: growth * level.n_active, fixed: level.fixed.clone() }
}
