//! Laws for every material in `materials/`, in 77 digits: the folder is its own list. Dual numbers and differences do not
//! depend on symbolic derivatives.

use std::sync::LazyLock;

use mms_codegen::certify::rest;
use mms_codegen::certify::rest::Rest;
use mms_codegen::materials::MATERIALS;
use mms_codegen::{Compiled, Selection, compile, compile_with};
use mms_math::Scalar as _;
use mms_mechanics::Response;
use mms_mechanics::extent::halton;
use mms_mechanics::sample::samples;
use mms_mechanics::{Output, Program};
use mms_program::dual::Dual;
use mms_program::interpret::{Interpreter, Number, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;
use mms_spec::source::Sources;
use mms_spec::{MaterialSpec, read_material};
use mms_symbolic::expr::Rational;

use crate::sampled::sampled;

/// Displacements in which no derivative vanishes, of every dimension.
const DISPLACEMENTS: [&str; 3] = [
    "[\"0.2*sin(X + t)*exp(X/2)\"]",
    "[\"0.1*sin(2*X + Y)*cos(t)\", \"0.2*X*Y^2*sin(t + X)\"]",
    "[\"0.1*sin(X*Y + Z)*cos(t)\", \"0.1*X*Z^2*sin(t + Y)\", \"0.1*exp(X - Y)*cos(Z + t)\"]",
];

/// A direction that turns from place to place, and leaves every plane.
const FIBRE: &str = "fibre = [\"4/5*cos(X)\", \"4/5*sin(X)\", \"3/5\"]";

fn specs() -> Vec<MaterialSpec> {
    let read = |(stem, text): &(&str, &str)| {
        let mut sources = Sources::default();
        let id = sources.add(*stem, *text);
        read_material(&sources, id, stem, &mut Vec::new()).expect("a right file")
    };
    MATERIALS.iter().map(read).collect()
}

/// The text of a field of a displacement with that material and its arguments.
fn text(dimension: usize, displacement: &str, material: &str, arguments: &str) -> String {
    let corner = |value: &str| vec![value; dimension].join(", ");
    format!(
        "[field]\ntitle = \"a field\"\ndimension = {dimension}\n[displacement]\nu = {displacement}\n\
         [material]\nmodel = \"{material}\"\n{arguments}\ndensity = \"2 + X^2\"\n[domain]\n\
         shape = \"box\"\nlower = [{}]\nupper = [{}]\ntime = [0, 1]\n",
        corner("0.25"),
        corner("1"),
    )
}

fn no_files(_: &str) -> Result<String, String> {
    Err("only shipped materials".to_string())
}

/// A field without a displacement: the response of a material to a gradient depends on none.
fn field(dimension: usize, material: &str, arguments: &str) -> Compiled {
    let displacement = format!("[{}]", vec!["0"; dimension].join(", "));
    let text = text(dimension, &displacement, material, arguments);
    compile("field", "field.toml", &text, &no_files).unwrap_or_else(|failure| panic!("{failure}"))
}

/// A field of the usual displacement, with only the stress and its divergence.
fn moving(dimension: usize, material: &str, arguments: &str) -> Compiled {
    let text = text(dimension, DISPLACEMENTS[dimension - 1], material, arguments);
    let quantities = Some([Quantity::FirstPiolaKirchhoff, Quantity::DivP].into());
    let selection = Selection { quantities, ..Selection::default() };
    compile_with("field", "field.toml", &text, &no_files, &selection.into())
        .unwrap_or_else(|failure| panic!("{failure}"))
}

/// The arguments of a material: distinct stresses that change from place to place, a large number for arguments without a unit,
/// and this formula for each given field.
fn arguments(spec: &MaterialSpec, given: &str) -> String {
    let line = |(index, parameter): (usize, &mms_spec::MaterialParameter)| {
        let unit = parameter.unit.as_ref().map(|unit| unit.value.as_str());
        let name = &parameter.name.value;
        let value = if unit == Some("Pa") { 2 + index } else { 30 };
        format!("{name} = \"{value} + X/{}\"\n", 3 + index)
    };
    let arguments: String = spec.parameters.iter().enumerate().map(line).collect();
    let givens = spec.givens.iter().map(|it| format!("{} = \"{given}\"\n", it.name.value));
    let arguments = arguments + &givens.collect::<String>();
    if spec.has_fibres() { arguments + FIBRE } else { arguments }
}

/// Every material in every dimension, with given fields that change from place to place and in time.
static FIELDS: LazyLock<Vec<(MaterialSpec, Compiled)>> =
    LazyLock::new(|| specs().iter().flat_map(|spec| of(spec, GIVEN)).collect());

/// The materials with their given fields at rest.
static RESTING: LazyLock<Vec<(MaterialSpec, Compiled)>> = LazyLock::new(|| {
    let is_given = |it: &&(MaterialSpec, Compiled)| !it.0.givens.is_empty();
    let others = FIELDS.iter().filter(|it| !is_given(it)).cloned();
    let given = specs().into_iter().filter(|spec| !spec.givens.is_empty());
    others.chain(given.flat_map(|spec| of(&spec, "0"))).collect()
});

/// A formula of given fields that changes from place to place and in time.
const GIVEN: &str = "1/3 + X*sin(1 + t)/5";

fn of(spec: &MaterialSpec, given: &str) -> Vec<(MaterialSpec, Compiled)> {
    let field = |dimension| field(dimension, spec.name.raw(), &arguments(spec, given));
    (1..=3).map(|dimension| (spec.clone(), field(dimension))).collect()
}

fn precise(value: f64) -> Precise {
    Precise::from_f64(value)
}

/// An output of a program at a point with a displacement gradient.
fn output<T: Number>(program: &Program, output: Output, at: &[T], gradient: &[T]) -> Vec<T> {
    let mut interpreter = Interpreter::new(program, &[]);
    let plan = interpreter.plan(&[output]);
    interpreter.set_time(&T::ratio(1, 4));
    interpreter.set_point(&plan, Point { coordinates: at, normal: &[], gradient });
    interpreter.output(output)
}

fn response<T: Number>(compiled: &Compiled, wanted: Response, gradient: &[T]) -> Vec<T> {
    let at = vec![T::ratio(1, 2); compiled.field.dimension];
    output(&compiled.program, Output::Response(wanted), &at, gradient)
}

fn tangent(compiled: &Compiled, gradient: &[Precise]) -> Vec<Precise> {
    let program = compiled.tangent().expect("a tangent of usual size");
    let at = vec![precise(0.5); compiled.field.dimension];
    output(&program, Output::Response(Response::Tangent), &at, gradient)
}

/// Displacement gradients spread over components from -1/5 to 1/5.
fn gradients(dimension: usize) -> Vec<Vec<Precise>> {
    let component = |index: usize| {
        let [first, ..] = halton::<Precise>(index);
        (first - precise(0.5)) * Precise::ratio(2, 5)
    };
    let square = dimension * dimension;
    (0..4).map(|set| (0..square).map(|k| component(7 + 11 * set + 5 * k)).collect()).collect()
}

/// The derivatives of an output by each component of H, by dual numbers.
fn by_duals(program: &Program, wanted: Output, gradient: &[Precise]) -> Vec<Vec<Precise>> {
    let constants = |values: &[Precise]| values.iter().cloned().map(Dual::constant).collect();
    let dimension = gradient.len().isqrt();
    let at: Vec<_> = constants(&vec![precise(0.5); dimension]);
    (0..gradient.len())
        .map(|component| {
            let mut strained: Vec<Dual<Precise>> = constants(gradient);
            strained[component] = Dual::variable(gradient[component].clone());
            let values = output(program, wanted, &at, &strained);
            values.into_iter().map(|value| value.slope).collect()
        })
        .collect()
}

#[track_caller]
fn assert_close(what: &str, a: &Precise, b: &Precise, tolerance: f64) {
    let difference = (a.clone() - b.clone()).magnitude();
    assert!(difference.at_most(&precise(tolerance)), "{what}: {:e}, {:e}", a.to_f64(), b.to_f64());
}

/// The tolerance: both sides have 77 digits, and some cancel.
const EXACT: f64 = 1e-60;

#[test]
fn stress_is_the_derivative_of_energy() {
    for (spec, compiled) in FIELDS.iter() {
        for gradient in gradients(compiled.field.dimension) {
            let stress = response(compiled, Response::FirstPiolaKirchhoff, &gradient);
            let energy = Output::Response(Response::StrainEnergy);
            let slopes = by_duals(&compiled.program, energy, &gradient);
            for (stress, slope) in stress.iter().zip(&slopes) {
                assert_close(spec.name.raw(), stress, &slope[0], EXACT);
            }
        }
    }
}

#[test]
fn the_tangent_is_the_derivative_of_stress_and_symmetric() {
    for (spec, compiled) in FIELDS.iter() {
        for gradient in gradients(compiled.field.dimension).into_iter().take(2) {
            let tangent = tangent(compiled, &gradient);
            let components = gradient.len();
            assert_eq!(tangent.len(), components * components);
            let stress = Output::Response(Response::FirstPiolaKirchhoff);
            let slopes = by_duals(&compiled.program, stress, &gradient);
            for row in 0..components {
                for column in 0..components {
                    let entry = &tangent[row * components + column];
                    assert_close(spec.name.raw(), entry, &slopes[column][row], EXACT);
                    let mirrored = &tangent[column * components + row];
                    assert_close(spec.name.raw(), entry, mirrored, EXACT);
                }
            }
        }
    }
}

#[test]
fn kirchhoff_stress_is_stress_times_the_transposed_gradient() {
    for (spec, compiled) in FIELDS.iter() {
        let dimension = compiled.field.dimension;
        for gradient in gradients(dimension) {
            let stress = response(compiled, Response::FirstPiolaKirchhoff, &gradient);
            let kirchhoff = response(compiled, Response::KirchhoffStress, &gradient);
            for (k, component) in kirchhoff.iter().enumerate() {
                let (row, column) = (k / dimension, k % dimension);
                let products = (0..dimension).map(|axis| {
                    let identity = precise(f64::from(u8::from(axis == column)));
                    let deformation = gradient[column * dimension + axis].clone() + identity;
                    stress[row * dimension + axis].clone() * deformation
                });
                let sum = products.fold(precise(0.0), |sum, product| sum + product);
                assert_close(spec.name.raw(), component, &sum, EXACT);
            }
        }
    }
}

/// An exact rotation: by an angle of cosine 3/5 in the plane, by the quaternion (1, 2, 3, 4) in space.
fn rotation(dimension: usize) -> Option<Vec<Precise>> {
    let (numbers, scale): (&[i32], i32) = match dimension {
        1 => return None,
        2 => (&[3, -4, 4, 3], 5),
        _ => (&[-20, 4, 22, 20, -10, 20, 10, 28, 4], 30),
    };
    Some(numbers.iter().map(|number| Precise::ratio(*number, scale)).collect())
}

#[test]
fn energy_stays_the_same_under_rotations_unless_a_material_says_otherwise() {
    for (spec, compiled) in FIELDS.iter() {
        let dimension = compiled.field.dimension;
        let Some(rotation) = rotation(dimension) else { continue };
        let identity = |k: usize| precise(f64::from(u8::from(k / dimension == k % dimension)));
        for gradient in gradients(dimension) {
            let rotated: Vec<Precise> = (0..dimension * dimension)
                .map(|k| {
                    let (row, column) = (k / dimension, k % dimension);
                    let products = (0..dimension).map(|axis| {
                        let place = axis * dimension + column;
                        let deformation = gradient[place].clone() + identity(place);
                        rotation[row * dimension + axis].clone() * deformation
                    });
                    products.fold(-identity(k), |sum, product| sum + product)
                })
                .collect();
            let energy = |gradient| response(compiled, Response::StrainEnergy, gradient).remove(0);
            let (before, after) = (energy(&gradient), energy(&rotated));
            if spec.frame_indifferent {
                assert_close(spec.name.raw(), &before, &after, EXACT);
            } else {
                let difference = (before - after).magnitude();
                assert!(precise(0.1).at_most(&difference), "{} does not notice", spec.name.shown());
            }
        }
    }
    let others = specs().into_iter().filter(|spec| !spec.frame_indifferent);
    assert_eq!(others.map(|spec| spec.name.shown()).collect::<Vec<_>>(), ["linear_elastic"]);
}

/// A fluid has no transverse waves, but is accepted as a material.
#[test]
fn a_fluid_is_a_material() {
    for dimension in 1..=3 {
        let fluid = field(dimension, "neo_hookean", "lambda = 1\nmu = 0");
        let rest = vec![precise(0.0); dimension * dimension];
        let speed = response(&fluid, Response::WaveSpeed, &rest).remove(0);
        assert_eq!(speed.to_f64(), (1.0_f64 / 2.25).sqrt());
    }
}

/// Whether a given pressure has to balance the stress at rest.
fn is_pressed(spec: &MaterialSpec) -> bool {
    spec.name.raw() == "neo_hookean_mixed"
}

#[test]
fn the_undeformed_body_is_free_of_stress_and_of_energy() {
    for (spec, compiled) in RESTING.iter().filter(|(spec, _)| !is_pressed(spec)) {
        let dimension = compiled.field.dimension;
        let rest = vec![precise(0.0); dimension * dimension];
        for wanted in
            [Response::FirstPiolaKirchhoff, Response::KirchhoffStress, Response::StrainEnergy]
        {
            for component in response(compiled, wanted, &rest) {
                assert_close(spec.name.raw(), &component, &rest[0], EXACT);
            }
        }
    }
}

/// The eigenvalues of the acoustic tensor Q_ik = A_iJkL n_J n_L at F = I, over directions in the
/// body: rho0 c^2 of every wave.
#[test]
fn no_wave_is_faster_than_the_wave_speed() {
    for (spec, compiled) in RESTING.iter() {
        let dimension = compiled.field.dimension;
        let rest = vec![precise(0.0); dimension * dimension];
        let speed = response(compiled, Response::WaveSpeed, &rest).remove(0);
        let density = response(compiled, Response::Density, &rest).remove(0);
        let bound = (density * speed.clone() * speed.clone()).to_f64();
        assert!(speed.to_f64() > 0.0, "{}: {:e}", spec.name.shown(), speed.to_f64());
        let tangent: Vec<f64> = tangent(compiled, &rest).iter().map(Precise::to_f64).collect();
        let mut largest: f64 = 0.0;
        for index in 2..200 {
            let normal: Vec<f64> = halton::<f64>(index).into_iter().map(|x| x - 0.5).collect();
            let acoustic = acoustic(&tangent, &normal[..dimension]);
            assert!(positive(&acoustic, dimension), "{}: {acoustic:?}", spec.name.shown());
            largest = largest.max(greatest_eigenvalue(&acoustic, dimension));
        }
        assert!(largest <= bound * (1.0 + 1e-12), "{}: {largest} {bound}", spec.name.shown());
        // If the fibres leave the plane, no direction in it is theirs.
        if !spec.has_fibres() {
            assert!(largest > bound * 0.999, "{}: {largest} {bound}", spec.name.shown());
        }
    }
}

fn acoustic(tangent: &[f64], normal: &[f64]) -> Vec<f64> {
    let dimension = normal.len();
    let square: f64 = normal.iter().map(|component| component * component).sum();
    let index = |i: usize, j: usize, k: usize, l: usize| {
        ((i * dimension + j) * dimension + k) * dimension + l
    };
    let entry = |i: usize, k: usize| -> f64 {
        let pairs = (0..dimension).flat_map(|j| (0..dimension).map(move |l| (j, l)));
        pairs.map(|(j, l)| tangent[index(i, j, k, l)] * normal[j] * normal[l] / square).sum()
    };
    (0..dimension * dimension).map(|k| entry(k / dimension, k % dimension)).collect()
}

/// Whether a symmetric matrix is positive definite, by its leading minors.
fn positive(matrix: &[f64], dimension: usize) -> bool {
    let at = |row: usize, column: usize| matrix[row * dimension + column];
    let two = |a: usize, b: usize| at(0, a) * at(1, b) - at(0, b) * at(1, a);
    let minors = match dimension {
        1 => vec![at(0, 0)],
        2 => vec![at(0, 0), two(0, 1)],
        _ => {
            let three = at(2, 2) * two(0, 1) - at(2, 1) * two(0, 2) + at(2, 0) * two(1, 2);
            vec![at(0, 0), two(0, 1), three]
        }
    };
    minors.into_iter().all(|minor| minor > 0.0)
}

/// The greatest eigenvalue, by powers of the matrix.
fn greatest_eigenvalue(matrix: &[f64], dimension: usize) -> f64 {
    let mut vector = vec![1.0, 0.7, 0.3];
    vector.truncate(dimension);
    let mut length = 0.0;
    for _ in 0..200 {
        let image: Vec<f64> = (0..dimension)
            .map(|row| (0..dimension).map(|k| matrix[row * dimension + k] * vector[k]).sum())
            .collect();
        length = image.iter().map(|x| x * x).sum::<f64>().sqrt();
        vector = image.into_iter().map(|x| x / length).collect();
    }
    length
}

/// Compares Div P with central differences of P in a field of that material.
fn momentum_balances(name: &str, compiled: &Compiled) {
    let dimension = compiled.field.dimension;
    let step = precise(1e-20);
    for sample in samples::<Precise>(&compiled.program, &[], 3) {
        let of = |quantity: Quantity, at: &[Precise]| {
            let mut interpreter = Interpreter::new(&compiled.program, &[]);
            interpreter.set_time(&sample.time);
            let plan = interpreter.plan(&[Output::Quantity(quantity)]);
            interpreter.set_point(&plan, Point::at(at));
            interpreter.output(Output::Quantity(quantity))
        };
        let at = &sample.coordinates;
        let mut differences = vec![precise(0.0); dimension];
        for axis in 0..dimension {
            let shifted = |step: Precise| {
                let mut shifted = at.clone();
                shifted[axis] = shifted[axis].clone() + step;
                of(Quantity::FirstPiolaKirchhoff, &shifted)
            };
            let (ahead, behind) = (shifted(step.clone()), shifted(-step.clone()));
            for (row, sum) in differences.iter_mut().enumerate() {
                let k = row * dimension + axis;
                let rise = ahead[k].clone() - behind[k].clone();
                *sum = sum.clone() + rise / (step.clone() * precise(2.0));
            }
        }
        // The differences err by step^2 times a third derivative: 40 digits less a few.
        for (found, expected) in of(Quantity::DivP, at).iter().zip(&differences) {
            assert_close(name, found, expected, 1e-30);
        }
    }
}

#[test]
fn the_divergence_is_that_of_the_stress() {
    let specs = specs();
    let all = specs.iter().flat_map(|spec| (1..=3).map(move |dimension| (spec, dimension)));
    for (spec, dimension) in sampled(all, 3) {
        let name = spec.name.raw();
        momentum_balances(name, &moving(dimension, name, &arguments(spec, GIVEN)));
    }
}

/// Compares with tau = lambda ln J I + mu (B - I), typed by hand.
#[test]
fn neo_hookean_is_what_is_on_paper() {
    let compiled = field(3, "neo_hookean", "lambda = 5\nmu = 3");
    for gradient in gradients(3) {
        let identity = |i: usize, j: usize| precise(f64::from(u8::from(i == j)));
        let at = |i: usize, j: usize| gradient[3 * i + j].clone() + identity(i, j);
        let cofactor = |i: usize| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            at(1, j) * at(2, k) - at(1, k) * at(2, j)
        };
        let jacobian = at(0, 0) * cofactor(0) + at(0, 1) * cofactor(1) + at(0, 2) * cofactor(2);
        let kirchhoff = response(&compiled, Response::KirchhoffStress, &gradient);
        for (k, found) in kirchhoff.iter().enumerate() {
            let (i, j) = (k / 3, k % 3);
            let left = at(i, 0) * at(j, 0) + at(i, 1) * at(j, 1) + at(i, 2) * at(j, 2);
            let pressure = precise(5.0) * jacobian.clone().ln() * identity(i, j);
            let expected = pressure + precise(3.0) * (left - identity(i, j));
            assert_close("tau", found, &expected, EXACT);
        }
    }
}

