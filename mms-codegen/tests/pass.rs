//! Every file in `data/pass` is right: reading it and parsing its formulas gives no diagnostic.

use std::fs;
use std::path::Path;

use mms_codegen::{Selection, compile_with};
use mms_spec::diagnostic::render;
use mms_spec::quantity::Quantity;
use mms_spec::source::Sources;
use mms_spec::syntax::parse;
use mms_spec::{BodySpec, FieldSpec, read_field, read_material};

/// Reads a field that must be right.
fn field(path: &Path) -> FieldSpec {
    let mut sources = Sources::default();
    let id = sources.add(path.display().to_string(), fs::read_to_string(path).expect("a file"));
    let mut diagnostics = Vec::new();
    let spec = read_field(&sources, id, "x", &mut diagnostics);
    let spec = spec.unwrap_or_else(|| panic!("{}", render(&sources, &diagnostics)));
    spec.formulas().for_each(|formula| drop(parse(formula, &mut diagnostics)));
    assert!(diagnostics.is_empty(), "{}", render(&sources, &diagnostics));
    spec
}

fn data(name: &str) -> FieldSpec {
    field(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/pass").join(name))
}

#[test]
fn right_files_are_read_without_a_word() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/pass");
    for entry in fs::read_dir(folder).expect("tests/data/pass") {
        let path = entry.expect("an entry of tests/data/pass").path();
        let name = path.file_stem().expect("a stem").to_string_lossy().into_owned();
        if !name.starts_with("material_") {
            field(&path);
        }
    }
}

#[test]
fn materials_are_read_without_a_word() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut sources = Sources::default();
    let mut diagnostics = Vec::new();
    for path in ["materials/neo_hookean.toml", "tests/data/pass/material_every_key.toml"] {
        let id = sources.add(path, fs::read_to_string(root.join(path)).expect("a file"));
        let spec = read_material(&sources, id, "x", &mut diagnostics).expect("a material");
        spec.formulas().for_each(|formula| drop(parse(formula, &mut diagnostics)));
        assert!(diagnostics.is_empty(), "{}", render(&sources, &diagnostics));
        let names: Vec<_> = spec.parameters.iter().map(|found| found.name.value.as_str()).collect();
        assert_eq!(names, ["lambda", "mu"]);
        assert_eq!(spec.frame_indifferent, path.contains("neo_hookean"));
    }
}

/// Compiles the files whose names begin with `units`: their formulas agree with their units, or state none.
#[test]
fn right_units_compile_without_a_word() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/pass");
    // Units are checked in the whole file, for any selection.
    let quantities = Some([Quantity::Displacement].into());
    let options = Selection { quantities, ..Selection::default() }.into();
    let mut compiled = 0;
    for entry in fs::read_dir(folder).expect("tests/data/pass") {
        let path = entry.expect("an entry of tests/data/pass").path();
        let name = path.file_stem().expect("a stem").to_string_lossy().into_owned();
        if name.starts_with("units_") {
            let text = fs::read_to_string(&path).expect("a file");
            let load = |_: &str| Err("no material files here".to_string());
            let result = compile_with(&name, &name, &text, &load, &options);
            result.unwrap_or_else(|failure| panic!("{name}: {failure}"));
            compiled += 1;
        }
    }
    assert!(compiled > 3);
}

#[test]
fn definitions_keep_the_order_of_the_file() {
    let spec = data("every_key_2d.toml");
    let parameters: Vec<_> =
        spec.parameters.iter().map(|found| found.name.value.as_str()).collect();
    assert_eq!(parameters, ["inner_radius", "outer_radius", "young", "rho0"]);
    let lets: Vec<_> = spec.lets.iter().map(|found| found.name.value.as_str()).collect();
    assert_eq!(lets, ["R", "A"]);
    let arguments: Vec<_> =
        spec.material.arguments.iter().map(|(name, _)| name.value.as_str()).collect();
    assert_eq!(arguments, ["lambda", "mu", "reinforcement"]);
}

#[test]
fn every_key_arrives() {
    let spec = data("every_key_2d.toml");
    assert_eq!(spec.parameters[0].value.text, "1000e-3");
    assert_eq!(spec.parameters[3].value.text, "1000");
    assert_eq!(spec.displacement[0].text, "A*X*R");
    assert_eq!(spec.material.fibre.as_ref().map(Vec::len), Some(3));
    assert!(matches!(&spec.domain.body, BodySpec::Round(round) if round.theta.is_some()));
    let faces: Vec<_> = spec.boundary.iter().map(|found| found.face.value.name()).collect();
    assert_eq!(faces, ["inner", "outer", "theta_min", "theta_max"]);
    let claims: Vec<_> = spec.boundary.iter().map(|found| found.claim.value.name()).collect();
    assert_eq!(claims, ["prescribed", "traction", "roller", "free"]);
    let study = &spec.studies[0];
    assert_eq!(
        (study.shape.as_str(), study.integrator.as_str()),
        ("quadratic_bspline", "leapfrog")
    );
    assert_eq!((study.courant, study.particles_per_cell), (Some(0.4), Some(3)));
    assert_eq!((study.precision.as_deref(), study.form.as_deref()), (Some("f64"), Some("fast")));
    assert_eq!((study.cells.as_slice(), study.order), ([8, 16].as_slice(), 2.0));
    assert_eq!(spec.checks[0].lets[0].name.value, "s");
    assert_eq!(spec.extremes[0].set.len(), 2);
    assert!(
        spec.rigid.is_some_and(|rigid| rigid.rotation.is_some() && rigid.translation.is_some())
    );
}
