//! The contents of a file for one mesh at one time.

use std::collections::BTreeMap;

use crate::Mistake;
use crate::cell::{dimension, last_edges, refused};
use crate::norm::{largest, range};

/// The form in which numbers were stored, which bounds their distance from the solver's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// Single precision.
    Single,
    /// Double precision, or text with as many digits.
    Double,
    /// Integers, or coordinates of a grid whose spacing has few digits: they are exact.
    Whole,
    /// Text, with this many digits after the point.
    Fixed(u32),
    /// Text, with this many significant digits.
    Digits(u32),
}

/// The last bits of a number in single precision, which are 0 for binary fractions with few digits.
const LAST_BITS: u32 = 0b11_1111;

/// The most digits of coordinates that are tested for a grid.
const SHORT: u32 = 9;
/// The least spacing of a grid whose points may be missing, in units of the last digit.
const SPARSE: f64 = 20.0;
/// The largest distance of a coordinate from a grid, divided by half its spacing.
const GRID: f64 = 1e-6;

impl Stored {
    /// Half a unit in the last place of a number of this magnitude.
    pub fn rounding(self, magnitude: f64) -> f64 {
        let magnitude = magnitude.abs();
        // Exponents beyond the range of integers are clamped to it.
        let unit = |exponent: f64| 0.5 * 10f64.powi(exponent as i32);
        match self {
            Stored::Single => magnitude * f64::from(f32::EPSILON) / 2.0,
            Stored::Double => magnitude * f64::EPSILON / 2.0,
            Stored::Whole => 0.0,
            Stored::Fixed(decimals) => unit(-f64::from(decimals)),
            Stored::Digits(_) if magnitude == 0.0 => 0.0,
            Stored::Digits(digits) => unit(magnitude.log10().floor() + 1.0 - f64::from(digits)),
        }
    }

    /// The form in which numbers were first stored: single precision if all numbers fit it and some use its last bits.
    pub fn at_first(self, numbers: &[f64]) -> Stored {
        let is_finer = self != Stored::Whole && self.rounding(1.0) < Stored::Single.rounding(1.0);
        let is_single = |it: &f64| f64::from(*it as f32).to_bits() == it.to_bits();
        let has_last_bits = |it: &f64| (*it as f32).to_bits() & LAST_BITS != 0;
        match is_finer && numbers.iter().all(is_single) && numbers.iter().any(has_last_bits) {
            true => Stored::Single,
            false => self,
        }
    }

    /// Whether coordinates are typed with all their digits and form a grid, such as 0, 0.25 and 0.5: along each axis they are
    /// multiples of half their spacing. A spacing of a few units of the last digit says nothing, unless it is the same everywhere.
    pub(crate) fn is_of_grid(self, coordinates: &[f64], dimension: usize) -> bool {
        let digits = match self {
            Stored::Fixed(digits) | Stored::Digits(digits) => digits,
            Stored::Single | Stored::Double | Stored::Whole => return false,
        };
        let unit = 2.0 * self.rounding(largest(coordinates));
        let is_axis_of_grid = |axis: usize| {
            let mut all: Vec<f64> =
                coordinates.iter().skip(axis).step_by(dimension).copied().collect();
            all.sort_by(f64::total_cmp);
            all.dedup();
            let gaps = || all.windows(2).map(|pair| pair[1] - pair[0]);
            let least = gaps().fold(f64::INFINITY, f64::min);
            let near = |number: f64| (number - number.round()).abs() < GRID;
            let is_even = || gaps().all(|gap| near(gap / least) && gap < 1.5 * least);
            let is_multiple = || all.iter().all(|it| near(2.0 * it / least));
            // A single coordinate has no spacing.
            least.is_finite() && is_multiple() && (least >= SPARSE * unit || is_even())
        };
        digits <= SHORT && (0..dimension).all(is_axis_of_grid)
    }

    /// The name in messages.
    pub fn name(self) -> String {
        match self {
            Stored::Single => "single precision".into(),
            Stored::Double => "double precision".into(),
            Stored::Whole => "integers".into(),
            Stored::Fixed(decimals) => format!("{decimals} digits after the point"),
            Stored::Digits(digits) => format!("{digits} significant digits"),
        }
    }
}

