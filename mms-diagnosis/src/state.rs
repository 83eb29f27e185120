//! Diagnosis of accelerations or residuals at an exact state, in the weak form.
//!
//! Values at points of a right solver need not be near the exact ones: on irregular meshes they are not, while their sums
//! with smooth functions w are. So the balance is asked for such sums: int rho0 a.w = -int P:grad w + int rho0 b.w + int
//! T.w over faces with tractions, with w = 0 where the motion is given. Every mistake in b, P, T or rho0 changes them in a
//! way that is known without a solver.

use mms_runtime::body::{Filling, Piece, bounding_box};
use mms_runtime::tensor::inverse;
use mms_runtime::{
    Condition, Face, Fill, ManufacturedField as _, Material as _, Matrix, Refusal, Vector,
};

pub use crate::answer::Computed;
use crate::answer::{Diagnosis, Finding, Limits, Rung, ranked, unseen};
use crate::changed::{Changed, Without};
use crate::exact::Exact;
use crate::hypothesis::{Change, Given, Hypothesis, MotionPart, away, faces};
use crate::pair;
use crate::rank::{Error, explain};
use crate::smooth::{Smooth, less, size};

/// Accelerations or residuals of a solver at an exact state.
#[derive(Clone, Debug)]
pub struct Response {
    /// What they are.
    pub computed: Computed,
    /// The time of the state.
    pub time: f64,
    /// X, the numbers of a point together.
    pub reference: Vec<f64>,
    /// The values, likewise.
    pub values: Vec<f64>,
    /// The volume of each point; none where all have the same, and of what is integrated already.
    pub volumes: Option<Vec<f64>>,
    /// What was left out.
    pub without: Without,
    /// The step over which accelerations are the mean, where they are found from velocities after one.
    pub step: Option<f64>,
}

/// The highest degree of functions, in one to three dimensions.
const DEGREE: [usize; 3] = [7, 5, 3];
/// Points of a quadrature along an axis, in one to three dimensions.
const POINTS: [f64; 3] = [512.0, 64.0, 20.0];
/// Which part of the error a mistake that is named may leave.
const LEFT: f64 = 0.2;
/// At one state mistakes of several sizes are one formula.
const NEARER: f64 = 1.3;
/// What h may make of a sum of a right solver, over the sum: so many times (h/length)^2.
const METHOD: f64 = 2.5;

/// Smooth functions that vanish where the motion is given, and a quadrature.
struct Weak<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    time: f64,
    smooth: Smooth<D>,
    points: Vec<Vector<f64, D>>,
    volumes: Vec<f64>,
    pieces: Vec<Piece<D>>,
    /// All functions at the points, point by point: every hypothesis asks for them.
    at_points: Vec<f64>,
    /// Their gradients.
    slopes_at_points: Vec<Vector<f64, D>>,
}

/// The sums of a field, apart by their terms: of a, of P in the body, of b, of tractions.
struct Sums {
    inertia: Vec<f64>,
    stress: Vec<f64>,
    force: Vec<f64>,
    traction: Vec<f64>,
}

impl<'a, const D: usize> Weak<'a, D> {
    fn new(exact: &'a Exact<'a, D>, time: f64, points: usize) -> Result<Self, Refusal> {
        let body = &exact.domain.body;
        let [lower, upper] = bounding_box(body)?;
        let spacing = (upper - lower) / POINTS[D - 1];
        let filling = Filling::new(body, Fill::Fitted, &spacing)?;
        let mut weak = Weak {
            exact,
            time,
            smooth: Smooth::new(body, points, DEGREE)?,
            points: filling.position,
            volumes: filling.volume,
            pieces: filling.pieces,
            at_points: Vec::new(),
            slopes_at_points: Vec::new(),
        };
        weak.at_points = weak.points.iter().flat_map(|x| weak.functions(x)).collect();
        weak.slopes_at_points = weak.points.iter().flat_map(|x| weak.gradients(x)).collect();
        Ok(weak)
    }

    /// 0 where the motion of a component is given, and of the size of 1 in the body.
    fn bubble(&self, component: usize, x: &Vector<f64, D>) -> f64 {
        let body = &self.exact.domain.body;
        let factor = |face: Face| match self.exact.domain.condition(face) {
            Condition::Traction | Condition::Free => 1.0,
            Condition::Fixed | Condition::Prescribed => away(body, face, x),
            Condition::Roller => match face {
                Face::Min(axis) | Face::Max(axis) if axis != component => 1.0,
                _ => away(body, face, x),
            },
        };
        faces(body).into_iter().map(factor).product()
    }

    /// The values of all functions with one component, at X.
    fn functions(&self, x: &Vector<f64, D>) -> Vec<f64> {
        let values = self.smooth.values(x);
        (0..D)
            .flat_map(|i| values.iter().map(|value| value * self.bubble(i, x)).collect::<Vec<_>>())
            .collect()
    }

