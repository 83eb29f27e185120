//! Errors with a known law, and their correct verdict.

use mms_convergence::{
    Basis, ExpectedOrder, Judgement, NormFinding, Reason, Sample, Sequence, TermKind, Verdict,
};

const SECOND: ExpectedOrder = ExpectedOrder::new(2.0, 0.15);

/// Levels of sizes n, n/2, .. 1 times the finest, with the errors of a law of these sizes.
fn levels(count: i32, law: impl Fn(f64) -> f64) -> Sequence {
    let sizes = (0..count).map(|k| 2f64.powi(k));
    Sequence::new(sizes.map(|x| Sample::new(x * 1e-2, 1e-4 * law(x))))
}

fn finding(count: i32, law: impl Fn(f64) -> f64) -> NormFinding {
    NormFinding::of(&levels(count, law), SECOND)
}

/// The finding for levels with these orders between them.
fn with_orders(orders: &[f64]) -> NormFinding {
    let mut errors = vec![1.0];
    for order in orders {
        errors.push(errors[errors.len() - 1] * 0.5f64.powf(*order));
    }
    errors.reverse();
    finding(errors.len() as i32, |x| errors[x.log2().round() as usize])
}

fn assert_near(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() < within, "{found}, {expected}");
}

#[test]
fn a_power_law_of_the_expected_order_passes() {
    for count in 3..7 {
        let found = finding(count, |x| 3.0 * x * x);
        assert_eq!((found.verdict, found.reason), (Verdict::Pass, Reason::Settled), "{found:?}");
        assert_eq!((found.term, found.lengths.len()), (None, count as usize));
        let estimate = found.estimate.expect("an order");
        assert_near(estimate.order, 2.0, 1e-9);
        // At least a quarter of the tolerance.
        assert_near(estimate.reach(), 0.0375, 1e-9);
    }
}

#[test]
fn the_order_of_a_power_law_may_be_off_by_the_tolerance() {
    for count in 3..7 {
        for (order, verdict, reason) in [
            (-1.0, Verdict::Fail, Reason::Below),
            (0.0, Verdict::Fail, Reason::Below),
            (1.0, Verdict::Fail, Reason::Below),
            (1.8, Verdict::Fail, Reason::Below),
            (1.86, Verdict::Pass, Reason::Settled),
            (2.14, Verdict::Pass, Reason::Settled),
            (2.2, Verdict::NotAsymptotic, Reason::Above),
            (4.0, Verdict::NotAsymptotic, Reason::Above),
        ] {
            let found = finding(count, |x| x.powf(order));
            assert_eq!((found.verdict, found.reason), (verdict, reason), "{order}: {found:?}");
        }
        let narrow = ExpectedOrder { tolerance: 0.05, ..SECOND };
        let found = |order: f64| NormFinding::of(&levels(count, |x| x.powf(order)), narrow).verdict;
        assert_eq!([1.94, 1.96].map(found), [Verdict::Fail, Verdict::Pass]);
    }
}

/// The rule of the finest pair within 0.15 passed the first of these on three levels, and computed its limit as 1.96 +- 0.02.
#[test]
fn a_hidden_lower_order_is_found_with_its_share_and_where_it_takes_over() {
    for count in 3..7 {
        for share in [0.19, 0.1, 0.05, 0.5] {
            let found = finding(count, |x| (1.0 - share) * x * x + share * x);
            // The order of the finest pair is 1.86 with a share of 0.19.
            let expected = match share {
                0.5 => Verdict::Fail,
                0.19 => Verdict::NotAsymptotic,
                0.1 if count == 3 => Verdict::NotAsymptotic,
                _ => Verdict::Pass,
            };
            assert_eq!(found.verdict, expected, "{share}: {found:?}");
            let fitted = found.share.expect("a share");
            assert_eq!(fitted.order, 1.0);
            assert_near(fitted.share, share, 1e-6);
            let term = found.material_term(SECOND).expect("a term");
            assert_eq!((term.kind, term.order), (TermKind::LowerOrder, 1.0));
            assert_near(term.share, share, 1e-6);
            assert_near(term.takes_over, 1e-2 * share / (1.0 - share), 1e-6);
        }
    }
}

