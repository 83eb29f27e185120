//! S, pressure and von Mises stress, which are derived on request: compared with the nine components of sigma of the same
//! motion in three dimensions, and with F S = P.

use serde_json::Value;

use super::mms::{Folder, numbers};

/// Materials, one with fibres that leave the plane, and one of the small strain.
const MATERIALS: [&str; 4] = [
    "model = \"neo_hookean\"\nlambda = 3\nmu = 2",
    "model = \"mooney_rivlin\"\nc1 = 0.7\nc2 = 0.3\nc3 = 3",
    "model = \"transversely_isotropic\"\nyoung = 5\nnu = 0.3\nreinforcement = 4\nfibre = [\"2/3\", \"1/3\", \"2/3\"]",
    "model = \"linear_elastic\"\nlambda = 3\nmu = 2",
];

/// A motion of `dimension` dimensions that does not depend on the others.
fn field(dimension: usize, material: &str) -> String {
    let u = ["0.2*X*Y*t", "0.1*(X^2 - Y)*t", "0"];
    let u = if dimension == 1 { &["0.2*X^2*t"][..] } else { &u[..dimension] };
    let list = |of: &str| vec![of; dimension].join(", ");
    format!(
        "[field]\ntitle = \"field\"\ndimension = {dimension}\n[displacement]\nu = {u:?}\n[material]\n{material}\n\
         density = 1\n[domain]\nshape = \"box\"\nlower = [{}]\nupper = [{}]\ntime = [0, 1]\n",
        list("0"),
        list("1")
    )
}

fn point(document: &Value) -> &Value {
    &document["points"][0]
}

#[test]
fn the_stress_out_of_the_plane_is_in_them() {
    for material in MATERIALS {
        let folder = Folder::new();
        folder.write("plane.toml", &field(2, material));
        folder.write("space.toml", &field(3, material));
        let eval = |name: &str, at: &str, rest: &str| {
            let command = format!("eval {name} --at {at} --time 0.7 --json {rest}");
            folder.mms(&command).exits(0).json()
        };
        let space = eval("space.toml", "0.4,0.8,0.3", "--quantity sigma");
        let s = numbers(&point(&space)["cauchy_stress"]);
        let pressure = -(s[0] + s[4] + s[8]) / 3.0;
        let deviator = |at: usize| s[at] + if at.is_multiple_of(4) { pressure } else { 0.0 };
        let squares: f64 = (0..9).map(|at| deviator(at).powi(2)).sum();
        let von_mises = (1.5 * squares).sqrt();
        for more in ["", "--rigid"] {
            // Small strains change with a rotation, so that such a field takes none.
            if !more.is_empty() && material.contains("linear") {
                continue;
            }
            let rest = format!("--quantity p,von_mises,S,PK1,F {more}");
            let plane = eval("plane.toml", "0.4,0.8", &rest);
            let of = |name: &str| numbers(&point(&plane)[name]);
            let near = |found: f64, expected: f64| {
                assert!((found - expected).abs() < 1e-13, "{material} {more}: {found} {expected}");
            };
            near(of("pressure")[0], pressure);
            near(of("von_mises")[0], von_mises);
            let [f, s, p] =
                ["deformation_gradient", "second_piola_kirchhoff", "first_piola_kirchhoff"].map(of);
            // At small strain S is P.
            let f = if material.contains("linear") { vec![1.0, 0.0, 0.0, 1.0] } else { f };
            for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let product = f[2 * row] * s[column] + f[2 * row + 1] * s[2 + column];
                near(product, p[2 * row + column]);
            }
        }
    }
}

/// In one dimension the lateral stresses of W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2 are lambda ln J / J.
#[test]
fn a_bar_is_strained_in_one_direction() {
    let folder = Folder::new();
    folder.write("bar.toml", &field(1, MATERIALS[0]));
    let run = folder.mms("eval bar.toml --at 0.5 --time 1 --quantity pressure,von_mises --json");
    let document = run.exits(0).json();
    let j: f64 = 1.2;
    let lateral = 3.0 * j.ln() / j;
    let axial = (3.0 * j.ln() + 2.0 * (j * j - 1.0)) / j;
    let near = |name: &str, expected: f64| {
        let found = numbers(&point(&document)[name])[0];
        assert!((found - expected).abs() < 1e-14, "{name}: {found} {expected}");
    };
    near("pressure", -(axial + 2.0 * lateral) / 3.0);
    near("von_mises", axial - lateral);
}

#[test]
fn at_rest_they_are_0_and_not_undefined() {
    let folder = Folder::new();
    folder.write("plane.toml", &field(2, MATERIALS[0]));
    let run = folder.mms("eval plane.toml --at 0.5,0.5 --time 0 --quantity S,p,von_mises --json");
    let document = run.exits(0).json();
    for name in ["second_piola_kirchhoff", "pressure", "von_mises"] {
        assert!(numbers(&point(&document)[name]).iter().all(|it| *it == 0.0), "{name}");
    }
}

#[test]
fn they_are_not_compiled() {
    let folder = Folder::new();
    let refused = |command: &str, name: &str| {
        let said = format!("the quantity `{name}` is not compiled");
        folder.mms(command).exits(2).complains(&said).complains("derive it from cauchy_stress");
    };
    refused("emit bar_1d --quantity PK2 --target c", "second_piola_kirchhoff");
    refused("show bar_1d --quantity von_mises", "von_mises");
    refused("accuracy bar_1d --quantity p", "pressure");
    let document = folder.mms("eval bar_1d --at 0.5 --time 0 --json").exits(0).json();
    assert_eq!(point(&document)["pressure"], Value::Null);
}

/// A result scaled by 1.001 has an error of 0.001 times the exact one.
#[test]
fn they_are_judged() {
    let folder = Folder::new();
    let state = "state axis_aligned_2d --cells 4 --time 0.02 -o state.csv --quantity S,p,von_mises";
    folder.mms(state).exits(0);
    let text = folder.read("state.csv");
    let mut lines = text.lines();
    let header = lines.next().expect("a header");
    let at = header.split(',').position(|it| it == "p").expect("the pressure");
    let (mut changed, mut squares, mut count) = (format!("{header}\n"), 0.0, 0.0);
    for line in lines {
        let mut words: Vec<String> = line.split(',').map(str::to_owned).collect();
        let p: f64 = words[at].parse().expect("a number");
        (squares, count) = (squares + p * p, count + 1.0);
        words[at] = format!("{:?}", p * 1.001);
        changed += &(words.join(",") + "\n");
    }
    folder.write("changed.csv", &changed);
    let document = folder.mms(
        "judge axis_aligned_2d changed.csv --map PK2=S_xx,S_xy,S_yx,S_yy --expected-order PK2=1 --json",
    );
    let document = document.exits(1).json();
    let error = |name: &str| -> f64 {
        let quantities = document["quantities"].as_array().expect("quantities");
        let found = quantities.iter().find(|it| it["name"] == name).expect("the quantity");
        found["norms"][1]["levels"][0]["error"].as_f64().expect("an error")
    };
    let expected = 1e-3 * f64::sqrt(squares / count);
    assert!((error("pressure") / expected - 1.0).abs() < 1e-9, "{}", error("pressure"));
    assert_eq!([error("von_mises"), error("second_piola_kirchhoff")], [0.0; 2]);
}
