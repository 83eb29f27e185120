//! Arrays of particles, bunch by bunch.

use std::ops::{Deref, DerefMut};

use crate::stencil::BUNCH;

/// An entry for every particle. The last bunch is full: its last entry stands in for those that there are not, so
/// that whatever is done to bunches is done to all alike.
#[derive(Clone, Debug, Default)]
pub struct Column<V> {
    /// Of whole bunches.
    entries: Vec<V>,
    len: usize,
}

impl<V: Copy> Column<V> {
    /// Bunch by bunch.
    pub(crate) fn bunches(&self) -> &[[V; BUNCH]] {
        self.entries.as_chunks().0
    }

    /// Bunch by bunch; the entries of a bunch that stand for the last particle have to become what its own does.
    pub(crate) fn bunches_mut(&mut self) -> &mut [[V; BUNCH]] {
        self.entries.as_chunks_mut().0
    }

    /// Has the last entry stand in again for those that there are not.
    pub(crate) fn fill_up(&mut self) {
        let last = self.last().copied();
        self.entries.truncate(self.len);
        if let Some(last) = last {
            self.entries.resize(self.len.next_multiple_of(BUNCH), last);
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

#[cfg(test)]
mod tests {
    use super::Column;

    #[test]
    fn the_last_entry_stands_in_for_those_that_there_are_not() {
        let mut column = Column::from(vec![0, 1, 2, 3, 4, 5]);
        assert_eq!(column.bunches(), [[0, 1, 2, 3], [4, 5, 5, 5]]);
        column.swap(0, 5);
        column.fill_up();
        assert_eq!(column.bunches_mut(), [[5, 1, 2, 3], [4, 0, 0, 0]]);
        assert_eq!(*column, [5, 1, 2, 3, 4, 0]);
        assert!(Column::<i32>::default().bunches().is_empty());
    }
}
