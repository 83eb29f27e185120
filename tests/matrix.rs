//! The matrix has a row for every mode, and its verdicts on sequences with a known answer are right.

use std::collections::{BTreeMap, BTreeSet};

use mms_exact::gallery;
use mms_lab::outcome::{Quantity, Size, SolverOutcome};
use mms_lab::rows::Named as _;
use mms_options::{Study, arguments};
use mms_runtime::{FormulationName, IntegratorName, ShapeName, Transfer};
use mms_spec::Claim;
use mms_verify::matrix::{ExpectedConvergence, MatrixRow, Word, rows};
use mms_verify::plan::RunPlan;
use mms_verify::verdict::{RowVerdict, judge};

fn studies() -> Vec<(MatrixRow, Study)> {
    let rows = rows().unwrap_or_else(|error| panic!("{error:#}"));
    rows.into_iter().map(|row| (row.clone(), row.study().unwrap().0)).collect()
}

/// Asserts that each of the items has some row.
fn each_has_a_row<T: std::fmt::Debug + Copy>(
    all: &[T],
    has: impl Fn(&MatrixRow, &Study, T) -> bool,
) {
    let studies = studies();
    for &one in all {
        assert!(studies.iter().any(|(row, study)| has(row, study, one)), "no row for {one:?}");
    }
}

/// Two runs that share a key would share a result.
#[test]
fn whatever_a_result_depends_on_is_in_its_key() {
    let (mut row, _) = studies().into_iter().find(|(row, _)| row.name == "precision/f32").unwrap();
    let study = "bar_1d --cells 8,16";
    let mut keys = BTreeSet::new();
    let others = [
        "--precision f32",
        "--form fast",
        "--courant 0.3",
        "--set young=2e6",
        "--rigid",
        "--shape linear",
    ];
    for (number, options) in std::iter::once("").chain(others).enumerate() {
        row.study = format!("{study} {options}");
        let plan = RunPlan::new(&[&row], false, "this program").unwrap();
        keys.extend(plan.jobs.into_iter().map(|job| job.key));
        assert_eq!(keys.len(), 2 * (number + 1), "{options}");
    }
}

#[test]
fn every_shape_function_has_a_row_in_every_formulation_that_takes_it() {
    for &formulation in FormulationName::ALL {
        let takes = |shape: &&ShapeName| {
            let method = mms_runtime::Method { shape: **shape, formulation, ..Default::default() };
            method.validate().is_ok()
        };
        let shapes: Vec<_> = ShapeName::ALL.iter().filter(takes).copied().collect();
        each_has_a_row(&shapes, |row, study, shape| {
            row.group() == "shape"
                && study.method.shape == shape
                && study.method.formulation == formulation
        });
    }
}

#[test]
fn every_integrator_has_a_row_in_time_alone_with_its_formal_order() {
    struct Formal;
    impl mms_runtime::integrator::IntegratorVisitor for Formal {
        type Output = i32;
        fn visit<I: mms_runtime::integrator::Integrator>(self) -> i32 {
            I::FORMAL_ORDER
        }
    }
    each_has_a_row(IntegratorName::ALL, |row, study, integrator| {
        row.halvings > 0
            && study.method.integrator == integrator
            && row.order == ExpectedConvergence::Order(integrator.visit(Formal).into())
    });
}

#[test]
fn every_transfer_has_a_row() {
    each_has_a_row(Transfer::NAMES, |row, _, name| row.name == format!("transfer/{name}"));
    for (row, study) in studies() {
        if let Some(name) = row.name.strip_prefix("transfer/") {
            let transfer = study.method.method(1).unwrap().setup.transfer;
            assert!(name.starts_with(&transfer.to_string()), "{} runs {transfer}", row.name);
        }
    }
}

#[test]
fn every_condition_has_a_row_whose_field_claims_it() {
    let fields = gallery::fields();
    each_has_a_row(Claim::ALL, |row, study, claim| {
        let field = fields.iter().find(|field| field.name == study.field).unwrap();
        let claimed = field.boundary.iter().any(|face| face.claim.value == claim);
        row.group() == "boundary" && row.name.contains(claim.name()) && claimed
    });
    each_has_a_row(&["boundary/periodic"], |row, study, name| {
        row.name == name && study.method.method(1).unwrap().setup.periodic != [false; 3]
    });
}

#[test]
fn every_material_and_every_dimension_has_a_row() {
    let fields = gallery::fields();
    let of = |study: &Study| fields.iter().find(|field| field.name == study.field).unwrap();
    let materials: Vec<_> =
        mms_codegen::materials::MATERIALS.iter().map(|(name, _)| *name).collect();
    each_has_a_row(&materials, |_, study, name| of(study).material.model.value == name);
    each_has_a_row(&[1, 2, 3], |_, study, dimension| of(study).dimension == dimension);
}

