//! Natural sizes, which separate a number that is 0 up to rounding from a small number: products of the length of the body, the
//! time window, rho0 c0^2 and rho0.

use mms_math::Scalar as _;

use mms_program::precise::Precise;

/// Exponents of length, time, modulus and density.
pub type Scale = [i32; 4];

pub const STRAIN: Scale = [0; 4];
pub const LENGTH: Scale = [1, 0, 0, 0];
pub const VELOCITY: Scale = [1, -1, 0, 0];
pub const ACCELERATION: Scale = [1, -2, 0, 0];
pub const JERK: Scale = [1, -3, 0, 0];
pub const CURVATURE: Scale = [-1, 0, 0, 0];
pub const THIRD_GRADIENT: Scale = [-2, 0, 0, 0];
pub const STRESS: Scale = [0, 0, 1, 0];
pub const STRESS_GRADIENT: Scale = [-1, 0, 1, 0];
pub const DENSITY_GRADIENT: Scale = [-1, 0, 0, 1];

/// The scales of a field: the longest edge or the outer radius of its body, its time window, and the largest rho0 c0^2 and rho0
/// in its domain.
#[derive(Clone, Debug)]
pub struct Sizes(pub [Precise; 4]);

impl Sizes {
    /// The natural size of a term.
    pub fn of(&self, scale: Scale) -> Precise {
        let mut size = Precise::from_f64(1.0);
        for (unit, exponent) in self.0.iter().zip(scale) {
            for _ in 0..exponent.unsigned_abs() {
                let unit = unit.clone();
                size = if exponent > 0 { size * unit } else { size / unit };
            }
        }
        size
    }
}
