//! Measured errors as a table, a JSON document and a picture.

use std::path::Path;

use mms_analysis::accuracy::{Accuracy, AccuracyRow, Errors};
use mms_documents::accuracy as documents;
use mms_documents::provenance::Provenance;
use mms_files::write::{pretty, write_files};
use mms_lab::workbench::Time;
use mms_program::precision::Precision;
use mms_spec::Form;
use mms_spec::foreign::Foreign;
use mms_spec::quantity::Quantity;

use super::page::Section as _;
use super::plot::Figure;
use crate::shown::Shown;
use crate::table::TextTable;

/// The bound of the stable form, in eps of the largest value of a quantity.
pub const BOUND: f64 = 64.0;

/// The regimes in which the stable form promises its bound.
const PROMISED: [&str; 4] =
    ["declared", "displacement_1e-4", "displacement_1e-8", "displacement_1e-12"];

/// The measured errors of a field.
pub struct Report {
    /// The field's name.
    pub field: Foreign,
    /// The number of points.
    pub points: usize,
    /// The errors.
    pub accuracy: Accuracy,
    /// The times of the emitted code; empty if they were not measured.
    pub times: Vec<(Form, Time)>,
    /// Whether all rows are shown, or the worst of each quantity.
    pub all: bool,
    /// The provenance.
    pub provenance: Provenance,
}

/// Whether a form has a promised bound in a regime.
pub fn is_promised(form: &str, regime: &str) -> bool {
    form == Form::Stable.name() && PROMISED.contains(&regime)
}

/// Whether a row has a promised bound.
fn has_promise(row: &AccuracyRow) -> bool {
    is_promised(row.form.name(), row.regime.raw())
}

/// Whether a row is within its promised bound; `None` if it has no promise, or no component that could be compared.
fn within_bound(row: &AccuracyRow) -> Option<bool> {
    let Errors { max_scaled_eps, not_finite, compared, .. } = row.errors;
    let is_known = compared > 0 || not_finite > 0;
    (has_promise(row) && is_known).then_some(max_scaled_eps <= BOUND && not_finite == 0)
}

/// An error of a row; `None` if it was not measured.
fn measured(row: &AccuracyRow, of: impl Fn(&Errors) -> f64) -> Option<f64> {
    (row.errors.compared > 0).then(|| of(&row.errors))
}

impl Report {
    /// The rows that exceed their promised bound.
    pub fn broken(&self) -> Vec<&AccuracyRow> {
        self.accuracy.rows.iter().filter(|row| within_bound(row) == Some(false)).collect()
    }

    /// The rows with a promised bound that were not measured.
    pub fn unmeasured(&self) -> Vec<&AccuracyRow> {
        let rows = self.accuracy.rows.iter();
        rows.filter(|row| has_promise(row) && within_bound(row).is_none()).collect()
    }

    /// Whether nothing at all was measured, or nothing of the field as declared, although that was selected.
    pub fn is_unmeasured(&self) -> bool {
        let rows = &self.accuracy.rows;
        self.is_declared_left_out() || rows.iter().all(|row| row.errors.compared == 0)
    }

    fn is_declared_left_out(&self) -> bool {
        let [declared, ..] = PROMISED;
        let Accuracy { rows, left_out } = &self.accuracy;
        left_out.iter().any(|it| it.regime == declared)
            && !rows.iter().any(|row| row.regime == declared)
    }

    /// The nanoseconds per point of the emitted code of a row.
    fn time(&self, quantity: Quantity, precision: Precision, form: Form) -> Option<f64> {
        let same = |(of, time): &&(Form, Time)| {
            *of == form && time.quantity == quantity && time.precision == precision
        };
        self.times.iter().find(same).map(|(_, time)| time.ns_per_point)
    }

    /// The rows that are shown: all, or the row of the largest error for each quantity, precision and form.
    fn shown(&self, all: bool) -> Vec<&AccuracyRow> {
        let rows = self.accuracy.rows.iter();
        if all {
            return rows.collect();
        }
        let mut shown: Vec<&AccuracyRow> = Vec::new();
        for row in rows {
            let key = |row: &AccuracyRow| (row.quantity, row.precision, row.form);
            match shown.iter_mut().find(|other| key(other) == key(row)) {
                Some(other) if is_worse(row, other) => {
                    *other = row;
                }
                Some(_) => {}
                None => shown.push(row),
            }
        }
        shown.sort_by_key(|row| row.quantity);
        shown
    }

