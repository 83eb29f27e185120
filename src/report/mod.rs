//! A study as a table, a JSON document, a CSV file and a picture.

pub mod accuracy;
pub(crate) mod method;
mod picture;
pub mod run;

use std::io::Write as _;
use std::path::Path;

use anyhow::Context as _;
use comfy_table::presets::NOTHING;
use comfy_table::{CellAlignment, Table};
use mms_runtime::study::{Judgement, Orders, orders};
use mms_runtime::{Division, Level, Method, Refusal};
use serde::Serialize;
use serde_json::{Value, json};

/// A finished study.
pub struct Study {
    /// The field's name.
    pub field: String,
    /// The field's title.
    pub title: String,
    /// The method.
    pub method: Method,
    /// `f32` or `f64`.
    pub precision: &'static str,
    /// The levels, from coarse to fine.
    pub levels: Vec<Result<Level, Refused>>,
    /// The order that theory says.
    pub expected_order: f64,
    /// How far from it is still as expected.
    pub tolerance: f64,
    /// The observed order and the verdict.
    pub judgement: Judgement,
}

/// A level that was not started.
#[derive(Clone, Debug)]
pub struct Refused {
    /// Cells of the body.
    pub cells: Division,
    /// Why it was not started.
    pub reason: Refusal,
}

/// One level as a record: a row of the CSV file, and an entry of the JSON document.
#[derive(Default, Serialize)]
struct Row {
    cells: Value,
    cell_size: Option<f64>,
    time_step: Option<f64>,
    steps: Option<usize>,
    particles: Option<usize>,
    l1: Option<f64>,
    l2: Option<f64>,
    linf: Option<f64>,
    order_l1: Option<f64>,
    order_l2: Option<f64>,
    order_linf: Option<f64>,
    seconds: Option<f64>,
    failure: Option<String>,
}

impl Row {
    fn of(level: &Level, before: Option<&Level>) -> Self {
        let observed = before.map_or_else(Orders::default, |before| orders(before, level));
        let errors = level.errors.as_ref().ok();
        Row {
            cells: method::division(&level.cells),
            cell_size: Some(level.cell_size),
            time_step: Some(level.time_step),
            steps: Some(level.steps),
            particles: Some(level.particles),
            l1: errors.map(|errors| errors.l1),
            l2: errors.map(|errors| errors.l2),
            linf: errors.map(|errors| errors.linf),
            order_l1: observed.l1,
            order_l2: observed.l2,
            order_linf: observed.linf,
            seconds: Some(level.seconds),
            failure: level.errors.as_ref().err().map(ToString::to_string),
        }
    }

    fn of_refused(refused: &Refused) -> Self {
        Row {
            cells: method::division(&refused.cells),
            failure: Some(format!("not started: {}", refused.reason)),
            ..Row::default()
        }
    }
}

impl Study {
    /// The levels that were started.
    fn started(&self) -> impl Iterator<Item = &Level> {
        self.levels.iter().flatten()
    }

    fn rows(&self) -> Vec<Row> {
        let before =
            std::iter::once(None).chain(self.levels.iter().map(|level| level.as_ref().ok()));
        let pairs = self.levels.iter().zip(before);
        pairs
            .map(|(level, before)| match level {
                Ok(level) => Row::of(level, before),
                Err(refused) => Row::of_refused(refused),
            })
            .collect()
    }

    /// The JSON document.
    pub fn document(&self) -> Value {
        json!({
            "field": self.field,
            "method": method::document(&self.method, self.precision),
            "levels": self.rows(),
            "expected_order": self.expected_order,
            "observed_order": self.judgement.observed_order,
            "verdict": self.judgement.verdict.to_string(),
        })
    }

    /// The table for a terminal, with the verdict.
    pub fn table(&self) -> String {
        let mut table = Table::new();
        table.load_style(NOTHING).set_header([
            "cells",
            "particles",
            "steps",
            "l1",
            "order",
            "l2",
            "order",
            "linf",
            "order",
            "time",
        ]);
        for row in self.rows() {
            let dead = if row.steps.is_some() { "stopped" } else { "not started" };
            let error = |error: Option<f64>| error.map_or(dead.into(), |e| format!("{e:.2e}"));
            let order = |order: Option<f64>| order.map_or("-".into(), |o| format!("{o:.2}"));
            let count = |count: Option<usize>| count.map_or("-".into(), |c| c.to_string());
            table.add_row([
                row.cells.to_string().replace('"', ""),
                count(row.particles),
                count(row.steps),
                error(row.l1),
                order(row.order_l1),
                error(row.l2),
                order(row.order_l2),
                error(row.linf),
                order(row.order_linf),
                row.seconds.map_or("-".into(), duration),
            ]);
        }
        for column in table.column_iter_mut() {
            column.set_cell_alignment(CellAlignment::Right);
        }
        let observed = match self.judgement.observed_order {
            Some(order) => format!("observed order {order:.2} (l2, finest pair)"),
            None => "no observed order".into(),
        };
        format!(
            "{}: {}\n{}\n\n{table}\n\n{}: {observed}, expected {} within {}",
            self.field,
            self.title,
            method::line(&self.method, self.precision),
            self.judgement.verdict,
            self.expected_order,
            self.tolerance
        )
    }

    /// Writes convergence.svg, .csv and .json into a folder, and returns their paths.
    pub fn write(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        std::fs::create_dir_all(folder)
            .with_context(|| format!("cannot make the folder `{}`", folder.display()))?;
        let json = serde_json::to_string_pretty(&self.document())? + "\n";
        let files = [("svg", picture::draw(self)?), ("csv", self.csv()?), ("json", json)];
        files
            .into_iter()
            .map(|(extension, content)| {
                let path = folder.join("convergence").with_extension(extension);
                write_whole(&path, &content)
                    .with_context(|| format!("cannot write `{}`", path.display()))?;
                Ok(path.display().to_string())
            })
            .collect()
    }

    fn csv(&self) -> anyhow::Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for row in self.rows() {
            writer.serialize(row)?;
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }
}

/// Never leaves half a file under its final name.
pub(crate) fn write_whole(path: &Path, content: &str) -> anyhow::Result<()> {
    let mut file = builder().tempfile_in(path.parent().unwrap_or(Path::new(".")))?;
    file.write_all(content.as_bytes())?;
    file.persist(path)?;
    Ok(())
}

/// A temporary file is private by default; these are results, as open as any other file.
fn builder() -> tempfile::Builder<'static, 'static> {
    #[cfg_attr(not(unix), allow(unused_mut))]
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

/// Seconds for a person.
pub(crate) fn duration(seconds: f64) -> String {
    if seconds < 1.0 { format!("{:.1} ms", seconds * 1e3) } else { format!("{seconds:.1} s") }
}
