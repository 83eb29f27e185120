//! The common part of the derivations of fields in plane strain: the algebra of a displacement gradient H and of its
//! derivatives, entry by entry.
//!
//! F = I + H, J = F11 F22 - F12 F21, cof F = J F^-T. Derivatives are product rules:
//!
//! ```text
//! J,J = cof F_mK u_m,KJ     I1,J = 2 F_mK u_m,KJ     cof_iJ,J = 0   (Piola)
//! ```

use std::f64::consts::PI;

use crate::support::Values;

pub type Matrix = [[f64; 2]; 2];

/// A function of one coordinate: its value, slope and curvature.
pub type Profile = [f64; 3];

/// sin(k x).
pub fn sine(k: f64, x: f64) -> Profile {
    let (sin, cos) = (k * x).sin_cos();
    [sin, k * cos, -k * k * sin]
}

/// cos(k x).
pub fn cosine(k: f64, x: f64) -> Profile {
    let (sin, cos) = (k * x).sin_cos();
    [cos, -k * sin, -k * k * cos]
}

/// x/L.
pub fn linear(length: f64, x: f64) -> Profile {
    [x / length, 1.0 / length, 0.0]
}

/// The waves of these fields: u1 = a p1(X) q1(Y) and u2 = b p2(X) q2(Y), with k = pi/L, w = k c,
/// c^2 = E/rho0, a = A cos(w t) and b = A/2 cos(w t + pi/3).
pub struct Waves {
    pub k: f64,
    /// w.
    pub frequency: f64,
    /// a and b.
    pub amplitudes: [f64; 2],
    /// a' and b'.
    pub rates: [f64; 2],
}

impl Waves {
    pub fn new(length: f64, young: f64, rho0: f64, amplitude: f64, time: f64) -> Self {
        let k = PI / length;
        let frequency = k * (young / rho0).sqrt();
        let phases = [frequency * time, frequency * time + PI / 3.0];
        let sizes = [amplitude, amplitude / 2.0];
        Waves {
            k,
            frequency,
            amplitudes: [0, 1].map(|i| sizes[i] * phases[i].cos()),
            rates: [0, 1].map(|i| -frequency * sizes[i] * phases[i].sin()),
        }
    }

    /// u'' = -w^2 u.
    pub fn acceleration(&self, strained: &Strained) -> [f64; 2] {
        strained.displacement.map(|u| -self.frequency * self.frequency * u)
    }

    /// The values of a field that is given by u alone.
    pub fn values(&self, strained: &Strained, solid: Solid, rho0: f64) -> Values {
        solid.values(strained.jacobian(), self.acceleration(strained), rho0)
    }
}

/// A strained point of a plane.
pub struct Strained {
    /// u_i.
    pub displacement: [f64; 2],
    /// H_iJ.
    pub gradient: Matrix,
    /// u_i,JK.
    pub second: [Matrix; 2],
}

impl Strained {
    /// u_i = a_i p_i(X) q_i(Y).
    pub fn product(amplitudes: [f64; 2], profiles: [[Profile; 2]; 2]) -> Self {
        let part = |i: usize, x: usize, y: usize| {
            let [p, q] = profiles[i];
            amplitudes[i] * p[x] * q[y]
        };
        Strained {
            displacement: [0, 1].map(|i| part(i, 0, 0)),
            gradient: [0, 1].map(|i| [part(i, 1, 0), part(i, 0, 1)]),
            second: [0, 1]
                .map(|i| [[part(i, 2, 0), part(i, 1, 1)], [part(i, 1, 1), part(i, 0, 2)]]),
        }
    }

    pub fn deformation(&self) -> Matrix {
        let h = self.gradient;
        [[1.0 + h[0][0], h[0][1]], [h[1][0], 1.0 + h[1][1]]]
    }

    pub fn cofactor(&self) -> Matrix {
        let f = self.deformation();
        [[f[1][1], -f[1][0]], [-f[0][1], f[0][0]]]
    }

