//! The shipped fields as compiled code: one module for each file of the folder `fields/`.
//!
//! With the feature `linked`, this crate compiles the traits of a solver for all fields, for a program that can run each of
//! them. Without it, a program compiles the traits only of the fields that it runs; the tests of formulas run none.

use mms_runtime::scene::Code;

include!(concat!(env!("OUT_DIR"), "/gallery.rs"));
