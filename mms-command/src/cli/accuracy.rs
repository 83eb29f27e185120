//! `mms accuracy`: errors against arbitrary precision, and what they cost.

use std::path::PathBuf;

use anyhow::{anyhow, bail};
use clap::Args;
use mms_analysis::accuracy::regime::REGIMES;
use mms_analysis::accuracy::{Request, measure, names};
use mms_codegen::selection::Selection;
use mms_codegen::{Compiled, Options};
use mms_exact::Source;
use mms_exact::{quantities, settings, validate_body};
use mms_lab::workbench::{Module, ModuleForm, Time, Workbench, time};
use mms_options::field::{Motion, open, precision};
use mms_program::precision::Precision;
use mms_report::accuracy::Report;
use mms_spec::Form;
use mms_spec::foreign::{Foreign, one_line, shown};
use mms_spec::quantity::Quantity;
use mms_spec::suggest::advice;

use super::format::Printing;
use super::{CommandOutcome, say, this_command, validate_output};

/// Measure the rounding errors of a field against arbitrary precision: of every quantity, in single, double and twice double
/// precision, in the stable and the fast form, at the declared parameters and at extremes.
///
/// The table shows, for each quantity, precision and form, the regime with the largest error. Errors are in eps of the
/// precision (2^-23, 2^-52, 2^-104): the median of |error|/|value|, the bound for 99 of 100 components, and the largest; then
/// the largest |error| over the largest |value| of the quantity. Components that are not finite are counted separately. A
/// field takes about one minute of processor time, at most a few minutes, mostly for elementary functions in arbitrary
/// precision; --quantity, --regime, --precision and --points shorten it.
///
/// The exit code is 1 if the stable form exceeds 64 eps of the largest value at the declared parameters, or at displacements
/// down to 1e-12 of the size of the body; and if this cannot be measured. Numbers that were not measured are null in --json.
#[derive(Args)]
#[command(after_help = listed())]
pub struct Accuracy {
    /// A name that `mms list` prints, or the path of a TOML file.
    field: String,
    /// The quantities to measure, separated by commas, or `all`.
    #[arg(long, value_name = "NAME", default_value = "all", value_delimiter = ',')]
    quantity: Vec<String>,
    /// The regimes of parameters, separated by commas, or `all`: the regimes in the list below, and the names of the field's
    /// [[extreme]] tables.
    #[arg(long, value_name = "NAME", default_value = "all", value_delimiter = ',')]
    regime: Vec<String>,
    /// The precisions, separated by commas; all by default.
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = precision())]
    precision: Vec<Precision>,
    /// The forms, stable or fast, separated by commas; both by default.
    #[arg(long, value_name = "NAME", value_delimiter = ',', value_parser = Form::from_name)]
    form: Vec<Form>,
    /// The number of points, each with a time; one in four is on a face or close to one.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    points: u32,
    /// Change the default of a parameter to a number, or to a formula in the parameters declared above it. May be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    motion: Motion,
    /// Compile the emitted code with the `rustc` on the PATH, and measure its time: batches in f32 and f64, single points in
    /// twice the digits. Takes half a minute, or some minutes for all quantities of a 3D field.
    #[arg(long)]
    time: bool,
    /// Show every regime; by default only the worst.
    #[arg(long)]
    all: bool,
    /// The folder to write accuracy.json and accuracy.svg to: errors over time, with the Pareto front. Implies --time.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    printing: Printing,
}

/// The regimes, for --help.
fn listed() -> String {
    let width = REGIMES.iter().map(|regime| regime.name.len()).max().unwrap_or(0);
    let lines = REGIMES.iter().map(|regime| format!("\n  {:width$}  {}", regime.name, regime.doc));
    format!("Regimes:{}", lines.collect::<String>())
}

