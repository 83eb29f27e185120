//! The elementary functions: a small closed set.

macro_rules! functions {
    ($($variant:ident $name:literal $arity:literal $doc:literal,)*) => {
        /// An elementary function of one or two arguments.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Function {
            $(#[doc = $doc] $variant,)*
        }

        impl Function {
            /// Every function.
            pub const ALL: &[Function] = &[$(Function::$variant,)*];

            /// Its name, as the scalar trait spells it.
            pub fn name(self) -> &'static str {
                match self { $(Function::$variant => $name,)* }
            }

            /// How many arguments it takes.
            pub fn arity(self) -> usize {
                match self { $(Function::$variant => $arity,)* }
            }
        }
    };
}

functions! {
    Sqrt "sqrt" 1 "The square root; in a graph it is the power 1/2.",
    Cbrt "cbrt" 1 "The real cube root, of either sign.",
    Exp "exp" 1 "The exponential function.",
    ExpM1 "exp_m1" 1 "exp(x) - 1.",
    Ln "ln" 1 "The natural logarithm.",
    Ln1p "ln_1p" 1 "ln(1 + x).",
    Ln1pRest "ln_1p_rest" 1 "x - ln(1 + x).",
    Sin "sin" 1 "The sine.",
    Cos "cos" 1 "The cosine.",
    SinNearZero "sin_near_zero" 1 "The sine of an angle that is proved to be less than a quarter turn.",
    CosNearZero "cos_near_zero" 1 "The cosine of such an angle.",
    SinWithinOne "sin_within_one" 1 "The sine of an angle that is proved to be at most 1, or a little more.",
    CosWithinOne "cos_within_one" 1 "The cosine of such an angle.",
    SinPi "sin_pi" 1 "sin(pi x).",
    CosPi "cos_pi" 1 "cos(pi x).",
    WithinTurns "within_turns" 1 "An angle less whole turns, where it is more than a few.",
    WithinTurnsPi "within_turns_pi" 1 "The same of an angle in half turns.",
    Tan "tan" 1 "The tangent.",
    Sinh "sinh" 1 "The hyperbolic sine.",
    Cosh "cosh" 1 "The hyperbolic cosine.",
    Tanh "tanh" 1 "The hyperbolic tangent.",
    Asin "asin" 1 "The inverse sine.",
    Acos "acos" 1 "The inverse cosine.",
    Atan "atan" 1 "The inverse tangent.",
    Atan2 "atan2" 2 "The angle of the point (x, y), called as atan2(y, x).",
    Powf "powf" 2 "A positive base to any power.",
    Offset "offset" 2 "a - b, in a step of its own: a coordinate less the place that a field is about.",
}

impl Function {
    /// Whether it is its argument but for whole turns.
    pub fn takes_turns_off(self) -> bool {
        matches!(self, Function::WithinTurns | Function::WithinTurnsPi)
    }

    /// The same function for whoever expects nothing of its argument.
    pub fn of_any_argument(self) -> Self {
        match self {
            Function::SinNearZero | Function::SinWithinOne => Function::Sin,
            Function::CosNearZero | Function::CosWithinOne => Function::Cos,
            other => other,
        }
    }
}
