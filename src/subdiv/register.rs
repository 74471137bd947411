//! Floats that go through the same arithmetic side by side: as many as a register of the processor holds.
//!
//! The compiler turns loops over arrays into wide instructions only where it sees fit, and libraries choose their width when
//! they are compiled. One portable binary with the width of the machine it runs on needs both, chosen as it starts. No
//! operation here rounds otherwise than the plain one, so that the bits are the same.

/// Some floats, each in a lane of its own.
pub(super) trait Register: Copy {
    /// How many.
    const WIDTH: usize;

    /// The first `WIDTH` of `values`.
    fn load(values: &[f32]) -> Self;
    /// Into the first `WIDTH` places of `out`.
    fn store(self, out: &mut [f32]);
    fn splat(value: f32) -> Self;
    fn plus(self, other: Self) -> Self;
    fn minus(self, other: Self) -> Self;
    fn times(self, other: Self) -> Self;
    fn over(self, other: Self) -> Self;
    fn sqrt(self) -> Self;
    /// Whether each is more than `low` and less than `high`.
    fn all_between(self, low: f32, high: f32) -> bool;
}

/// For any processor.
#[derive(Clone, Copy)]
pub(super) struct Plain([f32; 4]);

impl Plain {
    #[inline(always)]
    fn with(self, other: Plain, f: impl Fn(f32, f32) -> f32) -> Plain {
        let (a, b) = (self.0, other.0);
        Plain([f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3])])
    }
}

impl Register for Plain {
    const WIDTH: usize = 4;

    #[inline(always)]
    fn load(values: &[f32]) -> Plain {
        Plain([values[0], values[1], values[2], values[3]])
    }

    #[inline(always)]
    fn store(self, out: &mut [f32]) {
        out[..4].copy_from_slice(&self.0);
    }

    #[inline(always)]
    fn splat(value: f32) -> Plain {
        Plain([value; 4])
    }

    #[inline(always)]
    fn plus(self, other: Plain) -> Plain {
        self.with(other, |a, b| a + b)
    }

    #[inline(always)]
    fn minus(self, other: Plain) -> Plain {
        self.with(other, |a, b| a - b)
    }

    #[inline(always)]
    fn times(self, other: Plain) -> Plain {
        self.with(other, |a, b| a * b)
    }

    #[inline(always)]
    fn over(self, other: Plain) -> Plain {
        self.with(other, |a, b| a / b)
    }

    #[inline(always)]
    fn sqrt(self) -> Plain {
        self.with(self, |a, _| crate::math::ops::sqrt(a))
    }

    #[inline(always)]
    fn all_between(self, low: f32, high: f32) -> bool {
        self.0.iter().all(|&value| value > low && value < high)
    }
}

#[cfg(target_arch = "x86_64")]
pub(super) use x86::{Avx, Avx512};

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod x86 {
    use super::Register;
    use std::arch::x86_64::*;

    // SAFETY, of all that follows: the instructions are there, since the types say so; loads and stores stay within the
    // lists, whose lengths are asserted, and demand no alignment.
    macro_rules! register {
        ($name:ident, $of:ident, $width:literal, $about:literal, [$load:ident $store:ident $splat:ident $add:ident $sub:ident $mul:ident $div:ident $sqrt:ident], $between:expr) => {
            #[doc = $about]
            #[derive(Clone, Copy)]
            pub(in crate::subdiv) struct $name($of);

            impl Register for $name {
                const WIDTH: usize = $width;

                #[inline(always)]
                fn load(values: &[f32]) -> $name {
                    assert!(values.len() >= $width);
                    $name(unsafe { $load(values.as_ptr()) })
                }

                #[inline(always)]
                fn store(self, out: &mut [f32]) {
                    assert!(out.len() >= $width);
                    unsafe { $store(out.as_mut_ptr(), self.0) };
                }

                #[inline(always)]
                fn splat(value: f32) -> $name {
                    $name(unsafe { $splat(value) })
                }

                #[inline(always)]
                fn plus(self, other: $name) -> $name {
                    $name(unsafe { $add(self.0, other.0) })
                }

                #[inline(always)]
                fn minus(self, other: $name) -> $name {
                    $name(unsafe { $sub(self.0, other.0) })
                }

                #[inline(always)]
                fn times(self, other: $name) -> $name {
                    $name(unsafe { $mul(self.0, other.0) })
                }

                #[inline(always)]
                fn over(self, other: $name) -> $name {
                    $name(unsafe { $div(self.0, other.0) })
                }

                #[inline(always)]
                fn sqrt(self) -> $name {
                    $name(unsafe { $sqrt(self.0) })
                }

                #[inline(always)]
                fn all_between(self, low: f32, high: f32) -> bool {
                    let (low, high) = ($name::splat(low), $name::splat(high));
                    unsafe { $between(self.0, low.0, high.0) }
                }
            }
        };
    }

    register!(
        Avx, __m256, 8, "For processors with AVX: only code that has made sure of it may name this type.",
        [_mm256_loadu_ps _mm256_storeu_ps _mm256_set1_ps _mm256_add_ps _mm256_sub_ps _mm256_mul_ps _mm256_div_ps
            _mm256_sqrt_ps],
        |values, low, high| {
            let (above, below) = (_mm256_cmp_ps::<_CMP_GT_OQ>(values, low), _mm256_cmp_ps::<_CMP_LT_OQ>(values, high));
            _mm256_movemask_ps(_mm256_and_ps(above, below)) == 0xff
        }
    );

    register!(
        Avx512, __m512, 16, "For processors with AVX-512F: only code that has made sure of it may name this type.",
        [_mm512_loadu_ps _mm512_storeu_ps _mm512_set1_ps _mm512_add_ps _mm512_sub_ps _mm512_mul_ps _mm512_div_ps
            _mm512_sqrt_ps],
        |values, low, high| {
            let above = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(values, low);
            above & _mm512_cmp_ps_mask::<_CMP_LT_OQ>(values, high) == 0xffff
        }
    );
}
