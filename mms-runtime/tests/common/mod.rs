//! Hand-written fields for the runtime's tests.
#![allow(dead_code)]

pub mod spin;
pub mod wave;
pub mod weights;

use mms_runtime::study::{Frame, Observer, Solve, StudyLevel, run_level};
use mms_runtime::{
    Body, Condition, Domain, Face, FormulationName, IntegratorName, ManufacturedField, Material,
    Matrix, Method, Real, ShapeName, Vector,
};

/// The 1D bar of Wallstedt & Guilkey: u = X (2L - X)/L^2 A(t), F = 1 + 2 (L - X) A/L^2,
/// W with lambda = 0, mu = E/2, A = a cos(c pi t/L), c = sqrt(E/rho0).
///
/// Div P = -(E A/L^2)(1 + F^-2), so b = a - Div P/rho0 = [X (2L - X) A'' + (E/rho0)(1 + F^-2) A]/L^2;
/// the slides print a minus before E/rho0. `slide` adds a rigid motion s(t) = slide sin(c pi t/L + 1) to u,
/// which starts with velocity and acceleration.
#[derive(Clone)]
pub struct Bar {
    pub length: f64,
    pub young: f64,
    pub rho0: f64,
    pub amplitude: f64,
    /// Sign of the term E/rho0 in b: +1, or -1 as printed.
    pub sign: f64,
    pub slide: f64,
    /// The delay of the time at which b is evaluated.
    pub delay: f64,
    pub faces: Vec<(Face, Condition)>,
}

impl Default for Bar {
    fn default() -> Self {
        Self {
            length: 1.0,
            young: 1e6,
            rho0: 1e3,
            amplitude: 0.2,
            sign: 1.0,
            slide: 0.0,
            delay: 0.0,
            faces: vec![(Face::Min(0), Condition::Fixed), (Face::Max(0), Condition::Free)],
        }
    }
}

impl Bar {
    fn speed(&self) -> f64 {
        (self.young / self.rho0).sqrt()
    }

    fn frequency(&self) -> f64 {
        self.speed() * std::f64::consts::PI / self.length
    }

    /// The derivatives of A and s of this order.
    fn amplitudes<T: Real>(&self, time: T, derivative: i32) -> (T, T) {
        let w = self.frequency();
        let quarter = std::f64::consts::FRAC_PI_2 * f64::from(derivative);
        let phase = w * time.to_f64() + quarter;
        let scale = w.powi(derivative);
        let slide = self.slide * scale * (phase + 1.0).sin();
        (T::of(self.amplitude * scale * phase.cos()), T::of(slide))
    }

    fn motion<T: Real>(
        &self,
        derivative: i32,
        time: T,
        x: &[Vector<T, 1>],
        out: &mut [Vector<T, 1>],
    ) {
        let (amplitude, slide) = self.amplitudes(time, derivative);
        let l = T::of(self.length);
        for (out, x) in out.iter_mut().zip(x) {
            out[0] = x[0] * (l + l - x[0]) / (l * l) * amplitude + slide;
        }
    }
}

impl<T: Real> Material<T, 1> for Bar {
    fn density(&self, _: &[Vector<T, 1>], density: &mut [T]) {
        density.fill(T::of(self.rho0));
    }

    fn wave_speed(&self, _: &[Vector<T, 1>], speed: &mut [T]) {
        speed.fill(T::of(self.speed()));
    }

    fn kirchhoff_stress(
        &self,
        _: T,
        _: &[Vector<T, 1>],
        h: &[Matrix<T, 1>],
        stress: &mut [Matrix<T, 1>],
    ) {
        // tau = E/2 (F^2 - 1) = E/2 H (2 + H)
        for (stress, h) in stress.iter_mut().zip(h) {
            stress[0] = T::of(self.young / 2.0) * h[0] * (T::of(2.0) + h[0]);
        }
    }

