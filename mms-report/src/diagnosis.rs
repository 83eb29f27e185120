//! Diagnoses as text and as a JSON document.

use std::path::Path;

use mms_diagnosis::answer::{Diagnosis, DiagnosisFinding, ErrorPlace, Fields, Like, Ranked};
use mms_diagnosis::falls::{Falls, OfOrder};
use mms_diagnosis::list::Listed;
use mms_documents::diagnose as documents;
use mms_documents::provenance::Provenance;
use mms_exact::{Input, units};
use mms_files::write::{pretty, write_files};
use mms_spec::foreign::Foreign;

use crate::shown::Shown;
use crate::table::TextTable;
use crate::text::next;

/// The number of hypotheses that a text shows.
const SHOWN: usize = 5;

/// A diagnosis of results of a field.
pub struct Diagnosed<'a> {
    /// The field.
    pub input: &'a Input,
    /// The files.
    pub files: &'a [String],
    /// The diagnosis.
    pub diagnosis: &'a Diagnosis,
    /// A question about a parameter of the field, if results fit another value much better.
    pub question: Option<String>,
    /// The words of the command to type next, if something is wrong.
    pub next: Option<Vec<String>>,
    /// The provenance.
    pub provenance: Provenance,
}

impl Diagnosed<'_> {
    /// Writes diagnosis.json into a folder, and returns its path.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, folder: &Path) -> anyhow::Result<String> {
        let written = write_files(folder, "diagnosis", [("json", pretty(&self.document())?)])?;
        Ok(written.join(", "))
    }

    /// The text.
    fn all(&self, is_full: bool) -> String {
        let it = self.diagnosis;
        let mut parts =
            vec![format!("{}: {}", self.input.name.shown(), it.rung.says()), self.finding()];
        parts.extend(self.question.clone());
        parts.push(format!(
            "the error is {:.2e} of the solution; {}",
            it.error,
            ordinary(it.expected)
        ));
        parts.extend(it.falls.as_ref().map(|falls| order(falls, it.of_order.as_ref())));
        if it.finding != DiagnosisFinding::Nothing {
            parts.push(self.table().to_string());
        }
        parts.extend(it.pair.as_ref().map(|pair| {
            let [a, b] = &pair.hypotheses;
            format!("two at once? {a} and {b} together explain {:.1} %", 100.0 * pair.explained)
        }));
        parts.extend(it.like.as_ref().map(alike));
        if it.finding == DiagnosisFinding::Unexplained {
            parts.extend(it.place.as_ref().map(|at| place(at, it.falls.is_none())));
        }
        let unseen = &it.cannot_be_seen;
        parts.extend((!unseen.is_empty()).then(|| match is_full {
            true => format!("these results cannot show: {}", unseen.join(", ")),
            false => {
                format!("these results cannot show {} other mistakes (--verbose)", unseen.len())
            }
        }));
        parts.push(format!("to do: {}", it.rung.next(it.finding)));
        parts.extend(next(self.next.as_ref()));
        parts.join("\n\n")
    }

    fn finding(&self) -> String {
        let it = self.diagnosis;
        match (it.finding, it.ranked.first()) {
            (DiagnosisFinding::Nothing, _) => {
                "nothing: the error is of the size that a right solver makes".into()
            }
            (DiagnosisFinding::Named, Some(best)) => named(best),
            _ if it.falls.as_ref().is_some_and(|it| !it.is_right) => {
                "unexplained: the error does not fall as expected, and no hypothesis explains enough of it".into()
            }
            _ => "unexplained: there is an error, and no hypothesis explains enough of it".into(),
        }
    }

    fn table(&self) -> TextTable {
        let header = ["hypothesis", "factor", "explains", ""];
        let mut table = TextTable::new(format!("diagnosis of {}", self.input.name.shown()), header);
        for it in self.diagnosis.ranked.iter().take(SHOWN) {
            let factor: Vec<String> =
                it.factor.iter().map(|factor| format!("{factor:.4}")).collect();
            let note = if it.is_plausible { "" } else { "of an impossible size" };
            let explained = format!("{:.1} %", 100.0 * it.explained);
            table.add_row([it.title(), factor.join(", "), explained, note.into()]);
        }
        table
    }
}

