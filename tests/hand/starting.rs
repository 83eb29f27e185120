//! Bodies set in motion from rest, derived by hand: of rank one, see `rank_one.rs`.
//!
//! ```text
//! u   = d(t) phi,  phi = p(X) q(Y) r(Z)
//! d   = e A (1 - cos(w t))/2,  w = c pi/L,  d'' = e A w^2 cos(w t)/2
//! b   = d'' phi - Div P/rho0
//! ```

use std::f64::consts::PI;

use mms_runtime::{Matrix, Vector};

use crate::rank_one::RankOne;
use crate::support::{NeoHookean, TOLERANCE, Values, assert_agree, in_box};

/// The parameters of a body, and how it starts.
pub struct Start {
    pub length: f64,
    pub young: f64,
    pub nu: f64,
    pub rho0: f64,
    pub amplitude: f64,
    /// e.
    pub direction: [f64; 3],
}

/// A factor of phi, with its first and second derivative.
pub type Profile = [f64; 3];

/// A factor of phi for an axis that phi does not depend on.
pub const CONSTANT: Profile = [1.0, 0.0, 0.0];

/// a sin(k x) and its derivatives.
pub fn sine(k: f64, x: f64) -> Profile {
    let (sine, cosine) = (k * x).sin_cos();
    [sine, k * cosine, -k * k * sine]
}

impl Start {
    fn values<const D: usize>(&self, profiles: [Profile; 3], t: f64) -> Values {
        let &Start { length, young, nu, rho0, amplitude, direction } = self;
        let w = (young / rho0).sqrt() * PI / length;
        let direction = Vector::<f64, 3>::from(direction) * amplitude;
        // The factor of each axis is differentiated as often as the axis is named.
        let phi = |axes: &[usize]| -> f64 {
            let order = |axis| axes.iter().filter(|named| **named == axis).count();
            (0..3).map(|axis| profiles[axis][order(axis)]).product()
        };
        let motion = RankOne {
            direction: direction * ((1.0 - (w * t).cos()) / 2.0),
            gradient: Vector::<f64, 3>::from_fn(|i, _| phi(&[i])),
            hessian: Matrix::<f64, 3>::from_fn(|i, j| phi(&[i, j])),
        };
        let law = NeoHookean::of(young, nu);
        let inertia = direction * (w * w * (w * t).cos() / 2.0 * phi(&[]));
        let force = inertia - motion.divergence(&law) / rho0;
        Values::leading::<D>(motion.jacobian(), &motion.stress(&law), force.into())
    }

    /// Asserts that generated functions equal the derivation above, with the factors of phi at X.
    #[track_caller]
    pub fn assert_is<const D: usize>(
        &self,
        generated: impl Fn([f64; D], f64) -> Values,
        profiles: impl Fn([f64; D]) -> [Profile; 3],
    ) {
        let end = self.length / (self.young / self.rho0).sqrt();
        let points = in_box([0.0; D], [self.length; D], [0.0, end]);
        let by_hand = |x, t| self.values::<D>(profiles(x), t);
        assert_agree(TOLERANCE, &points, generated, by_hand);
    }
}
