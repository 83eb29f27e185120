//! The initial state of a run.

use super::Solver;
use super::clock::{Clock, Seconds};
use super::need::Need;
use super::slabs::Slabs;
use super::sorting::When;
use super::weights::ShapeProperties;
use crate::axisymmetric::{Rings, Station, hoop_strain};
use crate::body::{Fill, Filling, Piece, bounding_box};
use crate::boundary::{Boundary, is_wall};
use crate::defect::{Defect, on};
use crate::failure::positive;
use crate::failure::{Cause, Failure, Refusal};
use crate::field::{Body, Face, ManufacturedField};
use crate::formulation::FormulationName;
use crate::grid::Grid;
use crate::lattice::Axis;
use crate::lattice::Lattice;
use crate::method::{Division, Setup};
use crate::nodal::Nodal;
use crate::particle::Particles;
use crate::real::{Matrix, Real, Vector};
use crate::shape::Shape;
use crate::stencil::MOST;
use crate::tensor::{components, is_finite, jacobian, matrix_is_finite};

/// The largest number of times at which the field's motion is sampled to find the extent of the grid.
const MOTION_SAMPLES: usize = 64;

/// The number of cells around the body's motion, in addition to the reach of its particles' stencils.
const MARGIN: f64 = 2.0;

impl<'f, T: Real, const D: usize, F> Solver<'f, T, D, F>
where
    F: ManufacturedField<T, D> + ?Sized,
{
    /// Creates the field's body at the start of its time window, divided into `cells`, with the shape function `S`:
    /// displacement, velocity and H are the field's.
    ///
    /// # Errors
    /// The scene cannot be started.
    pub fn new<S: Shape>(
        field: &'f F,
        formulation: FormulationName,
        setup: &Setup,
        cells: &Division,
    ) -> Result<Self, Refusal> {
        Self::of_kind(ShapeProperties::of::<S>(), field, formulation, setup, cells)
    }

    /// Creates the body with a shape function of this kind.
    fn of_kind(
        kind: ShapeProperties<T, D>,
        field: &'f F,
        formulation: FormulationName,
        setup: &Setup,
        cells: &Division,
    ) -> Result<Self, Refusal> {
        setup.validate()?;
        let formulation = formulation.configuration();
        let moves = formulation.moves;
        let domain = field.domain();
        let [lower, upper] = bounding_box(&domain.body)?;
        let cell_size = cell_size(&(upper - lower), cells)?;
        let need = Need::new::<T, D>(kind.domain, setup.memory);
        let spacing = spacing::<D>(setup, &cell_size)?;
        let expected = (upper - lower).component_div(&spacing).iter().product();
        need.check(expected, 0.0)?;
        let revolved = field.axisymmetric();
        let is_meridian = revolved.is_some();
        if is_meridian {
            of_rings(kind.is_product, setup)?;
        }
        let weight = |middle: f64| revolved.map_or(1.0, |it| it.weight(middle));
        let station = if kind.domain > 0 { Station::Centroid } else { Station::Middle };
        let rings = is_meridian.then_some(Rings { station, weight: &weight });
        let filling = fill(&domain.body, setup, &spacing, rings)?;

        let mut particles = Particles::new(&filling, setup.transfer);
        let speed = largest_wave_speed(field, &particles.reference_position)?;
        let [start, end] = domain.time.map(|time| time.to_f64());
        let courant = positive("the Courant number", setup.courant)?;
        let time_step = setup.time_step.unwrap_or(courant * cell_size.min() / speed);
        let window = [start, setup.end_time.unwrap_or(end)];
        let clock = Clock::new(window, time_step, setup.parts)?;

        let mut motion = [lower, upper];
        if moves {
            motion = extent_of_motion(field, &particles, &clock)?;
        }
        let is_box = matches!(domain.body, Body::Box { .. });
        let ends_at = |face: Face| kind.degree > 1 && is_box && (!moves || is_wall(&domain, face));
        let axis = |a: usize| {
            let body = [lower[a], upper[a]];
            let reach = [motion[0][a], motion[1][a]];
            cells_along(setup, a, cell_size[a], body, reach, &ends_at)
        };
        let periodic = std::array::from_fn(|a| setup.periodic[a]);
        let lattice = Lattice::new(std::array::from_fn(axis), kind.degree, periodic)?;
        let lattice = Lattice { is_meridian, ..lattice };
        need.check(particles.len() as f64, lattice.len() as f64)?;
        // A period of the grid has to be a whole number of its cells.
        repeats(field, setup, &filling.pieces, &lattice, clock.window())?;
        let boundary = Boundary::new(&domain, &lattice, &filling.pieces, moves)?;
        let count = particles.len();
        let residual_nodes = if particles.residual.is_empty() { 0 } else { lattice.len() };
        let mut slabs = Slabs::new(&lattice, count, kind.near);
        initialise(field, &mut particles, T::of(clock.start))?;
        particles.fill_up();
        let mut grid = Grid::new(lattice);
        grid.mass_floor = mass_floor(&particles, &grid.lattice)?;
        let mut domains = (kind.domains)(&filling.half_edges);
        slabs.sort(&grid.lattice, kind.origin, &mut particles, &mut *domains, moves, When::Now);
        Ok(Self {
            field,
            clock,
            kind,
            domains,
            particles,
            grid,
            boundary,
            transfer: setup.transfer.taken(),
            slabs,
            kept: Vec::new(),
            keeps_weights: false,
            residual: std::array::from_fn(|_| vec![Nodal::zero(); residual_nodes]),
            time_of_force: T::zero(),
            suspect: false,
            seconds: Seconds::default(),
            formulation,
        })
    }

    /// Tests that a wave of this speed crosses no edge of a cell in a time step.
    ///
    /// # Errors
    /// The wave crosses an edge. The failure is at the particle where waves are fastest at F = I, which the Courant number
    /// refers to.
    pub fn check_time_step(&self, fastest_wave: f64) -> Result<(), Failure> {
        let (time_step, edge) = (self.clock.time_step, self.grid.lattice.cell_size.min().to_f64());
        let stable = edge / fastest_wave;
        // Round-off of the edge must not refuse the advised step itself.
        if time_step <= stable * (1.0 + 1e-6) {
            return Ok(());
        }
        let mut speed = vec![T::zero(); self.particles.len()];
        self.field.wave_speed(&self.particles.reference_position, &mut speed);
        let faster = |a: usize, b: usize| if speed[b] > speed[a] { b } else { a };
        let particle = (0..speed.len()).fold(0, faster);
        let courant = speed[particle].to_f64() / fastest_wave;
        Err(self.failure(particle, Cause::UnstableStep { time_step, stable, courant }))
    }
}

