//! The stability of a field in the report of `mms check`.

use mms_codegen::certify::certificate::Certificate;
use mms_codegen::certify::ellipticity::Ellipticity;
use mms_codegen::certify::softening::Softening;
use mms_documents::check;
use mms_documents::show as documents;
use mms_spec::Space;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::number::short;
use mms_stability::Stability;
use mms_stability::corners::Corner;
use mms_stability::faces::Surface;
use mms_stability::fibres::TransverseModuli;
use mms_stability::growth::Growth;
use mms_stability::resting::Material;
use mms_stability::solve::Solved;
use mms_stability::warnings::list;
use mms_stability::waves::Waves;

/// Lines for the values below 0 and the least of the others; for all values if `is_full`. `name` is the name of the line.
fn least_lines<T>(
    all: &[T],
    is_full: bool,
    (name, value): (&str, fn(&T) -> f64),
    line: impl Fn(&T) -> String,
) -> Vec<String> {
    let firm = || all.iter().filter(|it| value(it) >= 0.0);
    let least = firm().map(value).fold(f64::INFINITY, f64::min);
    let softest = all.iter().position(|it| value(it) == least);
    let is_told = |at: usize, it: &T| is_full || value(it) < 0.0 || Some(at) == softest;
    let kept = all.iter().enumerate().filter(|(at, it)| is_told(*at, it));
    let mut lines: Vec<String> = kept.map(|(_, it)| line(it)).collect();
    let left = all.len() - lines.len();
    lines
        .extend((left > 0).then(|| format!("  {name:<6} {left} more are more stable (--verbose)")));
    lines
}

/// A line for each sampled property; for faces and corners only the important ones unless `is_full`.
pub fn text(
    stability: &Stability,
    certificate: &Certificate,
    (space, is_static): (Space, bool),
    is_full: bool,
) -> Vec<String> {
    let mut lines: Vec<_> = stability.material.iter().map(at_rest).collect();
    lines.push(extent(&certificate.reach, space, stability.shortest_wavelength));
    let modulus = stability.material.as_ref().map_or("", Material::modulus);
    lines
        .extend(stability.waves.iter().map(|waves| body(waves, &certificate.ellipticity, modulus)));
    let of_face = ("face", (|it| it.least) as fn(&Surface) -> f64);
    lines.extend(least_lines(&stability.surfaces, is_full, of_face, |it| face(it, modulus)));
    let of_corner = ("corner", (|it| it.coercivity) as fn(&Corner) -> f64);
    lines.extend(least_lines(&stability.corners, is_full, of_corner, |it| edge(it, modulus)));
    lines.extend(stability.growth.iter().map(|growth| match is_static {
        true => equilibrium(growth),
        false => long(growth, stability.is_static),
    }));
    if stability.is_axisymmetric {
        let proved = proved(&certificate.ellipticity);
        lines.push(format!("  waves  acoustic tensors are positive definite: {proved}"));
        lines.push(
            "  faces  NOT LOOKED AT: waves on faces and corners, and long waves, of an axisymmetric body"
                .into(),
        );
    } else if !stability.has_mesh {
        lines.push(
            "  faces  NOT LOOKED AT: waves on faces and corners, and long waves, of a polygon"
                .into(),
        );
    }
    lines
}

/// The moduli at rest, under the names of other codes.
pub fn at_rest(material: &Material) -> String {
    let middle = if material.is_graded { ", in the middle of the body" } else { "" };
    if let Some(mu) = material.middle.shear_alone() {
        return format!(
            "  rest   mu = {} at F = I{middle}; a given field determines the volume",
            short(mu)
        );
    }
    if let Some(moduli) = material.middle.moduli() {
        let [young, nu] = [moduli.young(), moduli.nu()].map(short);
        let [lambda, mu] = [moduli.lambda, moduli.mu].map(short);
        return format!(
            "  rest   E = {young}, nu = {nu}, lambda = {lambda}, mu = {mu} at F = I{middle}"
        );
    }
    match material.middle.transverse_moduli() {
        Some(TransverseModuli { axis, young, nu, shear }) => format!(
            "  rest   E = {}, nu = {}, G = {} along {} and across it at F = I{middle}",
            list(&young),
            list(&nu),
            list(&shear),
            list(&axis)
        ),
        None => {
            "  rest   neither isotropic nor transversely isotropic at F = I: it has no E and nu"
                .into()
        }
    }
}

/// The box for a background grid, and the wavelength that a mesh must resolve.
pub fn extent(reach: &[[f64; 2]], space: Space, shortest_wavelength: Option<f64>) -> String {
    let side = |(axis, [least, most]): (usize, &[f64; 2])| {
        let direction = space.directions()[axis];
        format!("{} <= {direction} <= {}", short(*least), short(*most))
    };
    let sides: Vec<_> = reach.iter().enumerate().map(side).collect();
    let wave = match shortest_wavelength {
        Some(length) => format!("shortest wavelength {} (sampled)", short(length)),
        None => "no wavelength, for example because u is linear along each axis".into(),
    };
    format!("  extent {}; {wave}", sides.join(", "))
}

