//! Diagnosis of ordinary results: the error at some times, beside those that mistakes make in runs of our own.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

use mms_runtime::body::{Filling, bounding_box};
use mms_runtime::study::Solve;
use mms_runtime::{Fill, Method};

use crate::answer::{Diagnosis, Explained, Fields, Finding, Like, Rung, finding, ranked, unseen};
use crate::changed::Without;
use crate::evidence::{self, Frame, Mesh};
use crate::exact::{Exact, Quantity, vectors};
use crate::hypothesis::{Change, Hypothesis};
use crate::pair;
use crate::place;
use crate::rank::{Effect, Error, explain};
use crate::run::{Obstacle, Plan, written};
use crate::smooth::{less, nearest, size};

/// A mesh is finer than another by this factor at least.
const REFINED: f64 = 1.2;
/// How much of what falls with h^2 from mesh to mesh is looked at, where two meshes tell it from what does not.
const FALLING: f64 = 0.25;
/// Points along an axis at which errors are shown, in one to three dimensions.
const SHOWN: [f64; 3] = [64.0, 16.0, 6.0];
/// What a method makes at least, over the solution: so many times (h/length)^2. Some fields have none in ours.
const LEAST: f64 = 2.0;
/// An error is like that of a method if they are no further apart than this part of it.
const NEAR: f64 = 0.25;
/// From this part on a hypothesis is looked at by other methods, and these.
const PROMISING: f64 = 0.5;
const OTHERS: [usize; 3] = [1, 4, 8];

/// One mesh of a user's, and runs of our own on a grid of about that size.
struct Level<'a, const D: usize> {
    mesh: &'a Mesh,
    plan: Plan<'a, D>,
    /// The errors of right methods; `None` of one that stops.
    right: Vec<Option<Vec<f64>>>,
}

impl<'a, const D: usize> Level<'a, D>
where
    f64: Solve<D>,
{
    fn new(
        exact: &'a Exact<'a, D>,
        frame: &'a Frame<D>,
        mesh: &'a Mesh,
        like: Option<&Method>,
    ) -> Result<Self, Obstacle> {
        let plan = Plan::new(exact, frame, mesh, Without::default(), like)?;
        let right = on_all_processors(plan.methods(), |method| plan.right(method));
        Ok(Level { mesh, plan, right })
    }

    /// What a right method would make on the mesh.
    fn scaled(&self, method: usize) -> Option<Vec<f64>> {
        let ratio = (self.mesh.cell_size / self.plan.cell_size()).powi(2);
        self.right[method].as_ref().map(|it| it.iter().map(|it| it * ratio).collect())
    }
}

/// What velocities of so much earlier add to the errors of a mesh.
fn half_step<const D: usize>(
    exact: &Exact<'_, D>,
    frame: &Frame<D>,
    mesh: &Mesh,
    before: f64,
) -> Option<Vec<f64>> {
    let seen = frame.see(|at, quantity| {
        let snapshot = evidence::nearest(mesh, frame.times[at])?;
        let points = vectors(&snapshot.reference);
        let of = |time: f64| exact.values(quantity, time, &points);
        let before = if quantity == Quantity::Velocity { before } else { 0.0 };
        let pairs = of(snapshot.time - before).into_iter().zip(of(snapshot.time));
        let change = pairs.map(|(earlier, now)| earlier - now).collect();
        Some((points, change))
    });
    seen.map(|it| it.coefficients)
}

/// Looks at results with every hypothesis.
pub struct Look<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    frame: &'a Frame<D>,
    fine: Level<'a, D>,
    coarse: Option<Level<'a, D>>,
    /// The hypotheses.
    pub hypotheses: &'a [Hypothesis<D>],
    /// The error on the finest mesh.
    pub errors: Vec<f64>,
    /// Which part of its square is smooth.
    pub smooth: f64,
    /// The largest that a right method of ours would make there.
    pub ordinary: f64,
    /// What velocities of half a step earlier add to it.
    half_step: Vec<f64>,
    /// What is explained.
    pub error: Error,
}

