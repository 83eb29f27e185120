//! One output at many points, in double precision.

use std::sync::Arc;
use std::thread;

use mms_mechanics::{Output, Program};
use mms_program::block::{BlockMode, BlockPlan, Prepared, Scratch};

/// The number of points from which on threads share them.
const MANY: usize = 1 << 16;

/// An output of a program, for one set of parameters. The evaluation is compiled in this crate, once.
pub struct AtPoints {
    prepared: Prepared<f64>,
}

impl AtPoints {
    /// Prepares the output, and computes the stages that depend on parameters alone.
    pub fn new(program: &Program, output: Output, parameters: &[f64]) -> Self {
        let plan = BlockPlan::new(program, &[output], Output::is_quantity);
        AtPoints { prepared: Prepared::new(Arc::new(plan), BlockMode::portable(), parameters) }
    }

    /// Evaluates `components` numbers at each point X, with normals N if the output needs them; coordinates of a point are
    /// adjacent. Uses up to `threads` threads if there are many points.
    pub fn values(
        &self,
        components: usize,
        time: f64,
        dimension: usize,
        [points, normals]: [&[f64]; 2],
        threads: usize,
    ) -> Vec<f64> {
        let count = points.len() / dimension;
        let mut values = vec![0.0; count * components];
        let rows = count.div_ceil(if count < MANY { 1 } else { threads }).max(1);
        let shares =
            points.chunks(rows * dimension).zip(values.chunks_mut((rows * components).max(1)));
        thread::scope(|scope| {
            for (at, (points, values)) in shares.enumerate() {
                let normals = normals.get(at * rows * dimension..).unwrap_or_default();
                let mut work = move || {
                    let scratch = &mut Scratch::default();
                    self.prepared.at_points(scratch, time, dimension, [points, normals], values);
                };
                // Few points take less time than the start of a thread.
                if rows == count { work() } else { drop(scope.spawn(work)) }
            }
        });
        values
    }
}
