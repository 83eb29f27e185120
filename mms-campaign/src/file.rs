//! The contents of a campaign file.

use std::fmt;
use std::num::NonZero;
use std::time::Duration;

use mms_spec::diagnostic::{Diagnostic, quoted, render};
use mms_spec::source::{Sources, Span, Spanned};
use toml::de::DeValue;

use crate::capabilities::{self, Capabilities, validate_word};
use crate::set::{self, SweepPoint};
use crate::table::{Reader, Table, Value, digits, each, number};
use crate::template::{Placeholder, Template, Wrong};

/// The formats of exact states, the usual one first.
const STATES: &[&str] = &["vtu", "npz", "csv"];

/// The default time limit of a run, in seconds.
const TIME_LIMIT: f64 = 3600.0;

/// The default Courant number of time steps.
const COURANT: f64 = 0.4;

/// The default tolerance of orders.
const TOLERANCE: f64 = 0.15;

/// A solver, and the studies that it runs.
#[derive(Clone, Debug)]
pub struct Campaign {
    /// The text, for messages about it.
    pub sources: Sources,
    /// The command of the solver, and its surroundings.
    pub solver: Solver,
    /// The studies to run, with unique names. A study with lists in `set` has one entry for each of their steps.
    pub studies: Vec<Study>,
}

/// The command of a solver, and its surroundings.
#[derive(Clone, Debug)]
pub struct Solver {
    /// The name of the solver.
    pub name: String,
    /// A text that changes with the solver's version.
    pub version: Option<String>,
    /// More files that its results depend on, besides the files that the command names: paths and patterns.
    pub sources: Vec<Spanned<String>>,
    /// The words of its command line.
    pub run: Vec<Template>,
    /// The working directory; by default the folder of the file.
    pub directory: Option<Template>,
    /// The files of its results: a path or a pattern.
    pub output: Template,
    /// The number of threads of a run.
    pub threads: NonZero<usize>,
    /// The time limit of a run.
    pub time_limit: Duration,
    /// The language in which the field is written before a run.
    pub emit: Option<Spanned<String>>,
    /// The format of the exact state, `vtu`, `npz` or `csv`, if the file states it.
    pub state: Option<Spanned<String>>,
    /// The abilities of the solver.
    pub can: Option<Capabilities>,
}

/// A field, and the meshes on which a solver runs it.
#[derive(Clone, Debug)]
pub struct Study {
    /// The name; if a list of `set` made this study, followed by the values of its parameters.
    pub name: String,
    /// The name of the study in the file, shared by all studies that its lists of `set` make.
    pub family: String,
    /// A gallery name, or the path of a field file.
    pub field: Spanned<String>,
    /// Cells along the longest edge of the body, on each level.
    pub cells: Vec<usize>,
    /// dt on each level, if the file states it.
    pub time_steps: Option<Vec<f64>>,
    /// Whether each time step is combined with each number of cells.
    pub grid: bool,
    /// Particles in each direction of a cell, if the file states it.
    pub particles_per_cell: Option<Spanned<String>>,
    /// The Courant number for dt if the file does not state dt.
    pub courant: f64,
    /// The last time; by default the last time of the field.
    pub end: Option<f64>,
    /// The expected orders, in the form of `mms judge`.
    pub order: Vec<Spanned<String>>,
    /// The tolerance of the order.
    pub tolerance: f64,
    /// The quantities to judge; by default all that are found.
    pub quantity: Vec<Spanned<String>>,
    /// The meanings of column names, in the form of `mms judge`.
    pub map: Vec<Spanned<String>>,
    /// The names of the columns of tables without a header.
    pub columns: Vec<Spanned<String>>,
    /// The profile of the code that writes the results, by name or path.
    pub from: Option<Spanned<String>>,
    /// Whether norms are over points or over cells, in the form of `mms judge`.
    pub over: Option<Spanned<String>>,
    /// h on each level, if it is not the size of the cells.
    pub h: Option<Vec<f64>>,
    /// The times to judge.
    pub time: Vec<f64>,
    /// The column with the weights of means.
    pub weight: Option<Spanned<String>>,
    /// The start of the solver, in the form of `mms judge`.
    pub start: Option<Spanned<String>>,
    /// Whether results may cover a part of the body.
    pub part: bool,
    /// The memory for reading a file, in MB.
    pub max_memory: Option<u64>,
    /// Parameters, as `name=value`.
    pub set: Vec<String>,
    /// The place of its table in the file.
    pub span: Span,
}

