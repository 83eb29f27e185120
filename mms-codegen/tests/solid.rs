//! Ranges in which the density and the moduli at F = I are positive, and ranges in which they are not.

use mms_codegen::certify::certificate::{Certificate, certify};
use mms_codegen::certify::sign::Sign;
use mms_codegen::compile::compile_unproved;
use mms_codegen::{Compiled, Options};

use crate::sampled::sampled;

fn compiled(parameters: &str, material: &str) -> Compiled {
    let text = format!(
        "[field]\ntitle = \"x\"\ndimension = 2\n[parameters]\n{parameters}\n[displacement]\n\
         u = [\"0.01*X*t^2\", \"0.01*X*Y\"]\n[material]\n{material}\n[domain]\nshape = \"box\"\n\
         lower = [0, 0]\nupper = [1, 1]\ntime = [0, 1]\n"
    );
    let load = |_: &str| Err("no files here".to_string());
    let compiled = compile_unproved("x", "x.toml", &text, &load, &Options::default());
    compiled.unwrap_or_else(|failure| panic!("{failure}"))
}

fn is_solid(certificate: &Certificate) -> bool {
    certificate.solid.iter().all(|(_, sign)| matches!(sign, Sign::Positive(_)))
}

fn is_refuted(certificate: &Certificate) -> bool {
    certificate.solid.iter().any(|(_, sign)| matches!(sign, Sign::Refuted(..)))
}

/// An isotropic solid has mu > 0 and 3 lambda + 2 mu > 0, which young > 0 and -1 < nu < 1/2 give.
#[test]
fn ranges_are_refused_from_where_moduli_are_not_positive_definite() {
    let lame = "model = \"neo_hookean\"\nlambda = \"a\"\nmu = \"b\"\ndensity = 1000";
    let engineering = "model = \"linear_elastic\"\nyoung = \"a\"\nnu = \"b\"\ndensity = 1000";
    let gent = "model = \"gent\"\nkappa = \"a\"\nmu = \"b\"\nJm = 50\ndensity = 1000";
    let cases = [
        (lame, [-2.6, 6.0], [4.0, 4.5], true),
        (lame, [-2.7, 6.0], [4.0, 4.5], false),
        (lame, [6.0, 6.5], [0.01, 4.0], true),
        (lame, [6.0, 6.5], [0.0, 4.0], false),
        (engineering, [0.1, 10.0], [-0.99, 0.4999], true),
        (engineering, [0.1, 10.0], [-1.01, 0.4], false),
        (engineering, [0.1, 10.0], [0.3, 0.51], false),
        (engineering, [-0.1, 10.0], [0.3, 0.31], false),
        (gent, [1e-6, 1.0], [1.0, 2.0], true),
        (gent, [-1e-6, 1.0], [1.0, 2.0], false),
    ];
    for (material, a, b, is_right) in sampled(cases, 2) {
        let parameters = format!(
            "a = {{ value = {}, range = {a:?} }}\nb = {{ value = {}, range = {b:?} }}",
            a[1],
            f64::max(b[0], 0.3)
        );
        let certificate = certify(&compiled(&parameters, material));
        let found = (is_solid(&certificate), is_refuted(&certificate));
        assert_eq!(
            found,
            (is_right, !is_right),
            "{parameters} {material}: {:?}",
            certificate.solid
        );
    }
}

/// With W = ... + r/2 (I4 - 1)^2 and I4 - 1 = 2 a.E a, the stiffness is C = lambda I x I + 2 mu I + 4 r a x a x a x a. Its
/// shear moduli are mu, and the other two moduli are 2 (lambda + mu) and E = lambda + 2 mu + 4 r - lambda^2/(lambda + mu).
#[test]
fn fibres_are_refused_from_where_they_give_way() {
    let fibres = ["[1, 0, 0]", "[0.6, 0.8, 0]", "[0, 0, 1]", "[\"cos(X)\", \"sin(X)\", 0]"];
    let moduli: [(f64, f64); 3] = [(6.0, 4.0), (-1.0, 4.0), (100.0, 1.0)];
    for fibre in sampled(fibres, 2) {
        for (lambda, mu) in sampled(moduli, 2) {
            let limit = (lambda * lambda / (lambda + mu) - lambda - 2.0 * mu) / 4.0;
            for (least, is_right) in [(limit + 0.01, true), (limit - 0.01, false)] {
                let parameters = format!("r = {{ value = 5, range = [{least}, 10] }}");
                let material = format!(
                    "model = \"transversely_isotropic\"\nlambda = {lambda}\nmu = {mu}\n\
                     reinforcement = \"r\"\nfibre = {fibre}\ndensity = 1"
                );
                let certificate = certify(&compiled(&parameters, &material));
                let found = (is_solid(&certificate), is_refuted(&certificate));
                assert_eq!(
                    found,
                    (is_right, !is_right),
                    "{least} {material}: {:?}",
                    certificate.solid
                );
            }
        }
    }
}

/// Moduli that depend on no range are judged for the defaults only, which allows a fluid.
#[test]
fn moduli_without_a_range_are_not_looked_at() {
    let fluid = "model = \"neo_hookean\"\nlambda = \"a\"\nmu = 0\ndensity = \"1 + X*a\"";
    let certificate = certify(&compiled("a = { value = 1, range = [0.1, 1] }", fluid));
    let names: Vec<_> = certificate.solid.iter().map(|(part, _)| part.name()).collect();
    assert_eq!(names, ["rho0", "3 lambda + 2 mu"]);
    assert!(is_solid(&certificate), "{:?}", certificate.solid);
    let certificate = certify(&compiled("a = { value = 1 }", fluid));
    let names: Vec<_> = certificate.solid.iter().map(|(part, _)| part.name()).collect();
    assert_eq!(names, ["rho0"]);
}