/// Named numbers of points or cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// The name in the file.
    pub name: String,
    /// The number of components of a point or cell; at least 1.
    pub components: usize,
    /// All numbers, point by point or cell by cell.
    pub values: Vec<f64>,
    /// The form in which they were stored.
    pub stored: Stored,
    /// The names of the components, if the file has them.
    pub component_names: Vec<String>,
}

impl Default for Array {
    fn default() -> Self {
        let (name, values, component_names) = Default::default();
        Array { name, components: 1, values, stored: Stored::Double, component_names }
    }
}

impl Array {
    /// The number of points or cells.
    pub fn rows(&self) -> usize {
        self.values.len() / self.components
    }

    /// Whether the array has this name and this number of components.
    fn is_like(&self, name: &str, components: usize) -> bool {
        self.name == name && self.components == components
    }

    /// A copy without numbers.
    pub(crate) fn clone_without_values(&self) -> Array {
        let (name, component_names) = (self.name.clone(), self.component_names.clone());
        Array { name, component_names, values: Vec::new(), ..*self }
    }

    /// The number of its components and the range of each, in words.
    pub fn described(&self) -> String {
        let range = |component: usize| {
            let numbers = self.values.iter().skip(component).step_by(self.components);
            let [least, most] = range(numbers);
            format!("{least:.3e} to {most:.3e}")
        };
        let ranges: Vec<_> = (0..self.components).map(range).collect();
        match ranges.as_slice() {
            [range] if self.rows() > 0 => format!("one number, {range}"),
            _ if self.rows() > 0 && self.components <= 9 => {
                format!("{} components: {}", self.components, ranges.join(", "))
            }
            _ => format!("{} components", self.components),
        }
    }

    /// The largest rounding of its numbers.
    pub fn rounding(&self) -> f64 {
        self.stored.rounding(largest(&self.values))
    }
}

/// Cells, by their types in VTK.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cells {
    /// The type of each cell.
    pub types: Vec<u8>,
    /// The points of all cells, one cell after the other.
    pub points: Vec<usize>,
    /// The ends of each cell's points.
    pub ends: Vec<usize>,
}

impl Cells {
    /// The type and the points of each cell.
    pub fn iter(&self) -> impl Iterator<Item = (u8, &[usize])> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let each = self.types.iter().zip(starts.zip(&self.ends));
        each.map(|(&kind, (start, &end))| (kind, &self.points[start..end]))
    }

    /// The number of cells.
    pub fn len(&self) -> usize {
        self.types.len()
    }

    /// The highest dimension of a cell.
    pub(crate) fn dimension(&self) -> usize {
        self.types.iter().map(|kind| dimension(*kind)).max().unwrap_or(0)
    }

    /// Whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.types.is_empty()
    }

    /// Refuses cells whose ends do not follow each other, or that have points beyond the last.
    pub(crate) fn validate(&self, points: usize) -> Result<(), Mistake> {
        let (types, ends) = (self.types.len(), self.ends.len());
        if types != ends {
            return Err(Mistake::new(format!("{types} types of cells for {ends} cells")));
        }
        if !self.ends.is_sorted() || self.ends.last().copied().unwrap_or(0) != self.points.len() {
            return Err(Mistake::new("the offsets of the cells do not fit their connectivity"));
        }
        if let Some(point) = self.points.iter().find(|&&point| point >= points) {
            return Err(Mistake::new(format!(
                "a cell has the point {point}, counted from 0, but there are {points} points"
            )));
        }
        let refused = |(kind, points): (u8, &[usize])| refused(kind, points.len());
        self.iter().find_map(refused).map_or(Ok(()), |what| Err(Mistake::new(what)))
    }

    /// Swaps the nodes of the last two upright edges of Lagrange hexahedra, which old files swap.
    pub(crate) fn renumber_old(&mut self) {
        let mut start = 0;
        for (kind, &end) in self.types.iter().zip(&self.ends) {
            if let Some([from, middle, to]) = last_edges(*kind, end - start) {
                self.points[start..end][from..to].rotate_left(middle - from);
            }
            start = end;
        }
    }
}

