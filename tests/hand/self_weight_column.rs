//! A column at rest under its own weight, derived by hand.
//!
//! ```text
//! Div P = -rho0 b = rho0 g and P(height) = 0:  P = rho0 g (X - height), for every material
//! mu (F - 1/F) = P  (nu = 0: lambda = 0, mu = E/2):  F = (P + sqrt(P^2 + 4 mu^2))/(2 mu)
//! u(X) = the integral of F - 1 from 0 to X
//! ```

use mms_gallery::self_weight_column::{Parameters, prepare};

use crate::support::{TOLERANCE, Values, assert_agree, generated, in_box};

fn stress(parameters: &Parameters<f64>, x: f64) -> f64 {
    parameters.rho0 * parameters.gravity * (x - parameters.height)
}

fn stretch(parameters: &Parameters<f64>, x: f64) -> f64 {
    let (p, mu) = (stress(parameters, x), parameters.young / 2.0);
    (p + (p * p + 4.0 * mu * mu).sqrt()) / (2.0 * mu)
}

fn columns() -> [Parameters<f64>; 2] {
    let soft = Parameters { height: 2.5, young: 2e4, ..Parameters::default() };
    [Parameters::default(), soft]
}

#[test]
fn the_generated_column_is_the_column_on_paper() {
    for parameters in columns() {
        let by_hand = |[x]: [f64; 1], _| Values {
            jacobian: stretch(&parameters, x),
            stress: vec![stress(&parameters, x)],
            force: vec![-parameters.gravity],
        };
        let points = in_box([0.0], [parameters.height], [0.0, 1.0]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}

#[test]
fn the_displacement_is_the_integral_of_the_strain() {
    for parameters in columns() {
        let field = prepare(&parameters);
        // Simpson's rule: the error is of fourth order in the step.
        let steps = 1000;
        let step = parameters.height / f64::from(steps);
        let mut sum = 0.0;
        for k in 0..steps {
            let at = |part: f64| stretch(&parameters, (f64::from(k) + part) * step) - 1.0;
            sum += step / 6.0 * (at(0.0) + 4.0 * at(0.5) + at(1.0));
            let x = f64::from(k + 1) * step;
            let u = field.at_time(0.0).displacement([x])[0];
            assert!((u - sum).abs() < 1e-12 * parameters.height, "u({x}): {u}, integrated {sum}");
        }
    }
}
