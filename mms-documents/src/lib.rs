//! The results of `mms`: one type for each document of `--json`.
//!
//! A command computes a value of such a type. Text, tables, JSON and pages show it. Keys come in the order of the fields, and
//! have their names. The page `docs/reference/json.md` is made of these types and their comments.
//!
//! A number that is not finite is null in JSON. A key whose value is not known is null. A key that a document may lack is an
//! `Option` that is left out.

pub mod accuracy;
pub mod campaign;
pub mod check;
pub mod diagnose;
pub mod emit;
pub mod eval;
pub mod explain;
pub mod extremes;
pub mod judge;
pub mod list;
pub mod provenance;
pub mod run;
#[cfg(feature = "schema")]
pub mod schema;
pub mod show;
pub mod state;
pub mod study;
pub mod tradeoff;
mod value;
pub mod verify;

pub use value::{Division, Names};
