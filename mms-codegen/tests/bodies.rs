//! Bodies of every shape: claims on their faces are proved or refuted, J > 0 is proved over exactly the body, and the data on
//! faces agree with geometry and the quantities.

use mms_codegen::certify::certificate::{Certificate, certify};
use mms_codegen::certify::claims::ClaimVerdict;
use mms_codegen::certify::sign::Sign;
use mms_codegen::compile::Failure;
use mms_codegen::{Compiled, compile};
use mms_math::Scalar as _;
use mms_mechanics::Output;
use mms_mechanics::boundary::Datum;
use mms_mechanics::extent::halton;
use mms_mechanics::sample::{domain, samples};
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;
use mms_spec::{Claim, Face};

use crate::sampled::sampled;

/// A file of a displacement and a `[domain]` followed by `rest`.
fn file(dimension: usize, lets: &str, u: &str, rest: &str) -> String {
    format!(
        "[field]\ntitle = \"x\"\ndimension = {dimension}\n[let]\n{lets}\n[displacement]\nu = [{u}]\n\
         [material]\nmodel = \"neo_hookean\"\nlambda = 2\nmu = 1\ndensity = 1\n\
         [domain]\ntime = [0, 1]\n{rest}"
    )
}

fn try_compile(text: &str) -> Result<Compiled, Failure> {
    compile("x", "x.toml", text, &|path| Err(path.into()))
}

fn compiled(text: &str) -> Compiled {
    try_compile(text).unwrap_or_else(|failure| panic!("{failure}"))
}

/// Asserts that J > 0 and every claim is proved, and that there is no objection.
fn assert_proved(text: &str) -> Certificate {
    let compiled = compiled(text);
    let certificate = certify(&compiled);
    for (claim, finding) in &certificate.claims {
        assert_eq!(
            *finding,
            ClaimVerdict::Proved,
            "{}: {}\n{text}",
            claim.face.value.name(),
            claim.claim.value.name()
        );
    }
    assert!(
        matches!(certificate.jacobian, Sign::Positive(_)),
        "{:?}\n{text}",
        certificate.jacobian
    );
    let objections = certificate.objections(&compiled);
    assert!(objections.is_empty(), "{objections:?}\n{text}");
    certificate
}

/// A motion along the radius, which is 0 at R = 1 and at R = 2.
const RADIAL: &str = "U = \"t*sin(pi*(R - 1))/20\"";

fn radial(among: usize) -> (String, String) {
    let square = ["X^2", "Y^2", "Z^2"][..among].join(" + ");
    let lets = format!("R = \"sqrt({square})\"\n{RADIAL}");
    let along = |axis: &str| format!("\"U*{axis}/R\"");
    let third = if among == 3 { along("Z") } else { "0".into() };
    (lets, [along("X"), along("Y"), third].join(", "))
}

#[test]
fn claims_on_a_cylinder_are_proved() {
    let (lets, u) = radial(2);
    let body = "shape = \"cylinder\"\ninner = 1\nouter = 2\nz = [0, \"1/2\"]\n";
    let ends = "z_min = \"roller\"\nz_max = \"roller\"\n";
    let whole = format!("{body}[boundary]\ninner = \"fixed\"\nouter = \"roller\"\n{ends}");
    assert_proved(&file(3, &lets, &u, &whole));
    let sector = format!(
        "{body}theta = [\"pi/6\", \"3*pi/4\"]\n[boundary]\ninner = \"prescribed\"\nouter = \"traction\"\n\
         theta_min = \"roller\"\ntheta_max = \"roller\"\n{ends}"
    );
    assert_proved(&file(3, &lets, &u, &sector));
}

#[test]
fn claims_on_a_sphere_are_proved() {
    let (lets, u) = radial(3);
    let body = "shape = \"sphere\"\ninner = 1\nouter = 2\n";
    let whole = format!("{body}[boundary]\ninner = \"fixed\"\nouter = \"roller\"\n");
    assert_proved(&file(3, &lets, &u, &whole));
    let part = format!(
        "{body}theta = [\"pi/6\", \"3*pi/4\"]\nphi = [\"pi/5\", \"2*pi/3\"]\n[boundary]\n\
         inner = \"fixed\"\nouter = \"traction\"\ntheta_min = \"roller\"\ntheta_max = \"roller\"\n\
         phi_min = \"roller\"\nphi_max = \"roller\"\n"
    );
    assert_proved(&file(3, &lets, &u, &part));
}

