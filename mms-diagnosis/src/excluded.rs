//! Mistakes that results with a small error exclude, because they would have made an error twice as large.
//!
//! The error of a mistake is the error that it adds to a run of this project's own solver, on a grid no finer than the grid of
//! the results. It is measured as the error of the results is: a root mean square over the body, the largest over times. For a
//! field without time it is the error that the mistake adds [at equilibrium](crate::statics).
//!
//! Each mistake is first tried with cells of twice the size, if they are not too few. A run then takes a quarter of the time or
//! less. If a mistake has no size, and its error is far from the noticed one, that decides. A size is corrected on the finer grid.

use std::sync::Arc;

use mms_runtime::Fill;
use mms_runtime::body::{Filling, bounding_box};
use mms_runtime::study::Solve;

use crate::changed::Without;
use crate::evidence::{ComparisonFrame, Mesh, Snapshot};
use crate::exact::{Exact, Quantity};
use crate::hypothesis::{Hypothesis, HypothesisKind, Size, title};
use crate::level::on_all_processors;
use crate::run::{Obstacle, Responses, SolverRuns, written};
use crate::smooth::{self, Smooth, less};
use crate::statics::{Equilibrium, Statics};

/// Results with known errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// h of the finest mesh.
    pub cell_size: f64,
    /// The time step of the finest mesh, if it is known.
    pub time_step: Option<f64>,
    /// The times.
    pub times: Vec<f64>,
    /// The quantities, each with its root mean square error on the finest mesh, the largest over the times.
    pub errors: Vec<(Quantity, f64)>,
    /// Whether the results are of an equilibrium, and not of a motion.
    pub is_static: bool,
}

/// The mistakes of one kind that the results would have shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum VisibleSizes {
    /// The results show the mistake: its error is this multiple of the results' error, or, if `None`, it stops the solver.
    Always(Option<f64>),
    /// The results show sizes that differ by more than this from the right one.
    From {
        /// The size of a right solver.
        right: f64,
        /// The least difference that is shown.
        least: f64,
    },
    /// The results do not show the mistake: its error, or the error of its largest possible size, is this multiple of the
    /// results' error, less than [`NOTICED`].
    Never(f64),
}

/// A mistake, and whether it is excluded.
#[derive(Clone, Debug, PartialEq)]
pub struct Excluded {
    /// The name, with the variant.
    pub name: String,
    /// The name, with the variant and the face.
    pub title: String,
    /// The description of the mistake.
    pub says: &'static str,
    /// Whether it is a mistake or a choice.
    pub kind: HypothesisKind,
    /// Whether the results would have shown it.
    pub shown: VisibleSizes,
}

impl Excluded {
    /// Whether the mistake is excluded, at all sizes or from some size on.
    pub fn is_excluded(&self) -> bool {
        !matches!(self.shown, VisibleSizes::Never(_))
    }
}

/// The least ratio of the error of a mistake that is noticed to the error of the results. A larger error moves the order of the
/// sum away from the order of a right solver, even if it cancels a part of the right error. A factor of 1.65 is enough if the
/// error does not fall with h, the right error has order 2, and meshes are refined by 2. The rest of the factor covers the
/// uncertainty of a run on another mesh.
pub const NOTICED: f64 = 2.0;

/// The most steps times particles of one run: a fraction of a second, for about a hundred runs.
const MOST_WORK: f64 = 3e5;

/// The runs that are compared.
struct Runs<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    frame: &'a ComparisonFrame<D>,
    mesh: &'a Mesh,
    /// From the coarsest grid to the finest.
    solvers: Vec<Solvers<'a, D>>,
    errors: &'a [(Quantity, f64)],
}

/// Two ways to compute the errors that a mistake adds.
enum Solvers<'a, const D: usize> {
    /// A run with the mistake, and one without, by a method of the plan.
    Runs { plan: Box<dyn Responses<'a, D> + 'a>, method: usize, right: Vec<Vec<f64>> },
    /// Equilibrium with the mistake.
    Rest(Statics<'a, D>),
}

