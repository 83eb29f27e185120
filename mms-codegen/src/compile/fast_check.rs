//! A quick test, in microseconds, that a field surely allows the values that a user sets.
//!
//! It evaluates the conditions of [`Compiled::accepts`] once, in intervals that enclose the whole body. If that does not
//! decide, or something is wrong, it returns `None`.

use mms_math::Double;
use mms_math::coordinates::System;

use super::Compiled;
use crate::declared::elasticity::{curvatures, stiffness};
use mms_mechanics::axisymmetric::poles;
use mms_mechanics::extent::Region;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::model::Model;
use mms_program::Program;
use mms_program::interpret::{Interpreter, Number as _, Point};
use mms_program::interval::Interval;
use mms_program::schedule::schedule;
use mms_spec::{Claim, Face};
use mms_symbolic::expr::{Expr, Graph, Rational, Symbol};
use mms_symbolic::sorted::SortedMap;

/// The largest sector that the test decides: the full check distinguishes larger ones from full rings.
const TURN: f64 = std::f64::consts::TAU * (1.0 - 1e-9);

/// An angle from +Z up to this is surely at most pi, or is pi up to rounding.
const POLE: f64 = std::f64::consts::PI * (1.0 + 4.0 * f64::EPSILON);

/// An expression that the test evaluates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum CheckOutput {
    Ranges,
    Body,
    Time,
    Density,
    Poisson,
    Defined,
    Stiffness,
}

/// A field whose parameters are set time and again.
#[derive(Debug)]
pub struct FastParameterCheck {
    dimension: usize,
    program: Program<CheckOutput>,
    /// The parameters that have ranges.
    ranged: Vec<usize>,
    body: Region<()>,
    /// Whether theta is given.
    is_sector: bool,
    /// Whether the body may reach the axis; `None` if the field is not axisymmetric.
    axis: Option<bool>,
    defaults: Vec<Default>,
}

/// The value of a parameter that is not set.
#[derive(Debug)]
enum Default {
    Number(Interval, Double),
    /// Computed from the parameters before it.
    Made(Program<()>),
}

impl Default {
    fn new(graph: &Graph, default: Expr) -> Self {
        match graph.as_number(default) {
            Some(number) => {
                Default::Number(Interval::from_rational(number), Double::from_rational(number))
            }
            None => Default::Made(schedule(graph, &SortedMap::from([((), vec![default])]))),
        }
    }

    /// The enclosure and the value of the parameter, given all parameters before it.
    fn of(&self, enclosures: &[Interval], values: &[Double]) -> (Interval, Double) {
        match self {
            Default::Number(enclosure, value) => (*enclosure, *value),
            Default::Made(program) => (
                Interpreter::new(program, enclosures).output(())[0],
                Interpreter::new(program, values).output(())[0],
            ),
        }
    }
}

impl FastParameterCheck {
    /// Prepares the test for a field; `None` if the test cannot decide anything.
    pub fn new(compiled: &Compiled) -> Option<Self> {
        let (model, field) = (&compiled.model, &compiled.field);
        let mut graph = compiled.graph.clone();
        graph.make_room();
        let is_simple = model.rigid.is_none() && !matches!(model.kind, InvariantKind::Fibrous(_));
        let outputs = is_simple.then(|| outputs(&mut graph, model))?;
        let mut exprs = outputs.values().flatten();
        // Expressions that change in time are judged when they are read.
        let moves = exprs.any(|expr| graph.symbols(*expr).contains(&Symbol::Time));
        if field.incomplete || graph.is_exhausted() || moves {
            return None;
        }
        let parameters = model.parameters.iter();
        let is_sector = match &field.domain.body {
            mms_spec::BodySpec::Round(round) => round.theta.is_some(),
            _ => false,
        };
        // A face on the axis may have no other claim.
        let has_other_claim = field
            .boundary
            .iter()
            .any(|it| it.face.value == Face::RadialMin && it.claim.value != Claim::Axis);
        Some(FastParameterCheck {
            dimension: field.dimension,
            program: schedule(&graph, &outputs),
            ranged: (0..model.parameters.len())
                .filter(|index| model.parameters[*index].range.is_some())
                .collect(),
            body: model.domain.body.map(|_| ()),
            is_sector,
            axis: model.radius.map(|_| !has_other_claim && poles(&mut graph, model).is_empty()),
            defaults: parameters.map(|it| Default::new(&graph, it.default)).collect(),
        })
    }

    /// The values of all parameters if the field surely allows those that are set.
    pub fn accepted(&self, set: &SortedMap<usize, Rational>) -> Option<Vec<f64>> {
        let (mut enclosures, mut values) = (Vec::new(), Vec::new());
        for (index, default) in self.defaults.iter().enumerate() {
            let (enclosure, value) = match set.get(&index) {
                None => default.of(&enclosures, &values),
                Some(number) => {
                    // A set value must be a double precision number exactly; the full check handles others.
                    let value = number.to_f64().value();
                    Rational::try_from(value).ok().filter(|exact| exact == number)?;
                    (Interval::new(value, value), Double::from(value))
                }
            };
            enclosures.push(enclosure);
            values.push(value);
        }
        let values = values.into_iter().map(Double::to_f64).collect();
        self.allows(&enclosures).then_some(values)
    }

