//! Evaluation at many points: a kernel in one scalar, and a loop that the compiler turns into vector instructions.
//!
//! Points are processed in blocks of fixed length, 64 in double precision and 128 in single, which is 512 bytes per number in
//! both. So the loop over a block has no branch and no remainder; the last block is padded with copies of its first point. A
//! [`Lane`] replaces the number in a loop. There is one loop for AVX-512 (but not with debug assertions, where nothing need be
//! fast and everything would be compiled once more), one for AVX2 with fused multiply-add and one for everything else.
//! [`crate::dispatch`] detects the processor when the program runs: nothing depends on how it was compiled.
//!
//! # Vector path and scalar fallback
//!
//! The branch-free functions of [`Lane`] return either a correct result or NaN; they have neither branch nor call. They return
//! NaN for arguments that they do not handle: angles beyond 2^20, or beyond 1.57 where they were proved near zero, subnormal
//! arguments of logarithms, and arguments outside a domain. A block with a NaN result is computed again, number by number, with
//! the scalar's own functions, so that only time is lost. The range of an argument is tested by comparing integers, as the
//! multipliers are busy.
//!
//! # Why the loop is fast
//!
//! Everything between the dispatched function and a lane is always inlined: a single call would prevent all vectors. Nothing is
//! called between two blocks either, neither copies nor `map` of an array, which is not inlined from another unit of the
//! compilation: after a call the constants of a kernel are loaded one by one where they are used.
//!
//! The speed depends on how long operations wait for each other, and on how often numbers are copied. So terms of X alone and
//! terms that also need t are two loops over a block (`Points::each_then`). If the first one divides or computes roots, and
//! calls no function, both are one loop, in which the first is a block ahead: a division of eight numbers takes as long as ten
//! products of eight, and runs beside the products of the second. With functions there would be more coefficients than
//! registers. Divisions and square roots are the processor's: beside multiplications they take less time than equivalent
//! products, and are rounded once. `docs/speed.md` lists the gains of these decisions.

use crate::dispatch::{Work, best};
use crate::simd::{self, Simd};
use crate::{Double, Lane, Real};

pub use crate::block::{Block, Blocked, Columns};
pub use crate::kept::{KeptColumns, PointCache};
pub use crate::places::{Copied, Sink, Source};

/// A scalar that represents a number of type `T` in a loop over points.
pub trait Lift<T>: Real {
    /// Converts the number.
    fn splat(value: T) -> Self;
    /// The number.
    fn value(self) -> T;
}

/// The number type of batches: `f32` or `f64`.
pub trait Float: Real + Blocked + Lift<Self> + PartialOrd + Send + Sync {
    /// Eight numbers at a time on processors with registers of 512 bits.
    type WideMachine: Simd<Self> + From<simd::Wide>;
    /// Eight numbers at a time on processors that multiply and add in one step.
    type FusedMachine: Simd<Self> + From<simd::Fused>;
    /// Eight numbers at a time on other processors.
    type PlainSimd: Simd<Self> + From<simd::Plain>;
}

macro_rules! itself {
    ($($number:ident)*) => {
        $(
            impl Lift<$number> for $number {
                #[inline(always)]
                fn splat(value: $number) -> Self {
                    value
                }
                #[inline(always)]
                fn value(self) -> $number {
                    self
                }
            }
        )*
    };
}

itself!(f32 f64 Double);

macro_rules! float {
    ($float:ident, $wide:ident) => {
        impl<const FUSED: bool> Lift<$float> for Lane<$float, FUSED> {
            #[inline(always)]
            fn splat(value: $float) -> Self {
                Lane(value)
            }
            #[inline(always)]
            fn value(self) -> $float {
                self.0
            }
        }

        impl Float for $float {
            type WideMachine = simd::$wide;
            type FusedMachine = simd::Fused;
            type PlainSimd = simd::Plain;
        }
    };
}

// Eight numbers of single precision fill a register of 256 bits.
float!(f32, Fused);
#[cfg(target_arch = "x86_64")]
float!(f64, Wide);
#[cfg(not(target_arch = "x86_64"))]
float!(f64, Fused);

/// A function of `I` numbers with `O` results.
pub trait Function<S, const I: usize, const O: usize> {
    /// Computes the results. Always to be inlined: a call in the loop over points would prevent all vectors.
    fn at(&self, point: [S; I]) -> [S; O];
}

/// A function in any scalar that represents `T`.
pub trait Kernel<T, const I: usize, const O: usize> {
    /// Passes the function to a loop over points.
    fn drive<S: Lift<T>>(&self, points: &mut impl Points<S, I, O>);
}

/// A loop over points.
pub trait Points<S, const I: usize, const O: usize> {
    /// Applies the function to every point.
    fn each(&mut self, function: &impl Function<S, I, O>);

