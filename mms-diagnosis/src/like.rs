//! The orders of a method of this project's own solver, as a standard for results.

use mms_runtime::Method;
use mms_runtime::study::Solve;

use crate::changed::Without;
use crate::evidence::{ComparisonFrame, Mesh};
use crate::exact::{Exact, Quantity};
use crate::level::MOST_WORK;
use crate::run::{Obstacle, Responses, SolverRuns};
use crate::smooth::size;

/// Computes the order with which the error of a right method falls on a field, for each quantity of results of two meshes.
/// Errors are root mean squares at the points of the finest mesh, the largest over times.
///
/// # Errors
/// Runs that stop, that would take too long, or whose error does not fall.
pub fn orders_of<const D: usize>(
    exact: &Exact<'_, D>,
    frame: &ComparisonFrame<D>,
    mesh: &Mesh,
    method: &Method,
) -> Result<Vec<(Quantity, f64)>, Obstacle>
where
    f64: Solve<D>,
{
    let fine = SolverRuns::new(exact, frame, mesh, Without::default(), Some(method), MOST_WORK)?;
    let coarse = fine.coarser();
    let errors = |plan: &dyn Responses<'_, D>| {
        let errors = plan.right(plan.methods() - 1).ok_or(Obstacle::Diverges(None))?;
        Ok::<_, Obstacle>(errors.iter().map(|it| size(it)).collect::<Vec<f64>>())
    };
    let [of_fine, of_coarse] = [errors(&fine)?, errors(&*coarse)?];
    let largest = |of: &[f64], quantity: Quantity| {
        let all = frame.each().zip(of).filter(|((_, it), _)| *it == quantity);
        all.map(|(_, error)| *error).fold(0.0, f64::max)
    };
    let refined = (coarse.cell_size() / fine.cell_size()).ln();
    let mut orders = Vec::new();
    for &(quantity, _) in &frame.quantities {
        let [fine, coarse] = [&of_fine, &of_coarse].map(|it| largest(it, quantity));
        let order = (coarse / fine).ln() / refined;
        if order.is_finite() && order < LEAST {
            return Err(Obstacle::Diverges(Some(order)));
        }
        orders.extend(order.is_finite().then_some((quantity, order)));
    }
    Ok(orders)
}

/// The least order that counts as falling.
const LEAST: f64 = 0.5;