/// A term of lower order that reduces the error raises the order, until the error changes its sign.
#[test]
fn a_term_that_takes_away_from_the_error_is_no_pass() {
    for count in 3..7 {
        let found = finding(count, |x| 1.3 * x * x - 0.3 * x);
        assert_eq!(found.reason, Reason::Above, "{found:?}");
    }
}

/// Theory may state a range of orders, within which they settle.
#[test]
fn an_order_within_a_range_passes() {
    let range = ExpectedOrder { highest: 2.0, ..ExpectedOrder::new(1.0, 0.15) };
    assert_eq!(range.to_string(), "1 to 2");
    let found = |count: i32, law: &dyn Fn(f64) -> f64| NormFinding::of(&levels(count, law), range);
    for count in 3..7 {
        let laws: [(&dyn Fn(f64) -> f64, _); 7] = [
            (&|x| x, Verdict::Pass),
            (&|x| x * x, Verdict::Pass),
            (&|x| x.powf(1.5), Verdict::Pass),
            (&|x| 0.7 * x + 0.3 * x * x, Verdict::Pass),
            (&|x| x.powf(0.8), Verdict::Fail),
            (&|x| x.powf(2.3), Verdict::NotAsymptotic),
            (&|x| 0.5 + 0.5 * x, Verdict::Fail),
        ];
        for (at, (law, verdict)) in laws.iter().enumerate() {
            let found = found(count, law);
            assert_eq!(found.verdict, *verdict, "{count}, {at}: {found:?}");
        }
    }
    // Two levels are compared with the range as well.
    assert_eq!(found(2, &|x| x.powf(1.6)).verdict, Verdict::Pass);
    assert_eq!(found(2, &|x| x.powf(0.8)).verdict, Verdict::Fail);
}

/// Three levels whose order is open, with the cause.
#[test]
fn digits_or_scatter_leave_an_order_open() {
    let with = |rounding: f64| {
        let sample = |k: i32| {
            let x = 2f64.powi(k);
            Sample { rounding, ..Sample::new(x * 1e-2, 1e-4 * x * x) }
        };
        let found = NormFinding::of(&Sequence::new((0..3).map(sample)), SECOND);
        (found.verdict, found.reason)
    };
    assert_eq!(with(0.0), (Verdict::Pass, Reason::Settled));
    assert_eq!(with(2e-5), (Verdict::NotAsymptotic, Reason::Digits));
    let scattered = with_orders(&[2.1, 1.9]);
    assert_eq!((scattered.verdict, scattered.reason), (Verdict::NotAsymptotic, Reason::Open));
}

/// Orders of velocities on irregular meshes do not settle. The finest pair is enough for a pass, and too low a pair is none.
#[test]
fn orders_need_not_settle_where_theory_gives_a_bound() {
    let rough = ExpectedOrder { highest: 3.0, settles: false, ..ExpectedOrder::new(2.0, 0.15) };
    let found = |orders: &[f64], expected| {
        let mut errors = vec![1.0];
        orders.iter().for_each(|it| errors.push(errors[errors.len() - 1] * 0.5f64.powf(*it)));
        errors.reverse();
        let count = errors.len() as i32;
        NormFinding::of(&levels(count, |x| errors[x.log2().round() as usize]), expected).verdict
    };
    let settled = ExpectedOrder { settles: true, ..rough };
    assert_eq!(found(&[2.6, 2.83, 2.25], settled), Verdict::NotAsymptotic);
    // The highest order is tried first.
    assert_eq!(found(&[2.87, 3.03, 3.08], settled), Verdict::Pass);
    assert_eq!(found(&[2.6, 2.83, 2.25], rough), Verdict::Pass);
    assert_eq!(found(&[2.1, 2.2, 1.8], rough), Verdict::NotAsymptotic);
    assert_eq!(found(&[1.3, 1.1, 1.0], rough), Verdict::Fail);
}

