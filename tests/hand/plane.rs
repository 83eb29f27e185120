//! What the fields in plane strain have in common on paper: the algebra of a displacement gradient
//! H and of its derivatives, entry by entry, and the comparison with what was generated.
//!
//! F = I + H, J = F11 F22 - F12 F21, cof F = J F^-T. Derivatives are product rules:
//!
//! ```text
//! J,J = cof F_mK u_m,KJ     I1,J = 2 F_mK u_m,KJ     cof_iJ,J = 0   (Piola)
//! ```

pub type Matrix = [[f64; 2]; 2];

/// Young's modulus and Poisson's ratio as the constants of Lame and the bulk modulus.
pub struct Moduli {
    pub lambda: f64,
    pub mu: f64,
    pub kappa: f64,
}

impl Moduli {
    pub fn new(young: f64, nu: f64) -> Self {
        let lambda = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
        let mu = young / (2.0 * (1.0 + nu));
        Moduli { lambda, mu, kappa: young / (3.0 * (1.0 - 2.0 * nu)) }
    }
}

/// A strained point of a plane.
pub struct Strained {
    /// H_iJ.
    pub gradient: Matrix,
    /// u_i,JK.
    pub second: [Matrix; 2],
}

impl Strained {
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

/// What a field is at one point and time, on paper.
pub struct Paper {
    pub jacobian: f64,
    pub acceleration: [f64; 2],
    pub solid: Solid,
    pub rho0: f64,
}

/// What was generated for the same: J, P and b.
pub struct Generated {
    pub jacobian: f64,
    pub stress: Matrix,
    pub body_force: [f64; 2],
}

/// Points and times over the square of that edge and the time window.
pub fn places(length: f64, end: f64) -> impl Iterator<Item = ([f64; 2], f64)> {
    let part = |index: usize, step: f64| (0.11 + step * index as f64).fract();
    (0..200).map(move |index| {
        // Multiples of irrational numbers are spread evenly (Weyl, Math. Ann. 77, 1916).
        let point = [part(index, 0.618_033_988_749_895), part(index, 0.414_213_562_373_095)];
        (point.map(|x| x * length), end * part(index, 0.302_775_637_731_995))
    })
}

/// J, P and b agree. By hand everything is written in F, which rounds terms of the size of the
/// modulus, some tens of them; in Div P they stand beside the curvature of u.
#[track_caller]
pub fn assert_agree(paper: &Paper, generated: &Generated, modulus: f64, curvature: f64) {
    let rounding = 256.0 * f64::EPSILON;
    let close = |what: &str, found: f64, expected: f64, scale: f64| {
        let error = (found - expected).abs();
        assert!(error <= rounding * scale, "{what}: generated {found:e}, by hand {expected:e}");
    };
    close("J", generated.jacobian, paper.jacobian, 1.0);
    for i in 0..2 {
        for j in 0..2 {
            close("P", generated.stress[i][j], paper.solid.stress[i][j], modulus);
        }
        let force = paper.acceleration[i] - paper.solid.divergence[i] / paper.rho0;
        let scale = paper.acceleration[i].abs() + modulus * curvature / paper.rho0;
        close("b", generated.body_force[i], force, scale);
    }
}

/// A field of the gallery against paper: `$on_paper` is a function of its parameters, a point and a
/// time.
macro_rules! compare {
    ($field:ident, $varied:expr, $on_paper:expr) => {
        for parameters in [Parameters::<f64>::default(), $varied] {
            let field = mms::gallery::$field::prepare(&parameters);
            let speed = (parameters.young / parameters.rho0).sqrt();
            let end = 0.75 * parameters.length / speed;
            let k = std::f64::consts::PI / parameters.length;
            for (point, time) in crate::plane::places(parameters.length, end) {
                let at = field.at_time(time);
                let generated = crate::plane::Generated {
                    jacobian: at.jacobian(point),
                    stress: at.first_piola_kirchhoff(point),
                    body_force: at.body_force(point),
                };
                let paper = $on_paper(&parameters, point, time);
                let curvature = parameters.amplitude * 4.0 * k * k;
                crate::plane::assert_agree(&paper, &generated, 4.0 * parameters.young, curvature);
            }
        }
    };
}

pub(crate) use compare;
