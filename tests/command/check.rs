//! `mms check`: mistakes with their places, and closed forms.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::mms::{BAR, Folder};

/// A folder with the bar, in which `from` is replaced by `to`.
fn changed(from: &str, to: &str) -> Folder {
    assert!(BAR.contains(from), "the bar has no `{from}`");
    let folder = Folder::new();
    folder.write("bar.toml", &BAR.replace(from, to));
    folder
}

/// `line:column` of a text in the bar.
fn place(text: &str) -> String {
    let start = BAR.find(text).unwrap_or_else(|| panic!("the bar has no `{text}`"));
    let line = BAR[..start].matches('\n').count() + 1;
    let column = start - BAR[..start].rfind('\n').map_or(0, |newline| newline + 1) + 1;
    format!("{line}:{column}")
}

#[test]
fn a_right_file_exits_0_and_its_closed_form_is_named() {
    let run = Folder::with_bar("bar.toml").mms("check bar.toml").exits(0);
    run.prints("bar.toml: Body force on a 1D bar").prints("body_force");
    run.prints("slide 'Return to the 1D Bar', with the sign corrected");
    assert_eq!(run.stderr, "");
    assert!(!run.stdout.contains("  name "), "{run}");
    // A parameter may have the name of a quantity, and a note says so.
    let folder = Folder::new();
    folder.write("bar.toml", &BAR.replace("young", "E"));
    let run = folder.mms("check bar.toml").exits(0);
    run.prints("  name   `E` is the parameter for `--set`, and the quantity `green_lagrange` for `--quantity`");
}

#[test]
fn the_sign_printed_on_the_slides_is_refuted_with_exit_1() {
    let folder = changed("+ young/rho0*(1 + F^-2)*A)", "- young/rho0*(1 + F^-2)*A)");
    let run = folder.mms("check bar.toml").exits(1);
    run.prints("FAILED").prints(&format!("bar.toml:{}", place("\"(X*(2*length - X)*dA2")));
    run.prints("it acts as force_sign: the sign of Div P in b");
    let checks = &folder.mms("check bar.toml --json").exits(1).json()["files"][0]["checks"];
    assert_eq!(checks[0]["status"], "failed");
    assert_eq!(checks[0]["acts_as"]["hypothesis"], "force_sign");
    assert!(checks[0]["difference"]["derived"].is_number(), "{checks}");
}

/// A difference beyond the shown digits is described, because equal digits do not show it.
#[test]
fn a_difference_behind_the_digits_that_are_shown_is_said() {
    let close =
        "[[check]]\nquantity = \"u\"\nequals = [\"X*(2*length - X)/length^2*A*(1 + 1e-19)\"]\n";
    let folder = Folder::new();
    folder.write("bar.toml", &format!("{BAR}\n{close}"));
    folder.mms("check bar.toml").exits(1).prints("which differ after the 16th digit");
}

/// If a parameter is set, its range is not checked.
#[test]
fn what_is_set_is_what_is_checked() {
    let amplitude = "amplitude = { value = 0.2,";
    let folder = changed(amplitude, "amplitude = { value = 0.2, range = [0.1, 0.7],");
    let inside_out = "the field turns matter inside out";
    folder.mms("check bar.toml").exits(1).complains("J = det F is not");
    folder.mms("check bar.toml --set amplitude=0.3").exits(0).prints("J > 0: 0.4");
    folder.mms("check bar.toml --set amplitude=0.6").exits(1).complains(inside_out);
    let outside = folder.mms("check bar.toml --set amplitude=0.8").exits(2);
    outside.complains("outside its range");
    folder.mms("check bar.toml --set amplitude").exits(2).complains("expected name=value");
    folder.mms("check bar.toml --set amplitud=1").exits(2).prints("1 mistake(s)");
}

