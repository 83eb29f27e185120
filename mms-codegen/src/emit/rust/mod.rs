//! Rust: a module of kernels over arrays, generic in the scalar, and their face to the runtime.

mod adapter;
mod kernel;

use proc_macro2::{Ident, Span, TokenStream};
use quote::{format_ident, quote};

use crate::compile::Compiled;
use crate::expr::{Rational, Symbol};
use crate::program::interpret::small_ratio;
use crate::program::{Op, Output, Program, Stage, Value};

/// The crate that generated code finds the scalar trait and the contract in.
const RUNTIME: &str = "mms_runtime";

/// A field as a module named after it: kernels, and the contract of the runtime.
pub fn module(compiled: &Compiled) -> TokenStream {
    let emitter = Emitter::new(compiled);
    let name = identifier(&compiled.field.name);
    let runtime = Ident::new(RUNTIME, Span::call_site());
    let doc = format!(" {}.", compiled.field.title);
    let reference = compiled.field.reference.as_ref().map(|reference| {
        let text = format!("\n Source: {reference}.");
        quote!(#![doc = #text])
    });
    let parameters = emitter.parameters();
    let field = emitter.field();
    let at_time = emitter.at_time();
    let contract = emitter.contract();
    quote! {
        #[allow(non_snake_case, unused_variables, clippy::all)]
        pub mod #name {
            #![doc = #doc]
            #reference
            use ::#runtime::math::Scalar;
            #parameters
            #field
            #at_time
            #contract
        }
    }
}

/// The module as formatted text, for review.
pub fn text(compiled: &Compiled) -> String {
    let file = syn::parse2(module(compiled)).expect("emitted tokens are a module");
    prettyplease::unparse(&file)
}

/// A user's name as an identifier: keywords become raw, and those that cannot get an underscore.
fn identifier(name: &str) -> Ident {
    if syn::parse_str::<Ident>(name).is_ok() {
        return Ident::new(name, Span::call_site());
    }
    match name {
        "self" | "Self" | "super" | "crate" | "_" => format_ident!("{name}_"),
        keyword if syn::parse_str::<syn::Ident>(&format!("r#{keyword}")).is_ok() => {
            Ident::new_raw(keyword, Span::call_site())
        }
        // A file's stem may hold anything.
        other => {
            let word = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
            format_ident!("field_{}", other.chars().map(word).collect::<String>())
        }
    }
}

/// Where the body of a function finds the values that earlier stages left.
struct Place {
    /// The struct that holds the Parameter stage.
    field: TokenStream,
    /// The stages that the function computes itself.
    own: &'static [Stage],
}

struct Emitter<'a> {
    compiled: &'a Compiled,
    program: &'a Program,
    /// Values of the Parameter and Time stages that later stages or outputs read.
    kept: Vec<bool>,
}

impl<'a> Emitter<'a> {
    fn new(compiled: &'a Compiled) -> Self {
        let program = &compiled.program;
        let mut kept = vec![false; program.instrs.len()];
        for instr in &program.instrs {
            for operand in instr.op.operands() {
                kept[operand.index()] |= program.instr(operand).stage != instr.stage;
            }
        }
        for (output, values) in &program.outputs {
            for value in values {
                kept[value.index()] |= !matches!(output, Output::Parameter(_));
            }
        }
        for (kept, instr) in kept.iter_mut().zip(&program.instrs) {
            *kept &= !matches!(instr.op, Op::Constant(_) | Op::Pi);
        }
        Emitter { compiled, program, kept }
    }

    fn dimension(&self) -> usize {
        self.compiled.field.dimension
    }

    fn values(&self, output: Output) -> &[Value] {
        self.program.outputs.get(&output).map_or(&[], Vec::as_slice)
    }

    fn kept_in(&self, stage: Stage) -> Vec<Value> {
        let kept = |index: &usize| self.kept[*index] && self.program.instrs[*index].stage == stage;
        (0..self.program.instrs.len()).filter(kept).map(|index| Value(index as u32)).collect()
    }

    fn needed_by_kept(&self, kept: &[Value]) -> Vec<bool> {
        let mut needed = vec![false; self.program.instrs.len()];
        for value in kept {
            needed[value.index()] = true;
        }
        for index in (0..needed.len()).rev() {
            if needed[index] {
                for operand in self.program.instrs[index].op.operands() {
                    needed[operand.index()] = true;
                }
            }
        }
        needed
    }

