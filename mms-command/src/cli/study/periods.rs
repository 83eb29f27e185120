//! The periods of a study of phase.

use mms_report::UnstartedLevel;
use mms_runtime::Run;

/// The periods that runs go through.
pub struct Periods {
    /// The start of the first.
    pub start: f64,
    /// The length of each.
    pub length: f64,
    /// The number of the last.
    pub last: usize,
}

impl Periods {
    /// Advice for a run that went well for some periods and then failed.
    pub fn where_they_stopped(&self, levels: &[Result<Run, UnstartedLevel>]) -> Option<String> {
        let failures = levels.iter().flatten().filter_map(|run| run.level.errors.as_ref().err());
        let numbers =
            failures.map(|it| ((it.time - self.start) / self.length).floor() as usize + 1);
        let numbers: Vec<_> = numbers.filter(|&number| number > 1).collect();
        if numbers.is_empty() {
            return None;
        }
        let numbers = numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
        Some(format!(
            "note: stopped in period {numbers} of {}; if finer grids and smaller steps stop there too, errors that grow \
             from period to period have become larger than the motion: study fewer periods, or a smaller motion",
            self.last
        ))
    }
}
