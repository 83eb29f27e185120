//! `mms campaign`: an external solver on the meshes of several studies.

mod suggest;

use std::fmt::Display;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::{Context as _, bail};
use clap::Args;
use mms_campaign::Campaign as File;
use mms_documents::campaign::{CampaignRuns, ListedRun};
use mms_files::read::{self, FileKind};
use mms_files::shell::{command, quoted};
use mms_files::store::Store;
use mms_harness::canary;
use mms_harness::judged::JudgedStudy;
use mms_harness::only::Only;
use mms_harness::plan::{CampaignPlan, Job, PlannedStudy};
use mms_harness::report::Report;
use mms_harness::work::{self, CampaignRunner, Watcher, hash, side_by_side_of};
use mms_options::field::open;
use mms_report::campaign::{View, line};
use mms_spec::foreign;

use super::figure::FigureFile;
use super::format::{Detail, Printing};
use super::observers::Interrupted;
use super::{CommandOutcome, next, print, replaced, say, this_command, validate_output};
use crate::provenance::{Input, Provenance};

/// Run your own solver on the meshes of several studies, and judge each study as `mms judge` does.
///
/// FILE states how to run the solver ([solver]: run, output) and what to compute ([[study]]: field, cells, order). Commands
/// are started without a shell. `run`, `directory` and `output` may contain the placeholders {name}, {field}, {level},
/// {cells}, {cell_size}, {time_step}, {steps}, {start}, {end}, {force_factor}, {output}, {emitted}, {state}, {here}, and
/// {set.NAME} for a parameter; docs/guide/campaign.md explains them. Before a run, `emit` writes the source of the field, and
/// `state` or {state} writes the exact state at the start.
///
/// Each run has its own folder in the store, which also keeps its printed output. A run is done if its command succeeded and
/// its results can be read. A run is repeated only if one of its inputs changed: the command, the program that it starts, a
/// file that it names or that `sources` lists, the field, a version, or the results themselves.
///
/// Processes that a solver leaves behind are ended, and their names printed. Ctrl-C, Ctrl-\ and any other end of the campaign
/// end its runs; the same command continues with the remaining runs. If a run fails, its last lines are printed, other runs
/// continue, and the next call tries it again.
///
/// Exit codes: 0 all studies pass; 1 another verdict, or a pass with a wrong b; 2 bad usage, or a bad file; 3 a run failed,
/// or its results cannot be judged.
#[derive(Args)]
pub struct Campaign {
    /// The campaign file.
    file: PathBuf,
    /// Run only this study, or this level of it, as in bar_1d/3; may be repeated. A study is judged if all of its levels are
    /// selected.
    #[arg(long, value_name = "STUDY[/LEVEL]")]
    only: Vec<String>,
    /// The number of runs at the same time; by default the number of processors, divided by the `threads` of a run.
    #[arg(long, value_name = "N")]
    jobs: Option<NonZero<usize>>,
    /// Then run each study once more with -b in place of b, which must not pass: a study that passes with -b measures
    /// nothing. The wrong b is written to {emitted} and {state}, and {force_factor} is -1.
    #[arg(long, conflicts_with_all = ["dry_run", "list", "suggest"])]
    canary: bool,
    /// Print the runs and their commands, and which are done; run nothing.
    #[arg(long, conflicts_with = "figure")]
    dry_run: bool,
    /// Print a command for each run that is not done, for a scheduler that runs commands on other machines; run nothing. Each
    /// command makes one run and keeps its result in the folder of --store, which all machines share.
    #[arg(long, conflicts_with_all = ["dry_run", "figure"])]
    list: bool,
    /// Propose studies for the abilities that `can` declares, and run nothing: the fewest fields of the gallery that together
    /// show every term that such a solver can show. Terms that stay unseen are listed.
    #[arg(long, conflicts_with_all = ["dry_run", "list", "only", "output", "figure"])]
    suggest: bool,
    /// The folder for runs and their results; by default target/mms/campaign/NAME, with the name of FILE.
    #[arg(long, value_name = "DIR")]
    store: Option<PathBuf>,
    /// The folder to write campaign.json to, with a folder for each study for convergence.svg and .csv.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    figure: FigureFile,
    #[command(flatten)]
    detail: Detail,
    #[command(flatten)]
    printing: Printing,
}

