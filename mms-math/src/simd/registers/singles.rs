//! Single precision: one register of 256 bits.

#![allow(unsafe_code)]

use core::arch::x86_64::*;

use crate::dispatch::{Work, avx2};
use crate::lane::Lane;
use crate::simd::{Fused, Simd};

impl Simd<f32> for Fused {
    type Eight = __m256;
    type Lane = Lane<f32, true>;

    alike! { one:
        plus(a, b) _mm256_add_ps;
        minus(a, b) _mm256_sub_ps;
        times(a, b) _mm256_mul_ps;
        times_plus(a, b, c) _mm256_fmadd_ps;
        over(a, b) _mm256_div_ps;
        least(a, b) _mm256_min_ps;
        greatest(a, b) _mm256_max_ps;
        root(a) _mm256_sqrt_ps;
        floor(a) _mm256_floor_ps;
    }
    common!(f32);

    #[inline(always)]
    fn apart<W: Work<f32>>(self, work: W) -> W::Output {
        // Safety: a `Fused` exists only with AVX2 and FMA.
        unsafe { avx2(work) }
    }

    #[inline(always)]
    fn eight(self, numbers: &[f32; 8]) -> __m256 {
        unsafe { _mm256_loadu_ps(numbers.as_ptr()) }
    }

    #[inline(always)]
    fn halves(self, first: &[f32; 4], second: &[f32; 4]) -> __m256 {
        unsafe { _mm256_set_m128(_mm_loadu_ps(second.as_ptr()), _mm_loadu_ps(first.as_ptr())) }
    }

    #[inline(always)]
    fn splat(self, number: f32) -> __m256 {
        unsafe { _mm256_set1_ps(number) }
    }

    #[inline(always)]
    fn splat_halves(self, first: f32, second: f32) -> __m256 {
        unsafe { _mm256_set_m128(_mm_set1_ps(second), _mm_set1_ps(first)) }
    }

    #[inline(always)]
    fn numbers(self, eight: __m256) -> [f32; 8] {
        let mut numbers = [0.0; 8];
        unsafe { _mm256_storeu_ps(numbers.as_mut_ptr(), eight) };
        numbers
    }

    #[inline(always)]
    fn add_halves(self, to: &mut [f32; 4], eight: __m256) {
        let [first, second] = fours(eight);
        add(to, unsafe { _mm_add_ps(first, second) });
    }

    #[inline(always)]
    fn all_at_most(self, a: __m256, b: __m256) -> bool {
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b)) == 0xff }
    }

    #[inline(always)]
    fn all_between<const N: usize>(self, numbers: &[__m256; N], ends: &[[f32; 2]; N]) -> bool {
        let mut all = self.splat(f32::from_bits(!0));
        for (number, [first, last]) in numbers.iter().zip(ends) {
            let (first, last) = (self.splat(*first), self.splat(*last));
            unsafe {
                all = _mm256_and_ps(all, _mm256_cmp_ps::<_CMP_LE_OQ>(first, *number));
                all = _mm256_and_ps(all, _mm256_cmp_ps::<_CMP_LE_OQ>(*number, last));
            }
        }
        unsafe { _mm256_movemask_ps(all) == 0xff }
    }

    #[inline(always)]
    fn whole(self, a: __m256) -> [i32; 8] {
        let mut numbers = [0; 8];
        unsafe { _mm256_storeu_si256(numbers.as_mut_ptr().cast(), _mm256_cvttps_epi32(a)) };
        numbers
    }

    #[inline(always)]
    fn spread(self, a: __m256) -> [__m256; 4] {
        unsafe {
            [
                _mm256_permute_ps::<0b00_00_00_00>(a),
                _mm256_permute_ps::<0b01_01_01_01>(a),
                _mm256_permute_ps::<0b10_10_10_10>(a),
                _mm256_permute_ps::<0b11_11_11_11>(a),
            ]
        }
    }

    #[inline(always)]
    fn transposed(self, [a, b, c, d]: [__m256; 4]) -> [__m256; 4] {
        unsafe {
            // Of a and b, in each half: the numbers 0 and 1, then 2 and 3; likewise of c and d. These are moved as pairs.
            let low = _mm256_castps_pd(_mm256_unpacklo_ps(a, b));
            let high = _mm256_castps_pd(_mm256_unpackhi_ps(a, b));
            let more_low = _mm256_castps_pd(_mm256_unpacklo_ps(c, d));
            let more_high = _mm256_castps_pd(_mm256_unpackhi_ps(c, d));
            [
                _mm256_castpd_ps(_mm256_unpacklo_pd(low, more_low)),
                _mm256_castpd_ps(_mm256_unpackhi_pd(low, more_low)),
                _mm256_castpd_ps(_mm256_unpacklo_pd(high, more_high)),
                _mm256_castpd_ps(_mm256_unpackhi_pd(high, more_high)),
            ]
        }
    }

    #[inline(always)]
    fn unzipped(self, [a, b]: [__m256; 2]) -> [__m256; 2] {
        unsafe {
            // In each half, two numbers of a before two of b.
            let first = _mm256_shuffle_ps::<0b10_00_10_00>(a, b);
            let second = _mm256_shuffle_ps::<0b11_01_11_01>(a, b);
            [swap_inner_pairs(first), swap_inner_pairs(second)]
        }
    }

    #[inline(always)]
    fn zipped(self, [a, b]: [__m256; 2]) -> [__m256; 2] {
        unsafe {
            let (a, b) = (swap_inner_pairs(a), swap_inner_pairs(b));
            [_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b)]
        }
    }
}

/// The pairs 0, 2, 1, 3 of numbers. Safety: the processor has AVX2.
#[inline(always)]
unsafe fn swap_inner_pairs(a: __m256) -> __m256 {
    unsafe { _mm256_castpd_ps(_mm256_permute4x64_pd::<0b11_01_10_00>(_mm256_castps_pd(a))) }
}

/// The two halves.
#[inline(always)]
fn fours(eight: __m256) -> [__m128; 2] {
    unsafe { [_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight)] }
}

#[inline(always)]
fn add(to: &mut [f32; 4], four: __m128) {
    unsafe { _mm_storeu_ps(to.as_mut_ptr(), _mm_add_ps(_mm_loadu_ps(to.as_ptr()), four)) };
}
