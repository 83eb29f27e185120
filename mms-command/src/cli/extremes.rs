//! `mms extremes`: the solver at its limits.

use std::path::PathBuf;

use anyhow::bail;
use clap::Args;
use mms_codegen::{Options, Selection};
use mms_exact::settings;
use mms_exact::wave::without_bound;
use mms_files::write::{pretty, write_files};
use mms_lab::extremes::rows::{ExtremeSetting, rows};
use mms_lab::extremes::stable;
use mms_lab::extremes::subject::Subject;
use mms_lab::extremes::theory::{LinearMaterial, courant};
use mms_lab::extremes::verdict::{Declared, RunResult, judge};
use mms_lab::rows::Named as _;
use mms_lab::tradeoff::setting::Setting;
use mms_options::field::Motion;
use mms_options::method::{Arithmetic, MethodOptions, Precision};
use mms_report::Shown as _;
use mms_report::extremes::{JudgedExtreme, Report, Stability};
use mms_runtime::scene::usual_cells;
use mms_runtime::study::Observer;
use mms_runtime::{Division, IntegratorName, Method, Transfer};
use mms_spec::suggest::advice;
use mms_spec::twin::Twin;

use super::format::Printing;
use super::{CommandOutcome, print, say, this_command, validate_output};
use crate::session::progress::Progress;

/// Run a field at the limits of the built-in solver: each run must meet its bound, or stop with the right diagnosis.
///
/// The limits are tiny and nearly inverted motions, nearly incompressible material, stiff and soft units, one cell and
/// millions, one particle per cell and a thousand, Courant numbers from 0.01 to above the stable one, a million steps, a body
/// far from the origin, and single precision. Bounds are relative to the error of the declared field with the method's
/// options. If a field cannot be put at a limit, the row says why. A row is `unresolved` if the grid is too coarse for a
/// nearly inverted material: a cell may then contain a thousand times as much material as at the start, and no bound exists for
/// its error.
///
/// Then the command computes the largest stable Courant number of each shape function, formulation, transfer and integrator
/// by bisection, and prints it beside the value from von Neumann's analysis of the interior.
#[derive(Args)]
pub struct Extremes {
    /// A name that `mms list` prints, or the path of a TOML file.
    field: String,
    /// Run fewer steps, and measure the stability of fewer methods.
    #[arg(long)]
    quick: bool,
    /// Run only this row, as in units/soft, or the rows of this group, as in units, or `stability`; may be repeated.
    #[arg(long, value_name = "NAME")]
    row: Vec<String>,
    #[command(flatten)]
    method: MethodOptions,
    /// Change the default of a parameter to a number, or to a formula in the parameters declared above it. May be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    motion: Motion,
    /// The folder to write extremes.json to, the document of `--json`.
    #[arg(long, short, value_name = "DIR")]
    output: Option<PathBuf>,
    #[command(flatten)]
    printing: Printing,
}

/// The name by which `--row` selects the measurement of stable Courant numbers, which follows the rows.
const STABILITY: &str = "stability";

