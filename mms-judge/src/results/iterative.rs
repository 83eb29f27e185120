//! The iterative error of a solver: the difference between results of two tolerances on the same mesh.

use anyhow::{Context as _, bail, ensure};
use mms_exact::Exact;
use mms_results::norm::{lengths, of_differences, over_points};
use mms_results::pairing::{self, Pairs};
use mms_results::{Snapshot, names::Values};
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;

use super::MeasuredMesh;
use super::files::{Results, placed};
use super::level::Reading;

/// The least ratio of an error of discretisation to an iterative error that leaves its order unchanged: one percent of the
/// error changes the order by about 0.01 (Eca & Hoekstra, Int. J. Numer. Meth. Fluids 60, 2009, 499-530).
pub const HUNDRED: f64 = 100.0;

/// Raises the floors of all levels to a hundred times the iterative error found on one level, since tolerances are the same on
/// all meshes. The number of points identifies the level.
///
/// # Errors
/// Results of none of the meshes.
pub fn raise(
    levels: &mut [MeasuredMesh],
    (all, snapshots): (&[Results], &[Vec<usize>]),
    (tighter, own): (&Results, &[usize]),
    reading: &Reading<'_>,
    exact: &mut Exact,
) -> anyhow::Result<String> {
    let mut found: Vec<(Quantity, [f64; 3])> = Vec::new();
    let points = |results: &Results, at: usize| results.snapshots[at].rows();
    let mesh = (0..all.len())
        .find(|&mesh| points(&all[mesh], snapshots[mesh][0]) == points(tighter, own[0]))
        .with_context(|| {
            format!(
                "`--tighter {}`: {} points, which no FILE has; give results of one of these meshes",
                shown(&tighter.name),
                points(tighter, own[0])
            )
        })?;
    for (&one, &other) in snapshots[mesh].iter().zip(own) {
        let pair = [&all[mesh].snapshots[one], &tighter.snapshots[other]];
        for (quantity, norms) in differences(pair, reading, exact)? {
            match found.iter_mut().find(|(it, _)| *it == quantity) {
                Some((_, most)) => most.iter_mut().zip(norms).for_each(|(a, b)| *a = a.max(b)),
                None => found.push((quantity, norms)),
            }
        }
    }
    ensure!(!found.is_empty(), "`--tighter {}`: no quantity that is judged", shown(&tighter.name));
    let size = levels[mesh].found.sizes.map_or(1.0, |[shortest, _]| shortest);
    let dimension = exact.dimension as f64;
    for errors in levels.iter_mut().flat_map(|level| &mut level.errors) {
        let Some((_, [l1, l2, linf])) = found.iter().find(|(it, _)| *it == errors.quantity) else {
            continue;
        };
        errors.iterative = Some(*l2);
        for (name, measure) in &mut errors.norms {
            let own = match *name {
                "l1" => *l1,
                "l2" => *l2,
                "linf" => *linf,
                // As for the error of rounding.
                _ => 2.0 * dimension * l2 / size,
            };
            measure.rounding_error = measure.rounding_error.max(HUNDRED * own);
        }
    }
    let shares =
        found.iter().map(|(quantity, norms)| format!("{} {:.1e}", quantity.symbol(), norms[1]));
    Ok(format!(
        "iterative errors, from `{}`, root mean squares: {}; they should be a hundred times smaller than the errors",
        shown(&tighter.name),
        shares.collect::<Vec<_>>().join(", ")
    ))
}

/// The mean, the root mean square and the largest difference of each quantity.
fn differences(
    [one, other]: [&Snapshot; 2],
    reading: &Reading<'_>,
    exact: &Exact,
) -> anyhow::Result<Vec<(Quantity, [f64; 3])>> {
    let (pairs, _) = pairing::points(one, other, reading.names).map_err(placed)?;
    let (of_one, of_other) =
        (reading.judged_quantities(one, exact)?, reading.judged_quantities(other, exact)?);
    let mut found = Vec::new();
    for (quantity, a) in &of_one {
        let Some((_, b)) = of_other.iter().find(|(it, _)| it == quantity) else { continue };
        let norms = match a.is_of_cells || pairs == Pairs::InOrder(a.numbers.len() / a.components) {
            true if a.numbers.len() == b.numbers.len() => {
                of_differences(&a.numbers, &b.numbers, a.components, None)
            }
            true => bail!("{}: {} is of other points or cells", other.path, quantity.name()),
            false => over_points(paired(a, b, &pairs), None),
        };
        found.extend(norms.map(|it| (*quantity, [it.l1, it.l2, it.linf])));
    }
    Ok(found)
}

fn paired(a: &Values<'_>, b: &Values<'_>, pairs: &Pairs) -> impl Iterator<Item = f64> {
    let size = a.components;
    pairs.iter().flat_map(move |[i, j]| {
        lengths(&a.numbers[i * size..][..size], &b.numbers[j * size..][..size], size)
    })
}
