//! Mistakes that show in the numbers themselves, without comparison with a solver.

use mms_runtime::Vector;

use crate::answer::{Diagnosis, DiagnosisFinding, Ranked, Rung};
use crate::evidence::Snapshot;
use crate::exact::{Exact, vectors};
use crate::hypothesis::HypothesisKind;
use crate::smooth::size;

/// A pattern: its name and its description.
type Pattern = (&'static str, &'static str);

const PERMUTATION: Pattern =
    ("points_permuted", "the values of points are in another order than their positions");
const ZERO: Pattern = ("output_zero", "results are 0");

/// All patterns, for a list of hypotheses.
pub const LISTED: [Pattern; 2] = [PERMUTATION, ZERO];

/// The fewest points that show a pattern.
const FEWEST: usize = 16;
/// The least error, divided by the size of the solution, of results that are 0 or in an unknown order.
const FAR: f64 = 0.1;
/// Values are permuted if, sorted, they differ from the sorted exact ones by at most this part of the error.
const PERMUTED: f64 = 0.1;
/// A known order of points is named if it leaves less than this part of the error.
const ORDERED: f64 = 0.25;
/// The least smooth part of the squared error with which a name stays.
const SMOOTH: f64 = 0.5;
/// The most points by which lists are searched for a shift.
const SHIFTS: usize = 2;
/// About the number of values that are compared in each known order.
const SAMPLE: usize = 2000;

/// The first quantity of the last snapshot.
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
        let components = quantity.components(D);
        let wrong = Wrong { points, computed, right, components, sizes: [scale, off] };
        Some(wrong).filter(|it| it.points.len() >= FEWEST)
    }

    /// Whether the error is a large part of the solution.
    fn is_far(&self) -> bool {
        let [scale, off] = self.sizes;
        off > FAR * scale
    }
}

/// Finds results that are 0.
pub fn zero<const D: usize>(exact: &Exact<'_, D>, snapshots: &[&Snapshot]) -> Option<Diagnosis> {
    let wrong = Wrong::of(exact, snapshots).filter(Wrong::is_far)?;
    let Wrong { points, computed, sizes: [scale, off], .. } = wrong;
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

/// Replaces a diagnosis by a permutation of the points, if the values are the exact ones in another order. Much may look like a
/// permutation by chance. So a name stays, unless most of the error is noise: sums with smooth functions see little of noise.
pub fn or_permutation<const D: usize>(
    exact: &Exact<'_, D>,
    snapshots: &[&Snapshot],
    found: Diagnosis,
) -> Diagnosis {
    let is_smooth = found.place.as_ref().is_none_or(|it| it.smooth >= SMOOTH);
    if found.finding == DiagnosisFinding::Named && is_smooth {
        return found;
    }
    Wrong::of(exact, snapshots).and_then(|wrong| wrong.permutation()).unwrap_or(found)
}

impl<const D: usize> Wrong<'_, D> {
    fn permutation(&self) -> Option<Diagnosis> {
        let [scale, off] = self.sizes;
        let known = orders(self.points.len(), self.components, D).into_iter();
        let left = known.map(|order| (self.left(&*order.of), order.name));
        let best = left.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|(left, _)| *left < ORDERED);
        if let Some((left, name)) = best {
            let mut found = named(PERMUTATION, [off, left * off], scale);
            found.ranked[0].which = Some(name.into());
            return Some(found);
        }
        let apart = if self.is_far() { self.apart() } else { f64::INFINITY };
        (apart < PERMUTED * off).then(|| named(PERMUTATION, [off, apart], scale))
    }

    /// The error that is left if the number at index k belongs to index `of(k)`, divided by the whole error; from a sample.
    fn left(&self, of: &dyn Fn(usize) -> usize) -> f64 {
        let step = (self.computed.len() / SAMPLE) | 1;
        let (mut left, mut all) = (0.0, 0.0);
        for (k, computed) in self.computed.iter().enumerate().step_by(step) {
            left += (computed - self.right[of(k)]).powi(2);
            all += (computed - self.right[k]).powi(2);
        }
        if all > 0.0 { (left / all).sqrt() } else { f64::INFINITY }
    }

    /// The distance of the values from the exact ones, if the order of points does not count: the mean over directions of the
    /// distance of sorted projections (the sliced Wasserstein distance).
    fn apart(&self) -> f64 {
        let components = self.components;
        let square = |direction: &[f64]| {
            let sorted = |values: &[f64]| {
                let project = |it: &[f64]| it.iter().zip(direction).map(|(a, b)| a * b).sum();
                let mut all: Vec<f64> = values.chunks_exact(components).map(project).collect();
                all.sort_by(f64::total_cmp);
                all
            };
            distance(&sorted(self.computed), &sorted(&self.right)).powi(2)
        };
        let directions = directions(components);
        let sum: f64 = directions.iter().map(|it| square(it)).sum();
        (sum * components as f64 / directions.len() as f64).sqrt()
    }
}