/// Each value in a range must give an elastic solid.
#[test]
fn a_range_without_a_positive_density_or_modulus_is_refused_at_its_line() {
    let cases = [
        ("rho0      = { value = 1000,", "rho0      = { value = 1000, range = [-10, 1000],", "rho0"),
        ("young     = { value = 1e6, ", "young     = { value = 1e6, range = [0, 1e6],", "mu"),
    ];
    for (from, to, name) in cases {
        let folder = changed(from, to);
        let line = BAR[..BAR.find(from).expect("a parameter")].matches('\n').count() + 1;
        let place = format!("bar.toml:{line}:{}", to.find("range = [").expect("a range") + 10);
        let check = folder.mms("check bar.toml").exits(1);
        check.complains(&place).complains("positive").complains("narrow the range");
        check.prints(&format!("{name} > 0 is REFUTED"));
        let certificate = |command| {
            let document = folder.mms(command).json();
            document["files"][0]["certificate"]["solid"].clone()
        };
        assert_eq!(certificate("check bar.toml --json"), false);
        folder.mms("eval bar.toml --at 1 --time 0").exits(2).complains(&place);
        let parameter = from.split(' ').next().expect("a name");
        let set = format!("check bar.toml --json --set {parameter}=500");
        folder.mms(&set).exits(0);
        assert_eq!(certificate(&set), true);
    }
}

#[test]
fn a_mistake_exits_2_at_its_own_line_and_column() {
    let folder = changed("cos(c*pi*t/length)", "cos(c*pi*t/lenght)");
    let run = folder.mms("check bar.toml").exits(2);
    let start = place("length)\"\n\n[displacement]");
    run.complains(&format!("bar.toml:{start}")).complains("unknown name `lenght`");
    run.complains("did you mean `length`?");
}

#[test]
fn all_mistakes_are_found_in_one_run_and_counted() {
    let text = BAR
        .replace("title     =", "titel     =")
        .replace("cos(c*pi*t/length)", "cos(c*pi*t/lenght, 1)")
        .replace("lambda  = \"0\"", "lambda  = \"1/0\"")
        .replace("x_max = \"free\"", "x_max = \"fre\"");
    let folder = Folder::new();
    folder.write("bar.toml", &text);
    let run = folder.mms("check bar.toml").exits(2);
    let found = run.stderr.lines().filter(|line| line.starts_with("error:")).count();
    let places = run.stderr.lines().filter(|line| line.contains("--> bar.toml:")).count();
    assert_eq!(found, places, "each has its own place: {run}");
    run.complains("`titel`").complains("`lenght`").complains("division by zero");
    run.complains("`fre`").prints(&format!("bar.toml: {found} mistake(s)"));
}

#[test]
fn every_file_is_checked_whatever_the_others_are() {
    let folder = changed("cos(", "cso(");
    folder.write("good.toml", BAR);
    let run = folder.mms("check bar.toml absent.toml good.toml").exits(2);
    run.complains("did you mean `cos`?").complains("cannot read `absent.toml`");
    run.prints("good.toml: Body force on a 1D bar");
    let files = folder.mms("check bar.toml absent.toml good.toml --json").exits(2).json();
    let names: Vec<_> = (0..3).map(|index| files["files"][index]["file"].clone()).collect();
    assert_eq!(names, ["bar.toml", "absent.toml", "good.toml"]);
}

#[test]
fn a_wrong_file_is_refused_by_every_command_with_the_same_text() {
    let folder = changed("cos(", "cso(");
    let expected = folder.mms("check bar.toml").exits(2).stderr;
    for command in ["show bar.toml", "eval bar.toml --at 1 --time 0", "study bar.toml"] {
        folder.mms(command).exits(2).complains(expected.trim_end()).prints_nothing();
    }
}

