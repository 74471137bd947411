//! What a made head is asked for: what a vet would measure, whether its skin folds, where its landmarks are, what is seen of
//! them.

mod calliper;
mod deviation;
mod folds;
mod landmarks;
mod percentile;
mod sight;

pub use calliper::{Calliper, Dimension, MeasureError, Measurement, SkullClass, Tissue, value};
pub use deviation::Deviation;
pub use folds::{Folds, FoldsError, MAY_FOLD};
pub use landmarks::{Landmark, Side, bone_landmarks, skin_landmarks};
pub use percentile::percentile;
pub use sight::{Eyepoint, Sight};
