//! The comparison of the levels of one norm with the expected order.

use std::fmt;

use crate::limit::{Limit, limit};
use crate::order::{Basis, Estimate, Line, pairs};
use crate::sequence::{Sequence, SequenceLevel};
use crate::share::{Share, lower, rounding};
use crate::term::{ErrorTerm, second_term};
use crate::verdict::Verdict;

/// A theoretical order, and the tolerance of the observed one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedOrder {
    /// p.
    pub order: f64,
    /// The highest order that correct methods may show; p, unless theory states a range.
    pub highest: f64,
    /// Whether the order settles on finer levels. It need not if an error consists of waves as long as a cell.
    pub settles: bool,
    /// The tolerance about p, or about the range.
    pub tolerance: f64,
}

impl ExpectedOrder {
    /// Expects one order.
    pub const fn new(order: f64, tolerance: f64) -> Self {
        Self { order, highest: order, settles: true, tolerance }
    }

    /// The distance of an order from the range: negative below it, 0 within it.
    fn distance(&self, order: f64) -> f64 {
        (order - self.highest).max(0.0) + (order - self.order).min(0.0)
    }

    /// A quarter of the tolerance: the least half width of a printed interval of an order.
    pub fn resolution(&self) -> f64 {
        self.tolerance / 4.0
    }

    /// Compares an order that is known to within `reach` on either side with the expected one.
    fn place(&self, order: f64, reach: f64) -> OrderPosition {
        let [low, high] = [order - reach, order + reach].map(|it| self.distance(it));
        match self.tolerance {
            tolerance if low >= -tolerance && high <= tolerance => OrderPosition::Near,
            tolerance if high < -tolerance => OrderPosition::Below,
            tolerance if low > tolerance => OrderPosition::Above,
            _ => OrderPosition::Open,
        }
    }
}

impl fmt::Display for ExpectedOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.highest > self.order {
            true => write!(f, "{} to {}", self.order, self.highest),
            false => write!(f, "{}", self.order),
        }
    }
}

/// The position of an order relative to the expected one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum OrderPosition {
    /// Within the tolerance.
    Near,
    /// Below the tolerance.
    Below,
    /// Above the tolerance.
    Above,
    /// The interval of the order contains an end of the tolerance.
    Open,
}

/// The reason of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Every error is at round-off.
    Exact,
    /// A run stopped.
    Stopped,
    /// An error is exactly zero or not finite, or no fit exists: there is no order.
    NoOrder,
    /// There is at most one level above round-off.
    TooFewLevels,
    /// There are two levels, so that their order cannot be tested for settling: only the order itself is compared with the
    /// expected one.
    TwoLevels,
    /// The printed digits are too few to decide the order.
    Digits,
    /// The order is below the expected one by more than the tolerance.
    Below,
    /// The order is above the expected one by more than the tolerance.
    Above,
    /// A term of lower order may or may not make up more of the finest error than the tolerance allows.
    Open,
    /// The order is within the tolerance.
    Settled,
}

/// The finding about one norm.
#[derive(Clone, Debug, PartialEq)]
pub struct NormFinding {
    /// The outcome.
    pub verdict: Verdict,
    /// The reason of the verdict.
    pub reason: Reason,
    /// The order, if there is one.
    pub estimate: Option<Estimate>,
    /// The share of a term of lower order, which decides; for three levels or more.
    pub share: Option<Share>,
    /// The second term that explains the drift of the orders best, if it is significant.
    pub term: Option<ErrorTerm>,
    /// The limit of fine levels, for four levels or more.
    pub limit: Option<Limit>,
    /// The lengths of the levels that decided, from coarse to fine.
    pub lengths: Vec<f64>,
}

/// The largest scatter of ln e about a straight line in ln h for which errors count as a pure power law; the order of this law
/// then decides.
const PURE: f64 = 1e-3;

