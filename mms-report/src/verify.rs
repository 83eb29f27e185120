//! The matrix as a table, as a JSON document, and as a page.

use mms_documents::provenance::Provenance;
use mms_documents::study::{Level, LevelErrors};
use mms_documents::verify::{ListedRow, VerifiedRow, Verify, VerifyList};
use mms_files::words::duration;
use mms_lab::outcome::SolverOutcome;
use mms_lab::rows::Named as _;
use mms_options::Study;
use mms_verify::matrix::MatrixRow;
use mms_verify::verdict::Judgement;

use crate::method::division;
use crate::shown::Shown;
use crate::table::TextTable;
use crate::tally;
use crate::text::next;

/// Rows with their results.
pub struct Report<'a> {
    /// Whether `--quick` was given.
    pub quick: bool,
    /// The rows that were run.
    pub rows: Vec<JudgedRow<'a>>,
    /// The provenance.
    pub provenance: Provenance,
}

/// A row with its result.
pub struct JudgedRow<'a> {
    /// The row.
    pub row: &'a MatrixRow,
    /// The study of the row.
    pub study: Study,
    /// The levels, coarse to fine.
    pub levels: Vec<SolverOutcome>,
    /// The judgement of the levels.
    pub judgement: Judgement,
}

impl JudgedRow<'_> {
    fn document(&self) -> VerifiedRow {
        let Judgement { constant, verdict, expected, reason, .. } = &self.judgement;
        VerifiedRow {
            name: self.row.name.clone(),
            study: self.row.study.clone(),
            refined: if self.row.halvings > 0 { "time" } else { "space and time" }.to_owned(),
            quantity: self.row.quantity.name().to_owned(),
            formal_order: self.row.order.to_string(),
            tolerance: self.row.tolerance,
            theory: self.row.theory.clone(),
            levels: (0..self.levels.len()).map(|at| self.level(at)).collect(),
            observed_order: self.judgement.observed_order(),
            error_constant: *constant,
            expected_error_constant: self.row.constant,
            verdict: verdict.to_string(),
            expected_verdict: expected.to_string(),
            reason: reason.clone(),
            seconds: self.seconds(),
        }
    }

    fn seconds(&self) -> f64 {
        self.levels.iter().filter_map(SolverOutcome::run).map(|run| run.seconds).sum()
    }

    fn level(&self, at: usize) -> Level {
        let (level, [order_l1, order_l2, order_linf]) =
            (&self.levels[at], self.judgement.orders[at]);
        let (run, errors) = (level.run(), self.row.errors(level));
        let norm = |norm: usize| errors.map(|errors| errors[norm]);
        let [l1, l2, linf] = [0, 1, 2].map(norm);
        Level {
            cells: division(&self.study.cells[if self.row.halvings > 0 { 0 } else { at }]),
            cell_size: run.map(|run| run.cell_size),
            time_step: run.map(|run| run.time_step),
            steps: run.map(|run| run.steps),
            particles: run.map(|run| run.particles),
            errors: LevelErrors { l1, l2, linf, order_l1, order_l2, order_linf },
            seconds: run.map(|run| run.seconds),
            failure: level.failure().map(|it| it.to_string()),
            round_off: None,
            residual_ratio: None,
        }
    }
}

impl Report<'_> {
    /// The rows whose verdict is not the expected one.
    pub fn unexpected(&self) -> impl Iterator<Item = &JudgedRow<'_>> {
        self.rows.iter().filter(|row| !row.judgement.as_expected())
    }

    fn table(&self) -> TextTable {
        let header = ["mode", "field", "formal", "observed", "constant", "verdict", "", "time"];
        let mut table = TextTable::new("verification matrix", header).right([2, 3, 4, 7]);
        for judged in &self.rows {
            let Judgement { constant, verdict, .. } = &judged.judgement;
            table.add_row([
                judged.row.name.clone(),
                judged.study.field.clone(),
                judged.row.order.to_string(),
                decimals(judged.judgement.observed_order()),
                constant.map_or("-".into(), |constant| format!("{constant:.2e}")),
                verdict.to_string(),
                if judged.judgement.as_expected() { "" } else { "UNEXPECTED" }.to_owned(),
                duration(judged.seconds()),
            ]);
        }
        table
    }

    /// The page: all content that does not depend on a machine.
    pub fn page(&self) -> String {
        let mut page = String::from(INTRODUCTION);
        let mut group = "";
        for judged in &self.rows {
            let JudgedRow { row, judgement, .. } = judged;
            if row.group() != group {
                group = row.group();
                page += &format!(
                    "\n## {group}\n\n| mode | study | refined | formal order | observed | constant | verdict | theory |\n|---|---|---|---|---|---|---|---|\n"
                );
            }
            let observed: Vec<_> =
                judgement.orders.iter().skip(1).map(|orders| decimals(orders[1])).collect();
            page += &format!(
                "{}{} | {} | {} |\n",
                fixed(row),
                observed.join(", "),
                judgement.constant.map_or("-".into(), |constant| format!("{constant:.3e}")),
                format_args!("{} | {}", judgement.verdict, row.theory)
            );
        }
        page
    }
}

