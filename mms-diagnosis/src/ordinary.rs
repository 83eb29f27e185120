//! Diagnosis of ordinary results: the error at some times, beside those that mistakes make in runs of our own.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

use mms_runtime::study::Solve;

use crate::answer::{Diagnosis, Explained, Finding, finding, ranked, unseen};
use crate::changed::Without;
use crate::evidence::{Frame, Mesh};
use crate::exact::Exact;
use crate::hypothesis::{Change, Hypothesis, Size};
use crate::rank::{Error, SAME};
use crate::run::{Obstacle, Plan, written};
use crate::smooth::{less, size};

/// A mesh is finer than another by this factor at least.
const REFINED: f64 = 1.2;
/// By how much the error that differs from mesh to mesh may be larger than that of our own method.
const APART: f64 = 2.0;
/// What a method makes at least, over the solution: so many times (h/length)^2. Some fields have none in ours.
const LEAST: f64 = 2.0;
/// How often the size of a hypothesis is mended.
const MENDS: usize = 4;
/// From this part of the error on a hypothesis is worth mending.
const WORTH: f64 = 0.5;
/// From this part on it is looked at by a second method.
const PROMISING: f64 = 0.3;
/// A size is found when the response has to be scaled by no more than this.
const FOUND: f64 = 0.02;

/// Looks at results with every hypothesis.
pub struct Look<'a, const D: usize> {
    exact: &'a Exact<'a, D>,
    frame: &'a Frame<D>,
    mesh: &'a Mesh,
    plan: Plan<'a, D>,
    /// The hypotheses.
    pub hypotheses: &'a [Hypothesis<D>],
    /// The errors of a right run of our own.
    pub right: [Vec<f64>; 2],
    /// What is explained.
    pub error: Error,
}

impl<'a, const D: usize> Look<'a, D>
where
    f64: Solve<D>,
{
    /// Of results of meshes, from coarse to fine.
    pub fn new(
        exact: &'a Exact<'a, D>,
        frame: &'a Frame<D>,
        meshes: &'a [Mesh],
        hypotheses: &'a [Hypothesis<D>],
    ) -> Result<Self, Obstacle> {
        let plan = Plan::new(exact, frame, Without::default())?;
        let mesh = meshes.last().ok_or(Obstacle::NotFinite)?;
        let of = |mesh: &Mesh| {
            let seen = frame.errors_of(exact, mesh).ok_or(Obstacle::NotFinite)?;
            Ok(seen.coefficients)
        };
        let all_of = of(mesh)?;
        let right = [0, 1].map(|method| plan.right(method).unwrap_or(vec![0.0; all_of.len()]));
        let ratio = (mesh.cell_size / plan.cell_size()).powi(2);
        let own: Vec<f64> = right[0].iter().map(|it| it * ratio).collect();
        let method = match meshes {
            [.., coarse, fine] if coarse.cell_size > REFINED * fine.cell_size => {
                let ratio = (coarse.cell_size / fine.cell_size).powi(2) - 1.0;
                let coarse = of(coarse)?;
                let theirs: Vec<f64> =
                    less(&coarse, 1.0, &all_of).iter().map(|it| it / ratio).collect();
                // A mistake that is a part of the time step falls with it: what differs from mesh to mesh is not all
                // of the method, where ours makes much less, and most of the error would be left.
                let left = size(&less(&all_of, 1.0, &theirs));
                let is_all = size(&theirs) <= APART * size(&own) || left <= size(&theirs);
                if is_all { theirs } else { own }
            }
            _ => own,
        };
        let edge = plan.length() / mesh.cell_size;
        let floor = LEAST / (edge * edge);
        Ok(Look {
            exact,
            frame,
            mesh,
            plan,
            hypotheses,
            right,
            error: Error { all: all_of, method, floor },
        })
    }

    /// The error that a hypothesis of this size makes by a method, less that of a right solver.
    fn response(
        &self,
        method: usize,
        hypothesis: &Hypothesis<D>,
        size: &[f64],
    ) -> Option<Vec<f64>> {
        if let Change::Output(_) = hypothesis.change {
            return written(self.exact, self.frame, self.mesh, hypothesis, size);
        }
        Some(less(&self.plan.wrong(method, hypothesis, size)?, 1.0, &self.right[method]))
    }

    /// By how much responses are others by another method. Nothing where they explain too little to be looked at again.
    fn doubts(
        &self,
        hypothesis: &Hypothesis<D>,
        sizes: &[Vec<f64>],
        responses: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        let (_, remains) = self.error.explain(responses, &[]);
        if matches!(hypothesis.change, Change::Output(_)) || self.error.share(&remains) < PROMISING
        {
            return Vec::new();
        }
        let pairs = sizes.iter().zip(responses);
        let doubt = |(at, first): (&Vec<f64>, &Vec<f64>)| {
            Some(less(&self.response(1, hypothesis, at)?, 1.0, first))
        };
        pairs.filter_map(doubt).collect()
    }

    /// What a hypothesis explains; `None` where it has no response that can be found.
    pub fn explain(&self, index: usize) -> Option<Explained> {
        match &self.hypotheses[index].size {
            Size::Fixed => self.sized(index, 0.0, 1.0),
            Size::Any { right, first, .. } if right.len() == 1 => {
                self.sized(index, right[0], first[0])
            }
            Size::Any { right, first, .. } => self.vector(index, right, first),
        }
    }

    /// What each hypothesis explains, on all processors.
    pub fn all(&self) -> Vec<Explained> {
        let next = AtomicUsize::new(0);
        let take = || {
            (0..).map(|_| next.fetch_add(1, Relaxed)).take_while(|it| *it < self.hypotheses.len())
        };
        let worker = || take().filter_map(|index| self.explain(index)).collect::<Vec<_>>();
        let threads = thread::available_parallelism().map_or(1, usize::from);
        let mut all: Vec<Explained> = thread::scope(|scope| {
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
            workers.into_iter().flat_map(|it| it.join().expect("a hypothesis that ends")).collect()
        });
        all.sort_by_key(|it| it.hypothesis);
        all
    }

    /// A hypothesis with one number: its size is mended until the response need not be scaled.
    fn sized(&self, index: usize, right: f64, first: f64) -> Option<Explained> {
        let hypothesis = &self.hypotheses[index];
        let is_fixed = hypothesis.size == Size::Fixed;
        let mut at = first;
        let mut best: Option<Explained> = None;
        for _ in 0..MENDS {
            let Some(response) = self.response(0, hypothesis, &[at]) else { break };
            let response = [response];
            let doubts = self.doubts(hypothesis, &[vec![at]], &response);
            let (scale, remains) = self.error.explain(&response, &doubts);
            let ([response], scale) = (response, scale[0]);
            let share = self.error.share(&remains);
            let margin =
                size(&remains) / size(&response).max(f64::MIN_POSITIVE) * (at - right).abs();
            let found = hypothesis.rescaled(right, at, scale);
            let size = if is_fixed { Vec::new() } else { vec![found] };
            let explained = Explained { hypothesis: index, size, margin, scale, share, response };
            if best.as_ref().is_none_or(|best| explained.share > best.share - SAME) {
                best = Some(explained);
            }
            if is_fixed || share < WORTH || (scale - 1.0).abs() < FOUND || !found.is_finite() {
                break;
            }
            at = found;
        }
        best
    }

    /// A hypothesis with a vector, taken as linear.
    fn vector(&self, index: usize, right: &[f64], first: &[f64]) -> Option<Explained> {
        let hypothesis = &self.hypotheses[index];
        let along = |axis: usize| {
            let mut at = right.to_vec();
            at[axis] = first[axis];
            at
        };
        let sizes: Vec<_> = (0..right.len()).map(along).collect();
        let responses = sizes.iter().map(|at| self.response(0, hypothesis, at));
        let responses: Vec<_> = responses.collect::<Option<_>>()?;
        let doubts = self.doubts(hypothesis, &sizes, &responses);
        let (scales, remains) = self.error.explain(&responses, &doubts);
        let share = self.error.share(&remains);
        let steps = right.iter().zip(first).zip(&scales);
        let found: Vec<f64> =
            steps.map(|((right, first), scale)| right + scale * (first - right)).collect();
        let mut response = vec![0.0; self.error.all.len()];
        for (column, scale) in responses.iter().zip(&scales) {
            response = less(&response, -scale, column);
        }
        let margin = size(&remains) / size(&response).max(f64::MIN_POSITIVE) * size(&found);
        Some(Explained { hypothesis: index, size: found, margin, scale: 1.0, share, response })
    }
}

