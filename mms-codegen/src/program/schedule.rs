//! From expressions to straight-line code: n-ary sums and products become binary operations,
//! grouped by stage so that nothing is computed later than it is known.

use std::collections::{BTreeMap, HashMap};

use super::{Instr, Op, Output, Program, Stage, Value};
use crate::expr::{Expr, Function, Graph, Node, Rational, magnitude};

/// The program of `outputs`, without anything that they do not need.
pub fn schedule(graph: &Graph, outputs: &BTreeMap<Output, Vec<Expr>>) -> Program {
    let roots: Vec<Expr> = outputs.values().flatten().copied().collect();
    let mut builder = Builder::default();
    let mut values = BTreeMap::<Expr, Value>::new();
    for expr in graph.reachable(&roots) {
        let value = builder.lower(graph, graph.node(expr), &values);
        values.insert(expr, value);
    }
    let outputs = outputs
        .iter()
        .map(|(output, components)| {
            (*output, components.iter().map(|component| values[component]).collect())
        })
        .collect();
    in_stage_order(Program { instrs: builder.instrs, outputs })
}

/// Drops what no output needs, and sorts by stage; within a stage the order stays.
fn in_stage_order(program: Program) -> Program {
    let all: Vec<Output> = program.outputs.keys().copied().collect();
    let needed = program.needed(&all);
    let mut order: Vec<usize> = (0..program.instrs.len()).filter(|index| needed[*index]).collect();
    order.sort_by_key(|index| program.instrs[*index].stage);
    let mut renamed = vec![Value(0); program.instrs.len()];
    for (new, old) in order.iter().enumerate() {
        renamed[*old] = Value(new as u32);
    }
    let rename = |value: Value| renamed[value.index()];
    Program {
        instrs: order
            .into_iter()
            .map(|old| Instr {
                op: program.instrs[old].op.map(rename),
                stage: program.instrs[old].stage,
            })
            .collect(),
        outputs: program
            .outputs
            .into_iter()
            .map(|(output, values)| (output, values.into_iter().map(rename).collect()))
            .collect(),
    }
}

/// Value numbering: an operation on the same operands is one value.
#[derive(Default)]
struct Builder {
    instrs: Vec<Instr>,
    /// Only ever looked up, never iterated.
    index: HashMap<Op, Value>,
}

impl Builder {
    fn push(&mut self, op: Op) -> Value {
        let op = match op {
            Op::Add(a, b) if b < a => Op::Add(b, a),
            Op::Multiply(a, b) if b < a => Op::Multiply(b, a),
            other => other,
        };
        if let Some(value) = self.index.get(&op) {
            return *value;
        }
        let own = match op {
            Op::Input(symbol) => Stage::of(symbol),
            _ => Stage::Parameter,
        };
        let stage = op.operands().fold(own, |stage, operand| stage.join(self.stage(operand)));
        let value =
            Value(u32::try_from(self.instrs.len()).expect("the node limit bounds programs"));
        self.instrs.push(Instr { op: op.clone(), stage });
        self.index.insert(op, value);
        value
    }

    fn stage(&self, value: Value) -> Stage {
        self.instrs[value.index()].stage
    }

    fn constant(&mut self, number: impl Into<Rational>) -> Value {
        self.push(Op::Constant(number.into()))
    }

    fn lower(&mut self, graph: &Graph, node: &Node, values: &BTreeMap<Expr, Value>) -> Value {
        match node {
            Node::Number(number) => self.constant(number.clone()),
            Node::Pi => self.push(Op::Pi),
            Node::Symbol(symbol) => self.push(Op::Input(*symbol)),
            Node::Sum(constant, terms) => self.sum(graph, constant, terms, values),
            Node::Product(factors) => self.product(Rational::ONE, factors, values),
            Node::Call(function, arguments) => match arguments[..] {
                [a] => self.push(Op::Unary(*function, values[&a])),
                [a, b] => self.push(Op::Binary(*function, values[&a], values[&b])),
                _ => unreachable!("functions take one or two arguments"),
            },
        }
    }

    /// Terms of one stage are added up first, then the stages, earliest first.
    fn sum(
        &mut self,
        graph: &Graph,
        constant: &Rational,
        terms: &[(Expr, Rational)],
        values: &BTreeMap<Expr, Value>,
    ) -> Value {
        if let Some(content) = common_magnitude(constant, terms) {
            let signs: Vec<_> =
                terms.iter().map(|(term, factor)| (*term, factor / &content)).collect();
            let sum = self.sum(graph, &(constant / &content), &signs, values);
            let content = self.constant(content);
            return self.push(Op::Multiply(content, sum));
        }
        let mut groups = BTreeMap::<Stage, Signed>::new();
        if !constant.is_zero() {
            let (negative, magnitude) = split_sign(constant);
            let value = self.constant(magnitude);
            groups.entry(Stage::Parameter).or_default().add(self, negative, value);
        }
        for (term, coefficient) in terms {
            let (negative, magnitude) = split_sign(coefficient);
            let value = self.scaled(graph, magnitude, *term, values);
            groups.entry(self.stage(value)).or_default().add(self, negative, value);
        }
        let mut total = Signed::default();
        for group in groups.into_values() {
            if let Some((negative, value)) = group.0 {
                total.add(self, negative, value);
            }
        }
        total.finish(self)
    }

