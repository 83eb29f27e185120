//! The syntax of numbers and functions in Fortran.

use crate::port::body::{Dialect, Owner};
use crate::port::number::{decimal, nearest};
use crate::port::support::Calls;
use mms_program::interpret::parts;
use mms_symbolic::expr::{Function, Rational};

/// The syntax of statements in Fortran.
pub struct Fortran;

impl Dialect for Fortran {
    fn literal(&self, number: &Rational, wide: bool, calls: &mut Calls) -> String {
        match (wide, parts(number)) {
            (true, (high, 0.0)) => format!("{}({}_dp)", calls.to("wide_of"), decimal(high)),
            (true, (high, low)) => {
                format!("{}({}_dp, {}_dp)", calls.to("wide"), decimal(high), decimal(low))
            }
            (false, (value, _)) if value < 0.0 => format!("({}_wp)", decimal(value)),
            (false, _) => format!("{}_wp", decimal(nearest(number))),
        }
    }

    fn pi(&self, wide: bool, calls: &mut Calls) -> String {
        if wide { format!("{}()", calls.to("wide_pi")) } else { "3.141592653589793_wp".into() }
    }

    fn widened(&self, value: &str, calls: &mut Calls) -> String {
        format!("{}(real({value}, dp))", calls.to("wide_of"))
    }

    fn narrowed(&self, value: &str) -> String {
        format!("real({value}%high, wp)")
    }

    fn member(&self, owner: Owner, name: &str) -> String {
        format!("{}%{name}", owner.name())
    }

    fn function(&self, function: Function) -> String {
        let name = match function {
            Function::Ln => "log",
            Function::Cbrt => "cubic_root",
            Function::Powf => "power",
            _ => function.name(),
        };
        name.into()
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("{name} = {value}")
    }
}
