//! The verdict on attached results.

use std::error::Error;
use std::path::{Path, PathBuf};

use mms_convergence::TOLERANCE;
use mms_documents::judge::Judge;
use mms_documents::provenance::{Provenance, VERSION};
use mms_exact::Exact;
use mms_judge::Judgements;
use mms_judge::results::{Comparison, Reading, measure, own_roles};
use mms_judge::table::Orders;
use mms_results::Files;
use mms_results::names::Names;
use mms_spec::foreign::shown;
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

/// A verdict.
#[derive(Serialize)]
pub struct Verdict {
    /// As of `mms judge --json`.
    document: Judge,
    passes: bool,
    notes: Vec<String>,
}

/// Judges attached results of a field, one file for each mesh.
pub fn judge(
    field: &FieldText,
    files: &[Attached],
    attached: &[u8],
    options: &JudgeOptions,
) -> Result<Verdict, Mistake> {
    let (mut all, mut rest) = (Vec::new(), attached);
    for file in files {
        let Some((bytes, after)) = rest.split_at_checked(file.size) else {
            return Err(Mistake::of(format!("`{}` is not attached as a whole", shown(&file.name))));
        };
        all.push((file.name.as_str(), bytes));
        rest = after;
    }
    let (folder, input) = (Folder(all), field.compiled()?);
    let own: Vec<_> = input.compiled.model.own.keys().copied().collect();
    let names = Names { own: own_roles(&own), ..Names::default() };
    let wanted = match options.quantities.as_slice() {
        [] => Vec::new(),
        quantities => named(&input, quantities)?,
    };
    let provenance = Provenance {
        kind: "judge".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        document_version: VERSION,
        command: "judge in a browser".into(),
        input: input.provenance(&[]),
        machine: None,
    };
    let mut exact = Exact::new(input, &[])?;
    let reading = Reading {
        files: &folder,
        names: &names,
        wanted: &wanted,
        weight: None,
        memory: None,
        is_part: false,
        over: None,
    };
    let results = files.iter().map(|it| reading.find(&it.name, &exact));
    let results = results.collect::<anyhow::Result<Vec<_>>>()?;
    let expected = options.expected_order.iter().map(|it| it.to_string().parse());
    let expected: Vec<_> = expected.filter_map(Result::ok).collect();
    let comparison = Comparison {
        sizes: &options.mesh_sizes,
        times: &options.times,
        orders: &Orders::new(&expected, TOLERANCE),
        has_steps: false,
        tighter: None,
    };
    let measurement = measure(results, &reading, &mut exact, comparison)?;
    let warnings = measurement.warnings.clone();
    let names: Vec<_> = files.iter().map(|it| it.name.clone()).collect();
    let report = Judgements::of_results(&exact, &names, measurement, None, provenance)?;
    let notes = warnings.into_iter().map(|it| it.to_string()).chain(report.notes.iter().cloned());
    Ok(Verdict {
        passes: report.verdict().is_good(),
        notes: notes.collect(),
        document: report.document(),
    })
}
