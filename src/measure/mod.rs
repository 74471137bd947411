//! What a made head is asked for: whether its skin folds, where its landmarks are.

mod folds;

pub use folds::{Folds, FoldsError, MAY_FOLD};
