//! The least time of a loop over points on this machine: the number of additions, multiplications and fused
//! multiply-adds of the emitted code and of the functions that it calls, times the time of one such operation in the
//! same run, if none waits for another. A division and a square root count as one operation,
//! although they take longer; loads and stores, integers and selections are free.
//!
//! A special scalar counts the operations, with a table of the operations of the functions in `quick/` of `mms-math`:
//! count again if you change a function there.

use std::cell::{Cell, RefCell};
use std::hint::black_box;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::time::Instant;

use mms_runtime::math::batch::{self, Float, Function, Kernel, Lift, Points};
use mms_runtime::math::{Real, Scalar};

use crate::median;

/// The operations of a function in `f64` and in `f32`, counted in `mms-math/src/quick/` where products
/// are fused with sums.
type Slots = [usize; 2];

/// Sine and cosine of an angle: one reduction, two polynomials.
const SINE_AND_COSINE: Slots = [25, 22];
/// Sine and cosine without reduction of the angle.
const NEAR_ZERO: Slots = [18, 11];
/// Sine and cosine of an angle that is at most 1.
const WITHIN_ONE: Slots = [16, 10];
/// Sine and cosine of an angle in half turns.
const OF_HALF_TURNS: Slots = [19, 13];
/// The logarithm.
const LN: Slots = [16, 12];

/// Counts the operations on numbers of a point.
#[derive(Debug, Default)]
pub struct Tally {
    /// The column of the tables: 0 for `f64`, 1 for `f32`.
    format: usize,
    slots: Cell<usize>,
    /// Whether a function ran that the table lacks.
    uncounted: Cell<bool>,
    /// The angles whose sine and cosine are counted already, with the operations of the function.
    angles: RefCell<Vec<(f64, Slots)>>,
}

impl Tally {
    /// An empty tally for `f64` or `f32`.
    pub fn new(precision: &str) -> Self {
        Tally { format: usize::from(precision == "f32"), ..Tally::default() }
    }

    /// A number whose operations count, like the operations on all results computed from it.
    pub fn number(&self, value: f64) -> Counted<'_> {
        Counted { value, tally: Some(self) }
    }

    /// The number of operations since the last call; `None` if some were not counted.
    pub fn take(&self) -> Option<usize> {
        self.angles.take();
        let slots = self.slots.take();
        (!self.uncounted.take()).then_some(slots)
    }

    fn add(&self, slots: usize) {
        self.slots.set(self.slots.get() + slots);
    }

    /// Counts a sine or a cosine; the second function of the same angle is free.
    fn turn(&self, angle: f64, slots: Slots) {
        let mut angles = self.angles.borrow_mut();
        if !angles.contains(&(angle, slots)) {
            angles.push((angle, slots));
            self.add(slots[self.format]);
        }
    }
}

/// A number with the tally of its operations; operations on parameters and on the time are not counted.
#[derive(Clone, Copy, Debug)]
pub struct Counted<'a> {
    value: f64,
    tally: Option<&'a Tally>,
}

impl<'a> Counted<'a> {
    /// Counts one operation on two numbers, with the given result.
    fn with(self, other: Self, value: f64) -> Self {
        let tally = self.tally.or(other.tally);
        tally.inspect(|tally| tally.add(1));
        Counted { value, tally }
    }

    /// Counts a function call, with the given result.
    fn of(self, slots: Slots, value: f64) -> Self {
        self.tally.inspect(|tally| tally.add(slots[tally.format]));
        Counted { value, ..self }
    }

    fn turned(self, slots: Slots, value: f64) -> Self {
        self.tally.inspect(|tally| tally.turn(self.value, slots));
        Counted { value, ..self }
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $operator:tt),*) => {
        $(
            impl $trait for Counted<'_> {
                type Output = Self;
                fn $method(self, other: Self) -> Self {
                    self.with(other, self.value $operator other.value)
                }
            }
        )*
    };
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Counted<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Counted { value: -self.value, ..self }
    }
}

/// Functions that the table lacks: a loop that calls one has no floor.
macro_rules! not_counted {
    ($($function:ident($($argument:ident)?))*) => {
        $(
            fn $function(self $(, $argument: Self)?) -> Self {
                self.tally.inspect(|tally| tally.uncounted.set(true));
                Counted { value: Scalar::$function(self.value $(, $argument.value)?), ..self }
            }
        )*
    };
}

