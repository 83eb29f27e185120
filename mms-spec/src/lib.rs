//! Reads TOML to [`FieldSpec`] and [`MaterialSpec`]: the content of a file, in form only.
//!
//! Files are read through the TOML parser's spanned tables, key by key, so that the digits of numbers, the order of keys and
//! the place of every value survive. The promise: every key of format 1 is read, every other key is refused, every value has
//! its place, and one run reports every mistake of form in a file, each once. This crate checks names where they are defined;
//! `mms-mechanics/src/resolve.rs` resolves them where they are used. This crate has no calculus.
//!
//! A mistake never hides another: an unreadable formula is replaced by an empty one that is marked as reported
//! ([`Formula::reported`]), so that the counts are right and later phases can continue without reporting consequences.

mod balance;
mod boundary;
mod brackets;
mod check;
mod defined;
pub mod diagnostic;
mod document;
mod domain;
mod field;
pub mod field_name;
mod folder;
pub mod foreign;
mod form;
pub mod format;
mod formula;
mod given;
mod interned;
pub mod language;
mod material;
pub mod moduli;
pub mod names;
pub mod number;
pub mod own;
pub mod quantity;
mod rigid;
pub mod section;
pub mod source;
mod space;
mod study;
pub mod suggest;
mod symbols;
pub mod syntax;
pub mod table;
pub mod twin;
pub mod units;
mod value;

pub use balance::{BalanceLaw, BalanceSpec};
pub use boundary::{BoundarySpec, Claim, Face};
pub use check::{CheckSpec, ExtremeSpec, REGIMES};
pub use defined::{own_quantities, settle_checks};
pub use document::MAX_FILE;
pub use domain::{
    BODIES, BODY_KEYS, BodyShape, BodySpec, DomainSpec, MAX_VERTICES, Polygon, Round,
};
pub use field::{FieldSpec, read_field};
pub use folder::{FieldFile, field_files};
pub use form::Form;
pub use formula::Formula;
pub use given::{GivenSpec, MaterialGiven};
pub use material::{MaterialSpec, MaterialUse, read_material};
pub use rigid::{RigidSpec, Rotation, read_rigid};
pub use space::Space;
pub use study::{
    FILLS, FORMS, FORMULATIONS, INTEGRATORS, PRECISIONS, SHAPES, StudySpec, TRANSFERS,
};
pub use symbols::{LetSpec, MaterialParameter, ParameterSpec};
pub use value::MAX_COUNT;
