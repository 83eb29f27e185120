//! The syntax of numbers and functions in Octave and MATLAB.

use crate::port::body::{Arithmetic, Dialect, Owner, in_c_library};
use crate::port::number::{decimal, nearest};
use crate::port::support::Calls;
use mms_program::interpret::parts;
use mms_symbolic::expr::{Function, Rational};

/// The syntax of statements in Octave.
pub struct Octave;

impl Dialect for Octave {
    fn literal(&self, number: &Rational, wide: bool, _calls: &mut Calls) -> String {
        match (wide, parts(number)) {
            (true, (high, low)) => format!("[{}, {}]", decimal(high), decimal(low)),
            (false, (value, _)) if value < 0.0 => format!("({})", decimal(value)),
            (false, _) => decimal(nearest(number)),
        }
    }

    fn pi(&self, wide: bool, calls: &mut Calls) -> String {
        if wide { format!("{}()", calls.to("wide_pi")) } else { "pi".into() }
    }

    fn widened(&self, value: &str, calls: &mut Calls) -> String {
        format!("{}(double({value}))", calls.to("wide_of"))
    }

    fn narrowed(&self, value: &str) -> String {
        format!("{value}(1)")
    }

    fn member(&self, owner: Owner, name: &str) -> String {
        format!("{}.{name}", owner.name())
    }

    fn function(&self, function: Function) -> String {
        let name = match function {
            Function::Cbrt => "cubic_root",
            Function::Powf => "power",
            _ => in_c_library(function).unwrap_or(function.name()),
        };
        name.into()
    }

    fn arithmetic(
        &self,
        operation: Arithmetic,
        a: &str,
        b: &str,
        wide: bool,
        calls: &mut Calls,
    ) -> String {
        match (wide, operation) {
            (true, _) => format!("{}({a}, {b})", calls.to(operation.wide_name())),
            (false, Arithmetic::Add | Arithmetic::Subtract) => {
                format!("{a} {} {b}", operation.sign())
            }
            // Element by element.
            (false, _) => format!("{a} .{} {b}", operation.sign()),
        }
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("{name} = {value};")
    }
}
