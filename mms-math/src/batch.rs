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
use crate::structures::{put_columns, take_columns};
use crate::{Lane, Real};

pub use crate::kept::{Beside, Kept, KeptColumns};

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

/// `N` numbers at each of some points, wherever they are stored.
pub trait Source<T, const N: usize> {
    /// How many points there are.
    fn count(&self) -> usize;
    /// The points from `start` on, in a `room` for them where they do not stand in columns. Where there are not as
    /// many as a block has, the first one stands in for the others: it might be that nothing is defined elsewhere.
    fn block<'a, M: Machine<T>>(
        &'a self,
        machine: M,
        start: usize,
        room: &'a mut Block<T, N>,
    ) -> Columns<'a, T, N>;
}

/// A place for `N` numbers at each of some points.
pub trait Sink<T, const N: usize> {
    /// How many points there is room for.
    fn room(&self) -> usize;
    /// Writes the points from `start` on, as many as there is room for. Whether all that is written are numbers, which is
    /// asked of their sum: so it may be denied where infinite ones are among them.
    fn store<M: Machine<T>>(&mut self, machine: M, start: usize, block: &Block<T, N>) -> bool;
}

/// Structure of arrays: one slice for each number.
impl<T: Copy, const N: usize> Source<T, N> for [&[T]; N] {
    fn count(&self) -> usize {
        one_length(self.iter().map(|column| column.len()))
    }

    #[inline(always)]
    fn block<'a, M: Machine<T>>(
        &'a self,
        _: M,
        start: usize,
        room: &'a mut Block<T, N>,
    ) -> Columns<'a, T, N> {
        let mut lanes = room.0.iter_mut();
        core::array::from_fn(|k| {
            column_block(self[k], start, lanes.next().expect("there is one for each number"))
        })
    }
}

/// The numbers of a column from `start` on, in a `lane` of their own where there are not as many as a block has.
#[inline(always)]
pub(crate) fn column_block<'a, T: Copy>(
    column: &'a [T],
    start: usize,
    lane: &'a mut [T; BLOCK],
) -> &'a [T; BLOCK] {
    let rest = &column[start..];
    if let Some(block) = rest.first_chunk() {
        return block;
    }
    lane[..rest.len()].copy_from_slice(rest);
    lane[rest.len()..].fill(rest[0]);
    lane
}

/// Array of structures: the numbers of a point beside each other.
impl<T: Copy, const N: usize> Source<T, N> for &[[T; N]] {
    fn count(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn block<'a, M: Machine<T>>(
        &'a self,
        machine: M,
        start: usize,
        room: &'a mut Block<T, N>,
    ) -> Columns<'a, T, N> {
        turn(machine, &self[start..], &mut room.0);
        room.0.each_ref()
    }
}

/// Points that do not stand in columns, and are copied to lanes.
pub trait Copied<T> {
    /// How many numbers a point has.
    const NUMBERS: usize;
    /// How many points there are.
    fn points(&self) -> usize;
    /// Copies the points from `start` on, as many as fit and are there, to lanes: one for each of their numbers; the first
    /// one where there are no more.
    fn copy<M: Machine<T>>(&self, machine: M, start: usize, lanes: &mut [[T; BLOCK]]);
}

impl<T: Copy, const N: usize> Copied<T> for &[[T; N]] {
    const NUMBERS: usize = N;

    fn points(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn copy<M: Machine<T>>(&self, machine: M, start: usize, lanes: &mut [[T; BLOCK]]) {
        turn(machine, &self[start..], lanes);
    }
}

/// The numbers of some points, and then others of the same points: positions, and what comes with them.
impl<T, A: Copied<T>, B: Copied<T>, const N: usize> Source<T, N> for (A, B) {
    fn count(&self) -> usize {
        one_length([self.0.points(), self.1.points()].into_iter())
    }

    #[inline(always)]
    fn block<'a, M: Machine<T>>(
        &'a self,
        machine: M,
        start: usize,
        room: &'a mut Block<T, N>,
    ) -> Columns<'a, T, N> {
        const { assert!(A::NUMBERS + B::NUMBERS == N) };
        let (first, second) = room.0.split_at_mut(A::NUMBERS);
        self.0.copy(machine, start, first);
        self.1.copy(machine, start, second);
        room.0.each_ref()
    }
}

impl<T: Float, const N: usize> Sink<T, N> for [&mut [T]; N] {
    fn room(&self) -> usize {
        one_length(self.iter().map(|column| column.len()))
    }

