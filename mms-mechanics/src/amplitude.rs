//! Finds the parameter with which a motion vanishes (its amplitude, at the defaults of the others), and the expressions that
//! lose digits at a small amplitude.
//!
//! An expression that vanishes with the amplitude keeps its digits if no sum in it vanishes while its terms do not: see
//! [`Amplitude::keeps`]. Any other is replaced by its remainder ([`difference`]), order by order. The expressions are u, H,
//! C - I, B - I and J - 1; for Div P and the quantities made of it also v, a and the second gradient, which are small, too, for
//! a map such as r(R, a) - R. The test is numerical, at a few places, and only chooses a candidate: each form is exact for all
//! values.
//!
//! The part without an amplitude is omitted if it is 0 for any signs of X and of the parameters, in 31 digits at 24 places;
//! else it stays. The replacement is rejected if it has no value at a corner or in the middle of the body where the original
//! expression has one.

use mms_math::{Double, Scalar as _};

use crate::model::Model;
use crate::samples::{
    SamplePoint, anywhere, bounds, defaults, edges, evaluate, is_identity, places, size, vanishes,
};
use mms_symbolic::expr::{ByExpr, Expr, Graph, Node, Rational, Symbol};
use mms_symbolic::pass::curvature::{self, curvature};
use mms_symbolic::pass::difference::{Parts, difference};
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::substitute::replace;
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// The number of orders in the amplitude that may cancel.
const ORDERS: usize = 3;

/// The number of places of the body where an expression is evaluated.
const PLACES: usize = 2;

/// A small amplitude, relative to its default.
const SMALL: f64 = 1e-6;

/// A parameter with which u vanishes at every X and t.
#[derive(Clone, Debug)]
pub struct Amplitude {
    symbol: Symbol,
    /// The index of the parameter, and its default, or 1 if that is 0.
    index: usize,
    usual: Double,
    /// Places of the body, and places anywhere, with the parameter set to 0.
    body: Vec<SamplePoint>,
    anywhere: Vec<SamplePoint>,
    /// Corners, middle and middles of faces of the body, with the parameter at its default.
    edges: Vec<SamplePoint>,
}

impl Amplitude {
    /// The index of the parameter.
    pub fn index(&self) -> usize {
        self.index
    }

    /// The first parameter with which u vanishes at the defaults of the others. The body does not
    /// depend on it.
    pub fn find(graph: &Graph, model: &Model) -> Option<Amplitude> {
        let defaults = defaults(graph, model);
        let bounds = bounds(model);
        let of_body: SortedSet<Symbol> =
            bounds.iter().flat_map(|bound| graph.symbols(*bound)).collect();
        let of_motion: SortedSet<Symbol> =
            model.displacement.iter().flat_map(|u| graph.symbols(*u)).collect();
        let candidates = (0..defaults.len()).filter(|index| {
            let symbol = Symbol::Parameter(*index);
            of_motion.contains(&symbol) && !of_body.contains(&symbol)
        });
        let edges = edges(graph, model, &defaults);
        let moves = |places: &[SamplePoint]| {
            let values = evaluate(graph, &model.displacement, places);
            model.displacement.iter().any(|u| !vanishes(&values[*u]))
        };
        let of_defaults = places(graph, model, &defaults, PLACES);
        if !moves(&of_defaults) {
            return None;
        }
        candidates.into_iter().find_map(|index| {
            let mut parameters = defaults.clone();
            parameters[index] = Double::from_f64(0.0);
            let body = places(graph, model, &parameters, PLACES);
            if graph.work().is_over() || moves(&body) {
                return None;
            }
            let anywhere = anywhere(graph, model, &parameters, Some(index));
            let symbol = Symbol::Parameter(index);
            let edges = edges.clone();
            let usual = size(&defaults[index]);
            Some(Amplitude { symbol, index, usual, body, anywhere, edges })
        })
    }

