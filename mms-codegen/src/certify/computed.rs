//! Proves that finite values are finite as computed, too: by the scheduled program, with every intermediate value, in the
//! precision that it runs in.
//!
//! Each value is a pair (`mms-program/src/computed.rs`): bounds of the exact value, and of the distance of a computed value
//! from it. Every operation passes the distance on by the mean-value theorem, and adds its rounding and the least subnormal
//! number. The exact part is made sharper by formulas: each operand of a division, a root or a logarithm is written once more
//! as a formula in the variables of the box, as a multiple of J or bounded by its mean-value form. A divisor, a root or a
//! logarithm must be of the right sign with the error included. An overflow has no value, and neither has the sine, in twice
//! the digits, of an angle above 2^50. Values of the last two stages have the precision that is proved; values of the first two
//! stages have twice its digits.
//!
//! The verdict for `f64` is part of the verdict that everything is finite. The verdict for `f32` has its own line in the report;
//! `mms run` and `mms study` report an error only if a quantity cannot be computed in `f32` at a corner or in the middle of the
//! chart.
//!
//! The errors of the angles of sines, cosines and tangents bound how many of their digits are right. The program subtracts whole
//! turns from an angle such as c t. The bound of the error compares with the exact angle after as many turns are subtracted.
//! That number is uncertain for angles of more than a few turns, so that only the largest magnitude of the reduced angle is known.

use mms_math::Scalar as _;

use super::finite::{blame, corners};
use crate::bounds::chart::{Chart, ChartPoint, ChartProgram};
use crate::bounds::enclosure::Formulas;
use crate::bounds::search::{Cell, Measure, largest};
use crate::bounds::witness::{Witness, digits};
use crate::compile::Compiled;
use mms_mechanics::{Output, Program};
use mms_program::computed::{Computed, Double, Format, Single};
use mms_program::interpret::{Number, apply};
use mms_program::interval::Interval;
use mms_program::precise::Precise;
use mms_program::precision::Precision;
use mms_program::{Op, Stage, Value};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Function, Graph, Symbol};
use mms_symbolic::sorted::SortedSet;

/// The number of correct digits after the point from which an angle counts as accurate.
pub const ENOUGH_DIGITS: f64 = 6.0;

/// The steps that are charged for an operation on bounds and errors.
const STEPS: u64 = 20;
/// An operation that takes more steps than this is charged all of them in place of `STEPS`.
const SLOW: u64 = 10_000;
/// The steps that are charged for an operation in 77 digits, a function or not.
const STEPS_OF_DIGITS: u64 = 2_000;

/// The verdict about a program in one precision.
#[derive(Clone, Debug, PartialEq)]
pub enum ComputedVerdict {
    /// Every quantity is computed as a finite number everywhere, and J as a positive one.
    Proved,
    /// A quantity that is not computed at this place; the text names the operation that has no value.
    Fails(Quantity, Witness, String),
    /// Nothing is refuted, but near here this quantity is not proved to be computed.
    Unproved(Quantity, Witness),
    /// The program was not examined: some quantity has no value, or J > 0 is not proved.
    NotApplicable,
}

/// The proof that a program in one precision computes its quantities.
#[derive(Clone, Debug, PartialEq)]
pub struct ComputedProof {
    /// Whether the program computes its quantities.
    pub verdict: ComputedVerdict,
    /// The least number of right digits after the point of the angles of sines, cosines and tangents, and the place where it is
    /// least; `None` if there are no such angles, or if the number is not known.
    pub angles: Option<(f64, Witness)>,
    /// The number of cells.
    pub cells: usize,
}

impl ComputedProof {
    /// The result if the program was not examined.
    pub const NOT_APPLICABLE: ComputedProof =
        ComputedProof { verdict: ComputedVerdict::NotApplicable, angles: None, cells: 0 };
}