impl Shown for Diagnosed<'_> {
    type Document = documents::Diagnose;

    fn text(&self) -> String {
        self.all(false)
    }

    fn full_text(&self) -> String {
        self.all(true)
    }

    fn tables(&self) -> Vec<TextTable> {
        vec![self.table()]
    }

    fn document(&self) -> documents::Diagnose {
        let it = self.diagnosis;
        documents::Diagnose {
            field: self.input.name.raw().to_owned(),
            files: self.files.to_vec(),
            evidence: it.rung.says().to_owned(),
            finding: it.finding.name().to_owned(),
            error: it.error,
            least_expected_error: it.expected[0],
            expected_error: it.expected[1],
            order: it.falls.as_ref().map(|falls| error_order(falls, it.of_order.as_ref())),
            ranked: it.ranked.iter().map(hypothesis).collect(),
            cannot_be_seen: it.cannot_be_seen.iter().map(ToString::to_string).collect(),
            pair: it.pair.as_ref().map(|it| documents::Pair {
                hypotheses: it.hypotheses.iter().map(ToString::to_string).collect(),
                explained: it.explained,
            }),
            like: it.like.as_ref().map(|it| documents::Like {
                method: it.method.to_string(),
                factor: it.factor,
                apart: it.apart,
            }),
            place: it.place.as_ref().map(place_document),
            units: it.fields.as_ref().and_then(|it| units(&self.input.compiled, [it.quantity])),
            fields: it.fields.as_ref().map(fields),
            question: self.question.clone(),
            next: it.rung.next(it.finding).to_string(),
            next_command: self.next.clone(),
            provenance: self.provenance.clone(),
        }
    }
}

/// The sentence about the errors of right solvers.
fn ordinary([least, most]: [f64; 2]) -> String {
    match least == most {
        true => format!("a right solver would be at about {most:.1e}"),
        false => {
            format!(
                "right methods make {least:.1e} or more on such a grid, and up to {most:.1e} counts as right"
            )
        }
    }
}

/// The decrease of the error from mesh to mesh, and where to look.
fn order(it: &Falls, of_order: Option<&OfOrder>) -> String {
    let observed = it.observed.map_or("no order".into(), |order| format!("order {order:.2}"));
    let mut lines = vec![format!(
        "from mesh to mesh {} {} falls with {observed}, {} expected: {} (`mms judge`)",
        it.quantity, it.norm, it.expected, it.verdict
    )];
    lines.extend(it.hint().map(String::from));
    lines.extend(of_order.map(|own| {
        format!(
            "if your method has that order, `--like {}` compares with it: this right method has order {:.2} here",
            own.method, own.order
        )
    }));
    lines.join("\n")
}

/// The sentence about the named mistake.
fn named(best: &Ranked) -> String {
    let mut lines =
        vec![format!("named: {} ({})", best.title(), best.kind.name()), best.says.clone()];
    if !best.equivalent_always.is_empty() {
        lines
            .push(format!("the same formula for any field: {}", best.equivalent_always.join(", ")));
    }
    if !best.equivalent_here.is_empty() {
        lines.push(format!("not distinguished here: {}", best.equivalent_here.join(", ")));
    }
    if !best.needs.is_empty() {
        lines.push(format!("to distinguish them: {}", best.needs.join("; ")));
    }
    lines.join("\n")
}

/// The right method with a similar error.
fn alike(it: &Like) -> String {
    format!(
        "like {}: the error is {:.2} times the error of this right method on such a grid, {:.0} % apart",
        it.method,
        it.factor,
        100.0 * it.apart
    )
}

/// The place of an unexplained error, and its order if no other line has it.
fn place(it: &ErrorPlace, has_order: bool) -> String {
    let at: Vec<String> = it.at.iter().map(|x| format!("{x:.4}")).collect();
    let mut lines = vec![format!("it is largest at X = [{}], t = {:.4e}", at.join(", "), it.time)];
    if let Some(face) = it.face {
        lines.push(format!("more than half of it is beside the face {face}"));
    }
    if let Some((axis, at)) = it.plane {
        let axis = AXES[axis];
        lines.push(format!(
            "more than half of it is beside the plane {axis} = {at:.4}, which is no face: is it a border between parts of \
             the mesh, or between ranks?"
        ));
    }
    if let Some(order) = it.order.filter(|_| has_order) {
        lines.push(format!("from mesh to mesh it falls with order {order:.2}"));
    }
    if it.smooth < SMOOTH {
        lines.push(format!(
            "{:.0} % of it is not smooth: particles that cross cells, iterations that stop early (not_converged), or \
             single_precision",
            100.0 * (1.0 - it.smooth)
        ));
    }
    lines.join("\n")
}

