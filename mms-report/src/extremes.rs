//! The solver at its limits, as a table and as a JSON document.

use mms_documents::extremes::{ExtremeRow, Extremes, StabilityLimit};
use mms_documents::provenance::Provenance;
use mms_lab::extremes::rows::ExtremeSetting;
use mms_lab::extremes::verdict::{Declared, ExtremeVerdict, RunResult, bound};
use mms_options::method::Arithmetic;
use mms_runtime::Method;
use mms_spec::foreign::Foreign;

use super::method;
use super::text::tally;
use crate::shown::Shown;
use crate::table::TextTable;

/// The results of a field at its extremes.
pub struct Report {
    /// The field's name.
    pub field: Foreign,
    /// The field's title.
    pub title: Foreign,
    /// The method.
    pub method: Method,
    /// The arithmetic of the runs.
    pub arithmetic: Arithmetic,
    /// Whether `--quick` was given.
    pub quick: bool,
    /// The field as declared.
    pub declared: Declared,
    /// The rows.
    pub rows: Vec<JudgedExtreme>,
    /// The largest stable Courant numbers.
    pub stability: Vec<Stability>,
    /// The provenance.
    pub provenance: Provenance,
}

/// A row with its result.
pub struct JudgedExtreme {
    /// The row.
    pub row: ExtremeSetting,
    /// The extreme in words.
    pub setting: String,
    /// The result of the run.
    pub seen: RunResult,
    /// The verdict on the result.
    pub verdict: ExtremeVerdict,
}

/// The largest stable Courant number of a method.
pub struct Stability {
    /// The method.
    pub method: Method,
    /// The limit on an endless grid, if it is known.
    pub theory: Option<f64>,
    /// The limit on the body.
    pub measured: f64,
    /// Whether it is the method of the other rows, whose Courant number has to be stable for it.
    pub is_own: bool,
}

/// The factor by which a measured limit may exceed the theoretical limit: the number of steps is finite.
const ABOVE: f64 = 1.05;

/// A limit below this part of the theoretical limit is set by the faces.
const BELOW: f64 = 0.95;

impl Stability {
    /// The part of the body that sets the limit; or a word for an unexpected limit.
    pub fn verdict(&self) -> &'static str {
        match self.theory {
            _ if self.is_own && self.measured < self.method.setup.courant => {
                "unstable as it is run"
            }
            None => "no theory",
            Some(theory) if self.measured > ABOVE * theory => "above theory",
            Some(theory) if self.measured >= BELOW * theory => "as in the interior",
            Some(_) => "less at the faces",
        }
    }

    /// Whether the limit is expected.
    pub fn is_expected(&self) -> bool {
        !matches!(self.verdict(), "unstable as it is run" | "above theory")
    }
}

impl JudgedExtreme {
    /// The largest allowed l2; `None` for a run that stopped, since the bound needs the round-off of the run.
    fn bound(&self, declared: Declared) -> Option<f64> {
        match self.seen {
            RunResult::Ended { round_off, cell_size, .. } => {
                bound(&self.row, declared, cell_size, round_off)
            }
            _ => None,
        }
    }

    fn expected(&self, declared: Declared) -> String {
        let bound = self.bound(declared).map(|bound| format!("l2 at most {bound:.1e}"));
        let names: Vec<_> = self.row.stops.iter().map(|it| it.name()).collect();
        let stops = match names.len() {
            0 => None,
            1 | 2 => Some(names.join(" or ")),
            _ => Some("stops".to_owned()),
        };
        let alone = self.row.l2.filter(|_| bound.is_none()).map(|_| "a bound".to_owned());
        bound.or(alone).into_iter().chain(stops).collect::<Vec<_>>().join(", or ")
    }

    fn seen(&self) -> String {
        match &self.seen {
            RunResult::Ended { l2, .. } => format!("{l2:.1e}"),
            RunResult::Stopped { diagnosis, .. } => diagnosis.name().into(),
            RunResult::LeftOut { .. } => "-".into(),
        }
    }

    fn document(&self, declared: Declared) -> ExtremeRow {
        let l2 = match self.seen {
            RunResult::Ended { l2, .. } => Some(l2),
            _ => None,
        };
        let (diagnosis, reason) = match &self.seen {
            RunResult::Ended { .. } => (None, None),
            RunResult::Stopped { diagnosis, reason } => {
                (Some(diagnosis.name().to_owned()), Some(reason.clone()))
            }
            RunResult::LeftOut { reason } => (None, Some(reason.clone())),
        };
        ExtremeRow {
            name: self.row.name.clone(),
            setting: self.setting.clone(),
            theory: self.row.theory.clone(),
            allowed_factor: self.row.l2,
            allowed_diagnoses: self.row.stops.iter().map(|it| it.name().to_owned()).collect(),
            l2,
            bound: self.bound(declared),
            diagnosis,
            reason,
            verdict: self.verdict.name().to_owned(),
            expected: self.verdict.is_expected(),
        }
    }
}

/// The message if nothing ran.
const UNMEASURED: &str = "nothing was measured";