impl NormFinding {
    /// Judges one norm, by the levels that precede the first level that may be at round-off. While the verdict is `not
    /// asymptotic` and the term of order p + 1 dominates on the coarsest of more than three levels, drops that level and judges
    /// again. For a range of orders, tries the highest order first.
    pub fn of(sequence: &Sequence, expected: ExpectedOrder) -> Self {
        if sequence.is_exact() {
            return Self::exact(sequence.levels());
        }
        if expected.highest > expected.order {
            let best = Self::of(sequence, ExpectedOrder::new(expected.highest, expected.tolerance));
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

    /// The finding for levels whose errors are all at round-off.
    fn exact(levels: &[SequenceLevel]) -> Self {
        let (verdict, reason) = (Verdict::Exact, Reason::Exact);
        Self { verdict, reason, ..Self::none(levels.iter().map(|level| level.length).collect()) }
    }

    /// A finding without an order for levels of these lengths.
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

    /// Judges the order of a fit over more than one length, given with half its interval; `None` if no fit exists.
    pub(crate) fn of_fit(
        order: Option<[f64; 2]>,
        lengths: Vec<f64>,
        expected: ExpectedOrder,
    ) -> Self {
        let Some([order, reach]) = order else { return Self::none(lengths) };
        let shown = reach.max(expected.resolution());
        let interval = Some([order - shown, order + shown]);
        let estimate = Some(Estimate { order, interval, basis: Basis::Scatter });
        let place = match expected.place(order, 0.0) {
            OrderPosition::Near if reach > expected.tolerance => OrderPosition::Open,
            OrderPosition::Below | OrderPosition::Above
                if expected.distance(order).abs() <= reach =>
            {
                OrderPosition::Open
            }
            place => place,
        };
        Self { estimate, ..Self::none(lengths) }.decided(place)
    }

    /// The second term, if it changes the order on the finest level by a visible amount, and is not expected.
    pub fn material_term(&self, expected: ExpectedOrder) -> Option<ErrorTerm> {
        let is_seen = |it: &ErrorTerm| it.moves(expected.order) >= expected.resolution();
        self.term.filter(|it| is_seen(it) && expected.distance(it.order) != 0.0)
    }

    /// The limit, if it is significantly different from 0, changes the order visibly, and no second term was found.
    pub fn inconsistency(&self, expected: ExpectedOrder) -> Option<Limit> {
        let is_seen = |it: &Limit| it.share * it.order >= expected.resolution();
        self.limit.filter(|it| self.term.is_none() && !it.is_consistent() && is_seen(it))
    }

    /// Judges only these levels.
    fn on(levels: &[SequenceLevel], expected: ExpectedOrder) -> Self {
        let mut finding = Self::none(levels.iter().map(|level| level.length).collect());
        let Some(orders) = pairs(levels).filter(|orders| !orders.is_empty()) else {
            return finding;
        };
        finding.estimate = Estimate::of(levels, expected.resolution());
        if let [order] = orders[..] {
            let reach = finding.estimate.filter(|it| it.interval.is_some()).map(|it| it.reach());
            let place = expected.place(order, reach.unwrap_or(0.0));
            let is_open = place == OrderPosition::Open;
            let reason = if is_open { Reason::Digits } else { Reason::TwoLevels };
            return Self { reason, ..finding.decided(place) };
        }
        let p = expected.order;
        finding.term = second_term(levels, p).filter(ErrorTerm::is_shown);
        finding.limit = limit(levels);
        finding.share = Share::of(levels, p, lower(p));
        let place = finding.place(levels, orders[orders.len() - 1], expected);
        let is_rounded = finding.share.is_some_and(|share| share.is_rounded);
        let finding = finding.decided(place);
        let is_open = finding.reason == Reason::Open && is_rounded;
        Self { reason: if is_open { Reason::Digits } else { finding.reason }, ..finding }
    }

    /// Places the order of three levels or more; `finest` is the order of the finest pair.
    fn place(
        &self,
        levels: &[SequenceLevel],
        finest: f64,
        expected: ExpectedOrder,
    ) -> OrderPosition {
        let ExpectedOrder { order: p, highest, settles, tolerance } = expected;
        let is_pure = |line: &Line| line.scatter.max(rounding(levels)) <= PURE;
        if let Some(line) = Line::through(levels).filter(is_pure) {
            return expected.place(line.order, 0.0);
        }
        let levels_off = |it: Limit| it.is_plain() && it.share * it.order > 2.0 * tolerance;
        if self.limit.is_some_and(levels_off) {
            return OrderPosition::Below;
        }
        let Some(share) = self.share else { return OrderPosition::Open };
        let [least, most] = share.lowers(p);
        if least > tolerance && expected.place(finest, 0.0) == OrderPosition::Below {
            OrderPosition::Below
        } else if share.total_order - share.reach > highest + tolerance {
            OrderPosition::Above
        } else if most <= tolerance
            || !settles && expected.place(finest, 0.0) == OrderPosition::Near
        {
            OrderPosition::Near
        } else {
            OrderPosition::Open
        }
    }

    /// The finding with the verdict of a place.
    fn decided(self, place: OrderPosition) -> Self {
        let (verdict, reason) = match place {
            OrderPosition::Near => (Verdict::Pass, Reason::Settled),
            OrderPosition::Below => (Verdict::Fail, Reason::Below),
            OrderPosition::Above => (Verdict::NotAsymptotic, Reason::Above),
            OrderPosition::Open => (Verdict::NotAsymptotic, Reason::Open),
        };
        Self { verdict, reason, ..self }
    }
}