impl Study {
    /// The number of runs.
    pub fn levels(&self) -> usize {
        match self.grid {
            true => self.cells.len() * self.steps(),
            false => self.cells.len().max(self.steps()),
        }
    }

    /// Adds the parameters of a step.
    fn at(self, step: SweepPoint) -> Self {
        let name = match step.name.is_empty() {
            true => self.name,
            false => format!("{}@{}", self.name, step.name),
        };
        Study { name, set: step.set, ..self }
    }

    /// The number of given time steps.
    fn steps(&self) -> usize {
        self.time_steps.as_ref().map_or(0, Vec::len)
    }

    /// Cells along the longest edge of the body, on a level from 1 on.
    pub fn cells_of(&self, level: usize) -> usize {
        self.cells.get(self.of_cells(level)).copied().unwrap_or(self.cells[0])
    }

    /// dt of a level, if the file states it.
    pub fn time_step_of(&self, level: usize) -> Option<f64> {
        let at = if self.grid { (level - 1) % self.steps() } else { level - 1 };
        self.time_steps.as_ref()?.get(at).copied()
    }

    /// h of a level, if the file states it.
    pub fn h_of(&self, level: usize) -> Option<f64> {
        self.h.as_ref()?.get(self.of_cells(level)).copied()
    }

    /// The index of a level in `cells`; in a grid, all time steps of one number of cells precede the next number.
    fn of_cells(&self, level: usize) -> usize {
        if self.grid { (level - 1) / self.steps() } else { level - 1 }
    }
}

/// The mistakes in a file.
#[derive(Clone, Debug)]
pub struct Mistakes {
    /// The name of the file in messages.
    pub(crate) subject: &'static str,
    pub(crate) sources: Sources,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

/// The name of a campaign file in messages.
const CAMPAIGN: &str = "the campaign file";

impl std::error::Error for Mistakes {}

impl fmt::Display for Mistakes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = render(&self.sources, &self.diagnostics);
        write!(f, "{} has mistakes\n{}", self.subject, text.trim_end())
    }
}

impl Campaign {
    /// A mistake at a place of the file.
    pub fn mistake(&self, span: Span, message: impl Into<String>, label: &str) -> Mistakes {
        let diagnostic = Diagnostic::error(span, message).label(label);
        Mistakes { subject: CAMPAIGN, sources: self.sources.clone(), diagnostics: vec![diagnostic] }
    }
}

impl Solver {
    /// The format of the exact state that a run gets; `None` if it gets no such file.
    pub fn state(&self) -> Option<&str> {
        let named = self.state.as_ref().map(|it| it.value.as_str());
        named.or_else(|| self.asks_for(Placeholder::State).then_some(STATES[0]))
    }

    /// Whether the command, its folder or its results contain a placeholder.
    fn asks_for(&self, placeholder: Placeholder) -> bool {
        self.templates().any(|it| it.placeholders().any(|own| own == placeholder))
    }

    fn templates(&self) -> impl Iterator<Item = &Template> {
        self.run.iter().chain(&self.directory).chain([&self.output])
    }
}

const SOLVER: &[&str] = &[
    "name",
    "version",
    "sources",
    "run",
    "directory",
    "output",
    "threads",
    "time_limit",
    "emit",
    "state",
    "can",
];

const STUDY: &[&str] = &[
    "name",
    "field",
    "cells",
    "time_steps",
    "grid",
    "particles_per_cell",
    "courant",
    "end",
    "order",
    "tolerance",
    "quantity",
    "map",
    "columns",
    "from",
    "over",
    "h",
    "time",
    "weight",
    "start",
    "part",
    "max_memory",
    "set",
];

/// Parses a text; messages show `path` as its path.
///
/// # Errors
/// Every mistake of form, at its place.
pub fn read(path: &str, text: &str) -> Result<Campaign, Mistakes> {
    let (mut reader, root) = Reader::new(path, text);
    if !reader.diagnostics.is_empty() {
        let Reader { sources, diagnostics, .. } = reader;
        return Err(Mistakes { subject: CAMPAIGN, sources, diagnostics });
    }
    let root = reader.root(root.get_ref(), "a campaign file", &["solver", "study"]);
    let solver = solver(&mut reader, &root);
    let studies = studies(&mut reader, &root);
    match solver {
        Some(solver) if reader.diagnostics.is_empty() => {
            Ok(Campaign { sources: reader.sources, solver, studies })
        }
        _ => {
            let Reader { sources, diagnostics, .. } = reader;
            Err(Mistakes { subject: CAMPAIGN, sources, diagnostics })
        }
    }
}

