//! The effort of runs: the number of steps, and the duration estimated from a few steps of one run.

use std::time::{Duration, Instant};

use mms_runtime::study::{Frame, Observer};

/// The least number of particles times steps, over all runs, for a trial: fewer end sooner than a trial.
const WORTH_A_TRIAL: f64 = 5e6;

/// The least number of particles of a trial, if a run has as many.
const PARTICLES: usize = 4000;
/// The number of timed steps of a trial, after the first step.
const STEPS: usize = 6;

/// The duration above which a warning is printed.
const LONG: Duration = Duration::from_secs(120);

/// An observer that times a run, and ends it after a few steps.
#[derive(Default)]
pub struct Trial {
    last: usize,
    size: Option<Size>,
    first: Option<Instant>,
    took: Option<Duration>,
}

/// The size of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Particles.
    pub particles: usize,
    /// Time steps.
    pub steps: usize,
}

impl Size {
    fn work(self) -> f64 {
        self.particles as f64 * self.steps as f64
    }
}

impl Observer for Trial {
    fn begin(&mut self, particles: usize, steps: usize) {
        self.size = Some(Size { particles, steps });
    }

    fn step(&mut self, step: usize, _: usize) {
        match self.first {
            None => self.first = Some(Instant::now()),
            Some(first) if step == self.last => self.took = Some(first.elapsed()),
            Some(_) => {}
        }
    }

    fn wants(&self, step: usize, _: usize) -> bool {
        step == self.last
    }

    fn see(&mut self, _: &Frame) -> Result<(), String> {
        Err("a trial ends here".into())
    }
}

/// The effort of runs in a sentence, coarse to fine or fine to coarse; `begin` begins each run. With `in_step` all runs use the
/// time step of the finest. `None` if a run cannot be started, which is reported when it is run.
pub fn estimate(count: usize, in_step: bool, begin: impl Fn(usize, &mut Trial)) -> Option<String> {
    let sizes: Option<Vec<_>> = (0..count)
        .map(|run| {
            let mut trial = Trial::default();
            begin(run, &mut trial);
            trial.size
        })
        .collect();
    let mut sizes = sizes?;
    if in_step {
        let steps = sizes.iter().map(|size| size.steps).max().unwrap_or_default();
        sizes.iter_mut().for_each(|size| size.steps = steps);
    }
    let took = duration(&sizes, begin);
    Some(sentence(&sizes, took))
}

/// The estimated duration of runs of these sizes together; `None` if they are too short for a trial.
fn duration(sizes: &[Size], begin: impl Fn(usize, &mut Trial)) -> Option<Duration> {
    let work: f64 = sizes.iter().map(|size| size.work()).sum();
    let is_long = |size: &Size| size.steps > 4 * STEPS;
    let tried = (0..sizes.len()).filter(|run| is_long(&sizes[*run]));
    // The smallest that is large enough, else the largest.
    let run = tried.min_by_key(|run| match sizes[*run].particles {
        enough @ PARTICLES.. => (0, enough),
        few => (1, usize::MAX - few),
    });
    let run = run.filter(|_| work >= WORTH_A_TRIAL)?;
    let mut trial = Trial { last: 1 + STEPS, ..Trial::default() };
    begin(run, &mut trial);
    let of_step = trial.took?.div_f64((STEPS * sizes[run].particles) as f64);
    Duration::try_from_secs_f64(of_step.as_secs_f64() * work).ok()
}

fn sentence(sizes: &[Size], took: Option<Duration>) -> String {
    let steps: Vec<_> = sizes.iter().map(|size| size.steps.to_string()).collect();
    let runs = if sizes.len() == 1 { "run" } else { "runs" };
    let text = format!("{} {runs} of {} time steps", sizes.len(), steps.join(", "));
    match took {
        None => text,
        Some(took) if took < LONG => format!("{text}: about {}", words(took)),
        Some(took) => format!(
            "warning: {text} will take about {}; for less, choose fewer levels or cells, a larger time step, or a shorter \
             window",
            words(took)
        ),
    }
}

/// A duration in words.
fn words(time: Duration) -> String {
    match time.as_secs() {
        0 => "a second".into(),
        seconds @ ..120 => format!("{seconds} s"),
        seconds @ ..7200 => format!("{} minutes", seconds.div_ceil(60)),
        seconds => format!("{} hours", seconds.div_ceil(3600)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(sizes: &[[usize; 2]]) -> Vec<Size> {
        sizes
            .iter()
            .map(|[particles, steps]| Size { particles: *particles, steps: *steps })
            .collect()
    }

    #[test]
    fn minutes_are_warned_of() {
        let sizes = of(&[[64, 40], [128, 80]]);
        assert_eq!(sentence(&sizes, None), "2 runs of 40, 80 time steps");
        let took = Some(Duration::from_secs(7));
        assert_eq!(sentence(&sizes[..1], took), "1 run of 40 time steps: about 7 s");
        let text = sentence(&sizes, Some(Duration::from_secs(480)));
        assert!(
            text.starts_with("warning: 2 runs of 40, 80 time steps will take about 8 minutes"),
            "{text}"
        );
        assert_eq!(words(Duration::from_secs(7201)), "3 hours");
    }

    /// A run of 4000 particles whose steps take 4 ms.
    #[test]
    fn a_few_steps_tell_how_long_all_take() {
        let sizes = of(&[[1000, 1000], [4000, 2000]]);
        let begin = |run: usize, trial: &mut Trial| {
            assert_eq!(run, 1, "the first that is large enough is tried");
            for step in 1..=trial.last {
                std::thread::sleep(Duration::from_millis(4));
                trial.step(step, 2000);
            }
        };
        let took = duration(&sizes, begin).expect("a time").as_secs_f64();
        // 9e6 particles and steps, of which 4000 take 4 ms or somewhat more.
        assert!((9.0..30.0).contains(&took), "{took}");
        assert_eq!(duration(&sizes[..1], |_, _| panic!("it is short")), None);
    }
}