    /// The expressions `stable`, of which those that lose digits are replaced by the remainders of `plain`, which has the same
    /// values. The limit at amplitude 0 is added to a remainder unless it is 0.
    pub fn rewrite(&self, graph: &mut Graph, plain: &[Expr], stable: &[Expr]) -> Vec<Expr> {
        let keeps = self.kept(graph, stable).keeps;
        let lost = |index: &usize| keeps[stable[*index]] != KeptDigits::All;
        let lost: Vec<usize> = (0..stable.len()).filter(lost).collect();
        let mut rewritten = stable.to_vec();
        if lost.is_empty() {
            return rewritten;
        }
        let lossy: Vec<Expr> = lost.iter().map(|index| plain[*index]).collect();
        for (index, apart) in lost.into_iter().zip(self.apart(graph, &lossy)) {
            rewritten[index] = apart.unwrap_or(rewritten[index]);
        }
        // If terms of first order cancel, terms of the next order remain.
        for _ in 0..ORDERS {
            rewritten = factor(graph, &rewritten);
            let Digits { lossy, .. } = self.kept(graph, &rewritten);
            let inner: Vec<Expr> = lossy.into_iter().filter(|it| !rewritten.contains(it)).collect();
            let apart = self.apart(graph, &inner);
            let changes = inner.into_iter().zip(apart).filter_map(|(it, made)| Some((it, made?)));
            let changes: SortedMap<Expr, Expr> = changes.filter(|(it, made)| it != made).collect();
            if changes.is_empty() {
                break;
            }
            rewritten = replace(graph, &rewritten, &changes);
        }
        // A quotient may have no value at an edge where the whole has one.
        if self.has_values(graph, stable, &rewritten) { rewritten } else { stable.to_vec() }
    }

    /// Whether `after` have values where `before` have.
    fn has_values(&self, graph: &Graph, before: &[Expr], after: &[Expr]) -> bool {
        let values = evaluate(graph, &[before, after].concat(), &self.edges);
        let finite = |expr: &Expr| values[*expr].iter().map(|value| value.to_f64().is_finite());
        let pairs = || before.iter().zip(after);
        pairs().all(|(old, new)| finite(old).zip(finite(new)).all(|(old, new)| new || !old))
    }

    /// The remainder of each expression beyond its limit at amplitude 0, plus the limit unless that is 0; `None` if an
    /// expression has a part without a rule.
    fn apart(&self, graph: &mut Graph, exprs: &[Expr]) -> Vec<Option<Expr>> {
        let parts = difference(graph, exprs, self.symbol);
        let limits: Vec<Expr> = parts.iter().flatten().map(|parts| parts.limit).collect();
        let nothing = evaluate(graph, &limits, &self.anywhere);
        let mut apart = |Parts { limit, rest }: Parts| match is_identity(&nothing[limit]) {
            true => rest,
            false => graph.add(limit, rest),
        };
        parts.into_iter().map(|parts| parts.map(&mut apart)).collect()
    }

    /// Forms of expressions that are of second order in the amplitude, at the defaults of the other parameters. Parts of lower
    /// order are omitted if they are 0 for all parameters, else added. `None` if the expressions are of first order, or have a
    /// part without a rule.
    pub fn of_second_order(&self, graph: &mut Graph, roots: &[Expr]) -> Option<Vec<Expr>> {
        if !self.shrinks_twice(graph, roots) {
            return None;
        }
        let parts = curvature(graph, roots, self.symbol);
        let parts = parts.into_iter().collect::<Option<Vec<_>>>()?;
        let early: Vec<Expr> = parts.iter().flat_map(|parts| [parts.limit, parts.slope]).collect();
        let early = factor(graph, &early);
        let [here, anywhere] =
            [&self.body, &self.anywhere].map(|places| evaluate(graph, &early, places));
        if !early.iter().all(|part| vanishes(&here[*part])) {
            return None;
        }
        let symbol = graph.symbol(self.symbol);
        let mut with_early = |(early, parts): (&[Expr], &curvature::Parts)| {
            let linear = graph.mul(symbol, early[1]);
            let kept = [(early[0], early[0]), (early[1], linear)].into_iter();
            let kept = kept.filter(|(part, _)| !is_identity(&anywhere[*part]));
            let terms = kept.map(|(_, term)| term).chain([parts.rest]);
            graph.sum(terms.map(|term| (term, Rational::ONE)).collect::<Vec<_>>())
        };
        Some(early.chunks(2).zip(&parts).map(&mut with_early).collect())
    }

