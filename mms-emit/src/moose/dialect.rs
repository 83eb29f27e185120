//! The syntax of numbers and functions of the Function Parser.

use crate::port::body::{Dialect, Owner};
use crate::port::number::{decimal, nearest};
use crate::port::support::Calls;
use mms_symbolic::expr::{Function, Rational, Symbol};

/// The syntax of statements in a ParsedFunction.
pub struct Moose;

impl Dialect for Moose {
    fn literal(&self, number: &Rational, _wide: bool, _calls: &mut Calls) -> String {
        match nearest(number) {
            value if value < 0.0 => format!("({})", decimal(value)),
            value => decimal(value),
        }
    }

    fn pi(&self, _wide: bool, _calls: &mut Calls) -> String {
        decimal(std::f64::consts::PI)
    }

    fn input(&self, symbol: Symbol, name: &str) -> String {
        match symbol {
            Symbol::Coordinate(axis) => ["x", "y", "z"][axis].into(),
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
        format!("p_{name}")
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

    /// A call; sin(pi x) and cos(pi x) subtract half turns without error, each of which changes the sign.
    fn call(&self, function: Function, arguments: &[String]) -> String {
        let (x, pi) = (&arguments[0], decimal(std::f64::consts::PI));
        let turns = format!("floor({x} + 0.5)");
        let sign = format!("(1 - 2*({turns} - 2*floor(0.5*{turns})))");
        match function {
            Function::SinPi => format!("{sign}*sin({pi}*({x} - {turns}))"),
            Function::CosPi => format!("{sign}*sin({pi}*(0.5 - abs({x} - {turns})))"),
            Function::Powf => arguments.join("^"),
            _ => format!("{}({})", self.function(function), arguments.join(", ")),
        }
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("{name} := {value};")
    }
}
