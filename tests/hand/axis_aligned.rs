//! Standing waves along the axes (Wallstedt & Guilkey, JCP 227, 2008), derived by hand for any
//! number of dimensions.
//!
//! ```text
//! u_i  = a sin(k X_i) sin(c k t + phi_i),  k = pi/L,  c^2 = E/rho0,  phi = 0, 2 pi/3, 4 pi/3
//! F_ii = 1 + k a cos(k X_i) sin(c k t + phi_i) = F_i, and 0 beside the diagonal;  J = F_1 F_2 F_3
//! P_ii = mu (F_i - 1/F_i) + lambda ln J/F_i
//! dP_ii/dX_i = [mu (1 + F_i^-2) + lambda (1 - ln J) F_i^-2] F_i,i,   F_i,i = -k^2 u_i
//! b_i  = -(c k)^2 u_i - dP_ii/dX_i/rho0
//!      = k^2 u_i/rho0 [lambda (1 - ln J)/F_i^2 + mu (1 + 1/F_i^2) - E]
//! ```

use std::f64::consts::PI;

use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, in_box};

/// The parameters of one body.
pub struct Waves {
    pub length: f64,
    pub young: f64,
    pub nu: f64,
    pub rho0: f64,
    pub amplitude: f64,
}

impl Waves {
    fn values<const D: usize>(&self, x: [f64; D], t: f64) -> Values {
        let &Waves { length, young, nu, rho0, amplitude } = self;
        let NeoHookean { lambda, mu } = NeoHookean::of(young, nu);
        let k = PI / length;
        let angle = (young / rho0).sqrt() * k * t;
        let pulse = |axis: usize| amplitude * (angle + 2.0 * PI / 3.0 * axis as f64).sin();
        let stretch: [f64; D] =
            std::array::from_fn(|axis| 1.0 + k * pulse(axis) * (k * x[axis]).cos());
        let jacobian: f64 = stretch.iter().product();
        let mut stress = vec![0.0; D * D];
        let mut force = vec![0.0; D];
        for (axis, f) in stretch.into_iter().enumerate() {
            let u = pulse(axis) * (k * x[axis]).sin();
            stress[axis * D + axis] = mu * (f - 1.0 / f) + lambda * jacobian.ln() / f;
            let bracket =
                lambda * (1.0 - jacobian.ln()) / (f * f) + mu * (1.0 + 1.0 / (f * f)) - young;
            force[axis] = k * k * u / rho0 * bracket;
        }
        Values { jacobian, stress, force }
    }

    /// Asserts that generated functions equal the derivation above, over one period.
    #[track_caller]
    pub fn assert_are<const D: usize>(&self, generated: impl Fn([f64; D], f64) -> Values) {
        let period = 2.0 * self.length / (self.young / self.rho0).sqrt();
        let points = in_box([0.0; D], [self.length; D], [0.0, period]);
        assert_agree(TOLERANCE, &points, generated, |x, t| self.values(x, t));
    }
}