/// A time and its rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Time {
    /// The time.
    pub value: f64,
    /// Half a unit in the last place that was stored.
    pub rounding: f64,
}

/// The format of a snapshot that no file holds.
pub const ARRAYS: &str = "arrays";

/// The contents of a file for one mesh at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// The file.
    pub path: String,
    /// The name of the format.
    pub format: &'static str,
    /// The time, if it is known.
    pub time: Option<Time>,
    /// The places of the points, if the format has them.
    pub points: Option<Array>,
    /// The cells, if the format has them.
    pub cells: Cells,
    /// Named numbers of points.
    pub of_points: Vec<Array>,
    /// Named numbers of cells.
    pub of_cells: Vec<Array>,
    /// The lines of the points; empty for files without lines.
    pub lines: Vec<usize>,
    /// The units in the file of arrays, by their names.
    pub units: Vec<(String, String)>,
    /// The names of arrays that were not read.
    pub unread: Vec<String>,
}

impl Snapshot {
    /// The number of points; without places of points, the number of rows that most arrays have.
    pub fn rows(&self) -> usize {
        if let Some(points) = &self.points {
            return points.rows();
        }
        let mut counts = BTreeMap::<usize, usize>::new();
        self.of_points.iter().for_each(|array| *counts.entry(array.rows()).or_default() += 1);
        let most = counts.into_iter().max_by_key(|&(rows, count)| (count, rows));
        most.map_or(0, |(rows, _)| rows)
    }

    /// The place of a point: `path:line`, or its number.
    pub fn place(&self, point: usize) -> String {
        match self.lines.get(point) {
            Some(line) => format!("{}:{line}", self.path),
            None => format!("{}: point {point}", self.path),
        }
    }

    /// Turns arrays of cells into arrays of points, if each cell is a vertex of one point and each point has one: programs
    /// write particles without nodes in this way. Marks of ghosts, and arrays whose names points have, stay with the cells.
    pub(crate) fn with_vertices_as_points(mut self) -> Snapshot {
        let (rows, Cells { types, points, ends }) = (self.rows(), &self.cells);
        let mut is_there = vec![false; if types.len() == rows { rows } else { 0 }];
        let is_vertex = |kind: &u8| matches!(kind, 1 | 2);
        let is_one_each = rows > 0
            && types.len() == rows
            && types.iter().all(is_vertex)
            && ends.iter().enumerate().all(|(cell, end)| *end == cell + 1)
            && points.iter().all(|&point| !std::mem::replace(&mut is_there[point], true));
        if !is_one_each {
            return self;
        }
        let is_moved = |it: &Array| {
            !GHOSTS.contains(&&*it.name)
                && it.rows() == rows
                && self.of_points.iter().all(|of_point| of_point.name != it.name)
        };
        let (moved, kept) = self.of_cells.into_iter().partition(is_moved);
        self.of_cells = kept;
        let in_order = points.is_sorted();
        let of_points = |array: Array| match in_order {
            true => array,
            false => {
                let size = array.components;
                let mut values = vec![0.0; array.values.len()];
                for (own, &point) in array.values.chunks_exact(size).zip(points) {
                    values[point * size..][..size].copy_from_slice(own);
                }
                Array { values, ..array }
            }
        };
        let moved: Vec<Array> = moved;
        self.of_points.extend(moved.into_iter().map(of_points));
        self
    }

    /// Joins snapshots that are pieces of a mesh, with the same arrays. Pieces without points and cells may have any.
    ///
    /// # Errors
    /// An array that only some have, or that has other components there.
    pub(crate) fn join(pieces: Vec<Snapshot>) -> Result<Snapshot, Mistake> {
        let time = pieces.iter().find_map(|it| it.time);
        let (mut empty, pieces): (Vec<_>, Vec<_>) =
            pieces.into_iter().partition(|it| it.rows() == 0 && it.cells.is_empty());
        let mut pieces = pieces.into_iter();
        let mut whole = pieces.next().or_else(|| empty.pop()).unwrap_or_default();
        for piece in pieces {
            whole.append(piece)?;
        }
        Ok(Snapshot { time, ..whole })
    }

