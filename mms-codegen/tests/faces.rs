//! The data on the faces of a body: normals by geometry, u and P N by the quantities.

use mms_codegen::{Compiled, compile};
use mms_math::Scalar as _;
use mms_mechanics::boundary::Datum;
use mms_mechanics::extent::halton;
use mms_mechanics::sample::Sample;
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Number as _, Point};
use mms_program::precise::Precise;
use mms_spec::Face;
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::Rational;

const BLOCK: &str = r#"
shape = "box"
lower = [-1, "1/3"]
upper = [2, 1]
time  = [0, 1]
[boundary]
x_min = "traction"
x_max = "prescribed"
y_min = "traction"
"#;

const SECTOR: &str = r#"
shape = "annulus"
inner = 1
outer = 2
theta = ["pi/7", "2"]
time  = [0, 1]
[boundary]
inner     = "traction"
outer     = "traction"
theta_min = "traction"
theta_max = "traction"
"#;

fn field(domain: &str) -> Compiled {
    let text = format!(
        "[field]\ntitle = \"x\"\ndimension = 2\n[displacement]\n\
         u = [\"sin(X + 2*Y)*t/9\", \"X*Y^2*t^2/40\"]\n\
         [material]\nmodel = \"neo_hookean\"\nlambda = \"2 + X\"\nmu = 1\ndensity = 1\n\
         [domain]{domain}"
    );
    compile("x", "x.toml", &text, &|path| Err(path.into())).unwrap_or_else(|it| panic!("{it}"))
}

fn number(value: f64) -> Precise {
    Precise::from_f64(value)
}

fn value(
    program: &Program,
    output: Output,
    at: &Sample<Precise>,
    normal: &[Precise],
) -> Vec<Precise> {
    let mut interpreter = Interpreter::new(program, &[]);
    interpreter.set_time(&at.time);
    let plan = interpreter.plan(&[output]);
    interpreter.set_point(&plan, Point { coordinates: &at.coordinates, normal, gradient: &[] });
    interpreter.output(output)
}

#[track_caller]
fn assert_agree(found: &[Precise], expected: &[Precise]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        let difference = (found.clone() - expected.clone()).magnitude();
        let close = difference.at_most(&number(1e-60));
        assert!(close, "{:e} and {:e}", found.to_f64(), expected.to_f64());
    }
}

/// Points of a face, with the normal there, by geometry.
fn on_block(face: Face) -> Vec<(Sample<Precise>, Vec<Precise>)> {
    let third = Precise::from_rational(&Rational::from_parts(1.into(), 3u8.into()));
    let halton = (1..5).map(halton::<Precise>);
    let placed = halton.map(|[s, _, _, time]| {
        let (coordinates, normal) = match face {
            Face::Min(0) => (vec![number(-1.0), s], [-1.0, 0.0]),
            Face::Max(0) => (vec![number(2.0), s], [1.0, 0.0]),
            Face::Min(_) => (vec![s, third.clone()], [0.0, -1.0]),
            _ => (vec![s, number(1.0)], [0.0, 1.0]),
        };
        (Sample { coordinates, time }, normal.map(number).to_vec())
    });
    placed.collect()
}

fn on_sector(face: Face) -> Vec<(Sample<Precise>, Vec<Precise>)> {
    let first = Precise::pi() / number(7.0);
    let halton = (1..5).map(halton::<Precise>);
    let placed = halton.map(|[s, _, _, time]| {
        let (radius, angle) = match face {
            Face::Inner => (number(1.0), first.clone() + s),
            Face::Outer => (number(2.0), first.clone() + s),
            Face::ThetaMin => (number(1.0) + s, first.clone()),
            _ => (number(1.0) + s, number(2.0)),
        };
        let (sine, cosine) = (angle.clone().sin(), angle.cos());
        let coordinates = vec![radius.clone() * cosine.clone(), radius * sine.clone()];
        let normal = match face {
            Face::Inner => vec![-cosine, -sine],
            Face::Outer => vec![cosine, sine],
            Face::ThetaMin => vec![sine, -cosine],
            _ => vec![-sine, cosine],
        };
        (Sample { coordinates, time }, normal)
    });
    placed.collect()
}

fn given(compiled: &Compiled) -> Vec<(Face, Datum)> {
    let outputs = compiled.program.outputs.keys();
    let given = outputs.filter_map(|output| match output {
        Output::Face(face, datum) => Some((*face, *datum)),
        _ => None,
    });
    given.collect()
}

type Placed = fn(Face) -> Vec<(Sample<Precise>, Vec<Precise>)>;

fn assert_given(compiled: &Compiled, placed: Placed) {
    let program = &compiled.program;
    for (face, datum) in given(compiled) {
        for (at, normal) in placed(face) {
            let found = value(program, Output::Face(face, datum), &at, &[]);
            let expected = match datum {
                Datum::Normal => normal,
                Datum::Displacement => {
                    value(program, Output::Quantity(Quantity::Displacement), &at, &[])
                }
                Datum::Traction => {
                    value(program, Output::Quantity(Quantity::Traction), &at, &normal)
                }
            };
            assert_agree(&found, &expected);
        }
    }
}

/// A face that claims u, and one that claims nothing, get u as data.
#[test]
fn each_face_of_a_box_has_what_its_claim_calls_for() {
    use Datum::{Displacement, Normal, Traction};
    let block = field(BLOCK);
    let expected = [
        (Face::Min(0), Normal),
        (Face::Min(0), Traction),
        (Face::Min(1), Normal),
        (Face::Min(1), Traction),
        (Face::Max(0), Displacement),
        (Face::Max(1), Displacement),
    ];
    assert_eq!(given(&block), expected);
    assert_given(&block, on_block);
}

#[test]
fn each_face_of_a_sector_has_its_own_normal() {
    let sector = field(SECTOR);
    assert_eq!(given(&sector).len(), 8);
    assert_given(&sector, on_sector);
}

/// The data on a face of a box do not read the coordinate that is constant there.
#[test]
fn what_is_given_on_a_box_ignores_the_constant_coordinate() {
    let block = field(BLOCK);
    let output = Output::Face(Face::Min(0), Datum::Traction);
    let at = |x: f64| Sample { coordinates: vec![number(x), number(0.5)], time: number(0.5) };
    let program = &block.program;
    assert_agree(&value(program, output, &at(-1.0), &[]), &value(program, output, &at(7.0), &[]));
}
