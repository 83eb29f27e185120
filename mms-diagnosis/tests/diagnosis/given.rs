//! Laws with an added given field: hypotheses change the moduli or the law, and keep the addition.

use mms_diagnosis::changed::{Changed, Without};
use mms_diagnosis::exact::Exact;
use mms_diagnosis::hypothesis::all;
use mms_runtime::{Domain, ManufacturedField, Material};

use super::field::{self, DENSITY, FREQUENCY, LAMBDA, MU};
use super::{HELD, Point, Tensor};

/// The square, heated: its law has - HEAT sin(FREQUENCY t) ln J as well, which is 0 at the start.
struct Heated;

const HEAT: f64 = 150.0;

fn first(time: f64, h: &Tensor) -> Tensor {
    let inverse = (h + Tensor::identity()).try_inverse().unwrap().transpose();
    field::first(h, [LAMBDA, MU]) - inverse * (HEAT * (FREQUENCY * time).sin())
}

impl Material<f64, 2> for Heated {
    fn density(&self, x: &[Point], density: &mut [f64]) {
        HELD.density(x, density);
    }

    fn wave_speed(&self, x: &[Point], speed: &mut [f64]) {
        HELD.wave_speed(x, speed);
    }

    fn changes_with_time(&self) -> bool {
        true
    }

    fn kirchhoff_stress(&self, time: f64, _: &[Point], h: &[Tensor], stress: &mut [Tensor]) {
        for (h, stress) in h.iter().zip(stress) {
            *stress = first(time, h) * (h + Tensor::identity()).transpose();
        }
    }
}

impl ManufacturedField<f64, 2> for Heated {
    fn domain(&self) -> Domain<f64, 2> {
        HELD.domain()
    }

    fn displacement(&self, time: f64, x: &[Point], out: &mut [Point]) {
        HELD.displacement(time, x, out);
    }

    fn velocity(&self, time: f64, x: &[Point], out: &mut [Point]) {
        HELD.velocity(time, x, out);
    }

    fn acceleration(&self, time: f64, x: &[Point], out: &mut [Point]) {
        HELD.acceleration(time, x, out);
    }

    fn body_force(&self, time: f64, x: &[Point], out: &mut [Point]) {
        HELD.acceleration(time, x, out);
        for (x, out) in x.iter().zip(out) {
            *out -= field::divergence(time, x, |h| first(time, h)) / DENSITY;
        }
    }

    fn displacement_gradient(&self, time: f64, x: &[Point], out: &mut [Tensor]) {
        HELD.displacement_gradient(time, x, out);
    }
}

/// The change of tau by a mistake, while the square is warm.
fn change(mistake: &str, which: Option<&str>, size: f64, h: &Tensor) -> Tensor {
    let (time, x) = (0.03, [Point::new(0.3, 0.6)]);
    let exact = Exact::new(&Heated, 0.1, 1e-3);
    let all = all(&exact);
    let is_meant =
        |name: &str, found: Option<&str>| name == mistake && (which.is_none() || found == which);
    let hypothesis = all.iter().find(|it| is_meant(it.name, it.which.as_deref())).unwrap();
    let mut stress = [Tensor::zeros(), Tensor::zeros()];
    let [right, changed] = &mut stress;
    Heated.kirchhoff_stress(time, &x, &[*h], std::slice::from_mut(right));
    Changed::with(&exact, Without::default(), hypothesis, &[size]).kirchhoff_stress(
        time,
        &x,
        &[*h],
        std::slice::from_mut(changed),
    );
    *changed - *right
}

#[test]
fn moduli_and_laws_are_changed_and_what_a_given_field_adds_stays() {
    let h = Tensor::new(0.1, -0.05, 0.08, 0.02);
    let f = h + Tensor::identity();
    let (j, unit) = (f.determinant(), Tensor::identity());
    let of_mu = f * f.transpose() - unit;
    let near = |found: Tensor, expected: Tensor| {
        assert!((found - expected).norm() < 1e-8 * MU, "{found} {expected}");
    };
    near(change("lambda_factor", None, 1.0, &h), Tensor::zeros());
    near(change("lambda_factor", None, 1.2, &h), unit * (0.2 * LAMBDA * j.ln()));
    near(change("mu_factor", None, 0.7, &h), of_mu * (-0.3 * MU));
    let swapped = (unit * j.ln() - of_mu) * (MU - LAMBDA);
    near(change("moduli_swapped", None, 1.0, &h), swapped);
    let quadratic = unit * (LAMBDA * (j * (j - 1.0) - j.ln()));
    near(change("material", Some("neo_hookean_quadratic"), 1.0, &h), quadratic);
}
