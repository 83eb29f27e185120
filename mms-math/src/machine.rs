//! Four numbers at a time, in one register where the processor has such.
//!
//! The compiler turns a loop over many numbers into vector instructions by itself ([`crate::batch`]); what it
//! does to four numbers that go through long code together is luck. Here they are one value.

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

    /// a + b.
    fn plus(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// a - b.
    fn minus(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// a b.
    fn times(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// a b + c.
    fn times_plus(self, a: Self::Four, b: Self::Four, c: Self::Four) -> Self::Four;

    /// a / b.
    fn over(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// a where it is less than b, else b: so b where one is not a number.
    fn least(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// a where it is greater than b, else b: so b where one is not a number.
    fn greatest(self, a: Self::Four, b: Self::Four) -> Self::Four;

    /// The square roots.
    fn root(self, a: Self::Four) -> Self::Four;

    /// The greatest whole numbers that are not greater than these.
    fn floor(self, a: Self::Four) -> Self::Four;

    /// Whether a <= b for all four.
    fn all_at_most(self, a: Self::Four, b: Self::Four) -> bool;

    /// Whether all four numbers of each lie between its two ends: one question, and one branch, for all.
    fn all_between<const N: usize>(self, numbers: &[Self::Four; N], ends: &[[T; 2]; N]) -> bool;

    /// The whole numbers that these are, between -2^31 and 2^31; any number elsewhere.
    fn whole(self, a: Self::Four) -> [i32; 4];

    /// The first numbers of all four, then the second ones, and so on.
    fn transposed(self, rows: [Self::Four; 4]) -> [Self::Four; 4];

    /// The first numbers of four pairs, two of which are in each row, and the second ones.
    fn unzipped(self, rows: [Self::Four; 2]) -> [Self::Four; 2];

    /// Four pairs of a first and a second number, two in each row.
    fn zipped(self, columns: [Self::Four; 2]) -> [Self::Four; 2];

    /// Has this value brought near, for it is soon needed.
    fn fetch<V>(self, value: &V);
}

/// One number after the other: every processor can do that.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

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

macro_rules! arrays {
    ($($machine:ident $float:ident $times_plus:expr;)*) => {
        $(
            impl Machine<$float> for $machine {
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
                fn plus(self, a: [$float; 4], b: [$float; 4]) -> [$float; 4] {
                    [a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]]
                }

                #[inline(always)]
                fn minus(self, a: [$float; 4], b: [$float; 4]) -> [$float; 4] {
                    [a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]]
                }

                #[inline(always)]
                fn times(self, a: [$float; 4], b: [$float; 4]) -> [$float; 4] {
                    [a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]]
                }

                #[inline(always)]
                fn times_plus(
                    self,
                    a: [$float; 4],
                    b: [$float; 4],
                    c: [$float; 4],
                ) -> [$float; 4] {
                    let one = |k: usize| $times_plus(a[k], b[k], c[k]);
                    [one(0), one(1), one(2), one(3)]
                }

                #[inline(always)]
                fn over(self, a: [$float; 4], b: [$float; 4]) -> [$float; 4] {
                    [a[0] / b[0], a[1] / b[1], a[2] / b[2], a[3] / b[3]]
                }

                #[inline(always)]
                fn least(self, a: [$float; 4], b: [$float; 4]) -> [$float; 4] {
                    let one = |k: usize| if a[k] < b[k] { a[k] } else { b[k] };
                    [one(0), one(1), one(2), one(3)]
                }

                #[inline(always)]
                fn greatest(self, a: [$float; 4], b: [$float; 4]) -> [$float; 4] {
                    let one = |k: usize| if a[k] > b[k] { a[k] } else { b[k] };
                    [one(0), one(1), one(2), one(3)]
                }

                #[inline(always)]
                fn root(self, a: [$float; 4]) -> [$float; 4] {
                    a.map($float::sqrt)
                }

                #[inline(always)]
                fn floor(self, a: [$float; 4]) -> [$float; 4] {
                    a.map($float::floor)
                }

                #[inline(always)]
                fn all_at_most(self, a: [$float; 4], b: [$float; 4]) -> bool {
                    a[0] <= b[0] && a[1] <= b[1] && a[2] <= b[2] && a[3] <= b[3]
                }

                #[inline(always)]
                fn all_between<const N: usize>(
                    self,
                    numbers: &[[$float; 4]; N],
                    ends: &[[$float; 2]; N],
                ) -> bool {
                    let is_between = |number: &$float, [first, last]: &[$float; 2]| {
                        first <= number && number <= last
                    };
                    let mut pairs = numbers.iter().zip(ends);
                    pairs.all(|(four, ends)| four.iter().all(|number| is_between(number, ends)))
                }

                #[inline(always)]
                fn whole(self, a: [$float; 4]) -> [i32; 4] {
                    a.map(|number| number as i32)
                }

                #[inline(always)]
                fn transposed(self, [a, b, c, d]: [[$float; 4]; 4]) -> [[$float; 4]; 4] {
                    let column = |k: usize| [a[k], b[k], c[k], d[k]];
                    [column(0), column(1), column(2), column(3)]
                }

                #[inline(always)]
                fn unzipped(self, [a, b]: [[$float; 4]; 2]) -> [[$float; 4]; 2] {
                    [[a[0], a[2], b[0], b[2]], [a[1], a[3], b[1], b[3]]]
                }

                #[inline(always)]
                fn zipped(self, [a, b]: [[$float; 4]; 2]) -> [[$float; 4]; 2] {
                    [[a[0], b[0], a[1], b[1]], [a[2], b[2], a[3], b[3]]]
                }

                #[inline(always)]
                fn fetch<V>(self, _: &V) {}
            }
        )*
    };
}

arrays! {
    Plain f32 |a: f32, b: f32, c: f32| a * b + c;
    Plain f64 |a: f64, b: f64, c: f64| a * b + c;
}

#[cfg(not(target_arch = "x86_64"))]
arrays! {
    Fused f32 f32::mul_add;
    Fused f64 f64::mul_add;
}

#[cfg(target_arch = "x86_64")]
macro_rules! registers {
    (
        $($float:ident: $register:ident {
            four $load:ident, splat $splat:ident, numbers $store:ident, plus $plus:ident, minus $minus:ident,
            times $times:ident, times_plus $times_plus:ident, over $over:ident, least $least:ident,
            greatest $greatest:ident, root $root:ident, floor $floor:ident, compare $compare:ident, both $both:ident,
            signs $signs:ident, whole $whole:ident, transposed $transposed:ident, unzipped $unzipped:ident, zipped $zipped:ident
        })*
    ) => {
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
                fn plus(self, a: Self::Four, b: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$plus(a, b) }
                }

                #[inline(always)]
                fn minus(self, a: Self::Four, b: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$minus(a, b) }
                }

                #[inline(always)]
                fn times(self, a: Self::Four, b: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$times(a, b) }
                }

                #[inline(always)]
                fn times_plus(self, a: Self::Four, b: Self::Four, c: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$times_plus(a, b, c) }
                }

                #[inline(always)]
                fn over(self, a: Self::Four, b: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$over(a, b) }
                }

                #[inline(always)]
                fn least(self, a: Self::Four, b: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$least(a, b) }
                }

                #[inline(always)]
                fn greatest(self, a: Self::Four, b: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$greatest(a, b) }
                }

                #[inline(always)]
                fn root(self, a: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$root(a) }
                }

                #[inline(always)]
                fn floor(self, a: Self::Four) -> Self::Four {
                    unsafe { core::arch::x86_64::$floor(a) }
                }

                #[inline(always)]
                fn all_at_most(self, a: Self::Four, b: Self::Four) -> bool {
                    use core::arch::x86_64::{_CMP_LE_OQ, $compare, $signs};
                    unsafe { $signs($compare::<_CMP_LE_OQ>(a, b)) == 0b1111 }
                }

                #[inline(always)]
                fn all_between<const N: usize>(
                    self,
                    numbers: &[Self::Four; N],
                    ends: &[[$float; 2]; N],
                ) -> bool {
                    use core::arch::x86_64::{_CMP_LE_OQ, $both, $compare, $signs};
                    let mut all = self.splat($float::from_bits(!0));
                    for (number, [first, last]) in numbers.iter().zip(ends) {
                        let (first, last) = (self.splat(*first), self.splat(*last));
                        unsafe {
                            all = $both(all, $compare::<_CMP_LE_OQ>(first, *number));
                            all = $both(all, $compare::<_CMP_LE_OQ>(*number, last));
                        }
                    }
                    unsafe { $signs(all) == 0b1111 }
                }

                #[inline(always)]
                fn whole(self, a: Self::Four) -> [i32; 4] {
                    let mut numbers = [0; 4];
                    unsafe {
                        let registers = core::arch::x86_64::$whole(a);
                        core::arch::x86_64::_mm_storeu_si128(numbers.as_mut_ptr().cast(), registers);
                    }
                    numbers
                }

                #[inline(always)]
                fn transposed(self, [a, b, c, d]: [Self::Four; 4]) -> [Self::Four; 4] {
                    unsafe { $transposed(a, b, c, d) }
                }

                #[inline(always)]
                fn unzipped(self, [a, b]: [Self::Four; 2]) -> [Self::Four; 2] {
                    unsafe { $unzipped(a, b) }
                }

                #[inline(always)]
                fn zipped(self, [a, b]: [Self::Four; 2]) -> [Self::Four; 2] {
                    unsafe { $zipped(a, b) }
                }

                #[inline(always)]
                fn fetch<V>(self, value: &V) {
                    use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
                    unsafe { _mm_prefetch::<_MM_HINT_T0>(core::ptr::from_ref(value).cast()) };
                }
            }
        )*
    };
}

