//! Arithmetic that gives the same bits everywhere, and the named spaces.

pub mod fnv;
pub mod frames;
pub mod noise;
pub mod ops;
pub mod rng;
