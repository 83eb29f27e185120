//! The elementary functions: a small closed set.

/// Passes the list of functions to a macro: first the functions of one argument, then those with two. Each has its variant, its
/// name, its value at 0 if that is a whole number, and a sentence. The name is also the name of its method in the scalar trait,
/// so that evaluators need no list of their own.
#[macro_export]
macro_rules! for_functions {
    ($then:ident) => {
        $then! {
            one {
                Sqrt sqrt [None] "The square root; in a graph it is the power 1/2.",
                Cbrt cbrt [Some(0)] "The real cube root, of either sign.",
                Exp exp [Some(1)] "The exponential function.",
                ExpM1 exp_m1 [Some(0)] "exp(x) - 1.",
                Ln ln [None] "The natural logarithm.",
                Ln1p ln_1p [Some(0)] "ln(1 + x).",
                Ln1pRest ln_1p_rest [Some(0)] "x - ln(1 + x).",
                Sin sin [Some(0)] "The sine.",
                Cos cos [Some(1)] "The cosine.",
                SinPi sin_pi [Some(0)] "sin(pi x).",
                CosPi cos_pi [Some(1)] "cos(pi x).",
                WithinTurns within_turns [Some(0)] "An angle less whole turns, where it is more than a few.",
                WithinTurnsPi within_turns_pi [Some(0)] "An angle in half turns less whole turns, where it is more than a few.",
                Tan tan [Some(0)] "The tangent.",
                Sinh sinh [Some(0)] "The hyperbolic sine.",
                Cosh cosh [Some(1)] "The hyperbolic cosine.",
                Tanh tanh [Some(0)] "The hyperbolic tangent.",
                Asin asin [Some(0)] "The inverse sine.",
                Acos acos [None] "The inverse cosine.",
                Atan atan [Some(0)] "The inverse tangent.",
            }
            two {
                Atan2 atan2 [None] "The angle of the point (x, y), called as atan2(y, x).",
                Powf powf [None] "A positive base to any power.",
            }
        }
    };
}

macro_rules! declare {
    (
        one { $($one:ident $one_name:ident [$one_at_zero:expr] $one_doc:literal,)* }
        two { $($two:ident $two_name:ident [$two_at_zero:expr] $two_doc:literal,)* }
    ) => {
        /// An elementary function of one or two arguments.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Function {
            $(#[doc = $one_doc] $one,)*
            $(#[doc = $two_doc] $two,)*
        }

        impl Function {
            /// Every function.
            pub const ALL: &[Function] = &[$(Function::$one,)* $(Function::$two,)*];

            /// The name, as the scalar trait spells it.
            pub fn name(self) -> &'static str {
                match self {
                    $(Function::$one => stringify!($one_name),)*
                    $(Function::$two => stringify!($two_name),)*
                }
            }

            /// The number of arguments.
            pub fn arity(self) -> usize {
                match self {
                    $(Function::$one => 1,)*
                    $(Function::$two => 2,)*
                }
            }

            /// The value at a first argument of 0, if that is the same whole number for all other arguments.
            pub(super) fn at_zero(self) -> Option<i32> {
                match self {
                    $(Function::$one => $one_at_zero,)*
                    $(Function::$two => $two_at_zero,)*
                }
            }
        }
    };
}

for_functions!(declare);

impl Function {
    /// Whether the function subtracts whole turns from its argument.
    pub fn takes_turns_off(self) -> bool {
        matches!(self, Function::WithinTurns | Function::WithinTurnsPi)
    }
}

/// The proved bound of the magnitude of an angle, which makes its sine and cosine cheaper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Small {
    /// At most 1, or a little more: a few terms are enough.
    WithinOne,
    /// Less than a quarter turn: no turns need be subtracted.
    NearZero,
}
