//! The verdict of a study.

use std::fmt;

/// The version of the rule of verdicts: a changed rule has another number.
pub const RULE: u32 = 4;

/// The default tolerance of the observed order.
pub const TOLERANCE: f64 = 0.15;

/// The relative tolerance of an error constant: runs are the same on every machine up to rounding, and the deviation of levels
/// that are not asymptotic is the same as well.
pub const CONSTANT_TOLERANCE: f64 = 0.01;

/// The outcome of a study, from best to worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The compared values contain no information about the solver.
    NoEvidence,
    /// Every error is round-off: there is no order to observe, and no other error.
    Exact,
    /// The levels show the expected order.
    Pass,
    /// The levels do not decide, or show a higher order.
    NotAsymptotic,
    /// The levels show a lower order or another error constant, or a run stopped.
    Fail,
}

impl Verdict {
    /// Whether the verdict supports the solver.
    pub fn is_good(self) -> bool {
        matches!(self, Verdict::Pass | Verdict::Exact)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Verdict::NoEvidence => "no evidence",
            Verdict::Exact => "exact to round-off",
            Verdict::Pass => "pass",
            Verdict::NotAsymptotic => "not asymptotic",
            Verdict::Fail => "fail",
        })
    }
}

/// Whether an error constant is the expected one, to within [`CONSTANT_TOLERANCE`].
pub fn is_near(constant: f64, expected: f64) -> bool {
    (constant / expected - 1.0).abs() <= CONSTANT_TOLERANCE
}
