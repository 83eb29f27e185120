//! Values that a solver is given and does not compute: they are no evidence.

use mms_spec::Claim;
use mms_spec::quantity::Quantity;

use super::snapshot_errors::SnapshotErrors;
use crate::measured::Objection;

impl SnapshotErrors<'_> {
    /// Whether a solver is given all values of a quantity at places X: at the start, on walls, as loads.
    ///
    /// # Errors
    /// The motion cannot be evaluated.
    pub fn is_input(&mut self, quantity: Quantity, places: &[f64]) -> anyhow::Result<bool> {
        let rounding = self.motion.reference.rounding;
        let are_on = |claims: &[Claim]| self.exact.are_on(claims, places, rounding);
        let is_input = match quantity {
            Quantity::BodyForce
            | Quantity::BodyForceDensity
            | Quantity::CurrentBodyForceDensity => true,
            Quantity::Position
            | Quantity::Displacement
            | Quantity::Velocity
            | Quantity::Acceleration => match self.mesh.dimension {
                1 => are_on(&[Claim::Fixed, Claim::Prescribed, Claim::Roller]),
                _ => are_on(&[Claim::Fixed, Claim::Prescribed]),
            },
            Quantity::Traction => are_on(&[Claim::Free, Claim::Traction]),
            _ => false,
        };
        Ok(is_input || self.exact.is_start(&[self.time])?)
    }
}

/// The objection to results whose values are all given.
pub fn objection() -> Objection {
    let why = "the solver was given all these values: they are at the start, on walls whose motion is prescribed, or loads. \
               They do not test what it computes: give results of later times that all meshes have, inside the body";
    Objection { why: why.into(), is_to_all: true }
}
