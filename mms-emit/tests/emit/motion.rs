//! Tests of the bounds of the motion that modules declare.

use mms_codegen::Compiled;
use mms_emit::{Subject, Target};
use mms_mechanics::Output;
use mms_mechanics::sample::domain;
use mms_program::interpret::{Interpreter, Point};
use mms_spec::quantity::Quantity;
use mms_symbolic::sorted::SortedMap;

use super::gallery::{GALLERY, body_force, field};

/// The number of samples along each edge of the body, in one to three dimensions.
const ALONG: [usize; 3] = [65, 25, 7];
const TIMES: usize = 33;

/// The tolerance at each end, as a part of the distance between both ends, by which bounds may be wider than the samples:
/// bounds stop at 1/100, or after 100 boxes, which is much earlier for rings and columns that turn.
const SLACK: f64 = 0.25;

/// The tolerance at most ends: 1/100, and the motion between samples.
const SHARP: f64 = 0.015;

/// The least and the greatest x by axis of samples, from the scheduled program, which the bounds do not use.
fn reached(compiled: &Compiled) -> Vec<[f64; 2]> {
    let output = Output::Quantity(Quantity::Position);
    let parameters = compiled.parameters::<f64>(&SortedMap::new());
    let (body, [first, last]) = domain(&compiled.program, &parameters);
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    let plan = interpreter.plan(&[output]);
    let dimension = body.dimension();
    let along = ALONG[dimension - 1];
    let fraction = |index: usize, count: usize| index as f64 / (count - 1) as f64;
    let mut found = vec![[f64::INFINITY, f64::NEG_INFINITY]; dimension];
    for time in 0..TIMES {
        interpreter.set_time(&(first + (last - first) * fraction(time, TIMES)));
        for index in 0..along.pow(dimension as u32) {
            let place = (0..dimension).map(|axis| index / along.pow(axis as u32) % along);
            let fractions: Vec<_> = place.map(|place| fraction(place, along)).collect();
            interpreter.set_point(&plan, Point::at(&body.point(&fractions)));
            for (ends, x) in found.iter_mut().zip(interpreter.output(output)) {
                *ends = [ends[0].min(x), ends[1].max(x)];
            }
        }
    }
    found
}

#[test]
fn every_field_stays_within_what_its_modules_tell_and_nearly_fills_it() {
    let (mut sharp, mut all) = (0, 0);
    for compiled in &*GALLERY {
        let name = compiled.field.name.raw();
        let subject = Subject::new(compiled);
        let told = subject.reach();
        for (axis, (told, found)) in told.iter().zip(reached(compiled)).enumerate() {
            let width = found[1] - found[0];
            // The samples have rounding errors.
            let rounding = 1e-14 * (found[0].abs() + found[1].abs());
            let beyond = [found[0] - told[0], told[1] - found[1]];
            println!("{name} {axis}: {told:?} {found:?}");
            for beyond in beyond {
                (sharp, all) = (sharp + usize::from(beyond <= SHARP * width), all + 1);
                assert!(beyond >= -rounding, "{name}, axis {axis}: {told:?} misses {found:?}");
                assert!(beyond <= SLACK * width, "{name}, axis {axis}: {told:?} around {found:?}");
            }
        }
    }
    assert!(4 * sharp > 3 * all, "{sharp} of {all} ends are sharp");
}

/// The module contains the bounds as data, so that nobody types them again.
#[test]
fn modules_tell_how_far_the_motion_goes() {
    let compiled = field("sheared_block_2d");
    let subject = Subject::new(&compiled);
    let alone = body_force("sheared_block_2d");
    let [x, y] = [0, 1].map(|axis| subject.reach()[axis].map(|end| format!("{:?}", end + 0.0)));
    let [[left, right], [bottom, top]] = [x, y];
    for (language, line) in [
        ("c", format!("#define SHEARED_BLOCK_2D_MOTION_LOWER {{{left}, {bottom}}}\n")),
        ("cpp", format!("constexpr double motion_upper[dimension] = {{{right}, {top}}};\n")),
        ("python", format!("MOTION_LOWER = ({left}, {bottom})\nMOTION_UPPER = ({right}, {top})\n")),
        ("numpy", format!("MOTION_UPPER = ({right}, {top})\n")),
        (
            "fortran",
            format!(
                "  real(wp), parameter, public :: motion_lower(dimension) = &\n      \
                 [{left}_wp, {bottom}_wp]\n"
            ),
        ),
        ("julia", format!("const motion_upper = ({right}, {top})\n")),
        ("rust", format!("pub const MOTION_LOWER: [f64; DIMENSION] = [{left}, {bottom}];\n")),
    ] {
        let target = Target::find(language).expect("a target");
        for (subject, of) in [(&subject, "the field"), (&Subject::new(&alone), "b alone")] {
            let bundle = (target.emit)(subject);
            let text = &bundle.files[0].text;
            assert!(text.contains(&line), "{language}, of {of}, has no `{line}`");
            let lower = text.to_lowercase();
            assert!(lower.contains("x_max") && lower.contains("traction"), "{language}, of {of}");
        }
    }
}
