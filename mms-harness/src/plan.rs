//! The runs of a campaign.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail};
use mms_campaign::template::{PARAMETER, Placeholder, Template};
use mms_campaign::{Campaign, Study};
use mms_codegen::Options;
use mms_codegen::variation::Variation;
use mms_emit::{TARGETS, Target};
use mms_exact::validate_division;
use mms_exact::wave::sound;
use mms_exact::{Input, Open, quantities};
use mms_judge::results::{Over, Start as How, axes, own_roles, weight};
use mms_judge::table::{ExpectedOrders, NamedOrder};
use mms_mechanics::sample::domain;
use mms_results::names::{Mapping, Names, Role};
use mms_runtime::Division;
use mms_spec::foreign;
use mms_spec::quantity::Quantity;
use mms_spec::source::Spanned;
use mms_spec::suggest::advice;
use mms_state::points::PER_CELL;
use serde::Serialize;

use super::dependencies::{self, Dependencies, Dependency, UNKNOWN};
use super::digests::Digests;
use super::only::{self, Only};
use super::sources;
use crate::profile;

/// A campaign, ready to run.
pub struct CampaignPlan {
    /// The contents of the file.
    pub campaign: Campaign,
    /// The folder of the file.
    pub here: PathBuf,
    /// The language in which fields are written.
    pub target: Option<&'static Target>,
    /// The requested studies.
    pub studies: Vec<PlannedStudy>,
    /// The digests of the files that runs depend on.
    pub digests: Digests,
}

/// A study, with its words resolved.
pub struct PlannedStudy {
    /// The contents of the file.
    pub study: Study,
    /// The field.
    pub input: Input,
    /// The field that its runs get in place of `input`, for a canary.
    pub canary_input: Option<Input>,
    /// The first and the last time.
    pub window: [f64; 2],
    /// The options for judging its results.
    pub options: Judging,
    /// Particles in each direction of a cell.
    pub per_cell: Division,
    /// The requested runs.
    pub jobs: Vec<Job>,
}

/// The options of `mms judge`.
pub struct Judging {
    /// The quantities to judge; empty for all that are found.
    pub quantities: Vec<Quantity>,
    /// The names of arrays.
    pub names: Names,
    /// Whether norms are over points or over cells.
    pub over: Option<Over>,
    /// The expected orders.
    pub orders: ExpectedOrders,
    /// The column with the weights of means.
    pub weight: Option<Role>,
}

impl PlannedStudy {
    /// The field that its runs get.
    pub fn input_of_runs(&self) -> &Input {
        self.canary_input.as_ref().unwrap_or(&self.input)
    }

    /// Whether all of its levels were requested, so that it can be judged.
    pub fn is_whole(&self) -> bool {
        self.jobs.len() == self.study.levels()
    }
}

/// One run.
pub struct Job {
    /// `study/level`.
    pub name: String,
    /// The level, from 1 on.
    pub level: usize,
    /// Cells along the longest edge of the body.
    pub cells: usize,
    /// h.
    pub cell_size: f64,
    /// dt; `None` for a static field.
    pub time_step: Option<f64>,
    /// The number of time steps; `None` for a static field.
    pub steps: Option<u64>,
    /// The settings that the result depends on, including whether b is wrong.
    pub key: Key,
    /// The files that the result depends on.
    pub dependencies: Vec<Dependency>,
}

/// Everything that the result of a run depends on.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Key {
    /// The version of this program.
    pub version: &'static str,
    /// The version of the solver, as the file states it.
    pub solver: Option<String>,
    /// The words of the command; paths that this program chooses stay placeholders.
    pub command: Vec<String>,
    /// The working directory.
    pub directory: String,
    /// The files of its results.
    pub output: String,
    /// Digests of the files that the command starts or names, and of the files that the campaign file lists.
    pub files: BTreeMap<String, String>,
    /// The folder of the file, if the command may start something without a digest.
    pub folder: Option<String>,
    /// The language in which the field is written.
    pub emit: Option<&'static str>,
    /// The exact state from which it starts, if it gets one.
    pub state: Option<Start>,
    /// The digest of the text of the field, and of its own material.
    pub field: String,
    /// Parameters.
    pub set: Vec<String>,
    /// Whether it gets a wrong b.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub is_canary: bool,
}

