//! A field at an extreme, and the results of running it there.

use mms_analysis::accuracy::{Varied, regime, vary};
use mms_codegen::variation::Variation;
use mms_codegen::{Compiled, Options};
use mms_exact::Input;
use mms_exact::wave::{fastest_wave, sound};
use mms_mechanics::Output;
use mms_mechanics::sample::{domain, samples};
use mms_options::field::open;
use mms_options::method::Precision;
use mms_program::interpret::{Interpreter, Point};
use mms_runtime::scene::{Scene, Solvable, usual_cells};
use mms_runtime::study::{Observer, Watch};
use mms_runtime::{Division, FormulationName, Method};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

use super::rows::ExtremeSetting;
use super::theory::LinearMaterial;
use super::verdict::{Diagnosis, RunResult};

/// The number of points and times at which the largest displacement and the least J are searched.
const POINTS: usize = 256;

/// A field at an extreme.
pub struct Subject {
    /// The field.
    pub input: Input,
    /// The parameters that are set, by position.
    pub set: SortedMap<usize, Rational>,
    /// The extreme settings of the field, in words; empty if it is as declared.
    pub settings: String,
    /// The largest displacement.
    pub size: f64,
    /// The least J.
    least_jacobian: f64,
    /// The longest edge of the body, or its diameter.
    edge: f64,
    /// The begin and the end of the time window.
    window: [f64; 2],
}

impl Subject {
    /// A field in a regime or with another material; or the reason why it cannot be there.
    ///
    /// # Errors
    /// A field that cannot be read, or does not compile as it is.
    pub fn new(
        field: &str,
        declared: &Options,
        row: Option<&ExtremeSetting>,
    ) -> anyhow::Result<Result<Self, String>> {
        let mut options = declared.clone();
        let mut set = SortedMap::new();
        let mut settings = String::new();
        let source = open(field)?;
        if let Some(name) = row.and_then(|row| row.regime.as_deref()) {
            let Some(regime) = regime::find(name) else { anyhow::bail!("no regime `{name}`") };
            let compile = |options: &Options| source.compile(options);
            let varied = match vary(&compile, &options, regime) {
                Ok(varied) => varied,
                Err(reason) => return Ok(Err(reason)),
            };
            settings = name.replace('_', " ");
            let compiled = Input::new(source.clone(), declared)?.compiled;
            (options, set) = take(&compiled, varied, declared);
        } else if let Some(ratio) = row.and_then(|row| row.lambda_over_mu.clone()) {
            settings = format!("lambda/mu {ratio}");
            let variation = Variation::Moduli(ratio);
            let input = Input::new(source.clone(), declared)?;
            if let Err(reason) = variation.fits(&input.compiled.field) {
                return Ok(Err(reason));
            }
            options.variation = variation;
        }
        let varied = options != *declared;
        let input = match Input::new(source, &options) {
            // The field compiles as it is: it makes no claim about the extreme.
            Err(error) if varied => return Ok(Err(first_line(&error))),
            input => input?,
        };
        input.validate_moving()?;
        Ok(Ok(Self::of(input, set, settings)))
    }

    fn of(input: Input, set: SortedMap<usize, Rational>, settings: String) -> Self {
        let compiled = &input.compiled;
        let parameters = compiled.parameters::<f64>(&set);
        let (extent, window) = domain(&compiled.program, &parameters);
        let edge = extent.size();
        let (size, least_jacobian) = motion(compiled, &parameters);
        Subject { input, set, settings, size, least_jacobian, edge, window }
    }

    /// The method of a row.
    pub fn method(
        &self,
        base: &Method,
        row: &ExtremeSetting,
        quick: bool,
        allow_unstable: bool,
    ) -> (Method, Division) {
        let at = self.input.compiled.field.dimension - 1;
        let mut method = base.clone();
        let setup = &mut method.setup;
        setup.courant = row.courant.unwrap_or(setup.courant);
        if let Some(particles) = row.particles {
            setup.particles_per_cell = Division::Uniform(particles[at]);
        }
        if let Some([few, many]) = row.steps {
            let steps = if quick { few } else { many };
            setup.time_step = Some((self.window[1] - self.window[0]) / steps as f64);
        }
        let cells = row.cells.map_or_else(|| usual_cells(at + 1), |cells| cells[at]);
        if let Some(steps) = row.end {
            self.end_after(&mut method, cells, steps);
        }
        method.setup.fastest_wave = match row.allows_unstable(allow_unstable) {
            true => None,
            false => fastest_wave(&self.input, &self.set, &method),
        };
        (method, Division::Uniform(cells))
    }

