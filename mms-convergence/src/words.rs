//! Verdicts in words.

use crate::finding::{ExpectedOrder, NormFinding, Reason};
use crate::grid::Fit;
use crate::judgement::{Judgement, NormJudgement};
use crate::order::Basis;
use crate::term::{ErrorTerm, TermKind};
use crate::verdict::Verdict;

/// A function that names a level: by its length, or as the caller prefers.
pub type Name<'a> = &'a dyn Fn(f64) -> String;

/// A bound of an order, with enough digits to differ from the expected order.
pub fn bound(value: f64, expected: f64) -> String {
    let short = format!("{value:.2}");
    let is_told = |text: &String| text.parse() != Ok(expected);
    if is_told(&short) || (value - expected).abs() < 1e-6 {
        return short;
    }
    let longer = (3..=6).map(|digits| format!("{value:.digits$}")).find(is_told);
    let side = if value < expected { "below" } else { "above" };
    format!("{}, {side} {expected}", longer.unwrap_or(short))
}

/// The reasons why an order may exceed the theoretical one.
const ABOVE: &str = "an order above theory comes from an error that changes its sign between the levels, from errors of \
     space and time that cancel, from places where the method is more accurate than elsewhere (nodes, Gauss points), \
     from coarse levels that are not asymptotic, or from a theory that predicts too low an order";

impl Judgement {
    /// The verdict with the deciding norm, and then its explanation, a sentence a line. `symbol` is the symbol of the lengths
    /// in formulas: h or dt.
    pub fn sentences(&self, symbol: &str, name: Name<'_>) -> Vec<String> {
        let first = format!("{}: {}", self.verdict(), self.headline(name));
        std::iter::once(first).chain(self.explanations(symbol, name)).collect()
    }

    /// The order with its interval, the norm and the levels that decided, and the expected order.
    pub fn headline(&self, name: Name<'_>) -> String {
        let NormJudgement { norm, expected, finding } = self.deciding();
        finding.says(norm, *expected, name)
    }

    /// The reasons of the verdict, a sentence a line: first the basis of the interval.
    pub fn explanations(&self, symbol: &str, name: Name<'_>) -> Vec<String> {
        let NormJudgement { expected, finding, .. } = self.deciding();
        let basis = finding.basis(*expected).into_iter();
        basis.chain(self.reasons(symbol, name)).collect()
    }

    /// The reasons of the verdict, without the basis of the interval.
    pub fn reasons(&self, symbol: &str, name: Name<'_>) -> Vec<String> {
        let NormJudgement { expected, finding, .. } = self.deciding();
        let mut lines = finding.reasons(*expected, symbol, name);
        lines.extend(self.layer().map(|q| {
            format!(
                "the orders of l1, l2 and linf indicate a layer at a face where the order is {q:.1}: q + 1, q + 1/2 \
                 and q; look at the boundary conditions"
            )
        }));
        lines
    }
}

impl NormFinding {
    /// The order, its interval, norm and levels, and the expected order.
    fn says(&self, norm: &str, expected: ExpectedOrder, name: Name<'_>) -> String {
        let levels = match self.lengths.as_slice() {
            [] => "no level".into(),
            [alone] => name(*alone),
            [first, .., last] => {
                format!("{} levels, {} to {}", self.lengths.len(), name(*first), name(*last))
            }
        };
        let observed = match self.estimate {
            None => format!("no observed order ({norm}; {levels})"),
            Some(it) => match it.interval {
                None => format!("observed order {:.2} ({norm}; {levels})", it.order),
                Some(interval) => {
                    let [low, high] = interval.map(|it| bound(it, expected.order));
                    format!(
                        "observed order {:.2}, between {low} and {high} ({norm}; {levels})",
                        it.order
                    )
                }
            },
        };
        format!("{observed}, expected {expected}{}", self.because(expected))
    }

    fn because(&self, expected: ExpectedOrder) -> String {
        match self.reason {
            Reason::Exact => "; all errors are at round-off".into(),
            Reason::Settled | Reason::Below | Reason::Above => String::new(),
            Reason::Stopped => "; a run stopped".into(),
            Reason::NoOrder => "; an error is exactly zero, or nothing fits".into(),
            Reason::TooFewLevels => {
                "; two levels above round-off are needed, and three are better".into()
            }
            Reason::TwoLevels => {
                "; two levels cannot show whether the order has settled: add a third".into()
            }
            Reason::Digits => {
                "; the errors have too few digits to determine the order: give more digits".into()
            }
            Reason::Open => format!(
                "; the levels do not show whether it is within +-{}: give finer ones, or more",
                expected.tolerance
            ),
        }
    }

