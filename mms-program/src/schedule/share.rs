//! Common subexpressions: pairs of operands that several sums or products have in common become operations of
//! their own, the most frequent pair first (Hosangadi, Fallah & Kastner, Optimizing Polynomial Expressions by
//! Algebraic Factorization and Common Subexpression Elimination, 2006, uses the same greedy rule).
//!
//! In a sum a pair is two terms and the ratio of their coefficients, in a product two factors of which either both
//! multiply, or one divides; a power is a pair of equal factors. Every occurrence but the first saves an
//! operation.

use std::cmp::Reverse;
use std::collections::BTreeSet;
use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use super::flat::{Flat, Item, Operation, collected};
use mms_symbolic::expr::{Rational, is_unit, reachable};
use mms_symbolic::work::Work;

/// What can be shared.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Pair {
    /// a + ratio b, a before b.
    Sum(Item, Item, Rational),
    /// a b, a before b or the same.
    Product(Item, Item),
    /// a / b.
    Quotient(Item, Item),
}

impl Pair {
    fn form(&self) -> Operation {
        match self.clone() {
            Pair::Sum(a, b, ratio) => Operation::Sum(vec![(a, Rational::ONE), (b, ratio)]),
            Pair::Product(a, b) if a == b => Operation::Product(vec![(a, 2)]),
            Pair::Product(a, b) => Operation::Product(vec![(a, 1), (b, 1)]),
            Pair::Quotient(a, b) if a < b => Operation::Product(vec![(a, 1), (b, -1)]),
            Pair::Quotient(a, b) => Operation::Product(vec![(b, -1), (a, 1)]),
        }
    }

    fn operands(&self) -> (Item, Item) {
        let (Pair::Sum(a, b, _) | Pair::Product(a, b) | Pair::Quotient(a, b)) = self;
        (*a, *b)
    }

    /// A form that contains the pair, with `whole` in its place.
    fn replace(&self, form: &Operation, whole: Item) -> Operation {
        match (self, form) {
            (Pair::Sum(a, b, _), Operation::Sum(terms)) => {
                let mut rest = terms.clone();
                let first = rest.iter_mut().find(|(item, _)| item == a);
                let coefficient = first.map(|(_, own)| std::mem::take(own)).unwrap_or_default();
                rest.retain(|(item, _)| item != a && item != b);
                rest.push((whole, coefficient));
                Operation::Sum(collected(rest, Rational::is_zero))
            }
            (Pair::Product(a, b) | Pair::Quotient(a, b), Operation::Product(factors)) => {
                let power = |item: &Item| {
                    let found = factors.iter().find(|(base, _)| base == item);
                    found.map_or(0, |(_, exponent)| *exponent)
                };
                let (first, second) = (power(a), power(b));
                // A quotient whose numerator is below is a pair the other way round.
                let sign = first.signum();
                let opposite = if matches!(self, Pair::Quotient(..)) { -1 } else { 1 };
                let count = if a == b { first.abs() / 2 } else { first.abs().min(second.abs()) };
                let mut rest = factors.clone();
                rest.push((*a, -sign * count));
                rest.push((*b, -sign * opposite * count));
                rest.push((whole, sign * count));
                Operation::Product(collected(rest, |exponent| *exponent == 0))
            }
            _ => form.clone(),
        }
    }
}

/// Where pairs are counted. The greedy rule does better with the one or with the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scope {
    /// In all operations, with those that numbers have moved out of since.
    Made,
    /// In those that the roots need.
    Needed,
}

/// What it takes to count a pair.
const STEPS_OF_PAIR: u64 = 50;

/// Extracts shared pairs until no pair occurs twice, or the budget is spent.
pub(super) fn share(flat: &mut Flat, roots: &[Item], scope: Scope, work: &Work) {
    let counted: Vec<Item> = match scope {
        Scope::Made => (0..flat.forms.len()).map(|index| Item(index as u32)).collect(),
        Scope::Needed => reachable(roots, Item::index, |item| flat.form(item).operands()),
    };
    let mut table = Table { common: common(flat, &counted), ..Table::default() };
    for item in counted {
        if work.is_over() {
            return;
        }
        work.spend(table.steps(flat.form(item)));
        table.count(flat, item);
    }
    table.rank();
    while let Some(pair) = table.best().filter(|_| !work.is_over()) {
        work.spend(table.extract(flat, &pair));
    }
}

/// Operands of more than one of the sums and products that are counted, or of one more than once: only they can be
/// shared.
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

/// Which pairs occur where, and how often.
#[derive(Default)]
struct Table {
    /// Of the operations before sharing.
    common: Vec<bool>,
    /// How often a pair occurs, and how often in which operation. Their order here matters to nobody.
    places: FxHashMap<Pair, Places>,
    /// Pairs that occur more than once. The most frequent is last; of equals, the first in order.
    ranked: BTreeSet<(u64, Reverse<Pair>)>,
}

/// How often a pair occurs, and how often in which operation, which are in order.
#[derive(Default)]
struct Places {
    total: u64,
    each: Vec<(Item, u64)>,
}

