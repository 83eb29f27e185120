//! Diagnosis of ordinary results: compares their error at some times with the errors that mistakes make in our own runs.

use mms_runtime::Fill;
use mms_runtime::body::{Filling, bounding_box};
use mms_runtime::study::Solve;

use crate::answer::{
    Diagnosis, DiagnosisFinding, Explained, Fields, Like, Limits, Ranked, Rung, ranked, unseen,
};
use crate::evidence::{ComparisonFrame, Mesh};
use crate::exact::Exact;
use crate::falls::OfOrder;
use crate::hypothesis::{Change, Hypothesis, earlier_velocity};
use crate::level::{Levels, MeshLevel, on_all_processors};
use crate::pair;
use crate::place;
use crate::rank::{Effect, Error, explain, explain_usual};
use crate::run::{OTHERS, Obstacle};
use crate::smooth::{less, nearest, size};
use crate::solver::Solver;

/// Points along an axis at which errors are shown, in one to three dimensions.
const SHOWN: [f64; 3] = [64.0, 16.0, 6.0];
/// The largest difference that storage makes in results of one solver, relative to the solution.
const ROUNDING: f64 = 1e-6;
/// The error of a method counts as at least this times (h/length)^2, relative to the solution, since our methods make no error
/// on some fields.
const LEAST: f64 = 2.0;
/// An error is like a method's error if they differ by no more than this part of it.
const NEAR: f64 = 0.25;
/// The least share of the error that a linearised response must explain for the nonlinear response to be computed.
const LIKELY: f64 = 0.5;
/// The least share with which an error is explained, so that large mistakes are not searched.
const EXPLAINED: f64 = 0.9;
/// The least share with which a hypothesis is tried with other methods.
const PROMISING: f64 = 0.5;

/// The comparison of results with every hypothesis.
struct HypothesisSearch<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    frame: &'a ComparisonFrame<D>,
    levels: Levels<'a, D>,
    hypotheses: &'a [Hypothesis<D>],
    /// The right methods that an error may be like.
    yardsticks: Vec<usize>,
    /// The error to be explained.
    error: Error,
}

