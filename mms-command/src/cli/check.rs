//! `mms check`: every mistake of a file, and every claim it makes.

use std::sync::Arc;

use clap::Args;
use mms_check::{CheckOptions, meaning};
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

use super::{CommandOutcome, print, print_json, say, say_styled};

/// Check field files: find mistakes, prove the boundary claims and J > 0, and compare closed forms with derived ones.
///
/// Proofs cover the whole body, the time window and the ranges of the parameters. They are symbolic, or use interval
/// arithmetic. A claim on a face is `proved`; `enclosed`: it holds within 1e-12 of the size of the body or of the modulus;
/// `refuted` at a named point; or `unproved`. A proof that needs more steps than its budget is reported as not made.
///
/// The exit code is 1 if a claim is refuted or unproved, if J <= 0, if a function ends or jumps within the domain, if a
/// quantity is not finite, exactly or as computed in f64, or if a closed form differs or could be compared nowhere. A
/// separate line says whether f32 computes finite values. A stress at rest (P not 0 at F = I) is a warning.
///
/// Lines with bounds give the principal stretch, the strain rate, the wave speed, the stable time step, x, and the number of
/// correct digits of angles in sums such as X + c*t.
///
/// Stability is tested on a sample of points and times, at the default parameters: waves in the body (acoustic tensor), waves
/// on faces that are loaded, free or on rollers (surface impedance, dead loads), corners of such faces (coercivity of the
/// second variation in a quadrant), and long waves (least eigenvalue on a coarse mesh). A solver cannot follow a motion in
/// which a disturbance grows: this is a warning, and does not change the exit code.
#[derive(Args)]
pub struct Check {
    /// Field files, or names of fields of the gallery.
    #[arg(value_name = "FIELD", required = true)]
    files: Vec<String>,
    /// Fix a parameter at a value: a number, or a formula in the parameters declared above it. Proofs then cover this value
    /// only, not the parameter's range. May be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// Run Newton's method for static fields on a coarse mesh: report whether it stays at the exact state, and whether it
    /// converges to this state from zero.
    #[arg(long)]
    solve: bool,
    #[command(flatten)]
    variant: Variant,
    /// Explain each kind of line below the report.
    #[arg(long)]
    explain: bool,
    /// Print a line for each face and each corner; --json always has them.
    #[arg(long)]
    verbose: bool,
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

impl Check {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let options = self.variant.options(self.selection()?);
        let mut worst = CommandOutcome::AsExpected;
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
                (CommandOutcome::BadInput, _) | (_, CommandOutcome::AsExpected) => worst,
                _ => outcome,
            };
        }
        if self.json {
            print_json(&documents::Check { files: documents })?;
        }
        Ok(worst)
    }

    /// The selection of the whole field, in which the parameters that are set are constants.
    fn selection(&self) -> anyhow::Result<Selection> {
        let set = settings(&self.set)?;
        let freeze = match set.is_empty() {
            true => Freeze::Nothing,
            false => Freeze::Only(set.iter().map(|(name, _)| name.clone()).collect()),
        };
        Ok(Selection { set, freeze, ..Selection::default() })
    }

    fn report_unreadable(
        &self,
        path: &Foreign,
        error: &anyhow::Error,
    ) -> (CommandOutcome, CheckedFile) {
        if !self.json {
            say(format_args!("error: {error:#}"));
        }
        (CommandOutcome::BadInput, mms_check::unreadable(path, format!("{error:#}")))
    }

    fn report_failure(
        &self,
        path: &Foreign,
        failure: &Failure,
    ) -> anyhow::Result<(CommandOutcome, CheckedFile)> {
        if !self.json {
            say_styled(&failure.styled());
            print(&format!("{}: {} mistake(s)", path.shown(), failure.diagnostics.len()))?;
        }
        Ok((CommandOutcome::BadInput, mms_check::mistaken(path, failure)))
    }

    fn report(
        &self,
        path: &Foreign,
        compiled: &Arc<Compiled>,
    ) -> anyhow::Result<(CommandOutcome, CheckedFile)> {
        let options = CheckOptions { solve: self.solve, is_verbose: self.verbose };
        let mut report = mms_check::check(path, compiled, options);
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
        let outcome =
            if report.passes { CommandOutcome::AsExpected } else { CommandOutcome::Refuted };
        Ok((outcome, report.document))
    }
}