    fn allows(&self, parameters: &[Interval]) -> bool {
        let mut interpreter = Interpreter::new(&self.program, parameters);
        let early = [CheckOutput::Ranges, CheckOutput::Body, CheckOutput::Time]
            .map(|output| interpreter.output(output));
        let [ranges, body, time] = &early;
        let ranged = self.ranged.iter().map(|index| parameters[*index]);
        let within = |(value, range): (Interval, &[Interval])| {
            at_most(range[0], value) && at_most(value, range[1])
        };
        let Some(corners) = self.corners(body) else { return false };
        if !(ranged.zip(ranges.chunks_exact(2)).all(within) && below(time[0], time[1])) {
            return false;
        }
        let plan = interpreter.plan(&[
            CheckOutput::Density,
            CheckOutput::Poisson,
            CheckOutput::Defined,
            CheckOutput::Stiffness,
        ]);
        interpreter.set_point(&plan, Point::at(&corners));
        let of_numbers = |value: f64| Interval::new(value, value);
        let is_ratio = |it: &Interval| below(of_numbers(-1.0), *it) && below(*it, of_numbers(0.5));
        let is_defined = |it: &Interval| it.is_defined() && it.farthest() < f64::INFINITY;
        interpreter.output(CheckOutput::Density).iter().all(|it| below(of_numbers(0.0), *it))
            && interpreter.output(CheckOutput::Poisson).iter().all(is_ratio)
            && interpreter.output(CheckOutput::Defined).iter().all(is_defined)
            && self.is_stiff(&interpreter.output(CheckOutput::Stiffness))
    }

    /// Coordinates that enclose the body; `None` if it may be empty.
    fn corners(&self, body: &[Interval]) -> Option<Vec<Interval>> {
        let zero = Interval::new(0.0, 0.0);
        let ascend = |bounds: &[Interval; 2]| below(bounds[0], bounds[1]);
        let hull = |[from, to]: &[Interval; 2]| Interval::new(from.lower(), to.upper());
        // The test does not check whether the edges of a polygon cross.
        let Region::Block(block) = self.body.with(body.to_vec()) else { return None };
        if block.system == System::Cartesian {
            let inner = block.bounds[0][0];
            let is_beside = match self.axis {
                Some(true) => at_most(zero, inner),
                Some(false) => below(zero, inner),
                None => true,
            };
            let is_box = is_beside && block.bounds.iter().all(ascend);
            return is_box.then(|| block.bounds.iter().map(hull).collect());
        }
        let [[inner, outer], theta] = block.bounds.first_chunk()?;
        let is_part = ascend(theta) && (theta[1] - theta[0]).upper() < TURN;
        let is_ring = below(zero, *inner) && below(*inner, *outer);
        let third = block.bounds.get(2);
        let is_within = third.is_none_or(ascend)
            && match (block.system, third) {
                (System::Spherical, Some([first, last])) => {
                    let half = Interval::new(POLE, POLE);
                    at_most(zero, *first) && at_most(*last, half)
                }
                _ => true,
            };
        let reach = Interval::new(-outer.upper(), outer.upper());
        let mut corners = vec![reach; self.dimension];
        if let (System::Polar, Some(ends)) = (block.system, third) {
            corners[2] = hull(ends);
        }
        (is_ring && is_within && (is_part || !self.is_sector)).then_some(corners)
    }

    /// Whether Q_ik = A_i1k1 is positive definite: for an isotropic solid, that is enough (see [`super::elasticity`]).
    fn is_stiff(&self, tangent: &[Interval]) -> bool {
        // dP/dF has the fourth power of the number of rows.
        let size = tangent.len().isqrt().isqrt();
        let entry = |i: usize, k: usize| tangent[(i * size * size + k) * size];
        let mut matrix: Vec<Vec<_>> =
            (0..size).map(|i| (0..size).map(|k| entry(i, k)).collect()).collect();
        for row in 0..size {
            let (above, rest) = matrix.split_at_mut(row + 1);
            let above = &above[row];
            if !below(Interval::new(0.0, 0.0), above[row]) {
                return false;
            }
            for below in rest {
                let factor = below[row] / above[row];
                for (entry, over) in below.iter_mut().zip(above) {
                    *entry = *entry - factor * *over;
                }
            }
        }
        true
    }
}

/// The expressions that the test evaluates.
fn outputs(graph: &mut Graph, model: &Model) -> SortedMap<CheckOutput, Vec<Expr>> {
    let ranges = model.parameters.iter().filter_map(|parameter| parameter.range).flatten();
    let body = model.domain.body.values();
    let (_, slopes) = curvatures(graph, model);
    SortedMap::from([
        (CheckOutput::Ranges, ranges.collect()),
        (CheckOutput::Body, body),
        (CheckOutput::Time, model.domain.time.to_vec()),
        (CheckOutput::Density, vec![model.density]),
        (CheckOutput::Poisson, model.poisson.into_iter().collect()),
        (CheckOutput::Defined, [&model.arguments[..], &slopes].concat()),
        (CheckOutput::Stiffness, stiffness(graph, model)),
    ])
}

/// Whether a < b for all numbers of the intervals.
fn below(a: Interval, b: Interval) -> bool {
    a.is_defined() && b.is_defined() && a.upper() < b.lower()
}

/// Whether a <= b for all numbers of the intervals.
fn at_most(a: Interval, b: Interval) -> bool {
    a.is_defined() && b.is_defined() && a.upper() <= b.lower()
}
