//! Points and cells of two results in different orders.

use mms_results::motion::validate_distinct;
use mms_results::names::KNOWN;
use mms_results::names::Values;
use mms_results::pairing::{PairedBy, Pairs, cells, points};
use mms_results::{Array, Cells, Snapshot, Stored};
use proptest::prelude::*;

fn array(name: &str, components: usize, values: &[f64]) -> Array {
    Array {
        name: name.into(),
        components,
        values: values.to_vec(),
        stored: Stored::Double,
        ..Array::default()
    }
}

fn snapshot(path: &str, arrays: Vec<Array>) -> Snapshot {
    Snapshot { path: path.into(), of_points: arrays, ..Snapshot::default() }
}

fn listed(pairs: &Pairs) -> Vec<[usize; 2]> {
    pairs.iter().collect()
}

fn said(one: &Snapshot, other: &Snapshot) -> String {
    points(one, other, &KNOWN).unwrap_err().to_string()
}

#[test]
fn points_are_paired_by_their_numbers_before_anything_else() {
    let a = snapshot(
        "a",
        vec![array("GlobalNodeIds", 1, &[7.0, 8.0, 9.0]), array("X", 1, &[0.0, 0.5, 1.0])],
    );
    let b = snapshot(
        "b",
        vec![array("GlobalNodeIds", 1, &[9.0, 7.0, 8.0]), array("X", 1, &[0.0, 0.5, 1.0])],
    );
    let (pairs, by) = points(&a, &b, &KNOWN).unwrap();
    assert_eq!(
        (listed(&pairs), by),
        (vec![[0, 1], [1, 2], [2, 0]], PairedBy::Number("GlobalNodeIds".into()))
    );
    let other = snapshot("c", vec![array("GlobalNodeIds", 1, &[9.0, 7.0, 6.0])]);
    assert!(
        said(&a, &other).starts_with("a: this point has no partner in c by its number (point 1)")
    );
    // Numbers that start again on each rank do not count.
    let ranks = snapshot(
        "d",
        vec![array("GlobalNodeIds", 1, &[0.0, 1.0, 0.0]), array("X", 1, &[1.0, 0.5, 0.0])],
    );
    assert_eq!(points(&ranks, &a, &KNOWN).unwrap().1, PairedBy::Place);
}

#[test]
fn points_between_ranks_are_one() {
    // Two halves of a line, which both contain the middle.
    let whole = snapshot("whole", vec![array("X", 1, &[0.0, 0.5, 1.0])]);
    let halves = snapshot("halves", vec![array("X", 1, &[0.5, 1.0, 0.0, 0.5])]);
    let (pairs, by) = points(&whole, &halves, &KNOWN).unwrap();
    assert_eq!((listed(&pairs), by), (vec![[0, 2], [1, 0], [1, 3], [2, 1]], PairedBy::Place));
    let (pairs, _) = points(&halves, &whole, &KNOWN).unwrap();
    assert_eq!(listed(&pairs), [[0, 1], [1, 2], [2, 0], [3, 1]]);
    let less = snapshot("less", vec![array("X", 1, &[0.0, 1.0])]);
    assert!(
        said(&whole, &less).contains("whole: this point has no partner in less by its X (point 1)")
    );
    assert!(
        said(&less, &whole).contains("whole: this point has no partner in less by its X (point 1)")
    );
}

#[test]
fn points_without_a_name_are_tried_as_reference_and_as_present_positions() {
    let place = |name: &str, x: [f64; 2], u: [f64; 2]| Snapshot {
        points: Some(array("Points", 1, &x)),
        ..snapshot(name, vec![array("u", 1, &u)])
    };
    // The places x differ, and x - u is equal.
    let a = place("a", [0.1, 1.3], [0.1, 0.3]);
    let b = place("b", [1.25, 0.125], [0.25, 0.125]);
    let (pairs, by) = points(&a, &b, &KNOWN).unwrap();
    assert_eq!((listed(&pairs), by), (vec![[0, 1], [1, 0]], PairedBy::Place));
    // Without u nothing pairs the points, but equally many are compared in their order.
    let only = |x: [f64; 2]| snapshot("x", vec![array("x", 1, &x)]);
    assert_eq!(
        points(&only([0.0, 1.0]), &only([1.5, 0.1]), &KNOWN).unwrap(),
        (Pairs::InOrder(2), PairedBy::Order)
    );
}

