//! Comparisons of results as tables and JSON documents.

use mms_convergence::Verdict;
use mms_documents::judge::{DifferenceOfResults, JudgeBaseline, JudgeSame, SavedError};
use mms_judge::results::{Compared as Saved, Same};
use mms_spec::foreign::shown;
use serde::Serialize;

use super::shown::Shown;
use super::table::TextTable;

/// A comparison of results with saved ones, or with each other.
pub struct Compared<D> {
    text: String,
    table: TextTable,
    document: D,
}

impl<D: Clone + Serialize> Shown for Compared<D> {
    type Document = D;

    fn text(&self) -> String {
        self.text.clone()
    }

    fn tables(&self) -> Vec<TextTable> {
        vec![self.table.clone()]
    }

    fn document(&self) -> D {
        self.document.clone()
    }
}

/// Errors beside the saved ones.
pub fn with_baseline(title: &str, all: &[Saved], verdict: Verdict) -> Compared<JudgeBaseline> {
    let header = ["quantity", "norm", "h", "error", "saved", "change"];
    let mut table = TextTable::new(title, header).right_from(0);
    for it in all {
        let change = 100.0 * (it.error / it.saved - 1.0);
        table.add_row([
            shown(&it.quantity),
            shown(&it.norm),
            format!("{:.3e}", it.length),
            format!("{:.4e}", it.error),
            format!("{:.4e}", it.saved),
            format!("{change:+.2} %"),
        ]);
    }
    let errors = all.iter().map(|it| SavedError {
        quantity: it.quantity.to_string(),
        norm: it.norm.to_string(),
        cell_size: it.length,
        error: it.error,
        saved: it.saved,
        near: it.is_near(),
    });
    let document = JudgeBaseline { errors: errors.collect(), verdict: verdict.to_string() };
    let text =
        format!("{title}\n\n{table}\n\n{verdict}: errors may differ by 1 % from the saved ones");
    Compared { text, table, document }
}

/// The differences of two results.
pub fn differences(a: &str, b: &str, same: &Same) -> Compared<JudgeSame> {
    let Same { differences: all, alone, words, paired, .. } = same;
    let header = ["array", "time", "largest", "relative", "where"];
    let mut table = TextTable::new(format!("{} and {}", shown(a), shown(b)), header);
    for it in all {
        table.add_row([
            shown(&it.name),
            it.time.map_or("-".into(), |time| format!("{time:?}")),
            format!("{:.2e}", it.largest),
            format!("{:.1e}", it.relative()),
            shown(&it.place),
        ]);
    }
    let mut text =
        format!("{} and {}\npoints are paired {}\n\n{table}", shown(a), shown(b), shown(paired));
    if !alone.is_empty() {
        text += &format!("\n\nonly in one of them: {}", shown(&alone.join(", ")));
    }
    if !words.is_empty() {
        text += &format!("\n\nwords, which are not compared: {}", shown(&words.join(", ")));
    }
    if !same.is_finite() {
        text += "\n\nsome of these numbers are not finite: a run has failed";
    }
    let finite = |number: f64| number.is_finite().then_some(number);
    let differences = all.iter().map(|it| DifferenceOfResults {
        array: it.name.clone(),
        time: it.time,
        largest: finite(it.largest),
        relative: finite(it.relative()),
        r#where: it.place.clone(),
    });
    let document = JudgeSame {
        source: vec![a.to_owned(), b.to_owned()],
        paired: paired.to_string(),
        differences: differences.collect(),
        alone: alone.clone(),
        words: words.clone(),
    };
    Compared { text, table, document }
}
