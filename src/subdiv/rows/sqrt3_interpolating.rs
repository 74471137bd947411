//! Rows of interpolating √3.

use crate::mesh::{DedgeId, DedgeMesh, FaceId, VertexId};

use crate::subdiv::refined::{Refined, VertexParent};
use crate::subdiv::sqrt3_interpolating as masks;
use crate::subdiv::stencil::{StencilBuilder, StencilTable, Weight};

/// One row for each vertex of the child.
pub(in crate::subdiv) fn table<W: Weight>(mesh: &DedgeMesh, child: &Refined) -> StencilTable<W> {
    let n_entries = mesh.n_vertices() + 12 * (child.parents.len() - mesh.n_vertices());
    let mut builder = StencilTable::builder(mesh.n_vertices(), child.parents.len(), n_entries);
    let mut rows = Rows { mesh, builder: &mut builder, row: Vec::new() };
    for &parent in &child.parents {
        match parent {
            VertexParent::Vertex(vertex) => rows.builder.entry(vertex.0, 1.0),
            VertexParent::Face(face) => rows.face(face),
            VertexParent::FirstThird(dedge) => rows.third(dedge, false),
            VertexParent::SecondThird(dedge) => rows.third(dedge, true),
            VertexParent::Edge(_) => unreachable!("√3 puts no vertex into the middle of an edge"),
        }
        rows.builder.end_row();
    }
    builder.finish()
}

struct Rows<'a, W> {
    mesh: &'a DedgeMesh,
    builder: &'a mut StencilBuilder<W>,
    /// The row in the making: a vertex can come into it in several ways.
    row: Vec<(u32, f64)>,
}

impl<W: Weight> Rows<'_, W> {
    fn add(&mut self, source: VertexId, weight: f64) {
        match self.row.iter_mut().find(|(s, _)| *s == source.0) {
            Some((_, sum)) => *sum += weight,
            None => self.row.push((source.0, weight)),
        }
    }

    fn write(&mut self) {
        for (source, weight) in self.row.drain(..) {
            if weight != 0.0 {
                self.builder.entry(source, weight);
            }
        }
    }

    fn face(&mut self, face: FaceId) {
        let mesh = self.mesh;
        let sides = [0, 1, 2].map(|k| face.dedge(k));
        let extraordinary = sides.into_iter().filter(|&side| self.is_extraordinary(mesh.origin(side)));
        let extraordinary: Vec<_> = extraordinary.collect();
        if !extraordinary.is_empty() {
            for &side in &extraordinary {
                self.around(side, 1.0 / extraordinary.len() as f64);
            }
            return self.write();
        }
        let boundary = sides.map(|side| mesh.is_boundary_dedge(side));
        match boundary.iter().filter(|b| **b).count() {
            0 => self.regular(sides),
            1 => {
                let side = sides[boundary.iter().position(|b| *b).unwrap_or(0)];
                let [apex, end, across] = masks::ONE_SIDE;
                self.add(mesh.origin(side.prev()), apex);
                self.add(mesh.origin(side), end);
                self.add(mesh.target(side), end);
                for inner in [side.next(), side.prev()] {
                    let corner = mesh.twin(inner).map(|twin| mesh.origin(twin.prev()));
                    self.add(corner.unwrap_or(mesh.origin(inner)), across);
                }
            }
            2 => {
                // The inner side lies opposite the corner that the boundary sides share.
                let inner = sides[boundary.iter().position(|b| !*b).unwrap_or(0)];
                let [shared, other, across] = masks::TWO_SIDES;
                self.add(mesh.origin(inner.prev()), shared);
                self.add(mesh.origin(inner), other);
                self.add(mesh.target(inner), other);
                if let Some(twin) = mesh.twin(inner) {
                    self.add(mesh.origin(twin.prev()), across);
                }
            }
            _ => sides.into_iter().for_each(|side| self.add(mesh.origin(side), 1.0 / 3.0)),
        }
        self.write();
    }

    fn is_extraordinary(&self, vertex: VertexId) -> bool {
        !self.mesh.is_boundary_vertex(vertex) && self.mesh.valence(vertex) != 6
    }

    /// The twelve-point mask; a corner that is missing completes a parallelogram.
    fn regular(&mut self, sides: [DedgeId; 3]) {
        let mesh = self.mesh;
        sides.into_iter().for_each(|side| self.add(mesh.origin(side), masks::CORNERS));
        for side in sides {
            let Some(twin) = mesh.twin(side) else { continue };
            let apex = mesh.origin(twin.prev());
            self.add(apex, masks::ACROSS);
            for (outer, near, far) in [
                (twin.next(), mesh.target(twin), mesh.origin(twin)),
                (twin.prev(), mesh.origin(twin), mesh.target(twin)),
            ] {
                match mesh.twin(outer) {
                    Some(beyond) => self.add(mesh.origin(beyond.prev()), masks::BEYOND),
                    None => {
                        self.add(near, masks::BEYOND);
                        self.add(apex, masks::BEYOND);
                        self.add(far, -masks::BEYOND);
                    }
                }
            }
        }
    }

    /// The mask of the extraordinary vertex at the origin of a side of the face.
    fn around(&mut self, side: DedgeId, share: f64) {
        let mesh = self.mesh;
        let n = mesh.valence(mesh.origin(side));
        self.add(mesh.origin(side), share * masks::extraordinary_centre(n));
        // The ring must start and end with the corners of the face: counter-clockwise from the second of them.
        let mut here = side.prev();
        for i in 0..n {
            // `here` arrives from the neighbour.
            self.add(mesh.origin(here), share * masks::extraordinary(n, i));
            match mesh.twin(here) {
                Some(leaving) => here = leaving.prev(),
                None => break,
            }
        }
    }

    /// At a third of a side that is cut, from its origin or, if `reversed`, from its target.
    fn third(&mut self, dedge: DedgeId, reversed: bool) {
        let mesh = self.mesh;
        let (a, b) = (mesh.origin(dedge), mesh.target(dedge));
        let after = mesh.target(mesh.outgoing(b));
        let before = mesh.ring(a).last().unwrap_or(b);
        let points = if reversed { [after, b, a, before] } else { [before, a, b, after] };
        for (point, weight) in points.into_iter().zip(masks::BOUNDARY_POINT) {
            self.add(point, weight);
        }
        self.write();
    }
}
