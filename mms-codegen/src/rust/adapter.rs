//! The adapter: the kernels as the runtime's contract, over batches of points.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens as _, format_ident, quote};

use super::{Emitter, RUNTIME, input};
use mms_mechanics::Output;
use mms_mechanics::Response;
use mms_mechanics::invariant::Kind;
use mms_spec::quantity::Quantity;
use mms_spec::{Body, Claim, Face};
use mms_symbolic::expr::Symbol;

impl Emitter<'_> {
    /// The contract of the runtime: batches of points, one Time stage each.
    pub(super) fn contract(&self) -> TokenStream {
        let runtime = Ident::new(RUNTIME, Span::call_site());
        let dimension = self.dimension();
        let (domain, response) = (self.domain(), self.response());
        let (reference, source) = match self.stress_depends_on_position() {
            true => (
                quote!(reference),
                quote! {
                    &(::#runtime::arrays::<T, _, #dimension>(reference.as_flattened()), gradients)
                },
            ),
            false => (quote!(_), quote!(&gradients)),
        };
        let is_small = self.compiled.model.kind == Kind::SmallStrain;
        let small_strain = is_small.then(|| {
            quote! {
                fn is_small_strain(&self) -> bool {
                    true
                }
            }
        });
        let [stress_owner, energy_owner] =
            [Response::KirchhoffStress, Response::StrainEnergy].map(|it| self.owner(it));
        let is_timed = self.is_timed(Output::Response(Response::StrainEnergy));
        let changes = is_timed.then(|| {
            quote! {
                fn changes_with_time(&self) -> bool {
                    true
                }
            }
        });
        let components = Literal::usize_unsuffixed(self.axes().len().pow(2));
        // A solver asks for these two, and for the stress, at every particle in every step, and for the others
        // at some points or times: loops over many points are long to compile.
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

            #response

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

                #small_strain

                #changes

                fn kirchhoff_stress(
                    &self,
                    time: T,
                    reference: &[Vector<T>],
                    displacement_gradient: &[Matrix<T>],
                    stress: &mut [Matrix<T>],
                ) {
                    ::#runtime::material::by_bunches(
                        self, time, reference, displacement_gradient, stress,
                    );
                }

                fn kirchhoff_stress_of_bunches(
                    &self,
                    time: T,
                    #reference: &[[Vector<T>; ::#runtime::column::BUNCH]],
                    displacement_gradient: &[::#runtime::column::Matrices<T, #dimension>],
                    stress: &mut [::#runtime::column::Matrices<T, #dimension>],
                ) {
                    use ::#runtime::math::bunched::Bunched;
                    let gradients = Bunched::<_, #components>(displacement_gradient);
                    let mut stress = Bunched::<_, #components>(stress);
                    batch::run(&Response(&#stress_owner), #source, &mut stress);
                }

                fn strain_energy(
                    &self,
                    time: T,
                    reference: &[Vector<T>],
                    displacement_gradient: &[Matrix<T>],
                    energy: &mut [T],
                ) -> bool {
                    let material = #energy_owner;
                    let states = reference.iter().zip(displacement_gradient);
                    for (energy, (point, gradient)) in energy.iter_mut().zip(states) {
                        // Matrices are stored by columns.
                        let rows = gradient.transpose().into();
                        *energy = material.material_strain_energy((*point).into(), rows);
                    }
                    true
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

    /// Whether the Kirchhoff stress of a displacement gradient is another one elsewhere in the body.
    fn stress_depends_on_position(&self) -> bool {
        let stress = Output::Response(Response::KirchhoffStress);
        self.needs(stress, |symbol| matches!(symbol, Symbol::Coordinate(_)))
    }

    /// The owner of a function of the material: the field, or the field at one time where given fields change it.
    fn owner(&self, response: Response) -> TokenStream {
        match self.is_timed(Output::Response(response)) {
            true => quote!(self.at_time(time)),
            false => quote!(self),
        }
    }

    /// The Kirchhoff stress of a displacement gradient, as a kernel. Matrices go by columns here.
    fn response(&self) -> TokenStream {
        let columns = |symbol: &dyn Fn(usize, usize) -> TokenStream| -> Vec<TokenStream> {
            self.axes()
                .flat_map(|j| self.axes().map(move |i| (i, j)))
                .map(|(i, j)| symbol(i, j))
                .collect()
        };
        let gradients = columns(&|i, j| input(Symbol::Gradient(i, j)).into_token_stream());
        let stresses = columns(&|i, j| {
            let [i, j] = [i, j].map(Literal::usize_unsuffixed);
            quote!(stress[#i][#j])
        });
        let rows = self.axes().map(|i| {
            let row = self.axes().map(|j| input(Symbol::Gradient(i, j)));
            quote!([#(#row),*])
        });
        let mut point: Vec<_> =
            self.axes().map(|axis| self.input(Symbol::Coordinate(axis))).collect();
        let mut position = quote!([#(#point),*]);
        if !self.stress_depends_on_position() {
            let zeros = self.axes().map(|_| quote!(T::from_f64(0.0)));
            position = quote!([#(#zeros),*]);
            point.clear();
        }
        let inputs = Literal::usize_unsuffixed(point.len() + gradients.len());
        let results = Literal::usize_unsuffixed(gradients.len());
        let stress = Output::Response(Response::KirchhoffStress);
        let (owner, standing) = match self.is_timed(stress) {
            true => (
                quote!(AtTime<'a, T>),
                quote! {
                    let field = self.0.field.standing();
                    points.each(&Response(&self.0.standing(&field)));
                },
            ),
            false => (quote!(Field<T>), quote!(points.each(&Response(&self.0.standing()));)),
        };
        quote! {
            struct Response<'a, T: Real>(&'a #owner);

            impl<T: Real> batch::Function<T, #inputs, #results> for Response<'_, T> {
                #[inline(always)]
                fn at(&self, [#(#point,)* #(#gradients),*]: [T; #inputs]) -> [T; #results] {
                    let stress =
                        self.0.material_kirchhoff_stress(#position, [#(#rows),*]);
                    [#(#stresses),*]
                }
            }

            impl<T: batch::Float> batch::Kernel<T, #inputs, #results> for Response<'_, T> {
                #[inline(always)]
                fn drive<S: batch::Stand<T>>(
                    &self,
                    points: &mut impl batch::Points<S, #inputs, #results>,
                ) {
                    #standing
                }
            }
        }
    }

    fn domain(&self) -> TokenStream {
        let runtime = Ident::new(RUNTIME, Span::call_site());
        let dimension = self.dimension();
        let body = match &self.compiled.field.domain.body {
            Body::Box { .. } => quote! {
                Box { lower: self.lower().into(), upper: self.upper().into() }
            },
            Body::Round(round) => {
                let theta =
                    quote!(inner: self.inner()[0], outer: self.outer()[0], theta: self.theta());
                match round.shape.name {
                    "cylinder" => quote!(Cylinder { #theta, z: self.z_ends() }),
                    "sphere" => quote!(Sphere { #theta, phi: self.phi() }),
                    _ => quote!(Annulus { #theta }),
                }
            }
            Body::Polygon(polygon) => {
                let names = &polygon.names;
                quote! {
                Polygon {
                    vertices: self
                        .vertices()
                        .chunks_exact(2)
                        .map(|vertex| [vertex[0], vertex[1]])
                        .collect(),
                    names: ::std::vec![#(#names),*],
                }
                }
            }
            Body::Nothing => quote!(Nothing),
        };
        let faces = self.compiled.field.boundary.iter().filter_map(|boundary| {
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
                Face::PhiMin => quote!(PhiMin),
                Face::PhiMax => quote!(PhiMax),
                Face::Edge(first, name) => {
                    let first = index(first);
                    quote!(Edge(#first, #name))
                }
                // Of an axisymmetric body, which the solver does not know.
                Face::RadialMin | Face::RadialMax | Face::AxialMin | Face::AxialMax => return None,
            };
            let condition = match boundary.claim.value {
                Claim::Fixed => quote!(Fixed),
                Claim::Roller => quote!(Roller),
                Claim::Free => quote!(Free),
                Claim::Prescribed => quote!(Prescribed),
                Claim::Traction => quote!(Traction),
                Claim::Axis => return None,
            };
            Some(quote!((::#runtime::Face::#face, ::#runtime::Condition::#condition)))
        });
        quote! {
            fn domain(&self) -> ::#runtime::Domain<T, #dimension> {
                ::#runtime::Domain {
                    body: ::#runtime::Body::#body,
                    time: self.time_window(),
                    faces: ::std::vec![#(#faces),*],
                }
            }
        }
    }
}
