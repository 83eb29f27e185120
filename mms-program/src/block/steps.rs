//! The steps of a plan as loops over a block.
//!
//! A step costs one `match` for a block, and then loops without branches over pieces of 16 or 32 numbers, which are written as
//! a whole. So the compiler makes vector instructions of each without tests whether columns overlap, and nothing is `unsafe`.
//! Sums, products, quotients and roots are in one function for each instruction set, which runs step after step; every
//! elementary function is compiled separately, since the compiler loads all coefficients of a function first.

use std::ops::Range;

use mms_math::Scalar;
use mms_math::batch::{Float, Lift};
use mms_math::dispatch::Work;
use mms_math::simd::Simd;

use super::BlockMode;
use super::column::Column;
use super::plan::{BlockPlan, BlockStep, Operand, StepKind};
use crate::interpret;
use mms_symbolic::expr::{Function, Small};

/// The numbers that steps read and write.
struct Registers<'a, T, const C: usize, const K: usize> {
    scalars: &'a [T],
    columns: &'a mut [Column<T, C, K>],
    /// The number of pieces of a column to compute.
    pieces: usize,
}

impl<T: Copy, const C: usize, const K: usize> Registers<'_, T, C, K> {
    /// The column of a result, and the columns of its operands, which the plan makes distinct.
    #[inline(always)]
    fn of<const N: usize>(
        &mut self,
        result: u32,
        operands: [u32; N],
    ) -> (&mut [[T; C]], [&[[T; C]]; N]) {
        let pieces = self.pieces.min(K);
        let (below, rest) = self.columns.split_at_mut(result as usize);
        let (result, above) = rest.split_first_mut().expect("a register for each result");
        let column = |place: u32| {
            let place = place as usize;
            let column = match below.get(place) {
                Some(column) => column,
                None => &above[place - below.len() - 1],
            };
            &column.0[..pieces]
        };
        (&mut result.0[..pieces], std::array::from_fn(|k| column(operands[k])))
    }

    #[inline(always)]
    fn scalar<S: Lift<T>>(&self, place: u32) -> S {
        S::splat(self.scalars[place as usize])
    }

    #[inline(always)]
    fn one<S: Lift<T>>(&mut self, step: &BlockStep, function: impl Fn(S) -> S) {
        let (result, [a]) = self.of(step.result, [step.operands[0]]);
        one(result, a, function);
    }

    #[inline(always)]
    fn two<S: Lift<T>>(
        &mut self,
        step: &BlockStep,
        places: [usize; 2],
        function: impl Fn(S, S) -> S,
    ) {
        let (result, [a, b]) = self.of(step.result, places.map(|place| step.operands[place]));
        two(result, a, b, function);
    }

    #[inline(always)]
    fn three<S: Lift<T>>(&mut self, step: &BlockStep, function: impl Fn(S, S, S) -> S) {
        let (result, [a, b, c]) = self.of(step.result, step.operands);
        for (((result, a), b), c) in result.iter_mut().zip(a).zip(b).zip(c) {
            let mut found = *a;
            for k in 0..C {
                let [a, b, c] = [a[k], b[k], c[k]];
                let [a, b, c] = [S::splat(a), S::splat(b), S::splat(c)];
                found[k] = function(a, b, c).value();
            }
            *result = found;
        }
    }

    /// Runs a step that is no elementary function.
    #[inline(always)]
    fn step<S: Lift<T>>(&mut self, step: &BlockStep) {
        let [a, b, c] = step.operands;
        match step.kind {
            StepKind::Fill => {
                let value = self.scalars[a as usize];
                let (result, []) = self.of(step.result, []);
                result.fill([value; C]);
            }
            StepKind::Add => self.two(step, [0, 1], |a: S, b: S| a + b),
            StepKind::AddScalar => {
                let b: S = self.scalar(b);
                self.one(step, |a: S| a + b);
            }
            StepKind::Subtract => self.two(step, [0, 1], |a: S, b: S| a - b),
            StepKind::SubtractFrom => {
                let b: S = self.scalar(b);
                self.one(step, |a: S| b - a);
            }
            StepKind::Multiply => self.two(step, [0, 1], |a: S, b: S| a * b),
            StepKind::Scale => {
                let b: S = self.scalar(b);
                self.one(step, |a: S| a * b);
            }
            StepKind::Divide => self.two(step, [0, 1], |a: S, b: S| a / b),
            StepKind::DivideBy => {
                let b: S = self.scalar(b);
                self.one(step, |a: S| a / b);
            }
            StepKind::DivideInto => {
                let b: S = self.scalar(b);
                self.one(step, |a: S| b / a);
            }
            StepKind::Negate => self.one(step, |a: S| -a),
            StepKind::Root => self.one(step, |a: S| a.sqrt()),
            StepKind::MultiplyAdd => self.three(step, |a: S, b: S, c: S| a.mul_add(b, c)),
            StepKind::MultiplySubtract => self.three(step, |a: S, b: S, c: S| a.mul_add(b, -c)),
            StepKind::SubtractProduct => self.three(step, |a: S, b: S, c: S| (-a).mul_add(b, c)),
            StepKind::MultiplyAddScalar => {
                let c: S = self.scalar(c);
                self.two(step, [0, 1], |a: S, b: S| a.mul_add(b, c));
            }
            StepKind::SubtractProductFrom => {
                let c: S = self.scalar(c);
                self.two(step, [0, 1], |a: S, b: S| (-a).mul_add(b, c));
            }
            StepKind::ScaleAdd => {
                let b: S = self.scalar(b);
                self.two(step, [0, 2], |a: S, c: S| a.mul_add(b, c));
            }
            StepKind::ScaleSubtract => {
                let b: S = self.scalar(b);
                self.two(step, [0, 2], |a: S, c: S| a.mul_add(b, -c));
            }
            StepKind::ScaleAddScalar => {
                let [b, c]: [S; 2] = [self.scalar(b), self.scalar(c)];
                self.one(step, |a: S| a.mul_add(b, c));
            }
            StepKind::Unary(..) | StepKind::Binary(_) => {
                unreachable!("functions are parts of their own")
            }
        }
    }
}

