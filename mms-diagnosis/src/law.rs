//! Published isotropic laws, each linear in lambda and mu, for comparison with what a solver computes.
//!
//! They are typed here by hand, as the Kirchhoff stress tau of F in three dimensions. In plane strain the rest of F's diagonal
//! is 1. All have the same stress where F is near I.

use mms_runtime::Matrix;

/// A matrix in space.
pub type Tensor = Matrix<f64, 3>;

/// A law tau = lambda L(F) + mu M(F).
#[derive(Clone, Copy, Debug)]
pub struct PublishedLaw {
    /// The identifier of the law.
    pub name: &'static str,
    /// W, or the stress if there is no W.
    pub formula: &'static str,
    /// L and M.
    pub parts: fn(&Tensor) -> [Tensor; 2],
}

/// All published laws.
pub const LAWS: [PublishedLaw; 10] = [
    PublishedLaw {
        name: "neo_hookean",
        formula: "mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2",
        parts: |f| [identity(f.determinant().ln()), left(f) - identity(1.0)],
    },
    PublishedLaw {
        name: "neo_hookean_quadratic",
        formula: "mu/2 (I1 - 3) - mu ln J + lambda/2 (J - 1)^2",
        parts: |f| {
            let j = f.determinant();
            [identity(j * (j - 1.0)), left(f) - identity(1.0)]
        },
    },
    PublishedLaw {
        name: "neo_hookean_ciarlet",
        formula: "mu/2 (I1 - 3) - mu ln J + lambda/4 (J^2 - 1 - 2 ln J)",
        parts: |f| {
            let j = f.determinant();
            [identity((j * j - 1.0) / 2.0), left(f) - identity(1.0)]
        },
    },
    PublishedLaw {
        name: "neo_hookean_linear_volume",
        formula: "mu/2 (I1 - 3) - mu ln J + lambda (J - 1 - ln J)",
        parts: |f| [identity(f.determinant() - 1.0), left(f) - identity(1.0)],
    },
    PublishedLaw {
        name: "neo_hookean_isochoric",
        formula: "mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2",
        parts: |f| {
            let j = f.determinant();
            isochoric(f, j * (j - 1.0))
        },
    },
    PublishedLaw {
        name: "neo_hookean_isochoric_logarithmic",
        formula: "mu/2 (J^(-2/3) I1 - 3) + kappa/2 (ln J)^2",
        parts: |f| isochoric(f, f.determinant().ln()),
    },
    PublishedLaw {
        name: "neo_hookean_isochoric_mixed",
        formula: "mu/2 (J^(-2/3) I1 - 3) + kappa/4 (J^2 - 1 - 2 ln J)",
        parts: |f| isochoric(f, (f.determinant().powi(2) - 1.0) / 2.0),
    },
    PublishedLaw {
        name: "saint_venant_kirchhoff",
        formula: "lambda/2 (tr E)^2 + mu E:E",
        parts: |f| {
            let e = (f.transpose() * f - identity(1.0)) / 2.0;
            let push = |s: Tensor| f * s * f.transpose();
            [push(identity(e.trace())), push(e * 2.0)]
        },
    },
    PublishedLaw {
        name: "hencky",
        formula: "lambda/2 (tr ln U)^2 + mu ln U:ln U",
        parts: |f| {
            let b = left(f).symmetric_eigen();
            let logarithms = Tensor::from_diagonal(&b.eigenvalues.map(f64::ln));
            let strain = b.eigenvectors * logarithms * b.eigenvectors.transpose() / 2.0;
            [identity(strain.trace()), strain * 2.0]
        },
    },
    PublishedLaw {
        name: "linear_elastic",
        formula: "P = lambda tr(e) I + 2 mu e, e = sym H: small strains",
        parts: |f| {
            let h = f - identity(1.0);
            let strain = (h + h.transpose()) / 2.0;
            [identity(strain.trace()) * f.transpose(), strain * 2.0 * f.transpose()]
        },
    },
];

fn identity(factor: f64) -> Tensor {
    Tensor::identity() * factor
}

