//! Whether a field is fit for verification, as `mms check` and `mms show` report it; and windows that are moved.

use serde_json::Value;

use super::mms::Folder;

/// A square of lambda = 1.5 and mu = 1, with this u and these claims.
fn square(u: &str, boundary: &str) -> Folder {
    let folder = Folder::new();
    let text = format!(
        r#"
[field]
title = "square"
dimension = 2
[displacement]
u = {u}
[material]
model = "neo_hookean"
lambda = 1.5
mu = 1
density = 1
[domain]
shape = "box"
lower = [0, 0]
upper = [1, 1]
time = [0, 1]
[boundary]
{boundary}
"#
    );
    folder.write("square.toml", &text);
    folder
}

fn stability(folder: &Folder, arguments: &str) -> Value {
    let run = folder.mms(&format!("check square.toml {arguments} --json")).exits(0);
    run.json()["files"][0]["stability"].clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is a number"))
}

/// At rest the impedance of a free face is 2 mu (lambda + mu)/(lambda + 3 mu), and nothing grows.
#[test]
fn a_body_at_rest_is_stable() {
    let folder = square(r#"["0", "0"]"#, "x_min = \"fixed\"\ny_max = \"free\"");
    let found = stability(&folder, "");
    assert!((number(&found["least_acoustic_eigenvalue"]) - 1.0).abs() < 1e-9, "{found}");
    assert!((number(&found["faces"][0]["least_impedance"]) - 5.0 / 4.5).abs() < 1e-7, "{found}");
    assert_eq!(found["faces"][0]["face"], "y_max");
    assert_eq!(found["growth"], 1.0);
    assert_eq!(found["warnings"], serde_json::json!([]));
    let moduli = &folder.mms("show square.toml --json").exits(0).json()["moduli_at_rest"];
    assert!((number(&moduli["nu"]) - 0.3).abs() < 1e-12, "{moduli}");
    assert!((number(&moduli["young"]) - 2.6).abs() < 1e-12, "{moduli}");
}

/// A square that dead loads compress to half its width: growing modes cause a warning, and the file still passes.
#[test]
fn what_grows_is_a_warning_with_its_place() {
    let folder = square(
        r#"["-0.55*t*X", "0.2*t*Y"]"#,
        "x_min = \"roller\"\nx_max = \"traction\"\ny_min = \"traction\"\ny_max = \"traction\"",
    );
    let run = folder.mms("check square.toml").exits(0);
    run.complains("warning: short waves may grow on the loaded face y_max").complains("t = 1");
    run.complains("a disturbance of this motion grows").prints("proof  J > 0");
    let found = stability(&folder, "");
    assert!(number(&found["growth"]) > 10.0, "{found}");
    assert!(found["warnings"].as_array().expect("a list").len() >= 2, "{found}");
    // Before that time nothing grows.
    let found = stability(&folder, "--window 0,0.05");
    assert_eq!(found["warnings"], serde_json::json!([]), "{found}");
}

/// Dead pressure on two faces: each face alone is stable, and their corner is not.
#[test]
fn a_corner_that_grows_is_a_warning() {
    let folder = square(r#"["-0.1*X", "-0.1*Y"]"#, "x_max = \"traction\"\ny_max = \"traction\"");
    let run = folder.mms("check square.toml").exits(0);
    run.complains("warning: a disturbance of the corner of x_max and y_max grows")
        .complains("X = [1, 1]");
    run.prints("  corner x_max, y_max: coercivity -0.19");
    let found = stability(&folder, "");
    assert!(number(&found["faces"][0]["least_impedance"]) > 0.5, "{found}");
    assert_eq!(found["corners"][0]["faces"], serde_json::json!(["x_max", "y_max"]));
}

/// Saint Venant-Kirchhoff material that is compressed along X: Q = (N.S N) I + (lambda + mu) F N (F N)^T + mu F F^T with
/// S = lambda tr(E) I + 2 mu E. In the named direction the determinant of Q is not positive.
#[test]
fn where_ellipticity_is_lost_is_proved_and_named() {
    let folder = square(r#"["-0.5*t*X", "0"]"#, "");
    let text = folder.read("square.toml").replace("neo_hookean", "saint_venant_kirchhoff");
    folder.write("square.toml", &text);
    let run = folder.mms("check square.toml").exits(0);
    run.prints("acoustic tensors are positive definite: REFUTED at X = [");
    run.complains("warning: strong ellipticity is lost");
    let files = folder.mms("check square.toml --json").exits(0).json();
    let certificate = &files["files"][0]["certificate"];
    assert_eq!(certificate["strongly_elliptic"], false);
    let lost = &certificate["ellipticity_lost"];
    let [time, n1, n2] = [&lost["time"], &lost["direction"][0], &lost["direction"][1]].map(number);
    let (lambda, mu, stretch) = (1.5, 1.0, 1.0 - 0.5 * time);
    let strain = (stretch * stretch - 1.0) / 2.0;
    let pull = strain * ((lambda + 2.0 * mu) * n1 * n1 + lambda * n2 * n2);
    let first = pull + (lambda + mu) * (stretch * n1).powi(2) + mu * stretch * stretch;
    let second = pull + (lambda + mu) * n2 * n2 + mu;
    let mixed = (lambda + mu) * stretch * n1 * n2;
    assert!(first * second - mixed * mixed <= 1e-12 && first + second > 0.0, "{lost}");
}

/// E + 4 r along fibres with the energy r (I4 - 1)^2/2.
#[test]
fn fibres_have_moduli_at_rest() {
    let folder = square(r#"["0", "0"]"#, "");
    let fibres = "transversely_isotropic\"\nfibre = [0, 1, 0]\nreinforcement = 0.5";
    let text = folder.read("square.toml").replace("neo_hookean\"", fibres);
    folder.write("square.toml", &text);
    let shown = folder.mms("show square.toml --json").exits(0).json();
    assert_eq!(shown["moduli_at_rest"], Value::Null);
    let moduli = &shown["transverse_moduli_at_rest"];
    assert_eq!(moduli["axis"], serde_json::json!([0.0, 1.0, 0.0]));
    assert!((number(&moduli["young"][0]) - 4.6).abs() < 1e-9, "{moduli}");
    folder
        .mms("check square.toml")
        .exits(0)
        .prints("  rest   E = [4.6, ")
        .prints("along [0, 1, 0]");
}

/// x = X + A sin(2 pi X) does not reach beyond the body, and its wavelength is 1.
#[test]
fn extent_and_wavelength_are_those_of_the_motion() {
    let folder = square(r#"["0.05*sin(2*pi*X)*t", "0.25*t"]"#, "");
    let files = folder.mms("check square.toml --json").exits(0).json();
    let file = &files["files"][0];
    let [x, y] = [0, 1].map(|axis| [0, 1].map(|end| number(&file["extent"][axis][end])));
    assert!(x[0] <= 0.0 && x[0] > -0.02 && x[1] >= 1.0 && x[1] < 1.02, "{x:?}");
    assert!(y[0] <= 0.0 && y[0] > -0.02 && y[1] >= 1.25 && y[1] < 1.27, "{y:?}");
    assert!((number(&file["shortest_wavelength"]) - 1.0).abs() < 0.02, "{file}");
}

#[test]
fn newton_is_run_where_that_is_asked_for() {
    let folder = square(r#"["0.03*sin(2*X)*Y", "0.02*X*Y"]"#, "x_min = \"traction\"");
    folder
        .mms("check square.toml --solve")
        .exits(0)
        .prints("converges to the exact state from zero");
    assert_eq!(stability(&folder, "")["solve"], Value::Null);
    assert_eq!(stability(&folder, "--solve")["solve"], "comes");
}

/// A given window applies to all commands, and to emitted code.
#[test]
fn windows_can_be_moved() {
    let folder = Folder::with_bar("bar.toml");
    folder
        .mms("emit bar.toml --target python --window 0,length/c")
        .exits(0)
        .prints("0 to length/c");
    folder.mms("eval bar.toml --at 0.5 --time 0.03 --window 0,0.02").complains("outside");
    folder.mms("check bar.toml --window 0,0.02").exits(0);
    folder.mms("check bar.toml --window 0.02,0").exits(2).complains("the time window is empty");
    folder.mms("check bar.toml --window 1").exits(2).complains("the first and the last time");
    folder.mms("check bar.toml --window 0,young").exits(2).complains("must be times");
}

#[test]
fn lists_say_how_fields_start() {
    let folder = Folder::with_bar("bar.toml");
    let fields = folder.mms("list --json").exits(0).json();
    let starts = |name: &str| {
        let fields = fields["fields"].as_array().expect("a list");
        let field = fields.iter().find(|it| it["name"] == name).expect("a field");
        field["starts"].as_str().expect("a text").to_string()
    };
    assert_eq!(starts("bar_1d"), "deformed, at rest");
    assert_eq!(starts("axis_aligned_2d"), "deformed, moving");
    folder.mms("new start --dimension 2 --undeformed").exits(0);
    folder.mms("check start.toml").exits(0).prints("proof  J > 0");
}
