//! Rows of √3.
//!
//! Creases are an extension of ours: Kobbelt's boundary, seen from both sides (Guillot and Gourret 2006 take the same
//! view the other way round, a boundary as a crease whose other side is closed). Where sharpness ends, positions are
//! blended with those that the smooth scheme has at the same places: a point at a third of an edge is the middle of the
//! triangle that would lie there had the edge been turned, and a vertex beside it has one neighbour more, across. So the
//! surface changes steadily with the sharpness, down to the smooth one at none: `tests/creases.rs` says what holds.

use crate::mesh::{DedgeId, VertexId};

use crate::subdiv::level::Level;
use crate::subdiv::neighbourhood::Neighbourhood;
use crate::subdiv::refined::{Refined, VertexParent};
use crate::subdiv::rule::Rule;
use crate::subdiv::scheme::{BoundaryStep, Creasing};
use crate::subdiv::sqrt3 as masks;
use crate::subdiv::stencil::{StencilBuilder, StencilTable, Weight};

/// One row for each vertex of the child.
pub(in crate::subdiv) fn table<W: Weight>(
    level: &Level,
    child: &Refined,
    step: BoundaryStep,
    creasing: Creasing,
) -> StencilTable<W> {
    let mesh = &level.mesh;
    let n_entries = mesh.n_vertices() + 2 * mesh.n_dedges();
    let mut builder = StencilTable::builder(mesh.n_vertices(), child.parents.len(), n_entries);
    let mut rows = Rows { level, step, creasing, builder: &mut builder, here: Neighbourhood::default() };
    for &parent in &child.parents {
        match parent {
            VertexParent::Vertex(vertex) => rows.vertex(vertex),
            VertexParent::Face(face) => {
                for (corner, weight) in mesh.corners(face).into_iter().zip(masks::FACE_POINT) {
                    rows.builder.entry(corner.0, weight);
                }
            }
            VertexParent::FirstThird(dedge) => rows.third(dedge, mesh.origin(dedge), mesh.target(dedge)),
            VertexParent::SecondThird(dedge) => rows.third(dedge, mesh.target(dedge), mesh.origin(dedge)),
            VertexParent::Edge(_) => unreachable!("√3 puts no vertex into the middle of an edge"),
        }
        rows.builder.end_row();
    }
    builder.finish()
}

struct Rows<'a, W> {
    level: &'a Level,
    step: BoundaryStep,
    creasing: Creasing,
    builder: &'a mut StencilBuilder<W>,
    here: Neighbourhood,
}

impl<W: Weight> Rows<'_, W> {
    fn vertex(&mut self, vertex: VertexId) {
        let mesh = &self.level.mesh;
        if !self.level.is_plain() {
            self.tagged_vertex(vertex);
        } else if !mesh.is_boundary_vertex(vertex) {
            self.builder.ring(vertex, mesh.ring(vertex), masks::inner_vertex(mesh.valence(vertex)));
        } else if self.step == BoundaryStep::Keep {
            self.builder.entry(vertex.0, 1.0);
        } else {
            self.builder.curve(mesh, vertex, masks::BOUNDARY_VERTEX);
        }
    }

    fn tagged_vertex(&mut self, vertex: VertexId) {
        if self.level.is_fixed(vertex) {
            self.builder.entry(vertex.0, 1.0);
            return;
        }
        if self.step == BoundaryStep::Trisect {
            let mut row: Vec<(u32, f64)> = Vec::new();
            if beside_fading(self.level, vertex, |source, weight| match row.iter_mut().find(|(s, _)| *s == source) {
                Some((_, sum)) => *sum += weight,
                None => row.push((source, weight)),
            }) {
                row.iter().for_each(|&(source, weight)| self.builder.entry(source, weight));
                return;
            }
        }
        self.here.load(self.level, vertex, self.creasing);
        let rules = self.here.rules();
        for (rule, weight, is_now) in [(rules.now, rules.weight_now, true), (rules.next, 1.0 - rules.weight_now, false)]
        {
            if weight <= 0.0 {
                continue;
            }
            match rule {
                Rule::Smooth | Rule::Dart => self.add_smooth(weight, is_now),
                Rule::Crease if self.step == BoundaryStep::Trisect => self.add_curve(weight, is_now),
                Rule::Crease | Rule::Corner => self.here.add_centre(weight),
            }
        }
        self.here.finish_row(self.builder);
    }

    /// The smooth mask. After a keeping step the edges of a crease that is about to end are still there, but in the smooth
    /// surface they would have been turned away: they do not count then.
    fn add_smooth(&mut self, weight: f64, is_now: bool) {
        let counts = |here: &Neighbourhood, edge: usize| {
            is_now || self.step == BoundaryStep::Keep || here.around.edges[edge] <= 0.0 || here.around.stays_sharp(edge)
        };
        let n = (0..self.here.ring.len()).filter(|&edge| counts(&self.here, edge)).count();
        let mask = masks::inner_vertex(n);
        self.here.add_centre(weight * mask.centre);
        for edge in 0..self.here.ring.len() {
            if counts(&self.here, edge) {
                self.here.add_neighbour(edge, weight * mask.neighbour);
            }
        }
    }

    fn add_curve(&mut self, weight: f64, is_now: bool) {
        self.here.add_centre(weight * masks::BOUNDARY_VERTEX.centre);
        for edge in 0..self.here.ring.len() {
            if if is_now { self.here.around.edges[edge] > 0.0 } else { self.here.around.stays_sharp(edge) } {
                self.here.add_neighbour(edge, weight * masks::BOUNDARY_VERTEX.after);
            }
        }
    }

    /// A third of the way along a side that is cut, from its near end.
    fn third(&mut self, dedge: DedgeId, near: VertexId, far: VertexId) {
        if self.level.is_plain() {
            let is_first = self.level.mesh.origin(dedge) == near;
            let mask = masks::BOUNDARY_POINT;
            self.builder.curve(&self.level.mesh, near, if is_first { mask } else { mask.reversed() });
            return;
        }
        let builder = &mut self.builder;
        third_of(self.level, self.creasing, &mut self.here, [near, far], dedge, |source, weight| {
            builder.entry(source, weight);
        });
    }
}