    fn strain_energy(
        &self,
        _: T,
        _: &[Vector<T, 1>],
        h: &[Matrix<T, 1>],
        energy: &mut [T],
    ) -> bool {
        // W = E/4 (F^2 - 1) - E/2 ln F
        for (energy, h) in energy.iter_mut().zip(h) {
            let h = h[0].to_f64();
            *energy = T::of(self.young / 2.0 * (h + h * h / 2.0 - h.ln_1p()));
        }
        true
    }
}

impl<T: Real> ManufacturedField<T, 1> for Bar {
    fn domain(&self) -> Domain<T, 1> {
        let end = T::of(2.0) * T::of(self.length) / T::of(self.speed());
        Domain {
            body: Body::Box { lower: Vector::zeros(), upper: Vector::repeat(T::of(self.length)) },
            time: [T::zero(), end],
            faces: self.faces.clone(),
        }
    }

    fn displacement(&self, time: T, x: &[Vector<T, 1>], out: &mut [Vector<T, 1>]) {
        self.motion(0, time, x, out);
    }

    fn velocity(&self, time: T, x: &[Vector<T, 1>], out: &mut [Vector<T, 1>]) {
        self.motion(1, time, x, out);
    }

    fn acceleration(&self, time: T, x: &[Vector<T, 1>], out: &mut [Vector<T, 1>]) {
        self.motion(2, time, x, out);
    }

    fn body_force(&self, time: T, x: &[Vector<T, 1>], out: &mut [Vector<T, 1>]) {
        let time = time - T::of(self.delay);
        self.motion(2, time, x, out);
        let (amplitude, _) = self.amplitudes(time, 0);
        let l = T::of(self.length);
        let stiffness = T::of(self.sign * self.young / self.rho0);
        for (out, x) in out.iter_mut().zip(x) {
            let f = T::one() + T::of(2.0) * (l - x[0]) * amplitude / (l * l);
            out[0] += stiffness * (T::one() + T::one() / (f * f)) * amplitude / (l * l);
        }
    }

    fn displacement_gradient(&self, time: T, x: &[Vector<T, 1>], out: &mut [Matrix<T, 1>]) {
        let (amplitude, _) = self.amplitudes(time, 0);
        let l = T::of(self.length);
        for (out, x) in out.iter_mut().zip(x) {
            out[0] = T::of(2.0) * (l - x[0]) * amplitude / (l * l);
        }
    }
}

/// u = (H0 + H1 t) X + V t with tau = mu (F F^T - I): uniform F and stress, and b = 0.
#[derive(Clone)]
pub struct Affine {
    /// The upper corner; the lower corner of the box is 0.
    pub upper: [f64; 3],
    pub h0: [[f64; 3]; 3],
    pub h1: [[f64; 3]; 3],
    pub velocity: [f64; 3],
    pub mu: f64,
    pub faces: Vec<(Face, Condition)>,
}

impl Affine {
    /// A uniformly stretched body at rest, prescribed on all faces.
    pub fn patch(stretch: f64) -> Self {
        let h0 =
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { stretch } else { 0.0 }));
        let (upper, velocity) = ([1.0; 3], [0.0; 3]);
        Self { upper, h0, h1: [[0.0; 3]; 3], velocity, mu: 1.0, faces: Vec::new() }
    }

    /// An undeformed body with free faces.
    pub fn flight(velocity: [f64; 3]) -> Self {
        let free = |a| [(Face::Min(a), Condition::Free), (Face::Max(a), Condition::Free)];
        Self { velocity, faces: (0..3).flat_map(free).collect(), ..Self::patch(0.0) }
    }

    /// H at this time.
    pub fn gradient<T: Real, const D: usize>(&self, time: T) -> Matrix<T, D> {
        Matrix::from_fn(|i, j| T::of(self.h0[i][j]) + T::of(self.h1[i][j]) * time)
    }
}

impl<T: Real, const D: usize> Material<T, D> for Affine {
    fn density(&self, _: &[Vector<T, D>], density: &mut [T]) {
        density.fill(T::one());
    }

