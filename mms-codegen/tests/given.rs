//! Given fields and the quantities of further balances, against central differences in 77 digits and numbers from paper.

use std::fs;
use std::path::Path;

use mms_codegen::certify::rest::{self, Rest};
use mms_codegen::{Compiled, compile};
use mms_math::Scalar as _;
use mms_mechanics::{Output, Response};
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;

/// Displacements in which no derivative vanishes, of every dimension.
const DISPLACEMENTS: [&str; 3] = [
    "[\"0.2*sin(X + t)*exp(X/2)\"]",
    "[\"0.1*sin(2*X + Y)*cos(t)\", \"0.2*X*Y^2*sin(t + X)\"]",
    "[\"0.1*sin(X*Y + Z)*cos(t)\", \"0.1*X*Z^2*sin(t + Y)\", \"0.1*exp(X - Y)*cos(Z + t)\"]",
];

/// Half the distance between the points of a difference: the error is proportional to its square.
const STEP: f64 = 1e-20;
const CLOSE: f64 = 1e-30;

fn text(dimension: usize, tables: &str) -> String {
    let corner = |value: &str| vec![value; dimension].join(", ");
    format!(
        "[field]\ntitle = \"a field\"\ndimension = {dimension}\n[displacement]\nu = {}\n{tables}\n[domain]\n\
         shape = \"box\"\nlower = [{}]\nupper = [{}]\ntime = [0, 1]\n",
        DISPLACEMENTS[dimension - 1],
        corner("0.25"),
        corner("1"),
    )
}

fn compiled(text: &str) -> Compiled {
    let load = |_: &str| Err("only shipped materials".to_string());
    compile("field", "field.toml", text, &load).unwrap_or_else(|failure| panic!("{failure}"))
}

const SOLID: &str = "[material]\nmodel = \"neo_hookean\"\nlambda = 3\nmu = 2\ndensity = 2\n";

fn precise(value: f64) -> Precise {
    Precise::from_f64(value)
}

/// A quantity at a place and a time; quantities that need a normal read `normal`.
fn value(compiled: &Compiled, name: &str, time: &Precise, at: &[Precise]) -> Vec<Precise> {
    let quantity = compiled.quantity(name).expect("a quantity");
    let parameters = compiled.parameters(&Default::default());
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let output = Output::Quantity(quantity);
    interpreter.set_time(time);
    let normal = [0.6, 0.8, 0.0].map(precise);
    let plan = interpreter.plan(&[output]);
    let point =
        Point { coordinates: at, normal: &normal[..compiled.field.dimension], gradient: &[] };
    interpreter.set_point(&plan, point);
    interpreter.output(output)
}

/// The derivative of a quantity by a coordinate, or by the time.
fn slope(compiled: &Compiled, name: &str, at: &[Precise], axis: Option<usize>) -> Vec<Precise> {
    let [ahead, behind] = [STEP, -STEP].map(|step| {
        let (mut time, mut place) = (precise(0.375), at.to_vec());
        match axis {
            Some(axis) => place[axis] = place[axis].clone() + precise(step),
            None => time = time + precise(step),
        }
        value(compiled, name, &time, &place)
    });
    let pairs = ahead.into_iter().zip(behind);
    pairs.map(|(ahead, behind)| (ahead - behind) / precise(2.0 * STEP)).collect()
}

fn place(dimension: usize) -> Vec<Precise> {
    [0.5, 0.625, 0.75][..dimension].iter().map(|it| precise(*it)).collect()
}

#[track_caller]
fn assert_close(what: &str, found: &[Precise], expected: &[Precise]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (found, expected) in found.iter().zip(expected) {
        let difference = (found.clone() - expected.clone()).magnitude();
        let (found, expected) = (found.to_f64(), expected.to_f64());
        assert!(difference.at_most(&precise(CLOSE)), "{what}: {found:e}, {expected:e}");
    }
}

fn sum(values: impl IntoIterator<Item = Precise>) -> Precise {
    values.into_iter().fold(precise(0.0), |sum, value| sum + value)
}

