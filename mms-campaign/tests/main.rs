//! The tests of this crate, as one program, so that shared code is compiled and linked once.

mod coverage;
mod file;
mod process;
mod profile;
mod template;