    fn wave_speed(&self, _: &[Vector<T, D>], speed: &mut [T]) {
        speed.fill(T::of(2f64.sqrt()));
    }

    fn kirchhoff_stress(
        &self,
        _: T,
        _: &[Vector<T, D>],
        h: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) {
        for (stress, h) in stress.iter_mut().zip(h) {
            *stress = (h + h.transpose() + h * h.transpose()) * T::of(self.mu);
        }
    }
}

impl<T: Real, const D: usize> ManufacturedField<T, D> for Affine {
    fn domain(&self) -> Domain<T, D> {
        let exists = |face: &Face| matches!(*face, Face::Min(a) | Face::Max(a) if a < D);
        Domain {
            body: Body::Box {
                lower: Vector::zeros(),
                upper: Vector::from_fn(|a, _| T::of(self.upper[a])),
            },
            time: [T::of(0.5), T::of(1.5)],
            faces: self.faces.iter().copied().filter(|(face, _)| exists(face)).collect(),
        }
    }

    fn displacement(&self, time: T, x: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        let (h, v) = (self.gradient(time), Vector::from_fn(|a, _| T::of(self.velocity[a])));
        out.iter_mut().zip(x).for_each(|(out, x)| *out = h * x + v * time);
    }

    fn velocity(&self, _: T, x: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        let v = Vector::from_fn(|a, _| T::of(self.velocity[a]));
        let h1 = Matrix::from_fn(|i, j| T::of(self.h1[i][j]));
        out.iter_mut().zip(x).for_each(|(out, x)| *out = h1 * x + v);
    }

    fn acceleration(&self, _: T, _: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        out.fill(Vector::zeros());
    }

    fn body_force(&self, _: T, _: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        out.fill(Vector::zeros());
    }

    fn displacement_gradient(&self, time: T, _: &[Vector<T, D>], out: &mut [Matrix<T, D>]) {
        out.fill(self.gradient(time));
    }
}

/// u_i = a sin(pi X_i) sin(c pi t + phi_i), phi = 0, 2 pi/3, 4 pi/3, with rollers on all faces of the cube
/// from `lower` (0 or -1, where u_i = 0) to 1.
///
/// F is diagonal, F_i = 1 + a pi cos(pi X_i) sin(..), and with c = sqrt(E/rho0)
/// b_i = pi^2 u_i/rho0 [lambda (1 - ln J)/F_i^2 + mu (1 + F_i^-2) - E]. Here E = 1, rho0 = 1, nu = 0.3.
#[derive(Clone)]
pub struct AxisAligned {
    pub amplitude: f64,
    pub lower: f64,
}

impl AxisAligned {
    const LAMBDA: f64 = 0.3 / (1.3 * 0.4);
    const MU: f64 = 0.5 / 1.3;

    /// a sin(.. + derivative pi/2) pi^derivative along one axis.
    fn factor<T: Real>(&self, time: T, axis: usize, derivative: i32) -> T {
        use std::f64::consts::PI;
        let phase = axis as f64 * 2.0 * PI / 3.0 + f64::from(derivative) * PI / 2.0;
        T::of(self.amplitude * PI.powi(derivative) * (PI * time.to_f64() + phase).sin())
    }

    fn motion<T: Real, const D: usize>(
        &self,
        derivative: i32,
        time: T,
        x: &[Vector<T, D>],
        out: &mut [Vector<T, D>],
    ) {
        let factor = Vector::<T, D>::from_fn(|a, _| self.factor(time, a, derivative));
        for (out, x) in out.iter_mut().zip(x) {
            *out =
                x.map(|x| T::of((std::f64::consts::PI * x.to_f64()).sin())).component_mul(&factor);
        }
    }
}

impl<T: Real, const D: usize> Material<T, D> for AxisAligned {
    fn density(&self, _: &[Vector<T, D>], density: &mut [T]) {
        density.fill(T::one());
    }