/// A strain as small as rounding costs no digits of the stress.
#[test]
fn small_strains_lose_nothing() {
    for (spec, compiled) in FIELDS.iter() {
        for gradient in gradients(compiled.field.dimension) {
            let small: Vec<f64> =
                gradient.iter().map(|component| component.to_f64() * 1e-10).collect();
            let exact: Vec<Precise> = small.iter().map(|component| precise(*component)).collect();
            for wanted in [Response::FirstPiolaKirchhoff, Response::KirchhoffStress] {
                let expected = response(compiled, wanted, &exact);
                let found = response(compiled, wanted, &small);
                let largest = expected.iter().fold(0.0, |a: f64, b| a.max(b.to_f64().abs()));
                for (found, expected) in found.iter().zip(&expected) {
                    let error = (found - expected.to_f64()).abs();
                    let bound = 64.0 * f64::EPSILON * largest;
                    assert!(error <= bound, "{}: {error:e}, {bound:e}", spec.name.shown());
                }
            }
        }
    }
}

/// Three pairs of moduli of one solid: lambda = 2, mu = 3/2, graded like 1 + X.
const PAIRS: [&str; 3] = [
    "lambda = \"2*(1 + X)\"\nmu = \"3/2*(1 + X)\"",
    "young = \"27/7*(1 + X)\"\nnu = \"2/7\"",
    "kappa = \"3*(1 + X)\"\nmu = \"3/2*(1 + X)\"",
];

