//! Canonical construction: the only way to make a node.
//!
//! The constructors fold exact values, and expand no product. Each rule is sound wherever its left-hand side is defined, none
//! rounds, and none adds operations. Rules that need more knowledge, such as exp(ln x) = x, are omitted: they would enlarge a
//! domain.
//!
//! | rule | where |
//! |---|---|
//! | terms of a sum with one base are collected; a sum in a sum is opened | always |
//! | x^a x^b = x^(a+b) | where the left side is defined; the right side may be defined at more points, so `mms check` evaluates u as it is written, too |
//! | (x^a)^n = x^(a n), (x y)^n = x^n y^n | n an integer |
//! | (c x)^e = c^e x^e | c a positive number, and c^e rational |
//! | a number to a rational power is that number | it is rational, and no longer than 16 kbit |
//! | sqrt x = x^(1/2) | always |
//! | f(0) is a number, ln 1 = 0, sin and cos at multiples of pi/2 | the value is rational |
//! | ln(1 + x) = ln_1p(x) | always |
//! | sin(-x) = -sin x, cos(-x) = cos x | always; the sign comes from the leading coefficient |

use dashu_int::ops::{BitTest as _, Gcd as _};
use dashu_int::{IBig, UBig};

use super::{Expr, Function, Graph, HALF, Node, Rational, Small, Symbol, is_negative, magnitude};
use crate::sorted::SortedMap;

/// Powers of numbers are folded up to about this many bits; longer ones stay symbolic.
const FOLDED_BITS: usize = 1 << 14;

/// The steps of collecting a term.
const STEPS_OF_TERM: u64 = 10;

/// The longest number of a node, in bits: beyond it the graph is exhausted.
const MAX_BITS: usize = 1 << 17;

impl Graph {
    /// An exact number.
    pub fn number(&mut self, value: impl Into<Rational>) -> Expr {
        self.intern(Node::Number(value.into()))
    }

    /// pi.
    pub fn pi(&mut self) -> Expr {
        self.intern(Node::Pi)
    }

    /// A leaf.
    pub fn symbol(&mut self, symbol: Symbol) -> Expr {
        self.intern(Node::Symbol(symbol))
    }