/// A uniform expansion plus a shape, for bodies whose charts meet in a point or in a line.
#[test]
fn bodies_with_an_axis_or_a_centre_are_proved() {
    let plane = "\"t*X/10 + t*X*Y/20\", \"t*Y/10\"";
    let space = "\"t*X/10 + t*X*Y/20\", \"t*Y/10\", \"t*Z/10\"";
    let bounds = |certificate: &Certificate| match certificate.jacobian {
        Sign::Positive(bounds) => bounds,
        _ => unreachable!("it was proved"),
    };
    let disk = assert_proved(&file(2, "", plane, "shape = \"disk\"\nouter = 1\n"));
    // J = (1 + t/10 + t Y/20) (1 + t/10), least and greatest on the rim.
    let [lower, upper] = bounds(&disk);
    assert!(0.9 < lower && lower <= 1.0 && (1.265..1.5).contains(&upper), "{lower}, {upper}");
    let bodies = [
        "shape = \"cylinder\"\ninner = 0\nouter = 1\nz = [-1, 1]\n",
        "shape = \"sphere\"\ninner = 0\nouter = 1\n",
        "shape = \"sphere\"\ninner = 0\nouter = 1\ntheta = [0, \"pi/2\"]\nphi = [0, \"pi/2\"]\n",
    ];
    for body in sampled(bodies, 2) {
        let [lower, upper] = bounds(&assert_proved(&file(3, "", space, body)));
        assert!(0.9 < lower && lower <= 1.0 && (1.3915..1.6).contains(&upper), "{lower}, {upper}");
    }
}

#[test]
fn claims_on_edges_of_polygons_are_proved() {
    let u = "\"t*X*Y*(1 - X - Y)/4\", \"t*X*Y*(1 - X - Y)/5\"";
    for vertices in ["[[0, 0], [1, 0], [0, 1]]", "[[0, 1], [1, 0], [0, 0]]"] {
        let edges = "edge_1 = \"fixed\"\nedge_2 = \"fixed\"\nedge_3 = \"fixed\"\n";
        let rest = format!("shape = \"polygon\"\nvertices = {vertices}\n[boundary]\n{edges}");
        assert_proved(&file(2, "", u, &rest));
    }
}

/// J is negative in the square that a corner leaves out, which every box around the body contains.
#[test]
fn a_polygon_is_proved_over_itself_alone() {
    let u = "\"-t*X^2*Y^2/10\", \"0\"";
    let vertices = "[[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]";
    let names = "names = [\"floor\", \"step\", \"ledge\", \"wall\", \"top\", \"back\"]";
    let rest = format!(
        "shape = \"polygon\"\nvertices = {vertices}\n{names}\n[boundary]\nfloor = \"fixed\"\nback = \"fixed\"\n"
    );
    let certificate = assert_proved(&file(2, "", u, &rest));
    // J = 1 - t X Y^2/5, least in (1, 2).
    let Sign::Positive([lower, _]) = certificate.jacobian else { unreachable!("it was proved") };
    assert!(0.1 < lower && lower <= 0.2, "{lower}");
    let whole = "shape = \"polygon\"\nvertices = [[0, 0], [2, 0], [2, 2], [0, 2]]\n";
    let refuted = try_compile(&file(2, "", u, whole)).expect_err("J < 0 in (2, 2)");
    assert!(refuted.to_string().contains("J"), "{refuted}");
}

#[test]
fn false_claims_on_curved_faces_are_refuted_there() {
    let (lets, u) = radial(3);
    let cases = [
        ("shape = \"sphere\"\ninner = 1\nouter = \"3/2\"\n[boundary]\nouter = \"fixed\"\n", 1.5),
        ("shape = \"sphere\"\ninner = 1\nouter = 2\n[boundary]\ninner = \"free\"\n", 1.0),
        (
            "shape = \"cylinder\"\ninner = 0.5\nouter = 1\nz = [0, 1]\n[boundary]\nouter = \"roller\"\n",
            1.0,
        ),
    ];
    for (rest, radius) in cases {
        let failure = try_compile(&file(3, &lets, &u, rest)).expect_err("a false claim");
        let text = failure.to_string();
        // The place that the message names lies on the face.
        let number = |axis: &str| -> f64 {
            let (_, rest) = text.split_once(&format!("{axis} = ")).expect("a place");
            rest.split([',', '\n']).next().and_then(|it| it.parse().ok()).expect("a number")
        };
        let [x, y, z] = ["X", "Y", "Z"].map(number);
        let is_ball = rest.contains("sphere");
        let found = if is_ball { x.hypot(y).hypot(z) } else { x.hypot(y) };
        assert!(text.contains("does not hold everywhere"), "{text}");
        assert!((found - radius).abs() < 1e-12, "{radius}: {text}");
    }
    let triangle = "shape = \"polygon\"\nvertices = [[0, 0], [1, 0], [0, 1]]\n[boundary]\nedge_2 = \"fixed\"\n";
    let failure = try_compile(&file(2, "", "\"t*X*Y/9\", \"0\"", triangle));
    assert!(failure.is_err(), "u is not 0 on the slope");
}

