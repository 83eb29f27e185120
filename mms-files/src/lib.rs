//! The files of a program, and the machine that it runs on.
//!
//! [`read`] reads plain files up to a limit for each kind; [`write`](mod@write) writes files whole or not at all; [`results`]
//! finds files of results; [`store`] keeps results that several processes share; [`shell`] quotes command lines; [`machine`]
//! counts processors and memory; [`program`] identifies the running program; [`words`] prints durations and sizes.

#![warn(clippy::disallowed_methods)]
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod machine;
pub mod program;
pub mod read;
pub mod results;
pub mod shell;
pub mod store;
pub mod words;
pub mod write;
