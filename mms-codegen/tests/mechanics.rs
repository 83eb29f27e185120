//! Stress, its divergence and the body force of fields and materials of every kind, against
//! central differences of W and of P in 77 digits: a route without symbolic differentiation.

use mms_codegen::{Compiled, Selection};
use mms_math::Scalar as _;
use mms_mechanics::Output;
use mms_mechanics::Response;
use mms_mechanics::sample::samples;
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;

#[path = "support/written.rs"]
mod written;
use written::{GRADED, NEO_HOOKEAN, PLANE, SPACE, VORTEX, field, field_of};

const LINE: &str = "[\"0.2*sin(X + t)*exp(X/2)\"]";
/// A radial displacement: a polynomial of the radius times X/R.
const RING: &str = "[\"sin(t)*(3*hypot(X, Y) - (X^2 + Y^2)^(3/2))*X/hypot(X, Y)/9\", \
                    \"sin(t)*(3*hypot(X, Y) - (X^2 + Y^2)^(3/2))*Y/hypot(X, Y)/9\"]";
/// Rotation about an axis, along which it varies, and stretch.
const TWIST: &str = "[\"(1 + t/9)*(X*cos(Z*t + ln(1 + Z)) - Y*sin(Z*t + ln(1 + Z))) - X\", \
                     \"(1 + t/9)*(X*sin(Z*t + ln(1 + Z)) + Y*cos(Z*t + ln(1 + Z))) - Y\", \
                     \"0.1*t*(cosh(Z) + sinh(Z))*sqrt(X^2 + Y^2 + Z^2)\"]";

fn step() -> Precise {
    Precise::from_f64(1e-20)
}

/// A field evaluated in 77 digits, or a material.
struct Evaluator<'a> {
    compiled: &'a Compiled,
}

/// The quantities of a motion that are compared.
const QUANTITIES: [Quantity; 5] = [
    Quantity::DisplacementGradient,
    Quantity::FirstPiolaKirchhoff,
    Quantity::DivP,
    Quantity::BodyForce,
    Quantity::Acceleration,
];

/// A motion with only the quantities that are compared, and its material, which is the same without a motion.
struct Case {
    motion: Compiled,
    material: Compiled,
}

impl Case {
    fn new(dimension: usize, displacement: &str, material: &str, density: &str) -> Self {
        let selection = Selection { quantities: Some(QUANTITIES.into()), ..Selection::default() };
        let still = format!("[{}]", vec!["0"; dimension].join(", "));
        Case {
            motion: field_of(dimension, displacement, material, density, selection),
            material: field(dimension, &still, material, density),
        }
    }
}

impl Evaluator<'_> {
    fn quantity(&self, quantity: Quantity, time: &Precise, at: &[Precise]) -> Vec<Precise> {
        let mut interpreter = Interpreter::new(&self.compiled.program, &[]);
        interpreter.set_time(time);
        let output = Output::Quantity(quantity);
        let plan = interpreter.plan(&[output]);
        interpreter.set_point(&plan, Point::at(at));
        interpreter.output(output)
    }

    fn response(&self, response: Response, at: &[Precise], gradient: &[Precise]) -> Vec<Precise> {
        let mut interpreter = Interpreter::new(&self.compiled.program, &[]);
        let output = Output::Response(response);
        let plan = interpreter.plan(&[output]);
        interpreter.set_point(&plan, Point { coordinates: at, normal: &[], gradient });
        interpreter.output(output)
    }
}

/// The derivative of `f` by one entry of `at`.
fn central(at: &[Precise], entry: usize, f: impl Fn(&[Precise]) -> Vec<Precise>) -> Vec<Precise> {
    let shifted = |step: Precise| {
        let mut shifted = at.to_vec();
        shifted[entry] = shifted[entry].clone() + step;
        f(&shifted)
    };
    let (ahead, behind) = (shifted(step()), shifted(-step()));
    let twice = step() * Precise::from_f64(2.0);
    let pairs = ahead.into_iter().zip(behind);
    pairs.map(|(ahead, behind)| (ahead - behind) / twice.clone()).collect()
}

#[track_caller]
fn assert_agree(what: &str, a: &Precise, b: &Precise) {
    // The differences err by step^2 times a third derivative: 40 digits less a few.
    let difference = (a.clone() - b.clone()).magnitude();
    let close = difference.at_most(&Precise::from_f64(1e-30));
    assert!(close, "{what}: {:e} and {:e}", a.to_f64(), b.to_f64());
}