    /// Joins snapshots that are blocks of a mesh. Leaves out arrays that some blocks lack, and blocks of a lower dimension,
    /// such as boundaries, that lack an array which the others have.
    ///
    /// # Errors
    /// Points that only some have.
    pub(crate) fn join_blocks(mut blocks: Vec<Snapshot>) -> Result<Snapshot, Mistake> {
        blocks.retain(|it| it.rows() > 0 || !it.cells.is_empty());
        let most = blocks.iter().map(|it| it.cells.dimension()).max();
        let is_full = |it: &Snapshot| Some(it.cells.dimension()) == most;
        let mut unread: Vec<String> = blocks.iter().flat_map(|it| it.unread.clone()).collect();
        let is_mark = |it: &Array| GHOSTS.contains(&&*it.name);
        for arrays in [Snapshot::of_points_mut, Snapshot::of_cells_mut] {
            let mut common: Option<Vec<(String, usize)>> = None;
            for block in blocks.iter_mut().filter(|it| is_full(it)) {
                let own = arrays(block).iter().filter(|it| !is_mark(it));
                let own: Vec<_> = own.map(|it| (it.name.clone(), it.components)).collect();
                match &mut common {
                    None => common = Some(own),
                    Some(common) => common.retain(|it| own.contains(it)),
                }
            }
            let common = common.unwrap_or_default();
            let is_common = |it: &Array| common.iter().any(|(name, size)| it.is_like(name, *size));
            blocks.retain_mut(|block| {
                let is_fit = is_full(block)
                    || arrays(block).iter().filter(|it| is_common(it)).count() == common.len();
                let left_out = |it: &Array| !(is_mark(it) || is_fit && is_common(it));
                let names = arrays(block).iter().filter(|it| left_out(it));
                unread.extend(names.map(|it| it.name.clone()));
                arrays(block).retain(|it| !left_out(it));
                is_fit
            });
        }
        unread.sort();
        unread.dedup();
        Ok(Snapshot { unread, ..Snapshot::join(blocks)? })
    }

    fn of_points_mut(&mut self) -> &mut Vec<Array> {
        &mut self.of_points
    }

    fn of_cells_mut(&mut self) -> &mut Vec<Array> {
        &mut self.of_cells
    }

    fn append(&mut self, mut piece: Snapshot) -> Result<(), Mistake> {
        let connected = self.cells.points.len();
        let own = [self.rows(), self.cells.len()];
        let more = [piece.rows(), piece.cells.len()];
        mark_none(&mut self.of_points, &piece.of_points, own[0]);
        mark_none(&mut piece.of_points, &self.of_points, more[0]);
        mark_none(&mut self.of_cells, &piece.of_cells, own[1]);
        mark_none(&mut piece.of_cells, &self.of_cells, more[1]);
        self.cells.points.extend(piece.cells.points.iter().map(|point| point + own[0]));
        self.cells.ends.extend(piece.cells.ends.iter().map(|end| end + connected));
        self.cells.types.extend(piece.cells.types);
        self.lines.extend(piece.lines);
        append(self.points.as_mut_slice(), piece.points.into_iter().collect())?;
        append(&mut self.of_points, piece.of_points)?;
        append(&mut self.of_cells, piece.of_cells)
    }
}

/// The arrays in which VTK marks ghosts, the present one and the older one.
pub(crate) const GHOSTS: [&str; 2] = ["vtkGhostType", "vtkGhostLevels"];

/// Adds marks of ghosts that another piece has: a piece without them has no ghosts.
fn mark_none(arrays: &mut Vec<Array>, of_other: &[Array], rows: usize) {
    for (at, marks) in of_other.iter().enumerate().filter(|(_, it)| GHOSTS.contains(&&*it.name)) {
        if arrays.iter().all(|it| it.name != marks.name) {
            let none = Array { values: vec![0.0; rows], ..marks.clone_without_values() };
            arrays.insert(at.min(arrays.len()), none);
        }
    }
}

