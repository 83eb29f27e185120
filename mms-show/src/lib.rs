//! The derivation as a person would write it, in several notations.
//!
//! A [`Document`] has the contents in order: the material, the definitions of the field, for each quantity its definition and
//! its components in terms of names that have been listed before, and, on request, the terms of the equations that do not
//! vanish in the field. It is derived anew with a leaf for each thing that has a name (F, J, P, definitions of the file,
//! derivatives `A_t`, `F_11_X`), so that formulas stay as short as on paper. The compiler uses another, expanded derivation of
//! the same quantities; tests evaluate every line and compare with the program, in 77 digits. No right-hand side is longer than
//! a line: larger ones are put together from parts `k1`, `k2`, ...
//!
//! There is one walk from expressions to formulas ([`walk`]). A new notation is one file that implements [`walk::Notation`],
//! and its page. LaTeX is a whole document; MathML a page of well-formed XML with one `math` element per line; JSON contains
//! formulas in the language of field files, which parse back to the same expressions. Generated names that a user has taken get
//! another stem (`F_derived`).

mod abbreviate;
mod axisymmetric;
mod balance;
mod document;
mod energy;
mod fibres;
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

pub use document::{DERIVATION, Document, Line, Material, Section};
