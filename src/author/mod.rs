//! How the head's assets are made: patch language, first fit, bake.

mod atlas;
pub mod bake;
pub mod base;
pub mod bone;
mod limits;
mod nets;
mod packing;
pub mod patch;
mod skyline;
mod unwrap;
