//! The one-ring of a vertex with what is sharp in it, and a row of weights over them: scratch for building tables.

use crate::mesh::VertexId;

use super::corners::PolygonLevel;
use super::level::Level;
use super::mask::{CurveMask, RingMask};
use super::rule::{Rule, Rules, Surroundings};
use super::scheme::Creasing;
use super::stencil::{StencilBuilder, Weight};

/// Ring and sharpness around one vertex; kept from vertex to vertex for its buffers.
#[derive(Debug, Default)]
pub(super) struct Neighbourhood {
    vertex: u32,
    pub(super) ring: Vec<u32>,
    pub(super) around: Surroundings,
    /// Of the vertex, then of the ring.
    weights: Vec<f64>,
}

/// Which sharp edges count: those of this step or those of the next.
#[derive(Clone, Copy, PartialEq, Eq)]
enum When {
    Now,
    Next,
}

impl Neighbourhood {
    /// Looks at a vertex.
    pub(super) fn load(&mut self, level: &Level, vertex: VertexId, creasing: Creasing) {
        self.vertex = vertex.0;
        self.ring.clear();
        self.ring.extend(level.mesh.ring(vertex).map(|v| v.0));
        level.surroundings(vertex, &mut self.around);
        self.loaded(creasing);
    }

    /// Looks at a vertex of a polygon mesh: its neighbours along edges.
    pub(super) fn load_polygons(&mut self, level: &PolygonLevel, vertex: VertexId, creasing: Creasing) {
        self.vertex = vertex.0;
        self.ring.clear();
        self.ring.extend(level.mesh.ring(vertex).map(|v| v.0));
        level.surroundings(vertex, &mut self.around);
        self.loaded(creasing);
    }

    fn loaded(&mut self, creasing: Creasing) {
        self.around.fall(creasing);
        self.weights.clear();
        self.weights.resize(self.ring.len() + 1, 0.0);
    }

    /// Adds the weights of a vertex's rules: `smooth` over the ring, or `crease` along the two sharp edges, or the
    /// vertex alone; blended where the rule changes in this step.
    pub(super) fn add_rules(&mut self, rules: Rules, smooth: impl Fn(usize) -> RingMask, crease: CurveMask) {
        for (rule, when, weight) in
            [(rules.now, When::Now, rules.weight_now), (rules.next, When::Next, 1.0 - rules.weight_now)]
        {
            if weight <= 0.0 {
                continue;
            }
            match rule {
                Rule::Corner => self.weights[0] += weight,
                Rule::Crease => self.add_curve(when, crease, weight),
                Rule::Smooth | Rule::Dart => self.add_ring(smooth(self.ring.len()), weight),
            }
        }
    }

    fn add_curve(&mut self, when: When, mask: CurveMask, weight: f64) {
        self.weights[0] += weight * mask.centre;
        for edge in 0..self.ring.len() {
            if self.is_sharp(edge, when) {
                self.weights[1 + edge] += weight * mask.after;
            }
        }
    }

    fn add_ring(&mut self, mask: RingMask, weight: f64) {
        self.weights[0] += weight * mask.centre;
        self.weights[1..].iter_mut().for_each(|w| *w += weight * mask.neighbour);
    }

    /// Adds to the weight of the vertex itself.
    pub(super) fn add_centre(&mut self, weight: f64) {
        self.weights[0] += weight;
    }

    /// Adds to the weight of one neighbour.
    pub(super) fn add_neighbour(&mut self, edge: usize, weight: f64) {
        self.weights[1 + edge] += weight;
    }

    fn is_sharp(&self, edge: usize, when: When) -> bool {
        match when {
            When::Now => self.around.edges[edge] > 0.0,
            When::Next => self.around.stays_sharp(edge),
        }
    }

    /// The rules of the vertex.
    pub(super) fn rules(&self) -> Rules {
        self.around.rules()
    }

    /// How the curve goes on through this vertex, coming from the neighbour `from`: its other end, none where it ends or
    /// forks here, by the rule of this step and by that of the next, with the weights of the two.
    pub(super) fn onward(&self, from: u32) -> [(Option<u32>, f64); 2] {
        let rules = self.rules();
        let other = |rule: Rule, when: When| {
            let is_other = |&i: &usize| self.is_sharp(i, when) && self.ring[i] != from;
            (0..self.ring.len()).find(is_other).filter(|_| rule == Rule::Crease).map(|i| self.ring[i])
        };
        let now = other(rules.now, When::Now);
        // An edge that is smooth from the next step on has no curve to be part of then.
        let stays = (0..self.ring.len()).any(|i| self.ring[i] == from && self.is_sharp(i, When::Next));
        let next = if stays { other(rules.next, When::Next) } else { now };
        if now == next { [(now, 1.0), (next, 0.0)] } else { [(now, rules.weight_now), (next, 1.0 - rules.weight_now)] }
    }

    /// Writes the row: the vertex, then its ring counter-clockwise, without those of no weight.
    pub(super) fn finish_row<W: Weight>(&self, builder: &mut StencilBuilder<W>) {
        for (source, weight) in self.entries() {
            builder.entry(source, weight);
        }
    }

    /// Sources and weights, as [`finish_row`](Self::finish_row) writes them.
    pub(super) fn entries(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        let sources = std::iter::once(self.vertex).chain(self.ring.iter().copied());
        sources.zip(self.weights.iter().copied()).filter(|&(_, weight)| weight != 0.0)
    }
}
