//! The cache of a point: the values that its position determines, computed once for all times.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::{Context, Emitter};
use mms_program::Stage;
use mms_symbolic::expr::Symbol;

impl Emitter<'_> {
    /// The struct of the Point stage. The position is a member, so that it identifies the point, and for quantities that read a
    /// coordinate itself.
    pub(super) fn point_cache(&self) -> TokenStream {
        let kept = self.kept_in(Stage::Point);
        let names: Vec<_> = kept.iter().map(|value| self.name(*value)).collect();
        let place = Context::at_points(quote!(self), &[Stage::Point]);
        let body = self.statements(kept.iter().copied(), &place);
        let (dimension, point) = (self.dimension(), self.point());
        let axes: Vec<_> = self.axes().map(|axis| self.input(Symbol::Coordinate(axis))).collect();
        let count = Literal::usize_unsuffixed(axes.len() + kept.len());
        let size = format!(
            " {count} values of `T`, {} bytes in double precision: see `BYTES`.",
            8 * (axes.len() + kept.len())
        );
        quote! {
            /// The values that a reference position determines, computed once for all times.
            /// They belong to the parameters of the field that computed them.
            ///
            #[doc = #size]
            #[derive(Clone, Copy, Debug)]
            pub struct Point<T> {
                /// X.
                pub reference_position: [T; #dimension],
                #(#names: T,)*
            }

            impl<T> Point<T> {
                /// The size of one point in bytes.
                pub const BYTES: usize = ::core::mem::size_of::<Self>();
            }

            impl<T: Real> Field<T> {
                /// Computes once what the parameters and the reference position determine.
                #[inline(always)]
                pub fn at_point(&self, #point) -> Point<T> {
                    #body
                    Point { reference_position: [#(#axes),*], #(#names,)* }
                }
            }
        }
    }
}
