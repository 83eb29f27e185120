//! A field with a mistake, in the form in which a solver gets it.

use mms_runtime::axisymmetric::hoop_strain;
use mms_runtime::column::{Matrices, PACK, Pack};
use mms_runtime::{Axisymmetric, Domain, ManufacturedField, Material, Matrix, Vector};

use crate::body::{faces, is_on};
use crate::exact::Exact;
use crate::hypothesis::{Change, Given, Hypothesis, MotionPart, Ring};
use crate::revolved::{lifted, part, whole};

/// Terms that are omitted on purpose.
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
    /// The right field, less the omitted terms.
    pub fn right(exact: &'a Exact<'a, D>, without: Without) -> Self {
        Changed { exact, mistake: None, without }
    }

    /// The field with a mistake.
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

    /// The mistake of an axisymmetric field in space, its size, and the exact solution in space.
    fn in_space(&self) -> Option<(&'a Hypothesis<3>, &'a [f64], &'a Exact<'a, 3>)> {
        let (Hypothesis { change: Change::InSpace(it), .. }, size) = self.mistake? else {
            return None;
        };
        Some((it, size, self.exact.space?))
    }

    /// Changes stresses of an axisymmetric field in space.
    fn change_in_space(
        &self,
        time: f64,
        reference: &[Vector<f64, D>],
        (h, hoop_strain): (&[Matrix<f64, D>], &[f64]),
        (stress, hoop_stress): (&mut [Matrix<f64, D>], &mut [f64]),
        of: impl Fn(&Given<'_, 3>, &mut [Matrix<f64, 3>]),
    ) {
        let Some((_, size, exact)) = self.in_space() else { return };
        let points: Vec<_> = reference.iter().map(lifted).collect();
        let all = |it: &[Matrix<f64, D>], hoop: &[f64]| -> Vec<Matrix<f64, 3>> {
            it.iter().zip(hoop).map(|(it, hoop)| whole(it, *hoop)).collect()
        };
        let gradient = all(h, hoop_strain);
        let mut tau = all(stress, hoop_stress);
        let given = Given { exact, size, time, reference: &points, gradient: &gradient };
        of(&given, &mut tau);
        for ((stress, hoop), tau) in stress.iter_mut().zip(hoop_stress).zip(&tau) {
            (*stress, *hoop) = (part(tau), tau[(2, 2)]);
        }
    }

    /// Changes a quantity of the motion at the start or on walls.
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

    fn axisymmetric(&self) -> Option<&dyn Axisymmetric<f64, D>> {
        let is_plane = self.ring() == Some(Ring::Plane);
        self.exact.space.filter(|_| !is_plane).map(|_| self as _)
    }

    fn kirchhoff_stress(
        &self,
        time: f64,
        reference: &[Vector<f64, D>],
        displacement_gradient: &[Matrix<f64, D>],
        stress: &mut [Matrix<f64, D>],
    ) {
        if let (Some(space), Some(Ring::Plane)) = (self.exact.space, self.ring()) {
            let points: Vec<_> = reference.iter().map(lifted).collect();
            let all: Vec<_> = displacement_gradient.iter().map(|h| whole(h, 0.0)).collect();
            let tau = space.stress(time, &points, &all);
            stress.iter_mut().zip(&tau).for_each(|(to, tau)| *to = part(tau));
            return;
        }
        if self.without.stress {
            return stress.fill(Matrix::zeros());
        }
        self.exact.field.kirchhoff_stress(time, reference, displacement_gradient, stress);
        if let Some((Hypothesis { change: Change::Stress(_, change), .. }, size)) = self.mistake {
            change(&self.given(size, time, reference, displacement_gradient), stress);
        }
    }
}

impl<const D: usize> Changed<'_, D> {
    /// The body that the mistake uses in place of a ring.
    fn ring(&self) -> Option<Ring> {
        match self.mistake {
            Some((Hypothesis { change: Change::Ring(ring), .. }, _)) => Some(*ring),
            _ => None,
        }
    }
}

