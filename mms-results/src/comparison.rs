//! Compares computed values with an exact solution block by block, so that no array contains the whole exact solution.

use crate::norm::{Norms, Sums, largest_if_finite, lengths};

/// The number of values that are sampled to detect another unit.
const LOOKED_AT: usize = 1 << 16;

/// Computed numbers, compared with the exact ones added so far.
#[derive(Debug)]
pub struct Comparison<'a> {
    computed: &'a [f64],
    components: usize,
    weights: Option<&'a [f64]>,
    /// The number of points compared so far.
    seen: usize,
    sums: Sums,
    largest: f64,
    /// Sums of squares of the sampled computed and exact numbers, and of their products.
    squares: [f64; 2],
    products: f64,
}

impl<'a> Comparison<'a> {
    /// A comparison without points yet; with weights of points, or equal weights.
    pub fn new(computed: &'a [f64], components: usize, weights: Option<&'a [f64]>) -> Self {
        Comparison {
            computed,
            components,
            weights,
            seen: 0,
            sums: Sums::default(),
            largest: 0.0,
            squares: [0.0; 2],
            products: 0.0,
        }
    }

    /// Adds the exact numbers of the next points.
    ///
    /// # Errors
    /// The first of the numbers that is not finite.
    pub fn add(&mut self, exact: &[f64]) -> Result<(), usize> {
        self.largest = self.largest.max(largest_if_finite(exact)?);
        let first = self.seen * self.components;
        let computed = &self.computed[first..first + exact.len()];
        for (at, error) in lengths(computed, exact, self.components).enumerate() {
            let at = self.seen + at;
            self.sums.add(at, self.weights.map_or(1.0, |weights| weights[at]), error);
        }
        // Every `step`-th of all numbers.
        let step = self.computed.len() / LOOKED_AT + 1;
        let looked_at = (0..exact.len()).skip((step - first % step) % step).step_by(step);
        for at in looked_at {
            let (own, right) = (computed[at], exact[at]);
            self.squares[0] += own * own;
            self.squares[1] += right * right;
            self.products += own * right;
        }
        self.seen += exact.len() / self.components;
        Ok(())
    }

    /// The norms of the differences. `None` without points, or if their weights have no sum above 0.
    pub fn norms(&self) -> Option<Norms> {
        self.sums.if_any()
    }

    /// The largest absolute value of the exact numbers.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The power of ten by which the computed numbers exceed the exact ones, if they differ by this factor alone.
    pub fn unit(&self) -> Option<i32> {
        let [own, right] = self.squares;
        let alike = self.products / (own * right).sqrt();
        let power = (own / right).sqrt().log10();
        let is_one = alike > 0.99 && (power - power.round()).abs() < 0.02 && power.round() != 0.0;
        is_one.then(|| power.round() as i32)
    }
}