/// The body force of the case, derived with SymPy and mpmath independently of this project.
#[test]
fn the_body_force_of_a_given_pressure_is_that_on_paper() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/given");
    let read = |name: &str| fs::read_to_string(folder.join(name)).map_err(|it| it.to_string());
    let text = read("incompressible_field.toml").expect("the case");
    let compiled = compile("case", "case.toml", &text, &|material: &str| read(material))
        .unwrap_or_else(|failure| panic!("{failure}"));
    let parameters = compiled.parameters::<f64>(&Default::default());
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let output = Output::Quantity(Quantity::BodyForce);
    interpreter.set_time(&0.02);
    let plan = interpreter.plan(&[output]);
    interpreter.set_point(&plan, Point::at(&[0.3, 0.2]));
    let expected = [134.34159506128735, -93.2000881011068];
    for (found, expected) in interpreter.output(output).iter().zip(expected) {
        assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "{found:e}");
    }
}

#[test]
fn gradients_and_rates_are_those_of_the_given_fields() {
    for dimension in 1..=3 {
        let compiled = compiled(&text(
            dimension,
            "[let]\ng = \"exp(X/2)*cos(t)\"\n[given]\nT = { value = \"3 + g*X^2*sin(t)\" }\n\
             [material]\nmodel = \"poroelastic\"\nlambda = 3\nmu = 2\nbiot = \"1/2\"\np = \"T*X/9\"\ndensity = 2\n",
        ));
        let at = place(dimension);
        for name in ["T", "p"] {
            let of = |part: &str| value(&compiled, &format!("{name}{part}"), &precise(0.375), &at);
            let slopes = (0..dimension).map(|axis| slope(&compiled, name, &at, Some(axis)));
            assert_close(name, &of("_gradient"), &slopes.flatten().collect::<Vec<_>>());
            assert_close(name, &of("_rate"), &slope(&compiled, name, &at, None));
        }
        let stress = |axis| slope(&compiled, "P", &at, Some(axis));
        let slopes: Vec<_> = (0..dimension).map(stress).collect();
        let row = |i: usize| sum((0..dimension).map(|j| slopes[j][i * dimension + j].clone()));
        let divergence: Vec<_> = (0..dimension).map(row).collect();
        assert_close("Div P", &value(&compiled, "div_p", &precise(0.375), &at), &divergence);
    }
}

#[test]
fn the_source_of_a_balance_is_the_rate_of_its_storage_and_the_divergence_of_its_flux() {
    for dimension in 1..=3 {
        let axes = &["X", "Y", "Z"][..dimension];
        let row = |i: usize| {
            let term = |j: usize| {
                let (a, b) = (i.min(j) + 1, i.max(j) + 1);
                format!("Cinv{a}{b}*T_{}", axes[j])
            };
            let terms: Vec<_> = (0..dimension).map(term).collect();
            format!("\"-k*J*({}) + v_x*T\"", terms.join(" + "))
        };
        let flux: Vec<_> = (0..dimension).map(row).collect();
        let compiled = compiled(&text(
            dimension,
            &format!(
                "[parameters]\nk = {{ value = 0.7 }}\n[given]\nT = {{ value = \"3 + X^2*sin(t + X)\" }}\n{SOLID}\
                 [[balance]]\nname = \"heat\"\nstorage = \"2*J*T + T_t*u_x\"\nflux = [{}]\n\
                 [[balance]]\nname = \"heat\"\nresidual = \"2*J*T + T_t*u_x\"\n",
                flux.join(", ")
            ),
        ));
        let at = place(dimension);
        let rate = slope(&compiled, "heat_residual", &at, None).remove(0);
        let slopes = (0..dimension)
            .map(|axis| slope(&compiled, "heat_flux", &at, Some(axis)).swap_remove(axis));
        let source = sum(slopes.chain([rate]));
        let of = |name: &str| value(&compiled, name, &precise(0.375), &at);
        assert_close("source", &of("heat_source"), &[source]);
        let flux = of("heat_flux");
        let normal = [0.6, 0.8, 0.0].map(precise);
        let outward = sum(flux.iter().zip(&normal).map(|(q, n)| q.clone() * n.clone()));
        assert_close("normal flux", &of("heat_normal_flux"), &[outward]);
    }
}

