//! Tensors with all nine components: what a field of one or two dimensions leaves out is that of plane strain, or of
//! uniaxial strain.
//!
//! F_33 = 1 there, shears out of the plane are 0, and the normal stress follows from the pressure, in which it is: with D
//! dimensions, sigma_33 = (-3 p - tr sigma)/(3 - D), tr being that of the D x D components. P_33 = S_33 = tau_33 = J sigma_33,
//! without J at small strain.

use mms_mechanics::invariant::Kind;
use mms_runtime::math::Scalar;
use mms_spec::quantity::{Quantity, Shape};

/// Rows and columns in space.
pub const SPACE: usize = 3;

/// What stresses out of the plane follow from.
pub const NEEDED: [Quantity; 3] = [Quantity::CauchyStress, Quantity::Pressure, Quantity::Jacobian];

/// What stands on the diagonal of a tensor beyond the dimensions of the field.
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
    /// That of a quantity; none where it is no tensor. At small strain all stresses are one.
    pub fn of(quantity: Quantity, kind: &Kind) -> Option<Beyond> {
        let is_small = *kind == Kind::SmallStrain;
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

    /// Whether it takes stresses to know it.
    pub fn is_stress(self) -> bool {
        matches!(self, Beyond::Cauchy | Beyond::Kirchhoff)
    }

    /// Its value, with the stress in the plane, the pressure and J where it is a stress.
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

/// All nine components, by rows, of those that a field of so many dimensions has.
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
