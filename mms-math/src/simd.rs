//! Eight numbers at a time (a SIMD pack), in one register if the processor has such registers.
//!
//! The compiler turns a loop over many numbers into vector instructions by itself ([`crate::batch`]), but often not eight
//! numbers in long code. Here eight numbers are one value.
//!
//! Eight numbers are two halves of four. Operations move numbers only within a half, which takes one instruction: so the two
//! halves may belong to different cells or nodes.

mod arrays;
#[cfg(target_arch = "x86_64")]
mod registers;

use crate::batch::Lift;
use crate::dispatch::Work;

/// An instruction set that computes with eight numbers together.
pub trait Simd<T>: Copy {
    /// Eight numbers.
    type Eight: Copy;

    /// Whether eight numbers are computed one after the other: then code for eight at a time is longer and not faster.
    const ALONE: bool = false;

    /// A number of a loop that the compiler turns into vector instructions.
    type Lane: Lift<T>;

    /// Loads numbers.
    fn eight(self, numbers: &[T; 8]) -> Self::Eight;

    /// Loads the numbers of the first half, and of the second.
    fn halves(self, first: &[T; 4], second: &[T; 4]) -> Self::Eight;

    /// Does work in a function that is not inlined, and so is compiled once for all callers, for these instructions ([`Plain`]:
    /// the instructions that every processor has). For work that takes long compared with a call.
    fn apart<W: Work<T>>(self, work: W) -> W::Output;

    /// One number in all eight places.
    fn splat(self, number: T) -> Self::Eight;

    /// One number in all places of the first half, and another in all places of the second.
    fn splat_halves(self, first: T, second: T) -> Self::Eight;

    /// Stores the numbers.
    fn numbers(self, eight: Self::Eight) -> [T; 8];

    /// Adds the first half to `to`.
    fn add_first(self, to: &mut [T; 4], eight: Self::Eight);

    /// Adds the second half to `to`.
    fn add_second(self, to: &mut [T; 4], eight: Self::Eight);

    /// Adds both halves to `to`.
    fn add_halves(self, to: &mut [T; 4], eight: Self::Eight);

