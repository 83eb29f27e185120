//! The columns of a quantity in arrays, and the numbers in them.

use std::borrow::Cow;

use crate::axes::Axes;
use crate::cell::CellShape;
use crate::norm::largest_if_finite;
use crate::role::{Form, Role};
use crate::{Array, Mistake, Snapshot, Stored};

/// The largest accepted difference of two entries of a symmetric tensor, over the largest number.
const SYMMETRIC: f64 = 1e-5;

/// The largest strain; larger numbers are no strains.
const LARGEST_STRAIN: f64 = 1e3;

/// The largest out-of-plane component of a vector, over the largest in the plane: some codes compute it.
const ROUNDOFF: f64 = 1e-12;

/// The part of a quantity that a column contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Part {
    /// The component of this position among all.
    Nth(usize),
    /// An entry by row and column.
    Entry(usize, usize),
}

/// The place of an array in a snapshot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ArrayPlace {
    /// The places of the points.
    Grid,
    /// An array of points, by its position.
    Points(usize),
    /// An array of cells, by its position.
    Cells(usize),
}

/// A column of numbers: one component of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Column {
    pub place: ArrayPlace,
    pub component: usize,
}

/// The columns of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning {
    /// The quantity.
    pub role: Role,
    /// The name in the file.
    pub source: String,
    /// The face in the name: a traction belongs to a face.
    pub face: Option<&'static str>,
    /// The columns, each with its part of the quantity.
    pub(crate) columns: Vec<(Part, Column)>,
    /// The reason for this meaning.
    pub why: Why,
    /// The position of points for which both readings lie in the body, and the profile that states it.
    pub(crate) reading: Option<(Role, String)>,
    /// The letters of the components.
    pub(crate) axes: Axes,
}

/// The reasons why an array is a quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Why {
    /// The name of the array.
    Name,
    /// A user's `--map`, with this number of names.
    Map(usize),
    /// The profile of this code.
    Profile(String),
}

/// The numbers of a quantity at points or cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Values<'a> {
    /// All numbers, point by point or cell by cell; borrowed if the array has no other columns.
    pub numbers: Cow<'a, [f64]>,
    /// The number of components of a point or cell.
    pub components: usize,
    /// The uncertainty of a number, from how it was stored.
    pub rounding: f64,
    /// The precision of the stored numbers.
    pub stored: Stored,
    /// Whether the numbers belong to cells.
    pub is_of_cells: bool,
}

impl Values<'_> {
    /// Copies borrowed numbers, so that the values outlive the snapshot.
    pub fn into_owned(self) -> Values<'static> {
        Values { numbers: Cow::Owned(self.numbers.into_owned()), ..self }
    }
}

impl Meaning {
    /// The text that names the quantity in `--map`.
    pub(crate) fn mapping(&self, snapshot: &Snapshot, dimension: usize) -> String {
        match self.columns.first() {
            Some((_, first)) if self.is_one_array() => name(snapshot, first.place).to_owned(),
            _ => self.listed(snapshot, 0..dimension),
        }
    }

    /// The text that names the numbers of these positions in `--map`, one by one.
    fn listed(&self, snapshot: &Snapshot, order: impl IntoIterator<Item = usize>) -> String {
        let column = |(_, column): &(Part, Column)| {
            let name = name(snapshot, column.place);
            if self.is_one_array() { format!("{name}:{}", column.component) } else { name.into() }
        };
        let named = order.into_iter().filter_map(|at| self.nth(at)).map(column);
        named.collect::<Vec<_>>().join(",")
    }

    /// Whether all columns are in one array.
    fn is_one_array(&self) -> bool {
        self.columns.windows(2).all(|pair| pair[0].1.place == pair[1].1.place)
    }

