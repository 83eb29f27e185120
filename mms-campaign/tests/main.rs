//! The tests of this crate, as one program, so that what they share is compiled and linked once.

mod cover;
mod file;
mod process;
mod profile;
mod template;