impl Report {
    /// Whether the field could be put at none of the selected extremes.
    fn is_unmeasured(&self) -> bool {
        let is_left_out = |row: &JudgedExtreme| row.verdict == ExtremeVerdict::LeftOut;
        self.rows.iter().all(is_left_out) && self.stability.is_empty()
    }

    /// The names of rows that disagree with theory.
    pub fn unexpected(&self) -> Vec<String> {
        let rows = self.rows.iter().filter(|row| !row.verdict.is_expected());
        let rows = rows.map(|row| row.row.name.clone());
        let limits = self.stability.iter().filter(|it| !it.is_expected());
        if self.is_unmeasured() {
            return vec![UNMEASURED.into()];
        }
        rows.chain(limits.map(|it| format!("stability/{}", name(&it.method)))).collect()
    }

    fn rows_table(&self) -> TextTable {
        let header = ["row", "setting", "expected", "seen", "verdict", ""];
        let mut table = TextTable::new(format!("{} at its limits", self.field.shown()), header);
        for row in &self.rows {
            table.add_row([
                row.row.name.clone(),
                row.setting.clone(),
                row.expected(self.declared),
                row.seen(),
                row.verdict.name().into(),
                mark(row.verdict.is_expected()),
            ]);
        }
        table
    }

    fn limits_table(&self) -> TextTable {
        let header = ["largest stable Courant number", "theory", "measured", "verdict", ""];
        let mut limits = TextTable::new("largest stable Courant numbers", header).right([1, 2]);
        for it in &self.stability {
            limits.add_row([
                name(&it.method),
                it.theory.map_or("-".into(), |theory| format!("{theory:.3}")),
                format!("{:.3}", it.measured),
                it.verdict().into(),
                mark(it.is_expected()),
            ]);
        }
        limits
    }
}

impl Shown for Report {
    type Document = Extremes;

    fn text(&self) -> String {
        let (table, limits) = (self.rows_table(), self.limits_table());
        let mut text = format!(
            "{}: {}\n{}\nas declared, l2 is {:.2e} of the largest displacement\n",
            self.field.shown(),
            self.title.shown(),
            method::line(&self.method, self.arithmetic),
            self.declared.l2
        );
        if !self.rows.is_empty() {
            text += &format!("\n{table}\n");
        }
        if !self.stability.is_empty() {
            text += &format!("\n{limits}\n");
        }
        for row in &self.rows {
            let reason = match &row.seen {
                RunResult::LeftOut { reason } => reason,
                RunResult::Stopped { reason, .. } if !row.verdict.is_expected() => reason,
                RunResult::Ended { .. } if row.verdict != ExtremeVerdict::WithinBound => {
                    &row.row.theory
                }
                _ => continue,
            };
            text += &format!("\n{}: {}: {reason}", row.row.name, row.verdict.name());
        }
        if self.is_unmeasured() {
            return text + "\n" + UNMEASURED;
        }
        let (unexpected, count) = (self.unexpected().len(), self.rows.len() + self.stability.len());
        text + "\n" + &tally(unexpected, count, "as theory expects")
    }

    fn tables(&self) -> Vec<TextTable> {
        let limits = (!self.stability.is_empty()).then(|| self.limits_table());
        [self.rows_table()].into_iter().chain(limits).collect()
    }

    fn document(&self) -> Extremes {
        let stability = self.stability.iter().map(|it| StabilityLimit {
            method: name(&it.method),
            theory: it.theory,
            measured: it.measured,
            verdict: it.verdict().to_owned(),
            expected: it.is_expected(),
        });
        Extremes {
            field: self.field.raw().to_owned(),
            method: method::document(&self.method, self.arithmetic),
            quick: self.quick,
            declared_l2: self.declared.l2,
            rows: self.rows.iter().map(|row| row.document(self.declared)).collect(),
            stability: stability.collect(),
            unexpected: self.unexpected(),
            provenance: self.provenance.clone(),
        }
    }
}

fn mark(is_expected: bool) -> String {
    if is_expected { String::new() } else { "UNEXPECTED".into() }
}

/// The method without its Courant number.
fn name(method: &Method) -> String {
    let Method { formulation, shape, integrator, setup } = method;
    format!("{formulation} {shape} {integrator} {}", setup.transfer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_is_that_of_theory_or_less_and_above_what_is_run() {
        let verdict = |theory, measured, is_own| {
            let it = Stability { method: Method::default(), theory, measured, is_own };
            (it.verdict(), it.is_expected())
        };
        assert_eq!(verdict(Some(0.75), 0.76, true), ("as in the interior", true));
        assert_eq!(verdict(Some(0.75), 0.6, true), ("less at the faces", true));
        assert_eq!(verdict(Some(0.75), 0.8, true), ("above theory", false));
        assert_eq!(verdict(Some(0.75), 0.3, true), ("unstable as it is run", false));
        assert_eq!(verdict(Some(0.75), 0.3, false), ("less at the faces", true));
        assert_eq!(verdict(None, 0.5, false), ("no theory", true));
    }
}