#[inline(always)]
fn one<T: Copy, S: Lift<T>, const C: usize>(
    result: &mut [[T; C]],
    a: &[[T; C]],
    function: impl Fn(S) -> S,
) {
    for (result, a) in result.iter_mut().zip(a) {
        let mut found = *a;
        for k in 0..C {
            found[k] = function(S::splat(a[k])).value();
        }
        *result = found;
    }
}

#[inline(always)]
fn two<T: Copy, S: Lift<T>, const C: usize>(
    result: &mut [[T; C]],
    a: &[[T; C]],
    b: &[[T; C]],
    function: impl Fn(S, S) -> S,
) {
    for ((result, a), b) in result.iter_mut().zip(a).zip(b) {
        let mut found = *a;
        for k in 0..C {
            found[k] = function(S::splat(a[k]), S::splat(b[k])).value();
        }
        *result = found;
    }
}

/// The steps between functions.
struct Arithmetic<'a, 'b, T, const C: usize, const K: usize> {
    steps: &'a [BlockStep],
    registers: &'a mut Registers<'b, T, C, K>,
}

impl<T: Float, const C: usize, const K: usize> Work<T> for Arithmetic<'_, '_, T, C, K> {
    type Output = ();

    #[inline(always)]
    fn on<M: Simd<T>>(self, _: M) {
        for step in self.steps {
            self.registers.step::<M::Lane>(step);
        }
    }
}

/// A function of one argument at all points of a block.
struct Unary<'a, T, F, const C: usize> {
    function: F,
    result: &'a mut [[T; C]],
    argument: &'a [[T; C]],
}

impl<T: Float, F: OfOne, const C: usize> Work<T> for Unary<'_, T, F, C> {
    type Output = ();

    #[inline(always)]
    fn on<M: Simd<T>>(self, _: M) {
        one::<T, M::Lane, C>(self.result, self.argument, |x| self.function.at(x));
    }
}

/// A function of two arguments at all points of a block.
struct Binary<'a, T, F, const C: usize> {
    function: F,
    result: &'a mut [[T; C]],
    arguments: [&'a [[T; C]]; 2],
}

impl<T: Float, F: OfTwo, const C: usize> Work<T> for Binary<'_, T, F, C> {
    type Output = ();

    #[inline(always)]
    fn on<M: Simd<T>>(self, _: M) {
        let [a, b] = self.arguments;
        two::<T, M::Lane, C>(self.result, a, b, |a, b| self.function.at(a, b));
    }
}

trait OfOne {
    fn at<S: Scalar>(&self, x: S) -> S;
}

trait OfTwo {
    fn at<S: Scalar>(&self, a: S, b: S) -> S;
}

macro_rules! methods {
    ($($name:ident $method:ident)*) => {
        $(
            struct $name;
            impl OfOne for $name {
                #[inline(always)]
                fn at<S: Scalar>(&self, x: S) -> S {
                    x.$method()
                }
            }
        )*
    };
}

methods! {
    SinNearZero sin_near_zero
    CosNearZero cos_near_zero
    SinWithinOne sin_within_one
    CosWithinOne cos_within_one
}

