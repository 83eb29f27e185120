//! Compares results with a right run of the same solver, so that the error of the method cancels.

use anyhow::ensure;
use mms_diagnosis::evidence::Mesh;
use mms_diagnosis::exact::Quantity;
use mms_exact::Exact;
use mms_spec::foreign::shown;
use mms_spec::quantity;

/// The largest distance of points that count as the same, relative to the largest coordinate: single precision.
const SAME: f64 = 1e-6;

/// Replaces values by the exact ones plus their differences from a right run.
///
/// # Errors
/// Runs with other times, points or quantities.
pub fn compare(
    found: &mut Mesh,
    right: &Mesh,
    names: [&str; 2],
    exact: &mut Exact,
) -> anyhow::Result<()> {
    let [own, reference] = names.map(shown);
    let says = format!("`{own}` and `{reference}` of `--reference`");
    ensure!(
        found.snapshots.len() == right.snapshots.len(),
        "{says} have {} times and {}: expected the same",
        found.snapshots.len(),
        right.snapshots.len()
    );
    for (found, right) in found.snapshots.iter_mut().zip(&right.snapshots) {
        let largest = found.reference.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        let pairs = found.reference.iter().zip(&right.reference);
        let is_same = found.reference.len() == right.reference.len()
            && pairs.clone().all(|(a, b)| (a - b).abs() <= SAME * largest)
            && found.time == right.time;
        ensure!(is_same, "{says}: expected the same points in the same order, at the same times");
        for (quantity, values) in &mut found.values {
            let known = right.values.iter().find(|(it, _)| it == quantity);
            let Some((_, of_right)) = known else {
                anyhow::bail!(
                    "`{reference}` of `--reference`: no {}, which `{own}` has",
                    quantity.name()
                );
            };
            let of = match quantity {
                Quantity::Displacement => quantity::Quantity::Displacement,
                Quantity::Velocity => quantity::Quantity::Velocity,
                Quantity::DisplacementGradient => quantity::Quantity::DisplacementGradient,
            };
            let exact = exact.values(of, found.time, &found.reference)?;
            let each = values.iter_mut().zip(of_right).zip(exact);
            each.for_each(|((own, right), exact)| *own += exact - right);
        }
    }
    Ok(())
}
