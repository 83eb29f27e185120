//! Bodies filled with particles, in double precision.

mod annulus;
mod cuboid;

use std::fmt;
use std::str::FromStr;

use crate::extension::UnknownName;
use crate::failure::Refusal;
use crate::failure::{at_most, positive};
use crate::field::{Body, Face};
use crate::real::{Matrix, Real, Vector};
use annulus::Sector;

/// More particles than this are refused.
const PARTICLE_LIMIT: f64 = (1u64 << 27) as f64;

/// How particles are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fill {
    /// On a lattice of boxes; a curved face cuts it ragged.
    Cartesian,
    /// In rings along the faces of an annulus; in a box the same as `Cartesian`.
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
    /// Its middle.
    pub position: Vector<f64, D>,
    /// Area times outward normal.
    pub area: Vector<f64, D>,
}

/// A body full of particles in the reference configuration; entry `p` belongs to particle `p`.
#[derive(Clone, Debug, Default)]
pub struct Filling<const D: usize> {
    /// X.
    pub position: Vec<Vector<f64, D>>,
    /// V0. They add up to the volume of a box and of a fitted annulus.
    pub volume: Vec<f64>,
    /// The columns are half the edges of each domain.
    pub half_edges: Vec<Matrix<f64, D>>,
    /// The pieces of all faces that particles lie along. A ragged face has none.
    pub pieces: Vec<Piece<D>>,
}

impl<const D: usize> Filling<D> {
    /// Fills a body, with about `spacing` between particles along each axis: as many of them as make their
    /// domains fill it without gap or overlap.
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
            (Body::Annulus { inner, outer, theta }, fill) => {
                let sector = Sector::new([*inner, *outer], *theta);
                match fill {
                    Fill::Cartesian => sector.fill_cartesian(spacing),
                    Fill::Fitted => sector.fill_fitted(spacing),
                }
            }
        };
        positive("the number of particles", filling.len() as f64)?;
        Ok(filling)
    }

    /// How many particles there are.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there is no particle.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Moves each particle within its domain, by up to `fraction` of half its edges, at random. Domains,
    /// volumes and pieces of faces stay.
    pub fn jitter(&mut self, fraction: f64, seed: u64) {
        let mut random = fastrand::Rng::with_seed(seed);
        for (position, half_edges) in self.position.iter_mut().zip(&self.half_edges) {
            let shift = Vector::<f64, D>::from_fn(|_, _| 2.0 * random.f64() - 1.0);
            *position += half_edges * shift * fraction;
        }
    }
}

/// The faces that a body has.
pub(crate) fn faces<T: Real, const D: usize>(body: &Body<T, D>) -> Vec<Face> {
    match body {
        Body::Box { .. } => (0..D).flat_map(|a| [Face::Min(a), Face::Max(a)]).collect(),
        Body::Annulus { inner, outer, theta } => {
            let all = [Face::Inner, Face::Outer, Face::ThetaMin, Face::ThetaMax];
            let ring = Sector::new([*inner, *outer], *theta).is_ring();
            all[..if ring { 2 } else { 4 }].to_vec()
        }
    }
}

/// Lower and upper corner of the smallest box around a body.
///
/// # Errors
/// An edge that is not positive and finite.
pub fn bounding_box<T: Real, const D: usize>(
    body: &Body<T, D>,
) -> Result<[Vector<f64, D>; 2], Refusal> {
    let corners = match body {
        Body::Box { lower, upper } => [lower.map(Real::to_f64), upper.map(Real::to_f64)],
        Body::Annulus { inner, outer, theta } => {
            let sector = Sector::new([*inner, *outer], *theta);
            positive("the thickness of the annulus", sector.outer - sector.inner)?;
            sector.bounding_box()
        }
    };
    for edge in (corners[1] - corners[0]).iter() {
        positive("an edge of the body", *edge)?;
    }
    Ok(corners)
}