    /// Whether half of a small amplitude reduces these to about a quarter.
    fn shrinks_twice(&self, graph: &Graph, roots: &[Expr]) -> bool {
        let largest = |amplitude: f64| {
            let mut places = self.body.clone();
            for place in &mut places {
                place.parameters[self.index] = Double::from_f64(amplitude) * self.usual;
            }
            let values = evaluate(graph, roots, &places);
            let sizes = roots.iter().flat_map(|root| &values[*root]).map(|it| it.to_f64().abs());
            sizes.filter(|size| size.is_finite()).fold(0.0, f64::max)
        };
        let (whole, half) = (largest(SMALL), largest(SMALL / 2.0));
        half > 0.0 && half < 0.3 * whole
    }

    /// Whether all of these expressions keep digits at a small amplitude. An expression keeps its digits if it does not vanish
    /// with the amplitude; a sum, if all its terms vanish and keep their digits; a product, if a small factor keeps its digits;
    /// a function, if its operand keeps its digits.
    pub fn keeps(&self, graph: &Graph, roots: &[Expr]) -> bool {
        let keeps = self.kept(graph, roots).keeps;
        roots.iter().all(|root| keeps[*root] != KeptDigits::None)
    }

    fn kept(&self, graph: &Graph, roots: &[Expr]) -> Digits {
        let values = evaluate(graph, roots, &self.body);
        let mut kept = Digits { keeps: ByExpr::of(roots), lossy: Vec::new() };
        for expr in values.reached.iter().copied() {
            let at = &values[expr];
            let of = |child: &Expr| vanishes(&values[*child]).then(|| kept.keeps[*child]);
            let node = graph.node(expr);
            let keeps = match node {
                _ if !vanishes(at) => KeptDigits::All,
                Node::Number(_) | Node::Pi | Node::Symbol(_) => KeptDigits::All,
                Node::Sum(constant, terms) => {
                    let terms = terms.iter().map(|(term, _)| of(term).unwrap_or(KeptDigits::None));
                    let least = terms.min().unwrap_or(KeptDigits::All);
                    if constant.is_zero() { least } else { KeptDigits::None }
                }
                // The error of a factor is multiplied by the other factors.
                Node::Product(factors) => {
                    let small = || factors.iter().filter_map(|(base, _)| of(base));
                    match small().min() {
                        Some(KeptDigits::None) if small().max() > Some(KeptDigits::None) => {
                            KeptDigits::First
                        }
                        least => least.unwrap_or(KeptDigits::All),
                    }
                }
                Node::Call(..) | Node::Offset(_) | Node::Small(..) => {
                    let operands = node.children().filter_map(|operand| of(&operand));
                    operands.max().unwrap_or(KeptDigits::None)
                }
            };
            if keeps == KeptDigits::None && matches!(node, Node::Sum(..)) {
                kept.lossy.push(expr);
            }
            kept.keeps.set(expr, keeps);
        }
        kept
    }
}

/// Returns `stable`, or a more exact form if a motion has an amplitude: see [`Amplitude::rewrite`].
pub(super) fn rewritten(
    graph: &mut Graph,
    amplitude: Option<&Amplitude>,
    plain: &[Expr],
    stable: &[Expr],
) -> Vec<Expr> {
    amplitude.map_or_else(|| stable.to_vec(), |amplitude| amplitude.rewrite(graph, plain, stable))
}

/// The digits that an expression keeps which is small with the amplitude.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum KeptDigits {
    /// No digit is kept: the error is as large as the terms that cancel.
    None,
    /// The first order is kept: one factor of a product keeps no digit, but another factor is small, too.
    First,
    /// All digits are kept: no terms cancel.
    All,
}

/// The digits that each sub-expression keeps, and the sums that lose them.
struct Digits {
    keeps: ByExpr<KeptDigits>,
    lossy: Vec<Expr>,
}