    /// The share of the term of lower order.
    fn share_says(&self, p: f64) -> Option<String> {
        let (share, [low, high]) = (self.share?, self.share?.lowers(p));
        Some(format!(
            "an error of order {} lowers the order on the finest mesh by {low:.2} to {high:.2}",
            share.order
        ))
    }

    /// The basis of the interval.
    fn basis(&self, expected: ExpectedOrder) -> Option<String> {
        match self.estimate?.basis {
            Basis::Scatter => Some(format!(
                "the 95 % interval follows from the scatter about a power law, and is no less than +-{:.2}",
                expected.resolution()
            )),
            Basis::Drift => Some(
                "the interval follows from the drift of two orders, since three levels have no scatter".into(),
            ),
            Basis::Digits => Some("the interval follows from the digits of the two errors".into()),
            Basis::Nothing => None,
        }
    }

    /// The findings of the fits, in words.
    fn reasons(&self, expected: ExpectedOrder, symbol: &str, name: Name<'_>) -> Vec<String> {
        let mut lines = Vec::new();
        let is_asked = matches!(self.reason, Reason::Below | Reason::Open);
        lines.extend(self.share_says(expected.order).filter(|_| is_asked));
        lines.extend(
            self.material_term(expected).map(|term| term.sentence(expected.order, symbol, name)),
        );
        lines.extend(self.inconsistency(expected).map(|it| {
            format!(
                "not consistent: e0 + C {symbol}^{:.2} fits with e0 = {:.2e}, between {:.2e} and {:.2e}",
                it.order, it.error, it.interval[0], it.interval[1]
            )
        }));
        if self.reason == Reason::Above {
            lines.push(ABOVE.into());
        }
        if self.verdict == Verdict::Pass {
            lines.extend(self.left_open(name));
        }
        lines
    }

    /// The errors that a pass does not exclude.
    fn left_open(&self, name: Name<'_>) -> Option<String> {
        let (share, finest) = (self.share?, self.lengths.last()?);
        let most = 100.0 * share.interval()[1].clamp(0.0, 1.0);
        // With enough digits to differ from 0.
        let digits = (0..=3).find(|&it| most >= 0.95 * 0.1_f64.powi(it))?;
        Some(format!(
            "an error of order {} that makes up less than {most:.*} % at {} is not excluded",
            share.order,
            digits as usize,
            name(*finest)
        ))
    }
}

impl Fit {
    /// The formula, and the distance of errors from it.
    pub fn sentence(&self, norm: &str) -> String {
        format!(
            "{norm} = {:.3e} h^{:.2} {:+.3e} dt^{:.2} in all runs, within {:.1} %",
            self.space_constant,
            self.space_order,
            self.time_constant,
            self.time_order,
            100.0 * self.residual
        )
    }
}

impl ErrorTerm {
    fn sentence(&self, p: f64, symbol: &str, name: Name<'_>) -> String {
        let (q, at) = (self.order, name(self.takes_over));
        let what = match self.kind {
            TermKind::Plateau => "a plateau".into(),
            TermKind::LowerOrder => format!("a hidden error of order {q}"),
            TermKind::PreAsymptotic => {
                format!("an error of order {q} in addition, which vanishes on finer meshes")
            }
        };
        let percent = format!(
            "{:.1} % of the finest error ({:.1} to {:.1} %)",
            100.0 * self.share,
            100.0 * self.interval[0],
            100.0 * self.interval[1]
        );
        let fits = format!(
            "C {symbol}^{p} + D {symbol}^{q} fits the drift of the orders: {what}, {percent}"
        );
        match self.kind {
            _ if self.share < 0.0 && self.kind != TermKind::PreAsymptotic => {
                format!("{fits}, of the other sign: both cancel near {at}")
            }
            TermKind::PreAsymptotic => format!("{fits}; the expected order dominates below {at}"),
            _ => format!("{fits}; it takes over below {at}"),
        }
    }
}
