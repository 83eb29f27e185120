//! Passes over the graph, one file each. Every pass keeps the exact value of an expression.
//!
//! Every pass is a loop over handles in order, operands first; none recurses over expressions. (Recursions run over the bits of
//! an exponent, or over the remainder of a polynomial after a factor has been taken out.)
//!
//! | pass | does | known as |
//! |---|---|---|
//! | `differentiate` | partial derivatives; one rule for sums, one for products, one per function | symbolic differentiation |
//! | `substitute` | replaces symbols, and rebuilds what depends on them | substitution |
//! | `distribute` | multiplies values that parameters determine into sums whose terms have such factors already | distributing a constant factor |
//! | `cancellation` | k cos a - k becomes -2 k sin(a/2)^2, (1 + e)^2 - 1 becomes 2 e + e^2, and so on | cancellation rewriting (expm1, cosm1) |
//! | `difference` | f - f(0) for a symbol, without cancellation: sin(c + q) - sin c becomes 2 cos(c + q/2) sin(q/2) | zeroth-order Taylor remainder |
//! | `curvature` | f less its linear part in a symbol, likewise | second-order Taylor remainder |
//! | `expand` | multiplies out, so that terms cancel in exact numbers before they are rounded | expansion |
//! | `factor` | takes out the common factors of all terms of a sum | factoring |
//! | `horner` | a x + a y + b becomes a (x + y) + b, the most frequent factor first; a polynomial in one expression that is a square becomes one | multivariate Horner |
//! | `separate` | X (a + t (Y + t Z)) becomes a X + t (X Y) + t^2 (X Z), where nothing else reads the sums inside | binding-time split |
//! | `shift` | where x^2 - 1/16 occurs, a x^2 + b in other sums becomes a (x^2 - 1/16) + (a/16 + b) | affine reuse of a subexpression |
//! | `reassociate` | a + b (c + x) becomes (a + b c) + b x, where nothing else reads c + x | reassociation of constants |
//! | `half_turns`, `whole_turns` | functions of multiples of pi; range reduction before X is known | sinpi and cospi rewriting, argument reduction |
//! | `relations` | finds s^2 = 1 - c^2, sinh^2 = cosh^2 - 1, Y^2 = R^2 - X^2 | polynomial identities |
//! | `reduce` | multiplies out modulo the relations, and nests the normal form | Groebner normal form |
//!
//! `polynomial` has the multiplied-out sums that several passes work on. `simplify` in `mms-mechanics` decides which passes a
//! quantity uses.

pub mod cancellation;
pub mod curvature;
pub mod difference;
pub mod differentiate;
pub mod distribute;
pub mod expand;
pub mod factor;
pub mod half_turns;
pub mod horner;
mod polynomial;
pub mod reassociate;
pub mod reduce;
pub mod relations;
pub mod separate;
pub mod shift;
pub mod substitute;
pub mod whole_turns;

use crate::expr::{Expr, Rational};

/// Factors with their exponents, or terms with their coefficients.
type Operands = Vec<(Expr, Rational)>;