impl Report<'_> {
    /// The words of the study of the first row that is not as expected.
    fn next(&self) -> Option<Vec<String>> {
        let study = &self.unexpected().next()?.row.study;
        Some(
            ["mms", "study"]
                .into_iter()
                .chain(study.split_whitespace())
                .map(str::to_owned)
                .collect(),
        )
    }
}

impl Shown for Report<'_> {
    type Document = Verify;

    fn text(&self) -> String {
        let mut text = format!("{}\n", self.table());
        for judged in self.unexpected() {
            let MatrixRow { name, study, theory, .. } = judged.row;
            let Judgement { verdict, expected, reason, .. } = &judged.judgement;
            let reason = reason.as_deref().unwrap_or_default();
            text += &format!(
                "\n{name}: {verdict}, expected {expected}: {reason}\n  theory: {theory}\n  mms study {study}\n"
            );
        }
        text += &format!(
            "\n{}",
            tally(self.unexpected().count(), self.rows.len(), "as theory expects")
        );
        text.extend(next(self.next().as_ref()).map(|line| format!("\n{line}")));
        text
    }

    fn tables(&self) -> Vec<TextTable> {
        vec![self.table()]
    }

    fn document(&self) -> Verify {
        Verify {
            matrix: if self.quick { "quick" } else { "full" }.to_owned(),
            rows: self.rows.iter().map(JudgedRow::document).collect(),
            unexpected: self.unexpected().map(|judged| judged.row.name.clone()).collect(),
            next_command: self.next(),
            provenance: self.provenance.clone(),
        }
    }
}

/// The rows of the matrix before they are run.
pub struct List<'a> {
    /// The rows.
    pub rows: &'a [&'a MatrixRow],
    /// Whether `--quick` was given.
    pub quick: bool,
}

impl Shown for List<'_> {
    type Document = VerifyList;

    fn text(&self) -> String {
        let lines = self.rows.iter().map(|row| {
            let MatrixRow { name, study, order, theory, .. } = row;
            format!("{name}: order {order}; {theory}\n  mms study {study}\n")
        });
        lines.collect()
    }

    fn tables(&self) -> Vec<TextTable> {
        let header = ["mode", "study", "levels", "formal order", "theory"];
        let mut table = TextTable::new("rows of the verification matrix", header).right([2, 3]);
        for row in self.rows {
            table.add_row([
                row.name.clone(),
                row.study.clone(),
                row.levels(self.quick).to_string(),
                row.order.to_string(),
                row.theory.clone(),
            ]);
        }
        vec![table]
    }

    fn document(&self) -> VerifyList {
        let rows = self.rows.iter().map(|row| ListedRow {
            name: row.name.clone(),
            study: row.study.clone(),
            levels: row.levels(self.quick),
            formal_order: row.order.to_string(),
            theory: row.theory.clone(),
        });
        VerifyList { rows: rows.collect() }
    }
}

/// The text before the tables of the page.
const INTRODUCTION: &str = "\
# Verification matrix

Each row tests one mode of the built-in solver, that is one of its features, with a field that isolates it. The rows are data in
`mms-verify/src/matrix.toml`, with the order that theory expects; this page adds the observed orders. The command
`cargo run --release -- verify --page > docs/verification.md` writes this page.

If only the time step is refined, the order is the order in time. Observed orders compare l2 of neighbouring
levels, from coarse to fine. The constant is l2 over h^order or dt^order at the finest level of `mms verify --quick`, in the
units of the field. It may differ by 1 % from the constant in `matrix.toml`. The formal order `none` means that theory expects an
error that does not shrink, or a run that stops; `exact` means that rounding is the only error. The slides in
the last column are from the [source of the bar](verified.md#a-wrong-sign-in-a-published-formula).
";

/// The cells of a line of the page that follow from the row alone.
fn fixed(row: &MatrixRow) -> String {
    let mode = row.name.split('/').nth(1).unwrap_or_default();
    let refined = match row.halvings {
        0 => String::from("h and dt"),
        halvings => format!("dt, halved {halvings} times"),
    };
    let quantity = match row.quantity.name() {
        "displacement" => String::new(),
        name => format!(", error of {}", name.replace('_', " ")),
    };
    format!("| {mode} | `{}`{quantity} | {refined} | {} | ", row.study, row.order)
}

fn decimals(number: Option<f64>) -> String {
    number.map_or("-".into(), |number| format!("{number:.2}"))
}

#[cfg(test)]
mod tests {
    use mms_verify::matrix::{ExpectedConvergence, Word, rows};

    use super::fixed;

    /// The command writes the observed columns of the page; this test checks the columns that follow from the rows.
    #[test]
    fn the_page_has_these_rows() {
        let page = include_str!("../../docs/verification.md");
        let lines: Vec<_> = page.lines().filter(|line| line.contains("| `")).collect();
        let rows = rows().unwrap();
        let write = "write it anew: cargo run --release -- verify --page > docs/verification.md";
        assert_eq!(lines.len(), rows.len(), "{write}");
        for (line, row) in lines.into_iter().zip(&rows) {
            assert!(line.starts_with(&fixed(row)), "{}: {write}", row.name);
            assert!(line.ends_with(&format!("| {} |", row.theory)), "{}: {write}", row.name);
            let verdict = match row.order {
                ExpectedConvergence::Word(Word::None) => "| does not converge |",
                _ => "| pass |",
            };
            assert!(line.contains(verdict), "{}: {line}", row.name);
        }
    }
}
