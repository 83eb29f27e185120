//! The fastest wave of a field, which the time step of a run is held to.
//!
//! Where a wave that the field is proved to have may cross an edge of a cell in a step, the run stops before it
//! begins, unless `--allow-unstable` is given. The certificate is asked for the wave speed in the frame of the
//! grid, for the parameters of the run, and no sharper than it takes to decide; compiled fields and others alike.

use mms_codegen::Compiled;
use mms_codegen::certify::certificate::wave_speed;
use mms_codegen::certify::rates::Frame;
use mms_mechanics::Output;
use mms_mechanics::Response;
use mms_mechanics::sample::samples;
use mms_program::interpret::{Interpreter, Point};
use mms_runtime::{FormulationName, Method};
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

use super::input::Input;
use crate::terminal::say;

/// At how many points c0 is sampled.
const POINTS: usize = 16;

/// A bound of the speed of waves in the frame of the method's grid, with parameters set by `name=value`
/// settings; no sharper than the time step of the method asks for. `None`, with a word on stderr, where
/// there is none.
pub fn fastest_wave(
    input: &Input,
    settings: &[String],
    method: &Method,
) -> anyhow::Result<Option<f64>> {
    Ok(fastest_wave_with(input, &input.settings(settings)?, method))
}

/// The same, with parameters that are set by position.
pub fn fastest_wave_with(
    input: &Input,
    set: &SortedMap<usize, Rational>,
    method: &Method,
) -> Option<f64> {
    let frame = match method.formulation {
        FormulationName::Updated => Frame::Deformed,
        FormulationName::Total => Frame::Reference,
    };
    // A time step of the Courant number C crosses an edge of a cell at the speed c0/C. Where c0 depends on X,
    // the step follows from the greatest, and a bound that is sharper than needed does no harm.
    let asked = match method.setup.time_step {
        Some(_) => 0.0,
        None => sound(&input.compiled, set)[0] / method.setup.courant,
    };
    let fastest = wave_speed(&input.compiled, set, frame, asked);
    if fastest.is_none() {
        say(format_args!(
            "note: no stable time step of `{}` is known, since nothing bounds its waves: see `mms check`",
            input.name.shown()
        ));
    }
    fastest
}

/// The least and the greatest c0 at some points; the least is 0 where there is none.
pub fn sound(compiled: &Compiled, set: &SortedMap<usize, Rational>) -> [f64; 2] {
    let parameters = compiled.parameters::<f64>(set);
    let output = Output::Response(Response::WaveSpeed);
    let mut interpreter = Interpreter::new(&compiled.program, &parameters);
    interpreter.set_time(&0.0);
    let plan = interpreter.plan(&[output]);
    let speeds = samples(&compiled.program, &parameters, POINTS).into_iter().map(|sample| {
        interpreter.set_point(&plan, Point::at(&sample.coordinates));
        interpreter.output(output)[0]
    });
    let [least, greatest] = speeds.fold([f64::INFINITY, 0.0_f64], |[least, greatest], speed| {
        [least.min(speed), greatest.max(speed)]
    });
    [if least.is_finite() && least > 0.0 { least } else { 0.0 }, greatest]
}
