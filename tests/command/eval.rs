//! `mms eval`: the numbers, their printed form, and refusals.

use mms_bar::bar_1d;
use serde_json::{Value, json};

use super::mms::{BAR, Folder, assert_close, keys, numbers};

const IDENTIFIERS: [&str; 22] = [
    "at",
    "displacement",
    "position",
    "velocity",
    "acceleration",
    "displacement_gradient",
    "deformation_gradient",
    "jacobian",
    "right_cauchy_green",
    "left_cauchy_green",
    "green_lagrange",
    "mass_density",
    "strain_energy",
    "first_piola_kirchhoff",
    "nominal_stress",
    "cauchy_stress",
    "kirchhoff_stress",
    "div_p",
    "div_sigma",
    "body_force",
    "body_force_density",
    "current_body_force_density",
];

/// The document of one evaluation of the gallery's bar.
fn document(arguments: &str) -> Value {
    Folder::new().mms(&format!("eval bar_1d --json {arguments}")).exits(0).json()
}

/// The first component of a quantity at the first point.
fn value(arguments: &str, quantity: &str) -> f64 {
    numbers(&document(arguments)["points"][0][quantity])[0]
}

/// The lines of a printed document that are a number.
fn literals(text: &str) -> Vec<&str> {
    let lines = text.lines().map(str::trim);
    lines.filter(|line| line.parse::<f64>().is_ok()).collect()
}

#[test]
fn the_document_has_the_promised_shape() {
    let field = bar_1d::prepare(&bar_1d::Parameters::<f64>::default());
    let expected = json!({
        "field": "bar_1d",
        "time": 0.013,
        "precision": "f64",
        "form": "stable",
        "points": [{ "at": [0.37], "body_force": field.at_time(0.013).body_force([0.37]) }],
    });
    assert_eq!(document("--at 0.37 --time 0.013 --quantity body_force"), expected);
}

/// From b = A'' X (2L - X)/L^2 + E A (1 + F^-2)/(rho0 L^2), by hand.
#[test]
fn body_force_is_that_of_the_slides_with_the_right_sign() {
    let (x, t, a, rate) = (0.37, 0.013, 0.2, 1e3_f64.sqrt() * std::f64::consts::PI);
    let end = a * (rate * t).cos();
    let f = 1.0 + 2.0 * (1.0 - x) * end;
    let expected = -rate * rate * end * x * (2.0 - x) + 1e3 * (1.0 + f.powi(-2)) * end;
    let found = value("--at 0.37 --time 0.013 --quantity body_force", "body_force");
    assert_close(found, expected, 1e-13);
}

#[test]
fn points_keep_their_order_and_may_be_negative() {
    let document = document("--at 0.37 --at=-0.3 --at 0.5 --at -0.25 --time -0.001 --quantity u");
    let at: Vec<_> = document["points"].as_array().expect("points").iter().collect();
    let at: Vec<_> = at.into_iter().map(|point| numbers(&point["at"])[0]).collect();
    assert_eq!(at, [0.37, -0.3, 0.5, -0.25]);
    assert_eq!(document["time"], json!(-0.001));
}

#[test]
fn all_quantities_leave_out_traction() {
    let given = document("--at 0.37 --time 0.013 --quantity all");
    assert_eq!(keys(&given["points"][0]), IDENTIFIERS);
    assert_eq!(document("--at 0.37 --time 0.013"), given);
}

#[test]
fn short_names_are_answered_with_identifiers() {
    let given = document("--at 0.37 --time 0.013 --quantity u,v,a,H,F,J,P,sigma,div_p,b,W");
    let expected = [
        "at",
        "displacement",
        "velocity",
        "acceleration",
        "displacement_gradient",
        "deformation_gradient",
        "jacobian",
        "first_piola_kirchhoff",
        "cauchy_stress",
        "div_p",
        "body_force",
        "strain_energy",
    ];
    assert_eq!(keys(&given["points"][0]), expected);
    let full = document("--at 0.37 --time 0.013");
    for key in expected {
        assert_eq!(given["points"][0][key], full["points"][0][key], "{key}");
    }
}

#[test]
fn double_precision_has_the_shortest_digits_that_read_back() {
    let run = Folder::new().mms("eval bar_1d --at 0.37 --time 0.013 --json").exits(0);
    let printed = literals(&run.stdout);
    assert_eq!(printed.len(), IDENTIFIERS.len());
    for literal in printed {
        let number: f64 = literal.parse().expect("a number");
        assert_eq!(literal, format!("{number:?}"));
    }
    let field = bar_1d::prepare(&bar_1d::Parameters::<f64>::default());
    let expected = field.at_time(0.013).strain_energy([0.37]);
    assert_eq!(numbers(&run.json()["points"][0]["strain_energy"]), [expected]);
}

