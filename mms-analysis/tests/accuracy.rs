//! Errors against arbitrary precision are measured as declared and at every extreme, and regimes that do not apply are left out
//! with the reason.

use mms_analysis::accuracy::regime::REGIMES;
use mms_analysis::accuracy::{Accuracy, Request, measure};
use mms_codegen::compile::compile_unproved;
use mms_program::precision::Precision;
use mms_spec::Form;
use mms_spec::quantity::Quantity;

fn measured(stem: &str, text: &str, request: &Request) -> Accuracy {
    let load = |_: &str| Err("only shipped materials".to_string());
    let compile = |options: &_| compile_unproved(stem, stem, text, &load, options);
    measure(&compile, request, |_| {}).unwrap_or_else(|failure| panic!("{failure}"))
}

fn gallery(stem: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../fields/");
    std::fs::read_to_string(format!("{folder}{stem}.toml")).expect("a field of the gallery")
}

fn few(points: usize) -> Request {
    Request { points, ..Request::default() }
}

#[test]
fn each_regime_has_rows_or_a_reason() {
    let accuracy = measured("bar_1d", &gallery("bar_1d"), &few(12));
    for regime in REGIMES {
        let rows = accuracy.rows.iter().filter(|row| row.regime == regime.name).count();
        let left_out = accuracy.left_out.iter().filter(|it| it.regime == regime.name);
        let precisions = left_out.map(|it| it.precision.map_or(3, |_| 1)).sum::<usize>();
        let expected = Quantity::ALL.len() * Form::ALL.len() * (3 - precisions);
        assert_eq!(rows, expected, "{}", regime.name);
    }
    assert_eq!(accuracy.left_out, []);
}

#[test]
fn a_wave_keeps_its_digits_after_a_million_windows() {
    let request = Request { regimes: Some(vec!["time_1e6".into()]), ..few(64) };
    let accuracy = measured("travelling_wave_2d", &gallery("travelling_wave_2d"), &request);
    let is_rounded_once = |precision| matches!(precision, Precision::F32 | Precision::F64);
    let rows: Vec<_> = accuracy.rows.iter().filter(|row| is_rounded_once(row.precision)).collect();
    assert_eq!(rows.len(), 2 * Form::ALL.len() * Quantity::ALL.len());
    for row in rows {
        assert!(row.errors.max_scaled_eps <= 64.0, "{row:?}");
    }
}

#[test]
fn what_cannot_be_made_is_left_out_with_the_reason() {
    let regimes = ["jacobian_1e-3", "jacobian_1e3", "lambda_mu_0", "subnormal_inputs"];
    let request = Request {
        regimes: Some(regimes.map(String::from).to_vec()),
        quantities: vec![Quantity::Jacobian],
        ..few(8)
    };
    let accuracy = measured("generalized_vortex", &gallery("generalized_vortex"), &request);
    let reason = |regime: &str| {
        let left_out = accuracy.left_out.iter().find(|it| it.regime == regime);
        left_out.map_or("", |it| it.reason.as_str())
    };
    for regime in &regimes[..2] {
        assert!(reason(regime).contains("no amplitude makes it"), "{:?}", accuracy.left_out);
    }
    assert!(accuracy.rows.iter().any(|row| row.regime == "lambda_mu_0"));
}

#[test]
fn a_field_without_units_has_no_extreme_moduli() {
    let with_units = gallery("bar_1d");
    let text = with_units.lines().map(|line| {
        let end = line.find("unit = ").map(|start| {
            let rest = &line[start..];
            (start, start + rest.find(',').unwrap_or(rest.len()) + 1)
        });
        match end {
            Some((start, end)) => format!("{}{}\n", &line[..start], &line[end..]),
            None => format!("{line}\n"),
        }
    });
    let text: String = text.collect();
    let request = Request { regimes: Some(vec!["moduli_1e9".into()]), ..few(8) };
    let accuracy = measured("bar_1d", &text, &request);
    assert_eq!(accuracy.rows.len(), 0);
    assert!(accuracy.left_out[0].reason.contains("unit of a stress"), "{:?}", accuracy.left_out);
}

#[test]
fn the_stable_form_holds_in_every_precision_as_declared() {
    let request = Request {
        regimes: Some(vec!["declared".into()]),
        forms: vec![Form::Stable],
        points: 64,
        ..Request::default()
    };
    let accuracy = measured("bar_1d", &gallery("bar_1d"), &request);
    assert_eq!(accuracy.rows.len(), Quantity::ALL.len() * Precision::ALL.len());
    for row in &accuracy.rows {
        let errors = row.errors;
        assert!(errors.max_scaled_eps <= 64.0, "{row:?}");
        assert!(errors.median_eps <= errors.p99_eps && errors.p99_eps <= errors.max_eps);
        assert_eq!((errors.not_finite, errors.undefined), (0, 0), "{row:?}");
    }
}

#[test]
fn the_fast_form_loses_digits_of_a_tiny_strain() {
    let request = Request {
        regimes: Some(vec!["displacement_1e-12".into()]),
        quantities: vec![Quantity::StrainEnergy],
        precisions: vec![Precision::F64],
        points: 32,
        ..Request::default()
    };
    let accuracy = measured("axis_aligned_1d", &gallery("axis_aligned_1d"), &request);
    let error = |form: Form| {
        let row = accuracy.rows.iter().find(|row| row.form == form).expect("both forms");
        row.errors.max_scaled_eps
    };
    assert!(error(Form::Stable) < 64.0 && error(Form::Fast) > 1e6);
}

#[test]
fn a_field_adds_its_own_extremes() {
    let own = "\n[[extreme]]\nname = \"soft\"\nset = { young = 1e-3 }\n";
    let text = gallery("bar_1d") + own;
    let request = Request { regimes: Some(vec!["soft".into()]), ..few(8) };
    let accuracy = measured("bar_1d", &text, &request);
    assert_eq!(accuracy.left_out, []);
    assert!(accuracy.rows.iter().all(|row| row.regime == "soft"));
}
