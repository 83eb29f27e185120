//! The tests of this crate, as one program, so that shared code is compiled and linked once.

mod accuracy;
mod axisymmetric;
mod inverse_motion;
mod period;
mod visibility;
