//! Linear shape functions: the particle is a point.
//!
//! Sulsky, Chen, Schreyer, "A particle method for history-dependent materials", Comput. Methods Appl. Mech. Engrg. 118 (1994)
//! 179-196: w = 1 - |x - x_i| / h. The gradient jumps where a particle crosses a cell's border, so that the method does not
//! converge for large motions of particles through cells. In the total formulation particles cross no border.

use crate::spline::Spline;

/// Linear weights ("hat functions"), 2 nodes per axis.
pub type Linear = Spline<1, 2>;