impl<'a, const D: usize> Solvers<'a, D>
where
    f64: Solve<D>,
{
    /// Plans the runs, from the coarsest grid to the finest.
    fn all(
        exact: &'a Exact<'a, D>,
        frame: &'a ComparisonFrame<D>,
        mesh: &'a Mesh,
        is_static: bool,
    ) -> Result<Vec<Self>, Obstacle> {
        if is_static && exact.space.is_some() {
            return Err(Obstacle::Axisymmetric("results at rest"));
        }
        if is_static {
            let equilibrium = Equilibrium::new(exact, frame)?.ok_or(Obstacle::NotHeld)?;
            return Ok(vec![Solvers::Rest(Statics::new(Arc::new(equilibrium), frame, mesh))]);
        }
        let plan = SolverRuns::new(exact, frame, mesh, Without::default(), None, MOST_WORK)?;
        // Linear functions stop where a curved face cuts off a small part of a cell.
        let mut methods = 0..plan.methods();
        let first = methods.find_map(|method| Some((method, plan.right(method)?)));
        let (method, right) = match first {
            Some(first) => first,
            None if exact.follow.is_stopped() => return Err(Obstacle::Stopped),
            None => return Err(Obstacle::AllStop),
        };
        let coarse = plan.may_be_coarser().then(|| plan.coarser()).and_then(|plan| {
            let coarse = plan.right(method)?;
            let mut pairs = coarse.iter().zip(&right);
            // A run that nearly stops has errors of its own.
            let is_sound =
                pairs.all(|(coarse, fine)| smooth::size(coarse) <= UNSURE * smooth::size(fine));
            is_sound.then_some(Solvers::Runs { plan, method, right: coarse })
        });
        let fine = Solvers::Runs { plan: Box::new(plan), method, right };
        Ok(coarse.into_iter().chain([fine]).collect())
    }

    /// The errors that a mistake adds, for each time and quantity; `None` if it stops the solver.
    fn added(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<Vec<f64>>> {
        match self {
            Solvers::Runs { plan, method, right } => {
                let wrong = plan.wrong(*method, hypothesis, size)?;
                Some(wrong.iter().zip(right).map(|(a, b)| less(a, 1.0, b)).collect())
            }
            Solvers::Rest(statics) => statics.added(hypothesis, size),
        }
    }
}

/// Lists for each hypothesis whether a study of a field excludes it.
///
/// # Errors
/// Runs that would take too long, or that stop without a mistake, by each method.
pub fn excluded<const D: usize>(
    exact: &Exact<'_, D>,
    study: &Study,
    hypotheses: &[Hypothesis<D>],
) -> Result<Vec<Excluded>, Obstacle>
where
    f64: Solve<D>,
{
    let mesh = places(exact, study)?;
    let snapshots: Vec<&Snapshot> = mesh.snapshots.iter().collect();
    // Errors are compared point by point: no smooth functions are fitted to them.
    let none = Smooth::new(&exact.domain.body, 1, [0; 3])?;
    let frame = ComparisonFrame::new(exact, &snapshots, none);
    if frame.times.is_empty() {
        return Err(Obstacle::AtStart);
    }
    let solvers = Solvers::all(exact, &frame, &mesh, study.is_static)?;
    let runs = Runs { exact, frame: &frame, mesh: &mesh, solvers, errors: &study.errors };
    // Large sizes of a mistake are hypotheses of their own; excluding them adds no information.
    let own: Vec<_> = study.errors.iter().map(|(quantity, _)| *quantity).collect();
    let is_own = |it: &&Hypothesis<D>| it.also.is_empty() && it.is_of(&own);
    let hypotheses: Vec<_> = hypotheses.iter().filter(is_own).collect();
    let one = |at: usize| {
        let it = hypotheses[at];
        Excluded {
            name: title(it.name, it.which.as_deref(), None),
            title: it.title(),
            says: it.says,
            kind: it.kind,
            shown: runs.shown(it),
        }
    };
    on_all_processors(hypotheses.len(), ("mistake to exclude", exact.follow), one)
}

/// Points all over the body, at the times of a study.
fn places<const D: usize>(exact: &Exact<'_, D>, study: &Study) -> Result<Mesh, Obstacle> {
    let [lower, upper] = bounding_box(&exact.domain.body)?;
    let spacing = (upper - lower) / POINTS[D - 1];
    let points = Filling::new(&exact.domain.body, Fill::Fitted, &spacing)?.position;
    let reference: Vec<f64> = points.iter().flat_map(|x| x.iter().copied()).collect();
    let values = || study.errors.iter().map(|(quantity, _)| (*quantity, Vec::new())).collect();
    let snapshot = |time: &f64| Snapshot {
        time: *time,
        reference: reference.clone(),
        values: values(),
        ..Snapshot::default()
    };
    Ok(Mesh {
        cell_size: study.cell_size,
        time_step: study.time_step,
        snapshots: study.times.iter().map(snapshot).collect(),
    })
}

/// Points along an axis at which errors are compared, in one to three dimensions.
const POINTS: [f64; 3] = [64.0, 24.0, 10.0];

impl<const D: usize> Runs<'_, D>
where
    f64: Solve<D>,
{
    fn shown(&self, hypothesis: &Hypothesis<D>) -> VisibleSizes {
        let Size::Any { right, first, .. } = &hypothesis.size else {
            let mut times = None;
            for solvers in &self.solvers {
                times = self.times(solvers, hypothesis, &[]);
                if times.is_some_and(|it| it * UNSURE < NOTICED || NOTICED * UNSURE < it) {
                    break;
                }
            }
            return match times {
                Some(times) if times < NOTICED => VisibleSizes::Never(times),
                times => VisibleSizes::Always(times),
            };
        };
        let least = |axis: usize| {
            let mut step = first[axis] - right[axis];
            let farthest = FARTHEST * step.abs();
            for solvers in &self.solvers {
                let from = step.clamp(-farthest, farthest);
                step = self.least(solvers, hypothesis, (right, axis), from);
                if step.is_infinite() {
                    break;
                }
            }
            step.abs()
        };
        // For a vector, the size that is shown in every direction.
        let least = (0..right.len()).map(least).fold(0.0, f64::max);
        let farthest = hypothesis.farthest();
        match least < farthest {
            true => VisibleSizes::From { right: right[0], least },
            // The mistake adds nothing at any size.
            false if least.is_infinite() => VisibleSizes::Never(0.0),
            false => VisibleSizes::Never(NOTICED * farthest / least),
        }
    }

    /// The least difference from the right size along an axis that is shown, in the direction of `step`, the first estimate;
    /// infinite if the mistake adds nothing at any size. Later estimates assume that the error is proportional to the difference.
    fn least(
        &self,
        solvers: &Solvers<'_, D>,
        hypothesis: &Hypothesis<D>,
        (right, axis): (&[f64], usize),
        mut step: f64,
    ) -> f64 {
        let mut last = f64::INFINITY;
        for _ in 0..ROUNDS {
            let mut at = right.to_vec();
            at[axis] += step;
            match self.times(solvers, hypothesis, &at) {
                Some(times) if times > 0.0 => {
                    let times = times / NOTICED;
                    last = step / times;
                    if (times - 1.0).abs() < NEAR {
                        break;
                    }
                    // The step is limited, since the estimate may be far away.
                    step = (step / times).clamp(-FARTHEST * step.abs(), FARTHEST * step.abs());
                }
                Some(_) => return f64::INFINITY,
                // So large a mistake stops the solver.
                None => (step, last) = (step / FARTHEST, step),
            }
        }
        last
    }

    /// The error of a mistake divided by the error of the results, in the quantity that shows it best; `None` if it stops the
    /// solver.
    fn times(
        &self,
        solvers: &Solvers<'_, D>,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
    ) -> Option<f64> {
        let own = match written(self.exact, self.frame, self.mesh, hypothesis, size) {
            Some(errors) => errors,
            None => solvers.added(hypothesis, size)?,
        };
        let each = self.frame.each().zip(&own).zip(self.frame.quantities.iter().cycle());
        let times = each.map(|(((_, quantity), added), (_, size))| {
            let count = added.len() / quantity.components(D);
            let mean = added.iter().map(|it| it * it).sum::<f64>() / count.max(1) as f64;
            let error = self.errors.iter().find(|(it, _)| *it == quantity);
            mean.sqrt() / error.map_or(f64::INFINITY, |(_, error)| error.max(f64::EPSILON * size))
        });
        let times: Vec<f64> = times.collect();
        let is_finite = times.iter().all(|it| it.is_finite());
        is_finite.then(|| times.into_iter().fold(0.0, f64::max))
    }
}

/// The factor around the noticed error within which larger cells do not decide. An error that falls with h^3 is this many times
/// as large on cells of twice the size.
const UNSURE: f64 = 8.0;
/// The most runs in the search for a size.
const ROUNDS: usize = 3;
/// The search ends if the error of a mistake is within this part of the noticed one.
const NEAR: f64 = 0.2;
/// The largest factor by which a size changes in one step.
const FARTHEST: f64 = 1e3;
