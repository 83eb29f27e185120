//! The adapter: implements the runtime's contract with the kernels, over batches of points.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens as _, format_ident, quote};

use super::{Emitter, RUNTIME, input};
use mms_mechanics::Output;
use mms_mechanics::Response;
use mms_mechanics::invariant::InvariantKind;
use mms_spec::quantity::Quantity;
use mms_spec::{BodySpec, Claim, Face};
use mms_symbolic::expr::Symbol;

impl Emitter<'_> {
    /// The contract of the runtime: batches of points, one Time stage each.
    pub(super) fn contract(&self) -> TokenStream {
        let runtime = Ident::new(RUNTIME, Span::call_site());
        let dimension = self.dimension();
        let (domain, response) = (self.domain(), self.response());
        let source = match self.stress_depends_on_position() {
            true => quote! {
                &(::#runtime::arrays::<T, _, #dimension>(reference.as_flattened()), gradients)
            },
            false => quote!(&gradients),
        };
        let is_small = self.compiled.model.kind == InvariantKind::SmallStrain;
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
        let is_axisymmetric = self.compiled.field.space.is_axisymmetric();
        let components = Literal::usize_unsuffixed(self.components().count());
        let material = quote! {
            use ::#runtime::math::packed::Packed;
            let gradients = Packed::<_, #components>(gradients);
            let mut stress = Packed::<_, #components>(stress);
            batch::run(&Response(&#stress_owner), #source, &mut stress);
        };
        let [own_stress, own_energy, revolved] = match is_axisymmetric {
            true => self.revolved(&material, &energy_owner),
            false => [
                quote! {
                    let gradients = displacement_gradient;
                    #material
                },
                quote! {
                    let material = #energy_owner;
                    let states = reference.iter().zip(displacement_gradient);
                    for (energy, (point, gradient)) in energy.iter_mut().zip(states) {
                        // Matrices are stored by columns.
                        let rows = gradient.transpose().into();
                        *energy = material.material_strain_energy((*point).into(), rows);
                    }
                    true
                },
                TokenStream::new(),
            ],
        };
        let axisymmetric = is_axisymmetric.then(|| {
            quote! {
                fn axisymmetric(
                    &self,
                ) -> ::std::option::Option<&dyn ::#runtime::Axisymmetric<T, #dimension>> {
                    ::std::option::Option::Some(self)
                }
            }
        });
        // A solver evaluates these two, and the stress, at every particle in every step, and the other quantities at some
        // points or times only: loops over many points are slow to compile.
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

                #axisymmetric

                #changes

                fn kirchhoff_stress(
                    &self,
                    time: T,
                    reference: &[Vector<T>],
                    displacement_gradient: &[Matrix<T>],
                    stress: &mut [Matrix<T>],
                ) {
                    ::#runtime::material::by_packs(
                        self, time, reference, displacement_gradient, stress,
                    );
                }

                fn kirchhoff_stress_of_packs(
                    &self,
                    time: T,
                    reference: &[[Vector<T>; ::#runtime::column::PACK]],
                    displacement_gradient: &[::#runtime::column::Matrices<T, #dimension>],
                    stress: &mut [::#runtime::column::Matrices<T, #dimension>],
                ) {
                    #own_stress
                }

                fn strain_energy(
                    &self,
                    time: T,
                    reference: &[Vector<T>],
                    displacement_gradient: &[Matrix<T>],
                    energy: &mut [T],
                ) -> bool {
                    #own_energy
                }
            }

            #revolved

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

    /// Writes the stress and the energy of an axisymmetric field at its own hoop strains, and the contract of a body of
    /// revolution, whose stress is `material`.
    fn revolved(&self, material: &TokenStream, energy_owner: &TokenStream) -> [TokenStream; 3] {
        let runtime = Ident::new(RUNTIME, Span::call_site());
        let dimension = self.dimension();
        let module = quote!(::#runtime::axisymmetric);
        let own_stress = quote! {
            #module::stress_at_own_strain(self, time, reference, displacement_gradient, stress);
        };
        let own_energy = quote! {
            #module::energy_at_own_strain(self, time, reference, displacement_gradient, energy)
        };
        let revolved = quote! {
            impl<T: ::#runtime::Real> ::#runtime::Axisymmetric<T, #dimension> for Field<T> {
                fn hoop_strain(&self, time: T, reference: &[Vector<T>], out: &mut [T]) {
                    let field = self.at_time(time);
                    for (out, point) in out.iter_mut().zip(reference) {
                        *out = field.displacement_gradient((*point).into())[2][2];
                    }
                }

                fn kirchhoff_stress_of_packs(
                    &self,
                    time: T,
                    reference: &[[Vector<T>; ::#runtime::column::PACK]],
                    strains: (
                        &[::#runtime::column::Matrices<T, #dimension>],
                        &[[T; ::#runtime::column::PACK]],
                    ),
                    stresses: (
                        &mut [::#runtime::column::Matrices<T, #dimension>],
                        &mut [[T; ::#runtime::column::PACK]],
                    ),
                ) {
                    #module::by_rings(reference, strains, stresses, |reference, gradients, stress| {
                        #material
                    });
                }

                fn strain_energy(
                    &self,
                    time: T,
                    reference: &[Vector<T>],
                    (displacement_gradient, hoop_strain): (&[Matrix<T>], &[T]),
                    energy: &mut [T],
                ) -> bool {
                    let material = #energy_owner;
                    let zero = T::of(0.0);
                    let states = reference.iter().zip(displacement_gradient).zip(hoop_strain);
                    for (energy, ((point, h), &hoop)) in energy.iter_mut().zip(states) {
                        let rows = [
                            [h[(0, 0)], h[(0, 1)], zero],
                            [h[(1, 0)], h[(1, 1)], zero],
                            [zero, zero, hoop],
                        ];
                        *energy = material.material_strain_energy((*point).into(), rows);
                    }
                    true
                }
            }
        };
        [own_stress, own_energy, revolved]
    }

    /// The components of strain and stress that the solver stores, column by column; for an axisymmetric field the components
    /// of the meridian plane and the one around the axis.
    fn components(&self) -> impl Iterator<Item = (usize, usize)> {
        let hoop = self.compiled.field.space.is_axisymmetric().then_some((2, 2));
        self.axes().flat_map(|j| self.axes().map(move |i| (i, j))).chain(hoop)
    }

    /// Whether the Kirchhoff stress of a displacement gradient depends on the place in the body.
    fn stress_depends_on_position(&self) -> bool {
        let stress = Output::Response(Response::KirchhoffStress);
        self.needs(stress, |symbol| matches!(symbol, Symbol::Coordinate(_)))
    }

    /// The owner of a function of the material: the field, or the field at one time if given fields change the function.
    fn owner(&self, response: Response) -> TokenStream {
        match self.is_timed(Output::Response(response)) {
            true => quote!(self.at_time(time)),
            false => quote!(self),
        }
    }

    /// The Kirchhoff stress of a displacement gradient, as a kernel. Matrices are stored by columns here.
    fn response(&self) -> TokenStream {
        let columns = |symbol: &dyn Fn(usize, usize) -> TokenStream| -> Vec<TokenStream> {
            self.components().map(|(i, j)| symbol(i, j)).collect()
        };
        let gradients = columns(&|i, j| input(Symbol::Gradient(i, j)).into_token_stream());
        let stresses = columns(&|i, j| {
            let [i, j] = [i, j].map(Literal::usize_unsuffixed);
            quote!(stress[#i][#j])
        });
        let entry = |i, j| match self.components().any(|it| it == (i, j)) {
            true => input(Symbol::Gradient(i, j)).into_token_stream(),
            false => quote!(T::from_f64(0.0)),
        };
        let rows = self.rows().map(|i| {
            let row = self.rows().map(|j| entry(i, j));
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
                fn drive<S: batch::Lift<T>>(
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
            BodySpec::Box { .. } => quote! {
                Box { lower: self.lower().into(), upper: self.upper().into() }
            },
            BodySpec::Round(round) => {
                let theta =
                    quote!(inner: self.inner()[0], outer: self.outer()[0], theta: self.theta());
                match round.shape.name {
                    "cylinder" => quote!(Cylinder { #theta, z: self.z_ends() }),
                    "sphere" => quote!(Sphere { #theta, phi: self.phi() }),
                    _ => quote!(Annulus { #theta }),
                }
            }
            BodySpec::Polygon(polygon) => {
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
            BodySpec::Nothing => quote!(Nothing),
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
                Face::RadialMin => quote!(Min(0)),
                Face::RadialMax => quote!(Max(0)),
                Face::AxialMin => quote!(Min(1)),
                Face::AxialMax => quote!(Max(1)),
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
            };
            let condition = match boundary.claim.value {
                Claim::Fixed => quote!(Fixed),
                // The axis acts as a plane that points do not leave, without traction along it.
                Claim::Roller | Claim::Axis => quote!(Roller),
                Claim::Free => quote!(Free),
                Claim::Prescribed => quote!(Prescribed),
                Claim::Traction => quote!(Traction),
            };
            quote!((::#runtime::Face::#face, ::#runtime::Condition::#condition))
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
