//! Axisymmetric fields against the three-dimensional fields of which they are sections, in 77 digits, and against independent
//! numbers.

use mms_codegen::{Compiled, compile};
use mms_math::Scalar as _;
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::{Quantity, Shape};

use crate::sampled::sampled;

fn compiled(text: &str) -> Compiled {
    let load = |_: &str| Err("only shipped materials".to_string());
    compile("field", "field.toml", text, &load)
        .unwrap_or_else(|failure| panic!("{failure}\n{text}"))
}

/// A field in R and Z, and the tables for the same field in space.
struct Section {
    /// u_R and u_Z.
    u: [&'static str; 2],
    swirl: Option<&'static str>,
    /// The model and its parameters, in R and Z.
    material: &'static str,
    /// a_R, a_Z and a_theta of the fibres.
    fibre: Option<[&'static str; 3]>,
}

impl Section {
    fn text(&self, inner: &str) -> String {
        let [radial, axial] = self.u;
        let swirl = self.swirl.map_or(String::new(), |swirl| format!("swirl = \"{swirl}\"\n"));
        let fibre = self.fibre.map_or(String::new(), |[r, z, theta]| {
            format!("fibre = [\"{r}\", \"{z}\", \"{theta}\"]\n")
        });
        format!(
            "[field]\ntitle = \"a section\"\ndimension = 2\ncoordinates = \"axisymmetric\"\n\
             [displacement]\nu = [\"{radial}\", \"{axial}\"]\n{swirl}\
             [material]\n{}density = \"2 + R*Z\"\n{fibre}\
             [domain]\nshape = \"box\"\nlower = [\"{inner}\", 0]\nupper = [2, 1]\ntime = [0, 1]\n",
            self.material
        )
    }
}

/// The text of the field in space whose section this is.
fn in_space(flat: &Compiled) -> String {
    mms_spec::section::in_space(&flat.field, flat.field.material.model.value.raw()).expect("a text")
}

const PLAIN: Section = Section {
    u: ["0.05*R*sin(Z + t)*exp(R/2)", "0.05*R^2*Z*cos(t + Z)"],
    swirl: None,
    material: "model = \"neo_hookean\"\nlambda = 3\nmu = 2\n",
    fibre: None,
};

const SECTIONS: [Section; 6] = [
    PLAIN,
    Section { swirl: Some("0.1*R*Z*(1 + R^2)*cos(t)"), ..PLAIN },
    Section {
        swirl: Some("0.1*R*Z^2"),
        material: "model = \"mooney_rivlin\"\nc1 = \"1 + R*Z\"\nc2 = \"2 + Z\"\nc3 = \"7 + R^2\"\n",
        ..PLAIN
    },
    Section {
        material: "model = \"linear_elastic\"\nlambda = \"3 + R^2*Z\"\nmu = \"2 + R^2\"\n",
        swirl: Some("0.1*R*Z^2*sin(t + R)"),
        ..PLAIN
    },
    Section {
        material: "model = \"transversely_isotropic\"\nlambda = 3\nmu = 2\nreinforcement = \"4 + Z\"\n",
        u: ["0.05*R*Z*cos(t)", "0.05*R^2*t"],
        swirl: Some("0.1*R*Z^2"),
        fibre: Some(["0.48", "0.8", "0.36"]),
    },
    Section {
        material: "model = \"saint_venant_kirchhoff\"\nlambda = 3\nmu = \"2 + R\"\n",
        ..PLAIN
    },
];

fn precise(value: f64) -> Precise {
    Precise::from_f64(value)
}

/// A quantity at a point, in any number type.
fn value(compiled: &Compiled, quantity: Quantity, time: f64, at: &[f64]) -> Vec<Precise> {
    let parameters = compiled.parameters(&Default::default());
    let request;
    let program = match quantity.is_on_request() {
        true => {
            request = compiled.on_request(quantity).expect("small enough");
            &request
        }
        false => &compiled.program,
    };
    let mut interpreter = Interpreter::new(program, &parameters);
    interpreter.set_time(&precise(time));
    let output = Output::Quantity(quantity);
    let plan = interpreter.plan(&[output]);
    let coordinates: Vec<Precise> = at.iter().map(|it| precise(*it)).collect();
    let normal = match compiled.field.dimension {
        2 => [0.6, 0.8, 0.0],
        _ => [0.6, 0.0, 0.8],
    };
    let normal = normal.map(precise);
    let normal = &normal[..at.len()];
    interpreter.set_point(&plan, Point { coordinates: &coordinates, normal, gradient: &[] });
    interpreter.output(output)
}

/// The axes in space of R, Z and theta at the reference angle.
const ORDER: [usize; 3] = [0, 2, 1];

/// The components in space that correspond to the components of a section; the others are 0.
fn places(shape: Shape, vector: usize) -> Vec<usize> {
    match shape {
        Shape::Scalar => vec![0],
        Shape::Vector => ORDER[..vector].to_vec(),
        Shape::Tensor => {
            ORDER.iter().flat_map(|row| ORDER.map(|column| row * 3 + column)).collect()
        }
    }
}

#[track_caller]
fn close(name: &str, found: &[Precise], expected: &[Precise]) {
    assert_eq!(found.len(), expected.len(), "{name}");
    let scale = expected.iter().map(|it| it.to_f64().abs()).fold(1e-3, f64::max);
    for (index, (found, expected)) in found.iter().zip(expected).enumerate() {
        let off = (found.clone() - expected.clone()).to_f64().abs();
        assert!(
            off <= 1e-68 * scale,
            "{name} {index}: {} and {}",
            found.to_f64(),
            expected.to_f64()
        );
    }
}

#[test]
fn a_section_has_the_quantities_of_the_field_in_space() {
    for section in sampled(&SECTIONS, 2) {
        let flat = compiled(&section.text("0.25"));
        let space = compiled(&in_space(&flat));
        let evaluated = Quantity::evaluated();
        for quantity in sampled(evaluated, 3) {
            for [r, z, t] in [[0.75, 0.25, 0.375], [1.625, 0.875, 0.5]] {
                let found = value(&flat, quantity, t, &[r, z]);
                let all = value(&space, quantity, t, &[r, 0.0, z]);
                let places = places(quantity.shape(), flat.field.space.vector());
                let expected: Vec<_> = places.iter().map(|place| all[*place].clone()).collect();
                close(quantity.name(), &found, &expected);
            }
        }
    }
}

/// Compares with numbers of SymPy and mpmath, which do not depend on this project.
#[test]
fn a_case_from_elsewhere_has_its_numbers() {
    let field = compiled(
        "[field]\ntitle = \"Thick cylinder\"\ndimension = 2\ncoordinates = \"axisymmetric\"\n\
         [parameters]\nyoung = { value = 1e6 }\nnu = { value = 0.3 }\nrho0 = { value = 1000 }\n\
         a = { value = 0.02 }\n\
         [displacement]\nu = [\"a*R*sin(pi*Z)*cos(100*t)\", \"a*R^2*Z*cos(100*t)\"]\n\
         [material]\nmodel = \"neo_hookean\"\nyoung = \"young\"\nnu = \"nu\"\ndensity = \"rho0\"\n\
         [domain]\nshape = \"box\"\nlower = [1, 0]\nupper = [2, 1]\ntime = [0, 0.01]\n",
    );
    let of = |quantity| numbers(&field, quantity, 0.004, &[1.3, 0.2]);
    let near = |found: f64, expected: f64| {
        assert!((found - expected).abs() <= 1e-13 * expected.abs(), "{found} and {expected}");
    };
    let (force, stress) = (of(Quantity::BodyForce), of(Quantity::FirstPiolaKirchhoff));
    near(force[0], -128.61593128875083);
    near(force[1], -147.850_973_800_656_4);
    near(stress[0], 37559.18983375655);
    near(stress[4], 52284.40320344482);
    near(stress[8], 37755.65236879348);
}

/// Values in double precision.
fn numbers(compiled: &Compiled, quantity: Quantity, time: f64, at: &[f64]) -> Vec<f64> {
    let parameters = compiled.parameters(&Default::default());
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    interpreter.set_time(&time);
    let output = Output::Quantity(quantity);
    let plan = interpreter.plan(&[output]);
    let point = Point { coordinates: at, normal: &[0.6, 0.8], gradient: &[] };
    interpreter.set_point(&plan, point);
    interpreter.output(output)
}

/// Sections whose formulas have no pole at R = 0: all except those with fibres that lean outwards.
fn reaching_the_axis() -> impl Iterator<Item = &'static Section> {
    SECTIONS.iter().filter(|section| section.fibre.is_none())
}

#[test]
fn on_the_axis_values_are_limits_and_exact() {
    for section in sampled(reaching_the_axis(), 2) {
        let field = compiled(&section.text("0"));
        for quantity in Quantity::evaluated() {
            let [near, at] = [1e-45, 0.0].map(|r| value(&field, quantity, 0.375, &[r, 0.25]));
            let scale = at.iter().map(|it| it.to_f64().abs()).fold(1e-3, f64::max);
            for (near, at) in near.iter().zip(&at) {
                assert!(at.is_defined(), "{}", quantity.name());
                let off = (near.clone() - at.clone()).to_f64().abs();
                // Near the axis, a quantity that varies along R has a slope of a few units.
                assert!(off <= 1e-43 * scale, "{}: {off:e}", quantity.name());
            }
            if quantity.is_on_request() {
                continue;
            }
            let computed = numbers(&field, quantity, 0.375, &[0.0, 0.25]);
            for (computed, at) in computed.iter().zip(&at) {
                let off = (computed - at.to_f64()).abs();
                assert!(off <= 64.0 * f64::EPSILON * scale, "{}: {off:e}", quantity.name());
            }
        }
    }
}

/// The source of a balance includes the spreading part of the flux, Q_R/R; C^-1 and the gradient are taken from a body that
/// twists.
#[test]
fn a_balance_has_the_source_of_the_field_in_space() {
    let twisted = &SECTIONS[1];
    let flux = |axis: usize, names: [&str; 3], order: [usize; 3]| {
        let terms = (0..3).map(|k| format!("Cinv{}{}*({})", order[axis], order[k], names[k]));
        format!("-3*({})", terms.collect::<Vec<_>>().join(" + "))
    };
    let given = "[given]\nT = { value = \"R^2*Z*(1 + t)\" }\n";
    let balance = |names: [&str; 3]| {
        let all: Vec<_> = (0..3).map(|k| format!("\"{}\"", flux(k, names, [1, 2, 3]))).collect();
        format!("[[balance]]\nname = \"heat\"\nstorage = \"J*T\"\nflux = [{}]\n", all.join(", "))
    };
    let flat = twisted.text("0") + given + &balance(["T_R", "T_Z", "0"]);
    let space =
        in_space(&compiled(&twisted.text("0.25"))) + given + &balance(["T_X", "T_Y", "T_Z"]);
    let (flat, space) = (compiled(&flat), compiled(&space));
    for (name, shape) in [
        ("heat_source", Shape::Scalar),
        ("heat_flux", Shape::Vector),
        ("heat_normal_flux", Shape::Scalar),
        ("T_gradient", Shape::Vector),
        ("T_rate", Shape::Scalar),
    ] {
        let [one, other] = [&flat, &space].map(|it| it.quantity(name).expect("a quantity"));
        for [r, z, t] in [[0.75, 0.25, 0.375], [1.625, 0.875, 0.5]] {
            let all = value(&space, other, t, &[r, 0.0, z]);
            let expected = places(shape, 3).into_iter().map(|place| all[place].clone());
            close(name, &value(&flat, one, t, &[r, z]), &expected.collect::<Vec<_>>());
        }
    }
    let source = flat.quantity("heat_source").expect("a quantity");
    let [near, at] = [1e-45, 0.0].map(|r| value(&flat, source, 0.375, &[r, 0.25]).swap_remove(0));
    assert!((near - at).to_f64().abs() <= 1e-43);
}

/// A translation along the axis changes b by its acceleration, and changes no strain.
#[test]
fn a_twin_is_carried_along_the_axis() {
    let text = SECTIONS[1].text("0");
    let twin = text.clone() + "[rigid]\ntranslation = [0, \"3*t^2\"]\n";
    let (rest, moved) = (compiled(&text), compiled(&twin));
    let by = |quantity, axial: f64| {
        let [rest, moved] = [&rest, &moved].map(|it| value(it, quantity, 0.375, &[0.75, 0.25]));
        let carried = rest.into_iter().enumerate();
        let carried = carried.map(|(k, it)| if k == 1 { it + precise(axial) } else { it });
        close(quantity.name(), &moved, &carried.collect::<Vec<_>>());
    };
    by(Quantity::BodyForce, 6.0);
    by(Quantity::Position, 3.0 * 0.375 * 0.375);
    by(Quantity::DivP, 0.0);
    by(Quantity::FirstPiolaKirchhoff, 0.0);
}

/// Parameters that move the body to the axis, or beyond it, are checked like the file.
#[test]
fn a_body_may_be_moved_to_the_axis_only_where_all_is_finite_there() {
    let with = |radial: &str| {
        let text = PLAIN.text("inner").replace(PLAIN.u[0], radial);
        compiled(&text.replace("[material]", "[parameters]\ninner = { value = 0.5 }\n[material]"))
    };
    let allows = |field: &Compiled, inner: f64| {
        let set = [(0, inner.try_into().expect("a number"))].into_iter().collect();
        let quick = mms_codegen::compile::fast_check::FastParameterCheck::new(field)
            .expect("a simple field");
        let [quick, slow] = [quick.accepted(&set).is_some(), field.accepts(&set).is_ok()];
        assert!(slow || !quick, "{inner}");
        slow
    };
    let (finite, open) = (with("0.05*R*Z"), with("0.05*sin(R)*Z"));
    assert_eq!([0.25, 0.0, -0.25].map(|inner| allows(&finite, inner)), [true, true, false]);
    assert_eq!([0.25, 0.0, -0.25].map(|inner| allows(&open, inner)), [true, false, false]);
}