    /// Their gradients.
    fn gradients(&self, x: &Vector<f64, D>) -> Vec<Vector<f64, D>> {
        let (values, slopes) = (self.smooth.values(x), self.smooth.gradients(x));
        let step = 1e-5 * self.exact.cell_size.max(f64::MIN_POSITIVE);
        let of_bubble = |i: usize| {
            Vector::from_fn(|axis, _| {
                let mut along = Vector::zeros();
                along[axis] = step;
                (self.bubble(i, &(x + along)) - self.bubble(i, &(x - along))) / (2.0 * step)
            })
        };
        let all = (0..D).flat_map(|i| {
            let (bubble, slope) = (self.bubble(i, x), of_bubble(i));
            let pairs = values.iter().zip(&slopes);
            pairs.map(move |(value, of)| of * bubble + slope * *value).collect::<Vec<_>>()
        });
        all.collect()
    }

    fn count(&self) -> usize {
        D * self.smooth.count()
    }

    /// int q.w over the body, of q at the points of the quadrature.
    fn paired(&self, values: &[Vector<f64, D>]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        let functions = self.at_points.chunks(self.count());
        for ((functions, volume), q) in functions.zip(&self.volumes).zip(values) {
            add(&mut sums, functions, &(q * *volume));
        }
        sums
    }

    /// What is given per mass at the points of the quadrature, per volume.
    fn per_volume(&self, values: Vec<Vector<f64, D>>) -> Vec<Vector<f64, D>> {
        let density = self.exact.density(&self.points);
        values.iter().zip(density).map(|(value, density)| value * density).collect()
    }

    /// The terms of a field with a mistake.
    fn sums(&self, field: &Changed<'_, D>) -> Sums {
        let (x, time) = (&self.points, self.time);
        let mut b = vec![Vector::zeros(); x.len()];
        field.body_force(time, x, &mut b);
        let h = self.exact.gradient(time, x);
        let mut tau = vec![Matrix::zeros(); x.len()];
        field.at_time(time);
        field.kirchhoff_stress(x, &h, &mut tau);
        let mut stress = vec![0.0; self.count()];
        let slopes = self.slopes_at_points.chunks(self.count());
        for (((gradients, volume), tau), h) in slopes.zip(&self.volumes).zip(&tau).zip(&h) {
            let p = first(tau, h) * *volume;
            let each = gradients.chunks(self.smooth.count()).enumerate();
            let terms = each.flat_map(|(i, of)| of.iter().map(move |slope| (p.row(i) * slope)[0]));
            stress.iter_mut().zip(terms).for_each(|(sum, term)| *sum -= term);
        }
        Sums {
            inertia: self.paired(&self.per_volume(self.exact.acceleration(time, x))),
            stress,
            force: self.paired(&self.per_volume(b)),
            traction: self.tractions(field),
        }
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
        let loaded: Vec<&Piece<D>> = self.pieces.iter().filter(has_load).collect();
        let x: Vec<_> = loaded.iter().map(|piece| piece.position).collect();
        let h = self.exact.gradient(self.time, &x);
        let mut tau = vec![Matrix::zeros(); x.len()];
        field.surface_stress(self.time, &x, &h, &mut tau);
        let forces = tau.iter().zip(&h).zip(&loaded).map(|((tau, h), it)| first(tau, h) * it.area);
        loaded.iter().copied().zip(forces.collect::<Vec<_>>()).collect()
    }

    /// What a solver computes in such sums.
    fn computed(&self, response: &Response, sums: &Sums, density: f64) -> Vec<f64> {
        let Sums { inertia, stress, force, traction } = sums;
        let all = inertia.iter().zip(stress).zip(force).zip(traction);
        all.map(|(((inertia, stress), force), traction)| match response.computed {
            Computed::Acceleration => (stress + traction) / density + force,
            Computed::Residual | Computed::NodalResidual => {
                density * (inertia - force) - stress - traction
            }
        })
        .collect()
    }

    /// What scatter of the values from point to point leaves in the sums: half the difference of those over every second
    /// point and over the others.
    fn scatter(&self, response: &Response, right: &[f64]) -> Vec<f64> {
        let half = |first: usize| {
            let of = |at: usize| if at % 2 == first { 2.0 } else { 0.0 };
            self.error(response, right, &of)
        };
        less(&half(0), 1.0, &half(1)).iter().map(|it| it / 2.0).collect()
    }

