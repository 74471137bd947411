//! Rows of Catmull-Clark.

use crate::mesh::{DedgeId, FaceId, VertexId};

use crate::subdiv::catmull_clark as masks;
use crate::subdiv::corners::{PolygonLevel, RefinedPolygons};
use crate::subdiv::mask::RingMask;
use crate::subdiv::neighbourhood::Neighbourhood;
use crate::subdiv::scheme::Creasing;
use crate::subdiv::stencil::{StencilBuilder, StencilTable, Weight};

/// One row for each vertex of the child.
pub(in crate::subdiv) fn table<W: Weight>(
    level: &PolygonLevel,
    child: &RefinedPolygons,
    creasing: Creasing,
) -> StencilTable<W> {
    let mesh = &level.mesh;
    let n_rows = child.mesh.n_vertices();
    let mut builder = StencilTable::builder(mesh.n_vertices(), n_rows, 6 * n_rows);
    let mut rows = Rows { level, creasing, builder: &mut builder, here: Neighbourhood::default(), row: Vec::new() };
    for vertex in mesh.vertices() {
        rows.vertex(vertex);
        rows.write();
    }
    for &dedge in &child.edges {
        rows.edge(dedge);
        rows.write();
    }
    for face in mesh.faces() {
        rows.add_face(face, 1.0);
        rows.write();
    }
    builder.finish()
}

struct Rows<'a, W> {
    level: &'a PolygonLevel,
    creasing: Creasing,
    builder: &'a mut StencilBuilder<W>,
    here: Neighbourhood,
    /// The row in the making: a vertex comes into it by several faces.
    row: Vec<(u32, f64)>,
}

impl<W: Weight> Rows<'_, W> {
    fn add(&mut self, source: u32, weight: f64) {
        match self.row.iter_mut().find(|(s, _)| *s == source) {
            Some((_, sum)) => *sum += weight,
            None => self.row.push((source, weight)),
        }
    }

    fn add_face(&mut self, face: FaceId, weight: f64) {
        let corners = self.level.mesh.corners(face);
        let weight = weight / corners.len() as f64;
        if self.row.is_empty() {
            // A face alone has no corner twice.
            self.row.extend(corners.iter().map(|&corner| (corner, weight)));
        } else {
            corners.iter().for_each(|&corner| self.add(corner, weight));
        }
    }

    fn write(&mut self) {
        for (source, weight) in self.row.drain(..) {
            if weight != 0.0 {
                self.builder.entry(source, weight);
            }
        }
        self.builder.end_row();
    }

    fn vertex(&mut self, vertex: VertexId) {
        let mesh = &self.level.mesh;
        self.here.load_polygons(self.level, vertex, self.creasing);
        let rules = self.here.rules();
        let smooth = [(rules.now, rules.weight_now), (rules.next, 1.0 - rules.weight_now)]
            .into_iter()
            .filter(|(rule, _)| rule.is_smooth())
            .map(|(_, weight)| weight)
            .sum::<f64>();
        self.row.push((vertex.0, 0.0));
        if smooth > 0.0 {
            let n = self.here.ring.len();
            let [centre, neighbour, around] = masks::inner_vertex(n);
            self.add(vertex.0, smooth * centre);
            for i in 0..n {
                self.add(self.here.ring[i], smooth * neighbour);
            }
            let faces: Vec<FaceId> = mesh.outgoing_dedges(vertex).map(|d| mesh.face(d)).collect();
            faces.into_iter().for_each(|face| self.add_face(face, smooth * around));
        }
        if smooth < 1.0 {
            // The smooth part stands in the row already.
            let none = |_| RingMask { centre: 0.0, neighbour: 0.0 };
            self.here.add_rules(rules, none, masks::CREASE_VERTEX);
            let entries: Vec<_> = self.here.entries().collect();
            entries.into_iter().for_each(|(source, weight)| self.add(source, weight));
        }
    }

    fn edge(&mut self, dedge: DedgeId) {
        let mesh = &self.level.mesh;
        let ends = [mesh.origin(dedge), mesh.target(dedge)];
        let sharpness = self.level.edge_sharpness(dedge);
        let sharp =
            if sharpness >= 1.0 || (sharpness > 0.0 && self.stays_sharp(ends)) { 1.0 } else { f64::from(sharpness) };
        let [end, face] = masks::EDGE_POINT;
        for (vertex, crease) in ends.into_iter().zip(masks::CREASE_POINT) {
            self.add(vertex.0, sharp * crease + (1.0 - sharp) * end);
        }
        if sharp < 1.0
            && let Some(twin) = mesh.twin(dedge)
        {
            for side in [dedge, twin] {
                self.add_face(mesh.face(side), (1.0 - sharp) * face);
            }
        }
    }

    /// Whether both halves of a semi-sharp edge are still sharp after the step: with Chaikin's rule they may be.
    fn stays_sharp(&mut self, [a, b]: [VertexId; 2]) -> bool {
        [(a, b), (b, a)].into_iter().all(|(vertex, other)| {
            self.here.load_polygons(self.level, vertex, self.creasing);
            self.here.ring.iter().position(|&v| v == other.0).is_some_and(|edge| self.here.around.stays_sharp(edge))
        })
    }
}
