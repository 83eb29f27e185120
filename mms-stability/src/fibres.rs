//! Moduli of a material that is stiffened by fibres: at rest it is isotropic about an axis.

use nalgebra::{DMatrix, Matrix3, Vector3};

use crate::elasticity::Elasticity;
use crate::resting::ISOTROPIC;
use crate::subject::Resting;

/// Moduli of a transversely isotropic material at rest: along its axis, and across.
#[derive(Clone, Debug, PartialEq)]
pub struct TransverseModuli {
    /// The direction of the fibres.
    pub axis: [f64; 3],
    /// Young's moduli.
    pub young: [f64; 2],
    /// Poisson's ratios: the lateral contraction across the axis under a pull along it, and under a pull across it.
    pub nu: [f64; 2],
    /// Shear moduli, of planes with the axis and of the plane across it.
    pub shear: [f64; 2],
}

impl Resting {
    /// The moduli of a material that is isotropic about an axis; `None` if it is isotropic, or isotropic about no axis.
    pub fn transverse_moduli(&self) -> Option<TransverseModuli> {
        if self.moduli().is_some() {
            return None;
        }
        let stiffness = self.stiffness();
        let axes = [[0, 2, 1, 3], [0, 1, 2, 3]].map(|order| own_axis(&stiffness, order));
        axes.into_iter().flatten().find_map(|axis| about(&stiffness, axis))
    }
}

/// The eigenvector of a contraction, C_ikjk or C_ijkk, whose eigenvalue is separate from both others.
fn own_axis(stiffness: &Elasticity<3>, [i, j, k, l]: [usize; 4]) -> Option<Vector3<f64>> {
    let entry = |row: usize, column: usize| -> f64 {
        let index = |own: usize| {
            let all = [row, column, own, own];
            [all[i], all[j], all[k], all[l]]
        };
        (0..3).map(|own| stiffness.at(index(own))).sum()
    };
    let eigen = DMatrix::from_fn(3, 3, entry).symmetric_eigen();
    let value = |at: usize| eigen.eigenvalues[at];
    let apart = |at: usize| (1..3).map(move |by| (value(at) - value((at + by) % 3)).abs());
    let least = |at: &usize| apart(*at).fold(f64::INFINITY, f64::min);
    let axis = (0..3).max_by(|a, b| least(a).total_cmp(&least(b)))?;
    (least(&axis) > ISOTROPIC * stiffness.norm())
        .then(|| Vector3::from_fn(|row, _| eigen.eigenvectors[(row, axis)]))
}

/// The moduli about an axis; `None` if the material is not isotropic about it.
fn about(stiffness: &Elasticity<3>, axis: Vector3<f64>) -> Option<TransverseModuli> {
    let axis = axis * axis[axis.iamax()].signum();
    let aside = Vector3::from_fn(|row, _| f64::from(u8::from(row == axis.iamin())));
    let second = axis.cross(&aside).normalize();
    let frame = [axis, second, axis.cross(&second)];
    let turned = Elasticity::<3>::from_fn(|[i, j, k, l]| {
        let block = stiffness.contract(&frame[j], &frame[l]);
        frame[i].dot(&(block * frame[k]))
    });
    let own = |i: usize, j: usize| turned.at([i, i, j, j]);
    let shear = [turned.at([0, 1, 0, 1]), (own(1, 1) - own(1, 2)) / 2.0];
    let ideal = Elasticity::<3>::from_fn(|[i, j, k, l]| match (i == j, k == l) {
        (true, true) if i == k => own(i.min(1), i.min(1)),
        (true, true) if i == 0 || k == 0 => own(0, 1),
        (true, true) => own(1, 2),
        (false, false) if [i, j] == [k, l] || [i, j] == [l, k] => {
            shear[usize::from(i != 0 && j != 0)]
        }
        _ => 0.0,
    });
    let difference = Elasticity::<3>::from_fn(|at| turned.at(at) - ideal.at(at));
    if difference.norm() > ISOTROPIC * stiffness.norm() {
        return None;
    }
    let compliance = Matrix3::from_fn(own).try_inverse()?;
    Some(TransverseModuli {
        axis: axis.into(),
        young: [0, 1].map(|at| 1.0 / compliance[(at, at)]),
        nu: [0, 1].map(|at| -compliance[(at, at + 1)] / compliance[(at, at)]),
        shear,
    })
}