fn left(f: &Tensor) -> Tensor {
    // Written term by term: a product of matrices makes a call for each of its columns.
    let entry =
        |i: usize, j: usize| f[(i, 0)] * f[(j, 0)] + f[(i, 1)] * f[(j, 1)] + f[(i, 2)] * f[(j, 2)];
    let [xy, xz, yz] = [entry(0, 1), entry(0, 2), entry(1, 2)];
    Tensor::new(entry(0, 0), xy, xz, xy, entry(1, 1), yz, xz, yz, entry(2, 2))
}

/// The parts of mu J^(-2/3) dev(B) + kappa v I, with kappa = lambda + 2 mu/3.
fn isochoric(f: &Tensor, volumetric: f64) -> [Tensor; 2] {
    let b = left(f);
    let deviator = b - identity(b.trace() / 3.0);
    let shear = deviator * f.determinant().powf(-2.0 / 3.0);
    [identity(volumetric), shear + identity(2.0 / 3.0 * volumetric)]
}

/// F in space, from H in D dimensions.
pub fn in_space<const D: usize>(gradient: &Matrix<f64, D>) -> Tensor {
    let entry = |i: usize, j: usize| if i < D && j < D { gradient[(i, j)] } else { 0.0 };
    Tensor::identity() + Tensor::from_fn(entry)
}

/// The leading D x D part of a tensor in space.
pub fn in_plane<const D: usize>(tensor: &Tensor) -> Matrix<f64, D> {
    Matrix::from_fn(|i, j| tensor[(i, j)])
}

impl PublishedLaw {
    /// L and M for H in D dimensions.
    pub fn in_dimension<const D: usize>(&self, gradient: &Matrix<f64, D>) -> [Matrix<f64, D>; 2] {
        (self.parts)(&in_space(gradient)).map(|part| in_plane(&part))
    }

    /// tau for H in D dimensions.
    pub fn stress<const D: usize>(
        &self,
        moduli: [f64; 2],
        gradient: &Matrix<f64, D>,
    ) -> Matrix<f64, D> {
        let [stress] = self.stresses([moduli], gradient);
        stress
    }

    /// tau for each of several pairs of moduli.
    pub fn stresses<const D: usize, const N: usize>(
        &self,
        moduli: [[f64; 2]; N],
        gradient: &Matrix<f64, D>,
    ) -> [Matrix<f64, D>; N] {
        let [of_lambda, of_mu] = self.in_dimension(gradient);
        moduli.map(|[lambda, mu]| of_lambda * lambda + of_mu * mu)
    }
}

