//! Quantities at many points: the functions of a point, driven over slices.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens as _, format_ident, quote};

use super::quantity::{at, function};
use super::{Context, Emitter, MATH, RUNTIME, input};
use mms_mechanics::Output;
use mms_program::loops::{Columns, Cut, is_worth_two};
use mms_program::{Op, Stage, Value};
use mms_spec::quantity::{Quantity, Shape};
use mms_symbolic::expr::{Function, Symbol};
use mms_symbolic::sorted::SortedSet;

impl Emitter<'_> {
    /// The path of `mms-math` in generated code: the crate itself, or its re-export `math` in `mms-runtime`.
    pub(super) fn math(&self) -> TokenStream {
        let name = Ident::new(if self.contract { RUNTIME } else { MATH }, Span::call_site());
        if self.contract { quote!(::#name::math) } else { quote!(::#name) }
    }

    /// The items of the loops over points: the prepared field in the scalar of a loop, the cache of many points, and a kernel
    /// for each quantity.
    pub(super) fn batches(&self) -> TokenStream {
        let reads: Vec<_> = self
            .quantities()
            .map(|quantity| {
                let roots = self.values(Output::Quantity(quantity));
                let columns = Columns::of(self.program, roots);
                (quantity, self.kept_for(&columns), columns)
            })
            .collect();
        let kept: SortedSet<Value> =
            reads.iter().flat_map(|(_, kept, _)| &kept.columns.values).copied().collect();
        let kept = Vec::from_iter(kept);
        let (stand_ins, points) = (self.stand_ins(), self.points(&kept));
        let kernels = reads
            .iter()
            .map(|(quantity, own, columns)| self.kernels_of(*quantity, columns, own, &kept));
        quote!(#stand_ins #points #(#kernels)*)
    }

    /// The functions `standing`, which convert the prepared structs to the scalar type of a loop.
    fn stand_ins(&self) -> TokenStream {
        let names = |values: Vec<Value>| -> Vec<_> {
            values.into_iter().map(|value| self.name(value)).collect()
        };
        let (field, time) =
            (names(self.kept_in(Stage::Parameter)), names(self.kept_in(Stage::Time)));
        let wide: Vec<_> =
            self.kept_for_times().into_iter().map(|value| self.wide_name(value)).collect();
        let marker = (field.is_empty() && wide.is_empty())
            .then(|| quote!(marker: ::core::marker::PhantomData,));
        quote! {
            impl<T: Real> Field<T> {
                #[inline(always)]
                fn standing<S: batch::Lift<T>>(&self) -> Field<S> {
                    Field {
                        #(#field: S::splat(self.#field),)*
                        #(#wide: S::splat(T::narrow(self.#wide)).widen(),)*
                        #marker
                    }
                }
            }

            impl<T: Real> AtTime<'_, T> {
                #[inline(always)]
                fn standing<'a, S: batch::Lift<T>>(&self, field: &'a Field<S>) -> AtTime<'a, S> {
                    AtTime { field, #(#time: S::splat(self.#time),)* }
                }
            }
        }
    }

    /// The cache of many points.
    fn points(&self, kept: &[Value]) -> TokenStream {
        let names: Vec<_> = kept.iter().map(|value| self.name(*value)).collect();
        let place =
            Context { scalar: quote!(S), ..Context::at_points(quote!(self.0), &[Stage::Point]) };
        let body = self.statements(kept.iter().copied(), &place);
        let (dimension, position) = (self.dimension(), self.position());
        let count = self.axes().len() + kept.len();
        let size = format!(
            " {count} values of `T` a point, {} bytes in double precision: see `BYTES`.",
            8 * count
        );
        let count = Literal::usize_unsuffixed(count);
        quote! {
            /// The values that many reference positions determine, as one column for each value.
            ///
            #[doc = #size]
            /// Use it if computing those values costs more than reading them from memory:
            /// for sines, exponentials and roots, not for a product or two.
            #[derive(Clone, Debug)]
            pub struct Points<T: batch::Float> {
                kept: batch::PointCache<T, #count>,
            }

            impl<T: batch::Float> Points<T> {
                /// The size of one point in bytes.
                pub const BYTES: usize = #count * ::core::mem::size_of::<T>();

                /// The number of points.
                pub fn len(&self) -> usize {
                    self.kept.len()
                }

                /// Whether there is no point.
                pub fn is_empty(&self) -> bool {
                    self.kept.is_empty()
                }
            }

            impl<T: batch::Float> Field<T> {
                /// Computes once what the parameters and many reference positions determine.
                ///
                /// # Panics
                ///
                /// If the slices have different lengths.
                pub fn at_points(&self, points: [&[T]; #dimension]) -> Points<T> {
                    let mut kept = batch::PointCache::room_for(points[0].len());
                    batch::run(&PointsOf(self), &points, &mut kept);
                    Points { kept }
                }
            }

            struct PointsOf<'a, T: Real>(&'a Field<T>);

            impl<S: Real> batch::Function<S, #dimension, #count> for PointsOf<'_, S> {
                #[inline(always)]
                fn at(&self, [#(#position),*]: [S; #dimension]) -> [S; #count] {
                    #body
                    [#(#position,)* #(#names),*]
                }
            }

            impl<T: batch::Float> batch::Kernel<T, #dimension, #count> for PointsOf<'_, T> {
                #[inline(always)]
                fn drive<S: batch::Lift<T>>(
                    &self,
                    points: &mut impl batch::Points<S, #dimension, #count>,
                ) {
                    points.each(&PointsOf(&self.0.standing()));
                }
            }
        }
    }

    /// The kernels of a quantity that needs these `columns` of a point, and the functions that call them. The kernel over stored
    /// points reads the columns of `own` among `all` stored columns, and computes the other ones.
    fn kernels_of(
        &self,
        quantity: Quantity,
        columns: &Columns,
        own: &Cut,
        all: &[Value],
    ) -> TokenStream {
        let math = self.math();
        let dimension = self.axes().len();
        let takes_normal = quantity.takes_normal();
        let normals = if takes_normal { dimension } else { 0 };
        let space = self.compiled.field.space;
        let (axes, results) = (count(dimension), count(space.components(quantity.shape())));
        let name = quantity.name();
        let function = function(quantity);
        let [batch, batch_aos, batch_at] =
            ["batch", "batch_aos", "batch_at"].map(|suffix| format_ident!("{function}_{suffix}"));
        let (whole, cached) = (kernel(quantity, ""), kernel(quantity, "At"));
        let position = self.position();
        let normal = normal(normals);
        let inputs = count(dimension + normals);
        let with_normals = takes_normal.then(|| quote!(normals,));
        let Columns { axes: own_axes, values } = &own.columns;
        let column = |value| {
            dimension + all.binary_search(value).expect("every value that is read is stored")
        };
        let indices = own_axes.iter().copied().chain(values.iter().map(column));
        let indices = indices.map(count);
        let from_position = if is_worth_two(self.program, self.values(Output::Quantity(quantity))) {
            self.two_loops(quantity, columns)
        } else {
            let normal_argument = takes_normal.then(|| quote!(, [#(#normal),*]));
            let result =
                self.flat(quantity, quote!(at.#function([#(#position),*] #normal_argument)));
            quote! {
                #math::kernel! { #whole<S>, #inputs -> #results, |at, [#(#position,)* #(#normal),*]| {
                    #result
                } }
            }
        };
        let over_columns = self.over_columns(quantity, &cached, columns, own);
        quote! {
            #from_position
            #over_columns
            #math::batches! {
                #name, #with_normals #axes -> #results;
                #whole: #batch, #batch_aos;
                #cached: #batch_at, [#(#indices),*];
            }
        }
    }

    /// A kernel of a quantity that needs these `columns` of a point; it computes them from its arguments.
    pub(super) fn over_columns(
        &self,
        quantity: Quantity,
        kernel: &Ident,
        columns: &Columns,
        taken: &Cut,
    ) -> TokenStream {
        let math = self.math();
        let dimension = self.axes().len();
        let takes_normal = quantity.takes_normal();
        let normal = normal(if takes_normal { dimension } else { 0 });
        let normal_argument = takes_normal.then(|| quote!(, [#(#normal),*]));
        let results = count(self.compiled.field.space.components(quantity.shape()));
        let (function, point) = (at(quantity), self.point_of(columns));
        let result = self.flat(quantity, quote!(at.#function(&#point #normal_argument)));
        let place =
            Context { scalar: quote!(S), ..Context::at_points(quote!(at.field), &[Stage::Point]) };
        let made = self.one_by_one(&taken.made, &place);
        let axes = taken.columns.axes.iter().map(|axis| self.input(Symbol::Coordinate(*axis)));
        let taken = axes.chain(taken.columns.values.iter().map(|value| self.name(*value)));
        let taken: Vec<_> = taken.chain(normal).collect();
        let inputs = count(taken.len());
        quote! {
            #math::kernel! { #kernel<S>, #inputs -> #results, |at, [#(#taken),*]| {
                #made
                #result
            } }
        }
    }

    /// The names of a point's coordinates.
    pub(super) fn position(&self) -> Vec<Ident> {
        self.axes().map(|axis| self.input(Symbol::Coordinate(axis))).collect()
    }

    /// `Together` or `Apart`: whether the two loops of a split kernel run as one. They do if the first loop has divisions or
    /// roots, and apart from these only sums and products. Functions have coefficients, too many for the registers that the second loop leaves free.
    pub(super) fn loops_of(&self, quantity: Quantity) -> Ident {
        let roots = self.values(Output::Quantity(quantity));
        let needed = self.program.needed_for(roots.iter().copied());
        let has = |kind: fn(&Op) -> bool| {
            let mut found = self.program.range(Stage::Point).filter(|index| needed[*index]);
            found.any(|index| kind(&self.program.instrs[index].op))
        };
        let name = if has(divides) && !has(is_function) { "Together" } else { "Apart" };
        Ident::new(name, Span::call_site())
    }

    /// The components of a result beside each other.
    fn flat(&self, quantity: Quantity, result: TokenStream) -> TokenStream {
        match quantity.shape() {
            Shape::Scalar => quote!([#result]),
            Shape::Vector => result,
            Shape::Tensor => {
                let columns: Vec<_> = self.rows().map(Literal::usize_unsuffixed).collect();
                let components = columns
                    .iter()
                    .flat_map(|row| columns.iter().map(move |column| quote!(p[#row][#column])));
                quote!(let p = #result; [#(#components),*])
            }
        }
    }

    /// A point with only these columns; the others are 0.
    fn point_of(&self, columns: &Columns) -> TokenStream {
        let zero = quote!(S::from_f64(0.0));
        let position = self.axes().map(|axis| match columns.axes.contains(&axis) {
            true => self.input(Symbol::Coordinate(axis)).into_token_stream(),
            false => zero.clone(),
        });
        let members = self.kept_in(Stage::Point).into_iter().map(|value| {
            let name = self.name(value);
            match columns.values.contains(&value) {
                true => quote!(#name),
                false => quote!(#name: #zero),
            }
        });
        quote!(Point { reference_position: [#(#position),*], #(#members),* })
    }
}

/// Whether an operation occupies the divider of a processor.
fn divides(op: &Op) -> bool {
    matches!(op, Op::Divide(..) | Op::Unary(Function::Sqrt, ..))
}

/// Whether an operation is a function that is computed by sums and products.
fn is_function(op: &Op) -> bool {
    matches!(op, Op::Unary(..) | Op::Binary(..)) && !divides(op)
}

/// The names of the components of a normal.
pub(super) fn normal(components: usize) -> Vec<Ident> {
    (0..components).map(|axis| input(Symbol::Normal(axis))).collect()
}

/// A count as a literal without a suffix.
pub(super) fn count(number: usize) -> Literal {
    Literal::usize_unsuffixed(number)
}

/// The name of the kernel of a quantity.
pub(super) fn kernel(quantity: Quantity, suffix: &str) -> Ident {
    if let Quantity::Own(own) = quantity {
        return format_ident!("Own{}{suffix}Kernel", own.place);
    }
    let words = quantity.name().split('_').map(|word| {
        let (first, rest) = word.split_at(1);
        first.to_uppercase() + rest
    });
    format_ident!("{}{suffix}Kernel", words.collect::<String>())
}
