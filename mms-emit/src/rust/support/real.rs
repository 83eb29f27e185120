/// A scalar: `f32` or `f64`. Elementary functions come from the standard library. A crate without it has a dependency
/// and a feature `libm`, and uses the functions of that crate.
pub trait Real:
    Copy
    + PartialOrd
    + core::ops::Add<Output = Self>
    + core::ops::Sub<Output = Self>
    + core::ops::Mul<Output = Self>
    + core::ops::Div<Output = Self>
    + core::ops::Neg<Output = Self>
{
    /// The nearest number of this precision.
    fn of(value: f64) -> Self;
    /// The value in double precision.
    fn to_f64(self) -> f64;
    fn sqrt(self) -> Self;
    fn cbrt(self) -> Self;
    fn exp(self) -> Self;
    fn exp_m1(self) -> Self;
    fn ln(self) -> Self;
    fn ln_1p(self) -> Self;
    fn sin(self) -> Self;
    fn cos(self) -> Self;
    fn tan(self) -> Self;
    fn sinh(self) -> Self;
    fn cosh(self) -> Self;
    fn tanh(self) -> Self;
    fn asin(self) -> Self;
    fn acos(self) -> Self;
    fn atan(self) -> Self;
    fn atan2(self, x: Self) -> Self;
    fn powf(self, exponent: Self) -> Self;
    fn floor(self) -> Self;

    /// The magnitude.
    #[inline]
    fn magnitude(self) -> Self {
        if self < Self::of(0.0) { -self } else { self }
    }

    /// sin(pi x): half turns are subtracted without error, each of which changes the sign.
    #[inline]
    fn sin_pi(self) -> Self {
        let half_turns = Self::floor(self + Self::of(0.5));
        let sine = Self::sin(Self::of(core::f64::consts::PI) * (self - half_turns));
        sine * sign_after(half_turns)
    }

    /// cos(pi x): half turns are subtracted likewise; for the remainder r it is sin(pi (1/2 - |r|)).
    #[inline]
    fn cos_pi(self) -> Self {
        let half_turns = Self::floor(self + Self::of(0.5));
        let rest = Self::of(0.5) - Self::magnitude(self - half_turns);
        Self::sin(Self::of(core::f64::consts::PI) * rest) * sign_after(half_turns)
    }

    /// x - ln(1 + x): with s = x/(2 + x), x - 2 s = x s; beyond s = 1/5 the difference itself.
    #[inline]
    fn ln_1p_rest(self) -> Self {
        if self < Self::of(-1.0 / 3.0) || self > Self::of(0.5) {
            return self - Self::ln_1p(self);
        }
        let s = self / (Self::of(2.0) + self);
        let mut sum = Self::of(1.0 / 25.0);
        for n in [23.0, 21.0, 19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0] {
            sum = sum * (s * s) + Self::of(1.0) / Self::of(n);
        }
        s * (self - Self::of(2.0) * (s * s) * sum)
    }
}

/// -1 to the power of a whole number.
#[inline]
fn sign_after<T: Real>(half_turns: T) -> T {
    let pairs = T::floor(T::of(0.5) * half_turns);
    T::of(1.0) - T::of(2.0) * (half_turns - T::of(2.0) * pairs)
}

#[allow(unexpected_cfgs)]
mod real {
    use super::Real;

    #[cfg(not(feature = "libm"))]
    macro_rules! real {
        ($($float:ident)*) => {$(
            impl Real for $float {
                #[inline]
                fn of(value: f64) -> Self { value as $float }
                #[inline]
                fn to_f64(self) -> f64 { self as f64 }
                real! { $float: sqrt cbrt exp exp_m1 ln ln_1p sin cos tan sinh cosh tanh asin acos atan floor }
                #[inline]
                fn atan2(self, x: Self) -> Self { <$float>::atan2(self, x) }
                #[inline]
                fn powf(self, exponent: Self) -> Self { <$float>::powf(self, exponent) }
            }
        )*};
        ($float:ident: $($function:ident)*) => {$(
            #[inline]
            fn $function(self) -> Self { <$float>::$function(self) }
        )*};
    }

    #[cfg(feature = "libm")]
    macro_rules! real {
        ($($float:ident)*) => {$(
            impl Real for $float {
                #[inline]
                fn of(value: f64) -> Self { value as $float }
                #[inline]
                fn to_f64(self) -> f64 { self as f64 }
                real! { $float: sqrt sqrt, cbrt cbrt, exp exp, exp_m1 expm1, ln log, ln_1p log1p, sin sin, cos cos, tan tan,
                    sinh sinh, cosh cosh, tanh tanh, asin asin, acos acos, atan atan, floor floor }
                #[inline]
                fn atan2(self, x: Self) -> Self { libm::atan2(self as f64, x as f64) as $float }
                #[inline]
                fn powf(self, exponent: Self) -> Self { libm::pow(self as f64, exponent as f64) as $float }
            }
        )*};
        ($float:ident: $($function:ident $theirs:ident),*) => {$(
            #[inline]
            fn $function(self) -> Self { libm::$theirs(self as f64) as $float }
        )*};
    }

    real! { f32 f64 }
}
