//! Points in packs of eight, whose values are adjacent for each number (array of structures of arrays).

use crate::batch::{Block, Columns, Copied, Float, Sink, Source};
use crate::places::are_numbers;
use crate::simd::Simd;

/// A pack of eight points with `N` numbers each.
pub trait Numbers<T, const N: usize> {
    /// For each number, the values of the eight points.
    fn numbers(&self) -> [&[T; 8]; N];
    /// For each number, the mutable values of the eight points.
    fn numbers_mut(&mut self) -> [&mut [T; 8]; N];
}

impl<T, const N: usize> Numbers<T, N> for [[T; 8]; N] {
    #[inline(always)]
    fn numbers(&self) -> [&[T; 8]; N] {
        self.each_ref()
    }

    #[inline(always)]
    fn numbers_mut(&mut self) -> [&mut [T; 8]; N] {
        self.each_mut()
    }
}

/// A slice of packs, as a source of points or as a sink for results.
pub struct Packed<B, const N: usize>(pub B);

impl<T: Float, B: Numbers<T, N>, const N: usize> Source<T, N> for Packed<&[B], N> {
    fn count(&self) -> usize {
        self.points()
    }

    #[inline(always)]
    fn load<M: Simd<T>>(&self, simd: M, start: usize, room: &mut Block<T, N>) {
        self.copy(simd, start, &mut room.0);
    }

    #[inline(always)]
    fn columns<'a>(&'a self, _: usize, room: &'a Block<T, N>) -> Columns<'a, T, N> {
        room.0.each_ref()
    }
}

impl<T: Float, B: Numbers<T, N>, const N: usize> Copied<T> for Packed<&[B], N> {
    const NUMBERS: usize = N;

    fn points(&self) -> usize {
        8 * self.0.len()
    }

    #[inline(always)]
    fn copy<M: Simd<T>>(&self, _: M, start: usize, lanes: &mut [T::Column]) {
        let packs = &self.0[start / 8..];
        let packs = &packs[..packs.len().min(T::BLOCK / 8)];
        for (pack, place) in packs.iter().zip((0..T::BLOCK).step_by(8)) {
            for (lane, numbers) in lanes.iter_mut().zip(pack.numbers()) {
                T::numbers_mut(lane)[place..place + 8].copy_from_slice(numbers);
            }
        }
        for (lane, numbers) in lanes.iter_mut().zip(packs[0].numbers()) {
            T::numbers_mut(lane)[8 * packs.len()..].fill(numbers[0]);
        }
    }
}

impl<T: Float, B: Numbers<T, N>, const N: usize> Sink<T, N> for Packed<&mut [B], N> {
    fn room(&self) -> usize {
        8 * self.0.len()
    }

    #[inline(always)]
    fn store<M: Simd<T>>(&mut self, simd: M, start: usize, block: &Block<T, N>) -> bool {
        for (pack, place) in self.0[start / 8..].iter_mut().zip((0..T::BLOCK).step_by(8)) {
            for (to, lane) in pack.numbers_mut().into_iter().zip(&block.0) {
                to.copy_from_slice(&T::numbers(lane)[place..place + 8]);
            }
        }
        are_numbers(simd, block)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::vec::Vec;

    use super::Packed;
    use crate::batch::{Function, Kernel, Lift, Points, run};

    /// x y and x + 2 y.
    pub(crate) struct Both;

    impl<S: crate::Real> Function<S, 2, 2> for Both {
        #[inline(always)]
        fn at(&self, [x, y]: [S; 2]) -> [S; 2] {
            [x * y, x + S::from_f64(2.0) * y]
        }
    }

    impl Kernel<f64, 2, 2> for Both {
        #[inline(always)]
        fn drive<S: Lift<f64>>(&self, points: &mut impl Points<S, 2, 2>) {
            points.each(self);
        }
    }

    #[test]
    fn packs_are_evaluated_as_points_are() {
        for count in [1, 7, 8, 9, 25] {
            let number = |k: usize| (0.3 + 0.7 * k as f64).sin();
            let points: Vec<_> =
                (0..8 * count).map(|k| [number(2 * k), number(2 * k + 1)]).collect();
            let pack = |b: usize| [0, 1].map(|n| core::array::from_fn(|k| points[8 * b + k][n]));
            let packs: Vec<[[f64; 8]; 2]> = (0..count).map(pack).collect();
            let mut results = packs.clone();
            run(&Both, &Packed(&packs[..]), &mut Packed(&mut results[..]));
            let mut expected = points.clone();
            run(&Both, &&points[..], &mut &mut expected[..]);
            let mut mixed = packs.clone();
            let first: Vec<_> = points.iter().map(|[x, _]| [*x]).collect();
            let second: Vec<_> = packs.iter().map(|[_, y]| [*y]).collect();
            run(&Both, &(&first[..], Packed(&second[..])), &mut Packed(&mut mixed[..]));
            for (k, expected) in expected.iter().enumerate() {
                let found = [0, 1].map(|n| results[k / 8][n][k % 8]);
                assert_eq!((found, mixed[k / 8][0][k % 8]), (*expected, expected[0]));
            }
        }
    }
}