    #[inline(always)]
    fn store<M: Machine<T>>(&mut self, machine: M, start: usize, block: &Block<T, N>) -> bool {
        let mut sum = machine.splat(T::from_f64(0.0));
        for (column, lane) in self.iter_mut().zip(&block.0) {
            let to = &mut column[start..];
            let Some(to) = to.first_chunk_mut::<BLOCK>() else {
                to.copy_from_slice(&lane[..to.len()]);
                sum = machine.plus(sum, sum_of(machine, lane));
                continue;
            };
            let mut own = machine.splat(T::from_f64(0.0));
            // After a call that copies, all constants of the kernel would have to be loaded again.
            for (to, eight) in to.as_chunks_mut().0.iter_mut().zip(lane.as_chunks().0) {
                let eight = machine.eight(eight);
                *to = machine.numbers(eight);
                own = machine.plus(own, eight);
            }
            sum = machine.plus(sum, own);
        }
        machine.all_at_most(sum, sum)
    }
}

impl<T: Float, const N: usize> Sink<T, N> for &mut [[T; N]] {
    fn room(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn store<M: Machine<T>>(&mut self, machine: M, start: usize, block: &Block<T, N>) -> bool {
        turn_back(machine, &block.0, &mut self[start..]);
        are_numbers(machine, block)
    }
}

/// Whether all values are numbers, as [`Sink::store`] says it: past the last point there are copies of the first one,
/// of which as much is known.
#[inline(always)]
pub(crate) fn are_numbers<T: Float, M: Machine<T>, const N: usize>(
    machine: M,
    block: &Block<T, N>,
) -> bool {
    let mut sum = machine.splat(T::from_f64(0.0));
    for lane in &block.0 {
        sum = machine.plus(sum, sum_of(machine, lane));
    }
    machine.all_at_most(sum, sum)
}

/// The sums of every eighth value of a lane. Lanes are summed apart, for a sum waits for the one before.
#[inline(always)]
fn sum_of<T: Float, M: Machine<T>>(machine: M, lane: &[T; BLOCK]) -> M::Eight {
    let mut sum = machine.splat(T::from_f64(0.0));
    for eight in lane.as_chunks().0 {
        sum = machine.plus(sum, machine.eight(eight));
    }
    sum
}

/// Copies points, as many as fit and are there, to lanes: one for each of their numbers; the first one where there
/// are no more.
#[inline(always)]
fn turn<T: Copy, M: Machine<T>, const N: usize>(
    machine: M,
    points: &[[T; N]],
    lanes: &mut [[T; BLOCK]],
) {
    let points = &points[..points.len().min(BLOCK)];
    let (eights, others) = points.as_chunks::<8>();
    for (eight, points) in eights.iter().enumerate() {
        let mut columns = [machine.splat(points[0][0]); N];
        take_columns(machine, points.as_flattened(), &mut columns);
        for number in 0..N {
            let place = &mut lanes[number][8 * eight..8 * eight + 8];
            place.copy_from_slice(&machine.numbers(columns[number]));
        }
    }
    for (point, place) in others.iter().zip(8 * eights.len()..) {
        for number in 0..N {
            lanes[number][place] = point[number];
        }
    }
    for number in 0..N {
        lanes[number][points.len()..].fill(points[0][number]);
    }
}

/// Copies lanes back to points.
#[inline(always)]
fn turn_back<T: Copy, M: Machine<T>, const N: usize>(
    machine: M,
    lanes: &[[T; BLOCK]; N],
    points: &mut [[T; N]],
) {
    let count = points.len().min(BLOCK);
    let (eights, others) = points[..count].as_chunks_mut::<8>();
    for (eight, points) in eights.iter_mut().enumerate() {
        let mut columns = [machine.splat(lanes[0][0]); N];
        for number in 0..N {
            let place = lanes[number][8 * eight..].first_chunk();
            columns[number] = machine.eight(place.expect("there are eight more"));
        }
        put_columns(machine, &columns, points.as_flattened_mut());
    }
    for (point, place) in others.iter_mut().zip(8 * eights.len()..) {
        for number in 0..N {
            point[number] = lanes[number][place];
        }
    }
}

/// The length that all columns have.
pub(crate) fn one_length(mut lengths: impl Iterator<Item = usize>) -> usize {
    let first = lengths.next().unwrap_or(0);
    for length in lengths {
        assert_eq!(length, first, "the slices of a batch have different lengths");
    }
    first
}

/// Some columns, and then others.
#[doc(hidden)]
pub fn join<C: Copy, const A: usize, const B: usize, const N: usize>(
    first: [C; A],
    second: [C; B],
) -> [C; N] {
    const { assert!(A + B == N) };
    core::array::from_fn(|index| if index < A { first[index] } else { second[index - A] })
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
