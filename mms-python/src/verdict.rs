//! Verdicts and diagnoses, to the documents of `mms judge` and `mms diagnose`.

use mms_codegen::Compiled;
use mms_convergence::TOLERANCE;
use mms_diagnosis::changed::Without;
use mms_diagnosis::scene::{self, Evidence};
use mms_diagnosis::solver::Solver;
use mms_documents::provenance::{Machine, Provenance, VERSION};
use mms_exact::evaluated;
use mms_files::machine::{processor, processors};
use mms_files::results::Disk;
use mms_judge::Judgements;
use mms_judge::diagnose::{
    Alone, Reading as Looking, diagnosis_of, falls, find, keep_own, left_out, read,
};
use mms_judge::results::{Comparison, Over, Reading, Results, Start, axes, measure, own_roles};
use mms_judge::table::ExpectedOrders;
use mms_report::page::Section as _;
use mms_report::plot::Figure;
use mms_report::{Diagnosed, Format, Shown, View};
use mms_results::names::Names;
use mms_spec::quantity::Quantity;
use pyo3::prelude::*;

use crate::field::Field;
use crate::follow::Follower;
use crate::mistake::mistake;
use crate::opened::Opened;
use crate::results::{Given, ensure_timed, exact, sizes};

/// A result in every form that Python is given.
#[derive(IntoPyObject)]
pub struct Views {
    json: String,
    text: String,
    markdown: String,
    latex: String,
    csv: String,
    /// A picture, where there is one.
    svg: Option<String>,
}

impl Views {
    /// Makes all forms, with a picture.
    pub fn of(shown: &impl Shown, svg: Option<String>) -> anyhow::Result<Self> {
        let form = |format| shown.in_format(format);
        Ok(Views {
            json: serde_json::to_string(&shown.document())?,
            text: form(Format::Text)?,
            markdown: form(Format::Markdown)?,
            latex: form(Format::Latex)?,
            csv: form(Format::Csv)?,
            svg,
        })
    }
}

/// The orders that are expected, as of `--expected-order`.
fn orders(
    given: &[(Option<String>, f64)],
    tolerance: Option<f64>,
    start: Option<Start>,
) -> ExpectedOrders {
    let words = given.iter().map(|(name, order)| match name {
        Some(name) => format!("{name}={order}"),
        None => order.to_string(),
    });
    let all: Vec<_> = words.filter_map(|it| it.parse().ok()).collect();
    ExpectedOrders { start, ..ExpectedOrders::new(&all, tolerance.unwrap_or(TOLERANCE)) }
}

fn names(compiled: &Compiled) -> Names {
    let own: Vec<_> = compiled.model.own.keys().copied().collect();
    Names { own: own_roles(&own), axes: axes(&compiled.field), ..Names::default() }
}

fn wanted(opened: &Opened, quantities: &[String]) -> anyhow::Result<Vec<Quantity>> {
    match quantities {
        [] => Ok(Vec::new()),
        names => opened.input.offered(names, evaluated(&opened.input.own_quantities(), names)?),
    }
}

fn provenance(kind: &str, opened: &Opened) -> Provenance {
    Provenance {
        kind: kind.into(),
        version: env!("CARGO_PKG_VERSION").into(),
        document_version: VERSION,
        command: format!("manufactured.{kind}"),
        input: opened.input.provenance(&opened.arguments()),
        machine: Some(Machine { processor: processor(), cores: processors() }),
    }
}

/// Works without the lock of the interpreter until an interrupt ends the work, and turns an error into an exception.
fn detached<R: Send>(
    py: Python<'_>,
    progress: Option<Py<PyAny>>,
    work: impl FnOnce(&Follower) -> anyhow::Result<R> + Send,
) -> PyResult<R> {
    let made = Follower::follow(py, progress, work)?;
    made.map_err(|error| mistake(in_keywords(&format!("{error:#}"))))
}

/// A message with the keywords of Python in place of options: `` `--time` `` is `` `times` ``, and `` `--map u=..` `` is `` `u=..` ``.
fn in_keywords(message: &str) -> String {
    let mut parts = message.split("`--");
    let mut written = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|it: char| it != '-' && !it.is_ascii_lowercase());
        let (option, rest) = part.split_at(end.unwrap_or(part.len()));
        written.push('`');
        match option {
            "map" => written.push_str(rest.trim_start()),
            "time" => written += &format!("times{rest}"),
            "quantity" => written += &format!("quantities{rest}"),
            _ => written += &format!("{}{rest}", option.replace('-', "_")),
        }
    }
    written
}

