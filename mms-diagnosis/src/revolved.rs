//! An axisymmetric field in space: points and vectors have the components R, Z and theta, tensors three rows in that order.
//! Mistakes in stresses and forces at a point are the same here as in Cartesian coordinates.

use mms_runtime::axisymmetric;
use mms_runtime::{Body, Domain, ManufacturedField, Material, Matrix, Vector};

/// The field of a meridian, in space.
pub struct Revolved<'a, const D: usize>(pub &'a dyn ManufacturedField<f64, D>);

/// X in the meridian.
pub fn meridian<const D: usize>(reference: &[Vector<f64, 3>]) -> Vec<Vector<f64, D>> {
    reference.iter().map(|x| Vector::from_fn(|axis, _| x[axis])).collect()
}

/// A vector or a place of the meridian, in space.
pub fn lifted<const D: usize>(vector: &Vector<f64, D>) -> Vector<f64, 3> {
    Vector::from_fn(|axis, _| if axis < D { vector[axis] } else { 0.0 })
}

/// A tensor of the meridian and its entry around the axis, in space.
pub fn whole<const D: usize>(tensor: &Matrix<f64, D>, hoop: f64) -> Matrix<f64, 3> {
    Matrix::from_fn(|i, j| match (i < D && j < D, i == j) {
        (true, _) => tensor[(i, j)],
        (false, true) => hoop,
        (false, false) => 0.0,
    })
}

/// The part of a tensor in the meridian.
pub fn part<const D: usize>(tensor: &Matrix<f64, 3>) -> Matrix<f64, D> {
    Matrix::from_fn(|i, j| tensor[(i, j)])
}

/// A quantity of a field that is a vector, at a time and points of the meridian.
type VectorOf<const D: usize> =
    fn(&dyn ManufacturedField<f64, D>, f64, &[Vector<f64, D>], &mut [Vector<f64, D>]);

impl<const D: usize> Revolved<'_, D> {
    /// Computes a vector in the meridian, and lifts it into space.
    fn vectors(
        &self,
        of: VectorOf<D>,
        time: f64,
        reference: &[Vector<f64, 3>],
        out: &mut [Vector<f64, 3>],
    ) {
        let mut own = vec![Vector::zeros(); out.len()];
        of(self.0, time, &meridian(reference), &mut own);
        out.iter_mut().zip(own).for_each(|(to, own)| *to = lifted(&own));
    }
}

impl<const D: usize> Material<f64, 3> for Revolved<'_, D> {
    fn density(&self, reference: &[Vector<f64, 3>], density: &mut [f64]) {
        self.0.density(&meridian(reference), density);
    }

    fn wave_speed(&self, reference: &[Vector<f64, 3>], speed: &mut [f64]) {
        self.0.wave_speed(&meridian(reference), speed);
    }

    fn is_small_strain(&self) -> bool {
        self.0.is_small_strain()
    }

    fn changes_with_time(&self) -> bool {
        self.0.changes_with_time()
    }

    fn kirchhoff_stress(
        &self,
        time: f64,
        reference: &[Vector<f64, 3>],
        displacement_gradient: &[Matrix<f64, 3>],
        stress: &mut [Matrix<f64, 3>],
    ) {
        let flat: Vec<Matrix<f64, D>> = displacement_gradient.iter().map(part).collect();
        let strain: Vec<f64> = displacement_gradient.iter().map(|h| h[(2, 2)]).collect();
        let (mut own, mut hoop) = (vec![Matrix::zeros(); flat.len()], strain.clone());
        let strains = (&flat[..], &strain[..]);
        let stresses = (&mut own[..], &mut hoop[..]);
        axisymmetric::kirchhoff_stress(self.0, time, &meridian(reference), strains, stresses);
        let all = stress.iter_mut().zip(own).zip(hoop);
        all.for_each(|((to, own), hoop)| *to = whole(&own, hoop));
    }
}

impl<const D: usize> ManufacturedField<f64, 3> for Revolved<'_, D> {
    fn domain(&self) -> Domain<f64, 3> {
        let Domain { body, time, faces } = self.0.domain();
        let body = match body {
            Body::Box { lower, upper } => {
                let mut upper = lifted(&upper);
                upper[2] = 1.0;
                Body::Box { lower: lifted(&lower), upper }
            }
            _ => Body::Nothing,
        };
        Domain { body, time, faces }
    }

    fn displacement(&self, time: f64, x: &[Vector<f64, 3>], out: &mut [Vector<f64, 3>]) {
        self.vectors(|field, time, x, out| field.displacement(time, x, out), time, x, out);
    }

    fn velocity(&self, time: f64, x: &[Vector<f64, 3>], out: &mut [Vector<f64, 3>]) {
        self.vectors(|field, time, x, out| field.velocity(time, x, out), time, x, out);
    }

    fn acceleration(&self, time: f64, x: &[Vector<f64, 3>], out: &mut [Vector<f64, 3>]) {
        self.vectors(|field, time, x, out| field.acceleration(time, x, out), time, x, out);
    }

    fn body_force(&self, time: f64, x: &[Vector<f64, 3>], out: &mut [Vector<f64, 3>]) {
        self.vectors(|field, time, x, out| field.body_force(time, x, out), time, x, out);
    }

    fn displacement_gradient(&self, time: f64, x: &[Vector<f64, 3>], out: &mut [Matrix<f64, 3>]) {
        let x = meridian(x);
        let mut own = vec![Matrix::zeros(); x.len()];
        self.0.displacement_gradient(time, &x, &mut own);
        let hoop = axisymmetric::hoop_strain(self.0, time, &x);
        let all = out.iter_mut().zip(own).zip(hoop);
        all.for_each(|((to, own), hoop)| *to = whole(&own, hoop));
    }
}