impl Campaign {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        self.output.as_deref().map_or(Ok(()), validate_output)?;
        self.figure.validate()?;
        let text = read::text(&self.file, FileKind::Campaign)?;
        let file = mms_campaign::read(&self.file.to_string_lossy(), &text)?;
        if self.suggest {
            return self.propose(&file);
        }
        if file.studies.is_empty() {
            bail!(
                "`{}`: it has no [[study]]; `mms campaign FILE --suggest` proposes some",
                foreign::path(&self.file)
            );
        }
        let only: Vec<Only> = self.only.iter().cloned().map(Only::from).collect();
        let canaries = match self.canary {
            true => Some(canary::plan(&self.file, file.clone(), &only, &open)?),
            false => None,
        };
        let plan = CampaignPlan::new(&self.file, file, &only, &open)?;
        let given = self.folder();
        let (store, set_aside) = Store::open(&given)?;
        let folder = given.canonicalize().with_context(|| read::cannot_read(&given))?;
        let progress = Progress::new(&plan, canaries.as_ref())?;
        set_aside.iter().for_each(|what| progress.set_aside(what));
        let work = CampaignRunner::new(&plan, &store, &folder, &progress);
        match (self.dry_run, self.list) {
            (true, _) => self.show(&work),
            (_, true) => self.commands(&work),
            _ => self.carry_out(&work, canaries.as_ref(), &text),
        }
    }

    /// The folder of the store.
    fn folder(&self) -> PathBuf {
        let name = self.file.file_stem().unwrap_or_default();
        self.store.clone().unwrap_or_else(|| Path::new("target/mms/campaign").join(name))
    }

    /// Makes the runs of a plan, and judges its studies.
    fn judged<'a>(&self, work: &CampaignRunner<'a>) -> anyhow::Result<Vec<JudgedStudy<'a>>> {
        let jobs = self.jobs.unwrap_or_else(|| side_by_side_of(work.plan));
        let all = work.plan.studies.iter().zip(work.outcomes(jobs)?);
        all.map(|(planned, outcomes)| JudgedStudy::new(work, planned, outcomes, &signed)).collect()
    }

    fn carry_out(
        &self,
        work: &CampaignRunner<'_>,
        canaries: Option<&CampaignPlan>,
        text: &str,
    ) -> anyhow::Result<CommandOutcome> {
        let plan = work.plan;
        let mut studies = self.judged(work)?;
        let CampaignRunner { store, folder, watcher, .. } = *work;
        let canaries =
            canaries.map(|plan| self.judged(&CampaignRunner::new(plan, store, folder, watcher)));
        let canaries = canaries.transpose()?;
        for (study, warning) in
            studies.iter().flat_map(|it| it.warnings.iter().map(move |w| (it, w)))
        {
            say(format_args!("warning: {}: {warning}", study.planned.study.name));
        }
        let input = Input {
            field: None,
            rigid: None,
            window: None,
            set: Vec::new(),
            hash: hash(plan, text),
        };
        let next = next::after_campaign(&mut studies, &plan.here, &self.folder(), &next::typed());
        let provenance = this_command("campaign", input);
        let report = Report { plan, studies, canaries, next, provenance };
        self.tell(&report, work)
    }

    fn tell(
        &self,
        report: &Report<'_>,
        work: &CampaignRunner<'_>,
    ) -> anyhow::Result<CommandOutcome> {
        self.printing.print_in(self.detail, &View(report))?;
        let mut written = Vec::new();
        if let Some(folder) = &self.output {
            replaced::tell(folder, "campaign", &report.provenance);
            written.extend(View(report).write(folder)?);
        }
        written.extend(self.figure.write(|| View(report).figure())?);
        if !written.is_empty() && self.printing.is_text() {
            print(&format!("\nwrote {}", written.join(", ")))?;
        }
        if work.watcher.is_interrupted() {
            say("interrupted; finished runs are kept, and the same command continues");
        }
        Ok(match (report.has_failed(), report.is_refuted()) {
            (true, _) => CommandOutcome::RunFailed,
            (false, true) => CommandOutcome::Refuted,
            (false, false) => CommandOutcome::AsExpected,
        })
    }

    /// Shows the runs, and which of them are done.
    fn show(&self, work: &CampaignRunner<'_>) -> anyhow::Result<CommandOutcome> {
        let describe = |planned: &PlannedStudy, job: &Job, is_done: bool, words: Vec<String>| {
            let line = words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
            let state = if is_done { "done" } else { "to do" };
            let Job { name, cells, .. } = job;
            let steps = job.time_step.zip(job.steps);
            let steps = steps.map(|(step, count)| format!(", dt {step:.3e}, {count} steps"));
            let text = format!(
                "{}: {state}; {cells} cells, h {:.3e}{}\n  {line}",
                foreign::shown(name),
                planned.size(job),
                steps.unwrap_or_default()
            );
            (text, listed(job, is_done, &words))
        };
        self.each(work, "", |planned, job, is_done| {
            Ok(Some(describe(planned, job, is_done, work.command(planned, job)?)))
        })
    }

    /// Prints a command for each run that is not done.
    fn commands(&self, work: &CampaignRunner<'_>) -> anyhow::Result<CommandOutcome> {
        let [file, store] =
            [&self.file, &self.folder()].map(|it| it.to_string_lossy().into_owned());
        let head = ["campaign".to_owned(), file, format!("--store={store}")];
        let of = |job: &Job| [head.as_slice(), &[format!("--only={}", job.name)]].concat();
        self.each(work, "all runs are done", |_, job, is_done| {
            let words = of(job);
            let all = [&["mms".to_owned()], words.as_slice()].concat();
            Ok((!is_done).then(|| (command(&words), listed(job, is_done, &all))))
        })
    }

    /// Prints a line for each run; or `none`, if no run has one.
    fn each(
        &self,
        work: &CampaignRunner<'_>,
        none: &str,
        say_of: impl Fn(&PlannedStudy, &Job, bool) -> anyhow::Result<Option<(String, ListedRun)>>,
    ) -> anyhow::Result<CommandOutcome> {
        let (mut lines, mut documents) = (Vec::new(), Vec::new());
        for planned in &work.plan.studies {
            for job in &planned.jobs {
                let is_done = work.stored(planned, job)?.is_some();
                if let Some((line, document)) = say_of(planned, job, is_done)? {
                    lines.push(line);
                    documents.push(document);
                }
            }
        }
        if lines.is_empty() && self.printing.is_text() {
            say(none);
        } else {
            let document = CampaignRuns { runs: documents };
            self.printing.print_without_table(&lines.join("\n"), &document)?;
        }
        Ok(CommandOutcome::AsExpected)
    }

    fn propose(&self, file: &File) -> anyhow::Result<CommandOutcome> {
        let Some(can) = &file.solver.can else {
            bail!(
                "`{}`: `--suggest` needs the abilities of the solver; state them in [solver], as in can = {{ dimensions = \
                 [2] }}",
                foreign::path(&self.file)
            );
        };
        suggest::propose(can, self.printing)
    }
}

