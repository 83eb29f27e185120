//! One printer of instructions for all languages.

use super::callable::Callable;
use super::support::Calls;
use super::{AT_POINTS, Port};
use mms_mechanics::Output;
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
    /// The operator as text.
    pub fn sign(self) -> &'static str {
        match self {
            Arithmetic::Add => "+",
            Arithmetic::Subtract => "-",
            Arithmetic::Multiply => "*",
            Arithmetic::Divide => "/",
        }
    }

    /// The function of the support text that computes the operation with twice the digits, in languages without operators for
    /// it.
    pub fn wide_name(self) -> &'static str {
        match self {
            Arithmetic::Add => "wide_add",
            Arithmetic::Subtract => "wide_sub",
            Arithmetic::Multiply => "wide_mul",
            Arithmetic::Divide => "wide_div",
        }
    }
}

/// An argument that holds values computed before.
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
    /// The name of the argument in languages without a convention of their own.
    pub fn name(self) -> &'static str {
        match self {
            Owner::Parameters => "parameters",
            Owner::Field => "field",
            Owner::Time => "now",
        }
    }
}

/// The name of a function in the mathematical library of C, and of languages that adopted it; `None` if it has no such
/// function.
pub fn in_c_library(function: Function) -> Option<&'static str> {
    match function {
        Function::Ln => Some("log"),
        Function::Ln1p => Some("log1p"),
        Function::ExpM1 => Some("expm1"),
        Function::Powf => Some("pow"),
        Function::Ln1pRest
        | Function::SinPi
        | Function::CosPi
        | Function::WithinTurns
        | Function::WithinTurnsPi => None,
        other => Some(other.name()),
    }
}

/// The syntax of a language for the parts of a program. If `wide` is true, a number has twice the digits of a double. An
/// implementation that writes a function of the support text records it in `calls`; the printer itself records functions of
/// programs.
pub trait Dialect {
    /// A constant as an operand; a negative one is written in brackets.
    fn literal(&self, number: &Rational, wide: bool, calls: &mut Calls) -> String;
    /// pi.
    fn pi(&self, wide: bool, calls: &mut Calls) -> String;
    /// The expression that supplies a leaf in the function being written; `name` is the argument that holds it.
    fn input(&self, _symbol: Symbol, name: &str) -> String {
        name.into()
    }
    /// A number of the caller with twice the digits.
    fn widened(&self, value: &str, calls: &mut Calls) -> String;
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
    /// A call of a function; arguments are names, literals or members.
    fn call(&self, function: Function, arguments: &[String]) -> String {
        format!("{}({})", self.function(function), arguments.join(", "))
    }
    /// The name of a function of twice the digits.
    fn wide_function(&self, function: Function) -> String {
        format!("wide_{}", function.name())
    }
    /// Arithmetic.
    fn arithmetic(
        &self,
        operation: Arithmetic,
        a: &str,
        b: &str,
        _wide: bool,
        _calls: &mut Calls,
    ) -> String {
        format!("{a} {} {b}", operation.sign())
    }
    /// -a.
    fn negated(&self, a: &str, _wide: bool, _calls: &mut Calls) -> String {
        format!("-{a}")
    }
    /// The name of a value in the function that computes it.
    fn local(&self, value: Value, wide: bool) -> String {
        local(value, wide)
    }
    /// The statement that assigns a value to a new name.
    fn statement(&self, name: &str, value: &str, wide: bool) -> String;
}

/// The function being printed, which determines where its operands are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Context {
    /// The function that prepares a field.
    Parameters,
    /// The function that computes a field at a time.
    Times,
    /// A function of points, of a field at a time or of a prepared field alone.
    Points {
        /// Whether the function depends on time.
        timed: bool,
    },
    /// A function that computes everything from the parameters.
    Everything,
}

impl Context {
    fn computes(self, stage: Stage) -> bool {
        match self {
            Context::Parameters => stage == Stage::Parameter,
            Context::Times => stage == Stage::Time,
            Context::Points { .. } => AT_POINTS.contains(&stage),
            Context::Everything => true,
        }
    }

    fn is_wide(self) -> bool {
        matches!(self, Context::Parameters | Context::Times)
    }
}

/// The name of a value in a function.
pub fn local(value: Value, wide: bool) -> String {
    format!("{}{}", if wide { "w" } else { "q" }, value.index())
}