/// The edges of a cell, for a body whose bounding box has these `edges`.
///
/// # Errors
/// A number of cells is 0, or the number of axes is wrong.
pub fn cell_size<const D: usize>(
    edges: &Vector<f64, D>,
    cells: &Division,
) -> Result<Vector<f64, D>, Refusal> {
    for number in cells.numbers() {
        positive("the number of cells", number as f64)?;
    }
    match *cells {
        Division::Uniform(number) => Ok(Vector::repeat(edges.max() / number as f64)),
        Division::PerAxis(_, given) if given != D => {
            Err(Refusal::WrongDimension { what: "cells", given, dimension: D })
        }
        Division::PerAxis(numbers, _) => Ok(Vector::from_fn(|a, _| edges[a] / numbers[a] as f64)),
    }
}

/// The particles that a run with this grid starts from, in the reference configuration; the `rings` if the body is a body of
/// revolution.
///
/// # Errors
/// A body or a grid cannot be filled.
pub fn filling<T: Real, const D: usize>(
    body: &Body<T, D>,
    setup: &Setup,
    cells: &Division,
    rings: Option<Rings<'_>>,
) -> Result<Filling<D>, Refusal> {
    let [lower, upper] = bounding_box(body)?;
    let cell_size = cell_size(&(upper - lower), cells)?;
    fill(body, setup, &spacing::<D>(setup, &cell_size)?, rings)
}

/// Refuses methods without weights for rings.
fn of_rings(is_product: bool, setup: &Setup) -> Result<(), Refusal> {
    let what = if !is_product {
        "the corners of `cpdi` have no weights of rings: use `cpgimp`"
    } else if setup.periodic[0] {
        "it cannot repeat itself along R: leave out that axis"
    } else {
        return Ok(());
    };
    Err(Refusal::NotOfRings { what })
}

/// The distance between particles along each axis.
fn spacing<const D: usize>(
    setup: &Setup,
    cell_size: &Vector<f64, D>,
) -> Result<Vector<f64, D>, Refusal> {
    let per_cell = &setup.particles_per_cell;
    match *per_cell {
        Division::PerAxis(_, given) if given != D => {
            let what = "particles per cell";
            return Err(Refusal::WrongDimension { what, given, dimension: D });
        }
        _ => {}
    }
    for number in per_cell.numbers() {
        positive("the number of particles per cell", number as f64)?;
    }
    Ok(Vector::from_fn(|a, _| cell_size[a] / per_cell.along(a) as f64))
}