impl<'a, const D: usize> Look<'a, D>
where
    f64: Solve<D>,
{
    /// Of results of meshes, from coarse to fine, and a method that they may be of.
    pub fn new(
        exact: &'a Exact<'a, D>,
        frame: &'a Frame<D>,
        meshes: &'a [Mesh],
        hypotheses: &'a [Hypothesis<D>],
        like: Option<&Method>,
    ) -> Result<Self, Obstacle> {
        let mesh = meshes.last().ok_or(Obstacle::NotFinite)?;
        let of = |mesh: &Mesh| frame.errors_of(exact, mesh).ok_or(Obstacle::NotFinite);
        let fine = Level::new(exact, frame, mesh, like)?;
        let is_coarser = |it: &&Mesh| it.cell_size > REFINED * mesh.cell_size;
        let coarse = meshes.iter().rev().find(is_coarser);
        let coarse_errors = coarse.map(of).transpose()?.map(|it| it.coefficients);
        let coarse = coarse.map(|mesh| Level::new(exact, frame, mesh, like)).transpose()?;
        let seen = of(mesh)?;
        let edge = fine.plan.length() / mesh.cell_size;
        let floor = LEAST / (edge * edge);
        let all = 0..fine.plan.methods();
        let of_second_order = all.clone().filter(|it| fine.plan.is_of_second_order(*it));
        let sizes = of_second_order.filter_map(|it| Some(size(&fine.scaled(it)?)));
        let ordinary = sizes.fold(floor, f64::max);
        let mut look = Look {
            exact,
            frame,
            fine,
            coarse,
            hypotheses,
            errors: seen.coefficients.clone(),
            smooth: seen.share,
            ordinary,
            half_step: Vec::new(),
            error: Error::new(Vec::new(), Vec::new(), Vec::new(), floor),
        };
        let both = |method: usize| {
            let coarse = look.coarse.as_ref().map(|it| it.scaled(method));
            Some(look.together(look.fine.scaled(method)?, coarse.unwrap_or(Some(Vec::new()))?))
        };
        let methods = all.filter_map(both).collect();
        let all = look.together(seen.coefficients, coarse_errors.unwrap_or_default());
        look.half_step = half_step(exact, frame, mesh, 0.5 * exact.time_step).unwrap_or_default();
        let free = look.free();
        look.error = Error::new(all, methods, free, floor);
        Ok(look)
    }

    /// What velocities of half a step earlier add, as leapfrog has them: that is no mistake.
    fn free(&self) -> Vec<Vec<f64>> {
        let before =
            |mesh: &Mesh| 0.5 * self.exact.time_step * mesh.cell_size / self.fine.mesh.cell_size;
        let of = |mesh: &Mesh| half_step(self.exact, self.frame, mesh, before(mesh));
        let coarse = self.coarse.as_ref().map_or(Some(Vec::new()), |it| of(it.mesh));
        let both = coarse.map(|coarse| self.together(self.half_step.clone(), coarse));
        both.filter(|it| size(it) > 0.0).into_iter().collect()
    }

    /// Errors on two meshes as what does not fall with h^2, and a part of what does; of one mesh as they are.
    fn together(&self, fine: Vec<f64>, coarse: Vec<f64>) -> Vec<f64> {
        let Some(level) = &self.coarse else { return fine };
        let ratio = (level.mesh.cell_size / self.fine.mesh.cell_size).powi(2);
        let length = ratio.hypot(1.0);
        let pairs = || fine.iter().zip(&coarse);
        let steady = pairs().map(|(fine, coarse)| (ratio * fine - coarse) / length);
        let falling = pairs().map(|(fine, coarse)| FALLING * (fine + ratio * coarse) / length);
        steady.chain(falling).collect()
    }

    /// The error that a hypothesis of this size makes by a method, less that of a right solver.
    fn by(&self, method: usize, hypothesis: &Hypothesis<D>, at: &[f64]) -> Option<Vec<f64>> {
        let on = |level: &Level<'_, D>| self.on(level, method, hypothesis, at);
        let coarse = self.coarse.as_ref().map_or(Some(Vec::new()), on)?;
        Some(self.together(on(&self.fine)?, coarse))
    }

    /// The same on one mesh.
    fn on(
        &self,
        level: &Level<'_, D>,
        method: usize,
        hypothesis: &Hypothesis<D>,
        at: &[f64],
    ) -> Option<Vec<f64>> {
        let ratio = level.mesh.cell_size / self.fine.mesh.cell_size;
        let factor = if hypothesis.is_of_mesh { ratio } else { 1.0 };
        let at: Vec<f64> = at.iter().map(|it| it * factor).collect();
        if let Change::Output(_) = hypothesis.change {
            return written(self.exact, self.frame, level.mesh, hypothesis, &at);
        }
        let wrong = level.plan.wrong(method, hypothesis, &at)?;
        Some(less(&wrong, 1.0, level.right[method].as_ref()?))
    }

    /// The user's error on the finest mesh, and that of a hypothesis of some size, to be looked at.
    fn fields(&self, named: Option<(&Hypothesis<D>, &[f64])>) -> Option<Fields> {
        let [lower, upper] = bounding_box(&self.exact.domain.body).ok()?;
        let spacing = (upper - lower) / SHOWN[D - 1];
        let points = Filling::new(&self.exact.domain.body, Fill::Fitted, &spacing).ok()?.position;
        let of = |coefficients: &[f64]| self.frame.values(coefficients, &points);
        let named = named.and_then(|(it, at)| of(&self.on(&self.fine, 0, it, at)?));
        Some(Fields {
            quantity: self.frame.quantities.first()?.0.name(),
            time: *self.frame.times.last()?,
            error: of(&self.errors)?,
            named,
            points: points.iter().map(|x| x.as_slice().to_vec()).collect(),
        })
    }

    /// The method whose error on such a grid is nearest; if one was asked for, that.
    pub fn like(&self, is_asked: bool) -> Option<Like> {
        let last = self.fine.plan.methods() - 1;
        let first = if is_asked { last } else { 0 };
        let free = [self.half_step.clone()];
        let free = if size(&free[0]) > 0.0 { &free[..] } else { &[] };
        let all = (first..=last).filter_map(|method| {
            let error = self.fine.scaled(method)?;
            let mut apart = less(&self.errors, 1.0, &error);
            let mut own = self.errors.clone();
            for (column, part) in free.iter().zip(nearest(free, &apart)) {
                (apart, own) = (less(&apart, part, column), less(&own, part, column));
            }
            Some(Like {
                method: self.fine.plan.described(method),
                factor: size(&own) / size(&error),
                apart: size(&apart) / size(&own),
            })
        });
        let best = all.min_by(|a, b| a.apart.total_cmp(&b.apart))?;
        (is_asked || best.apart <= NEAR).then_some(best)
    }

    /// What each hypothesis explains, on all processors.
    pub fn all(&self) -> Vec<Explained> {
        let one = |index: usize| explain(index, &self.hypotheses[index], &self.error, self);
        on_all_processors(self.hypotheses.len(), one).into_iter().flatten().collect()
    }
}

