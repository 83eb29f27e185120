//! The errors of the quantities of one snapshot.

use anyhow::{anyhow, bail};
use mms_exact::Exact;
use mms_results::comparison::Comparison;
use mms_results::mesh::Mesh;
use mms_results::motion::Motion;
use mms_results::names::{Meaning, Role, Values, Why};
use mms_results::norm::{largest, lengths, range};
use mms_results::over_cells::{Carried, SolutionPart};
use mms_results::{Mistake, Snapshot, Stored};
use mms_spec::quantity::Quantity;

use super::files::placed;
use super::level::{Errors, Measure, Sampling};

/// A snapshot with its mesh, its motion and the exact solution.
pub struct SnapshotErrors<'a> {
    /// The snapshot.
    pub snapshot: &'a Snapshot,
    /// The mesh of the snapshot.
    pub mesh: Mesh<'a>,
    /// Whether the mesh has cells of its dimension with known shape functions.
    pub is_mesh: bool,
    /// X and u.
    pub motion: &'a Motion<'a>,
    /// The time.
    pub time: f64,
    /// The rounding of the time.
    pub rounding: f64,
    /// The exact solution.
    pub exact: &'a mut Exact,
}

/// Computes the exact solution at a time and at places X; the third argument is the row of the first place.
pub type Solution<'a> = &'a dyn Fn(&mut Exact, f64, usize, &[f64]) -> anyhow::Result<Vec<f64>>;

/// Values compared with the exact ones.
pub struct AgainstExact<'a> {
    /// The comparison of all values.
    all: Comparison<'a>,
    /// The error that rounding may make.
    floor: f64,
    /// The part of the floor that the digits of the time make.
    of_time: f64,
    /// Whether all values are inputs of a solver, and so no evidence.
    is_given: bool,
}

/// The number of points whose exact values are computed at once: enough for all threads, and small enough for the cache.
const BLOCK: usize = 1 << 16;

/// The largest difference of densities that count as equal, relative to the largest density.
const NEAR: f64 = 1e-6;

/// The least round-off of a computation, in units of double precision.
const ARITHMETIC: f64 = 16.0;

