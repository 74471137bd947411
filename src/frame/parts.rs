//! What a frame lends out: the drawable parts of one head.
//!
//! Lifetimes: [`PartTopology`] changes with the level of subdivision only, the value slices of a [`Part`] whenever the
//! breed or its look does. [`Revisions`] says which, so that a consumer uploads what moved and nothing else.

use super::uv::Uv;
use crate::subdiv::Plan;
use glam::Vec3;
use std::sync::Arc;

/// What a face is made of. One glTF material and one shading branch each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Material {
    /// Haired skin.
    Coat,
    /// The hairless, moist nose pad.
    Nose,
    /// Pigmented bare margins of lips and lids.
    Lip,
    /// The lining of the mouth.
    Mouth,
    /// The eyeball: sclera, iris, pupil, cornea.
    Eye,
    /// The flat cap that closes the neck.
    Cap,
    /// Skull and mandible.
    Bone,
    /// Crowns of the teeth.
    Tooth,
}

/// A run of indices with one material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaterialRange {
    /// What the run is made of.
    pub material: Material,
    /// First index of the run, a multiple of three.
    pub start: u32,
    /// Number of indices in the run, a multiple of three.
    pub count: u32,
}

/// The part of a [`Part`] that stays while only values change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PartTopology {
    /// `skin`, `neck_cap`, `eye_L`, `eye_R`, `skull`, `mandible`, `teeth_upper` or `teeth_lower`; unique in a frame; letters, digits and `_`.
    pub name: &'static str,
    /// Number of vertices: the length of every value slice of the part.
    pub n_vertices: usize,
    /// Three per triangle, counter-clockwise seen from outside, sorted by material.
    pub indices: Vec<u32>,
    /// Cover `indices` without gaps, in order, each material at most once.
    pub ranges: Vec<MaterialRange>,
}

/// One drawable mesh. Every slice has `topology.n_vertices` elements.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Names, indices, materials.
    pub topology: &'a Arc<PartTopology>,
    /// Metres, in the head's frame (+X the dog's left, +Y up, +Z out of the nose).
    pub positions: &'a [Vec3],
    /// Unit length, outward.
    pub normals: &'a [Vec3],
    /// Linear RGB albedo, each 0 to 1.
    pub colours: &'a [Vec3],
    /// Surface qualities, each 0 to 1: x fur (0 bare, 1 haired), y gloss (0 dry, 1 wet), z occlusion (0 open, 1 hidden).
    pub surface: &'a [Vec3],
    /// Direction in which hair lies, in the head's frame; not unit, not exactly tangent; zero where there is none.
    pub flow: &'a [Vec3],
    /// Where the part has a texture's layout and it has been asked for.
    pub uv: Option<&'a Uv>,
}

/// Counters that grow when the thing they name has changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Revisions {
    /// Indices, names, vertex counts.
    pub topology: u64,
    /// Positions, normals, flow.
    pub shape: u64,
    /// Colours and surface qualities.
    pub look: u64,
}

/// Everything visible of one head at one moment, borrowed from the pipeline that made it.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// In the written order, those of the layers that are shown: skin, `neck_cap`, `eye_L`, `eye_R`, `skull`, `mandible`,
    /// `teeth_upper`, `teeth_lower`.
    pub parts: Vec<Part<'a>>,
    /// Control positions of the skin, metres; length: control vertices.
    pub control: &'a [Vec3],
    /// Triangles of the control mesh, for drawing it as lines.
    pub control_indices: &'a [u32],
    /// The plan that makes the positions and normals of the first part from `control`, for who would evaluate it once
    /// more; none where there is no such plan.
    pub plan: Option<&'a Plan>,
    /// What has changed since the last frame.
    pub revisions: Revisions,
}

impl Frame<'_> {
    /// Lowest and highest corner over all parts, metres.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let all = self.parts.iter().flat_map(|p| p.positions.iter());
        all.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), &p| (lo.min(p), hi.max(p)))
    }

    /// Triangles over all parts.
    pub fn n_triangles(&self) -> usize {
        self.parts.iter().map(|p| p.topology.indices.len() / 3).sum()
    }
}
