//! The buffers of one part.

use super::parts::{Part, PartTopology};
use super::uv::Uv;
use glam::Vec3;
use std::sync::Arc;

/// Values of one part.
#[derive(Clone, Debug)]
pub(super) struct Values {
    pub(super) topology: Arc<PartTopology>,
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    pub(super) colours: Vec<Vec3>,
    pub(super) surface: Vec<Vec3>,
    pub(super) flow: Vec<Vec3>,
    pub(super) rest: Vec<Vec3>,
    /// Where it has been asked for.
    pub(super) uv: Option<Uv>,
}

impl Values {
    pub(super) fn new(topology: PartTopology) -> Self {
        let zero = vec![Vec3::ZERO; topology.n_vertices];
        Self {
            topology: Arc::new(topology),
            positions: zero.clone(),
            normals: zero.clone(),
            colours: zero.clone(),
            surface: zero.clone(),
            flow: zero.clone(),
            rest: zero,
            uv: None,
        }
    }

    pub(super) fn part(&self) -> Part<'_> {
        Part {
            topology: &self.topology,
            positions: &self.positions,
            normals: &self.normals,
            colours: &self.colours,
            surface: &self.surface,
            flow: &self.flow,
            rest: &self.rest,
            uv: self.uv.as_ref(),
        }
    }
}
