//! Arrays of particles, grouped in packs of [`PACK`] (array of structures of arrays).

use std::fmt;
use std::ops::{Deref, DerefMut};

use mms_math::packed::Numbers;

use crate::real::{Matrix, Real, Vector};

/// The number of particles in a pack.
pub const PACK: usize = 8;

/// The number of particles in each half of a pack.
pub const HALF: usize = PACK / 2;

/// An array with an entry for every particle. Copies of the last entry pad the last pack, so that loops process all packs
/// alike.
#[derive(Clone, Debug, Default)]
pub struct Column<V> {
    /// The entries, padded to whole packs.
    entries: Vec<V>,
    len: usize,
}

impl<V: Copy> Column<V> {
    /// The entries, pack by pack.
    pub(crate) fn packs(&self) -> &[[V; PACK]] {
        self.entries.as_chunks().0
    }

    /// The entries, pack by pack. The caller has to change the padding like the last particle's entry.
    pub(crate) fn packs_mut(&mut self) -> &mut [[V; PACK]] {
        self.entries.as_chunks_mut().0
    }

    /// Pads the last pack with copies of the last entry again.
    pub(crate) fn fill_up(&mut self) {
        let last = self.last().copied();
        self.entries.truncate(self.len);
        if let Some(last) = last {
            self.entries.resize(self.len.next_multiple_of(PACK), last);
        }
    }
}

impl<V: Copy> From<Vec<V>> for Column<V> {
    fn from(entries: Vec<V>) -> Self {
        let mut column = Self { len: entries.len(), entries };
        column.fill_up();
        column
    }
}

impl<V: Copy> FromIterator<V> for Column<V> {
    fn from_iter<I: IntoIterator<Item = V>>(entries: I) -> Self {
        Self::from(entries.into_iter().collect::<Vec<V>>())
    }
}

impl<V> Deref for Column<V> {
    type Target = [V];

    fn deref(&self) -> &[V] {
        &self.entries[..self.len]
    }
}

impl<V> DerefMut for Column<V> {
    fn deref_mut(&mut self) -> &mut [V] {
        &mut self.entries[..self.len]
    }
}

impl<'a, V> IntoIterator for &'a Column<V> {
    type Item = &'a V;
    type IntoIter = std::slice::Iter<'a, V>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// The data of a pack of particles: for each component, the values of all particles are adjacent.
pub trait Pack: Copy + fmt::Debug + Send + Sync {
    /// The data of one particle.
    type One: Copy;

    /// A pack whose particles all have the same data.
    fn alike(one: &Self::One) -> Self;

    /// Reads the data of one particle.
    fn get(&self, particle: usize) -> Self::One;

    /// Writes the data of one particle.
    fn set(&mut self, particle: usize, one: &Self::One);
}

/// The vectors of a pack: for each of the `D` components, the values of all particles are adjacent. Aligned to cache lines,
/// since a load that crosses a line takes twice as long; packs in single precision may therefore be padded.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Vectors<T, const D: usize>(pub [[T; PACK]; D]);

impl<T: Real, const D: usize> Pack for Vectors<T, D> {
    type One = Vector<T, D>;

    fn alike(one: &Vector<T, D>) -> Self {
        Self(std::array::from_fn(|i| [one[i]; PACK]))
    }

    fn get(&self, particle: usize) -> Vector<T, D> {
        Vector::from_fn(|i, _| self.0[i][particle])
    }

    fn set(&mut self, particle: usize, one: &Vector<T, D>) {
        (0..D).for_each(|i| self.0[i][particle] = one[i]);
    }
}

/// The matrices of a pack, by columns: entry (i, j) of all particles is `.0[j][i]`. Padded as [`Vectors`] are.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Matrices<T, const D: usize>(pub [[[T; PACK]; D]; D]);

impl<T: Real, const D: usize> Matrices<T, D> {
    /// Zero.
    pub fn zeros() -> Self {
        Self([[[T::zero(); PACK]; D]; D])
    }
}

impl<T: Real, const D: usize> Pack for Matrices<T, D> {
    type One = Matrix<T, D>;

    fn alike(one: &Matrix<T, D>) -> Self {
        Self(std::array::from_fn(|j| std::array::from_fn(|i| [one[(i, j)]; PACK])))
    }

    fn get(&self, particle: usize) -> Matrix<T, D> {
        Matrix::from_fn(|i, j| self.0[j][i][particle])
    }

    fn set(&mut self, particle: usize, one: &Matrix<T, D>) {
        for j in 0..D {
            for i in 0..D {
                self.0[j][i][particle] = one[(i, j)];
            }
        }
    }
}

impl Pack for () {
    type One = ();

    fn alike((): &()) {}

