//! The errors of the quantities of one snapshot.

use anyhow::{anyhow, bail};
use mms_results::motion::Motion;
use mms_results::names::Values;
use mms_results::norm::{Asked, Mesh, largest, lengths, of_differences};
use mms_results::{Mistake, Snapshot, Stored};
use mms_spec::quantity::Quantity;

use super::files::placed;
use super::level::{Errors, Measure, Sampling};
use crate::session::exact::Exact;

/// A snapshot with what is known of it.
pub struct Taken<'a> {
    /// The snapshot.
    pub snapshot: &'a Snapshot,
    /// Its mesh.
    pub mesh: Mesh<'a>,
    /// Whether that has cells of its dimension.
    pub is_mesh: bool,
    /// X and u.
    pub motion: &'a Motion<'a>,
    /// The time.
    pub time: f64,
    /// How far it may be from that of the solver.
    pub rounding: f64,
    /// The exact solution.
    pub exact: &'a mut Exact,
}

/// The exact solution at a time and at places X.
pub type Solution<'a> = &'a dyn Fn(&mut Exact, f64, &[f64]) -> anyhow::Result<Vec<f64>>;

/// How many times the round-off of double precision a computation has at least.
const ARITHMETIC: f64 = 16.0;

impl Taken<'_> {
    /// The errors of a quantity: over cells where these and values of their points are known, else over points.
    ///
    /// # Errors
    /// Values of other points; an exact value that is not finite.
    pub fn errors(
        &mut self,
        quantity: Quantity,
        values: &Values<'_>,
        weights: Option<&[f64]>,
    ) -> anyhow::Result<Errors> {
        let components = self.exact.components(quantity);
        let middles;
        let of_cells;
        let (values, places): (&Values<'_>, &[f64]) = if values.is_of_cells {
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
        let solution: Solution<'_> = &|exact, time, places| exact.values(quantity, time, places);
        let exact = solution(self.exact, self.time, places)?;
        self.hold_finite(quantity, &exact)?;
        let floor = self.floor(quantity, values, (places, &exact), solution)?;
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
        self.over_points(quantity, values, &exact, (sampling, weights, floor))
    }

    /// The norms over points, by their weights or all alike.
    pub fn over_points(
        &self,
        quantity: Quantity,
        values: &Values<'_>,
        exact: &[f64],
        (sampling, weights, floor): (Sampling, Option<&[f64]>, f64),
    ) -> anyhow::Result<Errors> {
        let components = self.exact.components(quantity);
        let found = of_differences(&values.numbers, exact, components, weights);
        let found =
            found.ok_or_else(|| anyhow!("{}: no points with a weight", self.snapshot.path))?;
        let norms = [("l1", found.l1), ("l2", found.l2), ("linf", found.linf)];
        let norms = norms.map(|(name, error)| (name, Measure { error, floor })).to_vec();
        Ok(self.result(quantity, values, exact, sampling, norms))
    }

    /// The values of the cells that have the dimension of the mesh.
    fn of_full_cells<'b>(&self, values: &Values<'b>) -> Values<'b> {
        let rows = self.mesh.full().filter_map(|(cell, ..)| {
            values.numbers.get(cell * values.components..)?.get(..values.components)
        });
        Values { numbers: rows.flatten().copied().collect(), ..*values }
    }

    fn over_cells(
        &mut self,
        quantity: Quantity,
        values: &Values<'_>,
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
        values: &Values<'_>,
        exact: &[f64],
        sampling: Sampling,
        norms: Vec<(&'static str, Measure)>,
    ) -> Errors {
        Errors {
            quantity,
            sampling,
            norms,
            unit: unit(&values.numbers, exact),
            largest: largest(exact),
            iterative: None,
            stored: values.stored,
        }
    }

    /// Refuses exact values that are not finite.
    pub fn hold_finite(&self, quantity: Quantity, exact: &[f64]) -> anyhow::Result<()> {
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
    pub fn floor(
        &mut self,
        quantity: Quantity,
        values: &Values<'_>,
        (places, exact): (&[f64], &[f64]),
        solution: Solution<'_>,
    ) -> anyhow::Result<f64> {
        let components = self.exact.components(quantity);
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
            let there = solution(self.exact, self.time, &moved)?;
            floor += largest_change(&there, exact, components);
        }
        if self.rounding > ARITHMETIC * f64::EPSILON * self.time.abs() {
            let later = solution(self.exact, self.time + self.rounding, places)?;
            floor += largest_change(&later, exact, components);
        }
        Ok(floor)
    }
}

fn largest_change(a: &[f64], b: &[f64], components: usize) -> f64 {
    lengths(a, b, components).filter(|it| it.is_finite()).fold(0.0, f64::max)
}

/// How many numbers are looked at to tell another unit.
const LOOKED_AT: usize = 1 << 16;

/// The power of ten by which values are larger than the exact ones, if they are that, and else alike.
fn unit(computed: &[f64], exact: &[f64]) -> Option<i32> {
    let step = computed.len() / LOOKED_AT + 1;
    let dot = |a: &[f64], b: &[f64]| {
        // Steps of each, for those of pairs go one by one.
        a.iter().step_by(step).zip(b.iter().step_by(step)).map(|(a, b)| a * b).sum::<f64>()
    };
    let (own, square) = (dot(computed, computed), dot(exact, exact));
    let alike = dot(computed, exact) / (own * square).sqrt();
    let power = (own / square).sqrt().log10();
    let is_one = alike > 0.99 && (power - power.round()).abs() < 0.02 && power.round() != 0.0;
    is_one.then(|| power.round() as i32)
}