    /// Applies the first function to every point, and then the second one to the numbers that it `reads`: indices into the
    /// point's own numbers followed by the results of the first function.
    fn each_then<const M: usize, const N: usize>(
        &mut self,
        first: &impl Function<S, I, M>,
        second: &impl Function<S, N, O>,
        reads: [usize; N],
        loops: Loops,
    );
}

/// The distribution of work on many points between two functions, the second of which needs the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loops {
    /// Each function has its own loop over every block: the operations of a short loop wait less for each other, so that more
    /// of them overlap.
    Apart,
    /// One loop applies the second function to a block and the first one to the next block: so divisions and roots of the first
    /// one, each of which takes as long as many products, run beside the products of the second one.
    Together,
}

/// Selects the numbers that the second function `reads` from a block's numbers and the results of the first function.
#[inline(always)]
fn taken<'a, T: Float, const I: usize, const M: usize, const N: usize>(
    inputs: &Columns<'a, T, I>,
    made: &'a Block<T, M>,
    reads: [usize; N],
) -> Columns<'a, T, N> {
    // `map` is not always inlined.
    let there = |k: usize| if k < I { inputs[k] } else { &made.0[k - I] };
    core::array::from_fn(|k| there(reads[k]))
}

/// Applies a kernel to every point of a source.
///
/// # Panics
///
/// If slices have different lengths.
pub fn run<T: Float, const I: usize, const O: usize>(
    kernel: &impl Kernel<T, I, O>,
    source: &impl Source<T, I>,
    sink: &mut impl Sink<T, O>,
) {
    let count = source.count();
    assert_eq!(sink.room(), count, "a batch has {count} points, and other room for its results");
    best(Drive { kernel, source, sink, count, scalar: core::marker::PhantomData::<T> });
}

/// A kernel, and the points that it is applied to.
struct Drive<'a, T, K, In, Out, const I: usize, const O: usize> {
    kernel: &'a K,
    source: &'a In,
    sink: &'a mut Out,
    count: usize,
    scalar: core::marker::PhantomData<T>,
}

impl<T, K, In, Out, const I: usize, const O: usize> Work<T> for Drive<'_, T, K, In, Out, I, O>
where
    T: Float,
    K: Kernel<T, I, O>,
    In: Source<T, I>,
    Out: Sink<T, O>,
{
    type Output = ();

    #[inline(always)]
    fn on<M: Simd<T>>(self, simd: M) {
        let Self { kernel, source, sink, count, scalar } = self;
        kernel.drive::<M::Lane>(&mut Blocks {
            simd,
            source,
            sink,
            count,
            careful: |inputs: &Columns<'_, T, I>, outputs: &mut Block<T, O>| {
                kernel.drive::<T>(&mut Single { inputs, outputs });
            },
            scalar,
        });
    }
}

/// All points, block by block.
struct Blocks<'a, M, T: Float, In, Out, Careful, const I: usize, const O: usize> {
    simd: M,
    source: &'a In,
    sink: &'a mut Out,
    count: usize,
    careful: Careful,
    scalar: core::marker::PhantomData<T>,
}

impl<M, T, In, Out, Careful, const I: usize, const O: usize>
    Blocks<'_, M, T, In, Out, Careful, I, O>
