//! Fields that leave an analytic branch, or have no value as computed: each is refused at the place of the formula, and
//! single-valued formulas pass. An adversarial search looks for places that a certificate overlooks.

#[path = "support/hunt.rs"]
mod hunt;

use std::fs;
use std::path::Path;

use hunt::Hunt;
use mms_codegen::certify::certificate::{Certificate, certify};
use mms_codegen::certify::computed::ComputedVerdict;
use mms_codegen::{Compiled, Options, compile_with};
use proptest::prelude::*;

use crate::sampled::{sampled, sampled_count};

/// A field: u, the body, the time window, and the other tables of the file.
struct Case<'a> {
    u: &'a [&'a str],
    body: &'a str,
    time: &'a str,
    rest: &'a str,
    material: &'a str,
}

const BOX: &str = "shape = \"box\"\nlower = [0]\nupper = [1]";
const SQUARE: &str = "shape = \"box\"\nlower = [-1, -1]\nupper = [1, 1]";
const RING: &str = "shape = \"annulus\"\ninner = 0.5\nouter = 1";
const NEO_HOOKEAN: &str = "model = \"neo_hookean\"\nlambda = 1\nmu = 1\ndensity = 1";

impl<'a> Case<'a> {
    fn of(u: &'a [&'a str], body: &'a str) -> Self {
        Case { u, body, time: "0, 1", rest: "", material: NEO_HOOKEAN }
    }

    fn text(&self) -> String {
        let u: Vec<String> = self.u.iter().map(|u| format!("\"{u}\"")).collect();
        format!(
            "[field]\ntitle = \"x\"\ndimension = {}\n{}\n[displacement]\nu = [{}]\n[material]\n{}\n[domain]\n{}\ntime = [{}]\n",
            u.len(),
            self.rest,
            u.join(", "),
            self.material,
            self.body,
            self.time,
        )
    }
}

/// An energy of a user's own with a cut at J = 1.
const CUT_ENERGY: &str = "[material]\ntitle = \"x\"\nstrain_energy = \"mu/2*(I1 - 3) - mu*ln(J) + mu/100*(J - 1)^4*atan2(J - 1, -1)\"\n\
                          [parameters]\nmu = { unit = \"Pa\" }\n";

fn certified(text: &str) -> (Compiled, Certificate) {
    let load = |_: &str| Ok(CUT_ENERGY.to_string());
    let compiled =
        mms_codegen::compile::compile_unproved("x", "x.toml", text, &load, &Options::default());
    let compiled = compiled.unwrap_or_else(|failure| panic!("{failure}"));
    let certificate = certify(&compiled);
    (compiled, certificate)
}

/// Asserts that a field is refused at a part of its text, and whether the refusal is certain.
fn refused_at(case: &Case<'_>, place: &str, is_certain: bool) {
    let text = case.text();
    let (compiled, certificate) = certified(&text);
    let found: Vec<&str> = certificate
        .branch_violations
        .iter()
        .map(|exit| compiled.sources.slice(exit.span))
        .collect();
    assert!(found.contains(&place), "{place}: {found:?}\n{text}");
    let exit =
        certificate.branch_violations.iter().find(|it| compiled.sources.slice(it.span) == place);
    assert_eq!(exit.map(|it| it.is_certain), Some(is_certain), "{place}: {exit:?}\n{text}");
    assert!(!certificate.objections(&compiled).is_empty());
}

fn passes(case: &Case<'_>) {
    let text = case.text();
    let (compiled, certificate) = certified(&text);
    let objections = certificate.objections(&compiled);
    assert!(objections.is_empty(), "{objections:?}\n{text}");
}

