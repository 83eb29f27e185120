//! The claims of a file on the faces of its body: each is proved as an identity if possible, else enclosed, or refuted at a
//! point.
//!
//! The natural scale of u is the size of the body; the natural scale of P N is the longitudinal modulus at F = I. `prescribed`
//! and `traction` claim only that u and P N are finite.

use mms_math::Scalar as _;

use super::motion::gradient;
use crate::bounds::chart::{Chart, straightened};
use crate::bounds::enclosure::Formulas;
use crate::bounds::search::{Measure, largest};
use crate::bounds::witness::Witness;
use crate::compile::Compiled;
use mms_mechanics::extent::Region;
use mms_mechanics::extent::spread;
use mms_mechanics::face::normal;
use mms_mechanics::tensor::dot;
use mms_mechanics::{Response, face};
use mms_program::interpret::Number as _;
use mms_program::interval::Interval;
use mms_program::precise::Precise;
use mms_spec::quantity::Quantity;
use mms_spec::{BoundarySpec, Claim, Face};
use mms_symbolic::expr::{Expr, Graph, Symbol};
use mms_symbolic::pass::reduce::reduce;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::substitute::substitute;

/// The number of points of a face where a claim is evaluated in 77 digits.
pub const POINTS: usize = 32;

/// The part of the natural scale below which a value may be rounding of 77 digits.
const DOUBT: f64 = 1e-40;

/// The width of an enclosure, relative to the natural scale, that passes for 0.
const NARROW: f64 = 1e-12;

/// The budget for computing a scale, in the steps of [`mms_symbolic::work`].
const STEPS_OF_SCALE: u64 = 20_000_000;

/// The verdict about a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum ClaimVerdict {
    /// The claim holds identically.
    Proved,
    /// The value that should be 0 lies between these numbers, which are near enough.
    Enclosed([f64; 2]),
    /// The value that should be 0 has this value here.
    Refuted(Witness, f64),
    /// The value that should be 0, or exist, lies between these numbers: not near enough.
    Unproved([f64; 2]),
}

impl ClaimVerdict {
    /// The word for the verdict in reports.
    pub fn status(&self) -> &'static str {
        match self {
            ClaimVerdict::Proved => "proved",
            ClaimVerdict::Enclosed(_) => "enclosed",
            ClaimVerdict::Refuted(..) => "refuted",
            ClaimVerdict::Unproved(_) => "unproved",
        }
    }
}

/// The components that a claim compares, and their scales.
struct Compared {
    /// The components that must be 0; for `prescribed` and `traction`, those that must exist.
    components: Vec<Expr>,
    /// The scale of each component.
    scales: Vec<Scale>,
}

/// The scale that a component is compared with.
#[derive(Clone, Copy, PartialEq)]
enum Scale {
    /// The size of the body.
    Length,
    /// The modulus of the material.
    Modulus,
}

impl Compared {
    /// The scales of the components as numbers, each computed once.
    fn scales(&self, compiled: &Compiled) -> Vec<f64> {
        let found = |scale: Scale, find: fn(&Compiled) -> f64| match self.scales.contains(&scale) {
            true => find(compiled),
            false => 0.0,
        };
        let (length, modulus) = (found(Scale::Length, size), found(Scale::Modulus, modulus));
        let number = |scale: &Scale| if *scale == Scale::Length { length } else { modulus };
        self.scales.iter().map(number).collect()
    }
}

/// A field on one of its faces.
struct OnFace<'a> {
    compiled: &'a Compiled,
    face: Face,
    chart: Chart,
    /// Whether the coordinate that is constant on the face stays a symbol, in the formulas and in the normal. A proof for all
    /// its values includes its value on the face, and the sine of a symbol is shorter than the sine of a number.
    is_open: bool,
}

/// Proves or refutes a claim, and counts the cells.
pub fn judge(
    graph: &mut Graph,
    compiled: &Compiled,
    claim: &BoundarySpec,
    limit: usize,
) -> (ClaimVerdict, usize) {
    let on_face = OnFace::new(graph, compiled, claim.face.value);
    let subject = on_face.subject(graph, claim.claim.value);
    let must_vanish = !matches!(claim.claim.value, Claim::Prescribed | Claim::Traction);
    if must_vanish
        && (on_face.vanishes(graph, &subject.components)
            || on_face.vanishes_openly(graph, claim.claim.value))
    {
        return (ClaimVerdict::Proved, 0);
    }
    let formulas = on_face.formulas(graph, &subject.components);
    let scales = subject.scales(compiled);
    if must_vanish && let Some(found) = on_face.refute(&formulas, &scales, POINTS) {
        return (found, 0);
    }
    on_face.enclose(&formulas, &scales, must_vanish, limit)
}

