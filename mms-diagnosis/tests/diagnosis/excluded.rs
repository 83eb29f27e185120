//! Mistakes that results exclude, compared with runs by a method that no diagnosis uses.

use mms_diagnosis::exact::Quantity;
use mms_diagnosis::excluded::{Study, VisibleSizes, excluded};
use mms_diagnosis::hypothesis::{self, all};

use super::field::{self, LAMBDA, MU};
use super::{LOADED, Mistaken, exact, solved};

#[test]
fn what_a_small_error_excludes_would_make_a_larger_one() {
    let exact = exact(&LOADED, 16.0);
    let right = Mistaken { moduli: [LAMBDA, MU], force: field::body_force, delay: 0.0, load: 1.0 };
    let (own, error) = (solved(&right), 2e-4);
    let study = Study {
        cell_size: 1.0 / 16.0,
        time_step: None,
        times: vec![0.03],
        errors: vec![(Quantity::Displacement, error)],
        is_static: false,
    };
    let all = excluded(&exact, &study, &all(&exact)).unwrap();
    let shown = |title: &str| all.iter().find(|it| it.title == title).unwrap().shown;
    let least = |title: &str| match shown(title) {
        VisibleSizes::From { least, .. } => least,
        other => panic!("{title}: {other:?}"),
    };
    // The error that a mistake adds to a run, over that error.
    let added = |mistaken: &Mistaken| {
        let state = solved(mistaken);
        let pairs = state.displacement.iter().zip(&own.displacement);
        let square: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
        (square / (state.displacement.len() / 2) as f64).sqrt() / error
    };
    let lambda = [LAMBDA * (1.0 + least("lambda_factor")), MU];
    let mu = [LAMBDA, MU * (1.0 + least("mu_factor"))];
    for moduli in [lambda, mu] {
        let times = added(&Mistaken { moduli, ..right });
        assert!((1.4..2.8).contains(&times), "twice the error, {moduli:?}: {times}");
    }
    let swapped = added(&Mistaken { moduli: [MU, LAMBDA], ..right });
    match shown("moduli_swapped") {
        VisibleSizes::Always(Some(times)) => assert!((times / swapped - 1.0).abs() < 0.3),
        other => panic!("{other:?}"),
    }
    // Uniform moduli are the same at x.
    assert!(matches!(shown("moduli_at_present"), VisibleSizes::Never(times) if times < 1e-9));
    // An error as large as the body excludes no mistake that keeps the body whole.
    let coarse = Study { errors: vec![(Quantity::Displacement, 1.0)], ..study };
    let all = excluded(&exact, &coarse, &hypothesis::all(&exact)).unwrap();
    for name in ["lambda_factor", "mu_factor", "moduli_swapped", "start_at_rest"] {
        assert!(!all.iter().find(|it| it.name == name).unwrap().is_excluded(), "{name}");
    }
}
