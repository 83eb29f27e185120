//! [`Scalar`] for the two IEEE formats, through the standard library.

use crate::Scalar;

macro_rules! scalar {
    ($float:ident, $($function:ident)*) => {
        impl Scalar for $float {
            #[inline]
            fn from_f64(value: f64) -> Self {
                value as $float
            }
            #[inline]
            fn pi() -> Self {
                core::$float::consts::PI
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                $float::atan2(self, x)
            }
            #[inline]
            fn powf(self, exponent: Self) -> Self {
                $float::powf(self, exponent)
            }
            $(
                #[inline]
                fn $function(self) -> Self {
                    $float::$function(self)
                }
            )*
        }
    };
}

scalar!(f32, sqrt cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asin acos atan);
scalar!(f64, sqrt cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asin acos atan);
