//! Bodies filled with particles, in double precision.

mod cuboid;
mod polygon;
pub mod round;

use std::fmt;
use std::str::FromStr;

use crate::extension::UnknownName;
use crate::failure::Refusal;
use crate::failure::{at_most, positive};
use crate::field::{Body, Face};
use crate::real::{Matrix, Real, Vector};
use mms_math::coordinates::System;
use polygon::Polygon;
use round::Block;

/// The largest number of particles of a body.
const PARTICLE_LIMIT: f64 = (1u64 << 27) as f64;

/// The layout of particles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    /// On a lattice of boxes; a curved face cuts it ragged.
    Cartesian,
    /// Along the faces; in a box equal to `Cartesian`.
    Fitted,
}

impl Fill {
    /// The names that users write.
    pub const NAMES: &'static [&'static str] = &["cartesian", "fitted"];
}

impl fmt::Display for Fill {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Fill::Cartesian => "cartesian",
            Fill::Fitted => "fitted",
        })
    }
}

impl FromStr for Fill {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "cartesian" => Ok(Fill::Cartesian),
            "fitted" => Ok(Fill::Fitted),
            _ => Err(UnknownName { what: "fill", given: text.to_owned(), known: Self::NAMES }),
        }
    }
}

/// A piece of a face, carried by the particle next to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece<const D: usize> {
    /// The face.
    pub face: Face,
    /// The particle.
    pub particle: usize,
    /// The middle of the piece.
    pub position: Vector<f64, D>,
    /// Area times outward normal.
    pub area: Vector<f64, D>,
}

/// A body full of particles in the reference configuration; entry `p` belongs to particle `p`.
#[derive(Clone, Debug, Default)]
pub struct Filling<const D: usize> {
    /// X.
    pub position: Vec<Vector<f64, D>>,
    /// V0. The sum is the volume of the body if it is a box or if particles are fitted to it.
    pub volume: Vec<f64>,
    /// The columns are half the edges of each domain.
    pub half_edges: Vec<Matrix<f64, D>>,
    /// The pieces of all faces that particles lie along. A ragged face has none.
    pub pieces: Vec<Piece<D>>,
}

impl<const D: usize> Filling<D> {
    /// Fills a body with particles about `spacing` apart along each axis: as many as make their domains fill the body without
    /// gap or overlap.
    ///
    /// # Errors
    /// The body has no extent, or takes too many particles.
    pub fn new<T: Real>(
        body: &Body<T, D>,
        fill: Fill,
        spacing: &Vector<f64, D>,
    ) -> Result<Self, Refusal> {
        let [lower, upper] = bounding_box(body)?;
        let most: f64 = (upper - lower).component_div(spacing).iter().product();
        at_most("particles", most.round(), PARTICLE_LIMIT)?;
        let filling = match (body, fill) {
            (Body::Box { .. }, _) => cuboid::fill(&lower, &upper, spacing),
            (body, fill) => match (Region::of(body)?, fill) {
                (Region::Round(block), Fill::Cartesian) => block.fill_cartesian(spacing),
                (Region::Round(block), Fill::Fitted) => block.fill_fitted(spacing),
                (Region::Polygon(polygon), Fill::Cartesian) => polygon.fill_cartesian(spacing),
                (Region::Polygon(polygon), Fill::Fitted) => polygon.fill_fitted(spacing),
            },
        };
        positive("the number of particles", filling.len() as f64)?;
        Ok(filling)
    }

    /// The number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is no particle.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Moves each particle at random within its domain, by up to `fraction` of half its edges. Does not change domains, volumes
    /// or pieces of faces.
    pub fn jitter(&mut self, fraction: f64, seed: u64) {
        let mut random = fastrand::Rng::with_seed(seed);
        for (position, half_edges) in self.position.iter_mut().zip(&self.half_edges) {
            let shift = Vector::<f64, D>::from_fn(|_, _| 2.0 * random.f64() - 1.0);
            *position += half_edges * shift * fraction;
        }
    }
}

/// A body other than a box, in double precision.
enum Region<'a> {
    Round(Block),
    Polygon(Polygon<'a>),
}

