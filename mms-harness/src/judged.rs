//! Judges the results of a study, as `mms judge` does.

use mms_documents::provenance::Provenance;
use mms_exact::Exact;
use mms_files::results::Disk;
use mms_judge::measured::Measured;
use mms_judge::results::{Comparison, Measurement, Reading, Results, measure};
use mms_judge::{Judgements, Unfollowed};
use mms_results::Snapshot;

use super::plan::{Job, Judging, PlannedStudy};
use super::work::{CampaignRunner, RunOutcome};

/// The judgement of a study.
pub struct JudgedStudy<'a> {
    /// The study.
    pub planned: &'a PlannedStudy,
    /// The outcomes of its runs.
    pub outcomes: Vec<RunOutcome>,
    /// The errors and verdicts; `None` if it has no results, or not all levels were requested.
    pub judgements: Option<Judgements>,
    /// The reason why its results cannot be judged.
    pub mistake: Option<String>,
    /// Warnings about the results.
    pub warnings: Vec<String>,
}

impl<'a> JudgedStudy<'a> {
    /// Judges a study.
    ///
    /// # Errors
    /// Its field cannot be evaluated.
    pub fn new(
        work: &CampaignRunner<'_>,
        planned: &'a PlannedStudy,
        outcomes: Vec<RunOutcome>,
        provenance: &dyn Fn(&PlannedStudy) -> Provenance,
    ) -> anyhow::Result<Self> {
        let mut judged = JudgedStudy {
            planned,
            outcomes,
            judgements: None,
            mistake: None,
            warnings: Vec::new(),
        };
        let finished =
            planned.jobs.iter().zip(&judged.outcomes).filter_map(|(job, outcome)| match outcome {
                RunOutcome::Finished(finished) => Some((job, finished)),
                _ => None,
            });
        let mut files = Vec::new();
        let mut jobs = Vec::new();
        for (job, finished) in finished {
            files.push(work.results_of(planned, job, finished)?);
            jobs.push(job);
        }
        let interrupted = judged.outcomes.contains(&RunOutcome::Interrupted);
        if jobs.is_empty() || interrupted || !planned.is_whole() {
            return Ok(judged);
        }
        let mut exact = Exact::new(planned.input.clone(), &planned.study.set)?;
        match measured(&mut exact, planned, &jobs, &files) {
            Err(error) => judged.mistake = Some(format!("{error:#}")),
            Ok(mut measurement) => {
                judged.warnings = measurement.warnings.clone();
                stopped(&mut measurement.measured, planned, &jobs);
                let provenance = provenance(planned);
                let time_step = jobs.iter().filter_map(|job| job.time_step).reduce(f64::min);
                match Judgements::of_results(
                    &exact,
                    &files,
                    measurement,
                    time_step,
                    provenance,
                    &Unfollowed,
                ) {
                    Ok(judgements) => {
                        judged.judgements = Some(judgements.of_campaign());
                    }
                    Err(error) => judged.mistake = Some(format!("{error:#}")),
                }
            }
        }
        Ok(judged)
    }
}

fn measured(
    exact: &mut Exact,
    planned: &PlannedStudy,
    jobs: &[&Job],
    files: &[String],
) -> anyhow::Result<Measurement> {
    let PlannedStudy { study, options, .. } = planned;
    let Judging { names, over, quantities: wanted, weight, .. } = options;
    let (memory, is_part) = (study.max_memory, study.part);
    let (weight, over) = (*weight, *over);
    let reading = Reading { names, wanted, weight, memory, files: &Disk, is_part, over };
    let all: Vec<Results> =
        files.iter().map(|file| reading.find(file, exact)).collect::<anyhow::Result<_>>()?;
    let h: Vec<f64> = jobs.iter().map(|job| planned.size(job)).collect();
    // A single file without a time contains the end.
    let is_end = |it: &Results| matches!(it.snapshots.as_slice(), [Snapshot { time: None, .. }]);
    let times = match study.time.is_empty() && all.iter().all(is_end) {
        true => vec![planned.window[1]],
        false => study.time.clone(),
    };
    let comparison = Comparison {
        sizes: &h,
        times: &times,
        orders: &options.orders,
        has_steps: study.time_steps.is_some(),
        tighter: None,
        follow: &Unfollowed,
    };
    let mut measurement = measure(all, &reading, exact, comparison)?;
    if study.time_steps.is_some() {
        let runs = measurement.measured.runs.iter_mut().zip(jobs);
        runs.for_each(|(run, job)| run.time_step = job.time_step);
    }
    Ok(measurement)
}

/// Adds the runs without results as stopped runs.
fn stopped(measured: &mut Measured, planned: &PlannedStudy, finished: &[&Job]) {
    let is_missing = |job: &&Job| finished.iter().all(|other| other.level != job.level);
    for job in planned.jobs.iter().filter(is_missing) {
        let time_step = planned.study.time_steps.as_ref().and(job.time_step);
        measured
            .runs
            .push(mms_judge::measured::RunSize { cell_size: planned.size(job), time_step });
        for norm in measured.quantities.iter_mut().flat_map(|it| &mut it.norms) {
            norm.errors.push(None);
            norm.floors.push(0.0);
        }
    }
}

impl PlannedStudy {
    /// h of a run, as the file states it, or the size of its cells.
    pub fn size(&self, job: &Job) -> f64 {
        self.study.h_of(job.level).unwrap_or(job.cell_size)
    }
}
