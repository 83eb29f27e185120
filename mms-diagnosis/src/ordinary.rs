//! Diagnosis of ordinary results: the error at some times, beside those that mistakes make in runs of our own.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;

use mms_runtime::study::Solve;

use crate::answer::{Diagnosis, Explained, Finding, finding, ranked, unseen};
use crate::changed::Without;
use crate::evidence::{Frame, Mesh};
use crate::exact::Exact;
use crate::hypothesis::{Change, Hypothesis};
use crate::rank::{Effect, Error, explain};
use crate::run::{Obstacle, Plan, written};
use crate::smooth::{less, size};

/// A mesh is finer than another by this factor at least.
const REFINED: f64 = 1.2;
/// By how much the error that differs from mesh to mesh may be larger than that of our own method.
const APART: f64 = 2.0;
/// What a method makes at least, over the solution: so many times (h/length)^2. Some fields have none in ours.
const LEAST: f64 = 2.0;
/// From this part on it is looked at by a second method.
const PROMISING: f64 = 0.3;

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
    fn by(&self, method: usize, hypothesis: &Hypothesis<D>, size: &[f64]) -> Option<Vec<f64>> {
        if let Change::Output(_) = hypothesis.change {
            return written(self.exact, self.frame, self.mesh, hypothesis, size);
        }
        Some(less(&self.plan.wrong(method, hypothesis, size)?, 1.0, &self.right[method]))
    }

    /// What each hypothesis explains, on all processors.
    pub fn all(&self) -> Vec<Explained> {
        let next = AtomicUsize::new(0);
        let take = || {
            (0..).map(|_| next.fetch_add(1, Relaxed)).take_while(|it| *it < self.hypotheses.len())
        };
        let worker = || {
            take()
                .filter_map(|index| explain(index, &self.hypotheses[index], &self.error, self))
                .collect::<Vec<_>>()
        };
        let threads = thread::available_parallelism().map_or(1, usize::from);
        let mut all: Vec<Explained> = thread::scope(|scope| {
            let workers: Vec<_> = (0..threads).map(|_| scope.spawn(worker)).collect();
            workers.into_iter().flat_map(|it| it.join().expect("a hypothesis that ends")).collect()
        });
        all.sort_by_key(|it| it.hypothesis);
        all
    }
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
        let doubt = |(at, first): (&Vec<f64>, &Vec<f64>)| {
            Some(less(&self.by(1, hypothesis, at)?, 1.0, first))
        };
        pairs.filter_map(doubt).collect()
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
    Ok(Diagnosis { finding, evidence: "results", ranked, cannot_be_seen, error, expected })
}
