//! The balance in the weak form, with smooth functions w that vanish where the motion is given: int rho0 a.w = -int P:grad w +
//! int rho0 b.w + int T.w over faces with tractions.

use std::ops::{Add, Mul, Sub};

use mms_runtime::body::bounding_box;
use mms_runtime::tensor::inverse;
use mms_runtime::{
    Condition, Domain, Face, ManufacturedField as _, Material as _, Matrix, Refusal, Vector,
};

use crate::answer::Computed;
use crate::body::{away, faces};
use crate::changed::{Changed, Without};
use crate::exact::Exact;
use crate::quadrature::{Piece, Quadrature};
use crate::smooth::{Smooth, less, size};

/// The highest degree of functions, in one to three dimensions.
const DEGREE: [usize; 3] = [7, 5, 3];
/// Points of quadrature along an axis, in one to three dimensions. The first rule that agrees with the one before is used.
const RULES: [&[usize]; 3] = [&[12, 24, 48, 96, 192], &[9, 12, 18, 27, 40], &[6, 9, 12, 18]];
/// The largest difference between rules that agree, relative to the largest sum.
const AGREED: f64 = 1e-9;
/// The step of difference quotients, relative to the size of the body.
const STEP: f64 = 1e-4;

/// Smooth functions that vanish where the motion is given, and a quadrature.
pub struct Weak<'a, const D: usize> {
    /// The exact solution.
    pub exact: &'a Exact<'a, D>,
    /// The time.
    pub time: f64,
    /// The points in the body and on its faces.
    pub quadrature: Quadrature<D>,
    smooth: Smooth<D>,
    /// The body, with the conditions on its faces.
    domain: Domain<f64, D>,
    /// A length that is small compared with the body.
    step: f64,
    /// All functions at the points, point by point; every hypothesis uses them.
    at_points: Vec<f64>,
    /// The gradients of all functions at the points.
    pub slopes_at_points: Vec<Vector<f64, D>>,
}

/// The sums of a field by terms: a, P in the body, b, tractions.
pub struct Sums {
    /// int rho0 a.w.
    pub inertia: Vec<f64>,
    /// -int P:grad w.
    pub stress: Vec<f64>,
    /// int rho0 b.w.
    pub force: Vec<f64>,
    /// int T.w.
    pub traction: Vec<f64>,
}

impl Sums {
    fn terms(&self) -> [&Vec<f64>; 4] {
        [&self.inertia, &self.stress, &self.force, &self.traction]
    }

    /// The size of the largest term.
    pub fn scale(&self) -> f64 {
        self.terms().map(|it| size(it)).into_iter().fold(f64::MIN_POSITIVE, f64::max)
    }

    /// The size of the largest difference between two terms of one kind.
    fn largest_difference(&self, other: &Sums) -> f64 {
        let pairs = self.terms().into_iter().zip(other.terms());
        pairs.map(|(a, b)| size(&less(a, 1.0, b))).fold(0.0, f64::max)
    }

    /// The sums that a solver computes if its density is `density` times the right one.
    pub fn computed(&self, computed: Computed, density: f64) -> Vec<f64> {
        let Sums { inertia, stress, force, traction } = self;
        let all = inertia.iter().zip(stress).zip(force).zip(traction);
        all.map(|(((inertia, stress), force), traction)| match computed {
            Computed::Acceleration => (stress + traction) / density + force,
            Computed::Residual | Computed::NodalResidual => {
                density * (inertia - force) - stress - traction
            }
        })
        .collect()
    }
}

/// The sums of the right field, and their relative difference from another quadrature.
pub struct Right<'a, const D: usize> {
    /// The functions and the quadrature.
    pub weak: Weak<'a, D>,
    /// The sums.
    pub sums: Sums,
    /// The error of the sums, relative to the largest sum.
    pub relative_error: f64,
}

