//! A field without compiled code, with the traits for the solver: its program, run in blocks of points with the same bits as
//! compiled code.
//!
//! A field file is used in one of two ways. In `fields/`, or by `field!`, it is compiled. Named by its path on the command
//! line, it is interpreted. `mms eval` interprets in both cases; `mms study` runs compiled code if there is some.

mod points;

use std::error::Error;
use std::fmt;
use std::sync::{Arc, OnceLock};

use dashu_ratio::RBig;
use mms_codegen::Compiled;
use mms_mechanics::Response;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::{Bound, Output};
use mms_program::Op;
use mms_program::block::{
    BlockMode, BlockPlan, Blockwise, Component, Inputs, Outputs, Prepared, ScratchPool,
};
use mms_program::interpret::Interpreter;
use mms_runtime::axisymmetric::{energy_at_own_strain, stress_at_own_strain};
use mms_runtime::column::Matrices;
use mms_runtime::column::PACK;
use mms_runtime::material::by_packs;
use mms_runtime::scene::Scene;
use mms_runtime::{
    Axisymmetric, Body, Condition, Domain, Face, ManufacturedField, Material, Matrix, Real, Vector,
};
use mms_spec::quantity::Quantity;
use mms_spec::{Claim, Space};
use mms_symbolic::expr::Symbol;
use mms_symbolic::sorted::SortedMap;

pub use points::AtPoints;

/// The number of outputs that a solver uses.
const OUTPUTS: usize = 9;

/// A field evaluated by the interpreter, for one set of parameters.
struct Interpreted<T: Blockwise> {
    compiled: Arc<Compiled>,
    parameters: Vec<T>,
    outputs: [SolverOutput<T>; OUTPUTS],
}

/// An output that a solver uses.
struct SolverOutput<T: Blockwise> {
    output: Output,
    mode: BlockMode,
    /// The prepared program, made at its first use.
    prepared: OnceLock<Prepared<T>>,
    pool: ScratchPool<T>,
}

/// The outputs, each in the mode that computes the bits of compiled code. Compiled code evaluates the first three in loops over
/// many points, with fused products, and the others point by point.
fn solver_outputs<T: Blockwise>() -> [SolverOutput<T>; OUTPUTS] {
    let (fused, portable) = (BlockMode::fused(), BlockMode::portable());
    [
        (Output::Quantity(Quantity::Displacement), fused),
        (Output::Quantity(Quantity::BodyForce), fused),
        (Output::Response(Response::KirchhoffStress), fused),
        (Output::Quantity(Quantity::Velocity), portable),
        (Output::Quantity(Quantity::Acceleration), portable),
        (Output::Quantity(Quantity::DisplacementGradient), portable),
        (Output::Response(Response::Density), portable),
        (Output::Response(Response::WaveSpeed), portable),
        (Output::Response(Response::StrainEnergy), portable),
    ]
    .map(|(output, mode)| SolverOutput {
        output,
        mode,
        prepared: OnceLock::new(),
        pool: ScratchPool::default(),
    })
}

/// A precision in which fields are interpreted. The interpreter is compiled in this crate, once: callers of [`scene`](fn@scene)
/// compile none of it.
pub trait Interpretable: Real + Blockwise {
    /// See [`scene`](fn@scene).
    ///
    /// # Errors
    /// The errors of [`scene`](fn@scene).
    fn scene(
        compiled: Arc<Compiled>,
        set: &SortedMap<usize, RBig>,
    ) -> Result<Scene<Self>, Swirling>;
}

macro_rules! interpretable {
    ($($float:ident)*) => {
        $(impl Interpretable for $float {
            fn scene(
                compiled: Arc<Compiled>,
                set: &SortedMap<usize, RBig>,
            ) -> Result<Scene<Self>, Swirling> {
                interpreted(compiled, set)
            }
        })*
    };
}

interpretable!(f32 f64);

/// An axisymmetric field with a swirl, for which there is no scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Swirling;

impl fmt::Display for Swirling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the field has a swirl, and the solver moves rings along R and Z alone")
    }
}

impl Error for Swirling {}

/// The scene of a compiled text, with some of its parameters set by the caller.
///
/// # Errors
/// The field is axisymmetric and has a swirl.
pub fn scene<T: Interpretable>(
    compiled: Arc<Compiled>,
    set: &SortedMap<usize, RBig>,
) -> Result<Scene<T>, Swirling> {
    T::scene(compiled, set)
}