/// The body of a function.
pub struct Body {
    /// The statements.
    pub statements: Vec<String>,
    /// The names that they define.
    pub locals: Vec<String>,
    /// The results.
    pub results: Vec<String>,
    /// The arguments that the body reads.
    pub inputs: Vec<Symbol>,
    /// Whether the body reads values kept by an earlier stage.
    pub reads_kept: bool,
    /// Whether the statements compute with twice the digits.
    pub is_wide: bool,
    /// The functions that the body calls.
    pub calls: Calls,
}

impl Body {
    /// Whether the body reads a parameter.
    pub fn reads_parameters(&self) -> bool {
        self.inputs.iter().any(|symbol| matches!(symbol, Symbol::Parameter(_)))
    }
}

/// The bodies of all functions of a field.
pub struct Bodies {
    /// The body of the function that computes the default of each parameter.
    pub defaults: Body,
    /// The body of the function that prepares a field. Results: the kept values, then the values kept with twice the digits.
    pub prepare: Body,
    /// The body of the function that computes a field at a time.
    pub at_time: Body,
    /// The bodies of the port's other functions, in order.
    pub callables: Vec<Body>,
}

impl Bodies {
    fn all(&self) -> impl Iterator<Item = &Body> {
        [&self.defaults, &self.prepare, &self.at_time].into_iter().chain(&self.callables)
    }

    /// The functions that the bodies call.
    pub fn calls(&self) -> Calls {
        let mut calls = Calls::default();
        self.all().for_each(|body| calls.extend(&body.calls));
        calls
    }

    /// Whether any body computes with twice the digits.
    pub fn are_wide(&self) -> bool {
        self.all().any(|body| body.is_wide)
    }
}

impl Port<'_> {
    /// The bodies of all functions in a language.
    pub fn bodies(&self, dialect: &dyn Dialect) -> Bodies {
        let defaults = self.parameters.keys().map(|it| self.values(Output::Parameter(*it))[0]);
        let defaults: Vec<Value> = defaults.collect();
        let kept: Vec<Value> = self.kept.iter().chain(&self.kept_wide).copied().collect();
        let of = |callable: &Callable| {
            let place = Context::Points { timed: callable.time };
            self.body(dialect, self.values(callable.output), place)
        };
        Bodies {
            defaults: self.body(dialect, &defaults, Context::Parameters),
            prepare: self.body(dialect, &kept, Context::Parameters),
            at_time: self.body(dialect, &self.kept_at_times, Context::Times),
            callables: self.callables.iter().map(of).collect(),
        }
    }

    /// The functions of a field, each with its body.
    pub fn with_bodies<'a>(
        &'a self,
        bodies: &'a Bodies,
    ) -> impl Iterator<Item = (&'a Callable, &'a Body)> {
        self.callables.iter().zip(&bodies.callables)
    }

    /// The body that computes `roots` in a function, as they are kept or returned.
    pub fn body(&self, dialect: &dyn Dialect, roots: &[Value], place: Context) -> Body {
        self.body_of(dialect, roots, place, self.program().needed_for(roots.iter().copied()))
    }

    /// The body that computes `roots` with the `needed` instructions only; all other values are read by name.
    pub fn body_of(
        &self,
        dialect: &dyn Dialect,
        roots: &[Value],
        place: Context,
        needed: Vec<bool>,
    ) -> Body {
        let program = self.program();
        let computed =
            |index: &usize| needed[*index] && place.computes(program.instrs[*index].stage);
        let wide = place.is_wide() && dialect.has_wide();
        let mut printer = Printer { port: self, dialect, place, wide, calls: Calls::default() };
        let (mut statements, mut locals) = (Vec::new(), Vec::new());
        let results = roots.iter().map(|root| printer.result(*root)).collect();
        let mut read: Vec<Value> = roots.to_vec();
        for index in (0..program.instrs.len()).filter(computed) {
            let instr = &program.instrs[index];
            read.extend(instr.op.operands());
            let Some(value) = printer.operation(&instr.op) else { continue };
            let name = dialect.local(Value(index as u32), wide);
            statements.push(dialect.statement(&name, &value, wide));
            locals.push(name);
        }
        let (mut inputs, mut reads_kept) = (Vec::new(), false);
        for value in read {
            let instr = program.instr(value);
            match instr.op {
                Op::Constant(_) | Op::Pi => {}
                Op::Input(symbol) if place.computes(instr.stage) => inputs.push(symbol),
                _ => reads_kept |= !place.computes(instr.stage),
            }
        }
        inputs.sort();
        inputs.dedup();
        let is_wide = wide && !statements.is_empty();
        Body { statements, locals, results, inputs, reads_kept, is_wide, calls: printer.calls }
    }
}

