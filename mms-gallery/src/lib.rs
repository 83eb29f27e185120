//! The shipped fields as compiled code: one module for each file of the folder `fields/`.
//!
//! With the feature `linked`, this crate itself compiles the implementations of the solver's traits for all fields; a program
//! that can run every field uses the feature. Without it, a program compiles these implementations only for the fields that it
//! runs; the tests of formulas run none.

use mms_runtime::scene::Code;

include!(concat!(env!("OUT_DIR"), "/gallery.rs"));
