//! A field of any dimension, ready for a solver.

use crate::axisymmetric::{Rings, Station};
use crate::body::bounding_box;
use crate::failure::Refusal;
use crate::field::{Body, ManufacturedField};
use crate::method::{Division, Method, Setup};
use crate::real::Real;
use crate::solver::{cell_size, filling};
use crate::study::{Observer, Solve, Watch};
use crate::study::{Run, StudyLevel};

/// The default number of cells along the longest edge of a run, in one to three dimensions.
pub fn usual_cells(dimension: usize) -> usize {
    [32, 16, 8][dimension - 1]
}

/// A field of one, two or three dimensions in the precision `T`.
pub enum Scene<T> {
    /// A bar.
    Line(Box<dyn ManufacturedField<T, 1>>),
    /// A plane body.
    Plane(Box<dyn ManufacturedField<T, 2>>),
    /// A body in space.
    Space(Box<dyn ManufacturedField<T, 3>>),
}

impl<T: Real> From<Box<dyn ManufacturedField<T, 1>>> for Scene<T> {
    fn from(field: Box<dyn ManufacturedField<T, 1>>) -> Self {
        Scene::Line(field)
    }
}

impl<T: Real> From<Box<dyn ManufacturedField<T, 2>>> for Scene<T> {
    fn from(field: Box<dyn ManufacturedField<T, 2>>) -> Self {
        Scene::Plane(field)
    }
}

impl<T: Real> From<Box<dyn ManufacturedField<T, 3>>> for Scene<T> {
    fn from(field: Box<dyn ManufacturedField<T, 3>>) -> Self {
        Scene::Space(field)
    }
}

/// A field that was compiled into a program.
#[derive(Clone, Copy, Debug)]
pub struct Code {
    /// The name: the stem of the field's file.
    pub name: &'static str,
    /// Creates the field in single precision, for parameter values in the order of the file; `None` if their number is wrong.
    pub single: fn(&[f32]) -> Option<Scene<f32>>,
    /// Creates the field in double precision, likewise.
    pub double: fn(&[f64]) -> Option<Scene<f64>>,
}

/// The [`Code`] of a module that `field!` made.
#[macro_export]
macro_rules! code {
    ($module:ident) => {
        $crate::scene::Code {
            name: stringify!($module),
            single: |values| {
                let parameters = $module::Parameters::from_array(values.try_into().ok()?);
                Some($crate::scene::Scene::from($module::prepare(&parameters).boxed()))
            },
            double: |values| {
                let parameters = $module::Parameters::from_array(values.try_into().ok()?);
                Some($crate::scene::Scene::from($module::prepare(&parameters).boxed()))
            },
        }
    };
}

/// A precision in which solvers exist for all dimensions.
pub trait Solvable: Solve<1> + Solve<2> + Solve<3> {}

impl<T: Solve<1> + Solve<2> + Solve<3>> Solvable for T {}

impl<T> Scene<T> {
    /// The default levels of a study: cells along the longest edge of the body.
    pub fn default_cells(&self) -> &'static [usize] {
        match self {
            Scene::Line(_) => &[8, 16, 32, 64, 128],
            Scene::Plane(_) => &[8, 16, 32, 64],
            Scene::Space(_) => &[4, 8, 16],
        }
    }

    /// The default grid of a study in time. It is fine: the error of a map to the grid and back in each step is of the order
    /// h^2 dt, and has to be less than the error of time.
    pub fn cells_of_a_study_in_time(&self) -> usize {
        match self {
            Scene::Line(_) => 128,
            Scene::Plane(_) => 32,
            Scene::Space(_) => 8,
        }
    }
}

impl<T: Real> Scene<T> {
    /// The edges of a box; `None` for another body.
    pub fn edges(&self) -> Option<Vec<f64>> {
        match self {
            Scene::Line(field) => edges(field.domain().body),
            Scene::Plane(field) => edges(field.domain().body),
            Scene::Space(field) => edges(field.domain().body),
        }
    }

    /// The particles that a run on such a grid starts from.
    ///
    /// # Errors
    /// A body or a grid cannot be filled.
    pub fn layout(&self, setup: &Setup, cells: &Division) -> Result<Layout, Refusal> {
        match self {
            Scene::Line(field) => layout(&field.domain().body, setup, cells, None),
            Scene::Plane(field) => {
                let of_middle = Rings { station: Station::Middle, weight: &|middle| middle };
                let rings = field.axisymmetric().map(|_| of_middle);
                layout(&field.domain().body, setup, cells, rings)
            }
            Scene::Space(field) => layout(&field.domain().body, setup, cells, None),
        }
    }

    /// The longest edge of a cell of such a grid, which is the length h of a level of a study; 0 if there is none.
    pub fn cell_size(&self, cells: &Division) -> f64 {
        match self {
            Scene::Line(field) => longest_edge(&field.domain().body, cells),
            Scene::Plane(field) => longest_edge(&field.domain().body, cells),
            Scene::Space(field) => longest_edge(&field.domain().body, cells),
        }
    }
}

/// Particles in the reference configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// X; the coordinates of a particle are adjacent.
    pub reference: Vec<f64>,
    /// V0.
    pub volume: Vec<f64>,
}

fn layout<T: Real, const D: usize>(
    body: &Body<T, D>,
    setup: &Setup,
    cells: &Division,
    rings: Option<Rings<'_>>,
) -> Result<Layout, Refusal> {
    let filling = filling(body, setup, cells, rings)?;
    let reference = filling.position.iter().flat_map(|position| position.iter().copied());
    Ok(Layout { reference: reference.collect(), volume: filling.volume })
}

fn edges<T: Real, const D: usize>(body: Body<T, D>) -> Option<Vec<f64>> {
    match body {
        Body::Box { lower, upper } => {
            Some((upper - lower).iter().map(|edge| edge.to_f64()).collect())
        }
        _ => None,
    }
}

fn longest_edge<T: Real, const D: usize>(body: &Body<T, D>, cells: &Division) -> f64 {
    let size = bounding_box(body).and_then(|[lower, upper]| cell_size(&(upper - lower), cells));
    size.map_or(0.0, |size| size.max())
}

impl<T: Solvable> Scene<T> {
    /// Runs a method on the field; see [`Solve::run`].
    ///
    /// # Errors
    /// The scene cannot be started.
    pub fn run(
        &self,
        method: &Method,
        cells: &Division,
        watch: Watch,
        observer: &mut dyn Observer,
    ) -> Result<Run, Refusal> {
        match self {
            Scene::Line(field) => T::run(field.as_ref(), method, cells, watch, observer),
            Scene::Plane(field) => T::run(field.as_ref(), method, cells, watch, observer),
            Scene::Space(field) => T::run(field.as_ref(), method, cells, watch, observer),
        }
    }

    /// Runs one level of a study; see [`crate::run_level`].
    ///
    /// # Errors
    /// The scene cannot be started.
    pub fn run_level(
        &self,
        method: &Method,
        cells: &Division,
        observer: &mut dyn Observer,
    ) -> Result<StudyLevel, Refusal> {
        self.run(method, cells, Watch::Displacement, observer).map(|run| run.level)
    }
}
