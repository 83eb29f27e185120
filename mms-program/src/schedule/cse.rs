//! Common subexpressions: common pairs of operands of several sums or products become operations of their own, the most
//! frequent pair first (Hosangadi, Fallah & Kastner, Optimizing Polynomial Expressions by Algebraic Factorization and Common
//! Subexpression Elimination, 2006, uses the same greedy rule).
//!
//! In a sum a pair is two terms and the ratio of their coefficients, in a product two factors that both multiply, or one of
//! which divides; a power is a pair of equal factors. Every occurrence but the first saves an operation.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use super::flat::{Flat, Item, Operation, collected};
use mms_symbolic::expr::{Rational, is_unit, reachable};
use mms_symbolic::work::Work;

/// A pair of operands that can be shared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Pair {
    /// a + ratio b, a before b.
    Sum(Item, Item, Ratio),
    /// a b, a before b or the same.
    Product(Item, Item),
    /// a / b.
    Quotient(Item, Item),
}

/// The position of a ratio among [`Ratios`], in the order of their first occurrence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Ratio(u32);

impl Pair {
    fn form(self, ratios: &Ratios) -> Operation {
        match self {
            Pair::Sum(a, b, ratio) => {
                Operation::Sum(vec![(a, Rational::ONE), (b, ratios.all[ratio.0 as usize].clone())])
            }
            Pair::Product(a, b) if a == b => Operation::Product(vec![(a, 2)]),
            Pair::Product(a, b) => Operation::Product(vec![(a, 1), (b, 1)]),
            Pair::Quotient(a, b) if a < b => Operation::Product(vec![(a, 1), (b, -1)]),
            Pair::Quotient(a, b) => Operation::Product(vec![(b, -1), (a, 1)]),
        }
    }

    fn operands(self) -> (Item, Item) {
        let (Pair::Sum(a, b, _) | Pair::Product(a, b) | Pair::Quotient(a, b)) = self;
        (a, b)
    }

    /// A form that contains the pair, with `whole` instead of it.
    fn replace(self, form: &Operation, whole: Item) -> Operation {
        match (self, form) {
            (Pair::Sum(a, b, _), Operation::Sum(terms)) => {
                let mut rest = terms.clone();
                let first = rest.iter_mut().find(|(item, _)| *item == a);
                let coefficient = first.map(|(_, own)| std::mem::take(own)).unwrap_or_default();
                rest.retain(|(item, _)| *item != a && *item != b);
                rest.push((whole, coefficient));
                Operation::Sum(collected(rest, Rational::is_zero))
            }
            (Pair::Product(a, b) | Pair::Quotient(a, b), Operation::Product(factors)) => {
                let power = |item: Item| {
                    let found = factors.iter().find(|(base, _)| *base == item);
                    found.map_or(0, |(_, exponent)| *exponent)
                };
                let (first, second) = (power(a), power(b));
                // A quotient whose numerator is a divisor is the pair in the other order.
                let sign = first.signum();
                let opposite = if matches!(self, Pair::Quotient(..)) { -1 } else { 1 };
                let count = if a == b { first.abs() / 2 } else { first.abs().min(second.abs()) };
                let mut rest = factors.clone();
                rest.push((a, -sign * count));
                rest.push((b, -sign * opposite * count));
                rest.push((whole, sign * count));
                Operation::Product(collected(rest, |exponent| *exponent == 0))
            }
            _ => form.clone(),
        }
    }
}

/// The ratios of coefficients so far, each once.
struct Ratios {
    all: Vec<Rational>,
    places: FxHashMap<Rational, Ratio>,
}

impl Default for Ratios {
    /// Starts with 1 and -1, which most ratios are.
    fn default() -> Self {
        Ratios { all: vec![Rational::ONE, Rational::NEG_ONE], places: FxHashMap::default() }
    }
}

impl Ratios {
    const ONE: Ratio = Ratio(0);
    const NEG_ONE: Ratio = Ratio(1);

    /// a/b.
    fn of(&mut self, a: &Rational, b: &Rational) -> Ratio {
        if a == b {
            return Self::ONE;
        }
        let ratio = match is_unit(b) {
            true if b.is_one() => a.clone(),
            true => -a.clone(),
            false => a / b,
        };
        if ratio == self.all[1] {
            return Self::NEG_ONE;
        }
        match self.places.entry(ratio) {
            Entry::Occupied(entry) => *entry.get(),
            Entry::Vacant(entry) => {
                let new = Ratio(self.all.len() as u32);
                self.all.push(entry.key().clone());
                *entry.insert(new)
            }
        }
    }
}