#[test]
fn single_and_double_precision_are_paired() {
    let values = [0.1, 0.2, 0.3, 0.7];
    let mut single = array("X", 1, &values.map(|x| f64::from(x as f32)));
    single.stored = Stored::Single;
    single.values.reverse();
    let (pairs, _) =
        points(&snapshot("a", vec![array("X", 1, &values)]), &snapshot("b", vec![single]), &KNOWN)
            .unwrap();
    assert_eq!(listed(&pairs), [[0, 3], [1, 2], [2, 1], [3, 0]]);
}

#[test]
fn cells_are_paired_by_their_points() {
    let mesh = |path: &str, x: &[f64], cells: &[[usize; 2]]| Snapshot {
        cells: Cells {
            types: vec![3; cells.len()],
            points: cells.concat(),
            ends: (1..=cells.len()).map(|it| 2 * it).collect(),
        },
        ..snapshot(path, vec![array("X", 1, x)])
    };
    let whole = mesh("whole", &[0.0, 0.5, 1.0], &[[0, 1], [1, 2]]);
    let halves = mesh("halves", &[0.5, 1.0, 0.0, 0.5], &[[1, 0], [2, 3]]);
    let (pairs, _) = points(&whole, &halves, &KNOWN).unwrap();
    assert_eq!(listed(&cells(&whole, &halves, &pairs).unwrap()), [[0, 1], [1, 0]]);
    let other = mesh("other", &[0.5, 1.0, 0.0, 0.5], &[[1, 0], [2, 1]]);
    let said = cells(&whole, &other, &pairs).unwrap_err().to_string();
    assert_eq!(said, "whole: cell 0 has no counterpart in other");
}

proptest! {
    /// Points of a grid in any order are paired correctly, each once.
    #[test]
    fn every_order_is_undone(order in Just((0..60).collect::<Vec<usize>>()).prop_shuffle(), noise in -1e-13..1e-13) {
        let point = |at: &usize| [0.1 * (*at % 10) as f64, 0.3 * (*at / 10) as f64];
        let of = |order: &[usize], off: f64| -> Vec<f64> {
            order.iter().flat_map(|at| point(at).map(|x| x * (1.0 + off * 1e-3))).collect()
        };
        let straight: Vec<usize> = (0..60).collect();
        let a = snapshot("a", vec![array("X", 2, &of(&straight, 0.0))]);
        let b = snapshot("b", vec![array("X", 2, &of(&order, noise))]);
        let (pairs, _) = points(&a, &b, &KNOWN).unwrap();
        let found = listed(&pairs);
        prop_assert_eq!(found.len(), 60);
        prop_assert!(found.iter().all(|[a, b]| order[*b] == *a));
    }
}

/// Among so many points that threads share them, and with a signed 0.
#[test]
fn two_points_in_one_place_are_found_among_many() {
    let values = |numbers: Vec<f64>| Values {
        numbers: numbers.into(),
        components: 2,
        rounding: 0.0,
        stored: Stored::Double,
        is_of_cells: false,
    };
    let count = 200_000;
    let mut numbers: Vec<f64> =
        (0..count).flat_map(|at| [(at % 500) as f64, (at / 500) as f64]).collect();
    let all = snapshot("a", Vec::new());
    assert_eq!(validate_distinct(&all, &values(numbers.clone())), Ok(()));
    // The first point again, in the middle.
    numbers[200_000..200_002].copy_from_slice(&[-0.0, 0.0]);
    let said = validate_distinct(&all, &values(numbers)).unwrap_err().to_string();
    assert!(
        said.contains("a: point 100000: X = [-0.0, 0.0] is where another point is: a: point 0"),
        "{said}"
    );
}