impl<const D: usize> Axisymmetric<f64, D> for Changed<'_, D> {
    fn hoop_strain(&self, time: f64, reference: &[Vector<f64, D>], out: &mut [f64]) {
        out.copy_from_slice(&hoop_strain(self.exact.field, time, reference));
    }

    fn kirchhoff_stress_of_packs(
        &self,
        time: f64,
        reference: &[[Vector<f64, D>; PACK]],
        strains: (&[Matrices<f64, D>], &[[f64; PACK]]),
        stresses: (&mut [Matrices<f64, D>], &mut [[f64; PACK]]),
    ) {
        let Some(right) = self.exact.field.axisymmetric() else { return };
        let (stress, hoop_stress) = stresses;
        if self.without.stress {
            stress.fill(Matrices::zeros());
            return hoop_stress.fill([0.0; PACK]);
        }
        right.kirchhoff_stress_of_packs(time, reference, strains, (stress, hoop_stress));
        let Some((Hypothesis { change: Change::Stress(_, change), .. }, ..)) = self.in_space()
        else {
            return;
        };
        let flat = |all: &[Matrices<f64, D>]| -> Vec<Matrix<f64, D>> {
            all.iter().flat_map(|it| (0..PACK).map(|at| it.get(at))).collect()
        };
        let h = flat(strains.0);
        let mut tau = flat(stress);
        let points = reference.as_flattened();
        let hoops = (&mut tau[..], hoop_stress.as_flattened_mut());
        self.change_in_space(time, points, (&h, strains.1.as_flattened()), hoops, change);
        for (to, tau) in stress.iter_mut().zip(tau.chunks(PACK)) {
            tau.iter().enumerate().for_each(|(at, tau)| to.set(at, tau));
        }
    }

    fn weight(&self, middle: f64) -> f64 {
        match (self.ring(), self.mistake) {
            (Some(Ring::Box), _) => 1.0,
            (Some(Ring::Wider), Some((_, [by, ..]))) => middle + by,
            _ => middle,
        }
    }

    fn strain_energy(
        &self,
        time: f64,
        reference: &[Vector<f64, D>],
        strains: (&[Matrix<f64, D>], &[f64]),
        energy: &mut [f64],
    ) -> bool {
        let right = self.exact.field.axisymmetric();
        right.is_some_and(|it| it.strain_energy(time, reference, strains, energy))
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
        if let Some((
            Hypothesis { change: Change::Force(change) | Change::Loads(change, _), .. },
            size,
            exact,
        )) = self.in_space()
        {
            let reference: Vec<_> = x.iter().map(lifted).collect();
            let mut b: Vec<_> = out.iter().map(lifted).collect();
            change(&Given { exact, size, time, reference: &reference, gradient: &[] }, &mut b);
            let pairs = out.iter_mut().zip(b);
            return pairs.for_each(|(out, b)| *out = Vector::from_fn(|axis, _| b[axis]));
        }
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
        let body = &self.exact.domain.body;
        let on = hypothesis.face.map_or_else(|| faces(body), |face| vec![face]);
        let right = stress.to_vec();
        for face in on {
            let mut changed = right.clone();
            match (&hypothesis.change, self.in_space()) {
                (Change::Surface(change) | Change::Loads(_, change), _) => {
                    change(&self.given(size, time, x, h), face, &mut changed);
                }
                (
                    _,
                    Some((
                        Hypothesis {
                            change: Change::Surface(change) | Change::Loads(_, change),
                            ..
                        },
                        ..,
                    )),
                ) => {
                    let strain = hoop_strain(self.exact.field, time, x);
                    let mut unread = vec![0.0; strain.len()];
                    let stresses = (&mut changed[..], &mut unread[..]);
                    let of = |at: &Given<'_, 3>, tau: &mut [Matrix<f64, 3>]| change(at, face, tau);
                    self.change_in_space(time, x, (h, &strain), stresses, of);
                }
                _ => return,
            }
            let pairs = stress.iter_mut().zip(changed).zip(x);
            let on_face = pairs.filter(|(_, x)| is_on(body, face, x));
            on_face.for_each(|((stress, changed), _)| *stress = changed);
        }
    }
}