/// Finds a point where a claim does not hold, among `points` points.
pub fn refute(
    graph: &mut Graph,
    compiled: &Compiled,
    claim: &BoundarySpec,
    points: usize,
) -> Option<ClaimVerdict> {
    if matches!(claim.claim.value, Claim::Prescribed | Claim::Traction) {
        return None;
    }
    let on_face = OnFace::new(graph, compiled, claim.face.value);
    let subject = on_face.subject(graph, claim.claim.value);
    if subject.components.iter().all(|component| graph.is_zero(*component)) {
        return None;
    }
    let formulas = on_face.formulas(graph, &subject.components);
    on_face.refute(&formulas, &subject.scales(compiled), points)
}

impl<'a> OnFace<'a> {
    fn new(graph: &mut Graph, compiled: &'a Compiled, face: Face) -> Self {
        let chart = Chart::new(graph, &compiled.field, &compiled.model, Some(face));
        OnFace { compiled, face, chart, is_open: false }
    }

    /// Rewrites formulas in X in terms of the coordinates that vary on the face, for any parameters.
    fn restrict(&self, graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
        let body = &self.compiled.model.domain.body;
        let places = face::positions(graph, body, Some(self.face));
        let general = straightened(graph, formulas, &places);
        match self.is_open {
            true => general,
            false => substitute(graph, &general, &face::constant(body, self.face)),
        }
    }

    fn displacement(&self, graph: &mut Graph) -> Vec<Expr> {
        let displacement = &self.compiled.derived.quantities[&Quantity::Displacement];
        self.restrict(graph, displacement)
    }

    fn normal(&self, graph: &mut Graph) -> Vec<Expr> {
        let body = &self.compiled.model.domain.body;
        let dimension = self.compiled.field.dimension;
        if self.is_open {
            return face::direction(graph, body, self.face)[..dimension].to_vec();
        }
        let normal = normal(graph, body, dimension, self.face);
        self.restrict(graph, &normal)
    }

    /// P N, from the reduced H on the face: terms that vanish there in H or in C - I vanish in P.
    fn traction(&self, graph: &mut Graph) -> Vec<Expr> {
        let Compiled { field, derived, .. } = self.compiled;
        let rows = field.space.rows();
        let gradient = gradient(graph, self.compiled);
        let gradient = self.restrict(graph, &gradient);
        let gradient = reduced(graph, &gradient);
        let supplied = gradient
            .iter()
            .enumerate()
            .map(|(at, entry)| (Symbol::Gradient(at / rows, at % rows), *entry));
        let stress = self.restrict(graph, &derived.responses[&Response::FirstPiolaKirchhoff]);
        let stress = substitute(graph, &stress, &supplied.collect());
        let normal = self.normal(graph);
        let component = |row: &[Expr]| dot(graph, row.iter().copied().zip(normal.iter().copied()));
        let traction: Vec<Expr> = stress.chunks_exact(rows).map(component).collect();
        match &self.compiled.model.rigid {
            Some(rigid) => rigid.turn(graph).apply(graph, &traction),
            None => traction,
        }
    }

    /// The components and scales of a claim, for any parameters.
    fn subject(&self, graph: &mut Graph, claim: Claim) -> Compared {
        let with = |components: Vec<Expr>, scale: Scale| Compared {
            scales: vec![scale; components.len()],
            components,
        };
        match claim {
            Claim::Fixed | Claim::Prescribed => with(self.displacement(graph), Scale::Length),
            Claim::Free | Claim::Traction => with(self.traction(graph), Scale::Modulus),
            Claim::Axis => {
                let mut leaving = self.displacement(graph);
                // A displacement along the axis stays on the axis.
                leaving.remove(1);
                let radius = graph.symbol(Symbol::Coordinate(0));
                leaving.extend(self.restrict(graph, &[radius]));
                with(leaving, Scale::Length)
            }
            Claim::Roller => {
                let normal = self.normal(graph);
                let around = graph.number(0);
                let pairs = |vector: Vec<Expr>| -> Vec<(Expr, Expr)> {
                    let normal = normal.iter().copied().chain([around]);
                    vector.into_iter().zip(normal).collect()
                };
                let displacement = self.displacement(graph);
                let across = dot(graph, pairs(displacement));
                let mut subject = with(vec![across], Scale::Length);
                let traction = self.traction(graph);
                let pull = dot(graph, pairs(traction.clone()));
                for (component, normal) in pairs(traction) {
                    let along = graph.mul(pull, normal);
                    subject.components.push(graph.sub(component, along));
                    subject.scales.push(Scale::Modulus);
                }
                subject
            }
        }
    }

    /// Whether formulas are 0 identically: for any parameters, or for the declared ones.
    fn vanishes(&self, graph: &mut Graph, components: &[Expr]) -> bool {
        let zero = |graph: &mut Graph, components: &[Expr]| {
            graph.attempt(|graph| {
                let relations = Relations::find(graph, components);
                let thorough = relations.thorough().unwrap_or(relations);
                let reduced = reduce(graph, components, &thorough);
                // Terms may cancel in a second reduction, because the first one lowered their powers.
                let relations = Relations::find(graph, &reduced);
                let reduced = reduce(graph, &reduced, &relations);
                reduced.iter().all(|component| graph.is_zero(*component))
            }) == Some(true)
        };
        if zero(graph, components) {
            return true;
        }
        let declared = self.chart.fix(graph, components);
        zero(graph, &declared)
    }

