//! The syntax of numbers and functions in Julia.

use crate::port::body::{Dialect, Owner, in_c_library};
use crate::port::number::{decimal, nearest};
use crate::port::support::Calls;
use mms_program::interpret::parts;
use mms_symbolic::expr::{Function, Rational};

/// The syntax of statements in Julia. Its own numbers of any precision replace numbers with twice the digits of a double.
pub struct Julia;

impl Dialect for Julia {
    fn literal(&self, number: &Rational, wide: bool, _calls: &mut Calls) -> String {
        match (wide, parts(number)) {
            (true, (high, 0.0)) => format!("wide({})", decimal(high)),
            (true, (high, low)) => format!("wide({}, {})", decimal(high), decimal(low)),
            (false, _) => format!("T({})", decimal(nearest(number))),
        }
    }

    fn pi(&self, wide: bool, _calls: &mut Calls) -> String {
        if wide { "BigFloat(pi)".into() } else { "T(pi)".into() }
    }

    fn widened(&self, value: &str, _calls: &mut Calls) -> String {
        format!("wide({value})")
    }

    fn narrowed(&self, value: &str) -> String {
        format!("T({value})")
    }

    fn member(&self, owner: Owner, name: &str) -> String {
        format!("{}.{name}", owner.name())
    }

    fn function(&self, function: Function) -> String {
        let name = match function {
            Function::SinPi => "sinpi",
            Function::CosPi => "cospi",
            Function::Atan2 => "atan",
            Function::Powf => "^",
            _ => in_c_library(function).unwrap_or(function.name()),
        };
        name.into()
    }

    fn call(&self, function: Function, arguments: &[String]) -> String {
        match function {
            Function::Powf => arguments.join("^"),
            _ => format!("{}({})", self.function(function), arguments.join(", ")),
        }
    }

    fn wide_function(&self, function: Function) -> String {
        self.function(function)
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("{name} = {value}")
    }
}