impl<'a, const D: usize> HypothesisSearch<'a, D>
where
    f64: Solve<D>,
{
    fn new(
        exact: &'a Exact<'a, D>,
        frame: &'a ComparisonFrame<D>,
        levels: Levels<'a, D>,
        hypotheses: &'a [Hypothesis<D>],
        solver: &Solver,
    ) -> Self {
        let own = |level: &MeshLevel<'_, D>| Some(level.seen.coefficients.clone());
        let right = |method| levels.together(|level| level.right(method));
        let free = levels.together(|level| earlier(exact, &levels, level));
        let free = free.filter(|it| size(it) > 0.0);
        let edge = exact.length() / levels.fine.mesh.cell_size;
        let is_asked = solver.like.is_some();
        // The error of a method cancels against a right run of the same solver.
        let yardsticks = if solver.is_compared_with_right_run {
            Vec::new()
        } else {
            yardsticks(&levels, is_asked)
        };
        let floor = match solver.is_compared_with_right_run {
            true => ROUNDING,
            false => LEAST / edge.powi(levels.degree() as i32 + 1),
        };
        // Methods of degree 1 do not show the errors of elements of degree 2.
        let known = if levels.degree() > 1 && !is_asked { &[] } else { yardsticks.as_slice() };
        let error = Error::new(
            levels.together(own).unwrap_or_default(),
            known.iter().filter_map(|it| right(*it)).collect(),
            free.filter(|_| !solver.is_compared_with_right_run).into_iter().collect(),
            floor,
        );
        HypothesisSearch { exact, frame, levels, hypotheses, yardsticks, error }
    }

    /// The sorted errors of right methods on the finest mesh; the floor if there are none.
    fn ordinary(&self) -> Vec<f64> {
        let errors = self.yardsticks.iter().filter_map(|it| self.levels.fine.right(*it));
        let mut sizes: Vec<f64> = errors.map(|it| size(&it)).collect();
        sizes.sort_by(f64::total_cmp);
        if sizes.is_empty() { vec![self.error.floor] } else { sizes }
    }

    /// The least error of a right method; for elements of degree 2 the floor, since methods of degree 1 do not show it.
    fn least(&self, ordinary: &[f64]) -> f64 {
        if self.levels.degree() > 1 { self.error.floor } else { ordinary[0] }
    }

    /// The largest error that counts as one of a right method. Elements of degree 2 make at most the error of the best method
    /// of degree 1.
    fn most(&self, ordinary: &[f64], falls: bool) -> f64 {
        let largest = match self.levels.degree() {
            2.. => ordinary[0],
            _ => ordinary[ordinary.len() - 1],
        };
        let times = match (falls, self.levels.are_two()) {
            (true, _) => TIMES_FALLING,
            (false, true) => TIMES_OF_TWO,
            (false, false) => TIMES_OF_ONE,
        };
        times * largest.max(self.error.floor)
    }

    /// A right method whose error falls with about this order.
    fn of_order(&self, order: f64) -> Option<OfOrder> {
        // A method whose error does not fall is not right.
        if self.levels.degree() > 1 || order < LEAST_ORDER {
            return None;
        }
        let mut all = (0..self.levels.fine.solvers.methods())
            .filter_map(|method| Some((method, self.levels.order_of(method)?)));
        let (method, order) = all.find(|(_, own)| (own - order).abs() <= SAME_ORDER)?;
        Some(OfOrder { method: self.levels.fine.solvers.described(method)?, order })
    }

    /// The error that a hypothesis of this size makes with a method, less the error of a right solver.
    fn response(&self, method: usize, hypothesis: &Hypothesis<D>, at: &[f64]) -> Option<Vec<f64>> {
        self.levels.together(|level| self.levels.wrong(level, method, hypothesis, at))
    }

    /// The user's error on the finest mesh and the error of a hypothesis of some size, as fields for plots.
    fn fields(&self, named: Option<(&Hypothesis<D>, &[f64])>) -> Option<Fields> {
        let [lower, upper] = bounding_box(&self.exact.domain.body).ok()?;
        let spacing = (upper - lower) / SHOWN[D - 1];
        let points = Filling::new(&self.exact.domain.body, Fill::Fitted, &spacing).ok()?.position;
        let of = |coefficients: &[f64]| self.frame.values(coefficients, &points);
        let fine = &self.levels.fine;
        let named = named.and_then(|(it, at)| of(&self.levels.wrong(fine, 0, it, at)?));
        Some(Fields {
            quantity: self.frame.quantities.first()?.0.name(),
            time: *self.frame.times.last()?,
            error: of(&fine.seen.coefficients)?,
            named,
            points: points.iter().map(|x| x.as_slice().to_vec()).collect(),
        })
    }

    /// The method whose error on such a grid is nearest; if the user named a method, that method.
    fn like(&self, is_asked: bool) -> Option<Like> {
        let fine = &self.levels.fine;
        let last = fine.solvers.methods() - 1;
        let first = if is_asked { last } else { 0 };
        let earlier = earlier(self.exact, &self.levels, fine).filter(|it| size(it) > 0.0);
        let free: Vec<_> = earlier.into_iter().collect();
        let all = (first..=last).filter_map(|method| {
            let error = fine.right(method)?;
            let mut own = fine.seen.coefficients.clone();
            let mut apart = less(&own, 1.0, &error);
            for (column, part) in free.iter().zip(nearest(&free, &apart)) {
                (apart, own) = (less(&apart, part, column), less(&own, part, column));
            }
            Some(Like {
                method: fine.solvers.described(method)?,
                factor: size(&own) / size(&error),
                apart: size(&apart) / size(&own),
            })
        });
        let best = all.min_by(|a, b| a.apart.total_cmp(&b.apart))?;
        (is_asked || best.apart <= NEAR).then_some(best)
    }

    /// Finds the part of the error that each hypothesis explains, on all processors. If none explains it, large mistakes
    /// are tried: the response to a large mistake is no multiple of the response to a small one.
    fn explain_all(&self, is_right: bool) -> Result<Vec<Explained>, Obstacle> {
        let seen: Vec<_> = self.frame.quantities.iter().map(|(it, _)| *it).collect();
        let each =
            |says: &str, of: &(dyn Fn(usize, &Hypothesis<D>) -> Option<Explained> + Sync)| {
                let one = |index: usize| {
                    Some(&self.hypotheses[index])
                        .filter(|it| it.is_of(&seen))
                        .and_then(|it| of(index, it))
                };
                on_all_processors(self.hypotheses.len(), (says, self.exact.follow), one)
            };
        let mut all = each("mistake", &|index, it| explain(index, it, &self.error, self))?;
        // A mistake of output with a fitted offset or factor may explain much by chance, so it does not end the search.
        let is_output =
            |it: &Explained| matches!(self.hypotheses[it.hypothesis].change, Change::Output(_));
        let explains = |it: &Explained| it.share >= EXPLAINED && !is_output(it);
        if is_right || all.iter().flatten().any(explains) {
            return Ok(all.into_iter().flatten().collect());
        }
        let large = each("large mistake", &|index, it| {
            explain_usual(index, it, &self.error, self, &it.usual(self.exact))
        })?;
        for (first, large) in all.iter_mut().zip(large) {
            let share = |it: &Option<Explained>| it.as_ref().map_or(f64::MIN, |it| it.share);
            if share(&large) > share(first) {
                *first = large;
            }
        }
        Ok(all.into_iter().flatten().collect())
    }
}

