//! The reference interpreter: runs a program in any scalar, stage by stage.

use mms_math::{Double, Scalar};

use crate::operation_cost;
use crate::program::{Instr, Key, Op, Program, Value, range};
use mms_symbolic::expr::{Function, Rational, Small, Stage, Symbol};
use mms_symbolic::work::Work;

/// A scalar that can be made from exact constants.
pub trait Number: Scalar {
    /// The value nearest to `number`.
    ///
    /// The quotient of two integers that the type represents exactly is rounded once, in every precision; other numbers go
    /// through two `f64`. Emitted code does the same.
    fn from_rational(number: &Rational) -> Self {
        nearest(number)
    }

    /// The value nearest to `number`, with more digits.
    fn wide_from_rational(number: &Rational) -> Self::Wide {
        nearest(number)
    }

    /// `self * self`; narrower than the product if the type uses that both are one number.
    fn square(self) -> Self {
        self.clone() * self
    }

    /// The square of a number with more digits.
    fn wide_square(wide: Self::Wide) -> Self::Wide {
        wide.clone() * wide
    }

    /// The numbers of double precision around this one, up to a rounding of the type's own.
    fn bounds(&self) -> [f64; 2];

    /// A number that may be `self` or `other`, such as an interval around both; a type of single numbers returns `self`.
    fn or(self, _other: Self) -> Self {
        self
    }

    /// The steps of an operation, or of a function of this number: see [`mms_symbolic::work`].
    fn steps(&self, _function: Option<Function>) -> u64 {
        1
    }
}

fn nearest<T: Scalar>(number: &Rational) -> T {
    match small_ratio(number) {
        Some((numerator, 1)) => T::from_f64(f64::from(numerator)),
        Some((numerator, denominator)) => T::ratio(numerator, denominator),
        None => {
            let (high, low) = parts(number);
            T::from_parts(high, low)
        }
    }
}

impl Number for f32 {
    fn bounds(&self) -> [f64; 2] {
        [f64::from(*self); 2]
    }
}

impl Number for f64 {
    fn bounds(&self) -> [f64; 2] {
        [*self; 2]
    }
}

impl Number for Double {
    fn bounds(&self) -> [f64; 2] {
        [self.to_f64(); 2]
    }
}

/// Numerator and denominator, if both are exact even in `f32`.
pub fn small_ratio(number: &Rational) -> Option<(i32, i32)> {
    const EXACT: u32 = 1 << 24;
    let numerator = i32::try_from(number.numerator()).ok()?;
    let denominator = i32::try_from(number.denominator()).ok()?;
    let is_exact = |number: i32| number.unsigned_abs() <= EXACT;
    (is_exact(numerator) && is_exact(denominator)).then_some((numerator, denominator))
}

/// The nearest `f64`, and the nearest to the remainder.
pub fn parts(number: &Rational) -> (f64, f64) {
    let high = number.to_f64().value();
    let low = Rational::try_from(high).map_or(0.0, |near| (number - near).to_f64().value());
    (high, low)
}

/// The inputs of a point, except the time.
#[derive(Clone, Copy, Debug)]
pub struct Point<'a, T> {
    /// X, `dimension` components; empty if no output depends on it.
    pub coordinates: &'a [T],
    /// N, `dimension` components; empty if no traction is computed.
    pub normal: &'a [T],
    /// H, row-major; empty if no response is computed.
    pub gradient: &'a [T],
}

impl<'a, T> Point<'a, T> {
    /// A point with a reference position only.
    pub fn at(coordinates: &'a [T]) -> Self {
        Point { coordinates, normal: &[], gradient: &[] }
    }
}

/// A program prepared for one set of parameters.
#[derive(Clone, Debug)]
pub struct Interpreter<'a, T: Number, K> {
    program: &'a Program<K>,
    run: Run<'a, T>,
}

impl<'a, T: Number, K: Key> Interpreter<'a, T, K> {
    /// Runs the Parameter stage. `parameters` are in the order of the field file.
    pub fn new(program: &'a Program<K>, parameters: &[T]) -> Self {
        Self::prepared(program, parameters, None, 1)
    }

