//! Evaluation at many points: a kernel in one scalar, and a loop that the compiler turns into vector
//! instructions.
//!
//! Points go through in blocks of fixed length, so that the loop over a block has no branch and no
//! remainder; the last block is filled up with copies of its first point. What the processor can do
//! is asked at run time: nothing depends on how the program was compiled.
//!
//! The quick functions of [`Lane`] answer not-a-number where they do not know. A block with such a
//! value is computed again, number by number, with the careful functions of the scalar itself.

use crate::dispatch::{Work, best};
use crate::machine::{self, Machine};
use crate::{Lane, Real};

pub use crate::kept::{Kept, KeptColumns};
pub use crate::places::{Copied, Sink, Source};

/// How many points go through a kernel at a time. The blocks of all inputs and outputs stay in the
/// first cache.
pub const BLOCK: usize = 64;

/// The values of `N` numbers at the points of a block, in whole lines of the cache: a vector that is in two takes
/// twice as long.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Block<T, const N: usize>(pub(crate) [[T; BLOCK]; N]);

impl<T: Copy, const N: usize> Block<T, N> {
    /// The same value everywhere.
    pub(crate) fn of(value: T) -> Self {
        Self([[value; BLOCK]; N])
    }
}

/// The same, wherever they are.
pub type Columns<'a, T, const N: usize> = [&'a [T; BLOCK]; N];

/// A scalar that stands for a number of type `T` in a loop over points.
pub trait Stand<T>: Real {
    /// In place of the number.
    fn standing_for(value: T) -> Self;
    /// The number.
    fn value(self) -> T;
}

/// A number that batches are made of: `f32` or `f64`.
pub trait Float: Real + Stand<Self> + PartialOrd + Send + Sync {
    /// Eight of it at a time where the processor has registers of 512 bits.
    type WideMachine: Machine<Self> + From<machine::Wide>;
    /// Where the processor multiplies and adds in one step.
    type FusedMachine: Machine<Self> + From<machine::Fused>;
    /// Elsewhere.
    type PlainMachine: Machine<Self> + From<machine::Plain>;
}

macro_rules! float {
    ($float:ident, $wide:ident) => {
        impl Stand<$float> for $float {
            #[inline(always)]
            fn standing_for(value: $float) -> Self {
                value
            }
            #[inline(always)]
            fn value(self) -> $float {
                self
            }
        }

        impl<const FUSED: bool> Stand<$float> for Lane<$float, FUSED> {
            #[inline(always)]
            fn standing_for(value: $float) -> Self {
                Lane(value)
            }
            #[inline(always)]
            fn value(self) -> $float {
                self.0
            }
        }

        impl Float for $float {
            type WideMachine = machine::$wide;
            type FusedMachine = machine::Fused;
            type PlainMachine = machine::Plain;
        }
    };
}

// Eight single ones fill a register of 256 bits.
float!(f32, Fused);
#[cfg(target_arch = "x86_64")]
float!(f64, Wide);
#[cfg(not(target_arch = "x86_64"))]
float!(f64, Fused);

/// A function of `I` numbers with `O` results.
pub trait Function<S, const I: usize, const O: usize> {
    /// Its results. To be inlined always: a call in the loop over points would end all vectors.
    fn at(&self, point: [S; I]) -> [S; O];

    /// Its results at all points of a block.
    #[inline(always)]
    fn on_block<T: Copy>(&self, inputs: &Columns<'_, T, I>, outputs: &mut Block<T, O>)
    where
        S: Stand<T>,
    {
        for place in 0..BLOCK {
            let point = core::array::from_fn(|input| S::standing_for(inputs[input][place]));
            let results = self.at(point);
            for output in 0..O {
                outputs.0[output][place] = results[output].value();
            }
        }
    }
}

/// The same function in any stand-in of `T`.
pub trait Kernel<T, const I: usize, const O: usize> {
    /// Passes the function to a loop over points.
    fn drive<S: Stand<T>>(&self, points: &mut impl Points<S, I, O>);
}

/// A loop over points.
pub trait Points<S, const I: usize, const O: usize> {
    /// Applies the function to every point.
    fn each(&mut self, function: &impl Function<S, I, O>);

    /// Applies the second function to what there is of every point then: its own numbers and, after them, what the
    /// first function makes of it. It takes those that it `reads`. Each has a loop of its own: the elements of a
    /// short loop wait less for each other, so that more of them are under way at a time.
    fn each_then<const M: usize, const N: usize>(
        &mut self,
        first: &impl Function<S, I, M>,
        second: &impl Function<S, N, O>,
        reads: [usize; N],
    );
}

/// What is done with a block.
trait OnBlock<S, T, const I: usize, const O: usize> {
    /// Its results.
    fn on_block(&mut self, inputs: &Columns<'_, T, I>, outputs: &mut Block<T, O>);
}

/// One function.
struct One<'a, F>(&'a F);

impl<S, T, F, const I: usize, const O: usize> OnBlock<S, T, I, O> for One<'_, F>
where
    S: Stand<T>,
    T: Copy,
    F: Function<S, I, O>,
{
    #[inline(always)]
    fn on_block(&mut self, inputs: &Columns<'_, T, I>, outputs: &mut Block<T, O>) {
        self.0.on_block(inputs, outputs);
    }
}

/// A function of a point and of another's results.
struct Two<'a, F, G, T, const M: usize, const N: usize> {
    first: &'a F,
    second: &'a G,
    reads: [usize; N],
    /// A place for the first one's results, made once for all blocks.
    between: Block<T, M>,
}