/// Bounds the program of a field in `f64` and in `f32`, each with at most `operations` operations. `jacobian` is J with its
/// known bounds.
pub fn bound(
    graph: &mut Graph,
    chart: &Chart,
    compiled: &Compiled,
    jacobian: (Expr, [f64; 2]),
    operations: usize,
) -> [ComputedProof; 2] {
    let quantities = QuantityProgram::new(compiled);
    let operands = Operands::new(graph, chart, &quantities, jacobian);
    [
        quantities.bound::<Double, f64>(chart, &operands, operations),
        quantities.bound::<Single, f32>(chart, &operands, operations),
    ]
}

/// Finds a quantity that a precision does not compute at a corner or in the middle of a chart, though it has a value there.
/// `None` proves nothing.
pub fn failure(
    compiled: &Compiled,
    chart: &Chart,
    precision: Precision,
) -> Option<ComputedVerdict> {
    let quantities = QuantityProgram::new(compiled);
    let whole = Cell::whole(chart.variables().len());
    let mut at = chart.points::<f64>();
    let operations = compiled.program.instrs.len() as u64;
    let mut fails = |fractions: &Vec<f64>| {
        chart.work().spend(STEPS * operations);
        if chart.work().is_over() {
            return None;
        }
        let spot = at.point(&chart.place(fractions));
        let (quantity, cause) = match precision {
            Precision::F32 => quantities.failure::<f32>(&spot)?,
            Precision::F64 => quantities.failure::<f64>(&spot)?,
            Precision::Wide => return None,
        };
        chart.work().spend(STEPS_OF_DIGITS * operations);
        let (witness, exact) = Witness::at(chart, fractions);
        quantities
            .has_value(&exact, quantity)
            .then_some(ComputedVerdict::Fails(quantity, witness, cause))
    };
    corners(&whole).iter().chain([&whole.centre()]).find_map(&mut fails)
}

/// Points of a box whose coordinates and times are numbers of a format.
fn computed<F: Format>(spot: &ChartPoint<Interval>) -> ChartPoint<Computed<F>> {
    ChartPoint {
        parameters: spot.parameters.iter().copied().map(Computed::rounded).collect(),
        time: Computed::input(spot.time),
        coordinates: spot.coordinates.iter().copied().map(Computed::input).collect(),
    }
}

/// The part of a program that computes the quantities.
struct QuantityProgram<'a> {
    program: &'a Program,
    /// The instructions that the quantities need.
    plan: Vec<bool>,
    /// The angles of circular functions, by position, and their units.
    angles: Vec<(usize, f64)>,
}

/// The values of a program: in the precision that is proved, and in the wider precision of the first two stages.
struct Values<T: Number> {
    narrow: Vec<T>,
    wide: Vec<T::Wide>,
}

impl<'a> QuantityProgram<'a> {
    fn new(compiled: &'a Compiled) -> Self {
        let program = &compiled.program;
        let is_quantity = |output: &&Output| matches!(output, Output::Quantity(_));
        let outputs: Vec<Output> = program.outputs.keys().filter(is_quantity).copied().collect();
        let plan = program.needed(&outputs);
        let angle = |(index, needed): (usize, &bool)| match program.instrs[index].op {
            Op::Unary(function, _, angle) if *needed => Some((angle.index(), unit(function)?)),
            _ => None,
        };
        let angles = plan.iter().enumerate().filter_map(angle).collect();
        QuantityProgram { program, plan, angles }
    }

    /// The operands of divisions, roots, logarithms, powers and arc functions, in order.
    fn sensitive(&self) -> Vec<usize> {
        let of = |op: &Op| match *op {
            Op::Divide(_, x) => Some(x),
            Op::Unary(function, _, x) if ends(function) => Some(x),
            Op::Binary(Function::Powf, x, _) => Some(x),
            _ => None,
        };
        let instrs = self.program.instrs.iter().zip(&self.plan);
        let operands = instrs.filter(|(_, needed)| **needed).filter_map(|(it, _)| of(&it.op));
        let output = self.program.outputs.get(&Output::Quantity(Quantity::Jacobian));
        let all: SortedSet<usize> =
            operands.chain(output.into_iter().flatten().copied()).map(Value::index).collect();
        all.into_iter().collect()
    }

