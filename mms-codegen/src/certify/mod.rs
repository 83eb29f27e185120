//! What a field file claims, tested against what follows from it.

mod angles;
pub mod branches;
pub mod certificate;
pub mod chart;
pub mod claims;
pub mod closed_form;
pub mod computed;
pub mod declared;
pub mod enclosure;
pub mod finite;
pub mod forms;
pub mod jacobian;
pub mod limits;
pub mod matrix;
pub mod message;
pub mod motion;
pub mod rates;
pub mod rest;
pub mod search;
pub mod tangent;
pub mod witness;
pub mod written;

pub(crate) use angles::near_zero;