fn interpreted<T: Real + Blockwise>(
    compiled: Arc<Compiled>,
    set: &SortedMap<usize, RBig>,
) -> Result<Scene<T>, Swirling> {
    let parameters = compiled.parameters(set);
    let space = compiled.field.space;
    let field = Interpreted { compiled, parameters, outputs: solver_outputs() };
    match space {
        Space::Axisymmetric { swirl: true } => Err(Swirling),
        Space::Axisymmetric { swirl: false } => Ok(Scene::Plane(Box::new(field))),
        Space::Cartesian(1) => Ok(Scene::Line(Box::new(field))),
        Space::Cartesian(2) => Ok(Scene::Plane(Box::new(field))),
        Space::Cartesian(_) => Ok(Scene::Space(Box::new(field))),
    }
}

/// Writes a coordinate of points, one for each place.
fn coordinate<T: Real, const D: usize>(column: &mut [T], points: &[Vector<T, D>], axis: usize) {
    column.iter_mut().zip(points).for_each(|(to, point)| *to = point[axis]);
}

impl<T: Real + Blockwise> Interpreted<T> {
    fn bound(&self, bound: Bound) -> Vec<T> {
        let interpreter = Interpreter::new(&self.compiled.program, &self.parameters);
        interpreter.output(Output::Bound(bound))
    }

    /// Evaluates an output at `count` points, block by block.
    fn evaluate(
        &self,
        output: Output,
        time: T,
        count: usize,
        write_inputs: &mut dyn FnMut(usize, &mut Inputs<'_, T>),
        read_outputs: &mut dyn FnMut(usize, &Outputs<'_, T>),
    ) {
        let solver_output = self.outputs.iter().find(|it| it.output == output);
        let solver_output = solver_output.expect("every output that is evaluated is listed");
        let prepared = solver_output.prepared.get_or_init(|| {
            let plan = BlockPlan::new(&self.compiled.program, &[output], Output::is_quantity);
            Prepared::new(Arc::new(plan), solver_output.mode, &self.parameters)
        });
        solver_output
            .pool
            .with(|scratch| prepared.run(scratch, time, count, write_inputs, read_outputs));
    }

    /// Evaluates an output of positions. `place` maps the index of a component to its place in the result of a point; some
    /// tensors have components without a place.
    fn at_points<R, const D: usize>(
        &self,
        time: T,
        output: Output,
        reference: &[Vector<T, D>],
        out: &mut [R],
        has_place: impl Fn(usize) -> bool,
        place: impl Fn(&mut R, usize) -> &mut T,
    ) {
        self.evaluate(
            output,
            time,
            reference.len(),
            &mut |start, inputs| {
                for (symbol, column) in inputs.columns() {
                    if let Symbol::Coordinate(axis) = symbol {
                        coordinate(column, &reference[start..], axis);
                    }
                }
            },
            &mut |start, outputs| {
                let out = &mut out[start..start + outputs.count()];
                for (index, component) in outputs.components(0).enumerate() {
                    if has_place(index) {
                        component.write(out.iter_mut().map(|it| place(it, index)));
                    }
                }
            },
        );
    }

    fn vectors<const D: usize>(
        &self,
        time: T,
        quantity: Quantity,
        reference: &[Vector<T, D>],
        out: &mut [Vector<T, D>],
    ) {
        let output = Output::Quantity(quantity);
        self.at_points(time, output, reference, out, |_| true, |it, axis| &mut it[axis]);
    }

    fn scalars<const D: usize>(
        &self,
        response: Response,
        reference: &[Vector<T, D>],
        out: &mut [T],
    ) {
        self.at_points(
            T::of(0.0),
            Output::Response(response),
            reference,
            out,
            |_| true,
            |it, _| it,
        );
    }

    /// The number of rows of tensors.
    fn rows(&self) -> usize {
        self.compiled.field.space.rows()
    }

    /// Evaluates the Kirchhoff stress of whole packs; hoop strains and stresses are used if the field is axisymmetric.
    fn stress_of_packs<const D: usize>(
        &self,
        time: T,
        reference: &[[Vector<T, D>; PACK]],
        (displacement_gradient, hoop_strain): (&[Matrices<T, D>], &[[T; PACK]]),
        (stress, hoop_stress): (&mut [Matrices<T, D>], &mut [[T; PACK]]),
    ) {
        let (points, rows) = (reference.as_flattened(), self.rows());
        self.evaluate(
            Output::Response(Response::KirchhoffStress),
            time,
            PACK * stress.len(),
            &mut |start, inputs| {
                for (symbol, column) in inputs.columns() {
                    let packs = column.as_chunks_mut().0.iter_mut();
                    let first = start / PACK;
                    match symbol {
                        Symbol::Gradient(row, axis) if row < D && axis < D => packs
                            .zip(&displacement_gradient[first..])
                            .for_each(|(to, pack)| *to = pack.0[axis][row]),
                        Symbol::Gradient(row, axis) if row == axis => {
                            packs.zip(&hoop_strain[first..]).for_each(|(to, pack)| *to = *pack);
                        }
                        Symbol::Gradient(..) => column.fill(T::of(0.0)),
                        Symbol::Coordinate(axis) => coordinate(column, &points[start..], axis),
                        _ => {}
                    }
                }
            },
            &mut |start, outputs| {
                let (first, count) = (start / PACK, outputs.count() / PACK);
                for (index, component) in outputs.components(0).enumerate() {
                    let (row, axis) = (index / rows, index % rows);
                    if row < D && axis < D {
                        let packs = stress[first..].iter_mut().take(count);
                        write_packs(&component, packs.map(|pack| &mut pack.0[axis][row]));
                    } else if row == axis {
                        write_packs(&component, hoop_stress[first..].iter_mut().take(count));
                    }
                }
            },
        );
    }

    /// Evaluates the strain energy; hoop strains are used if the field is axisymmetric.
    fn energy<const D: usize>(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        (displacement_gradient, hoop_strain): (&[Matrix<T, D>], &[T]),
        energy: &mut [T],
    ) {
        self.evaluate(
            Output::Response(Response::StrainEnergy),
            time,
            energy.len(),
            &mut |start, inputs| {
                for (symbol, column) in inputs.columns() {
                    match symbol {
                        Symbol::Gradient(row, axis) if row < D && axis < D => {
                            let gradients = &displacement_gradient[start..];
                            let columns = column.iter_mut().zip(gradients);
                            columns.for_each(|(to, gradient)| *to = gradient[(row, axis)]);
                        }
                        Symbol::Gradient(row, axis) if row == axis => {
                            let strains = &hoop_strain[start..];
                            column.iter_mut().zip(strains).for_each(|(to, strain)| *to = *strain);
                        }
                        Symbol::Gradient(..) => column.fill(T::of(0.0)),
                        Symbol::Coordinate(axis) => coordinate(column, &reference[start..], axis),
                        _ => {}
                    }
                }
            },
            &mut |start, outputs| {
                let out = &mut energy[start..start + outputs.count()];
                outputs.components(0).for_each(|component| component.write(out.iter_mut()));
            },
        );
    }
}

/// Writes a component of whole packs.
fn write_packs<'a, T: Real>(
    component: &Component<'_, T>,
    packs: impl Iterator<Item = &'a mut [T; PACK]>,
) {
    match component {
        Component::Each(numbers) => {
            packs.zip(numbers.as_chunks().0).for_each(|(to, numbers)| *to = *numbers);
        }
        Component::Same(number) => packs.for_each(|to| *to = [*number; PACK]),
    }
}

impl<T: Real + Blockwise, const D: usize> Axisymmetric<T, D> for Interpreted<T> {
    fn hoop_strain(&self, time: T, reference: &[Vector<T, D>], out: &mut [T]) {
        let (output, last) =
            (Output::Quantity(Quantity::DisplacementGradient), self.rows() * self.rows() - 1);
        self.at_points(time, output, reference, out, |index| index == last, |it, _| it);
    }