impl<'a, const D: usize> Right<'a, D> {
    /// Uses as many quadrature points as the sums need, and as many functions as this number of a user's points can separate.
    ///
    /// # Errors
    /// A body without extent.
    pub fn new(
        exact: &'a Exact<'a, D>,
        time: f64,
        points: usize,
        without: Without,
    ) -> Result<Self, Refusal> {
        let by = |count: usize| -> Result<(Weak<'a, D>, Sums), Refusal> {
            let weak = Weak::new(exact, time, points, count)?;
            let sums = weak.sums(&Changed::right(exact, without));
            Ok((weak, sums))
        };
        let rules = RULES[D - 1];
        let (mut weak, mut sums) = by(rules[0])?;
        let mut relative_error = f64::INFINITY;
        for &count in &rules[1..] {
            let (finer, found) = by(count)?;
            relative_error = found.largest_difference(&sums) / found.scale();
            (weak, sums) = (finer, found);
            if relative_error <= AGREED {
                break;
            }
        }
        Ok(Right { weak, sums, relative_error })
    }
}

impl<'a, const D: usize> Weak<'a, D> {
    fn new(
        exact: &'a Exact<'a, D>,
        time: f64,
        points: usize,
        count: usize,
    ) -> Result<Self, Refusal> {
        let smooth = Smooth::new(&exact.domain.body, points, DEGREE)?;
        Self::of(exact, time, &exact.domain, smooth, count)
    }

    /// Uses functions of these degrees in one to three dimensions that vanish where the domain prescribes the motion.
    ///
    /// # Errors
    /// A body without extent.
    pub fn with(
        exact: &'a Exact<'a, D>,
        time: f64,
        domain: &Domain<f64, D>,
        degrees: [usize; 3],
        count: usize,
    ) -> Result<Self, Refusal> {
        let smooth = Smooth::new(&domain.body, usize::MAX, degrees)?;
        Self::of(exact, time, domain, smooth, count)
    }

    fn of(
        exact: &'a Exact<'a, D>,
        time: f64,
        domain: &Domain<f64, D>,
        smooth: Smooth<D>,
        count: usize,
    ) -> Result<Self, Refusal> {
        let body = &domain.body;
        let [lower, upper] = bounding_box(body)?;
        let mut weak = Weak {
            exact,
            time,
            quadrature: Quadrature::new(body, count),
            smooth,
            domain: domain.clone(),
            step: STEP * (upper - lower).min(),
            at_points: Vec::new(),
            slopes_at_points: Vec::new(),
        };
        let all = &weak.quadrature.points;
        weak.at_points = all.iter().flat_map(|x| weak.functions(x)).collect();
        weak.slopes_at_points = all.iter().flat_map(|x| weak.gradients(x)).collect();
        Ok(weak)
    }

    /// A factor that is 0 where the motion of a component is given, and about 1 in the body.
    fn bubble(&self, component: usize, x: &Vector<f64, D>) -> f64 {
        let body = &self.domain.body;
        let factor = |face: Face| match self.domain.condition(face) {
            Condition::Traction | Condition::Free => 1.0,
            Condition::Fixed | Condition::Prescribed => away(body, face, x),
            Condition::Roller => match face {
                Face::Min(axis) | Face::Max(axis) if axis != component => 1.0,
                _ => away(body, face, x),
            },
        };
        faces(body).into_iter().map(factor).product()
    }

    /// The values of all functions of each component, at X.
    pub fn functions(&self, x: &Vector<f64, D>) -> Vec<f64> {
        let values = self.smooth.values(x);
        let bubbles: [f64; D] = std::array::from_fn(|component| self.bubble(component, x));
        bubbles.iter().flat_map(|bubble| values.iter().map(move |it| it * bubble)).collect()
    }

    /// The gradients of all functions of each component, at X.
    pub fn gradients(&self, x: &Vector<f64, D>) -> Vec<Vector<f64, D>> {
        let (values, slopes) = (self.smooth.values(x), self.smooth.gradients(x));
        let of_bubble = |i: usize| {
            Vector::from_fn(|axis, _| {
                let along = self.along(axis);
                (self.bubble(i, &(x + along)) - self.bubble(i, &(x - along))) / (2.0 * self.step)
            })
        };
        let all = (0..D).flat_map(|i| {
            let (bubble, slope) = (self.bubble(i, x), of_bubble(i));
            let pairs = values.iter().zip(&slopes);
            pairs.map(move |(value, of)| of * bubble + slope * *value).collect::<Vec<_>>()
        });
        all.collect()
    }

