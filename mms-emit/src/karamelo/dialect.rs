//! The syntax of numbers and functions in Karamelo.

use crate::port::body::{Dialect, Owner};
use crate::port::number::nearest;
use crate::port::support::Calls;
use mms_program::Value;
use mms_symbolic::expr::{Function, Rational, Symbol};

/// The syntax of variables, for a field with this name.
pub struct Karamelo<'a>(pub &'a str);

impl Dialect for Karamelo<'_> {
    /// A number without an exponent, which not all versions read.
    fn literal(&self, number: &Rational, _wide: bool, _calls: &mut Calls) -> String {
        match nearest(number) {
            value if value < 0.0 => format!("(0-{})", -value),
            value => format!("{value}"),
        }
    }

    fn pi(&self, _wide: bool, _calls: &mut Calls) -> String {
        "PI".into()
    }

    fn input(&self, symbol: Symbol, name: &str) -> String {
        match symbol {
            Symbol::Coordinate(axis) => ["x0", "y0", "z0"][axis].into(),
            Symbol::Time => "time".into(),
            _ => name.into(),
        }
    }

    fn widened(&self, value: &str, _calls: &mut Calls) -> String {
        value.into()
    }

    fn narrowed(&self, value: &str) -> String {
        value.into()
    }

    fn member(&self, _owner: Owner, name: &str) -> String {
        format!("{}_{name}", self.0)
    }

    fn has_wide(&self) -> bool {
        false
    }

    fn function(&self, function: Function) -> String {
        match function {
            Function::Ln => "log".into(),
            other => other.name().into(),
        }
    }

    fn negated(&self, a: &str, _wide: bool, _calls: &mut Calls) -> String {
        format!("0-{a}")
    }

    fn local(&self, value: Value, _wide: bool) -> String {
        format!("{}_{}", self.0, value.index())
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("{name} = {value}")
    }
}