    fn kirchhoff_stress_of_packs(
        &self,
        time: T,
        reference: &[[Vector<T, D>; PACK]],
        strains: (&[Matrices<T, D>], &[[T; PACK]]),
        stresses: (&mut [Matrices<T, D>], &mut [[T; PACK]]),
    ) {
        self.stress_of_packs(time, reference, strains, stresses);
    }

    fn strain_energy(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        strains: (&[Matrix<T, D>], &[T]),
        energy: &mut [T],
    ) -> bool {
        self.energy(time, reference, strains, energy);
        true
    }
}

impl<T: Real + Blockwise, const D: usize> Material<T, D> for Interpreted<T> {
    fn density(&self, reference: &[Vector<T, D>], density: &mut [T]) {
        self.scalars(Response::Density, reference, density);
    }

    fn wave_speed(&self, reference: &[Vector<T, D>], speed: &mut [T]) {
        self.scalars(Response::WaveSpeed, reference, speed);
    }

    fn is_small_strain(&self) -> bool {
        self.compiled.model.kind == InvariantKind::SmallStrain
    }

    fn axisymmetric(&self) -> Option<&dyn Axisymmetric<T, D>> {
        self.compiled.field.space.is_axisymmetric().then_some(self)
    }

    fn changes_with_time(&self) -> bool {
        let energy = Output::Response(Response::StrainEnergy);
        let needed = self.compiled.program.needed(&[energy]);
        let mut instrs = self.compiled.program.instrs.iter().zip(needed);
        instrs.any(|(instr, needed)| needed && matches!(instr.op, Op::Input(Symbol::Time)))
    }

