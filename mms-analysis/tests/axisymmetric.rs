//! Visibility of axisymmetric fields: against the fields in space of which they are sections, and against derivations on paper.

use mms_analysis::visibility::{Term, Visibility};
use mms_codegen::{Compiled, compile};

fn compiled(text: &str) -> Compiled {
    let load = |_: &str| Err("only shipped materials".to_string());
    compile("field", "field.toml", text, &load).unwrap_or_else(|failure| panic!("{failure}"))
}

/// A field in R and Z, and the equal field in space.
fn both([radial, axial, swirl]: [&str; 3], moduli: &str) -> [Compiled; 2] {
    let material = format!("[material]\nmodel = \"neo_hookean\"\n{moduli}density = 2\n");
    let flat = format!(
        "[field]\ntitle = \"a section\"\ndimension = 2\ncoordinates = \"axisymmetric\"\n\
         [displacement]\nu = [\"{radial}\", \"{axial}\"]\nswirl = \"{swirl}\"\n{material}\
         [domain]\nshape = \"box\"\nlower = [0.25, 0]\nupper = [1, 1]\ntime = [0, 1]\n"
    );
    let space = format!(
        "[field]\ntitle = \"in space\"\ndimension = 3\n[let]\nR = \"sqrt(X^2 + Y^2)\"\n\
         u_R = \"{radial}\"\nu_t = \"{swirl}\"\n\
         [displacement]\nu = [\"u_R*X/R - u_t*Y/R\", \"u_R*Y/R + u_t*X/R\", \"{axial}\"]\n{material}\
         [domain]\nshape = \"box\"\nlower = [0.25, 0.25, 0]\nupper = [1, 1, 1]\ntime = [0, 1]\n"
    );
    [flat, space].map(|text| compiled(&text))
}

#[test]
fn a_section_sees_what_the_field_in_space_sees() {
    const PLAIN: &str = "lambda = 3\nmu = 2\n";
    for (motion, moduli) in [
        (["0.1*R*Z*t", "0.05*R^2*sin(t)", "0"], PLAIN),
        (["0.1*R*t", "0.05*Z*t", "0"], PLAIN),
        (["0", "0", "0.1*R*Z*sin(t)"], "lambda = 3\nmu = \"2 + R^2\"\n"),
        (["0.05*R^3*t^3", "0", "0"], "lambda = 2\nmu = 2\n"),
    ] {
        let [flat, space] =
            both(motion, moduli).map(|field| Visibility::of(&field).expect("few terms"));
        // Terms that depend on no basis.
        for term in [
            Term::Velocity,
            Term::Acceleration,
            Term::Jerk,
            Term::InitialDisplacement,
            Term::InitialVelocity,
            Term::FinalDisplacement,
            Term::VolumeChange,
            Term::Rotation,
            Term::TransposedStress,
            Term::UnequalModuli,
            Term::GradedModuli,
            Term::GradedDensity,
            Term::BodyForce,
            Term::Parameter("lambda".into()),
            Term::Parameter("mu".into()),
        ] {
            assert_eq!(flat.lacks(&term), space.lacks(&term), "{motion:?}: {term:?}");
        }
    }
}

/// Linear shape functions in R and Z represent u_R = a + b R exactly. If b is not 0, that is no affine motion in space.
#[test]
fn shape_functions_are_those_in_r_and_z() {
    let [flat, space] = both(["0.1*(R - 0.25)*t", "0", "0"], "lambda = 3\nmu = 2\n")
        .map(|field| Visibility::of(&field).expect("few terms"));
    assert!(flat.lacks(&Term::Curvature) && !space.lacks(&Term::Curvature));
    assert!(!flat.lacks(&Term::BodyForce));
    let [curved, _] = both(["0.1*R^2*t", "0", "0"], "lambda = 3\nmu = 2\n")
        .map(|field| Visibility::of(&field).expect("few terms"));
    assert!(!curved.lacks(&Term::Curvature) && !curved.lacks(&Term::CurvatureAlongAxes));
    assert!(curved.lacks(&Term::ThirdGradient));
}
