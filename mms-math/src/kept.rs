//! Values at many points that are stored to be read again and again: a column for each number, aligned to cache lines.
//!
//! In slices that begin anywhere, every vector would be read in two pieces. Slices of whole blocks are read in place.

use std::vec;
use std::vec::Vec;

use crate::batch::{Block, Columns, Copied, Float, Sink, Source};
use crate::places::are_numbers;
use crate::simd::Simd;

/// `N` numbers of each of many points.
#[derive(Clone, Debug)]
pub struct PointCache<T: Float, const N: usize> {
    /// Column after column. The block with the last points of a column is padded with copies of its first point.
    blocks: Vec<Block<T, 1>>,
    /// The number of points.
    count: usize,
}

/// The number of blocks from a column to the next one. It is odd: columns that begin at the same place of their pages would
/// compete for the same lines of the first cache.
fn stride<T: Float>(count: usize) -> usize {
    count.div_ceil(T::BLOCK) | 1
}

impl<T: Float, const N: usize> PointCache<T, N> {
    /// Allocates storage for `count` points.
    pub fn room_for(count: usize) -> Self {
        PointCache { blocks: vec![Block::of(T::from_f64(0.0)); N * stride::<T>(count)], count }
    }

    /// The number of points.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The numbers with these indices, as a source of points.
    pub fn columns<const K: usize>(&self, indices: [usize; K]) -> KeptColumns<'_, T, K> {
        let stride = stride::<T>(self.count);
        KeptColumns {
            columns: indices.map(|index| &self.blocks[index * stride..][..stride]),
            count: self.count,
        }
    }
}

impl<T: Float, const N: usize> Sink<T, N> for PointCache<T, N> {
    fn room(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn store<M: Simd<T>>(&mut self, simd: M, start: usize, block: &Block<T, N>) -> bool {
        let columns = self.blocks.chunks_exact_mut(stride::<T>(self.count));
        for (column, lane) in columns.zip(&block.0) {
            column[start / T::BLOCK] = Block([*lane]);
        }
        are_numbers(simd, block)
    }
}

/// Some of the stored numbers.
#[derive(Clone, Copy, Debug)]
pub struct KeptColumns<'a, T: Float, const K: usize> {
    columns: [&'a [Block<T, 1>]; K],
    count: usize,
}

impl<T: Float, const K: usize> Source<T, K> for KeptColumns<'_, T, K> {
    fn count(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn load<M: Simd<T>>(&self, _: M, _: usize, _: &mut Block<T, K>) {}

    #[inline(always)]
    fn columns<'a>(&'a self, start: usize, _: &'a Block<T, K>) -> Columns<'a, T, K> {
        core::array::from_fn(|k| &self.columns[k][start / T::BLOCK].0[0])
    }
}

impl<T: Float, const K: usize> Copied<T> for KeptColumns<'_, T, K> {
    const NUMBERS: usize = K;

    fn points(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn copy<M: Simd<T>>(&self, _: M, start: usize, lanes: &mut [T::Column]) {
        for (column, lane) in self.columns.iter().zip(lanes) {
            *lane = column[start / T::BLOCK].0[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use std::vec;
    use std::vec::Vec;

    use super::PointCache;
    use crate::batch::{Blocked as _, run};
    use crate::packed::tests::Both;

    #[test]
    fn what_is_kept_is_read_as_slices_are() {
        const BLOCK: usize = f64::BLOCK;
        for count in [0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK + 5] {
            let column = |from: f64| (0..count).map(|k| (from + 0.7 * k as f64).sin()).collect();
            let [x, y]: [Vec<f64>; 2] = [0.3, 0.4].map(column);
            let mut kept = PointCache::<f64, 2>::room_for(count);
            run(&Both, &[&x[..], &y], &mut kept);
            assert_eq!((kept.len(), kept.is_empty()), (count, count == 0));
            let results = || [vec![0.0; count], vec![0.0; count]];
            let [mut slices, mut columns, mut mixed] = [results(), results(), results()];
            let [xy, sum] = [0, 1].map(|n| -> Vec<f64> {
                (0..count).map(|k| [x[k] * y[k], x[k] + 2.0 * y[k]][n]).collect()
            });
            run(&Both, &[&sum[..], &xy], &mut slices.each_mut().map(|column| &mut column[..]));
            let taken = kept.columns([1, 0]);
            run(&Both, &taken, &mut columns.each_mut().map(|column| &mut column[..]));
            let both = (kept.columns([1]), [&xy[..]]);
            run(&Both, &both, &mut mixed.each_mut().map(|column| &mut column[..]));
            assert_eq!(columns, slices, "{count}");
            assert_eq!(mixed, slices, "{count}");
        }
    }
}