impl Accuracy {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let text = open(&self.field)?;
        self.output.as_deref().map_or(Ok(()), validate_output)?;
        let set = settings(&self.set)?;
        let options = self.motion.options(Selection { set, ..Selection::default() });
        let refused = |failure| anyhow!("the field does not compile as selected\n{failure}");
        let compiled = text.compile(&options).map_err(refused)?;
        validate_body(&compiled, "errors are measured over a body")?;
        let quantities = self.quantities(&compiled)?;
        let quantities: Vec<_> = quantities.into_iter().filter(|it| compiled.offers(*it)).collect();
        let request = Request {
            options: options.clone(),
            quantities: quantities.clone(),
            precisions: wanted(Precision::ALL, &self.precision),
            forms: wanted(Form::ALL, &self.form),
            regimes: self.regimes(&compiled)?,
            points: self.points as usize,
        };
        let begun =
            |regime: &Foreign| say(format_args!("{}: {}", text.name().shown(), regime.shown()));
        let compile = |options: &Options| text.compile(options);
        let accuracy = measure(&compile, &request, begun).map_err(refused)?;
        let times = match self.time || self.output.is_some() {
            true => timed(&text, &request),
            false => None,
        };
        let input =
            mms_exact::provenance::input(&self.field, &options.selection, &self.set, &compiled);
        let report = Report {
            field: text.name().clone(),
            points: request.points,
            accuracy,
            times: times.unwrap_or_default(),
            all: self.all,
            provenance: this_command("accuracy", input),
        };
        self.printing.print(&report)?;
        if let Some(folder) = &self.output {
            for path in report.write(folder)? {
                say(path);
            }
        }
        let held =
            report.broken().is_empty() && report.unmeasured().is_empty() && !report.is_unmeasured();
        Ok(if held { CommandOutcome::AsExpected } else { CommandOutcome::Refuted })
    }

    fn quantities(&self, compiled: &Compiled) -> anyhow::Result<Vec<Quantity>> {
        if self.quantity.iter().any(|name| name.trim() == "all") {
            return Ok(compiled.quantities().collect());
        }
        let own: Vec<_> = compiled.model.own.keys().copied().collect();
        quantities(&own, &self.quantity)
    }

    fn regimes(&self, compiled: &Compiled) -> anyhow::Result<Option<Vec<String>>> {
        let wanted: Vec<String> = self.regime.iter().map(|name| name.trim().to_string()).collect();
        if wanted.iter().any(|name| name == "all") {
            return Ok(None);
        }
        let known = names(&compiled.field.extremes);
        let names = || known.iter().map(Foreign::raw);
        for name in &wanted {
            if names().any(|known| known == name) {
                continue;
            }
            let advice = advice(name, names(), |all| format!("there are {}", one_line(all)));
            bail!("no regime `{}`; {advice}", shown(name));
        }
        Ok(Some(wanted))
    }
}

/// The given values in the order of all values; all values if none is given.
fn wanted<T: PartialEq, const N: usize>(all: [T; N], given: &[T]) -> Vec<T> {
    all.into_iter().filter(|it| given.is_empty() || given.contains(it)).collect()
}

/// The times of the forms; `None`, with a word on stderr, where nothing can be timed.
fn timed(text: &Source, request: &Request) -> Option<Vec<(Form, Time)>> {
    say(format_args!("{}: compiling and timing the emitted code", text.name().shown()));
    let compiled = |form: Form| {
        let mut options = Options { form, ..request.options.clone() };
        options.selection.quantities = Some(request.quantities.iter().copied().collect());
        text.compile(&options).map_err(|failure| anyhow!("{failure}"))
    };
    let times = || {
        let bench = Workbench::open()?;
        let forms: Vec<_> = request.forms.iter().map(|form| (*form, compiled(*form))).collect();
        let mut modules = Vec::new();
        for (form, compiled) in &forms {
            let compiled = compiled.as_ref().map_err(|error| anyhow!("{error}"))?;
            modules.push(Module { name: form.name(), compiled });
        }
        let ways = request.precisions.iter().map(|precision| match precision {
            Precision::Wide => (*precision, ModuleForm::Single),
            _ => (*precision, ModuleForm::Batch),
        });
        time(&bench, &modules, &ways.collect::<Vec<_>>())
    };
    match times() {
        Ok(times) => Some(
            times
                .into_iter()
                .filter_map(|time| Some((Form::from_name(&time.module).ok()?, time)))
                .collect(),
        ),
        Err(error) => {
            say(format_args!("no times: {error:#}"));
            None
        }
    }
}
