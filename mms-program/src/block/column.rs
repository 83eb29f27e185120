//! The numbers of a block, and the three precisions that blocks are made of.

use std::fmt::Debug;
use std::ops::Range;

use mms_math::Double;
use mms_math::batch::Stand;

use super::plan::Plan;
use super::{Way, steps};
use crate::interpret::Number;

/// The numbers of a block in `K` pieces of `C`, in whole lines of the cache. A piece of single or double precision is
/// some registers, so that operations of one wait for no other; and a block ends with the piece that its last point is in.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Column<T, const C: usize, const K: usize>(pub(super) [[T; C]; K]);

/// The numbers of a block, whatever it is made of.
pub trait Numbers<T>: Clone + Debug + Send + Sync {
    /// The same number everywhere.
    fn of(number: T) -> Self;
    /// The numbers.
    fn numbers(&self) -> &[T];
    /// The same, to write to.
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

/// A number in which programs are run over blocks of points: `f32`, `f64` or [`Double`].
pub trait Blockwise: Number<Wide: Copy + Send + Sync> + Stand<Self> + Send + Sync {
    /// How many points a block has: as many as in compiled code, where a block that has a result which is not a number
    /// is computed again as a whole.
    const BLOCK: usize;
    /// How many points go through together.
    const TOGETHER: usize;
    /// The numbers of a block.
    type Column: Numbers<Self>;

    /// Whether both are the same to the bit.
    fn is_same(self, other: Self) -> bool;

    /// Runs the steps of a plan over the first `pieces` of a block.
    fn run(plan: &Plan, way: Way, scalars: &[Self], columns: &mut [Self::Column], pieces: usize);

    /// Runs some parts of a plan over the first `pieces` of a block; says whether all results are numbers, if they are the last
    /// parts.
    fn run_parts(
        of: (&Plan, Range<usize>),
        way: Way,
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
                plan: &Plan,
                way: Way,
                scalars: &[Self],
                columns: &mut [Self::Column],
                pieces: usize,
            ) {
                let all = 0..plan.parts.len();
                if !Self::run_parts((plan, all), way, scalars, columns, pieces) {
                    steps::carefully(plan, scalars, columns, pieces);
                }
            }

            fn run_parts(
                (plan, parts): (&Plan, Range<usize>),
                way: Way,
                scalars: &[Self],
                columns: &mut [Self::Column],
                pieces: usize,
            ) -> bool {
                let is_last = parts.end == plan.parts.len();
                steps::quickly((plan, parts), way, scalars, columns, pieces);
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

    fn run(plan: &Plan, _: Way, scalars: &[Self], columns: &mut [Self::Column], pieces: usize) {
        steps::carefully(plan, scalars, columns, pieces);
    }

    // Nothing is quick in twice the digits.
    fn run_parts(
        _: (&Plan, Range<usize>),
        _: Way,
        _: &[Self],
        _: &mut [Self::Column],
        _: usize,
    ) -> bool {
        false
    }
}
