//! The report of a campaign: text and JSON document.

use std::path::Path;

use anyhow::Context as _;
use mms_convergence::Verdict;
use mms_documents::campaign::{self as documents, CampaignRun, CampaignStudy};
use mms_files::write::refuse_link;
use mms_spec::foreign::{self, one_line, shown};

use super::judged::Judged;
use super::plan::{Job, Plan, Planned};
use super::work::{Finished, Outcome, left_behind_too};
use crate::provenance::Provenance;
use crate::report::{Judgements, Together, duration, plain, pretty, to_the_right, write_files};

/// A campaign that was carried out, or what was asked for of it.
pub struct Report<'a> {
    /// The plan of the campaign.
    pub plan: &'a Plan,
    /// The judgement of each study.
    pub studies: Vec<Judged<'a>>,
    /// Where it is from.
    pub provenance: Provenance,
}

impl Report<'_> {
    fn outcomes(&self) -> impl Iterator<Item = (&Job, &Outcome)> {
        self.studies.iter().flat_map(|it| it.planned.jobs.iter().zip(&it.outcomes))
    }

    /// Whether a run did not come to its end, or its results say nothing.
    pub fn has_failed(&self) -> bool {
        let failed = |(_, outcome): (&Job, &Outcome)| !matches!(outcome, Outcome::Finished(_));
        self.outcomes().any(failed) || self.studies.iter().any(|it| it.mistake.is_some())
    }

    /// Whether a verdict is no pass.
    pub fn is_refuted(&self) -> bool {
        let mut verdicts = self.studies.iter().filter_map(Judged::verdict);
        !verdicts.all(Verdict::is_good)
    }

    /// All of it for a terminal.
    pub fn text(&self) -> String {
        let mut parts: Vec<String> = self.studies.iter().flat_map(Judged::parts).collect();
        if self.studies.iter().any(|it| it.planned.is_whole()) {
            parts.push(self.matrix());
        }
        parts.extend(self.excluded().map(|it| it.text()));
        parts.push(self.tally());
        parts.join("\n\n")
    }

    /// A row for each study.
    fn matrix(&self) -> String {
        let mut table = plain(["study", "field", "expected", "observed", "of", "verdict"]);
        for judged in self.studies.iter().filter(|it| it.planned.is_whole()) {
            table.add_row(judged.row());
        }
        to_the_right(table).to_string()
    }

    /// The mistakes that all passing studies exclude together.
    fn excluded(&self) -> Option<Together> {
        Together::new(self.studies.iter().filter_map(|it| {
            let exclusions = it.judgements.as_ref()?.exclusions.as_ref()?;
            Some((it.planned.study.name.as_str(), exclusions))
        }))
    }

    fn tally(&self) -> String {
        let finished = self.outcomes().filter(|(_, it)| matches!(it, Outcome::Finished(_))).count();
        let runs = format!("{finished} of {} runs are done", self.outcomes().count());
        let judged: Vec<_> = self.studies.iter().filter(|it| it.planned.is_whole()).collect();
        let passed = judged.iter().filter(|it| it.verdict().is_some_and(Verdict::is_good)).count();
        match judged.len() {
            0 => runs,
            all => format!("{runs}; {passed} of {all} studies pass"),
        }
    }

    /// The JSON document.
    pub fn document(&self) -> documents::Campaign {
        let solver = &self.plan.campaign.solver;
        let passes = |it: &&Judged| it.verdict().is_some_and(Verdict::is_good);
        documents::Campaign {
            solver: solver.name.clone(),
            solver_version: solver.version.clone(),
            studies: self.studies.iter().map(Judged::document).collect(),
            excluded: self.excluded().map(|it| it.document()),
            passed: self.studies.iter().filter(passes).count(),
            provenance: self.provenance.clone(),
        }
    }

    /// Writes campaign.json, and for each study its picture and its table; returns their paths.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        let mut paths = write_files(folder, "campaign", [("json", pretty(&self.document())?)])?;
        for judged in &self.studies {
            if let Some(judgements) = &judged.judgements {
                let own = folder.join(&judged.planned.study.name);
                let cannot = || format!("cannot write to `{}`", foreign::path(&own));
                refuse_link(&own, "folder").with_context(cannot)?;
                paths.extend(judgements.write_parts(&own)?);
            }
        }
        Ok(paths)
    }
}