/// Judges results; see `judge` of the package.
#[pyfunction]
#[pyo3(signature = (field, results, quantities, times, orders, tolerance, start, over, part, all_components, progress))]
#[allow(clippy::too_many_arguments)]
fn judge(
    py: Python<'_>,
    field: &Field,
    results: Vec<Given>,
    quantities: Vec<String>,
    times: Vec<f64>,
    orders: Vec<(Option<String>, f64)>,
    tolerance: Option<f64>,
    start: Option<&str>,
    over: Option<&str>,
    part: bool,
    all_components: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Views> {
    let start = start.map(Start::of).transpose().map_err(|it| mistake(format!("`start`: {it}")))?;
    let over = over.map(Over::of).transpose().map_err(|it| mistake(format!("`over`: {it}")))?;
    let (opened, sizes) = (&*field.opened, sizes(&results)?);
    ensure_timed(&results, &times, opened.input.is_static())?;
    let orders = self::orders(&orders, tolerance, start);
    detached(py, progress, move |follower| {
        let mut exact = exact(opened, follower.stop.clone())?.in_space_if(all_components);
        let (names, wanted) = (names(opened.compiled()), wanted(opened, &quantities)?);
        let reading = Reading {
            files: &Disk,
            names: &names,
            wanted: &wanted,
            weight: None,
            memory: None,
            is_part: part,
            over,
        };
        let all = results.iter().enumerate();
        let all = all.map(|(at, it)| it.results(at, |name| reading.find(name, &exact)));
        let all = all.collect::<anyhow::Result<Vec<Results>>>()?;
        let files: Vec<_> = all.iter().map(|it| it.name.clone()).collect();
        let comparison = Comparison {
            sizes: &sizes,
            times: &times,
            orders: &orders,
            has_steps: false,
            tighter: None,
            follow: follower,
        };
        let measurement = measure(all, &reading, &mut exact, comparison)?;
        let provenance = provenance("judge", opened);
        let report =
            Judgements::of_results(&exact, &files, measurement, None, provenance, follower)?;
        let title = report.source.clone();
        let picture = Figure::new(title, report.document().plots()).svg();
        Views::of(&View(&report), Some(picture))
    })
}

/// Diagnoses results; see `diagnose` of the package.
#[pyfunction]
#[pyo3(signature = (field, results, law, quantities, times, time_steps, orders, without, residual_sign, nodal, progress))]
#[allow(clippy::too_many_arguments)]
fn diagnose(
    py: Python<'_>,
    field: &Field,
    results: Vec<Given>,
    law: Option<&str>,
    quantities: Vec<String>,
    times: Vec<f64>,
    time_steps: Vec<f64>,
    orders: Vec<(Option<String>, f64)>,
    without: Vec<String>,
    residual_sign: f64,
    nodal: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<(Views, Vec<String>)> {
    let terms = ["body_force", "stress", "traction"];
    if let Some(odd) = without.iter().find(|it| !terms.contains(&it.as_str())) {
        return Err(mistake(format!("`without`: no term `{odd}`; expected {}", terms.join(", "))));
    }
    let law = match law {
        None => None,
        Some("stress") => Some(Alone::Stress),
        Some("tangent") => Some(Alone::Tangent),
        Some(odd) => return Err(mistake(format!("`{odd}`: expected stress or tangent"))),
    };
    let (opened, sizes) = (&*field.opened, sizes(&results)?);
    let orders = self::orders(&orders, None, None);
    detached(py, progress, move |follower| {
        let mut exact = exact(opened, follower.stop.clone())?;
        let scene = exact.scene()?;
        let (names, wanted) = (names(opened.compiled()), wanted(opened, &quantities)?);
        let find = |name: &str| find(name, &names, None, &Disk);
        let all = results.iter().enumerate().map(|(at, it)| it.results(at, find));
        let mut all = all.collect::<anyhow::Result<Vec<Results>>>()?;
        let files: Vec<_> = all.iter().map(|it| it.name.clone()).collect();
        keep_own(&mut all, opened.input.is_static())?;
        let reading = Looking {
            files: &Disk,
            right: &[],
            names: &names,
            times: &times,
            rest: scene::is_at_rest(&scene).then_some(exact.window[1]),
            sizes: &sizes,
            time_steps: &time_steps,
            law,
            wanted: &wanted,
            residual_sign,
            is_nodal: nodal,
        };
        let mut notes = left_out(&all, &reading, &exact)?;
        let evidence = read(&all, &reading, &mut exact)?;
        let is_out = |term: &str| without.iter().any(|it| it == term);
        let without = Without {
            body_force: is_out("body_force"),
            stress: is_out("stress"),
            traction: is_out("traction"),
        };
        let falls = match &evidence {
            Evidence::Results(_) => falls(all, &wanted, &reading, &orders, &mut exact)
                .unwrap_or_else(|error| {
                    notes.push(format!("the order between meshes is not judged: {error:#}"));
                    None
                }),
            _ => None,
        };
        let solver = Solver { without, like: None, falls, is_compared_with_right_run: false };
        let (diagnosis, question) = diagnosis_of(&exact, &scene, &evidence, &solver, follower)?;
        let provenance = provenance("diagnose", opened);
        let input = &opened.input;
        let (diagnosis, next) = (&diagnosis, None);
        let report = Diagnosed { input, files: &files, diagnosis, question, next, provenance };
        Ok((Views::of(&report, None)?, notes.iter().map(|it| in_keywords(it)).collect()))
    })
}

/// Adds the functions to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<crate::results::Level>()?;
    module.add_function(wrap_pyfunction!(judge, module)?)?;
    module.add_function(wrap_pyfunction!(diagnose, module)?)
}
