//! The shipped fields, compiled: one module for each file of the folder `fields/`, which is the list.
//!
//! With the feature `linked` this crate compiles all of them with the traits of a solver, for a program that has them all.
//! Without it, only fields that a program uses are compiled with these traits: the tests of formulas use none.

use mms_runtime::scene::Code;

include!(concat!(env!("OUT_DIR"), "/gallery.rs"));
