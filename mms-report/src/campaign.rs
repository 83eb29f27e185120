//! The result of a campaign as text and files.

use std::path::Path;

use anyhow::Context as _;
use mms_convergence::Verdict;
use mms_documents::campaign::Campaign;
use mms_files::words::duration;
use mms_files::write::{pretty, refuse_link, write_files};
use mms_harness::judged::JudgedStudy;
use mms_harness::plan::Job;
use mms_harness::report::{Canary, Report};
use mms_harness::work::{Finished, RunOutcome, left_behind_too};
use mms_judge::Judgements;
use mms_spec::foreign::{self, one_line, shown};

use super::excluded;
use super::judge::View as JudgementView;
use super::junit;
use super::page::Section as _;
use super::plot::Figure;
use super::shown::Shown;
use super::table::TextTable;
use super::text::next;

/// The text of a campaign.
pub struct View<'a>(pub &'a Report<'a>);

impl View<'_> {
    /// The text: missing runs and results, the judgements (only failed ones, or all of them), and a row for each study.
    fn all(&self, is_full: bool) -> String {
        let mut parts: Vec<String> =
            self.0.studies.iter().flat_map(|it| parts(it, is_full)).collect();
        if self.0.studies.iter().any(|it| it.planned.is_whole()) {
            parts.push(self.matrix().to_string());
        }
        let mut end = vec![self.tally()];
        end.extend(self.0.excluded().map(|it| match is_full {
            true => excluded::together(&it),
            false => excluded::counts_together(&it),
        }));
        end.extend(self.canaries());
        end.extend(next(self.0.next.as_ref()));
        parts.push(end.join("\n"));
        parts.join("\n\n")
    }

    /// A row for each study.
    fn matrix(&self) -> TextTable {
        let header = ["study", "field", "expected", "observed", "of", "verdict"];
        let caption = format!("studies of {}", shown(&self.0.plan.campaign.solver.name));
        let mut table = TextTable::new(caption, header).right_from(0);
        for judged in self.0.studies.iter().filter(|it| it.planned.is_whole()) {
            table.add_row(row(judged));
        }
        table
    }

    fn tally(&self) -> String {
        let finished =
            self.0.outcomes().filter(|(_, it)| matches!(it, RunOutcome::Finished(_))).count();
        let runs = format!("{finished} of {} runs are done", self.0.outcomes().count());
        let judged: Vec<_> = self.0.studies.iter().filter(|it| it.planned.is_whole()).collect();
        let passed = judged.iter().filter(|it| it.verdict().is_some_and(Verdict::is_good)).count();
        match judged.len() {
            0 => runs,
            all => format!("{runs}; {passed} of {all} studies pass"),
        }
    }

    /// The findings of the canaries: a line for each study that passes with a wrong b, or does not count.
    fn canaries(&self) -> Option<String> {
        let all = self.0.canaries.as_ref()?.len();
        let fails = self.0.with_canary(Canary::Fails).len();
        let open = self.0.with_canary(Canary::Open);
        let head = match (all, all - open.len()) {
            (0, _) => {
                Some("canary: no study has a body force, so none can be given a wrong one".into())
            }
            (_, 0) => None,
            (_, counted) => Some(format!(
                "canary: {fails} of {counted} studies fail with -b in place of b, as all must"
            )),
        };
        let left_out = open.into_iter().map(|name| {
            format!(
                "canary: {} does not count: the study does not pass with the right b either",
                shown(name)
            )
        });
        let head = head.into_iter().chain(left_out);
        let lines = self.0.with_canary(Canary::Passes).into_iter().map(|name| {
            format!(
                "{} passes with -b: it measures nothing. Does the solver use the b that it is given, and are these its results?",
                shown(name)
            )
        });
        Some(head.chain(lines).collect::<Vec<_>>().join("\n"))
    }

    /// The verdict of each study that does not pass, with its name.
    fn reasons(&self) -> Vec<String> {
        let judged = self.0.studies.iter().filter_map(|it| Some((it, it.judgements.as_ref()?)));
        let reason = |(it, judgements): (&JudgedStudy<'_>, &Judgements)| {
            let (at, _) = judgements.decided();
            let (quantity, found) = judgements.each().nth(at)?;
            let says = judgements.sentences(quantity, found, true).into_iter().next()?;
            Some(format!("{}: {says}", shown(&it.planned.study.name)))
        };
        judged.filter(|(_, it)| !it.verdict().is_good()).filter_map(reason).collect()
    }

    /// Writes campaign.json, and for each study its picture and its table; returns their paths.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        let mut paths = write_files(folder, "campaign", [("json", pretty(&self.0.document())?)])?;
        for judged in &self.0.studies {
            if let Some(judgements) = &judged.judgements {
                let own = folder.join(&judged.planned.study.name);
                let cannot = || format!("cannot write to `{}`", foreign::path(&own));
                refuse_link(&own, "folder").with_context(cannot)?;
                paths.extend(JudgementView(judgements).write_parts(&own)?);
            }
        }
        Ok(paths)
    }
}

