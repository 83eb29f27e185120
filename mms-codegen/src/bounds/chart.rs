//! The variables of a field as a box: parameters with a range, the time, and coordinates between the bounds of the body.
//!
//! A round body is a box in radius and angles; a face is a box of one variable less. A polygon is a row of triangles, each the
//! image of a square, one side of which collapses to a corner. So every proof over a domain is a proof over a box. Where all
//! angles map to one place, as on an axis, the bounds are still valid: they bound values at places, not at angles.

use super::search::{Cell, Limit};
use mms_math::coordinates::System;
use mms_math::polygon::padded;
use mms_mechanics::extent::{Block, Region};
use mms_mechanics::face::{self, Formulas, POLAR_ANGLE, RADIUS};
use mms_mechanics::model::Model;
use mms_mechanics::tensor::Tensor;
use mms_mechanics::triangles;
use mms_program::interpret::{Interpreter, Number};
use mms_program::interval::Interval;
use mms_program::precise::Precise;
use mms_program::schedule::schedule_plainly;
use mms_program::{Key, Program};
use mms_spec::{Face, FieldSpec};
use mms_symbolic::expr::{Expr, Function, Graph, Node, Rational, Symbol};
use mms_symbolic::pass::reduce::reduce;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::substitute::{rebuild, substitute};
use mms_symbolic::sorted::SortedMap;
use mms_symbolic::work::Work;

/// The variables of a field on its body or on a face, and the expressions in them that replace the other symbols.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The symbols that vary: parameters, the time, coordinates.
    variables: Vec<Symbol>,
    /// The expressions that replace the other parameters, and a coordinate that is constant on a face.
    fixed: SortedMap<Symbol, Expr>,
    /// X in terms of radius and angles; empty if the coordinates are Cartesian.
    places: SortedMap<Symbol, Expr>,
    system: System,
    /// The triangles of a polygon, padded to a power of two in number: so bisection soon separates them.
    triangles: Vec<[usize; 3]>,
    /// The bounds of each variable, in terms of the parameters among those before it; then X and
    /// all parameters.
    program: Program<ChartOutput>,
    /// The number of components of X, and the number of parameters.
    dimension: usize,
    parameters: usize,
    /// The budget of all evaluations in the chart.
    work: Work,
}

/// An output of the chart's program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ChartOutput {
    /// The two bounds of the variable of this index.
    Bounds(usize),
    /// The vertices of a polygon, one after another.
    Vertices,
    /// All parameters.
    Parameters,
    /// X.
    Coordinates,
}

impl Chart {
    /// The chart of the body, or of one of its faces.
    pub fn new(graph: &mut Graph, field: &FieldSpec, model: &Model, face: Option<Face>) -> Self {
        let body = &model.domain.body;
        let (mut fixed, mut variables) = (SortedMap::new(), Vec::new());
        for (index, parameter) in model.parameters.iter().enumerate() {
            let symbol = Symbol::Parameter(index);
            match parameter.range {
                Some(range) if !field.parameters[index].frozen => variables.push((symbol, range)),
                _ => {
                    let value = substitute(graph, &[parameter.default], &fixed)[0];
                    fixed.insert(symbol, value);
                }
            }
        }
        variables.push((Symbol::Time, model.domain.time));
        if let Some(face) = face {
            for (symbol, bound) in face::constant(body, face) {
                let bound = substitute(graph, &[bound], &fixed)[0];
                fixed.insert(symbol, bound);
            }
        }
        variables.extend(face::ranges(graph, body, face));
        let places = face::positions(graph, body, face);
        let system = match body {
            Region::Block(Block { system, .. }) => *system,
            _ => System::Cartesian,
        };
        let triangles = match face {
            None => padded(triangles(graph, model)),
            Some(_) => Vec::new(),
        };
        let mut outputs = SortedMap::new();
        for (index, (_, bounds)) in variables.iter().enumerate() {
            outputs.insert(ChartOutput::Bounds(index), substitute(graph, bounds, &fixed));
        }
        if let Region::Polygon(_) = body {
            outputs.insert(ChartOutput::Vertices, substitute(graph, &body.values(), &fixed));
        }
        let leaves = |graph: &mut Graph, count: usize, symbol: fn(usize) -> Symbol| -> Vec<Expr> {
            (0..count).map(|index| graph.symbol(symbol(index))).collect()
        };
        let place = leaves(graph, field.dimension, Symbol::Coordinate);
        let place = substitute(graph, &place, &places);
        outputs.insert(ChartOutput::Coordinates, substitute(graph, &place, &fixed));
        let parameters = leaves(graph, model.parameters.len(), Symbol::Parameter);
        outputs.insert(ChartOutput::Parameters, substitute(graph, &parameters, &fixed));
        Chart {
            variables: variables.into_iter().map(|(symbol, _)| symbol).collect(),
            fixed,
            places,
            system,
            triangles,
            program: schedule_plainly(graph, &outputs),
            dimension: field.dimension,
            parameters: model.parameters.len(),
            work: graph.work().share(),
        }
    }

