//! Transposes arrays of structures: a register holds the same component of eight structures. Transposes back, too.
//!
//! Four numbers of each of the eight structures are moved at a time. The compiler would load them one by one, from all over the
//! memory.

use crate::simd::Simd;

/// Loads the columns of eight structures, whose `numbers` are stored one structure after the other: for each number, its values
/// in the eight structures.
///
/// # Panics
/// If there are fewer numbers than in eight structures.
#[inline(always)]
pub fn take_columns<T: Copy, M: Simd<T>>(simd: M, numbers: &[T], columns: &mut [M::Eight]) {
    let n = columns.len();
    let numbers = &numbers[..8 * n];
    if n == 2 {
        let rows = [simd.eight(some(numbers, 0)), simd.eight(some(numbers, 8))];
        columns.copy_from_slice(&simd.unzipped(rows));
        return;
    }
    for first in (0..together(n)).step_by(4) {
        let first = first.min(n.saturating_sub(4));
        let mut rows = [simd.splat(numbers[0]); 4];
        for k in 0..4 {
            let (from, second) = (k * n + first, (k + 4) * n + first);
            rows[k] = if second + 4 <= 8 * n {
                simd.halves(some(numbers, from), some(numbers, second))
            } else {
                let number = |j: usize| numbers[(second + j).min(8 * n - 1)];
                let last = [number(0), number(1), number(2), number(3)];
                simd.halves(some(numbers, from), &last)
            };
        }
        let turned = simd.transposed(rows);
        columns[first..first + n.min(4)].copy_from_slice(&turned[..n.min(4)]);
    }
    if together(n) < n {
        let last = |k: usize| numbers[k * n + n - 1];
        let [a, b] = [0, 4].map(|k| [last(k), last(k + 1), last(k + 2), last(k + 3)]);
        columns[n - 1] = simd.halves(&a, &b);
    }
}

/// Stores columns as the `numbers` of eight structures.
///
/// # Panics
/// If `numbers` is shorter than eight structures.
#[inline(always)]
pub fn put_columns<T: Copy, M: Simd<T>>(simd: M, columns: &[M::Eight], numbers: &mut [T]) {
    let n = columns.len();
    let numbers = &mut numbers[..8 * n];
    if n == 2 {
        let rows = simd.zipped([columns[0], columns[1]]);
        for k in 0..2 {
            numbers[8 * k..8 * k + 8].copy_from_slice(&simd.numbers(rows[k]));
        }
        return;
    }
    for first in (0..together(n)).step_by(4) {
        let first = first.min(n.saturating_sub(4));
        let mut some = [columns[first]; 4];
        some[..n.min(4)].copy_from_slice(&columns[first..first + n.min(4)]);
        let rows = simd.transposed(some);
        // If a row is longer than a structure, the next one overwrites the excess.
        for half in 0..2 {
            for k in 0..4 {
                let from = (4 * half + k) * n + first;
                let width = (8 * n - from).min(4);
                let row = simd.numbers(rows[k]);
                numbers[from..from + width].copy_from_slice(&row[4 * half..4 * half + width]);
            }
        }
    }
    if together(n) < n {
        let last = simd.numbers(columns[n - 1]);
        for k in 0..8 {
            numbers[k * n + n - 1] = last[k];
        }
    }
}

/// The number of numbers, out of `n`, that are moved four at a time. If `n` is no multiple of 4, the last four overlap with
/// others; but a single remaining number is moved alone, which takes less time.
#[inline(always)]
const fn together(n: usize) -> usize {
    if n % 4 == 1 { n - 1 } else { n }
}

#[inline(always)]
fn some<T, const N: usize>(numbers: &[T], from: usize) -> &[T; N] {
    numbers[from..].first_chunk().expect("as many numbers")
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::{put_columns, take_columns};
    use crate::batch::Float;
    use crate::dispatch::{Work, best};
    use crate::simd::{Plain, Simd};

    /// Loads the columns of eight structures of `N` numbers, which are 0, 1, 2, .. and so on; and stores them again.
    struct ThereAndBack<const N: usize>;

    impl<const N: usize> ThereAndBack<N> {
        fn by<T: Float, M: Simd<T>>(simd: M) {
            let numbers: Vec<T> = (0..8 * N + 1).map(|k| T::from_f64(k as f64)).collect();
            let mut columns = [simd.splat(T::from_f64(-1.0)); N];
            take_columns(simd, &numbers, &mut columns);
            for (number, column) in columns.iter().enumerate() {
                let expected = [0, 1, 2, 3, 4, 5, 6, 7].map(|p| numbers[p * N + number]);
                assert!(simd.numbers(*column) == expected, "{number} of {N}");
            }
            let mut back = numbers.clone();
            back[..8 * N].fill(T::from_f64(-1.0));
            put_columns(simd, &columns, &mut back);
            assert!(back == numbers, "{N}");
        }
    }

    impl<T: Float, const N: usize> Work<T> for ThereAndBack<N> {
        type Output = ();

        fn on<M: Simd<T>>(self, simd: M) {
            Self::by::<T, M>(simd);
        }
    }

    fn every<const N: usize>() {
        best::<f32, _>(ThereAndBack::<N>);
        best::<f64, _>(ThereAndBack::<N>);
        ThereAndBack::<N>::by::<f32, _>(Plain);
        ThereAndBack::<N>::by::<f64, _>(Plain);
    }

    #[test]
    fn structures_are_turned_there_and_back() {
        every::<1>();
        every::<2>();
        every::<3>();
        every::<4>();
        every::<5>();
        every::<6>();
        every::<7>();
        every::<8>();
        every::<9>();
        every::<10>();
    }
}