impl View<'_> {
    /// The figure of all studies that were judged.
    pub fn figure(&self) -> Figure {
        let document = self.0.document();
        Figure::new(document.title(), document.plots())
    }
}

impl Shown for View<'_> {
    type Document = Campaign;

    fn text(&self) -> String {
        self.all(false)
    }

    fn full_text(&self) -> String {
        self.all(true)
    }

    fn markdown(&self) -> String {
        let runs = self.0.outcomes().filter_map(|(job, outcome)| failure(job, outcome));
        let mistakes = self.0.studies.iter().filter_map(|it| {
            Some(format!("{}: {}", shown(&it.planned.study.name), it.mistake.as_ref()?))
        });
        let quoted = |it: String| format!("```text\n{}\n```\n", it.replace("```", "` ` `"));
        let mut parts = vec![self.matrix().markdown(), self.tally() + "\n"];
        parts.extend(self.canaries().map(quoted));
        parts.extend(self.reasons().into_iter().chain(mistakes).chain(runs).map(quoted));
        parts.join("\n")
    }

    fn junit(&self) -> anyhow::Result<String> {
        Ok(junit::document(self.0))
    }

    fn tables(&self) -> Vec<TextTable> {
        vec![self.matrix()]
    }

    fn document(&self) -> Campaign {
        self.0.document()
    }
}

/// The parts of the text about a study: runs that failed, processes that they left, and its judgement.
fn parts(judged: &JudgedStudy<'_>, is_full: bool) -> Vec<String> {
    let mut parts = Vec::new();
    let name = shown(&judged.planned.study.name);
    let runs = judged.planned.jobs.iter().zip(&judged.outcomes);
    parts.extend(runs.clone().filter_map(|(job, outcome)| failure(job, outcome)));
    parts.extend(runs.filter_map(|(job, outcome)| left_behind(job, outcome)));
    parts.extend(judged.mistake.as_ref().map(|it| format!("{name}: {it}")));
    parts.extend(judged.judgements.as_ref().map(|it| match is_full || !it.verdict().is_good() {
        true => format!("study {name}\n{}", JudgementView(it).without_next(is_full)),
        false => {
            let says =
                it.each().flat_map(|(quantity, judged)| it.sentences(quantity, judged, false));
            format!("study {name}\n{}", says.collect::<Vec<_>>().join("\n"))
        }
    }));
    parts
}

/// The row of a study in the table of all.
fn row(judged: &JudgedStudy<'_>) -> Vec<String> {
    let dash = || "-".to_owned();
    let deciding = judged.judgements.as_ref().and_then(|it| JudgementView(it).deciding());
    let word = match (judged.verdict(), &judged.mistake) {
        (Some(verdict), _) => verdict.to_string(),
        (None, Some(_)) => "not judged: its results are no evidence".into(),
        (None, None) => "not judged: no results".into(),
    };
    vec![
        shown(&judged.planned.study.name),
        judged.planned.input.name.shown(),
        deciding.as_ref().map_or_else(dash, |it| it.expected.to_string()),
        deciding.as_ref().and_then(|it| it.observed.clone()).unwrap_or_else(dash),
        deciding.map_or_else(dash, |it| it.of),
        word,
    ]
}

/// The message for a run that failed.
fn failure(job: &Job, outcome: &RunOutcome) -> Option<String> {
    let RunOutcome::Failed { reason, last_words, folder } = outcome else { return None };
    let words: String = last_words.iter().map(|line| format!("\n    {}", one_line(line))).collect();
    let words = if words.is_empty() { "\n    (it printed nothing)".to_owned() } else { words };
    Some(format!(
        "{} failed: {}{words}\n  its whole output is in {}",
        shown(&job.name),
        reason,
        shown(folder)
    ))
}

/// The processes that a run left behind.
fn left_behind(job: &Job, outcome: &RunOutcome) -> Option<String> {
    let RunOutcome::Finished(Finished { left_behind, .. }) = outcome else { return None };
    let names: Vec<_> = left_behind.iter().map(|name| shown(name)).collect();
    (!names.is_empty()).then(|| {
        let name = shown(&job.name);
        format!("{name} left processes behind, which were ended: {}", names.join(", "))
    })
}

/// A run that ended, on one line.
pub fn line(job: &Job, outcome: &RunOutcome, is_new: bool) -> String {
    let name = shown(&job.name);
    match outcome {
        RunOutcome::Finished(it) if is_new => {
            let behind = left_behind_too(&it.left_behind);
            format!("{name}: done in {}{behind}", duration(it.seconds))
        }
        RunOutcome::Finished(_) => format!("{name}: was done before"),
        RunOutcome::Failed { reason, .. } => format!("{name}: {reason}"),
        RunOutcome::Interrupted => format!("{name}: interrupted"),
    }
}
