//! A wave with its forcing, on any body, in one to three dimensions.

use mms_runtime::tensor::{inverse_deformation_gradient, jacobian};
use mms_runtime::{Body, Condition, Domain, Face, ManufacturedField, Material, Matrix, Vector};

/// u_k = a_k sin(q_k.X - w t + p_k) + s_k t, with P = mu (F - F^-T) and rho0 = 1.
///
/// Div P = mu (u_k,JJ + (F^-1)_Jm u_m,LJ (F^-1)_Lk), because d F^-1 = - F^-1 dF F^-1. In one dimension it is
/// (E/2) (1 + F^-2) u'', E = 2 mu.
#[derive(Clone, Debug)]
pub struct Wave<const D: usize> {
    pub body: Body<f64, D>,
    pub faces: Vec<(Face, Condition)>,
    /// a.
    pub amplitude: Vector<f64, D>,
    /// The wave vectors q_k, one per row.
    pub vectors: Matrix<f64, D>,
    /// p.
    pub phase: Vector<f64, D>,
    /// w.
    pub frequency: f64,
    /// s.
    pub slide: Vector<f64, D>,
    pub mu: f64,
    pub end: f64,
    /// Whether the body force maintains the wave; if not, it is zero, and only the start is exact.
    pub forced: bool,
}

impl Wave<1> {
    /// One wavelength on a bar from 0 to 1, at the speed of sound of small strains.
    pub fn bar() -> Self {
        let turn = std::f64::consts::TAU;
        Self {
            body: Body::Box { lower: Vector::zeros(), upper: Vector::repeat(1.0) },
            faces: Vec::new(),
            amplitude: Vector::repeat(0.03),
            vectors: Matrix::repeat(turn),
            phase: Vector::repeat(0.4),
            frequency: turn,
            slide: Vector::zeros(),
            mu: 0.5,
            end: 1.0,
            forced: true,
        }
    }

    /// Less than a wavelength on the bar, so that its ends have stresses, and different ones.
    pub fn stretched_bar() -> Self {
        Self { vectors: Matrix::repeat(4.0), frequency: 4.0, ..Self::bar() }
    }
}

impl Wave<2> {
    /// A wave in each component, neither along an axis, on any body.
    pub fn on(body: Body<f64, 2>) -> Self {
        Self {
            body,
            faces: Vec::new(),
            amplitude: Vector::<f64, 2>::new(0.04, -0.03),
            vectors: Matrix::<f64, 2>::new(2.0, 1.5, -1.0, 2.5),
            phase: Vector::<f64, 2>::new(0.3, 1.1),
            frequency: 3.0,
            slide: Vector::zeros(),
            mu: 0.5,
            end: 0.6,
            forced: true,
        }
    }

    /// A wave in each component, neither along an axis, on a box from the origin.
    pub fn on_box(upper: [f64; 2]) -> Self {
        Self::on(Body::Box { lower: Vector::zeros(), upper: Vector::from(upper) })
    }

    /// A wave in a box that slides by some cells: 40 cells have enough particles for several slabs, and the particles change
    /// places.
    pub fn sliding(faces: Condition) -> Self {
        let slide = Vector::repeat(1.0);
        Self { slide, ..Self::on_box([1.0, 0.75]).with_all_faces(faces) }
    }
}

impl Wave<3> {
    /// A wave in each component, none along an axis, on any body.
    pub fn in_space(body: Body<f64, 3>) -> Self {
        Self {
            body,
            faces: Vec::new(),
            amplitude: Vector::<f64, 3>::new(0.04, -0.03, 0.02),
            vectors: Matrix::<f64, 3>::new(2.0, 1.5, 0.5, -1.0, 2.5, 1.0, 0.5, -1.0, 2.0),
            phase: Vector::<f64, 3>::new(0.3, 1.1, 2.0),
            frequency: 3.0,
            slide: Vector::zeros(),
            mu: 0.5,
            end: 0.6,
            forced: true,
        }
    }
}

impl<const D: usize> Wave<D> {
    /// The wave with these claims about its faces.
    pub fn with_faces(self, faces: &[(Face, Condition)]) -> Self {
        Self { faces: faces.to_vec(), ..self }
    }

    /// The wave with one claim about every face of a box.
    pub fn with_all_faces(self, condition: Condition) -> Self {
        let both = |a| [(Face::Min(a), condition), (Face::Max(a), condition)];
        Self { faces: (0..D).flat_map(both).collect(), ..self }
    }

