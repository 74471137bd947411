//! One level of a triangle scheme while a plan is built: connectivity and what is sharp or frozen in it.

use crate::mesh::{DedgeId, DedgeMesh, VertexId};

use super::rule::Surroundings;

/// Sharpness of edges and vertices. Empty lists mean that nothing is sharp, which is how nearly all meshes are.
#[derive(Clone, Debug, Default)]
pub(super) struct Sharpness {
    /// One for each directed edge, the same for both sides of an edge; or none at all.
    pub(super) dedges: Vec<f32>,
    /// One for each vertex, or none at all; vertices beyond the end are not sharp.
    pub(super) vertices: Vec<f32>,
}

impl Sharpness {
    pub(super) fn is_empty(&self) -> bool {
        self.dedges.is_empty() && self.vertices.is_empty()
    }

    pub(super) fn dedge(&self, dedge: DedgeId) -> f32 {
        self.dedges.get(dedge.index()).copied().unwrap_or(0.0)
    }

    pub(super) fn vertex(&self, vertex: VertexId) -> f32 {
        self.vertices.get(vertex.index()).copied().unwrap_or(0.0)
    }
}

/// A mesh in the making. Its frozen faces stand behind the others.
#[derive(Clone, Debug)]
pub(super) struct Level {
    pub(super) mesh: DedgeMesh,
    pub(super) sharpness: Sharpness,
    /// Faces from this one on are frozen.
    pub(super) n_active: u32,
    /// For each control vertex whether it belongs to a frozen face; vertices beyond the end do not. Shared by all
    /// levels, since old vertices keep their numbers.
    pub(super) fixed: Vec<bool>,
}

impl Level {
    /// Whether nothing is tagged: the short ways are open then.
    #[inline(always)]
    pub(super) fn is_plain(&self) -> bool {
        self.sharpness.is_empty() && self.fixed.is_empty()
    }

    pub(super) fn is_fixed(&self, vertex: VertexId) -> bool {
        self.fixed.get(vertex.index()).copied().unwrap_or(false)
    }

    pub(super) fn is_frozen_dedge(&self, dedge: DedgeId) -> bool {
        dedge.0 >= 3 * self.n_active
    }

    /// Sharpness of an edge: infinite on the boundary.
    pub(super) fn edge_sharpness(&self, dedge: DedgeId) -> f32 {
        if self.mesh.is_boundary_dedge(dedge) { f32::INFINITY } else { self.sharpness.dedge(dedge) }
    }

    /// Whether √3 leaves the edge where it is instead of turning it: a boundary, a crease, the rim of a frozen region.
    #[inline(always)]
    pub(super) fn is_open(&self, dedge: DedgeId) -> bool {
        match self.mesh.twin(dedge) {
            None => true,
            Some(_) if self.is_plain() => false,
            Some(twin) => {
                self.sharpness.dedge(dedge) > 0.0 || self.is_frozen_dedge(twin) != self.is_frozen_dedge(dedge)
            }
        }
    }

    /// Whether √3 cuts the edge in three in a step that does so: an open one, but for those of frozen faces.
    #[inline(always)]
    pub(super) fn is_divisible(&self, dedge: DedgeId) -> bool {
        self.is_open(dedge)
            && !self.is_frozen_dedge(dedge)
            && self.mesh.twin(dedge).is_none_or(|twin| !self.is_frozen_dedge(twin))
    }

    /// The sharpness of everything around a vertex, in ring order.
    pub(super) fn surroundings(&self, vertex: VertexId, into: &mut Surroundings) {
        into.clear();
        into.vertex = self.sharpness.vertex(vertex);
        for dedge in self.mesh.outgoing_dedges(vertex) {
            into.edges.push(self.edge_sharpness(dedge));
            if self.mesh.is_boundary_dedge(dedge.prev()) {
                into.edges.push(f32::INFINITY);
            }
        }
    }
}
