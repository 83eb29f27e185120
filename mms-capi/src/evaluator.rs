//! Quantities at many points, in blocks: with the same bits as the interpreter of one point.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use mms_mechanics::{Output, Program};
use mms_program::block::{BlockMode, BlockPlan, Blockwise, Prepared, Scratch};
use mms_spec::quantity::Quantity;

/// The number of points that are evaluated together.
pub const BLOCK: usize = <f64 as Blockwise>::BLOCK;

/// The data for the evaluation of each quantity, reused from call to call.
#[derive(Debug)]
pub struct Evaluator(Vec<(Quantity, QuantityCache)>);

/// The plan of one quantity, and data that calls reuse.
#[derive(Debug, Default)]
struct QuantityCache {
    plan: OnceLock<Arc<BlockPlan>>,
    /// The data of calls that have ended; as many as there were concurrent calls.
    idle: Mutex<Vec<Ready>>,
}

/// The data of one call.
#[derive(Debug)]
pub struct Ready {
    /// The parameters of `prepared`.
    parameters: Vec<f64>,
    prepared: Prepared<f64>,
    scratch: Scratch<f64>,
    /// The components of a block.
    values: Vec<f64>,
}

impl Evaluator {
    /// An evaluator without data, for these quantities.
    pub fn new(quantities: impl Iterator<Item = Quantity>) -> Self {
        Evaluator(quantities.map(|quantity| (quantity, QuantityCache::default())).collect())
    }

    /// Calls `work` with the data for an evaluation of a quantity with these parameters. If the parameters differ from the
    /// previous call's, only the stage Parameter runs again.
    pub fn with<R>(
        &self,
        program: &Program,
        quantity: Quantity,
        parameters: &[f64],
        work: impl FnOnce(&mut Ready) -> R,
    ) -> R {
        let cache = self.0.iter().find(|(known, _)| *known == quantity);
        let (_, cache) = cache.expect("all quantities are listed");
        let idle = || cache.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let known = idle().pop();
        let mut ready = known.unwrap_or_else(|| {
            let plan = || {
                Arc::new(BlockPlan::new(
                    program,
                    &[Output::Quantity(quantity)],
                    Output::is_quantity,
                ))
            };
            let plan = cache.plan.get_or_init(plan).clone();
            Ready {
                parameters: parameters.to_vec(),
                prepared: Prepared::new(plan, BlockMode::portable(), parameters),
                scratch: Scratch::default(),
                values: Vec::new(),
            }
        });
        let mut pairs = ready.parameters.iter().zip(parameters);
        if !pairs.all(|(known, new)| known.to_bits() == new.to_bits()) {
            ready.prepared.set(parameters);
            ready.parameters.copy_from_slice(parameters);
        }
        let result = work(&mut ready);
        idle().push(ready);
        result
    }
}

impl Ready {
    /// Evaluates at points of `dimension` coordinates each, which may have normals, at most a block of them. Returns the
    /// components of each point in turn.
    pub fn evaluate(
        &mut self,
        time: f64,
        dimension: usize,
        [points, normals]: [&[f64]; 2],
        components: usize,
    ) -> &[f64] {
        let count = points.len() / dimension;
        if self.values.len() < count * components {
            self.values.resize(count * components, 0.0);
        }
        let values = &mut self.values[..count * components];
        self.prepared.at_points(&mut self.scratch, time, dimension, [points, normals], values);
        &self.values[..count * components]
    }
}
