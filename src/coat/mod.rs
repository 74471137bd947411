//! The coat: where each hair stands, how long it is there and which way it is combed.
//!
//! Lifetimes: [`Root`]s once per topology; the numbers of [`groom`] once per breed's look. What a hair looks like is worked
//! out where it is drawn, from these and from the skin as it is at that moment.

mod groom;
mod roots;

pub use groom::groom;
pub use roots::{MAX_STRANDS, Root, roots};

use crate::anatomy::Hair;
use glam::Vec3;

/// Names of numbers of strands.
pub const LEVELS: [(&str, usize); 4] = [("off", 0), ("low", 10_000), ("medium", 90_000), ("high", 250_000)];

/// The hair of one head, borrowed from who made it.
#[derive(Clone, Copy, Debug)]
pub struct Coat<'a> {
    /// The first so many of them are an even spread for every number.
    pub roots: &'a [Root],
    /// For each vertex of the skin: x length of hair, metres, 0 where there is none; y how far it stands off the skin, a
    /// factor; z how deep the place is hidden, 0 to 1.
    pub growth: &'a [Vec3],
    /// For each vertex of the skin what is to be added to the unit direction in which hair lies, head's frame.
    pub comb: &'a [Vec3],
    /// What is the same all over the head.
    pub hair: &'a Hair,
}
