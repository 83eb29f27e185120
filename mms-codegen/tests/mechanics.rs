//! Stress, its divergence and the body force of fields and materials of every kind, against
//! central differences of W and of P in 77 digits: a route without symbolic differentiation.

use mms_codegen::mechanics::Response;
use mms_codegen::program::Output;
use mms_codegen::program::interpret::{Interpreter, Point};
use mms_codegen::program::precise::Precise;
use mms_codegen::quantity::Quantity;
use mms_codegen::sample::samples;
use mms_codegen::visibility::{Span, Status, Term, Visibility};
use mms_codegen::{Compiled, compile};
use mms_math::Scalar as _;

/// A density that uses every invariant, so that no coefficient of the stress is zero.
const EVERY_INVARIANT: &str = r#"
[material]
title = "every invariant"
strain_energy = "k1*(I1 - 3)*(1 + (I1 - 3)/5) + k2*(I2 - 3 + (I1 - 3)*ln(J)) - k3*ln(J) + k4*(I3 - 1)^2"
[parameters]
k1 = { unit = "Pa" }
k2 = { unit = "Pa" }
k3 = { unit = "Pa" }
k4 = { unit = "Pa" }
"#;

const NEO_HOOKEAN: &str = "model = \"neo_hookean\"\nlambda = 3\nmu = 2";
/// A stress-free reference state needs 2 k1 + 4 k2 = k3; k1 and the density are graded.
const GRADED: &str =
    "model = \"./every.toml\"\nk1 = \"2 + X/3\"\nk2 = 1\nk3 = \"8 + 2*X/3\"\nk4 = 5";

fn field(dimension: usize, displacement: &str, material: &str, density: &str) -> Compiled {
    let corner = |value: &str| vec![value; dimension].join(", ");
    let text = format!(
        "[field]\ntitle = \"a field\"\ndimension = {dimension}\n[displacement]\nu = {displacement}\n\
         [material]\n{material}\ndensity = \"{density}\"\n[domain]\nshape = \"box\"\n\
         lower = [{}]\nupper = [{}]\ntime = [0, 1]\n",
        corner("0.25"),
        corner("1"),
    );
    let load = |_: &str| Ok(EVERY_INVARIANT.to_string());
    compile("field", "field.toml", &text, &load).unwrap_or_else(|failure| panic!("{failure}"))
}

const LINE: &str = "[\"0.2*sin(X + t)*exp(X/2)\"]";
const PLANE: &str = "[\"0.1*sin(2*X + Y)*cos(t)\", \"0.2*X*Y^2*sin(t + X)\"]";
const SPACE: &str =
    "[\"0.1*sin(X*Y + Z)*cos(t)\", \"0.1*X*Z^2*sin(t + Y)\", \"0.1*exp(X - Y)*cos(Z + t)\"]";

/// A rotation that varies with the radius: its relations collapse det F to 1.
const VORTEX: &str = "[\"X*cos(t*exp(-hypot(X, Y))) - Y*sin(t*exp(-hypot(X, Y))) - X\", \
                      \"X*sin(t*exp(-hypot(X, Y))) + Y*cos(t*exp(-hypot(X, Y))) - Y\"]";
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

/// A field evaluated in 77 digits.
struct Evaluator<'a> {
    compiled: &'a Compiled,
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

fn stress_is_the_derivative_of_energy(compiled: &Compiled) {
    let evaluator = Evaluator { compiled };
    for point in samples::<Precise>(compiled, &[], 4) {
        let at = &point.coordinates;
        let gradient = evaluator.quantity(Quantity::DisplacementGradient, &point.time, at);
        let stress = evaluator.quantity(Quantity::FirstPiolaKirchhoff, &point.time, at);
        let response = evaluator.response(Response::FirstPiolaKirchhoff, at, &gradient);
        for (component, stress) in stress.iter().enumerate() {
            let energy = |h: &[Precise]| evaluator.response(Response::StrainEnergy, at, h);
            let slope = central(&gradient, component, energy).remove(0);
            assert_agree("P = dW/dF", stress, &slope);
            assert_agree("P of the field and of the material", stress, &response[component]);
        }
    }
}

