//! The generalized vortex (Kamojjala, Brannon, Sadeghirad & Guilkey, Eng. Comput. 31, 2015),
//! derived by hand.
//!
//! ```text
//! x   = R e_r,  e_r and e_t being the polar basis at Theta + alpha,  alpha = g(t) h(R)
//! g   = A sin(w t),  h = (1 - s^2)^2,  s = (R - middle)/half_width
//!       (published as ((4 R - 3)(4 R - 5))^2, which is the same for 0.75 < R < 1.25)
//! F   = Q (I + gamma E_T E_R),  gamma = R g h',  Q the rotation by alpha;  J = 1
//! P   = mu (F - F^-T) = mu gamma (e_t E_R + e_r E_T)
//! Div P: e_t,R = -g h' e_r,  e_r,T = e_t,  E_R,T = E_T
//!     = mu [(gamma,R + 2 gamma/R) e_t - gamma g h' e_r]
//!     = mu [g (3 h' + R h'') e_t - R (g h')^2 e_r]
//! a   = R g'' h e_t - R (g' h)^2 e_r
//! b_r = -R (g' h)^2 + mu/rho0 R (g h')^2,  b_t = R g'' h - mu/rho0 g (3 h' + R h'')
//! ```

use std::f64::consts::PI;

use crate::support::{NeoHookean, Values};

/// The parameters of one vortex.
pub struct Vortex {
    pub middle: f64,
    pub half_width: f64,
    pub young: f64,
    pub nu: f64,
    pub rho0: f64,
    pub angle: f64,
}

impl Vortex {
    /// The period of g.
    pub fn period(&self) -> f64 {
        2.0 * self.middle / (self.young / self.rho0).sqrt()
    }

    fn mu(&self) -> f64 {
        NeoHookean::of(self.young, self.nu).mu
    }

    /// g, g' and g''.
    fn swing(&self, t: f64) -> [f64; 3] {
        let w = 2.0 * PI / self.period();
        let (sin, cos) = (w * t).sin_cos();
        [self.angle * sin, self.angle * w * cos, -self.angle * w * w * sin]
    }

    /// h, h' and h''.
    fn profile(&self, r: f64) -> [f64; 3] {
        let (w, s) = (self.half_width, (r - self.middle) / self.half_width);
        let rest = 1.0 - s * s;
        [rest * rest, -4.0 * s * rest / w, -4.0 * (1.0 - 3.0 * s * s) / (w * w)]
    }

    /// x(X, t).
    pub fn position(&self, [x, y]: [f64; 2], t: f64) -> [f64; 2] {
        let (sin, cos) = (self.swing(t)[0] * self.profile(x.hypot(y))[0]).sin_cos();
        [x * cos - y * sin, x * sin + y * cos]
    }

    /// J, P and b.
    pub fn values(&self, at: [f64; 2], t: f64) -> Values {
        let r = at[0].hypot(at[1]);
        let ([g, dg, ddg], [h, dh, ddh]) = (self.swing(t), self.profile(r));
        let mu = self.mu();
        let [x, y] = self.position(at, t);
        let (e_r, e_t) = ([x / r, y / r], [-y / r, x / r]);
        let (big_r, big_t) = ([at[0] / r, at[1] / r], [-at[1] / r, at[0] / r]);
        let entry = |i: usize, j: usize| mu * r * g * dh * (e_t[i] * big_r[j] + e_r[i] * big_t[j]);
        let along = -r * (dg * h).powi(2) + mu / self.rho0 * r * (g * dh).powi(2);
        let around = r * ddg * h - mu / self.rho0 * g * (3.0 * dh + r * ddh);
        Values {
            jacobian: 1.0,
            stress: vec![entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)],
            force: (0..2).map(|i| along * e_r[i] + around * e_t[i]).collect(),
        }
    }

    /// b as printed in inputs of several MPM codes, in the polar basis at Theta: in the component around the axis, the
    /// centripetal term R (g' h)^2 sin(alpha) has a plus sign.
    pub fn printed_force(&self, at: [f64; 2], t: f64) -> [f64; 2] {
        let [x, y] = at;
        let r = x.hypot(y);
        let ([g, dg, ddg], [h, dh, ddh]) = (self.swing(t), self.profile(r));
        let stiffness = self.mu() / self.rho0;
        let (sin, cos) = (g * h).sin_cos();
        let centripetal = r * (dg * h).powi(2);
        let bend = stiffness * r * (g * dh).powi(2);
        let around = r * ddg * h - stiffness * g * (3.0 * dh + r * ddh);
        let b_r = (bend - centripetal) * cos - around * sin;
        let b_t = (bend + centripetal) * sin + around * cos;
        [(b_r * x - b_t * y) / r, (b_r * y + b_t * x) / r]
    }
}
