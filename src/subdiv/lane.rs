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

    /// The cross product of the first three.
    #[inline(always)]
    pub(super) fn cross(self, other: Lane) -> Lane {
        let ([ax, ay, az, aw], [bx, by, bz, bw]) = (self.0, other.0);
        // The fourth lane is computed like the others so that all four share each instruction.
        let (left, right) = ([ay * bz, az * bx, ax * by, aw * bw], [az * by, ax * bz, ay * bx, aw * bw]);
        Lane(left).minus(Lane(right))
    }

    #[inline(always)]
    pub(super) fn plus(self, other: Lane) -> Lane {
        Lane(std::array::from_fn(|i| self.0[i] + other.0[i]))
    }
}
