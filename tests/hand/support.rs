//! The common parts of the derivations: points, the comparison, and the neo-Hookean law in three dimensions.

use mms_runtime::Matrix;

/// J, P and b at a point and a time; P row-major.
#[derive(Debug)]
pub struct Values {
    pub jacobian: f64,
    pub stress: Vec<f64>,
    pub force: Vec<f64>,
}

impl Values {
    /// The values of a field of `D` dimensions, from P and b in three.
    pub fn leading<const D: usize>(
        jacobian: f64,
        stress: &Matrix<f64, 3>,
        force: [f64; 3],
    ) -> Values {
        let stress = (0..D * D).map(|k| stress[(k / D, k % D)]).collect();
        Values { jacobian, stress, force: force[..D].to_vec() }
    }
}

/// The values of a prepared field of the gallery, as a function of X and t.
macro_rules! generated {
    ($field:expr) => {{
        let field = $field;
        move |x, t| {
            let at = field.at_time(t);
            $crate::support::Values {
                jacobian: at.jacobian(x),
                stress: at.first_piola_kirchhoff(x).concat(),
                force: at.body_force(x).to_vec(),
            }
        }
    }};
}
pub(crate) use generated;

/// Both sides round some hundred operations, relative to the largest value over all points.
pub const TOLERANCE: f64 = 1e-12;

/// Asserts that two derivations of J, P and b agree at all points: each differs by at most `tolerance` of the largest value of
/// its kind.
#[track_caller]
pub fn assert_agree<const D: usize>(
    tolerance: f64,
    points: &[([f64; D], f64)],
    generated: impl Fn([f64; D], f64) -> Values,
    by_hand: impl Fn([f64; D], f64) -> Values,
) {
    let mut scale = [0.0; 3];
    let pairs: Vec<_> = points.iter().map(|&(x, t)| (generated(x, t), by_hand(x, t))).collect();
    for (_, by_hand) in &pairs {
        let values = [&[by_hand.jacobian], &by_hand.stress[..], &by_hand.force[..]];
        for (scale, values) in scale.iter_mut().zip(values) {
            *scale = values.iter().fold(*scale, |scale: f64, value| scale.max(value.abs()));
        }
    }
    for (point, (generated, by_hand)) in points.iter().zip(&pairs) {
        let kinds = [
            ("J", &[generated.jacobian][..], &[by_hand.jacobian][..]),
            ("P", &generated.stress, &by_hand.stress),
            ("b", &generated.force, &by_hand.force),
        ];
        for ((kind, generated, by_hand), scale) in kinds.into_iter().zip(scale) {
            assert_eq!(generated.len(), by_hand.len(), "components of {kind}");
            let is_close = |(a, b): (&f64, &f64)| (a - b).abs() <= tolerance * scale;
            assert!(
                generated.iter().zip(by_hand).all(is_close),
                "{kind} at {point:?}: generated {generated:?}, by hand {by_hand:?}, scale {scale:e}"
            );
        }
    }
}

/// Numbers from 0 to 1: xorshift64* (Vigna, ACM TOMS 42, 2016).
pub fn random() -> impl FnMut() -> f64 {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    move || {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Points of a box, and times of a window.
pub fn in_box<const D: usize>(
    lower: [f64; D],
    upper: [f64; D],
    time: [f64; 2],
) -> Vec<([f64; D], f64)> {
    let mut random = random();
    let mut between = move |from: f64, to: f64| from + (to - from) * random();
    (0..500)
        .map(|_| {
            let x = std::array::from_fn(|axis| between(lower[axis], upper[axis]));
            (x, between(time[0], time[1]))
        })
        .collect()
}

/// Points of a ring, and times of a window.
pub fn in_ring(inner: f64, outer: f64, time: [f64; 2]) -> Vec<([f64; 2], f64)> {
    let polar = in_box([inner, 0.0], [outer, std::f64::consts::TAU], time).into_iter();
    polar.map(|([r, theta], t)| ([r * theta.cos(), r * theta.sin()], t)).collect()
}

/// The law of most of these fields: W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2.
#[derive(Clone, Copy)]
pub struct NeoHookean {
    pub lambda: f64,
    pub mu: f64,
}

impl NeoHookean {
    /// Lame's parameters from Young's modulus and Poisson's ratio.
    pub fn of(young: f64, nu: f64) -> Self {
        let lambda = young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
        Self { lambda, mu: young / (2.0 * (1.0 + nu)) }
    }

    /// The bulk modulus.
    pub fn bulk(&self) -> f64 {
        self.lambda + 2.0 * self.mu / 3.0
    }

    /// P = mu F + (lambda ln J - mu) F^-T.
    pub fn stress(&self, f: &Matrix<f64, 3>) -> Matrix<f64, 3> {
        let pressure = self.lambda * f.determinant().ln() - self.mu;
        f * self.mu + inverse(f).transpose() * pressure
    }

    /// m' = (lambda (1 - ln J) + mu)/J^2, the slope of m(J) = (lambda ln J - mu)/J. Since P =
    /// mu F + m cof F and Div cof F = 0, (Div P)_i = mu Lap u_i + m' (cof F)_iJ J,J.
    pub fn cofactor_slope(&self, jacobian: f64) -> f64 {
        (self.lambda * (1.0 - jacobian.ln()) + self.mu) / (jacobian * jacobian)
    }

    /// Div P, the sum over J of P_iJ,J, where `slopes` are F,X, F,Y and F,Z. By the product rule,
    /// with (F^-T)' = -F^-T F'^T F^-T and (ln J)' = tr(F^-1 F'):
    ///
    /// ```text
    /// P' = mu F' + (mu - lambda ln J) F^-T F'^T F^-T + lambda tr(F^-1 F') F^-T
    /// ```
    pub fn divergence(&self, f: &Matrix<f64, 3>, slopes: &[Matrix<f64, 3>; 3]) -> [f64; 3] {
        let inverse = inverse(f);
        let transposed = inverse.transpose();
        let resistance = self.mu - self.lambda * f.determinant().ln();
        let mut divergence = [0.0; 3];
        for (axis, slope) in slopes.iter().enumerate() {
            let dilation = (inverse * slope).trace();
            let change = slope * self.mu
                + transposed * slope.transpose() * transposed * resistance
                + transposed * (self.lambda * dilation);
            for (row, divergence) in divergence.iter_mut().enumerate() {
                *divergence += change[(row, axis)];
            }
        }
        divergence
    }
}

fn inverse(f: &Matrix<f64, 3>) -> Matrix<f64, 3> {
    f.try_inverse().expect("J > 0")
}