/// The operations in which pairs are counted. Neither choice always gives the cheaper program: emitted programs try both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scope {
    /// All operations, including those that were replaced when numbers were multiplied into sums.
    All,
    /// The operations that the roots need.
    Reachable,
}

/// The steps of counting a pair.
const STEPS_OF_PAIR: u64 = 50;

/// Extracts shared pairs until no pair occurs twice, or the budget is spent.
pub(super) fn share(flat: &mut Flat, roots: &[Item], scope: Scope, work: &Work) {
    let counted: Vec<Item> = match scope {
        Scope::All => (0..flat.forms.len()).map(|index| Item(index as u32)).collect(),
        Scope::Reachable => reachable(roots, Item::index, |item| flat.form(item).operands()),
    };
    let mut table = PairCounts { common: common(flat, &counted), ..PairCounts::default() };
    for item in counted {
        if work.is_over() {
            return;
        }
        work.spend(table.steps(flat.form(item)));
        table.count(flat, item);
    }
    table.rank();
    while let Some(pair) = table.best().filter(|_| !work.is_over()) {
        work.spend(table.extract(flat, pair));
    }
}

/// Marks the operands of several counted sums and products, or of one more than once: only they can be shared.
fn common(flat: &Flat, counted: &[Item]) -> Vec<bool> {
    let mut uses = vec![0_u64; flat.forms.len()];
    for item in counted {
        match flat.form(*item) {
            Operation::Sum(terms) => terms.iter().for_each(|(item, _)| uses[item.index()] += 1),
            Operation::Product(factors) => factors.iter().for_each(|(item, exponent)| {
                uses[item.index()] += u64::from(exponent.unsigned_abs());
            }),
            Operation::Constant(_) | Operation::Pi | Operation::Input(_) | Operation::Call(..) => {}
        }
    }
    uses.into_iter().map(|count| count > 1).collect()
}

/// The places and frequencies of pairs.
#[derive(Default)]
struct PairCounts {
    /// The sharable operands among the operations before sharing.
    common: Vec<bool>,
    ratios: Ratios,
    /// The occurrences of each pair. The order of this map has no effect.
    places: FxHashMap<Pair, Occurrences>,
    /// Pairs that occur more than once, ranked by an upper bound of their frequency; of equals, the first in order. The order
    /// ignores the values of ratios, which `best` compares.
    ranked: BinaryHeap<(u64, Reverse<Pair>)>,
    /// The pairs of one operation, while they are counted.
    pairs: Vec<(Pair, u64)>,
}

/// The number of occurrences of a pair, in total and in each operation.
#[derive(Default)]
struct Occurrences {
    total: u64,
    /// The frequency in the ranking, which is not below the true one; 0 if the pair is not ranked.
    ranked: u64,
    /// The one operation that contains the pair, as long as there is only one, as for most pairs.
    only: Option<(Item, u64)>,
    /// All operations that contain the pair, in order, if there are several.
    each: Vec<(Item, u64)>,
}

impl Occurrences {
    /// Sets how often the pair occurs in an operation.
    fn set(&mut self, item: Item, count: u64) {
        if self.each.is_empty() {
            match self.only {
                Some((only, _)) if only != item => self.each.extend(self.only.take()),
                _ => {
                    self.only = Some((item, count));
                    self.total = count;
                    return;
                }
            }
        }
        match self.each.binary_search_by_key(&item, |(item, _)| *item) {
            Ok(at) => self.total -= std::mem::replace(&mut self.each[at].1, count),
            Err(at) => self.each.insert(at, (item, count)),
        }
        self.total += count;
    }

    fn remove(&mut self, item: Item) {
        if let Some((_, count)) = self.only.take_if(|(only, _)| *only == item) {
            self.total -= count;
        } else if let Ok(at) = self.each.binary_search_by_key(&item, |(item, _)| *item) {
            self.total -= self.each.remove(at).1;
        }
    }

    /// The operations, in order.
    fn items(&self) -> Vec<Item> {
        self.only.iter().chain(&self.each).map(|(item, _)| *item).collect()
    }
}

impl PairCounts {
    /// Counts the pairs of an operation before any is ranked.
    fn count(&mut self, flat: &Flat, item: Item) {
        let pairs = self.take_pairs(flat.form(item), None);
        for (pair, count) in &pairs {
            self.places.entry(*pair).or_default().set(item, *count);
        }
        self.pairs = pairs;
    }

