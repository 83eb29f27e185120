//! `mms check`: every mistake of a file, and every claim it makes.

mod meaning;
mod mistaken;
mod proof;
pub mod stability;

use std::sync::Arc;

use clap::Args;
use mms_codegen::Compiled;
use mms_codegen::certify::certificate::certify;
use mms_codegen::certify::closed_form::{Comparison, Difference, Finding, compare};
use mms_codegen::certify::ellipticity::Ellipticity;
use mms_codegen::certify::rest;
use mms_codegen::certify::rest::Rest;
use mms_codegen::certify::written;
use mms_codegen::certify::written::{Gap, gaps};
use mms_codegen::compile::Failure;
use mms_codegen::selection::{Entry, Freeze, Selection};
use mms_diagnosis::answer::Ranked;
use mms_documents::check::{self as documents, CheckedFile, ClosedForm, UndefinedComponent};
use mms_exact::settings;
use mms_files::shell::command;
use mms_options::field::{Variant, open};
use mms_spec::diagnostic::{Diagnostic, render_styled};
use mms_spec::foreign::{Foreign, shown};
use mms_spec::source::Sources;
use mms_stability::judge;
use mms_stability::solve::solve;
use mms_stability::warnings::warnings;

use super::{Outcome, next, print, print_json, say, say_styled};

/// Check field files: mistakes, boundary claims, J > 0, and closed forms.
///
/// What holds over the whole body, time window and parameter ranges is proved: symbolically, or with
/// intervals. A claim is `proved`; `enclosed`, where all that is certain is that it is within
/// 1e-12 of what it should be, relative to the size of the body or the modulus; `refuted` at a point
/// that is named; or `unproved`. The last two exit 1, as do J <= 0, a function that ends or jumps within the domain, a
/// quantity without a finite value or that f64 does not compute as one, and a closed form that differs or was compared
/// nowhere. What takes more steps than a budget allows is said not to be proved. What f32 computes is a line of its own. A
/// stress at rest (P not 0 at F = I) is a warning. Bounds are given of J, the principal stretch, the strain rate, the wave
/// speed, and the time step that waves allow, of x, and of the digits that sums such as X + c*t leave of angles.
///
/// Whether a solver can follow the motion is looked at on a sample, for the defaults of the parameters: waves in the body
/// (acoustic tensor), waves on faces that are loaded, free or on rollers (surface impedance, loads dead), their corners
/// (coercivity of the second variation in a quadrant), and long waves
/// (least eigenvalue on a coarse mesh). What grows is a warning, and does not change the exit code.
#[derive(Args)]
pub struct Check {
    /// Field files, or names of fields of the gallery.
    #[arg(value_name = "FIELD", required = true)]
    files: Vec<String>,
    /// Fix a parameter at a value: a number, or a formula in the parameters above it. What holds is then proved for it
    /// alone, not for the parameter's range; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Run Newton's method on static fields, on a coarse mesh: does it stay at the exact state, and come to it from zero?
    #[arg(long)]
    solve: bool,
    #[command(flatten)]
    variant: Variant,
    /// Say below the lines what each of them means.
    #[arg(long)]
    explain: bool,
    /// Print a line for each face and each corner; --json has them as well.
    #[arg(long)]
    verbose: bool,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

impl Check {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let options = self.variant.options(self.selection()?);
        let mut worst = Outcome::AsExpected;
        let mut documents = Vec::new();
        for file in &self.files {
            let path = Foreign::from(file.as_str());
            let (outcome, document) = match open(file).map(|source| source.compile(&options)) {
                Ok(Ok(compiled)) => self.report(&path, &Arc::new(compiled))?,
                Ok(Err(mut failure)) => {
                    // What is frozen here is what is set, and its mistakes are said of that.
                    let entry = |it: &Diagnostic| options.selection.entry(it.span);
                    failure.diagnostics.retain(|it| !matches!(entry(it), Some(Entry::Freeze(_))));
                    self.report_failure(&path, &failure)?
                }
                Err(error) => self.report_unreadable(&path, &error),
            };
            documents.push(document);
            worst = match (worst, outcome) {
                (Outcome::BadInput, _) | (_, Outcome::AsExpected) => worst,
                _ => outcome,
            };
        }
        if self.json {
            print_json(&documents::Check { files: documents })?;
        }
        Ok(worst)
    }

