//! The quantity that is refined from level to level, and the resulting series of errors.

use std::fmt;
use std::str::FromStr;

use super::{Deviations, Errors, Run, Series, StudyLevel, StudyPoint};
use crate::extension::UnknownName;

/// The quantity that is refined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Refinement {
    /// h, and dt with it.
    #[default]
    Both,
    /// h alone, with one dt.
    Space,
    /// dt alone, with one h.
    Time,
}

impl Refinement {
    /// All refinements.
    pub const ALL: [Refinement; 3] = [Refinement::Both, Refinement::Space, Refinement::Time];

    /// The names that users write.
    pub const NAMES: &'static [&'static str] = &["both", "space", "time"];

    /// The name of the refinement.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// The length that is refined: h, or dt.
    pub fn length(self, level: &StudyLevel) -> f64 {
        match self {
            Refinement::Both | Refinement::Space => level.cell_size,
            Refinement::Time => level.time_step,
        }
    }

    /// The error of one quantity in a run, the largest over time. Its floor is unknown.
    pub fn point(self, run: &Run, quantity: fn(&Deviations) -> Errors) -> StudyPoint {
        let errors = run.details.as_ref().map(|details| quantity(&details.largest));
        StudyPoint { length: self.length(&run.level), errors, floor: 0.0 }
    }

    /// The error of the displacement in a run, and the part due to round-off.
    pub fn displacement(self, run: &Run) -> StudyPoint {
        let floor = run.details.as_ref().map_or(0.0, |details| details.round_off);
        StudyPoint { floor, ..self.point(run, |errors| errors.displacement) }
    }
}

impl fmt::Display for Refinement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Refinement {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let found = Self::ALL.into_iter().find(|it| it.name() == name);
        found.ok_or_else(|| UnknownName {
            what: "refinement",
            given: name.to_owned(),
            known: Self::NAMES,
        })
    }
}

/// The distance of each run's displacement from the displacement of the next finer run, from coarse to fine, for runs with
/// [`Watch::Parts`](super::Watch::Parts) on one grid: the differences contain only the error of time, and shrink with it. The
/// finest run has none.
pub fn differences(runs: &[&Run]) -> Series {
    let mut sorted = runs.to_vec();
    sorted.sort_by(|a, b| b.level.time_step.total_cmp(&a.level.time_step));
    Series::new(sorted.windows(2).map(|pair| {
        let noise = |run: &Run| run.details.as_ref().map_or(0.0, |details| details.round_off);
        StudyPoint {
            length: pair[0].level.time_step,
            errors: pair[0].snapshots.distance(&pair[1].snapshots),
            floor: noise(pair[0]).hypot(noise(pair[1])),
        }
    }))
}
