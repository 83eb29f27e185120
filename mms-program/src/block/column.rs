//! The numbers of a block, and the three precisions of blocks.

use std::fmt::Debug;
use std::ops::Range;

use mms_math::Double;
use mms_math::batch::Lift;

use super::plan::BlockPlan;
use super::{BlockMode, steps};
use crate::interpret::Number;

/// The numbers of a block in `K` pieces of `C`, in whole lines of the cache. A piece of single or double precision fills
/// several registers, so that its operations are independent of each other; a block ends with the piece that contains its last
/// point.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Column<T, const C: usize, const K: usize>(pub(super) [[T; C]; K]);

/// The numbers of a block, for any memory layout.
pub trait Numbers<T>: Clone + Debug + Send + Sync {
    /// Makes a block of one number.
    fn of(number: T) -> Self;
    /// The numbers.
    fn numbers(&self) -> &[T];
    /// The numbers, for writing.
    fn numbers_mut(&mut self) -> &mut [T];
}

impl<T: Copy + Debug + Send + Sync, const C: usize, const K: usize> Numbers<T> for Column<T, C, K> {
    fn of(number: T) -> Self {
        Column([[number; C]; K])
    }

    fn numbers(&self) -> &[T] {
        self.0.as_flattened()
    }

    fn numbers_mut(&mut self) -> &mut [T] {
        self.0.as_flattened_mut()
    }
}

/// A number type in which programs are run over blocks of points: `f32`, `f64` or [`Double`].
pub trait Blockwise: Number<Wide: Copy + Send + Sync> + Lift<Self> + Send + Sync {
    /// The number of points of a block. Compiled code has the same blocks, which matters because a block with a NaN result is
    /// computed again as a whole.
    const BLOCK: usize;
    /// The number of points that are processed together.
    const TOGETHER: usize;
    /// The numbers of a block.
    type Column: Numbers<Self>;

    /// Whether both numbers have the same bits.
    fn is_same(self, other: Self) -> bool;

    /// Runs the steps of a plan over the first `pieces` of a block.
    fn run(
        plan: &BlockPlan,
        mode: BlockMode,
        scalars: &[Self],
        columns: &mut [Self::Column],
        pieces: usize,
    );

    /// Runs some parts of a plan over the first `pieces` of a block. If they are the last parts, returns whether all results
    /// are numbers.
    fn run_parts(
        of: (&BlockPlan, Range<usize>),
        mode: BlockMode,
        scalars: &[Self],
        columns: &mut [Self::Column],
        pieces: usize,
    ) -> bool;
}

macro_rules! blockwise {
    ($float:ident, $together:literal, $pieces:literal) => {
        impl Blockwise for $float {
            const BLOCK: usize = <$float as mms_math::batch::Blocked>::BLOCK;
            const TOGETHER: usize = $together;
            type Column = Column<$float, $together, $pieces>;

            fn is_same(self, other: Self) -> bool {
                self.to_bits() == other.to_bits()
            }

            fn run(
                plan: &BlockPlan,
                mode: BlockMode,
                scalars: &[Self],
                columns: &mut [Self::Column],
                pieces: usize,
            ) {
                let all = 0..plan.parts.len();
                if !Self::run_parts((plan, all), mode, scalars, columns, pieces) {
                    steps::carefully(plan, scalars, columns, pieces);
                }
            }

            fn run_parts(
                (plan, parts): (&BlockPlan, Range<usize>),
                mode: BlockMode,
                scalars: &[Self],
                columns: &mut [Self::Column],
                pieces: usize,
            ) -> bool {
                let is_last = parts.end == plan.parts.len();
                steps::quickly((plan, parts), mode, scalars, columns, pieces);
                is_last && steps::are_numbers(plan, scalars, columns, pieces)
            }
        }

        const _: () = assert!($together * $pieces == <$float as Blockwise>::BLOCK);
    };
}

blockwise!(f32, 32, 4);
blockwise!(f64, 16, 4);

impl Blockwise for Double {
    const BLOCK: usize = 64;
    const TOGETHER: usize = 1;
    type Column = Column<Double, 1, 64>;

    fn is_same(self, other: Self) -> bool {
        let bits = |number: Double| [number.to_f64(), number.low()].map(f64::to_bits);
        bits(self) == bits(other)
    }

    fn run(
        plan: &BlockPlan,
        _: BlockMode,
        scalars: &[Self],
        columns: &mut [Self::Column],
        pieces: usize,
    ) {
        steps::carefully(plan, scalars, columns, pieces);
    }

    // There are no quick functions in twice the digits.
    fn run_parts(
        _: (&BlockPlan, Range<usize>),
        _: BlockMode,
        _: &[Self],
        _: &mut [Self::Column],
        _: usize,
    ) -> bool {
        false
    }
}
