//! Legalises a program for a language: functions that it lacks are written out in those that it has, without a
//! branch, and without a difference that algebra takes for 0.
//!
//! Some languages rearrange formulas: the parser of MOOSE simplifies (1 + x) - 1 to x, and so turns every compensated
//! logarithm into one of the rounded 1 + x. Therefore ln(1 + x) is written as 2^4 ln(1 + y), where x is halved four times as
//! x/(1 + sqrt(1 + x)), and then as a series. x - ln(1 + x) is computed from y by the same steps, as y^2 + 2 (y - ln(1 + y)),
//! a sum of positive terms. exp(x) - 1 is 2 exp(x/2) sinh(x/2), or a series of x/64 squared up. The interpreter runs the
//! lowered program in one precision, and the errors of this run decide how much a check program accepts.

use mms_mechanics::Program;
use mms_program::{Instr, Op, Stage, Value};
use mms_symbolic::expr::{Function, Rational};

/// The number of times that the argument of a logarithm is halved, each time to less than half: ln(1 + x) is twice
/// ln(1 + y) with y = x/(1 + sqrt(1 + x)).
const HALVINGS: u8 = 4;

/// The number of times that the argument of an exponential is halved: with e = exp(x/2) - 1, exp(x) - 1 = e (e + 2).
const SQUARINGS: u8 = 6;

/// The number of terms of the series that are summed.
const TERMS: u8 = 10;

/// A program of the same outputs in which only functions of `has` are called.
pub fn lowered(program: &Program, has: &[Function]) -> Program {
    let mut lowering = Lowering { has, instrs: Vec::new(), stage: Stage::Parameter };
    let mut renamed: Vec<Value> = Vec::with_capacity(program.instrs.len());
    for instr in &program.instrs {
        lowering.stage = instr.stage;
        let at = |value: &Value| renamed[value.index()];
        let value = match &instr.op {
            Op::Unary(function, _, a) => lowering.call(*function, at(a)),
            Op::Binary(function, a, b) => lowering.call_of_two(*function, at(a), at(b)),
            other => lowering.push(other.map(|value| at(&value))),
        };
        renamed.push(value);
    }
    let values = |values: &Vec<Value>| values.iter().map(|it| renamed[it.index()]).collect();
    let outputs = program.outputs.iter().map(|(output, it)| (*output, values(it))).collect();
    Program { instrs: lowering.instrs, outputs }
}

struct Lowering<'a> {
    has: &'a [Function],
    instrs: Vec<Instr>,
    /// The stage of the instruction which is written out.
    stage: Stage,
}