    /// The remaining budget for evaluations: the budget of the graph.
    pub fn work(&self) -> &Work {
        &self.work
    }

    /// The limit of a search of at most `cells` cells within this budget.
    pub fn limit(&self, cells: usize) -> Limit<'_> {
        Limit { cells, work: Some(&self.work) }
    }

    /// The symbols that vary.
    pub fn variables(&self) -> &[Symbol] {
        &self.variables
    }

    /// Rewrites formulas in X in terms of the variables.
    pub fn pull_back(&self, graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
        let general = straightened(graph, formulas, &self.places);
        self.fix(graph, &general)
    }

    /// The components of a pulled-back tensor in the basis of the coordinates: Q^T A Q with the
    /// directions of growing radius and angles as the columns of Q.
    pub fn in_local_basis(&self, graph: &mut Graph, tensor: &[Expr]) -> Vec<Expr> {
        let dimension = self.dimension;
        if self.system == System::Cartesian {
            return tensor.to_vec();
        }
        let coordinates = face::coordinates(graph);
        let directions = self.system.basis(&mut Formulas(graph), &coordinates);
        let basis = Tensor::from_fn(dimension, |row, column| directions[column][row]);
        let basis = self.fix(graph, basis.components());
        let basis = Tensor::from_components(dimension, basis);
        let tensor = Tensor::from_components(dimension, tensor.to_vec());
        let rotated = basis.transpose().mul(graph, &tensor).mul(graph, &basis);
        let reduced = graph.attempt(|graph| {
            let relations = Relations::find(graph, rotated.components());
            reduce(graph, rotated.components(), &relations)
        });
        reduced.unwrap_or_else(|| rotated.components().to_vec())
    }

    /// For each variable, its width over a cell due to its own fraction, and the further width due to the ranges of the
    /// parameters that its bounds depend on.
    fn widths(&self, cell: &Cell, place: &[Interval]) -> Vec<[f64; 2]> {
        let total = || place.iter().map(|side| side.width());
        if self.ranged().next().is_none() {
            return total().map(|width| [width, 0.0]).collect();
        }
        let centre = cell.centre();
        let at = self.place(&centre);
        let own = |(variable, side): (usize, &Interval)| {
            let mut moved = centre.clone();
            moved[variable] = side.upper();
            2.0 * (self.place(&moved)[variable] - at[variable]).abs()
        };
        let own = cell.0.iter().enumerate().map(own);
        own.zip(total()).map(|(own, total)| [own, (total - own).max(0.0)]).collect()
    }

    /// For each variable, the change that it causes over a cell, summed over all formulas with these slopes.
    pub fn changes(&self, cell: &Cell, place: &[Interval], slopes: &[Vec<Interval>]) -> Vec<f64> {
        let widths = self.widths(cell, place);
        let slopes = slopes.iter().map(|by| by.iter().map(|slope| slope.farthest()).sum::<f64>());
        let slopes: Vec<f64> = slopes.collect();
        let along: f64 = slopes.iter().zip(&widths).map(|(slope, width)| slope * width[1]).sum();
        let mut changes: Vec<f64> =
            slopes.iter().zip(&widths).map(|(slope, width)| slope * width[0]).collect();
        for variable in self.ranged() {
            changes[variable] += along;
        }
        if !self.triangles.is_empty() {
            self.changes_in_triangles(cell, &slopes, &mut changes);
        }
        changes
    }

    /// Computes the changes of X and Y over a cell of fractions of a polygon's triangle, each of which moves both.
    fn changes_in_triangles(&self, cell: &Cell, slopes: &[f64], changes: &mut [f64]) {
        let first = cell.0.len() - 2;
        let centre = cell.centre();
        let at = self.place(&centre);
        for own in first..cell.0.len() {
            let mut moved = centre.clone();
            moved[own] = cell.0[own].lower();
            let to = self.place(&moved);
            let by = |axis: usize| slopes[axis] * 2.0 * (to[axis] - at[axis]).abs();
            changes[own] = by(first) + by(first + 1);
        }
        let [from, to] = self.within(&cell.0[first]);
        if from != to {
            // A cell that lies across two triangles is cut between them first.
            changes[first] = f64::INFINITY;
        }
    }

    /// The first and the last triangle that a fraction may lie in.
    fn within<T: Number>(&self, fraction: &T) -> [usize; 2] {
        let count = self.triangles.len();
        let [lower, upper] = fraction.bounds().map(|end| end * count as f64);
        let last = (upper.ceil() as usize).saturating_sub(1).min(count - 1);
        [(lower.floor().max(0.0) as usize).min(last), last]
    }

    /// X and Y in the triangles of a polygon with these vertices.
    fn in_triangles<T: Number>(&self, vertices: &[T], fractions: &[T]) -> [T; 2] {
        let count = self.triangles.len() as f64;
        let [first, last] = self.within(&fractions[0]);
        let point = |triangle: usize, s: &T, t: &T| -> [T; 2] {
            let corners = self.triangles[triangle];
            std::array::from_fn(|axis| {
                let [a, b, c] = corners.map(|corner| vertices[2 * corner + axis].clone());
                let far = b.clone() - a.clone() + t.clone() * (c - b);
                a + s.clone() * far
            })
        };
        let along = fractions[0].clone() * T::from_f64(count);
        let [[from, to], across] = [&along, &fractions[1]].map(|fraction| fraction.bounds());
        if from == to && across[0] == across[1] {
            let s = along - T::from_f64(first as f64);
            return point(first, &s, &fractions[1]);
        }
        // The image of a rectangle is the hull of the images of its corners, for X and Y are linear in each fraction.
        let mut hull: Option<[T; 2]> = None;
        for triangle in first..=last {
            let ends = [from, to].map(|end| (end - triangle as f64).clamp(0.0, 1.0));
            for (s, t) in ends.into_iter().flat_map(|s| across.map(|t| (s, t))) {
                let corner = point(triangle, &T::from_f64(s), &T::from_f64(t));
                hull = Some(match hull {
                    Some(hull) => {
                        let [x, y] = hull;
                        let [own_x, own_y] = corner;
                        [x.or(own_x), y.or(own_y)]
                    }
                    None => corner,
                });
            }
        }
        hull.unwrap_or_else(|| [0, 1].map(|_| T::from_f64(f64::NAN)))
    }

    /// Rewrites formulas in all parameters in terms of the variables; parameters that do not vary get their defaults.
    pub fn fix(&self, graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
        substitute(graph, formulas, &self.fixed)
    }

    /// The values of the variables at fractions of the way from their lower to their upper bounds.
    pub fn place<T: Number>(&self, fractions: &[T]) -> Vec<T> {
        let mut values: Vec<T> = Vec::with_capacity(fractions.len());
        let (mut interpreter, mut known) = (None, 0);
        for (index, fraction) in fractions.iter().enumerate() {
            if self.work.is_over() {
                values.push(T::from_f64(f64::NAN));
                continue;
            }
            let count = self.ranged().take_while(|ranged| *ranged < index).count();
            if interpreter.is_none() || count != known {
                let parameters = self.raw_parameters(&values);
                interpreter = Some(Interpreter::within(&self.work, &self.program, &parameters));
                known = count;
            }
            if !self.triangles.is_empty() && index + 2 == fractions.len() {
                let vertices = interpreter.as_ref().map(|it| it.output(ChartOutput::Vertices));
                let vertices = vertices.unwrap_or_default();
                values.extend(self.in_triangles(&vertices, &fractions[index..]));
                break;
            }
            let bounds = interpreter.as_ref().map(|it| it.output(ChartOutput::Bounds(index)));
            let Some([lower, upper]) = bounds.as_deref() else { continue };
            let length = upper.clone() - lower.clone();
            values.push(lower.clone() + length * fraction.clone());
        }
        values
    }

    /// The parameters that vary, by position.
    pub fn varying_parameters(&self) -> impl Iterator<Item = usize> {
        self.variables.iter().filter_map(|symbol| match symbol {
            Symbol::Parameter(index) => Some(*index),
            _ => None,
        })
    }

    /// The indices of the variables that are parameters.
    fn ranged(&self) -> impl Iterator<Item = usize> {
        let count = self.variables.iter().position(|symbol| *symbol == Symbol::Time);
        0..count.unwrap_or(0)
    }

    /// The values of all parameters; those whose variables have no value yet are 0, and unused.
    fn raw_parameters<T: Number>(&self, values: &[T]) -> Vec<T> {
        let mut parameters = vec![T::from_f64(0.0); self.parameters];
        for (symbol, value) in self.variables.iter().zip(values) {
            if let Symbol::Parameter(index) = symbol {
                parameters[*index] = value.clone();
            }
        }
        parameters
    }

    /// The time, and coordinates by axis.
    fn split<T: Number>(&self, values: &[T]) -> (T, Vec<T>) {
        let mut time = T::from_f64(0.0);
        let mut coordinates = vec![T::from_f64(0.0); self.dimension];
        for (symbol, value) in self.variables.iter().zip(values) {
            match symbol {
                Symbol::Time => time = value.clone(),
                Symbol::Coordinate(axis) => coordinates[*axis] = value.clone(),
                _ => {}
            }
        }
        (time, coordinates)
    }

    /// Prepares a program of pulled-back formulas.
    pub fn run<'a, T: Number, K: Key>(&'a self, program: &'a Program<K>) -> ChartProgram<'a, T, K> {
        let ready = self.ranged().next().is_none().then(|| {
            let parameters = self.raw_parameters::<T>(&[]);
            Interpreter::within(&self.work, program, &parameters)
        });
        ChartProgram { chart: self, program, ready, plans: Vec::new(), cost_factor: 1 }
    }

    /// Prepares the map from the variables of the chart to parameters, time and X: see [`ChartProgram::point`].
    pub fn points<T: Number>(&self) -> ChartProgram<'_, T, ChartOutput> {
        self.run(&self.program)
    }
}

