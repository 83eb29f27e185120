//! A bar pulled ever faster, derived by hand.
//!
//! ```text
//! u = s X (c t/L)^2,  c^2 = E/rho0
//! F = 1 + s (c t/L)^2, the same at every point, and so is P = mu (F - 1/F) + lambda ln F/F
//! b = a = 2 s X (c/L)^2, since Div P = 0
//! ```

use mms_gallery::uniform_stretch::{Parameters, prepare};

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, generated, in_box};

#[test]
fn the_generated_bar_is_the_bar_on_paper() {
    let odd = Parameters::<f64> { length: 3.0, nu: -0.2, stretch: -0.2, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { length, young, nu, rho0, stretch } = parameters;
        let NeoHookean { lambda, mu } = NeoHookean::of(young, nu);
        let rate = (young / rho0).sqrt() / length;
        let by_hand = |[x]: [f64; 1], t: f64| {
            let f = 1.0 + stretch * (rate * t).powi(2);
            Values {
                jacobian: f,
                stress: vec![mu * (f - 1.0 / f) + lambda * f.ln() / f],
                force: vec![2.0 * stretch * x * rate * rate],
            }
        };
        let points = in_box([0.0], [length], [0.0, 2.0 / rate]);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
