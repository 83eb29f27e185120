//! The report on a field: its claims, proofs, stability and closed forms, as lines and as a document.
//!
//! [`check`] makes the report on a compiled field. Nothing here reads a file or prints.

mod closed_form;
pub mod meaning;
mod mistaken;
mod proof;
pub mod stability;

use std::sync::Arc;

use mms_codegen::Compiled;
use mms_codegen::certify::certificate::certify;
use mms_codegen::certify::closed_form::compare;
use mms_codegen::certify::ellipticity::Ellipticity;
use mms_codegen::certify::rest::{self, Rest};
use mms_codegen::certify::undefined::{self, Gap, gaps};
use mms_codegen::compile::Failure;
use mms_documents::check::{self as documents, CheckedFile, UndefinedComponent};
use mms_spec::diagnostic::Diagnostic;
use mms_spec::foreign::{Foreign, shown};
use mms_spec::quantity::Quantity;
use mms_spec::source::Sources;
use mms_stability::judge;
use mms_stability::solve::solve;
use mms_stability::warnings::warnings;

use self::closed_form::Compared;

/// The options of a check.
#[derive(Clone, Copy, Debug, Default)]
pub struct CheckOptions {
    /// Run Newton's method on a static field.
    pub solve: bool,
    /// Write a line for each face and each corner.
    pub is_verbose: bool,
}

/// The report on a field that compiles.
pub struct Report {
    /// Claims that do not hold, with their places.
    pub objections: Vec<Diagnostic>,
    /// Warnings, with their places: a stress at rest, disturbances that grow.
    pub warnings: Vec<Diagnostic>,
    /// The lines for people; the first has the title.
    pub lines: Vec<String>,
    /// The document. Its `next_command` is null; the command fills it in.
    pub document: CheckedFile,
    /// Whether every claim and closed form holds.
    pub passes: bool,
}

/// Checks a compiled field. `path` names its file in the report.
pub fn check(path: &Foreign, compiled: &Arc<Compiled>, options: CheckOptions) -> Report {
    let compared = Compared::of(compiled, compare(compiled));
    let title = format!("{}: {}", path.shown(), compiled.field.title.shown());
    if compiled.field.domain.body.is_nothing() {
        return numbers(path, compiled, title, &compared);
    }
    let gaps = gaps(compiled);
    let mut certificate = certify(compiled);
    let rest = rest::stress(compiled);
    certificate.spent.extend(skipped_checks(compiled, &rest));
    let objections = certificate.objections(compiled);
    let stability = judge(compiled);
    certificate.spent.extend(stability.is_spent.then(|| "what grows on the motion".to_string()));
    let lost = match &certificate.ellipticity {
        Ellipticity::Lost(softening) => Some(softening),
        Ellipticity::Strong(_) | Ellipticity::Unproved => None,
    };
    let growing = warnings(compiled, &stability, lost);
    let solved = options.solve.then(|| solve(compiled));
    // If u is evaluated at no point, the check does not pass.
    let is_seen = undefined::points(compiled) > 0 && compared.all_agree();

    let notes = doubly_named(compiled);
    let mut lines = vec![title];
    lines.extend(proof::text(compiled, &certificate));
    lines.extend(name_lines(&notes));
    lines.extend(rest_line(&rest));
    let of = (compiled.field.space, compiled.model.domain.is_static);
    lines.extend(stability::text(&stability, &certificate, of, options.is_verbose));
    lines.extend(solved.map(|solved| format!("  solve  {}", solved.words())));
    lines.extend(gaps.iter().flat_map(|gap| gap_lines(compiled, gap)));
    lines.extend(compared.lines(compiled));

    let material = stability.material.as_ref();
    let located_objections = objections.iter().map(|it| located(&compiled.sources, it));
    let document = CheckedFile {
        file: path.raw().to_owned(),
        diagnostics: None,
        notes,
        claims: Some(certificate.claims.iter().map(proof::claim).collect()),
        certificate: Some(Some(proof::document(&certificate))),
        objections: Some(located_objections.collect()),
        checks: Some(compared.documents()),
        undefined: Some(gaps.iter().map(|gap| gap_document(compiled, gap)).collect()),
        rest_stress: Some(rest.stress().map(<[f64]>::to_vec)),
        moduli_at_rest: Some(stability::moduli(material)),
        transverse_moduli_at_rest: Some(stability::transverse(material)),
        stability: Some(stability::document(&stability, &growing, solved)),
        extent: Some(certificate.reach.clone()),
        shortest_wavelength: Some(stability.shortest_wavelength),
        budget_spent: Some(certificate.spent.iter().map(ToString::to_string).collect()),
        simplified: Some(compiled.simplified),
        next_command: None,
    };
    let passes = objections.is_empty() && gaps.is_empty() && is_seen;
    let warnings = rest.warning(compiled).into_iter().chain(growing).collect();
    Report { objections, warnings, lines, document, passes }
}

