//! Radial displacements u(R) under an inner pressure, at small strain, for Lame's tube and sphere.
//!
//! ```text
//! eps_RR = u',  eps_TT = u/R;  P = lambda tr(eps) I + 2 mu eps
//! tube:   u = A R + B/R,    P_RR = 2 (lambda + mu) A - 2 mu B/R^2
//! sphere: u = A R + B/R^2,  P_RR = (3 lambda + 2 mu) A - 4 mu B/R^3
//! ```
//!
//! A and B are the solution of two linear equations: P_RR is minus the pressure inside, and 0 outside.

/// A and B for which a A - b B/R^n is minus the pressure at the inner radius and 0 at the outer one.
pub fn coefficients(
    [a, b]: [f64; 2],
    power: i32,
    [inner, outer]: [f64; 2],
    pressure: f64,
) -> [f64; 2] {
    // By elimination: the difference of both equations has B alone.
    let [near, far] = [inner, outer].map(|radius| b / radius.powi(power));
    let second = pressure / (near - far);
    [second * far / a, second]
}