impl<'a> Region<'a> {
    /// The region of a body other than a box.
    ///
    /// # Errors
    /// There is no body.
    fn of<T: Real, const D: usize>(body: &'a Body<T, D>) -> Result<Self, Refusal> {
        let pair = |pair: &[T; 2]| pair.map(Real::to_f64);
        let round = |system: System, radii: [&T; 2], others: &[&[T; 2]]| {
            let radii = radii.map(|radius| radius.to_f64());
            let bounds = [radii].into_iter().chain(others.iter().map(|it| pair(it))).collect();
            Ok(Region::Round(Block { system, bounds }))
        };
        match body {
            Body::Annulus { inner, outer, theta } => round(System::Polar, [inner, outer], &[theta]),
            Body::Cylinder { inner, outer, theta, z } => {
                round(System::Polar, [inner, outer], &[theta, z])
            }
            Body::Sphere { inner, outer, theta, phi } => {
                round(System::Spherical, [inner, outer], &[theta, phi])
            }
            Body::Polygon { vertices, names } => Ok(Region::Polygon(Polygon {
                vertices: vertices.iter().map(pair).collect(),
                names,
            })),
            Body::Box { .. } | Body::Nothing => Err(Refusal::NoBody),
        }
    }
}

/// The bounds of a round body in radius and angles; `None` for other bodies.
pub fn block<T: Real, const D: usize>(body: &Body<T, D>) -> Option<Block> {
    match Region::of(body) {
        Ok(Region::Round(block)) => Some(block),
        _ => None,
    }
}

/// The faces that a body has.
pub fn faces<T: Real, const D: usize>(body: &Body<T, D>) -> Vec<Face> {
    match body {
        Body::Box { .. } => (0..D).flat_map(|a| [Face::Min(a), Face::Max(a)]).collect(),
        body => match Region::of(body) {
            Ok(Region::Round(block)) => block.faces(),
            Ok(Region::Polygon(polygon)) => polygon.faces(),
            Err(_) => Vec::new(),
        },
    }
}

/// Lower and upper corner of the smallest box around a body.
///
/// # Errors
/// There is no body, or an edge is not positive and finite.
pub fn bounding_box<T: Real, const D: usize>(
    body: &Body<T, D>,
) -> Result<[Vector<f64, D>; 2], Refusal> {
    let corners = match body {
        Body::Box { lower, upper } => [lower.map(Real::to_f64), upper.map(Real::to_f64)],
        body => match Region::of(body)? {
            Region::Round(block) => {
                let [inner, outer] = block.bounds[0];
                let thickness = match D {
                    2 => "the thickness of the annulus",
                    _ => "the thickness of the body",
                };
                positive(thickness, outer - inner)?;
                for [from, to] in &block.bounds[1..] {
                    positive("what the body extends along an angle or its axis", to - from)?;
                }
                let corners = block.system.bounding_box(&block.bounds);
                corners.map(|corner| Vector::from_fn(|axis, _| corner[axis]))
            }
            Region::Polygon(polygon) => polygon.bounding_box(),
        },
    };
    for edge in (corners[1] - corners[0]).iter() {
        positive("an edge of the body", *edge)?;
    }
    Ok(corners)
}

/// Boxes of one size, laid out from the lower corner, whose middles lie inside.
fn lattice<const D: usize>(
    [lower, upper]: [Vector<f64, D>; 2],
    spacing: &Vector<f64, D>,
    is_inside: impl Fn(&Vector<f64, D>) -> bool,
) -> Filling<D> {
    let mut filling = Filling::default();
    let half = spacing / 2.0;
    let count: [usize; D] =
        std::array::from_fn(|a| ((upper[a] - lower[a]) / spacing[a]).ceil() as usize + 1);
    for k in 0..count.iter().product() {
        let stride = |a: usize| count[..a].iter().product::<usize>();
        let index = |a: usize| k / stride(a) % count[a];
        let middle = Vector::from_fn(|a, _| lower[a] + (2 * index(a) + 1) as f64 * half[a]);
        if is_inside(&middle) {
            filling.position.push(middle);
            filling.volume.push(spacing.iter().product());
            filling.half_edges.push(Matrix::from_diagonal(&half));
        }
    }
    filling
}
