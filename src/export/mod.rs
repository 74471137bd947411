//! Frames as files of other programs. Bytes out; who calls writes them to disk.

mod geometry;
mod glb;
mod materials;
pub mod motion;
mod textures;

pub use geometry::GeometryError;
pub use glb::{GlbError, GlbOptions, SCHEMA, to_glb};
pub use textures::{TEXTURE_SIZES, TextureError, Textures};
