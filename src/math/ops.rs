//! The only door to functions whose last bits differ between platforms.
//!
//! The standard library leaves `sin`, `powf` and their like to the machine's own mathematics, so two machines may
//! disagree in the last bit and a frame would hash differently. `libm` is the same code everywhere.
//! The square root is the exception: IEEE 754 demands its correct rounding, so the machine's instruction is exact.

/// A float type with the functions of this module: `f32` and `f64`.
pub trait Real: Copy + sealed::Sealed {
    /// What [`sin`] does.
    fn sin(self) -> Self;
    /// What [`cos`] does.
    fn cos(self) -> Self;
    /// What [`tan`] does.
    fn tan(self) -> Self;
    /// What [`asin`] does.
    fn asin(self) -> Self;
    /// What [`acos`] does.
    fn acos(self) -> Self;
    /// What [`atan2`] does.
    fn atan2(y: Self, x: Self) -> Self;
    /// What [`sqrt`] does.
    fn sqrt(self) -> Self;
    /// What [`cbrt`] does.
    fn cbrt(self) -> Self;
    /// What [`hypot`] does.
    fn hypot(x: Self, y: Self) -> Self;
    /// What [`powf`] does.
    fn powf(self, exponent: Self) -> Self;
    /// What [`exp`] does.
    fn exp(self) -> Self;
    /// What [`ln`] does.
    fn ln(self) -> Self;
}

mod sealed {
    /// Keeps [`Real`](super::Real) to the two float types.
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

macro_rules! real {
    ($float:ident, $sin:ident, $cos:ident, $tan:ident, $asin:ident, $acos:ident, $atan2:ident, $cbrt:ident, $hypot:ident, $pow:ident, $exp:ident, $ln:ident) => {
        impl Real for $float {
            fn sin(self) -> Self {
                libm::$sin(self)
            }
            fn cos(self) -> Self {
                libm::$cos(self)
            }
            fn tan(self) -> Self {
                libm::$tan(self)
            }
            fn asin(self) -> Self {
                libm::$asin(self)
            }
            fn acos(self) -> Self {
                libm::$acos(self)
            }
            fn atan2(y: Self, x: Self) -> Self {
                libm::$atan2(y, x)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $float::sqrt(self)
            }
            fn cbrt(self) -> Self {
                libm::$cbrt(self)
            }
            fn hypot(x: Self, y: Self) -> Self {
                libm::$hypot(x, y)
            }
            fn powf(self, exponent: Self) -> Self {
                libm::$pow(self, exponent)
            }
            fn exp(self) -> Self {
                libm::$exp(self)
            }
            fn ln(self) -> Self {
                libm::$ln(self)
            }
        }
    };
}

real!(f32, sinf, cosf, tanf, asinf, acosf, atan2f, cbrtf, hypotf, powf, expf, logf);
real!(f64, sin, cos, tan, asin, acos, atan2, cbrt, hypot, pow, exp, log);

/// Sine of an angle in radians.
pub fn sin<T: Real>(angle: T) -> T {
    angle.sin()
}

/// Cosine of an angle in radians.
pub fn cos<T: Real>(angle: T) -> T {
    angle.cos()
}

/// Sine and cosine of an angle in radians.
pub fn sin_cos<T: Real>(angle: T) -> (T, T) {
    (angle.sin(), angle.cos())
}

/// Tangent of an angle in radians.
pub fn tan<T: Real>(angle: T) -> T {
    angle.tan()
}

/// Angle in radians, -π/2 to π/2; not a number outside -1 to 1.
pub fn asin<T: Real>(x: T) -> T {
    x.asin()
}

/// Angle in radians, 0 to π; not a number outside -1 to 1.
pub fn acos<T: Real>(x: T) -> T {
    x.acos()
}

/// Angle of the point (x, y) in radians, -π to π.
pub fn atan2<T: Real>(y: T, x: T) -> T {
    T::atan2(y, x)
}

/// Square root, correctly rounded; not a number below zero.
#[inline(always)]
pub fn sqrt<T: Real>(x: T) -> T {
    x.sqrt()
}

/// Cube root.
pub fn cbrt<T: Real>(x: T) -> T {
    x.cbrt()
}

/// Length of (x, y) without overflow on the way.
pub fn hypot<T: Real>(x: T, y: T) -> T {
    T::hypot(x, y)
}

/// `base` to the power `exponent`.
pub fn powf<T: Real>(base: T, exponent: T) -> T {
    base.powf(exponent)
}

/// e to the power `x`.
pub fn exp<T: Real>(x: T) -> T {
    x.exp()
}

/// Natural logarithm; not a number below zero.
pub fn ln<T: Real>(x: T) -> T {
    x.ln()
}

/// 0 at `from`, 1 at `to` and beyond, level at both; `to` may be the lower one.
pub fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use crate::math::rng::Rng;

    #[test]
    fn square_root_of_the_machine_differs_from_the_portable_one() {
        let mut rng = Rng::new(1);
        for _ in 0..100_000 {
            let x = f32::from_bits(rng.next_u32() & 0x7fff_ffff);
            assert!(x.is_nan() || super::sqrt(x).to_bits() == libm::sqrtf(x).to_bits(), "{x}");
            let x = f64::from_bits(rng.next_u64() & 0x7fff_ffff_ffff_ffff);
            assert!(x.is_nan() || super::sqrt(x).to_bits() == libm::sqrt(x).to_bits(), "{x}");
        }
    }

    #[test]
    fn a_function_is_wired_to_the_wrong_one() {
        let x = 0.3_f64;
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} {b}");
        close(super::sin(x), 0.295_520_206_661_339_6);
        close(super::cos(x), 0.955_336_489_125_606);
        close(super::tan(x), 0.309_336_249_609_623_25);
        close(super::asin(super::sin(x)), x);
        close(super::acos(super::cos(x)), x);
        close(super::atan2(1.0, -1.0), 0.75 * std::f64::consts::PI);
        close(super::exp(super::ln(x)), x);
        close(super::powf(2.0, 0.5), std::f64::consts::SQRT_2);
        close(super::cbrt(0.027), x);
        close(super::hypot(0.3, 0.4), 0.5);
        assert_eq!(super::sin_cos(0.0_f32), (0.0, 1.0));
    }
}
