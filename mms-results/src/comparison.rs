//! What was computed against an exact solution that comes block by block, so that no array holds all of it.

use crate::norm::{Norms, Sums, largest_if_finite, lengths};

/// How many numbers are looked at to tell another unit.
const LOOKED_AT: usize = 1 << 16;

/// Numbers that were computed, so many for each point, against the exact ones of the points that have come.
#[derive(Debug)]
pub struct Comparison<'a> {
    computed: &'a [f64],
    components: usize,
    weights: Option<&'a [f64]>,
    /// Points that have come.
    seen: usize,
    sums: Sums,
    largest: f64,
    /// Sums of squares of some computed and of the exact numbers, and of their products.
    squares: [f64; 2],
    products: f64,
}

impl<'a> Comparison<'a> {
    /// Of no points yet, each with its weight, or all alike.
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

    /// Takes the exact numbers of the points that follow.
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
        // Every so many numbers of all.
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

    /// The norms of the differences. `None` without points, or where their weights have no sum above 0.
    pub fn norms(&self) -> Option<Norms> {
        self.sums.if_any()
    }

    /// The largest exact number, without its sign.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The power of ten by which what was computed is larger than the exact numbers, if it is that, and else alike.
    pub fn unit(&self) -> Option<i32> {
        let [own, right] = self.squares;
        let alike = self.products / (own * right).sqrt();
        let power = (own / right).sqrt().log10();
        let is_one = alike > 0.99 && (power - power.round()).abs() < 0.02 && power.round() != 0.0;
        is_one.then(|| power.round() as i32)
    }
}
