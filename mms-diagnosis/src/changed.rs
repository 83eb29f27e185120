//! A field with a mistake, as a solver is given it.

use mms_runtime::{Domain, ManufacturedField, Material, Matrix, Vector};

use crate::body::{faces, is_on};
use crate::exact::Exact;
use crate::hypothesis::{Change, Given, Hypothesis, MotionPart};

/// Terms that are left out on purpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Without {
    /// b is 0.
    pub body_force: bool,
    /// P is 0 in the body.
    pub stress: bool,
    /// Tractions are 0.
    pub traction: bool,
}

/// A field with a mistake of some size, or without one.
pub struct Changed<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    mistake: Option<(&'a Hypothesis<D>, &'a [f64])>,
    without: Without,
}

impl<'a, const D: usize> Changed<'a, D> {
    /// The field as it is, but for terms that are left out.
    pub fn right(exact: &'a Exact<'a, D>, without: Without) -> Self {
        Changed { exact, mistake: None, without }
    }

    /// The same with a mistake.
    pub fn with(
        exact: &'a Exact<'a, D>,
        without: Without,
        hypothesis: &'a Hypothesis<D>,
        size: &'a [f64],
    ) -> Self {
        Changed { mistake: Some((hypothesis, size)), ..Self::right(exact, without) }
    }

    fn given<'b>(
        &'b self,
        size: &'b [f64],
        time: f64,
        reference: &'b [Vector<f64, D>],
        gradient: &'b [Matrix<f64, D>],
    ) -> Given<'b, D> {
        Given { exact: self.exact, size, time, reference, gradient }
    }

    /// Changes a quantity of the motion, as it is at the start or on walls.
    fn moved(&self, time: f64, reference: &[Vector<f64, D>], motion: MotionPart<'_, D>) {
        let Some((hypothesis, size)) = self.mistake else { return };
        let is_start = time == self.exact.domain.time[0];
        match hypothesis.change {
            Change::Start(change) if is_start => {
                change(&self.given(size, time, reference, &[]), motion);
            }
            Change::Wall(change) => change(&self.given(size, time, reference, &[]), motion),
            _ => {}
        }
    }
}

impl<const D: usize> Material<f64, D> for Changed<'_, D> {
    fn density(&self, reference: &[Vector<f64, D>], density: &mut [f64]) {
        self.exact.field.density(reference, density);
        if let Some((Hypothesis { change: Change::Density | Change::Mass, .. }, [factor, ..])) =
            self.mistake
        {
            density.iter_mut().for_each(|density| *density *= factor);
        }
    }

    fn wave_speed(&self, reference: &[Vector<f64, D>], speed: &mut [f64]) {
        self.exact.field.wave_speed(reference, speed);
    }

    fn is_small_strain(&self) -> bool {
        self.exact.field.is_small_strain()
    }

    fn changes_with_time(&self) -> bool {
        self.exact.field.changes_with_time()
    }

    fn kirchhoff_stress(
        &self,
        time: f64,
        reference: &[Vector<f64, D>],
        displacement_gradient: &[Matrix<f64, D>],
        stress: &mut [Matrix<f64, D>],
    ) {
        if self.without.stress {
            return stress.fill(Matrix::zeros());
        }
        self.exact.field.kirchhoff_stress(time, reference, displacement_gradient, stress);
        if let Some((Hypothesis { change: Change::Stress(_, change), .. }, size)) = self.mistake {
            change(&self.given(size, time, reference, displacement_gradient), stress);
        }
    }
}

impl<const D: usize> ManufacturedField<f64, D> for Changed<'_, D> {
    fn domain(&self) -> Domain<f64, D> {
        let mut domain = self.exact.domain.clone();
        if let Some((hypothesis, _)) = self.mistake
            && let (Change::Condition(condition), Some(face)) =
                (&hypothesis.change, hypothesis.face)
        {
            domain.faces.retain(|(claimed, _)| *claimed != face);
            domain.faces.push((face, *condition));
        }
        domain
    }

    fn displacement(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        self.exact.field.displacement(time, x, out);
        self.moved(time, x, MotionPart::Displacement(out));
    }

    fn velocity(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        self.exact.field.velocity(time, x, out);
        self.moved(time, x, MotionPart::Velocity(out));
    }

    fn acceleration(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        self.exact.field.acceleration(time, x, out);
        self.moved(time, x, MotionPart::Acceleration(out));
    }

    fn body_force(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Vector<f64, D>]) {
        if self.without.body_force {
            return out.fill(Vector::zeros());
        }
        self.exact.field.body_force(time, x, out);
        match self.mistake {
            Some((
                Hypothesis { change: Change::Force(change) | Change::Loads(change, _), .. },
                size,
            )) => {
                change(&self.given(size, time, x, &[]), out);
            }
            // b is per mass.
            Some((Hypothesis { change: Change::Mass, .. }, [factor, ..])) => {
                out.iter_mut().for_each(|b| *b /= *factor);
            }
            _ => {}
        }
    }

    fn displacement_gradient(&self, time: f64, x: &[Vector<f64, D>], out: &mut [Matrix<f64, D>]) {
        self.exact.field.displacement_gradient(time, x, out);
        self.moved(time, x, MotionPart::Gradient(out));
    }

    fn surface_stress(
        &self,
        time: f64,
        x: &[Vector<f64, D>],
        h: &[Matrix<f64, D>],
        stress: &mut [Matrix<f64, D>],
    ) {
        if self.without.traction {
            return stress.fill(Matrix::zeros());
        }
        self.exact.field.surface_stress(time, x, h, stress);
        let Some((hypothesis, size)) = self.mistake else { return };
        let (Change::Surface(change) | Change::Loads(_, change)) = &hypothesis.change else {
            return;
        };
        let body = &self.exact.domain.body;
        let on = hypothesis.face.map_or_else(|| faces(body), |face| vec![face]);
        let right = stress.to_vec();
        for face in on {
            let mut changed = right.clone();
            change(&self.given(size, time, x, h), face, &mut changed);
            let pairs = stress.iter_mut().zip(changed).zip(x);
            let on_face = pairs.filter(|(_, x)| is_on(body, face, x));
            on_face.for_each(|((stress, changed), _)| *stress = changed);
        }
    }
}