/// Unit vectors: the axes, and some others.
fn directions(components: usize) -> Vec<Vec<f64>> {
    let axis = |axis: usize| (0..components).map(|it| f64::from(u8::from(it == axis))).collect();
    let other = |k: usize| {
        let part = |it: usize| (1.0 + 2.3 * k as f64 + 1.7 * it as f64).sin();
        let all: Vec<f64> = (0..components).map(part).collect();
        let length = size(&all);
        all.into_iter().map(|it| it / length).collect()
    };
    (0..components).map(axis).chain((0..3 * components).map(other)).collect()
}

/// The index of the number that is written at an index.
type Permutation = Box<dyn Fn(usize) -> usize>;

/// An order in which a program may write points by mistake.
struct PointOrder {
    name: String,
    of: Permutation,
}

/// The orders that people confuse, for a list of points in D dimensions.
fn orders(points: usize, components: usize, dimension: usize) -> Vec<PointOrder> {
    let of_points = |name: String, of: Permutation| PointOrder {
        name,
        of: Box::new(move |k| of(k / components) * components + k % components),
    };
    let mut all = vec![of_points("reversed".into(), Box::new(move |p| points - 1 - p))];
    for by in (1..=SHIFTS).filter(|by| *by < points) {
        let (back, plural) = (points - by, if by > 1 { "points" } else { "point" });
        let name = |way| format!("shifted by {by} {plural} {way}");
        all.push(of_points(name("forward"), Box::new(move |p| (p + back) % points)));
        all.push(of_points(name("back"), Box::new(move |p| (p + by) % points)));
    }
    if components > 1 {
        let of = move |k: usize| k % points * components + k / points;
        all.push(PointOrder { name: "component by component".into(), of: Box::new(of) });
    }
    for edges in grids(points, dimension) {
        all.extend(transposed(&edges).into_iter().map(|(name, of)| of_points(name, of)));
    }
    all
}

/// The ways to arrange points in a grid of at least 2 points along each axis.
fn grids(points: usize, dimension: usize) -> Vec<Vec<usize>> {
    let divisors = |of: usize| (2..=of / 2).filter(move |it| of.is_multiple_of(*it));
    match dimension {
        2 => divisors(points).map(|it| vec![it, points / it]).collect(),
        3 => divisors(points)
            .flat_map(|first| {
                let rest = points / first;
                divisors(rest).map(move |it| vec![first, it, rest / it])
            })
            .collect(),
        _ => Vec::new(),
    }
}

/// The orders of a grid in which the loops over the axes are nested otherwise. The last axis of `edges` runs fastest.
fn transposed(edges: &[usize]) -> Vec<(String, Permutation)> {
    let nestings: &[&[usize]] = match edges.len() {
        2 => &[&[1, 0]],
        _ => &[&[2, 1, 0], &[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1]],
    };
    let one = |nesting: &&'static [usize]| {
        let (edges, nesting) = (edges.to_vec(), *nesting);
        let sizes: Vec<_> = edges.iter().map(usize::to_string).collect();
        let name = format!("axes of a grid of {} points swapped", sizes.join(" x "));
        let of = move |p: usize| {
            let (mut rest, mut at) = (p, vec![0; edges.len()]);
            for axis in (0..edges.len()).rev() {
                at[axis] = rest % edges[axis];
                rest /= edges[axis];
            }
            nesting.iter().fold(0, |index, axis| index * edges[*axis] + at[*axis])
        };
        (name, Box::new(of) as Permutation)
    };
    nestings.iter().map(one).collect()
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
        finding: DiagnosisFinding::Named,
        rung: Rung::Results,
        ranked: vec![Ranked {
            hypothesis: usize::MAX,
            name,
            says: says.into(),
            kind: HypothesisKind::Mistake,
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
