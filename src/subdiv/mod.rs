//! Subdivision as a plan that is built once and evaluated every frame.
//!
//! Three lifetimes: a [`Plan`] is built when the control topology, the scheme or the depth changes, and can be shared;
//! an [`Evaluator`] owns the buffers and lives as long as whoever draws; a [`Surface`] is borrowed from it for a frame.
//!
//! Masks (weights from a neighbourhood) and the splitting of faces are apart: `sqrt3.rs` and `refine.rs`.

mod evaluate;
mod lane;
mod mask;
mod normals;
mod plan;
mod refine;
mod runs;
mod scheme;
pub mod sqrt3;
mod stencil;

pub use evaluate::{Evaluator, Surface, evaluate_once};
pub use mask::{CurveMask, RingMask};
pub use plan::{MAX_FACES, Plan, PlanError};
pub use refine::{Refined, VertexParent, refine};
pub use scheme::{BoundaryStep, Scheme};
pub use stencil::{Blend, StencilTable, Weight};
