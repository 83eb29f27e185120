//! What a field depends on, as a box: parameters with a range, the time, and coordinates between
//! whose bounds the body lies.
//!
//! An annulus is a box in radius and angle; a face is a box of one variable less. So everything that
//! is proved over a domain is proved over a box.

use super::search::{Cell, Limit};
use mms_mechanics::face;
use mms_mechanics::face::{ANGLE, RADIUS};
use mms_mechanics::model::Model;
use mms_mechanics::tensor::Tensor;
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

/// The variables of a field on its body or on a face, and what they replace.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The symbols that vary: parameters, the time, coordinates.
    variables: Vec<Symbol>,
    /// What stands for the other parameters, and for a coordinate that is constant on a face.
    fixed: SortedMap<Symbol, Expr>,
    /// X in terms of radius and angle; empty for a box.
    polar: SortedMap<Symbol, Expr>,
    /// The bounds of each variable, in terms of the parameters among those before it; then X and
    /// all parameters.
    program: Program<Output>,
    /// How many components X has, and how many parameters there are.
    dimension: usize,
    parameters: usize,
    /// What all that is evaluated in the chart may take together.
    work: Work,
}

/// What the chart's program computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Output {
    /// The two bounds of the variable of that index.
    Bounds(usize),
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
        let constant = face.map(face::fixed_coordinate);
        for (axis, bounds) in face::bounds(body).into_iter().enumerate() {
            let symbol = Symbol::Coordinate(axis);
            match constant {
                Some((fixed_axis, is_upper)) if fixed_axis == axis => {
                    let bound = substitute(graph, &[bounds[usize::from(is_upper)]], &fixed)[0];
                    fixed.insert(symbol, bound);
                }
                _ => variables.push((symbol, bounds)),
            }
        }
        let polar = face::polar(graph, body);
        let mut outputs = SortedMap::new();
        for (index, (_, bounds)) in variables.iter().enumerate() {
            outputs.insert(Output::Bounds(index), substitute(graph, bounds, &fixed));
        }
        let leaves = |graph: &mut Graph, count: usize, symbol: fn(usize) -> Symbol| -> Vec<Expr> {
            (0..count).map(|index| graph.symbol(symbol(index))).collect()
        };
        let place = leaves(graph, field.dimension, Symbol::Coordinate);
        let place = substitute(graph, &place, &polar);
        outputs.insert(Output::Coordinates, substitute(graph, &place, &fixed));
        let parameters = leaves(graph, model.parameters.len(), Symbol::Parameter);
        outputs.insert(Output::Parameters, substitute(graph, &parameters, &fixed));
        Chart {
            variables: variables.into_iter().map(|(symbol, _)| symbol).collect(),
            fixed,
            polar,
            program: schedule_plainly(graph, &outputs),
            dimension: field.dimension,
            parameters: model.parameters.len(),
            work: graph.work().share(),
        }
    }

    /// What may still be evaluated: the budget of the graph.
    pub fn work(&self) -> &Work {
        &self.work
    }

    /// A search of at most so many cells, within that budget.
    pub fn limit(&self, cells: usize) -> Limit<'_> {
        Limit { cells, work: Some(&self.work) }
    }

    /// The symbols that vary.
    pub fn variables(&self) -> &[Symbol] {
        &self.variables
    }

    /// Formulas in X in terms of the variables.
    pub fn pull_back(&self, graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
        let general = straightened(graph, formulas, &self.polar);
        self.fix(graph, &general)
    }

    /// The components of a pulled-back tensor in the basis of the coordinates: Q^T A Q with the
    /// directions of growing radius and angle as the columns of Q.
    pub fn in_local_basis(&self, graph: &mut Graph, tensor: &[Expr]) -> Vec<Expr> {
        if self.polar.is_empty() {
            return tensor.to_vec();
        }
        let angle = graph.symbol(ANGLE);
        let angle = self.fix(graph, &[angle])[0];
        let [sine, cosine] =
            [Function::Sin, Function::Cos].map(|function| graph.call(function, &[angle]));
        let minus = graph.scale(sine, -1);
        let basis = Tensor::from_components(2, vec![cosine, minus, sine, cosine]);
        let tensor = Tensor::from_components(2, tensor.to_vec());
        let rotated = basis.transpose().mul(graph, &tensor).mul(graph, &basis);
        let reduced = graph.attempt(|graph| {
            let relations = Relations::find(graph, rotated.components());
            reduce(graph, rotated.components(), &relations)
        });
        reduced.unwrap_or_else(|| rotated.components().to_vec())
    }

    /// By how much each fraction alone moves each variable in a cell, and by how much the parameters
    /// move it along with their own range.
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

    /// How much each variable changes formulas with these slopes over a cell, all of them together.
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
        changes
    }

    /// Formulas in all parameters in terms of the variables: the others have their defaults.
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
            let bounds = interpreter.as_ref().map(|it| it.output(Output::Bounds(index)));
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

    /// Which variables are parameters.
    fn ranged(&self) -> impl Iterator<Item = usize> {
        let count = self.variables.iter().position(|symbol| *symbol == Symbol::Time);
        0..count.unwrap_or(0)
    }

    /// Values of the variables among the parameters; what is not known yet is 0, and unused.
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

    /// Prepares a program of formulas that were pulled back.
    pub fn run<'a, T: Number, K: Key>(&'a self, program: &'a Program<K>) -> Run<'a, T, K> {
        let ready = self.ranged().next().is_none().then(|| {
            let parameters = self.raw_parameters::<T>(&[]);
            Interpreter::within(&self.work, program, &parameters)
        });
        Run { chart: self, program, ready, plans: Vec::new(), times: 1 }
    }

    /// Prepares what a place is without the chart: see [`Run::point`].
    pub fn points<T: Number>(&self) -> Run<'_, T, Output> {
        self.run(&self.program)
    }
}