    fn body(&self, outputs: &[Output], place: &Place) -> TokenStream {
        self.statements(&self.program.needed(outputs), place)
    }

    /// One `let` for every needed instruction of the stages that a function computes.
    fn statements(&self, needed: &[bool], place: &Place) -> TokenStream {
        let mut statements = TokenStream::new();
        for (index, instr) in self.program.instrs.iter().enumerate() {
            let free = matches!(instr.op, Op::Constant(_) | Op::Pi);
            let argument =
                matches!(instr.op, Op::Input(symbol) if !matches!(symbol, Symbol::Parameter(_)));
            if !needed[index] || free || argument || !place.own.contains(&instr.stage) {
                continue;
            }
            let name = self.name(Value(index as u32));
            let value = self.operation(&instr.op, place);
            statements.extend(quote!(let #name = #value;));
        }
        statements
    }

    fn operation(&self, op: &Op, place: &Place) -> TokenStream {
        let of = |value: &Value| self.operand(*value, place);
        match op {
            Op::Constant(number) => constant(number),
            Op::Pi => quote!(T::pi()),
            Op::Input(Symbol::Parameter(index)) => {
                let name = identifier(&self.compiled.model.parameters[*index].name);
                quote!(parameters.#name)
            }
            Op::Input(symbol) => {
                let name = input(*symbol);
                quote!(#name)
            }
            Op::Add(a, b) => binary(of(a), quote!(+), of(b)),
            Op::Subtract(a, b) => binary(of(a), quote!(-), of(b)),
            Op::Multiply(a, b) => binary(of(a), quote!(*), of(b)),
            Op::Divide(a, b) => binary(of(a), quote!(/), of(b)),
            Op::Negate(a) => {
                let a = of(a);
                quote!(-#a)
            }
            Op::Unary(function, a) => {
                let (function, a) = (format_ident!("{}", function.name()), of(a));
                quote!(#a.#function())
            }
            Op::Binary(function, a, b) => {
                let (function, a, b) = (format_ident!("{}", function.name()), of(a), of(b));
                quote!(#a.#function(#b))
            }
        }
    }

    /// How a function reads a value: a literal, a local, or a member of an earlier stage's struct.
    fn operand(&self, value: Value, place: &Place) -> TokenStream {
        let instr = self.program.instr(value);
        match &instr.op {
            Op::Constant(number) => return constant(number),
            Op::Pi => return quote!(T::pi()),
            Op::Input(symbol)
                if !matches!(symbol, Symbol::Parameter(_)) && place.own.contains(&instr.stage) =>
            {
                let name = input(*symbol);
                return quote!(#name);
            }
            _ => {}
        }
        let name = self.name(value);
        match instr.stage {
            stage if place.own.contains(&stage) => quote!(#name),
            Stage::Parameter => {
                let field = &place.field;
                quote!(#field.#name)
            }
            Stage::Time | Stage::Point | Stage::PointTime => quote!(self.#name),
        }
    }

    fn name(&self, value: Value) -> Ident {
        match &self.program.instr(value).op {
            Op::Input(Symbol::Time) => format_ident!("t"),
            _ => format_ident!("v{}", value.index()),
        }
    }
}

/// The argument that supplies a leaf.
fn input(symbol: Symbol) -> Ident {
    match symbol {
        Symbol::Coordinate(axis) => format_ident!("{}", ["X", "Y", "Z"][axis]),
        Symbol::Time => format_ident!("t"),
        Symbol::Normal(axis) => format_ident!("N{}", axis + 1),
        Symbol::Gradient(row, column) => format_ident!("H{}{}", row + 1, column + 1),
        Symbol::Parameter(_) | Symbol::Invariant(_) => {
            unreachable!("a member of the parameters, or gone after derivation")
        }
    }
}

fn binary(a: TokenStream, operator: TokenStream, b: TokenStream) -> TokenStream {
    quote!(#a #operator #b)
}

/// The scalar nearest to an exact number, as the interpreter rounds it.
fn constant(number: &Rational) -> TokenStream {
    match small_ratio(number) {
        Some((numerator, 1)) => {
            let value = f64::from(numerator);
            quote!(T::from_f64(#value))
        }
        Some((numerator, denominator)) => quote!(T::ratio(#numerator, #denominator)),
        None => {
            let value = number.to_f64().value();
            quote!(T::from_f64(#value))
        }
    }
}
