//! The runs of a campaign that `--only` selects.

use anyhow::bail;
use mms_campaign::{Campaign, Study};
use mms_spec::foreign;
use mms_spec::suggest::advice;

/// The name of selected runs: a study, all steps of one, or a level of these.
pub struct Only(String);

impl Only {
    fn study(&self) -> &str {
        self.0.rsplit_once('/').map_or(&self.0, |(study, _)| study)
    }

    fn names(&self, study: &Study) -> bool {
        [&study.name, &study.family].into_iter().any(|name| self.study() == name)
    }

    /// Whether a level of a study is selected.
    pub fn takes(&self, study: &Study, level: usize) -> bool {
        let names = [&study.name, &study.family];
        names.into_iter().any(|name| self.0 == *name || self.0 == format!("{name}/{level}"))
    }
}

impl From<String> for Only {
    fn from(name: String) -> Self {
        Only(name)
    }
}

/// Refuses names of studies and levels that the file does not have.
///
/// # Errors
/// Such a name, with the nearest one.
pub fn validate(campaign: &Campaign, only: &[Only]) -> anyhow::Result<()> {
    for it in only {
        let study = campaign.studies.iter().find(|study| it.names(study));
        let known =
            study.is_some_and(|study| (1..=study.levels()).any(|level| it.takes(study, level)));
        if !known {
            let names = campaign.studies.iter().map(|study| study.name.as_str());
            let levels =
                |study: &Study| format!("`{}` has levels 1 to {}", study.name, study.levels());
            let help = study.map_or_else(
                || advice(it.study(), names, |all| format!("the studies are {all}")),
                levels,
            );
            bail!(
                "`--only {}`: no such study or level; {}",
                foreign::shown(&it.0),
                foreign::shown(&help)
            );
        }
    }
    Ok(())
}