impl Scalar for Counted<'_> {
    type Wide = Self;
    fn widen(self) -> Self {
        self
    }
    fn narrow(wide: Self) -> Self {
        wide
    }
    fn from_f64(value: f64) -> Self {
        Counted { value, tally: None }
    }
    fn pi() -> Self {
        Self::from_f64(core::f64::consts::PI)
    }
    fn mul_add(self, factor: Self, term: Self) -> Self {
        let tally = self.tally.or(factor.tally);
        Counted { tally, ..self }.with(term, self.value * factor.value + term.value)
    }
    fn sqrt(self) -> Self {
        self.of([1, 1], self.value.sqrt())
    }
    fn ln(self) -> Self {
        self.of(LN, self.value.ln())
    }
    fn sin(self) -> Self {
        self.turned(SINE_AND_COSINE, self.value.sin())
    }
    fn cos(self) -> Self {
        self.turned(SINE_AND_COSINE, self.value.cos())
    }
    fn sin_near_zero(self) -> Self {
        self.turned(NEAR_ZERO, self.value.sin())
    }
    fn cos_near_zero(self) -> Self {
        self.turned(NEAR_ZERO, self.value.cos())
    }
    fn sin_within_one(self) -> Self {
        self.turned(WITHIN_ONE, self.value.sin())
    }
    fn cos_within_one(self) -> Self {
        self.turned(WITHIN_ONE, self.value.cos())
    }
    fn sin_pi(self) -> Self {
        self.turned(OF_HALF_TURNS, Scalar::sin_pi(self.value))
    }
    fn cos_pi(self) -> Self {
        self.turned(OF_HALF_TURNS, Scalar::cos_pi(self.value))
    }
    not_counted! {
        cbrt() exp() exp_m1() ln_1p() tan() sinh() cosh() tanh() asin() acos() atan()
        atan2(x) powf(exponent)
    }
}

/// Multiply-adds of which few wait for each other.
struct Chains;

/// The number of chains of multiply-adds, and their length.
const CHAINS: [usize; 2] = [16, 8];

impl<S: Real> Function<S, 1, 1> for Chains {
    #[inline(always)]
    fn at(&self, [x]: [S; 1]) -> [S; 1] {
        let mut sum = x;
        for chain in 0..CHAINS[0] {
            let start = S::from_f64(chain as f64 / CHAINS[0] as f64);
            let mut value = start;
            for _ in 0..CHAINS[1] {
                value = value.mul_add(x, start);
            }
            sum = sum + value;
        }
        [sum]
    }
}

impl<T: Float> Kernel<T, 1, 1> for Chains {
    #[inline(always)]
    fn drive<S: Lift<T>>(&self, points: &mut impl Points<S, 1, 1>) {
        points.each(self);
    }
}

/// The time of one operation in a batch on this machine.
pub struct Slot {
    /// `f64` or `f32`.
    pub precision: &'static str,
    turn: Box<dyn FnMut() -> f64>,
    rounds: Vec<f64>,
}

impl Slot {
    /// The slots of both precisions.
    pub fn all() -> [Slot; 2] {
        [Slot::of::<f64>("f64"), Slot::of::<f32>("f32")]
    }

    fn of<T: Float + 'static>(precision: &'static str) -> Slot {
        let tally = Tally::new(precision);
        Chains.at([tally.number(0.5)]);
        let points: Vec<T> =
            (0..4096).map(|index| T::from_f64(f64::from(index) / 4096.0)).collect();
        let mut out = points.clone();
        let slots = tally.take().expect("sums and products are counted");
        let count = (slots * points.len()) as f64;
        let turn = move || {
            let start = Instant::now();
            batch::run(&Chains, &[black_box(&points[..])], &mut [black_box(&mut out[..])]);
            1e9 * start.elapsed().as_secs_f64() / count
        };
        Slot { precision, turn: Box::new(turn), rounds: Vec::new() }
    }

    /// Measures one more round.
    pub fn round(&mut self) {
        self.rounds.push((self.turn)());
    }

    /// The median of the rounds, in nanoseconds.
    pub fn nanoseconds(&self) -> f64 {
        median(self.rounds.clone())
    }
}
