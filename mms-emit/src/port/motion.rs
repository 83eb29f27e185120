//! The extent of the motion, which a background grid has to contain.

use super::Port;
use super::number::decimal;

/// The comment above both ends in emitted code.
pub const DOC: &str = "Bounds of x = X + u(X, t) over the whole body and time window with the default \
parameters, in the unit of lengths: proved by interval arithmetic, and so a little wider than the motion. With other \
parameters it may go farther.";

impl Port<'_> {
    /// A line for the lower end and one for the upper, each of its name and of a number for each axis. Empty where
    /// nothing bounds the motion.
    pub fn motion(&self, line: impl Fn(&str, &[String]) -> String) -> String {
        let reach = self.subject.reach();
        if !reach.iter().flatten().all(|end| end.is_finite()) {
            return String::new();
        }
        let ends = ["motion_lower", "motion_upper"].into_iter().enumerate();
        let lines = ends.map(|(end, name)| {
            // 0 has no sign.
            let numbers: Vec<_> = reach.iter().map(|axis| decimal(axis[end] + 0.0)).collect();
            line(name, &numbers) + "\n"
        });
        lines.collect()
    }
}

/// Numbers as a tuple of Python or Julia, which one number alone is, too.
pub fn tuple(numbers: &[String]) -> String {
    match numbers {
        [one] => format!("({one},)"),
        several => format!("({})", several.join(", ")),
    }
}