    /// Bounds the program in one precision.
    fn bound<F: Format, T: Number + Into<f64> + Copy>(
        &self,
        chart: &Chart,
        operands: &Operands,
        operations: usize,
    ) -> ComputedProof {
        let dimension = chart.variables().len();
        let mut judge = Judge { quantities: self, chart, operands, spots: chart.points() };
        let mut at = chart.points::<f64>();
        let (mut worst, mut failure) = (None::<(f64, Cell)>, None);
        let mut fails = |fractions: &[f64]| {
            let spot = at.point(&chart.place(fractions));
            // If the budget is spent, every value is missing.
            let (quantity, cause) = self.failure::<T>(&spot).filter(|_| !chart.work().is_over())?;
            Some(ComputedVerdict::Fails(quantity, Witness::at(chart, fractions).0, cause))
        };
        let mut candidates = corners(&Cell::whole(dimension));
        // One evaluation for the cell itself, one for each operand, and one for each cell that is thinner by one variable.
        let limit = operations / ((4 + dimension) * self.program.instrs.len().max(1));
        let is_enough = |bound: f64, attained: f64| bound <= 0.0 || attained > 0.0;
        let found = largest(dimension, chart.limit(limit), is_enough, |cell| {
            let (gap, error) = judge.judge::<F>(cell);
            let at = cell.centre();
            if gap.is_none() {
                let error = error.unwrap_or(0.0);
                if worst.as_ref().is_none_or(|(worst, _)| error > *worst) {
                    worst = Some((error, cell.clone()));
                }
                return Measure { bound: 0.0, attained: 0.0, at, split: 0 };
            }
            candidates.push(at.clone());
            failure = failure.take().or_else(|| candidates.drain(..).find_map(|it| fails(&it)));
            let attained = if failure.is_some() { 1.0 } else { 0.0 };
            let split = blame(cell, |thin| judge.judge::<F>(thin).0.is_none());
            Measure { bound: f64::INFINITY, attained, at, split }
        });
        let unproved = |judge: &mut Judge<'_>| {
            let quantity = judge.judge::<F>(&found.worst).0.unwrap_or(Quantity::Displacement);
            ComputedVerdict::Unproved(quantity, Witness::at(chart, &found.worst.centre()).0)
        };
        let finding = match failure {
            Some(failure) => failure,
            None if found.bound <= 0.0 => ComputedVerdict::Proved,
            None => unproved(&mut judge),
        };
        let is_told = finding == ComputedVerdict::Proved && !self.angles.is_empty();
        let angles = worst.filter(|_| is_told).map(|(error, cell)| {
            (-error.max(F::UNIT).log10(), Witness::at(chart, &farthest_corner(chart, &cell)).0)
        });
        ComputedProof { verdict: finding, angles, cells: found.cells }
    }

    /// Bounds all values at a chart point, for any normal, with `known` bounds of some exact values.
    fn bounded<F: Format>(
        &self,
        spot: &ChartPoint<Computed<F>>,
        known: impl Fn(usize) -> Option<Interval>,
    ) -> Values<Computed<F>> {
        // The components of any unit vector.
        let normal = Computed::input(Interval::new(-1.0, 1.0));
        let meet = |index: usize, value: Computed<F>| {
            known(index).map_or(value, |bounds| value.meet(bounds))
        };
        let meet_wide = |index: usize, value: Computed<F::Wide>| {
            known(index).map_or(value, |bounds| value.meet(bounds))
        };
        self.values(spot, normal, meet, meet_wide)
    }

    /// The steps that bounding these values took.
    fn steps<F: Format>(&self, values: &Values<Computed<F>>) -> u64 {
        let of = |(index, _): (usize, &bool)| match self.program.instrs[index].op {
            Op::Unary(function, _, x) | Op::Binary(function, x, _) => {
                Some(values.narrow[x.index()].steps(Some(function)))
            }
            _ => None,
        };
        let needed = self.plan.iter().enumerate().filter(|(_, needed)| **needed);
        needed.map(|it| of(it).filter(|steps| *steps > SLOW).unwrap_or(STEPS)).sum()
    }

    /// Computes all needed values at a chart point; `meet` changes each value before others use it.
    fn values<T: Number>(
        &self,
        spot: &ChartPoint<T>,
        normal: T,
        meet: impl Fn(usize, T) -> T,
        meet_wide: impl Fn(usize, T::Wide) -> T::Wide,
    ) -> Values<T> {
        let input = |symbol| match symbol {
            Symbol::Parameter(index) => spot.parameters[index].clone(),
            Symbol::Time => spot.time.clone(),
            Symbol::Coordinate(axis) => spot.coordinates[axis].clone(),
            _ => normal.clone(),
        };
        let zero = T::from_f64(0.0);
        let mut narrow = vec![zero.clone(); self.program.instrs.len()];
        let mut wide = vec![zero.widen(); self.program.start(Stage::Point)];
        for (index, instr) in self.program.instrs.iter().enumerate() {
            if !self.plan[index] {
                continue;
            }
            if index < wide.len() {
                let (constant, square) = (T::wide_from_rational, T::wide_square);
                let value = apply(&instr.op, &wide, constant, square, &|it| input(it).widen());
                wide[index] = meet_wide(index, value);
                narrow[index] = T::narrow(wide[index].clone());
            } else {
                let value = apply(&instr.op, &narrow, T::from_rational, T::square, &input);
                narrow[index] = meet(index, value);
            }
        }
        Values { narrow, wide }
    }

    /// The first quantity that may fail to be computed, in the order of derivation.
    fn first_unproved<F: Format>(&self, values: &Values<Computed<F>>) -> Option<Quantity> {
        self.first_quantity(|quantity, index| {
            let value = values.narrow[index];
            value.is_finite() && (quantity != Quantity::Jacobian || value.reach().lower() > 0.0)
        })
    }

    fn first_quantity(&self, well: impl Fn(Quantity, usize) -> bool) -> Option<Quantity> {
        self.program.outputs.iter().find_map(|(output, values)| match output {
            Output::Quantity(quantity) => {
                let is_well = values.iter().all(|value| well(*quantity, value.index()));
                (!is_well).then_some(*quantity)
            }
            _ => None,
        })
    }

    /// The error bound of the angles, in radians.
    fn angle_error<F: Format>(&self, values: &Values<Computed<F>>) -> Option<f64> {
        let error = |&(index, unit): &(usize, f64)| match values.wide.get(index) {
            Some(wide) => unit * wide.error(),
            None => unit * values.narrow[index].error(),
        };
        self.angles.iter().map(error).reduce(f64::max)
    }

    /// Whether a quantity has a value in 77 digits, and J > 0.
    fn has_value(&self, spot: &ChartPoint<Precise>, quantity: Quantity) -> bool {
        let same = |_, value| value;
        let values = self.values(spot, Precise::from_f64(1.0), same, same).narrow;
        let zero = Precise::from_f64(0.0);
        let is_well = |asked: Quantity, index: usize| {
            let is_negative = values[index].at_most(&zero);
            match asked {
                Quantity::Jacobian => values[index].is_defined() && !is_negative,
                _ => asked != quantity || values[index].is_defined(),
            }
        };
        self.first_quantity(is_well).is_none()
    }

    /// The first quantity that the program cannot compute at a chart point, and the reason.
    fn failure<T: Number + Into<f64> + Copy>(
        &self,
        spot: &ChartPoint<f64>,
    ) -> Option<(Quantity, String)> {
        let all = |numbers: &[f64]| numbers.iter().map(|x| T::from_f64(*x)).collect();
        let spot = ChartPoint {
            parameters: all(&spot.parameters),
            time: T::from_f64(spot.time),
            coordinates: all(&spot.coordinates),
        };
        let values = self.values(&spot, T::from_f64(1.0), |_, value| value, |_, value| value);
        let number = |index: usize| -> f64 { values.narrow[index].into() };
        let quantity = self.first_quantity(|quantity, index| {
            let value = number(index);
            value.is_finite() && (quantity != Quantity::Jacobian || value > 0.0)
        })?;
        let needed = self.program.needed(&[Output::Quantity(quantity)]);
        let is_first = |index: &usize| needed[*index] && !number(*index).is_finite();
        let first = (0..needed.len()).find(is_first);
        let cause = first.map_or("J is not positive".into(), |index| {
            self.describe(index, &|index| digits(number(index)))
        });
        Some((quantity, cause))
    }

    /// `sin of 1e17`
    fn describe(&self, index: usize, number: &dyn Fn(usize) -> String) -> String {
        let op = &self.program.instrs[index].op;
        let of: Vec<String> = op.operands().map(|value| number(value.index())).collect();
        match (op, of.as_slice()) {
            (Op::Unary(function, ..), [x]) => format!("{}({x})", function.name()),
            (Op::Subtract(..), [a, b]) => format!("{a} - {b}"),
            (Op::Binary(function, ..), [a, b]) => format!("{}({a}, {b})", function.name()),
            (Op::Add(..), [a, b]) => format!("{a} + {b}"),
            (Op::Multiply(..), [a, b]) => format!("{a} * {b}"),
            (Op::Divide(..), [a, b]) => format!("{a} / {b}"),
            (Op::Input(_), _) => "an input is beyond the largest number".into(),
            _ => "a constant is beyond the largest number".into(),
        }
    }
}

