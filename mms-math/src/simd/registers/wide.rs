//! Double precision: one register of 512 bits.

#![allow(unsafe_code)]

use core::arch::x86_64::*;

use super::doubles::add;
use crate::dispatch::{Work, avx512};
use crate::lane::Lane;
use crate::simd::{Simd, Wide};

impl Simd<f64> for Wide {
    type Eight = __m512d;
    type Lane = Lane<f64, true>;

    alike! { one:
        plus(a, b) _mm512_add_pd;
        minus(a, b) _mm512_sub_pd;
        times(a, b) _mm512_mul_pd;
        times_plus(a, b, c) _mm512_fmadd_pd;
        over(a, b) _mm512_div_pd;
        least(a, b) _mm512_min_pd;
        greatest(a, b) _mm512_max_pd;
        root(a) _mm512_sqrt_pd;
    }
    common!(f64);

    #[inline(always)]
    fn apart<W: Work<f64>>(self, work: W) -> W::Output {
        // Safety: a `Wide` exists only with AVX-512.
        unsafe { avx512(work) }
    }

    #[inline(always)]
    fn eight(self, numbers: &[f64; 8]) -> __m512d {
        unsafe { _mm512_loadu_pd(numbers.as_ptr()) }
    }

    #[inline(always)]
    fn halves(self, first: &[f64; 4], second: &[f64; 4]) -> __m512d {
        let [first, second] = [first.as_ptr(), second.as_ptr()];
        unsafe { join(_mm256_loadu_pd(first), _mm256_loadu_pd(second)) }
    }

    #[inline(always)]
    fn splat(self, number: f64) -> __m512d {
        unsafe { _mm512_set1_pd(number) }
    }

    #[inline(always)]
    fn splat_halves(self, first: f64, second: f64) -> __m512d {
        unsafe { join(_mm256_set1_pd(first), _mm256_set1_pd(second)) }
    }

    #[inline(always)]
    fn numbers(self, eight: __m512d) -> [f64; 8] {
        let mut numbers = [0.0; 8];
        unsafe { _mm512_storeu_pd(numbers.as_mut_ptr(), eight) };
        numbers
    }

    #[inline(always)]
    fn add_halves(self, to: &mut [f64; 4], eight: __m512d) {
        let [first, second] = fours(eight);
        add(to, unsafe { _mm256_add_pd(first, second) });
    }

    #[inline(always)]
    fn floor(self, a: __m512d) -> __m512d {
        // Rounds down, without an exception if the number is not an integer.
        unsafe { _mm512_roundscale_pd::<0b1001>(a) }
    }

    #[inline(always)]
    fn all_at_most(self, a: __m512d, b: __m512d) -> bool {
        unsafe { _mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b) == 0xff }
    }

    #[inline(always)]
    fn all_between<const N: usize>(self, numbers: &[__m512d; N], ends: &[[f64; 2]; N]) -> bool {
        let mut all = 0xff;
        for (number, [first, last]) in numbers.iter().zip(ends) {
            let (first, last) = (self.splat(*first), self.splat(*last));
            unsafe {
                all = _mm512_mask_cmp_pd_mask::<_CMP_LE_OQ>(all, first, *number);
                all = _mm512_mask_cmp_pd_mask::<_CMP_LE_OQ>(all, *number, last);
            }
        }
        all == 0xff
    }

    #[inline(always)]
    fn whole(self, a: __m512d) -> [i32; 8] {
        let mut numbers = [0; 8];
        unsafe { _mm256_storeu_si256(numbers.as_mut_ptr().cast(), _mm512_cvttpd_epi32(a)) };
        numbers
    }

    #[inline(always)]
    fn spread(self, a: __m512d) -> [__m512d; 4] {
        unsafe {
            [
                _mm512_permutex_pd::<0b00_00_00_00>(a),
                _mm512_permutex_pd::<0b01_01_01_01>(a),
                _mm512_permutex_pd::<0b10_10_10_10>(a),
                _mm512_permutex_pd::<0b11_11_11_11>(a),
            ]
        }
    }

    #[inline(always)]
    fn transposed(self, [a, b, c, d]: [__m512d; 4]) -> [__m512d; 4] {
        unsafe {
            // Of a and b, in each half: the numbers 0 and 2, then 1 and 3; likewise of c and d.
            let (even, odd) = (_mm512_unpacklo_pd(a, b), _mm512_unpackhi_pd(a, b));
            let (more_even, more_odd) = (_mm512_unpacklo_pd(c, d), _mm512_unpackhi_pd(c, d));
            // The first pair of each half of both; then the second pair.
            let firsts = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
            let seconds = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
            [
                _mm512_permutex2var_pd(even, firsts, more_even),
                _mm512_permutex2var_pd(odd, firsts, more_odd),
                _mm512_permutex2var_pd(even, seconds, more_even),
                _mm512_permutex2var_pd(odd, seconds, more_odd),
            ]
        }
    }

    #[inline(always)]
    fn unzipped(self, [a, b]: [__m512d; 2]) -> [__m512d; 2] {
        unsafe {
            let even = _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14);
            let odd = _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15);
            [_mm512_permutex2var_pd(a, even, b), _mm512_permutex2var_pd(a, odd, b)]
        }
    }

    #[inline(always)]
    fn zipped(self, [a, b]: [__m512d; 2]) -> [__m512d; 2] {
        unsafe {
            let low = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11);
            let high = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
            [_mm512_permutex2var_pd(a, low, b), _mm512_permutex2var_pd(a, high, b)]
        }
    }
}

/// Both halves as one. Safety: the processor has AVX-512.
#[inline(always)]
unsafe fn join(first: __m256d, second: __m256d) -> __m512d {
    unsafe { _mm512_insertf64x4::<1>(_mm512_castpd256_pd512(first), second) }
}

/// The two halves.
#[inline(always)]
fn fours(eight: __m512d) -> [__m256d; 2] {
    unsafe { [_mm512_castpd512_pd256(eight), _mm512_extractf64x4_pd::<1>(eight)] }
}