/// Compares the functions of each face with the normal of its geometry and the quantities at a point of it.
#[test]
fn each_face_of_each_body_has_its_own_normal() {
    let plane = "\"sin(X + 2*Y)*t/9\", \"X*Y^2*t^2/40\"";
    let space = "\"sin(X + 2*Y)*t/9\", \"X*Y^2*t^2/40\", \"X*Z*t/20\"";
    let claims = |faces: &[&str]| {
        let lines = faces.iter().map(|face| format!("{face} = \"traction\"\n"));
        format!("[boundary]\n{}", lines.collect::<String>())
    };
    let round = ["inner", "outer", "theta_min", "theta_max"];
    let cases = [
        (
            3,
            space,
            "shape = \"cylinder\"\ninner = 1\nouter = 2\ntheta = [\"pi/7\", 2]\nz = [-1, 1]\n",
            [&round[..], &["z_min", "z_max"]].concat(),
        ),
        (
            3,
            space,
            "shape = \"sphere\"\ninner = 1\nouter = 2\ntheta = [\"pi/7\", 2]\nphi = [\"pi/5\", 2]\n",
            [&round[..], &["phi_min", "phi_max"]].concat(),
        ),
        (2, plane, "shape = \"disk\"\nouter = 2\ntheta = [\"pi/7\", 2]\n", round[1..].to_vec()),
        (
            2,
            plane,
            "shape = \"polygon\"\nvertices = [[0, 0], [\"4/3\", 0], [1, \"1/3\"], [\"4/3\", 1], [0, 1]]\n",
            vec!["edge_1", "edge_2", "edge_3", "edge_4", "edge_5"],
        ),
        (
            2,
            plane,
            "shape = \"polygon\"\nvertices = [[0, 1], [\"4/3\", 1], [1, \"1/3\"], [\"4/3\", 0], [0, 0]]\n",
            vec!["edge_1", "edge_2", "edge_3", "edge_4", "edge_5"],
        ),
    ];
    for (dimension, u, body, faces) in cases {
        let compiled = compiled(&file(dimension, "", u, &(body.to_string() + &claims(&faces))));
        let (extent, _) = domain::<Precise>(&compiled.program, &[]);
        let near = extent.map(Precise::to_f64);
        let mut seen = 0;
        for output in compiled.program.outputs.keys().copied().collect::<Vec<_>>() {
            let Output::Face(face, Datum::Traction) = output else { continue };
            seen += 1;
            for index in 1..4 {
                let (place, normal) = placed(&compiled, face, index);
                let inward: Vec<f64> = place
                    .iter()
                    .zip(&normal)
                    .map(|(x, n)| x.to_f64() - 1e-3 * n.to_f64())
                    .collect();
                let outward: Vec<f64> = place
                    .iter()
                    .zip(&normal)
                    .map(|(x, n)| x.to_f64() + 1e-3 * n.to_f64())
                    .collect();
                assert!(near.contains(&inward) && !near.contains(&outward), "{face:?}, {body}");
                // A step of that length along the normal ends at that distance from the face.
                assert!((near.distance_to(face, &inward) - 1e-3).abs() < 1e-9, "{face:?}, {body}");
                let found = value(&compiled, output, &place, &[]);
                let expected =
                    value(&compiled, Output::Quantity(Quantity::Traction), &place, &normal);
                for (found, expected) in found.iter().zip(&expected) {
                    let apart = (found.clone() - expected.clone()).magnitude();
                    assert!(apart.at_most(&Precise::from_f64(1e-60)), "{face:?}, {body}");
                }
            }
        }
        assert_eq!(seen, faces.len(), "{body}");
    }
}

