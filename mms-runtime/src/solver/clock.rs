//! The clock of a run: its time, computed from the step number, and the processor time of its parts.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::failure::Refusal;
use crate::failure::{at_most, positive};

/// The largest supported number of steps.
const STEP_LIMIT: f64 = u32::MAX as f64;

/// The time of a run. It is computed from the step number, never accumulated.
pub(super) struct Clock {
    pub start: f64,
    pub time_step: f64,
    pub steps: usize,
    pub step: usize,
    /// The number of time steps by which velocities are behind.
    pub lag: f64,
}

impl Clock {
    /// Divides the window into steps not longer than `time_step`, the same number in each of the parts.
    pub fn new(window: [f64; 2], time_step: f64, parts: usize) -> Result<Self, Refusal> {
        let duration = positive("the length of the time window", window[1] - window[0])?;
        let target = positive("the time step", time_step)?;
        // Round-off must not add a step to a duration of a whole number of steps.
        let parts = positive("the number of parts of a run", parts as f64)?;
        let steps = (duration / parts / target * (1.0 - 1e-6)).ceil().max(1.0) * parts;
        at_most("steps", steps, STEP_LIMIT)?;
        let (start, time_step) = (window[0], duration / steps);
        Ok(Self { start, time_step, steps: steps as usize, step: 0, lag: 0.0 })
    }

    pub fn window(&self) -> [f64; 2] {
        [self.start, self.time_of(self.steps)]
    }

    pub fn time_of(&self, step: usize) -> f64 {
        self.start + step as f64 * self.time_step
    }
}

/// Wall-clock seconds of the parts of all steps. Where threads work on two parts at once, or parts alternate many times, they
/// share the elapsed time in the proportions of a timed sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// The field's body force and tractions.
    pub forcing: f64,
    /// Weights, and sums between particles and nodes.
    pub transfer: f64,
    /// The nodes.
    pub grid: f64,
    /// The material.
    pub stress: f64,
}

impl Seconds {
    /// The sum of two measurements, part by part.
    pub(super) fn sum(self, other: Self) -> Self {
        Self {
            forcing: self.forcing + other.forcing,
            transfer: self.transfer + other.transfer,
            grid: self.grid + other.grid,
            stress: self.stress + other.stress,
        }
    }

    /// Scales these shares so that they sum to `elapsed` seconds.
    pub(super) fn within(self, elapsed: f64) -> Self {
        let all = self.forcing + self.transfer + self.grid + self.stress;
        let share = if all > 0.0 { elapsed / all } else { 0.0 };
        Self {
            forcing: self.forcing * share,
            transfer: self.transfer * share,
            grid: self.grid * share,
            stress: self.stress * share,
        }
    }
}

/// Runs a part of a step, and adds its time to `seconds`.
pub(super) fn timed<R>(seconds: &mut f64, part: impl FnOnce() -> R) -> R {
    let start = Instant::now();
    let result = part();
    *seconds += start.elapsed().as_secs_f64();
    result
}

/// Times parts that follow each other: each begins where the one before ended.
pub(super) struct Laps {
    since: Option<Instant>,
}

impl Laps {
    /// Starts the first part; measures nothing unless `timed`.
    pub fn start(timed: bool) -> Self {
        Self { since: timed.then(Instant::now) }
    }

    /// Ends a part: adds its time to `seconds`.
    pub fn end(&mut self, seconds: &mut f64) {
        if let Some(since) = &mut self.since {
            let now = Instant::now();
            *seconds += (now - *since).as_secs_f64();
            *since = now;
        }
    }
}