    /// A step along an axis.
    fn along(&self, axis: usize) -> Vector<f64, D> {
        Vector::from_fn(|it, _| if it == axis { self.step } else { 0.0 })
    }

    /// The number of functions.
    pub fn count(&self) -> usize {
        D * self.smooth.count()
    }

    /// int q.w over the body, from q at the points of the quadrature.
    pub fn integrate(&self, values: &[Vector<f64, D>]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        let functions = self.at_points.chunks(self.count());
        for ((functions, volume), q) in functions.zip(&self.quadrature.volumes).zip(values) {
            add(&mut sums, functions, &(q * *volume));
        }
        sums
    }

    /// -int P:grad w, from P at the points of the quadrature.
    pub fn stress_term(&self, stress: impl Iterator<Item = Matrix<f64, D>>) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        let slopes = self.slopes_at_points.chunks(self.count());
        for ((gradients, volume), p) in slopes.zip(&self.quadrature.volumes).zip(stress) {
            let p = p * *volume;
            let count = self.smooth.count();
            for (i, (sums, of)) in
                sums.chunks_exact_mut(count).zip(gradients.chunks_exact(count)).enumerate()
            {
                let row: [f64; D] = std::array::from_fn(|axis| p[(i, axis)]);
                for (sum, slope) in sums.iter_mut().zip(of) {
                    let mut term = row[0] * slope[0];
                    (1..D).for_each(|axis| term += row[axis] * slope[axis]);
                    *sum -= term;
                }
            }
        }
        sums
    }

    /// Converts values per mass at points to values per volume.
    pub fn per_volume(
        &self,
        x: &[Vector<f64, D>],
        values: Vec<Vector<f64, D>>,
    ) -> Vec<Vector<f64, D>> {
        let density = self.exact.density(x);
        values.iter().zip(density).map(|(value, density)| value * density).collect()
    }

    /// The terms of a field with a mistake.
    pub fn sums(&self, field: &Changed<'_, D>) -> Sums {
        let (x, time) = (&self.quadrature.points, self.time);
        let mut b = vec![Vector::zeros(); x.len()];
        field.body_force(time, x, &mut b);
        let h = self.exact.gradient(time, x);
        Sums {
            inertia: self.integrate(&self.per_volume(x, self.exact.acceleration(time, x))),
            stress: self.stress_term(self.stress(field, &h).into_iter()),
            force: self.integrate(&self.per_volume(x, b)),
            traction: self.tractions(field),
        }
    }

    /// P of a field for these H at the points of the quadrature.
    pub fn stress(&self, field: &Changed<'_, D>, h: &[Matrix<f64, D>]) -> Vec<Matrix<f64, D>> {
        let mut tau = vec![Matrix::zeros(); h.len()];
        field.kirchhoff_stress(self.time, &self.quadrature.points, h, &mut tau);
        tau.iter().zip(h).map(|(tau, h)| first(tau, h)).collect()
    }

    fn tractions(&self, field: &Changed<'_, D>) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        for (piece, load) in self.loads(field) {
            add(&mut sums, &self.functions(&piece.position), &load);
        }
        sums
    }

    /// The pieces of loaded faces, each with its force.
    fn loads(&self, field: &Changed<'_, D>) -> Vec<(&Piece<D>, Vector<f64, D>)> {
        let has_load =
            |piece: &&Piece<D>| self.exact.domain.condition(piece.face) == Condition::Traction;
        let loaded: Vec<&Piece<D>> = self.quadrature.pieces.iter().filter(has_load).collect();
        let x: Vec<_> = loaded.iter().map(|piece| piece.position).collect();
        let h = self.exact.gradient(self.time, &x);
        let mut tau = vec![Matrix::zeros(); x.len()];
        field.surface_stress(self.time, &x, &h, &mut tau);
        let forces = tau.iter().zip(&h).zip(&loaded).map(|((tau, h), it)| first(tau, h) * it.area);
        loaded.iter().copied().zip(forces.collect::<Vec<_>>()).collect()
    }

    /// Div P + rho0 b at X, without the omitted terms.
    pub fn applied(&self, without: &Without, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let (a, b) = (self.exact.acceleration(self.time, x), self.exact.body_force(self.time, x));
        let [force, stress] =
            [without.body_force, without.stress].map(|is_out| if is_out { 0.0 } else { 1.0 });
        let each = a.iter().zip(&b).zip(self.exact.density(x));
        each.map(|((a, b), density)| ((a - b) * stress + b * force) * density).collect()
    }

    /// rho0 a less Div P + rho0 b at X, without the omitted terms.
    pub fn residual(&self, without: &Without, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let inertia = self.per_volume(x, self.exact.acceleration(self.time, x));
        let applied = self.applied(without, x);
        inertia.iter().zip(applied).map(|(inertia, applied)| inertia - applied).collect()
    }
}

