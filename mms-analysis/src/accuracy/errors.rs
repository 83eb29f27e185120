//! Errors of one quantity over many points, in units of eps.

use mms_math::Scalar as _;

use mms_program::precise::Binary;
use mms_program::precision::{Digits, Precision};

/// Statistics of the errors of a quantity. Magnitudes below the least one that has all digits count as that one, so that
/// nothing is divided by 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// The median of |error| / |value| over points and components.
    pub median_eps: f64,
    /// The 99th percentile of |error| / |value|.
    pub p99_eps: f64,
    /// The maximum of |error| / |value|.
    pub max_eps: f64,
    /// The largest |error| over the largest |value|.
    pub max_scaled_eps: f64,
    /// The number of compared components.
    pub compared: usize,
    /// The number of computed components that are infinite or NaN. They are in no error statistic.
    pub not_finite: usize,
    /// The number of the infinite or NaN components whose true value is beyond the range of the precision.
    pub overflowed: usize,
    /// The number of components without a real value at their point. They are in no error statistic.
    pub undefined: usize,
}

/// The errors so far.
pub struct Tally<const BITS: usize> {
    precision: Precision,
    relative: Vec<f64>,
    largest_error: Binary<BITS>,
    largest_value: Binary<BITS>,
    errors: Errors,
}

impl<const BITS: usize> Tally<BITS> {
    /// A tally without errors.
    pub fn new(precision: Precision) -> Self {
        Tally {
            precision,
            relative: Vec::new(),
            largest_error: Binary::from_f64(0.0),
            // Smaller numbers have fewer digits, so that their error is relative to this one.
            largest_value: Binary::from_f64(precision.least()),
            errors: Errors::default(),
        }
    }

    /// Compares one component.
    pub fn compare<T: Digits>(&mut self, found: T, expected: &Binary<BITS>) {
        if !expected.is_defined() {
            self.errors.undefined += 1;
            return;
        }
        let size = expected.clone().magnitude();
        if !found.is_number() {
            self.errors.not_finite += 1;
            let in_range = size.at_most(&Binary::from_f64(self.precision.largest()));
            self.errors.overflowed += usize::from(!in_range);
            return;
        }
        let error = (found.precisely() - expected.clone()).magnitude();
        self.relative.push(self.ratio(&error, size.clone()));
        if !error.at_most(&self.largest_error) {
            self.largest_error = error;
        }
        if !size.at_most(&self.largest_value) {
            self.largest_value = size;
        }
    }

    /// An error relative to a size, in units of eps.
    fn ratio(&self, error: &Binary<BITS>, size: Binary<BITS>) -> f64 {
        let (near, scale) = (error.to_f64(), size.to_f64());
        // If both are in the range of double precision, 15 digits of an error are enough.
        if near == 0.0 || (near.is_normal() && scale.is_normal() && scale > self.precision.least())
        {
            return near / scale.max(self.precision.least()) / self.precision.eps();
        }
        let least = Binary::from_f64(self.precision.least());
        let size = if size.at_most(&least) { least } else { size };
        (error.clone() / size).to_f64() / self.precision.eps()
    }

    /// The statistics of the errors.
    pub fn finish(mut self) -> Errors {
        let scaled = self.ratio(&self.largest_error, self.largest_value.clone());
        self.relative.sort_by(f64::total_cmp);
        let compared = self.relative.len();
        let quantile = |parts: usize| {
            let place = (compared * parts).div_ceil(100).max(1) - 1;
            self.relative.get(place).copied().unwrap_or(0.0)
        };
        Errors {
            median_eps: quantile(50),
            p99_eps: quantile(99),
            max_eps: quantile(100),
            max_scaled_eps: scaled,
            compared,
            ..self.errors
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(pairs: &[(f64, f64)]) -> Errors {
        let mut tally = Tally::<256>::new(Precision::F64);
        for (found, expected) in pairs {
            tally.compare(*found, &Binary::from_f64(*expected));
        }
        tally.finish()
    }

    #[test]
    fn quantiles_are_of_components_and_the_last_is_of_the_largest() {
        let eps = f64::EPSILON;
        let mut pairs = vec![(1.0, 1.0); 98];
        pairs.extend([(4.0 * (1.0 + eps), 4.0), (1.0 + 3.0 * eps, 1.0)]);
        let errors = errors(&pairs);
        assert_eq!((errors.median_eps, errors.p99_eps, errors.max_eps), (0.0, 1.0, 3.0));
        assert_eq!((errors.max_scaled_eps, errors.compared), (1.0, 100));
    }

    #[test]
    fn what_is_no_number_is_counted_apart() {
        let mut tally = Tally::<256>::new(Precision::F32);
        tally.compare(f32::INFINITY, &Binary::from_f64(1e39));
        tally.compare(f32::NAN, &Binary::from_f64(1.0));
        tally.compare(1.0_f32, &Binary::from_f64(-1.0).sqrt());
        tally.compare(1.0_f32, &Binary::from_f64(1.0));
        let errors = tally.finish();
        assert_eq!((errors.not_finite, errors.overflowed, errors.undefined), (2, 1, 1));
        assert_eq!((errors.compared, errors.max_eps), (1, 0.0));
    }

    #[test]
    fn below_the_normal_numbers_errors_are_those_of_the_least_one() {
        let quantum = f64::from_bits(1);
        assert_eq!(errors(&[(2.0 * quantum, quantum)]).max_scaled_eps, 1.0);
    }

    #[test]
    fn nothing_compared_is_no_error() {
        assert_eq!(errors(&[]), Errors::default());
    }
}