impl Judged<'_> {
    /// The verdict; none where there are no results, or where these say nothing.
    fn verdict(&self) -> Option<Verdict> {
        self.judgements.as_ref().map(Judgements::verdict)
    }

    fn parts(&self) -> Vec<String> {
        let mut parts = Vec::new();
        let runs = self.planned.jobs.iter().zip(&self.outcomes);
        parts.extend(runs.clone().filter_map(|(job, outcome)| failure(job, outcome)));
        parts.extend(runs.filter_map(|(job, outcome)| left_behind(job, outcome)));
        parts.extend(self.mistake.as_ref().map(|it| format!("{}: {it}", self.name())));
        parts.extend(
            self.judgements.as_ref().map(|it| format!("{}\n{}", self.heading(), it.table())),
        );
        parts
    }

    fn name(&self) -> String {
        shown(&self.planned.study.name)
    }

    fn heading(&self) -> String {
        format!("study {}", self.name())
    }

    fn row(&self) -> Vec<String> {
        let dash = || "-".to_owned();
        let deciding = self.judgements.as_ref().and_then(|it| it.deciding());
        let word = match (self.verdict(), &self.mistake) {
            (Some(verdict), _) => verdict.to_string(),
            (None, Some(_)) => "not judged: its results say nothing".into(),
            (None, None) => "not judged: no results".into(),
        };
        vec![
            self.name(),
            self.planned.input.name.shown(),
            deciding.as_ref().map_or_else(dash, |it| it.expected.to_string()),
            deciding.as_ref().and_then(|it| it.observed.clone()).unwrap_or_else(dash),
            deciding.map_or_else(dash, |it| it.of),
            word,
        ]
    }

    fn document(&self) -> CampaignStudy {
        let Planned { study, input, jobs, .. } = self.planned;
        let runs = jobs.iter().zip(&self.outcomes).map(|(job, outcome)| run(job, outcome));
        CampaignStudy {
            name: study.name.clone(),
            study: study.family.clone(),
            set: study.set.clone(),
            field: input.name.raw().to_owned(),
            runs: runs.collect(),
            mistake: self.mistake.clone(),
            verdict: self.verdict().map(|it| it.to_string()),
            judgement: self.judgements.as_ref().map(|it| it.document()),
        }
    }
}

/// The message for a run that failed.
fn failure(job: &Job, outcome: &Outcome) -> Option<String> {
    let Outcome::Failed { reason, last_words, folder } = outcome else { return None };
    let words: String = last_words.iter().map(|line| format!("\n    {}", one_line(line))).collect();
    let words = if words.is_empty() { "\n    (it printed nothing)".to_owned() } else { words };
    Some(format!(
        "{} failed: {}{words}\n  all of it is in {}",
        shown(&job.name),
        reason,
        shown(folder)
    ))
}

/// The processes that a run left behind.
fn left_behind(job: &Job, outcome: &Outcome) -> Option<String> {
    let Outcome::Finished(Finished { left_behind, .. }) = outcome else { return None };
    let names: Vec<_> = left_behind.iter().map(|name| shown(name)).collect();
    (!names.is_empty()).then(|| {
        let name = shown(&job.name);
        format!("{name} left processes behind, which were ended: {}", names.join(", "))
    })
}

/// A run that ended, in a line.
pub fn line(job: &Job, outcome: &Outcome, is_new: bool) -> String {
    let name = shown(&job.name);
    match outcome {
        Outcome::Finished(it) if is_new => {
            let behind = left_behind_too(&it.left_behind);
            format!("{name}: done in {}{behind}", duration(it.seconds))
        }
        Outcome::Finished(_) => format!("{name}: was done before"),
        Outcome::Failed { reason, .. } => format!("{name}: {reason}"),
        Outcome::Interrupted => format!("{name}: interrupted"),
    }
}

fn run(job: &Job, outcome: &Outcome) -> CampaignRun {
    let (status, reason, last_words, folder) = match outcome {
        Outcome::Finished(it) => ("done", None, None, Some(&it.folder)),
        Outcome::Failed { reason, last_words, folder } => {
            ("failed", Some(reason), Some(last_words), Some(folder))
        }
        Outcome::Interrupted => ("interrupted", None, None, None),
    };
    let (seconds, left_behind) = match outcome {
        Outcome::Finished(it) => (Some(it.seconds), Some(&it.left_behind)),
        _ => (None, None),
    };
    CampaignRun {
        level: job.level,
        cells: job.cells,
        cell_size: job.cell_size,
        time_step: job.time_step,
        steps: job.steps,
        status: status.to_owned(),
        reason: reason.cloned(),
        last_words: last_words.cloned(),
        folder: folder.cloned(),
        seconds,
        left_behind: left_behind.cloned(),
    }
}
