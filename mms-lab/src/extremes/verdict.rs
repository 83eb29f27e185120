//! The verdict of a row: its result, and whether it is expected.
//!
//! A bound is l2 of the declared field times the factor of the row, times the square of the ratio of cell sizes if the grid is
//! coarser, plus five times the predicted round-off. Errors are relative to the largest displacement. The command searches for
//! runs that end beyond their bound, or stop for a reason that the row does not name. If J is small, a cell of a grid in space
//! holds 1/J times the material, like a cell of h/J with J = 1. If the bound times (1/J)^2 exceeds the motion itself, it bounds
//! nothing: a run beyond it is `unresolved`. The total formulation follows the same motion in second order, in a stable step.

use mms_runtime::{Cause, Refusal};
use serde::Deserialize;

use super::rows::ExtremeSetting;

/// The reason for missing errors, in a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Diagnosis {
    /// The time step is above the stable one.
    UnstableStep,
    /// J <= 0.
    Inverted,
    /// A value is infinite or not a number.
    NotFinite,
    /// A particle left the grid.
    Lost,
    /// A particle's domain is wider than a cell.
    HalfWidth,
    /// A particle's domain is flat.
    FlatDomain,
    /// A node beside a prescribed face has no reference position.
    NoReferencePosition,
    /// The observer stopped the run.
    Stopped,
    /// The scene does not fit.
    TooLarge,
    /// The scene makes no sense for another reason.
    Refused,
}

impl Diagnosis {
    /// The diagnosis of a run that stopped.
    pub fn of_cause(cause: &Cause) -> Self {
        match cause {
            Cause::UnstableStep { .. } => Diagnosis::UnstableStep,
            Cause::Inverted { .. } | Cause::BeyondAxis { .. } => Diagnosis::Inverted,
            Cause::NotFinite { .. } | Cause::OutOfRange { .. } => Diagnosis::NotFinite,
            Cause::Lost { .. } | Cause::LostInRelaxation { .. } => Diagnosis::Lost,
            Cause::HalfWidth { .. } => Diagnosis::HalfWidth,
            Cause::FlatDomain => Diagnosis::FlatDomain,
            Cause::NoReferencePosition { .. } => Diagnosis::NoReferencePosition,
            Cause::NotRelaxed { .. } | Cause::Stopped { .. } => Diagnosis::Stopped,
        }
    }

    /// The diagnosis of a run that was not started.
    pub fn of_refusal(refusal: &Refusal) -> Self {
        match refusal {
            Refusal::TooLarge { .. } => Diagnosis::TooLarge,
            _ => Diagnosis::Refused,
        }
    }

    /// The word in rows and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Diagnosis::UnstableStep => "unstable_step",
            Diagnosis::Inverted => "inverted",
            Diagnosis::NotFinite => "not_finite",
            Diagnosis::Lost => "lost",
            Diagnosis::HalfWidth => "half_width",
            Diagnosis::FlatDomain => "flat_domain",
            Diagnosis::NoReferencePosition => "no_reference_position",
            Diagnosis::Stopped => "stopped",
            Diagnosis::TooLarge => "too_large",
            Diagnosis::Refused => "refused",
        }
    }
}

/// The result of a run. Errors are relative to the largest displacement of the field.
#[derive(Clone, Debug, PartialEq)]
pub enum RunResult {
    /// The run ended.
    Ended {
        /// The largest over time of the root mean square over particles.
        l2: f64,
        /// The predicted part of round-off in the error.
        round_off: f64,
        /// h divided by the body's longest edge.
        cell_size: f64,
        /// The least J of the field, if the grid is in space; 1, if it moves with the material.
        least_jacobian: f64,
    },
    /// The run stopped.
    Stopped {
        /// The reason, in a word.
        diagnosis: Diagnosis,
        /// The reason, in full.
        reason: String,
    },
    /// The field cannot be put into the regime.
    LeftOut {
        /// The reason.
        reason: String,
    },
}

/// The field as declared, to which rows are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Declared {
    /// The l2 of the error, relative to the largest displacement.
    pub l2: f64,
    /// h divided by the body's longest edge.
    pub cell_size: f64,
    /// The least J of the field, as for a run.
    pub least_jacobian: f64,
}

/// The verdict of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExtremeVerdict {
    /// The error is within its bound.
    WithinBound,
    /// The run stops with an allowed diagnosis.
    Stops,
    /// The error is beyond its bound, on a grid in space whose cells hold so much material, because J is small, that their
    /// error may be as large as the motion: nothing bounds it.
    Unresolved,
    /// The error is beyond its bound, and no diagnosis reports it.
    BeyondBound,
    /// The run stops with a diagnosis that is not expected.
    WrongDiagnosis,
    /// The run does not stop, although it has to.
    DoesNotStop,
    /// The field cannot be put into the regime.
    LeftOut,
}

