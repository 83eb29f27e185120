//! The terms of the equations that a field tests.

use mms_analysis::visibility::{Span, Status, Term, Visibility};
use mms_codegen::{Compiled, compile};

#[path = "../../mms-codegen/tests/support/written.rs"]
mod written;
use written::{GRADED, NEO_HOOKEAN, PLANE, SPACE, VORTEX, field};

/// The names of a field's terms with each status.
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

/// Equal moduli, as with Poisson's ratio 1/4.
#[test]
fn equal_moduli_hide_a_swap_of_the_two() {
    let term = "unequal_moduli".to_string();
    for (moduli, is_hidden) in [
        ("lambda = 2\nmu = 2", true),
        ("young = 3\nnu = 0.25", true),
        ("young = 3\nnu = 0.3", false),
    ] {
        let material = format!("model = \"neo_hookean\"\n{moduli}");
        let [present, zero, negligible] = seen(&field(2, PLANE, &material, "1"));
        assert_eq!(zero.contains(&term) || negligible.contains(&term), is_hidden, "{moduli}");
        assert_eq!(present.contains(&term), !is_hidden, "{moduli}");
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

/// Elsewhere u is below the smallest number.
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

/// sin^2 + cos^2 - 1 that the canonical form does not recognise: the angle is doubled in one of them.
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
    // Far below the accuracy of double precision, but present.
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

/// An exponent is varied like any parameter, to test whether b depends on it.
#[test]
fn an_exponent_is_varied_like_any_parameter() {
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
    assert!(undecided.is_empty(), "{undecided:?}");
    for name in ["k", "n"] {
        assert!(!visibility.lacks(&Term::Parameter(name.into())), "{name}");
    }
}