fn momentum_balances(compiled: &Compiled) {
    let evaluator = Evaluator { compiled };
    let dimension = compiled.field.dimension;
    for point in samples::<Precise>(compiled, &[], 4) {
        let (time, at) = (&point.time, &point.coordinates);
        let of = |quantity| evaluator.quantity(quantity, time, at);
        let (divergence, force) = (of(Quantity::DivP), of(Quantity::BodyForce));
        let (acceleration, density) =
            (of(Quantity::Acceleration), evaluator.response(Response::Density, at, &[]).remove(0));
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

fn everything_holds(compiled: &Compiled) {
    stress_is_the_derivative_of_energy(compiled);
    momentum_balances(compiled);
}

#[test]
fn neo_hookean_in_one_dimension() {
    everything_holds(&field(1, LINE, NEO_HOOKEAN, "1"));
}

#[test]
fn neo_hookean_in_two_dimensions() {
    everything_holds(&field(2, PLANE, NEO_HOOKEAN, "1"));
}

#[test]
fn neo_hookean_in_three_dimensions() {
    everything_holds(&field(3, SPACE, NEO_HOOKEAN, "1"));
}

#[test]
fn every_invariant_graded_in_one_dimension() {
    everything_holds(&field(1, LINE, GRADED, "2 + X^2"));
}

#[test]
fn every_invariant_graded_in_two_dimensions() {
    everything_holds(&field(2, PLANE, GRADED, "2 + X*Y"));
}

#[test]
fn every_invariant_graded_in_three_dimensions() {
    everything_holds(&field(3, SPACE, GRADED, "2 + X*Z"));
}

#[test]
fn what_relations_simplify_keeps_its_value() {
    for (dimension, displacement) in [(2, VORTEX), (2, RING), (3, TWIST)] {
        everything_holds(&field(dimension, displacement, NEO_HOOKEAN, "1"));
        everything_holds(&field(dimension, displacement, GRADED, "2 + X*Y"));
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

/// A material at rest carries no stress.
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

/// The names of the terms that a field has of each status.
fn seen(compiled: &Compiled) -> [Vec<String>; 3] {
    let visibility = Visibility::of(compiled).expect("within the bound");
    [Status::Present, Status::Zero, Status::Negligible]
        .map(|status| visibility.with(status).map(Term::name).collect())
}

#[test]
fn a_field_of_every_term_lacks_none() {
    for dimension in [2, 3] {
        let displacement = if dimension == 2 { PLANE } else { SPACE };
        let [present, zero, negligible] = seen(&field(dimension, displacement, GRADED, "2 + X*Y"));
        assert!(zero.is_empty() && negligible.is_empty(), "{zero:?} {negligible:?}");
        let is_seen = |kind: &str| present.iter().any(|term| term.split('.').next() == Some(kind));
        let unseen: Vec<_> = Term::KINDS.iter().filter(|kind| !is_seen(kind)).collect();
        let outside: &[&&str] = if dimension == 2 { &[&"out_of_plane"] } else { &[] };
        assert_eq!(unseen, outside);
    }
}

#[test]
fn a_vortex_has_no_volume_change_no_lambda_and_a_symmetric_stress() {
    let [present, zero, _] = seen(&field(2, VORTEX, NEO_HOOKEAN, "1"));
    for term in ["volume_change", "parameter.lambda", "graded_moduli", "graded_density"] {
        assert!(zero.contains(&term.to_string()), "{term} of {zero:?}");
    }
    for term in ["shear", "rotation", "parameter.mu", "third_gradient", "traction.x_min"] {
        assert!(present.contains(&term.to_string()), "{term} of {present:?}");
    }
}

/// The sine of twice an angle in one component, twice sine times cosine in the other.
#[test]
fn a_divergence_that_is_0_by_an_identity_leaves_no_lambda() {
    let vortex =
        "[\"0.1*sin(pi*X)^2*sin(2*pi*Y)*cos(t)\", \"-0.1*sin(2*pi*X)*sin(pi*Y)^2*cos(t)\"]";
    let linear = "model = \"linear_elastic\"\nlambda = 3\nmu = 2";
    let [present, zero, negligible] = seen(&field(2, vortex, linear, "1"));
    assert!(zero.contains(&"parameter.lambda".to_string()), "{zero:?} {negligible:?}");
    assert!(present.contains(&"parameter.mu".to_string()), "{present:?}");
    assert!(negligible.is_empty(), "{negligible:?}");
}

/// Everywhere else u is too small for any number.
#[test]
fn a_pulse_in_a_tiny_body_has_a_divergence() {
    let pulse = "1e-11*exp(-(X/1e-9)^2 - (Y/1e-9)^2)*cos(t)";
    let text = format!(
        "[field]\ntitle = \"a pulse\"\ndimension = 2\n[displacement]\nu = [\"{pulse}\", \"{pulse}\"]\n\
         [material]\n{NEO_HOOKEAN}\ndensity = 1\n[domain]\nshape = \"box\"\n\
         lower = [0, 0]\nupper = [1e-9, 1e-9]\ntime = [0, 1]\n",
    );
    let load = |_: &str| Err("no other file".to_string());
    let compiled = compile("pulse", "pulse.toml", &text, &load).expect("a right field");
    let [present, ..] = seen(&compiled);
    for term in ["volume_change", "parameter.lambda"] {
        assert!(present.contains(&term.to_string()), "{term} of {present:?}");
    }
}

#[test]
fn components_that_do_not_couple_have_no_cross_terms() {
    let apart = "[\"0.1*sin(X)*cos(t)\", \"0.1*sin(Y)*cos(t + 1)\"]";
    let [present, zero, negligible] = seen(&field(2, apart, NEO_HOOKEAN, "1"));
    for term in ["shear", "rotation", "cross_terms", "transposed_stress"] {
        assert!(zero.contains(&term.to_string()), "{term} of {zero:?}");
    }
    assert!(present.contains(&"parameter.lambda".to_string()), "{present:?}");
    assert!(negligible.is_empty(), "{negligible:?}");
}

/// sin^2 + cos^2 - 1 that canonical form does not find: the angle is doubled in one of them.
#[test]
fn what_is_zero_without_being_seen_to_be_is_negligible() {
    let hidden = "[\"X/9 + 0.1*(cos(2*X*t) - 1 + 2*sin(X*t)^2)\"]";
    let visibility = Visibility::of(&field(1, hidden, NEO_HOOKEAN, "1")).expect("in the bound");
    let negligible: Vec<_> = visibility.with(Status::Negligible).map(Term::name).collect();
    for term in ["velocity", "acceleration", "curvature", "body_force"] {
        assert!(negligible.contains(&term.to_string()), "{term} of {negligible:?}");
    }
    assert_eq!(visibility.span(), Some(Span::Linear));
    assert!(visibility.is_exact_in_time());
    // Far below the accuracy of double precision, and there all the same.
    let small = hidden.replace("2*X*t) - 1", "2*X*t) - 1 + 1e-40*X^3*t^3");
    let [present, ..] = seen(&field(1, &small, NEO_HOOKEAN, "1"));
    for term in ["jerk", "third_gradient", "body_force"] {
        assert!(present.contains(&term.to_string()), "{term} of {present:?}");
    }
}

#[test]
fn polynomials_are_in_the_span_of_shape_functions() {
    let spans = [
        ("[\"X*t/9 + Y\", \"Y*t^3/9\"]", Some(Span::Linear), false),
        ("[\"X*Y*t/9\", \"Y*t^2/9\"]", Some(Span::Multilinear), true),
        ("[\"X^2*t/9\", \"X*Y*t^2/9\"]", Some(Span::Quadratic), true),
        ("[\"X^2*Y*t/9\", \"X*Y*t^2/9\"]", None, true),
    ];
    for (displacement, span, is_exact_in_time) in spans {
        let compiled = field(2, displacement, NEO_HOOKEAN, "1");
        let visibility = Visibility::of(&compiled).expect("within the bound");
        assert_eq!(visibility.span(), span, "{displacement}");
        assert_eq!(visibility.is_exact_in_time(), is_exact_in_time, "{displacement}");
        assert!(visibility.lacks(&Term::InitialAcceleration) != displacement.contains("t^2"));
    }
}

/// An exponent is a number, and cannot be varied to see whether b depends on it.
#[test]
fn a_parameter_that_must_be_a_number_is_undecided() {
    let material = "[material]\ntitle = \"power law\"\n\
                    strain_energy = \"k*((I1 - 3) - 2*ln(J) + (J^n - 1)^2)\"\n\
                    [parameters]\nk = {}\nn = {}\n";
    let text = "[field]\ntitle = \"a field\"\ndimension = 1\n[displacement]\nu = [\"0.1*sin(X + t)\"]\n\
                [material]\nmodel = \"./power.toml\"\nk = 2\nn = 3\ndensity = 1\n\
                [domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 1]\n";
    let load = |_: &str| Ok(material.to_string());
    let compiled = compile("field", "field.toml", text, &load);
    let compiled = compiled.unwrap_or_else(|failure| panic!("{failure}"));
    let visibility = Visibility::of(&compiled).expect("within the bound");
    let undecided: Vec<_> = visibility.with(Status::Undecided).map(Term::name).collect();
    assert_eq!(undecided, ["parameter.n"]);
    assert!(!visibility.lacks(&Term::Parameter("k".into())));
}