/// The data of an exact state at the start besides the field and its parameters.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Start {
    /// The format of its file.
    pub format: String,
    /// Cells of the grid whose particles are its points.
    pub cells: usize,
    /// Particles in each direction of a cell.
    pub per_cell: String,
}

impl Start {
    fn new(format: &str, cells: usize, per_cell: Division) -> Self {
        Start { format: format.to_owned(), cells, per_cell: per_cell.to_string() }
    }
}

impl CampaignPlan {
    /// Plans the runs of a file, all or some; `open` opens their fields.
    ///
    /// # Errors
    /// A mistake in the file, at its place.
    pub fn new(
        path: &Path,
        campaign: Campaign,
        only: &[Only],
        open: Open<'_>,
    ) -> anyhow::Result<Self> {
        Self::with(path, campaign, only, open, false)
    }

    /// Plans the runs; canaries get -b for b.
    pub(crate) fn with(
        path: &Path,
        campaign: Campaign,
        only: &[Only],
        open: Open<'_>,
        is_canary: bool,
    ) -> anyhow::Result<Self> {
        only::validate(&campaign, only)?;
        let here = folder_of(path)?;
        let target = target(&campaign)?;
        let digests = Digests::default();
        let sources = sources(&campaign, &here, &digests)?;
        let mut studies = Vec::new();
        for study in &campaign.studies {
            let is_asked =
                |level: &usize| only.is_empty() || only.iter().any(|it| it.takes(study, *level));
            let levels: Vec<usize> = (1..=study.levels()).filter(is_asked).collect();
            if !levels.is_empty() {
                let (campaign, here) = (&campaign, here.as_path());
                let sources = &sources;
                let digests = &digests;
                let setting =
                    CampaignContext { campaign, here, target, sources, digests, open, is_canary };
                studies.push(setting.planned(study, &levels)?);
            }
        }
        Ok(CampaignPlan { campaign, here, target, studies, digests })
    }
}

/// The texts of a file with placeholders.
pub(crate) fn templates(campaign: &Campaign) -> impl Iterator<Item = &Template> {
    let solver = &campaign.solver;
    solver.run.iter().chain(&solver.directory).chain([&solver.output])
}

/// The absolute folder of a file, which is independent of the working directory of a run.
fn folder_of(path: &Path) -> anyhow::Result<PathBuf> {
    let folder = path.parent().filter(|it| !it.as_os_str().is_empty()).unwrap_or(Path::new("."));
    folder.canonicalize().with_context(|| format!("no folder `{}`", foreign::path(folder)))
}

/// The language in which fields are written.
fn target(campaign: &Campaign) -> anyhow::Result<Option<&'static Target>> {
    let Some(word) = &campaign.solver.emit else { return Ok(None) };
    Target::find(&word.value).map(Some).ok_or_else(|| {
        let names = TARGETS.iter().map(|target| target.name);
        let help = advice(&word.value, names, |all| format!("the targets are {all}"));
        let message = format!("`emit`: no target `{}`; {help}", foreign::shown(&word.value));
        campaign.mistake(word.span, message, "unknown").into()
    })
}

/// The files that the campaign file lists.
fn sources(campaign: &Campaign, here: &Path, digests: &Digests) -> anyhow::Result<Vec<Dependency>> {
    let mut all = Vec::new();
    for word in &campaign.solver.sources {
        let found = sources::files(here, &word.value)
            .map_err(|why| campaign.mistake(word.span, format!("`sources`: {why}"), "this"))?;
        all.extend(found.iter().filter_map(|path| Dependency::new(path, here, digests)));
    }
    Ok(all)
}