#[test]
fn quantities_other_than_the_displacement_have_a_row() {
    each_has_a_row(
        &["velocity", "deformation_gradient", "first_piola_kirchhoff", "mean_velocity"],
        |row, _, name| row.quantity.name() == name,
    );
}

#[test]
fn a_run_that_rows_share_is_planned_once_and_the_longest_comes_first() {
    let rows = rows().unwrap();
    let rows: Vec<_> = rows.iter().collect();
    let [full, quick] = [false, true].map(|quick| RunPlan::new(&rows, quick, "").unwrap());
    for plan in [&full, &quick] {
        assert!(plan.jobs.windows(2).all(|pair| pair[0].work >= pair[1].work));
        let mut commands: Vec<_> = plan.jobs.iter().map(|job| &job.key).collect();
        commands.sort();
        commands.dedup();
        assert_eq!(commands.len(), plan.jobs.len());
        for levels in &plan.levels {
            let all_differ =
                levels.iter().all(|at| levels.iter().filter(|a| *a == at).count() == 1);
            assert!(all_differ, "levels of a row are one run");
        }
        let levels: usize = plan.levels.iter().map(Vec::len).sum();
        assert!(levels > plan.jobs.len(), "no row shares a run");
    }
    assert!(quick.jobs.iter().all(|job| full.jobs.iter().any(|other| other.key == job.key)));
}

#[test]
fn arguments_are_cut_at_blanks_but_between_apostrophes() {
    assert_eq!(arguments("a  --b 'c = \"d e\"' f"), ["a", "--b", "c = \"d e\"", "f"]);
}

/// A row with an expected order.
fn row(order: ExpectedConvergence) -> MatrixRow {
    MatrixRow {
        name: "some/mode".into(),
        study: "bar_1d --cells 8,16,32".into(),
        quick: 3,
        halvings: 0,
        quantity: Quantity::Displacement,
        order,
        linf: None,
        tolerance: 0.15,
        constant: match order {
            ExpectedConvergence::Order(_) => Some(1024.0),
            ExpectedConvergence::Word(_) => None,
        },
        theory: "known".into(),
        catches: Vec::new(),
        witness: Some("a sequence".into()),
    }
}

fn finished(level: usize, errors: [f64; 3]) -> SolverOutcome {
    let cell_size = 1.0 / f64::from(8 << level);
    let run = Size { cell_size, time_step: 0.1, steps: 10, particles: 16, seconds: 0.0 };
    SolverOutcome::Finished { run, errors, mean_velocity: vec![1.0] }
}

/// The verdict for these errors on 8, 16, ... cells, the same in all norms.
fn verdict(order: ExpectedConvergence, errors: &[f64]) -> RowVerdict {
    let levels = errors.iter().enumerate().map(|(level, &e)| finished(level, [e; 3]));
    judge(&row(order), &levels.collect::<Vec<_>>()).verdict
}

const SECOND: ExpectedConvergence = ExpectedConvergence::Order(2.0);
const NONE: ExpectedConvergence = ExpectedConvergence::Word(Word::None);

/// Without a level, theory is not confirmed.
#[test]
fn without_a_level_nothing_passes() {
    for order in [SECOND, ExpectedConvergence::Word(Word::Exact)] {
        assert_eq!(verdict(order, &[]), RowVerdict::NotAsymptotic);
    }
    assert!(!judge(&row(NONE), &[]).as_expected());
}
const EXACT: ExpectedConvergence = ExpectedConvergence::Word(Word::Exact);

#[test]
fn verdicts_on_known_sequences() {
    // l2 at 32 cells is 1, so that the constant is 32^2.
    assert_eq!(verdict(SECOND, &[16.0, 4.0, 1.0]), RowVerdict::Pass);
    assert_eq!(verdict(SECOND, &[4.0, 2.0, 1.0]), RowVerdict::Fail);
    assert_eq!(verdict(SECOND, &[1.0, 1.0, 1.0]), RowVerdict::DoesNotConverge);
    assert_eq!(verdict(SECOND, &[1.0, 4.0, 16.0]), RowVerdict::DoesNotConverge);
    assert_eq!(verdict(SECOND, &[32.0, 4.0, 1.0]), RowVerdict::NotAsymptotic);
    assert_eq!(verdict(SECOND, &[64.0, 8.0, 1.0]), RowVerdict::NotAsymptotic);
    assert_eq!(verdict(SECOND, &[1.0]), RowVerdict::NotAsymptotic);
    assert_eq!(verdict(SECOND, &[]), RowVerdict::NotAsymptotic);
    assert_eq!(verdict(SECOND, &[0.0, 0.0, 0.0]), RowVerdict::NotAsymptotic);
    assert_eq!(verdict(NONE, &[1.0, 1.1, 1.2]), RowVerdict::DoesNotConverge);
    assert_eq!(verdict(NONE, &[4.0, 2.0, 1.0]), RowVerdict::Fail);
    assert_eq!(verdict(EXACT, &[1e-15, 2e-15, 0.0]), RowVerdict::Pass);
    assert_eq!(verdict(EXACT, &[1e-15, 1e-9, 1e-15]), RowVerdict::Fail);
    assert_eq!(verdict(EXACT, &[1e-15, f64::NAN, 1e-15]), RowVerdict::Fail);
}

