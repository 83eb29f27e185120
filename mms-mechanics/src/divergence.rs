//! Div P of a density of I1, I2, J and I4, term by term:
//!
//! ```text
//! (Div P)_i = alpha Lap u_i + F_iJ alpha,J + beta (F C)_iJ,J + (F C)_iJ beta,J
//!           + (gamma,J - gamma g_J) F^-1_Ji + graded_i + fibres_i,   g_J = (ln J),J
//! ```

use crate::tensor::{Tensor, dot};
use mms_symbolic::expr::{Expr, Graph};

/// The terms of Div P.
pub(super) struct Terms {
    /// F.
    pub deformation: Tensor,
    /// F C.
    pub cubic: Tensor,
    /// F^-1.
    pub inverse: Tensor,
    /// alpha, beta and gamma.
    pub coefficients: [Expr; 3],
    /// The gradients of the coefficients through the strain.
    pub slopes: [Vec<Expr>; 3],
    /// Lap u.
    pub laplacian: Vec<Expr>,
    /// (F C)_iJ,J.
    pub cubic_divergence: Vec<Expr>,
    /// g.
    pub log_volume: Vec<Expr>,
    /// dP_iJ/dX_J at fixed H.
    pub graded: Vec<Expr>,
    /// The part of fibres, if any: two products for each component.
    pub fibres: Option<Vec<[(Expr, Expr); 2]>>,
}

impl Terms {
    /// The components of Div P.
    pub fn sum(&self, graph: &mut Graph) -> Vec<Expr> {
        let dimension = self.laplacian.len();
        let [alpha, beta, gamma] = self.coefficients;
        let [alpha_slope, beta_slope, gamma_slope] = &self.slopes;
        let one = graph.number(1);
        let pressure: Vec<Expr> = (0..dimension)
            .map(|axis| {
                let product = graph.mul(gamma, self.log_volume[axis]);
                graph.sub(gamma_slope[axis], product)
            })
            .collect();
        let component = |row: usize| {
            let mut pairs = vec![(alpha, self.laplacian[row]), (beta, self.cubic_divergence[row])];
            for axis in 0..dimension {
                pairs.push((self.deformation.at(row, axis), alpha_slope[axis]));
                pairs.push((self.cubic.at(row, axis), beta_slope[axis]));
                pairs.push((self.inverse.at(axis, row), pressure[axis]));
            }
            pairs.push((self.graded[row], one));
            pairs.extend(self.fibres.iter().flat_map(|fibres| fibres[row]));
            dot(graph, pairs)
        };
        (0..dimension).map(component).collect()
    }
}
