//! The data on the faces of the body: one function for each face and datum.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::{Context, Emitter};
use mms_mechanics::Output;
use mms_mechanics::boundary::Datum;
use mms_program::Stage;
use mms_spec::Face;
use mms_spec::quantity::{Quantity, Shape};

impl Emitter<'_> {
    /// Functions such as `x_max_traction`, for a point on that face.
    pub(super) fn on_faces(&self) -> impl Iterator<Item = TokenStream> {
        self.program.outputs.keys().filter_map(|output| match *output {
            Output::Face(face, datum) => Some(self.on_face(face, datum)),
            _ => None,
        })
    }

    fn on_face(&self, face: Face, datum: Datum) -> TokenStream {
        let name = format_ident!("{}_{}", face.name(), datum.name());
        let what = match datum {
            Datum::Normal => "Outward reference unit normal N",
            Datum::Displacement => self.compiled.doc(Quantity::Displacement).trim_end_matches('.'),
            Datum::Traction => "Traction P N on reference area",
        };
        let unit = match datum {
            Datum::Normal => "1",
            Datum::Displacement => Quantity::Displacement.unit(),
            Datum::Traction => Quantity::Traction.unit(),
        };
        let unit = self.compiled.unit(unit);
        let doc = format!(" {what} on the face `{}`, at a point of it. Unit: {unit}.", face.name());
        let own: &[Stage] = &[Stage::Point, Stage::PointTime];
        let place = Context::at_points(quote!(self.field), own);
        let output = Output::Face(face, datum);
        let (point, dimension) = (self.point(), self.dimension());
        let kind = match datum {
            Datum::Normal => quote!([T; #dimension]),
            Datum::Displacement | Datum::Traction => self.shape_type(Shape::Vector),
        };
        let (body, value) =
            (self.body(&[output], &place), self.shaped(output, Shape::Vector, &place));
        quote! {
            #[doc = #doc]
            #[inline]
            pub fn #name(&self, #point) -> #kind { #body #value }
        }
    }
}
