//! A field that was never compiled, behind the solver's contract: the reference interpreter.

use std::collections::BTreeMap;
use std::sync::Arc;

use dashu_ratio::RBig;
use mms_codegen::Compiled;
use mms_codegen::mechanics::Response;
use mms_codegen::program::interpret::{Interpreter, Number, Point};
use mms_codegen::program::{Bound, Output};
use mms_codegen::quantity::Quantity;
use mms_codegen::spec::{self, Claim};
use mms_runtime::{
    Body, Condition, Domain, Face, ManufacturedField, Material, Matrix, Real, Vector,
};

use mms_runtime::scene::Scene;

/// A field evaluated by the interpreter, for one set of parameters.
struct Interpreted<T> {
    compiled: Arc<Compiled>,
    parameters: Vec<T>,
}

/// The scene of a compiled text, some of its parameters set by the caller.
pub fn scene<T: Real + Number>(compiled: Arc<Compiled>, set: &BTreeMap<usize, RBig>) -> Scene<T> {
    let parameters = compiled.parameters(set);
    let dimension = compiled.field.dimension;
    let field = Interpreted { compiled, parameters };
    match dimension {
        1 => Scene::Line(Box::new(field)),
        2 => Scene::Plane(Box::new(field)),
        _ => Scene::Space(Box::new(field)),
    }
}

impl<T: Real + Number> Interpreted<T> {
    fn interpreter(&self) -> Interpreter<'_, T> {
        Interpreter::new(&self.compiled.program, &self.parameters)
    }

    fn bound(&self, bound: Bound) -> Vec<T> {
        self.interpreter().output(Output::Bound(bound))
    }

    /// Evaluates `output` at every point of a batch, and passes its components on.
    fn at_points<const D: usize>(
        &self,
        time: T,
        output: Output,
        reference: &[Vector<T, D>],
        mut take: impl FnMut(usize, &[T]),
    ) {
        let mut interpreter = self.interpreter();
        interpreter.set_time(&time);
        let plan = interpreter.plan(&[output]);
        for (index, point) in reference.iter().enumerate() {
            interpreter.set_point(&plan, Point::at(point.as_slice()));
            take(index, &interpreter.output(output));
        }
    }

    fn vectors<const D: usize>(
        &self,
        time: T,
        quantity: Quantity,
        reference: &[Vector<T, D>],
        out: &mut [Vector<T, D>],
    ) {
        self.at_points(time, Output::Quantity(quantity), reference, |index, components| {
            out[index] = Vector::from_column_slice(components);
        });
    }

    fn scalars<const D: usize>(
        &self,
        response: Response,
        reference: &[Vector<T, D>],
        out: &mut [T],
    ) {
        self.at_points(T::of(0.0), Output::Response(response), reference, |index, components| {
            out[index] = components[0];
        });
    }
}

impl<T: Real + Number, const D: usize> Material<T, D> for Interpreted<T> {
    fn density(&self, reference: &[Vector<T, D>], density: &mut [T]) {
        self.scalars(Response::Density, reference, density);
    }

    fn wave_speed(&self, reference: &[Vector<T, D>], speed: &mut [T]) {
        self.scalars(Response::WaveSpeed, reference, speed);
    }

    fn kirchhoff_stress(
        &self,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) {
        let output = Output::Response(Response::KirchhoffStress);
        let mut interpreter = self.interpreter();
        let plan = interpreter.plan(&[output]);
        let points = reference.iter().zip(displacement_gradient);
        for (stress, (point, gradient)) in stress.iter_mut().zip(points) {
            // Matrices are stored by columns, programs take rows.
            let rows = gradient.transpose();
            let coordinates = point.as_slice();
            interpreter
                .set_point(&plan, Point { coordinates, normal: &[], gradient: rows.as_slice() });
            *stress = Matrix::from_row_slice(&interpreter.output(output));
        }
    }

    fn strain_energy(
        &self,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        energy: &mut [T],
    ) -> bool {
        let output = Output::Response(Response::StrainEnergy);
        let mut interpreter = self.interpreter();
        let plan = interpreter.plan(&[output]);
        let points = reference.iter().zip(displacement_gradient);
        for (energy, (point, gradient)) in energy.iter_mut().zip(points) {
            let rows = gradient.transpose();
            let coordinates = point.as_slice();
            interpreter
                .set_point(&plan, Point { coordinates, normal: &[], gradient: rows.as_slice() });
            *energy = interpreter.output(output)[0];
        }
        true
    }
}

impl<T: Real + Number, const D: usize> ManufacturedField<T, D> for Interpreted<T> {
    fn domain(&self) -> Domain<T, D> {
        let body = match self.compiled.field.domain.body {
            spec::Body::Box { .. } => Body::Box {
                lower: Vector::from_column_slice(&self.bound(Bound::Lower)),
                upper: Vector::from_column_slice(&self.bound(Bound::Upper)),
            },
            spec::Body::Annulus { .. } => {
                let theta = self.bound(Bound::Theta);
                Body::Annulus {
                    inner: self.bound(Bound::Inner)[0],
                    outer: self.bound(Bound::Outer)[0],
                    theta: [theta[0], theta[1]],
                }
            }
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
        self.at_points(time, output, reference, |index, components| {
            out[index] = Matrix::from_row_slice(components);
        });
    }
}

fn face(face: spec::Face) -> Face {
    match face {
        spec::Face::Min(axis) => Face::Min(axis),
        spec::Face::Max(axis) => Face::Max(axis),
        spec::Face::Inner => Face::Inner,
        spec::Face::Outer => Face::Outer,
        spec::Face::ThetaMin => Face::ThetaMin,
        spec::Face::ThetaMax => Face::ThetaMax,
    }
}

fn condition(claim: Claim) -> Condition {
    match claim {
        Claim::Fixed => Condition::Fixed,
        Claim::Roller => Condition::Roller,
        Claim::Free => Condition::Free,
        Claim::Prescribed => Condition::Prescribed,
        Claim::Traction => Condition::Traction,
    }
}
