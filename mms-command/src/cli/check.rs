//! `mms check`: every mistake of a file, and every claim it makes.

use std::sync::Arc;

use clap::Args;
use mms_check::{Asked, meaning};
use mms_codegen::Compiled;
use mms_codegen::compile::Failure;
use mms_codegen::selection::{Entry, Freeze, Selection};
use mms_documents::check::{self as documents, CheckedFile};
use mms_exact::settings;
use mms_files::shell::command;
use mms_judge::next;
use mms_options::field::{Variant, open};
use mms_spec::diagnostic::{Diagnostic, render_styled};
use mms_spec::foreign::Foreign;

use super::{Outcome, print, print_json, say, say_styled};

/// Check field files: mistakes, boundary claims, J > 0, and closed forms.
///
/// Proofs cover the whole body, time window and parameter ranges; they are symbolic, or use intervals. A claim is `proved`;
/// `enclosed`, if it is only certain to hold within 1e-12, relative to the size of the body or the modulus; `refuted` at a
/// named point; or `unproved`. The last two exit 1, as do J <= 0, a function that ends or jumps within the domain, a quantity
/// without a finite value or that f64 does not compute as one, and a closed form that differs or was compared nowhere. A proof
/// that needs more steps than its budget is reported as not made. The numbers of f32 have a line of their own. A stress at rest
/// (P not 0 at F = I) is a warning. Bounds are given of J, the principal stretch, the strain rate, the wave speed, and the time
/// step that waves allow, of x, and of the digits that sums such as X + c*t leave of angles.
///
/// Whether a solver can follow the motion is looked at on a sample, for the defaults of the parameters: waves in the body
/// (acoustic tensor), waves on faces that are loaded, free or on rollers (surface impedance, loads dead), their corners
/// (coercivity of the second variation in a quadrant), and long waves
/// (least eigenvalue on a coarse mesh). A disturbance that grows is a warning, and does not change the exit code.
#[derive(Args)]
pub struct Check {
    /// Field files, or names of fields of the gallery.
    #[arg(value_name = "FIELD", required = true)]
    files: Vec<String>,
    /// Fix a parameter at a value: a number, or a formula in the parameters above it. Proofs then cover this value only, not
    /// the parameter's range; may be repeated.
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
                    // A parameter that is set is frozen here; its mistakes are reported for the setting.
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
        (Outcome::BadInput, mms_check::unreadable(path, format!("{error:#}")))
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
        Ok((Outcome::BadInput, mms_check::mistaken(path, failure)))
    }

    fn report(
        &self,
        path: &Foreign,
        compiled: &Arc<Compiled>,
    ) -> anyhow::Result<(Outcome, CheckedFile)> {
        let asked = Asked { solve: self.solve, is_verbose: self.verbose };
        let mut report = mms_check::check(path, compiled, asked);
        let has_body = !compiled.field.domain.body.is_nothing();
        let next = (!report.passes && has_body && !self.explain).then(|| {
            let options = [next::each("set", &self.set), self.variant.arguments()].concat();
            next::command(
                ["check", path.raw(), "--explain"].map(str::to_owned).into_iter().chain(options),
            )
        });
        if !self.json {
            let all: Vec<_> = report.objections.iter().chain(&report.warnings).cloned().collect();
            if !all.is_empty() {
                say_styled(&render_styled(&compiled.sources, &all));
            }
            let mut text = report.lines.join("\n");
            if self.explain && has_body {
                text += &meaning::of(&text);
            }
            text.extend(next.as_ref().map(|next| format!("\nnext: {}", command(&next[1..]))));
            print(&text)?;
        }
        report.document.next_command = next;
        let outcome = if report.passes { Outcome::AsExpected } else { Outcome::Refuted };
        Ok((outcome, report.document))
    }
}
