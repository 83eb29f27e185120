//! The common parts of ports to other languages.
//!
//! | module | holds |
//! |---|---|
//! | `callable` | the functions of a field, one list for all |
//! | `body` | the one printer of instructions, over the `Dialect` of a language |
//! | `faces` | the claim on each face, as data |
//! | `motion` | how far the motion goes, as data |
//! | `names` | a user's names under the rules of a language: words, case, length |
//! | `number` | literals, in decimal and hexadecimal |
//! | `support` | functions that a language lacks: the called ones of its support text |
//! | `lower` | a program in which functions that a language lacks are written out in those that it has |
//! | `once` | numbers without extra digits in the stages Parameter and Time |
//! | `docs` | the comments about a field |
//! | `vectors` | test vectors |
//! | `check` | the file of test vectors, the comments of check programs, and the functions that they call |
//!
//! A port is flat: one statement per instruction, no shared divisions, no fused products. The stages Parameter and
//! Time are computed in pairs of doubles, as in Rust, by support text in the language itself, in Julia in its own
//! numbers of 512 bits. Languages of expressions (UFL, MOOSE, Karamelo) have one precision, so that
//! subtracting turns from an angle gains no digits, and few functions; the others are written out. SymPy gets exact
//! numbers.

pub mod body;
pub mod callable;
pub mod check;
pub mod docs;
pub mod faces;
pub mod lower;
pub mod motion;
pub mod names;
pub mod number;
pub mod once;
pub mod support;
pub mod vectors;

use std::borrow::Cow;

use self::callable::{Callable, callables, input};
use self::names::{Rules, of_holder, of_own, unique};
use crate::target::Subject;
use mms_codegen::compile::Compiled;
use mms_codegen::liveness::Later;
use mms_mechanics::{Output, Program};
use mms_program::{Stage, Value};
use mms_symbolic::expr::{Function, Symbol};
use mms_symbolic::sorted::SortedMap;

/// The stages that are evaluated at a point.
pub const AT_POINTS: &[Stage] = &[Stage::Point, Stage::PointTime];

/// A field prepared for a target language.
pub struct Port<'a> {
    /// The field, and its test vectors.
    pub subject: &'a Subject<'a>,
    /// The field.
    pub compiled: &'a Compiled,
    program: Cow<'a, Program>,
    /// The name in the language, also used for file names.
    pub name: String,
    /// The parameters that are not frozen: their positions in the file, and their names in the language.
    pub parameters: SortedMap<usize, String>,
    /// The functions.
    pub callables: Vec<Callable>,
    /// Values that a prepared field holds: values of the Parameter stage that points read.
    pub kept: Vec<Value>,
    /// Values of the Parameter stage that the Time stage reads, kept with all digits.
    pub kept_wide: Vec<Value>,
    /// Values that a field at a time holds: values of both stages that points read.
    pub kept_at_times: Vec<Value>,
}

impl<'a> Port<'a> {
    /// The field under the rules of a language.
    pub fn new(subject: &'a Subject<'a>, rules: &Rules) -> Self {
        Self::of(subject, rules, Cow::Borrowed(&subject.compiled.program))
    }

    /// The field for a language that computes everything in one precision and has only the functions `has`.
    pub fn once(subject: &'a Subject<'a>, rules: &Rules, has: &[Function]) -> Self {
        let lowered = lower::lowered(&subject.compiled.program, has);
        let mut port = Self::of(subject, rules, Cow::Owned(lowered));
        let mut kept = std::mem::take(&mut port.kept_wide);
        kept.append(&mut port.kept);
        kept.sort();
        kept.dedup();
        port.kept = kept;
        port
    }

    fn of(subject: &'a Subject<'a>, rules: &Rules, program: Cow<'a, Program>) -> Self {
        let compiled = subject.compiled;
        let callables = named(callables(compiled), rules);
        let emitted = |output: &Output| callables.iter().any(|it| it.output == *output);
        let timed = |output: &Output| callables.iter().any(|it| it.output == *output && it.time);
        let mut read = Later::new(&program, emitted);
        read.outputs.clear();
        let kept_wide = read.kept_values(&[Stage::Parameter], &[Stage::Time]);
        let kept = Later::new(&program, emitted).kept_values(&[Stage::Parameter], AT_POINTS);
        let kept_at_times =
            Later::new(&program, timed).kept_values(&[Stage::Parameter, Stage::Time], AT_POINTS);
        let left = compiled.field.parameters.iter().enumerate();
        let (positions, names): (Vec<_>, Vec<_>) = left
            .filter(|(_, parameter)| !parameter.frozen)
            .map(|(position, parameter)| (position, parameter.name.value.as_str()))
            .unzip();
        let functions: Vec<&str> = callables.iter().map(|it| it.name.as_str()).collect();
        Port {
            subject,
            compiled,
            name: of_holder(compiled.field.name.raw(), rules, &functions),
            parameters: positions.into_iter().zip(unique(&names, rules)).collect(),
            callables,
            kept,
            kept_wide,
            kept_at_times,
            program,
        }
    }

    /// The program.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The number of coordinates of a point.
    pub fn dimension(&self) -> usize {
        self.compiled.field.dimension
    }

    /// The number of rows of a tensor.
    pub fn rows(&self) -> usize {
        self.compiled.field.space.rows()
    }

    /// The argument that supplies a leaf.
    pub fn input(&self, symbol: Symbol) -> String {
        input(self.compiled.field.space, symbol)
    }

    /// The components of an output.
    pub fn values(&self, output: Output) -> &[Value] {
        self.program().outputs.get(&output).map_or(&[], Vec::as_slice)
    }
}

/// The functions. The file's own quantities get names that the language accepts and no other function has.
fn named(mut callables: Vec<Callable>, rules: &Rules) -> Vec<Callable> {
    for place in 0..callables.len() {
        if callables[place].is_own() {
            let own = of_own(&callables[place].name, rules, &{
                let others = callables.iter().enumerate().filter(|(other, _)| *other != place);
                let axes = callables[place].space.axes().iter().copied();
                others.map(|(_, callable)| callable.name.as_str()).chain(axes).collect::<Vec<_>>()
            });
            callables[place].name = own;
        }
    }
    callables
}