/// Orders of correct solvers, whose errors have terms of higher order.
#[test]
fn orders_that_are_near_pass() {
    assert_eq!(with_orders(&[1.93, 1.95, 1.96, 1.96]).verdict, Verdict::Pass);
    assert_eq!(with_orders(&[2.3, 2.12, 2.05, 2.02]).verdict, Verdict::Pass);
    let first = ExpectedOrder::new(1.0, 0.15);
    let h1 = levels(4, |x| x + 0.3 * x * x);
    assert_eq!(NormFinding::of(&h1, first).verdict, Verdict::Pass);
}

#[test]
fn a_plateau_is_found_as_the_error_at_which_others_level_off() {
    for count in 3..7 {
        for share in [0.02, 0.3, 0.5] {
            let found = finding(count, |x| (1.0 - share) * x * x + share);
            let verdict = if share < 0.1 { Verdict::Pass } else { Verdict::Fail };
            assert_eq!(found.verdict, verdict, "{count} {share}: {found:?}");
            let term = found.term.expect("a term");
            assert_eq!(term.kind, TermKind::Plateau);
            assert_near(term.share, share, 1e-6);
        }
        let found = finding(count, |x| x.max(3.0).powi(2));
        assert_eq!(found.verdict, Verdict::Fail, "{found:?}");
    }
    let limit = finding(5, |x| 0.9 * x * x + 0.1).limit.expect("a limit");
    assert!(!limit.is_consistent());
    assert_near(limit.error, 1e-5, 1e-9);
    assert_near(limit.order, 2.0, 1e-3);
    assert!(finding(5, |x| x.powf(1.5)).limit.expect("a limit").error.abs() < 1e-10);
}

/// A plateau beside an order that is not the expected one is no second term of the expected order, and yet the limit is not 0.
#[test]
fn errors_that_level_off_are_not_consistent_whatever_their_order() {
    let found = finding(6, |x| 0.9 * x.powf(2.3) + 0.01 * x.sin().abs() + 0.4);
    assert_eq!(found.verdict, Verdict::Fail, "{found:?}");
    let limit = found.limit.expect("a limit");
    assert!(limit.interval[0] > 0.0 && !limit.is_consistent(), "{limit:?}");
}

/// A term that changes the order by less than a quarter of the tolerance decides nothing.
#[test]
fn a_term_that_nobody_sees_decides_nothing() {
    let found = finding(4, |x| 0.995 * x * x + 0.005 * x);
    assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
    assert!(found.term.is_some_and(|it| it.kind == TermKind::LowerOrder && it.is_shown()));
    assert_eq!(found.material_term(SECOND), None);
}

#[test]
fn coarse_levels_that_are_not_asymptotic_yet_are_left_out() {
    let found = finding(6, |x| x * x + 0.003 * x.powi(4));
    assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
    let term = found.term.expect("a term");
    assert_eq!((term.kind, term.order), (TermKind::PreAsymptotic, 4.0));
    // Three levels are never reduced.
    let found = finding(3, |x| x * x + 0.3 * x.powi(4));
    let seen = (found.verdict, found.reason, found.lengths.len());
    assert_eq!(seen, (Verdict::NotAsymptotic, Reason::Open, 3), "{found:?}");
}