macro_rules! functions {
    (
        one { $($one:ident $one_method:ident $one_at_zero:tt $one_doc:literal,)* }
        two { $($two:ident $two_method:ident $two_at_zero:tt $two_doc:literal,)* }
    ) => {
        methods! { $($one $one_method)* }
        $(
            struct $two;
            impl OfTwo for $two {
                #[inline(always)]
                fn at<S: Scalar>(&self, a: S, b: S) -> S {
                    a.$two_method(b)
                }
            }
        )*

        fn unary<T: Float, const C: usize>(
            (function, small): (Function, Option<Small>),
            mode: BlockMode,
            result: &mut [[T; C]],
            argument: &[[T; C]],
        ) {
            match (function, small) {
                (Function::Sin, Some(Small::NearZero)) => {
                    mode.run(Unary { function: SinNearZero, result, argument });
                }
                (Function::Cos, Some(Small::NearZero)) => {
                    mode.run(Unary { function: CosNearZero, result, argument });
                }
                (Function::Sin, Some(Small::WithinOne)) => {
                    mode.run(Unary { function: SinWithinOne, result, argument });
                }
                (Function::Cos, Some(Small::WithinOne)) => {
                    mode.run(Unary { function: CosWithinOne, result, argument });
                }
                $((Function::$one, _) => mode.run(Unary { function: $one, result, argument }),)*
                $((Function::$two, _))|* => unreachable!("a function of two arguments"),
            }
        }

        fn binary<T: Float, const C: usize>(
            function: Function,
            mode: BlockMode,
            result: &mut [[T; C]],
            arguments: [&[[T; C]]; 2],
        ) {
            match function {
                $(Function::$two => mode.run(Binary { function: $two, result, arguments }),)*
                _ => unreachable!("a function of one argument"),
            }
        }
    };
}

mms_symbolic::for_functions!(functions);

/// Runs some parts of a plan with the quick functions, over the first pieces of a block.
pub(super) fn quickly<T: Float, const C: usize, const K: usize>(
    (plan, parts): (&BlockPlan, Range<usize>),
    mode: BlockMode,
    scalars: &[T],
    columns: &mut [Column<T, C, K>],
    pieces: usize,
) {
    let mut registers = Registers { scalars, columns, pieces };
    for part in &plan.parts[parts] {
        let steps = &plan.steps[part.clone()];
        let BlockStep { kind, result, operands: [a, b, _] } = steps[0];
        match kind {
            StepKind::Unary(function, small) => {
                let (result, [argument]) = registers.of(result, [a]);
                unary((function, small), mode, result, argument);
            }
            StepKind::Binary(function) => {
                let (result, arguments) = registers.of(result, [a, b]);
                binary(function, mode, result, arguments);
            }
            _ => mode.run(Arithmetic { steps, registers: &mut registers }),
        }
    }
}

/// Runs the whole plan with the careful functions of the number type, which accept every argument.
pub(super) fn carefully<T: Lift<T>, const C: usize, const K: usize>(
    plan: &BlockPlan,
    scalars: &[T],
    columns: &mut [Column<T, C, K>],
    pieces: usize,
) {
    let mut registers = Registers { scalars, columns, pieces };
    for step in &plan.steps {
        match step.kind {
            StepKind::Unary(function, small) => {
                registers.one(step, |x: T| interpret::unary(function, small, x));
            }
            StepKind::Binary(function) => {
                registers.two(step, [0, 1], |a: T, b: T| interpret::binary(function, a, b));
            }
            _ => registers.step::<T>(step),
        }
    }
}

/// Returns false if any result is not a number. May also return false for infinities, since it tests sums, as compiled code
/// does. After the last point there are copies of the first one.
pub(super) fn are_numbers<T: Float, const C: usize, const K: usize>(
    plan: &BlockPlan,
    scalars: &[T],
    columns: &[Column<T, C, K>],
    pieces: usize,
) -> bool {
    let mut sums = [T::from_f64(0.0); C];
    let mut add = |numbers: &[T; C]| {
        for k in 0..C {
            sums[k] = sums[k] + numbers[k];
        }
    };
    for component in &plan.components {
        match component {
            Operand::Scalar(scalar) => add(&[scalars[*scalar as usize]; C]),
            Operand::Column(column) => {
                let numbers = &columns[*column as usize].0;
                numbers[..pieces.min(K)].iter().for_each(&mut add);
                if pieces < K {
                    add(&[numbers[0][0]; C]);
                }
            }
        }
    }
    let mut eight = [T::from_f64(0.0); 8];
    for (k, sum) in sums.iter().enumerate() {
        eight[k % 8] = eight[k % 8] + *sum;
    }
    eight.iter().all(|sum| sum.partial_cmp(sum).is_some())
}
