//! Subdivision as a plan that is built once and evaluated every frame.
//!
//! Three lifetimes: a [`Plan`] is built when the control topology, its [`Tags`] or the [`PlanOptions`] change, and can be
//! shared; an [`Evaluator`] owns the buffers and lives as long as whoever draws; a [`Surface`] is borrowed from it for a
//! frame.
//!
//! Masks (weights from a neighbourhood, one file for each scheme, with its paper) and the splitting of faces (`thirds`,
//! `quarters`, `corners`, `dual_split`) are apart; `rows` brings them together into stencils.

mod adaptive;
mod batch;
pub mod butterfly;
pub mod catmull_clark;
mod corners;
mod crease_angle;
mod disk;
pub mod doo_sabin;
mod dual;
mod dual_split;
mod evaluate;
mod face_varying;
mod flatness;
mod kernels;
mod lane;
mod level;
mod limit;
mod lod;
pub mod loop_scheme;
mod mask;
mod neighbourhood;
mod normals;
mod patch_kernels;
mod plan;
mod prepare;
mod quarters;
mod refined;
mod register;
mod rows;
mod rule;
mod runs;
mod scheme;
mod seams;
mod shared_patches;
pub mod similarity;
pub mod sqrt3;
pub mod sqrt3_interpolating;
mod stencil;
mod steps;
mod tags;
mod team;
mod thirds;

pub use adaptive::Candidate;
pub use crease_angle::creases_by_angle;
pub use disk::PlanFileError;
pub use dual::{DualError, Rim, ThreeConnected};
pub use evaluate::{Evaluator, Surface, evaluate_once};
pub use face_varying::{FaceVaryingError, FaceVaryingPlan, UvLinear};
pub use flatness::flat_faces;
pub use limit::{LimitMask, LimitTable};
pub use lod::{Detail, DetailBounds, DetailError, DetailState, Geomorph, GeomorphError, mean_edge_length};
pub use mask::{CurveMask, RingMask};
pub use plan::{DoublePlan, MAX_FACES, Plan, PlanError};
pub use rule::Rule;
pub use scheme::{BoundaryRule, BoundaryStep, Creasing, LoopWeights, Normals, PlanOptions, Positions, Scheme};
pub use seams::SeamPlan;
pub use stencil::{Blend, StencilTable, Weight};
pub use steps::levels_of;
pub use tags::{INFINITE_SHARPNESS, TagError, Tags};