    /// All of the field, with what is set as constants.
    fn selection(&self) -> anyhow::Result<Selection> {
        let set = settings(&self.set)?;
        let freeze = match set.is_empty() {
            true => Freeze::Nothing,
            false => Freeze::Only(set.iter().map(|(name, _)| name.clone()).collect()),
        };
        Ok(Selection { set, freeze, ..Selection::default() })
    }

    fn report_unreadable(&self, path: &Foreign, error: &anyhow::Error) -> (Outcome, CheckedFile) {
        if !self.json {
            say(format_args!("error: {error:#}"));
        }
        let diagnostic = documents::Diagnostic {
            path: path.raw().to_owned(),
            line: None,
            column: None,
            message: format!("{error:#}"),
            label: None,
            help: None,
        };
        (Outcome::BadInput, mistaken_file(path, vec![diagnostic]))
    }

    fn report_failure(
        &self,
        path: &Foreign,
        failure: &Failure,
    ) -> anyhow::Result<(Outcome, CheckedFile)> {
        if !self.json {
            say_styled(&failure.styled());
            print(&format!("{}: {} mistake(s)", path.shown(), failure.diagnostics.len()))?;
        }
        let diagnostics = failure.diagnostics.iter().map(|it| located(&failure.sources, it));
        Ok((Outcome::BadInput, mistaken_file(path, diagnostics.collect())))
    }

    fn report(
        &self,
        path: &Foreign,
        compiled: &Arc<Compiled>,
    ) -> anyhow::Result<(Outcome, CheckedFile)> {
        let comparisons = compare(compiled);
        let named = mistaken::named(compiled, &comparisons);
        if compiled.field.domain.body.is_nothing() {
            return self.report_numbers(path, compiled, (&comparisons, &named));
        }
        let agrees = |comparison: &Comparison| matches!(comparison.finding, Finding::Agrees);
        let gaps = gaps(compiled);
        let mut certificate = certify(compiled);
        let rest = rest::stress(compiled);
        certificate.spent.extend(unseen(compiled, &rest));
        let objections = certificate.objections(compiled);
        // What was looked at nowhere passes for nothing.
        let stability = judge(compiled);
        certificate
            .spent
            .extend(stability.is_spent.then(|| "what grows on the motion".to_string()));
        let lost = match &certificate.ellipticity {
            Ellipticity::Lost(softening) => Some(softening),
            Ellipticity::Strong(_) | Ellipticity::Unproved => None,
        };
        let warnings = warnings(compiled, &stability, lost);
        let solved = self.solve.then(|| solve(compiled));
        let is_seen = written::points(compiled) > 0 && comparisons.iter().all(agrees);
        let refuted = !objections.is_empty() || !gaps.is_empty() || !is_seen;
        let next = (refuted && !self.explain).then(|| {
            let options = [next::each("set", &self.set), self.variant.arguments()].concat();
            next::command(
                ["check", path.raw(), "--explain"].map(str::to_owned).into_iter().chain(options),
            )
        });
        if !self.json {
            let others = rest.warning(compiled).into_iter().chain(warnings.iter().cloned());
            let all: Vec<_> = objections.iter().cloned().chain(others).collect();
            if !all.is_empty() {
                say_styled(&render_styled(&compiled.sources, &all));
            }
            let mut proofs = proof::text(compiled, &certificate);
            proofs.extend(rest_line(&rest));
            let is_static = compiled.model.domain.is_static;
            let of = (compiled.field.space, is_static);
            proofs.extend(stability::text(&stability, &certificate, of, self.verbose));
            proofs.extend(solved.map(|solved| format!("  solve  {}", solved.words())));
            let mut text = text(path, compiled, proofs, &gaps, (&comparisons, &named));
            if self.explain {
                text += &meaning::of(&text);
            }
            text.extend(next.as_ref().map(|next| format!("\nnext: {}", command(&next[1..]))));
            print(&text)?;
        }
        let checks = comparisons
            .iter()
            .zip(&named)
            .map(|(it, named)| comparison_document(it, named.as_ref()));
        let outcome = if refuted { Outcome::Refuted } else { Outcome::AsExpected };
        let material = stability.material.as_ref();
        let objections = objections.iter().map(|it| located(&compiled.sources, it));
        let document = CheckedFile {
            file: path.raw().to_owned(),
            diagnostics: None,
            claims: Some(certificate.claims.iter().map(proof::claim).collect()),
            certificate: Some(Some(proof::document(&certificate))),
            objections: Some(objections.collect()),
            checks: Some(checks.collect()),
            undefined: Some(gaps.iter().map(|gap| gap_document(compiled, gap)).collect()),
            rest_stress: Some(rest.stress().map(<[f64]>::to_vec)),
            moduli_at_rest: Some(stability::moduli(material)),
            transverse_moduli_at_rest: Some(stability::transverse(material)),
            stability: Some(stability::document(&stability, &warnings, solved)),
            extent: Some(certificate.reach.clone()),
            shortest_wavelength: Some(stability.shortest_wavelength),
            budget_spent: Some(certificate.spent.iter().map(ToString::to_string).collect()),
            simplified: Some(compiled.simplified),
            next_command: next,
        };
        Ok((outcome, document))
    }
}

