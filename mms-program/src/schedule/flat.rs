//! The n-ary normal form for sharing: expressions as operations of any number of operands, grouped by stage.
//!
//! Unlike in the graph, a sum may contain a sum here, and a product a product. So the terms of one stage can be separate, and
//! common operands of several operations can be an operation of their own.

use std::hash::BuildHasher as _;
use std::ops::AddAssign;

use dashu_int::IBig;
use hashbrown::HashTable;
use rustc_hash::FxBuildHasher;

use mms_symbolic::expr::Stage;
use mms_symbolic::expr::{
    ByExpr, Expr, Function, Graph, HALF, Node, Rational, Small, Symbol, is_negative, is_unit,
    magnitude,
};

/// The largest number of operands. Longer sums and products are split, so that the work on pairs of their operands grows with
/// their length and not with its square.
const MAX_OPERANDS: usize = 32;

/// The largest depth of nested sums into which a coefficient is multiplied.
const SCALED_SUMS: usize = 4;

/// The greatest exponent of a product; the power function computes greater ones.
const MAX_EXPONENT: i32 = 1 << 24;

/// A handle to an operation of [`Flat`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Item(pub(super) u32);

impl Item {
    /// The position of the operation.
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// An operation on any number of operands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Operation {
    /// An exact number.
    Constant(Rational),
    /// pi.
    Pi,
    /// A leaf.
    Input(Symbol),
    /// Terms with their coefficients, in order; the constant is a coefficient of the number 1.
    Sum(Vec<(Item, Rational)>),
    /// Factors with their exponents, in order.
    Product(Vec<(Item, i32)>),
    /// An elementary function, and the proved bound of its argument.
    Call(Function, Option<Small>, Vec<Item>),
}

impl Operation {
    /// The operands.
    pub(super) fn operands(&self) -> impl DoubleEndedIterator<Item = Item> {
        let (terms, factors, arguments) = match self {
            Operation::Constant(_) | Operation::Pi | Operation::Input(_) => {
                (&[][..], &[][..], &[][..])
            }
            Operation::Sum(terms) => (&terms[..], &[][..], &[][..]),
            Operation::Product(factors) => (&[][..], &factors[..], &[][..]),
            Operation::Call(_, _, arguments) => (&[][..], &[][..], &arguments[..]),
        };
        let summed = terms.iter().map(|(item, _)| *item);
        summed.chain(factors.iter().map(|(item, _)| *item)).chain(arguments.iter().copied())
    }

    /// The number of operands.
    pub(super) fn size(&self) -> usize {
        match self {
            Operation::Constant(_) | Operation::Pi | Operation::Input(_) => 0,
            Operation::Sum(terms) => terms.len(),
            Operation::Product(factors) => factors.len(),
            Operation::Call(_, _, arguments) => arguments.len(),
        }
    }
}

/// The stages that are separate in a sum or product.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Grouping {
    /// All four stages: values that need X alone can be stored for all times.
    Staged,
    /// Values that need X are one group, which allows more sharing.
    Joint,
}

/// The places that the coefficient of a term may be multiplied into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scaling {
    /// A factor that is known before X is.
    Factors,
    /// A factor that is known before X is, also in every term of a sum: 2 X (a Y + b) is X (2 a Y + 2 b).
    Sums,
}

/// N-ary operations.
#[derive(Clone, Debug, Default)]
pub(super) struct Flat {
    pub(super) forms: Vec<Operation>,
    pub(super) stages: Vec<Stage>,
    /// Whether the other grouping gives other operations.
    pub(super) is_grouped: bool,
    /// Whether multiplying numbers into sums gives other operations.
    pub(super) is_scalable: bool,
}

impl Flat {
    /// The operations of `roots`, whose sub-expressions are `reached`, and the item of each root.
    pub(super) fn new(
        graph: &Graph,
        (reached, roots): (&[Expr], &[Expr]),
        grouping: Grouping,
        scaling: Scaling,
    ) -> (Self, Vec<Item>) {
        let mut maker = Maker::new(grouping, scaling);
        let mut items = ByExpr::of(roots);
        for expr in reached.iter().copied() {
            let item = maker.flatten(graph, expr, &items);
            items.set(expr, item);
        }
        (maker.flat, roots.iter().map(|root| items[*root]).collect())
    }

    /// `count` items of ln(-1), which has no value in any arithmetic.
    pub(super) fn undefined(count: usize) -> (Self, Vec<Item>) {
        let mut flat = Flat::default();
        let number = flat.push(Operation::Constant(Rational::NEG_ONE));
        let undefined = flat.push(Operation::Call(Function::Ln, None, vec![number]));
        (flat, vec![undefined; count])
    }