    fn rank(&mut self) {
        let frequent = self.places.iter_mut().filter(|(_, places)| places.total > 1);
        let ranked = frequent.map(|(pair, places)| {
            places.ranked = places.total;
            (places.total, Reverse(*pair))
        });
        self.ranked = ranked.collect::<Vec<_>>().into();
    }

    fn enter(&mut self, flat: &Flat, item: Item, concerned: [Item; 3]) {
        let pairs = self.take_pairs(flat.form(item), Some(concerned));
        for (pair, count) in &pairs {
            let places = self.places.entry(*pair).or_default();
            places.set(item, *count);
            if places.total > places.ranked.max(1) {
                places.ranked = places.total;
                self.ranked.push((places.total, Reverse(*pair)));
            }
        }
        self.pairs = pairs;
    }

    /// Removes the pairs of an operation. A pair that occurs less often keeps its rank until [`PairCounts::next`] reads it.
    fn withdraw(&mut self, flat: &Flat, item: Item, concerned: [Item; 3]) {
        let pairs = self.take_pairs(flat.form(item), Some(concerned));
        for (pair, _) in &pairs {
            if let Entry::Occupied(mut entry) = self.places.entry(*pair) {
                entry.get_mut().remove(item);
                if entry.get().total == 0 {
                    entry.remove();
                }
            }
        }
        self.pairs = pairs;
    }

    /// The most frequent pair; of equals, the first in order.
    fn best(&mut self) -> Option<Pair> {
        let (total, best) = self.next()?;
        let Pair::Sum(a, b, _) = best else { return Some(best) };
        // Pairs that only differ in their ratio follow each other, but not in the order of their ratios.
        let mut equals = vec![best];
        while let Some((next, Reverse(Pair::Sum(c, d, _)))) = self.ranked.peek()
            && (*next, *c, *d) == (total, a, b)
        {
            // Another pair may have replaced it.
            let Some((next, pair)) = self.next() else { break };
            match pair {
                Pair::Sum(c, d, _) if (next, c, d) == (total, a, b) => equals.push(pair),
                _ => {
                    self.ranked.push((next, Reverse(pair)));
                    break;
                }
            }
        }
        self.ranked.extend(equals.iter().map(|pair| (total, Reverse(*pair))));
        let value = |pair: &Pair| match pair {
            Pair::Sum(.., ratio) => &self.ratios.all[ratio.0 as usize],
            _ => &self.ratios.all[0],
        };
        equals.into_iter().min_by(|a, b| value(a).cmp(value(b)))
    }

    /// Removes the first pair of the ranking whose frequency is still the ranked one.
    fn next(&mut self) -> Option<(u64, Pair)> {
        while let Some((ranked, Reverse(pair))) = self.ranked.pop() {
            let Some(places) = self.places.get_mut(&pair).filter(|it| it.ranked == ranked) else {
                continue;
            };
            if places.total == ranked {
                return Some((ranked, pair));
            }
            places.ranked = if places.total > 1 { places.total } else { 0 };
            if places.ranked > 0 {
                self.ranked.push((places.ranked, Reverse(pair)));
            }
        }
        None
    }

    /// The steps of counting the pairs of an operation.
    fn steps(&self, form: &Operation) -> u64 {
        let operands = form.operands().filter(|item| self.is_common(*item)).count() as u64;
        STEPS_OF_PAIR * (1 + operands * operands / 2)
    }

    /// Makes the pair an operation, and replaces it everywhere; returns the steps.
    fn extract(&mut self, flat: &mut Flat, pair: Pair) -> u64 {
        let mut steps = 0;
        let form = pair.form(&self.ratios);
        let places = self.places[&pair].items();
        let existing = places.iter().copied().find(|place| *flat.form(*place) == form);
        let whole = existing.unwrap_or_else(|| flat.push(form));
        let (a, b) = pair.operands();
        let concerned = [a, b, whole];
        for place in places {
            // Pairs with each of the two operands, and with their replacement.
            steps += 3 * STEPS_OF_PAIR * flat.form(place).size() as u64;
            self.withdraw(flat, place, concerned);
            if place != whole {
                flat.forms[place.index()] = pair.replace(flat.form(place), whole);
                self.enter(flat, place, concerned);
            }
        }
        steps
    }