    /// The reason why an array is not the quantity of its name in this dimension: other components, another number of rows than
    /// points, or a strain too large for any bar, because Young's modulus may be called E as well. `None` if it may be the
    /// quantity, if a user maps it, or if only the order of its components is unknown.
    pub fn mismatch(
        &self,
        snapshot: &Snapshot,
        dimension: usize,
        points: Option<usize>,
    ) -> Option<String> {
        if matches!(self.why, Why::Map(_)) {
            return None;
        }
        let (name, found) = (self.role.name(), self.columns.len());
        let array = |column: &Column| array(snapshot, column.place);
        if self.wanted(snapshot, dimension).is_err() && self.orders(dimension).is_empty() {
            return Some(match found {
                1 => format!("{} (one number, and no {name})", self.source),
                _ => format!(
                    "{} ({found} components, and {name} has {})",
                    self.source,
                    self.expected(dimension)
                ),
            });
        }
        let columns = || self.columns.iter().map(|(_, column)| column);
        let is_odd = |column: &&Column| match column.place {
            ArrayPlace::Cells(_) => array(column).rows() != snapshot.cells.len(),
            _ => points.is_some_and(|points| array(column).rows() != points),
        };
        if let Some(odd) = columns().find(is_odd) {
            let rows = array(odd).rows();
            return Some(format!("{} ({rows} rows, and another number of points)", self.source));
        }
        let is_strain = dimension == 1 && self.role == Role::GreenLagrange && found == 1;
        let is_large = |it: &f64| it.abs() > LARGEST_STRAIN;
        (is_strain && columns().any(|it| array(it).values.iter().any(is_large)))
            .then(|| format!("{} (one number, and no {name})", self.source))
    }

    /// The number of dimensions of a vector with these columns.
    pub fn dimension(&self) -> usize {
        self.columns.len().clamp(1, 3)
    }