impl Extremes {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let all = rows()?;
        let wanted = self.select(&all)?;
        self.output.as_deref().map_or(Ok(()), validate_output)?;
        let arithmetic = self.method.arithmetic;
        let declared = match Subject::new(&self.field, &self.options()?, None)? {
            Ok(declared) => declared,
            Err(reason) => bail!("{reason}"),
        };
        let dimension = declared.input.compiled.field.dimension;
        // `&[]`: the values of `--set` are already the defaults of the compiled field.
        let (mut method, note) = self.method.method_for(&declared.input, &[])?;
        note.iter().for_each(say);
        // A run that is too large for the solver is too large on any machine.
        method.setup.memory = None;
        let progress = Progress::new();
        let usual = Division::Uniform(usual_cells(dimension));
        let seen = declared.run(&method, usual, arithmetic.precision, &mut progress.of(usual))?;
        let declared_error = match seen {
            RunResult::Ended { l2, cell_size, least_jacobian, .. } if l2 > 0.0 => {
                Declared { l2, cell_size, least_jacobian }
            }
            RunResult::Ended { .. } => bail!(
                "the method makes no error on `{}`, so there is nothing to compare with: choose another one",
                declared.input.name.shown()
            ),
            RunResult::Stopped { reason, .. } | RunResult::LeftOut { reason } => {
                progress.finish();
                say(format_args!(
                    "error: `{}` does not run as declared: {reason}",
                    declared.input.name.shown()
                ));
                return Ok(CommandOutcome::RunFailed);
            }
        };
        let mut judged = Vec::new();
        for row in wanted {
            judged.push(self.judge(row, &method, declared_error, &progress)?);
        }
        let stability = match self.wants(STABILITY) {
            true => self.stability(&method, &progress)?,
            false => Vec::new(),
        };
        progress.finish();
        let report = Report {
            field: declared.input.name.clone(),
            title: declared.input.compiled.field.title.clone(),
            method,
            arithmetic,
            quick: self.quick,
            declared: declared_error,
            rows: judged,
            stability,
            provenance: this_command("extremes", declared.input.provenance(&self.set)),
        };
        self.printing.print(&report)?;
        if let Some(folder) = &self.output {
            let written = write_files(folder, "extremes", [("json", pretty(&report.document())?)])?;
            if self.printing.is_text() {
                print(&format!("\nwrote {}", written.join(", ")))?;
            }
        }
        let expected = report.unexpected().is_empty();
        Ok(if expected { CommandOutcome::AsExpected } else { CommandOutcome::Refuted })
    }

    /// The options with which the field is compiled: its variant, and the parameters that are set.
    fn options(&self) -> anyhow::Result<Options> {
        let selection = Selection { set: settings(&self.set)?, ..Selection::default() };
        Ok(self.method.variant(&self.motion).options(selection))
    }

    fn wants(&self, name: &str) -> bool {
        self.row.is_empty() || self.row.iter().any(|row| row == name)
    }

    /// The selected rows.
    fn select<'a>(&self, all: &'a [ExtremeSetting]) -> anyhow::Result<Vec<&'a ExtremeSetting>> {
        let names =
            || all.iter().flat_map(|row| [row.name.as_str(), row.group()]).chain([STABILITY]);
        for name in &self.row {
            if names().any(|known| known == name) {
                continue;
            }
            let advice = advice(name, names(), |_| {
                let rows = all.iter().map(|row| row.name.as_str()).chain([STABILITY]);
                format!("there are {}", rows.collect::<Vec<_>>().join(", "))
            });
            bail!("`--row {name}`: no such row or group; {advice}");
        }
        Ok(all.iter().filter(|row| self.wants(&row.name) || self.wants(row.group())).collect())
    }

    fn judge(
        &self,
        row: &ExtremeSetting,
        base: &Method,
        declared: Declared,
        progress: &Progress,
    ) -> anyhow::Result<JudgedExtreme> {
        let mut arithmetic = self.method.arithmetic;
        let (setting, seen) = match Subject::new(&self.field, &self.options()?, Some(row))? {
            Err(reason) => (row.name.clone(), RunResult::LeftOut { reason }),
            Ok(subject) => {
                let allow_unstable = self.method.allow_unstable;
                let (method, cells) = subject.method(base, row, self.quick, allow_unstable);
                if !row.allows_unstable(allow_unstable) && method.setup.fastest_wave.is_none() {
                    progress.say(&without_bound(&subject.input));
                }
                if row.single {
                    arithmetic.precision = Precision::F32;
                }
                let mut observer = progress.of(cells);
                let seen = subject.run(
                    &method,
                    cells,
                    arithmetic.precision,
                    &mut observer as &mut dyn Observer,
                )?;
                (describe(&method, cells, arithmetic, &subject.settings), seen)
            }
        };
        let verdict = judge(row, declared, &seen);
        if self.quiet_terminal() {
            progress.say(&format!("{}: {}", row.name, verdict.name()));
        }
        Ok(JudgedExtreme { row: row.clone(), setting, seen, verdict })
    }

    fn quiet_terminal(&self) -> bool {
        !std::io::IsTerminal::is_terminal(&std::io::stderr())
    }

    /// The largest stable Courant numbers, on a motion so small that nothing else happens.
    fn stability(&self, own: &Method, progress: &Progress) -> anyhow::Result<Vec<Stability>> {
        let all = rows()?;
        let Some(small) = all.iter().find(|row| row.name == "displacement/1e-8") else {
            return Ok(Vec::new());
        };
        let mut options = self.options()?;
        // A rigid motion on top is no small one.
        options.selection.twin = Twin::Nothing;
        let subject = match Subject::new(&self.field, &options, Some(small))? {
            Ok(subject) => subject,
            Err(reason) => {
                progress.say(&format!("note: stability is not measured: {reason}"));
                return Ok(Vec::new());
            }
        };
        let elasticity = subject.elasticity()?;
        let mut found = Vec::new();
        for method in self.methods(own) {
            let measured = stable::courant(&subject, &method)?;
            let theory = elasticity
                .as_ref()
                .and_then(|elasticity: &LinearMaterial| courant(&method, elasticity));
            if self.quiet_terminal() {
                progress.say(&format!(
                    "stability of {} {}: {measured:.3}",
                    method.formulation, method.shape
                ));
            }
            found.push(Stability { is_own: method == *own, method, theory, measured });
        }
        Ok(found)
    }

    /// The method itself; in full also every shape function in each formulation, every integrator and transfers.
    fn methods(&self, own: &Method) -> Vec<Method> {
        let mut methods = vec![own.clone()];
        if self.quick {
            return methods;
        }
        for Setting { formulation, shape, .. } in Setting::kinds() {
            methods.push(Method { formulation, shape, ..own.clone() });
        }
        for &integrator in IntegratorName::ALL {
            methods.push(Method { integrator, ..own.clone() });
        }
        for transfer in [Transfer::FLIP, Transfer::Pic, Transfer::Apic, Transfer::Xpic { order: 2 }]
        {
            let mut method = own.clone();
            method.setup.transfer = transfer;
            methods.push(method);
        }
        let mut once: Vec<Method> = Vec::new();
        for method in methods {
            if !once.contains(&method) {
                once.push(method);
            }
        }
        once
    }
}

/// Describes the extreme setting of a run.
fn describe(method: &Method, cells: Division, arithmetic: Arithmetic, settings: &str) -> String {
    let setup = &method.setup;
    let mut words = vec![format!("{cells} cells")];
    if !settings.is_empty() {
        words.push(settings.to_owned());
    }
    words.push(format!("{} per cell", setup.particles_per_cell));
    words.push(match setup.time_step {
        Some(step) => format!("time step {step:.2e}"),
        None => format!("Courant {}", setup.courant),
    });
    words.push(arithmetic.to_string());
    words.join(", ")
}
