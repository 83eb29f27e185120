//! Judges and diagnoses the results of any solver.
//!
//! [`table`] reads errors that somebody measured; [`results`] measures those of results against a field. Both give
//! [`Measured`](measured::Measured), whose orders [`Judgements`] judges, and of which it makes the document.
//! [`diagnose`] makes of results the evidence of a diagnosis. Nothing here opens a file: `mms_results::Files` does.

pub mod diagnose;
mod excluded;
mod judgements;
pub mod measured;
pub mod names;
pub mod next;
pub mod results;
pub mod table;

pub use excluded::Together;
pub use judgements::{Judgements, norms_judged};
