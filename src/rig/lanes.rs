//! Eight numbers at a time, for the implicit head: plain loops over arrays that the compiler turns into vector
//! instructions. Every operation is the IEEE one, lane by lane, so the bits do not depend on the width of the machine.

use std::array::from_fn;
use std::ops::{Add, Mul, Neg, Sub};

/// Eight `f32`.
#[derive(Clone, Copy, Debug)]
pub struct F8(pub [f32; 8]);

macro_rules! lanewise {
    ($trait:ident, $f:ident, $op:tt) => {
        impl $trait for F8 {
            type Output = F8;
            #[inline(always)]
            fn $f(self, o: F8) -> F8 {
                F8(from_fn(|k| self.0[k] $op o.0[k]))
            }
        }
        impl $trait<f32> for F8 {
            type Output = F8;
            #[inline(always)]
            fn $f(self, o: f32) -> F8 {
                F8(from_fn(|k| self.0[k] $op o))
            }
        }
    };
}
lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);

impl Neg for F8 {
    type Output = F8;
    #[inline(always)]
    fn neg(self) -> F8 {
        F8(from_fn(|k| -self.0[k]))
    }
}

impl F8 {
    /// The same number in every lane.
    #[inline(always)]
    pub fn splat(v: f32) -> F8 {
        F8([v; 8])
    }
    /// Square root.
    #[inline(always)]
    pub fn sqrt(self) -> F8 {
        F8(from_fn(|k| self.0[k].sqrt()))
    }
    /// Quotient.
    #[inline(always)]
    pub fn div(self, o: F8) -> F8 {
        F8(from_fn(|k| self.0[k] / o.0[k]))
    }
    /// The larger of two; written as a comparison so that it is one instruction.
    #[inline(always)]
    pub fn max(self, o: F8) -> F8 {
        F8(from_fn(|k| if self.0[k] > o.0[k] { self.0[k] } else { o.0[k] }))
    }
    /// The smaller of two.
    #[inline(always)]
    pub fn min(self, o: F8) -> F8 {
        F8(from_fn(|k| if self.0[k] < o.0[k] { self.0[k] } else { o.0[k] }))
    }
    /// The smallest lane and the largest.
    #[inline(always)]
    pub fn range(self) -> (f32, f32) {
        let [a, b, c, d, e, f, g, h] = self.0;
        let less = |a: f32, b: f32| if a < b { a } else { b };
        let more = |a: f32, b: f32| if a > b { a } else { b };
        (
            less(less(less(a, e), less(b, f)), less(less(c, g), less(d, h))),
            more(more(more(a, e), more(b, f)), more(more(c, g), more(d, h))),
        )
    }
    /// Between two numbers.
    #[inline(always)]
    pub fn clamp(self, lo: f32, hi: f32) -> F8 {
        self.max(F8::splat(lo)).min(F8::splat(hi))
    }
    /// Without the sign.
    #[inline(always)]
    pub fn abs(self) -> F8 {
        F8(from_fn(|k| self.0[k].abs()))
    }
}

/// Eight points.
#[derive(Clone, Copy, Debug)]
pub struct P8 {
    /// To the dog's left.
    pub x: F8,
    /// Up.
    pub y: F8,
    /// Forward.
    pub z: F8,
}

impl P8 {
    /// Less one point.
    #[inline(always)]
    pub fn minus(self, c: glam::Vec3) -> P8 {
        P8 { x: self.x - c.x, y: self.y - c.y, z: self.z - c.z }
    }
    /// Scalar product with one vector.
    #[inline(always)]
    pub fn dot(self, v: glam::Vec3) -> F8 {
        self.x * v.x + self.y * v.y + self.z * v.z
    }
    /// Squared length.
    #[inline(always)]
    pub fn length_squared(self) -> F8 {
        self.x * self.x + self.y * self.y + self.z * self.z
    }
    /// Turned about the x axis; cosine and sine of the angle.
    #[inline(always)]
    pub fn rotate_x(self, c: f32, s: f32) -> P8 {
        P8 { x: self.x, y: self.y * c - self.z * s, z: self.y * s + self.z * c }
    }
}