/// With twice the digits, u = X (2 L - X) A cos(sqrt(E/rho0) pi t / L) / L^2 at the decimals that were typed. By mpmath:
/// 0.37*1.63*0.2*cos(sqrt(1000)*pi*0.013) with 40 digits.
#[test]
fn twice_the_digits_are_asked_for_by_name() {
    let run = Folder::new()
        .mms("eval bar_1d --at 0.37 --time 0.013 --quantity u --precision wide --json")
        .exits(0);
    let [at, displacement] = literals(&run.stdout)[..] else { panic!("two numbers") };
    assert_eq!(at, "3.7e-1");
    assert!(displacement.starts_with("3.325284728272693776125122018595"), "{displacement}");
}

#[test]
fn single_precision_has_the_shortest_digits_that_read_back() {
    let run =
        Folder::new().mms("eval bar_1d --at 0.37 --time 0.013 --precision f32 --json").exits(0);
    let printed = literals(&run.stdout);
    assert_eq!(printed.len(), IDENTIFIERS.len());
    for literal in printed {
        let number: f32 = literal.parse().expect("a number");
        assert_eq!(literal, format!("{number:?}"));
    }
    let field = bar_1d::prepare(&bar_1d::Parameters::<f32>::default());
    let expected = field.at_time(0.013).strain_energy([0.37]);
    let printed = &run.json()["points"][0]["strain_energy"];
    assert_eq!(printed[0].to_string().parse(), Ok(expected));
}

#[test]
fn a_setting_replaces_a_parameter() {
    // At t = 0, F = 1.4 at the fixed end, and P = E/2 (F - 1/F).
    let stress = |young: &str| {
        let arguments = format!("--at 0 --time 0 --quantity P --set young={young}");
        value(&arguments, "first_piola_kirchhoff")
    };
    let expected = (1.4 - 1.0 / 1.4) / 2.0;
    assert_close(stress("1"), expected, 1e-15);
    assert_close(stress("2/3"), expected * 2.0 / 3.0, 1e-15);
    assert_eq!(stress("1e6"), value("--at 0 --time 0 --quantity P", "first_piola_kirchhoff"));
}

#[test]
fn parameters_follow_those_they_depend_on() {
    let folder = Folder::new();
    let derived = "amplitude = { value = \"length/5\", ";
    folder.write("derived.toml", &BAR.replace("amplitude = { value = 0.2, ", derived));
    let displacement = |settings: &str| {
        let command = format!("eval derived.toml --json --at 1 --time 0 --quantity u {settings}");
        numbers(&folder.mms(&command).exits(0).json()["points"][0]["displacement"])[0]
    };
    // u = X (2L - X)/L^2 A.
    assert_close(displacement(""), 0.2, 1e-15);
    assert_close(displacement("--set length=2"), 0.75 * 0.4, 1e-15);
    assert_close(displacement("--set length=2 --set amplitude=1"), 0.75, 1e-15);
}

/// A single quantity is derived alone, and has the same bits as beside all others.
#[test]
fn a_quantity_alone_is_what_it_is_among_all() {
    let evaluate = |quantity: &str| {
        let at = "eval quiet_boundary_2d --at 0.3,0.6 --at 0.41,0.47 --time 0.02";
        Folder::new().mms(&format!("{at} --json --quantity {quantity}")).exits(0).json()
    };
    let all = evaluate("all");
    for quantity in ["displacement", "body_force", "cauchy_stress", "strain_energy", "jacobian"] {
        let alone = evaluate(quantity);
        for point in 0..2 {
            let [one, among] = [&alone, &all].map(|it| &it["points"][point][quantity]);
            assert!(one.is_array() && one == among, "{quantity}: {one} {among}");
        }
    }
}

#[test]
fn a_file_outside_the_gallery_gives_identical_numbers() {
    let folder = Folder::with_bar("deeper/copy.toml");
    for options in ["", "--precision f32", "--set young=7 --set length=1.5"] {
        let evaluate = |field: &str| {
            let points = "--at 0.37 --at 0.9 --time 0.013";
            folder.mms(&format!("eval {field} {points} {options} --json")).exits(0).json()
        };
        let (named, copied) = (evaluate("bar_1d"), evaluate("deeper/copy.toml"));
        assert_eq!(copied["field"], "copy");
        assert_eq!(copied["points"], named["points"], "{options}");
    }
}

#[test]
fn the_text_shows_the_numbers_of_the_document() {
    let text = Folder::new().mms("eval bar_1d --at 0.37 --time 0.013").exits(0).stdout;
    let point = &document("--at 0.37 --time 0.013")["points"][0];
    for (line, key) in text.lines().zip(IDENTIFIERS) {
        let words: Vec<_> = line.split_whitespace().collect();
        assert_eq!(words, [key, &point[key][0].to_string()]);
    }
    assert_eq!(text.lines().count(), IDENTIFIERS.len());
}

