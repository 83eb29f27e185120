//! A material of small strain has one stress and one configuration in the output of every command.

use super::mms::{Folder, numbers};

const FIELD: &str = "plane_strain_linear_elastic";

/// lambda and mu of the field.
fn moduli() -> [f64; 2] {
    let (young, nu) = (1e6, 0.3);
    [young * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), young / (2.0 * (1.0 + nu))]
}

/// lambda tr eps I + 2 mu eps of H, with the stress out of the plane.
fn stress(h: &[f64]) -> [f64; 5] {
    let [lambda, mu] = moduli();
    let pressure = lambda * (h[0] + h[3]);
    let shear = mu * (h[1] + h[2]);
    [pressure + 2.0 * mu * h[0], shear, shear, pressure + 2.0 * mu * h[3], pressure]
}

fn near(what: &str, found: &[f64], expected: &[f64], scale: f64) {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-12 * scale;
    let fits = found.len() == expected.len() && found.iter().zip(expected).all(is_near);
    assert!(fits, "{what}: {found:?} and {expected:?}");
}

#[test]
fn every_measure_is_one_stress() {
    let folder = Folder::new();
    let names = ["P", "nominal_stress", "sigma", "kirchhoff_stress", "S"];
    let asked = format!(
        "eval {FIELD} --at 0.3,0.4 --time 0.01 --json --quantity {},H,J,rho,p,von_mises,div_p,div_sigma,\
         body_force_density,current_body_force_density",
        names.join(",")
    );
    let point = folder.mms(&asked).exits(0).json()["points"][0].clone();
    let of = |name: &str| numbers(&point[name]);
    let s = stress(&of("displacement_gradient"));
    let measures = [
        "first_piola_kirchhoff",
        "nominal_stress",
        "cauchy_stress",
        "kirchhoff_stress",
        "second_piola_kirchhoff",
    ];
    measures.iter().for_each(|name| near(name, &of(name), &s[..4], 1e6));
    assert!((of("jacobian")[0] - 1.0).abs() > 0.01, "the volume changes");
    near("rho", &of("mass_density"), &[1000.0], 1000.0);
    near("p", &of("pressure"), &[-(s[0] + s[3] + s[4]) / 3.0], 1e6);
    let squares = (s[0] - s[3]).powi(2) + (s[3] - s[4]).powi(2) + (s[4] - s[0]).powi(2);
    let von_mises = (squares / 2.0 + 3.0 * s[1] * s[1]).sqrt();
    near("von Mises", &of("von_mises"), &[von_mises], 1e6);
    near("div sigma", &of("div_sigma"), &of("div_p"), 1e7);
    near("rho b", &of("current_body_force_density"), &of("body_force_density"), 1e7);
    let whole = folder.mms(&format!("{asked} --all-components")).exits(0).json();
    let nine = [s[0], s[1], 0.0, s[2], s[3], 0.0, 0.0, 0.0, s[4]];
    for name in measures {
        near(name, &numbers(&whole["points"][0][name]), &nine, 1e6);
    }
}

#[test]
fn a_state_has_the_reference_volume_twice() {
    let folder = Folder::new();
    let command = format!("state {FIELD} --cells 4 --time 0.01 -o state.csv");
    folder.mms(&command).exits(0);
    let text = folder.read("state.csv");
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = rows.next().expect("a header");
    let at = |name: &str| header.iter().position(|it| *it == name).expect("a column");
    let columns = ["volume", "reference_volume", "density", "mass"].map(at);
    for row in rows {
        let [volume, reference, density, mass] =
            columns.map(|column| row[column].parse::<f64>().expect("a number"));
        assert_eq!((volume, density), (reference, 1000.0));
        assert_eq!(mass, 1000.0 * reference);
    }
}

/// The small strain is a quantity too, and the meaning of a column `strain`. Other strains are found only by their names.
#[test]
fn a_column_of_strains_holds_the_small_strain() {
    let folder = Folder::new();
    let eval = format!("eval {FIELD} --at 0.3,0.4 --time 0.01 --quantity H,strain --json");
    let point = folder.mms(&eval).exits(0).json()["points"][0].clone();
    let h = numbers(&point["displacement_gradient"]);
    let shear = (h[1] + h[2]) / 2.0;
    near("strain", &numbers(&point["strain"]), &[h[0], shear, shear, h[3]], 1.0);
    let state = |field: &str| {
        let command =
            format!("state {field} --cells 4 --time 0.01 --quantity u,strain -o {field}.csv");
        folder.mms(&command).exits(0);
    };
    let compared = |field: &str, more: &str| -> Vec<String> {
        let command = format!("judge {field} {field}.csv --json {more}");
        let document = folder.mms(&command).json();
        let quantities = document["quantities"].as_array().expect("quantities");
        quantities.iter().map(|it| it["name"].as_str().expect("a name").into()).collect()
    };
    [FIELD, "travelling_wave_2d"].into_iter().for_each(state);
    assert_eq!(compared(FIELD, ""), ["displacement", "strain"]);
    assert_eq!(compared("travelling_wave_2d", ""), ["displacement"]);
    assert_eq!(compared("travelling_wave_2d", "--quantity strain"), ["strain"]);
}

/// The solver's own results, also of the updated formulation: sigma belongs to their F.
#[test]
fn a_run_writes_the_one_stress() {
    let folder = Folder::new();
    for (formulation, shape) in [("updated", "cpgimp"), ("total", "linear")] {
        let options = format!("--cells 8 --frames 1 --formulation {formulation} --shape {shape}");
        folder.mms(&format!("run {FIELD} --vtk {formulation} {options}")).exits(0);
        let files = std::fs::read_dir(folder.path(formulation)).expect("a folder");
        let files = files.map(|it| it.expect("an entry").path());
        let last = files.filter(|it| it.extension().is_some_and(|it| it == "vtu")).max();
        let name = last.expect("a file").file_name().expect("a name").to_owned();
        let file = format!("{formulation}/{}", name.to_string_lossy());
        let run = folder.mms(&format!("diagnose {FIELD} {file} --quantity stress"));
        run.exits(0).prints("nothing");
    }
}
