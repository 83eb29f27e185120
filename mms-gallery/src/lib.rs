//! The shipped fields, compiled: one module for each file of the folder `fields/`, which is the list.
//!
//! With the feature `linked` all of them are compiled behind the contract of a solver in this crate, for a program that
//! has them all. Without it that is left to who asks for one: the tests of formulas do not.

use mms_runtime::scene::Code;

include!(concat!(env!("OUT_DIR"), "/gallery.rs"));
