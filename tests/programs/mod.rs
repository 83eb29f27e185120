//! The macro in a crate that uses it. Each file would be a program of its own, but linking takes too long; they allow no
//! warning in the macro's output.

pub mod contract;
pub mod no_parameters;
pub mod odd_names;
pub mod odd_stems;
pub mod own_material;
pub mod point_cache;
pub mod selected;
pub mod two_fields;
