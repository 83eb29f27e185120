//! Passes over the graph, one file each. Every pass is a loop over handles in order, operands
//! first; none recurses over expressions. (What recurses does so over the bits of an exponent, or over what is left of a
//! polynomial when a factor has been taken out.)

pub mod absorb;
pub mod curvature;
pub mod difference;
pub mod differentiate;
pub mod expand;
pub mod factor;
pub mod gather;
pub mod half_turns;
pub mod nest;
mod polynomial;
pub mod reduce;
pub mod relations;
pub mod separate;
pub mod settle;
pub mod shift;
pub mod substitute;
pub mod whole_turns;

use crate::expr::{Expr, Rational};

/// Factors with their exponents, or terms with their coefficients.
type Operands = Vec<(Expr, Rational)>;
