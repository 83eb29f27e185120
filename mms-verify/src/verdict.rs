//! The verdict of a row of the matrix, from its levels.
//!
//! If only time is refined (`halvings`), the field must have no error in space, which would spoil the order. An example is a
//! body without strain that b(t) moves. The verdict is the first that holds:
//!
//! 1. `fail`: a level was not started; or the row expects an exact solution, and an error exceeds 5e-12.
//! 2. `does not converge`: a level stopped, or the order of `l2` on the finest pair is below 1/2. Some rows expect
//!    this.
//! 3. `fail`: the order of `l2` or `linf` is below its expected order by more than the tolerance, or the error constant differs
//!    by more than one percent from the constant of the row.
//! 4. `not asymptotic`: the order of `l2` is above the expected order by more than the tolerance, or differs by more than the
//!    tolerance from the order of the pair before.
//! 5. `pass`.
//!
//! The constant is l2 over h^order, at the finest level of `--quick`, so that both matrices compare it with the same
//! number. Runs differ by rounding alone from machine to machine, and one percent is far more.

use std::fmt;

use mms_convergence::{is_near, observed_order};
use mms_lab::outcome::SolverOutcome;

use super::matrix::{ExpectedConvergence, MatrixRow, Word};

/// An observed order below this counts as none: orders in theory are 1 or more.
const LEAST_ORDER: f64 = 0.5;

/// Errors of rounding, relative to the natural size of a quantity: 20,000 eps, for some thousand steps.
const ROUNDING: f64 = 5e-12;

/// The verdict of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowVerdict {
    /// The result that theory expects: the order and its error constant, or no error at all.
    Pass,
    /// A lower order, another constant, an error where there is none, or a run that was not started.
    Fail,
    /// An order that has not settled, or a higher one.
    NotAsymptotic,
    /// The error does not shrink, or a run stopped.
    DoesNotConverge,
}

impl fmt::Display for RowVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            RowVerdict::Pass => "pass",
            RowVerdict::Fail => "fail",
            RowVerdict::NotAsymptotic => "not asymptotic",
            RowVerdict::DoesNotConverge => "does not converge",
        })
    }
}

/// A row's outcome, and its basis.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The orders of l1, l2 and linf between each level and the one before; `None` for the first level, and if the row expects
    /// an exact solution.
    pub orders: Vec<[Option<f64>; 3]>,
    /// l2 over h^order or dt^order.
    pub constant: Option<f64>,
    /// The observed verdict.
    pub verdict: RowVerdict,
    /// The expected verdict.
    pub expected: RowVerdict,
    /// The reason why the verdict is not the expected one.
    pub reason: Option<String>,
}

impl Judgement {
    /// The order of l2 between the two finest levels.
    pub fn observed_order(&self) -> Option<f64> {
        self.orders.last().and_then(|orders| orders[1])
    }

    /// Whether the result agrees with theory.
    pub fn as_expected(&self) -> bool {
        self.verdict == self.expected
    }
}

/// Judges a row by its levels, coarse to fine. The verdict is the first that holds:
///
/// * `fail`: a level was not started; or, if the row expects an exact solution, an error exceeds rounding.
/// * `does not converge`: a level stopped, or the order of l2 between the two finest levels is below 1/2.
/// * `fail`: the order of l2 or linf there is below its expected order by more than the tolerance; or the error constant
///   differs by more than 1 % from the row's.
/// * `not asymptotic`: the order of l2 is above its expected order by more than the tolerance; or it differs by more than the
///   tolerance from the order of the pair before, if there is one.
/// * `pass`.
pub fn judge(row: &MatrixRow, levels: &[SolverOutcome]) -> Judgement {
    let orders = match row.order {
        ExpectedConvergence::Word(Word::Exact) => vec![[None; 3]; levels.len()],
        _ => orders(row, levels),
    };
    let constant = constant(row, levels);
    let expected = match row.order {
        ExpectedConvergence::Word(Word::None) => RowVerdict::DoesNotConverge,
        _ => RowVerdict::Pass,
    };
    let (verdict, reason) = see(row, levels, &orders, constant);
    let reason = (verdict != expected).then_some(reason);
    Judgement { orders, constant, verdict, expected, reason }
}

