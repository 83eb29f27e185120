//! Diagnosis of accelerations or residuals at an exact state, in the weak form.
//!
//! Values of a right solver at points need not be near the exact ones: on irregular meshes they are not, but their sums with
//! smooth functions w are. So the balance is evaluated for such sums: int rho0 a.w = -int P:grad w + int rho0 b.w + int T.w
//! over faces with tractions, with w = 0 where the motion is given. Every mistake in b, P, T or rho0 changes the sums in a way
//! that is known without a solver.

use mms_runtime::{Refusal, Vector};

pub use crate::answer::Computed;
use crate::answer::{Diagnosis, DiagnosisFinding, Limits, Rung, ranked, unseen};
use crate::changed::{Changed, Without};
use crate::exact::Exact;
use crate::hypothesis::{Change, Given, Hypothesis, MotionPart};
use crate::pair;
use crate::rank::{Error, explain};
use crate::smooth::{less, size};
use crate::weak::{OfElements, Right, Weak, add};

/// Accelerations or residuals of a solver at an exact state.
#[derive(Clone, Debug)]
pub struct Response {
    /// The kind of the values.
    pub computed: Computed,
    /// The time of the state.
    pub time: f64,
    /// X, point by point.
    pub reference: Vec<f64>,
    /// The values, point by point.
    pub values: Vec<f64>,
    /// The volume of each point; `None` if all have the same volume, or if the values are integrated already.
    pub volumes: Option<Vec<f64>>,
    /// The terms that were left out.
    pub without: Without,
    /// The degree of the cells, where these are known.
    pub degree: Option<u32>,
    /// The step over which accelerations are the mean, if they come from velocities after one step.
    pub step: Option<f64>,
}

/// The part of the error that a named mistake may leave.
const LEFT: f64 = 0.2;
/// The largest ratio of the error left to the error that an impossible size leaves. At one state several mistakes have the same
/// effect.
const NEARER: f64 = 1.3;
/// The additional error that right methods may make, divided by the size of the terms of elements of degree 1: for residuals,
/// and for accelerations, which depend on their neighbours if the mass is consistent.
const METHOD: [f64; 2] = [0.75, 1.25];
/// The rounding that the sums may contain, relative to the largest sum.
const ARITHMETIC: f64 = 1e-10;

impl Response {
    /// The sums of the values less the sums `right` of a right solver; and the error of these sums from scatter between points:
    /// half the difference between sums over every second point and over the others.
    fn error<const D: usize>(&self, weak: &Weak<'_, D>, right: &[f64]) -> [Vec<f64>; 2] {
        let points: Vec<Vector<f64, D>> = crate::exact::vectors(&self.reference);
        let total: f64 = weak.quadrature.volumes.iter().sum();
        let even = match self.computed {
            Computed::Acceleration | Computed::Residual => total / points.len().max(1) as f64,
            Computed::NodalResidual => 1.0,
        };
        let values = crate::exact::vectors(&self.values);
        let values = match self.computed {
            Computed::Acceleration => weak.per_volume(&points, values),
            Computed::Residual | Computed::NodalResidual => values,
        };
        // The smooth part of the right values is subtracted at the points, so that the user's sums need not be exact for it.
        let own = self.smooth_part(weak, &weak.quadrature.points);
        let at_points = self.smooth_part(weak, &points);
        let mut halves = [vec![0.0; weak.count()], vec![0.0; weak.count()]];
        for (at, x) in points.iter().enumerate() {
            let volume = self.volumes.as_ref().map_or(even, |it| it[at]);
            let smooth = at_points.get(at).copied().unwrap_or(Vector::zeros());
            add(&mut halves[at % 2], &weak.functions(x), &((values[at] - smooth) * volume));
        }
        let rest =
            if own.is_empty() { right.to_vec() } else { less(right, 1.0, &weak.integrate(&own)) };
        let [first, second] = halves;
        let all = less(&less(&first, -1.0, &second), 1.0, &rest);
        [all, less(&first, 1.0, &second)]
    }

