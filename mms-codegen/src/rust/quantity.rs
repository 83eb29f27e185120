//! Every quantity at a point and a time: plain functions over arrays, generic in the scalar.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::{Context, Emitter, identifier, input};
use mms_mechanics::Output;
use mms_program::Stage;
use mms_spec::quantity::{Quantity, Shape};
use mms_symbolic::expr::Symbol;

/// The endings of the further functions of each quantity and of faces.
const ENDINGS: [&str; 7] =
    ["_at", "_of", "_batch", "_batch_aos", "_normal", "_displacement", "_traction"];

/// The function of a quantity: its name, with an underscore if it is a name of the file's own that Rust or another function may
/// use.
pub(super) fn function(quantity: Quantity) -> Ident {
    let name = identifier(quantity.name());
    let is_own = matches!(quantity, Quantity::Own(_));
    match is_own && ENDINGS.iter().any(|ending| quantity.name().ends_with(ending)) {
        true => format_ident!("{name}_"),
        false => name,
    }
}

/// The function that computes a quantity from the stored values of a point.
pub(super) fn at(quantity: Quantity) -> Ident {
    format_ident!("{}_at", function(quantity))
}

impl Emitter<'_> {
    /// The struct of the Time stage, and every quantity at a point.
    pub(super) fn at_time(&self) -> TokenStream {
        let kept = self.kept_in(Stage::Time);
        let names: Vec<_> = kept.iter().map(|value| self.name(*value)).collect();
        let place = Context::once(quote!(self), &[Stage::Time]);
        let body = self.statements(kept.iter().copied(), &place);
        let values = kept.iter().map(|value| self.narrowed(*value, &place));
        // The time is widened only if some value is computed from it.
        let widened = (!kept.is_empty()).then(|| quote!(let t = t.widen();));
        let quantities = self.quantities().map(|quantity| self.quantity(quantity));
        let faces = self.on_faces();
        let material = self.compiled.is_for_a_solver().then(|| self.responses(true));
        let timeless = self.compiled.is_for_a_solver().then(|| {
            quote! {
                /// The body and the functions of the material that need no time.
                impl<T: Real> ::core::ops::Deref for AtTime<'_, T> {
                    type Target = Field<T>;

                    #[inline(always)]
                    fn deref(&self) -> &Field<T> {
                        self.field
                    }
                }
            }
        });
        quote! {
            /// The field at one time: everything that needs no X.
            #[derive(Clone, Copy, Debug)]
            pub struct AtTime<'a, T: Real> {
                field: &'a Field<T>,
                #(#names: T,)*
            }

            impl<T: Real> Field<T> {
                /// Computes once what the parameters and the time determine.
                #[inline]
                pub fn at_time(&self, t: T) -> AtTime<'_, T> {
                    #widened
                    #body
                    AtTime { field: self, #(#names: #values,)* }
                }
            }

            #timeless

            impl<T: Real> AtTime<'_, T> {
                #(#quantities)*
                #(#faces)*
                #material
            }
        }
    }

    /// The functions of a quantity: from a point, and from its stored values.
    fn quantity(&self, quantity: Quantity) -> TokenStream {
        let (name, at) = (function(quantity), at(quantity));
        let doc = self.compiled.doc(quantity);
        let doc = match self.compiled.unit_of(quantity).as_str() {
            "" => format!(" {doc}"),
            unit => format!(" {doc} Unit: {unit}."),
        };
        let cached = format!(" As `{}`, from what was kept of the point.", quantity.name());
        let own: &[Stage] = &[Stage::Point, Stage::PointTime];
        let place = |own| Context::at_points(quote!(self.field), own);
        let (whole, rest) = (place(own), place(&own[1..]));
        let output = Output::Quantity(quantity);
        let point = self.point();
        let normal = quantity.takes_normal().then(|| {
            let components = self.axes().map(|axis| input(Symbol::Normal(axis)));
            let dimension = self.dimension();
            quote!(, [#(#components),*]: [T; #dimension])
        });
        let kind = self.shape_type(quantity.shape());
        let [body, rest_body] = [&whole, &rest].map(|place| self.body(&[output], place));
        let [value, rest_value] =
            [&whole, &rest].map(|place| self.shaped(output, quantity.shape(), place));
        quote! {
            #[doc = #doc]
            #[inline(always)]
            pub fn #name(&self, #point #normal) -> #kind { #body #value }

            #[doc = #cached]
            #[inline(always)]
            pub fn #at(&self, point: &Point<T> #normal) -> #kind { #rest_body #rest_value }
        }
    }

    pub(super) fn point(&self) -> TokenStream {
        let dimension = self.dimension();
        let names = self.axes().map(|axis| self.input(Symbol::Coordinate(axis)));
        quote!([#(#names),*]: [T; #dimension])
    }

    pub(super) fn gradient(&self) -> TokenStream {
        let kind = self.shape_type(Shape::Tensor);
        let rows = self.rows().map(|row| {
            let names = self.rows().map(|column| input(Symbol::Gradient(row, column)));
            quote!([#(#names),*])
        });
        quote!([#(#rows),*]: #kind)
    }

    pub(super) fn shape_type(&self, shape: Shape) -> TokenStream {
        let space = self.compiled.field.space;
        let [vector, rows] = [space.vector(), space.rows()].map(Literal::usize_unsuffixed);
        match shape {
            Shape::Scalar => quote!(T),
            Shape::Vector => quote!([T; #vector]),
            Shape::Tensor => quote!([[T; #rows]; #rows]),
        }
    }

    pub(super) fn shaped(&self, output: Output, shape: Shape, place: &Context) -> TokenStream {
        let values: Vec<_> =
            self.values(output).iter().map(|value| self.operand(*value, place)).collect();
        match shape {
            Shape::Scalar => quote!(#(#values)*),
            Shape::Vector => quote!([#(#values),*]),
            Shape::Tensor => {
                let rows = values.chunks(self.rows().len()).map(|row| quote!([#(#row),*]));
                quote!([#(#rows),*])
            }
        }
    }
}
