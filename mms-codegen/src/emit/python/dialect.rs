//! How Python writes numbers and functions.

use crate::emit::port::body::Dialect;
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

    fn parameter(&self, name: &str) -> String {
        format!("parameters.{name}")
    }

    fn of_field(&self, name: &str) -> String {
        format!("field._{name}")
    }

    fn of_time(&self, name: &str) -> String {
        format!("self._{name}")
    }

    fn function(&self, function: Function, wide: bool) -> String {
        if wide {
            return format!("_wide_{}", function.name());
        }
        let (library, is_numpy) = match self {
            Form::Math => ("math", false),
            Form::NumPy => ("np", true),
        };
        let own = match function {
            Function::Ln1pRest | Function::SinPi | Function::CosPi => {
                return format!("_{}", function.name());
            }
            Function::Cbrt if !is_numpy => return "_cbrt".into(),
            Function::Ln => "log",
            Function::Ln1p => "log1p",
            Function::ExpM1 => "expm1",
            Function::Powf if is_numpy => "power",
            Function::Powf => "pow",
            Function::Asin if is_numpy => "arcsin",
            Function::Acos if is_numpy => "arccos",
            Function::Atan if is_numpy => "arctan",
            Function::Atan2 if is_numpy => "arctan2",
            Function::Cbrt
            | Function::Sqrt
            | Function::Exp
            | Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh
            | Function::Asin
            | Function::Acos
            | Function::Atan
            | Function::Atan2 => function.name(),
        };
        format!("{library}.{own}")
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("{name} = {value}")
    }
}