    /// The values per volume of a right solver in the body, without tractions on faces; empty for values at nodes, because the
    /// volume of a node is not known here.
    fn smooth_part<const D: usize>(
        &self,
        weak: &Weak<'_, D>,
        x: &[Vector<f64, D>],
    ) -> Vec<Vector<f64, D>> {
        match self.computed {
            Computed::Acceleration => weak.applied(&self.without, x),
            Computed::Residual => weak.residual(&self.without, x),
            Computed::NodalResidual => Vec::new(),
        }
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
    let right = Right::new(exact, response.time, response.reference.len() / D, response.without)?;
    let Right { weak, sums, relative_error: off } = &right;
    let is_shown = |change: &Change<D>| match change {
        Change::Force(_) | Change::Stress(..) | Change::Surface(_) => true,
        Change::Loads(..) | Change::Density => true,
        // After one step, a wrong mass acts like a start at another time.
        Change::Mass => response.step.is_none(),
        Change::Start(_) => response.step.is_some(),
        Change::Condition(_) | Change::Output(_) | Change::Wall(_) => false,
        Change::Tangent(_) | Change::Order(_) => false,
        Change::InSpace(_) | Change::Ring(_) => false,
    };
    let right = sums.computed(response.computed, 1.0);
    let scale = sums.scale();
    let scaled = |it: Vec<f64>| -> Vec<f64> { it.iter().map(|it| it / scale).collect() };
    let [all, scatter] = response.error(weak, &right).map(scaled);
    // Within a step, an integrator may use the acceleration of any time.
    let drift = response.step.map(|step| {
        let x = &weak.quadrature.points;
        let later = exact.acceleration(response.time + step, x);
        let now = exact.acceleration(response.time, x);
        let change = later.iter().zip(&now).map(|(later, now)| later - now).collect();
        scaled(weak.integrate(&weak.per_volume(x, change)))
    });
    let OfElements { methods, size: of_elements } =
        weak.of_elements(response.computed, &response.without);
    // The error of elements of degree 2 is of order h^3, of elements of degree 1 h^2.
    let is_solved = response.computed == Computed::Acceleration;
    let smooth = METHOD[usize::from(is_solved)] * of_elements / scale;
    let (methods, smooth) = match response.degree {
        Some(2..) => (Vec::new(), smooth * smooth.min(1.0).sqrt()),
        _ => (methods.into_iter().map(scaled).collect(), smooth),
    };
    // With cells, the volume of each point is known; without them the sums scatter.
    let scatter = if response.degree.is_some() { 0.0 } else { size(&scatter) };
    let floor = [smooth, scatter, *off, ARITHMETIC].into_iter().fold(0.0, f64::hypot);
    let methods: Vec<Vec<f64>> = drift.into_iter().chain(methods).collect();
    let most = floor + methods.iter().map(|it| size(it)).fold(0.0, f64::max);
    let error = Error::new(all, methods, Vec::new(), floor);
    let make = |hypothesis: &Hypothesis<D>, at: &[f64]| {
        if let (Change::Start(change), Some(step)) = (&hypothesis.change, response.step) {
            let x = &weak.quadrature.points;
            let mut v = exact.velocity(response.time, x);
            let given = Given { exact, size: at, time: response.time, reference: x, gradient: &[] };
            let right = v.clone();
            change(&given, MotionPart::Velocity(&mut v));
            let change = v.iter().zip(right).map(|(v, right)| (v - right) / step).collect();
            return scaled(weak.integrate(&weak.per_volume(x, change)));
        }
        let density = match (&hypothesis.change, at) {
            (Change::Density | Change::Mass, [factor, ..]) => *factor,
            _ => 1.0,
        };
        let sums = weak.sums(&Changed::with(exact, response.without, hypothesis, at));
        scaled(less(&sums.computed(response.computed, density), 1.0, &right))
    };
    let explained: Vec<_> = hypotheses
        .iter()
        .enumerate()
        .filter(|(_, it)| is_shown(&it.change))
        .take_while(|_| !exact.follow.is_stopped())
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
        falls: None,
        of_order: None,
        pair: (finding == DiagnosisFinding::Unexplained)
            .then(|| pair::best(&error, hypotheses, &explained))
            .flatten(),
        like: None,
        place: None,
        fields: None,
    })
}