/// The body filled with particles; with the `rings` if it is a body of revolution.
fn fill<T: Real, const D: usize>(
    body: &Body<T, D>,
    setup: &Setup,
    spacing: &Vector<f64, D>,
    rings: Option<Rings<'_>>,
) -> Result<Filling<D>, Refusal> {
    let along_faces = match body {
        Body::Box { .. } => Fill::Cartesian,
        _ => Fill::Fitted,
    };
    let mut filling = Filling::new(body, setup.fill.unwrap_or(along_faces), spacing)?;
    if let Some(rings) = rings {
        filling.revolve(rings);
    }
    if setup.jitter != 0.0 {
        filling.jitter(setup.jitter, setup.seed);
    }
    Ok(filling)
}

/// The cells of an axis: enough for the `motion` of a body whose bounds are `body`; splines end at some faces.
fn cells_along(
    setup: &Setup,
    a: usize,
    cell_size: f64,
    body: [f64; 2],
    motion: [f64; 2],
    ends_at: &dyn Fn(Face) -> bool,
) -> Axis {
    let whole = |distance: f64| (distance / cell_size).ceil().max(0.0);
    let padding = MOST as f64 + MARGIN;
    let [mut before, mut after] = [body[0] - motion[0], motion[1] - body[1]].map(whole);
    if setup.periodic[a] {
        (before, after) = (0.0, 0.0);
    }
    let first = before + padding + setup.offset[a];
    let last = first + (body[1] - body[0]) / cell_size;
    // The conversion saturates: the count of nodes refuses too many cells.
    let cells = (last.ceil() + after + padding).min(f64::from(u32::MAX)) as usize;
    let ends = |face: Face, knot: f64, else_at: i64| {
        let on_knot = (knot - knot.round()).abs() < 1e-4;
        let ended = ends_at(face) && !setup.periodic[a] && on_knot;
        if ended { knot.round() as i64 } else { else_at }
    };
    Axis {
        lower: body[0] - first * cell_size,
        cell_size,
        cells,
        ends: [ends(Face::Min(a), first, 0), ends(Face::Max(a), last, cells as i64)],
        body: [first, last],
    }
}

/// Tests that the grid repeats itself along the periodic axes, and the field, at three times and at the pieces of both faces.
fn repeats<T: Real, const D: usize, F: ManufacturedField<T, D> + ?Sized>(
    field: &F,
    setup: &Setup,
    pieces: &[Piece<D>],
    lattice: &Lattice<T, D>,
    window: [f64; 2],
) -> Result<(), Refusal> {
    let is_box = matches!(field.domain().body, Body::Box { .. });
    for axis in (0..D).filter(|&axis| setup.periodic[axis]) {
        let [first, last] = lattice.axes[axis].body;
        let cells = last - first;
        if !is_box || cells < 0.5 || (cells - cells.round()).abs() > 1e-4 {
            return Err(Refusal::NoPeriod { axis, is_box, cells });
        }
        let face = |face: Face| {
            let pieces = pieces.iter().filter(move |piece| piece.face == face);
            pieces.map(|piece| piece.position.map(T::of)).collect::<Vec<Vector<T, D>>>()
        };
        let [near, far] = [face(Face::Min(axis)), face(Face::Max(axis))];
        let mut values = [&near, &far].map(|face| vec![Vector::zeros(); face.len()]);
        for time in [0.1, 0.4, 0.8].map(|part| window[0] + part * (window[1] - window[0])) {
            for (points, values) in [&near, &far].into_iter().zip(&mut values) {
                field.displacement(T::of(time), points, values);
            }
            let largest = values[0].iter().fold(T::zero(), |most, u| most.max(u.amax()));
            let tolerance = largest * T::of(1e4) * T::default_epsilon();
            let apart = |(a, b): (&Vector<T, D>, &Vector<T, D>)| (a - b).amax() > tolerance;
            if values[0].iter().zip(&values[1]).any(apart) {
                return Err(Refusal::NotPeriodic { axis });
            }
        }
    }
    Ok(())
}

/// The largest c0 at all X.
pub(super) fn largest_wave_speed<T: Real, const D: usize, F: ManufacturedField<T, D> + ?Sized>(
    field: &F,
    reference: &[Vector<T, D>],
) -> Result<f64, Refusal> {
    let mut speed = vec![T::zero(); reference.len()];
    field.wave_speed(reference, &mut speed);
    let mut largest = 0.0;
    for speed in speed {
        largest = positive("the wave speed", speed.to_f64())?.max(largest);
    }
    Ok(largest)
}