    /// The numbers of the quantity in this dimension. Further components must be 0 in vectors, and are omitted in tensors.
    ///
    /// # Errors
    /// Too few numbers, or too many; one that is not finite, by its place.
    pub fn values<'a>(
        &self,
        snapshot: &'a Snapshot,
        dimension: usize,
    ) -> Result<Values<'a>, Mistake> {
        let columns =
            self.wanted(snapshot, dimension).map_err(|mistake| mistake.of(&snapshot.path))?;
        let of = |column: &Column| array(snapshot, column.place);
        let first = columns
            .iter()
            .flatten()
            .next()
            .ok_or_else(|| self.misfit(snapshot, dimension).of(&snapshot.path))?;
        let rows = of(first).rows();
        if let Some(other) = columns.iter().flatten().map(of).find(|other| other.rows() != rows) {
            let what =
                format!("`{}` has {rows} rows, and `{}` {}", self.source, other.name, other.rows());
            return Err(Mistake::new(what).of(&snapshot.path));
        }
        self.validate_flat(snapshot, dimension)?;
        let numbers = gathered(snapshot, &columns, rows);
        let is_of_cells = matches!(first.place, ArrayPlace::Cells(_));
        let largest = match is_of_cells {
            true => largest_of_cells(snapshot, &numbers, columns.len()),
            false => largest_if_finite(&numbers),
        };
        let largest = largest.map_err(|at| {
            let (row, value) = (at / columns.len(), numbers[at]);
            let what = format!(
                "{} is {value}; expected a finite number; if the run blew up, name the files of the other runs alone",
                self.source
            );
            match is_of_cells {
                true => Mistake::new(format!("cell {row}: {what}")).of(&snapshot.path),
                false => here(snapshot, row, what),
            }
        })?;
        self.validate_rows(snapshot, &numbers, dimension)
            .map_err(|mistake| mistake.of(&snapshot.path))?;
        let stored = columns.iter().flatten().map(|it| of(it).stored).reduce(Stored::coarser);
        let stored = stored.unwrap_or(Stored::Double).at_first(&numbers);
        let is_place = matches!(self.role, Role::Reference | Role::Place);
        let is_of_grid = is_place && stored.is_of_grid(&numbers, columns.len());
        let stored = if is_of_grid { Stored::Whole } else { stored };
        Ok(Values {
            components: columns.len(),
            rounding: stored.rounding(largest),
            stored,
            is_of_cells,
            numbers,
        })
    }

    /// The columns that a field of this dimension has; `None` for a component that is 0 everywhere, which a file may omit.
    fn wanted(
        &self,
        snapshot: &Snapshot,
        dimension: usize,
    ) -> Result<Vec<Option<Column>>, Mistake> {
        let pairs = || pairs_of((0..dimension).collect());
        let found = match self.role.form() {
            Form::Scalar => vec![self.columns.first().filter(|_| self.columns.len() == 1)],
            Form::Vector => (0..dimension).map(|axis| self.nth(axis)).collect(),
            Form::Tensor => pairs().map(|(i, j)| self.entry(i, j)).collect(),
            Form::Symmetric => {
                pairs().map(|(i, j)| self.entry(i, j).or_else(|| self.entry(j, i))).collect()
            }
            Form::Voigt => {
                pairs_of(self.in_dimension(dimension)).map(|(i, j)| self.entry(i, j)).collect()
            }
        };
        let is_zero = |at: usize| {
            let (row, column) = (at / dimension, at % dimension);
            let is_tensor = matches!(self.role.form(), Form::Tensor | Form::Symmetric);
            is_tensor && self.has_names() && self.axes.has_no_swirl() && (row == 2) != (column == 2)
        };
        let found = found.into_iter().enumerate().map(|(at, it)| match it {
            None if is_zero(at) => Some(None),
            it => it.map(|it| Some(it.1)),
        });
        let found: Option<Vec<_>> = found.collect();
        found.ok_or_else(|| self.misfit(snapshot, dimension))
    }

    /// The rows of a matrix over Voigt's components that a field of this dimension has: in a plane all except 33.
    fn in_dimension(&self, dimension: usize) -> Vec<usize> {
        match (dimension, self.columns.len()) {
            (2, 16) => vec![0, 1, 3],
            _ => (0..dimension * (dimension + 1) / 2).collect(),
        }
    }

    /// The least number of axes, rows and columns in names: 1 if they are counted from 1.
    fn least_number(&self) -> usize {
        let is_named = |part: &Part| matches!(part, Part::Entry(..));
        let least = |(part, _): &(Part, Column)| match *part {
            Part::Nth(at) => at,
            Part::Entry(i, j) => i.min(j),
        };
        let (least, most) = (
            self.columns.iter().map(least).min().unwrap_or(0),
            self.columns
                .iter()
                .map(|(part, _)| match *part {
                    Part::Nth(at) => at,
                    Part::Entry(i, j) => i.max(j),
                })
                .max()
                .unwrap_or(0),
        );
        let any = self.columns.iter().any(|(part, _)| is_named(part));
        usize::from(least == 1 && (any || most <= self.columns.len()))
    }

    fn nth(&self, at: usize) -> Option<&(Part, Column)> {
        self.columns.iter().find(|(part, _)| *part == Part::Nth(at + self.least_number()))
    }

    /// The entry of a matrix: by its name, or by its position row by row in a square matrix.
    fn entry(&self, row: usize, column: usize) -> Option<&(Part, Column)> {
        let from = self.least_number();
        let named = |part: &Part| *part == Part::Entry(row + from, column + from);
        let by_name = self.columns.iter().find(|(part, _)| named(part));
        let largest = if self.role.form() == Form::Voigt { 6 } else { 3 };
        let size = (1..=largest).find(|size| size * size == self.columns.len());
        by_name
            .or_else(|| self.nth(row * size.filter(|&size| row < size && column < size)? + column))
    }

    /// The units in the file of its columns, each with the name of the column.
    pub fn units<'a>(&self, snapshot: &'a Snapshot) -> Vec<(&'a str, &'a str)> {
        let is_own = |(array, _): &&(String, String)| self.has_array(snapshot, array);
        let own = snapshot.units.iter().filter(is_own);
        own.map(|(name, unit)| (name.as_str(), unit.as_str())).collect()
    }

    /// Whether an array of this name contains columns of the quantity.
    pub fn has_array(&self, snapshot: &Snapshot, array: &str) -> bool {
        self.columns.iter().any(|(_, it)| name(snapshot, it.place) == array)
    }

    /// Describes the columns: their points or cells, their precision, and the reason for the quantity.
    pub fn explained(&self, snapshot: &Snapshot) -> String {
        let array = |column: &Column| array(snapshot, column.place);
        let mut parts = Vec::new();
        if let Some((_, first)) = self.columns.first() {
            let of = if matches!(first.place, ArrayPlace::Cells(_)) { "cells" } else { "points" };
            match self.is_one_array() {
                true => {
                    parts.push(format!("`{}` of {of} ({})", self.source, array(first).described()))
                }
                false => {
                    let names: Vec<_> =
                        self.columns.iter().map(|(_, it)| name(snapshot, it.place)).collect();
                    parts.push(format!("`{}` of {of}", names.join("`, `")));
                }
            }
            parts.push(array(first).stored.name());
        }
        let entry = |(part, _): &(Part, Column)| match part {
            Part::Entry(i, j) => {
                Some(format!("{}{}", i + 1 - self.least_number(), j + 1 - self.least_number()))
            }
            Part::Nth(_) => None,
        };
        let entries: Option<Vec<_>> = self.columns.iter().map(entry).collect();
        match (self.role.form(), entries) {
            (Form::Scalar | Form::Vector, _) => {}
            (_, Some(entries)) => parts.push(format!("entries {}", entries.join(", "))),
            (_, None) => parts.push("entries row by row".into()),
        }
        parts.push(match &self.why {
            Why::Name => "by its name".into(),
            Why::Map(_) => "as `--map` says".into(),
            Why::Profile(name) => format!("as `--from {name}` says"),
        });
        parts.join("; ")
    }

    /// The number of components in a field of this dimension.
    fn expected(&self, dimension: usize) -> usize {
        match self.role.form() {
            Form::Scalar => 1,
            Form::Vector => dimension,
            Form::Tensor | Form::Symmetric => dimension * dimension,
            Form::Voigt => (dimension * (dimension + 1) / 2).pow(2),
        }
    }

    /// The possible orders of components of a tensor without names, each with the columns of its rows.
    fn orders(&self, dimension: usize) -> &'static [(&'static str, &'static [usize])] {
        let is_tensor = matches!(self.role.form(), Form::Tensor | Form::Symmetric);
        match (dimension, self.columns.len()) {
            _ if !is_tensor || self.has_names() => &[],
            (1, 3 | 4 | 6) => &[("11 first", &[0])],
            (2, 3) => &[("11, 22, 12", &[0, 2, 2, 1])],
            (2, 6) => &[("11, 22, 33, 12, ..", &[0, 3, 3, 1])],
            (3, 6) => &[
                ("11, 22, 33, 12, 23, 13 (VTK)", &[0, 3, 5, 3, 1, 4, 5, 4, 2]),
                ("11, 22, 33, 12, 13, 23 (Abaqus)", &[0, 3, 4, 3, 1, 5, 4, 5, 2]),
                ("11, 22, 33, 23, 13, 12 (Voigt)", &[0, 5, 4, 5, 1, 3, 4, 3, 2]),
            ],
            _ => &[],
        }
    }

    fn misfit(&self, snapshot: &Snapshot, dimension: usize) -> Mistake {
        let (symbol, source, found) = (self.role.symbol(), &self.source, self.columns.len());
        let expected = self.expected(dimension);
        let orders = self.orders(dimension);
        let said = |(entries, rows): &(&str, &[usize])| {
            let listed = self.listed(snapshot, rows.iter().copied());
            format!("; if they are {entries}, say `--map {symbol}={listed}`")
        };
        let named = self.columns.iter().map(|(_, column)| name(snapshot, column.place));
        let advice = match orders {
            [] if self.has_names() && found >= expected => {
                "; an entry is missing: off the diagonal the file has each entry once, as for a symmetric tensor, which this quantity is not".into()
            }
            [] if found == expected && !self.is_one_array() => format!(
                "; their names give other axes: name them in order with `--map {symbol}={}`",
                named.collect::<Vec<_>>().join(",")
            ),
            [] => format!("; name {expected} with `--map {symbol}=..`, row by row"),
            _ => format!(
                "{}; or name the code that wrote it with `--from`",
                orders.iter().map(said).collect::<String>()
            ),
        };
        let ranges = match self.is_one_array() {
            true => format!(" ({})", array(snapshot, self.columns[0].1.place).described()),
            false => String::new(),
        };
        Mistake::new(format!(
            "`{source}`, read as {}, has {found} component(s){ranges}, and of {dimension} dimension(s) {expected} are \
             expected{advice}",
            self.role.name()
        ))
    }

    /// Whether the column names give rows and columns of a matrix.
    fn has_names(&self) -> bool {
        self.columns.iter().any(|(part, _)| matches!(part, Part::Entry(..)))
    }

    /// Refuses four numbers of a symmetric tensor in a plane that cannot be 11, 12, 21, 22, because 12 differs from 21; or that
    /// are no likelier to be these than 11, 22, 33, 12.
    fn validate_rows(
        &self,
        snapshot: &Snapshot,
        numbers: &[f64],
        dimension: usize,
    ) -> Result<(), Mistake> {
        let is_listed = matches!(self.why, Why::Map(names) if names > 1);
        let is_four = self.columns.len() == 4 && dimension == 2 && !is_listed && !self.has_names();
        if self.role.form() != Form::Symmetric || !is_four {
            return Ok(());
        }
        let largest = numbers.iter().fold(0.0, |most: f64, it| most.max(it.abs()));
        let points = || numbers.as_chunks::<4>().0.iter();
        let is_symmetric = points().all(|it| (it[1] - it[2]).abs() <= SYMMETRIC * largest);
        let has_shear = points().any(|it| it[1] != 0.0);
        let has_last = points().any(|it| it[3] != 0.0);
        if is_symmetric && (has_last || !has_shear) {
            return Ok(());
        }
        let (symbol, source) = (self.role.symbol(), &self.source);
        let apart = points().map(|it| (it[1] - it[2]).abs()).fold(0.0, f64::max);
        Err(Mistake::new(format!(
            "`{source}` has {}: in which order? If they are 11, 22, 33, 12, say `--map {symbol}={}`; if 11, 12, 21, 22, say \
             `--map {symbol}={}`. As 12 and 21, two of them differ by at most {apart:.1e}",
            match self.is_one_array() {
                true => array(snapshot, self.columns[0].1.place).described(),
                false => format!("{} columns", self.columns.len()),
            },
            self.listed(snapshot, [0, 3, 3, 1]),
            self.listed(snapshot, [0, 1, 2, 3]),
        )))
    }

    /// Refuses a vector with more components than the field has, unless the others are 0 everywhere up to roundoff.
    fn validate_flat(&self, snapshot: &Snapshot, dimension: usize) -> Result<(), Mistake> {
        let from = self.least_number();
        let is_beyond = |part: &Part| matches!(part, Part::Nth(at) if *at >= dimension + from);
        let beyond = self.columns.iter().filter(|(part, _)| is_beyond(part));
        if self.role.form() != Form::Vector {
            return Ok(());
        }
        let numbers = |column: &Column| {
            let array = array(snapshot, column.place);
            array.values.iter().skip(column.component).step_by(array.components)
        };
        let own = self.columns.iter().filter(|(part, _)| !is_beyond(part));
        let own = own.flat_map(|(_, column)| numbers(column));
        let least = ROUNDOFF * own.fold(0.0, |most: f64, it| most.max(it.abs()));
        for (_, column) in beyond {
            let is_large = |(_, it): &(usize, &f64)| it.is_nan() || it.abs() > least;
            if let Some((row, value)) = numbers(column).enumerate().find(is_large) {
                let array = array(snapshot, column.place);
                if array.components > 3 && array.rows() <= 3 {
                    let what = format!(
                        "`{}` has {} rows of {} numbers: expected a row for each point; transpose it",
                        self.source,
                        array.rows(),
                        array.components
                    );
                    return Err(Mistake::new(what).of(&snapshot.path));
                }
                let what = format!(
                    "`{}` has a component of {value} beyond the {dimension} of the field; expected 0",
                    self.source
                );
                return Err(here(snapshot, row, what));
            }
        }
        Ok(())
    }
}

