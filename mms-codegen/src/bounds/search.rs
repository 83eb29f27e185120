//! Branch and bound: a rigorous upper bound of a function over a box, refined where it is largest.
//!
//! The box with the largest bound is split in halves next (Moore, Kearfott & Cloud, Introduction to Interval Analysis, 2009,
//! chapter 11). A search that ends early still returns a valid bound, only a less sharp one.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use mms_program::interval::Interval;
use mms_symbolic::work::Work;

/// The smallest width of a cell, as a part of the whole box.
const SMALLEST: f64 = 1.0 / (1u64 << 40) as f64;

/// A part of the unit box: for each variable the fractions that it lies between.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell(pub Vec<Interval>);

impl Cell {
    /// The whole unit box.
    pub fn whole(dimension: usize) -> Self {
        Cell(vec![Interval::new(0.0, 1.0); dimension])
    }

    /// The centre of the cell.
    pub fn centre(&self) -> Vec<f64> {
        self.0.iter().map(|side| side.middle()).collect()
    }

    /// The halves of the cell across one variable; `None` if it is too small to split.
    fn halves(&self, variable: usize) -> Option<[Cell; 2]> {
        let side = *self.0.get(variable)?;
        if side.width() <= SMALLEST {
            return None;
        }
        let middle = side.middle();
        let parts = [(side.lower(), middle), (middle, side.upper())];
        Some(parts.map(|(lower, upper)| {
            let mut half = self.clone();
            half.0[variable] = Interval::new(lower, upper);
            half
        }))
    }

    /// The widest side; of equals, the first.
    pub fn widest(&self) -> usize {
        self.largest(|side, _| side.width())
    }

    /// The variable across which the cell changes most, given the changes that each variable makes. If some changes are not
    /// finite, the widest of these variables; if nothing changes, the widest of all.
    pub fn steepest(&self, changes: &[f64]) -> usize {
        if changes.iter().any(|change| !change.is_finite()) {
            let width = |side: &Interval, variable: usize| match changes[variable].is_finite() {
                true => f64::NEG_INFINITY,
                false => side.width(),
            };
            return self.largest(width);
        }
        match changes.iter().any(|change| *change > 0.0) {
            true => self.largest(|_, variable| changes[variable]),
            false => self.widest(),
        }
    }

    fn largest(&self, size: impl Fn(&Interval, usize) -> f64) -> usize {
        let mut best = (0, f64::NEG_INFINITY);
        for (variable, side) in self.0.iter().enumerate() {
            let size = size(side, variable);
            if size > best.1 {
                best = (variable, size);
            }
        }
        best.0
    }
}

/// The bounds of a function in a cell.
#[derive(Clone, Debug)]
pub struct Measure {
    /// An upper bound of the function in the cell; infinite if none is known.
    pub bound: f64,
    /// A value in the cell; minus infinity if there is none.
    pub attained: f64,
    /// The place of this value, as fractions.
    pub at: Vec<f64>,
    /// The variable across which to split.
    pub split: usize,
}

/// The result of a search.
#[derive(Clone, Debug)]
pub struct SearchResult {
    /// An upper bound of the function everywhere.
    pub bound: f64,
    /// The greatest value that was met.
    pub attained: f64,
    /// The place of this value, as fractions.
    pub at: Vec<f64>,
    /// The cell whose bound is the greatest.
    pub worst: Cell,
    /// The number of measured cells.
    pub cells: usize,
}

struct Open {
    cell: Cell,
    bound: f64,
    split: usize,
    number: usize,
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        // Of two equal bounds, the older cell comes first.
        self.bound.total_cmp(&other.bound).then(other.number.cmp(&self.number))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

/// The limit of a search: a number of cells, and a budget that each measurement draws on. Cells differ in cost, so the budget
/// bounds the time.
#[derive(Clone, Copy, Debug)]
pub struct Limit<'a> {
    /// The largest number of cells.
    pub cells: usize,
    /// The budget for measuring them.
    pub work: Option<&'a Work>,
}

impl From<usize> for Limit<'_> {
    fn from(cells: usize) -> Self {
        Limit { cells, work: None }
    }
}

impl Limit<'_> {
    fn allows(&self, cells: usize) -> bool {
        cells <= self.cells && !self.work.is_some_and(Work::is_over)
    }
}

/// Bounds a function over the unit box from above, until `enough` accepts the bound and the greatest value, or the limit is
/// reached.
pub fn largest<'a>(
    dimension: usize,
    limit: impl Into<Limit<'a>>,
    enough: impl Fn(f64, f64) -> bool,
    mut measure: impl FnMut(&Cell) -> Measure,
) -> SearchResult {
    let limit = limit.into();
    let whole = Cell::whole(dimension);
    let first = measure(&whole);
    let mut found = SearchResult {
        bound: first.bound,
        attained: first.attained,
        at: first.at,
        worst: whole.clone(),
        cells: 1,
    };
    let mut open =
        BinaryHeap::from([Open { cell: whole, bound: first.bound, split: first.split, number: 0 }]);
    while let Some(top) = open.peek() {
        (found.bound, found.worst) = (top.bound, top.cell.clone());
        if enough(found.bound, found.attained) || !limit.allows(found.cells + 2) {
            break;
        }
        let Some(halves) = top.cell.halves(top.split) else { break };
        let parent = top.bound;
        open.pop();
        for cell in halves {
            let measured = measure(&cell);
            if measured.attained > found.attained {
                (found.attained, found.at) = (measured.attained, measured.at);
            }
            let bound = measured.bound.min(parent);
            open.push(Open { cell, bound, split: measured.split, number: found.cells });
            found.cells += 1;
        }
    }
    found
}
