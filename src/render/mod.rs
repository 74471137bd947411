//! A frame drawn with wgpu: to pixels in memory or to a texture of the window, by the same passes.
//!
//! Objects by lifetime: [`Gpu`] once per run; [`Painter`] (pipelines and the head's buffers) once per device;
//! [`Targets`] once per picture size; a [`Camera`] and a [`Drawing`] for each picture.

mod arrow;
mod atlas;
pub mod camera;
mod globals;
mod gpu;
mod ground_pass;
mod head_buffers;
mod lights;
mod mesh_pass;
mod noise;
mod offscreen;
mod painter;
pub mod picture;
mod preset;
mod samples;
mod shader_source;
mod shadow_pass;
mod sheet;
mod sky;
mod strand_pass;
mod subdivide_pass;
mod targets;
mod text;
mod wire_pass;

pub use arrow::arrow;
pub use atlas::{PAPER, Section, Strip, atlas};
pub use camera::{Camera, Lens, View, ViewError};
pub use gpu::{Gpu, GpuError};
pub use ground_pass::Background;
pub use mesh_pass::Quality;
pub use offscreen::{DrawError, Offscreen};
pub use painter::{Aside, Drawing, Painter, Shading, Stage};
pub use picture::Picture;
pub use preset::{Preset, PresetError};
pub use samples::{Samples, SamplesError};
pub use shader_source::{ShaderError, ShaderFile, ShaderSources};
pub use sheet::{Dress, Sheet};
pub use subdivide_pass::{PlanBuffers, SubdividePass};
pub use targets::Targets;
