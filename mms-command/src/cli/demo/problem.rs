// The inputs of the solver, at a time t and a reference position X.

/// The exact motion, which is taken at the start, and the loads that follow from it.
pub trait Problem {
    /// u.
    fn displacement(&self, t: f64, x: [f64; 2]) -> [f64; 2];
    /// v.
    fn velocity(&self, t: f64, x: [f64; 2]) -> [f64; 2];
    /// b, per unit mass.
    fn body_force(&self, t: f64, x: [f64; 2]) -> [f64; 2];
    /// P of the exact motion, whose tractions P N load the sides.
    fn stress(&self, t: f64, x: [f64; 2]) -> [[f64; 2]; 2];
}