    pub(super) fn form(&self, item: Item) -> &Operation {
        &self.forms[item.index()]
    }

    pub(super) fn stage(&self, item: Item) -> Stage {
        self.stages[item.index()]
    }

    /// A new item, without a search for an equal form.
    pub(super) fn push(&mut self, form: Operation) -> Item {
        let own = match form {
            Operation::Input(symbol) => Stage::of(symbol),
            _ => Stage::Parameter,
        };
        let stage = form.operands().fold(own, |stage, item| stage.join(self.stage(item)));
        let item = Item(u32::try_from(self.forms.len()).expect("the node limit bounds programs"));
        self.forms.push(form);
        self.stages.push(stage);
        item
    }
}

/// Operations under construction, hash-consed.
struct Maker {
    flat: Flat,
    /// The items by the hashes of their forms. Only ever looked up, never iterated.
    index: HashTable<Item>,
    grouping: Grouping,
    scaling: Scaling,
}

/// Operands of the stages, each with a number.
type Groups<N> = [Vec<(Item, N)>; Stage::ALL.len()];

fn hash(form: &Operation) -> u64 {
    FxBuildHasher.hash_one(form)
}

impl Maker {
    fn new(grouping: Grouping, scaling: Scaling) -> Self {
        Maker { flat: Flat::default(), index: HashTable::new(), grouping, scaling }
    }

    /// The one item of a form.
    fn intern(&mut self, form: Operation) -> Item {
        let forms = &self.flat.forms;
        let own = hash(&form);
        if let Some(item) = self.index.find(own, |item| forms[item.index()] == form) {
            return *item;
        }
        let item = self.flat.push(form);
        let forms = &self.flat.forms;
        self.index.insert_unique(own, item, |item| hash(&forms[item.index()]));
        item
    }

    fn constant(&mut self, number: impl Into<Rational>) -> Item {
        self.intern(Operation::Constant(number.into()))
    }

    fn flatten(&mut self, graph: &Graph, expr: Expr, items: &ByExpr<Item>) -> Item {
        match graph.node(expr) {
            Node::Number(number) => self.constant(number.clone()),
            Node::Pi => self.intern(Operation::Pi),
            Node::Symbol(symbol) => self.intern(Operation::Input(*symbol)),
            Node::Sum(constant, terms) => {
                let mut flat = Vec::new();
                if !constant.is_zero() {
                    flat.push((self.constant(1), constant.clone()));
                }
                for (term, coefficient) in terms {
                    flat.push(self.scaled(items[*term], coefficient));
                }
                self.sum(flat)
            }
            Node::Product(factors) => {
                let mut flat = Vec::new();
                for (base, exponent) in factors {
                    self.power(items[*base], exponent, &mut flat);
                }
                self.product(flat)
            }
            Node::Offset(operands) => {
                // A constant is a coefficient of the number 1.
                let (one, minus_one) = (Rational::ONE, Rational::NEG_ONE);
                let [from, place] = operands.map(|operand| items[operand]);
                let place = match self.flat.form(place) {
                    Operation::Constant(number) => {
                        let number = -number.clone();
                        (self.constant(1), number)
                    }
                    _ => (place, minus_one),
                };
                self.collected_sum(vec![(from, one), place])
            }
            // The proved bound of an angle belongs to its sine or cosine.
            Node::Small(_, angle) => items[*angle],
            Node::Call(function, arguments) => {
                let small = match graph.node(arguments[0]) {
                    Node::Small(small, _) => Some(*small),
                    _ => None,
                };
                let arguments = arguments.iter().map(|argument| items[*argument]).collect();
                self.intern(Operation::Call(*function, small, arguments))
            }
        }
    }

    /// A term and its coefficient, which is multiplied into factors that are known earlier, if there are any.
    fn scaled(&mut self, term: Item, coefficient: &Rational) -> (Item, Rational) {
        if is_unit(coefficient) {
            return (term, coefficient.clone());
        }
        let sign = if is_negative(coefficient) { Rational::NEG_ONE } else { Rational::ONE };
        match self.times(term, &magnitude(coefficient), SCALED_SUMS) {
            Some(scaled) => (scaled, sign),
            None => (term, coefficient.clone()),
        }
    }

