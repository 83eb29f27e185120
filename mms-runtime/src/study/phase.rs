//! The phase error of a run of a periodic motion.

use std::f64::consts::TAU;

use super::{Checkpoint, Frame, Observer};

/// The differences of amplitude and phase between the computed and the exact motion over a period, at the frequency of the
/// period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// The computed amplitude divided by the exact amplitude, minus 1.
    pub amplitude_error: f64,
    /// The angle by which the computed motion is behind, in radians, from -pi to pi.
    pub phase_lag: f64,
}

/// The least part of a motion, in squares, at the frequency of the period: a smaller part has no phase.
const LEAST_PART: f64 = 1e-6;

/// The least number of steps per period that separate a frequency from others.
const LEAST_STEPS: usize = 3;

/// The parts of two motions at the frequency of the period: sums over its steps of each component times cosine and sine. Over a
/// whole period all other periodic parts, and the mean, drop out, so that a motion A u(t - delta) has A and delta exactly for
/// any u (the shift theorem of discrete Fourier sums).
#[derive(Clone, Debug, Default)]
struct Projection {
    /// For each component of each particle: computed, exact.
    sums: Vec<[[f64; 2]; 2]>,
    /// The sum of squares of the exact motion, and the number of steps in it.
    squares: f64,
    steps: usize,
}

impl Projection {
    /// Adds a step, at an angle of the period: the computed components, and their errors.
    fn add(&mut self, angle: f64, computed: &[f64], error: &[f64]) {
        let (sine, cosine) = angle.sin_cos();
        self.sums.resize(computed.len(), Default::default());
        self.steps += 1;
        for (sums, (computed, error)) in self.sums.iter_mut().zip(computed.iter().zip(error)) {
            let exact = computed - error;
            self.squares += exact * exact;
            for (sum, value) in sums.iter_mut().zip([computed, &exact]) {
                sum[0] += value * cosine;
                sum[1] += value * sine;
            }
        }
    }

    /// The complex number z of least squares |D - z U| over all components, D and U being the computed and the exact part: its
    /// size is the ratio of amplitudes, its angle the lead of the computed motion.
    fn phase(&self) -> Option<Phase> {
        let (mut real, mut imaginary, mut whole) = (0.0, 0.0, 0.0);
        for [[d_cos, d_sin], [u_cos, u_sin]] in &self.sums {
            real += u_cos * d_cos + u_sin * d_sin;
            imaginary += u_sin * d_cos - u_cos * d_sin;
            whole += u_cos * u_cos + u_sin * u_sin;
        }
        let is_there = whole > LEAST_PART * self.squares * self.steps as f64;
        (is_there && self.steps >= LEAST_STEPS).then(|| Phase {
            amplitude_error: real.hypot(imaginary) / whole - 1.0,
            phase_lag: (-imaginary).atan2(real),
        })
    }
}

/// Follows a run through a whole number of periods, and measures amplitude and phase in some of them. The number of steps has
/// to be a multiple of the number of periods: see [`Setup::parts`](crate::Setup::parts).
pub struct Phases<'a> {
    /// The periods that are measured, the first being 1.
    wanted: Vec<usize>,
    /// The number of periods of the run.
    periods: usize,
    steps: usize,
    now: Projection,
    found: Vec<Option<Phase>>,
    /// The observer of the run's progress.
    progress: &'a mut dyn Observer,
}

impl<'a> Phases<'a> {
    /// Follows a run that ends with the last of the `wanted` periods, which are in ascending order.
    pub fn new(wanted: &[usize], progress: &'a mut dyn Observer) -> Self {
        Self {
            wanted: wanted.to_vec(),
            periods: wanted.last().copied().unwrap_or(1),
            steps: 0,
            now: Projection::default(),
            found: Vec::new(),
            progress,
        }
    }

    /// The phase in each `wanted` period that was reached: `None` if the motion has no part of that frequency, or the period
    /// too few steps.
    pub fn found(self) -> Vec<Option<Phase>> {
        self.found
    }

    /// The number of steps of a period.
    fn length(&self) -> usize {
        (self.steps / self.periods).max(1)
    }
}