/// The proof about acoustic tensors, in a word or with its place.
fn proved(ellipticity: &Ellipticity) -> String {
    match ellipticity {
        Ellipticity::Strong(_) => "proved".into(),
        Ellipticity::Lost(Softening { witness, direction, .. }) => format!(
            "REFUTED at X = {}, t = {} along {}",
            list(&witness.coordinates),
            short(witness.time),
            list(direction)
        ),
        Ellipticity::Unproved => "not proved".into(),
    }
}

fn body(waves: &Waves, ellipticity: &Ellipticity, modulus: &str) -> String {
    let proved = proved(ellipticity);
    let Waves { least, at, time, direction } = waves;
    format!(
        "  waves  acoustic tensors are positive definite: {proved}; {} {modulus} at X = {}, t = {} along {} is the least of a sample",
        short(*least),
        list(at),
        short(*time),
        list(direction)
    )
}

fn face(surface: &Surface, modulus: &str) -> String {
    let Surface { face, least, at, time, direction, follower, .. } = surface;
    let follower = follower.map_or(String::new(), |least| {
        format!("; {} as a pressure that follows the face", short(least))
    });
    format!(
        "  face   {}: surface impedance {} {modulus} at X = {}, t = {} along {} is the least of a sample{follower}",
        face.name(),
        short(*least),
        list(at),
        short(*time),
        list(direction)
    )
}

fn edge(corner: &Corner, modulus: &str) -> String {
    let Corner { faces: [first, second], coercivity, at, time } = corner;
    format!(
        "  corner {}, {}: coercivity {} {modulus} at X = {}, t = {}, in the softest state of a sample",
        first.name(),
        second.name(),
        short(*coercivity),
        list(at),
        short(*time)
    )
}

/// The line about the equilibrium of a static field, which is judged as a motion at rest.
fn equilibrium(growth: &Growth) -> String {
    let elements: Vec<_> = growth.elements.iter().map(usize::to_string).collect();
    let is = if growth.factor > 1.0 { "UNSTABLE" } else { "stable" };
    format!(
        "  growth the equilibrium is {is} against long waves ({} quadratic elements)",
        elements.join(" x ")
    )
}

fn long(growth: &Growth, is_static: bool) -> String {
    let elements: Vec<_> = growth.elements.iter().map(usize::to_string).collect();
    let times = if is_static { "at rest".into() } else { format!("{} times", growth.times) };
    let what = match growth.factor > 1.0 {
        false => "no long wave grows".into(),
        true => {
            format!("a disturbance grows by a factor of {} over the window", short(growth.factor))
        }
    };
    format!(
        "  growth {what}: least w^2 {} 1/s^2 at t = {} ({} quadratic elements, {times})",
        short(growth.least),
        short(growth.time),
        elements.join(" x ")
    )
}

/// The stability as a part of a document, with the warnings.
pub fn document(
    stability: &Stability,
    warnings: &[Diagnostic],
    solved: Option<Solved>,
) -> check::Stability {
    let waves = stability.waves.as_ref();
    let growth = stability.growth.as_ref();
    check::Stability {
        least_acoustic_eigenvalue: waves.map(|waves| waves.least),
        softest_wave: waves.map(|waves| check::PlaceInTheMotion {
            at: waves.at.to_vec(),
            time: waves.time,
            direction: waves.direction.to_vec(),
        }),
        faces: stability.surfaces.iter().map(face_document).collect(),
        corners: stability.corners.iter().map(corner_document).collect(),
        growth: growth.map(|growth| growth.factor),
        slowest_mode: growth.map(|growth| check::Mode {
            omega_squared: growth.least,
            time: growth.time,
            elements: growth.elements.to_vec(),
            times: growth.times,
        }),
        solve: solved.map(|it| it.name().to_owned()),
        warnings: warnings.iter().map(sentence).collect(),
    }
}

fn face_document(surface: &Surface) -> check::Surface {
    check::Surface {
        face: surface.face.name().to_string(),
        least_impedance: surface.least,
        least_impedance_follower: surface.follower,
        at: surface.at.to_vec(),
        time: surface.time,
        direction: surface.direction.to_vec(),
    }
}

fn corner_document(corner: &Corner) -> check::Corner {
    check::Corner {
        faces: corner.faces.map(|face| face.name().to_string()).to_vec(),
        coercivity: corner.coercivity,
        at: corner.at.to_vec(),
        time: corner.time,
    }
}

fn sentence(warning: &Diagnostic) -> String {
    format!("{}: {}", warning.message, warning.label)
}

/// Moduli at rest; `None` for a material that is not isotropic there.
pub fn moduli(material: Option<&Material>) -> Option<documents::Moduli> {
    let moduli = material?.middle.moduli()?;
    Some(documents::Moduli {
        lambda: moduli.lambda,
        mu: moduli.mu,
        young: moduli.young(),
        nu: moduli.nu(),
    })
}

/// Moduli of a material that is at rest isotropic about one axis only.
pub fn transverse(material: Option<&Material>) -> Option<documents::TransverseModuli> {
    let TransverseModuli { axis, young, nu, shear } = material?.middle.transverse_moduli()?;
    Some(documents::TransverseModuli {
        axis: axis.to_vec(),
        young: young.to_vec(),
        nu: nu.to_vec(),
        shear: shear.to_vec(),
    })
}
