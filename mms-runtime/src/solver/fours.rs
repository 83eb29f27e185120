//! Arrays of particles, bunch by bunch.

use crate::stencil::BUNCH;

/// The bunches of an array. If the last one is not full, its last entry stands in for those that there are not.
#[derive(Clone, Copy)]
pub(super) struct Fours<'a, V> {
    full: &'a [[V; BUNCH]],
    last: Option<[V; BUNCH]>,
}

impl<'a, V: Copy> Fours<'a, V> {
    #[inline(always)]
    pub fn new(items: &'a [V]) -> Self {
        let (full, rest) = items.as_chunks();
        Self { full, last: filled(rest) }
    }

    /// One of them.
    #[inline(always)]
    pub fn at(&self, k: usize) -> &[V; BUNCH] {
        match self.full.get(k) {
            Some(four) => four,
            None => self.last.as_ref().expect("no bunch after the last one"),
        }
    }
}

/// As [`Fours`], to be written.
pub(super) struct FoursMut<'a, V: Copy> {
    full: &'a mut [[V; BUNCH]],
    rest: &'a mut [V],
    last: Option<[V; BUNCH]>,
}

impl<'a, V: Copy> FoursMut<'a, V> {
    #[inline(always)]
    pub fn new(items: &'a mut [V]) -> Self {
        let (full, rest) = items.as_chunks_mut();
        let last = filled(rest);
        Self { full, rest, last }
    }

    /// One of them.
    #[inline(always)]
    pub fn at(&mut self, k: usize) -> &mut [V; BUNCH] {
        match self.full.get_mut(k) {
            Some(four) => four,
            None => self.last.as_mut().expect("no bunch after the last one"),
        }
    }
}

impl<V: Copy> Drop for FoursMut<'_, V> {
    fn drop(&mut self) {
        if let Some(last) = &self.last {
            self.rest.copy_from_slice(&last[..self.rest.len()]);
        }
    }
}

#[inline(always)]
fn filled<V: Copy>(rest: &[V]) -> Option<[V; BUNCH]> {
    let last = rest.last()?;
    Some(std::array::from_fn(|p| *rest.get(p).unwrap_or(last)))
}

#[cfg(test)]
mod tests {
    use super::{Fours, FoursMut};

    #[test]
    fn the_last_bunch_ends_with_its_last_entry() {
        let mut items = [0, 1, 2, 3, 4, 5];
        assert_eq!(Fours::new(&items).at(1), &[4, 5, 5, 5]);
        let mut bunches = FoursMut::new(&mut items);
        *bunches.at(0) = [7; 4];
        *bunches.at(1) = [8, 9, 10, 11];
        assert_eq!(bunches.at(1), &[8, 9, 10, 11]);
        drop(bunches);
        assert_eq!(items, [7, 7, 7, 7, 8, 9]);
    }
}
