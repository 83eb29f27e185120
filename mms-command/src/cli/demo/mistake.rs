//! The mistake that the demo makes in its solver: a row of P for a column. The build script writes the broken solver.

/// A line of the solver.
pub const RIGHT: &str = "let x_max = [p[1][0][0], p[1][1][0]];";

/// The line that takes its place.
pub const WRONG: &str = "let x_max = [p[1][0][0], p[1][0][1]];";
