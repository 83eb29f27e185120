//! Exact states of a field, at any points and times, for any solver.
//!
//! [`points`] determines the points: X from a file, the particles of a grid, or the material points at given present places
//! x ([`inverse_motion`](mms_analysis::inverse_motion)). [`State`]s contain the field's quantities there, and [`file`](mod@file)
//! writes them; [`domain`] adds the data that a solver needs once.

pub mod domain;
pub mod file;
pub mod points;

use anyhow::{bail, ensure};
use mms_exact::Exact;
use mms_files::machine::memory;
use mms_files::words::bytes;
use mms_judge::results::axes;
use mms_results::write::{ArrayShape, Column, State};
use mms_spec::Face;
use mms_spec::quantity::{self, Quantity};

use self::domain::Domain;
use self::points::Points;

/// A term that is withheld from a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WithheldTerm {
    /// b, in all its forms.
    BodyForce,
    /// All stresses, and the quantities that follow from them: divergences, pressure.
    Stress,
    /// Tractions on the faces.
    Traction,
}

impl WithheldTerm {
    /// All terms.
    pub const ALL: [WithheldTerm; 3] =
        [WithheldTerm::BodyForce, WithheldTerm::Stress, WithheldTerm::Traction];

    /// The term of this name.
    pub fn from_name(name: &str) -> Option<WithheldTerm> {
        WithheldTerm::ALL.into_iter().find(|term| term.name() == name)
    }

    /// A description of the term.
    pub fn says(self) -> &'static str {
        match self {
            WithheldTerm::BodyForce => "b, in all its forms",
            WithheldTerm::Stress => {
                "All stresses, and what follows from them: divergences, pressure"
            }
            WithheldTerm::Traction => "Tractions on the faces",
        }
    }

    /// The name of the term in commands.
    pub fn name(self) -> &'static str {
        match self {
            WithheldTerm::BodyForce => "body_force",
            WithheldTerm::Stress => "stress",
            WithheldTerm::Traction => "traction",
        }
    }

    /// The term that a quantity belongs to.
    fn of(quantity: Quantity) -> Option<WithheldTerm> {
        match quantity {
            Quantity::BodyForce
            | Quantity::BodyForceDensity
            | Quantity::CurrentBodyForceDensity => Some(WithheldTerm::BodyForce),
            Quantity::FirstPiolaKirchhoff
            | Quantity::NominalStress
            | Quantity::CauchyStress
            | Quantity::KirchhoffStress
            | Quantity::SecondPiolaKirchhoff
            | Quantity::Pressure
            | Quantity::VonMises
            | Quantity::DivP
            | Quantity::DivSigma => Some(WithheldTerm::Stress),
            Quantity::Traction => Some(WithheldTerm::Traction),
            _ => None,
        }
    }
}

/// The names of columns: symbols in tables and NumPy, words in VTK, as `mms run --vtk` writes them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Names {
    /// X, u, F.
    Symbols,
    /// reference_position, displacement, deformation_gradient.
    Words,
}

impl Names {
    fn of(self, quantity: Quantity) -> &'static str {
        match (self, quantity) {
            (Names::Words, _) | (_, Quantity::Own(_)) => quantity.name(),
            (Names::Symbols, Quantity::MassDensity) => "density",
            (Names::Symbols, _) => quantity.symbol(),
        }
    }

    fn reference(self) -> &'static str {
        match self {
            Names::Symbols => "X",
            Names::Words => "reference_position",
        }
    }
}

/// The quantities of a state if the user names none.
pub const USUAL: [Quantity; 9] = [
    Quantity::Position,
    Quantity::Displacement,
    Quantity::Velocity,
    Quantity::DeformationGradient,
    Quantity::FirstPiolaKirchhoff,
    Quantity::CauchyStress,
    Quantity::MassDensity,
    Quantity::BodyForce,
    Quantity::Traction,
];

/// The requested content of a state.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<'a> {
    /// The quantities; tractions belong to the faces that have points.
    pub quantities: &'a [Quantity],
    /// Terms that are set to 0.
    pub without: &'a [WithheldTerm],
    /// The names of columns.
    pub names: Names,
    /// The data of the field that a solver needs once.
    pub domain: &'a Domain,
}

