//! The elasticity A = d2W/dF2 of one state, and its acoustic tensors.

use nalgebra::{DMatrix, SMatrix, SVector};

/// A_iJkL = dP_iJ/dF_kL, with A_iJkL = A_kLiJ.
#[derive(Clone, Debug, PartialEq)]
pub struct Elasticity<const D: usize> {
    /// By i, J, k, L, the last index fastest.
    components: Vec<f64>,
}

impl<const D: usize> Elasticity<D> {
    /// Creates the tensor from a function of i, J, k, L.
    pub fn from_fn(mut component: impl FnMut([usize; 4]) -> f64) -> Self {
        let digit = |place: usize, position: u32| place / D.pow(position) % D;
        let indices = |place| [3, 2, 1, 0].map(|position| digit(place, position));
        Elasticity { components: (0..D.pow(4)).map(|place| component(indices(place))).collect() }
    }

    /// A_iJkL.
    pub fn at(&self, [i, j, k, l]: [usize; 4]) -> f64 {
        self.components[((i * D + j) * D + k) * D + l]
    }

    /// Whether all components are finite.
    pub fn is_finite(&self) -> bool {
        self.components.iter().all(|component| component.is_finite())
    }

    /// The square root of the sum of the squares of all components.
    pub fn norm(&self) -> f64 {
        self.components.iter().map(|component| component * component).sum::<f64>().sqrt()
    }

    /// A_iJkL v_J w_L.
    pub fn contract(&self, v: &SVector<f64, D>, w: &SVector<f64, D>) -> SMatrix<f64, D, D> {
        SMatrix::from_fn(|i, k| {
            let terms = (0..D).flat_map(|j| (0..D).map(move |l| (j, l)));
            terms.map(|(j, l)| self.at([i, j, k, l]) * v[j] * w[l]).sum()
        })
    }

    /// The least of h_iJ A_iJkL h_kL over all h of length 1.
    pub fn least_eigenvalue(&self) -> f64 {
        DMatrix::from_row_slice(D * D, D * D, &self.components).symmetric_eigenvalues().min()
    }

    /// The least eigenvalue of the acoustic tensor of waves along a direction N.
    pub fn least_acoustic(&self, normal: &SVector<f64, D>) -> f64 {
        least_eigenvalue(&self.contract(normal, normal))
    }
}

/// The least eigenvalue of a symmetric matrix.
pub fn least_eigenvalue<const D: usize>(matrix: &SMatrix<f64, D, D>) -> f64 {
    if D == 2 {
        let (middle, half) =
            ((matrix[(0, 0)] + matrix[(1, 1)]) / 2.0, (matrix[(0, 0)] - matrix[(1, 1)]) / 2.0);
        return middle - half.hypot(matrix[(0, 1)]);
    }
    DMatrix::from_fn(D, D, |i, j| matrix[(i, j)]).symmetric_eigenvalues().min()
}

/// The unit vector along an axis.
pub fn unit<const D: usize>(axis: usize) -> SVector<f64, D> {
    SVector::from_fn(|own, _| f64::from(u8::from(own == axis)))
}
