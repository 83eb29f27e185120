/// The errors of one precision.
struct Check {
    precision: &'static str,
    eps: f64,
    least: f64,
    errors: [f64; SETS],
    magnitudes: [f64; SETS],
    worst: f64,
    worst_name: &'static str,
    failures: usize,
}

impl Check {
    fn new(precision: &'static str, eps: f64, least: f64) -> Self {
        let (errors, magnitudes) = ([0.0; SETS], [0.0; SETS]);
        let worst_name = "nothing";
        Check { precision, eps, least, errors, magnitudes, worst: 0.0, worst_name, failures: 0 }
    }

    fn compare<T: Real>(&mut self, set: usize, expected: &[u64], found: &[T]) {
        assert_eq!(expected.len(), found.len());
        for (expected, found) in expected.iter().zip(found) {
            let (expected, found) = (f64::from_bits(*expected), found.to_f64());
            let error = if found.is_finite() { (found - expected).abs() } else { f64::INFINITY };
            self.errors[set] = self.errors[set].max(error);
            self.magnitudes[set] = self.magnitudes[set].max(expected.abs());
        }
    }

    /// Ends the comparison of a function.
    fn settle(&mut self, name: &'static str, accepted: f64) {
        for set in 0..SETS {
            let error = self.errors[set] / self.magnitudes[set].max(self.least) / self.eps;
            if error > accepted {
                println!("{name} in {}: {error:.3} eps, accepted {accepted}", self.precision);
                self.failures += 1;
            }
            if error > self.worst {
                (self.worst, self.worst_name) = (error, name);
            }
            (self.errors[set], self.magnitudes[set]) = (0.0, 0.0);
        }
    }

    fn conclude(self) -> usize {
        let Check { precision, worst, worst_name, .. } = self;
        println!("field_ in {precision}: worst error {worst:.3} eps, of {worst_name}");
        self.failures
    }
}

/// Numbers in the precision that is checked.
fn of<T: Real, const N: usize>(bits: [u64; N]) -> [T; N] {
    bits.map(|bits| T::of(f64::from_bits(bits)))
}

/// Two points as a function of many takes them: a column for each number.
fn columns<T: Real, const N: usize>(first: [u64; N], second: [u64; N]) -> [[T; 2]; N] {
    core::array::from_fn(|k| of([first[k], second[k]]))
}