impl Places {
    /// Sets how often the pair occurs in an operation.
    fn set(&mut self, item: Item, count: u64) {
        match self.each.binary_search_by_key(&item, |(item, _)| *item) {
            Ok(at) => self.total -= std::mem::replace(&mut self.each[at].1, count),
            Err(at) => self.each.insert(at, (item, count)),
        }
        self.total += count;
    }

    fn remove(&mut self, item: Item) {
        if let Ok(at) = self.each.binary_search_by_key(&item, |(item, _)| *item) {
            self.total -= self.each.remove(at).1;
        }
    }
}

impl Table {
    /// Counts the pairs of an operation before any is ranked.
    fn count(&mut self, flat: &Flat, item: Item) {
        for (pair, count) in self.pairs(flat.form(item), |_| true) {
            self.places.entry(pair).or_default().set(item, count);
        }
    }

    fn rank(&mut self) {
        let frequent = self.places.iter().filter(|(_, places)| places.total > 1);
        self.ranked =
            frequent.map(|(pair, places)| (places.total, Reverse(pair.clone()))).collect();
    }

    fn enter(&mut self, flat: &Flat, item: Item, concerned: impl Fn(Item) -> bool) {
        for (pair, count) in self.pairs(flat.form(item), concerned) {
            self.change(pair, |places| places.set(item, count));
        }
    }

    fn withdraw(&mut self, flat: &Flat, item: Item, concerned: impl Fn(Item) -> bool) {
        for (pair, _) in self.pairs(flat.form(item), concerned) {
            self.change(pair, |places| places.remove(item));
        }
    }

    /// Changes the places of a pair, and its rank with them.
    fn change(&mut self, pair: Pair, change: impl FnOnce(&mut Places)) {
        let mut entry = match self.places.entry(pair) {
            Entry::Occupied(entry) => entry,
            Entry::Vacant(entry) => entry.insert_entry(Places::default()),
        };
        let before = entry.get().total;
        change(entry.get_mut());
        let after = entry.get().total;
        if before != after && before > 1 {
            self.ranked.remove(&(before, Reverse(entry.key().clone())));
        }
        if before != after && after > 1 {
            self.ranked.insert((after, Reverse(entry.key().clone())));
        }
        if after == 0 {
            entry.remove();
        }
    }

    fn best(&self) -> Option<Pair> {
        self.ranked.last().map(|(_, pair)| pair.0.clone())
    }

    /// What it takes to count the pairs of an operation.
    fn steps(&self, form: &Operation) -> u64 {
        let operands = form.operands().filter(|item| self.is_common(*item)).count() as u64;
        STEPS_OF_PAIR * (1 + operands * operands / 2)
    }

    /// Makes the pair an operation, and puts it in its places; says what that took.
    fn extract(&mut self, flat: &mut Flat, pair: &Pair) -> u64 {
        let mut steps = 0;
        let form = pair.form();
        let places: Vec<Item> = self.places[pair].each.iter().map(|(item, _)| *item).collect();
        let existing = places.iter().copied().find(|place| *flat.form(*place) == form);
        let whole = existing.unwrap_or_else(|| flat.push(form));
        let (a, b) = pair.operands();
        let concerned = |item: Item| item == a || item == b || item == whole;
        for place in places {
            // With each of the pair, and with what takes its place.
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

    /// The pairs of an operation with a concerned operand, and how often each occurs in it.
    fn pairs(&self, form: &Operation, concerned: impl Fn(Item) -> bool) -> Vec<(Pair, u64)> {
        let is_common = |item: Item| self.is_common(item);
        let mut pairs = Vec::new();
        match form {
            Operation::Sum(terms) => {
                let terms: Vec<_> = terms.iter().filter(|(item, _)| is_common(*item)).collect();
                for (index, (a, first)) in terms.iter().enumerate() {
                    for (b, second) in &terms[index + 1..] {
                        if concerned(*a) || concerned(*b) {
                            pairs.push((Pair::Sum(*a, *b, ratio(second, first)), 1));
                        }
                    }
                }
            }
            Operation::Product(factors) => {
                let factors: Vec<_> = factors.iter().filter(|(item, _)| is_common(*item)).collect();
                for (index, (a, first)) in factors.iter().enumerate() {
                    let squares = u64::from(first.unsigned_abs() / 2);
                    if squares > 0 && concerned(*a) {
                        pairs.push((Pair::Product(*a, *a), squares));
                    }
                    for (b, second) in &factors[index + 1..] {
                        if concerned(*a) || concerned(*b) {
                            pairs.push(factor_pair((*a, *first), (*b, *second)));
                        }
                    }
                }
            }
            Operation::Constant(_) | Operation::Pi | Operation::Input(_) | Operation::Call(..) => {}
        }
        pairs
    }
}

/// a/b.
fn ratio(a: &Rational, b: &Rational) -> Rational {
    match is_unit(b) {
        true if b.is_one() => a.clone(),
        true => -a.clone(),
        false => a / b,
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

    /// X Y is a part of t X Y, and of nothing that is needed.
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
        share(&mut flat, &roots, Scope::Needed, graph.work());
        assert_eq!(*flat.form(roots[0]), whole);
        share(&mut flat, &roots, Scope::Made, graph.work());
        assert_ne!(*flat.form(roots[0]), whole);
    }
}
