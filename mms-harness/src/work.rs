//! Makes the runs of a campaign that the store does not contain.

use std::collections::BTreeMap;
use std::io::{Read as _, Seek as _, SeekFrom};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use anyhow::{Context as _, anyhow, ensure};
use mms_campaign::process::{Folder, Launch};
use mms_campaign::supervisor::{Ended, Report};
use mms_codegen::rust::File;
use mms_emit::{Subject, Target};
use mms_exact::Exact;
use mms_files::program;
use mms_files::read::{self, Unread};
use mms_files::results::{Disk, existing};
use mms_files::shell::quoted;
use mms_files::store::{Entry, Store, digest, side_by_side};
use mms_files::write::write_own;
use mms_judge::results::{placed, room};
use mms_results::Files as _;
use mms_results::wanted::{self, Need};
use mms_runtime::Division;
use mms_spec::foreign;
use mms_state::domain::Domain;
use mms_state::file::{self, Frame};
use mms_state::points::Points;
use mms_state::{USUAL, Wanted};
use serde::{Deserialize, Serialize};

use super::digests::Content;
use super::plan::{CampaignPlan, Job, Paths, PlannedStudy, text};

/// The stored record of a finished run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Finished {
    /// The folder of the run, below the store.
    pub folder: String,
    /// The seconds that it took.
    pub seconds: f64,
    /// The files of its results, each with its digest.
    pub results: Vec<(String, String)>,
    /// The names of processes that it left behind, which were ended.
    pub left_behind: Vec<String>,
}

/// The outcome of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum RunOutcome {
    /// The run finished, now or before.
    Finished(Finished),
    /// The run failed.
    Failed {
        /// The reason.
        reason: String,
        /// The last lines that the run printed.
        last_words: Vec<String>,
        /// The folder with all output.
        folder: String,
    },
    /// The run was interrupted, or not started.
    Interrupted,
}

/// Receives events while runs go on.
pub trait Watcher: Sync {
    /// A run has ended, or was in the store.
    fn done(&self, job: &Job, outcome: &RunOutcome, is_new: bool);
    /// A file of the store was set aside.
    fn set_aside(&self, what: &str);
    /// Whether all runs are to end.
    fn is_interrupted(&self) -> bool;
}

/// A plan, and the store for its results.
pub struct CampaignRunner<'a> {
    /// The runs.
    pub plan: &'a CampaignPlan,
    /// The store of results.
    pub store: &'a Store,
    /// The folder of the store.
    pub folder: &'a Path,
    /// The receiver of events.
    pub watcher: &'a dyn Watcher,
    /// The sources of fields, by study.
    emitted: Mutex<BTreeMap<String, Arc<Vec<File>>>>,
}

impl<'a> CampaignRunner<'a> {
    /// The work on a plan; starts nothing.
    pub fn new(
        plan: &'a CampaignPlan,
        store: &'a Store,
        folder: &'a Path,
        watcher: &'a dyn Watcher,
    ) -> Self {
        CampaignRunner { plan, store, folder, watcher, emitted: Mutex::default() }
    }

    /// Makes the runs of each study, `jobs` of them at the same time, and returns their outcomes.
    ///
    /// # Errors
    /// The store cannot be read or written.
    pub fn outcomes(&self, jobs: NonZero<usize>) -> anyhow::Result<Vec<Vec<RunOutcome>>> {
        let all: Vec<_> = self
            .plan
            .studies
            .iter()
            .flat_map(|it| it.jobs.iter().map(move |job| (it, job)))
            .collect();
        let done =
            side_by_side(&all, jobs, |(planned, job), wait| self.outcome(planned, job, wait))?;
        let mut done = done.into_iter();
        let of_study = |planned: &PlannedStudy| {
            let outcomes = done.by_ref().take(planned.jobs.len()).collect();
            self.without_cut_tables(planned, outcomes)
        };
        self.plan.studies.iter().map(of_study).collect()
    }

