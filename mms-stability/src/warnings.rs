//! Warnings about the stability of a field, for users.

use mms_codegen::bounds::witness::Witness;
use mms_codegen::certify::softening::Softening;
use mms_codegen::compile::Compiled;
use mms_spec::Claim;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::number::short;

use crate::corners::Corner;
use crate::faces::Surface;
use crate::growth::Growth;
use crate::resting::Material;
use crate::stability::Stability;
use crate::waves::Waves;

/// The growth factor over the window above which a disturbance outgrows errors.
const GROWTH: f64 = 10.0;

/// The fraction of the modulus at rest by which a value may be below 0 and still counts as 0.
const ROUNDING: f64 = 1e-9;

/// A warning for each way in which a disturbance grows, at the relevant place of the file; `lost` is where strong ellipticity
/// is proved to be lost, which the sample may miss.
pub fn warnings(
    compiled: &Compiled,
    stability: &Stability,
    lost: Option<&Softening>,
) -> Vec<Diagnostic> {
    let modulus = stability.material.as_ref().map_or("", Material::modulus);
    let mut warnings = Vec::new();
    let waves = stability.waves.iter().filter(|waves| waves.least <= ROUNDING);
    warnings.extend(waves.map(|waves| not_elliptic(compiled, waves, modulus)));
    if let (true, Some(lost)) = (warnings.is_empty(), lost) {
        let Softening { witness: Witness { coordinates: at, time, .. }, direction, value } = lost;
        let (at, time, direction) = (at.clone(), *time, direction.clone());
        warnings.push(not_elliptic(compiled, &Waves { least: *value, at, time, direction }, "Pa"));
    }
    let faces = stability.surfaces.iter().filter(|surface| surface.least < -ROUNDING);
    warnings.extend(faces.map(|surface| growing_face(compiled, surface, modulus)));
    let corners = stability.corners.iter().filter(|corner| corner.coercivity < -ROUNDING);
    warnings.extend(corners.map(|corner| growing_corner(compiled, corner, modulus)));
    let growth = stability.growth.iter();
    warnings.extend(growth.filter_map(|growth| growing(compiled, growth, stability.is_static)));
    warnings
}

fn not_elliptic(compiled: &Compiled, waves: &Waves, modulus: &str) -> Diagnostic {
    let Waves { least, at, time, direction } = waves;
    let message = "strong ellipticity is lost: an acoustic tensor is not positive definite";
    Diagnostic::warning(compiled.field.displacement[0].span, message)
        .label(format!(
            "its least eigenvalue is {} {modulus} at X = {}, t = {}, for waves along N = {}",
            short(*least),
            list(at),
            short(*time),
            list(direction)
        ))
        .help("short waves grow there without a bound, and no mesh converges: take a smaller amplitude, or another material")
}

fn growing_face(compiled: &Compiled, surface: &Surface, modulus: &str) -> Diagnostic {
    let Surface { face, claim, least, at, time, direction, .. } = surface;
    let claimed = compiled.field.boundary.iter().find(|it| it.face.value == *face);
    let span = claimed.map_or(compiled.field.displacement[0].span, |it| it.claim.span);
    let kind = match claim {
        Claim::Traction => "loaded",
        Claim::Roller => "rolling",
        _ => "free",
    };
    let warning = Diagnostic::warning(
        span,
        format!("short waves may grow on the {kind} face {}: its surface impedance is not positive", face.name()),
    )
    .label(format!(
        "its least eigenvalue is {} {modulus} at X = {}, t = {}, for waves along m = {}",
        short(*least),
        list(at),
        short(*time),
        list(direction)
    ))
    .help("they grow faster on finer meshes, and lower the order of accuracy: take a smaller amplitude, or prescribe u on \
           this face")
    .help("this is only a warning: values slightly below 0, near a corner or for a short time, may cause no visible growth");
    match surface.follower {
        Some(least) if least > 0.0 => warning.help(format!(
            "the load is a pressure: if it follows the face, the least eigenvalue is {} {modulus}",
            short(least)
        )),
        _ => warning,
    }
}

fn growing_corner(compiled: &Compiled, corner: &Corner, modulus: &str) -> Diagnostic {
    let Corner { faces: [first, second], coercivity, at, time } = corner;
    let claimed = compiled.field.boundary.iter().find(|it| it.face.value == *first);
    let span = claimed.map_or(compiled.field.displacement[0].span, |it| it.claim.span);
    let message = format!(
        "a disturbance of the corner of {} and {} grows: the second variation there is not positive",
        first.name(),
        second.name()
    );
    Diagnostic::warning(span, message)
        .label(format!(
            "it is {} {modulus} times the squared gradient at X = {}, t = {}",
            short(*coercivity),
            list(at),
            short(*time)
        ))
        .help("it grows faster on finer meshes, and lowers the order of accuracy: take a smaller amplitude, or prescribe u \
               on one of the two faces")
}

fn growing(compiled: &Compiled, growth: &Growth, is_static: bool) -> Option<Diagnostic> {
    let span = compiled.field.displacement[0].span;
    let found = format!("least eigenvalue w^2 = {} 1/s^2", short(growth.least));
    if is_static && growth.least < 0.0 {
        let message = "this state is an unstable equilibrium: the second variation of its energy is not positive";
        let warning = Diagnostic::warning(span, message).label(found);
        return Some(warning.help(
            "a static solver may converge to another state, and a dynamic one leaves this state: take a smaller amplitude, \
             or prescribe u on more faces",
        ));
    }
    (growth.factor > GROWTH).then(|| {
        let factor = short(growth.factor);
        let message = format!("a disturbance of this motion grows by a factor of about {factor} over the time window");
        Diagnostic::warning(span, message)
            .label(format!("{found} at t = {}", short(growth.time)))
            .help("errors of a right solver grow by the same factor: take a smaller amplitude or a shorter window, or \
                   prescribe u on more faces")
    })
}

/// Numbers in four digits.
pub fn list(numbers: &[f64]) -> String {
    let numbers: Vec<_> = numbers.iter().map(|number| short(*number)).collect();
    format!("[{}]", numbers.join(", "))
}
