//! How Python writes numbers and functions.

use crate::emit::port::body::{Dialect, Owner, in_c_library};
use crate::emit::port::number::{decimal, nearest};
use crate::expr::{Function, Rational};
use crate::program::interpret::parts;

/// What computes at points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `math`: one point at a time.
    Math,
    /// NumPy: arrays that broadcast.
    NumPy,
}

impl Dialect for Form {
    fn literal(&self, number: &Rational, wide: bool) -> String {
        match (wide, parts(number)) {
            (true, (high, 0.0)) => format!("_Wide({})", decimal(high)),
            (true, (high, low)) => format!("_Wide({}, {})", decimal(high), decimal(low)),
            (false, (value, _)) if value < 0.0 => format!("({})", decimal(value)),
            (false, _) => decimal(nearest(number)),
        }
    }

    fn pi(&self, wide: bool) -> String {
        if wide { "_PI".into() } else { "math.pi".into() }
    }

    fn widened(&self, value: &str) -> String {
        format!("_Wide(float({value}))")
    }

    fn narrowed(&self, value: &str) -> String {
        format!("{value}.high")
    }

    fn member(&self, owner: Owner, name: &str) -> String {
        match owner {
            Owner::Parameters => format!("parameters.{name}"),
            Owner::Field => format!("field._{name}"),
            Owner::Time => format!("self._{name}"),
        }
    }

    fn function(&self, function: Function) -> String {
        let Some(name) = in_c_library(function) else { return format!("_{}", function.name()) };
        match (self, function) {
            // Only Python 3.11 has it.
            (Form::Math, Function::Cbrt) => "_cbrt".into(),
            (Form::Math, _) => format!("math.{name}"),
            (Form::NumPy, Function::Powf) => "np.power".into(),
            (Form::NumPy, Function::Asin | Function::Acos | Function::Atan | Function::Atan2) => {
                format!("np.{}", name.replacen('a', "arc", 1))
            }
            (Form::NumPy, _) => format!("np.{name}"),
        }
    }

    fn wide_function(&self, function: Function) -> String {
        format!("_wide_{}", function.name())
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("{name} = {value}")
    }
}
