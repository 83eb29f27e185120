//! The mistakes that a study excludes.

use mms_exact::Input;
use mms_judge::Follow;
use mms_judge::results::Exclusions;
use mms_mechanics::sample::domain;
use mms_report::run;
use mms_runtime::{Method, Run};

use super::Study;

/// The parts of the time at which the change that a mistake makes is compared with the largest error of a study.
const LOOKED_AT: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

impl Study {
    /// The mistakes that the errors of the finest level exclude; nothing if no level has started.
    pub(super) fn exclusions(
        &self,
        input: &Input,
        method: &Method,
        started: &[&Run],
        search: &dyn Follow,
    ) -> anyhow::Result<Option<Exclusions>> {
        let Some(finest) = started.last() else { return Ok(None) };
        let set = input.settings(&self.set)?;
        let (_, [first, last]) =
            domain(&input.compiled.program, &input.compiled.parameters::<f64>(&set));
        let last = method.setup.end_time.unwrap_or(last);
        let times = LOOKED_AT.map(|part| first + part * (last - first)).to_vec();
        let times = (!input.is_static()).then_some(times);
        let scene = input.scene_with(&set, |code| code.double)?;
        let largest = finest.details.as_ref().map(|it| run::quantities(&it.largest));
        let error =
            |name: &str| Some(largest.iter().flatten().find(|(_, key, _)| *key == name)?.2.l2);
        let level = &finest.level;
        Ok(Exclusions::new(&scene, error, (level.cell_size, Some(level.time_step)), times, search))
    }
}
