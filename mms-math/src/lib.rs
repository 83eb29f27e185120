//! The scalar trait of generated functions, the interpreter and the solver.
//!
//! Generated code is written once, generic over [`Scalar`], and evaluated in `f32`, `f64`, twice the digits of `f64`
//! ([`Double`]), dual numbers or arbitrary precision. The crate has no dependencies and needs no standard library unless the
//! feature `std` (on by default) supplies the elementary functions of `f32` and `f64`, and with them evaluation at many points
//! ([`batch`]).
//!
//! | module | contents |
//! |---|---|
//! | `quick` | elementary functions without branches, for `f32` and `f64`; the tests bound their errors |
//! | `lane` | the scalar of a loop: a number, and whether products are fused with sums |
//! | `float` | `f32` and `f64`: branch-free functions; if one returns NaN, the function of the standard library is called |
//! | `double` | twice the digits of `f64` (double-double), without the standard library |
//! | `coordinates` | systems of coordinates: positions, directions, volumes between bounds |
//! | `polygon` | whether edges cross, triangles, distances |
//! | `batch`, `dispatch` | many points, block by block, and which instructions may be used |
//! | `block` | the numbers of a block, and the loops over it |
//! | `simd` | eight numbers as one value, in registers if the processor has them (SIMD pack) |
//! | `places`, `packed`, `structures` | sources of points and sinks for results: columns, packs of eight, arrays of structures |
//! | `kept` | values at many points, stored for later times |
//! | `generate` | macros that generated modules call |
//! | `defect` | the list of deliberate mistakes of a crate, and the selected one |
#![no_std]

#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "std")]
pub mod batch;
#[cfg(feature = "std")]
mod block;
pub mod coordinates;
mod defect;
#[cfg(feature = "std")]
pub mod dispatch;
mod double;
#[cfg(feature = "std")]
mod float;
#[cfg(feature = "std")]
mod generate;
#[cfg(feature = "std")]
mod kept;
#[cfg(feature = "std")]
mod lane;
#[cfg(feature = "std")]
pub mod packed;
#[cfg(feature = "std")]
mod places;
#[cfg(feature = "std")]
pub mod polygon;
#[cfg(feature = "std")]
mod quick;
#[cfg(feature = "std")]
pub mod simd;
#[cfg(feature = "std")]
pub mod structures;

pub use double::Double;
#[cfg(feature = "std")]
pub use lane::{Lane, NEAR_ZERO, WITHIN_ONE};

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// The largest number of half turns from which [`Scalar::within_turns_pi`] subtracts no turns: sums with so small an angle lose
/// no significant digits.
pub const FEW_HALF_TURNS: f64 = 8.0;

/// The largest number of radians that [`Scalar::within_turns`] does not change.
pub const FEW_RADIANS: f64 = 25.0;

/// The largest angle in radians, 2^50, that is reduced with twice the digits of an `f64`.
pub const LARGEST_ANGLE: f64 = 1125899906842624.0;

/// A real number in some precision: the arithmetic and the elementary functions of a field.
///
/// `Clone` rather than `Copy`, so that arbitrary-precision numbers qualify. Outside a function's domain an implementation
/// returns its own NaN or infinity; it never panics.
pub trait Scalar:
    Clone
    + Debug
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The nearest value to `value`; exact if the type has a 53-bit significand.
    fn from_f64(value: f64) -> Self;

    /// The type for values that are computed once and used often: it has more digits if there is such a type.
    type Wide: Scalar;

    /// Converts to the type with more digits.
    fn widen(self) -> Self::Wide;

    /// The nearest value to one with more digits.
    fn narrow(wide: Self::Wide) -> Self;

    /// The value nearest to `high + low`, a constant that has more digits than an `f64`.
    fn from_parts(high: f64, low: f64) -> Self {
        Self::from_f64(high) + Self::from_f64(low)
    }

    /// `numerator / denominator`, rounded once where both are exact in this type.
    fn ratio(numerator: i32, denominator: i32) -> Self {
        Self::from_f64(f64::from(numerator)) / Self::from_f64(f64::from(denominator))
    }

    /// The circle's half circumference over its radius.
    fn pi() -> Self;

    /// `self * factor + term`, rounded once or twice.
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    /// The square root.
    fn sqrt(self) -> Self;
    /// The real cube root, of either sign.
    fn cbrt(self) -> Self;
    /// The exponential function.
    fn exp(self) -> Self;
    /// exp(self) - 1 without cancellation near 0.
    fn exp_m1(self) -> Self;
    /// The natural logarithm.
    fn ln(self) -> Self;
    /// ln(1 + self) without cancellation near 0.
    fn ln_1p(self) -> Self;
    /// self - ln(1 + self) without cancellation near 0, where it is self^2/2.
    fn ln_1p_rest(self) -> Self {
        self.clone() - self.ln_1p()
    }
    /// The sine of an angle in radians.
    fn sin(self) -> Self;
    /// The cosine of an angle in radians.
    fn cos(self) -> Self;
    /// The sine of an angle in radians that is expected to be less than a quarter turn: an implementation may omit the
    /// reduction for such angles, and is correct for all others too.
    fn sin_near_zero(self) -> Self {
        self.sin()
    }
    /// The cosine of an angle in radians that is expected to be less than a quarter turn.
    fn cos_near_zero(self) -> Self {
        self.cos()
    }
    /// The sine of an angle in radians that is expected to be at most slightly more than 1: like [`Self::sin_near_zero`], with
    /// fewer terms.
    fn sin_within_one(self) -> Self {
        self.sin_near_zero()
    }
    /// The cosine of an angle in radians that is expected to be at most slightly more than 1.
    fn cos_within_one(self) -> Self {
        self.cos_near_zero()
    }
    /// The sine of an angle in half turns, sin(pi self): whole turns are subtracted without error.
    fn sin_pi(self) -> Self {
        (Self::pi() * self).sin()
    }
    /// The cosine of an angle in half turns.
    fn cos_pi(self) -> Self {
        (Self::pi() * self).cos()
    }
    /// An angle in radians that differs from this one by whole turns: at most [`FEW_RADIANS`], if the type subtracts turns with
    /// all its digits; otherwise this angle.
    fn within_turns(self) -> Self {
        self
    }
    /// An angle in half turns that differs from this one by whole turns, and is at most [`FEW_HALF_TURNS`]: turns are
    /// subtracted without error.
    fn within_turns_pi(self) -> Self {
        self
    }
    /// The tangent of an angle in radians.
    fn tan(self) -> Self;
    /// The hyperbolic sine.
    fn sinh(self) -> Self;
    /// The hyperbolic cosine.
    fn cosh(self) -> Self;
    /// The hyperbolic tangent.
    fn tanh(self) -> Self;
    /// The inverse sine, in [-pi/2, pi/2].
    fn asin(self) -> Self;
    /// The inverse cosine, in [0, pi].
    fn acos(self) -> Self;
    /// The inverse tangent, in (-pi/2, pi/2).
    fn atan(self) -> Self;
    /// The angle of the point (`x`, `self`), in (-pi, pi].
    fn atan2(self, x: Self) -> Self;
    /// `self` to the power `exponent`, for a positive base.
    fn powf(self, exponent: Self) -> Self;
}

/// A scalar that is `Copy`: the type that generated code computes with.
pub trait Real: Scalar<Wide: Copy> + Copy {}

impl<T: Scalar<Wide: Copy> + Copy> Real for T {}
