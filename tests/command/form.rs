//! `--form`: stable, or with the fewest operations.

use serde_json::Value;

use super::mms::{Folder, numbers};

/// P of a bar with a tiny strain, by `eval` with these options.
fn stress(options: &str) -> f64 {
    let folder = Folder::new();
    let place = "--at 0.37 --time 0.013 --quantity P --set amplitude=1e-10 --json";
    let run = folder.mms(&format!("eval bar_1d {place} {options}")).exits(0);
    numbers(&run.json()["points"][0]["first_piola_kirchhoff"])[0]
}

#[test]
fn the_stable_form_keeps_what_the_fast_one_cancels() {
    let folder = Folder::new();
    let place = "--at 0.37 --time 0.013 --quantity P --set amplitude=1e-10 --json";
    let wide = folder.mms(&format!("eval bar_1d {place} --precision wide")).exits(0).json();
    let truth = numbers(&wide["points"][0]["first_piola_kirchhoff"])[0];
    let eps = |value: f64| ((value - truth) / truth).abs() / f64::EPSILON;
    assert!(eps(stress("")) <= 8.0, "{} eps", eps(stress("")));
    assert_eq!(stress(""), stress("--form stable"));
    // F - 1/F loses the digits of H that F = 1 + H rounds off: some 1e-16 of 1e-10.
    let fast = eps(stress("--form fast"));
    assert!((1e4..1e11).contains(&fast), "{fast} eps");
}

#[test]
fn the_fast_form_has_fewer_operations() {
    let folder = Folder::new();
    let operations = |form: &str| {
        let run = folder.mms(&format!("show bar_1d --quantity P --form {form} --json")).exits(0);
        run.json()["operations"]["after"].as_u64().expect("a count")
    };
    assert!(operations("fast") < operations("stable"));
    let text = |form: &str| {
        folder.mms(&format!("emit bar_1d --form {form} --target rust-mms-math")).exits(0).stdout
    };
    assert_ne!(text("fast"), text("stable"));
    assert_eq!(folder.mms("emit bar_1d --target rust-mms-math").exits(0).stdout, text("stable"));
}

#[test]
fn there_is_no_other_form() {
    let folder = Folder::new();
    for command in [
        "eval bar_1d --at 0.3",
        "show bar_1d",
        "check bar_1d",
        "emit bar_1d --target rust-mms-math",
        "run bar_1d",
        "study bar_1d",
        "extremes bar_1d",
    ] {
        let run = folder.mms(&format!("{command} --form quick")).exits(2);
        run.complains("the forms are stable, fast");
    }
}

/// All errors of a study.
fn errors(study: &Value) -> &Value {
    &study["quantities"]
}

#[test]
fn a_study_of_both_forms_sets_them_beside_each_other() {
    let folder = Folder::new();
    // The field is interpreted in either form, so that nothing else differs; Div P differs if moduli depend on X.
    folder.write("bar.toml", include_str!("../../fields/graded_bar.toml"));
    let study = "study bar.toml --cells 4,8 --precision f32";
    let run = folder.mms(&format!("{study} --form stable,fast --json --output both")).exits(0);
    run.complains("leapfrog, f32, 2 particles").complains("leapfrog, f32, fast form, 2 particles");
    let document = run.json();
    let studies = document["studies"].as_array().expect("studies");
    assert_eq!(studies.len(), 2);
    assert_ne!(errors(&studies[0]), errors(&studies[1]), "{document:#}");
    for (study_of_both, form) in studies.iter().zip(["stable", "fast"]) {
        assert_eq!(study_of_both["name"], form);
        assert_eq!(study_of_both["method"]["form"], form);
        let alone = folder.mms(&format!("{study} --form {form} --json")).exits(0).json();
        assert_eq!(alone["method"], study_of_both["method"]);
        assert_eq!(errors(&alone), errors(study_of_both));
    }
    folder.mms("report both").exits(0);
    let page = folder.read("both/report.html");
    assert!(page.contains("<dt>form</dt><dd>fast</dd>"), "{page}");
}

#[test]
fn a_saved_scene_has_a_form() {
    let folder = Folder::new();
    let scene = "field = \"bar_1d\"\ncells = [4, 8]\nform = ";
    folder.write("one.toml", &format!("{scene}\"fast\"\n"));
    let one = folder.mms("study --study one.toml --json").json();
    assert_eq!(one["method"]["form"], "fast");
    let given = folder.mms("study --study one.toml --form stable --json").json();
    assert_eq!(given["method"]["form"], "stable");
    folder.write("both.toml", &format!("{scene}[\"stable\", \"fast\"]\n"));
    folder.mms("study --study both.toml").prints("fast: ").prints("of 2 methods pass");
    folder.write("none.toml", &format!("{scene}\"quick\"\n"));
    folder.mms("study --study none.toml").exits(2).complains("the forms are stable, fast");
}

#[test]
fn what_runs_says_in_which_form() {
    let folder = Folder::new();
    let run = "run bar_1d --cells 8 --output one";
    folder.mms(&format!("{run} --form fast")).exits(0).prints("cpgimp leapfrog, f64, fast form, 2");
    folder.mms("report one").exits(0);
    assert!(folder.read("one/report.html").contains("bar_1d: cpgimp leapfrog, fast form, 8 cells"));
    let stable = folder.mms(run).exits(0);
    stable.prints("cpgimp leapfrog, f64, 2 particles");
    let extremes = "extremes bar_1d --quick --row single --json";
    for form in ["stable", "fast"] {
        let document = folder.mms(&format!("{extremes} --form {form}")).json();
        assert_eq!(document["method"]["form"], form);
        let settings = document["rows"].as_array().expect("rows").iter();
        let mut settings = settings.map(|row| row["setting"].as_str().expect("a setting"));
        assert!(settings.all(|it| it.contains("fast form") == (form == "fast")), "{document:#}");
    }
}
