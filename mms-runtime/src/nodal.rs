//! What a node of the grid carries: four numbers that go through the processor as one, a vector, and the mass
//! beside the momentum.

use std::ops::{Add, AddAssign, Mul};

use mms_math::machine::Machine;

use crate::real::{Real, Vector};

/// A vector at a node, in the first components, and in the last one what is mapped along with it: the
/// mass along with the momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Nodal<T>(pub [T; 4]);

/// Where the mass is.
pub const LAST: usize = 3;

impl<T: Real> Nodal<T> {
    /// Nothing.
    pub fn zero() -> Self {
        Self([T::zero(); 4])
    }

    /// A vector, and a number along with it.
    #[inline(always)]
    pub fn new<const D: usize>(vector: &Vector<T, D>, last: T) -> Self {
        const { assert!(D <= LAST) };
        let component = |a: usize| if a < D { vector[a] } else { T::zero() };
        Self([component(0), component(1), component(2), last])
    }

    /// The vector.
    pub fn vector<const D: usize>(&self) -> Vector<T, D> {
        Vector::from_fn(|a, _| self.0[a])
    }

    /// The number along with the vector.
    pub fn last(&self) -> T {
        self.0[LAST]
    }
}

impl<T: Real> AddAssign for Nodal<T> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Real> Add for Nodal<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k] + other.0[k]))
    }
}

impl<T: Real> Mul<T> for Nodal<T> {
    type Output = Self;
    fn mul(self, factor: T) -> Self {
        Self(self.0.map(|number| number * factor))
    }
}

/// The nodes from `start` on, to be added to; an array that is not in use is empty.
pub struct Window<'a, T> {
    /// The number of the first one.
    pub start: usize,
    /// What they carry.
    pub nodes: &'a mut [Nodal<T>],
}

impl<'a, T> Window<'a, T> {
    /// The same nodes, for a while.
    #[inline(always)]
    pub fn reborrow(&mut self) -> Window<'_, T> {
        Window { start: self.start, nodes: self.nodes }
    }

    /// `W` nodes from this one on.
    #[inline(always)]
    pub fn row<const W: usize>(&mut self, first: u32) -> &mut [Nodal<T>; W] {
        // A number of 32 bits and W do not overflow 64: so the last node is all that has to be asked for.
        let first = first.wrapping_sub(self.start as u32) as usize;
        self.nodes[first..first + W].first_chunk_mut().expect("a range of W nodes")
    }

    /// Those before a node, and those from it on.
    pub fn split(self, at: usize) -> [Self; 2] {
        let (before, after) = self.nodes.split_at_mut((at - self.start).min(self.nodes.len()));
        [Self { start: self.start, nodes: before }, Self { start: at, nodes: after }]
    }
}

/// A vector for each half, and the same number in all places that they leave.
#[inline(always)]
pub fn halves<T: Real, M: Machine<T>, const D: usize>(
    machine: M,
    [first, second]: [&Vector<T, D>; 2],
    other: T,
) -> M::Eight {
    let first = |a: usize| if a < D { first[a] } else { other };
    let second = |a: usize| if a < D { second[a] } else { other };
    machine
        .halves(&[first(0), first(1), first(2), other], &[second(0), second(1), second(2), other])
}
