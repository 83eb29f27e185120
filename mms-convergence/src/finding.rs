//! What the levels of one norm say of the expected order.

use std::fmt;

use crate::limit::{Limit, limit};
use crate::order::{Basis, Estimate, Line, pairs};
use crate::sequence::{Level, Sequence};
use crate::share::{Share, lower, rounding};
use crate::term::{Term, second_term};
use crate::verdict::Verdict;

/// An order that theory promises, and how far the observed one may be from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// p.
    pub order: f64,
    /// The highest order that right methods may show; p, unless theory leaves a range.
    pub highest: f64,
    /// Whether the order settles on finer levels. It need not where an error is made of waves as long as a cell.
    pub settles: bool,
    /// How far the order may be from p, or from the range.
    pub tolerance: f64,
}

impl Expected {
    /// Expects one order.
    pub const fn new(order: f64, tolerance: f64) -> Self {
        Self { order, highest: order, settles: true, tolerance }
    }

    /// The distance of an order from the range: negative below it, 0 within it.
    fn distance(&self, order: f64) -> f64 {
        (order - self.highest).max(0.0) + (order - self.order).min(0.0)
    }

    /// A quarter of the tolerance: no interval of an order is printed narrower.
    pub fn resolution(&self) -> f64 {
        self.tolerance / 4.0
    }

    /// Judges an order that is known to within `reach` at either side: in its place, below it, above it, or undecided.
    fn place(&self, order: f64, reach: f64) -> Place {
        let [low, high] = [order - reach, order + reach].map(|it| self.distance(it));
        match self.tolerance {
            tolerance if low >= -tolerance && high <= tolerance => Place::Near,
            tolerance if high < -tolerance => Place::Below,
            tolerance if low > tolerance => Place::Above,
            _ => Place::Open,
        }
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.highest > self.order {
            true => write!(f, "{} to {}", self.order, self.highest),
            false => write!(f, "{}", self.order),
        }
    }
}

/// Where an order is, seen from the expected one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// Within the tolerance.
    Near,
    /// Below it.
    Below,
    /// Above it.
    Above,
    /// The interval of the order holds an end of the tolerance.
    Open,
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
    /// The digits that were printed leave the order open.
    Digits,
    /// The order is below the expected one by more than the tolerance.
    Below,
    /// The order is above the expected one by more than the tolerance.
    Above,
    /// A term of lower order may make up more of the finest error than the tolerance allows, or less.
    Open,
    /// The order is within the tolerance.
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
    /// The share of a term of lower order, of three levels or more: it decides.
    pub share: Option<Share>,
    /// The second term that explains the drift of the orders best, if one is shown.
    pub term: Option<Term>,
    /// The limit of fine levels, of four levels or more.
    pub limit: Option<Limit>,
    /// The lengths of the levels that decided, from coarse to fine.
    pub lengths: Vec<f64>,
}

/// Levels whose logarithms are no farther than this from a straight line follow a power law: its order decides.
const PURE: f64 = 1e-3;