    fn table(&self) -> TextTable {
        let caption = format!("{}, {} points, errors in eps", self.field.shown(), self.points);
        let header = [
            "quantity",
            "precision",
            "form",
            "regime",
            "median",
            "99 %",
            "max",
            "max/largest",
            "not finite",
            "ns/point",
        ];
        let mut table = TextTable::new(caption, header).right_from(4);
        for row in self.shown(self.all) {
            let errors = row.errors;
            let lost = match (errors.not_finite, errors.overflowed) {
                (0, _) => "-".into(),
                (lost, overflowed) => format!("{lost} ({overflowed} too large)"),
            };
            let time = self.time(row.quantity, row.precision, row.form);
            let shown =
                |of: fn(&Errors) -> f64| measured(row, of).map_or("not measured".into(), eps);
            table.add_row([
                row.quantity.name().to_string(),
                row.precision.name().into(),
                row.form.name().into(),
                row.regime.shown(),
                shown(|it| it.median_eps),
                shown(|it| it.p99_eps),
                shown(|it| it.max_eps),
                shown(|it| it.max_scaled_eps),
                lost,
                time.map_or("-".into(), |time| format!("{time:.2}")),
            ]);
        }
        table
    }

    /// Writes accuracy.json and, if there are times, accuracy.svg into a folder; returns their paths.
    pub fn write(&self, folder: &Path) -> anyhow::Result<Vec<String>> {
        let mut paths = write_files(folder, "accuracy", [("json", pretty(&self.document())?)])?;
        if !self.times.is_empty() {
            let caption = format!("{}: {} points", self.field.shown(), self.points);
            let figure = Figure::new(caption, self.document().plots());
            paths.extend(write_files(folder, "accuracy", [("svg", figure.svg())])?);
        }
        Ok(paths)
    }
}

impl Shown for Report {
    type Document = documents::Accuracy;

    fn text(&self) -> String {
        let table = self.table();
        let mut text =
            format!("{}, {} points, errors in eps\n\n{table}\n", self.field.shown(), self.points);
        for left_out in &self.accuracy.left_out {
            let quantity = left_out.quantity.map_or(String::new(), |it| format!(", {}", it.name()));
            let precision =
                left_out.precision.map_or(String::new(), |it| format!(" in {}", it.name()));
            text += &format!(
                "\nleft out: {}{quantity}{precision}: {}",
                left_out.regime.shown(),
                left_out.reason
            );
        }
        if self.is_declared_left_out() {
            text += "\nnothing was measured of the field as declared";
        } else if self.is_unmeasured() {
            text += "\nnothing was measured";
        }
        for row in self.unmeasured() {
            text += &format!(
                "\nnot measured: {} in {} at {}: no component has a real value, {} were looked at",
                row.quantity.name(),
                row.precision.name(),
                row.regime.shown(),
                row.errors.undefined
            );
        }
        for row in self.broken() {
            text += &format!(
                "\nbeyond {BOUND} eps: {} in {} at {}: {} eps, {} not finite",
                row.quantity.name(),
                row.precision.name(),
                row.regime.shown(),
                measured(row, |it| it.max_scaled_eps).map_or("unknown".into(), eps),
                row.errors.not_finite
            );
        }
        text
    }

    fn tables(&self) -> Vec<TextTable> {
        vec![self.table()]
    }

    fn document(&self) -> documents::Accuracy {
        let row = |row: &AccuracyRow| documents::AccuracyRow {
            quantity: row.quantity.name().to_owned(),
            precision: row.precision.name().to_owned(),
            form: row.form.name().to_owned(),
            regime: row.regime.raw().to_owned(),
            median_eps: measured(row, |it| it.median_eps),
            p99_eps: measured(row, |it| it.p99_eps),
            max_eps: measured(row, |it| it.max_eps),
            max_scaled_eps: measured(row, |it| it.max_scaled_eps),
            compared: row.errors.compared,
            not_finite: row.errors.not_finite,
            overflowed: row.errors.overflowed,
            undefined: row.errors.undefined,
            within_bound: within_bound(row),
            ns_per_point: self.time(row.quantity, row.precision, row.form),
        };
        let left_out = self.accuracy.left_out.iter().map(|it| documents::LeftOut {
            regime: it.regime.raw().to_owned(),
            quantity: it.quantity.map(|it| it.name().to_owned()),
            precision: it.precision.map(|it| it.name().to_owned()),
            reason: it.reason.to_string(),
        });
        documents::Accuracy {
            field: self.field.raw().to_owned(),
            points: self.points,
            bound_eps: BOUND,
            rows: self.accuracy.rows.iter().map(row).collect(),
            left_out: left_out.collect(),
            provenance: self.provenance.clone(),
        }
    }
}

/// Whether a row has a larger error of a quantity; a row without a measured error has none.
fn is_worse(row: &AccuracyRow, other: &AccuracyRow) -> bool {
    let [row, other] = [row, other].map(|it| measured(it, |errors| errors.max_scaled_eps));
    row > other
}

/// An error for a person.
pub fn eps(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        small if small < 1000.0 => format!("{small:.2}"),
        large => format!("{large:.1e}"),
    }
}
