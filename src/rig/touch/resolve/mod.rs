//! What is done about contacts: lips go outwards, off the teeth; the tongue is lifted, lowered or made narrow between them;
//! the jaw closes no farther than teeth let it.
//!
//! Only what is deeper than as the dog was bred counts, at rest and while its jaw opens straight: a pose at rest changes no
//! bit, and teeth that shear past each other do not keep a mouth open.

mod jaw;
mod lips;
mod tongue;

pub use jaw::{free_jaw, least_gape};
pub use lips::free_lips;
pub use tongue::{KNOTS, TongueShift, free_tongue};

use super::push::Push;
use crate::math::ops;
use glam::Vec3;

/// What is left in contact no deeper than this counts as touching, not as going through: canonical millimetres.
const ENOUGH: f32 = 0.02;

/// Buffers of a resolution: made once, written again.
#[derive(Clone, Debug, Default)]
pub struct Resolution {
    push: Push,
    x: Vec<f32>,
}

/// How far a point goes along a unit way until it is out of a ball of that radius about the origin.
fn way_through(from: Vec3, way: Vec3, radius: f32) -> f32 {
    let (along, off) = (from.dot(way), from.length_squared());
    ops::sqrt((along * along - off + radius * radius).max(0.0)) - along
}
