//! Bounds of formulas over a part of their domain, and of their slopes.

use std::collections::HashMap;
use std::rc::Rc;

use mms_math::Scalar as _;

use super::chart::{Chart, ChartProgram};
use super::forms::compact;
use mms_program::Program;
use mms_program::interpret::Number;
use mms_program::interval::Interval;
use mms_program::schedule::schedule_plainly;
use mms_symbolic::expr::{Expr, Graph};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::sorted::SortedMap;

/// Formulas in the variables of a chart, with their derivatives by these.
#[derive(Clone, Debug)]
pub struct Formulas {
    program: Program<EnclosureOutput>,
    variables: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum EnclosureOutput {
    Values,
    /// The derivatives by the variable of this index.
    Slopes(usize),
}

impl Formulas {
    /// Differentiates formulas that were pulled back to a chart.
    pub fn new(graph: &mut Graph, chart: &Chart, formulas: &[Expr]) -> Self {
        let mut outputs = SortedMap::from([(EnclosureOutput::Values, compact(graph, formulas))]);
        for (index, symbol) in chart.variables().iter().enumerate() {
            // Once the budget is spent no value of the program is used, so any formulas will do as slopes.
            let slopes = match graph.work().is_over() {
                true => formulas.to_vec(),
                false => differentiate(graph, formulas, *symbol),
            };
            outputs.insert(EnclosureOutput::Slopes(index), compact(graph, &slopes));
        }
        Formulas { program: schedule_plainly(graph, &outputs), variables: chart.variables().len() }
    }

    /// The number of operations of one evaluation.
    pub fn size(&self) -> usize {
        self.program.instrs.len()
    }

    /// Prepares an evaluation in one scalar type.
    pub fn run<'a, T: Number>(&'a self, chart: &'a Chart) -> Evaluation<'a, T> {
        let mut outputs = vec![EnclosureOutput::Values];
        outputs.extend((0..self.variables).map(EnclosureOutput::Slopes));
        Evaluation { run: chart.run(&self.program), outputs }
    }
}

/// Bounds over boxes, kept for several searches: their first boxes are the same.
pub struct Enclosures<'a> {
    evaluation: Evaluation<'a, Interval>,
    known: HashMap<Vec<u64>, Rc<Enclosure>>,
}

impl<'a> Enclosures<'a> {
    /// Prepares bounds of formulas in a chart.
    pub fn new(formulas: &'a Formulas, chart: &'a Chart) -> Self {
        Enclosures { evaluation: formulas.run(chart), known: HashMap::new() }
    }

    /// Bounds over a box, as [`Evaluation::enclose`] finds them.
    pub fn enclose(&mut self, place: &[Interval]) -> Rc<Enclosure> {
        let new = || Rc::new(self.evaluation.enclose(place));
        self.known.entry(key(place)).or_insert_with(new).clone()
    }

    /// The values at a point.
    pub fn values(&mut self, place: &[Interval]) -> Vec<Interval> {
        self.evaluation.values(place)
    }
}

/// The bits that identify a box.
pub fn key(place: &[Interval]) -> Vec<u64> {
    place.iter().flat_map(|side| [side.lower(), side.upper()].map(f64::to_bits)).collect()
}

/// Formulas that are being evaluated.
pub struct Evaluation<'a, T: Number> {
    run: ChartProgram<'a, T, EnclosureOutput>,
    outputs: Vec<EnclosureOutput>,
}

impl<T: Number> Evaluation<'_, T> {
    /// The values at a place.
    pub fn values(&mut self, place: &[T]) -> Vec<T> {
        self.run.at(place, &self.outputs[..1]).swap_remove(0)
    }
}

/// Bounds of some formulas over a box.
#[derive(Clone, Debug)]
pub struct Enclosure {
    /// The bounds of each formula.
    pub values: Vec<Interval>,
    /// The bounds of each derivative: first by variable, then by formula.
    pub slopes: Vec<Vec<Interval>>,
}

impl Evaluation<'_, Interval> {
    /// Bounds formulas over a box by interval arithmetic, intersected with the mean-value form f(c) + f'(box) (box - c), whose
    /// excess shrinks with the square of the box (Moore, Kearfott & Cloud, Introduction to Interval Analysis, 2009, section
    /// 6.3).
    pub fn enclose(&mut self, place: &[Interval]) -> Enclosure {
        let mut outputs = self.run.at(place, &self.outputs);
        let slopes = outputs.split_off(1);
        let mut values = outputs.swap_remove(0);
        let centre: Vec<Interval> =
            place.iter().map(|side| Interval::from_f64(side.middle())).collect();
        let at_centre = self.values(&centre);
        for (index, value) in values.iter_mut().enumerate() {
            let smooth = slopes.iter().all(|slopes| slopes[index].is_defined());
            if !value.is_defined() || !smooth {
                continue;
            }
            let mut form = at_centre[index];
            for (slopes, (side, middle)) in slopes.iter().zip(place.iter().zip(&centre)) {
                form = form + slopes[index] * (*side - *middle);
            }
            *value = value.meet(form);
        }
        Enclosure { values, slopes }
    }
}