    fn wave_speed(&self, _: &[Vector<T, D>], speed: &mut [T]) {
        speed.fill(T::of((Self::LAMBDA + 2.0 * Self::MU).sqrt()));
    }

    fn kirchhoff_stress(
        &self,
        _: T,
        _: &[Vector<T, D>],
        h: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) {
        for (stress, h) in stress.iter_mut().zip(h) {
            let log_j = T::of(mms_runtime::tensor::jacobian(h).to_f64().ln());
            *stress = (h + h.transpose() + h * h.transpose()) * T::of(Self::MU);
            *stress += Matrix::identity() * (T::of(Self::LAMBDA) * log_j);
        }
    }
}

impl<T: Real, const D: usize> ManufacturedField<T, D> for AxisAligned {
    fn domain(&self) -> Domain<T, D> {
        let rollers = |a| [(Face::Min(a), Condition::Roller), (Face::Max(a), Condition::Roller)];
        Domain {
            body: Body::Box {
                lower: Vector::repeat(T::of(self.lower)),
                upper: Vector::repeat(T::one()),
            },
            time: [T::zero(), T::one()],
            faces: (0..D).flat_map(rollers).collect(),
        }
    }

    fn displacement(&self, time: T, x: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.motion(0, time, x, out);
    }

    fn velocity(&self, time: T, x: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.motion(1, time, x, out);
    }

    fn acceleration(&self, time: T, x: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.motion(2, time, x, out);
    }

    fn body_force(&self, time: T, x: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.motion(0, time, x, out);
        for (out, x) in out.iter_mut().zip(x) {
            let stretch = |a: usize| {
                let cosine = (std::f64::consts::PI * x[a].to_f64()).cos();
                1.0 + self.factor::<f64>(time.to_f64(), a, 0) * std::f64::consts::PI * cosine
            };
            let log_j: f64 = (0..D).map(|a| stretch(a).ln()).sum();
            for a in 0..D {
                let soft = stretch(a).powi(-2);
                let stiffness = Self::LAMBDA * (1.0 - log_j) * soft + Self::MU * (1.0 + soft) - 1.0;
                out[a] *= T::of(std::f64::consts::PI.powi(2) * stiffness);
            }
        }
    }

    fn displacement_gradient(&self, time: T, x: &[Vector<T, D>], out: &mut [Matrix<T, D>]) {
        use std::f64::consts::PI;
        for (out, x) in out.iter_mut().zip(x) {
            *out = Matrix::from_diagonal(&Vector::from_fn(|a, _| {
                self.factor::<T>(time, a, 0) * T::of(PI * (PI * x[a].to_f64()).cos())
            }));
        }
    }
}

/// Keeps the last state of a run.
#[derive(Default)]
pub struct Last(pub Option<Frame>);

impl Observer for Last {
    fn step(&mut self, _: usize, _: usize) {}

    fn wants(&self, step: usize, steps: usize) -> bool {
        step == steps
    }

    fn see(&mut self, frame: &Frame) -> Result<(), String> {
        self.0 = Some(frame.clone());
        Ok(())
    }
}

/// A method with the command's defaults for all other settings.
pub fn method(shape: ShapeName, integrator: IntegratorName) -> Method {
    Method { shape, integrator, ..Method::default() }
}

/// Every valid combination of formulation, shape function and integrator.
pub fn methods() -> Vec<Method> {
    let mut methods = Vec::new();
    for &formulation in FormulationName::ALL {
        for &shape in ShapeName::ALL {
            for &integrator in IntegratorName::ALL {
                methods.push(Method { formulation, ..method(shape, integrator) });
            }
        }
    }
    methods.retain(|method| method.validate().is_ok());
    methods
}

/// The levels of a study.
pub fn levels<T: Solve<D>, const D: usize>(
    field: &dyn ManufacturedField<T, D>,
    method: &Method,
    cells: &[usize],
) -> Vec<StudyLevel> {
    let level = |&cells: &usize| run_level(field, method, &cells.into(), &mut ()).unwrap();
    cells.iter().map(level).collect()
}