/// The report on a field without a body: its closed forms, at points of the unit cube. It has no proofs.
fn numbers(path: &Foreign, compiled: &Compiled, title: String, compared: &Compared) -> Report {
    let none =
        "  proof  NONE: numbers without claims, since [domain] has no body (`shape = \"none\"`)";
    let notes = doubly_named(compiled);
    let mut lines = vec![title, none.into()];
    lines.extend(name_lines(&notes));
    lines.extend(compared.lines(compiled));
    let document = CheckedFile {
        file: path.raw().to_owned(),
        notes,
        claims: Some(Vec::new()),
        certificate: Some(None),
        objections: Some(Vec::new()),
        checks: Some(compared.documents()),
        simplified: Some(compiled.simplified),
        ..CheckedFile::default()
    };
    let passes = compared.all_agree();
    Report { objections: Vec::new(), warnings: Vec::new(), lines, document, passes }
}

/// The document of a file that does not compile.
pub fn mistaken(path: &Foreign, failure: &Failure) -> CheckedFile {
    let diagnostics = failure.diagnostics.iter().map(|it| located(&failure.sources, it));
    with_mistakes(path, diagnostics.collect())
}

/// The document of a file that cannot be read.
pub fn unreadable(path: &Foreign, message: String) -> CheckedFile {
    let diagnostic = documents::Diagnostic {
        path: path.raw().to_owned(),
        line: None,
        column: None,
        message,
        label: None,
        help: None,
    };
    with_mistakes(path, vec![diagnostic])
}

fn with_mistakes(path: &Foreign, diagnostics: Vec<documents::Diagnostic>) -> CheckedFile {
    CheckedFile {
        file: path.raw().to_owned(),
        diagnostics: Some(diagnostics),
        ..CheckedFile::default()
    }
}

/// The parameters whose names are also names of quantities, each in a sentence.
fn doubly_named(compiled: &Compiled) -> Vec<String> {
    let parameters = compiled.model.parameters.iter();
    let note = |name: &str| {
        let is_it = |it: &Quantity| it.symbol() == name || Some(*it) == Quantity::from_name(name);
        let quantity = Quantity::evaluated().find(is_it)?.name();
        Some(format!(
            "`{name}` is the parameter for `--set`, and the quantity `{quantity}` for `--quantity`: a longer name, with symbol = \"{name}\", \
             tells them apart"
        ))
    };
    parameters.filter_map(|it| note(&it.name)).collect()
}

fn name_lines(notes: &[String]) -> impl Iterator<Item = String> {
    notes.iter().map(|note| format!("  name   {note}"))
}

/// The parts of the report, beside the proofs, that were skipped or reduced because they take too long.
fn skipped_checks(compiled: &Compiled, rest: &Rest) -> Vec<String> {
    let mut skipped = Vec::new();
    if undefined::points(compiled) < undefined::POINTS {
        skipped.push("u as it is written".to_string());
    }
    if *rest == Rest::Unknown {
        skipped.push("stress at rest".into());
    }
    if !compiled.simplified {
        skipped.push("the search for short and exact formulas".into());
    }
    skipped
}

/// The line about P at F = I, if P is not 0.
fn rest_line(rest: &Rest) -> Option<String> {
    if let Rest::Pressed(stress, names) = rest {
        let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
        return Some(format!(
            "  rest   P is {:e} I at F = I, a pressure that the given {} balances",
            stress[0],
            names.join(", ")
        ));
    }
    let components: Vec<_> = rest.stress()?.iter().map(|it| format!("{it:e}")).collect();
    Some(format!("  rest   stress at rest: P is [{}] at F = I, not 0", components.join(", ")))
}

/// A diagnostic with its place.
pub fn located(sources: &Sources, diagnostic: &Diagnostic) -> documents::Diagnostic {
    let (line, column) = sources.location(diagnostic.span);
    documents::Diagnostic {
        path: sources.get(diagnostic.span.source).path.raw().to_owned(),
        line: Some(line),
        column: Some(column),
        message: diagnostic.message.to_string(),
        label: Some(diagnostic.label.to_string()),
        help: Some(diagnostic.help.iter().map(ToString::to_string).collect()),
    }
}

/// The lines about a component of u whose formula, as the file writes it, has no value at some points.
fn gap_lines(compiled: &Compiled, gap: &Gap) -> [String; 2] {
    let (at, time) = &gap.first;
    let what = match gap.component {
        Some(component) => format!("component {}", component + 1),
        None => "the rigid motion".into(),
    };
    [
        format!(
            "  u      {what} is UNDEFINED as written at {} of {} points",
            gap.points,
            undefined::POINTS,
        ),
        format!(
            "    {}: `{}` has no value at X = {at:?}, t = {time:e}: shrink [domain], or write it in another form",
            compiled.sources.place(gap.span),
            shown(compiled.sources.slice(gap.span)),
        ),
    ]
}

/// The place where u has no value, and the function that causes it.
fn gap_document(compiled: &Compiled, gap: &Gap) -> UndefinedComponent {
    let (line, column) = compiled.sources.location(gap.span);
    UndefinedComponent {
        component: gap.component.map(|component| component + 1),
        line,
        column,
        points: gap.points,
        at: gap.first.0.clone(),
        time: gap.first.1,
    }
}