impl Wanted<'_> {
    /// Refuses states at this many times if they do not fit into free memory.
    ///
    /// # Errors
    /// The memory that they need, and the free memory.
    pub fn validate_memory(
        &self,
        exact: &Exact,
        points: &Points,
        times: usize,
    ) -> anyhow::Result<()> {
        let points = points.reference.len() / exact.dimension;
        let numbers: usize = self.quantities.iter().map(|it| exact.components(*it)).sum();
        // X and x for the file, two volumes and the mass.
        let numbers = numbers + 2 * exact.dimension + 3;
        let need = 8.0 * numbers as f64 * points as f64 * times as f64;
        ensure!(
            need < memory() as f64,
            "{points} points at {times} times take {} of memory, and {} are free; give fewer at once",
            bytes(need),
            bytes(memory() as f64)
        );
        Ok(())
    }

    /// The exact state at points X.
    ///
    /// # Errors
    /// A quantity that is not finite somewhere.
    pub fn state(&self, exact: &mut Exact, points: &Points, time: f64) -> anyhow::Result<State> {
        let dimension = exact.dimension;
        let mut columns = vec![Column {
            name: self.names.reference().into(),
            shape: ArrayShape::Vector,
            values: points.reference.clone(),
        }];
        for &quantity in self.quantities {
            match quantity {
                // The points of VTK are x.
                Quantity::Position if self.names == Names::Words => {}
                _ if quantity.takes_normal() => {
                    for (face, on_face) in points.faces(exact) {
                        let values =
                            self.on_face(quantity, exact, points, (face, &on_face), time)?;
                        let name = format!("{}_{}", quantity.name(), face.name());
                        columns.push(Column { name, shape: shape(quantity, exact), values });
                    }
                }
                _ => {
                    let values = exact.values(quantity, time, &points.reference)?;
                    let values =
                        self.held(quantity, values, (&points.reference, dimension), time)?;
                    let name = self.names.of(quantity).to_owned();
                    columns.push(Column { name, shape: shape(quantity, exact), values });
                }
            }
        }
        columns.extend(weights(exact, points, time)?);
        let axes = axes(&exact.input().compiled.field);
        Ok(State { time, dimension, axes, facts: self.domain.facts(), columns })
    }

    /// The values of a quantity that depends on a normal, at the points of a face; 0 at all others.
    fn on_face(
        &self,
        quantity: Quantity,
        exact: &mut Exact,
        points: &Points,
        (face, on_face): (Face, &[usize]),
        time: f64,
    ) -> anyhow::Result<Vec<f64>> {
        let dimension = exact.dimension;
        let place = |point: &usize| &points.reference[point * dimension..][..dimension];
        let places: Vec<f64> = on_face.iter().flat_map(place).copied().collect();
        let found = exact.on_face(quantity, face, time, &places)?;
        let found = self.held(quantity, found, (&places, dimension), time)?;
        let components = exact.components(quantity);
        let mut all = vec![0.0; points.reference.len() / dimension * components];
        for (point, value) in on_face.iter().zip(found.chunks(components)) {
            all[point * components..][..components].copy_from_slice(value);
        }
        Ok(all)
    }

    /// The values, or 0 if their term is withheld.
    fn held(
        &self,
        quantity: Quantity,
        mut values: Vec<f64>,
        (points, dimension): (&[f64], usize),
        time: f64,
    ) -> anyhow::Result<Vec<f64>> {
        if WithheldTerm::of(quantity).is_some_and(|term| self.without.contains(&term)) {
            values.fill(0.0);
        }
        let components = values.len() * dimension / points.len().max(1);
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            bail!(
                "{} is {} at X = {:?}, t = {time}: not defined there, or beyond the range of f64",
                quantity.name(),
                values[at],
                &points[at / components * dimension..][..dimension]
            );
        }
        Ok(values)
    }
}

fn shape(quantity: Quantity, exact: &Exact) -> ArrayShape {
    match quantity.shape() {
        quantity::Shape::Tensor if exact.rows() > exact.dimension => ArrayShape::Nine,
        quantity::Shape::Scalar => ArrayShape::Scalar,
        quantity::Shape::Vector if exact.space().vector() > exact.dimension => ArrayShape::Three,
        quantity::Shape::Vector => ArrayShape::Vector,
        quantity::Shape::Tensor => ArrayShape::Tensor,
    }
}

/// The present and the reference volume, which are equal at small strain, and the mass, if volumes are known: mass = density x
/// volume, if the field has a density. Volumes and masses of rings are per radian.
fn weights(exact: &mut Exact, points: &Points, time: f64) -> anyhow::Result<Vec<Column>> {
    let Some(reference) = &points.volume else { return Ok(Vec::new()) };
    let stretched = match exact.is_small_strain() {
        true => vec![1.0; reference.len()],
        false => exact.values(Quantity::Jacobian, time, &points.reference)?,
    };
    let times = |factor: &[f64]| reference.iter().zip(factor).map(|(a, b)| a * b).collect();
    let column =
        |name: &str, values| Column { name: name.into(), shape: ArrayShape::Scalar, values };
    let mut columns =
        vec![column("volume", times(&stretched)), column("reference_volume", reference.clone())];
    if exact.input().compiled.model.has_density {
        columns.push(column("mass", times(&exact.densities(&points.reference)?)));
    }
    Ok(columns)
}
