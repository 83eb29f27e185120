//! The norms of one quantity together.

use crate::finding::{ExpectedOrder, NormFinding, Reason};
use crate::grid::Fit;
use crate::sequence::Sequence;
use crate::verdict::Verdict;

/// Judged norms, each under its name: mean, root mean square and maximum under `l1`, `l2` and `linf`.
///
/// The worst norm decides. If there is an `l2`, `l1` and `linf` count only if they fail by more than the tolerance: they reveal
/// a lower order at a few points, and otherwise the maximum of errors at particles, which come nearer to a face with every
/// level, is not a pure power of h. On two levels they fail only if the order is too low by more than half an order; if it is too
/// low by less, the levels do not decide. `h1` counts only if it fails: its terms of higher order vanish later.
#[derive(Clone, Debug, PartialEq)]
pub struct Judgement {
    /// The findings, at least one, in the order in which the norms were given.
    pub norms: Vec<NormJudgement>,
    /// The index of the norm that decided; `l2` first, if no other is worse.
    deciding: usize,
}

/// One norm, and its result.
#[derive(Clone, Debug, PartialEq)]
pub struct NormJudgement {
    /// The name of the norm.
    pub norm: String,
    /// The expected order.
    pub expected: ExpectedOrder,
    /// The finding from the levels.
    pub finding: NormFinding,
}

impl NormJudgement {
    /// Whether the order exceeds the least order that correct methods may show.
    pub fn is_superconvergent(&self) -> bool {
        let ExpectedOrder { order, highest, tolerance, .. } = self.expected;
        let is_more = |observed: f64| highest > order && observed > order + tolerance;
        self.finding.verdict == Verdict::Pass
            && self.finding.estimate.is_some_and(|it| is_more(it.order))
    }

    /// Whether a norm beside l2 counts: its order is lower by more than the tolerance, or it has no order because a run stopped.
    /// Two levels have no interval: for them it is twice the tolerance.
    fn is_far(&self) -> bool {
        let ExpectedOrder { order, tolerance, .. } = self.expected;
        let is_far = self.finding.estimate.is_none_or(|it| match it.interval {
            Some([_, high]) => high < order - tolerance,
            None => it.order < order - 2.0 * tolerance,
        });
        (self.finding.verdict == Verdict::Fail || self.is_open()) && is_far
    }

    /// Whether two levels leave it open whether the order of a norm beside l2 is too low.
    fn is_open(&self) -> bool {
        self.finding.reason == Reason::TwoLevels
            && self.finding.verdict == Verdict::NotAsymptotic
            && self.finding.estimate.is_some_and(|it| it.order < self.expected.order)
    }

    /// A norm beside l2. A single pair of levels shows only an order that is too low by more than [`HALF`].
    fn beside_l2(mut self) -> Self {
        let NormFinding { verdict, reason, estimate, .. } = &mut self.finding;
        let is_near = estimate.is_some_and(|it| it.order >= self.expected.order - HALF);
        if *reason == Reason::TwoLevels && *verdict == Verdict::Fail && is_near {
            *verdict = Verdict::NotAsymptotic;
        }
        self
    }
}

/// The part of an order by which the maximum over two levels may miss the expected order by chance.
const HALF: f64 = 0.5;
/// The tolerance of the orders of a layer.
const NEAR: f64 = 0.15;

