//! Eight numbers as an array, for processors without a known register for them.

use super::{Plain, Simd};
use crate::dispatch::Work;
use crate::lane::Lane;

macro_rules! arrays {
    ($($simd:ident $float:ident $fused:literal $times_plus:expr;)*) => {
        $(
            impl Simd<$float> for $simd {
                type Eight = [$float; 8];
                type Lane = Lane<$float, $fused>;
                // The compiler uses the registers of processors that multiply and add in one step.
                const ALONE: bool = !$fused;

                #[inline(never)]
                fn apart<W: Work<$float>>(self, work: W) -> W::Output {
                    work.on(self)
                }

                #[inline(always)]
                fn eight(self, numbers: &[$float; 8]) -> [$float; 8] {
                    *numbers
                }

                #[inline(always)]
                fn halves(self, [a, b, c, d]: &[$float; 4], [e, f, g, h]: &[$float; 4]) -> [$float; 8] {
                    [*a, *b, *c, *d, *e, *f, *g, *h]
                }

                #[inline(always)]
                fn splat(self, number: $float) -> [$float; 8] {
                    [number; 8]
                }

                #[inline(always)]
                fn splat_halves(self, a: $float, b: $float) -> [$float; 8] {
                    [a, a, a, a, b, b, b, b]
                }

                #[inline(always)]
                fn numbers(self, eight: [$float; 8]) -> [$float; 8] {
                    eight
                }

                #[inline(always)]
                fn add_first(self, to: &mut [$float; 4], eight: [$float; 8]) {
                    for k in 0..4 {
                        to[k] += eight[k];
                    }
                }

                #[inline(always)]
                fn add_second(self, to: &mut [$float; 4], eight: [$float; 8]) {
                    for k in 0..4 {
                        to[k] += eight[k + 4];
                    }
                }

                #[inline(always)]
                fn add_halves(self, to: &mut [$float; 4], eight: [$float; 8]) {
                    for k in 0..4 {
                        to[k] += eight[k] + eight[k + 4];
                    }
                }

                #[inline(always)]
                fn plus(self, mut a: [$float; 8], b: [$float; 8]) -> [$float; 8] {
                    for k in 0..8 {
                        a[k] += b[k];
                    }
                    a
                }

                #[inline(always)]
                fn minus(self, mut a: [$float; 8], b: [$float; 8]) -> [$float; 8] {
                    for k in 0..8 {
                        a[k] -= b[k];
                    }
                    a
                }

                #[inline(always)]
                fn times(self, mut a: [$float; 8], b: [$float; 8]) -> [$float; 8] {
                    for k in 0..8 {
                        a[k] *= b[k];
                    }
                    a
                }

                #[inline(always)]
                fn times_plus(
                    self,
                    mut a: [$float; 8],
                    b: [$float; 8],
                    c: [$float; 8],
                ) -> [$float; 8] {
                    for k in 0..8 {
                        a[k] = $times_plus(a[k], b[k], c[k]);
                    }
                    a
                }

                #[inline(always)]
                fn over(self, mut a: [$float; 8], b: [$float; 8]) -> [$float; 8] {
                    for k in 0..8 {
                        a[k] /= b[k];
                    }
                    a
                }

                #[inline(always)]
                fn least(self, mut a: [$float; 8], b: [$float; 8]) -> [$float; 8] {
                    for k in 0..8 {
                        a[k] = if a[k] < b[k] { a[k] } else { b[k] };
                    }
                    a
                }

                #[inline(always)]
                fn greatest(self, mut a: [$float; 8], b: [$float; 8]) -> [$float; 8] {
                    for k in 0..8 {
                        a[k] = if a[k] > b[k] { a[k] } else { b[k] };
                    }
                    a
                }

                #[inline(always)]
                fn root(self, a: [$float; 8]) -> [$float; 8] {
                    core::array::from_fn(|k| a[k].sqrt())
                }

                #[inline(always)]
                fn floor(self, a: [$float; 8]) -> [$float; 8] {
                    core::array::from_fn(|k| a[k].floor())
                }

                #[inline(always)]
                fn all_at_most(self, a: [$float; 8], b: [$float; 8]) -> bool {
                    a.iter().zip(&b).all(|(a, b)| a <= b)
                }

                #[inline(always)]
                fn all_between<const N: usize>(
                    self,
                    numbers: &[[$float; 8]; N],
                    ends: &[[$float; 2]; N],
                ) -> bool {
                    let is_between = |number: &$float, [first, last]: &[$float; 2]| {
                        first <= number && number <= last
                    };
                    let mut pairs = numbers.iter().zip(ends);
                    pairs.all(|(eight, ends)| eight.iter().all(|number| is_between(number, ends)))
                }

                #[inline(always)]
                fn whole(self, a: [$float; 8]) -> [i32; 8] {
                    core::array::from_fn(|k| a[k] as i32)
                }

                #[inline(always)]
                fn spread(self, a: [$float; 8]) -> [[$float; 8]; 4] {
                    let of = |k: usize| self.splat_halves(a[k], a[k + 4]);
                    [of(0), of(1), of(2), of(3)]
                }

                #[inline(always)]
                fn transposed(self, rows: [[$float; 8]; 4]) -> [[$float; 8]; 4] {
                    let mut columns = rows;
                    for k in 0..4 {
                        for row in 0..4 {
                            columns[k][row] = rows[row][k];
                            columns[k][4 + row] = rows[row][4 + k];
                        }
                    }
                    columns
                }

                #[inline(always)]
                fn unzipped(self, rows: [[$float; 8]; 2]) -> [[$float; 8]; 2] {
                    let pairs = rows.as_flattened();
                    [0, 1].map(|which| core::array::from_fn(|k| pairs[2 * k + which]))
                }

                #[inline(always)]
                fn zipped(self, columns: [[$float; 8]; 2]) -> [[$float; 8]; 2] {
                    let row = |row: usize| core::array::from_fn(|k| columns[k % 2][4 * row + k / 2]);
                    [row(0), row(1)]
                }

                #[inline(always)]
                fn fetch<V>(self, _: &[V], _: usize) {}
            }
        )*
    };
}

arrays! {
    Plain f32 false |a: f32, b: f32, c: f32| a * b + c;
    Plain f64 false |a: f64, b: f64, c: f64| a * b + c;
}

#[cfg(not(target_arch = "x86_64"))]
use super::Fused;

#[cfg(not(target_arch = "x86_64"))]
arrays! {
    Fused f32 true f32::mul_add;
    Fused f64 true f64::mul_add;
}
