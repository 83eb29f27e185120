//! Values that are written in another order than the positions of their points.

use mms_diagnosis::answer::{Diagnosis, DiagnosisFinding, ErrorPlace};
use mms_diagnosis::evidence::Snapshot;
use mms_diagnosis::exact::Quantity;
use mms_diagnosis::patterns;

use super::{LOADED, Point, exact, field, name};

/// The exact displacements of a grid, written in another order than the positions, with an error of some percent.
#[test]
fn values_in_another_order_are_named() {
    let grid = |[a, b]: [usize; 2]| -> Vec<Point> {
        let middle = |k: usize, count: usize| (k as f64 + 0.5) / count as f64;
        (0..a * b).map(|k| Point::new(middle(k % a, a), middle(k / a, b))).collect()
    };
    let exact = exact(&LOADED, 12.0);
    let of = |edges: [usize; 2], before: &Diagnosis, order: &dyn Fn(usize) -> usize| {
        let points = grid(edges);
        let time = 0.03;
        let right: Vec<Point> = points.iter().map(|x| field::displacement(time, x)).collect();
        let error = |x: &Point| 1e-4 * (7.0 * x[0] + 3.0 * x[1]).sin();
        let u = (0..points.len()).flat_map(|k| {
            let (u, error) = (right[order(k)], error(&points[k]));
            [u[0] + error, u[1] - error]
        });
        let snapshot = Snapshot {
            time,
            reference: points.iter().flat_map(|x| x.as_slice().to_vec()).collect(),
            values: vec![(Quantity::Displacement, u.collect())],
            ..Snapshot::default()
        };
        let found = patterns::or_permutation(&exact, &[&snapshot], before.clone());
        let which = found.ranked[0].which.clone().unwrap_or_default();
        (name(&found), which.into_owned())
    };
    let zero = Snapshot {
        time: 0.03,
        reference: grid([6, 6]).iter().flat_map(|x| x.as_slice().to_vec()).collect(),
        values: vec![(Quantity::Displacement, vec![0.0; 72])],
        ..Snapshot::default()
    };
    let other = patterns::zero(&exact, &[&zero]).expect("zeros");
    let unexplained = Diagnosis { finding: DiagnosisFinding::Unexplained, ..other.clone() };
    let named = |which: &str| ("points_permuted", which.to_owned());
    let (wide, count) = ([32, 18], 32 * 18);
    let order = |order: &dyn Fn(usize) -> usize| of(wide, &unexplained, order);
    assert_eq!(order(&|k| k).0, "unexplained");
    assert_eq!(order(&|k| count - 1 - k), named("reversed"));
    assert_eq!(order(&|k| (k + 1) % count), named("shifted by 1 point back"));
    assert_eq!(order(&|k| k % 18 * 32 + k / 18), named("axes of a grid of 32 x 18 points swapped"));
    // No rule: the order of scrambled numbers.
    let mut shuffled: Vec<usize> = (0..count).collect();
    shuffled.sort_by_key(|k| (*k as u32).wrapping_mul(2_654_435_769));
    assert_eq!(order(&|k| shuffled[k]), named(""));
    // Another name stays, unless most of the error is noise.
    assert_eq!(of(wide, &other, &|k| shuffled[k]).0, "output_zero");
    let place = |smooth| ErrorPlace {
        at: Vec::new(),
        time: 0.03,
        face: None,
        plane: None,
        order: None,
        smooth,
    };
    for (smooth, name) in [(0.9, "output_zero"), (0.1, "points_permuted")] {
        let other = Diagnosis { place: Some(place(smooth)), ..other.clone() };
        assert_eq!(of(wide, &other, &|k| shuffled[k]).0, name);
    }
}