/// The largest number of the cells of highest dimension; other cells are no part of the body. For a number that is not finite,
/// the error is its position.
fn largest_of_cells(snapshot: &Snapshot, numbers: &[f64], components: usize) -> Result<f64, usize> {
    let shape = |(kind, points): (u8, &[usize])| {
        CellShape::of(kind, points.len()).map_or(UNKNOWN, |shape| shape.dimension)
    };
    let dimensions: Vec<usize> = snapshot.cells.iter().map(shape).collect();
    let most = dimensions.iter().copied().max().unwrap_or(UNKNOWN);
    let mut largest = 0.0_f64;
    for (cell, own) in numbers.chunks_exact(components).enumerate() {
        let is_of_body = dimensions.get(cell).is_none_or(|it| *it == most);
        for (at, number) in own.iter().enumerate().filter(|_| is_of_body) {
            if !number.is_finite() {
                return Err(cell * components + at);
            }
            largest = largest.max(number.abs());
        }
    }
    Ok(largest)
}

/// The dimension assumed for cells of unknown shape, such as polygons.
const UNKNOWN: usize = 2;

/// Rows and columns of a square matrix, row by row.
fn pairs_of(rows: Vec<usize>) -> impl Iterator<Item = (usize, usize)> {
    let columns = rows.clone();
    rows.into_iter().flat_map(move |i| columns.clone().into_iter().map(move |j| (i, j)))
}

