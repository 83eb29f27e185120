//! Sources of points, and sinks for results: in columns, adjacent per point, or in any other layout that can be copied.

use crate::batch::{Block, Columns, Float};
use crate::simd::Simd;
use crate::structures::{put_columns, take_columns};

/// `N` numbers at each of some points, in any layout.
pub trait Source<T: Float, const N: usize> {
    /// The number of points.
    fn count(&self) -> usize;
    /// Copies the points from `start` on to the buffer `room`, unless they are stored in columns. If there are fewer than a
    /// block has, copies of the first one pad the block: other values might be outside the domain.
    fn load<M: Simd<T>>(&self, simd: M, start: usize, room: &mut Block<T, N>);
    /// The points from `start` on: in place, or in the buffer `room` that they were copied to.
    fn columns<'a>(&'a self, start: usize, room: &'a Block<T, N>) -> Columns<'a, T, N>;
}

/// The destination of results: `N` numbers at each point.
pub trait Sink<T: Float, const N: usize> {
    /// The number of points that can be stored.
    fn room(&self) -> usize;
    /// Writes the points from `start` on, as many as can be stored. Returns false if any written value is NaN. May also return
    /// false for infinities of both signs, since it tests the sum.
    fn store<M: Simd<T>>(&mut self, simd: M, start: usize, block: &Block<T, N>) -> bool;
}

/// Structure of arrays: one slice for each number.
impl<T: Float, const N: usize> Source<T, N> for [&[T]; N] {
    fn count(&self) -> usize {
        one_length(self.iter().map(|column| column.len()))
    }

    #[inline(always)]
    fn load<M: Simd<T>>(&self, _: M, start: usize, room: &mut Block<T, N>) {
        for (column, lane) in self.iter().zip(&mut room.0) {
            if column[start..].len() < T::BLOCK {
                fill(lane, &column[start..]);
            }
        }
    }

    #[inline(always)]
    fn columns<'a>(&'a self, start: usize, room: &'a Block<T, N>) -> Columns<'a, T, N> {
        core::array::from_fn(|k| T::first_of(&self[k][start..]).unwrap_or(&room.0[k]))
    }
}

/// Copies numbers to a lane, as many as fit, and pads the rest with the first one.
#[inline(always)]
pub(crate) fn fill<T: Float>(lane: &mut T::Column, numbers: &[T]) {
    let count = numbers.len().min(T::BLOCK);
    let lane = T::numbers_mut(lane);
    lane[..count].copy_from_slice(&numbers[..count]);
    lane[count..].fill(numbers[0]);
}

impl<T: Float, const N: usize> Copied<T> for [&[T]; N] {
    const NUMBERS: usize = N;

    fn points(&self) -> usize {
        self.count()
    }

    #[inline(always)]
    fn copy<M: Simd<T>>(&self, _: M, start: usize, lanes: &mut [T::Column]) {
        for (column, lane) in self.iter().zip(lanes) {
            fill(lane, &column[start..]);
        }
    }
}

/// Array of structures: the numbers of a point are adjacent.
impl<T: Float, const N: usize> Source<T, N> for &[[T; N]] {
    fn count(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn load<M: Simd<T>>(&self, simd: M, start: usize, room: &mut Block<T, N>) {
        turn(simd, &self[start..], &mut room.0);
    }

    #[inline(always)]
    fn columns<'a>(&'a self, _: usize, room: &'a Block<T, N>) -> Columns<'a, T, N> {
        room.0.each_ref()
    }
}

/// Points that are not stored in columns, and are copied to lanes.
pub trait Copied<T: Float> {
    /// The number of numbers of a point.
    const NUMBERS: usize;
    /// The number of points.
    fn points(&self) -> usize;
    /// Copies the points from `start` on to lanes, as many as fit: one lane for each of their numbers. Pads the rest with the
    /// first point.
    fn copy<M: Simd<T>>(&self, simd: M, start: usize, lanes: &mut [T::Column]);
}

impl<T: Float, const N: usize> Copied<T> for &[[T; N]] {
    const NUMBERS: usize = N;

    fn points(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn copy<M: Simd<T>>(&self, simd: M, start: usize, lanes: &mut [T::Column]) {
        turn(simd, &self[start..], lanes);
    }
}

/// The numbers of some points, and then other numbers of the same points: positions, and their normals.
impl<T: Float, A: Copied<T>, B: Copied<T>, const N: usize> Source<T, N> for (A, B) {
    fn count(&self) -> usize {
        one_length([self.0.points(), self.1.points()].into_iter())
    }

    #[inline(always)]
    fn load<M: Simd<T>>(&self, simd: M, start: usize, room: &mut Block<T, N>) {
        const { assert!(A::NUMBERS + B::NUMBERS == N) };
        let (first, second) = room.0.split_at_mut(A::NUMBERS);
        self.0.copy(simd, start, first);
        self.1.copy(simd, start, second);
    }