/// The right methods that results are compared with: methods of second order in time whose error falls on this field, or the
/// one method that the user named.
fn yardsticks<const D: usize>(levels: &Levels<'_, D>, is_asked: bool) -> Vec<usize>
where
    f64: Solve<D>,
{
    let solvers = &levels.fine.solvers;
    let last = solvers.methods() - 1;
    // A method without an error on this field has no order.
    let converges =
        |it: &usize| levels.order_of(*it).is_some_and(|it| it.is_nan() || it >= CONVERGES);
    let is_known = |it: &usize| solvers.is_of_second_order(*it) && converges(it);
    match is_asked {
        true => vec![last],
        false => (0..=last).filter(is_known).collect(),
    }
}

/// The error of velocities that are half a step earlier, as leapfrog has them: any multiple of it is no mistake.
fn earlier<'a, const D: usize>(
    exact: &Exact<'_, D>,
    levels: &Levels<'a, D>,
    level: &MeshLevel<'a, D>,
) -> Option<Vec<f64>>
where
    f64: Solve<D>,
{
    levels.wrong(level, 0, &earlier_velocity(), &[exact.time_step / 2.0])
}

impl<const D: usize> Effect<D> for HypothesisSearch<'_, D>
where
    f64: Solve<D>,
{
    fn response(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<f64>> {
        let rough = self.levels.together(|level| self.levels.roughly(level, hypothesis, size));
        let Some(rough) = rough else { return self.response(0, hypothesis, size) };
        let directions = [rough];
        let (_, remains) = self.error.explain(&directions, &[]);
        let [rough] = directions;
        if self.error.share(&remains) < LIKELY {
            return Some(rough);
        }
        self.response(0, hypothesis, size).or(Some(rough))
    }

    /// The differences of other methods' responses from the first's; none for output or a hypothesis that explains too little.
    fn method_differences(
        &self,
        hypothesis: &Hypothesis<D>,
        sizes: &[Vec<f64>],
        responses: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        let (_, remains) = self.error.explain(responses, &[]);
        let is_output = matches!(hypothesis.change, Change::Output(_));
        if is_output || self.error.share(&remains) < PROMISING {
            return Vec::new();
        }
        let methods = self.levels.fine.solvers.methods();
        let is_there = |it: &usize| *it < methods;
        let pairs = sizes.iter().zip(responses);
        let doubts = |(at, first): (&Vec<f64>, &Vec<f64>)| {
            let other = |method| Some(less(&self.response(method, hypothesis, at)?, 1.0, first));
            OTHERS.into_iter().filter(is_there).filter_map(other).collect::<Vec<_>>()
        };
        pairs.flat_map(doubts).collect()
    }
}

/// The limits within which a mistake is named. A mistake without a fitted size that explains an error is named even if the
/// error is small, because right solvers do not make such errors. On one mesh the error of a method may look like a mistake of
/// some size, and on two meshes so may an error that falls with the method's order.
const OF_ONE: Limits = Limits { excess: [0.05, 1.0], left: [0.35, 0.12], nearer: [1.3, 0.95] };
const OF_TWO: Limits = Limits { excess: [0.05, 0.4], left: [0.35, 0.15], nearer: [1.3, 0.95] };
/// If the order is wrong, there is a mistake, and the ratio of its error to the methods' error does not matter.
const OF_WRONG_ORDER: Limits =
    Limits { excess: [0.05, 0.05], left: [0.35, 0.25], nearer: [1.3, 0.95] };
/// The largest ratio of an error that counts as the error of a right method to the errors of our right methods, on one mesh.
const TIMES_OF_ONE: f64 = 4.0;
/// The largest such ratio on two meshes.
const TIMES_OF_TWO: f64 = 3.0;
/// The largest such ratio for an error that falls with the expected order.
const TIMES_FALLING: f64 = 10.0;
/// The least order with which an error on two meshes is almost only the error of the method.
const VANISHES: f64 = 1.5;
/// The least order of a method that converges.
const CONVERGES: f64 = 1.4;
/// Orders that differ by less may belong to one method.
const SAME_ORDER: f64 = 0.15;

/// The least order of an error that falls.
const LEAST_ORDER: f64 = 0.25;

/// Diagnoses ordinary results of meshes, from coarse to fine, with the known facts about their solver.
///
/// # Errors
/// Results that cannot be diagnosed.
pub fn diagnose<const D: usize>(
    exact: &Exact<'_, D>,
    frame: &ComparisonFrame<D>,
    meshes: &[Mesh],
    hypotheses: &[Hypothesis<D>],
    solver: &Solver,
) -> Result<Diagnosis, Obstacle>
where
    f64: Solve<D>,
{
    let (like, falls) = (solver.like.as_ref(), solver.falls.as_ref());
    let levels = Levels::new(exact, frame, meshes, like)?;
    let look = HypothesisSearch::new(exact, frame, levels, hypotheses, solver);
    let explained = look.explain_all(falls.is_some_and(|it| it.is_right))?;
    let seen = &look.levels.fine.seen;
    let (error, ordinary) = (size(&seen.coefficients), look.ordinary());
    let mut needs = Vec::new();
    if meshes.len() < 2 {
        needs.push("a second mesh");
    }
    if frame.times.len() < 2 {
        needs.push("a second time");
    }
    needs.push("accelerations at an exact state");
    let middle = ordinary[ordinary.len() / 2];
    let ranked = ranked(exact, hypotheses, explained.clone(), middle, &needs);
    let limits = match falls {
        Some(falls) if !falls.is_right => OF_WRONG_ORDER,
        _ if look.levels.are_two() => OF_TWO,
        _ => OF_ONE,
    };
    // A method's error, such as an error of the wave speed, may look like a factor.
    let order = look.levels.order();
    let vanishes = match falls {
        Some(falls) => falls.is_right,
        // If the error is 0, it has no order.
        None => {
            solver.is_compared_with_right_run
                || order.is_none_or(|it| it.is_nan() || it >= VANISHES)
        }
    };
    let is_of_method = vanishes && error <= middle;
    let most = look.most(&ordinary, vanishes && order.is_some());
    let like = look.like(like.is_some());
    let is_free = ranked.first().is_some_and(Ranked::is_free);
    let finding = match limits.finding(&ranked, look.error.excess()) {
        DiagnosisFinding::Named if is_of_method && is_free => DiagnosisFinding::Nothing,
        // Right methods that do not converge on this field make such errors.
        DiagnosisFinding::Named if !vanishes && is_free && like.is_some() => {
            DiagnosisFinding::Unexplained
        }
        DiagnosisFinding::Named => DiagnosisFinding::Named,
        _ if vanishes && error <= most => DiagnosisFinding::Nothing,
        _ => DiagnosisFinding::Unexplained,
    };
    let named = ranked.first().filter(|_| finding == DiagnosisFinding::Named);
    // The remaining error hides anything smaller.
    let left = match (finding, named) {
        (DiagnosisFinding::Nothing, _) => size(&look.error.all),
        (_, Some(best)) => size(&look.error.beyond) * (1.0 - best.explained).max(0.0).sqrt(),
        _ => size(&look.error.beyond),
    };
    let cannot_be_seen = unseen(hypotheses, &explained, left.max(look.error.floor));
    let fields = look.fields(named.map(|it| (&hypotheses[it.hypothesis], it.factor.as_slice())));
    let wrong = falls.filter(|it| !it.is_right).and_then(|it| it.observed);
    Ok(Diagnosis {
        finding,
        rung: Rung::Results,
        ranked,
        cannot_be_seen,
        error,
        expected: [look.least(&ordinary), most],
        falls: falls.cloned(),
        of_order: wrong.and_then(|it| look.of_order(it)),
        pair: (finding == DiagnosisFinding::Unexplained)
            .then(|| pair::best(&look.error, hypotheses, &explained))
            .flatten(),
        like,
        place: place::of(exact, meshes, seen.share),
        fields,
    })
}