/// Appends arrays to the arrays of the same names.
fn append(arrays: &mut [Array], mut more: Vec<Array>) -> Result<(), Mistake> {
    let only_in_some = |name: &str| {
        Mistake::new(format!(
            "the array `{name}` is not in all its pieces, or has other components in some: write it in all"
        ))
    };
    for (at, array) in arrays.iter_mut().enumerate() {
        let is_it = |it: &Array| it.is_like(&array.name, array.components);
        // The order is most often the same.
        let found = (at..more.len()).find(|&at| is_it(&more[at]));
        let found = found.ok_or_else(|| only_in_some(&array.name))?;
        more.swap(at, found);
        array.values.append(&mut more[at].values);
        array.stored = array.stored.coarser(more[at].stored);
    }
    more.get(arrays.len()).map_or(Ok(()), |it| Err(only_in_some(&it.name)))
}

impl Stored {
    /// The form with the larger rounding.
    pub(crate) fn coarser(self, other: Stored) -> Stored {
        if self.rounding(1.0) >= other.rounding(1.0) { self } else { other }
    }
}

/// The parts of a surface in VTK, in the order of their cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Section {
    /// Points.
    Verts,
    /// Lines.
    Lines,
    /// Polygons.
    Polys,
    /// Strips of triangles.
    Strips,
}

impl Section {
    /// All sections.
    pub const ALL: [Section; 4] = [Section::Verts, Section::Lines, Section::Polys, Section::Strips];

    /// The name in XML.
    pub fn name(self) -> &'static str {
        match self {
            Section::Verts => "Verts",
            Section::Lines => "Lines",
            Section::Polys => "Polys",
            Section::Strips => "Strips",
        }
    }

    /// The type of a cell of the section with this number of points.
    fn kind(self, points: usize) -> u8 {
        match (self, points) {
            (Section::Verts, 1) => 1,
            (Section::Verts, _) => 2,
            (Section::Lines, 2) => 3,
            (Section::Lines, _) => 4,
            (Section::Polys, 3) => 5,
            (Section::Polys, 4) => 9,
            (Section::Polys, _) => 7,
            (Section::Strips, _) => 6,
        }
    }
}

impl Cells {
    /// Adds the cells of a section.
    pub(crate) fn add(&mut self, section: Section, ends: &[usize], points: Vec<usize>) {
        let (before, mut start) = (self.points.len(), 0);
        for &end in ends {
            self.types.push(section.kind(end.saturating_sub(start)));
            self.ends.push(before.saturating_add(end));
            start = end;
        }
        self.points.extend(points);
    }
}

#[cfg(test)]
mod tests {
    use super::Stored;

    #[test]
    fn coordinates_of_a_grid_are_known_by_their_spacing() {
        let is_grid =
            |digits, coordinates: &[f64]| Stored::Digits(digits).is_of_grid(coordinates, 1);
        assert!(is_grid(1, &[0.0, 0.5, 1.0]));
        assert!(is_grid(2, &[0.25, 0.75]));
        assert!(is_grid(1, &[0.1, 0.2, 0.3, 0.4]));
        // A point is missing.
        assert!(is_grid(3, &[0.0, 0.125, 0.375, 0.5]));
        assert!(!is_grid(1, &[0.1, 0.2, 0.4]));
        // Sixths and thirds.
        assert!(!is_grid(2, &[0.17, 0.5, 0.83]));
        assert!(!is_grid(2, &[0.0, 0.33, 0.67, 1.0]));
        assert!(!is_grid(2, &[0.13, 0.58, 0.71, 0.99]));
        // A line at a third.
        assert!(!is_grid(2, &[0.33, 0.33]));
        // With full precision nothing has to be guessed.
        assert!(!is_grid(17, &[0.0, 0.5, 1.0]));
    }
}