    /// a + b.
    fn plus(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;

    /// a - b.
    fn minus(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;

    /// a b.
    fn times(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;

    /// a b + c.
    fn times_plus(self, a: Self::Eight, b: Self::Eight, c: Self::Eight) -> Self::Eight;

    /// a / b.
    fn over(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;

    /// a if it is less than b, else b: so b if one of them is NaN.
    fn least(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;

    /// a if it is greater than b, else b: so b if one of them is NaN.
    fn greatest(self, a: Self::Eight, b: Self::Eight) -> Self::Eight;

    /// The square roots.
    fn root(self, a: Self::Eight) -> Self::Eight;

    /// The largest integers that are at most these numbers.
    fn floor(self, a: Self::Eight) -> Self::Eight;

    /// Whether a <= b for all eight.
    fn all_at_most(self, a: Self::Eight, b: Self::Eight) -> bool;

    /// Whether all eight numbers of each entry lie between the entry's two `ends`: one test and one branch for all.
    fn all_between<const N: usize>(self, numbers: &[Self::Eight; N], ends: &[[T; 2]; N]) -> bool;

    /// Converts numbers that are integers between -2^31 and 2^31. Other numbers become unspecified integers.
    fn whole(self, a: Self::Eight) -> [i32; 8];

    /// For each place in a half: the number there, in all places of its half.
    fn spread(self, a: Self::Eight) -> [Self::Eight; 4];

    /// In each half, the first numbers of all four rows, then the second ones, and so on.
    fn transposed(self, rows: [Self::Eight; 4]) -> [Self::Eight; 4];

    /// The first numbers of eight pairs, four of which are in each row, and the second numbers.
    fn unzipped(self, rows: [Self::Eight; 2]) -> [Self::Eight; 2];

    /// Eight pairs of a first and a second number, four in each row.
    fn zipped(self, columns: [Self::Eight; 2]) -> [Self::Eight; 2];

    /// Prefetches the value in that place; does nothing if there is none.
    fn fetch<V>(self, values: &[V], place: usize);
}

/// One number after the other: works on every processor.
#[derive(Clone, Copy, Debug)]
pub struct Plain;

/// Multiply-adds that round once. A value exists only if the processor is known to have them ([`crate::dispatch`]).
#[derive(Clone, Copy, Debug)]
pub struct Fused(());

impl Fused {
    /// To be called only in a function that is compiled for AVX2 and FMA, on a processor that has them; on aarch64 every
    /// processor has such instructions.
    #[cfg_attr(not(any(target_arch = "x86_64", target_arch = "aarch64")), allow(dead_code))]
    pub(crate) fn known() -> Self {
        Fused(())
    }
}

/// Multiply-adds that round once, with registers for eight numbers of double precision.
#[derive(Clone, Copy, Debug)]
pub struct Wide(());

impl Wide {
    /// To be called only on a processor with AVX-512, in a function compiled for it.
    #[cfg_attr(any(not(target_arch = "x86_64"), debug_assertions), allow(dead_code))]
    pub(crate) fn known() -> Self {
        Wide(())
    }
}

impl From<Wide> for Fused {
    fn from(_: Wide) -> Self {
        Fused(())
    }
}

#[cfg(test)]
mod tests {
    use std::format;
    use std::vec;
    use std::vec::Vec;

    use super::{Plain, Simd};
    use crate::batch::Float;
    use crate::dispatch::{Work, best};

    /// All operations of an instruction set, applied to some numbers.
    struct Everything<T>([[T; 8]; 4]);

    impl<T: Float> Everything<T> {
        fn by<M: Simd<T>>(&self, simd: M) -> Vec<[T; 8]> {
            let [a, b, c, d] = self.0.each_ref().map(|numbers| simd.eight(numbers));
            let (one, two) = (self.0[0][2], self.0[3][5]);
            let [first, second, ..] = *self.0[1].as_chunks::<4>().0 else { unreachable!() };
            let mut all = vec![
                simd.halves(&second, &first),
                simd.splat(one),
                simd.splat_halves(one, two),
                simd.plus(a, b),
                simd.minus(a, b),
                simd.times(a, b),
                simd.over(a, b),
                simd.least(a, b),
                simd.greatest(a, b),
                simd.floor(a),
                simd.root(simd.times(b, b)),
            ];
            all.extend(simd.spread(a));
            all.extend(simd.transposed([a, b, c, d]));
            all.extend(simd.unzipped([a, b]));
            all.extend(simd.zipped([a, b]));
            let mut all: Vec<_> = all.into_iter().map(|eight| simd.numbers(eight)).collect();
            all.push(simd.whole(simd.floor(c)).map(|number| T::from_f64(number.into())));
            let compared = [(a, b), (c, d), (a, a)].map(|(a, b)| simd.all_at_most(a, b));
            // Ends are within; one number of b is NaN.
            let [wide, narrow] = [[-2e9, 2e9], [-7.5, 1e9]].map(|ends| ends.map(T::from_f64));
            let within = [[a, c], [c, d], [a, b]].map(|it| simd.all_between(&it, &[wide, narrow]));
            all.extend([compared, within].map(|[a, b, c]| {
                let told = [a, b, c, a, b, c, a, b];
                told.map(|is| T::from_f64(f64::from(u8::from(is))))
            }));
            let mut sums = [first; 3];
            simd.add_first(&mut sums[0], d);
            simd.add_second(&mut sums[1], d);
            simd.add_halves(&mut sums[2], d);
            all.extend(sums.map(|sum| simd.numbers(simd.halves(&sum, &first))));
            all
        }
    }

    impl<T: Float> Work<T> for &Everything<T> {
        type Output = Vec<[T; 8]>;

        fn on<M: Simd<T>>(self, simd: M) -> Self::Output {
            self.by(simd)
        }
    }

    fn alike<T: Float>() {
        let numbers = [
            [1.5, -2.5, 0.0, -0.0, 7.5, 8.25, -9.0, 1.25],
            [2.5, -3.5, f64::NAN, 1e30, -0.75, 8.5, 3.5, -1e3],
            [-1.0, 2.75, 1e9, -7.5, 12.5, 0.5, -6.25, 3.0],
            [-0.5, 3.0, 1e9, 0.25, 12.5, 0.75, -6.0, 4.0],
        ];
        let numbers = Everything(numbers.map(|row| row.map(T::from_f64)));
        let (found, expected) = (best(&numbers), numbers.by(T::PlainSimd::from(Plain)));
        // NaN is not equal to itself; its text is.
        assert_eq!(format!("{found:?}"), format!("{expected:?}"));
    }

    #[test]
    fn machines_differ_in_sums_of_products_only() {
        alike::<f32>();
        alike::<f64>();
    }

    /// Row r has the numbers 10 r, 10 r + 1, ..
    fn move_numbers<M: Simd<f64>>(simd: M) {
        let row = |r: usize| std::array::from_fn(|k| (10 * r + k) as f64);
        let rows: [[f64; 8]; 4] = std::array::from_fn(row);
        let [a, b, c, d] = rows.each_ref().map(|row| simd.eight(row));
        let [first, ..] = simd.transposed([a, b, c, d]);
        assert_eq!(simd.numbers(first), [0.0, 10.0, 20.0, 30.0, 4.0, 14.0, 24.0, 34.0]);
        let [_, _, third, _] = simd.spread(b);
        assert_eq!(simd.numbers(third), [12.0, 12.0, 12.0, 12.0, 16.0, 16.0, 16.0, 16.0]);
        let pairs = simd.unzipped([a, b]);
        assert_eq!(simd.numbers(pairs[1]), [1.0, 3.0, 5.0, 7.0, 11.0, 13.0, 15.0, 17.0]);
        assert_eq!(simd.zipped(pairs).map(|row| simd.numbers(row)), [rows[0], rows[1]]);
    }

    #[test]
    fn what_is_moved_stays_in_its_half() {
        move_numbers(Plain);
    }
}