    #[inline(always)]
    fn columns<'a>(&'a self, _: usize, room: &'a Block<T, N>) -> Columns<'a, T, N> {
        room.0.each_ref()
    }
}

impl<T: Float, const N: usize> Sink<T, N> for [&mut [T]; N] {
    fn room(&self) -> usize {
        one_length(self.iter().map(|column| column.len()))
    }

    #[inline(always)]
    fn store<M: Simd<T>>(&mut self, simd: M, start: usize, block: &Block<T, N>) -> bool {
        let mut sum = simd.splat(T::from_f64(0.0));
        for (column, lane) in self.iter_mut().zip(&block.0) {
            let to = &mut column[start..];
            let Some(to) = T::first_of_mut(to) else {
                to.copy_from_slice(&T::numbers(lane)[..to.len()]);
                sum = simd.plus(sum, sum_of(simd, lane));
                continue;
            };
            let mut own = simd.splat(T::from_f64(0.0));
            // After a call that copies, all constants of the kernel would have to be loaded again.
            let to = T::numbers_mut(to).as_chunks_mut().0;
            for (to, eight) in to.iter_mut().zip(T::numbers(lane).as_chunks().0) {
                let eight = simd.eight(eight);
                *to = simd.numbers(eight);
                own = simd.plus(own, eight);
            }
            sum = simd.plus(sum, own);
        }
        simd.all_at_most(sum, sum)
    }
}

impl<T: Float, const N: usize> Sink<T, N> for &mut [[T; N]] {
    fn room(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn store<M: Simd<T>>(&mut self, simd: M, start: usize, block: &Block<T, N>) -> bool {
        turn_back(simd, &block.0, &mut self[start..]);
        are_numbers(simd, block)
    }
}

/// Whether no value is NaN, with the restriction of [`Sink::store`]. Copies of the first point after the last one do not change
/// the result.
#[inline(always)]
pub(crate) fn are_numbers<T: Float, M: Simd<T>, const N: usize>(
    simd: M,
    block: &Block<T, N>,
) -> bool {
    let mut sum = simd.splat(T::from_f64(0.0));
    for lane in &block.0 {
        sum = simd.plus(sum, sum_of(simd, lane));
    }
    simd.all_at_most(sum, sum)
}

/// The sums of every eighth value of a lane. Lanes are summed separately, for each sum waits for the previous one.
#[inline(always)]
fn sum_of<T: Float, M: Simd<T>>(simd: M, lane: &T::Column) -> M::Eight {
    let mut sum = simd.splat(T::from_f64(0.0));
    for eight in T::numbers(lane).as_chunks().0 {
        sum = simd.plus(sum, simd.eight(eight));
    }
    sum
}

/// Copies points to lanes, as many as fit: one lane for each of their numbers. Pads the rest with the first point.
#[inline(always)]
fn turn<T: Float, M: Simd<T>, const N: usize>(simd: M, points: &[[T; N]], lanes: &mut [T::Column]) {
    let points = &points[..points.len().min(T::BLOCK)];
    let (eights, others) = points.as_chunks::<8>();
    for (eight, points) in eights.iter().enumerate() {
        let mut columns = [simd.splat(points[0][0]); N];
        take_columns(simd, points.as_flattened(), &mut columns);
        for number in 0..N {
            let lane = T::numbers_mut(&mut lanes[number]);
            let place = &mut lane[8 * eight..8 * eight + 8];
            place.copy_from_slice(&simd.numbers(columns[number]));
        }
    }
    for (point, place) in others.iter().zip(8 * eights.len()..) {
        for number in 0..N {
            T::numbers_mut(&mut lanes[number])[place] = point[number];
        }
    }
    for number in 0..N {
        T::numbers_mut(&mut lanes[number])[points.len()..].fill(points[0][number]);
    }
}

/// Copies lanes back to points.
#[inline(always)]
fn turn_back<T: Float, M: Simd<T>, const N: usize>(
    simd: M,
    lanes: &[T::Column; N],
    points: &mut [[T; N]],
) {
    let count = points.len().min(T::BLOCK);
    let (eights, others) = points[..count].as_chunks_mut::<8>();
    for (eight, points) in eights.iter_mut().enumerate() {
        let mut columns = [simd.splat(T::numbers(&lanes[0])[0]); N];
        for number in 0..N {
            let place = T::numbers(&lanes[number])[8 * eight..].first_chunk();
            columns[number] = simd.eight(place.expect("there are eight more"));
        }
        put_columns(simd, &columns, points.as_flattened_mut());
    }
    for (point, place) in others.iter_mut().zip(8 * eights.len()..) {
        for number in 0..N {
            point[number] = T::numbers(&lanes[number])[place];
        }
    }
}

/// The common length of all columns.
pub(crate) fn one_length(mut lengths: impl Iterator<Item = usize>) -> usize {
    let first = lengths.next().unwrap_or(0);
    for length in lengths {
        assert_eq!(length, first, "the slices of a batch have different lengths");
    }
    first
}