impl Observer for Phases<'_> {
    fn begin(&mut self, particles: usize, steps: usize) {
        self.steps = steps;
        self.progress.begin(particles, steps);
    }

    fn step(&mut self, step: usize, steps: usize) {
        self.progress.step(step, steps);
    }

    fn wants(&self, step: usize, _: usize) -> bool {
        step > 0 && self.wanted.contains(&step.div_ceil(self.length()))
    }

    fn see(&mut self, frame: &Frame) -> Result<(), String> {
        let length = self.length();
        let within = frame.step % length;
        let angle = TAU * within as f64 / length as f64;
        self.now.add(angle, &frame.displacement, &frame.displacement_error);
        if within == 0 {
            self.found.push(std::mem::take(&mut self.now).phase());
        }
        Ok(())
    }

    fn keeps(&self, step: usize, steps: usize) -> bool {
        self.progress.keeps(step, steps)
    }

    fn keep(&mut self, checkpoint: &dyn Checkpoint) -> Result<(), String> {
        self.progress.keep(checkpoint)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A motion of three components that are no sines: each has a mean, harmonics and its own phase.
    fn exact(turns: f64) -> [f64; 3] {
        [0.0, 0.3, 1.1].map(|phase| {
            let angle = TAU * turns + phase;
            0.7 + angle.cos() + 0.4 * (2.0 * angle).sin() - 0.2 * (3.0 * angle).cos()
        })
    }

    /// The phases in the periods 1 and 3 of a run with this number of steps per period.
    fn found(length: usize, computed: impl Fn(f64) -> [f64; 3]) -> Vec<Option<Phase>> {
        let mut progress = ();
        let mut phases = Phases::new(&[1, 3], &mut progress);
        let steps = 3 * length;
        phases.begin(3, steps);
        for step in (1..=steps).filter(|&step| (0..=length).contains(&step) || step > 2 * length) {
            assert!(phases.wants(step, steps), "{step}");
            let turns = step as f64 / length as f64;
            let (d, u) = (computed(turns), exact(turns));
            let frame = Frame {
                step,
                time: turns,
                dimension: 1,
                position: Vec::new(),
                displacement: d.to_vec(),
                displacement_error: d.iter().zip(u).map(|(d, u)| d - u).collect(),
                velocity: Vec::new(),
                deformation_gradient: Vec::new(),
                cauchy_stress: Vec::new(),
                hoop_stretch: Vec::new(),
                hoop_stress: Vec::new(),
            };
            phases.see(&frame).expect("seen");
        }
        assert!(!phases.wants(0, steps) && !phases.wants(length + 1, steps));
        phases.found()
    }

    #[test]
    fn a_motion_that_lags_and_is_damped_has_its_lag_and_damping() {
        for (amplitude, lag) in [(1.0, 0.0), (0.9, 0.25), (1.05, -1.0), (1e-3, 3.0)] {
            let delayed = |turns| exact(turns - lag / TAU).map(|u| amplitude * u);
            for length in [8, 17, 1000] {
                let all = found(length, delayed);
                assert_eq!(all.len(), 2);
                for phase in all {
                    let phase = phase.expect("a phase");
                    assert!((phase.amplitude_error - (amplitude - 1.0)).abs() < 1e-13, "{phase:?}");
                    assert!((phase.phase_lag - lag).abs() < 1e-13, "{phase:?}");
                }
            }
        }
    }

    /// A motion that is slightly slower, and decays, shows its accumulated errors in each period.
    #[test]
    fn a_drift_grows_from_period_to_period() {
        let (slow, decay) = (1e-4, 1e-3);
        let drifting = |turns: f64| exact(turns * (1.0 - slow)).map(|u| u * (-decay * turns).exp());
        let all: Vec<_> = found(400, drifting).into_iter().flatten().collect();
        for (phase, middle) in all.iter().zip([0.5, 2.5]) {
            let [lag, loss] = [TAU * slow * middle, -decay * middle];
            assert!((phase.phase_lag / lag - 1.0).abs() < 0.5, "{phase:?}");
            assert!((phase.amplitude_error / loss - 1.0).abs() < 0.5, "{phase:?}");
        }
        let grown = |of: fn(&Phase) -> f64| of(&all[1]) - of(&all[0]);
        assert!((grown(|it| it.phase_lag) / (2.0 * TAU * slow) - 1.0).abs() < 0.01, "{all:?}");
        assert!((grown(|it| it.amplitude_error) / (-2.0 * decay) - 1.0).abs() < 0.01, "{all:?}");
    }

    #[test]
    fn what_is_not_there_has_no_phase() {
        let mut still = Projection::default();
        let mut twice = Projection::default();
        for step in 0..16 {
            let angle = TAU * f64::from(step) / 16.0;
            still.add(angle, &[1.0], &[0.0]);
            twice.add(angle, &[(2.0 * angle).cos()], &[0.0]);
        }
        assert_eq!((still.phase(), twice.phase()), (None, None));
        let mut short = Projection::default();
        for angle in [0.0, TAU / 2.0] {
            short.add(angle, &[angle.cos()], &[0.0]);
        }
        assert_eq!(short.phase(), None);
    }
}