/// The names of the axes of X.
const AXES: [&str; 3] = ["X", "Y", "Z"];
/// An error with a smaller smooth part than this is called noise.
const SMOOTH: f64 = 0.5;

fn fields(it: &Fields) -> documents::ErrorFields {
    documents::ErrorFields {
        quantity: it.quantity.to_string(),
        time: it.time,
        points: it.points.clone(),
        error: it.error.clone(),
        named: it.named.clone(),
    }
}

fn error_order(it: &Falls, of_order: Option<&OfOrder>) -> documents::ErrorOrder {
    documents::ErrorOrder {
        quantity: it.quantity.to_string(),
        norm: it.norm.to_string(),
        observed_order: it.observed,
        expected_order: it.expected,
        verdict: it.verdict.to_string(),
        says: it.hint().map(|hint| hint.to_string()),
        like: of_order.map(|own| documents::MethodOfOrder {
            method: own.method.to_string(),
            order: own.order,
        }),
    }
}

fn place_document(it: &ErrorPlace) -> documents::Place {
    documents::Place {
        at: it.at.clone(),
        time: it.time,
        face: it.face.map(|face| face.to_string()),
        plane: it.plane.map(|(axis, at)| documents::Plane { axis: AXES[axis].to_owned(), at }),
        order: it.order,
        smooth: it.smooth,
    }
}

fn hypothesis(it: &Ranked) -> documents::Hypothesis {
    let texts = |all: &[String]| all.to_vec();
    let factor = it.factor.first().copied().filter(|_| it.factor.len() == 1);
    documents::Hypothesis {
        hypothesis: it.name.to_string(),
        says: it.says.to_string(),
        kind: it.kind.name().to_owned(),
        factor,
        interval: factor.map(|factor| [factor - it.margin, factor + it.margin]),
        vector: (it.factor.len() > 1).then(|| it.factor.clone()),
        explained: it.explained,
        plausible: it.is_plausible,
        face: it.face.map(|face| face.to_string()),
        which: it.which.as_ref().map(ToString::to_string),
        equivalent_always: texts(&it.equivalent_always),
        equivalent_here: texts(&it.equivalent_here),
        needs: texts(&it.needs),
    }
}

/// The hypotheses about a field.
pub struct Hypotheses<'a> {
    /// The field.
    pub field: &'a Foreign,
    /// All of them.
    pub all: Vec<Listed>,
}

impl Hypotheses<'_> {
    fn table(&self) -> TextTable {
        let header = ["hypothesis", "changes", "kind", "shown by", "what it is"];
        let mut table = TextTable::new(format!("hypotheses about {}", self.field.shown()), header);
        for it in &self.all {
            let title = it.size_of.map_or(it.title.clone(), |_| format!("  {}", it.title));
            table.add_row([&title, it.changes, it.kind.name(), it.shown_by, &it.says]);
        }
        table
    }
}

impl Shown for Hypotheses<'_> {
    type Document = documents::Hypotheses;

    fn text(&self) -> String {
        self.table().to_string()
    }

    fn tables(&self) -> Vec<TextTable> {
        vec![self.table()]
    }

    fn document(&self) -> documents::Hypotheses {
        let each = self.all.iter().map(|it| documents::ListedHypothesis {
            hypothesis: it.title.clone(),
            changes: it.changes.to_owned(),
            kind: it.kind.name().to_owned(),
            shown_by: it.shown_by.to_owned(),
            says: it.says.to_string(),
            of: it
                .size_of
                .map(|(name, factor)| documents::SizeOf { hypothesis: name.to_owned(), factor }),
        });
        documents::Hypotheses { field: self.field.raw().to_owned(), hypotheses: each.collect() }
    }
}
