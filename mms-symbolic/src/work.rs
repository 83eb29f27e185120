//! A budget of steps for the work that a text may cause.
//!
//! Work is counted in steps of about ten nanoseconds, and never in seconds, so that the same text ends at the same place on
//! every machine. A graph has one budget. Making nodes, counting pairs to share, and running a program all draw on it;
//! `mms-program/src/operation_cost.rs` has the steps of an operation in intervals and in 77 digits. In a proof, a value for
//! which no budget is left is not a number, so it proves nothing and refutes nothing. Comparisons in 77 digits are then made at
//! fewer points, or at none, which does not count as a pass. So `mms check` ends within ten seconds of processor time for any
//! text, and lists the parts that it left out. The fields of the gallery use a tenth of each budget or less, except for some of
//! the rates.
//!
//! A `Stop` from another thread empties every budget. A compilation then ends with one diagnostic that says so, a proof with
//! less proved. A field compiled before the stop has to be compiled anew.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Stops a compilation, a proof or a comparison from another thread.
///
/// The waiting thread keeps a copy, and another copy is part of the compilation's options. After the request, running work ends
/// soon: a compilation with one diagnostic that says so, proofs with less proved.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Requests the stop; this cannot be undone.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether a stop has been requested.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// A compilation does not depend on its handle for stopping, so all handles are equal.
impl PartialEq for Stop {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Stop {}

/// The remaining steps of a budget. A step is about ten nanoseconds of work: an operation on intervals takes a few.
///
/// Handles of one budget draw on the same steps; a clone with its graph has a budget of its own.
#[derive(Debug, Default)]
pub struct Work {
    left: Arc<AtomicU64>,
    stop: Stop,
}

impl Work {
    /// A budget without a limit, until one is set.
    pub fn new(stop: Stop) -> Self {
        Work { left: Arc::new(AtomicU64::new(u64::MAX)), stop }
    }

    /// Another handle of the same budget.
    pub fn share(&self) -> Self {
        Work { left: Arc::clone(&self.left), stop: self.stop.clone() }
    }

    /// Sets the number of remaining steps.
    pub fn allow(&self, steps: u64) {
        self.left.store(steps, Ordering::Relaxed);
    }

    /// The number of remaining steps.
    pub fn left(&self) -> u64 {
        if self.stop.is_asked() { 0 } else { self.left.load(Ordering::Relaxed) }
    }

    /// Spends these steps, or all that remain.
    pub fn spend(&self, steps: u64) {
        // A budget is spent by one thread: nothing is lost between load and store.
        let left = self.left.load(Ordering::Relaxed);
        self.left.store(left.saturating_sub(steps), Ordering::Relaxed);
    }

    /// Runs `work` with `steps` steps of its own, which do not reduce the budget.
    pub fn with_own_budget<R>(&self, steps: u64, work: impl FnOnce() -> R) -> R {
        let left = self.left.load(Ordering::Relaxed);
        self.allow(steps);
        let made = work();
        self.allow(left);
        made
    }

    /// Whether no steps remain.
    pub fn is_over(&self) -> bool {
        self.left() == 0
    }

    /// The handle for requesting a stop.
    pub fn stop(&self) -> &Stop {
        &self.stop
    }
}

impl Clone for Work {
    fn clone(&self) -> Self {
        let work = Work::new(self.stop.clone());
        work.allow(self.left.load(Ordering::Relaxed));
        work
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn handles_share_what_clones_have_apart() {
        let work = Work::new(Stop::default());
        work.allow(10);
        let (shared, own) = (work.share(), work.clone());
        shared.spend(7);
        own.spend(20);
        assert_eq!((work.left(), shared.left(), own.left()), (3, 3, 0));
        assert!(own.is_over() && !work.is_over());
        assert!(work.with_own_budget(1, || (work.spend(1), work.is_over()).1));
        assert_eq!(work.left(), 3);
    }

    #[test]
    fn who_is_asked_to_stop_has_nothing_left() {
        let stop = Stop::default();
        let work = Work::new(stop.clone());
        assert!(!work.is_over());
        stop.ask();
        assert!(work.is_over() && work.clone().stop().is_asked());
    }
}
