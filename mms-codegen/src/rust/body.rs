//! The body of a function: one `let` for every instruction that its results need.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::{Context, Emitter, constant, pi};
use mms_mechanics::Output;
use mms_program::fusion::{Fused, Fusion};
use mms_program::{Op, Value, unary_name};
use mms_symbolic::expr::Symbol;

impl Emitter<'_> {
    /// The statements that compute `outputs`, within the stages that a function computes.
    pub(super) fn body(&self, outputs: &[Output], place: &Context) -> TokenStream {
        let roots = outputs.iter().flat_map(|output| self.values(*output)).copied();
        self.statements(roots, place)
    }

    /// The statements that compute `roots`, within the stages that a function computes.
    pub(super) fn statements(
        &self,
        roots: impl IntoIterator<Item = Value>,
        place: &Context,
    ) -> TokenStream {
        let roots: Vec<Value> = roots.into_iter().collect();
        let needed = self.program.needed_for(roots.iter().copied());
        let computed: Vec<bool> = (self.program.instrs.iter().zip(&needed))
            .map(|(instr, needed)| *needed && place.own.contains(&instr.stage))
            .collect();
        let once = place.is_once();
        let body = Body {
            emitter: self,
            place,
            fusion: match once {
                true => Fusion::none(&self.program.instrs),
                false => Fusion::new(&self.program.instrs, &roots, &needed, place.own),
            },
        };
        let written =
            (0..computed.len()).filter(|index| computed[*index] && body.is_written(*index));
        written.map(|index| body.statement(Value(index as u32))).collect()
    }

    /// The statements for these values only.
    pub(super) fn one_by_one(&self, values: &[Value], place: &Context) -> TokenStream {
        let body = Body { emitter: self, place, fusion: Fusion::none(&self.program.instrs) };
        values.iter().map(|value| body.statement(*value)).collect()
    }
}

/// A function, and the operations that its processor fuses.
struct Body<'a> {
    emitter: &'a Emitter<'a>,
    place: &'a Context,
    fusion: Fusion,
}

impl Body<'_> {
    /// Whether an instruction gets its own `let`. Constants do not, since each reader writes them; neither do arguments, which
    /// have names, and operations that are fused into another one.
    fn is_written(&self, index: usize) -> bool {
        let has_a_value = match self.emitter.program.instrs[index].op {
            Op::Constant(_) | Op::Pi => false,
            Op::Input(symbol) => matches!(symbol, Symbol::Parameter(_)),
            _ => true,
        };
        has_a_value && !self.fusion.absorbed[index]
    }

    fn statement(&self, value: Value) -> TokenStream {
        let name = self.emitter.name(value);
        let computed = match &self.fusion.fused[value.index()] {
            Some(fused) => self.fused(fused),
            None => self.operation(&self.emitter.program.instr(value).op),
        };
        quote!(let #name = #computed;)
    }

    fn fused(&self, fused: &Fused) -> TokenStream {
        let [a, b, term] =
            [fused.factors[0], fused.factors[1], fused.term].map(|value| self.operand(value));
        let a = if fused.minus_product { quote!((-#a)) } else { a };
        let term = if fused.minus_term { quote!(-#term) } else { term };
        quote!(#a.mul_add(#b, #term))
    }

    fn operation(&self, op: &Op) -> TokenStream {
        let of = |value: &Value| self.operand(*value);
        let binary = |a: &Value, operator: TokenStream, b: &Value| {
            let (a, b) = (of(a), of(b));
            quote!(#a #operator #b)
        };
        match op {
            Op::Constant(number) => constant(number, &self.place.scalar),
            Op::Pi => pi(&self.place.scalar),
            Op::Input(Symbol::Parameter(index)) => {
                let name = &self.emitter.parameter_names[index];
                quote!(parameters.#name.widen())
            }
            Op::Input(symbol) => {
                let name = self.emitter.input(*symbol);
                quote!(#name)
            }
            Op::Add(a, b) => binary(a, quote!(+), b),
            Op::Subtract(a, b) => binary(a, quote!(-), b),
            Op::Multiply(a, b) => binary(a, quote!(*), b),
            Op::Divide(a, b) => binary(a, quote!(/), b),
            Op::Negate(a) => {
                let a = of(a);
                quote!(-#a)
            }
            Op::Unary(function, small, a) => {
                let (function, a) = (format_ident!("{}", unary_name(*function, *small)), of(a));
                quote!(#a.#function())
            }
            Op::Binary(function, a, b) => {
                let (function, a, b) = (format_ident!("{}", function.name()), of(a), of(b));
                quote!(#a.#function(#b))
            }
        }
    }

    fn operand(&self, value: Value) -> TokenStream {
        self.emitter.operand(value, self.place)
    }
}