/// A program of formulas in the variables of a chart.
pub struct Run<'a, T: Number, K> {
    chart: &'a Chart,
    program: &'a Program<K>,
    /// After the stage of parameters, where none of them varies.
    ready: Option<Interpreter<'a, T, K>>,
    /// What outputs need that were asked for.
    plans: Vec<(Vec<K>, Vec<bool>)>,
    /// How many times what an operation takes is charged.
    times: u64,
}

/// All parameters, t and X.
#[derive(Clone, Debug)]
pub struct Spot<T> {
    /// In the order of the file.
    pub parameters: Vec<T>,
    /// t.
    pub time: T,
    /// X.
    pub coordinates: Vec<T>,
}

impl Spot<Precise> {
    /// Whether all of it was computed.
    pub fn is_known(&self) -> bool {
        let all = self.parameters.iter().chain(&self.coordinates).chain([&self.time]);
        all.into_iter().all(Precise::is_defined)
    }
}

impl<T: Number> Run<'_, T, Output> {
    /// All parameters, t and X at values of the variables.
    pub fn point(&mut self, values: &[T]) -> Spot<T> {
        let [parameters, coordinates] = self
            .at(values, &[Output::Parameters, Output::Coordinates])
            .try_into()
            .unwrap_or_else(|_| unreachable!("two outputs were asked for"));
        Spot { parameters, time: self.chart.split(values).0, coordinates }
    }
}

impl<T: Number, K: Key> Run<'_, T, K> {
    /// Charges every operation as so many.
    pub fn charge(&mut self, times: u64) {
        self.times = times;
        self.ready.iter_mut().for_each(|ready| ready.charge(times));
    }

    /// Some outputs at values of the variables.
    pub fn at(&mut self, values: &[T], outputs: &[K]) -> Vec<Vec<T>> {
        self.with(values, &|_| unreachable!("all leaves are variables"), outputs)
    }

    /// Some outputs at values of the variables and of the leaves that are left open.
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
                own = Interpreter::as_many(work, self.program, &parameters, self.times);
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

/// Formulas in X in terms of radius and angle, and without sqrt(X^2 + Y^2), which is the radius.
pub fn straightened(
    graph: &mut Graph,
    formulas: &[Expr],
    polar: &SortedMap<Symbol, Expr>,
) -> Vec<Expr> {
    if polar.is_empty() {
        return formulas.to_vec();
    }
    let replaced = substitute(graph, formulas, polar);
    let short = graph.attempt(|graph| {
        let relations = Relations::find(graph, &replaced);
        let reduced = reduce(graph, &replaced, &relations);
        without_roots(graph, &reduced)
    });
    short.unwrap_or(replaced)
}

/// (R^n)^e = R^(n e) for the radius R, which is not negative.
fn without_roots(graph: &mut Graph, formulas: &[Expr]) -> Vec<Expr> {
    let radius = graph.symbol(RADIUS);
    rebuild(graph, formulas, |graph, node| {
        let Node::Product(factors) = node else { return graph.remake(node) };
        let factors = factors.into_iter().map(|(base, exponent)| match graph.node(base) {
            Node::Product(inner) => match inner.as_slice() {
                [(expr, power)] if *expr == radius => (radius, power * exponent),
                _ => (base, exponent),
            },
            _ => (base, exponent),
        });
        let factors: Vec<(Expr, Rational)> = factors.collect();
        graph.remake(Node::Product(factors))
    })
}
