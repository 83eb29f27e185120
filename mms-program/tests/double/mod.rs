//! Double-double arithmetic and its functions: compared with 77 digits, with each other where a result is exact, and with `f64`
//! where there are no digits to keep.

mod accuracy;
mod exactness;
mod sample;
mod special;

use mms_math::{Double, Scalar as _};
use mms_program::precise::Precise;

/// The number of arguments in each range.
const COUNT: usize = 1000;

fn exact(x: Double) -> Precise {
    Precise::from_f64(x.to_f64()) + Precise::from_f64(x.low())
}

/// The double-double number whose exact value this is.
fn rounded(value: &Precise) -> Double {
    let high = value.to_f64();
    Double::new(high, (value.clone() - Precise::from_f64(high)).to_f64())
}

fn magnitude(x: Double) -> Double {
    if x < of(0.0) { -x } else { x }
}

fn of(value: f64) -> Double {
    Double::from(value)
}
