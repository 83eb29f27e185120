//! Neo-Hookean bodies of revolution on paper, as bodies in space: at the angle 0, where X = R and Y = 0, u and its derivatives
//! over X, Y and Z follow from u_R/R and u_Z, which are functions of R^2 and Z. No formula for cylindrical coordinates is used.
//!
//! ```text
//! u      = (g X, g Y, k),  g(s, Z) = u_R/R,  k(s, Z) = u_Z,  s = X^2 + Y^2
//! g,X    = 2 X g,s,  g,XX = 2 g,s + 4 X^2 g,ss;  at Y = 0: g,Y = 0, g,YY = 2 g,s, g,XY = 0
//! Div P  = mu Lap u + m' cof F grad J,  m = (lambda ln J - mu)/J,  J,K = cof F : F,K
//! ```

use mms_runtime::{Matrix, Vector};

use crate::support::{NeoHookean, Values};

/// A function of s = R^2 and Z, with its derivatives.
#[derive(Clone, Copy, Default)]
pub struct Profile {
    pub value: f64,
    pub over_s: f64,
    pub over_ss: f64,
    pub over_z: f64,
    pub over_sz: f64,
    pub over_zz: f64,
}

/// u_R/R and u_Z, and the second derivatives of u_R and u_Z over time.
pub struct Motion {
    pub spread: Profile,
    pub along: Profile,
    pub acceleration: [f64; 2],
}

/// J, P and b at the distance `r` from the axis.
pub fn values(r: f64, law: &NeoHookean, rho0: f64, motion: &Motion) -> Values {
    let Motion { spread: g, along: k, acceleration } = motion;
    let f = Matrix::<f64, 3>::new(
        1.0 + g.value + 2.0 * r * r * g.over_s,
        0.0,
        r * g.over_z,
        0.0,
        1.0 + g.value,
        0.0,
        2.0 * r * k.over_s,
        0.0,
        1.0 + k.over_z,
    );
    // The second derivatives of (g X, g Y, k) over X and Z; those over Y are by the symmetry of a rotation.
    let over_x = Matrix::<f64, 3>::new(
        6.0 * r * g.over_s + 4.0 * r.powi(3) * g.over_ss,
        0.0,
        g.over_z + 2.0 * r * r * g.over_sz,
        0.0,
        2.0 * r * g.over_s,
        0.0,
        2.0 * k.over_s + 4.0 * r * r * k.over_ss,
        0.0,
        2.0 * r * k.over_sz,
    );
    let over_z = Matrix::<f64, 3>::new(
        g.over_z + 2.0 * r * r * g.over_sz,
        0.0,
        r * g.over_zz,
        0.0,
        g.over_z,
        0.0,
        2.0 * r * k.over_sz,
        0.0,
        k.over_zz,
    );
    let laplacian = Vector::<f64, 3>::new(
        8.0 * r * g.over_s + 4.0 * r.powi(3) * g.over_ss + r * g.over_zz,
        0.0,
        4.0 * k.over_s + 4.0 * r * r * k.over_ss + k.over_zz,
    );
    let jacobian = f.determinant();
    let cofactor = f.try_inverse().expect("F is regular").transpose() * jacobian;
    let slope = Vector::<f64, 3>::new(cofactor.dot(&over_x), 0.0, cofactor.dot(&over_z));
    let div_p = laplacian * law.mu + cofactor * slope * law.cofactor_slope(jacobian);
    let stress = f * law.mu + cofactor * ((law.lambda * jacobian.ln() - law.mu) / jacobian);
    let force = [acceleration[0] - div_p.x / rho0, acceleration[1] - div_p.z / rho0];
    // In the order R, Z, hoop.
    let order = [0, 2, 1];
    let stress = (0..9).map(|at| stress[(order[at / 3], order[at % 3])]).collect();
    Values { jacobian, stress, force: force.to_vec() }
}
