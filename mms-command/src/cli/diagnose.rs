//! `mms diagnose`: which mistake makes the error of a solver.

use std::path::PathBuf;
use std::str::FromStr;

use anyhow::{Context as _, ensure};
use clap::{Args, Parser as _, ValueEnum};
use mms_codegen::variation::Variation;
use mms_codegen::{Options, Selection};
use mms_convergence::TOLERANCE;
use mms_diagnosis::answer::DiagnosisFinding;
use mms_diagnosis::changed::Without;
use mms_diagnosis::evidence::Mesh;
use mms_diagnosis::exact::Quantity as Seen;
use mms_diagnosis::scene::{self, Evidence};
use mms_diagnosis::solver::Solver;
use mms_exact::Exact;
use mms_exact::{Input, evaluated};
use mms_files::results::Disk;
use mms_judge::diagnose::{
    Alone, Reading, diagnosis_of, falls, find, gradients, keep_own, left_out, read,
};
use mms_judge::next::{self, Meshes};
use mms_judge::table::{ExpectedOrders, NamedOrder};
use mms_options::field::{Variant, open};
use mms_options::method::{MethodOptions, finite, length, positive};
use mms_report::{Diagnosed, DiagnosisPlan, DiagnosisStep, Hypotheses};
use mms_runtime::Method;
use mms_runtime::scene::Scene;
use mms_spec::own::Own;
use mms_spec::quantity::Quantity;

use super::format::{Detail, Printing};
use super::naming::Naming;
use super::next::typed;
use super::{CommandOutcome, print, replaced, say, this_command, validate_output};
use crate::session::progress::StatusLine;

/// Name the mistake in a solver from the error that it makes.
///
/// For the results of a FIELD, give one FILE for each mesh, as for `mms judge`. Their content determines the comparison:
///
/// F and a stress (--quantity stress), or F and its tangent (--quantity tangent): the material law is compared to round-off,
/// without a solver.
///
/// Accelerations `a` or residuals `r` at an exact state: they are integrated against smooth functions, and the integrals
/// compared.
///
/// u, v, F at one or more times: the built-in solver runs each hypothesis on a grid of about your size, or computes its
/// equilibrium for a static field, and its errors are compared with yours. Results of two meshes must also have the expected
/// order, as in `mms judge`.
///
/// A hypothesis is named if it explains the error, with a plausible size, and no other explains it as well. It describes the
/// effect of the mistake, not the line that is wrong.
///
/// Exit codes: 0 the error is not larger than a right method makes; 1 a mistake is named, or the error is unexplained; 2 bad
/// usage, or bad files.
#[derive(Args)]
pub struct Diagnose {
    /// A name that `mms list` prints, or the path of a TOML file.
    #[arg(required_unless_present = "list")]
    field: Option<String>,
    /// Results of one mesh, at one or more times, as for `mms judge`.
    #[arg(value_name = "FILE", required_unless_present_any = ["list", "plan"])]
    files: Vec<String>,
    /// List the hypotheses: what each is, what it changes, which step shows it, and whether it is a mistake or a choice.
    /// Without a FIELD, the list is for sheared_block_2d, a square with loads.
    #[arg(long, conflicts_with = "files")]
    list: bool,
    /// Print the steps of a diagnosis in order: what each needs from your code, its cost, its command, and the mistakes that
    /// it can show. Give the STEPs that your code can output; by default all are printed.
    #[arg(
        long,
        value_name = "STEP,..",
        num_args = 0..=1,
        value_delimiter = ',',
        requires = "field",
        conflicts_with_all = ["files", "list"]
    )]
    plan: Option<Vec<DiagnosisStep>>,
    /// The quantities to compare, by name or symbol, as for `mms judge`: u, v, F; by default all that the files contain.
    /// `stress` compares the material law alone, from a table of F and P, S, sigma or tau; `tangent` does so from a table of
    /// F and DDSDDE.
    #[arg(long, value_name = "NAME,..|stress|tangent", value_delimiter = ',')]
    quantity: Vec<String>,
    #[command(flatten)]
    naming: Naming,
    /// The most memory for reading a file, in MB; by default the free memory.
    #[arg(long, value_name = "MB")]
    max_memory: Option<u64>,
    /// The cell size h of each FILE, in their order; 1/8 is a number too. By default h is measured from the files.
    #[arg(long, value_name = "H,..", value_delimiter = ',', value_parser = length)]
    h: Vec<f64>,
    /// The times of the results, if the files contain none.
    #[arg(long, value_name = "T,..", value_delimiter = ',', value_parser = finite, allow_hyphen_values = true)]
    time: Vec<f64>,
    /// The time step of your solver: one for all FILEs, or one for each in their order; by default the step of about the
    /// Courant number 0.4.
    #[arg(long, value_name = "DT,..", value_delimiter = ',', value_parser = positive)]
    time_step: Vec<f64>,
    /// A term that was switched off in your solver for accelerations or residuals; may be repeated.
    #[arg(long, value_name = "body_force|stress|traction")]
    without: Vec<Term>,
    /// The sign of residuals: `+` is r = rho0 a - Div P - rho0 b, per reference volume.
    #[arg(long, value_name = "+|-", default_value = "+", allow_hyphen_values = true, value_parser = sign)]
    residual_sign: f64,
    /// The kind of residuals: `density` is per reference volume; `nodal` is a force, integrated with the shape function of
    /// each node, and includes the tractions.
    #[arg(long, value_name = "density|nodal", default_value = "density")]
    residual: Residual,
    /// The method of the built-in solver to compare with, as in `shape=linear,integrator=usl`: any options of `mms study`
    /// that state how to solve. The expected order is then the order of this method on this field. By default several methods
    /// are compared.
    #[arg(long, value_name = "OPTION=VALUE,..")]
    like: Option<Alike>,
    /// The expected order of results on two or more meshes, as for `mms judge`.
    #[arg(long, value_name = "[NAME=]P,..", value_delimiter = ',')]
    expected_order: Vec<NamedOrder>,
    /// Results of a right version of your solver, one for each FILE, on the same meshes and at the same times. FILEs are
    /// compared with them in place of the exact solution, so that the error of your method cancels.
    #[arg(long, value_name = "FILE", value_delimiter = ',', requires = "files", conflicts_with_all = ["like", "expected_order"])]
    reference: Vec<String>,
    /// State that your solver was given the affine part of the motion, as `mms state --affine` writes it.
    #[arg(long)]
    affine: bool,
    /// Set a parameter to a value; may be repeated.
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    variant: Variant,
    #[command(flatten)]
    detail: Detail,
    #[command(flatten)]
    printing: Printing,
    /// The folder to write diagnosis.json to, for `mms report`.
    #[arg(long, short, value_name = "FOLDER", conflicts_with = "list")]
    output: Option<PathBuf>,
}