#[test]
fn any_pair_of_moduli_gives_the_same_solid() {
    for spec in specs() {
        let Some((own, _)) = mms_spec::moduli::pairs(&spec) else { continue };
        let is_other = |line: &&str| !own.iter().any(|name| line.starts_with(name));
        let all = arguments(&spec, "1/3 + X/5");
        let others: Vec<&str> = all.lines().filter(is_other).collect();
        let arguments = PAIRS.map(|pair| format!("{pair}\n{}", others.join("\n")));
        let fields = arguments.each_ref().map(|it| field(2, spec.name.raw(), it));
        for gradient in gradients(2) {
            let [lame, engineering, bulk] =
                fields.each_ref().map(|it| response(it, Response::FirstPiolaKirchhoff, &gradient));
            for ((a, b), c) in lame.iter().zip(&engineering).zip(&bulk) {
                assert_close(spec.name.raw(), a, b, EXACT);
                assert_close(spec.name.raw(), a, c, EXACT);
            }
        }
        for arguments in sampled(&arguments, 3) {
            momentum_balances(spec.name.raw(), &moving(2, spec.name.raw(), arguments));
        }
    }
}

/// Young's modulus and Poisson's ratio that both change from place to place.
#[test]
fn the_divergence_has_the_gradient_of_the_moduli() {
    let graded = "young = \"2 + sin(X*Y)\"\nnu = \"(1 + X)/6\"";
    let compiled = moving(2, "neo_hookean", graded);
    momentum_balances("graded", &compiled);
    let names: Vec<_> =
        compiled.material.parameters.iter().map(|it| it.name.value.as_str()).collect();
    assert_eq!(names, ["young", "nu"]);
}