#[test]
fn the_document_of_a_wrong_file_names_each_place() {
    let folder = changed("cos(c*pi*t/length)", "cos(c*pi*t/lenght)");
    let document = folder.mms("check bar.toml --json").exits(2).json();
    let diagnostic = &document["files"][0]["diagnostics"][0];
    let found = format!("{}:{}", diagnostic["line"], diagnostic["column"]);
    assert_eq!(found, place("length)\"\n\n[displacement]"));
    assert_eq!(diagnostic["path"], "bar.toml");
    assert_eq!(diagnostic["message"], "unknown name `lenght`");
    assert_eq!(diagnostic["help"][0], "did you mean `length`?");
    let unreadable = folder.mms("check nowhere.toml --json").exits(2).json();
    assert!(unreadable["files"][0]["diagnostics"][0]["message"].is_string(), "{unreadable}");
}

/// The bar, with a displacement and one closed form of it.
fn with_displacement(u: &str, closed_form: &str) -> Folder {
    let folder = Folder::new();
    // The claims of the bar do not hold for every displacement.
    let before = &BAR[..BAR.find("[boundary]").expect("claims")];
    let text = before.replace("X*(2*length - X)/length^2 * A", u);
    assert_ne!(text, before);
    let check = format!("[[check]]\nquantity = \"displacement\"\nequals = [\"{closed_form}\"]\n");
    folder.write("bar.toml", &(text + &check));
    folder
}

#[test]
fn a_closed_form_of_values_far_below_double_precision_holds() {
    let folder = with_displacement("1e-9*A*exp(-1e7*X/length)", "1e-9*A/exp(X/length)^10000000");
    folder.mms("check bar.toml").exits(0).prints("displacement agrees to 1e-20 at 128 points");
    let wrong = with_displacement("1e-9*A*exp(-1e7*X/length)", "1e-9*A/exp(X/length)^10000001");
    wrong.mms("check bar.toml").exits(1).prints("displacement FAILED");
}

#[test]
fn what_is_undefined_in_the_domain_is_told_as_such() {
    // The domain is 0 to 1: the root has no value in half of it.
    let folder = with_displacement("A*sqrt(X/length - 1/2)", "sqrt(X/length - 1/2)*A");
    let run = folder.mms("check bar.toml").exits(1);
    run.prints("displacement is UNDEFINED at 64 of 128 points");
    run.prints("derived undefined, closed form undefined").prints("shrink [domain]");
    let check = &folder.mms("check bar.toml --json").exits(1).json()["files"][0]["checks"][0];
    assert_eq!((&check["status"], &check["points"]), (&"undefined".into(), &128.into()));
    assert_eq!(check["undefined_points"], 64);
    assert!(check["difference"]["derived"].is_null(), "{check}");
    let other =
        with_displacement("A*X/length", "A*X/length*sqrt(X/length - 1/2)/sqrt(X/length - 1/2)");
    other.mms("check bar.toml").exits(0);
    let other = with_displacement("A*X/length", "A*X/length + 0*A*ln(X/length - 1/2)");
    other.mms("check bar.toml").exits(0);
    let other =
        with_displacement("A*X/length", "A*X/length*exp(ln(X/length - 1/2))/(X/length - 1/2)");
    let run = other.mms("check bar.toml").exits(1);
    run.prints("closed form undefined").prints("is UNDEFINED at 65 of 128 points");
}

#[test]
fn a_difference_is_told_before_what_is_undefined() {
    let folder = with_displacement("A*sqrt(X/length - 1/2)", "2*A*sqrt(X/length - 1/2)");
    folder.mms("check bar.toml").exits(1).prints("displacement FAILED");
}

#[test]
fn what_cancels_is_evaluated_as_it_is_written() {
    // Canonical form simplifies this to X; as written it has no value in half of the domain.
    let root = "sqrt(X/length - 1/2)";
    let folder = with_displacement(&format!("A*{root}*{root}"), "A*(X/length - 1/2)");
    let run = folder.mms("check bar.toml").exits(1);
    run.prints("displacement agrees to 1e-20 at 128 points");
    run.prints("component 1 is UNDEFINED as written at 16 of 32 points");
    run.prints(&format!("bar.toml:17:9: `{root}` has no value at X = ["));
    let found = &folder.mms("check bar.toml --json").exits(1).json()["files"][0]["undefined"];
    assert_eq!((&found[0]["component"], &found[0]["points"]), (&1.into(), &16.into()));
    assert_eq!((&found[0]["line"], &found[0]["column"]), (&17.into(), &9.into()));
    // Powers, definitions and functions of two arguments, all of them defined.
    let defined = "A*(X/length - 2)^3*(X/length - 2)^-2*hypot(X/length, 1)*cbrt(-1 - X/length)";
    with_displacement(defined, defined).mms("check bar.toml").exits(0);
}