    /// The same of the values at points of a user's, less those of a right solver. Each point counts `times`.
    fn error(&self, response: &Response, right: &[f64], times: &dyn Fn(usize) -> f64) -> Vec<f64> {
        let points: Vec<Vector<f64, D>> = crate::exact::vectors(&response.reference);
        let total: f64 = self.volumes.iter().sum();
        let each = match response.computed {
            Computed::Acceleration | Computed::Residual => total / points.len().max(1) as f64,
            Computed::NodalResidual => 1.0,
        };
        let even = vec![each; points.len()];
        let volumes = response.volumes.as_ref().unwrap_or(&even);
        // The smooth part of what is right is taken away at the points, so that the user's sums need not be exact for it.
        let smooth = |x: &[Vector<f64, D>]| self.smooth_part(response, x);
        let (own, at_points) = (smooth(&self.points), smooth(&points));
        let per_volume = match response.computed {
            Computed::Acceleration => self.exact.density(&points),
            Computed::Residual | Computed::NodalResidual => vec![1.0; points.len()],
        };
        let mut sums = vec![0.0; self.count()];
        let values: Vec<Vector<f64, D>> = crate::exact::vectors(&response.values);
        for (at, x) in points.iter().enumerate() {
            let q = (values[at] * per_volume[at] - at_points[at]) * volumes[at] * times(at);
            add(&mut sums, &self.functions(x), &q);
        }
        let rest = less(right, 1.0, &self.paired(&own));
        less(&sums, 1.0, &rest)
    }

    /// Per volume, what a right solver computes in the body, without what tractions add on faces.
    fn smooth_part(&self, response: &Response, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        match response.computed {
            Computed::Acceleration => self.applied(&response.without, x),
            Computed::Residual => self.left_over(&response.without, x),
            // What belongs to a node of it is not known here.
            Computed::NodalResidual => vec![Vector::zeros(); x.len()],
        }
    }

    /// Div P + rho0 b, less what is left out.
    fn applied(&self, without: &Without, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let (a, b) = (self.exact.acceleration(self.time, x), self.exact.body_force(self.time, x));
        let [force, stress] =
            [without.body_force, without.stress].map(|is_out| if is_out { 0.0 } else { 1.0 });
        let each = a.iter().zip(&b).zip(self.exact.density(x));
        each.map(|((a, b), density)| ((a - b) * stress + b * force) * density).collect()
    }

    /// rho0 a less that.
    fn left_over(&self, without: &Without, x: &[Vector<f64, D>]) -> Vec<Vector<f64, D>> {
        let pairs = self.exact.acceleration(self.time, x).into_iter().zip(self.exact.density(x));
        let inertia = pairs.map(|(a, density)| a * density);
        inertia.zip(self.applied(without, x)).map(|(inertia, applied)| inertia - applied).collect()
    }

    /// What sums of forces at nodes are off by, for these are integrated with what shape functions of first order make of w: over
    /// a cell its mean is larger by h^2/12 times the second derivatives of w. In a balance with all its terms that is nothing.
    fn interpolated(&self, without: &Without) -> Vec<f64> {
        let x = &self.points;
        let axes: [_; D] = std::array::from_fn(|axis| Vector::from_fn(|i, _| f64::from(i == axis)));
        let mut sums = vec![0.0; self.count()];
        let values = self.left_over(without, x);
        for ((x, volume), q) in x.iter().zip(&self.volumes).zip(&values) {
            add(&mut sums, &self.curvature(x, &axes), &(q * *volume));
        }
        // On a face there are nodes; only along it is w interpolated. Without its stress a body has the tractions alone, and
        // without tractions the stress alone.
        let factor = f64::from(without.traction) - f64::from(without.stress);
        let right = Changed::right(self.exact, Without::default());
        for (piece, load) in self.loads(&right) {
            let x = &piece.position;
            let across = self.curvature(x, &[piece.area.normalize()]);
            let along = less(&self.curvature(x, &axes), 1.0, &across);
            add(&mut sums, &along, &(load * factor));
        }
        sums
    }

    /// h^2/12 times the second derivatives of all functions along these axes, by differences over h.
    fn curvature(&self, x: &Vector<f64, D>, axes: &[Vector<f64, D>]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count()];
        let here = self.functions(x);
        for axis in axes {
            let step = axis * self.exact.cell_size;
            let [before, after] = [x - step, x + step].map(|it| self.functions(&it));
            for (((sum, here), before), after) in sums.iter_mut().zip(&here).zip(before).zip(after)
            {
                *sum += (before - 2.0 * here + after) / 12.0;
            }
        }
        sums
    }
}

/// P = tau F^-T; what is not finite where F is singular.
fn first<const D: usize>(tau: &Matrix<f64, D>, h: &Matrix<f64, D>) -> Matrix<f64, D> {
    let f = h + Matrix::identity();
    inverse(&f).map_or(Matrix::repeat(f64::NAN), |inverse| tau * inverse.transpose())
}

/// Adds q.w for all functions, whose components come one after the other.
fn add<const D: usize>(sums: &mut [f64], functions: &[f64], q: &Vector<f64, D>) {
    let count = functions.len() / D;
    for (at, (sum, value)) in sums.iter_mut().zip(functions).enumerate() {
        *sum += value * q[at / count];
    }
}

