//! Long waves against closed forms.

use std::f64::consts::PI;

use crate::support::{field, plane, zero};
use mms_codegen::Compiled;
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

/// A disc of radius 1 with a uniform traction all around that stretches it; the material has the moduli of [`MODULI`].
fn disc(stretch: f64) -> Compiled {
    let change = stretch - 1.0;
    field(&format!(
        "[field]\ntitle = 'disc'\ndimension = 2\n[displacement]\nu = ['{change:.3}*X', '{change:.3}*Y']\n\
         [material]\nmodel = 'neo_hookean'\nlambda = 1.5\nmu = 1\ndensity = 1\n\
         [domain]\nshape = 'disk'\nouter = 1\ntime = [0, 1]\n[boundary]\nouter = 'traction'\n"
    ))
}

/// The Bessel function J_2 by its power series, and its first derivative times x.
fn bessel(x: f64) -> [f64; 2] {
    let mut term = x * x / 8.0;
    let [mut value, mut slope] = [0.0; 2];
    for m in 0..30_u32 {
        value += term;
        slope += term * f64::from(2 * m + 2);
        term *= -(x * x / 4.0) / f64::from((m + 1) * (m + 3));
    }
    [value, slope]
}

/// The translations and the rotation of a free disc are no modes. The softest mode at rest has u = grad phi + curl psi with
/// phi = a J_2(h R) cos 2 theta and psi = b J_2(k R) sin 2 theta, h^2 = rho0 w^2/(lambda + 2 mu), k^2 = rho0 w^2/mu, and no
/// traction at R = 1 (Love, A Treatise on the Mathematical Theory of Elasticity, 1927, chapter 12).
#[test]
fn a_free_disc_swings_as_an_ellipse() {
    let [lambda, mu] = MODULI;
    let determinant = |w: f64| {
        let [h, k] = [w / (lambda + 2.0 * mu).sqrt(), w / mu.sqrt()];
        let [[j, dj], [l, dl]] = [bessel(h), bessel(k)];
        let normal =
            [-lambda * h * h * j - 2.0 * mu * (dj + (h * h - 4.0) * j), 4.0 * mu * (dl - l)];
        let shear = [-4.0 * (dj - j), 2.0 * dl + (k * k - 8.0) * l];
        normal[0] * shear[1] - normal[1] * shear[0]
    };
    let expected = zero(2.0, 3.0, determinant).powi(2);
    let found = judge(&disc(1.0)).growth.expect("all is free").least;
    // A Rayleigh quotient is an upper bound. Two quadratic elements lie along half a wave, k h = pi/2: the error is about
    // (k h)^4/720, 0.8 %.
    assert!((0.0..0.012).contains(&(found / expected - 1.0)), "{found} {expected}");
}

/// With as many displacements held as there are rigid motions, Newton's method converges to the exact state of a loaded disc.
#[test]
fn a_disc_with_tractions_all_around_is_solved() {
    for stretch in [1.05, 0.98] {
        assert_eq!(solve(&disc(stretch)), Solved::Comes, "{stretch}");
    }
}
