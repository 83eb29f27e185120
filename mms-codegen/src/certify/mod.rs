//! What a field file claims, tested against what follows from it.

pub mod branches;
pub mod certificate;
pub mod claims;
pub mod closed_form;
pub mod computed;
pub mod finite;
pub mod jacobian;
pub mod limits;
pub mod matrix;
pub mod message;
pub mod motion;
pub mod rates;
pub mod rest;
pub mod tangent;
pub mod written;
