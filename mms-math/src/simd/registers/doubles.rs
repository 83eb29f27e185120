//! Double precision: two registers of 256 bits.

#![allow(unsafe_code)]

use core::arch::x86_64::*;

use crate::dispatch::{Work, avx2};
use crate::lane::Lane;
use crate::simd::{Fused, Simd};

impl Simd<f64> for Fused {
    type Eight = [__m256d; 2];
    type Lane = Lane<f64, true>;

    alike! { two:
        plus(a, b) _mm256_add_pd;
        minus(a, b) _mm256_sub_pd;
        times(a, b) _mm256_mul_pd;
        times_plus(a, b, c) _mm256_fmadd_pd;
        over(a, b) _mm256_div_pd;
        least(a, b) _mm256_min_pd;
        greatest(a, b) _mm256_max_pd;
        root(a) _mm256_sqrt_pd;
        floor(a) _mm256_floor_pd;
    }
    common!(f64);

    #[inline(always)]
    fn apart<W: Work<f64>>(self, work: W) -> W::Output {
        // Safety: a `Fused` exists only with AVX2 and FMA.
        unsafe { avx2(work) }
    }

    #[inline(always)]
    fn eight(self, numbers: &[f64; 8]) -> [__m256d; 2] {
        let [first, second] = [numbers.as_ptr(), numbers[4..].as_ptr()];
        unsafe { [_mm256_loadu_pd(first), _mm256_loadu_pd(second)] }
    }

    #[inline(always)]
    fn halves(self, first: &[f64; 4], second: &[f64; 4]) -> [__m256d; 2] {
        unsafe { [_mm256_loadu_pd(first.as_ptr()), _mm256_loadu_pd(second.as_ptr())] }
    }

    #[inline(always)]
    fn splat(self, number: f64) -> [__m256d; 2] {
        unsafe { [_mm256_set1_pd(number); 2] }
    }

    #[inline(always)]
    fn splat_halves(self, first: f64, second: f64) -> [__m256d; 2] {
        unsafe { [_mm256_set1_pd(first), _mm256_set1_pd(second)] }
    }

    #[inline(always)]
    fn numbers(self, [first, second]: [__m256d; 2]) -> [f64; 8] {
        let mut numbers = [0.0; 8];
        unsafe {
            _mm256_storeu_pd(numbers.as_mut_ptr(), first);
            _mm256_storeu_pd(numbers[4..].as_mut_ptr(), second);
        }
        numbers
    }

    #[inline(always)]
    fn add_halves(self, to: &mut [f64; 4], [first, second]: [__m256d; 2]) {
        add(to, unsafe { _mm256_add_pd(first, second) });
    }

    #[inline(always)]
    fn all_at_most(self, a: [__m256d; 2], b: [__m256d; 2]) -> bool {
        unsafe {
            let first = _mm256_cmp_pd::<_CMP_LE_OQ>(a[0], b[0]);
            let second = _mm256_cmp_pd::<_CMP_LE_OQ>(a[1], b[1]);
            _mm256_movemask_pd(_mm256_and_pd(first, second)) == 0b1111
        }
    }

    #[inline(always)]
    fn all_between<const N: usize>(
        self,
        numbers: &[[__m256d; 2]; N],
        ends: &[[f64; 2]; N],
    ) -> bool {
        let [mut all, _] = self.splat(f64::from_bits(!0));
        for (numbers, [first, last]) in numbers.iter().zip(ends) {
            for number in numbers {
                unsafe {
                    let (first, last) = (_mm256_set1_pd(*first), _mm256_set1_pd(*last));
                    all = _mm256_and_pd(all, _mm256_cmp_pd::<_CMP_LE_OQ>(first, *number));
                    all = _mm256_and_pd(all, _mm256_cmp_pd::<_CMP_LE_OQ>(*number, last));
                }
            }
        }
        unsafe { _mm256_movemask_pd(all) == 0b1111 }
    }

    #[inline(always)]
    fn whole(self, [first, second]: [__m256d; 2]) -> [i32; 8] {
        let mut numbers = [0; 8];
        unsafe {
            let both = _mm256_set_m128i(_mm256_cvttpd_epi32(second), _mm256_cvttpd_epi32(first));
            _mm256_storeu_si256(numbers.as_mut_ptr().cast(), both);
        }
        numbers
    }

    #[inline(always)]
    fn spread(self, [first, second]: [__m256d; 2]) -> [[__m256d; 2]; 4] {
        let [a, b] = [spread(first), spread(second)];
        [[a[0], b[0]], [a[1], b[1]], [a[2], b[2]], [a[3], b[3]]]
    }

    #[inline(always)]
    fn transposed(self, [a, b, c, d]: [[__m256d; 2]; 4]) -> [[__m256d; 2]; 4] {
        let first = transposed([a[0], b[0], c[0], d[0]]);
        let second = transposed([a[1], b[1], c[1], d[1]]);
        [[first[0], second[0]], [first[1], second[1]], [first[2], second[2]], [first[3], second[3]]]
    }

    #[inline(always)]
    fn unzipped(self, [a, b]: [[__m256d; 2]; 2]) -> [[__m256d; 2]; 2] {
        let [[a, b], [c, d]] = [unzipped(a), unzipped(b)];
        [[a, c], [b, d]]
    }

    #[inline(always)]
    fn zipped(self, [[a, c], [b, d]]: [[__m256d; 2]; 2]) -> [[__m256d; 2]; 2] {
        [zipped([a, b]), zipped([c, d])]
    }
}

#[inline(always)]
fn spread(a: __m256d) -> [__m256d; 4] {
    unsafe {
        [
            _mm256_permute4x64_pd::<0b00_00_00_00>(a),
            _mm256_permute4x64_pd::<0b01_01_01_01>(a),
            _mm256_permute4x64_pd::<0b10_10_10_10>(a),
            _mm256_permute4x64_pd::<0b11_11_11_11>(a),
        ]
    }
}

#[inline(always)]
fn transposed([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
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

#[inline(always)]
fn unzipped([a, b]: [__m256d; 2]) -> [__m256d; 2] {
    unsafe {
        // The pairs 0 and 2, then 1 and 3.
        let even = _mm256_permute2f128_pd::<0x20>(a, b);
        let odd = _mm256_permute2f128_pd::<0x31>(a, b);
        [_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)]
    }
}

#[inline(always)]
fn zipped([a, b]: [__m256d; 2]) -> [__m256d; 2] {
    unsafe {
        let (even, odd) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        [_mm256_permute2f128_pd::<0x20>(even, odd), _mm256_permute2f128_pd::<0x31>(even, odd)]
    }
}

/// The two halves.
#[inline(always)]
fn fours(eight: [__m256d; 2]) -> [__m256d; 2] {
    eight
}

#[inline(always)]
pub(super) fn add(to: &mut [f64; 4], four: __m256d) {
    unsafe { _mm256_storeu_pd(to.as_mut_ptr(), _mm256_add_pd(_mm256_loadu_pd(to.as_ptr()), four)) };
}