/// A point of a face, to all digits, and the normal that the program computes there.
fn placed(compiled: &Compiled, face: Face, index: usize) -> (Vec<Precise>, Vec<Precise>) {
    let (extent, _) = domain::<Precise>(&compiled.program, &[]);
    let mut fractions: Vec<Precise> = halton(index).to_vec();
    let place = match (&extent, face) {
        (mms_mechanics::extent::Extent::Polygon(vertices), Face::Edge(first, _)) => {
            let [from, to] = [first, (first + 1) % vertices.len()].map(|at| vertices[at].clone());
            let way = fractions[0].clone();
            let along = |axis: usize| {
                from[axis].clone() + (to[axis].clone() - from[axis].clone()) * way.clone()
            };
            vec![along(0), along(1)]
        }
        (_, face) => {
            let (axis, is_upper) = match face {
                Face::Inner => (1, false),
                Face::Outer => (1, true),
                Face::ThetaMin => (0, false),
                Face::ThetaMax => (0, true),
                Face::PhiMin | Face::Min(_) => (2, false),
                _ => (2, true),
            };
            fractions[axis] = Precise::from_f64(if is_upper { 1.0 } else { 0.0 });
            extent.point(&fractions)
        }
    };
    let normal = value(compiled, Output::Face(face, Datum::Normal), &place, &[]);
    (place, normal)
}

fn value(
    compiled: &Compiled,
    output: Output,
    place: &[Precise],
    normal: &[Precise],
) -> Vec<Precise> {
    let mut interpreter = Interpreter::new(&compiled.program, &[]);
    interpreter.set_time(&Precise::from_f64(0.5));
    let plan = interpreter.plan(&[output]);
    interpreter.set_point(&plan, Point { coordinates: place, normal, gradient: &[] });
    interpreter.output(output)
}

/// A radius of 0, a whole turn and an axis are no faces.
#[test]
fn faces_that_are_not_there_have_no_functions() {
    let faces = |dimension: usize, rest: &str| -> Vec<String> {
        let u = vec!["0"; dimension].join(", ");
        let compiled = compiled(&file(dimension, "", &u, rest));
        let body = &compiled.field.domain.body;
        Face::of(body, compiled.field.space)
            .into_iter()
            .map(|face| face.name().to_string())
            .collect()
    };
    assert_eq!(faces(3, "shape = \"sphere\"\ninner = 0\nouter = 1\n"), ["outer"]);
    let cone = "shape = \"sphere\"\ninner = 0\nouter = 1\nphi = [0, \"pi/3\"]\n";
    assert_eq!(faces(3, cone), ["outer", "phi_max"]);
    let cap = "shape = \"sphere\"\ninner = 1\nouter = 2\nphi = [\"pi/3\", \"pi\"]\n";
    assert_eq!(faces(3, cap), ["inner", "outer", "phi_min"]);
    let rod = "shape = \"cylinder\"\ninner = 0\nouter = 1\nz = [0, 1]\n";
    assert_eq!(faces(3, rod), ["outer", "z_min", "z_max"]);
    assert_eq!(faces(2, "shape = \"disk\"\nouter = 1\n"), ["outer"]);
    let wedge = "shape = \"disk\"\nouter = 1\ntheta = [0, 1]\n";
    assert_eq!(faces(2, wedge), ["outer", "theta_min", "theta_max"]);
    let edges = "shape = \"polygon\"\nvertices = [[0, 0], [1, 0], [0, 1]]\nnames = [\"low\", \"slope\", \"left\"]\n";
    assert_eq!(faces(2, edges), ["low", "slope", "left"]);
    assert_eq!(faces(2, "shape = \"none\"\n"), Vec::<String>::new());
}

/// A field without a body is evaluated at points of the unit cube where points have to be chosen.
#[test]
fn a_field_without_a_body_is_numbers() {
    let compiled = compiled(&file(2, "", "\"t*ln(X + 1)\", \"t*Y/9\"", "shape = \"none\"\n"));
    assert!(compiled.field.domain.body.is_nothing());
    assert!(samples::<f64>(&compiled.program, &[], 8).iter().all(|it| it.coordinates.len() == 2));
    let place = [3.0, -2.0].map(Precise::from_f64);
    let u = value(&compiled, Output::Quantity(Quantity::Displacement), &place, &[]);
    assert!((u[0].to_f64() - 0.5 * 4f64.ln()).abs() < 1e-15);
    let claims: Vec<Claim> = compiled.field.boundary.iter().map(|it| it.claim.value).collect();
    assert!(claims.is_empty());
}