/// The data that all studies of a file share.
struct CampaignContext<'a> {
    campaign: &'a Campaign,
    here: &'a Path,
    target: Option<&'static Target>,
    sources: &'a [Dependency],
    digests: &'a Digests,
    open: Open<'a>,
    is_canary: bool,
}

impl CampaignContext<'_> {
    /// The value of an option of `mms judge` from a word of the file, or a mistake at its place.
    fn option<T>(
        &self,
        word: &Spanned<String>,
        key: &str,
        value: Result<T, String>,
    ) -> anyhow::Result<T> {
        value.map_err(|why| {
            self.campaign.mistake(word.span, format!("`{key}`: {why}"), "this").into()
        })
    }

    fn options<T>(
        &self,
        words: &[Spanned<String>],
        key: &str,
        value: impl Fn(&str) -> Result<T, String>,
    ) -> anyhow::Result<Vec<T>> {
        words.iter().map(|word| self.option(word, key, value(&word.value))).collect()
    }

    /// The field of a study; a path starts from the folder of the file.
    fn field(&self, study: &Study, variation: Variation) -> anyhow::Result<Input> {
        let field = &study.field;
        let path = self.here.join(&field.value);
        let is_path = field.value.ends_with(".toml");
        let named = if is_path { path.to_string_lossy() } else { field.value.as_str().into() };
        let options = Options { variation, ..Options::default() };
        let input = (self.open)(&named).and_then(|source| Input::new(source, &options));
        let input = input.and_then(|input| input.validate_settings(&study.set).map(|()| input));
        input.map_err(|error| {
            let why = format!("{error:#}");
            let (first, rest) = why.split_once('\n').unwrap_or((&why, ""));
            let mistake = self.campaign.mistake(field.span, format!("`field`: {first}"), "this");
            anyhow!("{mistake}\n{rest}")
        })
    }

    fn planned(&self, study: &Study, levels: &[usize]) -> anyhow::Result<PlannedStudy> {
        let input = self.field(study, Variation::Nothing)?;
        let canary_input = match self.is_canary {
            true => Some(self.field(study, Variation::ForceReversed)?),
            false => None,
        };
        let settings = input.settings(&study.set)?;
        let parameters = input.compiled.parameters::<f64>(&settings);
        let (_, [first, last]) = domain(&input.compiled.program, &parameters);
        self.validate_static(study, &input)?;
        self.validate_parameters(study, &input)?;
        let end = study.end.unwrap_or(last);
        if !(end > first && end <= last) {
            let message = format!("`end`: the time window of the field is {first:?} to {last:?}");
            return Err(self.campaign.mistake(study.span, message, "of this study").into());
        }
        let speed = sound(&input.compiled, &settings)[1];
        let (window, per_cell) = ([first, end], self.per_cell(study, &input)?);
        let place = StudyContext { setting: self, study, input: &input, window, per_cell, speed };
        let jobs = levels.iter().map(|&level| place.job(level)).collect::<Result<_, _>>()?;
        let options = self.judging(study, &input)?;
        Ok(PlannedStudy {
            study: study.clone(),
            window,
            options,
            per_cell,
            jobs,
            input,
            canary_input,
        })
    }

    /// Refuses times for a static field.
    fn validate_static(&self, study: &Study, input: &Input) -> anyhow::Result<()> {
        if !input.is_static() {
            return Ok(());
        }
        let keys = [
            ("time_steps", study.time_steps.is_some()),
            ("end", study.end.is_some()),
            ("time", !study.time.is_empty()),
        ];
        let key = keys.into_iter().find(|(_, is_given)| *is_given).map(|(key, _)| key.to_owned());
        let timed =
            templates(self.campaign).flat_map(Template::placeholders).find(|it| it.is_time());
        let Some(found) = key.or_else(|| Some(format!("{{{}}}", timed?.name()))) else {
            return Ok(());
        };
        let message = format!("`{found}`: `{}` is static, and has no time", input.name.shown());
        let label = "leave it out; the last result of each run counts";
        Err(self.campaign.mistake(study.field.span, message, label).into())
    }

    /// Refuses placeholders for parameters that the field of a study does not have.
    fn validate_parameters(&self, study: &Study, input: &Input) -> anyhow::Result<()> {
        let parameters = &input.compiled.model.parameters;
        let known = |name: &str| parameters.iter().any(|it| it.name == name);
        let Some(unknown) =
            templates(self.campaign).flat_map(Template::parameters).find(|it| !known(it))
        else {
            return Ok(());
        };
        let names = parameters.iter().map(|it| it.name.as_str());
        let help = advice(unknown, names, |all| format!("it has {all}"));
        let message = format!(
            "`{{{PARAMETER}{}}}`: `{}` has no such parameter; {help}",
            foreign::shown(unknown),
            input.name.shown()
        );
        Err(self.campaign.mistake(study.field.span, message, "this field").into())
    }

    /// Particles in each direction of a cell, as the file states it, or the default.
    fn per_cell(&self, study: &Study, input: &Input) -> anyhow::Result<Division> {
        let Some(word) = &study.particles_per_cell else { return Ok(PER_CELL) };
        let dimension = input.compiled.field.dimension;
        let found = word.value.parse::<Division>().map_err(|error| error.to_string());
        let held = found.and_then(|it| {
            validate_division("particles_per_cell", &it, dimension)
                .map_err(|error| error.to_string())?;
            Ok(it)
        });
        self.option(word, "particles_per_cell", held)
    }

    fn judging(&self, study: &Study, input: &Input) -> anyhow::Result<Judging> {
        let own = input.own_quantities();
        let text =
            |word: &str| quantities(&own, &[word.to_owned()]).map_err(|error| error.to_string());
        let quantities = self.options(&study.quantity, "quantity", text)?.concat();
        let own = own_roles(&own);
        let map = self.options(&study.map, "map", |word| Mapping::read(word, &own))?;
        let columns = study.columns.iter().map(|word| word.value.clone()).collect();
        let profile = |word: &Spanned<String>| {
            let path = self.here.join(&word.value).to_string_lossy().into_owned();
            let given = if word.value.ends_with(".toml") { &path } else { &word.value };
            self.option(word, "from", profile::find(given).map_err(|error| format!("{error:#}")))
        };
        let profile = study.from.as_ref().map(profile).transpose()?;
        let over = |word: &Spanned<String>| self.option(word, "over", Over::of(&word.value));
        let over = study.over.as_ref().map(over).transpose()?;
        let names = Names { map, columns, profile, own, axes: axes(&input.compiled.field) };
        let order = |word: &str| word.parse::<NamedOrder>().map_err(str::to_owned);
        let orders =
            ExpectedOrders::new(&self.options(&study.order, "order", order)?, study.tolerance);
        let of = |word: &Spanned<String>| {
            self.option(word, "weight", weight(&word.value).map_err(str::to_owned))
        };
        let weight = study.weight.as_ref().map(of).transpose()?;
        let start = |word: &Spanned<String>| self.option(word, "start", How::of(&word.value));
        let orders =
            ExpectedOrders { start: study.start.as_ref().map(start).transpose()?, ..orders };
        Ok(Judging { quantities, names, over, orders, weight })
    }
}

