//! One printer of instructions for all languages.

use super::callable::input;
use super::{AT_POINTS, Port};
use mms_program::{Op, Stage, Value};
use mms_symbolic::expr::{Function, Rational, Symbol};

/// An operation that most languages write between its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arithmetic {
    /// +
    Add,
    /// -
    Subtract,
    /// *
    Multiply,
    /// /
    Divide,
}

impl Arithmetic {
    /// Its sign.
    pub fn sign(self) -> &'static str {
        match self {
            Arithmetic::Add => "+",
            Arithmetic::Subtract => "-",
            Arithmetic::Multiply => "*",
            Arithmetic::Divide => "/",
        }
    }
}

/// An argument that keeps what was computed before.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// The parameters.
    Parameters,
    /// The prepared field.
    Field,
    /// The field at a time.
    Time,
}

impl Owner {
    /// What the argument is called where a language has no custom of its own.
    pub fn name(self) -> &'static str {
        match self {
            Owner::Parameters => "parameters",
            Owner::Field => "field",
            Owner::Time => "now",
        }
    }
}

/// The name that a function has in the mathematical library of C, and of languages that took it over; none
/// where there is no such function.
pub fn in_c_library(function: Function) -> Option<&'static str> {
    match function {
        Function::Ln => Some("log"),
        Function::Ln1p => Some("log1p"),
        Function::ExpM1 => Some("expm1"),
        Function::Powf => Some("pow"),
        Function::Ln1pRest
        | Function::SinNearZero
        | Function::CosNearZero
        | Function::SinWithinOne
        | Function::CosWithinOne
        | Function::SinPi
        | Function::CosPi
        | Function::WithinTurns
        | Function::WithinTurnsPi
        | Function::Offset => None,
        Function::Sqrt
        | Function::Cbrt
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
        | Function::Atan2 => Some(function.name()),
    }
}

/// How a language writes what programs are made of. `wide` says that a number has twice the digits of
/// a double.
pub trait Dialect {
    /// A constant as an operand; one below 0 stands in brackets.
    fn literal(&self, number: &Rational, wide: bool) -> String;
    /// pi.
    fn pi(&self, wide: bool) -> String;
    /// What supplies a leaf in the function that is being written.
    fn input(&self, name: &str) -> String {
        name.into()
    }
    /// A number of the caller with twice the digits.
    fn widened(&self, value: &str) -> String;
    /// The nearest number of the caller's precision.
    fn narrowed(&self, value: &str) -> String;
    /// A member of an argument.
    fn member(&self, owner: Owner, name: &str) -> String;
    /// Whether the language computes what needs only parameters and the time with twice the digits.
    fn has_wide(&self) -> bool {
        true
    }
    /// The name of a function of the caller's precision.
    fn function(&self, function: Function) -> String;
    /// A call of it; arguments are names, literals or members.
    fn call(&self, function: Function, arguments: &[String]) -> String {
        format!("{}({})", self.function(function), arguments.join(", "))
    }
    /// The name of a function of twice the digits.
    fn wide_function(&self, function: Function) -> String {
        format!("wide_{}", function.name())
    }
    /// Arithmetic.
    fn arithmetic(&self, operation: Arithmetic, a: &str, b: &str, _wide: bool) -> String {
        format!("{a} {} {b}", operation.sign())
    }
    /// -a.
    fn negated(&self, a: &str, _wide: bool) -> String {
        format!("-{a}")
    }
    /// What a value is called in the function that computes it.
    fn local(&self, value: Value, wide: bool) -> String {
        local(value, wide)
    }
    /// The statement that gives a new name to a value.
    fn statement(&self, name: &str, value: &str, wide: bool) -> String;
}

/// Which function is being written, and so where operands are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// That which prepares a field.
    Parameters,
    /// That which goes to a time.
    Times,
    /// One of points, of a field at a time or of a prepared field alone.
    Points {
        /// Whether it is of a time.
        timed: bool,
    },
    /// One that computes everything, from the parameters on.
    Everything,
}

impl Place {
    fn computes(self, stage: Stage) -> bool {
        match self {
            Place::Parameters => stage == Stage::Parameter,
            Place::Times => stage == Stage::Time,
            Place::Points { .. } => AT_POINTS.contains(&stage),
            Place::Everything => true,
        }
    }

    fn is_wide(self) -> bool {
        matches!(self, Place::Parameters | Place::Times)
    }
}

/// The name of a value in a function.
pub fn local(value: Value, wide: bool) -> String {
    format!("{}{}", if wide { "w" } else { "q" }, value.index())
}

/// The body of a function.
pub struct Body {
    /// Its statements.
    pub statements: Vec<String>,
    /// The names that they define.
    pub locals: Vec<String>,
    /// Its results.
    pub results: Vec<String>,
    /// The arguments that it reads.
    pub inputs: Vec<Symbol>,
    /// Whether it reads what an earlier stage kept.
    pub reads_kept: bool,
}

