//! States of fields against formulas by hand, and against the derivation of emitted code.

use crate::support::{gallery, neo_hookean, plane};
use mms_codegen::Compiled;
use mms_mechanics::{Output, Response};
use mms_program::interpret::{Interpreter, Point};
use mms_stability::resting::Material;
use mms_stability::subject::{Formulas, Subject};
use mms_symbolic::sorted::SortedMap;
use nalgebra::{SMatrix, SVector};

/// Tests that dP/dF by dual numbers of P is the tangent that is derived from W by formulas.
fn agrees<const D: usize>(name: &str, compiled: &Compiled) {
    let formulas = Formulas::new(compiled);
    let mut subject = Subject::<D>::new(compiled, &formulas);
    let program = compiled.tangent().expect("a tangent");
    let parameters = compiled.parameters::<f64>(&SortedMap::new());
    let mut interpreter = Interpreter::new(&program, &parameters);
    let output = Output::Response(Response::Tangent);
    let plan = interpreter.plan(&[output]);
    for [a, b] in [[0.25, 0.4], [0.9, 0.7]] {
        let place: SVector<f64, D> = subject.chart.place(&[a; D]);
        let time = subject.time(b);
        let state = subject.state(&place, time).expect("a state");
        let gradient = state.deformation - SMatrix::identity();
        let rows = gradient.transpose();
        let (coordinates, gradient) = (place.as_slice(), rows.as_slice());
        // Given fields change in time.
        interpreter.set_time(&time);
        interpreter.set_point(&plan, Point { coordinates, normal: &[], gradient });
        let tangent = interpreter.output(output);
        let largest = tangent.iter().fold(0.0_f64, |largest, entry| largest.max(entry.abs()));
        for (index, expected) in tangent.iter().enumerate() {
            let digit = |position: u32| index / D.pow(position) % D;
            let found = state.elasticity.at([3, 2, 1, 0].map(digit));
            assert!(
                (found - expected).abs() <= 1e-10 * largest,
                "{name} {index} {found} {expected}"
            );
        }
    }
}

#[test]
fn elasticity_is_the_tangent_of_w_in_every_field() {
    for (name, compiled) in gallery() {
        match compiled.field.dimension {
            1 => agrees::<1>(name, compiled),
            2 => agrees::<2>(name, compiled),
            _ => agrees::<3>(name, compiled),
        }
    }
}

#[test]
fn elasticity_is_that_by_hand() {
    let field = plane(["0.3*X*Y", "0.2*X - 0.1*Y^2"], [1.5, 1.0], [1.0, 1.0], "");
    let formulas = Formulas::new(&field);
    let mut subject = Subject::<2>::new(&field, &formulas);
    let (x, y) = (0.4, 0.7);
    let state = subject.state(&SVector::from([x, y]), 0.0).expect("a state");
    let f = SMatrix::<f64, 2, 2>::new(1.0 + 0.3 * y, 0.3 * x, 0.2, 1.0 - 0.2 * y);
    let expected = neo_hookean(&f, f.determinant(), [1.5, 1.0]);
    for index in 0..16 {
        let at = [8, 4, 2, 1].map(|step| index / step % 2);
        assert!((state.elasticity.at(at) - expected.at(at)).abs() < 1e-14, "{at:?}");
    }
}

/// Every material of the gallery with E and nu has these at F = I, and a material with fibres has no isotropic moduli.
#[test]
fn moduli_at_rest_are_those_that_a_field_gives() {
    let mut seen = 0;
    for (name, compiled) in gallery() {
        let parameters = compiled.parameters::<f64>(&SortedMap::new());
        let named = |wanted: &str| {
            let index = compiled.model.parameters.iter().position(|it| it.name == wanted)?;
            Some(parameters[index])
        };
        let moduli = Material::of(compiled).expect("a material").middle.moduli();
        // If a given pressure has to balance the stress at F = I, the tangent there belongs to a stressed body.
        let is_pressed = compiled.material.name.raw() == "neo_hookean_mixed";
        if compiled.model.fibre.is_some() || is_pressed {
            assert_eq!(moduli, None, "{name}");
            continue;
        }
        let moduli = moduli.unwrap_or_else(|| panic!("{name} is isotropic"));
        let is_graded = name.starts_with("graded");
        if let (Some(young), Some(nu), false) = (named("young"), named("nu"), is_graded) {
            assert!((moduli.young() / young - 1.0).abs() < 1e-9, "{name}: {moduli:?}");
            assert!((moduli.nu() - nu).abs() < 1e-9, "{name}: {moduli:?}");
            seen += 1;
        }
    }
    assert!(seen > 5, "{seen}");
}
