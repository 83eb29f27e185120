//! The syntax of numbers and functions in C++.

use crate::port::body::{Dialect, Owner, in_c_library};
use crate::port::number::{decimal, nearest};
use crate::port::support::Calls;
use mms_program::interpret::parts;
use mms_symbolic::expr::{Function, Rational, Symbol};

/// The syntax of statements in C++, for a field whose tensors have this number of rows.
pub struct Cpp(pub usize);

impl Dialect for Cpp {
    fn literal(&self, number: &Rational, wide: bool, calls: &mut Calls) -> String {
        match (wide, parts(number)) {
            (true, (high, 0.0)) => format!("{}({})", calls.to("wide_of"), decimal(high)),
            (true, (high, low)) => {
                format!("{}({}, {})", calls.to("wide_parts"), decimal(high), decimal(low))
            }
            (false, _) => format!("T({})", decimal(nearest(number))),
        }
    }

    fn pi(&self, wide: bool, calls: &mut Calls) -> String {
        if wide { format!("{}()", calls.to("wide_pi")) } else { "T(3.141592653589793)".into() }
    }

    /// Inputs are arrays: one for the coordinates, one for the rows of H.
    fn input(&self, symbol: Symbol, name: &str) -> String {
        match symbol {
            Symbol::Coordinate(axis) => format!("X[{axis}]"),
            Symbol::Normal(axis) => format!("N[{axis}]"),
            Symbol::Gradient(row, column) => format!("H[{}]", row * self.0 + column),
            _ => name.into(),
        }
    }

    fn widened(&self, value: &str, calls: &mut Calls) -> String {
        format!("{}(static_cast<double>({value}))", calls.to("wide_of"))
    }

    fn narrowed(&self, value: &str) -> String {
        format!("T({value}.high)")
    }

    fn member(&self, owner: Owner, name: &str) -> String {
        format!("{}.{name}", owner.name())
    }

    fn function(&self, function: Function) -> String {
        in_c_library(function).map_or(function.name().into(), |name| format!("std::{name}"))
    }

    fn statement(&self, name: &str, value: &str, wide: bool) -> String {
        format!("const {} {name} = {value};", if wide { "wide" } else { "T" })
    }
}
