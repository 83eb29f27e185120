//! The accuracy of the stable form: for every quantity, at any amplitude down to 1e-12 of the size, the largest error over
//! points spread over body and time window is at most 64 eps of the largest magnitude of that quantity over these points.
//!
//! The reference is the same program in 77 digits, on the very same `f64` numbers.

mod measure;

use std::fs;
use std::path::{Path, PathBuf};

use measure::{Excess, of_field, of_responses};
use mms_codegen::compile::compile_unproved;
use mms_codegen::materials::MATERIALS;
use mms_codegen::{Compiled, Options};
use mms_math::Scalar as _;
use mms_mechanics::Output;
use mms_program::interpret::{Interpreter, Point};
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;
use mms_spec::source::Sources;
use mms_spec::{MaterialSpec, read_material};
use mms_symbolic::sorted::SortedMap;

use crate::sampled::sampled;

/// The bound, in units of eps.
const BOUND: f64 = 64.0;

/// The tested values of the parameter that scales the strain, beside its default.
const AMPLITUDES: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// Parameters that scale a motion.
const SCALES: [&str; 4] = ["amplitude", "angle", "twist", "stretch"];

/// The TOML files of a folder, in order of their names.
fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{folder:?}: {error}"));
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{folder:?} has fields");
    files
}

fn compiled(name: &str, text: &str) -> Compiled {
    with_own_material(name, text, "")
}

/// A field, possibly with a material of its own.
fn with_own_material(name: &str, text: &str, material: &str) -> Compiled {
    let load = |_: &str| Ok(material.to_string());
    compile_unproved(name, name, text, &load, &Options::default())
        .unwrap_or_else(|failure| panic!("{failure}"))
}

/// Measures all outputs of a field at every amplitude.
fn measured(name: &str, text: &str) -> Vec<Excess> {
    at_every_amplitude(name, &compiled(name, text))
}

fn at_every_amplitude(name: &str, compiled: &Compiled) -> Vec<Excess> {
    let scale = compiled.model.parameters.iter().position(|parameter| {
        let name = parameter.name.as_str();
        SCALES.contains(&name)
    });
    let mut measured = of_field(compiled, name, None);
    for amplitude in AMPLITUDES {
        measured.extend(
            scale.into_iter().flat_map(|scale| of_field(compiled, name, Some((scale, amplitude)))),
        );
    }
    measured
}

/// Prints the largest errors first, and fails if one exceeds the bound.
#[track_caller]
fn hold(mut measured: Vec<Excess>) {
    assert!(!measured.is_empty());
    measured.sort_by(|a, b| b.eps.total_cmp(&a.eps));
    let beyond: Vec<_> = measured.iter().filter(|it| it.is_beyond(BOUND)).collect();
    for excess in beyond.iter().copied().chain(measured.iter().take(5)) {
        println!("{excess}");
    }
    assert!(beyond.is_empty(), "{} of {} are beyond {BOUND} eps", beyond.len(), measured.len());
}

/// Measures every field of a folder, or one field in `share`.
fn measured_in(folder: &str, share: usize) -> Vec<Excess> {
    let of = |path: &PathBuf| {
        let text = fs::read_to_string(path).expect("a readable file");
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        measured(&name, &text)
    };
    sampled(&files(folder), share).into_iter().flat_map(of).collect()
}

#[test]
fn every_field_of_the_gallery_holds() {
    hold(measured_in("../fields", 5));
}

/// The remainder of b and Div P if all terms of first order cancel: waves at the speed of the material, and harmonic motions.
#[test]
fn what_is_of_second_order_in_the_amplitude_holds() {
    hold(measured_in("tests/data/second_order", 2));
}

/// Constants that are much larger than the variable part, or added to something large.
#[test]
fn what_stands_beside_constants_holds() {
    hold(measured_in("tests/data/constants", 1));
}

/// Bodies that are a million times as far from the origin as they are large.
#[test]
fn fields_about_a_place_far_away_hold() {
    hold(measured_in("tests/data/far", 1));
}

