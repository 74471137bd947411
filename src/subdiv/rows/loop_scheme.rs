//! Rows of Loop.

use crate::mesh::{DedgeId, VertexId};

use crate::subdiv::level::Level;
use crate::subdiv::loop_scheme as masks;
use crate::subdiv::neighbourhood::Neighbourhood;
use crate::subdiv::refined::{Refined, VertexParent};
use crate::subdiv::scheme::PlanOptions;
use crate::subdiv::stencil::{StencilBuilder, StencilTable, Weight};

/// One row for each vertex of the child.
pub(in crate::subdiv) fn table<W: Weight>(level: &Level, child: &Refined, options: &PlanOptions) -> StencilTable<W> {
    let mesh = &level.mesh;
    let n_entries = mesh.n_vertices() + mesh.n_dedges() + 4 * (child.parents.len() - mesh.n_vertices());
    let mut builder = StencilTable::builder(mesh.n_vertices(), child.parents.len(), n_entries);
    let mut rows = Rows { level, options, builder: &mut builder, here: Neighbourhood::default() };
    for &parent in &child.parents {
        match parent {
            VertexParent::Vertex(vertex) => rows.vertex(vertex),
            VertexParent::Edge(dedge) => rows.edge(dedge),
            _ => unreachable!("a quarter has its corners on vertices and edges"),
        }
        rows.builder.end_row();
    }
    builder.finish()
}

struct Rows<'a, W> {
    level: &'a Level,
    options: &'a PlanOptions,
    builder: &'a mut StencilBuilder<W>,
    here: Neighbourhood,
}

impl<W: Weight> Rows<'_, W> {
    fn vertex(&mut self, vertex: VertexId) {
        let mesh = &self.level.mesh;
        if !self.level.is_plain() {
            self.here.load(self.level, vertex, self.options.creasing);
            let rules = self.here.rules();
            self.here.add_rules(rules, |n| masks::inner_vertex(n, self.options.loop_weights), masks::CREASE_VERTEX);
            self.here.finish_row(self.builder);
        } else if mesh.is_boundary_vertex(vertex) {
            self.builder.curve(mesh, vertex, masks::CREASE_VERTEX);
        } else {
            let mask = masks::inner_vertex(mesh.valence(vertex), self.options.loop_weights);
            self.builder.ring(vertex, mesh.ring(vertex), mask);
        }
    }

    fn edge(&mut self, dedge: DedgeId) {
        let mesh = &self.level.mesh;
        let ends = [mesh.origin(dedge), mesh.target(dedge)];
        let sharpness = self.level.edge_sharpness(dedge);
        let weight_sharp =
            if sharpness >= 1.0 || (sharpness > 0.0 && self.stays_sharp(dedge)) { 1.0 } else { f64::from(sharpness) };
        let apexes = mesh.twin(dedge).map(|twin| [mesh.origin(dedge.prev()), mesh.origin(twin.prev())]);
        match apexes {
            Some(apexes) if weight_sharp < 1.0 => {
                let blend = |smooth: f64, sharp: f64| weight_sharp * sharp + (1.0 - weight_sharp) * smooth;
                for (i, end) in ends.into_iter().enumerate() {
                    self.builder.entry(end.0, blend(masks::EDGE_POINT[i], masks::CREASE_POINT[i]));
                }
                for (i, apex) in apexes.into_iter().enumerate() {
                    self.builder.entry(apex.0, blend(masks::EDGE_POINT[2 + i], 0.0));
                }
            }
            _ => {
                for (end, weight) in ends.into_iter().zip(masks::CREASE_POINT) {
                    self.builder.entry(end.0, weight);
                }
            }
        }
    }

    /// Whether both halves of a semi-sharp edge are still sharp after the step: with Chaikin's rule they may be.
    fn stays_sharp(&mut self, dedge: DedgeId) -> bool {
        let mesh = &self.level.mesh;
        let (a, b) = (mesh.origin(dedge), mesh.target(dedge));
        [(a, b), (b, a)].into_iter().all(|(vertex, other)| {
            self.here.load(self.level, vertex, self.options.creasing);
            self.here.ring.iter().position(|&v| v == other.0).is_some_and(|edge| self.here.around.stays_sharp(edge))
        })
    }
}