    /// Whether a claim on a face where an angle is constant holds for every value of this angle, with the normal that belongs
    /// to it.
    fn vanishes_openly(&self, graph: &mut Graph, claim: Claim) -> bool {
        let Region::Block(block) = &self.compiled.model.domain.body else { return false };
        if !block.system.is_angle(face::fixed_coordinate(self.face).0) {
            return false;
        }
        let open = OnFace {
            compiled: self.compiled,
            face: self.face,
            chart: self.chart.clone(),
            is_open: true,
        };
        let subject = open.subject(graph, claim);
        open.vanishes(graph, &subject.components)
    }

    /// Formulas in the variables of the face, ready to be evaluated.
    fn formulas(&self, graph: &mut Graph, components: &[Expr]) -> Formulas {
        let declared = self.chart.fix(graph, components);
        Formulas::new(graph, &self.chart, &declared)
    }

    fn refute(&self, formulas: &Formulas, scales: &[f64], points: usize) -> Option<ClaimVerdict> {
        let mut values = formulas.run::<Precise>(&self.chart);
        let dimension = self.chart.variables().len();
        (1..=points).find_map(|index| {
            let fractions: Vec<Precise> =
                spread(index, dimension).iter().map(Precise::from_rational).collect();
            let found = values.values(&self.chart.place(&fractions));
            let beyond_doubt = |(value, scale): (&Precise, &f64)| {
                let doubt = Precise::from_f64(scale * DOUBT);
                let is_known = *scale > 0.0 && scale.is_finite();
                (is_known && value.is_defined() && !value.clone().magnitude().at_most(&doubt))
                    .then(|| value.to_f64())
            };
            let value = found.iter().zip(scales).find_map(beyond_doubt)?;
            Some(ClaimVerdict::Refuted(Witness::at_precise(&self.chart, &fractions).0, value))
        })
    }

    /// Bounds the components that should be 0, each in units of its scale.
    fn enclose(
        &self,
        formulas: &Formulas,
        scales: &[f64],
        must_vanish: bool,
        limit: usize,
    ) -> (ClaimVerdict, usize) {
        let mut bounds = formulas.run::<Interval>(&self.chart);
        let dimension = self.chart.variables().len();
        let farthest = |value: &Interval| match value.is_defined() {
            true => value.farthest(),
            false => f64::INFINITY,
        };
        let enough = |bound: f64, _: f64| match must_vanish {
            true => bound <= NARROW / 2.0,
            false => bound.is_finite(),
        };
        let found = largest(dimension, self.chart.limit(limit), enough, |cell| {
            let place = self.chart.place(&cell.0);
            let enclosure = bounds.enclose(&place);
            let relative =
                enclosure.values.iter().zip(scales).map(|(value, scale)| farthest(value) / scale);
            // If there is no scale, no value is small.
            let relative = relative.map(|it| if it.is_nan() { f64::INFINITY } else { it });
            Measure {
                bound: relative.fold(0.0, f64::max),
                attained: 0.0,
                at: cell.centre(),
                split: cell.steepest(&self.chart.changes(cell, &place, &enclosure.slopes)),
            }
        });
        let scale = scales.iter().copied().fold(0.0, f64::max);
        let interval = [-found.bound * scale, found.bound * scale];
        let finding = match enough(found.bound, 0.0) {
            true if must_vanish => ClaimVerdict::Enclosed(interval),
            true => ClaimVerdict::Proved,
            false => ClaimVerdict::Unproved(interval),
        };
        (finding, found.cells)
    }
}

/// Reduces formulas modulo their own relations, as far as the graph has room for it.
fn reduced(graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
    let reduced = graph.attempt(|graph| {
        let relations = Relations::find(graph, formulas);
        reduce(graph, formulas, &relations)
    });
    reduced.unwrap_or_else(|| formulas.to_vec())
}

/// The size of the body: its longest edge, or its outer diameter.
fn size(compiled: &Compiled) -> f64 {
    let mut graph = compiled.graph.clone();
    graph.make_room();
    graph.work().allow(STEPS_OF_SCALE);
    let body = &compiled.model.domain.body;
    let values = crate::declared::values(&graph, &compiled.model, &body.values());
    body.with(values).size()
}

/// The longitudinal modulus at F = I, in the middle of the body.
fn modulus(compiled: &Compiled) -> f64 {
    let mut graph = compiled.graph.clone();
    graph.make_room();
    graph.work().allow(STEPS_OF_SCALE);
    let chart = Chart::new(&mut graph, &compiled.field, &compiled.model, None);
    let responses = &compiled.derived.responses;
    let parts = [Response::WaveSpeed, Response::Density].map(|response| responses[&response][0]);
    let parts = chart.pull_back(&mut graph, &parts);
    let formulas = Formulas::new(&mut graph, &chart, &parts);
    let centre = vec![0.5; chart.variables().len()];
    let values = formulas.run::<f64>(&chart).values(&chart.place(&centre));
    values[0] * values[0] * values[1]
}