#[test]
fn three_levels_are_judged_by_their_drift() {
    let pass = with_orders(&[1.90, 1.97]);
    let [low, high] = pass.estimate.and_then(|it| it.interval).expect("an interval");
    assert_eq!(
        (pass.verdict, pass.estimate.map(|it| it.basis)),
        (Verdict::Pass, Some(Basis::Drift))
    );
    assert_near(low, 1.90, 1e-9);
    assert_near(high, 1.97 + 1.25 * 0.07, 1e-9);
    for (orders, reason) in [
        ([1.999, 1.998], Reason::Settled),
        ([1.96, 1.95], Reason::Settled),
        ([1.7, 1.9], Reason::Settled),
        ([2.05, 1.97], Reason::Open),
        ([1.83, 1.89], Reason::Settled),
        ([1.9, 1.85], Reason::Open),
        ([1.82, 1.75], Reason::Below),
    ] {
        let found = with_orders(&orders);
        assert_eq!(found.reason, reason, "{orders:?}: {:?}", found.share);
    }
}

#[test]
fn two_levels_have_an_order_alone_and_say_so() {
    let verdicts = [
        (2.0, Verdict::Pass),
        (1.9, Verdict::Pass),
        (1.0, Verdict::Fail),
        (0.0, Verdict::Fail),
        (2.5, Verdict::NotAsymptotic),
    ];
    for (order, verdict) in verdicts {
        let found = with_orders(&[order]);
        assert_eq!((found.verdict, found.reason), (verdict, Reason::TwoLevels));
        let estimate = found.estimate.expect("an order");
        assert_eq!(estimate.interval, None);
        assert_near(estimate.order, order, 1e-12);
    }
    assert_eq!(finding(1, |x| x).reason, Reason::TooFewLevels);
    assert_eq!(finding(0, |x| x).verdict, Verdict::NotAsymptotic);
}

/// Two points lie at other distances from a face, so the order of their maximum varies.
#[test]
fn two_levels_leave_a_maximum_of_slightly_low_order_open() {
    let of = |order: f64| {
        let (l2, linf) = (levels(2, |x| x * x), levels(2, |x| x.powf(order)));
        let norms = [("l2", &l2, SECOND), ("linf", &linf, SECOND)];
        let judgement = Judgement::of(norms).expect("norms");
        (judgement.verdict(), judgement.deciding().norm.clone())
    };
    assert_eq!(of(1.75), (Verdict::Pass, "l2".into()));
    assert_eq!(of(1.68), (Verdict::NotAsymptotic, "linf".into()));
    assert_eq!(of(1.51), (Verdict::NotAsymptotic, "linf".into()));
    assert_eq!(of(1.49), (Verdict::Fail, "linf".into()));
}

/// Three errors of two digits: half a unit is 5 % of 1.0 and 1 % of 5.0.
#[test]
fn printed_digits_count() {
    let of = |lengths: &[f64], errors: &[f64]| {
        let samples = lengths.iter().zip(errors).map(|(h, e)| {
            let unit = 10f64.powf(e.log10().floor() - 1.0);
            Sample { rounding: 0.5 * unit, ..Sample::new(*h, *e) }
        });
        NormFinding::of(&Sequence::new(samples), SECOND)
    };
    let near = of(&[0.1, 0.099], &[1.0e-3, 9.8e-4]);
    assert_eq!((near.verdict, near.reason), (Verdict::NotAsymptotic, Reason::Digits));
    let estimate = near.estimate.expect("an order");
    assert_eq!(estimate.basis, Basis::Digits);
    assert_near(estimate.reach(), (0.05 + 0.5 / 98.0) / (0.1f64 / 0.099).ln(), 1e-9);
    assert_eq!(of(&[0.1, 0.05], &[4.0e-3, 1.0e-3]).verdict, Verdict::Pass);
    assert_eq!(of(&[0.1, 0.05], &[3.0e-3, 1.0e-3]).verdict, Verdict::Fail);
    assert_eq!(of(&[0.1, 0.05], &[3.4e-3, 1.0e-3]).reason, Reason::Digits, "1.77 +- 0.09");
    let three = of(&[0.1, 0.099, 0.098], &[1.0e-3, 9.8e-4, 9.6e-4]);
    assert_eq!(three.verdict, Verdict::NotAsymptotic, "{three:?}");
    assert_eq!(of(&[0.1, 0.05, 0.025], &[1.2e-3, 3.0e-4, 7.5e-5]).verdict, Verdict::Pass);
}

