//! What the inner loops compute with: a position in one register.

use glam::Vec3;
use wide::f32x4;

/// x, y, z and a fourth float that means nothing: one register wide, so that a row of a stencil is one multiply and one add
/// a source. Cross products come as z, x, y: that order needs but one turned copy of each factor.
#[derive(Clone, Copy, Debug, Default)]
#[repr(transparent)]
pub(super) struct Lane(pub(super) f32x4);

impl From<Vec3> for Lane {
    #[inline(always)]
    fn from(v: Vec3) -> Lane {
        Lane(f32x4::new([v.x, v.y, v.z, 0.0]))
    }
}

impl From<Lane> for Vec3 {
    #[inline(always)]
    fn from(lane: Lane) -> Vec3 {
        let [x, y, z, _] = lane.0.to_array();
        Vec3::new(x, y, z)
    }
}

impl Lane {
    #[inline(always)]
    pub(super) fn scaled(self, weight: f32) -> Lane {
        Lane(self.0 * f32x4::splat(weight))
    }

    #[inline(always)]
    pub(super) fn plus(self, other: Lane) -> Lane {
        Lane(self.0 + other.0)
    }

    #[inline(always)]
    pub(super) fn minus(self, other: Lane) -> Lane {
        Lane(self.0 - other.0)
    }

    /// The cross product, as z, x, y.
    #[inline(always)]
    pub(super) fn cross(self, other: Lane) -> Lane {
        Lane(self.0 * other.turned() - self.turned() * other.0)
    }

    /// y, z, x.
    #[inline(always)]
    fn turned(self) -> f32x4 {
        let [x, y, z, w] = self.0.to_array();
        f32x4::new([y, z, x, w])
    }
}
