//! The largest stable Courant number, measured: 400 steps on a motion of 1e-8 of the body, where an unstable mode
//! outgrows the motion, and ten bisections.

use mms_options::method::Precision;
use mms_runtime::{Division, Method};

use super::subject::Subject;
use super::verdict::Seen;

/// Between these, numbers are looked for.
pub const RANGE: [f64; 2] = [0.02, 4.0];

/// How often the range is halved: to a part in two hundred.
const HALVINGS: usize = 10;

/// How many cells along the longest edge, in one, two and three dimensions.
const CELLS: [usize; 3] = [32, 8, 4];

/// Steps. A mode that grows by a part in ten thousand in each is not seen; one that is one percent above the limit grows
/// by a quarter.
const STEPS: usize = 400;

/// An error that is this part of the displacement has outgrown it: before, it was that of the method.
const GROWN: f64 = 0.5;

/// The largest stable Courant number of a method; the lower end of the range if none is.
///
/// # Errors
/// The gallery is not that of its files.
pub fn courant(subject: &Subject, method: &Method) -> anyhow::Result<f64> {
    let [mut stable, mut unstable] = RANGE;
    if is_stable(subject, method, unstable)? {
        return Ok(unstable);
    }
    for _ in 0..HALVINGS {
        let middle = (stable * unstable).sqrt();
        if is_stable(subject, method, middle)? {
            stable = middle;
        } else {
            unstable = middle;
        }
    }
    Ok(stable)
}

fn is_stable(subject: &Subject, method: &Method, courant: f64) -> anyhow::Result<bool> {
    let cells = CELLS[subject.input.compiled.field.dimension - 1];
    let mut method = method.clone();
    method.setup.courant = courant;
    method.setup.fastest_wave = None;
    subject.end_after(&mut method, cells, STEPS);
    let seen = subject.run(&method, Division::Uniform(cells), Precision::F64, &mut ())?;
    Ok(matches!(seen, Seen::Ended { l2, .. } if l2 < GROWN))
}
