//! The page docs/tradeoff.md.

use mms_lab::tradeoff::search::{Cost, Goal};
use mms_lab::tradeoff::setting::Setting;
use mms_spec::foreign::Foreign;

use super::{Report, factor};

/// The text before the tables.
const INTRODUCTION: &str = "\
# Speed against accuracy

`mms tradeoff` chooses the cheapest method for an error. These tables compare its choice with the default of `mms run` (updated
cpgimp leapfrog, f64, 2 particles per cell and direction, Courant 0.4). The errors are 1e-3, 1e-4 and 1e-5: the largest error of
the displacement over time and particles. The command is

```console
$ cargo run --release -- tradeoff --page > docs/tradeoff.md
```

All runs use one thread. The cost of the default is extrapolated by its power law from its run nearest to the target. A time is
the number of particle-steps, times the time of one particle-step in the longest runs with the method. No run has more than
1e8 particle-steps.
";

/// Tables of fields, one after the other.
pub struct Page {
    text: String,
    field: Foreign,
}

impl Default for Page {
    fn default() -> Self {
        Self { text: INTRODUCTION.into(), field: Foreign::default() }
    }
}

impl Page {
    /// The fields.
    pub const FIELDS: [&str; 4] =
        ["bar_1d", "axis_aligned_2d", "expanding_ring", "generalized_vortex_third"];

    /// The targets.
    pub const TARGETS: [f64; 3] = [1e-3, 1e-4, 1e-5];

    /// Adds the result of a search for a target.
    pub fn add(&mut self, report: &Report) {
        if self.field != report.field {
            self.field = report.field.clone();
            self.text += &format!(
                "\n## {}\n\n{}.\n\n| linf | choice | cells | time | particle-steps | memory | the default takes | half the error costs |\n|---|---|---|---|---|---|---|---|\n",
                report.field.shown(),
                report.title.shown()
            );
        }
        self.text += &line(report);
    }

    /// The page.
    pub fn text(&self) -> &str {
        &self.text
    }
}

fn line(report: &Report) -> String {
    let Goal::Error(target) = report.problem.goal else { return String::new() };
    let Some(trial) = report.choice() else {
        return format!("| {target:e} | not reached: {} | | | | | | |\n", report.unreached(target));
    };
    let default = match report.gain() {
        Some(gain) if trial.setting != Setting::default() => {
            format!("{} times the time", factor(gain))
        }
        Some(_) => "the same".into(),
        None => format!("no time is enough: {}", report.why_not()),
    };
    let half = report
        .exponent()
        .map_or("-".into(), |it| format!("{} times the time", factor(2f64.powf(it))));
    let [time, work, memory] = [Cost::Seconds, Cost::ParticleSteps, Cost::Memory]
        .map(|measure| measure.show(report.cost(trial, measure)));
    let work = work.trim_end_matches(" particle-steps");
    format!(
        "| {target:e} | {} | {} | {time} | {work} | {memory} | {default} | {half} |\n",
        trial.setting, trial.cells
    )
}
