//! Rows of the modified butterfly.

use crate::mesh::{DedgeId, VertexId};

use crate::subdiv::butterfly as masks;
use crate::subdiv::level::Level;
use crate::subdiv::neighbourhood::Neighbourhood;
use crate::subdiv::refined::{Refined, VertexParent};
use crate::subdiv::scheme::Creasing;
use crate::subdiv::stencil::{StencilBuilder, StencilTable, Weight};

/// One row for each vertex of the child.
pub(in crate::subdiv) fn table<W: Weight>(level: &Level, child: &Refined, creasing: Creasing) -> StencilTable<W> {
    let mesh = &level.mesh;
    let n_entries = mesh.n_vertices() + 8 * (child.parents.len() - mesh.n_vertices());
    let mut builder = StencilTable::builder(mesh.n_vertices(), child.parents.len(), n_entries);
    let mut rows = Rows { level, creasing, builder: &mut builder, here: Neighbourhood::default(), row: Vec::new() };
    for &parent in &child.parents {
        match parent {
            VertexParent::Vertex(vertex) => rows.builder.entry(vertex.0, 1.0),
            VertexParent::Edge(dedge) => rows.edge(dedge),
            _ => unreachable!("a quarter has its corners on vertices and edges"),
        }
        rows.builder.end_row();
    }
    builder.finish()
}

struct Rows<'a, W> {
    level: &'a Level,
    creasing: Creasing,
    builder: &'a mut StencilBuilder<W>,
    here: Neighbourhood,
    /// The row in the making: a vertex can come into it in several ways.
    row: Vec<(u32, f64)>,
}

impl<W: Weight> Rows<'_, W> {
    fn edge(&mut self, dedge: DedgeId) {
        let sharpness = self.level.edge_sharpness(dedge);
        let sharp = f64::from(sharpness.min(1.0));
        self.row.clear();
        if sharp > 0.0 {
            self.curve(dedge, sharp);
        }
        if sharp < 1.0 {
            self.smooth(dedge, 1.0 - sharp);
        }
        for &(source, weight) in &self.row {
            if weight != 0.0 {
                self.builder.entry(source, weight);
            }
        }
    }

    fn add(&mut self, source: VertexId, weight: f64) {
        match self.row.iter_mut().find(|(s, _)| *s == source.0) {
            Some((_, sum)) => *sum += weight,
            None => self.row.push((source.0, weight)),
        }
    }

    /// Four points of the curve; beyond an end of it the mirror image.
    fn curve(&mut self, dedge: DedgeId, share: f64) {
        let mesh = &self.level.mesh;
        let (a, b) = (mesh.origin(dedge), mesh.target(dedge));
        for end in [a, b] {
            self.add(end, share * masks::CURVE_ENDS);
        }
        for (near, far) in [(a, b), (b, a)] {
            self.here.load(self.level, near, self.creasing);
            match self.here.onward(far.0) {
                Some(beyond) => self.add(VertexId(beyond), share * masks::CURVE_BEYOND),
                None => {
                    self.add(near, 2.0 * share * masks::CURVE_BEYOND);
                    self.add(far, -share * masks::CURVE_BEYOND);
                }
            }
        }
    }

    fn smooth(&mut self, dedge: DedgeId, share: f64) {
        let Some(twin) = self.level.mesh.twin(dedge) else { return };
        let extraordinary = [dedge, twin].map(|side| self.is_extraordinary(side));
        let n = extraordinary.iter().filter(|e| **e).count();
        if n == 0 {
            return self.eight_points(dedge, twin, share);
        }
        for (side, _) in [dedge, twin].into_iter().zip(extraordinary).filter(|(_, is)| *is) {
            self.around(side, share / n as f64);
        }
    }

    /// Whether the origin of a side is inside the surface, on no crease, and has not six neighbours.
    fn is_extraordinary(&mut self, side: DedgeId) -> bool {
        let mesh = &self.level.mesh;
        let vertex = mesh.origin(side);
        let on_curve = mesh.outgoing_dedges(vertex).any(|d| self.is_wall(d)) || mesh.is_boundary_vertex(vertex);
        !on_curve && mesh.valence(vertex) != 6
    }

    /// Whether the other side of an edge does not count: there is none, or a crease lies between.
    fn is_wall(&self, side: DedgeId) -> bool {
        self.level.edge_sharpness(side) >= 1.0
    }

    /// The mask of the extraordinary vertex at the origin of a side.
    fn around(&mut self, side: DedgeId, share: f64) {
        let mesh = &self.level.mesh;
        let n = mesh.valence(mesh.origin(side));
        self.add(mesh.origin(side), share * masks::EXTRAORDINARY_CENTRE);
        let mut here = side;
        for j in 0..n {
            self.add(mesh.target(here), share * masks::extraordinary(n, j));
            match mesh.twin(here.prev()) {
                Some(onward) => here = onward,
                None => break,
            }
        }
    }

    fn eight_points(&mut self, dedge: DedgeId, twin: DedgeId, share: f64) {
        let mesh = &self.level.mesh;
        let ends = [mesh.origin(dedge), mesh.target(dedge)];
        ends.into_iter().for_each(|end| self.add(end, share * masks::ENDS));
        for side in [dedge, twin] {
            self.add(mesh.origin(side.prev()), share * masks::APEXES);
        }
        for side in [dedge, twin] {
            let apex = mesh.origin(side.prev());
            // Across the side that leads to the apex, and across the one that comes from it.
            for (inner, near, far) in [
                (side.next(), mesh.target(side), mesh.origin(side)),
                (side.prev(), mesh.origin(side), mesh.target(side)),
            ] {
                let weight = share * masks::WINGS;
                match mesh.twin(inner) {
                    Some(across) if !self.is_wall(inner) => self.add(mesh.origin(across.prev()), weight),
                    _ => {
                        self.add(near, weight);
                        self.add(apex, weight);
                        self.add(far, -weight);
                    }
                }
            }
        }
    }
}