#[test]
fn a_cut_inside_the_domain_is_refused_where_it_is() {
    let cut = "atan2(X - 1/2, -1)";
    refused_at(&Case::of(&[&format!("-0.05*{cut}")], BOX), cut, true);
    // The cut lies where no cell has a corner or its middle.
    let odd = "atan2(X - 1/3, -1)";
    refused_at(&Case::of(&[&format!("-0.05*{odd}")], BOX), odd, true);
    let in_time = "atan2(t - 0.3, -1)";
    refused_at(&Case::of(&[&format!("0.05*X*{in_time}")], BOX), in_time, true);
    let moving = "atan2(X - 0.5 - 0.1*t, X - 2)";
    refused_at(&Case::of(&[&format!("0.01*{moving}")], BOX), moving, true);
    let ring = Case::of(&["0.01*atan2(Y, X)", "0"], RING);
    refused_at(&ring, "atan2(Y, X)", true);
    let half = Case::of(&["0.01*cos(atan2(Y, X)/2)", "0"], RING);
    refused_at(&half, "atan2(Y, X)", true);
    let parameter = "[parameters]\na = { value = 0.5, range = [-1, 1] }\n";
    let ranged = Case { rest: parameter, ..Case::of(&["0.01*X*atan2(a - 0.1, -1)"], BOX) };
    refused_at(&ranged, "atan2(a - 0.1, -1)", true);
    let by_let = "[let]\nangle = \"atan2(X - 0.5, -1)\"\nunused = \"atan2(X - 0.7, -1)\"\n";
    let by_let = Case { rest: by_let, ..Case::of(&["0.01*angle"], BOX) };
    refused_at(&by_let, "atan2(X - 0.5, -1)", true);
    assert_eq!(certified(&by_let.text()).1.branch_violations.len(), 1);
}

#[test]
fn every_formula_that_a_field_is_made_of_is_looked_at() {
    let graded =
        "model = \"neo_hookean\"\nlambda = \"2 + atan2(X - 1/2, -1)/10\"\nmu = 1\ndensity = 1";
    let graded = Case { material: graded, ..Case::of(&["0.01*X"], BOX) };
    refused_at(&graded, "atan2(X - 1/2, -1)", true);
    let density =
        "model = \"neo_hookean\"\nlambda = 1\nmu = 1\ndensity = \"4 + atan2(X - 1/2, -1)\"";
    let density = Case { material: density, ..Case::of(&["0.01*X"], BOX) };
    refused_at(&density, "atan2(X - 1/2, -1)", true);
    let rigid = "[rigid]\nrotation = \"atan2(t - 0.3, -1)\"\n";
    let rigid = Case { rest: rigid, ..Case::of(&["0.01*X", "0"], SQUARE) };
    refused_at(&rigid, "atan2(t - 0.3, -1)", true);
    let energy = "model = \"./mine.toml\"\nmu = 1\ndensity = 1";
    let energy = Case { material: energy, ..Case::of(&["0.1*sin(3*X)*cos(t)"], BOX) };
    refused_at(&energy, "atan2(J - 1, -1)", true);
    // J is 1, so that lambda ln J is 0 wherever lambda has a value.
    let pole = "model = \"neo_hookean\"\nlambda = \"1/(X - 1/3)^2\"\nmu = 1\ndensity = 1";
    let pole = Case { material: pole, ..Case::of(&["0.1*Y*cos(t)", "0"], SQUARE) };
    refused_at(&pole, "1/(X - 1/3)^2", true);
}

/// In a ring the invariants are functions of radius and angle: W is examined at the strain of each point, and at no other.
#[test]
fn the_energy_of_a_round_body_is_examined_at_its_own_strain() {
    let gent = "model = \"gent\"\nkappa = 1\nmu = 1\nJm = 20\ndensity = 1";
    let wave = "0.05*sin(2*pi*(hypot(X, Y) - 0.5))/hypot(X, Y)";
    let u = [format!("{wave}*X"), format!("{wave}*Y")];
    passes(&Case { material: gent, ..Case::of(&[&u[0], &u[1]], RING) });
    let energy = "model = \"./mine.toml\"\nmu = 1\ndensity = 1";
    let growing = ["0.1*(hypot(X, Y) - 0.9)*X", "0.1*(hypot(X, Y) - 0.9)*Y"];
    let cut = Case { material: energy, ..Case::of(&growing, RING) };
    refused_at(&cut, "atan2(J - 1, -1)", true);
    let (_, certificate) = certified(&cut.text());
    let place = &certificate.branch_violations[0].witness.coordinates;
    let radius = f64::hypot(place[0], place[1]);
    let jacobian = (1.0 + 0.1 * (2.0 * radius - 0.9)) * (1.0 + 0.1 * (radius - 0.9));
    assert!((jacobian - 1.0).abs() < 1e-12, "J = {jacobian} at {place:?}");
}

