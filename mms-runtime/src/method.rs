//! A method: everything about a run except the field and the number of cells.

use std::fmt;
use std::str::FromStr;

use crate::body::Fill;
use crate::failure::Refusal;
use crate::formulation::FormulationName;
use crate::integrator::{Integrator, IntegratorName, IntegratorVisitor};
use crate::shape::ShapeName;
use crate::shape::{Shape, ShapeVisitor};
use crate::transfer::Transfer;

/// The largest supported number of threads.
const MOST_THREADS: f64 = 1024.0;

/// Numbers of cells, or of particles per cell, along the axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Division {
    /// One number: of cells along the longest edge, all of them cubes; of particles along every axis.
    Uniform(usize),
    /// One number for each of this many axes, the first axis first; further entries are unused.
    PerAxis([usize; 3], usize),
}

impl Division {
    /// The number along an axis.
    pub fn along(&self, axis: usize) -> usize {
        match *self {
            Division::Uniform(number) => number,
            Division::PerAxis(numbers, _) => numbers[axis],
        }
    }

    /// The numbers, as given.
    pub fn numbers(&self) -> Vec<usize> {
        match *self {
            Division::Uniform(number) => vec![number],
            Division::PerAxis(numbers, given) => numbers[..given].to_vec(),
        }
    }
}

impl From<usize> for Division {
    fn from(number: usize) -> Self {
        Division::Uniform(number)
    }
}

impl fmt::Display for Division {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let numbers: Vec<String> = self.numbers().iter().map(usize::to_string).collect();
        f.pad(&numbers.join("x"))
    }
}

/// A text that is no [`Division`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected a number from 1, or one per axis as in `32x16`; found `{given}`")]
pub struct NoDivision {
    given: String,
}

impl FromStr for Division {
    type Err = NoDivision;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let error = || NoDivision { given: text.to_owned() };
        let number = |text: &str| text.parse().ok().filter(|&number: &usize| number > 0);
        let numbers: Option<Vec<usize>> = text.split('x').map(number).collect();
        match numbers.as_deref() {
            Some(&[number]) => Ok(Division::Uniform(number)),
            Some(&[first, second]) => Ok(Division::PerAxis([first, second, 1], 2)),
            Some(&[first, second, third]) => Ok(Division::PerAxis([first, second, third], 3)),
            _ => Err(error()),
        }
    }
}

/// The parameters of a method that need no type.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// The update of the particles' velocity from the grid.
    pub transfer: Transfer,
    /// Particles per cell along each axis.
    pub particles_per_cell: Division,
    /// The fill of the body; by default along the faces of an annulus.
    pub fill: Option<Fill>,
    /// The largest random displacement of each particle, as a fraction of half its domain.
    pub jitter: f64,
    /// The seed of the random numbers.
    pub seed: u64,
    /// The shift of the grid against the body along each axis, in cells.
    pub offset: [f64; 3],
    /// The axes along which the body repeats itself, instead of having faces.
    pub periodic: [bool; 3],
    /// time_step * c0 / shortest edge of a cell, c0 being the fastest wave speed at F = I.
    pub courant: f64,
    /// The time step, instead of one computed from the Courant number.
    pub time_step: Option<f64>,
    /// The number of parts, with equal numbers of steps, that the run is divided into.
    pub parts: usize,
    /// The proved bound of the wave speeds, in the frame of the grid: a run is refused if its time step lets such a wave cross
    /// the shortest edge of a cell. `None` refuses no run.
    pub fastest_wave: Option<f64>,
    /// The end of the run, instead of the end of the field's time window.
    pub end_time: Option<f64>,
    /// Whether the run computes the equilibrium of a field that does not move, by dynamic relaxation, however long that takes.
    /// If so, `end_time` and `parts` are ignored.
    pub relax: bool,
    /// The number of threads of one run, from 1. Results do not depend on it.
    pub threads: usize,
    /// The largest memory of a run in bytes; `None` for no limit.
    pub memory: Option<u64>,
}

impl Setup {
    /// Refuses parameters outside their ranges.
    pub(crate) fn validate(&self) -> Result<(), Refusal> {
        let within = |what, value: f64, from, to| {
            let inside = (from..=to).contains(&value);
            inside.then_some(()).ok_or(Refusal::OutOfRange { what, value, from, to })
        };
        if let Transfer::Flip { fraction } = self.transfer {
            within("the fraction of FLIP", fraction, 0.0, 1.0)?;
        }
        within("the number of threads", self.threads as f64, 1.0, MOST_THREADS)?;
        within("the jitter", self.jitter, 0.0, 1.0)?;
        self.offset.iter().try_for_each(|&part| within("the grid's offset", part, 0.0, 1.0))
    }
}

impl Default for Setup {
    /// FLIP, 2 particles per cell and axis, Courant number 0.4, the field's time window.
    fn default() -> Self {
        Self {
            transfer: Transfer::FLIP,
            particles_per_cell: Division::Uniform(2),
            fill: None,
            jitter: 0.0,
            seed: 0,
            offset: [0.0; 3],
            periodic: [false; 3],
            courant: 0.4,
            time_step: None,
            parts: 1,
            fastest_wave: None,
            end_time: None,
            relax: false,
            threads: 1,
            memory: None,
        }
    }
}

/// A method: all settings that do not change between the levels of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Method {
    /// The shape function.
    pub shape: ShapeName,
    /// The time integrator.
    pub integrator: IntegratorName,
    /// The formulation.
    pub formulation: FormulationName,
    /// All other settings.
    pub setup: Setup,
}

impl Method {
    /// Refuses combinations without a meaning, and names the nearest that has one.
    ///
    /// # Errors
    /// A shape function whose domain follows the deformation, in a formulation where nothing moves; a relaxation with an
    /// integrator that uses several velocities.
    pub fn validate(&self) -> Result<(), Refusal> {
        struct Follows;
        impl ShapeVisitor for Follows {
            type Output = bool;
            fn visit<S: Shape>(self) -> bool {
                S::FOLLOWS
            }
        }
        let follows = self.shape.visit(Follows);
        if self.formulation == FormulationName::Total && follows {
            return Err(Refusal::NothingToFollow { shape: self.shape.name() });
        }
        struct Together;
        impl IntegratorVisitor for Together {
            type Output = bool;
            fn visit<I: Integrator>(self) -> bool {
                !I::KEEPS_WEIGHTS
            }
        }
        if self.setup.relax && !self.integrator.visit(Together) {
            return Err(Refusal::PartsInRelaxation { integrator: self.integrator.name() });
        }
        Ok(())
    }
}

impl Default for Method {
    /// Contiguous-particle GIMP and leapfrog, updated.
    fn default() -> Self {
        Self {
            shape: ShapeName::Cpgimp,
            integrator: IntegratorName::Leapfrog,
            formulation: FormulationName::Updated,
            setup: Setup::default(),
        }
    }
}
