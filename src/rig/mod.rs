//! The head: control mesh, landmarks, and the function from measures to control positions.
//!
//! Definition and state are apart: a [`Rig`] is loaded once and shared, what changes with a breed is in [`Deformed`].

mod control;
pub mod deform;
pub mod handles;
pub mod implicit;
mod lanes;
mod proportions;

pub use control::{ControlError, HalfMesh, HalfRings};
pub use handles::Handles;
pub use proportions::{EarProportions, Measures, Proportions};