#[test]
fn what_is_proved_is_told_with_its_bounds() {
    let run = Folder::with_bar("bar.toml").mms("check bar.toml").exits(0);
    run.prints("proof  J > 0: 0.6 <= J <= 1.4").prints("every quantity is finite everywhere");
    run.prints("claim  x_min is fixed (u = 0): proved").prints("x_max is free (P N = 0): proved");
    let file =
        &Folder::with_bar("bar.toml").mms("check bar.toml --json").exits(0).json()["files"][0];
    assert_eq!(file["claims"][1]["status"], "proved", "{file}");
    let certificate = &file["certificate"];
    let number = |key: &str| certificate[key].as_f64().unwrap_or_else(|| panic!("{certificate}"));
    assert_eq!(certificate["finite"], true);
    // F = 1 + 0.4 cos, and the fastest wave is where F is least: c^2 = E/(2 rho0) (1 + F^-2).
    let fastest = (500.0_f64 * (1.0 + 0.6_f64.powi(-2))).sqrt();
    assert!((1.4..1.4 * 1.1).contains(&number("principal_stretch")));
    assert!((fastest..fastest * 1.1).contains(&number("reference_wave_speed")));
    // In the deformed body it is where F is greatest: c^2 = E/(2 rho0) (F^2 + 1).
    let deformed = (500.0_f64 * (1.4_f64.powi(2) + 1.0)).sqrt();
    assert!((deformed..deformed * 1.1).contains(&number("wave_speed")));
    let step = number("time_step_per_cell_size");
    assert!((1.0 / (fastest * 1.1)..=1.0 / fastest).contains(&step), "{step}");
}

#[test]
fn a_cut_is_refused_where_it_stands_and_elsewhere_with_the_same_text() {
    let folder = Folder::new();
    let text = include_str!("../../mms-codegen/tests/data/faults/atan2_cut_1d.toml");
    folder.write("cut.toml", text);
    let check = folder.mms("check cut.toml").exits(1);
    let message = "`atan2(X-L/2,-1)` is not analytic everywhere";
    check.complains("cut.toml:16:10").complains(message).complains("at X = 0.5");
    check.prints("LEAVE their analytic branch");
    let json = folder.mms("check cut.toml --json").exits(1).json();
    let certificate = &json["files"][0]["certificate"];
    assert_eq!((&certificate["analytic"], &certificate["finite"]), (&false.into(), &true.into()));
    folder.mms("eval cut.toml --at 0.3 --time 0").exits(2).complains(message);
    folder.mms("emit cut.toml --target c").exits(2).complains(message);
}

#[test]
fn what_a_precision_does_not_compute_is_told_and_refused_where_it_is_asked_for() {
    let folder = Folder::with_bar("bar.toml");
    folder.mms("check bar.toml").exits(0).prints("in f32 every quantity is finite, too\n");
    let stiff = folder.mms("check bar.toml --set young=1e39").exits(0);
    stiff.prints("in f32 every quantity is finite, too: ").prints("NOT, as computed");
    let json = folder.mms("check bar.toml --set young=1e39 --json").exits(0).json();
    let certificate = &json["files"][0]["certificate"];
    assert_eq!((&certificate["finite_f32"], &certificate["finite"]), (&false.into(), &true.into()));
    let run = folder.mms("run bar.toml --cells 4 --set young=1e39 --precision f32").exits(2);
    run.complains("but not as f32 computes it").complains("--precision f64");
    let text = include_str!("../../mms-codegen/tests/data/faults/time_sine_nan.toml");
    folder.write("sine.toml", text);
    let check = folder.mms("check sine.toml").exits(1);
    check.complains("finite everywhere, but not as f64 computes it").complains("sin(1e17)");
    check.prints("every quantity is finite everywhere: displacement is NOT, as computed");
    folder.mms("emit sine.toml --target c").exits(2).complains("sin(1e17)");
}

