//! What a study ends with.

use std::fmt;

/// The version of the rule by which verdicts are made: another rule has another number.
pub const RULE: u32 = 3;

/// How far the observed order may be from the expected one, by default.
pub const TOLERANCE: f64 = 0.15;

/// How far an error constant may be from the expected one, relative to it: runs are the same on every machine but for
/// rounding, and what levels lose by not being asymptotic is the same as well.
pub const CONSTANT_TOLERANCE: f64 = 0.01;

/// The outcome of a study; the worse, the later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// The values that were compared show nothing of the solver.
    NoEvidence,
    /// Every error is round-off: there is no order to observe, and nothing left of the error.
    Exact,
    /// The levels show the expected order.
    Pass,
    /// The levels do not tell, or show a higher order.
    NotAsymptotic,
    /// The levels show a lower order or another error constant, or a run stopped.
    Fail,
}

impl Verdict {
    /// Whether it speaks for the solver.
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