impl Lowering<'_> {
    fn push(&mut self, op: Op) -> Value {
        let value =
            Value(u32::try_from(self.instrs.len()).expect("the node limit bounds programs"));
        self.instrs.push(Instr { op, stage: self.stage });
        value
    }

    fn ratio(&mut self, numerator: u32, denominator: u32) -> Value {
        self.push(Op::Constant(Rational::from_parts(numerator.into(), denominator.into())))
    }

    fn add(&mut self, a: Value, b: Value) -> Value {
        self.push(Op::Add(a, b))
    }

    fn mul(&mut self, a: Value, b: Value) -> Value {
        self.push(Op::Multiply(a, b))
    }

    fn div(&mut self, a: Value, b: Value) -> Value {
        self.push(Op::Divide(a, b))
    }

    fn plus(&mut self, number: u32, a: Value) -> Value {
        let number = self.ratio(number, 1);
        self.add(a, number)
    }

    fn times(&mut self, number: u32, a: Value) -> Value {
        let number = self.ratio(number, 1);
        self.mul(number, a)
    }

    fn half(&mut self, a: Value) -> Value {
        let half = self.ratio(1, 2);
        self.mul(half, a)
    }

    fn call(&mut self, function: Function, x: Value) -> Value {
        if self.has.contains(&function) && !function.takes_turns_off() {
            return self.push(Op::Unary(function, None, x));
        }
        match function {
            Function::Ln1p => {
                let (x, _) = self.halved(x);
                let (s, rest) = self.artanh(x);
                let sum = self.add(s, rest);
                self.times(2 << HALVINGS, sum)
            }
            Function::Ln1pRest => self.ln_1p_rest(x),
            Function::ExpM1 if self.has.contains(&Function::Sinh) => {
                // exp(x) - 1 = 2 exp(x/2) sinh(x/2)
                let x = self.half(x);
                let (exp, sinh) = (self.call(Function::Exp, x), self.call(Function::Sinh, x));
                let product = self.mul(exp, sinh);
                self.times(2, product)
            }
            Function::ExpM1 => self.exp_m1(x),
            Function::Sinh => {
                let minus = self.push(Op::Negate(x));
                let (up, down) = (self.exp_m1(x), self.exp_m1(minus));
                let difference = self.push(Op::Subtract(up, down));
                self.half(difference)
            }
            Function::Cosh => {
                let minus = self.push(Op::Negate(x));
                let (up, down) = (self.call(Function::Exp, x), self.call(Function::Exp, minus));
                let sum = self.add(up, down);
                self.half(sum)
            }
            Function::Tanh => {
                let twice = self.times(2, x);
                let e = self.exp_m1(twice);
                let below = self.plus(2, e);
                self.div(e, below)
            }
            Function::Asin => {
                let complement = self.complement(x);
                self.call_of_two(Function::Atan2, x, complement)
            }
            Function::Acos => {
                let complement = self.complement(x);
                self.call_of_two(Function::Atan2, complement, x)
            }
            Function::Atan => {
                let one = self.ratio(1, 1);
                self.call_of_two(Function::Atan2, x, one)
            }
            Function::Cbrt => {
                // x (x^2)^(-1/3), of either sign; at 0 it has no value.
                let square = self.mul(x, x);
                let ln = self.call(Function::Ln, square);
                let third = self.ratio(1, 3);
                let third = self.mul(third, ln);
                let exp = self.call(Function::Exp, third);
                self.div(x, exp)
            }
            Function::SinPi => self.of_half_turns(Function::Sin, x),
            Function::CosPi => self.of_half_turns(Function::Cos, x),
            Function::Sqrt
            | Function::Exp
            | Function::Ln
            | Function::Sin
            | Function::Cos
            | Function::Tan => unreachable!("every language has {}", function.name()),
            // A value computed in one precision has lost its digits already.
            Function::WithinTurns | Function::WithinTurnsPi => x,
            Function::Atan2 | Function::Powf => unreachable!("a function of two arguments"),
        }
    }

    fn call_of_two(&mut self, function: Function, a: Value, b: Value) -> Value {
        if self.has.contains(&function) || function == Function::Atan2 {
            return self.push(Op::Binary(function, a, b));
        }
        let ln = self.call(Function::Ln, a);
        let exponent = self.mul(b, ln);
        self.call(Function::Exp, exponent)
    }

    fn of_half_turns(&mut self, function: Function, x: Value) -> Value {
        let pi = self.push(Op::Pi);
        let angle = self.mul(pi, x);
        self.call(function, angle)
    }

    /// sqrt((1 - x) (1 + x))
    fn complement(&mut self, x: Value) -> Value {
        let one = self.ratio(1, 1);
        let (below, above) = (self.push(Op::Subtract(one, x)), self.add(one, x));
        let product = self.mul(below, above);
        self.call(Function::Sqrt, product)
    }

    /// The halved argument of a logarithm, and every half on the way.
    fn halved(&mut self, mut x: Value) -> (Value, Vec<Value>) {
        let mut halves = Vec::new();
        for _ in 0..HALVINGS {
            let inner = self.plus(1, x);
            let root = self.call(Function::Sqrt, inner);
            let below = self.plus(1, root);
            x = self.div(x, below);
            halves.push(x);
        }
        (x, halves)
    }

    /// s = x/(2 + x) and artanh(s) - s, of a small x: ln(1 + x) is twice their sum.
    fn artanh(&mut self, x: Value) -> (Value, Value) {
        let below = self.plus(2, x);
        let s = self.div(x, below);
        let square = self.mul(s, s);
        let mut sum = self.ratio(1, 2 * u32::from(TERMS) + 1);
        for n in (1..u32::from(TERMS)).rev() {
            let product = self.mul(sum, square);
            let term = self.ratio(1, 2 * n + 1);
            sum = self.add(product, term);
        }
        let cubed = self.mul(square, s);
        (s, self.mul(cubed, sum))
    }

    /// x - ln(1 + x) = y^2 + 2 (y - ln(1 + y)) with the half y of x: no digits cancel.
    fn ln_1p_rest(&mut self, x: Value) -> Value {
        let (x, halves) = self.halved(x);
        // For the last half, x - 2 s is x s.
        let (s, rest) = self.artanh(x);
        let product = self.mul(x, s);
        let twice = self.times(2, rest);
        let mut result = self.push(Op::Subtract(product, twice));
        for half in halves.into_iter().rev() {
            let square = self.mul(half, half);
            let twice = self.times(2, result);
            result = self.add(square, twice);
        }
        result
    }

    /// exp(x) - 1 by its series for a small part of x, which is then squared up.
    fn exp_m1(&mut self, x: Value) -> Value {
        let part = self.ratio(1, 1 << SQUARINGS);
        let x = self.mul(part, x);
        let mut sum = self.ratio(1, 1);
        for n in (2..=u32::from(TERMS) + 2).rev() {
            let product = self.mul(x, sum);
            let share = self.ratio(1, n);
            let product = self.mul(share, product);
            sum = self.plus(1, product);
        }
        let mut e = self.mul(x, sum);
        for _ in 0..SQUARINGS {
            let other = self.plus(2, e);
            e = self.mul(e, other);
        }
        e
    }
}
