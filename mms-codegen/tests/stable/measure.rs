//! Errors in units of eps, of double precision against 77 digits.

use std::fmt;

use mms_codegen::Compiled;
use mms_math::Scalar as _;
use mms_mechanics::Response;
use mms_mechanics::extent::halton;
use mms_mechanics::sample::samples;
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

/// The number of points and times.
const POINTS: usize = 24;

/// The error of one output of one field.
pub struct Excess {
    what: String,
    /// max |error| / max |value| over points and components, in units of eps; infinite if a quantity that is 0 everywhere is
    /// not computed as 0.
    pub eps: f64,
}

impl Excess {
    /// Whether a bound is exceeded; NaN exceeds every bound.
    pub fn is_beyond(&self, bound: f64) -> bool {
        self.eps.is_nan() || self.eps > bound
    }
}

impl fmt::Display for Excess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:10.3e} eps  {}", self.eps, self.what)
    }
}

/// The inputs of one evaluation.
struct Case {
    time: f64,
    coordinates: Vec<f64>,
    normal: Vec<f64>,
    gradient: Vec<f64>,
}

/// The largest error and the largest magnitude.
#[derive(Clone, Default)]
struct Largest {
    error: f64,
    value: f64,
}

/// Every quantity at the default parameters, or with one of them set.
pub fn of_field(compiled: &Compiled, name: &str, set: Option<(usize, f64)>) -> Vec<Excess> {
    let exact = |value: f64| Rational::try_from(value).expect("a finite number");
    let set: SortedMap<usize, Rational> =
        set.into_iter().map(|(index, value)| (index, exact(value))).collect();
    let parameters = compiled.parameters::<f64>(&set);
    let dimension = compiled.field.dimension;
    let cases: Vec<Case> = samples(&compiled.program, &parameters, POINTS)
        .into_iter()
        .enumerate()
        .map(|(index, sample)| {
            let normal = unit(index, dimension);
            Case { time: sample.time, coordinates: sample.coordinates, normal, gradient: vec![] }
        })
        .collect();
    let outputs: Vec<Output> =
        Quantity::ALL.iter().map(|quantity| Output::Quantity(*quantity)).collect();
    let set = set
        .iter()
        .map(|(index, value)| {
            let name = &compiled.model.parameters[*index].name;
            format!(", {name} = {:.0e}", value.to_f64().value())
        })
        .collect::<String>();
    compare(&compiled.program, &parameters, &cases, &outputs, &format!("{name}{set}"))
}

/// The stress and the energy of a material at displacement gradients whose components are of about that size.
pub fn of_responses(compiled: &Compiled, name: &str, size: f64) -> Vec<Excess> {
    let dimension = compiled.field.dimension;
    let component = |index: usize| halton::<f64>(index)[0] - 0.5;
    let cases: Vec<Case> = (0..POINTS)
        .map(|index| {
            let place = |k: usize| 1 + 7 * index + 13 * k;
            let components = 0..dimension * dimension;
            let gradient = components.map(|k| size * component(place(k))).collect();
            Case { time: 0.0, coordinates: vec![0.5; dimension], normal: vec![], gradient }
        })
        .collect();
    let responses =
        [Response::StrainEnergy, Response::FirstPiolaKirchhoff, Response::KirchhoffStress];
    let outputs = responses.map(Output::Response);
    let name = format!("{name} at gradients of {size:.0e}, {dimension}-D");
    compare(&compiled.program, &[], &cases, &outputs, &name)
}

/// Unit normals of all directions; not all along the axes.
fn unit(index: usize, dimension: usize) -> Vec<f64> {
    let raw: Vec<f64> = (0..dimension).map(|axis| halton::<f64>(index + 5 * axis + 1)[1]).collect();
    let length = raw.iter().map(|component| component * component).sum::<f64>().sqrt();
    raw.iter().map(|component| component / length).collect()
}

fn compare(
    program: &Program,
    parameters: &[f64],
    cases: &[Case],
    outputs: &[Output],
    name: &str,
) -> Vec<Excess> {
    let wide = |values: &[f64]| -> Vec<Precise> {
        values.iter().map(|value| Precise::from_f64(*value)).collect()
    };
    let mut double = Interpreter::new(program, parameters);
    let mut reference = Interpreter::new(program, &wide(parameters));
    let plan = double.plan(outputs);
    let mut largest = vec![Largest::default(); outputs.len()];
    for case in cases {
        double.set_time(&case.time);
        reference.set_time(&Precise::from_f64(case.time));
        let Case { coordinates, normal, gradient, .. } = case;
        double.set_point(&plan, Point { coordinates, normal, gradient });
        let (coordinates, normal, gradient) = (wide(coordinates), wide(normal), wide(gradient));
        let point = Point { coordinates: &coordinates, normal: &normal, gradient: &gradient };
        reference.set_point(&plan, point);
        for (output, largest) in outputs.iter().zip(&mut largest) {
            let pairs = double.output(*output).into_iter().zip(reference.output(*output));
            for (found, expected) in pairs {
                let error = (Precise::from_f64(found) - expected.clone()).magnitude().to_f64();
                // NaN must win, and `max` would drop it.
                if largest.error <= error || error.is_nan() {
                    largest.error = error;
                }
                largest.value = largest.value.max(expected.magnitude().to_f64());
            }
        }
    }
    let named = outputs.iter().zip(largest).map(|(output, Largest { error, value })| {
        let eps = if error == 0.0 { 0.0 } else { error / value / f64::EPSILON };
        Excess { what: format!("{} of {name}", label(*output)), eps }
    });
    named.collect()
}

fn label(output: Output) -> String {
    match output {
        Output::Quantity(quantity) => quantity.name().to_string(),
        other => format!("{other:?}"),
    }
}