/// Errors on one mesh that are no larger than this, times what a right solver of ours makes, are ordinary: those that a mistake
/// explains, and those that none does.
const NAMED: f64 = 3.0;
const UNEXPLAINED: f64 = 8.0;

/// Diagnoses ordinary results of meshes, from coarse to fine.
///
/// # Errors
/// Results with which that is not possible.
pub fn diagnose<const D: usize>(
    exact: &Exact<'_, D>,
    frame: &Frame<D>,
    meshes: &[Mesh],
    hypotheses: &[Hypothesis<D>],
) -> Result<Diagnosis, Obstacle>
where
    f64: Solve<D>,
{
    let look = Look::new(exact, frame, meshes, hypotheses)?;
    let explained = look.all();
    let ratio = (look.mesh.cell_size / look.plan.cell_size()).powi(2);
    let own = look.right.iter().map(|right| size(right)).fold(0.0, f64::max) * ratio;
    let expected = size(&look.error.method).max(own).max(look.error.floor);
    let error = size(&look.error.all);
    let mut needs = Vec::new();
    if meshes.len() < 2 {
        needs.push("a second mesh");
    }
    if frame.times.len() < 2 {
        needs.push("a second time");
    }
    needs.push("accelerations at an exact state");
    let cannot_be_seen = unseen(hypotheses, &explained, size(&look.error.method).max(1e-9));
    let ranked = ranked(exact, hypotheses, explained, &needs);
    let finding = match finding(&ranked, look.error.excess()) {
        // With one mesh, what the user's method makes is known from ours alone.
        Finding::Named if meshes.len() < 2 && error <= NAMED * expected => Finding::Nothing,
        Finding::Unexplained if meshes.len() < 2 && error <= UNEXPLAINED * expected => {
            Finding::Nothing
        }
        found => found,
    };
    Ok(Diagnosis {
        finding,
        evidence: "results",
        ranked,
        pair: None,
        cannot_be_seen,
        error,
        expected,
        notes: Vec::new(),
    })
}
