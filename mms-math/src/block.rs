//! A block of points: the number of points that a loop processes at a time, and the loops over them.

use core::fmt::Debug;

use crate::batch::{Function, Lift};

/// The values of `N` numbers at the points of a block, aligned to cache lines: a load that crosses a line takes twice as long.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Block<T: Blocked, const N: usize>(pub(crate) [T::Column; N]);

impl<T: Blocked, const N: usize> Block<T, N> {
    /// A block with one value everywhere.
    pub(crate) fn of(value: T) -> Self {
        Self([T::column_of(value); N])
    }
}

/// The values of `N` numbers at the points of a block, stored anywhere.
pub type Columns<'a, T, const N: usize> = [&'a <T as Blocked>::Column; N];

/// A number type that has blocks.
pub trait Blocked: Copy {
    /// The number of points that a kernel processes at a time: eight registers of 512 bits. With fewer points the compiler
    /// unrolls the whole loop, and divisions no longer overlap products; with more, it copies a column by a call. The blocks of
    /// all inputs and outputs stay in the first cache.
    const BLOCK: usize;
    /// An array of `BLOCK` numbers.
    type Column: Copy + Debug;
    /// A column with one number everywhere.
    fn column_of(number: Self) -> Self::Column;
    /// The first `BLOCK` numbers of a slice; `None` if it is shorter.
    fn first_of(numbers: &[Self]) -> Option<&Self::Column>;
    /// The first `BLOCK` numbers of a mutable slice; `None` if it is shorter.
    fn first_of_mut(numbers: &mut [Self]) -> Option<&mut Self::Column>;
    /// The numbers of a column.
    fn numbers(column: &Self::Column) -> &[Self];
    /// The mutable numbers of a column.
    fn numbers_mut(column: &mut Self::Column) -> &mut [Self];

    /// Applies a function at all points of a block.
    fn on_block<S: Lift<Self>, const I: usize, const O: usize>(
        function: &impl Function<S, I, O>,
        inputs: &Columns<'_, Self, I>,
        results: &mut Block<Self, O>,
    );

    /// Applies two functions in one loop: the second one at all points of a block, to the results that the first one `made` of
    /// them, and the first one at the points of the next block. Its results overwrite the results that were just read.
    fn side_by_side<S, const I: usize, const M: usize, const N: usize, const O: usize>(
        functions: (&impl Function<S, I, M>, &impl Function<S, N, O>),
        blocks: (&Columns<'_, Self, I>, &Columns<'_, Self, I>),
        made: &mut Block<Self, M>,
        results: &mut Block<Self, O>,
        reads: [usize; N],
    ) where
        S: Lift<Self>;
}

// Written out for each type, since within one function the compiler sees that `results` and the inputs do not overlap;
// behind a closure it does not, and would check at every block.
macro_rules! blocked {
    ($float:ident, $block:literal) => {
        impl Blocked for $float {
            const BLOCK: usize = $block;
            type Column = [$float; $block];
            #[inline(always)]
            fn column_of(number: $float) -> Self::Column {
                [number; $block]
            }
            #[inline(always)]
            fn first_of(numbers: &[$float]) -> Option<&Self::Column> {
                numbers.first_chunk()
            }
            #[inline(always)]
            fn first_of_mut(numbers: &mut [$float]) -> Option<&mut Self::Column> {
                numbers.first_chunk_mut()
            }
            #[inline(always)]
            fn numbers(column: &Self::Column) -> &[$float] {
                column
            }
            #[inline(always)]
            fn numbers_mut(column: &mut Self::Column) -> &mut [$float] {
                column
            }

            #[inline(always)]
            fn on_block<S: Lift<$float>, const I: usize, const O: usize>(
                function: &impl Function<S, I, O>,
                inputs: &Columns<'_, $float, I>,
                results: &mut Block<$float, O>,
            ) {
                for place in 0..$block {
                    let number = |k: usize| S::splat(inputs[k][place]);
                    let found = function.at(core::array::from_fn(number));
                    for k in 0..O {
                        results.0[k][place] = found[k].value();
                    }
                }
            }

            #[inline(always)]
            fn side_by_side<S, const I: usize, const M: usize, const N: usize, const O: usize>(
                (first, second): (&impl Function<S, I, M>, &impl Function<S, N, O>),
                (inputs, coming): (&Columns<'_, $float, I>, &Columns<'_, $float, I>),
                made: &mut Block<$float, M>,
                results: &mut Block<$float, O>,
                reads: [usize; N],
            ) where
                S: Lift<$float>,
            {
                for place in 0..$block {
                    let mut before = [S::from_f64(0.0); M];
                    for k in 0..M {
                        before[k] = S::splat(made.0[k][place]);
                    }
                    let found =
                        second.at(core::array::from_fn(|k| match reads[k].checked_sub(I) {
                            None => S::splat(inputs[reads[k]][place]),
                            Some(k) => before[k],
                        }));
                    let number = |k: usize| S::splat(coming[k][place]);
                    let next = first.at(core::array::from_fn(number));
                    for k in 0..M {
                        made.0[k][place] = next[k].value();
                    }
                    for k in 0..O {
                        results.0[k][place] = found[k].value();
                    }
                }
            }
        }
    };
}

blocked!(f32, 128);
blocked!(f64, 64);
