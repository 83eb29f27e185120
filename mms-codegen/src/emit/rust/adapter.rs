//! The adapter: the kernels as the runtime's contract, over batches of points.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use super::{Emitter, RUNTIME};
use crate::mechanics::model::Body;
use crate::quantity::Quantity;
use crate::spec::{Claim, Face};

impl Emitter<'_> {
    /// The contract of the runtime: batches of points, one Time stage each.
    pub(super) fn contract(&self) -> TokenStream {
        let runtime = Ident::new(RUNTIME, Span::call_site());
        let dimension = self.dimension();
        let domain = self.domain();
        // A solver asks for these two at every particle in every step, and for the others at some points or
        // times: loops over many points are long to compile.
        let batches = [Quantity::Displacement, Quantity::BodyForce].map(|quantity| {
            let name = format_ident!("{}", quantity.name());
            let batch = format_ident!("{name}_batch_aos");
            quote! {
                fn #name(&self, time: T, reference: &[Vector<T>], out: &mut [Vector<T>]) {
                    let (points, out) =
                        (::#runtime::arrays(reference), ::#runtime::arrays_mut(out));
                    self.at_time(time).#batch(points, out);
                }
            }
        });
        let vectors = [Quantity::Velocity, Quantity::Acceleration].map(|quantity| {
            let name = format_ident!("{}", quantity.name());
            quote! {
                fn #name(&self, time: T, reference: &[Vector<T>], out: &mut [Vector<T>]) {
                    let field = self.at_time(time);
                    for (out, point) in out.iter_mut().zip(reference) {
                        *out = field.#name((*point).into()).into();
                    }
                }
            }
        });
        quote! {
            type Vector<T> = ::#runtime::Vector<T, #dimension>;
            type Matrix<T> = ::#runtime::Matrix<T, #dimension>;

            impl<T: ::#runtime::Real> Field<T> {
                /// The field behind the contract, as a solver takes it.
                pub fn boxed(self) -> ::std::boxed::Box<dyn ::#runtime::ManufacturedField<T, #dimension>> {
                    ::std::boxed::Box::new(self)
                }
            }

            impl<T: ::#runtime::Real> ::#runtime::Material<T, #dimension> for Field<T> {
                fn density(&self, reference: &[Vector<T>], density: &mut [T]) {
                    for (density, point) in density.iter_mut().zip(reference) {
                        *density = Field::density(self, (*point).into());
                    }
                }

                fn wave_speed(&self, reference: &[Vector<T>], speed: &mut [T]) {
                    for (speed, point) in speed.iter_mut().zip(reference) {
                        *speed = Field::wave_speed(self, (*point).into());
                    }
                }

                fn kirchhoff_stress(
                    &self,
                    reference: &[Vector<T>],
                    displacement_gradient: &[Matrix<T>],
                    stress: &mut [Matrix<T>],
                ) {
                    let points = reference.iter().zip(displacement_gradient);
                    for (stress, (point, gradient)) in stress.iter_mut().zip(points) {
                        let rows = ::core::array::from_fn(|i| {
                            ::core::array::from_fn(|j| gradient[(i, j)])
                        });
                        let rows = self.material_kirchhoff_stress((*point).into(), rows);
                        *stress = Matrix::from_fn(|i, j| rows[i][j]);
                    }
                }
            }

            impl<T: ::#runtime::Real> ::#runtime::ManufacturedField<T, #dimension> for Field<T> {
                #domain
                #(#batches)*
                #(#vectors)*

                fn displacement_gradient(
                    &self,
                    time: T,
                    reference: &[Vector<T>],
                    out: &mut [Matrix<T>],
                ) {
                    let field = self.at_time(time);
                    for (out, point) in out.iter_mut().zip(reference) {
                        let rows = field.displacement_gradient((*point).into());
                        *out = Matrix::from_fn(|i, j| rows[i][j]);
                    }
                }
            }
        }
    }

    fn domain(&self) -> TokenStream {
        let runtime = Ident::new(RUNTIME, Span::call_site());
        let dimension = self.dimension();
        let body = match &self.compiled.model.domain.body {
            Body::Box { .. } => quote! {
                ::#runtime::Body::Box { lower: self.lower().into(), upper: self.upper().into() }
            },
            Body::Annulus { .. } => quote! {
                ::#runtime::Body::Annulus {
                    inner: self.inner()[0],
                    outer: self.outer()[0],
                    theta: self.theta(),
                }
            },
        };
        let faces = self.compiled.field.boundary.iter().map(|boundary| {
            let index = Literal::usize_unsuffixed;
            let face = match boundary.face.value {
                Face::Min(axis) => {
                    let axis = index(axis);
                    quote!(Min(#axis))
                }
                Face::Max(axis) => {
                    let axis = index(axis);
                    quote!(Max(#axis))
                }
                Face::Inner => quote!(Inner),
                Face::Outer => quote!(Outer),
                Face::ThetaMin => quote!(ThetaMin),
                Face::ThetaMax => quote!(ThetaMax),
            };
            let condition = match boundary.claim.value {
                Claim::Fixed => quote!(Fixed),
                Claim::Roller => quote!(Roller),
                Claim::Free => quote!(Free),
                Claim::Prescribed => quote!(Prescribed),
                Claim::Traction => quote!(Traction),
            };
            quote!((::#runtime::Face::#face, ::#runtime::Condition::#condition))
        });
        quote! {
            fn domain(&self) -> ::#runtime::Domain<T, #dimension> {
                ::#runtime::Domain {
                    body: #body,
                    time: self.time_window(),
                    faces: ::std::vec![#(#faces),*],
                }
            }
        }
    }
}
