//! The functions of the language of formulas, and words of other languages that it does not have.

/// The functions of the language.
pub const FUNCTIONS: &[&str] = &[
    "sqrt", "exp", "ln", "sin", "cos", "tan", "sinh", "cosh", "tanh", "asin", "acos", "atan",
    "atan2", "hypot", "cbrt",
];

/// The page on the limits of the scope, as a literal.
macro_rules! scope {
    () => {
        "docs/scope.md"
    };
}

/// The page on the limits of the scope, and the nearest alternatives.
pub const SCOPE: &str = scope!();

/// The advice on a word of other languages and books that this language does not have.
pub fn elsewhere(word: &str) -> Option<&'static str> {
    Some(match word {
        "log" => "the natural logarithm is `ln(x)`",
        "log10" => "write `ln(x)/ln(10)`",
        "log2" => "write `ln(x)/ln(2)`",
        "pow" | "power" => "a power is `a^b`",
        "M_PI" | "np.pi" => "the circle's number is `pi`",
        "e" | "E" => "powers of Euler's number are `exp(x)`",
        "sec" | "csc" | "cot" => "write it with `sin(x)` and `cos(x)`",
        "arcsin" | "arccos" | "arctan" => "it is `asin(x)`, `acos(x)` or `atan(x)` here",
        "lambda1" | "lambda2" | "lambda3" | "lambda_1" | "lambda_2" | "lambda_3" => {
            concat!(
                "a material is a function of the invariants I1, I2, J, and principal stretches are not known: ",
                scope!()
            )
        }
        "plane" => {
            concat!(
                "a field in a plane is in plane strain; plane stress takes the moduli that it reduces to: ",
                scope!()
            )
        }
        _ => return None,
    })
}

/// The advice on another name of a modulus or of the density, for a material with lambda and mu.
pub fn modulus(word: &str) -> Option<&'static str> {
    Some(match word.to_ascii_lowercase().as_str() {
        "e" | "ym" | "youngs" | "young_modulus" | "youngs_modulus" | "elastic_modulus" => {
            "Young's modulus is `young`, given with `nu`"
        }
        "poisson" | "poissons_ratio" | "poisson_ratio" | "v" => "Poisson's ratio is `nu`",
        "g" | "shear" | "shear_modulus" => "the shear modulus is `mu`",
        "k" | "bulk" | "bulk_modulus" => "the bulk modulus is `kappa`, given with `mu`",
        "rho" | "rho0" | "density0" => "the reference density is `density`",
        _ => return None,
    })
}

/// The advice on a word of other programs for a load or condition of a face, such as `pressure`, which is no claim.
pub fn instead_of_claim(word: &str) -> Option<&'static str> {
    Some(match word.to_ascii_lowercase().as_str() {
        "pressure" | "follower" | "follower_load" | "follower_pressure" | "following_pressure" => {
            concat!(
                "a load that follows the face is no claim; `traction` gives P N of the exact motion, a dead load: ",
                scope!()
            )
        }
        "load" | "dead_load" | "force" | "neumann" | "stress" => {
            concat!("a load is `traction`, and follows from u: ", scope!())
        }
        "contact" | "friction" => concat!("contact is not covered: ", scope!()),
        _ => return None,
    })
}

/// The advice on a power between a function and its argument, as in `sin^2(X)`, if a text ends in this way.
pub fn power_of_function(text: &str) -> Option<String> {
    let (before, exponent) = text.trim_end().rsplit_once('^')?;
    let is_word = |it: char| it.is_ascii_alphanumeric() || it == '_';
    let name = before.rsplit(|it| !is_word(it)).next()?;
    let exponent: u32 = exponent.trim().parse().ok()?;
    FUNCTIONS
        .contains(&name)
        .then(|| format!("the power of a function follows its call: `{name}(..)^{exponent}`"))
}
