//! The coat: where each hair stands, how long it is there, which way it is combed and which colour it has.
//!
//! Lifetimes: [`Root`]s and the [`Chart`] once per topology; the numbers of [`groom()`] and the [`Colours`] once per breed's
//! look. What a hair looks like is worked out where it is drawn, from these and from the skin as it is at that moment.

mod chart;
mod colours;
mod condition;
mod groom;
mod markings;
mod roots;

pub use chart::{Chart, Fibre, Site};
pub use colours::Colours;
pub use condition::{CLIPPED, Condition, ConditionField};
pub use groom::{Groom, N_CHANNELS, groom};
pub use markings::Colouring;
pub use roots::{MAX_STRANDS, N_LEADERS, Root, n_rooted, roots};

use crate::anatomy::{Hair, Region};
use crate::mesh::VertexId;
use crate::rig::Rig;
use glam::Vec3;

/// For each control vertex whether it is bare and stands beside one that is not. The nose pad's rim and the fold of the
/// lids are such: hair comes up to them.
fn borders(rig: &Rig, regions: &[Region]) -> Vec<bool> {
    let beside_hair = |v: usize| rig.mesh().ring(VertexId(v as u32)).any(|u| !regions[u.0 as usize].is_bare());
    regions.iter().enumerate().map(|(v, &region)| region.is_bare() && beside_hair(v)).collect()
}

/// Names of numbers of strands.
pub const LEVELS: [(&str, usize); 4] = [("off", 0), ("low", 10_000), ("medium", 90_000), ("high", 250_000)];

/// The hair of one head, borrowed from who made it.
#[derive(Clone, Copy, Debug)]
pub struct Coat<'a> {
    /// The first so many of them are an even spread for every number.
    pub roots: &'a [Root],
    /// For each root the hair's own colour, linear.
    pub colours: &'a [Vec3],
    /// For each vertex of the skin.
    pub grooms: &'a [Groom],
    /// The breed's numbers.
    pub hair: &'a Hair,
    /// How much it is a puppy's, 0 to 1: short, soft and woolly.
    pub youth: f32,
}
