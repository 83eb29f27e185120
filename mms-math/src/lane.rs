//! The scalar of a vectorised loop: a number whose functions have neither branch nor call, and whose type tells whether
//! products are fused with sums.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::Scalar;
use crate::quick::number::Float;
use crate::quick::{exponential, inverse, logarithm, power, trigonometric};

/// A number of a loop that the compiler may turn into vector instructions: the functions have neither branches nor calls, and
/// return NaN for arguments that they do not handle.
///
/// `FUSED` tells that `mul_add` rounds once. The code must then be compiled for a processor with one instruction for it, or
/// every operation becomes a call; otherwise it is a product and a sum.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
#[repr(transparent)]
pub struct Lane<T, const FUSED: bool>(pub T);

/// The largest magnitude for which a [`Lane`] computes [`Scalar::sin_near_zero`] and [`Scalar::cos_near_zero`]: just less than
/// a quarter turn.
pub const NEAR_ZERO: f64 = 1.57;

/// The largest magnitude for which a [`Lane`] computes [`Scalar::sin_within_one`] and [`Scalar::cos_within_one`]: just more
/// than 1.
pub const WITHIN_ONE: f64 = 1.0625;

macro_rules! operators {
    ($($trait:ident $method:ident $operator:tt),*) => {
        $(
            impl<T: Float, const FUSED: bool> $trait for Lane<T, FUSED> {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    Lane(self.0 $operator other.0)
                }
            }
        )*
    };
}

operators!(Add add +, Sub sub -, Mul mul *, Div div /);

impl<T: Float, const FUSED: bool> Neg for Lane<T, FUSED> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lane(-self.0)
    }
}

macro_rules! scalar {
    ($($module:ident: $($function:ident)*;)*) => {
        impl<T: Float, const FUSED: bool> Scalar for Lane<T, FUSED> {
            type Wide = Self;
            #[inline(always)]
            fn widen(self) -> Self {
                self
            }
            #[inline(always)]
            fn narrow(wide: Self) -> Self {
                wide
            }
            #[inline(always)]
            fn from_f64(value: f64) -> Self {
                Lane(T::of(value))
            }
            #[inline(always)]
            fn from_parts(high: f64, _: f64) -> Self {
                Lane(T::of(high))
            }
            #[inline(always)]
            fn pi() -> Self {
                Lane(T::PI[0])
            }
            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                self.times_plus(factor, term)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Lane(self.0.sqrt())
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                inverse::atan2(self, x)
            }
            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                T::powf(self, exponent)
            }
            $($(
                #[inline(always)]
                fn $function(self) -> Self {
                    $module::$function(self)
                }
            )*)*
        }
    };
}

scalar! {
    power: cbrt;
    exponential: exp exp_m1 sinh cosh tanh;
    logarithm: ln ln_1p ln_1p_rest;
    trigonometric: sin cos sin_near_zero cos_near_zero sin_within_one cos_within_one sin_pi cos_pi tan;
    inverse: asin acos atan;
}
