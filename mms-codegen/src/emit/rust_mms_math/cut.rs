//! Two loops over the points of a batch, and what the first one hands to the second one.
//!
//! A number that is handed over is written and read again. So products of numbers that are there anyway are taken
//! where they are read; and where several products have one factor, that is handed over in their place.

use std::collections::{BTreeMap, BTreeSet};

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::batch::{Columns, count, kernel, normal};
use super::{Emitter, Place};
use crate::expr::Symbol;
use crate::program::{Op, Stage, Value};
use crate::quantity::Quantity;

/// What the second loop starts from.
struct Cut {
    /// What it reads: coordinates, and what the first loop found.
    columns: Columns,
    /// The products that it begins with, in order, and their factors.
    products: Vec<(Value, [Value; 2])>,
}

impl Emitter<'_> {
    /// The kernel of a quantity that needs these `columns` of a point, in two loops.
    pub(super) fn two_loops(&self, quantity: Quantity, columns: &Columns) -> TokenStream {
        let math = self.math();
        let dimension = self.axes().len();
        let normals = if quantity == Quantity::Traction { dimension } else { 0 };
        let [whole, first, then] = ["", "Of", "Then"].map(|suffix| kernel(quantity, suffix));
        let found = format_ident!("{}_of", quantity.name());
        let cut = self.cut(columns);
        let handed = &cut.columns.values;
        let body = self
            .statements(handed.iter().copied(), &Place::at_points(quote!(self), &[Stage::Point]));
        let names = handed.iter().map(|value| self.name(*value));
        let of_first = dimension + normals..dimension + normals + handed.len();
        let reads = cut.columns.axes.iter().copied().chain(of_first);
        let reads = reads.chain(dimension..dimension + normals).map(count);
        let inputs = count(dimension + normals);
        let between = count(handed.len());
        let results = count(quantity.shape().components(dimension));
        let (point, position, normal) = (self.point(), self.position(), normal(normals));
        let second = self.over_columns(quantity, &then, columns, &cut.columns, &cut.products);
        quote! {
            impl<T: Real> Field<T> {
                #[inline(always)]
                fn #found(&self, #point) -> [T; #between] { #body [#(#names),*] }
            }
            #math::kernel! { #first<S>, #inputs -> #between, |at, [#(#position,)* #(#normal),*]| {
                at.field.#found([#(#position),*])
            } }
            #second
            #math::kernels! { #whole = #first, #then [#(#reads),*]; #inputs -> #between -> #results }
        }
    }

    /// Where loops part of which the second one needs these columns.
    fn cut(&self, columns: &Columns) -> Cut {
        let mut handed: BTreeSet<Value> = columns.values.iter().copied().collect();
        let mut products = BTreeMap::new();
        loop {
            let mut made = BTreeMap::new();
            let mut of_factor: BTreeMap<Value, usize> = BTreeMap::new();
            for value in &handed {
                let Op::Multiply(a, b) = self.program.instr(*value).op else { continue };
                let is_there = |factor: &Value| {
                    let known = handed.contains(factor) || products.contains_key(factor);
                    known || !self.is_found_at_points(*factor)
                };
                let missing: BTreeSet<Value> =
                    [a, b].into_iter().filter(|factor| !is_there(factor)).collect();
                match Vec::from_iter(missing)[..] {
                    [] => drop(made.insert(*value, [a, b])),
                    [factor] => *of_factor.entry(factor).or_default() += 1,
                    _ => {}
                }
            }
            handed.retain(|value| !made.contains_key(value));
            let shared = of_factor.into_iter().filter(|(_, products)| *products > 1);
            let best = shared.max_by_key(|(_, products)| *products);
            handed.extend(best.map(|(factor, _)| factor));
            if made.is_empty() && best.is_none() {
                break;
            }
            products.extend(made);
        }
        let mut axes: BTreeSet<usize> = columns.axes.iter().copied().collect();
        for factor in products.values().flatten() {
            if let Op::Input(Symbol::Coordinate(axis)) = self.program.instr(*factor).op {
                axes.insert(axis);
            }
        }
        let columns = Columns { axes: Vec::from_iter(axes), values: Vec::from_iter(handed) };
        Cut { columns, products: Vec::from_iter(products) }
    }

    /// Whether a value has to be computed from a position.
    fn is_found_at_points(&self, value: Value) -> bool {
        let instr = self.program.instr(value);
        instr.stage == Stage::Point && !matches!(instr.op, Op::Input(_))
    }
}