/// The weights of a vertex in a face of whose sides some are creases that end with the coming step, which cuts them: the
/// smooth surface would have turned these, so that what lies across is a neighbour. Says whether there are such sides; if
/// not, nothing has been entered.
pub(in crate::subdiv) fn beside_fading(level: &Level, vertex: VertexId, mut entry: impl FnMut(u32, f64)) -> bool {
    let mesh = &level.mesh;
    let fading: Vec<(u32, f64)> = mesh
        .outgoing_dedges(vertex)
        .map(|side| side.next())
        .filter(|&side| level.is_divisible(side))
        .filter_map(|side| {
            let across = mesh.origin(mesh.twin(side)?.prev());
            Some((across.0, f64::from(level.edge_sharpness(side).min(1.0))))
        })
        .filter(|(_, sharp)| *sharp < 1.0)
        .collect();
    // Each of them is there or not, at most three in a face: all cases, each with its share.
    for case in 0..if fading.is_empty() { 0 } else { 1_usize << fading.len() } {
        let is_neighbour = |i: usize| case >> i & 1 == 1;
        let share: f64 =
            fading.iter().enumerate().map(|(i, (_, s))| if is_neighbour(i) { 1.0 - s } else { *s }).product();
        let mask = masks::inner_vertex(mesh.valence(vertex) + case.count_ones() as usize);
        entry(vertex.0, share * mask.centre);
        mesh.ring(vertex).for_each(|v| entry(v.0, share * mask.neighbour));
        for (_, &(across, _)) in fading.iter().enumerate().filter(|(i, _)| is_neighbour(*i)) {
            entry(across, share * mask.neighbour);
        }
    }
    !fading.is_empty()
}

/// The weights of the point at a third of the way along a side that is cut, from its near end. `here` is scratch.
pub(in crate::subdiv) fn third_of(
    level: &Level,
    creasing: Creasing,
    here: &mut Neighbourhood,
    [near, far]: [VertexId; 2],
    dedge: DedgeId,
    mut entry: impl FnMut(u32, f64),
) {
    let mesh = &level.mesh;
    let mask = masks::BOUNDARY_POINT;
    here.load(level, near, creasing);
    let mut onward = here.onward(far.0);
    if level.is_fixed(near) {
        onward = [(None, 1.0), (None, 0.0)];
    }
    // A sharpness below one: so much of the curve, the rest of the smooth surface.
    let sharp = f64::from(level.edge_sharpness(dedge).min(1.0));
    let smooth = (1.0 - sharp) / 3.0;
    // Where the curve ends, the point before is the mirror image of the far end.
    let mirrored: f64 = onward.iter().filter(|(before, _)| before.is_none()).map(|(_, weight)| weight).sum();
    entry(near.0, sharp * (mask.centre + mirrored * 2.0 * mask.before) + smooth);
    entry(far.0, sharp * (mask.after - mirrored * mask.before));
    for (before, weight) in onward {
        if let Some(before) = before.filter(|_| weight > 0.0) {
            entry(before, sharp * weight * mask.before);
        }
    }
    if smooth > 0.0
        && let Some(twin) = mesh.twin(dedge)
    {
        entry(mesh.origin(dedge.prev()).0, smooth);
        entry(mesh.origin(twin.prev()).0, smooth);
    }
}