#[test]
fn traction_needs_the_normal_of_a_boundary() {
    let folder = Folder::new();
    let refused = folder.mms("eval bar_1d --at 0 --time 0 --quantity traction").exits(2);
    refused.complains("give --face or --normal").prints_nothing();
    let along = |normal: &str| {
        value(&format!("--at 0 --time 0 --quantity traction --normal {normal}"), "traction")
    };
    let stress = value("--at 0 --time 0 --quantity P", "first_piola_kirchhoff");
    assert_eq!([along("1"), along("-1")], [stress, -stress]);
    // No other quantity takes a face.
    for option in ["--face x_max", "--normal 1", "--face x_max --quantity u,P"] {
        self::refused(
            &format!("bar_1d --at 0 --time 0 {option}"),
            "only tractions and normal fluxes take a normal",
        );
    }
}

/// Asserts that an evaluation with these arguments is refused with a message, and prints nothing.
fn refused(arguments: &str, message: &str) {
    let run = Folder::new().mms(&format!("eval {arguments}")).exits(2);
    run.complains(message).prints_nothing();
}

#[test]
fn points_and_times_that_are_no_numbers_are_refused() {
    for text in ["nan", "inf", "-inf", "1e400"] {
        refused(&format!("bar_1d --time 0 --at={text}"), "is not a finite number");
        refused(&format!("bar_1d --at 1 --time={text}"), "expected a finite number");
    }
    for text in ["abc", "1..2", "0x1", "1;2", ","] {
        refused(&format!("bar_1d --time 0 --at={text}"), "is not a number");
        refused(&format!("bar_1d --at 1 --time={text}"), "invalid float literal");
    }
    refused("bar_1d --precision f32 --time 0 --at 1e39", "is not a finite number");
}

#[test]
fn the_wrong_dimension_is_refused() {
    let message = "expected 1 component(s) for a field of dimension 1, found 2";
    refused("bar_1d --time 0 --at 1,2", message);
    refused("bar_1d --time 0 --at 1 --quantity traction --normal 1,0", message);
}

#[test]
fn unknown_names_are_refused_with_a_suggestion() {
    refused("bar_1d --at 1 --time 0 --quantity body_forc", "did you mean `body_force`?");
    refused("bar_1d --at 1 --time 0 --quantity u,jacobain", "did you mean `jacobian`?");
    refused("bar_1d --at 1 --time 0 --set yuong=1", "did you mean `young`?");
    refused("bar_2d --at 1 --time 0", "did you mean `bar_1d`?");
    refused("bar_1d --at 1 --time 0 --quantity zzz", "the quantities are displacement, position");
    refused("bar_1d --at 1 --time 0 --set zzz=1", "the field has length, young, rho0, amplitude");
    refused("zzz --at 1 --time 0", "a file of your own is given by its path, ending in .toml");
}

#[test]
fn settings_that_set_nothing_are_refused() {
    for value in ["abc", "nan", "inf", "", "1/0", "sqrt(2)"] {
        refused(&format!("bar_1d --at 1 --time 0 --set young={value}"), "not a number");
    }
    refused("bar_1d --at 1 --time 0 --set young", "expected name=value");
    refused("bar_1d --at 1 --time 0 --set young=1 --set young=2", "`young` is set twice");
}

#[test]
fn a_value_that_is_not_defined_is_refused_by_name_and_place() {
    // The bar is inverted at its fixed end: F = 1 - 1.2.
    let arguments = "bar_1d --at 1 --at 0 --time 0 --set amplitude=-0.6 --quantity u,W --json";
    refused(arguments, "strain_energy of `bar_1d` is NaN at X = 0, t = 0");
}

#[test]
fn a_missing_file_is_refused() {
    refused("absent.toml --at 1 --time 0", "cannot read `absent.toml`");
}

#[test]
fn incomplete_command_lines_are_refused() {
    refused("bar_1d --time 0", "--at <X,Y>");
    refused("bar_1d --at 1", "give the time with `--time T`");
    refused("--at 1 --time 0", "<FIELD>");
    refused("bar_1d --at 1 --time 0 --precision f16", "[possible values: f32, f64, wide]");
}

/// The bar with a range for its amplitude, which depends on a parameter above it.
fn bar_with_range() -> Folder {
    let folder = Folder::new();
    let plain = "amplitude = { value = 0.2,";
    assert!(BAR.contains(plain), "the bar's amplitude has changed");
    let with_range = format!("{plain} range = [0, \"length/4\"],");
    folder.write("bar.toml", &BAR.replace(plain, &with_range));
    folder
}

