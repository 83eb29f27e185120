//! Long waves against closed forms.

use std::f64::consts::PI;

use crate::support::{field, plane, zero};
use mms_stability::growth::Growth;
use mms_stability::judge;
use mms_stability::solve::{Solved, solve};

const ROLLERS: &str = r#"
x_min = "roller"
x_max = "roller"
y_min = "roller"
y_max = "roller"
"#;

/// A square on rollers at rest: the slowest mode is (sin pi X cos pi Y, -cos pi X sin pi Y), of w^2 = 2 pi^2 mu/rho0.
#[test]
fn a_square_on_rollers_has_the_modes_of_sines() {
    let square = plane(["0", "0"], [1.5, 1.0], [1.0, 1.0], ROLLERS);
    let growth = judge(&square).growth.expect("something is free");
    let expected = 2.0 * PI * PI;
    // Four quadratic elements along half a wave: the error is about (k h)^4/720.
    assert!((growth.least / expected - 1.0).abs() < 2e-3, "{growth:?}");
    assert_eq!(growth.factor, 1.0);
}

/// A plate of length L and thickness 1, on rollers at one end, with a dead load on the other that compresses it by a strain.
fn plate(length: f64, strain: f64) -> Growth {
    let [lambda, mu] = MODULI;
    // No stress across the plate.
    let stress = |q: f64| lambda * ((1.0 - strain) * q).ln() / q + mu * (q - 1.0 / q);
    let across = zero(0.9, 1.1, stress) - 1.0;
    let u = [format!("-{strain:.17}*X"), format!("{across:.17}*Y")];
    let loads = "x_min = 'roller'\nx_max = 'traction'\ny_min = 'traction'\ny_max = 'traction'";
    judge(&plane([&u[0], &u[1]], MODULI, [length, 1.0], loads)).growth.expect("something is free")
}

const MODULI: [f64; 2] = [1.5, 1.0];
const LENGTH: f64 = 16.0;

/// Without a load the plate vibrates as a beam that is guided at one end and free at the other: w^2 = E' h^2/12 (b/L)^4/rho0
/// with tan b + tanh b = 0 and E' = 4 mu (lambda + mu)/(lambda + 2 mu). Sliding along the rollers is no mode.
#[test]
fn a_plate_swings_as_a_beam() {
    let [lambda, mu] = MODULI;
    let stiffness = 4.0 * mu * (lambda + mu) / (lambda + 2.0 * mu);
    let root = zero(1.6, 3.0, |b| b.tan() + b.tanh());
    let expected = stiffness / 12.0 * (root / LENGTH).powi(4);
    let found = plate(LENGTH, 0.0).least;
    // The errors of theory and mesh are about (h/L)^2 and (root/4)^4/720.
    assert!((found / expected - 1.0).abs() < 0.02, "{found} {expected}");
}

/// The load of Euler, 1744: a plate that is guided at one end and free at the other buckles at the strain (pi h/(2 L))^2/12.
/// Beyond it a disturbance grows.
#[test]
fn a_plate_buckles_at_the_load_of_euler() {
    let critical = (PI / (2.0 * LENGTH)).powi(2) / 12.0;
    let found = zero(0.5 * critical, 2.0 * critical, |strain| plate(LENGTH, strain).least);
    assert!((found / critical - 1.0).abs() < 0.02, "{found} {critical}");
    let buckled = plate(LENGTH, 4.0 * critical);
    let expected = (-buckled.least).sqrt().exp();
    assert!((buckled.factor - expected).abs() < 1e-12 && expected > 1.0, "{buckled:?}");
}

/// A body that is fixed on one side and has small loads is found from zero.
#[test]
fn newton_comes_to_stable_states() {
    let stretched = plane(["0.05*sin(X)*Y", "0.04*X*Y"], MODULI, [1.0, 1.0], "x_min = 'traction'");
    assert_eq!(solve(&stretched), Solved::Comes);
    let all = "x_min = 'traction'\nx_max = 'traction'\ny_min = 'traction'\ny_max = 'traction'";
    let unheld = plane(["0.1*sin(X)*Y", "0.1*X*Y"], MODULI, [1.0, 1.0], all);
    assert_eq!(solve(&unheld), Solved::Comes);
    let moving = plane(["0.05*t*X", "0"], MODULI, [1.0, 1.0], "");
    assert_eq!(solve(&moving), Solved::Moving);
}

/// A disc with a uniform traction all around. Its translations and its rotation are free, and are no modes of the stability: the
/// least mode is elastic, with w^2 of order mu/(rho0 R^2). With as many displacements constrained, Newton's method converges.
#[test]
fn a_disc_with_tractions_all_around_is_free_to_move() {
    for stretch in [1.0, 1.05, 0.98] {
        let change = stretch - 1.0;
        let disc = field(&format!(
            "[field]\ntitle = 'disc'\ndimension = 2\n[displacement]\nu = ['{change:.3}*X', '{change:.3}*Y']\n\
             [material]\nmodel = 'neo_hookean'\nlambda = 1.5\nmu = 1\ndensity = 1\n\
             [domain]\nshape = 'disk'\nouter = 1\ntime = [0, 1]\n[boundary]\nouter = 'traction'\n"
        ));
        let growth = judge(&disc).growth.expect("all is free");
        assert!((0.5..20.0).contains(&growth.least), "{stretch}: {growth:?}");
        assert_eq!(solve(&disc), Solved::Comes, "{stretch}");
    }
}