/// Whether a function of one argument has no value, or no slope, at some argument.
fn ends(function: Function) -> bool {
    matches!(
        function,
        Function::Sqrt
            | Function::Cbrt
            | Function::Ln
            | Function::Ln1p
            | Function::Ln1pRest
            | Function::Tan
            | Function::Asin
            | Function::Acos
    )
}

/// The unit in which a circular function reads its angle.
fn unit(function: Function) -> Option<f64> {
    match function {
        Function::Sin | Function::Cos | Function::Tan => Some(1.0),
        Function::SinPi | Function::CosPi => Some(core::f64::consts::PI),
        _ => None,
    }
}

/// The corner with the largest numbers, whose digits are the coarsest.
fn farthest_corner(chart: &Chart, cell: &Cell) -> Vec<f64> {
    let size = |corner: &Vec<f64>| chart.place(corner).iter().map(|x: &f64| x.abs()).sum::<f64>();
    let farthest = corners(cell).into_iter().max_by(|a, b| size(a).total_cmp(&size(b)));
    farthest.unwrap_or_else(|| cell.centre())
}

/// The operands of divisions, roots and logarithms of a program, as formulas that a chart bounds better than one operation
/// after the other.
struct Operands {
    /// The position of each operand, in the order of the program, and the formula or multiple of J that it is.
    known: Vec<(usize, Known)>,
    formulas: Option<Formulas>,
}

