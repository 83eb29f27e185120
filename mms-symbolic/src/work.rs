//! A budget of steps for the work that a text may cause.
//!
//! Work is counted in steps of about ten nanoseconds, and never in seconds, so that the same text ends at the same
//! place on every machine. A graph has one budget. Who makes nodes, counts pairs to share, or runs a program
//! within it is charged for what that takes; `program/effort.rs` says what an operation takes in intervals and in
//! 77 digits. In a proof, what there is no budget left for is not a number, so it proves nothing and refutes
//! nothing. Comparisons in 77 digits are then made at fewer points, or at none, which is no pass. So `mms check`
//! ends within ten seconds of processor time, whatever the text is, and says what it left out. The fields of the
//! gallery take a tenth of each budget or less, except for some of the rates.
//!
//! A `Stop` that another thread has asked to stop leaves every budget empty. A compilation then ends with one
//! diagnostic that says so, a proof with less proved. Who holds a compiled field after that compiles it anew.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Asks a compilation, a proof or a comparison to stop, from another thread.
///
/// Whoever waits keeps a copy and gives another one to the compilation's options. What has not ended by then ends soon: a
/// compilation with one diagnostic that says so, proofs with less proved.
#[derive(Clone, Debug, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Asks for the stop; that cannot be taken back.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether a stop has been asked for.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What is compiled does not depend on who may stop it.
impl PartialEq for Stop {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Eq for Stop {}

/// What is left of a budget. A step is some ten nanoseconds' work: an operation on intervals takes a few.
///
/// Handles of one budget draw on the same steps; what is cloned with a graph has its own.
#[derive(Debug, Default)]
pub struct Work {
    left: Arc<AtomicU64>,
    stop: Stop,
}

impl Work {
    /// A budget without a bound, until one is set.
    pub fn new(stop: Stop) -> Self {
        Work { left: Arc::new(AtomicU64::new(u64::MAX)), stop }
    }

    /// Another handle of the same budget.
    pub fn share(&self) -> Self {
        Work { left: Arc::clone(&self.left), stop: self.stop.clone() }
    }

    /// Sets how many steps are left.
    pub fn allow(&self, steps: u64) {
        self.left.store(steps, Ordering::Relaxed);
    }

    /// How many steps are left.
    pub fn left(&self) -> u64 {
        if self.stop.is_asked() { 0 } else { self.left.load(Ordering::Relaxed) }
    }

    /// Takes so many steps, or all that are left.
    pub fn spend(&self, steps: u64) {
        // A budget is spent by one thread: nothing is lost between the two.
        let left = self.left.load(Ordering::Relaxed);
        self.left.store(left.saturating_sub(steps), Ordering::Relaxed);
    }

    /// Runs `work` with so many steps of its own, which are not taken from what is left.
    pub fn aside<R>(&self, steps: u64, work: impl FnOnce() -> R) -> R {
        let left = self.left.load(Ordering::Relaxed);
        self.allow(steps);
        let made = work();
        self.allow(left);
        made
    }

    /// Whether nothing is left.
    pub fn is_over(&self) -> bool {
        self.left() == 0
    }

    /// The handle by which somebody may ask for a stop.
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
        assert!(work.aside(1, || (work.spend(1), work.is_over()).1));
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