impl SnapshotErrors<'_> {
    /// The errors of a quantity: over cells if these and values of their points are known, otherwise over points.
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
        let sampling = match (values.is_of_cells, self.is_mesh, weights) {
            (true, ..) => Sampling::Middles,
            (false, _, Some(_)) => Sampling::Weighted,
            (false, true, None) => Sampling::Cells,
            (false, false, None) => Sampling::Points,
        };
        let radii = self.exact.radii(places);
        let weights = match sampling {
            Sampling::Weighted => weights,
            _ => radii.as_deref(),
        };
        if let Some(weights) = weights.filter(|it| it.len() != rows) {
            bail!("{}: {} weights for {rows} points", self.snapshot.path, weights.len());
        }
        let solution: Solution<'_> = &|exact, time, _, places| exact.values(quantity, time, places);
        let compared = self.compared(quantity, (values, weights), places, solution)?;
        match sampling {
            Sampling::Cells => self.over_cells(quantity, values, &compared),
            _ => self.over_points(quantity, (values, places), sampling, &compared),
        }
    }

    /// The norms over points at these places, weighted or with equal weights.
    pub fn over_points(
        &self,
        quantity: Quantity,
        (values, places): (&Values<'_>, &[f64]),
        sampling: Sampling,
        compared: &AgainstExact<'_>,
    ) -> anyhow::Result<Errors> {
        let found = compared.all.norms();
        let found =
            found.ok_or_else(|| anyhow!("{}: no points with a weight", self.snapshot.path))?;
        let norms = [("l1", found.l1), ("l2", found.l2), ("linf", found.linf)];
        let floor = compared.floor;
        let norms =
            norms.map(|(name, error)| (name, Measure { error, rounding_error: floor })).to_vec();
        let dimension = self.mesh.dimension;
        let place = places.get(found.at * dimension..).and_then(|it| it.get(..dimension));
        let place = place.unwrap_or_default().to_vec();
        Ok(self.result(quantity, values, (sampling, place), norms, compared))
    }

    /// Refuses a density whose name may mean the present or the reference one, if its numbers are the reference density and the
    /// present density differs.
    ///
    /// # Errors
    /// A density that may be either; an exact density that is not finite.
    pub fn validate_density(
        &mut self,
        meaning: &Meaning,
        values: &Values<'_>,
    ) -> anyhow::Result<()> {
        let is_open = meaning.role == Role::MassDensity && meaning.why == Why::Name;
        let name = &meaning.source;
        if !is_open || name == Role::MassDensity.name() || values.is_of_cells {
            return Ok(());
        }
        let places = self.mesh.points;
        let reference = self.exact.densities(places)?;
        let present = self.exact.values(Quantity::MassDensity, self.time, places)?;
        let near = |a: &[f64], b: &[f64]| {
            let most = NEAR * largest(b) + 2.0 * values.rounding;
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= most)
        };
        if !near(&values.numbers, &reference) || near(&present, &reference) {
            return Ok(());
        }
        let [least, most] = range(&present);
        bail!(
            "{}: `{name}` is the reference density of the field at all points, and the present one is {least:.6e} to \
             {most:.6e}: say which it is with `--map rho0={name}`, which is given and not judged, or `--map rho={name}`",
            self.snapshot.path
        )
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
        compared: &AgainstExact<'_>,
    ) -> anyhow::Result<Errors> {
        let floor = compared.floor;
        let (components, time, dimension) =
            (self.exact.components(quantity), self.time, self.mesh.dimension);
        let gradient =
            (quantity == Quantity::Displacement).then_some(Quantity::DisplacementGradient);
        let exact = &mut *self.exact;
        let mut asked = |asked: SolutionPart, places: &[f64]| {
            let found = match gradient.filter(|_| asked == SolutionPart::Gradients) {
                Some(gradient) => exact.values_in_dimension(gradient, time, places),
                None => exact.values(quantity, time, places),
            };
            found.map_err(|error| Mistake::new(format!("{error:#}")))
        };
        let (values_of_points, has_gradient) = (&values.numbers, gradient.is_some());
        let carried = Carried { values: values_of_points, components, has_gradient };
        let measured = self.mesh.measure(carried, &mut asked);
        let found = measured.map_err(|mistake| placed(mistake.of(&self.snapshot.path)))?;
        let value = found.value;
        let mut norms = vec![("l1", value.l1), ("l2", value.l2), ("linf", value.linf)];
        norms.extend(gradient.map(|_| ("h1", found.h1)));
        // If values are rounded by r, a gradient in a cell of size h has an error of about r/h.
        let size = self.mesh.sizes().map_or(1.0, |[shortest, _]| shortest);
        let of_norm =
            |name: &str| if name == "h1" { 2.0 * dimension as f64 * floor / size } else { floor };
        let norms = norms
            .into_iter()
            .map(|(name, error)| (name, Measure { error, rounding_error: of_norm(name) }));
        let norms = norms.collect();
        Ok(self.result(quantity, values, (Sampling::Cells, found.place), norms, compared))
    }

    /// Compares values with the exact ones at places X, and finds the part of the difference that rounding may make: rounding
    /// of the values, of X and of the time, and round-off of double precision.
    ///
    /// # Errors
    /// An exact value that is not finite.
    pub fn compared<'b>(
        &mut self,
        quantity: Quantity,
        (values, weights): (&'b Values<'_>, Option<&'b [f64]>),
        places: &[f64],
        solution: Solution<'_>,
    ) -> anyhow::Result<AgainstExact<'b>> {
        let (components, dimension) = (self.exact.components(quantity), self.mesh.dimension);
        let mut all = Comparison::new(&values.numbers, components, weights);
        let reference = &self.motion.reference;
        // u = x - X already contains the rounding of X; the change of the exact u with X is added here.
        let moves = !matches!(reference.stored, Stored::Double | Stored::Whole);
        let passes = self.rounding > ARITHMETIC * f64::EPSILON * self.time.abs();
        // In these quantities components of sigma cancel.
        let cancels = matches!(quantity, Quantity::Pressure | Quantity::VonMises);
        let (mut of_places, mut of_time, mut cancelled) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (block, places) in places.chunks(BLOCK * dimension).enumerate() {
            let first = block * BLOCK;
            let exact = solution(self.exact, self.time, first, places)?;
            if let Err(at) = all.add(&exact) {
                bail!(
                    "{}: the exact {} is {} there, t = {}: not defined, or beyond the range of f64",
                    self.snapshot.place(first + at / components),
                    quantity.name(),
                    exact[at],
                    self.time
                );
            }
            let change = |other: &[f64]| largest_change(other, &exact, components);
            if moves {
                let moved: Vec<f64> = places.iter().map(|x| x + reference.rounding).collect();
                let there = solution(self.exact, self.time, first, &moved)?;
                of_places = of_places.max(change(&there));
            }
            if passes {
                let later = solution(self.exact, self.time + self.rounding, first, places)?;
                of_time = of_time.max(change(&later));
            }
            if cancels {
                let stress = self.exact.values(Quantity::CauchyStress, self.time, places)?;
                cancelled = cancelled.max(largest(&stress));
            }
        }
        let size = if cancels { cancelled } else { all.largest() };
        let arithmetic = ARITHMETIC * f64::EPSILON * size;
        let floor = values.rounding.max(arithmetic) * (components as f64).sqrt();
        let is_given = self.is_input(quantity, places)?;
        Ok(AgainstExact { all, floor: floor + of_places + of_time, of_time, is_given })
    }

    fn result(
        &self,
        quantity: Quantity,
        values: &Values<'_>,
        (sampling, place): (Sampling, Vec<f64>),
        norms: Vec<(&'static str, Measure)>,
        compared: &AgainstExact<'_>,
    ) -> Errors {
        Errors {
            quantity,
            sampling,
            norms,
            unit: compared.all.unit(),
            largest: compared.all.largest(),
            at_points: compared.all.norms().map(|it| it.l2).filter(|_| sampling == Sampling::Cells),
            iterative: None,
            stored: values.stored,
            of_time: [compared.of_time, self.time],
            is_input: compared.is_given,
            largest_at: (place, self.motion.reference.rounding),
        }
    }
}

fn largest_change(a: &[f64], b: &[f64], components: usize) -> f64 {
    lengths(a, b, components).filter(|it| it.is_finite()).fold(0.0, f64::max)
}