/// Diagnoses what a solver computed at an exact state.
///
/// # Errors
/// A body without extent.
pub fn diagnose<const D: usize>(
    exact: &Exact<'_, D>,
    response: &Response,
    hypotheses: &[Hypothesis<D>],
) -> Result<Diagnosis, Refusal> {
    let weak = Weak::new(exact, response.time, response.reference.len() / D)?;
    let is_shown = |change: &Change<D>| match change {
        Change::Force(_) | Change::Stress(..) | Change::Surface(_) | Change::Density => true,
        // After one step it is a start at another time.
        Change::Mass => response.step.is_none(),
        Change::Start(_) => response.step.is_some(),
        Change::Condition(_) | Change::Output(_) | Change::Wall(_) => false,
        Change::Tangent(_) | Change::Order(_) => false,
    };
    let right_sums = weak.sums(&Changed::right(exact, response.without));
    let right = weak.computed(response, &right_sums, 1.0);
    let Sums { inertia, stress, force, traction } = &right_sums;
    let sizes = [inertia, stress, force, traction].map(|it| size(it));
    let scale = sizes.into_iter().fold(0.0, f64::max);
    let all: Vec<f64> =
        weak.error(response, &right, &|_| 1.0).iter().map(|it| it / scale).collect();
    let [lower, upper] = bounding_box(&exact.domain.body)?;
    let smooth = METHOD * (exact.cell_size / (upper - lower).max()).powi(2);
    let floor = smooth.hypot(size(&weak.scatter(response, &right)) / scale);
    // Within a step, an integrator may take the acceleration of any time.
    let drift = response.step.map(|step| {
        let later = exact.acceleration(response.time + step, &weak.points);
        let now = exact.acceleration(response.time, &weak.points);
        let change = later.iter().zip(&now).map(|(later, now)| later - now).collect();
        weak.paired(&weak.per_volume(change)).iter().map(|it| it / scale).collect()
    });
    let is_part =
        response.computed == Computed::NodalResidual && response.without != Without::default();
    let interpolated =
        is_part.then(|| weak.interpolated(&response.without).iter().map(|it| it / scale).collect());
    let methods: Vec<Vec<f64>> = drift.into_iter().chain(interpolated).collect();
    let most = floor + methods.iter().map(|it| size(it)).fold(0.0, f64::max);
    let error = Error::new(all, methods, Vec::new(), floor);
    let make = |hypothesis: &Hypothesis<D>, at: &[f64]| {
        if let (Change::Start(change), Some(step)) = (&hypothesis.change, response.step) {
            let mut v = exact.velocity(response.time, &weak.points);
            let given = Given {
                exact,
                size: at,
                time: response.time,
                reference: &weak.points,
                gradient: &[],
            };
            let right = v.clone();
            change(&given, MotionPart::Velocity(&mut v));
            let change = v.iter().zip(right).map(|(v, right)| (v - right) / step).collect();
            return weak.paired(&weak.per_volume(change)).iter().map(|it| it / scale).collect();
        }
        let density = match (&hypothesis.change, at) {
            (Change::Density | Change::Mass, [factor, ..]) => *factor,
            _ => 1.0,
        };
        let sums = weak.sums(&Changed::with(exact, response.without, hypothesis, at));
        let wrong = weak.computed(response, &sums, density);
        less(&wrong, 1.0, &right).iter().map(|it| it / scale).collect::<Vec<f64>>()
    };
    let explained: Vec<_> = hypotheses
        .iter()
        .enumerate()
        .filter(|(_, it)| is_shown(&it.change))
        .filter_map(|(index, hypothesis)| explain(index, hypothesis, &error, &make))
        .collect();
    let mut cannot_be_seen = unseen(hypotheses, &explained, floor.min(1e-6));
    let others = hypotheses.iter().filter(|it| !is_shown(&it.change));
    cannot_be_seen.extend(others.map(|it| it.name.to_owned()));
    cannot_be_seen.dedup();
    let (found, excess) = (size(&error.all), error.excess());
    let ranked = ranked(
        exact,
        hypotheses,
        explained.clone(),
        0.0,
        &["another term left out (`--without`)", "another field"],
    );
    let limits = Limits { excess: [1.0; 2], left: [LEFT; 2], nearer: [NEARER; 2] };
    let finding = limits.finding(&ranked, excess);
    Ok(Diagnosis {
        finding,
        rung: if response.step.is_some() { Rung::Step } else { Rung::State(response.computed) },
        ranked,
        cannot_be_seen,
        error: found,
        expected: [floor, most],
        pair: (finding == Finding::Unexplained)
            .then(|| pair::best(&error, hypotheses, &explained))
            .flatten(),
        like: None,
        place: None,
        fields: None,
    })
}
