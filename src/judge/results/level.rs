//! The errors of one snapshot.

use std::borrow::Cow;

use anyhow::{anyhow, bail};
use mms_results::motion::{Motion, hold_distinct, resolve};
use mms_results::names::{Mapping, Meaning, Role, Values, recognise};
use mms_results::norm::{Asked, Mesh, lengths, over_points};
use mms_results::{Mistake, Snapshot, Stored};
use mms_spec::quantity::Quantity;

use super::files::placed;
use crate::session::exact::Exact;

/// Over what a norm is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Over points, all alike.
    Points,
    /// Over points, by their weights.
    Weighted,
    /// Over the body, by quadrature over cells.
    Cells,
    /// Over the middles of cells.
    Middles,
}

impl Sampling {
    /// The norms, and why they are these.
    pub fn says(self) -> &'static str {
        match self {
            Sampling::Points => {
                "mean (l1), root mean square (l2) and maximum (linf) over points, which carry no weight"
            }
            Sampling::Weighted => {
                "l1, l2 and linf over points, means by the weight that was asked for"
            }
            Sampling::Cells => {
                "l1, l2 and linf over the body, and the seminorm of H1 where the gradient is known, by quadrature over \
                 cells, for the mesh is known"
            }
            Sampling::Middles => {
                "l1, l2 and linf over the middles of cells, for there is one value in each; values there may be more \
                 accurate than elsewhere (superconvergence)"
            }
        }
    }

    /// Its name in a document.
    pub fn name(self) -> &'static str {
        match self {
            Sampling::Points => "points",
            Sampling::Weighted => "weighted points",
            Sampling::Cells => "cells",
            Sampling::Middles => "middles of cells",
        }
    }
}

/// An error, and what rounding of the file alone may leave of it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measure {
    /// The error.
    pub error: f64,
    /// The floor.
    pub floor: f64,
}

/// The errors of a quantity in one snapshot.
#[derive(Clone, Debug)]
pub struct Errors {
    /// The quantity.
    pub quantity: Quantity,
    /// Over what.
    pub sampling: Sampling,
    /// By the names of norms.
    pub norms: Vec<(&'static str, Measure)>,
    /// What its values are times the exact ones, where that is a power of ten.
    pub unit: Option<i32>,
    /// How it was stored.
    pub stored: Stored,
}

/// How snapshots are read.
pub struct Reading<'a> {
    /// What the user says of names.
    pub map: &'a [Mapping],
    /// The quantities that are wanted; all, if there are none.
    pub wanted: &'a [Quantity],
    /// Weights of points.
    pub weight: Option<Role>,
}

/// What was found in a snapshot.
pub struct Found {
    /// Errors of quantities.
    pub errors: Vec<Errors>,
    /// The shortest and the longest of the longest edges of cells, where there are such.
    pub sizes: Option<[f64; 2]>,
    /// Points.
    pub points: usize,
    /// The type of cells that are not known, where there are such and no others.
    pub unknown: Option<u8>,
    /// How X was found.
    pub how: String,
    /// Quantities that are there and cannot be judged.
    pub passed_over: Vec<&'static str>,
}

/// What means may be taken by.
///
/// # Errors
/// It is no such column.
pub fn weight(text: &str) -> Result<Role, &'static str> {
    let role = Role::from_name(text).filter(|it| matches!(it, Role::Volume | Role::Mass));
    role.ok_or("expected volume or mass; `--map volume=NAME` says which column that is")
}

/// The quantity of the compiler that this is.
fn quantity(role: Role) -> Option<Quantity> {
    Quantity::from_name(role.name())
}