/// The mass up to which nodes count as empty: for larger masses, 1/m is finite.
///
/// # Errors
/// A particle is so light that nodes with a round-off of its mass would count as empty.
fn mass_floor<T: Real, const D: usize>(
    particles: &Particles<T, D>,
    lattice: &Lattice<T, D>,
) -> Result<T, Refusal> {
    let smallest = particles.mass.iter().fold(particles.mass[0], |a, &b| a.min(b));
    if on(Defect::MassCutOff) {
        return Ok(smallest * T::ratio(1, 100));
    }
    let invertible = T::max_value().map_or(T::zero(), |most| T::one() / most);
    let least = invertible / T::default_epsilon();
    if smallest < least {
        return Err(Refusal::TooLight { mass: smallest.to_f64(), least: least.to_f64() });
    }
    let widest = lattice.count.iter().fold(0, |a, &b| a.max(b));
    // A domain that overlaps a node by the round-off of its position adds the square of that to the node.
    let round_off = T::default_epsilon() * T::of(4.0 * widest as f64);
    Ok((smallest * round_off * round_off).max(invertible))
}

/// The smallest and the largest coordinates that the field moves a particle to.
fn extent_of_motion<T: Real, const D: usize, F: ManufacturedField<T, D> + ?Sized>(
    field: &F,
    particles: &Particles<T, D>,
    clock: &Clock,
) -> Result<[Vector<f64, D>; 2], Refusal> {
    let mut extent = [f64::INFINITY, f64::NEG_INFINITY].map(Vector::<f64, D>::repeat);
    let mut displacement = vec![Vector::zeros(); particles.len()];
    let samples = clock.steps.min(MOTION_SAMPLES);
    for sample in 0..=samples {
        let fraction = sample as f64 / samples as f64;
        let time = T::of(clock.start + fraction * clock.time_step * clock.steps as f64);
        let reference = &particles.reference_position;
        field.displacement(time, reference, &mut displacement);
        finite_vectors("displacement", time, reference, &displacement)?;
        for (reference, displacement) in reference.iter().zip(&displacement) {
            let position = (reference + displacement).map(Real::to_f64);
            extent = [extent[0].inf(&position), extent[1].sup(&position)];
        }
    }
    Ok(extent)
}

/// Sets mass, displacement, velocity and H at the time `start`.
fn initialise<T: Real, const D: usize, F: ManufacturedField<T, D> + ?Sized>(
    field: &F,
    particles: &mut Particles<T, D>,
    start: T,
) -> Result<(), Refusal> {
    let reference = &particles.reference_position;
    field.density(reference, &mut particles.mass);
    for (mass, &volume) in particles.mass.iter_mut().zip(&particles.reference_volume) {
        positive("the density", mass.to_f64())?;
        *mass *= volume;
        positive("the mass of a particle", mass.to_f64())?;
    }
    let mut vectors = vec![Vector::zeros(); particles.len()];
    field.displacement(start, reference, &mut vectors);
    finite_vectors("displacement", start, reference, &vectors)?;
    particles.displacement = vectors.iter().copied().collect();
    field.velocity(start, reference, &mut vectors);
    if on(Defect::StartAtRest) {
        vectors.fill(Vector::zeros());
    }
    if on(Defect::StartSingle) {
        let single = |v: T| T::of(f64::from(v.to_f64() as f32));
        vectors.iter_mut().for_each(|v| *v = v.map(single));
    }
    finite_vectors("velocity", start, reference, &vectors)?;
    particles.velocity = vectors.into_iter().collect();
    let mut gradients = vec![Matrix::zeros(); particles.len()];
    field.displacement_gradient(start, reference, &mut gradients);
    if on(Defect::MassOfPresentVolume) {
        let gradients = gradients.iter();
        particles.mass.iter_mut().zip(gradients).for_each(|(mass, h)| *mass *= jacobian(h));
    }
    if on(Defect::StartUndeformed) {
        gradients.fill(Matrix::zeros());
    }
    let odd = gradients.iter().position(|h| !matrix_is_finite(h));
    refuse_at("displacement gradient", start, reference, odd)?;
    let mut hoop_strain = hoop_strain(field, start, reference);
    let odd = hoop_strain.iter().position(|h| !h.is_finite());
    refuse_at("hoop strain", start, reference, odd)?;
    if on(Defect::StartUndeformed) {
        hoop_strain.fill(T::zero());
    }
    particles.hoop_strain = hoop_strain.into();
    particles.displacement_gradient = gradients.into_iter().collect();
    Ok(())
}

fn finite_vectors<T: Real, const D: usize>(
    quantity: &'static str,
    time: T,
    reference: &[Vector<T, D>],
    values: &[Vector<T, D>],
) -> Result<(), Refusal> {
    refuse_at(quantity, time, reference, values.iter().position(|value| !is_finite(value)))
}

fn refuse_at<T: Real, const D: usize>(
    quantity: &'static str,
    time: T,
    reference: &[Vector<T, D>],
    odd: Option<usize>,
) -> Result<(), Refusal> {
    odd.map_or(Ok(()), |p| {
        Err(Refusal::FieldNotFinite {
            quantity,
            time: time.to_f64(),
            reference_position: components(&reference[p]),
        })
    })
}
