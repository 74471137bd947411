//! Breed to drawable parts: deform, evaluate, normals, colours, hashes.

mod canvas;
mod cap;
mod dyes;
mod eyeball;
mod eyelids;
mod folds;
mod layers;
mod mouth;
mod muscles;
mod parts;
mod pipeline;
mod skeleton;
mod skin;
mod uv;
mod values;
mod whiskers;
mod wrinkles;

pub use canvas::Canvas;
pub use eyeball::Eyeball;
pub use layers::{Layers, LayersError};
pub use parts::{Frame, Material, MaterialRange, Part, PartTopology, Revisions};
pub use pipeline::{MAX_LEVEL, Pipeline, PipelineError};
pub use skin::tags as skin_tags;
pub use uv::Uv;

/// One 64-bit FNV-1a hash over the bits of each stage of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StageHashes {
    /// Control positions of the skin, places of the eyes.
    pub control: u64,
    /// Positions of every part.
    pub positions: u64,
    /// Normals of every part.
    pub normals: u64,
    /// Indices of every part.
    pub indices: u64,
}
