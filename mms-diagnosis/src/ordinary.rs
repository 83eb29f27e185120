//! Diagnosis of ordinary results: the error at some times, beside those that mistakes make in runs of our own.

use mms_runtime::body::{Filling, bounding_box};
use mms_runtime::study::Solve;
use mms_runtime::{Fill, Method};

use crate::answer::{
    Diagnosis, Explained, Fields, Finding, Like, Limits, Ranked, Rung, ranked, unseen,
};
use crate::evidence::{Frame, Mesh};
use crate::exact::Exact;
use crate::hypothesis::{Change, Hypothesis, earlier_velocity};
use crate::level::{Level, Levels, on_all_processors};
use crate::pair;
use crate::place;
use crate::rank::{Effect, Error, explain};
use crate::run::{OTHERS, Obstacle};
use crate::smooth::{less, nearest, size};

/// Points along an axis at which errors are shown, in one to three dimensions.
const SHOWN: [f64; 3] = [64.0, 16.0, 6.0];
/// What a method makes at least, over the solution: so many times (h/length)^2. Some fields have none in ours.
const LEAST: f64 = 2.0;
/// An error is like that of a method if they are no further apart than this part of it.
const NEAR: f64 = 0.25;
/// From this part on a hypothesis is looked at by other methods.
const PROMISING: f64 = 0.5;

/// Looks at results with every hypothesis.
struct Look<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    frame: &'a Frame<D>,
    levels: Levels<'a, D>,
    hypotheses: &'a [Hypothesis<D>],
    /// What is explained.
    error: Error,
}

impl<'a, const D: usize> Look<'a, D>
where
    f64: Solve<D>,
{
    fn new(
        exact: &'a Exact<'a, D>,
        frame: &'a Frame<D>,
        levels: Levels<'a, D>,
        hypotheses: &'a [Hypothesis<D>],
    ) -> Self {
        let own = |level: &Level<'_, D>| Some(level.seen.coefficients.clone());
        let right = |method| levels.together(|level| level.right(method));
        let free = levels.together(|level| earlier(exact, &levels, level));
        let free = free.filter(|it| size(it) > 0.0);
        let edge = levels.fine.plan.length() / levels.fine.mesh.cell_size;
        let error = Error::new(
            levels.together(own).unwrap_or_default(),
            (0..levels.fine.plan.methods()).filter_map(right).collect(),
            free.into_iter().collect(),
            LEAST / (edge * edge),
        );
        Look { exact, frame, levels, hypotheses, error }
    }

    /// The errors that right methods of ours would make on the finest mesh, from the least to the largest.
    fn ordinary(&self) -> Vec<f64> {
        let fine = &self.levels.fine;
        let methods = (0..fine.plan.methods()).filter(|it| fine.plan.is_of_second_order(*it));
        let mut sizes: Vec<f64> = methods.filter_map(|it| Some(size(&fine.right(it)?))).collect();
        sizes.sort_by(f64::total_cmp);
        if sizes.is_empty() { vec![self.error.floor] } else { sizes }
    }

    /// Whether an error may be that of a right method, though none of ours has such a one: on two meshes it falls as that of one
    /// of second order, or falls and is not much larger than those of ours, or is about that of the middle one.
    fn is_ordinary(&self, error: f64, ordinary: &[f64]) -> bool {
        let times = UNEXPLAINED[usize::from(self.levels.are_two())];
        let most = |of: usize| error <= times * ordinary[of].max(self.error.floor);
        let order = self.levels.order();
        let falls = order.is_none_or(|order| order >= FALLS);
        order.is_some_and(|order| order >= VANISHES)
            || most(ordinary.len() - 1) && (falls || most(ordinary.len() / 2))
    }

    /// The error that a hypothesis of this size makes by a method, less that of a right solver.
    fn by(&self, method: usize, hypothesis: &Hypothesis<D>, at: &[f64]) -> Option<Vec<f64>> {
        self.levels.together(|level| self.levels.wrong(level, method, hypothesis, at))
    }

    /// The user's error on the finest mesh, and that of a hypothesis of some size, to be looked at.
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

    /// The method whose error on such a grid is nearest; if one was asked for, that.
    fn like(&self, is_asked: bool) -> Option<Like> {
        let fine = &self.levels.fine;
        let last = fine.plan.methods() - 1;
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
                method: fine.plan.described(method),
                factor: size(&own) / size(&error),
                apart: size(&apart) / size(&own),
            })
        });
        let best = all.min_by(|a, b| a.apart.total_cmp(&b.apart))?;
        (is_asked || best.apart <= NEAR).then_some(best)
    }

    /// What each hypothesis explains, on all processors.
    fn all(&self) -> Vec<Explained> {
        let one = |index: usize| explain(index, &self.hypotheses[index], &self.error, self);
        on_all_processors(self.hypotheses.len(), one).into_iter().flatten().collect()
    }
}

