//! A field that a user named, with numbers for its parameters.
//!
//! A [`Source`] is the text of a field and the function that reads its material. [`Input`] is a field compiled from one;
//! [`Exact`] evaluates it at many points. [`wave`] bounds the speed of its waves, [`gallery`] holds the texts of the shipped
//! fields, and [`template`] writes the text of a new one. This crate opens no files: the makers of a [`Source`] read them.

mod exact;
pub mod gallery;
mod input;
pub mod plane;
pub mod provenance;
mod quantities;
mod source;
pub mod template;
mod units;
pub mod wave;

pub use exact::{Exact, SAME, TURNS, says};
pub use input::{Input, Mistaken, settings, validate_body, validate_division};
pub use quantities::{evaluated, quantities};
pub use source::{Open, Source};
pub use units::units;
