//! Diagnoses as text and as a JSON document.

use mms_diagnosis::answer::{Diagnosis, Finding, Ranked};
use mms_spec::foreign::Foreign;
use serde_json::{Value, json};

use super::text::plain;
use crate::diagnose::Listed;
use crate::provenance::Provenance;

/// How many hypotheses a text shows.
const SHOWN: usize = 5;

/// A diagnosis of results of a field.
pub struct Diagnosed<'a> {
    /// The field.
    pub field: &'a Foreign,
    /// The files.
    pub files: &'a [String],
    /// What was found.
    pub diagnosis: &'a Diagnosis,
    /// Where it is from.
    pub provenance: Provenance,
}

impl Diagnosed<'_> {
    /// What a person reads.
    pub fn text(&self) -> String {
        let it = self.diagnosis;
        let mut parts = vec![format!(
            "{}: {}\nthe error is {:.2e} of the solution; a right solver would be at about {:.1e}",
            self.field.shown(),
            it.evidence,
            it.error,
            it.expected
        )];
        parts.push(self.finding());
        if it.finding != Finding::Nothing {
            parts.push(self.table());
        }
        if !it.cannot_be_seen.is_empty() {
            parts.push(format!("these results cannot show: {}", it.cannot_be_seen.join(", ")));
        }
        parts.join("\n\n")
    }

    fn finding(&self) -> String {
        let it = self.diagnosis;
        match (it.finding, it.ranked.first()) {
            (Finding::Nothing, _) => "nothing: the error is of the size that a right solver makes; a finer mesh would show \
                                      more"
                .into(),
            (Finding::Named, Some(best)) => named(best),
            _ => "unexplained: there is an error, and no hypothesis explains enough of it. Accelerations at an exact state \
                  (`mms diagnose` of `a`), or a table of F and stress (`--quantity stress`), show more"
                .into(),
        }
    }

    fn table(&self) -> String {
        let mut table = plain(["hypothesis", "factor", "explains", ""]);
        for it in self.diagnosis.ranked.iter().take(SHOWN) {
            let factor: Vec<String> =
                it.factor.iter().map(|factor| format!("{factor:.4}")).collect();
            let note = if it.is_plausible { "" } else { "of a size that it cannot have" };
            let explained = format!("{:.1} %", 100.0 * it.explained);
            table.add_row([it.title(), factor.join(", "), explained, note.into()]);
        }
        table.to_string()
    }

    /// What a program reads.
    pub fn document(&self) -> Value {
        let it = self.diagnosis;
        json!({
            "field": self.field,
            "files": self.files,
            "evidence": it.evidence,
            "finding": it.finding.name(),
            "error": it.error,
            "expected_error": it.expected,
            "ranked": it.ranked.iter().map(ranked).collect::<Vec<_>>(),
            "cannot_be_seen": it.cannot_be_seen,
            "provenance": self.provenance,
        })
    }
}

/// What a mistake that is named says.
fn named(best: &Ranked) -> String {
    let mut lines =
        vec![format!("named: {} ({})", best.title(), best.kind.name()), best.says.clone()];
    if !best.equivalent_always.is_empty() {
        lines
            .push(format!("the same formula for any field: {}", best.equivalent_always.join(", ")));
    }
    if !best.equivalent_here.is_empty() {
        lines.push(format!("not told apart here: {}", best.equivalent_here.join(", ")));
    }
    if !best.needs.is_empty() {
        lines.push(format!("what tells them apart: {}", best.needs.join("; ")));
    }
    lines.join("\n")
}

fn ranked(it: &Ranked) -> Value {
    let factor = match it.factor.as_slice() {
        [factor] => json!(factor),
        _ => Value::Null,
    };
    let interval = it.factor.first().filter(|_| it.factor.len() == 1);
    json!({
        "hypothesis": it.name,
        "says": it.says,
        "kind": it.kind.name(),
        "factor": factor,
        "interval": interval.map(|factor| [factor - it.margin, factor + it.margin]),
        "vector": if it.factor.len() > 1 { json!(it.factor) } else { Value::Null },
        "explained": it.explained,
        "plausible": it.is_plausible,
        "face": it.face.map(|face| face.to_string()),
        "which": it.which,
        "equivalent_always": it.equivalent_always,
        "equivalent_here": it.equivalent_here,
        "needs": it.needs,
    })
}

/// The hypotheses about a field.
pub struct Hypotheses<'a> {
    /// The field.
    pub field: &'a Foreign,
    /// All of them.
    pub all: Vec<Listed>,
}

impl Hypotheses<'_> {
    /// What a person reads.
    pub fn table(&self) -> String {
        let mut table = plain(["hypothesis", "changes", "kind", "what it is"]);
        for it in &self.all {
            table.add_row([it.title.as_str(), it.changes, it.kind, &it.says]);
        }
        table.to_string()
    }

    /// What a program reads.
    pub fn document(&self) -> Value {
        let each = self.all.iter().map(|it| {
            json!({ "hypothesis": it.title, "changes": it.changes, "kind": it.kind, "says": it.says })
        });
        json!({ "field": self.field, "hypotheses": each.collect::<Vec<_>>() })
    }
}