/// Compares with a different program, unlike the other tests: the field at the origin has no offsets.
#[test]
fn a_field_far_away_has_the_values_of_the_same_field_at_the_origin() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/far/wave_from_afar.toml");
    let far = fs::read_to_string(path).expect("a readable file");
    let near =
        far.replace("X - x0", "X").replace("Y - y0", "Y").replace("3e6", "0").replace("-7e5", "0");
    let values = |text: &str, [x, y]: [f64; 2]| {
        let compiled = compiled("a wave", text);
        let parameters = compiled.parameters::<Precise>(&SortedMap::new());
        let mut interpreter = Interpreter::new(&compiled.program, &parameters);
        interpreter.set_time(&Precise::from_f64(0.375));
        let quantities = Quantity::ALL.iter().filter(|it| **it != Quantity::Position);
        let outputs: Vec<Output> = quantities.map(|it| Output::Quantity(*it)).collect();
        let [coordinates, normal] = [[x, y], [0.6, 0.8]].map(|it| it.map(Precise::from_f64));
        let point = Point { normal: &normal, ..Point::at(&coordinates) };
        interpreter.set_point(&interpreter.plan(&outputs), point);
        outputs.into_iter().flat_map(|it| interpreter.output(it)).collect::<Vec<_>>()
    };
    let [near, far] = [(near, [0.25, 0.375]), (far, [3e6 + 0.25, -7e5 + 0.375])]
        .map(|(text, at)| values(&text, at));
    assert_eq!(near.len(), far.len());
    for (near, far) in near.into_iter().zip(far) {
        let (difference, size) = ((near.clone() - far).to_f64().abs(), near.to_f64().abs());
        assert!(difference <= 1e-60 * size.max(1e-3), "{difference:e} of {size:e}");
    }
}

/// Terms that are separated for small strains may lose digits at large ones.
#[test]
fn waves_hold_after_many_periods() {
    hold(measured_in("tests/data/late", 1));
}

#[test]
fn graded_moduli_hold_at_large_shear() {
    hold(measured_in("tests/data/graded", 1));
}

/// Densities of users, whose slopes cancel at F = I only as functions of the invariants.
#[test]
fn stresses_of_materials_of_ones_own_hold() {
    let energies = [
        "mu/2*(I1 - 3) + mu*(1/J - 1)",
        "mu/2*(I1 - 3) + mu*(J^(-2) - 1)/2",
        "mu/2*(I2/I3 + 2*J - 5)",
    ];
    let motions = files("tests/data/stable");
    let pairs = motions.iter().flat_map(|motion| energies.map(|energy| (motion, energy)));
    let mut measured = Vec::new();
    for (path, energy) in sampled(pairs, 20) {
        let motion = fs::read_to_string(path).expect("a readable file");
        let text = format!("{motion}\n[material]\nmodel = \"./own.toml\"\nmu = 3\ndensity = 2\n");
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let material = format!(
            "[material]\ntitle = \"own\"\nstrain_energy = \"{energy}\"\n\n[parameters]\nmu = {{}}\n"
        );
        let name = format!("{stem} of {energy}");
        let compiled = with_own_material(&name, &text, &material);
        measured.extend(at_every_amplitude(&name, &compiled));
    }
    hold(measured);
}

/// A motion with a material whose bulk modulus has that size. The files lack their last table, [material].
fn with_material(stem: &str, text: &str, spec: &MaterialSpec, bulk: usize) -> (String, String) {
    let line = |(index, parameter): (usize, &mms_spec::MaterialParameter)| {
        let unit = parameter.unit.as_ref().map(|unit| unit.value.as_str());
        let value = match (parameter.name.value.as_str(), unit) {
            ("lambda" | "kappa" | "c3", _) => bulk,
            (_, Some("Pa")) => 2 + index,
            _ => 30,
        };
        format!("{} = {value}\n", parameter.name.value)
    };
    let arguments: String = spec.parameters.iter().enumerate().map(line).collect();
    // Given fields are at rest, so that they add nothing to small terms.
    let givens = spec.givens.iter().map(|given| format!("{} = 0\n", given.name.value));
    let arguments = arguments + &givens.collect::<String>();
    let fibre = if spec.has_fibres() { "fibre = [\"3/5\", \"4/5\", 0]\n" } else { "" };
    let material = spec.name.raw();
    let text =
        format!("{text}\n[material]\nmodel = \"{material}\"\n{arguments}{fibre}density = 2\n");
    (format!("{stem} of {material}"), text)
}

