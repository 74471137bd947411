//! Texture coordinates of parts, for who writes or paints them. They change with the topology alone, and a frame has them
//! only when asked: no picture needs them.

use super::parts::MaterialRange;
use super::{PipelineError, skin};
use crate::rig::{HEAD_UV, HalfUv, Rig};
use crate::subdiv::{Plan, SeamPlan};
use glam::Vec2;

/// A part with its vertices doubled along the seams of its texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Uv {
    /// For each vertex to draw the two vertices of the part that it lies in the middle of: nearly everywhere twice the
    /// same. Where the scheme has turned edges, a face across a seam is cut in two there.
    pub vertices: Vec<[u32; 2]>,
    /// Place in the texture of each vertex to draw, 0 to 1, from the top left, v downwards.
    pub coordinates: Vec<Vec2>,
    /// Three vertices to draw for each triangle, counter-clockwise from outside, sorted by material.
    pub indices: Vec<u32>,
    /// Cover `indices` as the part's own cover its own.
    pub ranges: Vec<MaterialRange>,
}

impl Uv {
    /// Of the skin.
    pub(super) fn of_skin(rig: &Rig, plan: &Plan) -> Result<Uv, PipelineError> {
        let half = rig.half();
        let (values, corners) = HalfUv::parse(HEAD_UV, half)?.corners(half);
        let seams = SeamPlan::build(plan, rig.mesh(), &skin::tags(rig), &corners, values.len())?;
        let (indices, ranges) = skin::by_material(rig, seams.indices(), seams.face_parent());
        let coordinates = seams.evaluate_uvs(&values);
        Ok(Uv { vertices: seams.render_vertices().to_vec(), coordinates, indices, ranges })
    }
}