#[test]
fn digits_that_a_sum_loses_are_told() {
    let wave = "[displacement]\nu = [\"0.01*sin(X + 30*t)\"]\n";
    let folder = Folder::new();
    let text = format!(
        "[field]\ntitle = \"x\"\ndimension = 1\n{wave}[material]\nmodel = \"neo_hookean\"\nlambda = 1\n\
         mu = 1\ndensity = 1\n[domain]\nshape = \"box\"\nlower = [0]\nupper = [1]\ntime = [0, 1]\n"
    );
    folder.write("near.toml", &text);
    folder.mms("check near.toml").exits(0).prints("angles are right to 14 digits after the point");
    let far = text.replace("[0, 1]\n", "[0, 1e13]\n");
    folder.write("late.toml", &far);
    folder.mms("check late.toml").exits(0).prints("angles are right to 14 digits after the point");
    folder.write("far.toml", &far.replace("0.01*sin(X + 30*t)", "1e-15*sin((X + 2)*t)"));
    let far = folder.mms("check far.toml").exits(0);
    far.prints("FEWER THAN SIX digits after the point: 1 near X = 1, t = 1e13");
    let json = folder.mms("check far.toml --json").exits(0).json();
    assert_eq!(json["files"][0]["certificate"]["angle_digits"], 1);
}

/// A product inside the speed exceeds the largest number.
#[test]
fn a_speed_without_a_bound_is_no_number() {
    let run = Folder::with_bar("bar.toml").mms("check bar.toml --set young=1e300").exits(0);
    run.prints("waves without a bound in double precision");
    run.prints("no time step is known to be stable");
}

#[test]
fn a_refuted_claim_exits_1_and_is_refused_elsewhere_with_the_same_text() {
    let folder = changed("x_max = \"free\"", "x_max = \"fixed\"");
    let run = folder.mms("check bar.toml").exits(1);
    run.prints("claim  x_max is fixed (u = 0): REFUTED").complains("`x_max` is no `fixed` face");
    let at = run.stderr.find(&format!("bar.toml:{}", place("\"free\""))).is_some();
    assert!(at, "{run}");
    let expected = run.stderr.trim_end().to_string();
    for command in ["show bar.toml", "eval bar.toml --at 1 --time 0"] {
        folder.mms(command).exits(2).complains(&expected).prints_nothing();
    }
    let claim = &folder.mms("check bar.toml --json").exits(1).json()["files"][0]["claims"][1];
    assert_eq!(claim["status"], "refuted");
    assert!(claim["at"][0] == 1.0 && claim["value"].is_number(), "{claim}");
}

#[test]
fn matter_that_is_turned_inside_out_exits_1() {
    let folder = changed("amplitude = { value = 0.2,", "amplitude = { value = 0.6,");
    let run = folder.mms("check bar.toml").exits(1);
    run.complains("J = det F is not positive").complains("J is ").prints("J > 0 is REFUTED");
    folder.mms("eval bar.toml --at 1 --time 0").exits(2).complains("J = det F is not positive");
}