    /// A term times a positive coefficient, which goes to the earliest factor.
    fn scaled(
        &mut self,
        graph: &Graph,
        coefficient: Rational,
        term: Expr,
        values: &BTreeMap<Expr, Value>,
    ) -> Value {
        match graph.node(term) {
            Node::Product(factors) => self.product(coefficient, factors, values),
            _ if coefficient.is_one() => values[&term],
            _ => {
                let coefficient = self.constant(coefficient);
                self.push(Op::Multiply(coefficient, values[&term]))
            }
        }
    }

    /// Factors of one stage are gathered into one quotient; an earlier stage multiplies into the
    /// next one that may see it.
    fn product(
        &mut self,
        coefficient: Rational,
        factors: &[(Expr, Rational)],
        values: &BTreeMap<Expr, Value>,
    ) -> Value {
        let mut groups = BTreeMap::<Stage, Quotient>::new();
        if !coefficient.is_one() {
            let value = self.constant(coefficient);
            groups.entry(Stage::Parameter).or_default().multiply(self, value);
        }
        for (base, exponent) in factors {
            let base = values[base];
            let (negative, magnitude) = split_sign(exponent);
            let power = self.power(base, &magnitude);
            let group = groups.entry(self.stage(base)).or_default();
            if negative {
                group.divide(self, power);
            } else {
                group.multiply(self, power);
            }
        }
        let mut carried = None;
        for stage in Stage::ALL {
            let Some(group) = groups.remove(&stage) else { continue };
            carried = Some(match carried {
                // What needs t waits until what needs X is known, and does not delay it.
                Some(early) if self.stage(early) == Stage::Time && stage == Stage::Point => {
                    let point = group.finish(self, None);
                    self.push(Op::Multiply(early, point))
                }
                early => group.finish(self, early),
            });
        }
        carried.unwrap_or_else(|| self.constant(1))
    }

    /// A positive power, by repeated squaring; halves are square roots.
    fn power(&mut self, base: Value, exponent: &Rational) -> Value {
        let whole = exponent.numerator() / dashu_int::IBig::from(exponent.denominator().clone());
        let fraction = exponent - Rational::from(whole.clone());
        let integer = u64::try_from(whole).ok();
        let half = Rational::from_parts(1.into(), 2u8.into());
        match integer {
            Some(0) if fraction == half => self.push(Op::Unary(Function::Sqrt, base)),
            Some(count) if fraction.is_zero() => self.integer_power(base, count),
            Some(count) if fraction == half => {
                let (power, root) =
                    (self.integer_power(base, count), self.push(Op::Unary(Function::Sqrt, base)));
                self.push(Op::Multiply(power, root))
            }
            _ => {
                let exponent = self.constant(exponent.clone());
                self.push(Op::Binary(Function::Powf, base, exponent))
            }
        }
    }

    fn integer_power(&mut self, base: Value, exponent: u64) -> Value {
        let mut power: Option<Value> = None;
        for bit in (0..u64::BITS - exponent.leading_zeros()).rev() {
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

/// A running product over a running product.
#[derive(Default)]
struct Quotient {
    numerator: Option<Value>,
    denominator: Option<Value>,
}

impl Quotient {
    fn multiply(&mut self, builder: &mut Builder, value: Value) {
        self.numerator = Some(times(builder, self.numerator, value));
    }

    fn divide(&mut self, builder: &mut Builder, value: Value) {
        self.denominator = Some(times(builder, self.denominator, value));
    }

    /// The quotient times what is known already.
    fn finish(self, builder: &mut Builder, early: Option<Value>) -> Value {
        let numerator = match (early, self.numerator) {
            (Some(early), Some(numerator)) => builder.push(Op::Multiply(early, numerator)),
            (Some(value), None) | (None, Some(value)) => value,
            (None, None) => builder.constant(1),
        };
        match self.denominator {
            Some(denominator) => builder.push(Op::Divide(numerator, denominator)),
            None => numerator,
        }
    }
}

fn times(builder: &mut Builder, product: Option<Value>, value: Value) -> Value {
    match product {
        Some(product) => builder.push(Op::Multiply(product, value)),
        None => value,
    }
}

/// Whether a number is negative, and its magnitude.
fn split_sign(number: &Rational) -> (bool, Rational) {
    (*number < Rational::ZERO, magnitude(number))
}

/// The magnitude other than one that the constant, unless it is zero, and all coefficients share.
fn common_magnitude(constant: &Rational, terms: &[(Expr, Rational)]) -> Option<Rational> {
    if terms.len() < 2 {
        return None;
    }
    let common = magnitude(&terms[0].1);
    let shared = |number: &Rational| magnitude(number) == common;
    let all = terms.iter().all(|(_, coefficient)| shared(coefficient));
    (!common.is_one() && all && (constant.is_zero() || shared(constant))).then_some(common)
}
