//! Walks around a vertex, counter-clockwise.

use super::dedge::DedgeMesh;
use super::ids::{DedgeId, FaceId, VertexId};

/// The directed edges that start at a vertex, counter-clockwise; from the boundary one where there is one.
#[derive(Clone, Debug)]
pub struct OutgoingDedges<'a> {
    mesh: &'a DedgeMesh,
    start: DedgeId,
    here: Option<DedgeId>,
}

impl Iterator for OutgoingDedges<'_> {
    type Item = DedgeId;

    #[inline]
    fn next(&mut self) -> Option<DedgeId> {
        let here = self.here?;
        self.here = self.mesh.twin(here.prev()).filter(|&onward| onward != self.start);
        Some(here)
    }
}

/// The one-ring: the neighbours of a vertex, counter-clockwise.
///
/// On the boundary it starts at the next vertex along the boundary and ends at the one before, so that it has one
/// neighbour more than the vertex has triangles.
#[derive(Clone, Debug)]
pub struct Ring<'a> {
    dedges: OutgoingDedges<'a>,
    /// On the boundary: the last neighbour, which no outgoing directed edge leads to.
    last: Option<VertexId>,
}

impl Iterator for Ring<'_> {
    type Item = VertexId;

    #[inline]
    fn next(&mut self) -> Option<VertexId> {
        let Some(dedge) = self.dedges.next() else {
            return self.last.take();
        };
        let mesh = self.dedges.mesh;
        if mesh.is_boundary_dedge(dedge.prev()) {
            self.last = Some(mesh.origin(dedge.prev()));
        }
        Some(mesh.target(dedge))
    }
}

impl DedgeMesh {
    /// The directed edges that start at a vertex, counter-clockwise; on the boundary from the most clockwise one.
    #[inline]
    pub fn outgoing_dedges(&self, vertex: VertexId) -> OutgoingDedges<'_> {
        let start = self.outgoing(vertex);
        OutgoingDedges { mesh: self, start, here: Some(start) }
    }

    /// The triangles at a vertex, counter-clockwise; on the boundary from the most clockwise one.
    pub fn faces_around(&self, vertex: VertexId) -> impl Iterator<Item = FaceId> + '_ {
        self.outgoing_dedges(vertex).map(DedgeId::face)
    }

    /// The neighbours of a vertex, counter-clockwise; on the boundary from the next vertex along it to the one before.
    #[inline]
    pub fn ring(&self, vertex: VertexId) -> Ring<'_> {
        Ring { dedges: self.outgoing_dedges(vertex), last: None }
    }

    /// Number of edges at a vertex.
    pub fn valence(&self, vertex: VertexId) -> usize {
        self.ring(vertex).count()
    }
}
