//! What a field file claims, tested against what follows from it.

pub mod closed_form;
pub mod declared;
pub mod sample;
pub mod written;