/// A file with mistakes.
fn mistaken_file(path: &Foreign, diagnostics: Vec<documents::Diagnostic>) -> CheckedFile {
    CheckedFile {
        file: path.raw().to_owned(),
        diagnostics: Some(diagnostics),
        ..CheckedFile::default()
    }
}

impl Check {
    /// Reports the closed forms of a field without a body, at points of the unit cube. There is nothing to prove.
    fn report_numbers(
        &self,
        path: &Foreign,
        compiled: &Compiled,
        (comparisons, named): (&[Comparison], &[Option<Ranked>]),
    ) -> anyhow::Result<(Outcome, CheckedFile)> {
        if !self.json {
            let line = "  proof  NONE: numbers without claims, for [domain] has no body (`shape = \"none\"`)";
            print(&text(path, compiled, vec![line.into()], &[], (comparisons, named)))?;
        }
        let agrees = |comparison: &Comparison| matches!(comparison.finding, Finding::Agrees);
        let outcome = match comparisons.iter().all(agrees) {
            true => Outcome::AsExpected,
            false => Outcome::Refuted,
        };
        let checks = comparisons.iter().zip(named);
        let checks = checks.map(|(it, named)| comparison_document(it, named.as_ref()));
        let document = CheckedFile {
            file: path.raw().to_owned(),
            claims: Some(Vec::new()),
            certificate: Some(None),
            objections: Some(Vec::new()),
            checks: Some(checks.collect()),
            simplified: Some(compiled.simplified),
            ..CheckedFile::default()
        };
        Ok((outcome, document))
    }
}