fn solver(reader: &mut Reader, root: &Table<'_>) -> Option<Solver> {
    let Some(value) = root.value("solver") else {
        let example =
            "[solver] has run = \"./solver {cells} {output}\" and output = \"{output}/*.csv\"";
        let found = Diagnostic::error(root.span, "missing table [solver]");
        reader.report(found.label("it states how the solver is run").help(example));
        return None;
    };
    let table = reader.table(value, "solver", "a table, [solver]", ("[solver]", SOLVER))?;
    let run = run(reader, &table);
    let output = template(reader, &table, "output");
    if table.value("output").is_none() {
        reader.missing(&table, "output", "as in output = \"{output}/*.vtu\"");
    }
    let state = reader.text(&table, "state");
    state.iter().for_each(|word| validate_word(reader, "state", word, STATES));
    let found = Solver {
        name: reader.text(&table, "name").map_or_else(|| "solver".to_owned(), |it| it.value),
        version: reader.text(&table, "version").map(|it| it.value),
        sources: reader.texts(&table, "sources"),
        run: run?,
        directory: template(reader, &table, "directory"),
        output: output?,
        threads: threads(reader, &table),
        time_limit: limit(reader, &table),
        emit: reader.text(&table, "emit"),
        state,
        can: capabilities::read(reader, &table),
    };
    validate_emitted(reader, &table, &found);
    validate_output(reader, &table, &found);
    Some(found)
}

/// Requires `emit` if `{emitted}` is used.
fn validate_emitted(reader: &mut Reader, table: &Table<'_>, solver: &Solver) {
    if solver.asks_for(Placeholder::Emitted)
        && solver.emit.is_none()
        && table.value("emit").is_none()
    {
        reader.missing(
            table,
            "emit",
            "`{emitted}` is the folder that it fills, as in emit = \"numpy\"",
        );
    }
}

/// Refuses results in a place that all runs share, where results of one run could be taken for results of another.
fn validate_output(reader: &mut Reader, table: &Table<'_>, solver: &Solver) {
    let names = |template: &Template| template.placeholders().any(|it| it == Placeholder::Output);
    if names(&solver.output) || solver.directory.as_ref().is_some_and(names) {
        return;
    }
    let span = table.value("output").map_or(table.span, |value| reader.span(value));
    let message = "`output`: all runs would write to the same place";
    let help = "begin it with {output}, the folder of the run, and give that to the solver; for a solver that writes to its \
                working folder, directory = \"{output}\"";
    reader.report(Diagnostic::error(span, message).label("no {output} in it").help(help));
}

/// The words of the command: a text is split here, an array is not.
fn run(reader: &mut Reader, table: &Table<'_>) -> Option<Vec<Template>> {
    let Some(value) = table.value("run") else {
        reader.missing(table, "run", "as in run = \"./solver --cells {cells} --out {output}\"");
        return None;
    };
    let words = match value.get_ref() {
        DeValue::String(text) => Template::words(text).map(Some),
        DeValue::Array(items) if !items.is_empty() => {
            let words = items.iter().map(|item| item.get_ref().as_str().map(Template::new));
            words.map(Option::transpose).collect()
        }
        _ => Ok(None),
    };
    let span = reader.span(value);
    match words {
        Ok(Some(words)) => return Some(words),
        Ok(None) => reader.expect(span, "run", "a command in quotes, or an array of its words"),
        Err(wrong) => wrong_template(reader, span, "run", &wrong),
    }
    None
}

fn template(reader: &mut Reader, table: &Table<'_>, key: &str) -> Option<Template> {
    let text = reader.text(table, key)?;
    match Template::new(&text.value) {
        Ok(template) => Some(template),
        Err(wrong) => {
            wrong_template(reader, text.span, key, &wrong);
            None
        }
    }
}