where
    M: Simd<T>,
    T: Float,
    In: Source<T, I>,
    Out: Sink<T, O>,
    Careful: Fn(&Columns<'_, T, I>, &mut Block<T, O>),
{
    /// Stores the results of the block that begins at `start`. If a result is NaN, the block is computed again, into another
    /// block: once `results` has been passed by reference, the compiler no longer knows that it does not overlap the inputs.
    #[inline(always)]
    fn store(&mut self, start: usize, inputs: &Columns<'_, T, I>, results: &Block<T, O>) {
        if !self.sink.store(self.simd, start, results) {
            let mut again = Block::of(T::from_f64(0.0));
            (self.careful)(inputs, &mut again);
            self.sink.store(self.simd, start, &again);
        }
    }

    /// Applies two functions one after the other to every block.
    #[inline(always)]
    fn apart<S: Lift<T>, const B: usize, const N: usize>(
        &mut self,
        first: &impl Function<S, I, B>,
        second: &impl Function<S, N, O>,
        reads: [usize; N],
    ) {
        let zero = T::from_f64(0.0);
        let (mut made, mut results) = (Block::of(zero), Block::of(zero));
        // Two blocks in turn, as below: with a single one the compiler orders operations in another way, and some fields take 5
        // % longer in single precision.
        let mut rooms = [Block::of(zero); 2];
        let [mut now, mut soon] = rooms.each_mut();
        let mut start = 0;
        while start < self.count {
            self.source.load(self.simd, start, now);
            let inputs = self.source.columns(start, now);
            T::on_block(first, &inputs, &mut made);
            T::on_block(second, &taken(&inputs, &made, reads), &mut results);
            self.store(start, &inputs, &results);
            core::mem::swap(&mut now, &mut soon);
            start += T::BLOCK;
        }
    }

    /// Applies two functions in one loop, the first one a block ahead of the second.
    #[inline(always)]
    fn together<S: Lift<T>, const B: usize, const N: usize>(
        &mut self,
        first: &impl Function<S, I, B>,
        second: &impl Function<S, N, O>,
        reads: [usize; N],
    ) {
        if self.count == 0 {
            return;
        }
        let zero = T::from_f64(0.0);
        let (mut made, mut results) = (Block::<T, B>::of(zero), Block::of(zero));
        let mut rooms = [Block::of(zero); 2];
        let [mut now, mut soon] = rooms.each_mut();
        let mut start = 0;
        self.source.load(self.simd, start, now);
        T::on_block(first, &self.source.columns(start, now), &mut made);
        while start < self.count {
            let inputs = self.source.columns(start, now);
            let next = start + T::BLOCK;
            // The last block is not after the loop: otherwise all code that stores results would exist twice.
            if next < self.count {
                self.source.load(self.simd, next, soon);
                let both = (&inputs, &self.source.columns(next, soon));
                T::side_by_side((first, second), both, &mut made, &mut results, reads);
            } else {
                T::on_block(second, &taken(&inputs, &made, reads), &mut results);
            }
            self.store(start, &inputs, &results);
            core::mem::swap(&mut now, &mut soon);
            start = next;
        }
    }
}

impl<M, T, S, In, Out, Careful, const I: usize, const O: usize> Points<S, I, O>
    for Blocks<'_, M, T, In, Out, Careful, I, O>
where
    M: Simd<T>,
    T: Float,
    S: Lift<T>,
    In: Source<T, I>,
    Out: Sink<T, O>,
    Careful: Fn(&Columns<'_, T, I>, &mut Block<T, O>),
{
    #[inline(always)]
    fn each(&mut self, function: &impl Function<S, I, O>) {
        let zero = T::from_f64(0.0);
        let (mut room, mut results) = (Block::of(zero), Block::of(zero));
        let mut start = 0;
        while start < self.count {
            self.source.load(self.simd, start, &mut room);
            let inputs = self.source.columns(start, &room);
            T::on_block(function, &inputs, &mut results);
            self.store(start, &inputs, &results);
            start += T::BLOCK;
        }
    }

    #[inline(always)]
    fn each_then<const B: usize, const N: usize>(
        &mut self,
        first: &impl Function<S, I, B>,
        second: &impl Function<S, N, O>,
        reads: [usize; N],
        loops: Loops,
    ) {
        match loops {
            Loops::Apart => self.apart(first, second, reads),
            Loops::Together => self.together(first, second, reads),
        }
    }
}

/// One block, number by number.
struct Single<'a, T: Float, const I: usize, const O: usize> {
    inputs: &'a Columns<'a, T, I>,
    outputs: &'a mut Block<T, O>,
}

impl<T: Float, const I: usize, const O: usize> Points<T, I, O> for Single<'_, T, I, O> {
    fn each(&mut self, function: &impl Function<T, I, O>) {
        T::on_block(function, self.inputs, self.outputs);
    }

    fn each_then<const M: usize, const N: usize>(
        &mut self,
        first: &impl Function<T, I, M>,
        second: &impl Function<T, N, O>,
        reads: [usize; N],
        _: Loops,
    ) {
        let mut made = Block::<T, M>::of(T::from_f64(0.0));
        T::on_block(first, self.inputs, &mut made);
        T::on_block(second, &taken(self.inputs, &made, reads), self.outputs);
    }
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;
    use core::fmt::Debug;
    use std::vec;
    use std::vec::Vec;

    use super::{Float, Function, Kernel, Lift, Loops, PointCache, Points, Sink, Source, run};
    use crate::Real;
    use crate::packed::tests::Both;

    #[test]
    fn infinities_and_what_is_not_a_number_are_written_as_they_are() {
        for count in [1, 64, 100, 128, 130] {
            let mut x: Vec<f64> = (0..count).map(|k| 0.7 + 0.3 * k as f64).collect();
            for (place, value) in
                [f64::INFINITY, f64::NEG_INFINITY, f64::NAN].into_iter().enumerate()
            {
                x[(place + 1) * count / 4] = value;
            }
            let y = vec![0.5; count];
            let (mut products, mut sums) = (y.clone(), y.clone());
            run(&Both, &[&x[..], &y], &mut [&mut products[..], &mut sums]);
            for (k, x) in x.iter().enumerate() {
                let found = [products[k], sums[k]].map(f64::to_bits);
                assert_eq!(found, [x * 0.5, x + 1.0].map(f64::to_bits), "{x} of {count}");
            }
        }
    }

    /// The distance r from a centre and ln y, and from them ln(x)/r and x r + ln y.
    struct Ring {
        loops: Loops,
        drives: Cell<usize>,
    }
    struct First;
    struct Second;

    impl<S: Real> Function<S, 2, 2> for First {
        #[inline(always)]
        fn at(&self, [x, y]: [S; 2]) -> [S; 2] {
            [(x * x + y * y).sqrt(), y.ln()]
        }
    }

    impl<S: Real> Function<S, 3, 2> for Second {
        #[inline(always)]
        fn at(&self, [x, r, l]: [S; 3]) -> [S; 2] {
            [x.ln() / r, x * r + l]
        }
    }

    impl<T: Float> Kernel<T, 2, 2> for Ring {
        #[inline(always)]
        fn drive<S: Lift<T>>(&self, points: &mut impl Points<S, 2, 2>) {
            self.drives.set(self.drives.get() + 1);
            points.each_then::<2, 3>(&First, &Second, [0, 2, 3], self.loops);
        }
    }

    /// Returns its two inputs.
    struct Same;

    impl<S: Real> Function<S, 2, 2> for Same {
        #[inline(always)]
        fn at(&self, point: [S; 2]) -> [S; 2] {
            point
        }
    }

    impl<T: Float> Kernel<T, 2, 2> for Same {
        #[inline(always)]
        fn drive<S: Lift<T>>(&self, points: &mut impl Points<S, 2, 2>) {
            points.each(self);
        }
    }

    /// Writes the results, and returns how many blocks were computed again.
    fn ring<T: Float>(
        loops: Loops,
        source: &impl Source<T, 2>,
        sink: &mut impl Sink<T, 2>,
    ) -> usize {
        let ring = Ring { loops, drives: Cell::new(0) };
        run(&ring, source, sink);
        // All points are one drive, and each block that is computed again is another.
        ring.drives.get() - 1
    }

    /// Compares both loops, over points from each source, with the functions themselves. The branch-free logarithm returns NaN
    /// for a `subnormal` number, which x or y is in every other block: only these are computed again.
    fn loops_agree<T: Float + Into<f64> + Debug>(unknown: usize, subnormal: T, epsilon: f64) {
        let block = T::BLOCK;
        for count in [0, 1, block - 1, block, block + 1, 2 * block, 3 * block + 5] {
            let mut columns = [0.3, 0.4].map(|from: f64| -> Vec<T> {
                (0..count).map(|k| T::from_f64(2.0 + (from + 0.7 * k as f64).sin())).collect()
            });
            let places = (block..count).step_by(2 * block);
            let again = places.len();
            places.for_each(|place| columns[unknown][place] = subnormal);
            let slices = columns.each_ref().map(|column| &column[..]);
            let points: Vec<[T; 2]> = (0..count).map(|k| slices.map(|column| column[k])).collect();
            let mut kept = PointCache::<T, 2>::room_for(count);
            run(&Same, &slices, &mut kept);
            let [apart, together] = [Loops::Apart, Loops::Together].map(|loops| {
                let zero = T::from_f64(0.0);
                let mut found = [vec![zero; count], vec![zero; count]];
                let mut rows = [vec![[zero; 2]; count], vec![[zero; 2]; count]];
                let [of_points, of_kept] = rows.each_mut();
                let blocks = [
                    ring(loops, &slices, &mut found.each_mut().map(|column| &mut column[..])),
                    ring(loops, &&points[..], &mut &mut of_points[..]),
                    ring(loops, &kept.columns([0, 1]), &mut &mut of_kept[..]),
                ];
                assert_eq!(blocks, [again; 3], "{loops:?}, {count} points");
                let [first, second] = &found;
                let found: Vec<_> = first.iter().zip(second).map(|(a, b)| [*a, *b]).collect();
                assert!(rows.iter().all(|rows| *rows == found), "{loops:?}, {count} points");
                found
            });
            assert_eq!(apart, together, "{count} points");
            for ([x, y], found) in points.iter().zip(together) {
                let [r, l] = First.at([*x, *y]);
                for (found, expected) in found.into_iter().zip(Second.at([*x, r, l])) {
                    let [found, expected]: [f64; 2] = [found, expected].map(Into::into);
                    let error = (found - expected).abs() / expected.abs();
                    assert!(error <= 4.0 * epsilon, "{x:?}, {y:?} of {count}: {error}");
                }
            }
        }
    }

    #[test]
    fn loops_together_give_what_loops_apart_do() {
        // The second function uses the logarithm of x, and the first, which is a block ahead, the logarithm of y.
        for unknown in [0, 1] {
            loops_agree::<f64>(unknown, 1e-310, f64::EPSILON);
            loops_agree::<f32>(unknown, 1e-40, f32::EPSILON.into());
        }
    }
}