/// A program of formulas in the variables of a chart.
pub struct ChartProgram<'a, T: Number, K> {
    chart: &'a Chart,
    program: &'a Program<K>,
    /// The interpreter after the stage of parameters, if none of them varies.
    ready: Option<Interpreter<'a, T, K>>,
    /// The instructions that each requested list of outputs needs.
    plans: Vec<(Vec<K>, Vec<bool>)>,
    /// The factor by which the cost of each operation is multiplied in the budget.
    cost_factor: u64,
}

/// All parameters, t and X.
#[derive(Clone, Debug)]
pub struct ChartPoint<T> {
    /// The parameters, in the order of the file.
    pub parameters: Vec<T>,
    /// t.
    pub time: T,
    /// X.
    pub coordinates: Vec<T>,
}

impl ChartPoint<Precise> {
    /// Whether every number was computed.
    pub fn is_known(&self) -> bool {
        let all = self.parameters.iter().chain(&self.coordinates).chain([&self.time]);
        all.into_iter().all(Precise::is_defined)
    }
}

impl<T: Number> ChartProgram<'_, T, ChartOutput> {
    /// All parameters, t and X at values of the variables.
    pub fn point(&mut self, values: &[T]) -> ChartPoint<T> {
        let [parameters, coordinates] = self
            .at(values, &[ChartOutput::Parameters, ChartOutput::Coordinates])
            .try_into()
            .unwrap_or_else(|_| unreachable!("two outputs were requested"));
        ChartPoint { parameters, time: self.chart.split(values).0, coordinates }
    }
}

