//! The body of a function: one `let` for every instruction that its results need.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::division::{Step, roots_below, steps};
use super::fusion::{Fused, Fusion};
use super::{Emitter, Place, constant, input, path, pi};
use crate::expr::{Function, Symbol};
use crate::program::{Op, Output, Value};

impl Emitter<'_> {
    /// What `outputs` need of the stages that a function computes.
    pub(super) fn body(&self, outputs: &[Output], place: &Place) -> TokenStream {
        let roots = outputs.iter().flat_map(|output| self.values(*output)).copied();
        self.statements(roots, place)
    }

    /// What `roots` need of the stages that a function computes.
    pub(super) fn statements(
        &self,
        roots: impl IntoIterator<Item = Value>,
        place: &Place,
    ) -> TokenStream {
        let roots: Vec<Value> = roots.into_iter().collect();
        let needed = self.program.needed_for(roots.iter().copied());
        let computed: Vec<bool> = (self.program.instrs.iter().zip(&needed))
            .map(|(instr, needed)| *needed && place.own.contains(&instr.stage))
            .collect();
        let once = place.is_once();
        let steps = match place.is_whole && !once {
            true => steps(self.program, &computed),
            false => (0..computed.len()).filter(|at| computed[*at]).map(Step::One).collect(),
        };
        let body = Body {
            emitter: self,
            place,
            fusion: match once {
                true => Fusion::none(self.program),
                false => Fusion::new(self.program, &roots, &needed, place.own),
            },
            below: match once {
                true => BTreeSet::new(),
                false => roots_below(self.program, &computed),
            },
        };
        steps.iter().flat_map(|step| body.statement(step)).collect()
    }
}

/// A function, and what its processor does in one go.
struct Body<'a> {
    emitter: &'a Emitter<'a>,
    place: &'a Place,
    fusion: Fusion,
    /// The square roots that it divides by.
    below: BTreeSet<Value>,
}

impl Body<'_> {
    fn statement(&self, step: &Step) -> Option<TokenStream> {
        match step {
            Step::One(index) => self.is_written(*index).then(|| self.single(Value(*index as u32))),
            Step::Together(members) => Some(self.quotients(members)),
        }
    }

    /// Constants stand where they are read, and arguments have their names already.
    fn is_written(&self, index: usize) -> bool {
        let has_a_value = match self.emitter.program.instrs[index].op {
            Op::Constant(_) | Op::Pi => false,
            Op::Input(symbol) => matches!(symbol, Symbol::Parameter(_)),
            _ => true,
        };
        has_a_value && !self.fusion.absorbed[index]
    }

    fn single(&self, value: Value) -> TokenStream {
        let name = self.emitter.name(value);
        if let Some(fused) = &self.fusion.fused[value.index()] {
            let fused = self.fused(fused);
            return quote!(let #name = #fused;);
        }
        match &self.emitter.program.instr(value).op {
            Op::Unary(Function::Sqrt, of) if self.below.contains(&value) => {
                let (of, below) = (self.operand(*of), self.below_name(value));
                quote!(let [#name, #below] = #of.root();)
            }
            Op::Divide(above, root) if self.below.contains(root) => {
                let (above, below) = (self.operand(*above), self.below_name(*root));
                quote!(let #name = #above.over_root(#below);)
            }
            op => {
                let value = self.operation(op);
                quote!(let #name = #value;)
            }
        }
    }

    fn quotients(&self, members: &[usize]) -> TokenStream {
        let names = members.iter().map(|index| self.emitter.name(Value(*index as u32)));
        let operands = members.iter().map(|index| {
            let operands = self.emitter.program.instrs[*index].op.operands();
            operands.map(|operand| self.operand(operand)).collect::<Vec<_>>()
        });
        let (above, below): (Vec<_>, Vec<_>) =
            operands.map(|pair| (pair[0].clone(), pair[1].clone())).unzip();
        let scalar = path(&self.place.scalar);
        quote!(let [#(#names),*] = #scalar::quotients([#(#above),*], [#(#below),*]);)
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
                let name = input(*symbol);
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

    fn operand(&self, value: Value) -> TokenStream {
        self.emitter.operand(value, self.place)
    }

    /// What divides by a square root.
    fn below_name(&self, root: Value) -> Ident {
        format_ident!("r{}", root.index())
    }
}