    /// Whether an operand can be shared.
    fn is_common(&self, item: Item) -> bool {
        self.common.get(item.index()).copied().unwrap_or(true)
    }

    /// The pairs of an operation, only those with a concerned operand if some are given, and how often each occurs in it; in a
    /// reused buffer.
    fn take_pairs(&mut self, form: &Operation, concerned: Option<[Item; 3]>) -> Vec<(Pair, u64)> {
        let mut pairs = std::mem::take(&mut self.pairs);
        pairs.clear();
        match form {
            Operation::Sum(terms) => {
                let item = |at: usize| terms[at].0;
                self.each_two(terms.len(), item, concerned, |ratios, first, second| {
                    let ((a, first), (b, second)) = (&terms[first], &terms[second]);
                    pairs.push((Pair::Sum(*a, *b, ratios.of(second, first)), 1));
                });
            }
            Operation::Product(factors) => {
                let is_concerned =
                    |item: Item| concerned.is_none_or(|concerned| concerned.contains(&item));
                for (item, exponent) in factors {
                    let squares = u64::from(exponent.unsigned_abs() / 2);
                    if squares > 0 && self.is_common(*item) && is_concerned(*item) {
                        pairs.push((Pair::Product(*item, *item), squares));
                    }
                }
                let item = |at: usize| factors[at].0;
                self.each_two(factors.len(), item, concerned, |_, first, second| {
                    pairs.push(factor_pair(factors[first], factors[second]));
                });
            }
            Operation::Constant(_) | Operation::Pi | Operation::Input(_) | Operation::Call(..) => {}
        }
        pairs
    }

    /// Calls a function for every two operands that can be shared, by their positions, the first one first; only pairs with a
    /// concerned operand if some are given.
    fn each_two(
        &mut self,
        count: usize,
        item: impl Fn(usize) -> Item,
        concerned: Option<[Item; 3]>,
        mut with: impl FnMut(&mut Ratios, usize, usize),
    ) {
        let shared: Vec<usize> = (0..count).filter(|at| self.is_common(item(*at))).collect();
        let ratios = &mut self.ratios;
        for (index, first) in shared.iter().enumerate() {
            match concerned {
                Some(concerned) if !concerned.contains(&item(*first)) => {}
                // A pair of two concerned operands is counted with the first one.
                Some(concerned) => {
                    let others =
                        shared[..index].iter().filter(|at| !concerned.contains(&item(**at)));
                    others.for_each(|other| with(ratios, *other, *first));
                    shared[index + 1..].iter().for_each(|other| with(ratios, *first, *other));
                }
                None => shared[index + 1..].iter().for_each(|other| with(ratios, *first, *other)),
            }
        }
    }
}

/// The pair of two powers, and how often it occurs in their product.
fn factor_pair((a, first): (Item, i32), (b, second): (Item, i32)) -> (Pair, u64) {
    let pair = match (first > 0, second > 0) {
        (true, false) => Pair::Quotient(a, b),
        (false, true) => Pair::Quotient(b, a),
        _ => Pair::Product(a, b),
    };
    (pair, u64::from(first.unsigned_abs().min(second.unsigned_abs())))
}

#[cfg(test)]
mod tests {
    use super::super::flat::{Flat, Grouping, Operation, Scaling};
    use super::{Scope, share};
    use mms_symbolic::expr::{Graph, Symbol};

    /// X Y is a part of t X Y, but of no operation that is needed.
    #[test]
    fn what_nobody_needs_is_no_reason_to_share() {
        let mut graph = Graph::default();
        let t = graph.symbol(Symbol::Time);
        let [x, y] = [0, 1].map(|axis| graph.symbol(Symbol::Coordinate(axis)));
        let product = graph.product(vec![(t, 1.into()), (x, 1.into()), (y, 1.into())]);
        let reached = graph.reachable(&[product]);
        let all = (&reached[..], &[product][..]);
        let (mut flat, roots) = Flat::new(&graph, all, Grouping::Joint, Scaling::Factors);
        let whole = flat.form(roots[0]).clone();
        let Operation::Product(factors) = &whole else { panic!("{whole:?}") };
        flat.push(Operation::Product(factors[1..].to_vec()));
        share(&mut flat, &roots, Scope::Reachable, graph.work());
        assert_eq!(*flat.form(roots[0]), whole);
        share(&mut flat, &roots, Scope::All, graph.work());
        assert_ne!(*flat.form(roots[0]), whole);
    }
}