impl Finding {
    /// Judges one norm. Of a range of orders the highest is tried first. The levels that decide are those before the first that may be nothing but round-off. If they do not
    /// tell, coarse ones are left out while more than three are left and the term of order p + 1 leads on the coarsest.
    pub fn of(sequence: &Sequence, expected: Expected) -> Self {
        if sequence.is_exact() {
            return Self::exact(sequence.levels());
        }
        if expected.highest > expected.order {
            let best = Self::of(sequence, Expected::new(expected.highest, expected.tolerance));
            if best.verdict == Verdict::Pass {
                return best;
            }
        }
        let mut levels = sequence.sound();
        let mut finding = Self::on(levels, expected);
        let is_coarse = |it: &Self| {
            it.verdict == Verdict::NotAsymptotic && it.share.is_some_and(|share| share.is_coarse)
        };
        while levels.len() > 3 && is_coarse(&finding) {
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
        let (verdict, reason) = (Verdict::Exact, Reason::Exact);
        Self { verdict, reason, ..Self::none(levels.iter().map(|level| level.length).collect()) }
    }

    /// Says nothing of levels of these lengths.
    fn none(lengths: Vec<f64>) -> Self {
        Self {
            verdict: Verdict::NotAsymptotic,
            reason: if lengths.len() > 1 { Reason::NoOrder } else { Reason::TooFewLevels },
            estimate: None,
            share: None,
            term: None,
            limit: None,
            lengths,
        }
    }

    /// Judges an order that a fit of more than one length has, by half its interval; `None` if nothing fits.
    pub(crate) fn of_fit(order: Option<[f64; 2]>, lengths: Vec<f64>, expected: Expected) -> Self {
        let Some([order, reach]) = order else { return Self::none(lengths) };
        let shown = reach.max(expected.resolution());
        let interval = Some([order - shown, order + shown]);
        let estimate = Some(Estimate { order, interval, basis: Basis::Scatter });
        let place = match expected.place(order, 0.0) {
            Place::Near if reach > expected.tolerance => Place::Open,
            Place::Below | Place::Above if expected.distance(order).abs() <= reach => Place::Open,
            place => place,
        };
        Self { estimate, ..Self::none(lengths) }.decided(place)
    }

    /// The second term, if it moves the order on the finest level by enough to be seen, and is not expected.
    pub fn material_term(&self, expected: Expected) -> Option<Term> {
        let is_seen = |it: &Term| it.moves(expected.order) >= expected.resolution();
        self.term.filter(|it| is_seen(it) && expected.distance(it.order) != 0.0)
    }

    /// The limit that is left, if it is shown not to be 0, moves the order by enough to be seen, and is no other term.
    pub fn inconsistency(&self, expected: Expected) -> Option<Limit> {
        let is_seen = |it: &Limit| it.share * it.order >= expected.resolution();
        self.limit.filter(|it| self.term.is_none() && !it.is_consistent() && is_seen(it))
    }

    /// On just these levels.
    fn on(levels: &[Level], expected: Expected) -> Self {
        let mut finding = Self::none(levels.iter().map(|level| level.length).collect());
        let Some(orders) = pairs(levels).filter(|orders| !orders.is_empty()) else {
            return finding;
        };
        finding.estimate = Estimate::of(levels, expected.resolution());
        if let [order] = orders[..] {
            let reach = finding.estimate.filter(|it| it.interval.is_some()).map(|it| it.reach());
            let place = expected.place(order, reach.unwrap_or(0.0));
            let is_open = place == Place::Open;
            let reason = if is_open { Reason::Digits } else { Reason::TwoLevels };
            return Self { reason, ..finding.decided(place) };
        }
        let p = expected.order;
        finding.term = second_term(levels, p).filter(Term::is_shown);
        finding.limit = limit(levels);
        finding.share = Share::of(levels, p, lower(p));
        let place = finding.place(levels, orders[orders.len() - 1], expected);
        let is_rounded = finding.share.is_some_and(|share| share.is_rounded);
        let finding = finding.decided(place);
        let is_open = finding.reason == Reason::Open && is_rounded;
        Self { reason: if is_open { Reason::Digits } else { finding.reason }, ..finding }
    }

    /// Where the order of three levels or more is; `finest` is that of the finest pair.
    fn place(&self, levels: &[Level], finest: f64, expected: Expected) -> Place {
        let Expected { order: p, highest, settles, tolerance } = expected;
        let is_pure = |line: &Line| line.scatter.max(rounding(levels)) <= PURE;
        if let Some(line) = Line::through(levels).filter(is_pure) {
            return expected.place(line.order, 0.0);
        }
        let levels_off = |it: Limit| it.is_plain() && it.share * it.order > 2.0 * tolerance;
        if self.limit.is_some_and(levels_off) {
            return Place::Below;
        }
        let Some(share) = self.share else { return Place::Open };
        let [least, most] = share.lowers(p);
        if least > tolerance && expected.place(finest, 0.0) == Place::Below {
            Place::Below
        } else if share.total_order - share.reach > highest + tolerance {
            Place::Above
        } else if most <= tolerance || !settles && expected.place(finest, 0.0) == Place::Near {
            Place::Near
        } else {
            Place::Open
        }
    }

    /// With the verdict of a place.
    fn decided(self, place: Place) -> Self {
        let (verdict, reason) = match place {
            Place::Near => (Verdict::Pass, Reason::Settled),
            Place::Below => (Verdict::Fail, Reason::Below),
            Place::Above => (Verdict::NotAsymptotic, Reason::Above),
            Place::Open => (Verdict::NotAsymptotic, Reason::Open),
        };
        Self { verdict, reason, ..self }
    }
}