/// The errors of right elements of degree 1 in the sums, which fall with h^2.
pub struct OfElements {
    /// The errors of right methods, with a lumped and with a consistent mass.
    pub methods: Vec<Vec<f64>>,
    /// The size of the error terms.
    pub size: f64,
}

impl<const D: usize> Weak<'_, D> {
    /// Finds the errors of elements by their terms. The interpolant of a function between nodes exceeds it, as a mean over
    /// cells, by h^2/12 times the second derivatives along the axes, where h is the longest edge. This affects w in all force
    /// terms, u in the stress, and a in the inertia of a consistent mass. A lumped mass interpolates a.w as one function, which
    /// differs by h^2/6 int rho0 grad a:grad w. Accelerations are compared with the exact ones at nodes: both sides interpolate
    /// w inside the body, so that its error cancels there.
    pub fn of_elements(&self, computed: Computed, without: &Without) -> OfElements {
        let factor = self.exact.cell_size.powi(2) / 12.0;
        let axes: Axes<D> =
            std::array::from_fn(|axis| (Vector::from_fn(|it, _| f64::from(it == axis)), factor));
        let inertia = |x: &[Vector<f64, D>]| match computed {
            Computed::Acceleration => self.applied(without, x),
            _ => self.per_volume(x, self.exact.acceleration(self.time, x)),
        };
        let [function, displacement, acceleration, product] = [
            self.of_functions(computed, without, &axes),
            self.of_displacements(without, &axes),
            self.integrate(&self.curved(inertia, &axes)),
            self.of_products(inertia, &axes),
        ];
        let plus = |a: &[f64], b: &[f64]| less(a, -1.0, b);
        let methods = match computed {
            Computed::Acceleration => {
                let consistent = less(&plus(&function, &displacement), 1.0, &acceleration);
                vec![less(&consistent, 1.0, &product), consistent]
            }
            Computed::Residual | Computed::NodalResidual => {
                let integrated = less(&function, 1.0, &displacement);
                let consistent = plus(&integrated, &acceleration);
                vec![plus(&consistent, &product), consistent, integrated]
            }
        };
        let terms = [function, displacement, acceleration, product];
        let size = terms.iter().map(|it| size(it).powi(2)).sum::<f64>().sqrt();
        OfElements { methods, size }
    }

    /// The values of a function before and after each point of the quadrature, along an axis.
    fn beside<T>(
        &self,
        axis: &Vector<f64, D>,
        of: impl Fn(&[Vector<f64, D>]) -> Vec<T>,
    ) -> [Vec<T>; 2] {
        let x = &self.quadrature.points;
        [-self.step, self.step]
            .map(|step| of(&x.iter().map(|x| x + axis * step).collect::<Vec<_>>()))
    }

    /// The sum over axes of a function's second derivatives at the quadrature points, each times the factor of its axis.
    fn curved<T>(&self, of: impl Fn(&[Vector<f64, D>]) -> Vec<T>, axes: &Axes<D>) -> Vec<T>
    where
        T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
    {
        let here = of(&self.quadrature.points);
        let mut sum: Vec<T> = here.iter().map(|it| *it * 0.0).collect();
        for (axis, factor) in axes {
            let [before, after] = self.beside(axis, &of);
            let over = factor / self.step.powi(2);
            for (((sum, here), before), after) in sum.iter_mut().zip(&here).zip(before).zip(after) {
                *sum = *sum + (before - *here * 2.0 + after) * over;
            }
        }
        sum
    }

    /// The error from interpolating w: for residuals at nodes, in the stress, the body force and the inertia; for every
    /// computed quantity, in the terms on faces.
    fn of_functions(&self, computed: Computed, without: &Without, axes: &Axes<D>) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        if computed == Computed::NodalResidual {
            let x = &self.quadrature.points;
            let values = self.residual(without, x);
            for ((x, volume), q) in x.iter().zip(&self.quadrature.volumes).zip(&values) {
                add(&mut sums, &self.curvature(x, axes), &(q * *volume));
            }
        }
        let sign = if computed == Computed::Acceleration { 1.0 } else { -1.0 };
        // The nodes of a face lie on it, so w is interpolated only along the face. There the stress and the tractions cancel:
        // if one of them is omitted, only the other contributes.
        let factor = sign * (f64::from(without.stress) - f64::from(without.traction));
        let right = Changed::right(self.exact, Without::default());
        for (piece, load) in self.loads(&right) {
            let across = piece.area.normalize();
            let along = axes.map(|(axis, factor)| (axis - across * across.dot(&axis), factor));
            add(&mut sums, &self.curvature(&piece.position, &along), &(load * factor));
        }
        sums
    }

    /// The error from interpolating u in the stress: the effect of a small part of the change of H, scaled.
    fn of_displacements(&self, without: &Without, axes: &Axes<D>) -> Vec<f64> {
        let h = self.exact.gradient(self.time, &self.quadrature.points);
        let bent = self.curved(|x| self.exact.gradient(self.time, x), axes);
        let largest = bent.iter().map(|it| it.amax()).fold(0.0, f64::max);
        let part = SMALL / largest.max(SMALL);
        let bent: Vec<_> = bent.iter().zip(&h).map(|(bent, h)| h + bent * part).collect();
        let right = Changed::right(self.exact, *without);
        let [bent, straight] =
            [bent, h].map(|h| self.stress_term(self.stress(&right, &h).into_iter()));
        less(&bent, 1.0, &straight).iter().map(|it| it / part).collect()
    }

    /// The error of a.w as one function, less the errors of a and of w by themselves.
    fn of_products(
        &self,
        inertia: impl Fn(&[Vector<f64, D>]) -> Vec<Vector<f64, D>>,
        axes: &Axes<D>,
    ) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        for (axis, factor) in axes {
            let [before, after] = self.beside(axis, &inertia);
            let slopes = self.slopes_at_points.chunks(self.count());
            let pairs = slopes.zip(&self.quadrature.volumes).zip(before.iter().zip(&after));
            for ((gradients, volume), (before, after)) in pairs {
                let own: Vec<f64> = gradients.iter().map(|it| it.dot(axis)).collect();
                add(&mut sums, &own, &((after - before) * (factor * volume / self.step)));
            }
        }
        sums
    }

    /// Second derivatives of all functions along axes, each times its factor.
    fn curvature(&self, x: &Vector<f64, D>, axes: &Axes<D>) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        let here = self.functions(x);
        for (axis, factor) in axes {
            let step = axis * self.step;
            let over = factor / self.step.powi(2);
            let [before, after] = [x - step, x + step].map(|it| self.functions(&it));
            for (((sum, here), before), after) in sums.iter_mut().zip(&here).zip(before).zip(after)
            {
                *sum += (before - 2.0 * here + after) * over;
            }
        }
        sums
    }
}

/// Directions, each with a factor of the second derivative along it.
type Axes<const D: usize> = [(Vector<f64, D>, f64); D];

/// A change of H that is small.
const SMALL: f64 = 1e-4;

/// P = tau F^-T; NaN if F is singular.
pub fn first<const D: usize>(tau: &Matrix<f64, D>, h: &Matrix<f64, D>) -> Matrix<f64, D> {
    let f = h + Matrix::identity();
    inverse(&f).map_or(Matrix::repeat(f64::NAN), |inverse| tau * inverse.transpose())
}

/// Adds q.w for all functions, which are listed component by component.
pub fn add<const D: usize>(sums: &mut [f64], functions: &[f64], q: &Vector<f64, D>) {
    let count = functions.len() / D;
    let each = sums.chunks_exact_mut(count).zip(functions.chunks_exact(count));
    for ((sums, functions), q) in each.zip(q.iter()) {
        sums.iter_mut().zip(functions).for_each(|(sum, value)| *sum += value * q);
    }
}