/// Orders are ratios of errors, so that the size of errors does not matter.
#[test]
fn errors_may_be_as_small_or_large_as_numbers_are() {
    for law in [|x: f64| x * x + 0.03 * x, |x: f64| x * x + x, |x: f64| x * x + 40.0] {
        let of = |scale: f64| {
            let sizes = (0..5).map(|k| 2f64.powi(k));
            NormFinding::of(&Sequence::new(sizes.map(|x| Sample::new(x, scale * law(x)))), SECOND)
        };
        let usual = of(1.0);
        for scale in [1e-300, 1e-200, 1e200, 1e300] {
            let found = of(scale);
            assert_eq!((found.verdict, found.reason), (usual.verdict, usual.reason), "{scale}");
        }
    }
}

#[test]
fn errors_of_zero_have_no_order_and_runs_that_stop_fail() {
    let zero = finding(4, |x| if x > 1.0 { x * x } else { 0.0 });
    assert_eq!((zero.verdict, zero.reason), (Verdict::NotAsymptotic, Reason::NoOrder));
    let stopped = Sample { error: None, ..Sample::new(1.0, 0.0) };
    let others = [0.5, 0.25, 0.125].map(|h| Sample::new(h, h * h));
    let found = NormFinding::of(&Sequence::new([stopped].into_iter().chain(others)), SECOND);
    assert_eq!((found.verdict, found.reason), (Verdict::Fail, Reason::Stopped));
}

/// The seminorm of H1 approaches its order from above: its term of higher order vanishes later. It decides if it fails.
#[test]
fn the_seminorm_of_h1_decides_where_it_fails() {
    let l2 = levels(3, |x| x * x);
    let of = |h1: Sequence| {
        let norms = [("l2", &l2, SECOND), ("h1", &h1, ExpectedOrder::new(1.0, 0.15))];
        let judgement = Judgement::of(norms).expect("norms");
        let verdict = judgement.norm("h1").expect("h1").finding.verdict;
        (verdict, judgement.verdict(), judgement.deciding().norm.clone())
    };
    let from_above = of(levels(3, |x| x + 0.015 * x.powi(3)));
    assert_eq!(from_above, (Verdict::NotAsymptotic, Verdict::Pass, "l2".into()));
    assert_eq!(of(levels(3, |x| x.sqrt())), (Verdict::Fail, Verdict::Fail, "h1".into()));
}

/// Errors that stall at round-off fail without the floor, and pass above it.
#[test]
fn what_may_be_round_off_is_not_judged() {
    let with = |knows_the_floor: bool| {
        let sample = |k: i32| {
            let h = 0.5f64.powi(k);
            let error = (h * h).max(1e-3);
            Sample { is_noise: knows_the_floor && error < 1.1e-3, ..Sample::new(h, error) }
        };
        NormFinding::of(&Sequence::new((0..8).map(sample)), SECOND)
    };
    assert_ne!(with(false).verdict, Verdict::Pass);
    let found = with(true);
    assert_eq!((found.verdict, found.lengths.len()), (Verdict::Pass, 5));
}

fn three(errors: [fn(f64) -> f64; 3]) -> Judgement {
    let sequences = errors.map(|law| levels(4, law));
    let norms = ["l1", "l2", "linf"].into_iter().zip(&sequences);
    Judgement::of(norms.map(|(norm, sequence)| (norm, sequence, SECOND))).expect("norms")
}

