//! The result of a campaign, and its document.

use mms_convergence::Verdict;
use mms_documents::campaign::{self as documents, CampaignRun, CampaignStudy};
use mms_documents::provenance::Provenance;
use mms_judge::{Judgements, Together};

use crate::judged::JudgedStudy;
use crate::plan::{CampaignPlan, Job, PlannedStudy};
use crate::work::RunOutcome;

/// The report on a campaign, or on the requested part of it.
pub struct Report<'a> {
    /// The plan of the campaign.
    pub plan: &'a CampaignPlan,
    /// The judgement of each study.
    pub studies: Vec<JudgedStudy<'a>>,
    /// If requested, the judgements of the same studies with a wrong b; fields without a body force have none.
    pub canaries: Option<Vec<JudgedStudy<'a>>>,
    /// The words of the command to type next, if a study does not pass.
    pub next: Option<Vec<String>>,
    /// The provenance of the document.
    pub provenance: Provenance,
}

/// The verdict of a study with a wrong b.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Canary {
    /// The study does not pass: it measures the solver.
    Fails,
    /// The study passes: it measures nothing.
    Passes,
    /// Not known: the study does not pass with the right b either, or runs are missing.
    Open,
}

impl Canary {
    /// The name of the finding in a document.
    pub fn name(self) -> &'static str {
        match self {
            Canary::Fails => "fails",
            Canary::Passes => "passes",
            Canary::Open => "open",
        }
    }
}

impl Report<'_> {
    /// Each run with its outcome.
    pub fn outcomes(&self) -> impl Iterator<Item = (&Job, &RunOutcome)> {
        self.studies.iter().flat_map(|it| it.planned.jobs.iter().zip(&it.outcomes))
    }

    /// Whether a run failed, or the results of a study cannot be judged.
    pub fn has_failed(&self) -> bool {
        let failed =
            |(_, outcome): (&Job, &RunOutcome)| !matches!(outcome, RunOutcome::Finished(_));
        self.outcomes().any(failed) || self.studies.iter().any(|it| it.mistake.is_some())
    }

    /// Whether a verdict is no pass, or a study passes with a wrong b.
    pub fn is_refuted(&self) -> bool {
        let mut verdicts = self.studies.iter().filter_map(JudgedStudy::verdict);
        !verdicts.all(Verdict::is_good) || !self.with_canary(Canary::Passes).is_empty()
    }

    /// The verdict of a study with a wrong b; `None` if it has no such runs.
    pub fn canary(&self, study: &str) -> Option<Canary> {
        let found = self.canaries.iter().flatten().find(|it| it.planned.study.name == study)?;
        let passes = |it: &JudgedStudy<'_>| it.verdict().is_some_and(Verdict::is_good);
        let mut right = self.studies.iter().filter(|it| it.planned.study.name == study);
        let is_missing = found.outcomes.contains(&RunOutcome::Interrupted);
        Some(match right.any(passes) && !is_missing {
            _ if passes(found) => Canary::Passes,
            true => Canary::Fails,
            false => Canary::Open,
        })
    }

    /// The studies with this verdict for a wrong b.
    pub fn with_canary(&self, wanted: Canary) -> Vec<&str> {
        let names = self.canaries.iter().flatten().map(|it| it.planned.study.name.as_str());
        names.filter(|name| self.canary(name) == Some(wanted)).collect()
    }

    /// The mistakes that all passing studies exclude together.
    pub fn excluded(&self) -> Option<Together> {
        Together::new(self.studies.iter().filter_map(|it| {
            let exclusions = it.judgements.as_ref()?.exclusions.as_ref()?;
            Some((it.planned.study.name.as_str(), exclusions))
        }))
    }

    fn study(&self, judged: &JudgedStudy<'_>) -> CampaignStudy {
        let canary = self.canary(&judged.planned.study.name);
        CampaignStudy { canary: canary.map(|it| it.name().to_owned()), ..judged.document() }
    }

    /// The JSON document.
    pub fn document(&self) -> documents::Campaign {
        let solver = &self.plan.campaign.solver;
        let passes = |it: &&JudgedStudy| it.verdict().is_some_and(Verdict::is_good);
        documents::Campaign {
            solver: solver.name.clone(),
            solver_version: solver.version.clone(),
            studies: self.studies.iter().map(|it| self.study(it)).collect(),
            excluded: self.excluded().map(|it| it.document()),
            passed: self.studies.iter().filter(passes).count(),
            next_command: self.next.clone(),
            provenance: self.provenance.clone(),
        }
    }
}

impl JudgedStudy<'_> {
    /// The verdict; `None` if there are no results, or they cannot be judged.
    pub fn verdict(&self) -> Option<Verdict> {
        self.judgements.as_ref().map(Judgements::verdict)
    }

    fn document(&self) -> CampaignStudy {
        let PlannedStudy { study, input, jobs, .. } = self.planned;
        let runs = jobs.iter().zip(&self.outcomes).map(|(job, outcome)| run(job, outcome));
        CampaignStudy {
            name: study.name.clone(),
            study: study.family.clone(),
            set: study.set.clone(),
            field: input.name.raw().to_owned(),
            runs: runs.collect(),
            mistake: self.mistake.clone(),
            verdict: self.verdict().map(|it| it.to_string()),
            canary: None,
            judgement: self.judgements.as_ref().map(|it| it.document()),
        }
    }
}

fn run(job: &Job, outcome: &RunOutcome) -> CampaignRun {
    let (status, reason, last_words, folder) = match outcome {
        RunOutcome::Finished(it) => ("done", None, None, Some(&it.folder)),
        RunOutcome::Failed { reason, last_words, folder } => {
            ("failed", Some(reason), Some(last_words), Some(folder))
        }
        RunOutcome::Interrupted => ("interrupted", None, None, None),
    };
    let (seconds, left_behind) = match outcome {
        RunOutcome::Finished(it) => (Some(it.seconds), Some(&it.left_behind)),
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