/// The data that all runs of a study share.
struct StudyContext<'a> {
    setting: &'a CampaignContext<'a>,
    study: &'a Study,
    input: &'a Input,
    window: [f64; 2],
    per_cell: Division,
    /// The speed c0 of the fastest wave at F = I, at its greatest over the body.
    speed: f64,
}

impl StudyContext<'_> {
    fn job(&self, level: usize) -> anyhow::Result<Job> {
        let study = self.study;
        let cells = study.cells_of(level);
        let scene = self.input.scene::<f64>(&study.set, |code| code.double)?;
        let cell_size = scene.cell_size(&Division::Uniform(cells));
        let (time_step, steps) = match self.input.is_static() {
            true => (None, None),
            false => self.steps(level, cell_size).map(|(step, steps)| (Some(step), Some(steps)))?,
        };
        let is_canary = self.setting.is_canary;
        let with = if is_canary { " with -b" } else { "" };
        let name = format!("{}/{level}{with}", study.name);
        let key = Key {
            version: env!("CARGO_PKG_VERSION"),
            solver: None,
            command: Vec::new(),
            directory: String::new(),
            output: String::new(),
            files: BTreeMap::new(),
            folder: None,
            emit: self.setting.target.map(|target| target.name),
            state: self
                .setting
                .campaign
                .solver
                .state()
                .map(|it| Start::new(it, cells, self.per_cell)),
            field: self.input.compiled.input_hash(),
            set: study.set.clone(),
            is_canary,
        };
        let job =
            Job { name, level, cells, cell_size, time_step, steps, key, dependencies: Vec::new() };
        Ok(self.with_command(job))
    }

    /// dt as the file states it, or the longest dt of the Courant number that divides the window; and the number of steps.
    fn steps(&self, level: usize, cell_size: f64) -> anyhow::Result<(f64, u64)> {
        let duration = self.window[1] - self.window[0];
        let given = self.study.time_step_of(level);
        let longest = given.unwrap_or(self.study.courant * cell_size / self.speed);
        // Round-off must not add a step to a whole number of steps.
        let steps = (duration / longest * (1.0 - 1e-6)).ceil().max(1.0);
        if !(steps.is_finite() && steps < 1e12) {
            bail!(
                "`{}`: level {} would take {steps:e} steps of {longest:e}; give `time_steps`, or fewer `cells`",
                foreign::shown(&self.study.name),
                level
            );
        }
        Ok((given.unwrap_or(duration / steps), steps as u64))
    }

    /// Adds the data that the result depends on.
    fn with_command(&self, mut job: Job) -> Job {
        let CampaignContext { campaign, here, .. } = *self.setting;
        let solver = &campaign.solver;
        let value = |it: Placeholder| match it.is_path() {
            true => format!("{{{}}}", it.name()),
            false => self.value(&job, it),
        };
        let fill = |template: &Template| template.fill(value, |name| self.parameter(name));
        let command: Vec<String> = solver.run.iter().map(fill).collect();
        let directory = solver.directory.as_ref().map_or("{here}".to_owned(), fill);
        let output = fill(&solver.output);
        let found = self.dependencies(&job);
        job.key.folder = (!found.is_complete).then(|| here.to_string_lossy().into_owned());
        job.dependencies =
            found.files.into_values().chain(self.setting.sources.iter().cloned()).collect();
        let digest = |it: &Dependency| (it.name.clone(), it.content.text().to_owned());
        job.key.files = job.dependencies.iter().map(digest).collect();
        job.key.solver = solver.version.clone();
        (job.key.command, job.key.directory, job.key.output) = (command, directory, output);
        job
    }

    /// The files that the command of a run depends on.
    fn dependencies(&self, job: &Job) -> Dependencies {
        let CampaignContext { campaign, here, digests, .. } = *self.setting;
        let value = |it: Placeholder| match it {
            Placeholder::Here => here.to_string_lossy().into_owned(),
            it if it.is_path() => UNKNOWN.to_string(),
            it => self.value(job, it),
        };
        let solver = &campaign.solver;
        let fill = |template: &Template| template.fill(value, |name| self.parameter(name));
        let words: Vec<String> = solver.run.iter().map(fill).collect();
        let directory = solver.directory.as_ref().map_or(String::new(), fill);
        let directory = (!directory.contains(UNKNOWN)).then(|| here.join(directory));
        dependencies::SearchFolders { here, directory: directory.as_deref(), digests }
            .dependencies(&words)
    }

    fn value(&self, job: &Job, placeholder: Placeholder) -> String {
        let of = (self.study, self.input, self.per_cell);
        value(of, self.window, job, placeholder)
    }

    fn parameter(&self, name: &str) -> String {
        parameter(self.study, self.input, name)
    }
}