/// Poisson's ratio 2/7 is (3 kappa - 2 mu)/(2 (3 kappa + mu)) of the same solid.
#[test]
fn the_moduli_of_the_tests_are_those_of_one_solid() {
    let ratio = |n: i32, d: i32| Rational::from_parts(n.into(), (d as u32).into());
    let (lambda, mu) = (ratio(2, 1), ratio(3, 2));
    let kappa = lambda.clone() + mu.clone() * ratio(2, 3);
    let nu = lambda.clone() / ((lambda + mu.clone()) * ratio(2, 1));
    let young = mu * ratio(2, 1) * (ratio(1, 1) + nu.clone());
    assert_eq!((kappa, nu, young), (ratio(3, 1), ratio(2, 7), ratio(27, 7)));
}

#[test]
fn no_shipped_material_has_a_stress_at_rest() {
    for (spec, compiled) in FIELDS.iter() {
        let (found, name) = (rest::stress(compiled), spec.name.shown());
        match is_pressed(spec) {
            false => assert_eq!(found, Rest::Free, "{name} in {}", compiled.field.dimension),
            true => match found {
                Rest::Pressed(stress, names) => {
                    let is_spherical = |(k, it): (usize, &f64)| {
                        (*it == 0.0) != k.is_multiple_of(compiled.field.dimension + 1)
                    };
                    assert!(stress.iter().enumerate().all(is_spherical), "{name}: {stress:?}");
                    assert_eq!(names, ["p"]);
                }
                other => panic!("{name}: {other:?}"),
            },
        }
    }
}
