//! Numbers that are computed in one precision throughout.

use std::ops::{Add, Div, Mul, Neg, Sub};

use mms_math::Scalar;

use mms_program::interpret::Number;
use mms_program::precision::{Digits, Precision};

/// A number in one precision, in which the stages Parameter and Time are computed too.
#[derive(Clone, Copy, Debug)]
pub struct Once<T>(pub T);

macro_rules! once {
    ($($float:ident $precision:ident: $($function:ident)*;)*) => {$(
        impl Scalar for Once<$float> {
            type Wide = Self;

            fn widen(self) -> Self {
                self
            }

            fn narrow(wide: Self) -> Self {
                wide
            }

            fn from_f64(value: f64) -> Self {
                Once(value as $float)
            }

            fn pi() -> Self {
                Once(std::$float::consts::PI)
            }

            fn atan2(self, x: Self) -> Self {
                Once(Scalar::atan2(self.0, x.0))
            }

            fn powf(self, exponent: Self) -> Self {
                Once(Scalar::powf(self.0, exponent.0))
            }

            $(fn $function(self) -> Self {
                Once(Scalar::$function(self.0))
            })*
        }

        impl Number for Once<$float> {
            fn bounds(&self) -> [f64; 2] {
                [f64::from(self.0); 2]
            }
        }

        impl Digits for Once<$float> {
            const PRECISION: Precision = Precision::$precision;

            fn parts(self) -> (f64, f64) {
                (self.0.into(), 0.0)
            }
        }
    )*};
}

once! {
    f32 F32: sqrt cbrt exp exp_m1 ln ln_1p ln_1p_rest sin cos sin_pi cos_pi tan sinh cosh tanh asin acos atan;
    f64 F64: sqrt cbrt exp exp_m1 ln ln_1p ln_1p_rest sin cos sin_pi cos_pi tan sinh cosh tanh asin acos atan;
}

impl<T: Neg<Output = T>> Neg for Once<T> {
    type Output = Self;

    fn neg(self) -> Self {
        Once(-self.0)
    }
}

macro_rules! operators {
    ($($operator:ident $function:ident)*) => {$(
        impl<T: $operator<Output = T>> $operator for Once<T> {
            type Output = Self;

            fn $function(self, other: Self) -> Self {
                Once(self.0.$function(other.0))
            }
        }
    )*};
}

operators! { Add add Sub sub Mul mul Div div }
