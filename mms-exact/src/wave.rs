//! The fastest wave of a field, which limits the time step of a run.
//!
//! If a wave that the field is proved to allow may cross an edge of a cell in a step, the run stops before it begins, unless
//! `--allow-unstable` is given. The certificate bounds the wave speed in the frame of the grid, for the parameters of the run,
//! and only as sharply as the decision needs; for compiled and interpreted fields.

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

use crate::Input;

/// The number of points at which c0 is sampled.
const POINTS: usize = 16;

/// Bounds the speed of waves in the frame of the method's grid, for parameters that are set by position; only as sharply as the
/// time step of the method needs. `None` if no bound is proved: [`without_bound`] says so.
pub fn fastest_wave(
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
    wave_speed(&input.compiled, set, frame, asked)
}

/// The note that no stable time step of a field is known.
pub fn without_bound(input: &Input) -> String {
    format!(
        "note: no stable time step of `{}` is known, since nothing bounds its waves: see `mms check`",
        input.name.shown()
    )
}

/// The least and the greatest c0 at some points; the least is 0 if there is no point.
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