/// What a function makes of the numbers below `count`, in their order.
fn on_all_processors<T: Send>(count: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let worker = || {
        let take = || Some(next.fetch_add(1, Relaxed)).filter(|it| *it < count);
        std::iter::from_fn(take).map(|at| (at, of(at))).collect::<Vec<_>>()
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let mut all: Vec<(usize, T)> = thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
        workers.into_iter().flat_map(|it| it.join().expect("a run that ends")).collect()
    });
    all.sort_by_key(|(at, _)| *at);
    all.into_iter().map(|(_, it)| it).collect()
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

/// Which part of the error a mistake that is named may leave: one that has no size, and one whose size was found.
const LEFT: [f64; 2] = [0.25, 0.12];
/// And over what a hypothesis of a size that it cannot have leaves.
const NEARER: f64 = 0.95;
/// An error that no hypothesis explains is not held against a solver, where it is no larger than so many times that of right
/// methods of ours: on one mesh and on two.
const UNEXPLAINED: [f64; 2] = [4.0, 3.0];

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
    let look = Look::new(exact, frame, meshes, hypotheses, like)?;
    let explained = look.all();
    let (error, expected) = (size(&look.errors), look.ordinary);
    let mut needs = Vec::new();
    if meshes.len() < 2 {
        needs.push("a second mesh");
    }
    if frame.times.len() < 2 {
        needs.push("a second time");
    }
    needs.push("accelerations at an exact state");
    let ranked = ranked(exact, hypotheses, explained.clone(), &needs);
    let kind = usize::from(look.coarse.is_some());
    let finding = match finding(&ranked, look.error.excess(), LEFT, NEARER) {
        Finding::Unexplained if error <= UNEXPLAINED[kind] * expected => Finding::Nothing,
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
        expected,
        pair: (finding == Finding::Unexplained)
            .then(|| pair::best(&look.error, hypotheses, &explained))
            .flatten(),
        like: look.like(like.is_some()),
        place: place::of(exact, meshes, look.smooth),
        fields,
    })
}