impl Port<'_> {
    /// What computes `roots` in a function, as they are kept or returned.
    pub fn body(&self, dialect: &dyn Dialect, roots: &[Value], place: Place) -> Body {
        self.body_of(dialect, roots, place, self.program().needed_for(roots.iter().copied()))
    }

    /// The same, of the instructions that are needed there: others are known by their names.
    pub fn body_of(
        &self,
        dialect: &dyn Dialect,
        roots: &[Value],
        place: Place,
        needed: Vec<bool>,
    ) -> Body {
        let program = self.program();
        let computed =
            |index: &usize| needed[*index] && place.computes(program.instrs[*index].stage);
        let mut body = Body {
            statements: Vec::new(),
            locals: Vec::new(),
            results: roots.iter().map(|root| self.result(dialect, *root, place)).collect(),
            inputs: Vec::new(),
            reads_kept: false,
        };
        let mut read: Vec<Value> = roots.to_vec();
        for index in (0..program.instrs.len()).filter(computed) {
            let instr = &program.instrs[index];
            read.extend(instr.op.operands());
            let Some(value) = self.operation(dialect, &instr.op, place) else { continue };
            let wide = place.is_wide() && dialect.has_wide();
            let name = dialect.local(Value(index as u32), wide);
            body.statements.push(dialect.statement(&name, &value, wide));
            body.locals.push(name);
        }
        for value in read {
            let instr = program.instr(value);
            match instr.op {
                Op::Constant(_) | Op::Pi => {}
                Op::Input(symbol) if place.computes(instr.stage) => body.inputs.push(symbol),
                _ => body.reads_kept |= !place.computes(instr.stage),
            }
        }
        body.inputs.sort();
        body.inputs.dedup();
        body
    }

    /// The right side of a statement; none where the value needs no statement.
    fn operation(&self, dialect: &dyn Dialect, op: &Op, place: Place) -> Option<String> {
        let wide = place.is_wide() && dialect.has_wide();
        let of = |value: &Value| self.operand(dialect, *value, place);
        let call = |function, arguments: &[String]| match wide {
            true => format!("{}({})", dialect.wide_function(function), arguments.join(", ")),
            false => dialect.call(function, arguments),
        };
        let arithmetic = |operation, a: &Value, b: &Value| {
            Some(dialect.arithmetic(operation, &of(a), &of(b), wide))
        };
        match op {
            Op::Constant(_) | Op::Pi => None,
            Op::Input(Symbol::Parameter(index)) => {
                Some(dialect.widened(&dialect.member(Owner::Parameters, &self.parameters[index])))
            }
            Op::Input(_) => None,
            Op::Add(a, b) => arithmetic(Arithmetic::Add, a, b),
            Op::Subtract(a, b) => arithmetic(Arithmetic::Subtract, a, b),
            Op::Multiply(a, b) => arithmetic(Arithmetic::Multiply, a, b),
            Op::Divide(a, b) => arithmetic(Arithmetic::Divide, a, b),
            Op::Negate(a) => Some(dialect.negated(&of(a), wide)),
            Op::Unary(function, a) => Some(call(*function, &[of(a)])),
            Op::Binary(function, a, b) => Some(call(*function, &[of(a), of(b)])),
        }
    }

    /// How a function reads a value: a literal, a local, an argument, or what an earlier stage kept.
    fn operand(&self, dialect: &dyn Dialect, value: Value, place: Place) -> String {
        let wide = place.is_wide() && dialect.has_wide();
        let instr = self.program().instr(value);
        match &instr.op {
            Op::Constant(number) => return dialect.literal(number, wide),
            Op::Pi => return dialect.pi(wide),
            Op::Input(symbol)
                if place.computes(instr.stage) && !matches!(symbol, Symbol::Parameter(_)) =>
            {
                let name = dialect.input(&input(*symbol));
                return if wide { dialect.widened(&name) } else { name };
            }
            _ => {}
        }
        let name = local(value, wide);
        match place {
            _ if place.computes(instr.stage) => dialect.local(value, wide),
            Place::Points { timed: true } => dialect.member(Owner::Time, &name),
            _ => dialect.member(Owner::Field, &name),
        }
    }

    /// A value in the caller's precision.
    fn result(&self, dialect: &dyn Dialect, value: Value, place: Place) -> String {
        let instr = self.program().instr(value);
        match &instr.op {
            Op::Constant(number) => dialect.literal(number, false),
            Op::Pi => dialect.pi(false),
            Op::Input(Symbol::Time) if place == Place::Times => dialect.input("t"),
            _ if place == Place::Times && instr.stage == Stage::Parameter => {
                dialect.member(Owner::Field, &local(value, false))
            }
            _ if place.is_wide() && dialect.has_wide() => {
                dialect.narrowed(&self.operand(dialect, value, place))
            }
            _ => self.operand(dialect, value, place),
        }
    }
}