#[test]
fn the_worst_norm_decides_and_a_layer_is_told_by_its_orders() {
    let square: fn(f64) -> f64 = |x| x * x;
    let of_largest = three([square, square, |x| x.powf(1.6)]);
    assert_eq!(
        (of_largest.verdict(), of_largest.deciding().norm.as_str()),
        (Verdict::Fail, "linf")
    );
    assert_eq!(of_largest.layer(), None, "l2 does not show it");
    assert_eq!(three([square; 3]).deciding().norm, "l2");
    let slightly = three([square, square, |x| x.powf(1.84)]);
    assert_eq!(slightly.verdict(), Verdict::Pass, "the maximum is near");
    assert_eq!(slightly.norms[2].finding.verdict, Verdict::Fail);
    let layer = three([square, |x| x.powf(1.5), |x| x]);
    assert_eq!(layer.deciding().norm, "l2");
    assert_near(layer.layer().expect("a layer"), 1.0, 1e-6);
    // With the order 1/2 at the face, all three are lower.
    let layer = three([|x| x.powf(1.5), |x| x, |x| x.sqrt()]);
    assert_near(layer.layer().expect("a layer"), 0.5, 1e-6);
    assert_eq!(three([|x| x, |x| x, |x| x]).layer(), None, "a lower order everywhere is no layer");
}

#[test]
fn words_name_the_norm_the_levels_and_the_reason() {
    let says =
        |judgement: &Judgement| judgement.sentences("h", &|h| format!("h = {h:.4}")).join("\n");
    let square: fn(f64) -> f64 = |x| x * x;
    let layer = says(&three([square, |x| x.powf(1.5), |x| x]));
    assert!(layer.starts_with("fail: observed order 1.50, between 1.46"), "{layer}");
    let decided = "(l2; 4 levels, h = 0.0800 to h = 0.0100), expected 2\n";
    assert!(layer.contains(decided), "{layer}");
    assert!(
        layer.contains("an error of order 1 lowers the order on the finest mesh by"),
        "{layer}"
    );
    assert!(layer.contains("a layer at a face where the order is 1.0"), "{layer}");
    assert!(says(&three([|x| x.powi(3); 3])).contains("an error that changes its sign"));
    let hidden = says(&three([|x| 0.8 * x * x + 0.2 * x; 3]));
    assert!(hidden.contains("a hidden error of order 1, 20.0 % of the finest error"), "{hidden}");
    assert!(hidden.contains("it takes over below h = 0.0025"), "{hidden}");
    assert!(
        says(&three([square; 3])).contains("of order 1 that makes up less than 4 % at h = 0.01")
    );
}

/// Errors without an order neither pass nor fail, and support the solver. A run that stopped does not.
#[test]
fn errors_that_are_round_off_have_a_verdict_of_their_own() {
    let samples = || [0.0, 3e-17, 1e-17].into_iter().zip([4.0, 2.0, 1.0]);
    let exact = || Sequence::new(samples().map(|(error, h)| Sample::new(h, error))).exact(true);
    let found = NormFinding::of(&exact(), SECOND);
    assert_eq!((found.verdict, found.reason), (Verdict::Exact, Reason::Exact));
    assert_eq!((found.estimate, found.lengths.len()), (None, 3));
    assert_eq!(found.verdict.to_string(), "exact to round-off");
    assert!(found.verdict.is_good() && !Verdict::NotAsymptotic.is_good());
    let judgement = Judgement::of([("l2", &exact(), SECOND)]).expect("a norm");
    let says = judgement.sentences("h", &|h| format!("h {h}"));
    assert_eq!(
        says,
        [
            "exact to round-off: no observed order (l2; 3 levels, h 4 to h 1), expected 2; all errors are at round-off"
        ]
    );
    let stopped = Sample { error: None, ..Sample::new(0.5, 0.0) };
    let samples = samples().map(|(error, h)| Sample::new(h, error)).chain([stopped]);
    let found = NormFinding::of(&Sequence::new(samples).exact(true), SECOND);
    assert_eq!((found.verdict, found.reason), (Verdict::Fail, Reason::Stopped));
    assert!(Verdict::Exact < Verdict::Pass, "another quantity that has an order decides");
}