impl Judgement {
    /// Judges each norm. `None` without a norm.
    pub fn of<'a>(
        norms: impl IntoIterator<Item = (&'a str, &'a Sequence, ExpectedOrder)>,
    ) -> Option<Self> {
        let judged = |(norm, sequence, expected): (&str, &Sequence, ExpectedOrder)| NormJudgement {
            norm: norm.to_owned(),
            expected,
            finding: NormFinding::of(sequence, expected),
        };
        Self::worst(norms.into_iter().map(judged).collect())
    }

    /// Judges the orders in space and in time of norms whose errors were fitted over runs of [h, dt].
    pub fn of_fits<'a>(
        runs: &[[f64; 2]],
        norms: impl IntoIterator<Item = (&'a str, Option<Fit>, [ExpectedOrder; 2])>,
    ) -> Option<Self> {
        let judged = |(norm, fit, expected): (&'a str, Option<Fit>, [ExpectedOrder; 2])| {
            let orders = fit.map(|it| [it.space_order, it.time_order]);
            ["h", "dt"].into_iter().enumerate().map(move |(which, length)| {
                let order = orders.zip(fit).map(|(orders, it)| [orders[which], it.reach[which]]);
                let expected = expected[which];
                let finding = NormFinding::of_fit(order, lengths(runs, which), expected);
                NormJudgement { norm: format!("{norm} in {length}"), expected, finding }
            })
        };
        Self::worst(norms.into_iter().flat_map(judged).collect())
    }

    fn worst(norms: Vec<NormJudgement>) -> Option<Self> {
        let has_l2 = norms.iter().any(|it| it.norm == "l2");
        let is_beside = |it: &NormJudgement| has_l2 && matches!(it.norm.as_str(), "l1" | "linf");
        let norms: Vec<NormJudgement> =
            norms.into_iter().map(|it| if is_beside(&it) { it.beside_l2() } else { it }).collect();
        let decides = |it: &NormJudgement| match it.norm.as_str() {
            "l1" | "linf" if has_l2 => it.is_far(),
            "h1" if has_l2 => it.finding.verdict != Verdict::NotAsymptotic,
            _ => true,
        };
        let worst = norms.iter().filter(|it| decides(it)).map(|it| it.finding.verdict).max()?;
        let is_worst = |it: &NormJudgement| decides(it) && it.finding.verdict == worst;
        let of_l2 = norms.iter().position(|it| it.norm == "l2" && is_worst(it));
        let deciding = of_l2.or_else(|| norms.iter().position(is_worst))?;
        Some(Self { norms, deciding })
    }

    /// The norm that decided.
    pub fn deciding(&self) -> &NormJudgement {
        &self.norms[self.deciding]
    }

    /// The verdict of the norm that decided.
    pub fn verdict(&self) -> Verdict {
        self.deciding().finding.verdict
    }

    /// The order of linf, if linf alone decides a fail: l2, and l1 if it is given, has the expected order.
    pub fn only_largest(&self) -> Option<f64> {
        let deciding = self.deciding();
        let is_good = |name| self.norm(name).is_none_or(|it| it.finding.verdict.is_good());
        let is_alone = deciding.norm == "linf"
            && deciding.finding.verdict == Verdict::Fail
            && self.norm("l2").is_some()
            && is_good("l1")
            && is_good("l2");
        deciding.finding.estimate.filter(|_| is_alone).map(|it| it.order)
    }

    /// The result of a norm.
    pub fn norm(&self, name: &str) -> Option<&NormJudgement> {
        self.norms.iter().find(|it| it.norm == name)
    }

    /// The order of l2, or without l2, of the norm that decided.
    pub fn observed_order(&self) -> Option<f64> {
        let judged = self.norm("l2").unwrap_or(self.deciding());
        judged.finding.estimate.map(|it| it.order)
    }

    /// The order q of a layer of one cell at a face, whose errors are of order q there: it covers a part h of the body, so that
    /// l1, l2 and linf show q + 1, q + 1/2 and q, or the expected order if that is lower. `None` unless l2 shows it too.
    pub fn layer(&self) -> Option<f64> {
        let order = |norm: &str| {
            let judged = self.norm(norm)?;
            Some((judged.finding.estimate?.order, judged.expected.order))
        };
        let (linf, l1, l2) = (order("linf")?.0, order("l1")?, order("l2")?);
        let follows = |(found, expected): (f64, f64), more: f64| {
            (found - expected.min(linf + more)).abs() <= NEAR
        };
        let is_seen = linf + 0.5 + NEAR < l2.1;
        (is_seen && follows(l1, 1.0) && follows(l2, 0.5)).then_some(linf)
    }
}

/// The distinct lengths, from coarse to fine.
fn lengths(runs: &[[f64; 2]], which: usize) -> Vec<f64> {
    let mut lengths: Vec<f64> = runs.iter().map(|run| run[which]).collect();
    lengths.sort_by(|a, b| b.total_cmp(a));
    lengths.dedup();
    lengths
}
