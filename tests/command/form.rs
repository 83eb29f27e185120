//! `--form`: stable, or with the fewest operations.

use super::mms::{Folder, numbers};

/// P of a bar that is stretched by next to nothing, by `eval` with these options.
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
    // F - 1/F loses what F = 1 + H does not hold of H: some 1e-16 of 1e-10.
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
    let text = |form: &str| folder.mms(&format!("emit bar_1d --form {form}")).exits(0).stdout;
    assert_ne!(text("fast"), text("stable"));
    assert_eq!(folder.mms("emit bar_1d").exits(0).stdout, text("stable"));
}

#[test]
fn there_is_no_other_form() {
    let folder = Folder::new();
    for command in ["eval bar_1d --at 0.3", "show bar_1d", "check bar_1d", "emit bar_1d"] {
        let run = folder.mms(&format!("{command} --form quick")).exits(2);
        run.complains("the forms are stable, fast");
    }
}
