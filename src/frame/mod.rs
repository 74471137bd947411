//! Breed to drawable parts: deform, evaluate, normals, colours, hashes.

mod parts;

pub use parts::{Frame, Material, MaterialRange, Part, PartTopology, Revisions};