    /// Withdraws runs with a table that ends within a line, if tables of other levels end with a whole line: the same program
    /// wrote all of them.
    fn without_cut_tables(
        &self,
        planned: &PlannedStudy,
        outcomes: Vec<RunOutcome>,
    ) -> anyhow::Result<Vec<RunOutcome>> {
        let cut: Vec<Option<PathBuf>> = outcomes.iter().map(|it| self.cut_table(it)).collect();
        let is_whole = |(outcome, cut): (&RunOutcome, &Option<PathBuf>)| {
            matches!(outcome, RunOutcome::Finished(_)) && cut.is_none()
        };
        if !outcomes.iter().zip(&cut).any(is_whole) {
            return Ok(outcomes);
        }
        let runs = planned.jobs.iter().zip(outcomes).zip(cut);
        let kept = runs.map(|((job, outcome), cut)| match (outcome, cut) {
            (RunOutcome::Finished(Finished { folder, .. }), Some(path)) => {
                let path = foreign::path(&path);
                let reason =
                    format!("`{path}` ends within a line, and tables of other levels do not");
                self.watcher.set_aside(&self.store.distrust(&job.key, &reason)?);
                let reason = format!("it ended well, but {reason}: it is cut");
                Ok(RunOutcome::Failed { reason, last_words: Vec::new(), folder })
            }
            (outcome, _) => Ok(outcome),
        });
        kept.collect()
    }

    /// The path of a result table that ends within a line.
    fn cut_table(&self, outcome: &RunOutcome) -> Option<PathBuf> {
        let RunOutcome::Finished(finished) = outcome else { return None };
        let paths = finished.results.iter().map(|(path, _)| Path::new(path));
        let mut tables = paths
            .filter(|path| path.extension().is_some_and(|end| end == "csv" || end == "tsv"))
            .map(|path| self.folder.join(&finished.folder).join(path));
        tables.find(|path| last_byte(path).is_ok_and(|byte| byte != b'\n'))
    }

    /// The stored record of a run, if its results still exist. Sets a record aside whose results have changed.
    ///
    /// # Errors
    /// The store cannot be read, or a file in it cannot be renamed.
    pub fn stored(&self, planned: &PlannedStudy, job: &Job) -> anyhow::Result<Option<Finished>> {
        let said = match self.store.load::<Finished>(&job.key)? {
            Entry::Missing => return Ok(None),
            Entry::SetAside(said) => said,
            Entry::Stored(finished) => match self.fault(planned, job, &finished)? {
                None => return Ok(Some(finished)),
                Some(Fault::Missing) => return Ok(None),
                Some(Fault::Changed(path)) => {
                    let reason = format!("`{}` has changed since the run", foreign::path(&path));
                    self.store.distrust(&job.key, &reason)?
                }
            },
        };
        self.watcher.set_aside(&said);
        Ok(None)
    }

    /// The first fault of the results of a run: a file is missing, has changed, or was added.
    fn fault(
        &self,
        planned: &PlannedStudy,
        job: &Job,
        finished: &Finished,
    ) -> anyhow::Result<Option<Fault>> {
        let folder = self.folder.join(&finished.folder);
        let wrong = finished.results.iter().find_map(|(path, digest)| {
            let path = folder.join(path);
            match self.plan.digests.of(&path) {
                None => Some(Fault::Missing),
                Some(found) => (found.text() != digest).then_some(Fault::Changed(path)),
            }
        });
        if wrong.is_some() {
            return Ok(wrong);
        }
        let is_new =
            |path: &PathBuf| finished.results.iter().all(|(own, _)| folder.join(own) != *path);
        Ok(match existing(&self.results_of(planned, job, finished)?) {
            Ok(paths) => paths.into_iter().find(is_new).map(Fault::Changed),
            Err(_) => Some(Fault::Missing),
        })
    }