impl<S, T, F, G, const I: usize, const M: usize, const N: usize, const O: usize> OnBlock<S, T, I, O>
    for Two<'_, F, G, T, M, N>
where
    S: Stand<T>,
    T: Copy,
    F: Function<S, I, M>,
    G: Function<S, N, O>,
{
    #[inline(always)]
    fn on_block(&mut self, inputs: &Columns<'_, T, I>, outputs: &mut Block<T, O>) {
        self.first.on_block(inputs, &mut self.between);
        let there = |k: usize| if k < I { inputs[k] } else { &self.between.0[k - I] };
        let columns = core::array::from_fn(|k| there(self.reads[k]));
        self.second.on_block(&columns, outputs);
    }
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

/// A kernel, and what it is driven over.
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
    fn on<M: Machine<T>>(self, machine: M) {
        let Self { kernel, source, sink, count, .. } = self;
        let zero = T::from_f64(0.0);
        kernel.drive::<M::Lane>(&mut Blocks {
            machine,
            source,
            sink,
            count,
            room: Block::of(zero),
            outputs: Block::of(zero),
            careful: |inputs: &Columns<'_, T, I>, outputs: &mut Block<T, O>| {
                kernel.drive::<T>(&mut Single { inputs, outputs });
            },
        });
    }
}

/// All points, block by block.
struct Blocks<'a, M, T, In, Out, Careful, const I: usize, const O: usize> {
    machine: M,
    source: &'a In,
    sink: &'a mut Out,
    count: usize,
    /// For inputs that do not stand in columns.
    room: Block<T, I>,
    outputs: Block<T, O>,
    careful: Careful,
}

impl<M, T, In, Out, Careful, const I: usize, const O: usize>
    Blocks<'_, M, T, In, Out, Careful, I, O>
where
    M: Machine<T>,
    T: Float,
    In: Source<T, I>,
    Out: Sink<T, O>,
    Careful: Fn(&Columns<'_, T, I>, &mut Block<T, O>),
{
    #[inline(always)]
    fn all<S>(&mut self, work: &mut impl OnBlock<S, T, I, O>) {
        let mut start = 0;
        while start < self.count {
            let inputs = self.source.block(self.machine, start, &mut self.room);
            work.on_block(&inputs, &mut self.outputs);
            if !self.sink.store(self.machine, start, &self.outputs) {
                (self.careful)(&inputs, &mut self.outputs);
                self.sink.store(self.machine, start, &self.outputs);
            }
            start += BLOCK;
        }
    }
}

impl<M, T, S, In, Out, Careful, const I: usize, const O: usize> Points<S, I, O>
    for Blocks<'_, M, T, In, Out, Careful, I, O>
where
    M: Machine<T>,
    T: Float,
    S: Stand<T>,
    In: Source<T, I>,
    Out: Sink<T, O>,
    Careful: Fn(&Columns<'_, T, I>, &mut Block<T, O>),
{
    #[inline(always)]
    fn each(&mut self, function: &impl Function<S, I, O>) {
        self.all(&mut One(function));
    }

    #[inline(always)]
    fn each_then<const B: usize, const N: usize>(
        &mut self,
        first: &impl Function<S, I, B>,
        second: &impl Function<S, N, O>,
        reads: [usize; N],
    ) {
        let between = Block::<T, B>::of(T::from_f64(0.0));
        self.all(&mut Two { first, second, reads, between });
    }
}

/// One block, number by number.
struct Single<'a, T, const I: usize, const O: usize> {
    inputs: &'a Columns<'a, T, I>,
    outputs: &'a mut Block<T, O>,
}

impl<T: Float, const I: usize, const O: usize> Points<T, I, O> for Single<'_, T, I, O> {
    fn each(&mut self, function: &impl Function<T, I, O>) {
        function.on_block(self.inputs, self.outputs);
    }

    fn each_then<const M: usize, const N: usize>(
        &mut self,
        first: &impl Function<T, I, M>,
        second: &impl Function<T, N, O>,
        reads: [usize; N],
    ) {
        let between = Block::<T, M>::of(T::from_f64(0.0));
        Two { first, second, reads, between }.on_block(self.inputs, self.outputs);
    }
}

#[cfg(test)]
mod tests {
    use std::vec;
    use std::vec::Vec;

    use super::run;
    use crate::bunched::tests::Both;

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
}
