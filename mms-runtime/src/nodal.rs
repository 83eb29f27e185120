//! Values at a node of the grid: four numbers that fit one register, a vector and the mass beside the momentum.

use std::ops::{Add, AddAssign, Mul};

use mms_math::simd::Simd;

use crate::real::{Real, Vector};

/// A vector at a node, in the first components, and in the last one a number that is mapped along with it: the mass beside the
/// momentum.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub struct Nodal<T>(pub [T; 4]);

/// The component of the mass.
pub const LAST: usize = 3;

impl<T: Real> Nodal<T> {
    /// All four numbers 0.
    pub fn zero() -> Self {
        Self([T::zero(); 4])
    }

    /// A vector, and a number beside it.
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

    /// The number beside the vector.
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

/// A mutable range of the nodes from `start` on; empty for an array that is not in use.
pub struct Window<'a, T> {
    /// The number of the first node.
    pub start: usize,
    /// The values at the nodes.
    pub nodes: &'a mut [Nodal<T>],
}

impl<'a, T> Window<'a, T> {
    /// A shorter borrow of the same nodes.
    #[inline(always)]
    pub fn reborrow(&mut self) -> Window<'_, T> {
        Window { start: self.start, nodes: self.nodes }
    }

    /// `W` nodes from `first` on.
    #[inline(always)]
    pub fn row<const W: usize>(&mut self, first: u32) -> &mut [Nodal<T>; W] {
        // A number of 32 bits plus W does not overflow 64 bits, so checking the last node is enough.
        let first = first.wrapping_sub(self.start as u32) as usize;
        self.nodes[first..first + W].first_chunk_mut().expect("a range of W nodes")
    }

    /// Splits the window before node `at`.
    pub fn split(self, at: usize) -> [Self; 2] {
        let (before, after) = self.nodes.split_at_mut((at - self.start).min(self.nodes.len()));
        [Self { start: self.start, nodes: before }, Self { start: at, nodes: after }]
    }
}

/// A vector for each half, and `other` in all further places.
#[inline(always)]
pub fn halves<T: Real, M: Simd<T>, const D: usize>(
    simd: M,
    [first, second]: [&Vector<T, D>; 2],
    other: T,
) -> M::Eight {
    let first = |a: usize| if a < D { first[a] } else { other };
    let second = |a: usize| if a < D { second[a] } else { other };
    simd.halves(&[first(0), first(1), first(2), other], &[second(0), second(1), second(2), other])
}
