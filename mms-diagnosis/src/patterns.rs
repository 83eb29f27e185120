//! Mistakes that show in the numbers themselves, without comparison with a solver.

use mms_runtime::Vector;

use crate::answer::{Diagnosis, Finding, Ranked, Rung};
use crate::evidence::Snapshot;
use crate::exact::{Exact, vectors};
use crate::hypothesis::Kind;
use crate::smooth::size;

/// A pattern: its name and its description.
type Pattern = (&'static str, &'static str);

const PERMUTATION: Pattern =
    ("points_permuted", "the values of points are in another order than their positions");
const ZERO: Pattern = ("output_zero", "results are 0");

/// All patterns, for a list of hypotheses.
pub const LISTED: [Pattern; 2] = [PERMUTATION, ZERO];

/// Values are permuted if, sorted, they differ from the sorted exact ones by at most this part of the error.
const PERMUTED: f64 = 0.1;

/// The first quantity of the last snapshot, if its error is large.
struct Wrong<'a, const D: usize> {
    points: Vec<Vector<f64, D>>,
    computed: &'a [f64],
    right: Vec<f64>,
    components: usize,
    /// The size of the exact values, and of the error.
    sizes: [f64; 2],
}

impl<'a, const D: usize> Wrong<'a, D> {
    fn of(exact: &Exact<'_, D>, snapshots: &[&'a Snapshot]) -> Option<Self> {
        let snapshot = snapshots.last()?;
        let points = vectors::<D>(&snapshot.reference);
        let (quantity, computed) = snapshot.values.first()?;
        let right = exact.values(*quantity, snapshot.time, &points);
        let (scale, off) = (size(&right), distance(computed, &right));
        let is_far = off > 0.1 * scale && points.len() >= 16;
        let components = quantity.components(D);
        is_far.then_some(Wrong { points, computed, right, components, sizes: [scale, off] })
    }
}

/// Finds results that are 0.
pub fn zero<const D: usize>(exact: &Exact<'_, D>, snapshots: &[&Snapshot]) -> Option<Diagnosis> {
    let Wrong { points, computed, sizes: [scale, off], .. } = Wrong::of(exact, snapshots)?;
    if computed.iter().any(|it| *it != 0.0) {
        return None;
    }
    let mut found = named(ZERO, [off, 0.0], scale);
    if starts_at_rest(exact, &points) {
        found.ranked[0].equivalent_here.push("force_missing".into());
        found.ranked[0].needs.push("accelerations at an exact state".into());
    }
    Some(found)
}

/// Finds values that are in another order. Tried last, because much may look so.
pub fn permutation<const D: usize>(
    exact: &Exact<'_, D>,
    snapshots: &[&Snapshot],
) -> Option<Diagnosis> {
    let Wrong { computed, right, components, sizes: [scale, off], .. } =
        Wrong::of(exact, snapshots)?;
    // The sorted values of each component are compared with the sorted exact ones.
    let sorted = |values: &[f64]| -> Vec<f64> {
        let columns = (0..components).flat_map(|component| {
            let mut column: Vec<f64> =
                values.iter().skip(component).step_by(components).copied().collect();
            column.sort_by(f64::total_cmp);
            column
        });
        columns.collect()
    };
    let apart = distance(&sorted(computed), &sorted(&right));
    let ordered = rows(computed, components);
    let of_right = rows(&right, components);
    let is_permuted =
        apart < PERMUTED * off && distance(&ordered, &of_right) < 2.0 * PERMUTED * off;
    is_permuted.then(|| named(PERMUTATION, [off, apart], scale))
}

/// Whether the field starts at rest, so that a body without loads stays where it is.
fn starts_at_rest<const D: usize>(exact: &Exact<'_, D>, points: &[Vector<f64, D>]) -> bool {
    let start = exact.domain.time[0];
    let motion = [exact.displacement(start, points), exact.velocity(start, points)];
    motion.iter().flatten().all(|it| it.norm() == 0.0)
}

/// The diagnosis of a pattern, from the error and the part that the pattern leaves, each over the size of the exact solution.
fn named((name, says): Pattern, [off, left]: [f64; 2], scale: f64) -> Diagnosis {
    Diagnosis {
        finding: Finding::Named,
        rung: Rung::Results,
        ranked: vec![Ranked {
            hypothesis: usize::MAX,
            name,
            says: says.into(),
            kind: Kind::Mistake,
            face: None,
            which: None,
            factor: Vec::new(),
            margin: 0.0,
            explained: 1.0 - (left / off).powi(2),
            is_plausible: true,
            acts_as_first: false,
            is_sized: false,
            is_known: false,
            equivalent_always: Vec::new(),
            equivalent_here: Vec::new(),
            rivals: 0,
            needs: Vec::new(),
        }],
        cannot_be_seen: Vec::new(),
        error: off / scale,
        expected: [left / scale; 2],
        falls: None,
        of_order: None,
        pair: None,
        like: None,
        place: None,
        fields: None,
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The values sorted by point: by the first component, then by the next.
fn rows(values: &[f64], components: usize) -> Vec<f64> {
    let mut rows: Vec<&[f64]> = values.chunks_exact(components).collect();
    rows.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
    rows.concat()
}
