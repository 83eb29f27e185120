//! The derivation as a person would write it, in several notations.
//!
//! A [`Document`] is what there is to show: the material, the definitions of the field, and for each
//! quantity its definition and its components in terms of names that have been listed before; what
//! the field sees of the equations, where that was asked for. It is
//! derived anew with F, J, P, ... as leaves, so that formulas stay as short as on paper; what is
//! compiled is another, expanded derivation of the same quantities, and tests compare the two.
//! No right-hand side is longer than a line: larger ones are put together from parts `k1`, `k2`, ...
//!
//! There is one walk from expressions to formulas ([`walk`]). A new notation is one file that
//! implements [`walk::Notation`], and its page.

mod abbreviate;
mod balance;
mod document;
mod energy;
mod fibres;
mod matrix;
mod motion;
mod page;
mod reading;
mod small_strain;
mod stress;

pub mod language;
pub mod latex;
pub mod mathml;
pub mod name;
pub mod relation;
mod rigid;
pub mod sympy;
pub mod text;
pub mod walk;

pub use document::{Document, Line, Material, Section};
