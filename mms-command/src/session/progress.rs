//! The progress of a run.

use std::io::IsTerminal as _;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mms_judge::Follow;
use mms_lab::trial;
use mms_runtime::Division;
use mms_runtime::study::Observer;

use crate::terminal::say;

/// A bar on a terminal, a line per run elsewhere.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    pub fn new() -> Self {
        let bar = on_terminal();
        if let Ok(style) = ProgressStyle::with_template(
            "{msg} {bar:40} {percent:>3}% {per_sec} particles and steps, {eta:>4} left",
        ) {
            bar.set_style(style);
        }
        Progress { bar }
    }

    /// Follows a run.
    pub fn of(&self, cells: Division) -> OfRun<'_> {
        self.bar.set_message(format!("{cells} cells"));
        OfRun { bar: &self.bar, cells }
    }

    pub fn say(&self, line: &str) {
        self.bar.suspend(|| say(line));
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl trial::Progress for Progress {
    fn of(&self, cells: Division) -> Box<dyn Observer + '_> {
        Box::new(Progress::of(self, cells))
    }

    fn say(&self, line: &str) {
        Progress::say(self, line);
    }

    fn finish(&self) {
        Progress::finish(self);
    }
}

/// A bar that is drawn if standard error is a terminal.
fn on_terminal() -> ProgressBar {
    if std::io::stderr().is_terminal() {
        ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(10))
    } else {
        ProgressBar::hidden()
    }
}

/// One line on a terminal that says what is tried now, as in "mistake to exclude: 3 of 48"; nothing elsewhere. The line vanishes
/// with the value.
pub struct StatusLine {
    line: ProgressBar,
}

impl StatusLine {
    pub fn new() -> Self {
        let line = on_terminal();
        if let Ok(style) = ProgressStyle::with_template("{msg}") {
            line.set_style(style);
        }
        StatusLine { line }
    }
}

impl Follow for StatusLine {
    fn is_stopped(&self) -> bool {
        false
    }

    fn say(&self, line: &str) {
        self.line.set_message(line.to_owned());
        self.line.tick();
    }
}

impl Drop for StatusLine {
    fn drop(&mut self) {
        self.line.finish_and_clear();
    }
}

/// The progress of one run, in particles and steps.
pub struct OfRun<'a> {
    bar: &'a ProgressBar,
    cells: Division,
}

impl Observer for OfRun<'_> {
    fn begin(&mut self, particles: usize, steps: usize) {
        self.bar.reset();
        self.bar.set_length(particles as u64 * steps as u64);
    }

    fn step(&mut self, step: usize, steps: usize) {
        let all = self.bar.length().unwrap_or_default();
        self.bar.set_position(all / steps as u64 * step as u64);
        if step == steps && self.bar.is_hidden() {
            say(format_args!("{} cells: {steps} steps done", self.cells));
        }
    }
}