fn materials() -> Vec<MaterialSpec> {
    let read = |(stem, text): &(&str, &str)| {
        let mut sources = Sources::default();
        let id = sources.add(*stem, *text);
        read_material(&sources, id, stem, &mut Vec::new()).expect("a right file")
    };
    MATERIALS.iter().map(read).collect()
}

/// Every motion of a folder with every material, or one in `share` of these pairs.
fn with_every_material(folder: &str, bulk: usize, share: usize) -> Vec<Excess> {
    let (motions, materials) = (files(folder), materials());
    let pairs = materials.iter().flat_map(|spec| motions.iter().map(move |motion| (spec, motion)));
    let of = |spec: &MaterialSpec, motion: &PathBuf| {
        let text = fs::read_to_string(motion).expect("a readable file");
        let stem = motion.file_stem().unwrap_or_default().to_string_lossy();
        let (name, text) = with_material(&stem, &text, spec, bulk);
        measured(&name, &text)
    };
    sampled(pairs, share).into_iter().flat_map(|(spec, motion)| of(spec, motion)).collect()
}

#[test]
fn motions_with_large_rotations_and_tiny_strains_hold_for_every_material() {
    hold(with_every_material("tests/data/stable", 2, 42));
}

/// If the divergence of u is 0, which the formulas do not show, a bulk modulus only multiplies terms of second order.
#[test]
fn motions_without_divergence_hold_near_incompressibility() {
    hold(with_every_material("tests/data/one_volume", 3000, 12));
}

/// The contribution to Div P of fibres whose direction varies is as small as the stress.
#[test]
fn fibres_that_turn_over_the_body_hold() {
    let of = |displacement: &str| {
        let text = format!(
            "[field]\ntitle = \"fibres\"\ndimension = 2\n[parameters]\namplitude = {{ value = 0.1 }}\n\
             [displacement]\nu = [{displacement}]\n[material]\nmodel = \"transversely_isotropic\"\n\
             lambda = 2\nmu = 3\nreinforcement = 5\nfibre = [\"cos(X)\", \"sin(X)\", 0]\ndensity = 1\n\
             [domain]\nshape = \"box\"\nlower = [0, 0]\nupper = [1, 1]\ntime = [0, 1]\n"
        );
        measured(displacement, &text)
    };
    let motions = ["0, \"amplitude*X*Y\"", "\"amplitude*sin(X + t)\", \"amplitude*X*Y^2\""];
    hold(motions.into_iter().flat_map(of).collect());
}

#[test]
fn what_a_material_answers_to_a_gradient_holds() {
    let mut all = Vec::new();
    for dimension in 1..=3 {
        let corner = |value: &str| vec![value; dimension].join(", ");
        let motion = format!(
            "[field]\ntitle = \"a field\"\ndimension = {dimension}\n[displacement]\nu = [{}]\n\
             [domain]\nshape = \"box\"\nlower = [{}]\nupper = [{}]\ntime = [0, 1]\n",
            corner("0"),
            corner("0"),
            corner("1")
        );
        for spec in materials() {
            let (name, text) = with_material("an answer", &motion, &spec, 2);
            let compiled = compiled(&name, &text);
            for size in [0.3, 1e-3, 1e-6, 1e-9, 1e-12] {
                all.extend(of_responses(&compiled, &name, size));
            }
        }
    }
    hold(all);
}
