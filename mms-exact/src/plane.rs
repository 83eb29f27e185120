//! Tensors with all nine components: a field of one or two dimensions omits the components of uniaxial or plane strain.
//!
//! F_33 = 1, shears out of the plane are 0, and the normal stress follows from the pressure, which includes it: with D
//! dimensions, sigma_33 = (-3 p - tr sigma)/(3 - D), where tr is the trace of the D x D components. P_33 = S_33 = tau_33 = J
//! sigma_33, without J at small strain.

use mms_mechanics::invariant::InvariantKind;
use mms_runtime::math::Scalar;
use mms_spec::quantity::{Quantity, Shape};

/// Rows and columns in space.
pub const SPACE: usize = 3;

/// The quantities from which stresses out of the plane follow.
pub const NEEDED: [Quantity; 3] = [Quantity::CauchyStress, Quantity::Pressure, Quantity::Jacobian];

/// The diagonal component of a tensor beyond the dimensions of the field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// 1, as in F.
    One,
    /// 0, as in E.
    Zero,
    /// sigma_33.
    Cauchy,
    /// J sigma_33.
    Kirchhoff,
}

impl Beyond {
    /// The diagonal component of a quantity; `None` if it is no tensor. At small strain all stresses are the same.
    pub fn of(quantity: Quantity, kind: &InvariantKind) -> Option<Beyond> {
        let is_small = *kind == InvariantKind::SmallStrain;
        match quantity {
            _ if quantity.shape() != Shape::Tensor => None,
            Quantity::DisplacementGradient | Quantity::GreenLagrange | Quantity::SmallStrain => {
                Some(Beyond::Zero)
            }
            Quantity::CauchyStress => Some(Beyond::Cauchy),
            Quantity::FirstPiolaKirchhoff
            | Quantity::NominalStress
            | Quantity::KirchhoffStress
            | Quantity::SecondPiolaKirchhoff => {
                Some(if is_small { Beyond::Cauchy } else { Beyond::Kirchhoff })
            }
            _ => Some(Beyond::One),
        }
    }

    /// Whether the component is computed from stresses.
    pub fn is_stress(self) -> bool {
        matches!(self, Beyond::Cauchy | Beyond::Kirchhoff)
    }

    /// The value; stresses are computed from the stress in the plane, the pressure and J.
    pub fn value<T: Scalar>(self, stress: &[T], pressure: &T, jacobian: &T) -> T {
        let number = T::from_f64;
        let cauchy = || {
            let dimension = if stress.len() == 1 { 1 } else { 2 };
            let trace = (0..dimension)
                .map(|axis| stress[axis * (dimension + 1)].clone())
                .fold(number(0.0), |sum, it| sum + it);
            (number(-3.0) * pressure.clone() - trace) / number((SPACE - dimension) as f64)
        };
        match self {
            Beyond::One => number(1.0),
            Beyond::Zero => number(0.0),
            Beyond::Cauchy => cauchy(),
            Beyond::Kirchhoff => cauchy() * jacobian.clone(),
        }
    }
}

/// All nine components, by rows, of a tensor of a field of `dimension` dimensions.
pub fn nine<T: Scalar>(own: &[T], dimension: usize, beyond: &T) -> Vec<T> {
    let entry = |at: usize| {
        let (row, column) = (at / SPACE, at % SPACE);
        match row.max(column) < dimension {
            true => own[row * dimension + column].clone(),
            false if row == column => beyond.clone(),
            false => T::from_f64(0.0),
        }
    };
    (0..SPACE * SPACE).map(entry).collect()
}