/// A defect may keep the order and change the constant.
#[test]
fn the_right_order_with_another_constant_fails() {
    let judgement = |scale: f64| {
        let levels = [16.0, 4.0, 1.0].map(|e| e * scale);
        let levels = levels.into_iter().enumerate().map(|(level, e)| finished(level, [e; 3]));
        judge(&row(SECOND), &levels.collect::<Vec<_>>())
    };
    assert_eq!(judgement(1.005).verdict, RowVerdict::Pass);
    let other = judgement(1.02);
    assert_eq!(other.verdict, RowVerdict::Fail);
    assert_eq!(other.reason.as_deref(), Some("error constant 1.0445e3, not 1.0240e3"));
    assert_eq!(other.constant, Some(1024.0 * 1.02));
}

#[test]
fn the_largest_error_counts_too() {
    let levels = [[16.0, 16.0, 16.0], [4.0, 4.0, 4.0], [1.0, 1.0, 2.0]];
    let levels = levels.into_iter().enumerate().map(|(level, e)| finished(level, e));
    let judgement = judge(&row(SECOND), &levels.collect::<Vec<_>>());
    assert_eq!((judgement.verdict, judgement.observed_order()), (RowVerdict::Fail, Some(2.0)));
}

/// Some rows expect a stop; a run that was never started proves nothing.
#[test]
fn a_run_that_stopped_does_not_converge_and_one_that_was_refused_fails() {
    let stopped = match finished(2, [1.0; 3]) {
        SolverOutcome::Finished { run, .. } => {
            SolverOutcome::Stopped { run, failure: "inverted".into() }
        }
        other => other,
    };
    let refused = SolverOutcome::Refused { reason: "between nodes".into() };
    for (last, verdict) in [(stopped, RowVerdict::DoesNotConverge), (refused, RowVerdict::Fail)] {
        let levels = [finished(0, [16.0; 3]), finished(1, [4.0; 3]), last];
        for order in [SECOND, NONE] {
            assert_eq!(judge(&row(order), &levels).verdict, verdict);
        }
    }
}

/// If only the time step is refined, the order is in time.
#[test]
fn an_order_in_time_is_that_over_time_steps() {
    let row = MatrixRow { halvings: 2, constant: Some(100.0), ..row(SECOND) };
    let levels = [16.0, 4.0, 1.0].map(|e| match finished(0, [e; 3]) {
        SolverOutcome::Finished { run, errors, mean_velocity } => {
            let run = Size { time_step: 0.1 * f64::sqrt(e), ..run };
            SolverOutcome::Finished { run, errors, mean_velocity }
        }
        other => other,
    });
    let judgement = judge(&row, &levels);
    assert_eq!((judgement.verdict, judgement.observed_order()), (RowVerdict::Pass, Some(2.0)));
}

#[test]
fn momentum_is_held_to_what_it_is() {
    let row = |velocity| MatrixRow { quantity: Quantity::MeanVelocity(velocity), ..row(EXACT) };
    let levels = [finished(0, [1.0; 3]), finished(1, [1.0; 3])];
    assert_eq!(judge(&row(vec![1.0]), &levels).verdict, RowVerdict::Pass);
    assert_eq!(judge(&row(vec![1.1]), &levels).verdict, RowVerdict::Fail);
    assert_eq!(judge(&row(vec![1.0, 0.0]), &levels).verdict, RowVerdict::Fail);
}

/// The command observes which rows catch a defect; this test checks the rows that claim to catch one.
#[test]
fn the_page_of_defects_has_those_that_rows_say_they_catch() {
    let page = include_str!("../docs/defects.md");
    let name = |line: &'static str| line.strip_prefix("| `")?.split('`').next();
    let lines: BTreeMap<&str, &str> =
        page.lines().filter_map(|line| Some((name(line)?, line))).collect();
    let write = "write it anew: cargo run --release --features defects -- verify --defects --page > docs/defects.md";
    let rows = rows().unwrap();
    let caught: BTreeSet<&str> =
        rows.iter().flat_map(|row| row.catches.iter().map(String::as_str)).collect();
    assert!(caught.len() >= 25 && caught.iter().copied().eq(lines.keys().copied()), "{write}");
    for row in &rows {
        let shown = row.catches.iter().all(|name| lines[name.as_str()].contains(&row.name));
        assert!(shown, "{}: {write}", row.name);
    }
}
