//! Cubic B-splines: the particle is a point, and its weights have two continuous derivatives.
//!
//! Steffen, Kirby, Berzins, "Analysis and reduction of quadrature errors in the material point method (MPM)", Int. J. Numer.
//! Meth. Engng 76 (2008), doi 10.1002/nme.2360. [`Lattice`](crate::Lattice) places the nodes, and knots end at the faces of a
//! body that do not move.

use crate::spline::Spline;

/// Cubic B-splines, 4 nodes per axis.
pub type CubicBspline = Spline<3, 4>;
