//! The verdict on attached results.

use std::error::Error;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use mms_convergence::TOLERANCE;
use mms_documents::judge::Judge;
use mms_documents::provenance::{Input, Provenance, VERSION};
use mms_exact::Exact;
use mms_judge::next::{Meshes, after_judgement, list};
use mms_judge::results::{Comparison, Reading, axes, measure, own_roles};
use mms_judge::table::{self, ExpectedOrders};
use mms_judge::{Judgements, Unfollowed};
use mms_results::Files;
use mms_results::names::Names;
use mms_spec::foreign::shown;
use mms_spec::source::Sources;
use serde::Serialize;

use crate::field::named;
use crate::mistake::Mistake;
use crate::request::{Attached, FieldText, JudgeOptions};

/// The bytes of memory that reading may take: a module of 32 bits has at most four times as many.
const MEMORY: u64 = 1 << 30;

/// Attached files, which lie one after another.
struct Folder<'a>(Vec<(&'a str, &'a [u8])>);

impl Files for Folder<'_> {
    fn paths(&self, given: &str) -> Result<Vec<PathBuf>, Box<dyn Error + Send + Sync>> {
        Ok(vec![given.into()])
    }

    fn bytes(&self, path: &Path, room: u64) -> Result<Vec<u8>, String> {
        let found = self.0.iter().find(|(name, _)| Path::new(name) == path);
        let Some((_, bytes)) = found else {
            return Err("it is not among the files given; give it as well".into());
        };
        match bytes.len() as u64 <= room {
            true => Ok(bytes.to_vec()),
            false => Err(format!("it has {} bytes; at most {room} fit into memory", bytes.len())),
        }
    }

    fn memory(&self) -> u64 {
        MEMORY
    }
}

/// The reply to a page that judges results.
#[derive(Serialize)]
pub struct JudgeReply {
    /// The document of `mms judge --json`.
    document: Judge,
    passes: bool,
    notes: Vec<String>,
    /// The words of the command to type next, if the verdict is no pass.
    next: Option<Vec<String>>,
}

/// Judges attached results of a field, one file for each mesh, or a table of errors.
pub fn judge(
    field: &FieldText,
    files: &[Attached],
    attached: &[u8],
    options: &JudgeOptions,
) -> Result<JudgeReply, Mistake> {
    let (mut all, mut rest) = (Vec::new(), attached);
    for file in files {
        let Some((bytes, after)) = rest.split_at_checked(file.size) else {
            return Err(Mistake::of(format!("`{}` is not attached as a whole", shown(&file.name))));
        };
        all.push((file.name.as_str(), bytes));
        rest = after;
    }
    let expected = options.expected_order.iter().map(|it| it.to_string().parse());
    let orders =
        ExpectedOrders::new(&expected.filter_map(Result::ok).collect::<Vec<_>>(), TOLERANCE);
    let report = match options.errors {
        true => of_table(&all, &orders)?,
        false => of_results(field, &Folder(all), options, &orders)?,
    };
    Ok(JudgeReply {
        passes: report.verdict().is_good(),
        notes: report.notes.clone(),
        next: report.next.clone(),
        document: report.document(),
    })
}

/// Judges a table of errors.
fn of_table(files: &[(&str, &[u8])], orders: &ExpectedOrders) -> anyhow::Result<Judgements> {
    let [(name, bytes)] = files else { bail!("expected one table of errors") };
    let text = str::from_utf8(bytes).with_context(|| format!("`{}` is no text", shown(name)))?;
    let (measured, notes) = table::read(Path::new(name), text, orders, None)?;
    let mut sources = Sources::default();
    sources.add(*name, text);
    let hash = sources.hash();
    let input = Input { field: None, rigid: None, window: None, set: Vec::new(), hash };
    let mut report = Judgements::of(shown(name).to_string(), measured, provenance(input))?;
    report.notes = notes;
    report.next = after_judgement(&report, None, false);
    Ok(report)
}

/// Judges results of a field. The mistakes that they exclude are not listed, since the solver would have to run.
fn of_results(
    field: &FieldText,
    folder: &Folder<'_>,
    options: &JudgeOptions,
    orders: &ExpectedOrders,
) -> Result<Judgements, Mistake> {
    let input = field.compiled()?;
    let own: Vec<_> = input.compiled.model.own.keys().copied().collect();
    let axes = axes(&input.compiled.field);
    let names = Names { own: own_roles(&own), axes, ..Names::default() };
    let wanted = match options.quantities.as_slice() {
        [] => Vec::new(),
        quantities => named(&input, quantities)?,
    };
    let provenance = provenance(input.provenance(&[]));
    let mut exact = Exact::new(input, &[])?;
    let reading = Reading {
        files: folder,
        names: &names,
        wanted: &wanted,
        weight: None,
        memory: None,
        is_part: false,
        over: None,
    };
    let results = folder.0.iter().map(|(name, _)| reading.find(name, &exact));
    let results = results.collect::<anyhow::Result<Vec<_>>>()?;
    let comparison = Comparison {
        sizes: &options.mesh_sizes,
        times: &options.times,
        orders,
        has_steps: false,
        tighter: None,
        follow: &Unfollowed,
    };
    let measurement = measure(results, &reading, &mut exact, comparison)?;
    let warnings = measurement.warnings.clone();
    let names: Vec<_> = folder.0.iter().map(|(name, _)| name.to_string()).collect();
    let mut report = Judgements::without_exclusions(&exact, &names, measurement, provenance)?;
    report.notes.splice(0..0, warnings);
    let given = [list("h", &options.mesh_sizes), list("time", &options.times)];
    let options_given = given.into_iter().flatten().collect();
    let field = format!("{}.toml", field.name);
    let meshes = Meshes { field, files: names, options: options_given, of_judge: None };
    report.next = after_judgement(&report, Some(&meshes), !options.quantities.is_empty());
    Ok(report)
}

fn provenance(input: Input) -> Provenance {
    Provenance {
        kind: "judge".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        document_version: VERSION,
        command: "judge in a browser".into(),
        input,
        machine: None,
    }
}
