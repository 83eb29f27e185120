//! The degree of a solution on linear cells: a file may contain a quadratic solution on them.

use anyhow::bail;
use mms_spec::quantity::Quantity;

use super::MeasuredMesh;
use super::level::{Errors, Sampling};
use crate::table::ExpectedOrders;

/// The orders at points of a quadratic solution.
const AT_POINTS: [f64; 2] = [2.6, 3.4];
/// The orders over cells of the linear interpolation of a quadratic solution.
const OVER_CELLS: [f64; 2] = [1.5, 2.4];

/// Refuses linear cells with two possible readings: errors over them have order 2, and errors at points the order of a
/// quadratic solution, or an order that the user expects and linear cells cannot have.
///
/// # Errors
/// Both readings, with their orders and with the option that chooses each.
pub fn validate_linear(
    levels: &[MeasuredMesh],
    sizes: &[f64],
    orders: &ExpectedOrders,
) -> anyhow::Result<()> {
    if orders.degree != Some(1) {
        return Ok(());
    }
    let of = |level: &MeasuredMesh| {
        let is_u = |it: &&Errors| {
            it.quantity == Quantity::Displacement
                && it.sampling == Sampling::Cells
                && !it.is_noise()
        };
        let errors = level.errors.iter().find(is_u)?;
        let (_, over_cells) = errors.norms.iter().find(|(name, _)| *name == "l2")?;
        Some([errors.at_points?, over_cells.error])
    };
    let mut found: Vec<(f64, [f64; 2])> = Vec::new();
    for (level, &size) in levels.iter().zip(sizes) {
        let Some(errors) = of(level) else { return Ok(()) };
        found.push((size, errors));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [(fine, of_fine), (coarse, of_coarse), ..] = found.as_slice() else { return Ok(()) };
    let order = |at: usize| (of_coarse[at] / of_fine[at]).ln() / (coarse / fine).ln();
    let [at_points, over_cells] = [order(0), order(1)];
    let is_within = |[least, most]: [f64; 2], order: f64| order >= least && order <= most;
    let [expected, _] = orders.of("displacement", "u", "l2");
    let is_expected = expected.order > OVER_CELLS[1] && at_points >= expected.order - 0.4;
    let is_quadratic = is_within(AT_POINTS, at_points) && is_within(OVER_CELLS, over_cells);
    if !(is_quadratic || is_expected) {
        return Ok(());
    }
    bail!(
        "`{}`: errors of u have order {at_points:.2} at points, and {over_cells:.2} over its linear cells: is it a \
         quadratic solution that was written on linear cells? Then say `--over points` and the order with \
         `--expected-order 3`; if the solution is linear in its cells, say `--over cells`",
        mms_spec::foreign::shown(&levels[0].name)
    )
}
