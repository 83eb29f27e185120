//! GIMP with half widths fixed at their initial values (undeformed, "uniform" GIMP).
//!
//! Bardenhagen, Kober, "The generalized interpolation material point method", CMES 5 (2004) 477-496,
//! doi 10.3970/cmes.2004.005.477. Gaps and overlaps appear between stretched particles, so that the order is lost on fine
//! grids. In the total formulation there are none.

use crate::gimp::Gimp;

/// Weights averaged over boxes that keep their size, 2 to 4 nodes per axis.
pub type Ugimp = Gimp<false>;
