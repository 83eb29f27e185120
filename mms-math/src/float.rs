//! [`Scalar`] for the two IEEE formats, through the standard library.

use crate::{Real, Scalar};

macro_rules! scalar {
    ($float:ident, $wide:ident, $($function:ident)*) => {
        impl Scalar for $float {
            type Wide = $wide;
            #[inline]
            fn widen(self) -> Self::Wide {
                self as $wide
            }
            #[inline]
            fn narrow(wide: Self::Wide) -> Self {
                wide as $float
            }
            #[inline]
            fn from_parts(high: f64, _: f64) -> Self {
                high as $float
            }
            #[inline]
            fn from_f64(value: f64) -> Self {
                value as $float
            }
            #[inline]
            fn pi() -> Self {
                core::$float::consts::PI
            }
            #[inline]
            fn ln_1p_rest(self) -> Self {
                if self.abs() < 0.1 { series_of_rest(self) } else { self - $float::ln_1p(self) }
            }
            #[inline]
            fn sin_pi(self) -> Self {
                let turns = $float::round(self * 0.5);
                $float::sin((self - 2.0 * turns) * Self::pi())
            }
            #[inline]
            fn cos_pi(self) -> Self {
                let turns = $float::round(self * 0.5);
                $float::cos((self - 2.0 * turns) * Self::pi())
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

scalar!(f32, f64, sqrt cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asin acos atan);
scalar!(f64, f64, sqrt cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asin acos atan);

/// x - ln(1 + x) = x^2/2 - x^3/3 + ..., for |x| < 0.1.
fn series_of_rest<T: Real>(x: T) -> T {
    let mut sum = T::from_f64(0.0);
    for n in (2..=17).rev() {
        sum = T::ratio(1, n) - x * sum;
    }
    x * x * sum
}