/// The other checks that were skipped, or made at fewer points, because they take too long.
fn unseen(compiled: &Compiled, rest: &Rest) -> Vec<String> {
    let mut unseen = Vec::new();
    if written::points(compiled) < written::POINTS {
        unseen.push("u as it is written".to_string());
    }
    if *rest == Rest::Unknown {
        unseen.push("stress at rest".into());
    }
    if !compiled.simplified {
        unseen.push("the search for short and exact formulas".into());
    }
    unseen
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

fn located(sources: &Sources, diagnostic: &Diagnostic) -> documents::Diagnostic {
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

/// Where u has no value, and what is to blame.
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

fn comparison_document(comparison: &Comparison, named: Option<&Ranked>) -> ClosedForm {
    let (status, found, undefined) = match &comparison.finding {
        Finding::Agrees => ("passed", None, 0),
        Finding::Differs(found) => ("failed", Some(found), 0),
        Finding::Undefined { points, first } => ("undefined", Some(first), *points),
        Finding::Unmeasured => ("unmeasured", None, 0),
    };
    let finite = |number: f64| number.is_finite().then_some(number);
    let difference = found.map(|found| documents::Difference {
        at: found.coordinates.clone(),
        time: found.time,
        component: found.component,
        derived: finite(found.derived),
        expected: finite(found.expected),
    });
    ClosedForm {
        quantity: comparison.quantity.name().to_owned(),
        source: comparison.source.as_ref().map(|it| it.raw().to_owned()),
        points: comparison.points,
        status: status.to_owned(),
        undefined_points: undefined,
        difference,
        acts_as: named.map(mistaken::document),
    }
}

fn text(
    path: &Foreign,
    compiled: &Compiled,
    proofs: Vec<String>,
    gaps: &[Gap],
    (comparisons, named): (&[Comparison], &[Option<Ranked>]),
) -> String {
    let mut lines = vec![format!("{}: {}", path.shown(), compiled.field.title.shown())];
    lines.extend(proofs);
    for gap in gaps {
        let (at, time) = &gap.first;
        let what = match gap.component {
            Some(component) => format!("component {}", component + 1),
            None => "the rigid motion".into(),
        };
        lines.push(format!(
            "  u      {what} is UNDEFINED as written at {} of {} points",
            gap.points,
            written::POINTS,
        ));
        lines.push(format!(
            "    {}: `{}` has no value at X = {at:?}, t = {time:e}: shrink [domain], or write it in another form",
            compiled.sources.place(gap.span),
            shown(compiled.sources.slice(gap.span)),
        ));
    }
    for (comparison, named) in comparisons.iter().zip(named) {
        let quantity = comparison.quantity.name();
        let source = comparison.source.as_ref().map(Foreign::shown);
        let source = source.as_deref().unwrap_or("no source given");
        match &comparison.finding {
            Finding::Agrees => lines.push(format!(
                "  check  {quantity} agrees to 1e-20 at {} points ({source})",
                comparison.points
            )),
            Finding::Unmeasured => lines.push(format!(
                "  check  {quantity} was NOT COMPARED: one value takes too long in 77 digits ({source})"
            )),
            Finding::Differs(found) => {
                lines.push(format!("  check  {quantity} FAILED ({source})"));
                lines.push(describe(compiled, comparison, found));
                lines.extend(named.as_ref().map(mistaken::says));
            }
            Finding::Undefined { points, first } => {
                lines.push(format!(
                    "  check  {quantity} is UNDEFINED at {points} of {} points ({source})",
                    comparison.points
                ));
                lines.push(describe(compiled, comparison, first));
                lines.push("    a division by 0, a root or logarithm of a negative number, or beyond all bounds: shrink [domain], or rewrite what has no value there".into());
            }
        }
    }
    lines.join("\n")
}

fn describe(compiled: &Compiled, comparison: &Comparison, found: &Difference) -> String {
    let place = compiled.sources.place(comparison.span);
    let value = |value: f64| match value.is_nan() {
        true => "undefined".to_string(),
        false => format!("{value:e}"),
    };
    let apart = match found.derived == found.expected {
        true => ", which differ behind the 16th digit",
        false => "",
    };
    format!(
        "    {place}: component {} at X = {:?}, t = {:e}: derived {}, closed form {}{apart}",
        found.component + 1,
        found.coordinates,
        found.time,
        value(found.derived),
        value(found.expected)
    )
}
