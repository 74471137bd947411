//! Where the window gets its heads from.

use crate::anatomy::{Breed, ParamTable};
use crate::frame::Frame;
use std::sync::Arc;

/// Makes frames of breeds: the frame's pipeline, or a stand-in of a test.
pub trait Heads {
    /// Refines to another level from the next frame on.
    fn set_level(&mut self, level: u32) -> Result<(), String>;
    /// The head of a breed at this moment.
    fn update(&mut self, breed: &Breed) -> Frame<'_>;
}

/// Makes [`Heads`] for a table of measures and a level: at the start, and again when the table has changed on disk.
pub type MakeHeads = Box<dyn Fn(&Arc<ParamTable>, u32) -> Result<Box<dyn Heads>, String>>;