impl<T: Number, K: Key> ChartProgram<'_, T, K> {
    /// Charges every operation `cost_factor` times its steps.
    pub fn charge(&mut self, cost_factor: u64) {
        self.cost_factor = cost_factor;
        self.ready.iter_mut().for_each(|ready| ready.charge(cost_factor));
    }

    /// Computes some outputs at values of the variables.
    pub fn at(&mut self, values: &[T], outputs: &[K]) -> Vec<Vec<T>> {
        self.with(values, &|_| unreachable!("all leaves are variables"), outputs)
    }

    /// Computes some outputs at values of the variables and of the leaves that `open` supplies.
    pub fn with(&mut self, values: &[T], open: &dyn Fn(Symbol) -> T, outputs: &[K]) -> Vec<Vec<T>> {
        let known = self.plans.iter().position(|(planned, _)| planned == outputs);
        let plan = known.unwrap_or_else(|| {
            self.plans.push((outputs.to_vec(), self.program.needed(outputs)));
            self.plans.len() - 1
        });
        let mut own;
        let interpreter = match &mut self.ready {
            Some(ready) => ready,
            None => {
                let parameters = self.chart.raw_parameters(values);
                let work = &self.chart.work;
                own = Interpreter::as_many(work, self.program, &parameters, self.cost_factor);
                &mut own
            }
        };
        let (time, coordinates) = self.chart.split(values);
        interpreter.set_time(&time);
        interpreter.set_leaves(&self.plans[plan].1, &|symbol| match symbol {
            Symbol::Coordinate(axis) => coordinates[axis].clone(),
            other => open(other),
        });
        outputs.iter().map(|output| interpreter.output(*output)).collect()
    }
}

