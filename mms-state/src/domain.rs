//! The data of a field that a solver needs once: time window, body, extent of the motion, claims on the faces.

use mms_documents::state::{StateBody, StateBox, StateDomain, StateFace};
use mms_emit::port::faces::claims;
use mms_exact::Exact;
use mms_mechanics::Bound;
use mms_mechanics::extent::Extent;
use mms_mechanics::output::parts;
use mms_results::write::{self, Fact};
use mms_spec::quantity::Quantity;
use mms_spec::{Claim, Face};

/// The number of samples of the body along each edge, in one to three dimensions.
const ALONG: [usize; 3] = [257, 33, 9];

/// The number of sampled times.
const TIMES: usize = 65;

/// The data of a field.
#[derive(Clone, Debug)]
pub struct Domain {
    /// The time window; `None` for a static field.
    window: Option<[f64; 2]>,
    body: Extent<f64>,
    /// The least and the greatest coordinates x of samples.
    reach: [Vec<f64>; 2],
    faces: Vec<(Face, Claim)>,
    /// Whether points represent rings.
    is_axisymmetric: bool,
}

/// The measure of volumes and masses of rings.
const OF_RINGS: &str = "per radian";

impl Domain {
    /// Collects the data of a field with numeric parameters.
    ///
    /// # Errors
    /// A motion that cannot be evaluated.
    pub fn of(exact: &mut Exact) -> anyhow::Result<Self> {
        let faces = claims(&exact.input().compiled.field);
        let window = Some(exact.window).filter(|_| !exact.input().is_static());
        let body = exact.body.clone();
        let is_axisymmetric = exact.space().is_axisymmetric();
        Ok(Domain { reach: reach(exact)?, window, body, faces, is_axisymmetric })
    }

    /// The data in lines for a person.
    pub fn text(&self) -> String {
        let [lower, upper] = &self.reach;
        let mut text = match self.window {
            Some([first, last]) => format!("time window: {first:?} to {last:?}\n"),
            None => "static: no time\n".into(),
        };
        text += &format!("motion: x from {lower:?} to {upper:?} (sampled)\n");
        if self.is_axisymmetric {
            text += &format!("volumes and masses: of rings, {OF_RINGS}\n");
        }
        for (face, claim) in &self.faces {
            text += &format!("{}: {}, {}\n", face.name(), claim.name(), claim.meaning());
        }
        text
    }

    /// The data as facts in a file: numbers, and the claim of each face.
    pub fn facts(&self) -> Vec<Fact> {
        let fact = |name: &str, value| Fact { name: name.to_owned(), value };
        let [lower, upper] = &self.reach;
        let window = self.window.map(|it| fact("time_window", write::Value::Numbers(it.to_vec())));
        let mut facts: Vec<Fact> = window.into_iter().collect();
        facts.push(fact("motion_lower", write::Value::Numbers(lower.clone())));
        facts.push(fact("motion_upper", write::Value::Numbers(upper.clone())));
        facts.extend(self.faces.iter().map(|(face, claim)| {
            fact(&format!("face_{}", face.name()), write::Value::Word(claim.name().to_owned()))
        }));
        let volumes = self.volumes().map(|it| fact("volumes", write::Value::Word(it)));
        facts.extend(volumes);
        facts
    }

    /// The measure of volumes and masses, if it is not the whole body.
    fn volumes(&self) -> Option<String> {
        self.is_axisymmetric.then(|| OF_RINGS.to_owned())
    }

    /// The data as a part of a document.
    pub fn document(&self) -> StateDomain {
        let face = |(face, claim): &(Face, Claim)| StateFace {
            face: face.name().to_string(),
            claim: claim.name().to_owned(),
        };
        let [lower, upper] = self.reach.clone();
        StateDomain {
            time_window: self.window,
            body: body(&self.body),
            motion: StateBox { lower, upper },
            faces: self.faces.iter().map(face).collect(),
            volumes: self.volumes(),
        }
    }
}

/// The body as a part of a document; `None` if there is none.
fn body(extent: &Extent<f64>) -> Option<StateBody> {
    if matches!(extent, Extent::Nothing(_)) {
        return None;
    }
    let mut body = StateBody::default();
    for (bound, values) in parts(extent, 0.0) {
        match bound {
            Bound::Lower => body.lower = Some(values),
            Bound::Upper => body.upper = Some(values),
            Bound::Inner => body.inner = values.first().copied(),
            Bound::Outer => body.outer = values.first().copied(),
            Bound::Theta => body.theta = values.try_into().ok(),
            Bound::Z => body.z = values.try_into().ok(),
            Bound::Phi => body.phi = values.try_into().ok(),
            Bound::Vertices => {
                body.vertices = Some(values.chunks_exact(2).map(<[f64]>::to_vec).collect());
            }
            Bound::Space | Bound::Time => {}
        }
    }
    Some(body)
}

/// The least and the greatest coordinates of samples of the body, including its corners, over the time window.
fn reach(exact: &mut Exact) -> anyhow::Result<[Vec<f64>; 2]> {
    let dimension = exact.dimension;
    let along = ALONG[dimension - 1];
    let fraction = |index: usize, count: usize| index as f64 / (count - 1) as f64;
    let sample = |mut index: usize| {
        let mut fractions = [0.0; 3];
        for axis in 0..dimension {
            fractions[axis] = fraction(index % along, along);
            index /= along;
        }
        exact.body.point(&fractions)
    };
    let mut points: Vec<f64> = (0..along.pow(dimension as u32)).flat_map(sample).collect();
    if let Extent::Polygon(vertices) = &exact.body {
        points.extend(vertices.iter().flatten());
    }
    let [first, last] = exact.window;
    let (mut lower, mut upper) =
        (vec![f64::INFINITY; dimension], vec![f64::NEG_INFINITY; dimension]);
    for index in 0..TIMES {
        let time = first + (last - first) * fraction(index, TIMES);
        let components = exact.components(Quantity::Position);
        for position in exact.values(Quantity::Position, time, &points)?.chunks(components) {
            // Under a swirl a point leaves its meridian, so its distance from the axis counts.
            let mut position = position.to_vec();
            position[0] = position[dimension..].iter().fold(position[0], |r, it| r.hypot(*it));
            for axis in 0..dimension {
                lower[axis] = lower[axis].min(position[axis]);
                upper[axis] = upper[axis].max(position[axis]);
            }
        }
    }
    Ok([lower, upper])
}