impl ExtremeVerdict {
    /// The word in the table and in JSON.
    pub fn name(self) -> &'static str {
        match self {
            ExtremeVerdict::WithinBound => "within bound",
            ExtremeVerdict::Stops => "stops",
            ExtremeVerdict::Unresolved => "unresolved",
            ExtremeVerdict::BeyondBound => "beyond bound",
            ExtremeVerdict::WrongDiagnosis => "wrong diagnosis",
            ExtremeVerdict::DoesNotStop => "does not stop",
            ExtremeVerdict::LeftOut => "left out",
        }
    }

    /// Whether the verdict agrees with theory.
    pub fn is_expected(self) -> bool {
        !matches!(
            self,
            ExtremeVerdict::BeyondBound
                | ExtremeVerdict::WrongDiagnosis
                | ExtremeVerdict::DoesNotStop
        )
    }
}

/// Noise of rounding is within this factor of its prediction.
const NOISE: f64 = 5.0;

/// The largest l2 that a row allows on a grid and with round-off, relative to the largest displacement.
pub fn bound(
    row: &ExtremeSetting,
    declared: Declared,
    cell_size: f64,
    round_off: f64,
) -> Option<f64> {
    let coarser = (cell_size / declared.cell_size).max(1.0);
    row.l2.map(|factor| factor * declared.l2 * coarser.powi(2) + NOISE * round_off)
}

/// Whether a bound of the error is useless, because it is as large as the motion or larger: cells in space of size `h` hold as
/// much material as cells of size h/J hold at J = 1, and errors grow with the square of this size.
fn is_vacuous(bound: f64, declared: Declared, least_jacobian: f64) -> bool {
    let crowded = (declared.least_jacobian / least_jacobian).max(1.0);
    crowded > 1.0 && bound * crowded.powi(2) >= 1.0
}

/// The verdict on the result of a row.
pub fn judge(row: &ExtremeSetting, declared: Declared, seen: &RunResult) -> ExtremeVerdict {
    match seen {
        RunResult::LeftOut { .. } => ExtremeVerdict::LeftOut,
        RunResult::Stopped { diagnosis, .. } if row.stops.contains(diagnosis) => {
            ExtremeVerdict::Stops
        }
        RunResult::Stopped { .. } => ExtremeVerdict::WrongDiagnosis,
        RunResult::Ended { l2, round_off, cell_size, least_jacobian } => {
            match bound(row, declared, *cell_size, *round_off) {
                None => ExtremeVerdict::DoesNotStop,
                Some(bound) if *l2 <= bound => ExtremeVerdict::WithinBound,
                Some(bound) if l2.is_finite() && is_vacuous(bound, declared, *least_jacobian) => {
                    ExtremeVerdict::Unresolved
                }
                Some(_) => ExtremeVerdict::BeyondBound,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(keys: &str) -> ExtremeSetting {
        toml::from_str(&format!("name = \"a/b\"\ntheory = \"t\"\n{keys}")).unwrap()
    }

    #[test]
    fn a_row_is_within_its_bound_or_stops_as_expected() {
        let declared = Declared { l2: 1e-3, cell_size: 0.1, least_jacobian: 0.5 };
        let crowded = |l2: f64, least_jacobian| RunResult::Ended {
            l2,
            round_off: 1e-6,
            cell_size: 0.1,
            least_jacobian,
        };
        let ended = |l2: f64| crowded(l2, 0.5);
        let bounded = row("l2 = 2\nstops = [\"lost\"]");
        assert_eq!(judge(&bounded, declared, &ended(2e-3)), ExtremeVerdict::WithinBound);
        assert_eq!(judge(&bounded, declared, &ended(2.1e-3)), ExtremeVerdict::BeyondBound);
        assert_eq!(judge(&bounded, declared, &ended(f64::NAN)), ExtremeVerdict::BeyondBound);
        // Cells with 30 times the material may have errors as large as the motion; cells with 10 times may not.
        assert_eq!(
            judge(&bounded, declared, &crowded(0.9, 0.5 / 30.0)),
            ExtremeVerdict::Unresolved
        );
        assert_eq!(
            judge(&bounded, declared, &crowded(1e-3, 0.5 / 30.0)),
            ExtremeVerdict::WithinBound
        );
        assert_eq!(
            judge(&bounded, declared, &crowded(0.9, 0.5 / 10.0)),
            ExtremeVerdict::BeyondBound
        );
        assert_eq!(
            judge(&bounded, declared, &crowded(f64::NAN, 1e-3)),
            ExtremeVerdict::BeyondBound
        );
        let coarse =
            RunResult::Ended { l2: 7e-3, round_off: 0.0, cell_size: 0.2, least_jacobian: 0.5 };
        assert_eq!(judge(&bounded, declared, &coarse), ExtremeVerdict::WithinBound);
        let stopped = |diagnosis| RunResult::Stopped { diagnosis, reason: String::new() };
        assert_eq!(judge(&bounded, declared, &stopped(Diagnosis::Lost)), ExtremeVerdict::Stops);
        let wrong = judge(&bounded, declared, &stopped(Diagnosis::Inverted));
        assert_eq!((wrong, wrong.is_expected()), (ExtremeVerdict::WrongDiagnosis, false));
        let stops = row("stops = [\"unstable_step\"]");
        assert_eq!(judge(&stops, declared, &ended(0.0)), ExtremeVerdict::DoesNotStop);
    }
}