    /// A product or a sum times a number, if that needs no operation that depends on X. `sums` is the largest depth of nested
    /// sums into which the number may be multiplied.
    fn times(&mut self, item: Item, number: &Rational, sums: usize) -> Option<Item> {
        let Operation::Product(factors) = self.flat.form(item) else {
            return self.sum_times(item, number, sums);
        };
        let late = self.flat.stage(item).min(Stage::Point);
        let mut bases = factors.iter().enumerate().filter(|(_, (_, power))| *power == 1);
        let early = bases.clone().find(|(_, (base, _))| self.flat.stage(*base) < late);
        let (place, scaled) = match early {
            Some((place, (base, _))) => (place, self.multiple(*base, number)),
            None => {
                let sums_of = |(place, (base, _)): (usize, &(Item, i32))| (place, *base);
                let bases: Vec<_> = bases.by_ref().map(sums_of).collect();
                let mut bases = bases.into_iter();
                bases
                    .find_map(|(place, base)| Some((place, self.sum_times(base, number, sums)?)))?
            }
        };
        let Operation::Product(mut factors) = self.flat.form(item).clone() else { return None };
        factors[place].0 = scaled;
        Some(self.product(factors))
    }

    /// A sum times a number, if the number can be multiplied into every term.
    fn sum_times(&mut self, item: Item, number: &Rational, sums: usize) -> Option<Item> {
        if sums == 0 || self.flat.stage(item) < Stage::Point {
            return None;
        }
        let Operation::Sum(terms) = self.flat.form(item) else { return None };
        if self.scaling == Scaling::Factors {
            self.flat.is_scalable = true;
            return None;
        }
        let mut terms = terms.clone();
        for (term, _) in &mut terms {
            *term = match self.flat.stage(*term) < Stage::Point {
                true => self.multiple(*term, number),
                false => self.times(*term, number, sums - 1)?,
            };
        }
        Some(self.sum(terms))
    }

    fn multiple(&mut self, item: Item, number: &Rational) -> Item {
        let number = self.constant(number.clone());
        self.product(vec![(number, 1), (item, 1)])
    }

    /// Adds the factors of a power: halves are square roots, other fractions power functions.
    fn power(&mut self, base: Item, exponent: &Rational, factors: &mut Vec<(Item, i32)>) {
        if exponent.is_int()
            && let Ok(count) = i32::try_from(exponent.numerator())
            && count.unsigned_abs() <= MAX_EXPONENT as u32
        {
            factors.extend((count != 0).then_some((base, count)));
            return;
        }
        let sign = if is_negative(exponent) { -1 } else { 1 };
        let magnitude = magnitude(exponent);
        let whole = magnitude.numerator() / IBig::from(magnitude.denominator().clone());
        let fraction = &magnitude - Rational::from(whole.clone());
        let count = i32::try_from(whole).ok().filter(|count| *count <= MAX_EXPONENT);
        match count {
            Some(count) if fraction.is_zero() || fraction == HALF => {
                if fraction == HALF {
                    let root = self.intern(Operation::Call(Function::Sqrt, None, vec![base]));
                    factors.push((root, sign));
                }
                if count > 0 {
                    factors.push((base, sign * count));
                }
            }
            _ => {
                let exponent = self.constant(magnitude);
                let power =
                    self.intern(Operation::Call(Function::Powf, None, vec![base, exponent]));
                factors.push((power, sign));
            }
        }
    }

    /// The group of a stage: groups are computed separately, in this order.
    fn group(&self, item: Item) -> Stage {
        match (self.flat.stage(item), self.grouping) {
            (Stage::PointTime, Grouping::Joint) => Stage::Point,
            (stage, _) => stage,
        }
    }

    /// Operands by their groups.
    fn grouped<N>(&mut self, operands: Vec<(Item, N)>) -> Groups<N> {
        let mut groups = Groups::default();
        for operand in operands {
            groups[self.group(operand.0) as usize].push(operand);
        }
        let is_there = |stage: Stage| !groups[stage as usize].is_empty();
        self.flat.is_grouped |= is_there(Stage::Point) && is_there(Stage::PointTime);
        groups
    }

    /// A sum whose terms are grouped by stage.
    fn sum(&mut self, terms: Vec<(Item, Rational)>) -> Item {
        let groups = self.grouped(terms);
        let carried = self.carry(groups, |flat, _, group| match group.as_slice() {
            [_] => group,
            _ => vec![(flat.collected_sum(group), Rational::ONE)],
        });
        self.collected_sum(carried)
    }

