//! A rotating body.

use mms_runtime::{Body, Condition, Domain, Face, ManufacturedField, Material, Matrix, Vector};

/// x = Q(t) X about the origin, with the angle w t, on a free square from -1 to 1: no strain, no stress, and
/// b = a = - w^2 x. The material is tau = mu (F F^T - I), and rho0 = 1.
pub struct Spin {
    pub frequency: f64,
    pub mu: f64,
    pub end: f64,
}

impl Spin {
    /// Q.
    pub fn rotation(&self, time: f64) -> Matrix<f64, 2> {
        let (sine, cosine) = (self.frequency * time).sin_cos();
        Matrix::<f64, 2>::new(cosine, -sine, sine, cosine)
    }
}

impl Material<f64, 2> for Spin {
    fn density(&self, _: &[Vector<f64, 2>], density: &mut [f64]) {
        density.fill(1.0);
    }

    fn wave_speed(&self, _: &[Vector<f64, 2>], speed: &mut [f64]) {
        speed.fill((2.0 * self.mu).sqrt());
    }

    fn kirchhoff_stress(
        &self,
        _: f64,
        _: &[Vector<f64, 2>],
        h: &[Matrix<f64, 2>],
        stress: &mut [Matrix<f64, 2>],
    ) {
        for (stress, h) in stress.iter_mut().zip(h) {
            *stress = (h + h.transpose() + h * h.transpose()) * self.mu;
        }
    }
}

impl ManufacturedField<f64, 2> for Spin {
    fn domain(&self) -> Domain<f64, 2> {
        Domain {
            body: Body::Box { lower: Vector::repeat(-1.0), upper: Vector::repeat(1.0) },
            time: [0.0, self.end],
            faces: [Face::Min(0), Face::Max(0), Face::Min(1), Face::Max(1)]
                .map(|face| (face, Condition::Free))
                .to_vec(),
        }
    }

    fn displacement(&self, time: f64, x: &[Vector<f64, 2>], out: &mut [Vector<f64, 2>]) {
        let gradient = self.rotation(time) - Matrix::identity();
        out.iter_mut().zip(x).for_each(|(out, x)| *out = gradient * x);
    }

    fn velocity(&self, time: f64, x: &[Vector<f64, 2>], out: &mut [Vector<f64, 2>]) {
        let quarter = Matrix::<f64, 2>::new(0.0, -1.0, 1.0, 0.0);
        let rate = quarter * self.rotation(time) * self.frequency;
        out.iter_mut().zip(x).for_each(|(out, x)| *out = rate * x);
    }

    fn acceleration(&self, time: f64, x: &[Vector<f64, 2>], out: &mut [Vector<f64, 2>]) {
        let rate = -self.rotation(time) * self.frequency.powi(2);
        out.iter_mut().zip(x).for_each(|(out, x)| *out = rate * x);
    }

    fn body_force(&self, time: f64, x: &[Vector<f64, 2>], out: &mut [Vector<f64, 2>]) {
        self.acceleration(time, x, out);
    }

    fn displacement_gradient(&self, time: f64, _: &[Vector<f64, 2>], out: &mut [Matrix<f64, 2>]) {
        out.fill(self.rotation(time) - Matrix::identity());
    }
}