    /// The outcome of a run; `None` if another process is making it and `wait` is false.
    fn outcome(
        &self,
        planned: &PlannedStudy,
        job: &Job,
        wait: bool,
    ) -> anyhow::Result<Option<RunOutcome>> {
        if let Some(finished) = self.stored(planned, job)? {
            return Ok(Some(self.told(job, RunOutcome::Finished(finished), false)));
        }
        let Some(_claim) = self.store.claim(&job.key, wait)? else { return Ok(None) };
        // The process that held the claim before may have finished.
        if let Some(finished) = self.stored(planned, job)? {
            return Ok(Some(self.told(job, RunOutcome::Finished(finished), false)));
        }
        if self.watcher.is_interrupted() {
            return Ok(Some(RunOutcome::Interrupted));
        }
        let outcome =
            self.run(planned, job).with_context(|| format!("`{}`", foreign::shown(&job.name)))?;
        if let RunOutcome::Finished(finished) = &outcome {
            self.store.save(&job.key, finished)?;
        }
        Ok(Some(self.told(job, outcome, true)))
    }

    fn told(&self, job: &Job, outcome: RunOutcome, is_new: bool) -> RunOutcome {
        self.watcher.done(job, &outcome, is_new);
        outcome
    }

    fn run(&self, planned: &PlannedStudy, job: &Job) -> anyhow::Result<RunOutcome> {
        let parent = self.parent(planned, job)?;
        let folder = Folder::free(&parent)
            .with_context(|| format!("cannot make a folder in `{}`", foreign::path(&parent)))?;
        let paths = self.paths(&folder.path)?;
        let own = text(folder.path.strip_prefix(self.folder).unwrap_or(&folder.path))?;
        let failed = |reason: String| RunOutcome::Failed {
            reason,
            last_words: folder.last_words(),
            folder: own.clone(),
        };
        if let Err(error) = self.prepare(planned, job, &paths) {
            return Ok(failed(format!("it was not started: {error:#}")));
        }
        let changed = || {
            let found = job.dependencies.iter().find(|it| it.has_changed(&self.plan.digests));
            found.map(|it| foreign::shown(&it.name))
        };
        if let Some(name) = changed() {
            return Ok(failed(format!(
                "it was not started: `{name}` has changed since the campaign began; run the same command again to use it as it is now"
            )));
        }
        let started = Instant::now();
        let Report { ended, left_behind } = self.start(planned, job, &paths, &folder)?;
        let seconds = started.elapsed().as_secs_f64();
        Ok(match (ended, changed()) {
            (Ended::Interrupted, _) => RunOutcome::Interrupted,
            (Ended::Badly(reason), _) => failed(reason + &left_behind_too(&left_behind)),
            (Ended::Well, Some(name)) => failed(format!(
                "`{name}` changed during the run, so its results belong to an unknown version; a run must write into \
                 {{output}}"
            )),
            (Ended::Well, None) => match self.results(planned, job, &paths, &folder.path) {
                Ok(results) => {
                    RunOutcome::Finished(Finished { folder: own, seconds, results, left_behind })
                }
                Err(error) => failed(format!("it ended well, but {error:#}")),
            },
        })
    }

    /// Runs the command in the folder of the run, and keeps its output there.
    fn start(
        &self,
        planned: &PlannedStudy,
        job: &Job,
        paths: &Paths,
        folder: &Folder,
    ) -> anyhow::Result<Report> {
        let solver = &self.plan.campaign.solver;
        let words: Vec<String> =
            solver.run.iter().map(|word| planned.fill(word, job, paths)).collect();
        let line = words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
        write_own(&folder.path.join("command.txt"), &(line + "\n"))?;
        let launch = Launch {
            supervisor: &program::words()?,
            words: &words,
            directory: &self.directory(planned, job, paths),
            variables: &[("OMP_NUM_THREADS", solver.threads.to_string())],
            limit: solver.time_limit,
        };
        Ok(folder.run(&launch, &|| self.watcher.is_interrupted())?)
    }