    fn get(&self, _: usize) {}

    fn set(&mut self, _: usize, (): &()) {}
}

macro_rules! numbers {
    ($($dimension:literal $entries:literal),*) => {
        $(impl<T: Real> Numbers<T, $entries> for Matrices<T, $dimension> {
            #[inline(always)]
            fn numbers(&self) -> [&[T; PACK]; $entries] {
                let entries = self.0.as_flattened().first_chunk();
                entries.expect("as many entries").each_ref()
            }

            #[inline(always)]
            fn numbers_mut(&mut self) -> [&mut [T; PACK]; $entries] {
                let entries = self.0.as_flattened_mut().first_chunk_mut();
                entries.expect("as many entries").each_mut()
            }
        })*
    };
}

numbers!(1 1, 2 4, 3 9);

/// An array of [`Pack`]es with an entry for every particle. As in a [`Column`], the last pack is full.
#[derive(Clone, Debug)]
pub struct Packs<B> {
    packs: Vec<B>,
    len: usize,
}

impl<B: Pack> Packs<B> {
    /// The number of entries.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there is no entry.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// Reads the entry of one particle.
    ///
    /// # Panics
    /// If there is no such particle.
    pub fn get(&self, particle: usize) -> B::One {
        assert!(particle < self.len, "a particle that there is not");
        self.packs[particle / PACK].get(particle % PACK)
    }

    /// The entries of all particles, one after the other.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = B::One> {
        (0..self.len).map(|particle| self.get(particle))
    }

    /// The number of bytes per particle.
    pub fn bytes(&self) -> usize {
        if self.is_empty() { 0 } else { size_of::<B>() / PACK }
    }

    /// The packs.
    pub(crate) fn packs(&self) -> &[B] {
        &self.packs
    }

    /// The packs. The caller has to change the padding like the last particle's entry.
    pub(crate) fn packs_mut(&mut self) -> &mut [B] {
        &mut self.packs
    }

    /// Exchanges the entries of two particles.
    pub(crate) fn swap(&mut self, a: usize, b: usize) {
        let (first, second) = (self.get(a), self.get(b));
        self.packs[a / PACK].set(a % PACK, &second);
        self.packs[b / PACK].set(b % PACK, &first);
    }

    /// Pads the last pack with copies of the last entry again.
    pub(crate) fn fill_up(&mut self) {
        if let Some(last) = self.len.checked_sub(1) {
            let entry = self.get(last);
            for k in last % PACK + 1..PACK {
                self.packs[last / PACK].set(k, &entry);
            }
        }
    }
}

impl<B: Pack> FromIterator<B::One> for Packs<B> {
    fn from_iter<I: IntoIterator<Item = B::One>>(entries: I) -> Self {
        let mut all = Self { packs: Vec::new(), len: 0 };
        for entry in entries {
            match all.len % PACK {
                0 => all.packs.push(B::alike(&entry)),
                // Pads the rest of the pack, in case no entry follows.
                k => (k..PACK).for_each(|k| all.packs[all.len / PACK].set(k, &entry)),
            }
            all.len += 1;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::{Column, Matrices, Packs};
    use crate::real::Matrix;

    #[test]
    fn the_last_entry_stands_in_for_those_that_there_are_not() {
        let mut column = Column::from((0..10).collect::<Vec<_>>());
        assert_eq!(column.packs(), [[0, 1, 2, 3, 4, 5, 6, 7], [8, 9, 9, 9, 9, 9, 9, 9]]);
        column.swap(0, 9);
        column.fill_up();
        assert_eq!(column.packs(), [[9, 1, 2, 3, 4, 5, 6, 7], [8, 0, 0, 0, 0, 0, 0, 0]]);
        assert_eq!(*column, [9, 1, 2, 3, 4, 5, 6, 7, 8, 0]);
        assert!(Column::<i32>::default().packs().is_empty());
    }

    #[test]
    fn matrices_are_kept_entry_by_entry() {
        let matrix = |p: usize| Matrix::<f64, 2>::new(0.0, 1.0, 2.0, 3.0) * (1.0 + p as f64);
        let mut column: Packs<Matrices<_, 2>> = (0..10).map(matrix).collect();
        assert_eq!(column.packs()[0].0[1][0], [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
        assert_eq!(column.packs()[1].0[0][1], [18.0, 20.0, 20.0, 20.0, 20.0, 20.0, 20.0, 20.0]);
        column.swap(0, 9);
        column.fill_up();
        assert_eq!(column.packs()[1].0[0][1], [18.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0, 2.0]);
        let order = [9, 1, 2, 3, 4, 5, 6, 7, 8, 0].map(matrix);
        assert!(column.iter().eq(order));
    }
}
