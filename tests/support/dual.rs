//! Hyper-dual numbers as a scalar of generated code: first and second derivatives exact to round-off, by arithmetic that uses
//! no symbolic differentiation.

use std::ops::{Add, Div, Mul, Neg, Sub};

use mms_runtime::math::Scalar;
use num_dual::{DualNum, HyperDual64};

/// A value, its derivatives in two directions, and the mixed second derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual(pub HyperDual64);

impl Dual {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        Dual(HyperDual64::from_re(value))
    }

    /// A variable, differentiated in the directions whose seeds are 1.
    pub fn variable(value: f64, first: f64, second: f64) -> Self {
        let mut dual = HyperDual64::from_re(value);
        dual.eps1 = first;
        dual.eps2 = second;
        Dual(dual)
    }
}

macro_rules! operators {
    ($($trait:ident $function:ident,)*) => {
        $(impl $trait for Dual {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Dual($trait::$function(self.0, other.0))
            }
        })*
    };
}

operators! { Add add, Sub sub, Mul mul, Div div, }

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Dual(-self.0)
    }
}

macro_rules! scalar {
    ($($function:ident)*) => {
        impl Scalar for Dual {
            type Wide = Self;
            fn widen(self) -> Self {
                self
            }
            fn narrow(wide: Self) -> Self {
                wide
            }
            fn from_f64(value: f64) -> Self {
                Dual::constant(value)
            }
            fn pi() -> Self {
                Dual::constant(std::f64::consts::PI)
            }
            fn atan2(self, x: Self) -> Self {
                Dual(self.0.atan2(x.0))
            }
            fn powf(self, exponent: Self) -> Self {
                Dual(self.0.powd(exponent.0))
            }
            $(fn $function(self) -> Self {
                Dual(DualNum::$function(&self.0))
            })*
        }
    };
}

scalar!(sqrt cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asin acos atan);