#[test]
fn roots_logarithms_and_arcs_end_where_they_are_not_analytic() {
    let cases = [
        ("sqrt(X)", "sqrt(X)", true),
        ("X^(5/2)", "X^(5/2)", true),
        ("cbrt(X - 1/3)^7", "cbrt(X - 1/3)", true),
        ("(X - 0.2)^(7/3)", "(X - 0.2)^(7/3)", true),
        ("ln(X + t)", "ln(X + t)", true),
        ("asin(X)", "asin(X)", true),
        ("acos(2*X - 1.5)", "acos(2*X - 1.5)", true),
        ("tan(2*X)", "tan(2*X)", true),
        ("hypot(X - 0.5, t - 0.5)^5", "hypot(X - 0.5, t - 0.5)", true),
        // The square is never negative; that it is 0 somewhere is only found at a corner of a cell.
        ("sqrt((X - 1/3)^2)^5", "sqrt((X - 1/3)^2)", false),
        ("sqrt((X - 1/2)^2)^5", "sqrt((X - 1/2)^2)", true),
    ];
    for (u, place, is_certain) in sampled(cases, 3) {
        refused_at(&Case::of(&[&format!("0.01*{u}")], BOX), place, is_certain);
    }
    passes(&Case::of(&["0.01*(1 + X^2)^(1 + X)"], BOX));
}

#[test]
fn what_canonical_form_cancels_must_have_a_value() {
    refused_at(&Case::of(&["0.01*sqrt(X - 1e-5)*sqrt(X - 1e-5)"], BOX), "sqrt(X - 1e-5)", true);
    refused_at(&Case::of(&["0.01*(ln(X - 1e-5) - ln(X - 1e-5) + X)"], BOX), "ln(X - 1e-5)", true);
    let pole = "0.01*(X - 1/3)*X/(X - 1/3)";
    refused_at(&Case::of(&[pole], BOX), pole, true);
    passes(&Case::of(&["0.01*sqrt(X)*sqrt(X)"], BOX));
    passes(&Case::of(&["0.01*hypot(X, Y)^2", "0"], SQUARE));
}

#[test]
fn what_is_single_valued_across_the_cut_passes() {
    passes(&Case::of(&["0.01*cos(3*atan2(Y, X))", "0.01*sin(2*atan2(Y, X) - 5*t)"], RING));
    let waves =
        "[parameters]\nm = { value = 4 }\n[let]\nangle = \"atan2(Y, X)\"\nR = \"hypot(X, Y)\"\n";
    let waves =
        Case { rest: waves, ..Case::of(&["0.01*R*cos(m*(angle - 0.3*t))", "0.01*R^3"], RING) };
    passes(&waves);
    refused_at(&Case { rest: &waves.rest.replace("= 4", "= 4.5"), ..waves }, "atan2(Y, X)", true);
    // The cut is on the other side.
    passes(&Case::of(&["0.01*atan2(X, 2 + Y)", "0"], SQUARE));
    let sector = "shape = \"annulus\"\ninner = 0.5\nouter = 1\ntheta = [0, \"3*pi/4\"]";
    passes(&Case::of(&["0.01*atan2(Y, X)", "0.01*sqrt(X^2 + Y^2)"], sector));
    // At the origin there is no angle.
    refused_at(
        &Case::of(&["0.01*hypot(X, Y)^2*cos(2*atan2(Y, X))", "0"], SQUARE),
        "atan2(Y, X)",
        true,
    );
}

#[test]
fn a_constant_needs_no_branch() {
    let constant = "[parameters]\ne = { value = 0 }\n";
    passes(&Case { rest: constant, ..Case::of(&["0.01*X*(1 + sqrt(e) + atan2(e, -1))"], BOX) });
}

/// A compilation finds a cut, without a proof.
#[test]
fn a_compilation_finds_a_cut() {
    let text = Case::of(&["-0.05*atan2(X - 1/2, -1)"], BOX).text();
    let load = |_: &str| Err("no files here".to_string());
    let failure = compile_with("x", "x.toml", &text, &load, &Options::default());
    let failure = failure.expect_err("a cut").to_string();
    assert!(
        failure.contains("is not analytic everywhere") && failure.contains("X = 0.5"),
        "{failure}"
    );
}

