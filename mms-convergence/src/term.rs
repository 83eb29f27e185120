//! A second term beside the term of the expected order: e = C h^p + D h^q.

use crate::OUTSIDE;
use crate::least::solve;
use crate::order::Line;
use crate::sequence::SequenceLevel;

/// The kind of a second term, which explains a drift of the orders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TermKind {
    /// q = 0: errors level off.
    Plateau,
    /// q = p - 1: an error of lower order, which takes over on finer levels.
    LowerOrder,
    /// q = p + 1, or p + 2 if symmetry excludes odd powers: an error of higher order, which vanishes on finer levels.
    PreAsymptotic,
}

/// A second term in the errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorTerm {
    /// The kind of the term.
    pub kind: TermKind,
    /// q.
    pub order: f64,
    /// D h^q over the error on the finest level; negative if it reduces the error.
    pub share: f64,
    /// The interval of the share.
    pub interval: [f64; 2],
    /// The length at which both terms are equal: a lower order takes over below it, a higher one above.
    pub takes_over: f64,
}

impl ErrorTerm {
    /// Whether the term is significant, not only scatter.
    pub fn is_shown(&self) -> bool {
        self.interval[0] > 0.0 || self.interval[1] < 0.0
    }

    /// The least change of the order of the finest level from p due to the term: the digits of a table cannot decide shares of
    /// some percent.
    pub fn moves(&self, expected: f64) -> f64 {
        let least =
            if self.is_shown() { self.interval[0].abs().min(self.interval[1].abs()) } else { 0.0 };
        (self.order - expected).abs() * least
    }
}

/// Each kind with its q.
fn kinds(expected: f64) -> impl Iterator<Item = (TermKind, f64)> {
    let lower = (expected - 1.0 > 1e-9).then_some((TermKind::LowerOrder, expected - 1.0));
    let higher = [1.0, 2.0].map(|more| (TermKind::PreAsymptotic, expected + more));
    std::iter::once((TermKind::Plateau, 0.0)).chain(lower).chain(higher)
}

/// The sum of squares up to which a power law is exact up to rounding.
const EXACT: f64 = 1e-20;

/// The second term that explains the errors of three levels or more best, if it explains them better than a power law of
/// another order.
///
/// Errors are relative. Intervals are Student's for one of four tested terms (Bonferroni), so that scatter alone shows one in
/// at most 5 % of all cases.
pub(crate) fn second_term(levels: &[SequenceLevel], expected: f64) -> Option<ErrorTerm> {
    let misfit = Line::through(levels).map_or(f64::INFINITY, |line| line.left);
    if misfit < EXACT {
        return None;
    }
    let fits = kinds(expected).filter_map(|kind| fit(levels, expected, kind));
    let best = fits.min_by(|a, b| a.1.total_cmp(&b.1))?;
    (best.1 < misfit).then_some(best.0)
}

/// Fits one kind of term, and returns its misfit, too.
fn fit(levels: &[SequenceLevel], p: f64, (kind, q): (TermKind, f64)) -> Option<(ErrorTerm, f64)> {
    let finest = levels.last()?;
    let row = |level: &SequenceLevel| {
        let (x, e) = (level.length / finest.length, level.error() / finest.error());
        ([x.powf(p) / e, x.powf(q) / e], 1.0)
    };
    let rows: Vec<_> = levels.iter().map(row).collect();
    let found = solve(&rows)?;
    let [c, d] = found.unknowns;
    let distance = |([a, b], _): &([f64; 2], f64)| (c * a + d * b).ln().powi(2);
    let misfit: f64 = rows.iter().map(distance).sum();
    let error = c + d;
    let reach = found.reach(1, OUTSIDE / 4.0) / error;
    let share = d / error;
    let takes_over = finest.length * (d / c).abs().powf(1.0 / (p - q));
    let term =
        ErrorTerm { kind, order: q, share, interval: [share - reach, share + reach], takes_over };
    (misfit.is_finite() && error > 0.0).then_some((term, misfit))
}
