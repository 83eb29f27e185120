//! Axisymmetric fields in every language: points R and Z, tensors of three rows, vectors of two components, or three with a
//! swirl.

use std::fs;
use std::path::Path;

use mms_codegen::{Compiled, compile};
use mms_emit::Subject;
use mms_emit::port::callable::callables;

use super::build::{in_turn, mostly_quick, prove};

/// The worst error of a check program, in eps.
const WORST: f64 = 64.0;

fn compiled(name: &str, text: &str) -> Compiled {
    let load = |path: &str| Err(format!("{path}: no such material here"));
    compile(name, &format!("{name}.toml"), text, &load)
        .unwrap_or_else(|failure| panic!("{failure}"))
}

/// A shaft with its axis, with a swirl or without.
fn shaft(has_swirl: bool) -> Compiled {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mms-codegen/tests/data/pass");
    let text = fs::read_to_string(folder.join("units_axisymmetric.toml")).expect("a field");
    if has_swirl {
        return compiled("shaft", &text);
    }
    let (motion, _) = text.split_once("[[balance]]").expect("a balance");
    let line = |line: &&str| !line.starts_with("swirl");
    compiled("shaft", &motion.lines().filter(line).collect::<Vec<_>>().join("\n"))
}

#[test]
fn axisymmetric_fields_prove_themselves_in_every_language() {
    let shafts = [true, false].map(shaft);
    for (case, shaft) in shafts.iter().enumerate() {
        let subject = Subject::new(shaft);
        for target in in_turn("shafts", case, shafts.len()) {
            let worst = prove(target, &subject, &format!("axisymmetric_{case}"), mostly_quick);
            assert!(worst <= WORST, "{}: {worst}", target.name);
        }
    }
}

#[test]
fn functions_have_the_components_of_their_field() {
    for (has_swirl, vector) in [(true, 3), (false, 2)] {
        let shaft = shaft(has_swirl);
        let all = callables(&shaft);
        let of = |name: &str| all.iter().find(|it| it.name == name).expect("a function");
        for (name, count) in [
            ("displacement", vector),
            ("body_force", vector),
            ("traction", vector),
            ("first_piola_kirchhoff", 9),
            ("r_max_normal", 2),
            ("r_max_traction", vector),
            ("lower", 2),
        ] {
            assert_eq!(of(name).components.len(), count, "{name}");
        }
        assert_eq!(of("body_force").input_names(), ["R", "Z"]);
        assert_eq!(of("traction").input_names(), ["R", "Z", "N1", "N2"]);
        assert_eq!(of("material_kirchhoff_stress").inputs.len(), 2 + 9);
        // The axis is no face.
        assert!(all.iter().all(|it| !it.name.starts_with("r_min")));
    }
}