    fn kirchhoff_stress(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) {
        by_packs(self, time, reference, displacement_gradient, stress);
    }

    fn kirchhoff_stress_of_packs(
        &self,
        time: T,
        reference: &[[Vector<T, D>; PACK]],
        displacement_gradient: &[Matrices<T, D>],
        stress: &mut [Matrices<T, D>],
    ) {
        if self.compiled.field.space.is_axisymmetric() {
            return stress_at_own_strain(self, time, reference, displacement_gradient, stress);
        }
        self.stress_of_packs(time, reference, (displacement_gradient, &[]), (stress, &mut []));
    }

    fn strain_energy(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        energy: &mut [T],
    ) -> bool {
        if self.compiled.field.space.is_axisymmetric() {
            return energy_at_own_strain(self, time, reference, displacement_gradient, energy);
        }
        self.energy(time, reference, (displacement_gradient, &[]), energy);
        true
    }
}

impl<T: Real + Blockwise, const D: usize> ManufacturedField<T, D> for Interpreted<T> {
    fn domain(&self) -> Domain<T, D> {
        let number = |bound: Bound| self.bound(bound)[0];
        let pair = |bound: Bound| {
            let values = self.bound(bound);
            [values[0], values[1]]
        };
        let round = || (number(Bound::Inner), number(Bound::Outer), pair(Bound::Theta));
        let body = match &self.compiled.field.domain.body {
            mms_spec::BodySpec::Box { .. } => Body::Box {
                lower: Vector::from_column_slice(&self.bound(Bound::Lower)),
                upper: Vector::from_column_slice(&self.bound(Bound::Upper)),
            },
            mms_spec::BodySpec::Round(shape) => {
                let (inner, outer, theta) = round();
                match shape.shape.name {
                    "cylinder" => Body::Cylinder { inner, outer, theta, z: pair(Bound::Z) },
                    "sphere" => Body::Sphere { inner, outer, theta, phi: pair(Bound::Phi) },
                    _ => Body::Annulus { inner, outer, theta },
                }
            }
            mms_spec::BodySpec::Polygon(polygon) => {
                let vertices = self.bound(Bound::Vertices);
                let pairs = vertices.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
                Body::Polygon { vertices: pairs.collect(), names: polygon.names.clone() }
            }
            mms_spec::BodySpec::Nothing => Body::Nothing,
        };
        let time = self.bound(Bound::Time);
        let claims = self.compiled.field.boundary.iter();
        let faces = claims.map(|claim| (face(claim.face.value), condition(claim.claim.value)));
        Domain { body, time: [time[0], time[1]], faces: faces.collect() }
    }

    fn displacement(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.vectors(time, Quantity::Displacement, reference, out);
    }

    fn velocity(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.vectors(time, Quantity::Velocity, reference, out);
    }

    fn acceleration(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.vectors(time, Quantity::Acceleration, reference, out);
    }

    fn body_force(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.vectors(time, Quantity::BodyForce, reference, out);
    }

    fn displacement_gradient(&self, time: T, reference: &[Vector<T, D>], out: &mut [Matrix<T, D>]) {
        let output = Output::Quantity(Quantity::DisplacementGradient);
        let rows = self.rows();
        let has_place = |index| index / rows < D && index % rows < D;
        self.at_points(time, output, reference, out, has_place, |it, index| {
            &mut it[(index / rows, index % rows)]
        });
    }
}

/// Converts a face to the solver's type.
fn face(face: mms_spec::Face) -> Face {
    match face {
        mms_spec::Face::Min(axis) => Face::Min(axis),
        mms_spec::Face::Max(axis) => Face::Max(axis),
        mms_spec::Face::Inner => Face::Inner,
        mms_spec::Face::Outer => Face::Outer,
        mms_spec::Face::ThetaMin => Face::ThetaMin,
        mms_spec::Face::ThetaMax => Face::ThetaMax,
        mms_spec::Face::PhiMin => Face::PhiMin,
        mms_spec::Face::PhiMax => Face::PhiMax,
        mms_spec::Face::Edge(first, name) => Face::Edge(first, name),
        mms_spec::Face::RadialMin => Face::Min(0),
        mms_spec::Face::RadialMax => Face::Max(0),
        mms_spec::Face::AxialMin => Face::Min(1),
        mms_spec::Face::AxialMax => Face::Max(1),
    }
}

/// Converts a claim to the solver's type: points of the axis stay on it, and have no traction along it.
fn condition(claim: Claim) -> Condition {
    match claim {
        Claim::Fixed => Condition::Fixed,
        Claim::Roller | Claim::Axis => Condition::Roller,
        Claim::Free => Condition::Free,
        Claim::Prescribed => Condition::Prescribed,
        Claim::Traction => Condition::Traction,
    }
}