#[cfg(target_arch = "x86_64")]
registers! {
    f32: __m128 {
        four _mm_loadu_ps, splat _mm_set1_ps, numbers _mm_storeu_ps, plus _mm_add_ps, minus _mm_sub_ps,
        times _mm_mul_ps, times_plus _mm_fmadd_ps, over _mm_div_ps, least _mm_min_ps,
        greatest _mm_max_ps, root _mm_sqrt_ps, floor _mm_floor_ps, compare _mm_cmp_ps, both _mm_and_ps,
        signs _mm_movemask_ps, whole _mm_cvttps_epi32, transposed transposed_singles,
        unzipped unzipped_singles, zipped zipped_singles
    }
    f64: __m256d {
        four _mm256_loadu_pd, splat _mm256_set1_pd, numbers _mm256_storeu_pd, plus _mm256_add_pd, minus _mm256_sub_pd,
        times _mm256_mul_pd, times_plus _mm256_fmadd_pd, over _mm256_div_pd, least _mm256_min_pd,
        greatest _mm256_max_pd, root _mm256_sqrt_pd, floor _mm256_floor_pd, compare _mm256_cmp_pd, both _mm256_and_pd,
        signs _mm256_movemask_pd, whole _mm256_cvttpd_epi32, transposed transposed_doubles,
        unzipped unzipped_doubles, zipped zipped_doubles
    }
}

