//! Splits the kernel of a quantity into two loops over points, and decides which values of many points are stored.
//!
//! The first loop passes values to the second in whole lines of the cache, and as few as possible: the second loop computes
//! sums and products of the values that it has. Stored values of many points are read from memory every time, so a number that
//! up to three sums and products compute from others is not stored: `generalized_vortex` stores 17 numbers where `Point`, in
//! registers, has 21, and for b alone 4 where `Point` has 5. `mms-program/src/loops.rs` has the rules.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::batch::{count, kernel, normal};
use super::quantity::function;
use super::{Context, Emitter};
use mms_program::Stage;
use mms_program::loops::{Columns, Cut, WORTH_IN_CACHE, WORTH_IN_MEMORY};
use mms_spec::quantity::Quantity;

impl Emitter<'_> {
    /// The kernel of a quantity that needs these `columns` of a point, in two loops.
    pub(super) fn two_loops(&self, quantity: Quantity, columns: &Columns) -> TokenStream {
        let math = self.math();
        let dimension = self.axes().len();
        let normals = if quantity.takes_normal() { dimension } else { 0 };
        let [whole, first, then] = ["", "Of", "Then"].map(|suffix| kernel(quantity, suffix));
        let found = format_ident!("{}_of", function(quantity));
        let cut = Cut::new(self.program, columns, WORTH_IN_CACHE);
        let handed = &cut.columns.values;
        let body = self
            .statements(handed.iter().copied(), &Context::at_points(quote!(self), &[Stage::Point]));
        let names = handed.iter().map(|value| self.name(*value));
        let of_first = dimension + normals..dimension + normals + handed.len();
        let reads = cut.columns.axes.iter().copied().chain(of_first);
        let reads = reads.chain(dimension..dimension + normals).map(count);
        let inputs = count(dimension + normals);
        let between = count(handed.len());
        let results = count(self.compiled.field.space.components(quantity.shape()));
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

    /// The stored values of many points that a quantity reads if it needs these `columns`: all of them, or fewer.
    pub(super) fn kept_for(&self, columns: &Columns) -> Cut {
        let cut = Cut::new(self.program, columns, WORTH_IN_MEMORY);
        if cut.columns.count() < columns.count() {
            return cut;
        }
        Cut { columns: columns.clone(), made: Vec::new() }
    }
}
