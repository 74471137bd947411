//! What a made head is asked for: whether its skin folds, where its landmarks are, what is seen of them.

mod folds;
mod landmarks;
mod sight;

pub use folds::{Folds, FoldsError, MAY_FOLD};
pub use landmarks::{Landmark, Side, skin_landmarks};
pub use sight::{Eyepoint, Sight};
