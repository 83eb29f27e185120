//! The syntax of numbers and functions in Python.

use crate::port::body::{Dialect, Owner, in_c_library};
use crate::port::number::{decimal, nearest};
use crate::port::support::Calls;
use mms_program::interpret::parts;
use mms_symbolic::expr::{Function, Rational};

/// The library that computes at points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Library {
    /// `math`: one point at a time.
    Math,
    /// NumPy: arrays that broadcast.
    NumPy,
    /// SymPy: expressions with exact numbers.
    SymPy,
    /// UFL: expressions of finite elements.
    Ufl,
}

impl Library {
    /// Whether the library builds expressions: then nothing is gained by computing parts of them in advance.
    pub fn is_of_expressions(self) -> bool {
        matches!(self, Library::SymPy | Library::Ufl)
    }
}

/// The name of a function in SymPy, or the written-out formula of a function that SymPy lacks.
fn in_sympy(function: Function, arguments: &[String]) -> String {
    let argument = &arguments[0];
    match function {
        Function::Ln1p => format!("sp.log(1 + {argument})"),
        Function::Ln1pRest => format!("({argument} - sp.log(1 + {argument}))"),
        Function::ExpM1 => format!("(sp.exp({argument}) - 1)"),
        Function::SinPi => format!("sp.sin(PI*{argument})"),
        Function::CosPi => format!("sp.cos(PI*{argument})"),
        Function::Cbrt => format!("sp.sign({argument})*sp.Abs({argument})**sp.Rational(1, 3)"),
        Function::Powf => format!("{argument}**{}", arguments[1]),
        _ => {
            let name = in_c_library(function).unwrap_or(function.name());
            format!("sp.{name}({})", arguments.join(", "))
        }
    }
}

/// An exact number of SymPy.
fn exact(number: &Rational) -> String {
    match number.denominator().is_one() {
        true => format!("sp.Integer({})", number.numerator()),
        false => format!("sp.Rational({}, {})", number.numerator(), number.denominator()),
    }
}

impl Dialect for Library {
    fn literal(&self, number: &Rational, wide: bool, calls: &mut Calls) -> String {
        if *self == Library::SymPy {
            return exact(number);
        }
        match (wide, parts(number)) {
            (true, (high, 0.0)) => format!("{}({})", calls.to("_Wide"), decimal(high)),
            (true, (high, low)) => {
                format!("{}({}, {})", calls.to("_Wide"), decimal(high), decimal(low))
            }
            (false, (value, _)) if value < 0.0 => format!("({})", decimal(value)),
            (false, _) => decimal(nearest(number)),
        }
    }

    fn pi(&self, wide: bool, calls: &mut Calls) -> String {
        match self {
            Library::SymPy => "PI".into(),
            _ if wide => calls.to("_PI").into(),
            _ => calls.to("math.pi").into(),
        }
    }

    fn has_wide(&self) -> bool {
        !self.is_of_expressions()
    }

    fn widened(&self, value: &str, calls: &mut Calls) -> String {
        match self {
            Library::SymPy => format!("sp.sympify({value})"),
            Library::Ufl => value.into(),
            Library::Math | Library::NumPy => format!("{}(float({value}))", calls.to("_Wide")),
        }
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
            (Library::Math, Function::Cbrt) => "_cbrt".into(),
            (Library::Ufl, Function::Ln) => "ufl.ln".into(),
            (Library::Ufl, _) => format!("ufl.{name}"),
            (Library::SymPy, _) => format!("sp.{name}"),
            (Library::Math, _) => format!("math.{name}"),
            (Library::NumPy, Function::Powf) => "np.power".into(),
            (
                Library::NumPy,
                Function::Asin | Function::Acos | Function::Atan | Function::Atan2,
            ) => {
                format!("np.{}", name.replacen('a', "arc", 1))
            }
            (Library::NumPy, _) => format!("np.{name}"),
        }
    }

    fn call(&self, function: Function, arguments: &[String]) -> String {
        match (self, function) {
            (Library::SymPy, _) => in_sympy(function, arguments),
            (Library::Ufl, Function::Powf) => arguments.join("**"),
            _ => format!("{}({})", self.function(function), arguments.join(", ")),
        }
    }

    fn wide_function(&self, function: Function) -> String {
        format!("_wide_{}", function.name())
    }

    fn statement(&self, name: &str, value: &str, _wide: bool) -> String {
        format!("{name} = {value}")
    }
}