    /// Ends a run after `steps` steps of its Courant number.
    pub fn end_after(&self, method: &mut Method, cells: usize, steps: usize) {
        let [_, speed] = sound(&self.input.compiled, &self.set);
        let time_step = method.setup.courant * self.edge / cells as f64 / speed;
        method.setup.end_time = Some(self.window[0] + steps as f64 * time_step);
    }

    /// The material of a box in its middle; `None` for a body whose particles lie along its faces.
    ///
    /// # Errors
    /// The gallery differs from its files.
    pub fn elasticity(&self) -> anyhow::Result<Option<LinearMaterial>> {
        let compiled = &self.input.compiled;
        let (extent, _) = domain(&compiled.program, &compiled.parameters::<f64>(&self.set));
        let Some(bounds) = extent.box_bounds() else { return Ok(None) };
        let middle: Vec<f64> = bounds.iter().map(|[lower, upper]| (lower + upper) / 2.0).collect();
        let scene = self.input.scene_with(&self.set, |code| code.double)?;
        Ok(Some(LinearMaterial::of(&scene, &middle)))
    }

    /// Runs a method.
    ///
    /// # Errors
    /// The gallery differs from its files.
    pub fn run(
        &self,
        method: &Method,
        cells: Division,
        precision: Precision,
        observer: &mut dyn Observer,
    ) -> anyhow::Result<RunResult> {
        let set = &self.set;
        Ok(match precision {
            Precision::F32 => {
                self.see(&self.input.scene_with(set, |code| code.single)?, method, cells, observer)
            }
            Precision::F64 => {
                self.see(&self.input.scene_with(set, |code| code.double)?, method, cells, observer)
            }
        })
    }

    fn see<T: Solvable>(
        &self,
        scene: &Scene<T>,
        method: &Method,
        cells: Division,
        observer: &mut dyn Observer,
    ) -> RunResult {
        let run = match scene.run(method, &cells, Watch::Displacement, observer) {
            Ok(run) => run,
            Err(refusal) => {
                let diagnosis = Diagnosis::of_refusal(&refusal);
                return RunResult::Stopped { diagnosis, reason: refusal.to_string() };
            }
        };
        match (run.level.errors, run.details) {
            (Ok(errors), Some(details)) => RunResult::Ended {
                l2: errors.l2 / self.size,
                round_off: details.round_off / self.size,
                cell_size: run.level.cell_size / self.edge,
                least_jacobian: match method.formulation {
                    FormulationName::Updated => self.least_jacobian,
                    FormulationName::Total => 1.0,
                },
            },
            (Err(failure), _) => RunResult::Stopped {
                diagnosis: Diagnosis::of_cause(&failure.cause),
                reason: failure.to_string(),
            },
            (Ok(_), None) => {
                RunResult::Stopped { diagnosis: Diagnosis::Stopped, reason: String::new() }
            }
        }
    }
}

/// The options to compile with, and the parameters to set afterwards: values of the field's own parameters become its defaults,
/// so that its claims are checked with them.
fn take(
    compiled: &Compiled,
    varied: Varied,
    declared: &Options,
) -> (Options, SortedMap<usize, Rational>) {
    let parameters = &compiled.model.parameters;
    let (own, added): (SortedMap<_, _>, SortedMap<_, _>) =
        varied.values.into_iter().partition(|(at, _)| *at < parameters.len());
    let own = own.iter().map(|(at, value)| (parameters[*at].name.clone(), format!("({value})")));
    let own: SortedMap<_, _> = own.collect();
    let mut selection = declared.selection.clone();
    selection.set.retain(|(name, _)| !own.contains_key(name));
    selection.set.extend(own);
    (Options { selection, variation: varied.variation, ..declared.clone() }, added)
}

fn first_line(error: &anyhow::Error) -> String {
    let text = format!("{error:#}");
    let line = text.lines().find(|line| line.contains("error")).or_else(|| text.lines().next());
    line.unwrap_or_default().to_owned()
}

/// The largest displacement and the least J, at some points and times.
fn motion(compiled: &Compiled, parameters: &[f64]) -> (f64, f64) {
    let [u, jacobian] = [Quantity::Displacement, Quantity::Jacobian].map(Output::Quantity);
    let mut interpreter = Interpreter::new(&compiled.program, parameters);
    let plan = interpreter.plan(&[u, jacobian]);
    let (mut size, mut least) = (0.0_f64, f64::INFINITY);
    for sample in samples(&compiled.program, parameters, POINTS) {
        interpreter.set_time(&sample.time);
        interpreter.set_point(&plan, Point::at(&sample.coordinates));
        size = size.max(interpreter.output(u).iter().map(|u| u * u).sum::<f64>().sqrt());
        least = least.min(interpreter.output(jacobian)[0]);
    }
    (size, least)
}