#[test]
fn a_value_outside_its_range_is_refused_with_the_range() {
    let folder = bar_with_range();
    folder.mms("eval bar.toml --at 0.3 --time 0 --set amplitude=0.25").exits(0);
    for command in ["eval bar.toml --at 0.3 --time 0", "study bar.toml --cells 8,16"] {
        let run = folder.mms(&format!("{command} --set amplitude=0.26")).exits(2);
        run.complains("`--set amplitude=0.26`").complains("`amplitude` is 0.26, outside its range");
        run.complains("bar.toml:10:37").complains("expected 0 to 0.25");
    }
    // The range changes with the parameters that it depends on.
    folder.mms("eval bar.toml --at 0.3 --time 0 --set amplitude=0.26 --set length=2").exits(0);
    let run = folder.mms("eval bar.toml --at 0.3 --time 0 --set length=0.5").exits(2);
    run.complains("`amplitude` is 0.2, outside its range").complains("expected 0 to 0.125");
}

#[test]
fn settings_that_leave_no_body_no_time_or_no_mass_are_refused() {
    let folder = Folder::new();
    for (setting, complaint) in [
        ("length=0", "the box is empty along X"),
        ("length=-1", "the time window is empty"),
        ("young=-1", "this bound is not a real number"),
        ("young=-1", "this material is unstable at F = I"),
        ("young=0", "this material has no stiffness at F = I"),
        ("rho0=-5", "this is -5"),
    ] {
        for command in ["eval bar_1d --at 0.3 --time 0", "study bar_1d --cells 8,16"] {
            let run = folder.mms(&format!("{command} --set {setting}")).exits(2);
            run.complains(&format!("`--set {setting}`")).complains(complaint);
            run.complains("fields/bar_1d.toml:");
        }
    }
}

#[test]
fn points_outside_body_and_window_are_evaluated_with_a_warning() {
    let folder = Folder::new();
    let inside = folder.mms("eval bar_1d --at 0 --at 1 --time 0 --quantity u --json").exits(0);
    assert_eq!(inside.stderr, "");
    let document = inside.json();
    assert!(document.get("outside_body").is_none() && document.get("outside_time").is_none());
    let command = "eval bar_1d --at 0.5 --at 1.5 --at -0.1 --time 1e3 --quantity u";
    let run = folder.mms(command).exits(0);
    run.complains("`--at 1.5` is outside the body").complains("`--at -0.1` is outside the body");
    run.complains("`--time 1e3` is outside the time window");
    let document = folder.mms(&format!("{command} --json")).exits(0).json();
    assert_eq!(document["outside_body"], serde_json::json!([1, 2]));
    assert_eq!(document["outside_time"], true);
    // Points of a sector are found at any turn of their angle.
    let sector = "eval conformal_sector_2d --time 0.01 --quantity u";
    assert_eq!(folder.mms(&format!("{sector} --at 0.5,0.5")).exits(0).stderr, "");
    folder.mms(&format!("{sector} --at -0.5,0.5")).exits(0).complains("is outside the body");
}

/// Moduli that follow a power law of the radius with a parameter as its exponent. b was derived with SymPy and mpmath.
#[test]
fn a_power_of_the_radius_may_have_a_parameter_as_exponent() {
    let folder = Folder::new();
    let text = r#"[field]
title     = "Power-law graded ring"
dimension = 2
[parameters]
E0   = { value = 1e6 }
beta = { value = 1.7, range = [1, 2] }
nu   = { value = 0.3 }
rho0 = { value = 1000 }
ri   = { value = 1 }
ro   = { value = 2 }
amp  = { value = 0.02 }
[let]
R = "sqrt(X^2 + Y^2)"
[displacement]
u = ["amp*X*sin(30*t)", "amp*Y*sin(30*t)"]
[material]
model = "linear_elastic"
young = "E0*(R/ri)^beta"
nu = "nu"
density = "rho0"
[domain]
shape = "annulus"
inner = "ri"
outer = "ro"
time  = [0, 0.1]
[boundary]
inner = "prescribed"
outer = "prescribed"
"#;
    folder.write("ring.toml", text);
    let run = folder.mms("eval ring.toml --at 1.3,0.4 --time 0.02 --quantity b --json").exits(0);
    let b = numbers(&run.json()["points"][0]["body_force"]);
    let right = [-56.97660369906452, -17.531262676635236];
    assert!(b.iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-14 * b.abs()), "{b:?}");
    folder.mms("check ring.toml").exits(0).prints("every quantity is finite everywhere");
    // The base vanishes on the inner side.
    folder.write("ring.toml", &text.replace("(R/ri)^beta", "(R - ri)^beta"));
    let run = folder.mms("check ring.toml");
    assert_ne!(run.code, 0, "{run}");
}