fn wrong_template(reader: &mut Reader, span: Span, key: &str, wrong: &Wrong) {
    let known: Vec<_> = Placeholder::ALL.iter().map(|it| it.name()).collect();
    let help = match wrong {
        Wrong::Unknown(name) => {
            let all =
                |all: &str| format!("the placeholders are {all}, and {{set.NAME}} of a parameter");
            let near = mms_spec::suggest::did_you_mean(name, known.iter().copied());
            let near = near.map_or(String::new(), |it| format!("did you mean `{{{it}}}`? "));
            near + &all(&known.join(", "))
        }
        Wrong::Unpaired(_) => format!("the placeholders are {}", known.join(", ")),
        Wrong::Unclosed | Wrong::Empty => {
            "the words are split as a POSIX shell does; or give an array of them".into()
        }
    };
    let message = format!("`{key}`: {wrong}");
    reader.report(Diagnostic::error(span, message).label("in this text").help(help));
}

fn threads(reader: &mut Reader, table: &Table<'_>) -> NonZero<usize> {
    let expected = "a whole number from 1 on";
    reader
        .of_key(table, "threads", expected, |_, value| whole(value))
        .unwrap_or(NonZero::<usize>::MIN)
}

fn limit(reader: &mut Reader, table: &Table<'_>) -> Duration {
    let seconds = reader.positive(table, "time_limit").unwrap_or(TIME_LIMIT);
    Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)
}

/// A whole number from 1 on.
fn whole(value: &Value<'_>) -> Option<NonZero<usize>> {
    let DeValue::Integer(digits) = value.get_ref() else { return None };
    usize::from_str_radix(digits.as_str(), digits.radix()).ok().and_then(NonZero::new)
}

fn studies(reader: &mut Reader, root: &Table<'_>) -> Vec<Study> {
    let expected = "an array of tables, [[study]]";
    let items = reader.of_key(root, "study", expected, |_, value| value.get_ref().as_array());
    let mut studies: Vec<Study> = Vec::new();
    for item in items.into_iter().flat_map(|items| items.iter()) {
        let table = reader.table(item, "study", "a table, [[study]]", ("[[study]]", STUDY));
        let Some(table) = table else { continue };
        let Some((study, steps)) = study(reader, &table) else { continue };
        if studies.iter().any(|other| other.family == study.family) {
            let message = format!("two studies are called {}", quoted(&study.family));
            let found = Diagnostic::error(table.span, message).label("the second of them");
            reader.report(found.help("give it a `name` of its own"));
        }
        studies.extend(steps.into_iter().map(|step| study.clone().at(step)));
    }
    studies
}

/// Reads a study, and the steps of its parameters.
fn study(reader: &mut Reader, table: &Table<'_>) -> Option<(Study, Vec<SweepPoint>)> {
    let field = reader.text(table, "field");
    if table.value("field").is_none() {
        reader.missing(table, "field", "a name of the gallery, or the path of a field file");
    }
    let cells = cells(reader, table);
    let is_positive = |it: f64| it > 0.0;
    let positive = "an array of positive numbers";
    let time_steps = reader.numbers(table, "time_steps", positive, is_positive);
    let h = reader.numbers(table, "h", positive, is_positive);
    let time = reader.numbers(table, "time", "an array of numbers", f64::is_finite);
    let name = name(reader, table, field.as_ref());
    let name = name?;
    let study = Study {
        family: name.clone(),
        name,
        field: field?,
        cells: cells?,
        time_steps,
        grid: reader.flag(table, "grid", false),
        particles_per_cell: per_cell(reader, table),
        courant: reader.positive(table, "courant").unwrap_or(COURANT),
        end: reader.number(table, "end"),
        order: orders(reader, table),
        tolerance: reader.positive(table, "tolerance").unwrap_or(TOLERANCE),
        quantity: reader.texts(table, "quantity"),
        map: reader.texts(table, "map"),
        columns: reader.texts(table, "columns"),
        from: reader.text(table, "from"),
        over: reader.text(table, "over"),
        h,
        time: time.unwrap_or_default(),
        weight: reader.text(table, "weight"),
        start: reader.text(table, "start"),
        part: reader.flag(table, "part", false),
        max_memory: reader.positive(table, "max_memory").map(|it| it.ceil() as u64),
        set: Vec::new(),
        span: table.span,
    };
    validate_levels(reader, table, &study);
    Some((study, set::steps(reader, table)))
}

