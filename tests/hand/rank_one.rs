//! Displacements along one direction, u = d phi(X), derived by hand: H has rank one.
//!
//! ```text
//! F       = I + d g,  g = grad phi;  J = 1 + d.g;  F^-T = I - g d/J  (Sherman & Morrison, 1950)
//! cof F   = J I - g d
//! grad J  = (grad grad phi) d
//! Div P   = mu Lap phi d + m' cof F grad J,  m' = (lambda (1 - ln J) + mu)/J^2
//! ```

use mms_runtime::{Matrix, Vector};

use crate::support::NeoHookean;

type Vector3 = Vector<f64, 3>;

/// A displacement of rank one at a point and a time.
pub struct RankOne {
    /// d.
    pub direction: Vector3,
    /// grad phi.
    pub gradient: Vector3,
    /// grad grad phi.
    pub hessian: Matrix<f64, 3>,
}

impl RankOne {
    /// 1 + d.g.
    pub fn jacobian(&self) -> f64 {
        1.0 + self.direction.dot(&self.gradient)
    }

    fn cofactor(&self) -> Matrix<f64, 3> {
        Matrix::identity() * self.jacobian() - self.gradient * self.direction.transpose()
    }

    /// P.
    pub fn stress(&self, law: &NeoHookean) -> Matrix<f64, 3> {
        let jacobian = self.jacobian();
        let f = Matrix::<f64, 3>::identity() + self.direction * self.gradient.transpose();
        f * law.mu + self.cofactor() * ((law.lambda * jacobian.ln() - law.mu) / jacobian)
    }

    /// Div P.
    pub fn divergence(&self, law: &NeoHookean) -> Vector3 {
        let slope = self.cofactor() * (self.hessian * self.direction);
        self.direction * (law.mu * self.hessian.trace())
            + slope * law.cofactor_slope(self.jacobian())
    }
}
