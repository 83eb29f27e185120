//! [`Scalar`] for the two IEEE formats: the branch-free functions, and the standard library where they return NaN.

use crate::lane::Lane;
use crate::quick::number::Float;
use crate::{Double, Scalar};

macro_rules! scalar {
    ($float:ident, $wide:ident, $narrow:expr, $($function:ident)*) => {
        impl Scalar for $float {
            type Wide = $wide;
            #[inline]
            fn widen(self) -> Self::Wide {
                $wide::from(self)
            }
            #[inline]
            fn narrow(wide: Self::Wide) -> Self {
                $narrow(wide)
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
            fn sqrt(self) -> Self {
                $float::sqrt(self)
            }
            #[inline]
            fn ln_1p_rest(self) -> Self {
                // NaN results from numbers so large that nothing cancels, and from numbers outside the domain.
                known(Lane::<_, false>(self).ln_1p_rest(), || self - $float::ln_1p(self))
            }
            // Not inlined: that would make programs longer than the call of a plain sine.
            fn sin_near_zero(self) -> Self {
                known(Lane::<_, false>(self).sin_near_zero(), || Scalar::sin(self))
            }
            fn cos_near_zero(self) -> Self {
                known(Lane::<_, false>(self).cos_near_zero(), || Scalar::cos(self))
            }
            fn sin_within_one(self) -> Self {
                known(Lane::<_, false>(self).sin_within_one(), || Scalar::sin_near_zero(self))
            }
            fn cos_within_one(self) -> Self {
                known(Lane::<_, false>(self).cos_within_one(), || Scalar::cos_near_zero(self))
            }
            #[inline]
            fn sin_pi(self) -> Self {
                known(Lane::<_, false>(self).sin_pi(), || Lane::<_, false>(self % 2.0).sin_pi().0)
            }
            #[inline]
            fn cos_pi(self) -> Self {
                known(Lane::<_, false>(self).cos_pi(), || Lane::<_, false>(self % 2.0).cos_pi().0)
            }
            fn within_turns(self) -> Self {
                $narrow(Scalar::within_turns($wide::from(self)))
            }
            fn within_turns_pi(self) -> Self {
                $narrow(Scalar::within_turns_pi($wide::from(self)))
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                known(Lane::<_, false>(self).atan2(Lane(x)), || $float::atan2(self, x))
            }
            #[inline]
            fn powf(self, exponent: Self) -> Self {
                known(Lane::<_, false>(self).powf(Lane(exponent)), || $float::powf(self, exponent))
            }
            $(
                #[inline]
                fn $function(self) -> Self {
                    known(Lane::<_, false>(self).$function(), || $float::$function(self))
                }
            )*
        }
    };
}

scalar!(
    f32, f64, |wide| wide as f32,
    cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asin acos atan
);
scalar!(
    f64, Double, Double::to_f64,
    cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asin acos atan
);

/// The branch-free result, or `careful` if that is NaN.
#[inline(always)]
fn known<T: Float>(quick: Lane<T, false>, careful: impl FnOnce() -> T) -> T {
    if quick.0.is_nan() { careful() } else { quick.0 }
}