#[derive(Clone, Copy)]
enum Known {
    Formula(usize),
    Within(Interval),
}

impl Operands {
    /// Finds these operands in a program where J, an expression, lies within bounds; none if the graph has no room for them.
    fn new(
        graph: &mut Graph,
        chart: &Chart,
        quantities: &QuantityProgram<'_>,
        jacobian: (Expr, [f64; 2]),
    ) -> Self {
        let known = graph.attempt(|graph| Self::find(graph, chart, quantities, jacobian));
        let is_void = graph.is_exhausted();
        let none = || Operands { known: Vec::new(), formulas: None };
        known.filter(|_| !is_void).unwrap_or_else(none)
    }

    fn find(
        graph: &mut Graph,
        chart: &Chart,
        quantities: &QuantityProgram<'_>,
        (jacobian, bounds): (Expr, [f64; 2]),
    ) -> Self {
        let positions = quantities.sensitive();
        let exprs = expressions(graph, quantities.program);
        let exprs: Vec<Expr> = positions.iter().map(|index| exprs[*index]).collect();
        let exprs = chart.pull_back(graph, &exprs);
        let one = graph.number(1);
        let change = graph.sub(jacobian, one);
        let (part, whole) = graph.split_content(jacobian);
        let [bounds, part] = [Interval::new(bounds[0], bounds[1]), Interval::from_rational(&part)];
        let (mut known, mut formulas) = (Vec::new(), Vec::new());
        for (index, expr) in positions.into_iter().zip(exprs) {
            let (factor, primitive) = graph.split_content(expr);
            let found = if expr == change {
                Known::Within(bounds - Interval::from_f64(1.0))
            } else if primitive == whole {
                Known::Within(bounds / part * Interval::from_rational(&factor))
            } else {
                formulas.push(expr);
                Known::Formula(formulas.len() - 1)
            };
            known.push((index, found));
        }
        Operands { known, formulas: Some(Formulas::new(graph, chart, &formulas)) }
    }