/// The numbers of some columns, row by row; 0 where a column is missing.
fn gathered<'a>(snapshot: &'a Snapshot, columns: &[Option<Column>], rows: usize) -> Cow<'a, [f64]> {
    // Most often they are adjacent, alone or with a third coordinate after them.
    let start = columns[0].filter(|start| {
        let is_next = |(at, column): (usize, &Option<Column>)| {
            let (place, component) = (start.place, start.component + at);
            *column == Some(Column { place, component })
        };
        columns.iter().enumerate().all(is_next)
    });
    if let Some(start) = start {
        let first = array(snapshot, start.place);
        if columns.len() == first.components {
            return Cow::Borrowed(&first.values);
        }
        let (start, count) = (start.component, columns.len());
        let mut numbers = Vec::with_capacity(rows * count);
        let each = first.values.chunks_exact(first.components);
        each.for_each(|row| numbers.extend_from_slice(&row[start..start + count]));
        return numbers.into();
    }
    let mut numbers = vec![0.0; rows * columns.len()];
    for (at, column) in columns.iter().enumerate() {
        let Some(column) = column else { continue };
        let array = array(snapshot, column.place);
        let own = array.values.chunks_exact(array.components).map(|row| row[column.component]);
        let to = numbers.chunks_exact_mut(columns.len());
        to.zip(own).for_each(|(to, number)| to[at] = number);
    }
    numbers.into()
}

pub(crate) fn array(snapshot: &Snapshot, place: ArrayPlace) -> &Array {
    match place {
        ArrayPlace::Points(at) => &snapshot.of_points[at],
        ArrayPlace::Cells(at) => &snapshot.of_cells[at],
        ArrayPlace::Grid => {
            snapshot.points.as_ref().expect("a meaning is of the snapshot that it was found in")
        }
    }
}

/// The name of an array in `--map`.
pub(crate) fn name(snapshot: &Snapshot, place: ArrayPlace) -> &str {
    if place == ArrayPlace::Grid { "points" } else { &array(snapshot, place).name }
}

/// A mistake at a point.
pub(crate) fn here(snapshot: &Snapshot, row: usize, what: String) -> Mistake {
    let line = snapshot.lines.get(row).copied();
    let what = if line.is_some() { what } else { format!("point {row}: {what}") };
    Mistake { path: snapshot.path.clone(), line, what }
}
