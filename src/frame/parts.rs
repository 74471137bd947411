//! What a frame lends out: the drawable parts of one head.
//!
//! Lifetimes: [`PartTopology`] changes with the level of subdivision only, the value slices of a [`Part`] whenever the
//! breed or its look does. [`Revisions`] says which, so that a consumer uploads what moved and nothing else.

use super::eyeball::Eyeball;
use super::uv::Uv;
use crate::coat::Coat;
use crate::rig::whiskers::Whisker;
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
    /// The white of the eye.
    Sclera,
    /// The coloured ring, under the cornea.
    Iris,
    /// The opening in it.
    Pupil,
    /// What closes the neck.
    Cap,
    /// Skull and mandible.
    Bone,
    /// Crowns of the teeth.
    Tooth,
    /// Gums, palate and floor of the mouth.
    Gum,
    /// Tongue.
    Tongue,
    /// The third eyelid.
    ThirdEyelid,
    /// The line of tears along the lower lid.
    Tears,
    /// Whiskers.
    Whisker,
    /// Muscle.
    Muscle,
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
    /// One of those that [`Frame::parts`] lists; unique in a frame; letters, digits and `_`.
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
    /// Where each vertex lies on the base head, metres: what is to stay in place on the surface whatever the head does is a
    /// function of it. Zero where nothing is.
    pub rest: &'a [Vec3],
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
    /// Colours, surface qualities, length and direction of hair.
    pub look: u64,
}

/// Everything visible of one head at one moment, borrowed from the pipeline that made it.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// In the written order, those of the layers that are shown: `skin`, `neck_cap`; `eye_L`, `eye_R`, `third_eyelid_L`,
    /// `third_eyelid_R`, `tears_L`, `tears_R`; `whiskers`; `muscles`; `skull`, `mandible`; `teeth_upper`, `teeth_lower`; `gums_upper`
    /// with the palate, `gums_lower` with the floor of the mouth; `tongue`.
    pub parts: Vec<Part<'a>>,
    /// Control positions of the skin, metres; length: control vertices.
    pub control: &'a [Vec3],
    /// Triangles of the control mesh, for drawing it as lines.
    pub control_indices: &'a [u32],
    /// The plan of the first part; none where that is no skin.
    pub plan: Option<&'a Plan>,
    /// Whether the plan makes just the positions and normals of the first part from `control`, for who would evaluate it
    /// once more: folds and wrinkles are beside it.
    pub is_planned: bool,
    /// Whiskers, the left ones, then their mirror images; empty where they are not shown.
    pub whiskers: &'a [Whisker],
    /// What a picture is to know of the eyeballs beside their meshes, the left one first; empty where they are not shown.
    pub eyes: &'a [Eyeball],
    /// Hair on the first part; none where that is no skin. Its roots are as many as have been asked for.
    pub coat: Option<Coat<'a>>,
    /// What has changed since the last frame.
    pub revisions: Revisions,
}

impl<'a> Frame<'a> {
    /// Every part but the whiskers, which neither fill a picture nor hide what lies behind them; where there is nothing
    /// else, those.
    pub fn body(&self) -> impl Iterator<Item = &Part<'a>> + Clone {
        let is_whisker = |part: &Part<'_>| part.topology.ranges.iter().all(|r| r.material == Material::Whisker);
        let all = self.parts.iter().all(is_whisker);
        self.parts.iter().filter(move |part| all || !is_whisker(part))
    }

    /// Points around which a picture is framed, metres: the [body](Frame::body), and about how far its hair reaches where it
    /// has some.
    pub fn outline(&self) -> Vec<Vec3> {
        let mut points: Vec<Vec3> = self.body().flat_map(|p| p.positions).copied().collect();
        if let (Some(coat), Some(skin)) = (self.coat.filter(|coat| !coat.roots.is_empty()), self.parts.first()) {
            for (v, groom) in coat.grooms.iter().enumerate() {
                let along = skin.flow[v].normalize_or_zero() * 0.3 + skin.normals[v] * 0.5;
                points.push(skin.positions[v] + along * groom.length);
            }
        }
        points
    }

    /// Lowest and highest corner of the [body](Frame::body), metres.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        let all = self.body().flat_map(|p| p.positions.iter());
        all.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), &p| (lo.min(p), hi.max(p)))
    }

    /// Triangles over all parts.
    pub fn n_triangles(&self) -> usize {
        self.parts.iter().map(|p| p.topology.indices.len() / 3).sum()
    }
}
