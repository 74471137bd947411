//! The coat: where each hair stands, how long it is there, which way it is combed and which colour it has.
//!
//! Lifetimes: [`Root`]s and the [`Chart`] once per topology; the numbers of [`groom()`] and the [`Colours`] once per breed's
//! look. What a hair looks like is worked out where it is drawn, from these and from the skin as it is at that moment.

mod chart;
mod colours;
mod groom;
mod markings;
mod roots;

pub use chart::{Chart, Fibre, Site};
pub use colours::Colours;
pub use groom::groom;
pub use markings::Colouring;
pub use roots::{MAX_STRANDS, Root, roots};

use crate::anatomy::{Hair, Region};
use crate::mesh::VertexId;
use crate::rig::Rig;
use glam::Vec3;

/// Whether a region bears no hair.
fn is_bare(region: Region) -> bool {
    matches!(region, Region::Nose | Region::Nostril | Region::Lid | Region::Mouth)
}

/// For each control vertex whether it is bare and stands beside one that is not. The nose pad's rim and the fold of the
/// lids are such: hair comes up to them.
fn borders(rig: &Rig, regions: &[Region]) -> Vec<bool> {
    let beside_hair = |v: usize| rig.mesh().ring(VertexId(v as u32)).any(|u| !is_bare(regions[u.0 as usize]));
    regions.iter().enumerate().map(|(v, &region)| is_bare(region) && beside_hair(v)).collect()
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
    /// For each vertex of the skin: x length of hair, metres, 0 where there is none; y how far it stands off the skin, a
    /// factor; z how deep the place is hidden, 0 to 1.
    pub growth: &'a [Vec3],
    /// For each vertex of the skin what is to be added to the unit direction in which hair lies, head's frame.
    pub comb: &'a [Vec3],
    /// What is the same all over the head.
    pub hair: &'a Hair,
}