    /// The folder that contains one folder for each attempt of a run. Its name includes a part of the digest of the run's key,
    /// so that runs of the same level with other inputs have other folders.
    fn parent(&self, planned: &PlannedStudy, job: &Job) -> anyhow::Result<PathBuf> {
        let digest = digest([serde_json::to_string(&job.key)?]);
        let own = format!("{}-{}", job.level, &digest[..8]);
        Ok(self.folder.join(&planned.study.name).join(own))
    }

    /// The paths of a run in its folder.
    fn paths(&self, folder: &Path) -> anyhow::Result<Paths> {
        Ok(Paths {
            output: text(&folder.join("output"))?,
            emitted: text(&folder.join("emitted"))?,
            state: text(&folder.join("state").with_extension(self.state().unwrap_or_default()))?,
            here: text(&self.plan.here)?,
        })
    }

    /// The format of the exact state for runs, if they get one.
    fn state(&self) -> Option<&str> {
        self.plan.campaign.solver.state()
    }

    /// Makes the folder for results, and writes the input files of the run.
    fn prepare(&self, planned: &PlannedStudy, job: &Job, paths: &Paths) -> anyhow::Result<()> {
        make(Path::new(&paths.output))?;
        if let Some(target) = self.plan.target {
            self.emit(planned, target, paths)?;
        }
        match self.state() {
            Some(_) => {
                write_state(planned, job, &paths.state).context("the exact state at the start")
            }
            None => Ok(()),
        }
    }

    /// Writes the source of the field.
    fn emit(&self, planned: &PlannedStudy, target: &Target, paths: &Paths) -> anyhow::Result<()> {
        let folder = Path::new(&paths.emitted);
        make(folder)?;
        for file in self.sources(planned, target)?.iter() {
            let path = folder.join(&file.name);
            write_own(&path, &file.text)
                .with_context(|| format!("cannot write `{}`", foreign::path(&path)))?;
        }
        Ok(())
    }

    /// The source of the field of a study, with its parameters as defaults; made once for all of its runs.
    fn sources(&self, planned: &PlannedStudy, target: &Target) -> anyhow::Result<Arc<Vec<File>>> {
        // Other threads that need the source have to wait for it anyway.
        let mut all = self.emitted.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(files) = all.get(&planned.study.name) {
            return Ok(files.clone());
        }
        let input = planned.input_of_runs().with_defaults(&planned.study.set)?;
        let bundle = (target.emit)(&Subject::new(&input.compiled));
        let files = Arc::new(bundle.sources().to_vec());
        all.insert(planned.study.name.clone(), files.clone());
        Ok(files)
    }

    fn directory(&self, planned: &PlannedStudy, job: &Job, paths: &Paths) -> PathBuf {
        let own = self.plan.campaign.solver.directory.as_ref();
        let own = own.map_or(String::new(), |it| planned.fill(it, job, paths));
        self.plan.here.join(own)
    }

    /// The argument of `mms judge` for the results of a run.
    fn results_argument(
        &self,
        planned: &PlannedStudy,
        job: &Job,
        paths: &Paths,
    ) -> anyhow::Result<String> {
        let pattern = planned.pattern(&self.plan.campaign.solver.output, job, paths);
        text(&self.directory(planned, job, paths).join(pattern))
    }

    /// The argument of `mms judge` for the results of a finished run.
    ///
    /// # Errors
    /// A path that is no text.
    pub fn results_of(
        &self,
        planned: &PlannedStudy,
        job: &Job,
        finished: &Finished,
    ) -> anyhow::Result<String> {
        let paths = self.paths(&self.folder.join(&finished.folder))?;
        self.results_argument(planned, job, &paths)
    }