    /// Prepares like [`Interpreter::new`], within a budget of work: once it is spent, no value is a number.
    pub fn within(work: &'a Work, program: &'a Program<K>, parameters: &[T]) -> Self {
        Self::prepared(program, parameters, Some(work), 1)
    }

    /// Prepares like [`Interpreter::within`], for a scalar whose operations are charged `times` their steps.
    pub fn as_many(work: &'a Work, program: &'a Program<K>, parameters: &[T], times: u64) -> Self {
        Self::prepared(program, parameters, Some(work), times)
    }

    fn prepared(
        program: &'a Program<K>,
        parameters: &[T],
        work: Option<&'a Work>,
        times: u64,
    ) -> Self {
        Interpreter { program, run: Run::new(&program.instrs, parameters, work, times) }
    }

    /// Charges every further operation `times` its steps.
    pub fn charge(&mut self, times: u64) {
        self.run.times = times;
    }

    /// Runs the Time stage.
    pub fn set_time(&mut self, time: &T) {
        self.run.once(Stage::Time, &|symbol| match symbol {
            Symbol::Time => time.clone(),
            _ => unreachable!("the Time stage reads the time only"),
        });
    }

    /// The instructions that some outputs need: computed once, and passed to every evaluation.
    pub fn plan(&self, outputs: &[K]) -> Vec<bool> {
        self.program.needed(outputs)
    }

    /// Runs the Point and PointTime stages of a plan.
    pub fn set_point(&mut self, plan: &[bool], point: Point<'_, T>) {
        self.run.at_point(plan, point);
    }

    /// Runs a plan like [`Interpreter::set_point`], for a program with other leaves: the caller has the value of each.
    pub fn set_leaves(&mut self, plan: &[bool], leaf: &dyn Fn(Symbol) -> T) {
        self.run.at_leaves(plan, leaf);
    }

    /// The components of an output that has been planned and run; a tensor is row-major.
    pub fn output(&self, output: K) -> Vec<T> {
        self.run.components(self.program.outputs.get(&output).map_or(&[][..], Vec::as_slice))
    }
}

/// An interpreter without keys of outputs: it is compiled once for each scalar, for all key types.
#[derive(Clone, Debug)]
struct Run<'a, T: Number> {
    instrs: &'a [Instr],
    values: Vec<T>,
    /// The values of the stages Parameter and Time, which are rounded at the end of the stage.
    once: Vec<T::Wide>,
    /// The budget, if there is one: once it is spent, values are not numbers.
    work: Option<&'a Work>,
    /// The factor by which the charged steps of an operation are multiplied.
    times: u64,
}

impl<'a, T: Number> Run<'a, T> {
    fn new(instrs: &'a [Instr], parameters: &[T], work: Option<&'a Work>, times: u64) -> Self {
        let values = vec![T::from_f64(0.0); instrs.len()];
        let once = vec![T::Wide::from_f64(0.0); range(instrs, Stage::Point).start];
        let mut run = Run { instrs, values, once, work, times };
        run.once(Stage::Parameter, &|symbol| match symbol {
            Symbol::Parameter(index) => parameters[index].clone(),
            _ => unreachable!("the Parameter stage reads parameters only"),
        });
        run
    }

    /// Runs a stage with more digits, and then rounds it.
    fn once(&mut self, stage: Stage, input: &dyn Fn(Symbol) -> T) {
        for index in range(self.instrs, stage) {
            if self.is_over(index) {
                self.once[index] = T::Wide::from_f64(f64::NAN);
                self.values[index] = T::from_f64(f64::NAN);
                continue;
            }
            let op = &self.instrs[index].op;
            let input = |symbol| input(symbol).widen();
            self.once[index] = apply(op, &self.once, T::wide_from_rational, T::wide_square, &input);
            self.values[index] = T::narrow(self.once[index].clone());
        }
    }