fn stress_is_the_derivative_of_energy(case: &Case) {
    let [evaluator, material] =
        [&case.motion, &case.material].map(|compiled| Evaluator { compiled });
    for point in samples::<Precise>(&case.motion.program, &[], 4) {
        let at = &point.coordinates;
        let gradient = evaluator.quantity(Quantity::DisplacementGradient, &point.time, at);
        let stress = evaluator.quantity(Quantity::FirstPiolaKirchhoff, &point.time, at);
        let response = material.response(Response::FirstPiolaKirchhoff, at, &gradient);
        for (component, stress) in stress.iter().enumerate() {
            let energy = |h: &[Precise]| material.response(Response::StrainEnergy, at, h);
            let slope = central(&gradient, component, energy).remove(0);
            assert_agree("P = dW/dF", stress, &slope);
            assert_agree("P of the field and of the material", stress, &response[component]);
        }
    }
}

fn momentum_balances(case: &Case) {
    let [evaluator, material] =
        [&case.motion, &case.material].map(|compiled| Evaluator { compiled });
    let dimension = case.motion.field.dimension;
    for point in samples::<Precise>(&case.motion.program, &[], 4) {
        let (time, at) = (&point.time, &point.coordinates);
        let of = |quantity| evaluator.quantity(quantity, time, at);
        let (divergence, force) = (of(Quantity::DivP), of(Quantity::BodyForce));
        let (acceleration, density) =
            (of(Quantity::Acceleration), material.response(Response::Density, at, &[]).remove(0));
        let slopes: Vec<_> = (0..dimension)
            .map(|axis| {
                central(at, axis, |at| evaluator.quantity(Quantity::FirstPiolaKirchhoff, time, at))
            })
            .collect();
        for row in 0..dimension {
            let mut differences = Precise::from_f64(0.0);
            for (axis, slope) in slopes.iter().enumerate() {
                differences = differences + slope[row * dimension + axis].clone();
            }
            assert_agree("Div P", &divergence[row], &differences);
            let balance = density.clone() * acceleration[row].clone() - differences;
            assert_agree("rho0 b", &(density.clone() * force[row].clone()), &balance);
        }
    }
}

fn everything_holds(case: &Case) {
    stress_is_the_derivative_of_energy(case);
    momentum_balances(case);
}

#[test]
fn neo_hookean_in_one_dimension() {
    everything_holds(&Case::new(1, LINE, NEO_HOOKEAN, "1"));
}

#[test]
fn neo_hookean_in_two_dimensions() {
    everything_holds(&Case::new(2, PLANE, NEO_HOOKEAN, "1"));
}

#[test]
fn neo_hookean_in_three_dimensions() {
    everything_holds(&Case::new(3, SPACE, NEO_HOOKEAN, "1"));
}

#[test]
fn every_invariant_graded_in_one_dimension() {
    everything_holds(&Case::new(1, LINE, GRADED, "2 + X^2"));
}

#[test]
fn every_invariant_graded_in_two_dimensions() {
    everything_holds(&Case::new(2, PLANE, GRADED, "2 + X*Y"));
}

#[test]
fn every_invariant_graded_in_three_dimensions() {
    everything_holds(&Case::new(3, SPACE, GRADED, "2 + X*Z"));
}

#[test]
fn what_relations_simplify_keeps_its_value() {
    for (dimension, displacement) in [(2, VORTEX), (2, RING), (3, TWIST)] {
        everything_holds(&Case::new(dimension, displacement, NEO_HOOKEAN, "1"));
        everything_holds(&Case::new(dimension, displacement, GRADED, "2 + X*Y"));
    }
}

/// dP_11/dF_11 at F = I is lambda + 2 mu, and the wave speed its root over rho0.
#[test]
fn the_wave_speed_is_that_of_lame() {
    let compiled = field(3, SPACE, NEO_HOOKEAN, "7");
    let at = [Precise::from_f64(0.5), Precise::from_f64(0.5), Precise::from_f64(0.5)];
    let speed = Evaluator { compiled: &compiled }.response(Response::WaveSpeed, &at, &[]).remove(0);
    assert_agree(
        "c^2 rho0",
        &(speed.clone() * speed * Precise::from_f64(7.0)),
        &Precise::from_f64(7.0),
    );
}

/// A material at rest has no stress.
#[test]
fn the_undeformed_state_is_free_of_stress() {
    for compiled in [field(3, SPACE, NEO_HOOKEAN, "1"), field(2, PLANE, GRADED, "1")] {
        let dimension = compiled.field.dimension;
        let at = vec![Precise::from_f64(0.5); dimension];
        let zero = vec![Precise::from_f64(0.0); dimension * dimension];
        let evaluator = Evaluator { compiled: &compiled };
        for response in [Response::FirstPiolaKirchhoff, Response::KirchhoffStress] {
            for component in evaluator.response(response, &at, &zero) {
                assert_agree("P(I)", &component, &zero[0]);
            }
        }
    }
}
