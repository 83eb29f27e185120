//! A rigid motion on top of a field.

use mms_symbolic::expr::Expr;

/// A rotation by an angle.
#[derive(Clone, Debug)]
pub enum Rotation {
    /// A rotation in the plane.
    Plane {
        /// The angle.
        angle: Expr,
    },
    /// A rotation in space, about an axis of any length except 0.
    Space {
        /// The components of the axis.
        axis: [Expr; 3],
        /// The angle.
        angle: Expr,
    },
}

/// x -> Q x + d.
#[derive(Clone, Debug)]
pub struct RigidMotion {
    /// Q, if there is a rotation.
    pub rotation: Option<Rotation>,
    /// d.
    pub translation: Vec<Expr>,
}
