//! Passes over the graph, one file each. Every pass is a loop over handles in order, operands
//! first; none recurses.

pub mod absorb;
pub mod difference;
pub mod differentiate;
pub mod expand;
pub mod factor;
pub mod half_turns;
pub mod nest;
mod polynomial;
pub mod reduce;
pub mod relations;
pub mod settle;
pub mod substitute;
