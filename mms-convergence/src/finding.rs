//! What the levels of one norm say of the expected order.

use crate::limit::{Limit, limit};
use crate::order::{Basis, Estimate, misfit, pairs};
use crate::sequence::{Level, Sequence};
use crate::term::{Kind, Term, second_term};
use crate::verdict::Verdict;

/// What theory says, and how narrow an interval must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// p.
    pub order: f64,
    /// Half the width that an interval of the order may have.
    pub tolerance: f64,
}

impl Expected {
    /// An order is not told from another that is nearer than this, a quarter of the tolerance: so much the digits of
    /// tables and terms of higher order make. A term that moves the order by less decides nothing.
    pub fn resolution(&self) -> f64 {
        self.tolerance / 4.0
    }

    /// Whether an order is off by the tolerance at most.
    fn is_near(&self, order: f64) -> bool {
        (order - self.order).abs() <= self.tolerance
    }
}

/// Why a verdict is what it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Every error is nothing but round-off.
    Exact,
    /// A run stopped.
    Stopped,
    /// An error is exactly zero or not finite, or nothing fits: there is no order.
    NoOrder,
    /// There is one level above round-off, or none.
    TooFewLevels,
    /// There are two, so that nothing says whether their order is settled: it alone is held to the expected one.
    TwoLevels,
    /// The whole interval lies below the expected order.
    Below,
    /// It does, but orders approach the expected one.
    Approaching,
    /// It does, by less than the tolerance, and three levels cannot tell noise from a lower order.
    Near,
    /// The whole interval lies above the expected order.
    Above,
    /// The interval holds the expected order, and much else.
    Wide,
    /// A plateau or a lower order is there, and takes over on finer levels.
    HiddenTerm,
    /// The interval holds the expected order and is narrow.
    Settled,
}

/// What is found of one norm.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The outcome.
    pub verdict: Verdict,
    /// Why.
    pub reason: Reason,
    /// The order, if there is one.
    pub estimate: Option<Estimate>,
    /// The second term that explains the drift of the orders best, if one is shown.
    pub term: Option<Term>,
    /// What is left in the limit, of four levels or more.
    pub limit: Option<Limit>,
    /// The lengths of the levels that decided, from coarse to fine.
    pub lengths: Vec<f64>,
}

impl Finding {
    /// Judges one norm. The levels that decide are those before the first that may be nothing but round-off, less
    /// coarse ones while more than three are left, orders are shown to approach the expected one, and the rest says
    /// more: these are not asymptotic yet.
    pub fn of(sequence: &Sequence, expected: Expected) -> Self {
        if sequence.is_exact() {
            return Self::exact(sequence.levels());
        }
        let mut levels = sequence.sound();
        let mut finding = Self::on(levels, expected);
        while levels.len() > 3 && finding.is_pre_asymptotic() && finding.verdict != Verdict::Pass {
            levels = &levels[1..];
            finding = Self::on(levels, expected);
        }
        if sequence.has_stopped() {
            (finding.verdict, finding.reason) = (Verdict::Fail, Reason::Stopped);
        }
        finding
    }

    /// Of levels whose errors are nothing but round-off.
    fn exact(levels: &[Level]) -> Self {
        Self {
            verdict: Verdict::Exact,
            reason: Reason::Exact,
            estimate: None,
            term: None,
            limit: None,
            lengths: levels.iter().map(|level| level.length).collect(),
        }
    }

    /// Judges an order that a fit of more than one length has, by half its interval; `None` where nothing fits.
    pub(crate) fn of_fit(order: Option<[f64; 2]>, lengths: Vec<f64>, expected: Expected) -> Self {
        let estimate = order.map(|[order, reach]| {
            let reach = reach.max(expected.resolution());
            let interval = Some([order - reach, order + reach]);
            Estimate { order, interval, basis: Basis::Scatter }
        });
        let (verdict, reason) = (Verdict::NotAsymptotic, Reason::NoOrder);
        let mut finding = Self { verdict, reason, estimate, term: None, limit: None, lengths };
        (finding.verdict, finding.reason) = finding.decide(&[], expected);
        finding
    }

    /// The second term, where it moves the order on the finest level by enough to be seen.
    pub fn material_term(&self, expected: Expected) -> Option<Term> {
        self.term.filter(|term| term.moves(expected.order) >= expected.resolution())
    }

    /// The limit that is left, where it is shown not to be 0, moves the order by enough to be seen, and is no other term.
    pub fn inconsistency(&self, expected: Expected) -> Option<Limit> {
        let is_seen = |it: &Limit| it.share * it.order >= expected.resolution();
        self.limit.filter(|it| self.term.is_none() && !it.is_consistent() && is_seen(it))
    }

    fn is_pre_asymptotic(&self) -> bool {
        self.term.is_some_and(|term| term.kind == Kind::PreAsymptotic)
    }

    /// On just these levels.
    fn on(levels: &[Level], expected: Expected) -> Self {
        let orders = pairs(levels).filter(|orders| !orders.is_empty());
        let mut finding = Self {
            verdict: Verdict::NotAsymptotic,
            reason: if levels.len() > 1 { Reason::NoOrder } else { Reason::TooFewLevels },
            estimate: Estimate::of(levels, expected.resolution()),
            term: None,
            limit: None,
            lengths: levels.iter().map(|level| level.length).collect(),
        };
        if let Some(orders) = orders.as_ref().filter(|orders| orders.len() > 1) {
            let term = second_term(levels, expected.order, misfit(levels));
            finding.term = term.filter(Term::is_shown);
            finding.limit = limit(levels);
            (finding.verdict, finding.reason) = finding.decide(orders, expected);
        } else if let Some([order]) = orders.as_deref() {
            finding.verdict = match order - expected.order {
                off if off < -expected.tolerance => Verdict::Fail,
                off if off > expected.tolerance => Verdict::NotAsymptotic,
                _ => Verdict::Pass,
            };
            finding.reason = Reason::TwoLevels;
        }
        finding
    }

    /// By the orders between neighbours, from coarse to fine.
    fn decide(&self, orders: &[f64], expected: Expected) -> (Verdict, Reason) {
        let Some(estimate) = self.estimate else {
            return (Verdict::NotAsymptotic, Reason::NoOrder);
        };
        let hidden = self.material_term(expected).filter(|_| !self.is_pre_asymptotic());
        let is_hidden = hidden.is_some() || self.inconsistency(expected).is_some();
        let is_outside = !estimate.holds(expected.order);
        let approaches = self.is_pre_asymptotic() || approach(orders, expected);
        match estimate {
            _ if is_outside && approaches => (Verdict::NotAsymptotic, Reason::Approaching),
            it if is_outside && it.order > expected.order => {
                (Verdict::NotAsymptotic, Reason::Above)
            }
            it if is_outside && it.basis == Basis::Drift && expected.is_near(it.order) => {
                (Verdict::NotAsymptotic, Reason::Near)
            }
            _ if is_outside => (Verdict::Fail, Reason::Below),
            _ if is_hidden => (Verdict::NotAsymptotic, Reason::HiddenTerm),
            it if it.reach() > expected.tolerance => (Verdict::NotAsymptotic, Reason::Wide),
            _ => (Verdict::Pass, Reason::Settled),
        }
    }
}

/// Whether the order of the finest pair is near the expected one, and nearer than that of the pair before.
fn approach(orders: &[f64], expected: Expected) -> bool {
    let [.., before, last] =
        orders.iter().map(|it| (it - expected.order).abs()).collect::<Vec<_>>()[..]
    else {
        return false;
    };
    last <= expected.tolerance && last + expected.resolution() < before
}