/// The name of a study, which is also the name of a folder: from `name`, or from its field.
fn name(reader: &mut Reader, table: &Table<'_>, field: Option<&Spanned<String>>) -> Option<String> {
    let name = match reader.text(table, "name") {
        Some(name) => name,
        None => of_field(field?),
    };
    let is_odd = |c: char| c.is_control() || matches!(c, '/' | '\\');
    let text = name.value.as_str();
    if text.is_empty() || text.starts_with('.') || text.contains(is_odd) || text.len() > 100 {
        let expected = "the name of a folder: no slash, no dot in front, at most 100 characters";
        reader.expect(name.span, "name", expected);
    }
    Some(name.value)
}

/// The file name of a path without its extension.
fn of_field(field: &Spanned<String>) -> Spanned<String> {
    let file = field.value.rsplit(['/', '\\']).next().unwrap_or_default();
    let stem = file.strip_suffix(".toml").unwrap_or(file);
    Spanned { value: stem.to_owned(), span: field.span }
}

fn cells(reader: &mut Reader, table: &Table<'_>) -> Option<Vec<usize>> {
    let Some(value) = table.value("cells") else {
        reader.missing(
            table,
            "cells",
            "as in cells = [8, 16, 32]: cells along the longest edge, on each level",
        );
        return None;
    };
    let expected = "an array of whole numbers from 1 on, one for each level";
    let cells = |item: &Value<'_>| whole(item).map(NonZero::get);
    reader.of_value(value, "cells", expected, |_| each(value, cells))
}

/// Requires at least three of each and no `courant` in a grid of cells and time steps: fewer do not separate the two errors.
fn validate_grid(reader: &mut Reader, table: &Table<'_>, study: &Study) {
    let lengths = [("cells", study.cells.len()), ("time_steps", study.steps())];
    for (key, length) in lengths.into_iter().filter(|(_, length)| *length < 3) {
        let span = table.value(key).map_or(table.span, |value| reader.span(value));
        let message = format!("`grid`: `{key}` has {length} values");
        let help = "three and more of each: fewer cannot separate errors of space and time";
        reader.report(Diagnostic::error(span, message).label("expected three at least").help(help));
    }
    let of_h = study.h.as_ref().map_or(study.cells.len(), Vec::len);
    if of_h != study.cells.len() {
        let span = table.value("h").map_or(table.span, |value| reader.span(value));
        let message = format!("`h` has {of_h} values, and `cells` {}", study.cells.len());
        let found = Diagnostic::error(span, message).label("counted here");
        reader.report(found.help("as many in a grid: one for each number of cells"));
    }
}

/// Requires one entry per level in `cells`, `time_steps` and `h`; `cells` may have a single entry for all time steps.
fn validate_levels(reader: &mut Reader, table: &Table<'_>, study: &Study) {
    if study.grid {
        return validate_grid(reader, table, study);
    }
    let levels = study.levels();
    let lengths = [
        ("cells", Some(study.cells.len()).filter(|length| *length != 1)),
        ("time_steps", study.time_steps.as_ref().map(Vec::len)),
        ("h", study.h.as_ref().map(Vec::len)),
    ];
    for (key, length) in lengths {
        let Some(length) = length.filter(|length| *length != levels) else { continue };
        let span = table.value(key).map_or(table.span, |value| reader.span(value));
        let message = format!("`{key}` has {length} values, and there are {levels} levels");
        let help = "as many for each; or one number of cells for several time steps";
        reader.report(Diagnostic::error(span, message).label("counted here").help(help));
    }
}

/// A whole number, or a text with one for each axis.
fn per_cell(reader: &mut Reader, table: &Table<'_>) -> Option<Spanned<String>> {
    let expected = "a whole number, or one for each axis, as in \"3x2\"";
    reader.of_key(table, "particles_per_cell", expected, |reader, value| {
        Some(Spanned { value: digits(value)?, span: reader.span(value) })
    })
}

/// A number, or texts in the form of `--expected-order`.
fn orders(reader: &mut Reader, table: &Table<'_>) -> Vec<Spanned<String>> {
    let plain = table.value("order").filter(|value| number(value).is_some());
    match plain.and_then(|value| Some((value, digits(value)?))) {
        Some((value, value_text)) => vec![Spanned { value: value_text, span: reader.span(value) }],
        None => reader.texts(table, "order"),
    }
}