/// Safety: the processor has AVX.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
#[inline(always)]
unsafe fn transposed_doubles(
    a: core::arch::x86_64::__m256d,
    b: core::arch::x86_64::__m256d,
    c: core::arch::x86_64::__m256d,
    d: core::arch::x86_64::__m256d,
) -> [core::arch::x86_64::__m256d; 4] {
    use core::arch::x86_64::{_mm256_permute2f128_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd};
    unsafe {
        // Of a and b: the numbers 0 and 2, then 1 and 3; likewise of c and d.
        let (even, odd) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (more_even, more_odd) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(even, more_even),
            _mm256_permute2f128_pd::<0x20>(odd, more_odd),
            _mm256_permute2f128_pd::<0x31>(even, more_even),
            _mm256_permute2f128_pd::<0x31>(odd, more_odd),
        ]
    }
}

/// Safety: the processor has SSE, as all of them have.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
#[inline(always)]
unsafe fn transposed_singles(
    a: core::arch::x86_64::__m128,
    b: core::arch::x86_64::__m128,
    c: core::arch::x86_64::__m128,
    d: core::arch::x86_64::__m128,
) -> [core::arch::x86_64::__m128; 4] {
    use core::arch::x86_64::{_mm_movehl_ps, _mm_movelh_ps, _mm_unpackhi_ps, _mm_unpacklo_ps};
    unsafe {
        // Of a and b: the numbers 0 and 1, then 2 and 3; likewise of c and d.
        let (low, high) = (_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b));
        let (more_low, more_high) = (_mm_unpacklo_ps(c, d), _mm_unpackhi_ps(c, d));
        [
            _mm_movelh_ps(low, more_low),
            _mm_movehl_ps(more_low, low),
            _mm_movelh_ps(high, more_high),
            _mm_movehl_ps(more_high, high),
        ]
    }
}

/// Safety: the processor has AVX.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
#[inline(always)]
unsafe fn unzipped_doubles(
    a: core::arch::x86_64::__m256d,
    b: core::arch::x86_64::__m256d,
) -> [core::arch::x86_64::__m256d; 2] {
    use core::arch::x86_64::{_mm256_permute2f128_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd};
    unsafe {
        // The pairs 0 and 2, then 1 and 3.
        let even = _mm256_permute2f128_pd::<0x20>(a, b);
        let odd = _mm256_permute2f128_pd::<0x31>(a, b);
        [_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)]
    }
}

