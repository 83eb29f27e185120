//! The decrease of an error from mesh to mesh, and the place to look for its cause.

/// The order of an error, compared with the order of a right solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Falls {
    /// The quantity.
    pub quantity: String,
    /// The norm.
    pub norm: String,
    /// The observed order; `None` where a run stopped.
    pub observed: Option<f64>,
    /// The least order of a right solver.
    pub expected: f64,
    /// The verdict of `mms judge`.
    pub verdict: String,
    /// Whether that verdict allows the finding `nothing`.
    pub is_right: bool,
}

/// An error with an order between these two falls like the error of a time step.
const OF_STEPS: [f64; 2] = [0.75, 1.25];
/// An error with less than this order does not fall.
const STEADY: f64 = 0.35;
/// The largest distance of an order from 2 that counts as order 2.
const NEAR: f64 = 0.15;

impl Falls {
    /// Says where to look for the cause of an error of this order; `None` if the order is right.
    pub fn hint(&self) -> Option<&'static str> {
        let [least, most] = OF_STEPS;
        Some(match self.observed {
            _ if self.is_right => return None,
            None => "a run stopped: look at its last state",
            Some(order) if order > self.expected => {
                "it falls faster than expected: the coarse mesh is too coarse to tell; add a finer one"
            }
            Some(order) if order < STEADY => {
                "it does not fall: look for a wrong term, factor, load, material, wall or output"
            }
            Some(order) if order < least => {
                "it falls slowly: look for two mistakes at once, or for a layer of cells at a face"
            }
            Some(order) if order < most => {
                "it falls with order 1: look at time stepping (loads, walls or output of another step, the first step), or \
                 for a layer of cells at a face"
            }
            Some(order) if self.expected > 2.0 && (order - 2.0).abs() < NEAR => {
                "it falls with order 2, as an integrator of second order does: if yours is one, `--expected-order 2`"
            }
            Some(_) => {
                "it falls, but too slowly: look for a layer of cells at a face, or add a finer mesh"
            }
        })
    }
}

/// A right method of this project's own solver, and the order of its error on this field.
#[derive(Clone, Debug, PartialEq)]
pub struct OfOrder {
    /// The method, as `--like` takes it.
    pub method: String,
    /// The order.
    pub order: f64,
}

#[cfg(test)]
mod tests {
    use super::Falls;

    #[test]
    fn each_order_points_to_another_cause() {
        let hint = |observed: Option<f64>, is_right| {
            let [quantity, norm, verdict] = ["displacement", "l2", "fail"].map(String::from);
            Falls { quantity, norm, observed, expected: 2.0, verdict, is_right }.hint()
        };
        let has = |observed, word: &str| hint(observed, false).is_some_and(|it| it.contains(word));
        assert_eq!(hint(Some(2.0), true), None);
        assert!(has(Some(0.02), "wrong term") && has(Some(-0.4), "wrong term"));
        assert!(has(Some(0.98), "time stepping") && has(Some(0.5), "two mistakes"));
        assert!(has(Some(1.6), "finer mesh") && has(Some(2.6), "faster"));
        assert!(has(None, "stopped"));
    }
}