/// lambda and mu with which a law comes nearest to some stresses, and the relative difference that remains. `None` if the
/// stresses do not determine both.
pub fn moduli<const D: usize>(
    law: &PublishedLaw,
    samples: &[(Matrix<f64, D>, Matrix<f64, D>)],
) -> Option<([f64; 2], f64)> {
    let (mut normal, mut right, mut size) = ([0.0; 3], [0.0; 2], 0.0);
    for (gradient, stress) in samples {
        let [l, m] = law.in_dimension(gradient);
        normal = [normal[0] + l.dot(&l), normal[1] + l.dot(&m), normal[2] + m.dot(&m)];
        right = [right[0] + l.dot(stress), right[1] + m.dot(stress)];
        size += stress.norm_squared();
    }
    let determinant = normal[0] * normal[2] - normal[1] * normal[1];
    if !(determinant > 1e-12 * normal[0] * normal[2] && size > 0.0) {
        return None;
    }
    let lambda = (right[0] * normal[2] - right[1] * normal[1]) / determinant;
    let mu = (right[1] * normal[0] - right[0] * normal[1]) / determinant;
    let miss = |(h, stress): &(Matrix<f64, D>, Matrix<f64, D>)| {
        (law.stress([lambda, mu], h) - stress).norm_squared()
    };
    let missed: f64 = samples.iter().map(miss).sum();
    Some(([lambda, mu], (missed / size).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A law by its name, and its W.
    type Energy<'a> = (&'a str, &'a dyn Fn(&Tensor) -> f64);

    /// P = dW/dF by central differences of the energies that the formulas name.
    #[test]
    fn stresses_are_derivatives_of_the_energies() {
        let [lambda, mu] = [1.7, 0.6];
        let kappa = lambda + 2.0 / 3.0 * mu;
        let invariant = |f: &Tensor| (f.transpose() * f).trace();
        let energies: [Energy<'_>; 9] = [
            ("neo_hookean", &|f| {
                let ln = f.determinant().ln();
                mu / 2.0 * (invariant(f) - 3.0) - mu * ln + lambda / 2.0 * ln * ln
            }),
            ("neo_hookean_quadratic", &|f| {
                let j = f.determinant();
                mu / 2.0 * (invariant(f) - 3.0) - mu * j.ln() + lambda / 2.0 * (j - 1.0).powi(2)
            }),
            ("neo_hookean_ciarlet", &|f| {
                let j = f.determinant();
                mu / 2.0 * (invariant(f) - 3.0) - mu * j.ln()
                    + lambda / 4.0 * (j * j - 1.0 - 2.0 * j.ln())
            }),
            ("neo_hookean_linear_volume", &|f| {
                let j = f.determinant();
                mu / 2.0 * (invariant(f) - 3.0) - mu * j.ln() + lambda * (j - 1.0 - j.ln())
            }),
            ("neo_hookean_isochoric", &|f| {
                let j = f.determinant();
                mu / 2.0 * (j.powf(-2.0 / 3.0) * invariant(f) - 3.0)
                    + kappa / 2.0 * (j - 1.0).powi(2)
            }),
            ("neo_hookean_isochoric_logarithmic", &|f| {
                let j = f.determinant();
                mu / 2.0 * (j.powf(-2.0 / 3.0) * invariant(f) - 3.0) + kappa / 2.0 * j.ln().powi(2)
            }),
            ("neo_hookean_isochoric_mixed", &|f| {
                let j = f.determinant();
                mu / 2.0 * (j.powf(-2.0 / 3.0) * invariant(f) - 3.0)
                    + kappa / 4.0 * (j * j - 1.0 - 2.0 * j.ln())
            }),
            ("saint_venant_kirchhoff", &|f| {
                let e = (f.transpose() * f - identity(1.0)) / 2.0;
                lambda / 2.0 * e.trace().powi(2) + mu * e.dot(&e)
            }),
            ("hencky", &|f| {
                let values = (f.transpose() * f).symmetric_eigenvalues().map(|it| it.ln() / 2.0);
                lambda / 2.0 * values.sum().powi(2) + mu * values.norm_squared()
            }),
        ];
        let f = Tensor::new(1.2, 0.1, -0.05, 0.3, 0.9, 0.07, -0.2, 0.15, 1.1);
        for (name, energy) in energies {
            let law = LAWS.iter().find(|law| law.name == name).unwrap();
            let stress = law.stress([lambda, mu], &(f - identity(1.0)));
            let slope = Tensor::from_fn(|i, j| {
                let mut step = Tensor::zeros();
                step[(i, j)] = 1e-6;
                (energy(&(f + step)) - energy(&(f - step))) / 2e-6
            });
            assert!((stress - slope * f.transpose()).norm() < 1e-8, "{name}: {stress} {slope}");
        }
    }

    #[test]
    fn laws_are_the_same_at_small_strains() {
        let h = Tensor::new(1.0, 0.5, -0.3, 0.2, -0.7, 0.4, 0.1, 0.6, 0.3) * 1e-7;
        let linear = LAWS[LAWS.len() - 1].stress([1.7, 0.6], &h);
        for law in LAWS {
            let stress = law.stress([1.7, 0.6], &h);
            assert!((stress - linear).norm() < 1e-6 * linear.norm(), "{}", law.name);
        }
    }

    #[test]
    fn moduli_are_found_again() {
        let gradient =
            |k: f64| Matrix::<f64, 2>::from_fn(|i, j| 0.2 * (k + 3.0 * i as f64 + j as f64).sin());
        let sample = |k: f64| (gradient(k), LAWS[4].stress([5.0, 2.0], &gradient(k)));
        let samples = [1.0, 2.0, 5.0].map(sample);
        let ([lambda, mu], missed) = moduli(&LAWS[4], &samples).unwrap();
        assert!((lambda - 5.0).abs() < 1e-12 && (mu - 2.0).abs() < 1e-12 && missed < 1e-13);
        assert!(moduli(&LAWS[0], &samples).unwrap().1 > 1e-3);
    }
}
