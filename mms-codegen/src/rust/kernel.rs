//! The items that need no time: the parameters, the struct of their stage, the domain and the material.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::{Context, Emitter};
use mms_mechanics::Response;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::{Bound, Output};
use mms_program::Stage;
use mms_spec::foreign::{Foreign, blanked};
use mms_spec::quantity::Shape;

impl Emitter<'_> {
    pub(super) fn parameters(&self) -> TokenStream {
        let left = self.parameter_names.keys();
        let parameters: Vec<_> =
            left.clone().map(|index| &self.compiled.model.parameters[*index]).collect();
        let (dimension, count) = (self.dimension(), Literal::usize_unsuffixed(parameters.len()));
        let names: Vec<_> = parameters.iter().map(|parameter| &parameter.name).collect();
        let fields: Vec<_> = self.parameter_names.values().collect();
        // A parameter may be called like something that a pattern cannot bind, such as `None`.
        let locals: Vec<_> = (0..names.len()).map(|index| format_ident!("p{index}")).collect();
        let docs = parameters.iter().map(|parameter| {
            let what = parameter.doc.as_ref().map(Foreign::in_a_comment);
            let what = what.as_deref().unwrap_or("A parameter of the field");
            match &parameter.unit {
                Some(unit) => format!(" {what} ({}).", blanked(unit)),
                None => format!(" {what}."),
            }
        });
        let place = Context::once(quote!(), &[Stage::Parameter]);
        let outputs: Vec<_> = left.copied().map(Output::Parameter).collect();
        let body = self.body(&outputs, &place);
        let values = outputs.iter().map(|output| self.narrowed(self.values(*output)[0], &place));
        let own_material = self.contract.then(|| self.own_material());
        let doc = match self.compiled.selection.set.is_empty() {
            true => " The parameters; their defaults come from the field file.",
            false => " The parameters; their defaults come from the field file, or were set.",
        };
        // A struct without members cannot be generic in their type.
        let generic = self.parameters_generic();
        let scalar = (!parameters.is_empty()).then(|| quote!(<T: Real>));
        let (of_type, of_function) = if parameters.is_empty() {
            (None, Some(quote!(<T>)))
        } else {
            (Some(quote!(<T>)), None)
        };
        quote! {
            /// The number of space dimensions.
            pub const DIMENSION: usize = #dimension;

            #own_material

            /// The names of the parameters, in the order of the field file.
            pub const NAMES: [&str; #count] = [#(#names),*];

            #[doc = #doc]
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

    fn own_material(&self) -> TokenStream {
        let text = match self.compiled.own_material() {
            Some((_, text)) => quote!(::core::option::Option::Some(#text)),
            None => quote!(::core::option::Option::None),
        };
        quote! {
            /// The text of the material's file, where the field brings its own.
            pub const OWN_MATERIAL: Option<&str> = #text;
        }
    }

    /// The struct of the Parameter stage, and the items that need no time.
    pub(super) fn field(&self) -> TokenStream {
        let kept = self.kept_in(Stage::Parameter);
        let names: Vec<_> = kept.iter().map(|value| self.name(*value)).collect();
        let place = Context::once(quote!(), &[Stage::Parameter]);
        let values: Vec<_> = kept.iter().map(|value| self.narrowed(*value, &place)).collect();
        let wide = self.kept_for_times();
        let wide_names: Vec<_> = wide.iter().map(|value| self.wide_name(*value)).collect();
        let wide_values = wide.iter().map(|value| self.operand(*value, &place));
        let body = self.statements(kept.iter().chain(&wide).copied(), &place);
        let generic = self.parameters_generic();
        let solver = self.compiled.is_for_a_solver().then(|| {
            let (bounds, responses) = (self.bounds(), self.responses(false));
            quote! {
                impl<T: Real> Field<T> {
                    #bounds
                    #responses
                }
            }
        });
        let window = (solver.is_none() && !self.compiled.field.is_static()).then(|| {
            let window = self.bound(Bound::Time);
            quote!(impl<T: Real> Field<T> { #window })
        });
        // A field without any value still has a scalar type.
        let (marker, marked) = match kept.is_empty() && wide.is_empty() {
            true => (
                Some(quote!(marker: ::core::marker::PhantomData<T>,)),
                Some(quote!(marker: ::core::marker::PhantomData,)),
            ),
            false => (None, None),
        };
        quote! {
            /// The field for one set of parameters: everything that needs neither t nor X, computed with
            /// more digits than `T` has.
            #[derive(Clone, Copy, Debug)]
            pub struct Field<T: Real> {
                #(#names: T,)*
                #(#wide_names: T::Wide,)*
                #marker
            }

            /// Computes once what only the parameters determine.
            pub fn prepare<T: Real>(parameters: &Parameters #generic) -> Field<T> {
                #body
                Field { #(#names: #values,)* #(#wide_names: #wide_values,)* #marked }
            }

            #solver
            #window
        }
    }

    fn parameters_generic(&self) -> Option<TokenStream> {
        (!self.parameter_names.is_empty()).then(|| quote!(<T>))
    }

    /// The function that returns a bound.
    fn bound(&self, bound: Bound) -> TokenStream {
        let place = Context::at_points(quote!(self), &[]);
        let name = format_ident!("{}", bound.name());
        let doc = format!(" {}", bound.doc());
        let values = self.values(Output::Bound(bound));
        let length = Literal::usize_unsuffixed(values.len());
        let values = values.iter().map(|value| self.operand(*value, &place));
        quote! {
            #[doc = #doc]
            pub fn #name(&self) -> [T; #length] { [#(#values),*] }
        }
    }

    fn bounds(&self) -> TokenStream {
        let time = self.bound(Bound::Time);
        // If there is no body, there are no bounds of it.
        let parts = self.program.outputs.keys().filter_map(|output| match output {
            Output::Bound(bound) if !matches!(bound, Bound::Time | Bound::Space) => Some(*bound),
            _ => None,
        });
        let body = parts.map(|it| self.bound(it));
        quote!(#(#body)* #time)
    }

    /// The functions of the material that change with time, or those that do not.
    pub(super) fn responses(&self, timed: bool) -> TokenStream {
        let (point, gradient) = (self.point(), self.gradient());
        let own: &[Stage] = &[Stage::Point, Stage::PointTime];
        let place = Context::at_points(if timed { quote!(self.field) } else { quote!(self) }, own);
        let kirchhoff = match self.compiled.model.kind {
            InvariantKind::SmallStrain => {
                " P F^T at X of the displacement gradient H, Pa, for an updated formulation: no stress at small strain."
            }
            _ => " Kirchhoff stress tau = P F^T at X of the displacement gradient H, Pa.",
        };
        let functions = [
            (Response::Density, "density", " Reference density rho0 at X, kg/m^3.", Shape::Scalar),
            (
                Response::WaveSpeed,
                "wave_speed",
                " The fastest wave speed at X in the undeformed state, m/s.",
                Shape::Scalar,
            ),
            (
                Response::StrainEnergy,
                "material_strain_energy",
                " Strain-energy density W at X of the displacement gradient H, Pa.",
                Shape::Scalar,
            ),
            (
                Response::FirstPiolaKirchhoff,
                "material_first_piola_kirchhoff",
                " First Piola-Kirchhoff stress P = dW/dF at X of the displacement gradient H, Pa.",
                Shape::Tensor,
            ),
            (Response::KirchhoffStress, "material_kirchhoff_stress", kirchhoff, Shape::Tensor),
        ];
        let wanted = functions
            .into_iter()
            .filter(|(response, ..)| self.is_timed(Output::Response(*response)) == timed);
        wanted
            .map(|(response, name, doc, shape)| {
                let name = format_ident!("{name}");
                let strained = !matches!(response, Response::Density | Response::WaveSpeed);
                let gradient = strained.then(|| quote!(, #gradient));
                let output = Output::Response(response);
                let (kind, value) = (self.shape_type(shape), self.shaped(output, shape, &place));
                let body = self.body(&[output], &place);
                quote! {
                    #[doc = #doc]
                    #[inline(always)]
                    pub fn #name(&self, #point #gradient) -> #kind { #body #value }
                }
            })
            .collect()
    }
}
