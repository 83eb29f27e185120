//! Comparisons of results as tables and JSON documents.

use mms_convergence::Verdict;
use mms_spec::foreign::shown;
use serde_json::{Value, json};

use super::text::{plain, to_the_right};
use crate::judge::results::{Compared, Same};

/// Errors and what they were.
pub(crate) fn with_baseline(title: &str, all: &[Compared], verdict: Verdict) -> (String, Value) {
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
    let document = all.iter().map(|it| {
        json!({
            "quantity": it.quantity, "norm": it.norm, "cell_size": it.length, "error": it.error, "saved": it.saved,
            "near": it.is_near(),
        })
    });
    let document =
        json!({ "errors": document.collect::<Vec<_>>(), "verdict": verdict.to_string() });
    let text = format!(
        "{title}\n\n{}\n\n{verdict}: errors may differ from those that were saved by 1 %",
        to_the_right(table)
    );
    (text, document)
}

/// How far two results differ.
pub(crate) fn differences(a: &str, b: &str, same: &Same) -> (String, Value) {
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
    let document = all.iter().map(|it| {
        json!({
            "array": it.name, "time": it.time, "largest": it.largest, "relative": it.relative(), "where": it.place,
        })
    });
    let document = json!({ "source": [a, b], "paired": paired, "differences": document.collect::<Vec<_>>(), "alone": alone, "words": words });
    (text, document)
}
