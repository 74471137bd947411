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
            for (beyond, weight) in self.here.onward(far.0) {
                let weight = weight * share * masks::CURVE_BEYOND;
                match beyond {
                    _ if weight == 0.0 => {}
                    Some(beyond) => self.add(VertexId(beyond), weight),
                    None => {
                        self.add(near, 2.0 * weight);
                        self.add(far, -weight);
                    }
                }
            }
        }
    }

    fn smooth(&mut self, dedge: DedgeId, share: f64) {
        let Some(twin) = self.level.mesh.twin(dedge) else { return };
        let [a, b] = [dedge, twin].map(|side| self.extraordinary_part(side));
        let regular = (1.0 - a) * (1.0 - b);
        if regular > 0.0 {
            self.eight_points(dedge, twin, share * regular);
        }
        // Of two extraordinary ends the mean.
        for (side, part) in [(dedge, a * (1.0 - 0.5 * b)), (twin, b * (1.0 - 0.5 * a))] {
            if part > 0.0 {
                self.around(side, share * part);
            }
        }
    }

    /// How far the origin of a side is extraordinary: inside the surface, with other than six neighbours, and not sharp.
    fn extraordinary_part(&self, side: DedgeId) -> f64 {
        let mesh = &self.level.mesh;
        let vertex = mesh.origin(side);
        if mesh.is_boundary_vertex(vertex) || mesh.valence(vertex) == 6 {
            return 0.0;
        }
        let sharpest = mesh.outgoing_dedges(vertex).map(|d| self.wall(d)).fold(0.0, f64::max);
        1.0 - sharpest
    }

    /// How little the other side of an edge counts: not at all where there is none or where a crease lies between.
    fn wall(&self, side: DedgeId) -> f64 {
        f64::from(self.level.edge_sharpness(side).min(1.0))
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
                let wall = self.wall(inner);
                if let Some(across) = mesh.twin(inner).filter(|_| wall < 1.0) {
                    self.add(mesh.origin(across.prev()), share * (1.0 - wall) * masks::WINGS);
                }
                if wall > 0.0 {
                    let weight = share * wall * masks::WINGS;
                    self.add(near, weight);
                    self.add(apex, weight);
                    self.add(far, -weight);
                }
            }
        }
    }
}