/// Prints the instructions of one function, and records the functions that they call.
struct Printer<'a> {
    port: &'a Port<'a>,
    dialect: &'a dyn Dialect,
    place: Context,
    wide: bool,
    calls: Calls,
}

impl Printer<'_> {
    /// The right side of a statement; `None` if the value needs no statement.
    fn operation(&mut self, op: &Op) -> Option<String> {
        match op {
            Op::Constant(_) | Op::Pi => None,
            Op::Input(Symbol::Parameter(index)) => {
                let parameter =
                    self.dialect.member(Owner::Parameters, &self.port.parameters[index]);
                Some(self.dialect.widened(&parameter, &mut self.calls))
            }
            Op::Input(_) => None,
            Op::Add(a, b) => self.arithmetic(Arithmetic::Add, *a, *b),
            Op::Subtract(a, b) => self.arithmetic(Arithmetic::Subtract, *a, *b),
            Op::Multiply(a, b) => self.arithmetic(Arithmetic::Multiply, *a, *b),
            Op::Divide(a, b) => self.arithmetic(Arithmetic::Divide, *a, *b),
            Op::Negate(a) => {
                let a = self.operand(*a);
                Some(self.dialect.negated(&a, self.wide, &mut self.calls))
            }
            // Other languages have no use for the proved range of an angle.
            Op::Unary(function, _, a) => Some(self.call(*function, &[*a])),
            Op::Binary(function, a, b) => Some(self.call(*function, &[*a, *b])),
        }
    }

    fn arithmetic(&mut self, operation: Arithmetic, a: Value, b: Value) -> Option<String> {
        let (a, b) = (self.operand(a), self.operand(b));
        Some(self.dialect.arithmetic(operation, &a, &b, self.wide, &mut self.calls))
    }

    fn call(&mut self, function: Function, arguments: &[Value]) -> String {
        let arguments: Vec<String> = arguments.iter().map(|value| self.operand(*value)).collect();
        if self.wide {
            let name = self.dialect.wide_function(function);
            return format!("{}({})", self.calls.to(&name), arguments.join(", "));
        }
        self.calls.to(&self.dialect.function(function));
        self.dialect.call(function, &arguments)
    }

    /// The text by which a function reads a value: a literal, a local, an argument, or a value kept by an earlier stage.
    fn operand(&mut self, value: Value) -> String {
        let (dialect, place, wide) = (self.dialect, self.place, self.wide);
        let instr = self.port.program().instr(value);
        match &instr.op {
            Op::Constant(number) => return dialect.literal(number, wide, &mut self.calls),
            Op::Pi => return dialect.pi(wide, &mut self.calls),
            Op::Input(symbol)
                if place.computes(instr.stage) && !matches!(symbol, Symbol::Parameter(_)) =>
            {
                let name = dialect.input(*symbol, &self.port.input(*symbol));
                return if wide { dialect.widened(&name, &mut self.calls) } else { name };
            }
            _ => {}
        }
        let name = local(value, wide);
        match place {
            _ if place.computes(instr.stage) => dialect.local(value, wide),
            Context::Points { timed: true } => dialect.member(Owner::Time, &name),
            _ => dialect.member(Owner::Field, &name),
        }
    }

    /// A value in the caller's precision.
    fn result(&mut self, value: Value) -> String {
        let dialect = self.dialect;
        let instr = self.port.program().instr(value);
        match &instr.op {
            Op::Constant(number) => dialect.literal(number, false, &mut self.calls),
            Op::Pi => dialect.pi(false, &mut self.calls),
            Op::Input(Symbol::Time) if self.place == Context::Times => {
                dialect.input(Symbol::Time, "t")
            }
            _ if self.place == Context::Times && instr.stage == Stage::Parameter => {
                dialect.member(Owner::Field, &local(value, false))
            }
            _ if self.wide => dialect.narrowed(&self.operand(value)),
            _ => self.operand(value),
        }
    }
}
