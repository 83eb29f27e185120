//! Lame's thick tube under inner pressure, derived by hand along the radius (see `lame`).

use mms_gallery::lame_tube::{Parameters, prepare};
use mms_runtime::{Matrix, Vector};

use crate::lame::coefficients;
use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_tube_is_the_tube_on_paper() {
    let odd = Parameters::<f64> { inner: 0.8, outer: 1.7, nu: 0.4, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { inner, outer, height, pressure, young, nu, .. } = parameters;
        let NeoHookean { lambda, mu } = NeoHookean::of(young, nu);
        let [first, second] =
            coefficients([2.0 * (lambda + mu), 2.0 * mu], 2, [inner, outer], pressure);
        let field = prepare(&parameters);
        let by_hand = |[x, y, z]: [f64; 3], t: f64| {
            let r = x.hypot(y);
            let (strain, hoop) = (first - second / (r * r), first + second / (r * r));
            let radial = Vector::<f64, 3>::new(x / r, y / r, 0.0);
            let around = Vector::<f64, 3>::new(-y / r, x / r, 0.0);
            let strains = radial * radial.transpose() * strain + around * around.transpose() * hoop;
            let stress: Matrix<f64, 3> =
                Matrix::<f64, 3>::identity() * (lambda * (strain + hoop)) + strains * (2.0 * mu);
            // det(I + H), of a motion along the radius.
            let jacobian = (1.0 + strain) * (1.0 + hoop);
            let u = field.at_time(t).displacement([x, y, z]);
            assert!((u[0].hypot(u[1]) - r * hoop.abs()).abs() < 1e-15 * outer, "{u:?}");
            Values::leading::<3>(jacobian, &stress, [0.0; 3])
        };
        let quarter = std::f64::consts::FRAC_PI_2;
        let round = in_box([inner, 0.0, 0.0], [outer, quarter, height], [0.0, 0.1]).into_iter();
        let points: Vec<_> =
            round.map(|([r, theta, z], t)| ([r * theta.cos(), r * theta.sin(), z], t)).collect();
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
