//! What is taken from memory at a point, and what is made of it first.
//!
//! A number that is kept is written once and read every time. So sums and products of numbers that are there anyway are
//! computed where they are read; and where several can be made of one number, that is kept in their place.

use std::collections::BTreeSet;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::batch::{Columns, count, kernel, normal};
use super::{Emitter, Place};
use crate::expr::Symbol;
use crate::program::{Op, Stage, Value};
use crate::quantity::Quantity;

/// How many sums and products a number is worth that one loop over points leaves to the next one.
const WORTH_IN_CACHE: usize = 1;

/// And one that is kept of a point: it comes from memory.
const WORTH_IN_MEMORY: usize = 3;

/// What a function of a point starts from.
pub(super) struct Cut {
    /// What it reads: coordinates, and values that were found before.
    pub columns: Columns,
    /// What it makes of those, operands first.
    pub made: Vec<Value>,
}

impl Emitter<'_> {
    /// The kernel of a quantity that needs these `columns` of a point, in two loops.
    pub(super) fn two_loops(&self, quantity: Quantity, columns: &Columns) -> TokenStream {
        let math = self.math();
        let dimension = self.axes().len();
        let normals = if quantity == Quantity::Traction { dimension } else { 0 };
        let [whole, first, then] = ["", "Of", "Then"].map(|suffix| kernel(quantity, suffix));
        let found = format_ident!("{}_of", quantity.name());
        let cut = self.cut(columns, WORTH_IN_CACHE);
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
        let second = self.over_columns(quantity, &then, columns, &cut);
        let loops = self.loops_of(quantity);
        quote! {
            impl<T: Real> Field<T> {
                #[inline(always)]
                fn #found(&self, #point) -> [T; #between] { #body [#(#names),*] }
            }
            #math::kernel! { #first<S>, #inputs -> #between, |at, [#(#position,)* #(#normal),*]| {
                at.field.#found([#(#position),*])
            } }
            #second
            #math::kernels! {
                #whole = #first, #then [#(#reads),*], #loops; #inputs -> #between -> #results
            }
        }
    }

    /// What a quantity that needs these `columns` of a point reads of the cache of many: these, or fewer.
    pub(super) fn kept_for(&self, columns: &Columns) -> Cut {
        let cut = self.cut(columns, WORTH_IN_MEMORY);
        if cut.columns.len() < columns.len() {
            return cut;
        }
        Cut { columns: columns.clone(), made: Vec::new() }
    }

    /// What is taken in place of these columns, where a number is `worth` so many operations.
    fn cut(&self, columns: &Columns, worth: usize) -> Cut {
        let mut taken: BTreeSet<Value> = columns.values.iter().copied().collect();
        let mut made = BTreeSet::new();
        loop {
            let there = &taken | &made;
            let steps = |value: &Value| Some((*value, self.steps(*value, worth, &there)?));
            if let Some((value, steps)) = taken.iter().find_map(steps) {
                taken.remove(&value);
                made.extend(steps);
                continue;
            }
            // How many could be made if there were another one.
            let of_it = |another: &Value| {
                let mut there = there.clone();
                there.insert(*another);
                let is_made = |value: &&Value| self.steps(**value, worth, &there).is_some();
                taken.iter().filter(is_made).count()
            };
            let others: BTreeSet<Value> =
                taken.iter().flat_map(|value| self.behind(*value, worth)).collect();
            let best = others.iter().map(|other| (of_it(other), *other)).max();
            match best {
                Some((several, other)) if several > 1 => drop(taken.insert(other)),
                _ => break,
            }
        }
        let mut axes: BTreeSet<usize> = columns.axes.iter().copied().collect();
        for value in &made {
            for operand in self.program.instr(*value).op.operands() {
                if let Op::Input(Symbol::Coordinate(axis)) = self.program.instr(operand).op {
                    axes.insert(axis);
                }
            }
        }
        let columns = Columns { axes: Vec::from_iter(axes), values: Vec::from_iter(taken) };
        Cut { columns, made: Vec::from_iter(made) }
    }

    /// The sums and products, no more than `most`, that make a value of others that are `there`.
    fn steps(&self, value: Value, most: usize, there: &BTreeSet<Value>) -> Option<BTreeSet<Value>> {
        let mut steps = BTreeSet::from([value]);
        let mut open = vec![value];
        while let Some(step) = open.pop() {
            let op = &self.program.instr(step).op;
            let counted = steps.iter().filter(|step| self.program.instr(**step).op.is_counted());
            if !is_cheap(op) || counted.count() > most {
                return None;
            }
            let missing = |other: &Value| self.is_found_at_points(*other) && !there.contains(other);
            open.extend(op.operands().filter(missing).filter(|other| steps.insert(*other)));
        }
        Some(steps)
    }

    /// What comes before a value, up to so many sums and products.
    fn behind(&self, value: Value, most: usize) -> BTreeSet<Value> {
        let op = &self.program.instr(value).op;
        let mut behind = BTreeSet::new();
        if most > 0 && is_cheap(op) {
            for operand in op.operands().filter(|operand| self.is_found_at_points(*operand)) {
                behind.insert(operand);
                behind.extend(self.behind(operand, most - 1));
            }
        }
        behind
    }

    /// Whether a value has to be computed from a position.
    fn is_found_at_points(&self, value: Value) -> bool {
        let instr = self.program.instr(value);
        instr.stage == Stage::Point && !matches!(instr.op, Op::Input(_))
    }
}

/// Whether an operation takes no longer than a sum or a product.
fn is_cheap(op: &Op) -> bool {
    matches!(op, Op::Add(..) | Op::Subtract(..) | Op::Multiply(..) | Op::Negate(_))
}