    /// A product whose factors are grouped by stage.
    fn product(&mut self, factors: Vec<(Item, i32)>) -> Item {
        let groups = self.grouped(factors);
        let carried = self.carry(groups, |flat, stage, mut group| {
            // One division at a point serves numerator and denominator; values that are known earlier are inverted earlier.
            let inverse = group.iter().all(|(_, exponent)| *exponent < 0);
            if stage <= Stage::Time || !inverse {
                return vec![(flat.collected_product(group), 1)];
            }
            group.iter_mut().for_each(|(_, exponent)| *exponent = -*exponent);
            vec![(flat.collected_product(group), -1)]
        });
        self.collected_product(carried)
    }

    /// Joins groups: each but the last becomes one operand of the next. The group that needs t and no X is joined to the one
    /// that needs both.
    fn carry<N>(
        &mut self,
        groups: Groups<N>,
        mut close: impl FnMut(&mut Self, Stage, Vec<(Item, N)>) -> Vec<(Item, N)>,
    ) -> Vec<(Item, N)> {
        let mut early = Vec::new();
        let mut late = Vec::new();
        let last = groups.iter().rposition(|group| !group.is_empty());
        let groups = Stage::ALL.into_iter().zip(groups).enumerate();
        for (place, (stage, group)) in groups.filter(|(_, (_, group))| !group.is_empty()) {
            let to = if stage <= Stage::Time { &mut early } else { &mut late };
            if Some(place) == last && to.is_empty() {
                *to = group;
            } else {
                to.extend(close(self, stage, group));
            }
        }
        if early.len() > 1 && !late.is_empty() {
            early = close(self, Stage::Time, early);
        }
        early.extend(late);
        early
    }

    /// A sum of terms that are grouped already; a lone term with coefficient 1 is itself.
    fn collected_sum(&mut self, terms: Vec<(Item, Rational)>) -> Item {
        let mut terms = collected(terms, Rational::is_zero);
        while terms.len() > MAX_OPERANDS {
            let parts = terms.chunks(MAX_OPERANDS);
            terms = parts
                .map(|part| (self.intern(Operation::Sum(part.to_vec())), Rational::ONE))
                .collect();
            // A part may be an item that existed before.
            terms.sort();
        }
        match terms.as_slice() {
            [] => self.constant(0),
            [(item, one)] if one.is_one() => *item,
            _ => self.intern(Operation::Sum(terms)),
        }
    }

    /// A product of factors that are grouped already; a lone factor is itself.
    fn collected_product(&mut self, factors: Vec<(Item, i32)>) -> Item {
        let mut factors = collected(factors, |exponent| *exponent == 0);
        while factors.len() > MAX_OPERANDS {
            let parts = factors.chunks(MAX_OPERANDS);
            factors =
                parts.map(|part| (self.intern(Operation::Product(part.to_vec())), 1)).collect();
            factors.sort();
        }
        match factors.as_slice() {
            [] => self.constant(1),
            [(item, 1)] => *item,
            _ => self.intern(Operation::Product(factors)),
        }
    }
}

/// Sorts operands, adds up the numbers of equal ones, and drops zeros.
pub(super) fn collected<N: AddAssign>(
    mut operands: Vec<(Item, N)>,
    is_zero: impl Fn(&N) -> bool,
) -> Vec<(Item, N)> {
    operands.sort_by_key(|(item, _)| *item);
    let mut collected = Vec::<(Item, N)>::with_capacity(operands.len());
    for (item, number) in operands {
        match collected.last_mut() {
            Some((last, total)) if *last == item => *total += number,
            _ => collected.push((item, number)),
        }
    }
    collected.retain(|(_, number)| !is_zero(number));
    collected
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A product of 40 factors is one of two, and the factor with the last factors may be an older item.
    #[test]
    fn operands_are_in_order_where_long_products_are_parted() {
        let mut graph = Graph::default();
        let names: Vec<Expr> =
            (0..40).map(|index| graph.symbol(Symbol::Parameter(index))).collect();
        let mut product = |factors: &[Expr]| {
            graph.product(factors.iter().map(|factor| (*factor, Rational::ONE)).collect::<Vec<_>>())
        };
        let roots = [product(&names[MAX_OPERANDS..]), product(&names)];
        let reached = graph.reachable(&roots);
        let all = (&reached[..], &roots[..]);
        let (flat, items) = Flat::new(&graph, all, Grouping::Staged, Scaling::Factors);
        let operands: Vec<Item> = flat.form(items[1]).operands().collect();
        assert_eq!(operands.len(), 2);
        assert!(operands.is_sorted() && operands.contains(&items[0]), "{operands:?}");
    }
}