/// Compares every name of the language of balances, as the residual of a constraint, with the quantities of the field.
#[test]
fn the_names_of_balances_are_the_motion() {
    let rigid = "[rigid]\nrotation = \"t^2 + 1/3\"\ntranslation = [\"t/5\", \"t^2\"]\n";
    for (dimension, rigid) in [(1, ""), (2, ""), (2, rigid), (3, "")] {
        let mut names = vec!["J".to_string()];
        for (row, column) in (1..=3).flat_map(|row| (1..=3).map(move |column| (row, column))) {
            names.extend(["H", "F", "Finv", "C", "Cinv"].map(|it| format!("{it}{row}{column}")));
        }
        for axis in &["x", "y", "z"][..dimension] {
            names.extend([format!("u_{axis}"), format!("v_{axis}")]);
        }
        let constraint =
            |name: &String| format!("[[balance]]\nname = \"of_{name}\"\nresidual = \"{name}\"\n");
        let constraints: String = names.iter().map(constraint).collect();
        let compiled = compiled(&text(dimension, &format!("{SOLID}{constraints}{rigid}")));
        let at = place(dimension);
        let of = |name: &str| value(&compiled, name, &precise(0.375), &at);
        let named = |name: &str| of(&format!("of_{name}_residual")).remove(0);
        let unit = |i: usize, j: usize| precise(f64::from(u8::from(i == j)));
        let [h, c] = ["H", "C"].map(of);
        let padded = |of: &[Precise], i: usize, j: usize, beyond: Precise| {
            if i.max(j) < dimension { of[i * dimension + j].clone() } else { beyond }
        };
        let entry =
            |letters: &str, i: usize, j: usize| named(&format!("{letters}{}{}", i + 1, j + 1));
        for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
            let gradient = padded(&h, i, j, precise(0.0));
            assert_close("H", &[entry("H", i, j)], std::slice::from_ref(&gradient));
            assert_close("F", &[entry("F", i, j)], &[gradient + unit(i, j)]);
            assert_close("C", &[entry("C", i, j)], &[padded(&c, i, j, unit(i, j))]);
            for (letters, inverse) in [("F", "Finv"), ("C", "Cinv")] {
                let product = (0..3).map(|k| entry(letters, i, k) * entry(inverse, k, j));
                assert_close(inverse, &[sum(product)], &[unit(i, j)]);
            }
        }
        assert_close("J", &[named("J")], &of("J"));
        let vector = |letter: &str| -> Vec<Precise> {
            let axes = &["x", "y", "z"][..dimension];
            axes.iter().map(|axis| named(&format!("{letter}_{axis}"))).collect()
        };
        assert_close("u", &vector("u"), &of("u"));
        assert_close("v", &vector("v"), &of("v"));
    }
}

/// The wave speed is the one at rest for any pressure; the judged stress, too.
#[test]
fn the_material_is_judged_with_given_fields_at_rest() {
    let of = |p: &str| {
        compiled(&text(
            2,
            &format!(
                "[material]\nmodel = \"poroelastic\"\nlambda = 3\nmu = 2\nbiot = 1\np = \"{p}\"\ndensity = 2\n"
            ),
        ))
    };
    let [none, some] = ["0", "1/3 + X*t"].map(of);
    let speed = |compiled: &Compiled| {
        let mut interpreter = Interpreter::<f64, _>::new(&compiled.program, &[]);
        let output = Output::Response(Response::WaveSpeed);
        let plan = interpreter.plan(&[output]);
        interpreter.set_time(&0.5);
        interpreter.set_point(&plan, Point::at(&[0.5, 0.5]));
        interpreter.output(output)
    };
    assert_eq!(speed(&none), speed(&some));
    assert_eq!(rest::stress(&some), Rest::Free);
    let stress = |compiled| value(compiled, "P", &precise(0.375), &place(2))[0].to_f64();
    assert!((stress(&none) - stress(&some)).abs() > 0.1);
}

/// A static field has no rates, and its balances no change of storage.
#[test]
fn a_static_field_has_given_fields_without_rates() {
    let text = "[field]\ntitle = \"a field\"\ndimension = 1\n[given]\nT = { value = \"X^2\" }\n[displacement]\n\
                u = [\"X^2/9\"]\n[material]\nmodel = \"neo_hookean\"\nlambda = 3\nmu = 2\n[[balance]]\n\
                name = \"heat\"\nstorage = \"T\"\nflux = [\"-T_X\"]\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\n";
    let compiled = compiled(text);
    assert!(compiled.quantity("T_rate").is_err());
    let source = value(&compiled, "heat_source", &precise(0.0), &place(1));
    assert_close("source", &source, &[precise(-2.0)]);
}
