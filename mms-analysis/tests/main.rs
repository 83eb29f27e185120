//! The tests of this crate, as one program, so that shared code is compiled and linked once.

mod accuracy;
mod axisymmetric;
mod period;
mod present;
mod visibility;
