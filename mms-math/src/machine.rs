//! Four numbers at a time, in one register where the processor has such.
//!
//! The compiler turns a loop over many numbers into vector instructions by itself ([`crate::batch`]); what it
//! does to four numbers that go through long code together is luck. Here they are one value.

use core::ops::{Add, Mul};

/// A way to compute with four numbers together.
pub trait Machine<T>: Copy {
    /// Four numbers.
    type Four: Copy;

    /// These numbers.
    fn four(self, numbers: &[T; 4]) -> Self::Four;

    /// The same number four times.
    fn splat(self, number: T) -> Self::Four;

    /// The numbers.
    fn numbers(self, four: Self::Four) -> [T; 4];

    /// a b.
    fn times(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// a b + c.
    fn times_plus(self, a: Self::Four, b: Self::Four, c: Self::Four) -> Self::Four;
}

/// Products and sums, one number after the other: every processor has them.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

impl<T: Copy + Add<Output = T> + Mul<Output = T>> Machine<T> for Plain {
    type Four = [T; 4];

    #[inline(always)]
    fn four(self, numbers: &[T; 4]) -> [T; 4] {
        *numbers
    }

    #[inline(always)]
    fn splat(self, number: T) -> [T; 4] {
        [number; 4]
    }

    #[inline(always)]
    fn numbers(self, four: [T; 4]) -> [T; 4] {
        four
    }

    #[inline(always)]
    fn times(self, a: [T; 4], b: [T; 4]) -> [T; 4] {
        [a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]]
    }

    #[inline(always)]
    fn times_plus(self, a: [T; 4], b: [T; 4], c: [T; 4]) -> [T; 4] {
        [a[0] * b[0] + c[0], a[1] * b[1] + c[1], a[2] * b[2] + c[2], a[3] * b[3] + c[3]]
    }
}

/// Multiply-adds that round once. There is one only where the processor is known to have them
/// ([`crate::dispatch`]).
#[derive(Clone, Copy, Debug)]
pub struct Fused(());

impl Fused {
    /// Only for a processor with AVX2 and FMA, where there are such, in a function compiled for them.
    #[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(dead_code))]
    pub(crate) fn known() -> Self {
        Fused(())
    }
}

#[cfg(target_arch = "x86_64")]
macro_rules! registers {
    ($($float:ident: $register:ident, $load:ident, $store:ident, $splat:ident, $times:ident, $times_plus:ident;)*) => {
        $(
            // Safety, of all: a `Fused` is a proof that the processor has the instructions.
            #[allow(unsafe_code)]
            impl Machine<$float> for Fused {
                type Four = core::arch::x86_64::$register;

                #[inline(always)]
                fn four(self, numbers: &[$float; 4]) -> Self::Four {
                    unsafe { core::arch::x86_64::$load(numbers.as_ptr()) }
                }

                #[inline(always)]
                fn splat(self, number: $float) -> Self::Four {
                    unsafe { core::arch::x86_64::$splat(number) }
                }

                #[inline(always)]
                fn numbers(self, four: Self::Four) -> [$float; 4] {
                    let mut numbers = [0.0; 4];
                    unsafe { core::arch::x86_64::$store(numbers.as_mut_ptr(), four) };
                    numbers
                }

                #[inline(always)]
                fn times(self, a: Self::Four, b: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$times(a, b) }
                }

                #[inline(always)]
                fn times_plus(self, a: Self::Four, b: Self::Four, c: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$times_plus(a, b, c) }
                }
            }
        )*
    };
}

#[cfg(target_arch = "x86_64")]
registers! {
    f32: __m128, _mm_loadu_ps, _mm_storeu_ps, _mm_set1_ps, _mm_mul_ps, _mm_fmadd_ps;
    f64: __m256d, _mm256_loadu_pd, _mm256_storeu_pd, _mm256_set1_pd, _mm256_mul_pd, _mm256_fmadd_pd;
}

#[cfg(not(target_arch = "x86_64"))]
macro_rules! numbers {
    ($($float:ident)*) => {
        $(
            impl Machine<$float> for Fused {
                type Four = [$float; 4];

                #[inline(always)]
                fn four(self, numbers: &[$float; 4]) -> [$float; 4] {
                    *numbers
                }

                #[inline(always)]
                fn splat(self, number: $float) -> [$float; 4] {
                    [number; 4]
                }

                #[inline(always)]
                fn numbers(self, four: [$float; 4]) -> [$float; 4] {
                    four
                }

                #[inline(always)]
                fn times(self, a: [$float; 4], b: [$float; 4]) -> [$float; 4] {
                    Plain.times(a, b)
                }

                #[inline(always)]
                fn times_plus(
                    self,
                    a: [$float; 4],
                    b: [$float; 4],
                    c: [$float; 4],
                ) -> [$float; 4] {
                    let one = |k: usize| a[k].mul_add(b[k], c[k]);
                    [one(0), one(1), one(2), one(3)]
                }
            }
        )*
    };
}

#[cfg(not(target_arch = "x86_64"))]
numbers!(f32 f64);