#[test]
fn the_macro_refuses_a_file_with_the_same_text() {
    let package = Path::new(env!("CARGO_MANIFEST_DIR")).join("mms-macros");
    let mut count = 0;
    for entry in fs::read_dir(package.join("tests/ui/fail")).expect("a folder") {
        let input = entry.expect("an entry").path();
        if input.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let shown = input.strip_prefix(&package).expect("a file of the package");
        let check = Command::new(env!("CARGO_BIN_EXE_mms"))
            .args([Path::new("check"), shown])
            .current_dir(&package)
            .output()
            .expect("the program starts");
        assert_eq!(check.status.code(), Some(2), "{}", shown.display());
        let compiler = fs::read_to_string(input.with_extension("stderr")).expect("a .stderr file");
        // The compiler adds the place of the macro, and changes the indentation.
        let (message, _) = compiler.rsplit_once("\n --> ").expect("the place of the macro");
        let lines = |text: &str| -> Vec<String> {
            let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
            lines.map(str::to_string).collect()
        };
        let expected = String::from_utf8(check.stderr).expect("UTF-8");
        assert_eq!(lines(message), lines(&expected), "{}", shown.display());
        count += 1;
    }
    assert!(count >= 4, "{count} files");
}

#[test]
fn a_file_that_is_no_text_is_refused_where_it_is_none() {
    let folder = tempfile::tempdir().expect("a folder");
    let field = folder.path().join("odd.toml");
    fs::write(&field, b"[field]\n# na\xc3\xafve \xff\n").expect("a file");
    let check = Command::new(env!("CARGO_BIN_EXE_mms"))
        .args([Path::new("check"), &field])
        .output()
        .expect("the program starts");
    assert_eq!(check.status.code(), Some(2));
    let said = String::from_utf8(check.stderr).expect("UTF-8");
    assert!(said.contains("odd.toml:2:9: expected text in UTF-8"), "{said}");
}

/// A case of the compiler's tests.
fn fault(names: &[&str]) -> Folder {
    let faults = Path::new(env!("CARGO_MANIFEST_DIR")).join("mms-codegen/tests/data/faults");
    let folder = Folder::new();
    for name in names {
        folder.write(name, &fs::read_to_string(faults.join(name)).expect("a case"));
    }
    folder
}

#[test]
fn what_a_budget_left_is_said_and_no_pass() {
    let folder = fault(&["u_sinh.toml"]);
    let run = folder.mms("check u_sinh.toml").exits(1);
    run.prints("budget SPENT before the end of: ").prints("UNPROVED");
    let file = &folder.mms("check u_sinh.toml --json").exits(1).json()["files"][0];
    assert!(!file["budget_spent"].as_array().expect("a list").is_empty(), "{file}");
    let file = &Folder::with_bar("bar.toml").mms("check bar.toml --json").exits(0).json();
    let file = &file["files"][0];
    assert_eq!(file["budget_spent"].as_array().map(Vec::len), Some(0), "{file}");
    assert_eq!(file["simplified"], true, "{file}");
}

#[test]
fn an_extreme_is_held_to_what_defaults_are_held_to() {
    let folder = fault(&["extreme_bad_set.toml"]);
    let run = folder.mms("check extreme_bad_set.toml").exits(2);
    run.complains("the extreme `a` is no state of this field: the box is empty along X");
    run.complains("extreme_bad_set.toml:33:6");
}

#[test]
fn a_stress_at_rest_is_a_warning_of_check_and_show() {
    let folder = fault(&["stressed_field.toml", "stressed.toml"]);
    let run = folder.mms("check stressed_field.toml").exits(0);
    run.complains("warning: stress at rest").complains("stressed.toml:4:").prints("stress at rest");
    let document = folder.mms("check stressed_field.toml --json").exits(0).json();
    let expected = serde_json::json!([3e5, 0.0, 0.0, 3e5]);
    assert_eq!(document["files"][0]["rest_stress"], expected);
    folder.mms("show stressed_field.toml --quantity J").exits(0).complains("stress at rest");
    let document = folder.mms("show stressed_field.toml --quantity J --json").exits(0).json();
    assert_eq!(document["rest_stress"], expected);
    let bar = Folder::with_bar("bar.toml");
    let file = &bar.mms("check bar.toml --json").exits(0).json()["files"][0];
    assert!(file["rest_stress"].is_null(), "{file}");
    assert_eq!(bar.mms("show bar.toml --quantity J").exits(0).stderr, "");
}