/// The origin of a judgement of a campaign.
fn signed(planned: &PlannedStudy) -> Provenance {
    this_command("judge", planned.input.provenance(&planned.study.set))
}

fn listed(job: &Job, is_done: bool, words: &[String]) -> ListedRun {
    ListedRun {
        name: job.name.clone(),
        level: job.level,
        cells: job.cells,
        cell_size: job.cell_size,
        time_step: job.time_step,
        steps: job.steps,
        done: is_done,
        command: words.to_vec(),
    }
}

/// A line on stderr for each run that ends.
struct Progress {
    all: usize,
    ended: AtomicUsize,
    interrupted: Interrupted,
}

impl Progress {
    fn new(plan: &CampaignPlan, canaries: Option<&CampaignPlan>) -> anyhow::Result<Self> {
        let studies = [Some(plan), canaries].into_iter().flatten().flat_map(|it| &it.studies);
        let all = studies.map(|it| it.jobs.len()).sum();
        Ok(Self { all, ended: AtomicUsize::new(0), interrupted: Interrupted::listen()? })
    }

    fn say(&self, what: impl Display) {
        let ended = self.ended.fetch_add(1, Ordering::Relaxed) + 1;
        say(format_args!("{ended} of {} runs: {what}", self.all));
    }
}

impl Watcher for Progress {
    fn done(&self, job: &Job, outcome: &work::RunOutcome, is_new: bool) {
        self.say(line(job, outcome, is_new));
    }

    fn set_aside(&self, what: &str) {
        say(format_args!("warning: {what}"));
    }

    fn is_interrupted(&self) -> bool {
        self.interrupted.is_set()
    }
}
