//! Londra: a real-time, parametric, expressive dog's head.
//!
//! Modules are layers that may only look down; `tests/layering.rs` guards the arrows and `ARCHITECTURE.md` draws them.

pub mod io;
pub mod math;
pub mod mesh;
pub mod subdiv;

#[cfg(feature = "head")]
pub mod anatomy;
#[cfg(feature = "head")]
pub mod author;
#[cfg(feature = "head")]
pub mod coat;
#[cfg(feature = "head")]
pub mod export;
#[cfg(feature = "head")]
pub mod frame;
#[cfg(feature = "head")]
pub mod measure;
#[cfg(feature = "head")]
pub mod motion;
#[cfg(feature = "head")]
pub mod rig;

#[cfg(feature = "graphics")]
pub mod app;
#[cfg(feature = "graphics")]
pub mod cli;
#[cfg(feature = "graphics")]
pub mod render;