/// What velocities of half a step earlier add on a mesh, as leapfrog has them: any amount of that is no mistake.
fn earlier<'a, const D: usize>(
    exact: &Exact<'_, D>,
    levels: &Levels<'a, D>,
    level: &Level<'a, D>,
) -> Option<Vec<f64>>
where
    f64: Solve<D>,
{
    levels.wrong(level, 0, &earlier_velocity(), &[exact.time_step / 2.0])
}

impl<const D: usize> Effect<D> for Look<'_, D>
where
    f64: Solve<D>,
{
    fn response(&self, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<f64>> {
        self.by(0, hypothesis, size)
    }

    /// By how much responses are others by the second method. Nothing where they explain too little to be looked at again.
    fn doubts(
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
        let pairs = sizes.iter().zip(responses);
        let doubts = |(at, first): (&Vec<f64>, &Vec<f64>)| {
            let other = |method| Some(less(&self.by(method, hypothesis, at)?, 1.0, first));
            OTHERS.into_iter().filter_map(other).collect::<Vec<_>>()
        };
        pairs.flat_map(doubts).collect()
    }
}

/// When a mistake is named, on one mesh and on two. What has no size to be fitted and explains an error is there, however small it
/// is: right solvers do not make such errors. On one mesh the error of a method may look like a mistake of some size, and so may on
/// two what falls with its order.
const LIMITS: [Limits; 2] = [
    Limits { excess: [0.05, 1.0], left: [0.35, 0.12], nearer: [1.3, 0.95] },
    Limits { excess: [0.05, 0.4], left: [0.35, 0.15], nearer: [1.3, 0.95] },
];
/// An error that no hypothesis explains is not held against a solver, where it is no larger than so many times that of right
/// methods of ours: on one mesh and on two.
const UNEXPLAINED: [f64; 2] = [4.0, 3.0];
/// Errors that fall with these orders from mesh to mesh are those of a method, or hold next to nothing else.
const FALLS: f64 = 0.7;
const VANISHES: f64 = 1.5;

/// Diagnoses ordinary results of meshes, from coarse to fine; `like` is a method that they may be of.
///
/// # Errors
/// Results with which that is not possible.
pub fn diagnose<const D: usize>(
    exact: &Exact<'_, D>,
    frame: &Frame<D>,
    meshes: &[Mesh],
    hypotheses: &[Hypothesis<D>],
    like: Option<&Method>,
) -> Result<Diagnosis, Obstacle>
where
    f64: Solve<D>,
{
    let look = Look::new(exact, frame, Levels::new(exact, frame, meshes, like)?, hypotheses);
    let explained = look.all();
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
    let kind = usize::from(look.levels.are_two());
    // What may be the error of a method, as that of a wave's speed, may look like a factor.
    let is_of_method = look.levels.order().is_none_or(|order| order >= VANISHES) && error <= middle;
    let finding = match LIMITS[kind].finding(&ranked, look.error.excess()) {
        Finding::Named if is_of_method && ranked.first().is_some_and(Ranked::is_free) => {
            Finding::Nothing
        }
        Finding::Unexplained if look.is_ordinary(error, &ordinary) => Finding::Nothing,
        found => found,
    };
    let named = ranked.first().filter(|_| finding == Finding::Named);
    // Behind what is left of the error anything smaller is hidden.
    let left = match (finding, named) {
        (Finding::Nothing, _) => size(&look.error.all),
        (_, Some(best)) => size(&look.error.beyond) * (1.0 - best.explained).max(0.0).sqrt(),
        _ => size(&look.error.beyond),
    };
    let cannot_be_seen = unseen(hypotheses, &explained, left.max(look.error.floor));
    let fields = look.fields(named.map(|it| (&hypotheses[it.hypothesis], it.factor.as_slice())));
    Ok(Diagnosis {
        finding,
        rung: Rung::Results,
        ranked,
        cannot_be_seen,
        error,
        expected: [ordinary[0], ordinary[ordinary.len() - 1]],
        pair: (finding == Finding::Unexplained)
            .then(|| pair::best(&look.error, hypotheses, &explained))
            .flatten(),
        like: look.like(like.is_some()),
        place: place::of(exact, meshes, seen.share),
        fields,
    })
}
