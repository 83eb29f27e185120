//! Lowering to binary operations, in order. Values are numbered, so an operation on the same operands is one value.
//!
//! Operands of one stage are combined first. But if parameters determine c, and X adds only products p and q to it, the sum is
//! (c + p) + q and not c + (p + q), so that each product is added in one fused step; and a quotient of values that X determines
//! is computed before its product with values of parameters.

use std::hash::BuildHasher as _;

use hashbrown::HashTable;
use rustc_hash::FxBuildHasher;

use super::flat::{Flat, Item, Operation};
use crate::program::{Instr, Op, Value};
use mms_symbolic::expr::Stage;
use mms_symbolic::expr::{Rational, is_negative, is_unit, magnitude};

/// Value numbering: an operation on the same operands is one value.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) instrs: Vec<Instr>,
    /// The values by the hashes of their operations. Only ever looked up, never iterated.
    index: HashTable<Value>,
}

fn hash(op: &Op) -> u64 {
    FxBuildHasher.hash_one(op)
}

/// One item for each stage.
type ByStage<T> = [T; Stage::ALL.len()];

/// The value of each item that has one.
struct Lowered(Vec<Option<Value>>);

impl Lowered {
    fn is_known(&self, item: Item) -> bool {
        self.0[item.index()].is_some()
    }
}

impl std::ops::Index<Item> for Lowered {
    type Output = Value;

    fn index(&self, item: Item) -> &Value {
        self.0[item.index()].as_ref().expect("operands are lowered first")
    }
}

impl Builder {
    fn push(&mut self, op: Op) -> Value {
        let op = match op {
            Op::Add(a, b) if b < a => Op::Add(b, a),
            Op::Multiply(a, b) if b < a => Op::Multiply(b, a),
            other => other,
        };
        let (own_hash, instrs) = (hash(&op), &self.instrs);
        if let Some(value) = self.index.find(own_hash, |value| instrs[value.index()].op == op) {
            return *value;
        }
        let own = match op {
            Op::Input(symbol) => Stage::of(symbol),
            _ => Stage::Parameter,
        };
        let stage = op.operands().fold(own, |stage, operand| stage.join(self.stage(operand)));
        let value =
            Value(u32::try_from(self.instrs.len()).expect("the node limit bounds programs"));
        self.instrs.push(Instr { op, stage });
        let instrs = &self.instrs;
        self.index.insert_unique(own_hash, value, |value| hash(&instrs[value.index()].op));
        value
    }

    fn stage(&self, value: Value) -> Stage {
        self.instrs[value.index()].stage
    }

    fn constant(&mut self, number: impl Into<Rational>) -> Value {
        self.push(Op::Constant(number.into()))
    }

    /// The values of `roots`, after everything that they need.
    pub(super) fn lower(&mut self, flat: &Flat, roots: &[Item]) -> Vec<Value> {
        let mut values = Lowered(vec![None; flat.forms.len()]);
        let mut open: Vec<Item> = roots.iter().rev().copied().collect();
        while let Some(item) = open.last().copied() {
            let operands = flat.form(item).operands();
            let before = open.len();
            open.extend(operands.rev().filter(|operand| !values.is_known(*operand)));
            if open.len() > before {
                continue;
            }
            open.pop();
            if !values.is_known(item) {
                values.0[item.index()] = Some(self.form(flat.form(item), &values));
            }
        }
        roots.iter().map(|root| values[*root]).collect()
    }

    fn form(&mut self, form: &Operation, values: &Lowered) -> Value {
        match form {
            Operation::Constant(number) => self.constant(number.clone()),
            Operation::Pi => self.push(Op::Pi),
            Operation::Input(symbol) => self.push(Op::Input(*symbol)),
            Operation::Sum(terms) => {
                let terms: Vec<_> =
                    terms.iter().map(|(item, factor)| (values[*item], factor)).collect();
                self.sum(&terms)
            }
            Operation::Product(factors) => {
                self.product(factors.iter().map(|(item, exponent)| (values[*item], *exponent)))
            }
            Operation::Call(function, small, arguments) => match arguments[..] {
                [a] => self.push(Op::Unary(*function, *small, values[a])),
                [a, b] => self.push(Op::Binary(*function, values[a], values[b])),
                _ => unreachable!("functions take one or two arguments"),
            },
        }
    }

