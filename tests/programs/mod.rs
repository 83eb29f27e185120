//! The macro as a crate meets it that uses it. Each file is a program of its own, but for the time
//! it takes to link them; they allow no warning in what the macro writes.

pub mod contract;
pub mod no_parameters;
pub mod odd_names;
pub mod odd_stems;
pub mod own_material;
pub mod point_cache;
pub mod selected;
pub mod two_fields;
