//! Moduli of fibrous material at rest against closed forms.

use crate::support::field;
use mms_codegen::certify::rest::stress;
use mms_codegen::compile;
use mms_stability::fibres::TransverseModuli;
use mms_stability::resting::Material;

/// The moduli of a square of neo-Hookean matrix with E and nu, whose fibres have the energy `fibre`.
fn moduli(fibre: &str) -> Option<TransverseModuli> {
    let compiled = field(&format!(
        r#"
[field]
title = "fibres"
dimension = 2
[displacement]
u = ["0.01*X*Y", "0"]
[material]
model = "transversely_isotropic"
young = 10
nu = 0.3
reinforcement = 5
fibre = {fibre}
density = 1
[domain]
shape = "box"
lower = [0, 0]
upper = [1, 1]
time = [0, 1]
"#
    ));
    Material::of(&compiled).expect("a material").middle.transverse_moduli()
}

fn close(found: [f64; 2], expected: [f64; 2]) {
    for (found, expected) in found.into_iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
}

/// Fibres add 4 r a a a a to the stiffness: by Sherman & Morrison (Ann. Math. Stat. 21, 1950) the compliance is less by s s 4
/// r/(1 + 4 r/E) with s = (1, -nu, -nu)/E.
#[test]
fn fibres_stiffen_along_their_axis() {
    let (young, nu, added) = (10.0, 0.3, 20.0);
    let share = added / (young + added);
    let across = (1.0 - nu * nu * share) / young;
    let between = -(nu + nu * nu * share) / young;
    let shear = young / (2.0 * (1.0 + nu));
    let axes = [[0.8, 0.6, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]];
    for axis in axes {
        let found = moduli(&format!("{axis:?}")).expect("an axis");
        let along: f64 = found.axis.iter().zip(axis).map(|(a, b)| a * b).sum();
        assert!((along - 1.0).abs() < 1e-9, "{found:?}");
        close(found.young, [young + added, 1.0 / across]);
        close(found.nu, [nu, -between / across]);
        close(found.shear, [shear, shear]);
    }
}

/// In a W of the small strain a stress at rest does not turn with rotations: lambda and mu are as in its formula.
#[test]
fn a_stress_at_rest_leaves_small_strain_moduli_as_they_are() {
    for (material, text) in [
        ("small", "lambda/2*eps_trace^2 + mu*eps_squared + s*eps_trace"),
        ("finite", "mu/2*(I1 - 3) + (s - mu)*ln(J) + lambda/2*ln(J)^2"),
    ] {
        let law = format!(
            "[material]\ntitle = \"{material}\"\nstrain_energy = \"{text}\"\n[parameters]\nlambda = {{}}\nmu = {{}}\ns = {{}}\n"
        );
        let compiled = compile("test", "test.toml", STRESSED, &|_| Ok(law.clone()));
        let compiled = compiled.unwrap_or_else(|failure| panic!("{failure}"));
        let resting = Material::of(&compiled).expect("a material").middle;
        assert!((resting.stress[0] - 0.3).abs() < 1e-12, "{resting:?}");
        let moduli = resting.moduli().unwrap_or_else(|| panic!("{material} is isotropic"));
        let shift = if material == "finite" { 0.3 } else { 0.0 };
        assert!((moduli.lambda - 1.0).abs() < 1e-12, "{material}: {moduli:?}");
        assert!((moduli.mu - (2.0 - shift)).abs() < 1e-12, "{material}: {moduli:?}");
    }
}

const STRESSED: &str = r#"
[field]
title = "stressed"
dimension = 2
[displacement]
u = ["0.01*X*Y", "0"]
[material]
model = "law.toml"
lambda = 1
mu = 2
s = 0.3
density = 1
[domain]
shape = "box"
lower = [0, 0]
upper = [1, 1]
time = [0, 1]
"#;

/// Fibres across a plane body that pull at rest: P is 0 in the plane, and 2 s across it.
#[test]
fn a_stress_at_rest_across_a_plane_body_is_found() {
    let law = "[material]\ntitle = \"taut\"\nstrain_energy = \"mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2 + s*(I4 - 1)\"\n\
               [parameters]\nlambda = {}\nmu = {}\ns = {}\n";
    let text = STRESSED.replace("s = 0.3", "s = 0.3\nfibre = [0, 0, 1]");
    let compiled = compile("test", "test.toml", &text, &|_| Ok(law.into()));
    let rest = stress(&compiled.unwrap_or_else(|failure| panic!("{failure}")));
    let found = rest.stress().expect("a stress");
    assert_eq!(found.len(), 9);
    assert!((found[8] - 0.6).abs() < 1e-15 && found[..8].iter().all(|it| *it == 0.0), "{found:?}");
}
