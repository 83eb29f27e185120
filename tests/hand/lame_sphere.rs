//! Lame's hollow sphere under inner pressure, derived by hand along the radius (see `lame`).

use std::f64::consts::FRAC_PI_2;

use mms_gallery::lame_sphere::{Parameters, prepare};
use mms_runtime::{Matrix, Vector};

use crate::lame::coefficients;
use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_sphere_is_the_sphere_on_paper() {
    let odd = Parameters::<f64> { inner: 0.8, outer: 1.7, nu: 0.4, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { inner, outer, pressure, young, nu, .. } = parameters;
        let NeoHookean { lambda, mu } = NeoHookean::of(young, nu);
        let [first, second] =
            coefficients([3.0 * lambda + 2.0 * mu, 4.0 * mu], 3, [inner, outer], pressure);
        let by_hand = |[x, y, z]: [f64; 3], _| {
            let place = Vector::<f64, 3>::new(x, y, z);
            let r = place.norm();
            let (strain, hoop) = (first - 2.0 * second / r.powi(3), first + second / r.powi(3));
            let along = place * place.transpose() / (r * r);
            let identity = Matrix::<f64, 3>::identity();
            let strains = along * strain + (identity - along) * hoop;
            let stress = identity * (lambda * (strain + 2.0 * hoop)) + strains * (2.0 * mu);
            let jacobian = (1.0 + strain) * (1.0 + hoop).powi(2);
            Values::leading::<3>(jacobian, &stress, [0.0; 3])
        };
        let round = in_box([inner, 0.0, 0.0], [outer, FRAC_PI_2, FRAC_PI_2], [0.0, 0.1]);
        let place = |([r, theta, phi], t): ([f64; 3], f64)| {
            let across = r * phi.sin();
            ([across * theta.cos(), across * theta.sin(), r * phi.cos()], t)
        };
        let points: Vec<_> = round.into_iter().map(place).collect();
        // b is 0 on paper; in the code it is the rounding of stresses over a length.
        let generated = |x, t| {
            let values: Values = generated!(prepare(&parameters))(x, t);
            let rounding = 1e-12 * pressure / (inner * parameters.rho0);
            assert!(values.force.iter().all(|it| it.abs() < rounding), "{:?}", values.force);
            Values { force: vec![0.0; 3], ..values }
        };
        assert_agree(TOLERANCE, &points, generated, by_hand);
    }
}