    /// The known bounds of a value, given bounds of the formulas.
    fn of(&self, index: usize, bounds: &[Interval]) -> Option<Interval> {
        let place = self.known.binary_search_by_key(&index, |(index, _)| *index).ok()?;
        match self.known[place].1 {
            Known::Formula(formula) => bounds.get(formula).copied(),
            Known::Within(bounds) => Some(bounds),
        }
    }
}

/// The values of a program as expressions.
fn expressions(graph: &mut Graph, program: &Program) -> Vec<Expr> {
    let mut made: Vec<Expr> = Vec::with_capacity(program.instrs.len());
    for instr in &program.instrs {
        let of = |value: &Value| made[value.index()];
        let expr = match &instr.op {
            Op::Constant(number) => graph.number(number.clone()),
            Op::Pi => graph.pi(),
            Op::Input(symbol) => graph.symbol(*symbol),
            Op::Add(a, b) => graph.add(of(a), of(b)),
            Op::Subtract(a, b) => graph.sub(of(a), of(b)),
            Op::Multiply(a, b) => graph.mul(of(a), of(b)),
            Op::Divide(a, b) => graph.div(of(a), of(b)),
            Op::Negate(a) => graph.scale(of(a), -1),
            Op::Unary(function, _, a) => circular(graph, *function, of(a)),
            Op::Binary(function, a, b) => graph.call(*function, &[of(a), of(b)]),
        };
        made.push(expr);
    }
    made
}

/// A circular function in the form that files use.
fn circular(graph: &mut Graph, function: Function, x: Expr) -> Expr {
    let plain = match function {
        Function::SinPi => Function::Sin,
        Function::CosPi => Function::Cos,
        // Only sines and cosines read this result, and whole turns do not change them.
        other if other.takes_turns_off() => return x,
        other => return graph.call(other, &[x]),
    };
    let pi = graph.pi();
    let angle = graph.mul(pi, x);
    graph.call(plain, &[angle])
}

/// Bounds a program in cells.
struct Judge<'a> {
    quantities: &'a QuantityProgram<'a>,
    chart: &'a Chart,
    operands: &'a Operands,
    spots: ChartProgram<'a, Interval, crate::bounds::chart::ChartOutput>,
}

impl Judge<'_> {
    /// The quantity that may fail to be computed in a cell, and the error bound of the angles there.
    fn judge<F: Format>(&mut self, cell: &Cell) -> (Option<Quantity>, Option<f64>) {
        let place = self.chart.place(&cell.0);
        let spot = computed::<F>(&self.spots.point(&place));
        let mut values = self.quantities.bounded(&spot, |index| self.operands.of(index, &[]));
        self.chart.work().spend(self.quantities.steps(&values));
        if let Some(formulas) = &self.operands.formulas
            && self.quantities.first_unproved(&values).is_some()
        {
            let bounds = formulas.run::<Interval>(self.chart).enclose(&place).values;
            values = self.quantities.bounded(&spot, |index| self.operands.of(index, &bounds));
            self.chart.work().spend(self.quantities.steps(&values));
        }
        (self.quantities.first_unproved(&values), self.quantities.angle_error(&values))
    }
}
