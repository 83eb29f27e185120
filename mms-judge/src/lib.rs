//! Judges and diagnoses the results of any solver.
//!
//! [`table`] reads measured errors; [`results`] measures the errors of results against a field. Both return
//! [`Measured`](measured::Measured). [`Judgements`] judges its orders, and makes the document. [`diagnose`] turns results into
//! the evidence of a diagnosis. Nothing here opens a file: `mms_results::Files` does.

pub mod diagnose;
mod excluded;
mod judgements;
pub mod measured;
pub mod names;
pub mod next;
pub mod results;
pub mod table;

pub use excluded::Together;
pub use mms_diagnosis::follow::{Follow, Unfollowed};

pub use judgements::{Judgements, norms_judged};