impl Reading<'_> {
    /// Whether an array of that meaning is needed.
    fn wants(&self, role: Role) -> bool {
        let is_place =
            matches!(role, Role::Reference | Role::Position | Role::Place | Role::Displacement);
        let is_weight = matches!(role, Role::Volume | Role::Mass);
        if is_place || is_weight {
            return is_place || self.weight == Some(role);
        }
        self.wanted.is_empty() || quantity(role).is_some_and(|it| self.wanted.contains(&it))
    }

    /// Measures a snapshot at a time.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn measure(
        &self,
        snapshot: &Snapshot,
        time: f64,
        rounding: f64,
        exact: &mut Exact,
    ) -> anyhow::Result<Found> {
        let dimension = exact.dimension;
        let meanings = recognise(snapshot, self.map, &|role| self.wants(role)).map_err(placed)?;
        let motion = resolve(snapshot, &meanings, dimension, &|point| exact.body.distance(point))
            .map_err(placed)?;
        let cells = &snapshot.cells;
        let mesh = Mesh { cells, points: &motion.reference.numbers, dimension };
        let sizes = mesh.sizes();
        if sizes.is_none() {
            hold_distinct(snapshot, &motion.reference).map_err(placed)?;
        }
        let mut taken = Taken {
            snapshot,
            mesh,
            is_mesh: sizes.is_some(),
            motion: &motion,
            time,
            rounding,
            exact,
        };
        let mut errors = Vec::new();
        let mut passed_over = Vec::new();
        let weights = self.weights(snapshot, &meanings)?;
        for (role, values) in self.values(snapshot, &meanings, &motion, dimension)? {
            match quantity(role) {
                Some(quantity) => {
                    errors.push(taken.errors(quantity, &values, weights.as_deref())?)
                }
                None => passed_over.push(role.name()),
            }
        }
        let points = motion.reference.numbers.len() / dimension;
        let unknown = mesh.unknown().filter(|_| sizes.is_none());
        Ok(Found { errors, sizes, points, unknown, how: motion.how.clone(), passed_over })
    }

    /// What there is to judge: u as it was found, and all others.
    fn values<'a>(
        &self,
        snapshot: &Snapshot,
        meanings: &[Meaning],
        motion: &'a Motion,
        dimension: usize,
    ) -> anyhow::Result<Vec<(Role, Cow<'a, Values>)>> {
        let mut found = Vec::new();
        let wants_u = self.wanted.is_empty() || self.wanted.contains(&Quantity::Displacement);
        let u = motion.displacement.as_ref().filter(|_| wants_u);
        found.extend(u.map(|u| (Role::Displacement, Cow::Borrowed(u))));
        let of_motion =
            [Role::Reference, Role::Place, Role::Displacement, Role::Volume, Role::Mass];
        for meaning in meanings.iter().filter(|it| !of_motion.contains(&it.role)) {
            if meaning.role == Role::Position && !self.wanted.contains(&Quantity::Position) {
                continue;
            }
            let values = meaning.values(snapshot, dimension).map_err(placed)?;
            found.push((meaning.role, Cow::Owned(values)));
        }
        Ok(found)
    }

    fn weights(
        &self,
        snapshot: &Snapshot,
        meanings: &[Meaning],
    ) -> anyhow::Result<Option<Vec<f64>>> {
        let Some(role) = self.weight else { return Ok(None) };
        let meaning = meanings.iter().find(|it| it.role == role).ok_or_else(|| {
            anyhow!(
                "{}: `--weight {name}`: no such column; name it with `--map {name}=..`",
                snapshot.path,
                name = role.name()
            )
        })?;
        let weights = meaning.values(snapshot, 1).map_err(placed)?;
        if let Some(at) = weights.numbers.iter().position(|it| *it < 0.0) {
            bail!(
                "{}: {} is {}; expected a weight of 0 or more",
                snapshot.place(at),
                role.name(),
                weights.numbers[at]
            );
        }
        Ok(Some(weights.numbers))
    }
}

/// A snapshot with what is known of it.
struct Taken<'a> {
    snapshot: &'a Snapshot,
    mesh: Mesh<'a>,
    is_mesh: bool,
    motion: &'a Motion,
    time: f64,
    rounding: f64,
    exact: &'a mut Exact,
}

/// How many times the round-off of double precision a computation has at least.
const ARITHMETIC: f64 = 16.0;

