//! Methods with smaller time steps.

use mms_runtime::Method;

/// The number of equal parts of the time window at whose ends the runs of a study in time are compared.
pub const PARTS: usize = 16;

/// A method whose time step is halved `times` times.
pub fn halved(method: &Method, times: u32) -> Method {
    let mut method = method.clone();
    let factor = 2f64.powi(times as i32);
    method.setup.courant /= factor;
    method.setup.time_step = method.setup.time_step.map(|step| step / factor);
    method.setup.parts *= PARTS << times;
    method
}

/// A method with a quarter of the time step, unless that is given.
pub fn quartered(method: &Method) -> Method {
    let mut method = method.clone();
    method.setup.courant /= 4.0;
    method
}