/// The value of a parameter of a study, with the digits of a double.
fn parameter(study: &Study, input: &Input, name: &str) -> String {
    let set = input.settings(&study.set).unwrap_or_default();
    let values = input.compiled.parameters::<f64>(&set);
    let at = input.compiled.model.parameters.iter().position(|it| it.name == name);
    at.and_then(|at| values.get(at)).map_or_else(String::new, |value| format!("{value:?}"))
}

/// The value of a placeholder that is no path.
fn value(
    (study, input, per_cell): (&Study, &Input, Division),
    [start, end]: [f64; 2],
    job: &Job,
    placeholder: Placeholder,
) -> String {
    match placeholder {
        Placeholder::Name => study.name.clone(),
        Placeholder::Field => input.name.raw().to_owned(),
        Placeholder::Level => job.level.to_string(),
        Placeholder::Cells => job.cells.to_string(),
        Placeholder::ParticlesPerCell => per_cell.to_string(),
        Placeholder::CellSize => format!("{:?}", job.cell_size),
        Placeholder::TimeStep => job.time_step.map_or_else(String::new, |it| format!("{it:?}")),
        Placeholder::Steps => job.steps.map_or_else(String::new, |it| it.to_string()),
        Placeholder::Start => format!("{start:?}"),
        Placeholder::End => format!("{end:?}"),
        Placeholder::ForceFactor => if job.key.is_canary { "-1" } else { "1" }.to_owned(),
        Placeholder::Output | Placeholder::Emitted | Placeholder::State | Placeholder::Here => {
            String::new()
        }
    }
}

