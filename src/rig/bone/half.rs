//! The control mesh of a bone as baked: one half, mirrored when loaded.

use crate::mesh::{DedgeMesh, MeshError};
use crate::rig::mirror;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// Half of a bone's control mesh (x ≥ 0). The whole is that half, in its order, followed by the mirror images of its
/// vertices off the median plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoneHalf {
    /// Format version, 1.
    pub version: u32,
    /// Whether each vertex lies in the median plane.
    pub midline: Vec<bool>,
    /// Triangles, counter-clockwise seen from outside.
    pub faces: Vec<[u16; 3]>,
    /// Positions on the canonical skull, millimetres, head's frame.
    pub base: Vec<[f32; 3]>,
    /// Landmark id, vertex.
    pub landmarks: Vec<(String, u16)>,
}

impl BoneHalf {
    /// Connectivity of the whole mesh.
    ///
    /// # Errors
    /// Where it is not an oriented manifold.
    pub fn mesh(&self) -> Result<DedgeMesh, MeshError> {
        DedgeMesh::from_triangles(mirror::n_whole(&self.midline), &mirror::triangles(&self.midline, &self.faces))
    }

    /// Writes the whole mesh's positions from the half's.
    pub fn unfold(&self, half: &[Vec3], whole: &mut Vec<Vec3>) {
        mirror::unfold(&self.midline, half, whole);
    }
}
