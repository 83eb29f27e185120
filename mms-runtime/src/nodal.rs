//! What a node of the grid carries: four numbers that go through the processor as one.

use std::ops::{Add, AddAssign, Div, Mul};

use crate::{Real, Vector};

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

impl<T: Real> Div<T> for Nodal<T> {
    type Output = Self;
    fn div(self, divisor: T) -> Self {
        Self(self.0.map(|number| number / divisor))
    }
}