fn fault(name: &str) -> (Compiled, Certificate) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/faults");
    certified(&fs::read_to_string(folder.join(name)).expect("a readable file"))
}

/// The evaluation of these files agrees with the certificate.
#[test]
fn what_is_proved_finite_is_computed() {
    for name in sampled(["time_sine_nan.toml", "xbig.toml", "time_03.toml"], 3) {
        let (compiled, certificate) = fault(name);
        let [double, _] = &certificate.computed;
        let is_refused = !certificate.objections(&compiled).is_empty();
        assert_eq!(
            is_refused,
            double.verdict != ComputedVerdict::Proved,
            "{name}: {certificate:?}"
        );
    }
    assert!(!fault("atan2_cut_1d.toml").1.branch_violations.is_empty());
}

#[test]
fn what_overflows_on_the_way_is_told() {
    // 1e39 Pa is too large for single precision, but not for double.
    let stiff = "model = \"neo_hookean\"\nlambda = 1e39\nmu = 1e39\ndensity = 1";
    let case = Case { material: stiff, ..Case::of(&["0.01*X^2"], BOX) };
    let (compiled, certificate) = certified(&case.text());
    let [double, single] = &certificate.computed;
    assert_eq!(double.verdict, ComputedVerdict::Proved);
    assert!(matches!(single.verdict, ComputedVerdict::Fails(..)), "{single:?}");
    assert!(certificate.objections(&compiled).is_empty());
}

#[test]
fn digits_that_sums_lose_are_counted() {
    let digits = |u: &str, time: &str| {
        let u = [u];
        let case = Case { time, ..Case::of(&u, BOX) };
        let (_, certificate) = certified(&case.text());
        let (digits, witness) = certificate.computed[0].angles.clone().expect("an angle");
        (digits, witness.time)
    };
    for window in ["0, 1", "0, 1e13"] {
        let (digits, _) = digits("0.01*sin(X + 30*t)", window);
        assert!((13.0..16.0).contains(&digits), "{window}: {digits}");
    }
    // Whole turns are subtracted with 106 bits, for angles up to 2^50.
    let (digits_of_large, at) = digits("0.01*sin(X + 30*t)", "0, 1e15");
    assert!(digits_of_large < 0.0 && at == 1e15, "{digits_of_large} {at}");
    // No part of the angle is known before X is. 3e13 has a last digit of 1/256, and half of it may be missing.
    let (far, at) = digits("1e-15*sin((X + 2)*t)", "0, 1e13");
    assert!((1.0..3.0).contains(&far) && at == 1e13, "{far} {at}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: sampled_count(96, 8) as u32, ..ProptestConfig::default() })]
    #[test]
    fn no_point_contradicts_a_certificate(data in prop::collection::vec(any::<u8>(), 40..160)) {
        hunt::hunt(&hunt::field(&data), &data);
    }
}

/// Tries `MMS_HUNT_FIELDS` fields, or 200, and counts the results.
#[test]
#[ignore = "takes a minute: .ci/long runs it"]
fn a_longer_hunt() {
    let number = |name: &str| std::env::var(name).ok().and_then(|it| it.parse::<u64>().ok());
    let fields = number("MMS_HUNT_FIELDS").unwrap_or(200);
    // A linear congruential generator (Knuth, The Art of Computer Programming 2, section 3.3.4).
    let mut state = number("MMS_HUNT_SEED").unwrap_or(1);
    let mut next = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as u8
    };
    let mut counts = [0_u64; 3];
    for _ in 0..fields {
        let data: Vec<u8> = (0..160).map(|_| next()).collect();
        counts[match hunt::hunt(&hunt::field(&data), &data) {
            Hunt::Refused => 0,
            Hunt::NotCertified => 1,
            Hunt::Held => 2,
        }] += 1;
    }
    eprintln!("refused {}, not certified {}, held {}", counts[0], counts[1], counts[2]);
    assert!(counts[2] > 0, "no certificate was tried");
}
