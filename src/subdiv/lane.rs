//! A position padded to four floats: one register wide, so that a row of a stencil is one multiply and one add a source.

use glam::Vec3;

/// x, y, z and a fourth float that stays zero. The same sums as on [`Vec3`], in the same order, hence the same bits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C, align(16))]
pub(super) struct Lane(pub(super) [f32; 4]);

impl From<Vec3> for Lane {
    #[inline(always)]
    fn from(v: Vec3) -> Lane {
        Lane([v.x, v.y, v.z, 0.0])
    }
}

impl From<Lane> for Vec3 {
    #[inline(always)]
    fn from(lane: Lane) -> Vec3 {
        Vec3::new(lane.0[0], lane.0[1], lane.0[2])
    }
}

impl Lane {
    #[inline(always)]
    pub(super) fn scaled(self, weight: f32) -> Lane {
        Lane(self.0.map(|x| x * weight))
    }

    #[inline(always)]
    pub(super) fn minus(self, other: Lane) -> Lane {
        Lane(std::array::from_fn(|i| self.0[i] - other.0[i]))
    }

    /// The cross product of the first three, as z, x, y: that order needs but one turned copy of each factor.
    #[inline(always)]
    pub(super) fn cross_zxy(self, other: Lane) -> Lane {
        let turned = |[x, y, z, w]: [f32; 4]| [y, z, x, w];
        let (a, b) = (self.0, other.0);
        let (a_turned, b_turned) = (turned(a), turned(b));
        Lane(std::array::from_fn(|i| a[i] * b_turned[i] - a_turned[i] * b[i]))
    }

    #[inline(always)]
    pub(super) fn plus(self, other: Lane) -> Lane {
        Lane(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}