/// The folders and files of a run for its command.
pub struct Paths {
    /// The folder for its results.
    pub output: String,
    /// The folder with the source of the field.
    pub emitted: String,
    /// The file with the exact state at the start.
    pub state: String,
    /// The folder of the campaign file.
    pub here: String,
}

impl PlannedStudy {
    /// Fills a text of the file for one of the runs.
    pub fn fill(&self, template: &Template, job: &Job, paths: &Paths) -> String {
        template.fill(|it| self.value(job, paths, it), |name| self.parameter(name))
    }

    /// Fills a pattern for one of the runs; special characters in the filled values are escaped.
    pub fn pattern(&self, template: &Template, job: &Job, paths: &Paths) -> String {
        let plain = self.fill(template, job, paths);
        let own = template.fill(|_| String::new(), |_| String::new());
        if !own.contains(['*', '?', '[']) {
            return plain;
        }
        template.fill(
            |it| glob::Pattern::escape(&self.value(job, paths, it)),
            |name| glob::Pattern::escape(&self.parameter(name)),
        )
    }

    fn parameter(&self, name: &str) -> String {
        parameter(&self.study, &self.input, name)
    }

    fn value(&self, job: &Job, paths: &Paths, placeholder: Placeholder) -> String {
        match placeholder {
            Placeholder::Output => paths.output.clone(),
            Placeholder::Emitted => paths.emitted.clone(),
            Placeholder::State => paths.state.clone(),
            Placeholder::Here => paths.here.clone(),
            other => value((&self.study, &self.input, self.per_cell), self.window, job, other),
        }
    }
}

/// A path as UTF-8 text, which commands need.
pub fn text(path: &Path) -> anyhow::Result<String> {
    let text = path.to_str().map(str::to_owned);
    text.ok_or_else(|| anyhow!("`{}`: expected a path in UTF-8", foreign::path(path)))
}