/// Safety: the processor has AVX.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
#[inline(always)]
unsafe fn zipped_doubles(
    a: core::arch::x86_64::__m256d,
    b: core::arch::x86_64::__m256d,
) -> [core::arch::x86_64::__m256d; 2] {
    use core::arch::x86_64::{_mm256_permute2f128_pd, _mm256_unpackhi_pd, _mm256_unpacklo_pd};
    unsafe {
        let (even, odd) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        [_mm256_permute2f128_pd::<0x20>(even, odd), _mm256_permute2f128_pd::<0x31>(even, odd)]
    }
}

/// Safety: the processor has SSE, as all of them have.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
#[inline(always)]
unsafe fn unzipped_singles(
    a: core::arch::x86_64::__m128,
    b: core::arch::x86_64::__m128,
) -> [core::arch::x86_64::__m128; 2] {
    use core::arch::x86_64::_mm_shuffle_ps;
    unsafe { [_mm_shuffle_ps::<0b10_00_10_00>(a, b), _mm_shuffle_ps::<0b11_01_11_01>(a, b)] }
}

/// Safety: likewise.
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
#[inline(always)]
unsafe fn zipped_singles(
    a: core::arch::x86_64::__m128,
    b: core::arch::x86_64::__m128,
) -> [core::arch::x86_64::__m128; 2] {
    use core::arch::x86_64::{_mm_unpackhi_ps, _mm_unpacklo_ps};
    unsafe { [_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b)] }
}

#[cfg(test)]
mod tests {
    use std::format;
    use std::vec;
    use std::vec::Vec;

    use super::{Fused, Machine, Plain};
    use crate::batch::Float;
    use crate::dispatch::{Work, best};

    /// Everything that a machine can do with some numbers, as numbers.
    struct Everything<T>([[T; 4]; 4]);

    impl<T: Float> Everything<T> {
        fn by<M: Machine<T>>(&self, machine: M) -> Vec<[T; 4]> {
            let [a, b, c, d] = self.0.each_ref().map(|numbers| machine.four(numbers));
            let mut all = vec![
                machine.splat(self.0[0][2]),
                machine.plus(a, b),
                machine.minus(a, b),
                machine.times(a, b),
                machine.over(a, b),
                machine.least(a, b),
                machine.greatest(a, b),
                machine.floor(a),
                machine.root(machine.times(b, b)),
            ];
            all.extend(machine.transposed([a, b, c, d]));
            all.extend(machine.unzipped([a, b]));
            all.extend(machine.zipped([a, b]));
            let mut all: Vec<_> = all.into_iter().map(|four| machine.numbers(four)).collect();
            all.push(machine.whole(machine.floor(c)).map(|number| T::from_f64(number.into())));
            let compared = [(a, b), (c, d), (a, a)].map(|(a, b)| machine.all_at_most(a, b));
            // Ends are within; a number of b is none.
            let [wide, narrow] = [[-2e9, 2e9], [-7.5, 1e9]].map(|ends| ends.map(T::from_f64));
            let within =
                [[a, c], [c, d], [a, b]].map(|it| machine.all_between(&it, &[wide, narrow]));
            for [a, b, c] in [compared, within] {
                all.push([a, b, c, false].map(|is| T::from_f64(f64::from(u8::from(is)))));
            }
            all
        }
    }

    impl<T: Float> Work for &Everything<T> {
        type Output = Vec<[T; 4]>;

        fn fused(self, machine: Fused) -> Self::Output {
            self.by(T::FusedMachine::from(machine))
        }

        fn plain(self, machine: Plain) -> Self::Output {
            self.by(T::PlainMachine::from(machine))
        }
    }

    fn alike<T: Float>() {
        let numbers = [
            [1.5, -2.5, 0.0, -0.0],
            [2.5, -3.5, f64::NAN, 1e30],
            [-1.0, 2.75, 1e9, -7.5],
            [-0.5, 3.0, 1e9, 0.25],
        ];
        let numbers = Everything(numbers.map(|row| row.map(T::from_f64)));
        let (found, expected) = (best(&numbers), numbers.by(T::PlainMachine::from(Plain)));
        // Not a number is not equal to itself; its text is.
        assert_eq!(format!("{found:?}"), format!("{expected:?}"));
    }

    #[test]
    fn machines_differ_in_sums_of_products_only() {
        alike::<f32>();
        alike::<f64>();
    }
}