/// The kind of residuals.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Residual {
    Density,
    Nodal,
}

/// A term of the balance of momentum.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
enum Term {
    BodyForce,
    Stress,
    Traction,
}

/// The field of a list, where none is named.
const LISTED: &str = "sheared_block_2d";

/// Options of a method, separated by commas.
#[derive(Clone)]
struct Alike(MethodOptions);

impl FromStr for Alike {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        #[derive(clap::Parser)]
        struct Options {
            #[command(flatten)]
            method: MethodOptions,
        }
        // Names of options have hyphens for underscores; their values stay as they are.
        let word = |it: &str| match it.trim().split_once('=') {
            Some((name, value)) => format!("--{}={value}", name.replace('_', "-")),
            None => format!("--{}", it.trim().replace('_', "-")),
        };
        let words = text.split(',').map(word);
        let parsed = Options::try_parse_from(std::iter::once(String::new()).chain(words));
        parsed.map(|it| Alike(it.method)).map_err(|error| error.render().to_string())
    }
}

fn sign(text: &str) -> Result<f64, &'static str> {
    match text {
        "+" => Ok(1.0),
        "-" => Ok(-1.0),
        _ => Err("expected + or -"),
    }
}

impl Diagnose {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        self.output.as_deref().map_or(Ok(()), validate_output)?;
        let variation = if self.affine { Variation::Affine } else { Variation::Nothing };
        let options = Options { variation, ..self.variant.options(Selection::default()) };
        let input = Input::new(open(self.field.as_deref().unwrap_or(LISTED))?, &options)?;
        let scene = input.scene(&self.set, |code| code.double)?;
        if self.list {
            let report = Hypotheses { field: &input.name, all: scene::hypotheses(&scene) };
            self.printing.print_in(self.detail, &report)?;
            return Ok(CommandOutcome::AsExpected);
        }
        if let Some(steps) = &self.plan {
            let plan = DiagnosisPlan::new(&input.name, steps, scene::hypotheses(&scene));
            self.printing.print(&plan)?;
            return Ok(CommandOutcome::AsExpected);
        }
        let provenance = this_command("diagnose", input.provenance(&self.set));
        let mut exact = Exact::new(input, &self.set)?;
        let (law, wanted) = self.quantities(&exact.input().own_quantities())?;
        let names = self.naming.names(Some(exact.input()))?;
        let all = self.files.iter().map(|file| find(file, &names, self.max_memory, &Disk));
        let mut all = all.collect::<anyhow::Result<Vec<_>>>()?;
        let is_static = exact.input().is_static();
        keep_own(&mut all, is_static)?;
        let right = self.reference.iter().map(|file| find(file, &names, self.max_memory, &Disk));
        let mut right = right.collect::<anyhow::Result<Vec<_>>>()?;
        keep_own(&mut right, is_static)?;
        let reading = Reading {
            files: &Disk,
            right: &right,
            names: &names,
            times: &self.time,
            rest: scene::is_at_rest(&scene).then_some(exact.window[1]),
            sizes: &self.h,
            time_steps: &self.time_step,
            law,
            wanted: &wanted,
            residual_sign: self.residual_sign,
            is_nodal: self.residual == Residual::Nodal,
        };
        let left_out = left_out(&all, &reading, &exact)?;
        if !left_out.is_empty() {
            say(format_args!("left out: {}", left_out.join(", ")));
        }
        let evidence = read(&all, &reading, &mut exact)?;
        say(format_args!("looking at {}", evidence.says()));
        let is_out = |term: Term| self.without.contains(&term);
        let without = Without {
            body_force: is_out(Term::BodyForce),
            stress: is_out(Term::Stress),
            traction: is_out(Term::Traction),
        };
        let method = |Alike(it): &Alike| it.method(exact.dimension);
        let like = self.like.as_ref().map(method).transpose()?;
        ensure!(
            like.is_none() || reading.rest.is_none(),
            "`--like`: nothing moves in this field, and methods of `mms study` solve for motion; leave the option out"
        );
        let falls = match &evidence {
            Evidence::Results(meshes) if right.is_empty() => {
                let gradients = gradients(&all, &reading, &exact)?;
                let orders = self.orders(&scene, meshes, like.as_ref(), &gradients)?;
                let falls = falls(all, &wanted, &reading, &orders, &mut exact);
                falls.unwrap_or_else(|error| {
                    say(format_args!("warning: the order between meshes is not judged: {error:#}"));
                    None
                })
            }
            _ => None,
        };
        let solver = Solver { without, like, falls, is_compared_with_right_run: !right.is_empty() };
        let (diagnosis, question) =
            diagnosis_of(&exact, &scene, &evidence, &solver, &StatusLine::new())?;
        let input = exact.input();
        let meshes = self.meshes(reading.rest);
        let next = next::after_diagnosis(&diagnosis, &meshes, &typed());
        let (files, diagnosis) = (&self.files, &diagnosis);
        let report = Diagnosed { input, files, diagnosis, question, next, provenance };
        self.printing.print_in(self.detail, &report)?;
        if let Some(folder) = &self.output {
            replaced::tell(folder, "diagnosis", &report.provenance);
            let written = report.write(folder)?;
            if self.printing.is_text() {
                print(&format!("\nwrote {written}"))?;
            }
        }
        Ok(match diagnosis.finding {
            DiagnosisFinding::Nothing => CommandOutcome::AsExpected,
            DiagnosisFinding::Named | DiagnosisFinding::Unexplained => CommandOutcome::Refuted,
        })
    }

    /// The results, and the options that `mms judge` takes as well; of a field at rest a time for results that have none.
    fn meshes(&self, rest: Option<f64>) -> Meshes {
        let times = match (self.time.as_slice(), rest) {
            ([], Some(rest)) => vec![rest],
            (times, _) => times.to_vec(),
        };
        let options = [
            next::list("quantity", &self.quantity).into_iter().collect(),
            next::list("h", &self.h).into_iter().collect(),
            next::list("time", &times).into_iter().collect(),
            self.naming.arguments(),
            next::each("max-memory", self.max_memory.as_slice()),
            next::each("set", &self.set),
            self.variant.arguments(),
        ];
        let field = self.field.clone().unwrap_or_default();
        let (files, options) = (self.files.clone(), options.concat());
        Meshes { field, files, options, of_judge: None }
    }

    /// The law alone, or the quantities of results that are looked at.
    fn quantities(&self, own: &[Own]) -> anyhow::Result<(Option<Alone>, Vec<Quantity>)> {
        Ok(match self.quantity.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
            ["stress"] => (Some(Alone::Stress), Vec::new()),
            ["tangent"] => (Some(Alone::Tangent), Vec::new()),
            _ => (None, evaluated(own, &self.quantity)?),
        })
    }

    /// The expected orders of results on meshes: as given, or the orders of the method that results are compared with.
    fn orders(
        &self,
        scene: &Scene<f64>,
        meshes: &[Mesh],
        like: Option<&Method>,
        gradients: &[Quantity],
    ) -> anyhow::Result<ExpectedOrders> {
        let mut orders = ExpectedOrders::new(&self.expected_order, TOLERANCE);
        let Some(like) = like.filter(|_| meshes.len() > 1 && self.expected_order.is_empty()) else {
            return Ok(orders);
        };
        let found = scene::orders_of(scene, meshes, like).context("`--like`")?;
        for (quantity, order) in found {
            say(format_args!("expected order of {}: {order:.2}, as of `--like`", quantity.name()));
            let order = (100.0 * order).round() / 100.0;
            match quantity {
                Seen::DisplacementGradient => {
                    orders.named.extend(gradients.iter().map(|it| (it.name().into(), order)));
                }
                _ => orders.named.push((quantity.name().into(), order)),
            }
        }
        Ok(orders)
    }
}
