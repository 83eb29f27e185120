//! The errors of one norm on levels of refinement.

/// ln(e1/e2) / ln(h1/h2).
///
/// `None` if there is no order: an error or a length is not positive and finite, or h1 = h2. An error of exactly zero has no
/// order: a method that represents the field exactly proves nothing.
pub fn observed_order(errors: [f64; 2], lengths: [f64; 2]) -> Option<f64> {
    let usable = |value: f64| value > 0.0 && value.is_finite();
    let all_usable = errors.into_iter().chain(lengths).all(usable);
    let order = (errors[0] / errors[1]).ln() / (lengths[0] / lengths[1]).ln();
    (all_usable && order.is_finite()).then_some(order)
}

/// The error of one run in one norm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// The refined length: h or dt.
    pub length: f64,
    /// The error; `None` if the run stopped.
    pub error: Option<f64>,
    /// Whether the error may be at round-off.
    pub is_noise: bool,
    /// Half a unit of the last printed digit of the error; 0 if it was not rounded.
    pub rounding: f64,
}

impl Sample {
    /// The error of a run that ended, well above round-off.
    pub fn new(length: f64, error: f64) -> Self {
        Self { length, error: Some(error), is_noise: false, rounding: 0.0 }
    }

    fn relative_rounding(&self) -> f64 {
        self.error.filter(|error| *error > 0.0).map_or(0.0, |error| self.rounding / error)
    }
}

/// The relative difference below which two lengths are equal.
const SAME: f64 = 1e-6;

/// The runs of one length. Several runs are replicates: with other grid offsets, or other seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct SequenceLevel {
    /// h or dt.
    pub length: f64,
    /// The errors of the runs, in the order in which they were given.
    pub errors: Vec<f64>,
    /// The largest relative error of printed digits over the runs.
    pub(crate) rounding: f64,
    has_stopped: bool,
    is_noise: bool,
}

impl SequenceLevel {
    /// The error; for replicates the geometric mean, since orders are differences of logarithms.
    pub fn error(&self) -> f64 {
        match self.errors.as_slice() {
            [alone] => *alone,
            several => (several.iter().map(|e| e.ln()).sum::<f64>() / several.len() as f64).exp(),
        }
    }

    /// The observed order from a coarser level to this one.
    pub fn order_from(&self, coarse: &SequenceLevel) -> Option<f64> {
        observed_order([coarse.error(), self.error()], [coarse.length, self.length])
    }

    fn join(&mut self, sample: Sample) {
        self.errors.extend(sample.error);
        self.rounding = self.rounding.max(sample.relative_rounding());
        self.has_stopped |= sample.error.is_none();
        self.is_noise |= sample.is_noise;
    }
}

/// The levels of a study in one norm, from coarse to fine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sequence {
    levels: Vec<SequenceLevel>,
    is_exact: bool,
}

impl Sequence {
    /// A sequence of samples in any order.
    pub fn new(samples: impl IntoIterator<Item = Sample>) -> Self {
        let mut samples: Vec<Sample> = samples.into_iter().collect();
        samples.sort_by(|a, b| b.length.total_cmp(&a.length));
        let mut levels: Vec<SequenceLevel> = Vec::new();
        for sample in samples {
            match levels.last_mut() {
                Some(level) if level.length <= sample.length * (1.0 + SAME) => level.join(sample),
                _ => levels.push(SequenceLevel {
                    length: sample.length,
                    errors: sample.error.into_iter().collect(),
                    rounding: sample.relative_rounding(),
                    has_stopped: sample.error.is_none(),
                    is_noise: sample.is_noise,
                }),
            }
        }
        Self { levels, is_exact: false }
    }

    /// Sets whether all errors are known to be at round-off.
    pub fn exact(self, is_exact: bool) -> Self {
        Self { is_exact, ..self }
    }

    /// Whether all errors are known to be at round-off.
    pub fn is_exact(&self) -> bool {
        self.is_exact && !self.has_stopped()
    }

    /// The levels, from coarse to fine.
    pub fn levels(&self) -> &[SequenceLevel] {
        &self.levels
    }

    /// Whether a run stopped.
    pub fn has_stopped(&self) -> bool {
        self.levels.iter().any(|level| level.has_stopped)
    }

    /// The levels before the first that may be at round-off.
    pub fn sound(&self) -> &[SequenceLevel] {
        let sound = self.levels.iter().take_while(|level| !level.is_noise).count();
        &self.levels[..sound]
    }

    /// C of e = C h^p on the finest sound level, p being the expected order.
    pub fn error_constant(&self, expected_order: f64) -> Option<f64> {
        let finest = self.sound().last().filter(|level| !level.errors.is_empty())?;
        let constant = finest.error() / finest.length.powf(expected_order);
        (constant > 0.0 && constant.is_finite()).then_some(constant)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_of_a_power_law_is_its_exponent() {
        let order = observed_order([9e-3, 1e-3], [0.3, 0.1]).expect("an order");
        assert!((order - 2.0).abs() < 1e-12);
    }

    #[test]
    fn nothing_useless_has_an_order() {
        for errors in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [f64::NAN, 1.0], [f64::INFINITY, 1.0]] {
            assert_eq!(observed_order(errors, [0.2, 0.1]), None);
        }
        assert_eq!(observed_order([2.0, 1.0], [0.1, 0.1]), None);
    }

    #[test]
    fn levels_are_sorted_and_runs_of_one_length_are_replicates() {
        let samples = [(0.25, 1.0), (0.5, 2.0), (0.25 + 1e-9, 4.0), (1.0, 16.0)];
        let sequence = Sequence::new(samples.map(|(h, e)| Sample::new(h, e)));
        let levels = sequence.levels();
        assert_eq!(levels.iter().map(|it| it.errors.len()).collect::<Vec<_>>(), [1, 1, 2]);
        assert!((levels[2].error() - 2.0).abs() < 1e-12, "the geometric mean of 1 and 4");
        assert!((levels[1].order_from(&levels[0]).expect("an order") - 3.0).abs() < 1e-12);
    }

    #[test]
    fn levels_from_the_first_that_may_be_round_off_are_left_out() {
        let noise = Sample { is_noise: true, ..Sample::new(0.25, 1.0) };
        let sequence = Sequence::new([Sample::new(1.0, 16.0), noise, Sample::new(0.125, 1.0)]);
        assert_eq!(sequence.sound().len(), 1);
        assert_eq!(sequence.error_constant(2.0), Some(16.0));
    }
}
