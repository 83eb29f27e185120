//! How far a run is.

use std::io::IsTerminal as _;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mms_runtime::Division;

/// A bar on a terminal, a line per run elsewhere.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    pub fn new() -> Self {
        let bar = if std::io::stderr().is_terminal() {
            ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr_with_hz(10))
        } else {
            ProgressBar::hidden()
        };
        if let Ok(style) =
            ProgressStyle::with_template("{msg} {bar:40} {percent:>3}% {eta:>4} left")
        {
            bar.set_style(style);
        }
        Progress { bar }
    }

    pub fn step(&self, cells: &Division, step: usize, steps: usize) {
        if step <= 1 {
            self.bar.reset();
            self.bar.set_length(steps as u64);
            self.bar.set_message(format!("{cells} cells"));
        }
        self.bar.set_position(step as u64);
        if step == steps && self.bar.is_hidden() {
            anstream::eprintln!("{cells} cells: {steps} steps done");
        }
    }

    pub fn say(&self, line: &str) {
        self.bar.suspend(|| anstream::eprintln!("{line}"));
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
