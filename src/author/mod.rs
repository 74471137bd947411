//! How the head's assets are made: patch language, first fit, bake.

pub mod bake;
pub mod base;
pub mod bone;
mod nets;
pub mod patch;
