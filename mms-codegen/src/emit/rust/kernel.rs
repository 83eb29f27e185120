//! The kernels: plain functions over arrays, generic in the scalar.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::{Emitter, Place, input};
use crate::expr::Symbol;
use crate::mechanics::Response;
use crate::mechanics::model::Body;
use crate::program::{Bound, Output, Stage};
use crate::quantity::{Quantity, Shape};

impl Emitter<'_> {
    pub(super) fn parameters(&self) -> TokenStream {
        let parameters = &self.compiled.model.parameters;
        let (dimension, count) = (self.dimension(), Literal::usize_unsuffixed(parameters.len()));
        let names: Vec<_> = parameters.iter().map(|parameter| &parameter.name).collect();
        let fields = &self.parameter_names;
        // A parameter may be called like something that a pattern cannot bind, such as `None`.
        let locals: Vec<_> = (0..names.len()).map(|index| format_ident!("p{index}")).collect();
        let docs = parameters.iter().map(|parameter| {
            let what = parameter.doc.as_deref().unwrap_or("A parameter of the field");
            match &parameter.unit {
                Some(unit) => format!(" {what} ({unit})."),
                None => format!(" {what}."),
            }
        });
        let place = Place { field: quote!(), own: &[Stage::Parameter] };
        let outputs: Vec<_> = (0..parameters.len()).map(Output::Parameter).collect();
        let body = self.body(&outputs, &place);
        let values = outputs.iter().map(|output| self.operand(self.values(*output)[0], &place));
        let own_material = match self.compiled.own_material() {
            Some((_, text)) => quote!(::core::option::Option::Some(#text)),
            None => quote!(::core::option::Option::None),
        };
        // A struct without members cannot be generic in their type.
        let generic = self.parameters_generic();
        let scalar = (!parameters.is_empty()).then(|| quote!(<T: Scalar + Copy>));
        let (of_type, of_function) = if parameters.is_empty() {
            (None, Some(quote!(<T>)))
        } else {
            (Some(quote!(<T>)), None)
        };
        quote! {
            /// The number of space dimensions.
            pub const DIMENSION: usize = #dimension;

            /// The text of the material's file, where the field brings its own.
            pub const OWN_MATERIAL: Option<&str> = #own_material;

            /// The names of the parameters, in the order of the field file.
            pub const NAMES: [&str; #count] = [#(#names),*];

            /// The parameters; their defaults are those of the field file.
            #[derive(Clone, Copy, Debug, PartialEq)]
            pub struct Parameters #generic {
                #(#[doc = #docs] pub #fields: T,)*
            }

            impl #of_type Parameters #generic {
                /// From the values in the order of `NAMES`.
                pub fn from_array #of_function(values: [T; #count]) -> Self {
                    let [#(#locals),*] = values;
                    Parameters { #(#fields: #locals),* }
                }
            }

            impl #scalar Default for Parameters #generic {
                fn default() -> Self {
                    #body
                    Parameters { #(#fields: #values),* }
                }
            }
        }
    }

    /// The struct of the Parameter stage, and what needs no time.
    pub(super) fn field(&self) -> TokenStream {
        let kept = self.kept_in(Stage::Parameter);
        let names: Vec<_> = kept.iter().map(|value| self.name(*value)).collect();
        let place = Place { field: quote!(), own: &[Stage::Parameter] };
        let body = self.statements(&self.program.needed_for(kept.iter().copied()), &place);
        let generic = self.parameters_generic();
        let responses = self.responses();
        let bounds = self.bounds();
        // A field without any value still has a scalar type.
        let (marker, marked) = match kept.is_empty() {
            true => (
                Some(quote!(marker: ::core::marker::PhantomData<T>,)),
                Some(quote!(marker: ::core::marker::PhantomData,)),
            ),
            false => (None, None),
        };
        quote! {
            /// The field for one set of parameters: everything that needs neither t nor X.
            #[derive(Clone, Copy, Debug)]
            pub struct Field<T> {
                #(#names: T,)*
                #marker
            }

            /// Computes once what only the parameters determine.
            pub fn prepare<T: Scalar + Copy>(parameters: &Parameters #generic) -> Field<T> {
                #body
                Field { #(#names,)* #marked }
            }

            impl<T: Scalar + Copy> Field<T> {
                #bounds
                #responses
            }
        }
    }

    fn parameters_generic(&self) -> Option<TokenStream> {
        (!self.compiled.model.parameters.is_empty()).then(|| quote!(<T>))
    }

    fn bounds(&self) -> TokenStream {
        let place = Place { field: quote!(self), own: &[] };
        let function = |bound: Bound, name: &str, doc: &str| {
            let name = format_ident!("{name}");
            let values = self.values(Output::Bound(bound));
            let length = Literal::usize_unsuffixed(values.len());
            let values = values.iter().map(|value| self.operand(*value, &place));
            quote! {
                #[doc = #doc]
                pub fn #name(&self) -> [T; #length] { [#(#values),*] }
            }
        };
        let time =
            function(Bound::Time, "time_window", " The first and last time of the claims, s.");
        let body = match &self.compiled.model.domain.body {
            Body::Box { .. } => [
                function(Bound::Lower, "lower", " The body's least reference coordinates, m."),
                function(Bound::Upper, "upper", " The body's greatest reference coordinates, m."),
            ]
            .to_vec(),
            Body::Annulus { .. } => [
                function(Bound::Inner, "inner", " The body's inner radius, m."),
                function(Bound::Outer, "outer", " The body's outer radius, m."),
                function(Bound::Theta, "theta", " The body's first and last angle."),
            ]
            .to_vec(),
        };
        quote!(#(#body)* #time)
    }

    fn responses(&self) -> TokenStream {
        let point = self.point();
        let gradient = self.gradient();
        let place = Place { field: quote!(self), own: &[Stage::Point, Stage::PointTime] };
        let function = |response: Response, name: &str, doc: &str, shape: Shape, strained: bool| {
            let name = format_ident!("{name}");
            let gradient = strained.then(|| quote!(, #gradient));
            let output = Output::Response(response);
            let (kind, value) = (self.shape_type(shape), self.shaped(output, shape, &place));
            let body = self.body(&[output], &place);
            quote! {
                #[doc = #doc]
                #[inline]
                pub fn #name(&self, #point #gradient) -> #kind { #body #value }
            }
        };
        let density = function(
            Response::Density,
            "density",
            " Reference density rho0 at X, kg/m^3.",
            Shape::Scalar,
            false,
        );
        let speed = function(
            Response::WaveSpeed,
            "wave_speed",
            " The fastest wave speed at X in the undeformed state, m/s.",
            Shape::Scalar,
            false,
        );
        let energy = function(
            Response::StrainEnergy,
            "material_strain_energy",
            " Strain-energy density W at X of the displacement gradient H, Pa.",
            Shape::Scalar,
            true,
        );
        let first = function(
            Response::FirstPiolaKirchhoff,
            "material_first_piola_kirchhoff",
            " First Piola-Kirchhoff stress P = dW/dF at X of the displacement gradient H, Pa.",
            Shape::Tensor,
            true,
        );
        let kirchhoff = function(
            Response::KirchhoffStress,
            "material_kirchhoff_stress",
            " Kirchhoff stress tau = P F^T at X of the displacement gradient H, Pa.",
            Shape::Tensor,
            true,
        );
        quote!(#density #speed #energy #first #kirchhoff)
    }

    /// The struct of the Time stage, and every quantity at a point.
    pub(super) fn at_time(&self) -> TokenStream {
        let kept = self.kept_in(Stage::Time);
        let names: Vec<_> = kept.iter().map(|value| self.name(*value)).collect();
        let place = Place { field: quote!(self), own: &[Stage::Time] };
        let body = self.statements(&self.program.needed_for(kept.iter().copied()), &place);
        let quantities = Quantity::ALL.iter().map(|quantity| self.quantity(*quantity));
        quote! {
            /// The field at one time: everything that needs no X.
            #[derive(Clone, Copy, Debug)]
            pub struct AtTime<'a, T> {
                field: &'a Field<T>,
                #(#names: T,)*
            }

            impl<T: Scalar + Copy> Field<T> {
                /// Computes once what the parameters and the time determine.
                #[inline]
                pub fn at_time(&self, t: T) -> AtTime<'_, T> {
                    #body
                    AtTime { field: self, #(#names,)* }
                }
            }

            impl<T: Scalar + Copy> AtTime<'_, T> {
                #(#quantities)*
            }
        }
    }

    fn quantity(&self, quantity: Quantity) -> TokenStream {
        let name = format_ident!("{}", quantity.name());
        let doc = format!(" {} Unit: {}.", quantity.doc(), quantity.unit());
        let place = Place { field: quote!(self.field), own: &[Stage::Point, Stage::PointTime] };
        let output = Output::Quantity(quantity);
        let point = self.point();
        let normal = (quantity == Quantity::Traction).then(|| {
            let components = self.axes().map(|axis| input(Symbol::Normal(axis)));
            let dimension = self.dimension();
            quote!(, [#(#components),*]: [T; #dimension])
        });
        let kind = self.shape_type(quantity.shape());
        let body = self.body(&[output], &place);
        let value = self.shaped(output, quantity.shape(), &place);
        quote! {
            #[doc = #doc]
            #[inline]
            pub fn #name(&self, #point #normal) -> #kind { #body #value }
        }
    }

    fn point(&self) -> TokenStream {
        let dimension = self.dimension();
        let names = self.axes().map(|axis| input(Symbol::Coordinate(axis)));
        quote!([#(#names),*]: [T; #dimension])
    }

    fn gradient(&self) -> TokenStream {
        let dimension = self.dimension();
        let rows = self.axes().map(|row| {
            let names = self.axes().map(|column| input(Symbol::Gradient(row, column)));
            quote!([#(#names),*])
        });
        quote!([#(#rows),*]: [[T; #dimension]; #dimension])
    }

    fn shape_type(&self, shape: Shape) -> TokenStream {
        let dimension = self.dimension();
        match shape {
            Shape::Scalar => quote!(T),
            Shape::Vector => quote!([T; #dimension]),
            Shape::Tensor => quote!([[T; #dimension]; #dimension]),
        }
    }

    fn shaped(&self, output: Output, shape: Shape, place: &Place) -> TokenStream {
        let values: Vec<_> =
            self.values(output).iter().map(|value| self.operand(*value, place)).collect();
        match shape {
            Shape::Scalar => quote!(#(#values)*),
            Shape::Vector => quote!([#(#values),*]),
            Shape::Tensor => {
                let rows = values.chunks(self.axes().len()).map(|row| quote!([#(#row),*]));
                quote!([#(#rows),*])
            }
        }
    }
}
