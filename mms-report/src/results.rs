//! Comparisons of results as tables and JSON documents.

use mms_convergence::Verdict;
use mms_documents::judge::{DifferenceOfResults, JudgeBaseline, JudgeSame, SavedError};
use mms_judge::results::{Compared, Same};
use mms_spec::foreign::shown;

use super::text::{plain, to_the_right};

/// Errors and what they were.
pub fn with_baseline(title: &str, all: &[Compared], verdict: Verdict) -> (String, JudgeBaseline) {
    let mut table = plain(["quantity", "norm", "h", "error", "saved", "change"]);
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
    let text = format!(
        "{title}\n\n{}\n\n{verdict}: errors may differ from those that were saved by 1 %",
        to_the_right(table)
    );
    (text, document)
}

/// How far two results differ.
pub fn differences(a: &str, b: &str, same: &Same) -> (String, JudgeSame) {
    let Same { differences: all, alone, words, paired, .. } = same;
    let mut table = plain(["array", "time", "largest", "relative", "where"]);
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
        text += &format!("\n\nin one of them alone: {}", shown(&alone.join(", ")));
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
    (text, document)
}