    fn at_point(&mut self, plan: &[bool], point: Point<'_, T>) {
        let dimension = point.gradient.len().isqrt();
        self.at_leaves(plan, &|symbol| match symbol {
            Symbol::Coordinate(axis) => point.coordinates[axis].clone(),
            Symbol::Normal(axis) => point.normal[axis].clone(),
            Symbol::Gradient(row, column) => point.gradient[row * dimension + column].clone(),
            _ => unreachable!("earlier stages have run"),
        });
    }

    fn at_leaves(&mut self, plan: &[bool], leaf: &dyn Fn(Symbol) -> T) {
        let stages = [Stage::Point, Stage::PointTime].map(|stage| range(self.instrs, stage));
        for index in stages.into_iter().flatten().filter(|index| plan[*index]) {
            if self.is_over(index) {
                self.values[index] = T::from_f64(f64::NAN);
                continue;
            }
            let op = &self.instrs[index].op;
            self.values[index] = apply(op, &self.values, T::from_rational, T::square, leaf);
        }
    }

    fn components(&self, values: &[Value]) -> Vec<T> {
        values.iter().map(|value| self.values[value.index()].clone()).collect()
    }

    /// Charges an instruction to the budget; returns true if the budget is spent.
    fn is_over(&self, index: usize) -> bool {
        let Some(work) = self.work else { return false };
        if work.is_over() {
            return true;
        }
        let steps = match &self.instrs[index].op {
            Op::Unary(function, _, a) | Op::Binary(function, a, _) => {
                self.values[a.index()].steps(Some(*function))
            }
            Op::Constant(number) => {
                self.values[index].steps(None) + operation_cost::of_constant(number)
            }
            _ => self.values[index].steps(None),
        };
        work.spend(self.times * steps);
        false
    }
}

/// One operation on the values before it.
pub fn apply<T: Scalar>(
    op: &Op,
    values: &[T],
    constant: fn(&Rational) -> T,
    square: fn(T) -> T,
    input: &dyn Fn(Symbol) -> T,
) -> T {
    let of = |value: &Value| values[value.index()].clone();
    match op {
        Op::Constant(number) => constant(number),
        Op::Pi => T::pi(),
        Op::Input(symbol) => input(*symbol),
        Op::Add(a, b) => of(a) + of(b),
        Op::Subtract(a, b) => of(a) - of(b),
        Op::Multiply(a, b) if a == b => square(of(a)),
        Op::Multiply(a, b) => of(a) * of(b),
        Op::Divide(a, b) => of(a) / of(b),
        Op::Negate(a) => -of(a),
        Op::Unary(function, small, a) => unary(*function, *small, of(a)),
        Op::Binary(function, a, b) => binary(*function, of(a), of(b)),
    }
}

macro_rules! evaluate {
    (
        one { $($one:ident $one_method:ident $one_at_zero:tt $one_doc:literal,)* }
        two { $($two:ident $two_method:ident $two_at_zero:tt $two_doc:literal,)* }
    ) => {
        /// A function of one argument, with an optional proved bound of it.
        pub fn unary<T: Scalar>(function: Function, small: Option<Small>, x: T) -> T {
            match (function, small) {
                (Function::Sin, Some(Small::NearZero)) => x.sin_near_zero(),
                (Function::Cos, Some(Small::NearZero)) => x.cos_near_zero(),
                (Function::Sin, Some(Small::WithinOne)) => x.sin_within_one(),
                (Function::Cos, Some(Small::WithinOne)) => x.cos_within_one(),
                $((Function::$one, _) => x.$one_method(),)*
                $((Function::$two, _))|* => unreachable!("a function of two arguments"),
            }
        }

        /// A function of two arguments.
        pub fn binary<T: Scalar>(function: Function, a: T, b: T) -> T {
            match function {
                $(Function::$two => a.$two_method(b),)*
                _ => unreachable!("a function of one argument"),
            }
        }
    };
}

mms_symbolic::for_functions!(evaluate);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_single_precision_does_not_hold_is_no_small_ratio() {
        let exact = 1 << 24;
        assert_eq!(small_ratio(&Rational::from(-exact)), Some((-exact, 1)));
        assert_eq!(small_ratio(&Rational::from(exact + 1)), None);
        assert_eq!(small_ratio(&Rational::from(i32::MIN)), None);
    }
}
