//! Amplitude and phase of the levels of a study, in some periods of the motion.

use mms_convergence::observed_order;
use mms_documents::study::{self as documents, PhaseLevel};
use mms_runtime::study::{Phase, Refinement};

use super::table::TextTable;

/// The amplitudes and phases of some periods.
pub struct Phases {
    /// The duration of a period.
    pub period: f64,
    /// The numbers of the measured periods, from 1.
    pub measured: Vec<usize>,
    /// The phase on each level, from coarse to fine, in each of these periods; fewer if a run stopped.
    pub levels: Vec<Vec<Option<Phase>>>,
}

impl Phases {
    /// The levels in the `which`th of the measured periods, with the orders between them.
    fn rows(
        &self,
        which: usize,
        lengths: &[Option<f64>],
        refinement: Refinement,
    ) -> Vec<PhaseLevel> {
        let column = |of: fn(&Phase) -> f64| -> Vec<Option<f64>> {
            let phase = |level: &Vec<Option<Phase>>| level.get(which).copied().flatten();
            self.levels.iter().map(|level| phase(level).as_ref().map(of)).collect()
        };
        let (amplitudes, lags) = (column(|it| it.amplitude_error), column(|it| it.phase_lag));
        let orders = [&amplitudes, &lags].map(|values| orders(values, lengths, refinement));
        let rows = amplitudes.iter().zip(&lags).enumerate();
        rows.map(|(level, (&amplitude_error, &phase_lag))| PhaseLevel {
            amplitude_error,
            order_amplitude: orders[0][level],
            phase_lag,
            order_phase: orders[1][level],
        })
        .collect()
    }

    /// The errors as a part of a document. `lengths` are h or dt of each level that was started.
    pub fn document(&self, lengths: &[Option<f64>], refinement: Refinement) -> documents::Phase {
        let period = |(which, &number): (usize, &usize)| documents::Period {
            number,
            levels: self.rows(which, lengths, refinement),
        };
        let measured = self.measured.iter().enumerate().map(period).collect();
        documents::Phase { period: self.period, measured }
    }

    /// The table for a terminal.
    pub fn table(&self, lengths: &[Option<f64>], refinement: Refinement) -> TextTable {
        let length = if refinement == Refinement::Time { "time step" } else { "cell size" };
        let header = ["in period", length, "amplitude error", "order", "phase lag", "order"];
        let mut table = TextTable::new("amplitude and phase", header).right_from(0);
        for (which, number) in self.measured.iter().enumerate() {
            let rows = self.rows(which, lengths, refinement);
            for (row, length) in rows.into_iter().zip(lengths) {
                let signed =
                    |value: Option<f64>| value.map_or("-".into(), |it| format!("{it:+.2e}"));
                let order = |order: Option<f64>| order.map_or("-".into(), |it| format!("{it:.2}"));
                table.add_row([
                    number.to_string(),
                    length.map_or("-".into(), |length| format!("{length:.3e}")),
                    signed(row.amplitude_error),
                    order(row.order_amplitude),
                    signed(row.phase_lag),
                    order(row.order_phase),
                ]);
            }
        }
        table
    }
}

/// The order between each level and the one before; in time, where the error of space remains, between their difference and the
/// difference before.
fn orders(
    values: &[Option<f64>],
    lengths: &[Option<f64>],
    refinement: Refinement,
) -> Vec<Option<f64>> {
    let order = |level: usize| {
        let at = |back: usize| {
            let level = level.checked_sub(back)?;
            Some((values[level]?, lengths[level]?))
        };
        let ((last, fine), (before, coarse)) = (at(0)?, at(1)?);
        if refinement != Refinement::Time {
            return observed_order([before.abs(), last.abs()], [coarse, fine]);
        }
        let (first, coarsest) = at(2)?;
        observed_order([(first - before).abs(), (before - last).abs()], [coarsest, coarse])
    };
    (0..values.len()).map(order).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn orders_in_time_are_those_of_differences() {
        let steps = [0.4, 0.2, 0.1, 0.05].map(Some);
        let of = |space: f64, refinement| {
            orders(&steps.map(|dt| Some(space - 3.0 * dt? * dt?)), &steps, refinement)
        };
        for space in [0.0, 0.7] {
            let found = of(space, Refinement::Time);
            assert_eq!(found[..2], [None, None]);
            assert!(found[2..].iter().all(|it| (it.unwrap() - 2.0).abs() < 1e-9), "{found:?}");
        }
        let found = of(0.0, Refinement::Both);
        assert!(found[1..].iter().all(|it| (it.unwrap() - 2.0).abs() < 1e-9), "{found:?}");
        let gap = orders(&[Some(1.0), None, Some(0.1)], &steps[..3], Refinement::Both);
        assert_eq!(gap, [None; 3]);
    }
}