/// Rewrites formulas in X in terms of radius and angles, with sqrt(X^2 + Y^2) and sqrt(X^2 + Y^2 + Z^2) replaced by the radius,
/// or by its part across the axis.
pub fn straightened(
    graph: &mut Graph,
    formulas: &[Expr],
    places: &SortedMap<Symbol, Expr>,
) -> Vec<Expr> {
    if places.is_empty() {
        return formulas.to_vec();
    }
    let replaced = match across(graph, places) {
        Some(across) => {
            let named = with_radii(graph, formulas);
            let radius = graph.symbol(RADIUS);
            let mut places = places.clone();
            places.extend([(ACROSS, across), (WHOLE, radius)]);
            substitute(graph, &named, &places)
        }
        None => substitute(graph, formulas, places),
    };
    let short = graph.attempt(|graph| {
        let relations = Relations::find(graph, &replaced);
        let reduced = reduce(graph, &replaced, &relations);
        without_roots(graph, &reduced)
    });
    short.unwrap_or(replaced)
}

/// R sin phi, if X is given by radius and two angles.
fn across(graph: &mut Graph, places: &SortedMap<Symbol, Expr>) -> Option<Expr> {
    let angle = graph.symbol(POLAR_ANGLE);
    let cosine = graph.call(Function::Cos, &[angle]);
    let radius = graph.symbol(RADIUS);
    let height = graph.mul(radius, cosine);
    if places.get(&POLAR_ANGLE) != Some(&height) {
        return None;
    }
    let sine = graph.call(Function::Sin, &[angle]);
    Some(graph.mul(radius, sine))
}

/// The name of sqrt(X^2 + Y^2) until it is replaced.
const ACROSS: Symbol = Symbol::Local(0);
/// The name of sqrt(X^2 + Y^2 + Z^2) until it is replaced.
const WHOLE: Symbol = Symbol::Local(1);

/// Replaces these two roots in formulas by their names, in any power.
fn with_radii(graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
    let coordinates = face::coordinates(graph);
    let squares = coordinates.map(|it| (graph.power(it, 2), Rational::ONE));
    let [plane, space] = [2, 3].map(|count| graph.sum(squares[..count].iter().cloned()));
    let [across, whole] = [ACROSS, WHOLE].map(|name| graph.symbol(name));
    rebuild(graph, formulas, |graph, node| {
        let Node::Product(factors) = node else { return graph.remake(node) };
        let twice = |exponent: Rational| exponent * Rational::from(2);
        let factors = factors.into_iter().map(|(base, exponent)| match base {
            _ if base == plane => (across, twice(exponent)),
            _ if base == space => (whole, twice(exponent)),
            _ => (base, exponent),
        });
        let factors: Vec<(Expr, Rational)> = factors.collect();
        graph.remake(Node::Product(factors))
    })
}

/// (R^n)^e = R^(n e) for the radius R, which is not negative, and likewise for the sine of phi.
fn without_roots(graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
    let radius = graph.symbol(RADIUS);
    let angle = graph.symbol(POLAR_ANGLE);
    let sine = graph.call(Function::Sin, &[angle]);
    rebuild(graph, formulas, |graph, node| {
        let Node::Product(factors) = node else { return graph.remake(node) };
        let mut found: Vec<(Expr, Rational)> = Vec::new();
        for (base, exponent) in factors {
            match graph.node(base) {
                Node::Product(inner)
                    if inner.iter().all(|(expr, _)| *expr == radius || *expr == sine) =>
                {
                    let powers = inner.iter().map(|(expr, power)| (*expr, power * &exponent));
                    found.extend(powers);
                }
                _ => found.push((base, exponent)),
            }
        }
        graph.remake(Node::Product(found))
    })
}
