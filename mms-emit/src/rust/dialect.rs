//! The syntax of numbers and functions in Rust.

use crate::port::body::{Dialect, Owner};
use crate::port::number::{decimal, nearest};
use crate::port::support::Calls;
use mms_program::interpret::parts;
use mms_symbolic::expr::{Function, Rational};

/// The syntax of statements in Rust.
pub struct Rust;

impl Dialect for Rust {
    fn literal(&self, number: &Rational, wide: bool, calls: &mut Calls) -> String {
        match (wide, parts(number)) {
            (true, (high, 0.0)) => format!("{}({})", calls.to("wide_of"), decimal(high)),
            (true, (high, low)) => {
                format!("{}({}, {})", calls.to("wide_parts"), decimal(high), decimal(low))
            }
            (false, _) => format!("T::of({})", decimal(nearest(number))),
        }
    }

    fn pi(&self, wide: bool, calls: &mut Calls) -> String {
        if wide {
            format!("{}()", calls.to("wide_pi"))
        } else {
            "T::of(core::f64::consts::PI)".into()
        }
    }

    fn widened(&self, value: &str, calls: &mut Calls) -> String {
        format!("{}(T::to_f64({value}))", calls.to("wide_of"))
    }

    fn narrowed(&self, value: &str) -> String {
        format!("T::of({value}.high)")
    }

    fn member(&self, owner: Owner, name: &str) -> String {
        match owner {
            Owner::Parameters => format!("parameters.{name}"),
            Owner::Field | Owner::Time => format!("self.{name}"),
        }
    }

    fn function(&self, function: Function) -> String {
        format!("T::{}", function.name())
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("let {name} = {value};")
    }
}
