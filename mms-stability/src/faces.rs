//! Short waves on loaded and free faces, and on rollers: the surface impedance, sampled.

use mms_codegen::compile::Compiled;
use mms_spec::{Claim, Face};
use nalgebra::{SMatrix, SVector};

use crate::chart::components;
use crate::elasticity::unit;
use crate::impedance::Impedance;
use crate::least::{Least, least};
use crate::subject::{State, Subject};
use crate::waves::Recent;

/// The number of places along each axis of a face that are tested first, by dimension.
const PLACES: [usize; 3] = [1, 9, 3];
/// The number of times that are tested first.
const TIMES: usize = 7;
/// The number of directions that are tested first.
const DIRECTIONS: usize = 5;

/// The fraction of a traction up to which a part that is not normal to the deformed face is ignored, so that the load is a
/// pressure.
const PRESSURE: f64 = 1e-9;

/// The least sampled eigenvalue of the surface impedance of a face.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The face.
    pub face: Face,
    /// The claim of the face.
    pub claim: Claim,
    /// The eigenvalue over the modulus at rest.
    pub least: f64,
    /// The least eigenvalue for a load that is a pressure everywhere, and follows the face.
    pub follower: Option<f64>,
    /// X.
    pub at: Vec<f64>,
    /// t.
    pub time: f64,
    /// m.
    pub direction: Vec<f64>,
}

/// The behaviour of a load when the face moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Load {
    /// A load of constant magnitude and direction.
    Dead,
    /// A pressure, which stays normal to the face.
    Follower,
}

/// Evaluates every face that is loaded, free or on rollers. If a load is a pressure at all sampled places, also evaluates a
/// pressure that follows the face. A face without a strongly elliptic state has no impedance, nor has a face of one dimension,
/// along which no wave runs.
pub fn surfaces<const D: usize>(compiled: &Compiled, subject: &mut Subject<'_, D>) -> Vec<Surface> {
    if D == 1 {
        return Vec::new();
    }
    let claimed = compiled.field.boundary.iter();
    let claimed = claimed.map(|boundary| (boundary.face.value, boundary.claim.value));
    let moves = |(_, claim): &(Face, Claim)| !matches!(claim, Claim::Fixed | Claim::Prescribed);
    let faces: Vec<_> =
        claimed.filter(moves).filter(|(face, _)| subject.chart.has(*face)).collect();
    faces.into_iter().filter_map(|(face, claim)| surface(subject, face, claim)).collect()
}

fn surface<const D: usize>(
    subject: &mut Subject<'_, D>,
    face: Face,
    claim: Claim,
) -> Option<Surface> {
    let found = least_impedance(subject, (face, claim), Load::Dead)?;
    let follower = match claim {
        Claim::Traction => least_impedance(subject, (face, claim), Load::Follower),
        _ => None,
    };
    let place = subject.chart.on_face(face, &found.at[..D - 1]);
    let (_, tangents) = subject.chart.frame(face, &place);
    Some(Surface {
        face,
        claim,
        least: found.value,
        follower: follower.map(|found| found.value),
        at: components(&subject.chart.place(&place)),
        time: subject.time(found.at[D - 1]),
        direction: components(&along(&tangents, &found.at[D..])),
    })
}

/// The least eigenvalue over a face, the window and directions. `None` if no state has an impedance, or if `load` should follow
/// the face but is no pressure.
fn least_impedance<const D: usize>(
    subject: &mut Subject<'_, D>,
    (face, claim): (Face, Claim),
    load: Load,
) -> Option<Least> {
    let times = if subject.is_static { 2 } else { TIMES };
    let counts = [&vec![PLACES[D - 1]; D - 1][..], &[times], &vec![DIRECTIONS; D - 2]].concat();
    let mut recent = Recent::new();
    let mut follows = true;
    let found = least(&counts, |fractions| {
        let place = subject.chart.on_face(face, &fractions[..D - 1]);
        let (normal, tangents) = subject.chart.frame(face, &place);
        let state = recent.state(subject, &place, fractions[D - 1]).filter(|_| follows)?;
        let along = along(&tangents, &fractions[D..]);
        let mut impedance = Impedance::new(&state.elasticity, &normal, &along)?;
        if load == Load::Follower {
            let pressure = pressure(state, &normal);
            follows = pressure.is_some();
            let (pressure, inverse) = pressure?;
            impedance = impedance.under_pressure(pressure, [inverse * normal, inverse * along]);
        }
        let span = match claim {
            Claim::Roller => tangents,
            _ => (0..D).map(unit).collect(),
        };
        Some(impedance.least_eigenvalue(&span) / state.modulus)
    });
    found.filter(|_| follows)
}

/// A direction along a face, at a fraction of half a turn; a line has only one.
fn along<const D: usize>(tangents: &[SVector<f64, D>], angle: &[f64]) -> SVector<f64, D> {
    match (tangents, angle) {
        ([first, second], [angle]) => {
            let (sine, cosine) = (std::f64::consts::PI * angle).sin_cos();
            first * cosine + second * sine
        }
        _ => tangents[0],
    }
}

/// P N of a face under pressure is -q F^-T N with q = p J; `None` where P N is not normal to the deformed face. Returns q,
/// and F^-T.
fn pressure<const D: usize>(
    state: &State<D>,
    normal: &SVector<f64, D>,
) -> Option<(f64, SMatrix<f64, D, D>)> {
    let inverse = state.deformation.try_inverse()?.transpose();
    let (area, traction) = (inverse * normal, state.stress * normal);
    let pressure = -traction.dot(&area) / area.norm_squared();
    let rest = traction + area * pressure;
    let is_normal = rest.norm() <= PRESSURE * (traction.norm() + state.modulus * PRESSURE);
    is_normal.then_some((pressure, inverse))
}