impl Taken<'_> {
    fn errors(
        &mut self,
        quantity: Quantity,
        values: &Values,
        weights: Option<&[f64]>,
    ) -> anyhow::Result<Errors> {
        let components = self.exact.components(quantity);
        let middles;
        let of_cells;
        let (values, places): (&Values, &[f64]) = if values.is_of_cells {
            middles = self.mesh.middles();
            of_cells = self.of_full_cells(values);
            (&of_cells, &middles)
        } else {
            (values, self.mesh.points)
        };
        let rows = values.numbers.len() / components;
        let expected = places.len() / self.mesh.dimension;
        if rows != expected {
            bail!(
                "{}: {} has {rows} values for {expected} points or cells of the dimension of the field",
                self.snapshot.path,
                quantity.name()
            );
        }
        let exact = self.exact.values(quantity, self.time, places)?;
        self.hold_finite(quantity, &exact)?;
        let floor = self.floor(quantity, values, places, &exact)?;
        let sampling = match (values.is_of_cells, self.is_mesh, weights) {
            (true, ..) => Sampling::Middles,
            (false, _, Some(_)) => Sampling::Weighted,
            (false, true, None) => return self.over_cells(quantity, values, floor, &exact),
            (false, false, None) => Sampling::Points,
        };
        let weights = weights.filter(|_| sampling == Sampling::Weighted);
        if let Some(weights) = weights.filter(|it| it.len() != rows) {
            bail!("{}: {} weights for {rows} points", self.snapshot.path, weights.len());
        }
        let found = over_points(&lengths(&values.numbers, &exact, components), weights);
        let found =
            found.ok_or_else(|| anyhow!("{}: no points with a weight", self.snapshot.path))?;
        let norms = [("l1", found.l1), ("l2", found.l2), ("linf", found.linf)];
        Ok(self.result(
            quantity,
            values,
            &exact,
            sampling,
            norms.map(|(name, error)| (name, Measure { error, floor })).to_vec(),
        ))
    }

    /// The values of the cells that have the dimension of the mesh.
    fn of_full_cells(&self, values: &Values) -> Values {
        let rows = self.mesh.full().filter_map(|(cell, ..)| {
            values.numbers.get(cell * values.components..)?.get(..values.components)
        });
        Values { numbers: rows.flatten().copied().collect(), ..*values }
    }

    fn over_cells(
        &mut self,
        quantity: Quantity,
        values: &Values,
        floor: f64,
        at_points: &[f64],
    ) -> anyhow::Result<Errors> {
        let (components, time, dimension) =
            (self.exact.components(quantity), self.time, self.mesh.dimension);
        let gradient =
            (quantity == Quantity::Displacement).then_some(Quantity::DisplacementGradient);
        let exact = &mut *self.exact;
        let mut asked = |asked: Asked, places: &[f64]| {
            let found = match (asked, gradient) {
                (Asked::Values, _) => exact.values(quantity, time, places),
                (Asked::Gradients, Some(gradient)) => exact.values(gradient, time, places),
                (Asked::Gradients, None) => Ok(vec![0.0; places.len() * components]),
            };
            found.map_err(|error| Mistake::new(format!("{error:#}")))
        };
        let measured = self.mesh.measure(&values.numbers, components, &mut asked);
        let found = measured.map_err(|mistake| placed(mistake.of(&self.snapshot.path)))?;
        let value = found.value;
        let mut norms = vec![("l1", value.l1), ("l2", value.l2), ("linf", value.linf)];
        norms.extend(gradient.map(|_| ("h1", found.gradient.l2)));
        // Rounding in a value is one in a gradient over the size of a cell.
        let size = self.mesh.sizes().map_or(1.0, |[shortest, _]| shortest);
        let of_norm =
            |name: &str| if name == "h1" { 2.0 * dimension as f64 * floor / size } else { floor };
        let norms =
            norms.into_iter().map(|(name, error)| (name, Measure { error, floor: of_norm(name) }));
        let norms = norms.collect();
        Ok(self.result(quantity, values, at_points, Sampling::Cells, norms))
    }

    fn result(
        &self,
        quantity: Quantity,
        values: &Values,
        exact: &[f64],
        sampling: Sampling,
        norms: Vec<(&'static str, Measure)>,
    ) -> Errors {
        Errors {
            quantity,
            sampling,
            norms,
            unit: unit(&values.numbers, exact),
            stored: values.stored,
        }
    }

    fn hold_finite(&self, quantity: Quantity, exact: &[f64]) -> anyhow::Result<()> {
        let components = self.exact.components(quantity);
        match exact.iter().position(|it| !it.is_finite()) {
            None => Ok(()),
            Some(at) => bail!(
                "{}: the exact {} is {} there, t = {}: not defined, or beyond the range of f64",
                self.snapshot.place(at / components),
                quantity.name(),
                exact[at],
                self.time
            ),
        }
    }

    /// What rounding may make of the error: that of the values, of X, and of the time, and that of double precision.
    fn floor(
        &mut self,
        quantity: Quantity,
        values: &Values,
        places: &[f64],
        exact: &[f64],
    ) -> anyhow::Result<f64> {
        let components = self.exact.components(quantity);
        let largest = |of: &[f64]| of.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        let largest = match quantity {
            // Components of sigma cancel in them.
            Quantity::Pressure | Quantity::VonMises => {
                largest(&self.exact.values(Quantity::CauchyStress, self.time, places)?)
            }
            _ => largest(exact),
        };
        let arithmetic = ARITHMETIC * f64::EPSILON * largest;
        let mut floor = values.rounding.max(arithmetic) * (components as f64).sqrt();
        let reference = &self.motion.reference;
        // u = x - X has the rounding of X already, and of it what the exact u makes besides.
        if !matches!(reference.stored, Stored::Double | Stored::Whole) {
            let moved: Vec<f64> = places.iter().map(|x| x + reference.rounding).collect();
            let there = self.exact.values(quantity, self.time, &moved)?;
            floor += largest_change(&there, exact, components);
        }
        if self.rounding > ARITHMETIC * f64::EPSILON * self.time.abs() {
            let later = self.exact.values(quantity, self.time + self.rounding, places)?;
            floor += largest_change(&later, exact, components);
        }
        Ok(floor)
    }
}

fn largest_change(a: &[f64], b: &[f64], components: usize) -> f64 {
    let changes = lengths(a, b, components).into_iter();
    changes.filter(|it| it.is_finite()).fold(0.0, f64::max)
}

/// The power of ten by which values are larger than the exact ones, if they are that, and else alike.
fn unit(computed: &[f64], exact: &[f64]) -> Option<i32> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (own, square) = (dot(computed, computed), dot(exact, exact));
    let alike = dot(computed, exact) / (own * square).sqrt();
    let power = (own / square).sqrt().log10();
    let is_one = alike > 0.99 && (power - power.round()).abs() < 0.02 && power.round() != 0.0;
    is_one.then(|| power.round() as i32)
}