    /// The point reflection u'(X) = -u(-X).
    pub fn reflected(&self) -> Self {
        let body = match &self.body {
            Body::Box { lower, upper } => Body::Box { lower: -upper, upper: -lower },
            other => other.clone(),
        };
        Self {
            body,
            amplitude: -self.amplitude,
            vectors: -self.vectors,
            slide: -self.slide,
            ..self.clone()
        }
    }

    /// The derivative of the sine of this order, by its argument, times the amplitude.
    fn sine(&self, k: usize, time: f64, x: &Vector<f64, D>, derivative: u8) -> f64 {
        let argument = (self.vectors.row(k) * x)[0] - self.frequency * time + self.phase[k];
        self.amplitude[k] * (argument + f64::from(derivative) * std::f64::consts::FRAC_PI_2).sin()
    }

    /// H at a point.
    pub fn gradient(&self, time: f64, x: &Vector<f64, D>) -> Matrix<f64, D> {
        Matrix::from_fn(|k, j| self.vectors[(k, j)] * self.sine(k, time, x, 1))
    }

    /// Div P at a point.
    fn divergence(&self, time: f64, x: &Vector<f64, D>) -> Vector<f64, D> {
        let inverse = inverse_deformation_gradient(&self.gradient(time, x)).unwrap();
        let q = |k: usize| self.vectors.row(k).transpose();
        let mut divergence = Vector::zeros();
        for m in 0..D {
            let curvature = self.sine(m, time, x, 2); // u_m,LJ = curvature q_L q_J
            divergence[m] += curvature * q(m).norm_squared();
            let across = (inverse.column(m).transpose() * q(m))[0] * curvature;
            divergence += inverse.tr_mul(&q(m)) * across;
        }
        divergence * self.mu
    }

    /// P = mu (F - F^-T) at H.
    pub fn first_piola_kirchhoff(&self, h: &Matrix<f64, D>) -> Matrix<f64, D> {
        let inverse = inverse_deformation_gradient(h).unwrap();
        (Matrix::identity() + h - inverse.transpose()) * self.mu
    }

    /// The strain energy per reference volume at H, mu/2 (tr F^T F - D) - mu ln J.
    pub fn strain_energy(&self, h: &Matrix<f64, D>) -> f64 {
        self.mu * (h.trace() + h.norm_squared() / 2.0 - jacobian(h).ln())
    }
}

impl<const D: usize> Material<f64, D> for Wave<D> {
    fn density(&self, _: &[Vector<f64, D>], density: &mut [f64]) {
        density.fill(1.0);
    }

    fn wave_speed(&self, _: &[Vector<f64, D>], speed: &mut [f64]) {
        speed.fill((2.0 * self.mu).sqrt());
    }

    fn kirchhoff_stress(
        &self,
        _: f64,
        _: &[Vector<f64, D>],
        h: &[Matrix<f64, D>],
        stress: &mut [Matrix<f64, D>],
    ) {
        for (stress, h) in stress.iter_mut().zip(h) {
            *stress = (h + h.transpose() + h * h.transpose()) * self.mu;
        }
    }
}

impl<const D: usize> ManufacturedField<f64, D> for Wave<D> {
    fn domain(&self) -> Domain<f64, D> {
        Domain { body: self.body.clone(), time: [0.0, self.end], faces: self.faces.clone() }
    }

    fn displacement(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        for (out, x) in out.iter_mut().zip(x) {
            *out = Vector::from_fn(|k, _| self.sine(k, time, x, 0)) + self.slide * time;
        }
    }

    fn velocity(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        for (out, x) in out.iter_mut().zip(x) {
            let rate = Vector::from_fn(|k, _| self.sine(k, time, x, 1));
            *out = self.slide - rate * self.frequency;
        }
    }

    fn acceleration(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        for (out, x) in out.iter_mut().zip(x) {
            *out = Vector::from_fn(|k, _| self.sine(k, time, x, 2)) * self.frequency.powi(2);
        }
    }

    fn body_force(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        if !self.forced {
            return out.fill(Vector::zeros());
        }
        self.acceleration(time, x, out);
        for (out, x) in out.iter_mut().zip(x) {
            *out -= self.divergence(time, x);
        }
    }

    fn displacement_gradient(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Matrix<f64, D>]) {
        out.iter_mut().zip(x).for_each(|(out, x)| *out = self.gradient(time, x));
    }
}