    pub fn jacobian(&self) -> f64 {
        let f = self.deformation();
        f[0][0] * f[1][1] - f[0][1] * f[1][0]
    }

    /// I1 of F in space, where the third stretch is 1.
    pub fn first_invariant(&self) -> f64 {
        let f = self.deformation();
        f[0][0] * f[0][0] + f[0][1] * f[0][1] + f[1][0] * f[1][0] + f[1][1] * f[1][1] + 1.0
    }

    /// A_mK u_m,KJ for J = 1, 2.
    fn along(&self, a: Matrix) -> [f64; 2] {
        [0, 1].map(|j| {
            let row = |m: usize| a[m][0] * self.second[m][0][j] + a[m][1] * self.second[m][1][j];
            row(0) + row(1)
        })
    }

    pub fn jacobian_slope(&self) -> [f64; 2] {
        self.along(self.cofactor())
    }

    pub fn first_invariant_slope(&self) -> [f64; 2] {
        self.along(self.deformation()).map(|half| 2.0 * half)
    }

    pub fn laplacian(&self) -> [f64; 2] {
        [0, 1].map(|i| self.second[i][0][0] + self.second[i][1][1])
    }

    /// q = kappa (J - 1) - m I1/(3 J) and its gradient: the addition of a separate volume law to P = m F.
    pub fn isochoric_pressure(&self, kappa: f64, m: f64, m_slope: [f64; 2]) -> (f64, [f64; 2]) {
        let (j, i1) = (self.jacobian(), self.first_invariant());
        let (j_slope, i1_slope) = (self.jacobian_slope(), self.first_invariant_slope());
        let slope = [0, 1].map(|axis| {
            kappa * j_slope[axis] - (m_slope[axis] * i1 + m * i1_slope[axis]) / (3.0 * j)
                + m * i1 * j_slope[axis] / (3.0 * j * j)
        });
        (kappa * (j - 1.0) - m * i1 / (3.0 * j), slope)
    }

    /// P = m F + q cof F and Div P = m Lap u + F grad m + cof F grad q.
    pub fn solid(&self, m: f64, m_slope: [f64; 2], q: f64, q_slope: [f64; 2]) -> Solid {
        let (f, cofactor, laplacian) = (self.deformation(), self.cofactor(), self.laplacian());
        let stress = [0, 1].map(|i| [0, 1].map(|j| m * f[i][j] + q * cofactor[i][j]));
        let divergence = [0, 1].map(|i| {
            let sheared = f[i][0] * m_slope[0] + f[i][1] * m_slope[1];
            let pressed = cofactor[i][0] * q_slope[0] + cofactor[i][1] * q_slope[1];
            m * laplacian[i] + sheared + pressed
        });
        Solid { stress, divergence }
    }
}

/// P and Div P.
pub struct Solid {
    pub stress: Matrix,
    pub divergence: [f64; 2],
}

impl Solid {
    /// J, P and b = a - Div P/rho0.
    pub fn values(&self, jacobian: f64, acceleration: [f64; 2], rho0: f64) -> Values {
        let force = [0, 1].map(|i| acceleration[i] - self.divergence[i] / rho0);
        Values { jacobian, stress: self.stress.concat(), force: force.to_vec() }
    }
}

/// A field of the gallery against paper: `$on_paper` is a function of its parameters, a point and a
/// time.
macro_rules! compare {
    ($field:ident, $varied:expr, $on_paper:expr) => {
        for parameters in [Parameters::<f64>::default(), $varied] {
            let Parameters { length, young, rho0, .. } = parameters;
            let window = [0.0, 0.75 * length / (young / rho0).sqrt()];
            crate::support::assert_agree(
                crate::support::TOLERANCE,
                &crate::support::in_box([0.0; 2], [length; 2], window),
                crate::support::generated!(mms_gallery::$field::prepare(&parameters)),
                |point, time| $on_paper(&parameters, point, time),
            );
        }
    };
}

pub(crate) use compare;