    /// Adds up terms of one stage first, then the stages, earliest first: terms that cancel at each time, or in differences of
    /// coordinates, do so before anything else is rounded. But if X determines products only, these are added one by one to the
    /// part of parameters, so that none takes a step of its own: they are rounded anyway.
    fn sum(&mut self, terms: &[(Value, &Rational)]) -> Value {
        let content = common_magnitude(terms);
        let mut groups = ByStage::<Vec<(bool, Value)>>::default();
        for (term, coefficient) in terms {
            let value = match content {
                Some(_) => *term,
                None => self.scaled(coefficient, *term),
            };
            groups[self.stage(value) as usize].push((is_negative(coefficient), value));
        }
        let mut total = Signed::default();
        let groups = Stage::ALL.into_iter().zip(groups);
        for (stage, group) in groups.filter(|(_, group)| !group.is_empty()) {
            let is_product = |(_, value): &(bool, Value)| {
                matches!(self.instrs[value.index()].op, Op::Multiply(..))
            };
            let is_continued = total.stage(self) == Some(Stage::Parameter)
                && stage == Stage::Point
                && group.iter().all(is_product);
            let before = if is_continued { Signed::default() } else { std::mem::take(&mut total) };
            for (negative, value) in group.into_iter().chain(before.0) {
                total.add(self, negative, value);
            }
        }
        let total = total.finish(self);
        match content {
            Some(content) => self.scaled(&content, total),
            None => total,
        }
    }

    /// A value times the magnitude of a number.
    fn scaled(&mut self, factor: &Rational, value: Value) -> Value {
        if is_unit(factor) {
            return value;
        }
        let one = matches!(&self.instrs[value.index()].op, Op::Constant(one) if one.is_one());
        let factor = self.constant(magnitude(factor));
        if one { factor } else { self.push(Op::Multiply(factor, value)) }
    }

    /// Multiplies factors of one stage first, then the stages, earliest first; one division serves all divisors.
    fn product(&mut self, factors: impl Iterator<Item = (Value, i32)>) -> Value {
        let [mut above, mut below] = [ByStage::<Option<Value>>::default(); 2];
        for (base, exponent) in factors {
            let power = self.integer_power(base, exponent.unsigned_abs());
            let groups = if exponent > 0 { &mut above } else { &mut below };
            let group = &mut groups[self.stage(power) as usize];
            *group = Some(match *group {
                Some(product) => self.push(Op::Multiply(product, power)),
                None => power,
            });
        }
        let Some(denominator) = self.multiplied(below) else {
            return self.multiplied(above).unwrap_or_else(|| self.constant(1));
        };
        // The part of X is divided first: its product with the part of parameters can then be added in one step.
        let is_parted = above.iter().flatten().count() > 1;
        let early = match is_parted && self.stage(denominator) != Stage::Parameter {
            true => above[Stage::Parameter as usize].take(),
            false => None,
        };
        let numerator = self.multiplied(above).unwrap_or_else(|| self.constant(1));
        let quotient = self.push(Op::Divide(numerator, denominator));
        match early {
            Some(early) => self.push(Op::Multiply(early, quotient)),
            None => quotient,
        }
    }

    /// The product of one value for each stage, earliest first; `None` if there are no values.
    fn multiplied(&mut self, groups: ByStage<Option<Value>>) -> Option<Value> {
        let values = groups.into_iter().flatten();
        values.reduce(|product, value| self.push(Op::Multiply(product, value)))
    }

    fn integer_power(&mut self, base: Value, exponent: u32) -> Value {
        let mut power: Option<Value> = None;
        for bit in (0..u32::BITS - exponent.leading_zeros()).rev() {
            power = power.map(|power| self.push(Op::Multiply(power, power)));
            if exponent >> bit & 1 == 1 {
                power = Some(match power {
                    Some(power) => self.push(Op::Multiply(power, base)),
                    None => base,
                });
            }
        }
        power.unwrap_or_else(|| self.constant(1))
    }
}

/// A running sum with a sign in front.
#[derive(Default)]
struct Signed(Option<(bool, Value)>);

impl Signed {
    fn stage(&self, builder: &Builder) -> Option<Stage> {
        self.0.map(|(_, value)| builder.stage(value))
    }

    fn add(&mut self, builder: &mut Builder, negative: bool, value: Value) {
        self.0 = Some(match self.0 {
            None => (negative, value),
            Some((sign, total)) if sign == negative => (sign, builder.push(Op::Add(total, value))),
            Some((false, total)) => (false, builder.push(Op::Subtract(total, value))),
            Some((true, total)) => (false, builder.push(Op::Subtract(value, total))),
        });
    }

    fn finish(self, builder: &mut Builder) -> Value {
        match self.0 {
            None => builder.constant(0),
            Some((false, total)) => total,
            Some((true, total)) => builder.push(Op::Negate(total)),
        }
    }
}

/// The common magnitude of all coefficients, if it is not one.
fn common_magnitude(terms: &[(Value, &Rational)]) -> Option<Rational> {
    let [(_, first), _, ..] = terms else { return None };
    if is_unit(first) {
        return None;
    }
    let common = magnitude(first);
    let is_common = terms.iter().all(|(_, factor)| magnitude(factor) == common);
    is_common.then_some(common)
}
