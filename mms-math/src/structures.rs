//! Arrays of structures: the same number of four structures together, in one register, and back.
//!
//! Four numbers of each of the four go at a time. The compiler would take them one by one, from all over the memory.

use crate::machine::Machine;

/// The columns of four structures, whose `numbers` stand one structure behind the other: of each number the four.
///
/// # Panics
/// If there are less numbers than in four structures.
#[inline(always)]
pub fn take_columns<T: Copy, M: Machine<T>>(machine: M, numbers: &[T], columns: &mut [M::Four]) {
    let n = columns.len();
    let numbers = &numbers[..4 * n];
    if n == 2 {
        let rows = [machine.four(four(numbers, 0)), machine.four(four(numbers, 4))];
        columns.copy_from_slice(&machine.unzipped(rows));
        return;
    }
    for first in (0..together(n)).step_by(4) {
        let first = first.min(n.saturating_sub(4));
        let mut rows = [machine.splat(numbers[0]); 4];
        for k in 0..4 {
            let from = k * n + first;
            rows[k] = if from + 4 <= 4 * n {
                machine.four(four(numbers, from))
            } else {
                let number = |j: usize| numbers[(from + j).min(4 * n - 1)];
                machine.four(&[number(0), number(1), number(2), number(3)])
            };
        }
        let some = machine.transposed(rows);
        columns[first..first + n.min(4)].copy_from_slice(&some[..n.min(4)]);
    }
    if together(n) < n {
        let last = |k: usize| numbers[k * n + n - 1];
        columns[n - 1] = machine.four(&[last(0), last(1), last(2), last(3)]);
    }
}

/// Writes the `numbers` of four structures with these columns.
///
/// # Panics
/// If there is no room for four structures.
#[inline(always)]
pub fn put_columns<T: Copy, M: Machine<T>>(machine: M, columns: &[M::Four], numbers: &mut [T]) {
    let n = columns.len();
    let numbers = &mut numbers[..4 * n];
    if n == 2 {
        let rows = machine.zipped([columns[0], columns[1]]);
        for k in 0..2 {
            numbers[4 * k..4 * k + 4].copy_from_slice(&machine.numbers(rows[k]));
        }
        return;
    }
    for first in (0..together(n)).step_by(4) {
        let first = first.min(n.saturating_sub(4));
        let mut some = [columns[first]; 4];
        some[..n.min(4)].copy_from_slice(&columns[first..first + n.min(4)]);
        let rows = machine.transposed(some);
        // Where a row is longer than a structure, the next one is written over what is too much.
        for k in 0..4 {
            let from = k * n + first;
            let width = (4 * n - from).min(4);
            numbers[from..from + width].copy_from_slice(&machine.numbers(rows[k])[..width]);
        }
    }
    if together(n) < n {
        let last = machine.numbers(columns[n - 1]);
        for k in 0..4 {
            numbers[k * n + n - 1] = last[k];
        }
    }
}

/// How many of `n` numbers go four at a time, the last four again where they are less: but for one that would be left
/// over, which takes less time alone.
#[inline(always)]
const fn together(n: usize) -> usize {
    if n % 4 == 1 { n - 1 } else { n }
}

#[inline(always)]
fn four<T>(numbers: &[T], from: usize) -> &[T; 4] {
    numbers[from..].first_chunk().expect("four numbers")
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::{put_columns, take_columns};
    use crate::batch::Float;
    use crate::dispatch::{Work, best};
    use crate::machine::{Fused, Machine, Plain};

    /// The columns of four structures of `N` numbers: they are 0, 1, 2, .. and so on; and what they make again.
    struct ThereAndBack<const N: usize>;

    impl<const N: usize> ThereAndBack<N> {
        fn by<T: Float, M: Machine<T>>(machine: M) {
            let numbers: Vec<T> = (0..4 * N + 1).map(|k| T::from_f64(k as f64)).collect();
            let mut columns = [machine.splat(T::from_f64(-1.0)); N];
            take_columns(machine, &numbers, &mut columns);
            for (number, column) in columns.iter().enumerate() {
                let expected = [0, 1, 2, 3].map(|p| numbers[p * N + number]);
                assert!(machine.numbers(*column) == expected, "{number} of {N}");
            }
            let mut back = numbers.clone();
            back[..4 * N].fill(T::from_f64(-1.0));
            put_columns(machine, &columns, &mut back);
            assert!(back == numbers, "{N}");
        }
    }

    impl<const N: usize> Work for ThereAndBack<N> {
        type Output = ();

        fn fused(self, machine: Fused) {
            Self::by::<f32, _>(machine);
            Self::by::<f64, _>(machine);
        }

        fn plain(self, machine: Plain) {
            Self::by::<f32, _>(machine);
            Self::by::<f64, _>(machine);
        }
    }

    fn every<const N: usize>() {
        best(ThereAndBack::<N>);
        ThereAndBack::<N>.plain(Plain);
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