fn orders(row: &MatrixRow, levels: &[SolverOutcome]) -> Vec<[Option<f64>; 3]> {
    let order = |[coarse, fine]: [&SolverOutcome; 2], norm: usize| {
        let [e1, e2] = [row.errors(coarse)?, row.errors(fine)?];
        observed_order([e1[norm], e2[norm]], [row.size(coarse)?, row.size(fine)?])
    };
    let pairs = levels.windows(2);
    let pairs = pairs.map(|pair| [0, 1, 2].map(|norm| order([&pair[0], &pair[1]], norm)));
    std::iter::once([None; 3]).chain(pairs).take(levels.len()).collect()
}

/// The error constant at the level for which the row states one.
fn constant(row: &MatrixRow, levels: &[SolverOutcome]) -> Option<f64> {
    let ExpectedConvergence::Order(order) = row.order else { return None };
    let at = if row.quick > 0 { row.quick } else { levels.len() };
    let level = levels.get(at.checked_sub(1)?)?;
    let [_, l2, _] = row.errors(level)?;
    Some(l2 / row.size(level)?.powf(order))
}

fn see(
    row: &MatrixRow,
    levels: &[SolverOutcome],
    orders: &[[Option<f64>; 3]],
    constant: Option<f64>,
) -> (RowVerdict, String) {
    for level in levels {
        if let SolverOutcome::Refused { reason } = level {
            return (RowVerdict::Fail, format!("not started: {reason}"));
        }
    }
    if row.order == ExpectedConvergence::Word(Word::Exact) {
        return exact(row, levels);
    }
    for level in levels {
        if let SolverOutcome::Stopped { failure, .. } = level {
            return (RowVerdict::DoesNotConverge, failure.clone());
        }
    }
    let Some(&[_, Some(l2), Some(linf)]) = orders.last() else {
        return (RowVerdict::NotAsymptotic, "there is no order".into());
    };
    let seen = format!("order {l2:.2} in l2, {linf:.2} in linf");
    let ExpectedConvergence::Order(order) = row.order else {
        let verdict = if l2 < LEAST_ORDER { RowVerdict::DoesNotConverge } else { RowVerdict::Fail };
        return (verdict, seen);
    };
    if l2 < LEAST_ORDER {
        return (RowVerdict::DoesNotConverge, seen);
    }
    if l2 < order - row.tolerance || linf < row.linf.unwrap_or(order) - row.tolerance {
        return (RowVerdict::Fail, seen);
    }
    let written = row.constant.unwrap_or(f64::NAN);
    if !constant.is_some_and(|constant| is_near(constant, written)) {
        let found = constant.map_or("none".into(), |constant| format!("{constant:.4e}"));
        return (RowVerdict::Fail, format!("error constant {found}, not {written:.4e}"));
    }
    let before = orders.len().checked_sub(2).and_then(|at| orders[at][1]);
    let settled = before.is_none_or(|before| (l2 - before).abs() <= row.tolerance);
    if l2 > order + row.tolerance || !settled {
        let before = before.map_or(String::new(), |before| format!(" after {before:.2}"));
        return (RowVerdict::NotAsymptotic, format!("order {l2:.2}{before} in l2"));
    }
    (RowVerdict::Pass, seen)
}

/// A solution that the method represents exactly.
fn exact(row: &MatrixRow, levels: &[SolverOutcome]) -> (RowVerdict, String) {
    if levels.is_empty() {
        return (RowVerdict::NotAsymptotic, "there is no level".into());
    }
    for level in levels {
        let largest = match level {
            SolverOutcome::Finished { .. } => {
                row.errors(level).map_or(f64::NAN, |errors| errors[2])
            }
            SolverOutcome::Stopped { failure, .. } => return (RowVerdict::Fail, failure.clone()),
            SolverOutcome::Refused { .. } => continue,
        };
        if largest.is_nan() || largest > ROUNDING {
            return (RowVerdict::Fail, format!("an error of {largest:.1e} in linf"));
        }
    }
    (RowVerdict::Pass, String::new())
}