    /// The result files of a run, which must exist and be complete: all files that judging would read.
    fn results(
        &self,
        planned: &PlannedStudy,
        job: &Job,
        paths: &Paths,
        folder: &Path,
    ) -> anyhow::Result<Vec<(String, String)>> {
        let found = Mutex::new(BTreeMap::new());
        let open = |path: &Path, room: u64| {
            let bytes = Disk.bytes(path, room)?;
            let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
            found.insert(path.to_owned(), self.plan.digests.of(path));
            Ok(bytes)
        };
        for path in existing(&self.results_argument(planned, job, paths)?)? {
            ensure!(
                path.metadata().is_ok_and(|it| it.len() > 0),
                "`{}` is empty",
                foreign::path(&path)
            );
            let (bytes, advice) = room(None, &Disk);
            let wanted = wanted::Wanted::new(|_| Need::Numbers).within(bytes, advice);
            let wanted = wanted.named(&planned.options.names.columns);
            mms_results::read(&path, &open, &wanted).map_err(placed)?;
        }
        let found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
        let file = |(path, content): (PathBuf, Option<Content>)| {
            let content = content.with_context(|| read::cannot_read(&path))?;
            let own = path.strip_prefix(folder).unwrap_or(&path);
            Ok((text(own)?, content.text().to_owned()))
        };
        found.into_iter().map(file).collect()
    }

    /// The words of a run, in the folder of its first attempt.
    ///
    /// # Errors
    /// A path that is no text.
    pub fn command(&self, planned: &PlannedStudy, job: &Job) -> anyhow::Result<Vec<String>> {
        let paths = self.paths(&self.parent(planned, job)?.join("1"))?;
        let words = self.plan.campaign.solver.run.iter();
        Ok(words.map(|word| planned.fill(word, job, &paths)).collect())
    }
}

fn last_byte(path: &Path) -> Result<u8, Unread> {
    let mut file = read::open(path)?;
    let mut byte = [0];
    file.seek(SeekFrom::End(-1))?;
    file.read_exact(&mut byte)?;
    Ok(byte[0])
}

/// A fault in the results of a run.
enum Fault {
    /// A file is missing.
    Missing,
    /// A file has changed since the run, or is not from the run.
    Changed(PathBuf),
}

/// The end of a sentence that names the processes left behind by a run; empty if there are none.
pub fn left_behind_too(names: &[String]) -> String {
    let shown: Vec<_> = names.iter().map(|name| foreign::shown(name)).collect();
    match shown.is_empty() {
        true => String::new(),
        false => format!("; it left processes behind, which were ended: {}", shown.join(", ")),
    }
}

/// Writes the exact state at the start, at the particles of a grid of the level.
fn write_state(planned: &PlannedStudy, job: &Job, path: &str) -> anyhow::Result<()> {
    let (study, input, [start, _]) = (&planned.study, planned.input_of_runs(), &planned.window);
    let file: file::Target = path.parse().map_err(anyhow::Error::msg)?;
    let scene = input.scene(&study.set, |code| code.double)?;
    let points = Points::of_grid(&scene, &Division::Uniform(job.cells), planned.per_cell)?;
    let mut exact = Exact::new(input.clone(), &study.set)?;
    let domain = &Domain::of(&mut exact)?;
    let wanted = Wanted { quantities: &USUAL, without: &[], names: file.names(), domain };
    wanted.validate_memory(&exact, &points, 1)?;
    file.write(&[Frame::new(&wanted, &mut exact, &points, *start)?], domain)?;
    Ok(())
}

fn make(folder: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(folder)
        .map_err(|error| anyhow!("cannot make the folder `{}`: {error}", foreign::path(folder)))
}

/// The default number of runs at the same time: as many as the processors allow.
pub fn side_by_side_of(plan: &CampaignPlan) -> NonZero<usize> {
    let processors = std::thread::available_parallelism().map_or(1, NonZero::get);
    let jobs = processors / plan.campaign.solver.threads.get();
    NonZero::new(jobs).unwrap_or(NonZero::<usize>::MIN)
}

/// The hash of the fields of a plan, for the provenance.
pub fn hash(plan: &CampaignPlan, file: &str) -> String {
    let fields = plan.studies.iter().map(|it| it.input.compiled.input_hash());
    digest([file, &fields.collect::<String>()])
}