    /// `a + b`.
    pub fn add(&mut self, a: Expr, b: Expr) -> Expr {
        self.sum([(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// `a - b`.
    pub fn sub(&mut self, a: Expr, b: Expr) -> Expr {
        self.sum([(a, Rational::ONE), (b, Rational::NEG_ONE)])
    }

    /// `factor * a` for an exact number.
    pub fn scale(&mut self, a: Expr, factor: impl Into<Rational>) -> Expr {
        self.sum([(a, factor.into())])
    }

    /// `a * b`.
    pub fn mul(&mut self, a: Expr, b: Expr) -> Expr {
        self.product([(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// `a / b`.
    pub fn div(&mut self, a: Expr, b: Expr) -> Expr {
        self.product([(a, Rational::ONE), (b, Rational::NEG_ONE)])
    }

    /// `base ^ exponent` for an exact exponent.
    pub fn power(&mut self, base: Expr, exponent: impl Into<Rational>) -> Expr {
        self.product([(base, exponent.into())])
    }

    /// The sum of expressions times exact coefficients.
    pub fn sum(&mut self, terms: impl IntoIterator<Item = (Expr, Rational)>) -> Expr {
        if self.is_exhausted() {
            return self.exhaust();
        }
        let mut constant = Rational::ZERO;
        let mut open = Vec::<(Expr, Rational)>::new();
        for (expr, coefficient) in terms {
            match self.node(expr) {
                Node::Number(number) => constant += times(number, &coefficient),
                Node::Sum(inner_constant, inner) => {
                    if !inner_constant.is_zero() {
                        constant += times(inner_constant, &coefficient);
                    }
                    let scaled = |(term, own): &(Expr, Rational)| (*term, times(own, &coefficient));
                    open.extend(inner.iter().map(scaled));
                }
                _ => open.push((expr, coefficient)),
            }
        }
        let terms = collected(open);
        let steps = |number: &Rational| STEPS_OF_TERM + steps_of_length(number);
        self.work.spend(steps(&constant) + terms.iter().map(|(_, it)| steps(it)).sum::<u64>());
        if is_long(&constant) || terms.iter().any(|(_, coefficient)| is_long(coefficient)) {
            return self.exhaust();
        }
        match terms.as_slice() {
            [] => self.number(constant),
            [(term, one)] if constant.is_zero() && one.is_one() => *term,
            _ => self.intern(Node::Sum(constant, terms)),
        }
    }

    /// The product of expressions to exact exponents.
    pub fn product(&mut self, factors: impl IntoIterator<Item = (Expr, Rational)>) -> Expr {
        if self.is_exhausted() {
            return self.exhaust();
        }
        let mut collector = Collector::default();
        collector.open.extend(factors);
        // A lone sum stays as written; as one of several factors it is normalised.
        if let [(expr, exponent)] = collector.open.as_slice()
            && exponent.is_one()
        {
            return *expr;
        }
        let (coefficient, factors) = collector.collect(self);
        if let Some(division) = factors.iter().find(|(base, _)| self.is_zero(*base)) {
            // A division by zero stays one, times any factors.
            return self.intern(Node::Product(vec![division.clone()]));
        }
        let product = match factors.as_slice() {
            [] => self.number(Rational::ONE),
            [(base, one)] if one.is_one() => *base,
            _ => self.intern(Node::Product(factors)),
        };
        self.scale(product, coefficient)
    }

    /// An elementary function, folded if its value is known exactly.
    pub fn call(&mut self, function: Function, arguments: &[Expr]) -> Expr {
        let [argument, ..] = *arguments else { unreachable!("every function has an argument") };
        if let Some(folded) = self.fold_call(function, argument) {
            return folded;
        }
        self.intern(Node::Call(function, arguments.to_vec()))
    }

    /// A coordinate less a place; an ordinary difference if the first operand is no coordinate.
    pub fn offset(&mut self, coordinate: Expr, place: Expr) -> Expr {
        let is_coordinate = matches!(self.node(coordinate), Node::Symbol(Symbol::Coordinate(_)));
        match is_coordinate && !self.is_zero(place) {
            true => self.intern(Node::Offset([coordinate, place])),
            false => self.sub(coordinate, place),
        }
    }

    /// An angle with the proved bound of its magnitude.
    pub fn small(&mut self, small: Small, angle: Expr) -> Expr {
        self.intern(Node::Small(small, angle))
    }

    fn fold_call(&mut self, function: Function, argument: Expr) -> Option<Expr> {
        if function == Function::Sqrt {
            return Some(self.power(argument, HALF));
        }
        if let Some(at_zero) = function.at_zero()
            && self.is_zero(argument)
        {
            return Some(self.number(at_zero));
        }
        match function {
            Function::Ln if self.as_number(argument).is_some_and(Rational::is_one) => {
                Some(self.number(Rational::ZERO))
            }
            Function::Ln => {
                let Node::Sum(constant, terms) = self.node(argument) else { return None };
                if !constant.is_one() {
                    return None;
                }
                let terms = terms.clone();
                let rest = self.sum(terms);
                Some(self.call(Function::Ln1p, &[rest]))
            }
            // ln(1 + (x - 1)) is ln x, which is as exact and saves a subtraction.
            Function::Ln1p => {
                let Node::Sum(constant, terms) = self.node(argument) else { return None };
                if *constant != Rational::NEG_ONE {
                    return None;
                }
                let terms = terms.clone();
                let whole = self.sum(terms);
                Some(self.call(Function::Ln, &[whole]))
            }
            Function::Sin | Function::Cos => self.fold_circular(function, argument),
            _ => None,
        }
    }

    /// sin and cos at multiples of pi/2, and of an argument with a leading minus sign.
    fn fold_circular(&mut self, function: Function, argument: Expr) -> Option<Expr> {
        if let Some(turns) = self.quarter_turns(argument) {
            // sin(n pi/2) runs through 0 1 0 -1, and the cosine is a quarter turn ahead.
            let phase = if function == Function::Sin { turns } else { (turns + 1) % 4 };
            return Some(self.number([0, 1, 0, -1][phase as usize]));
        }
        if !self.leads_with_minus(argument) {
            return None;
        }
        let positive = self.scale(argument, -1);
        let value = self.call(function, &[positive]);
        Some(if function == Function::Sin { self.scale(value, -1) } else { value })
    }

    fn quarter_turns(&self, angle: Expr) -> Option<u8> {
        let turns = match self.node(angle) {
            Node::Pi => Rational::from(2),
            Node::Sum(constant, terms) if constant.is_zero() => match terms.as_slice() {
                [(term, factor)] if *self.node(*term) == Node::Pi => factor * Rational::from(2),
                _ => return None,
            },
            _ => return None,
        };
        let (numerator, denominator) = turns.into_parts();
        if !denominator.is_one() {
            return None;
        }
        let four = IBig::from(4);
        let turns: IBig = ((numerator % &four) + &four) % &four;
        u8::try_from(turns).ok()
    }

    /// Whether the first term of a sum is subtracted.
    pub fn leads_with_minus(&self, expr: Expr) -> bool {
        let Node::Sum(constant, terms) = self.node(expr) else { return false };
        let leading = terms.first().map_or(constant, |(_, coefficient)| coefficient);
        is_negative(leading)
    }

    /// The number `c` and the sum `s` with `expr = c s`, where all multiples of `expr` have the same `s`: its first coefficient
    /// is positive, and as many coefficients as possible are 1 or -1. If several multiples have equally many, `s` has coprime
    /// integers.
    pub fn split_content(&mut self, expr: Expr) -> (Rational, Expr) {
        let Node::Sum(constant, terms) = self.node(expr) else {
            return (Rational::ONE, expr);
        };
        if let Some(known) = self.contents.get(&expr) {
            return known.clone();
        }
        let mut divisor = constant.clone();
        for (_, coefficient) in terms {
            divisor = gcd(&divisor, coefficient);
        }
        let mut counts = SortedMap::<Rational, usize>::new();
        for (_, coefficient) in terms {
            *counts.get_or_default(magnitude(coefficient)) += 1;
        }
        let ones = |content: &Rational| counts.get(content).copied().unwrap_or(0);
        let mut content = divisor;
        for (_, coefficient) in terms {
            let candidate = magnitude(coefficient);
            if ones(&candidate) > ones(&content) {
                content = candidate;
            }
        }
        if self.leads_with_minus(expr) {
            content = -content;
        }
        let primitive = self.scale(expr, Rational::ONE / &content);
        self.contents.insert(expr, (content.clone(), primitive));
        self.contents.insert(primitive, (Rational::ONE, primitive));
        (content, primitive)
    }
}

/// a b.
fn times(a: &Rational, b: &Rational) -> Rational {
    if b.is_one() {
        a.clone()
    } else if a.is_one() {
        b.clone()
    } else {
        a * b
    }
}

/// Sorts terms or factors, adds up the numbers of equal ones, and drops zeros.
fn collected(mut open: Vec<(Expr, Rational)>) -> Vec<(Expr, Rational)> {
    if !open.is_sorted_by(|(a, _), (b, _)| a < b) {
        open.sort_by_key(|(expr, _)| *expr);
        open.dedup_by(|(expr, number), (last, total)| {
            let is_same = expr == last;
            if is_same {
                *total += std::mem::take(number);
            }
            is_same
        });
    }
    open.retain(|(_, number)| !number.is_zero());
    open
}

/// Collects the factors of a product until none of them can be opened further.
#[derive(Default)]
struct Collector {
    open: Vec<(Expr, Rational)>,
    coefficient: Option<Rational>,
    factors: Vec<(Expr, Rational)>,
}

impl Collector {
    fn collect(mut self, graph: &mut Graph) -> (Rational, Vec<(Expr, Rational)>) {
        loop {
            while let Some((base, exponent)) = self.open.pop() {
                self.take(graph, base, exponent);
            }
            self.factors = collected(self.factors);
            // Exponents that were added may have become integers: x^(1/2) x^(1/2) opens x.
            let is_openable =
                |(base, exponent): &mut (Expr, Rational)| opens(graph, *base, exponent);
            self.open.extend(self.factors.extract_if(.., is_openable));
            if self.open.is_empty() {
                break;
            }
        }
        (self.coefficient.unwrap_or(Rational::ONE), self.factors)
    }

    fn take(&mut self, graph: &mut Graph, base: Expr, exponent: Rational) {
        if exponent.is_zero() {
            return;
        }
        match graph.node(base) {
            Node::Number(number) => match number_power(number, &exponent) {
                Some(power) => self.multiply(power),
                None => self.keep(base, exponent),
            },
            Node::Product(factors) if exponent.is_int() => {
                let powers = factors.iter().map(|(base, inner)| (*base, times(inner, &exponent)));
                self.open.extend(powers);
            }
            Node::Sum(..) if exponent.is_int() => self.take_sum(graph, base, exponent),
            Node::Sum(constant, terms) if constant.is_zero() && terms.len() == 1 => {
                // (c x)^e = c^e x^e for c > 0, and (|c| (-x))^e otherwise.
                let (term, coefficient) = terms[0].clone();
                if coefficient > Rational::ZERO {
                    let coefficient = graph.number(coefficient);
                    self.open.push((coefficient, exponent.clone()));
                    self.open.push((term, exponent));
                } else {
                    self.keep(base, exponent);
                }
            }
            _ => self.keep(base, exponent),
        }
    }

    fn take_sum(&mut self, graph: &mut Graph, sum: Expr, exponent: Rational) {
        let (content, primitive) = graph.split_content(sum);
        match number_power(&content, &exponent) {
            Some(power) => {
                self.multiply(power);
                if matches!(graph.node(primitive), Node::Product(_)) {
                    self.open.push((primitive, exponent));
                } else {
                    self.keep(primitive, exponent);
                }
            }
            None => self.keep(sum, exponent),
        }
    }

    fn keep(&mut self, base: Expr, exponent: Rational) {
        self.factors.push((base, exponent));
    }

    fn multiply(&mut self, number: Rational) {
        self.coefficient = Some(match self.coefficient.take() {
            Some(coefficient) => times(&coefficient, &number),
            None => number,
        });
    }
}

/// Whether a base with this exponent is more than one canonical factor.
fn opens(graph: &Graph, base: Expr, exponent: &Rational) -> bool {
    if !exponent.is_int() {
        return false;
    }
    match graph.node(base) {
        Node::Product(_) => true,
        Node::Number(number) => number_power(number, exponent).is_some(),
        Node::Sum(constant, terms) => match terms.as_slice() {
            [(_, factor)] => constant.is_zero() && number_power(factor, exponent).is_some(),
            _ => false,
        },
        _ => false,
    }
}

/// The steps of adding or multiplying a number of this length, including the common divisor of two such numbers.
pub fn steps_of_length(number: &Rational) -> u64 {
    let bits = number.numerator().bit_len() + number.denominator().bit_len();
    let words = (bits / 64) as u64;
    words * words / 4
}

fn is_long(number: &Rational) -> bool {
    number.numerator().bit_len().max(number.denominator().bit_len()) > MAX_BITS
}

/// The greatest common divisor of two rationals: both are integer multiples of it.
fn gcd(a: &Rational, b: &Rational) -> Rational {
    if a.is_zero() {
        return magnitude(b);
    }
    if b.is_zero() {
        return gcd(b, a);
    }
    let numerator = a.numerator().gcd(b.numerator());
    let denominator = a.denominator() * b.denominator() / a.denominator().gcd(b.denominator());
    Rational::from_parts(numerator.into(), denominator)
}

/// `number ^ exponent` if it is rational and not too long.
fn number_power(number: &Rational, exponent: &Rational) -> Option<Rational> {
    if number.is_one() || exponent.is_one() {
        return Some(number.clone());
    }
    let root = usize::try_from(exponent.denominator()).ok()?;
    let power = isize::try_from(exponent.numerator()).ok()?;
    if number.is_zero() {
        return (power > 0).then_some(Rational::ZERO);
    }
    if root > 1 && *number < Rational::ZERO {
        return None;
    }
    let numerator = exact_root(number.numerator().clone(), root)?;
    let denominator = exact_root(number.denominator().clone().into(), root)?;
    let bits = numerator.bit_len().max(denominator.bit_len());
    let count = power.unsigned_abs();
    if bits > 1 && count.saturating_mul(bits) > FOLDED_BITS {
        return None;
    }
    let (numerator, denominator) = (numerator.pow(count), denominator.pow(count));
    Some(if power < 0 {
        Rational::from_parts_signed(denominator, numerator)
    } else {
        Rational::from_parts_signed(numerator, denominator)
    })
}

/// The root of an integer, if it is an integer. A negative number only has a first root.
fn exact_root(value: IBig, root: usize) -> Option<IBig> {
    if root == 1 {
        return Some(value);
    }
    let magnitude = UBig::try_from(value).ok()?;
    if magnitude.bit_len() > FOLDED_BITS {
        return None;
    }
    let floor = magnitude.nth_root(root);
    (floor.pow(root) == magnitude).then(|| floor.into())
}
