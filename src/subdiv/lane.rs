//! What the inner loops compute with: a position in one register, or eight positions in three.

use std::ops::{Add, Mul, Sub};

use glam::Vec3;
use wide::{f32x4, f32x8};

/// Something that stencils blend. Each coordinate goes through the same operations in the same order whatever the type,
/// hence to the same bits.
pub(super) trait Value: Copy + Default + Send + Sync {
    fn scaled(self, weight: f32) -> Self;
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    /// The cross product, in an order of coordinates that suits the type.
    fn cross(self, other: Self) -> Self;
}

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

impl Value for Lane {
    #[inline(always)]
    fn scaled(self, weight: f32) -> Lane {
        Lane(self.0 * f32x4::splat(weight))
    }

    #[inline(always)]
    fn plus(self, other: Lane) -> Lane {
        Lane(self.0 + other.0)
    }

    #[inline(always)]
    fn minus(self, other: Lane) -> Lane {
        Lane(self.0 - other.0)
    }

    #[inline(always)]
    fn cross(self, other: Lane) -> Lane {
        Lane(self.0 * other.turned() - self.turned() * other.0)
    }
}

impl Lane {
    /// y, z, x.
    #[inline(always)]
    fn turned(self) -> f32x4 {
        let [x, y, z, w] = self.0.to_array();
        f32x4::new([y, z, x, w])
    }
}

/// How many heads a batch works on side by side.
pub(super) const HEADS: usize = 8;

/// The same vertex of eight heads, coordinate by coordinate.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Octet {
    pub(super) x: f32x8,
    pub(super) y: f32x8,
    pub(super) z: f32x8,
}

impl Octet {
    /// Vertex `i` of each head; heads that are missing repeat the last.
    #[inline(always)]
    pub(super) fn gather(heads: &[&[Vec3]], i: usize) -> Octet {
        let mut columns = [[0.0_f32; HEADS]; 3];
        for head in 0..HEADS {
            let p = heads[head.min(heads.len() - 1)][i];
            (columns[0][head], columns[1][head], columns[2][head]) = (p.x, p.y, p.z);
        }
        Octet { x: f32x8::new(columns[0]), y: f32x8::new(columns[1]), z: f32x8::new(columns[2]) }
    }

    /// Writes place `i` of each head.
    #[inline(always)]
    pub(super) fn scatter(self, heads: &mut [&mut [Vec3]], i: usize) {
        let (x, y, z) = (self.x.to_array(), self.y.to_array(), self.z.to_array());
        for (head, out) in heads.iter_mut().enumerate() {
            out[i] = Vec3::new(x[head], y[head], z[head]);
        }
    }

    /// The squared lengths.
    #[inline(always)]
    pub(super) fn squared(self) -> f32x8 {
        self.x * self.x + self.y * self.y + self.z * self.z
    }
}

macro_rules! octet {
    ($f:ident) => {
        #[inline(always)]
        fn $f(self, other: Octet) -> Octet {
            Octet { x: f32x8::$f(self.x, other.x), y: f32x8::$f(self.y, other.y), z: f32x8::$f(self.z, other.z) }
        }
    };
}

impl Add for Octet {
    type Output = Octet;
    octet!(add);
}

impl Sub for Octet {
    type Output = Octet;
    octet!(sub);
}

impl Mul<f32x8> for Octet {
    type Output = Octet;
    #[inline(always)]
    fn mul(self, factor: f32x8) -> Octet {
        Octet { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

impl Value for Octet {
    #[inline(always)]
    fn scaled(self, weight: f32) -> Octet {
        self * f32x8::splat(weight)
    }

    #[inline(always)]
    fn plus(self, other: Octet) -> Octet {
        self + other
    }

    #[inline(always)]
    fn minus(self, other: Octet) -> Octet {
        self - other
    }

    /// As x, y, z.
    #[inline(always)]
    fn cross(self, other: Octet) -> Octet {
        Octet {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }
}
