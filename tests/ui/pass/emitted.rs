//! Files that `mms emit` wrote a moment ago, included as they are, against the interpreter.
#![deny(warnings, unsafe_code, clippy::all)]

mod bar_1d {
    include!(concat!(env!("CARGO_MANIFEST_DIR"), "/emitted/all/bar_1d.rs"));
}
mod wave {
    include!(concat!(env!("CARGO_MANIFEST_DIR"), "/emitted/part/standing_wave_3d.rs"));
}
mod odd_names {
    include!(concat!(env!("CARGO_MANIFEST_DIR"), "/emitted/all/odd_names.rs"));
}
mod plain {
    include!(concat!(env!("CARGO_MANIFEST_DIR"), "/emitted/all/plain.rs"));
}

use mms_codegen::certify::sample::samples;
use mms_codegen::program::Output;
use mms_codegen::program::interpret::{Interpreter, Point};
use mms_codegen::quantity::Quantity;
use mms_codegen::selection::{Freeze, Selection};
use mms_codegen::{Compiled, compile_with};

/// A field of the package, compiled here.
fn compiled(path: &str, selection: &Selection) -> Compiled {
    let file = format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&file).expect("a field file");
    let missing = |material: &str| Err(material.to_string());
    compile_with("field", path, &text, &missing, &selection.clone().into()).expect("a right file")
}

/// Calls `compare` with points, times, and what the interpreter gives there, bit for bit.
fn interpreted(
    compiled: &Compiled,
    quantity: Quantity,
    mut compare: impl FnMut(&[f64], f64, &[f64]),
) {
    let parameters = compiled.parameters::<f64>(&Default::default());
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let plan = interpreter.plan(&[Output::Quantity(quantity)]);
    for point in samples(compiled, &parameters, 64) {
        interpreter.set_time(&point.time);
        interpreter.set_point(&plan, Point::at(&point.coordinates));
        let expected = interpreter.output(Output::Quantity(quantity));
        compare(&point.coordinates, point.time, &expected);
    }
}

fn main() {
    let all = compiled("fields/bar_1d.toml", &Selection::default());
    let bar = bar_1d::prepare(&bar_1d::Parameters::<f64>::default());
    interpreted(&all, Quantity::BodyForce, |at, time, expected| {
        assert_eq!(bar.at_time(time).body_force([at[0]]), *expected);
    });
    interpreted(&all, Quantity::CauchyStress, |at, time, expected| {
        let point = bar.at_point([at[0]]);
        assert_eq!(bar.at_time(time).cauchy_stress_at(&point)[0], *expected);
    });
    assert_eq!(bar.upper(), [1.0]);
    let stress = bar.material_first_piola_kirchhoff([0.5], [[1.0]]);
    assert!((stress[0][0] - 0.5e6 * (2.0 - 0.5)).abs() < 1e-9, "{stress:?}");

    // As the test's command line says it.
    let part = Selection {
        quantities: Some([Quantity::BodyForce, Quantity::Velocity].into()),
        set: vec![("lambda".into(), "0".into())],
        freeze: Freeze::Everything,
        ..Selection::default()
    };
    let part = compiled("examples/fields/standing_wave_3d.toml", &part);
    let field = wave::prepare::<f64>(&wave::Parameters::default());
    interpreted(&part, Quantity::BodyForce, |at, time, expected| {
        let at: [f64; 3] = at.try_into().expect("three coordinates");
        assert_eq!(field.at_time(time).body_force(at), *expected);
        assert_eq!(field.at_time(time).body_force_at(&field.at_point(at)), *expected);
    });
    interpreted(&part, Quantity::Velocity, |at, time, expected| {
        let at: [f64; 3] = at.try_into().expect("three coordinates");
        assert_eq!(field.at_time(time).velocity(at), *expected);
    });

    let odd = odd_names::prepare(&odd_names::Parameters::<f64>::default());
    assert!(odd.at_time(0.0).displacement([1.0])[0] > 0.0);
    let plain = plain::prepare::<f64>(&plain::Parameters::default());
    assert!((plain.at_time(0.0).displacement([0.5])[0] - 0.075).abs() < 1e-16);
}
