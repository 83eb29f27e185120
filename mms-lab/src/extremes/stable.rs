//! The largest stable Courant number, measured: 400 steps on a motion of 1e-8 of the body, where an unstable mode
//! outgrows the motion, and ten bisections.

use mms_options::method::Precision;
use mms_runtime::{Division, Method};

use super::subject::Subject;
use super::verdict::RunResult;

/// The range in which the number is searched.
pub const RANGE: [f64; 2] = [0.02, 4.0];

/// The number of halvings of the range: to 1/200.
const HALVINGS: usize = 10;

/// The number of cells along the longest edge, in one, two and three dimensions.
const CELLS: [usize; 3] = [32, 8, 4];

/// The number of steps. A mode that grows by 1e-4 in each is not detected; a mode 1 % above the limit grows by a quarter.
const STEPS: usize = 400;

/// The error, as a part of the displacement, above which a mode has outgrown the motion: below, the error is the method's.
const GROWN: f64 = 0.5;

/// The largest stable Courant number of a method; the lower end of the range if none is.
///
/// # Errors
/// The gallery differs from its files.
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
    Ok(matches!(seen, RunResult::Ended { l2, .. } if l2 < GROWN))
}
