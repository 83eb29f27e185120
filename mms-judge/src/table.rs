//! Tables of errors: CSV, TSV, or columns between blanks, with a header.

use std::path::Path;
use std::str::FromStr;

use anyhow::{Context as _, anyhow, bail};
use csv::{ReaderBuilder, StringRecord};
use mms_convergence::ExpectedOrder;
use mms_spec::foreign;
use mms_spec::foreign::shown;
use mms_spec::suggest::did_you_mean;

use crate::measured::{Measured, Norm, Quantity, RunSize};
use crate::names::Column;
use crate::results::Start;

/// An order, optionally of a named norm, as in `2` or `H1=1`.
#[derive(Clone, Debug)]
pub struct NamedOrder {
    name: Option<String>,
    order: f64,
}

impl FromStr for NamedOrder {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, &'static str> {
        Ok(match text.rsplit_once('=') {
            Some((name, order)) => Self { name: Some(name.to_owned()), order: finite(order)? },
            None => Self { name: None, order: finite(text)? },
        })
    }
}

/// Reads a number that is neither infinite nor NaN.
fn finite(text: &str) -> Result<f64, &'static str> {
    text.trim().parse().ok().filter(|it: &f64| it.is_finite()).ok_or("expected a finite number")
}

/// The expected orders: of all norms, or of named ones.
#[derive(Clone, Debug, PartialEq)]
pub struct ExpectedOrders {
    /// The order of everything without an order of its own.
    pub usual: f64,
    /// The degree of the cells, if it is known.
    pub degree: Option<u32>,
    /// Whether the user gave the usual order.
    pub is_given: bool,
    /// The orders of named norms, quantities or columns; the order of `time` is the one of dt in a grid of h and dt.
    pub named: Vec<(String, f64)>,
    /// The tolerance of an order.
    pub tolerance: f64,
    /// The start of the solver, if the user gave it.
    pub start: Option<Start>,
}

/// The character between a quantity and its norm.
pub const OF: char = ':';

/// The column that names the method of each row, in the table of a study of several.
const METHOD: &str = "method";

/// The name of the order in dt.
pub const TIME: &str = "time";

impl ExpectedOrders {
    /// Collects given orders; the last one of a name counts, and the usual order is 2 if none is given.
    pub fn new(given: &[NamedOrder], tolerance: f64) -> Self {
        let usual = given.iter().rev().find(|it| it.name.is_none());
        let named = given.iter().rev().filter_map(|it| Some((it.name.clone()?, it.order)));
        let (is_given, usual) = (usual.is_some(), usual.map_or(2.0, |it| it.order));
        let named = named.collect();
        ExpectedOrders { usual, degree: None, is_given, named, tolerance, start: None }
    }

    /// The orders for cells of a degree: the usual order is one more than the degree, unless the user gave another one.
    pub fn of_degree(self, degree: Option<u32>) -> Self {
        let own = degree.filter(|_| !self.is_given).map(|degree| f64::from(degree + 1));
        Self { usual: own.unwrap_or(self.usual), degree, ..self }
    }

    /// The usual order of gradients.
    pub(super) fn of_gradients(&self) -> f64 {
        self.of_gradient(self.usual)
    }

    /// The order of the gradient of a quantity with this order: the degree of the cells, if nothing else limits the order;
    /// otherwise one less.
    fn of_gradient(&self, order: f64) -> f64 {
        self.degree.map_or(order - 1.0, |degree| order.min(degree.into()))
    }

    fn find(&self, names: &[&str]) -> Option<&(String, f64)> {
        self.named.iter().find(|(name, _)| names.contains(&name.as_str()))
    }

    /// The expected orders of a norm of a quantity in this column, in h and in dt.
    pub(super) fn of(&self, column: &str, quantity: &str, norm: &str) -> [ExpectedOrder; 2] {
        let usual = if norm == "h1" { self.of_gradients() } else { self.usual };
        let space = self.given(column, quantity, norm).unwrap_or(usual);
        let time = self.find(&[TIME]).map_or(self.usual, |(_, order)| *order);
        [space, time].map(|order| self.expected(order))
    }

    /// The range of orders that are expected around an order.
    pub(super) fn expected(&self, order: f64) -> ExpectedOrder {
        ExpectedOrder::new(order, self.tolerance)
    }

    /// The given order of a norm of a quantity: given for both together, for the column, or for one of the two. The order of a
    /// quantity is the order of its values; in H1 it has the order of their gradient.
    pub(super) fn given(&self, column: &str, quantity: &str, norm: &str) -> Option<f64> {
        let both = [column, quantity].map(|it| format!("{it}{OF}{norm}"));
        let of_both = self.find(&[&both[0], &both[1]]);
        let (name, order) =
            of_both.or_else(|| self.find(&[column])).or_else(|| self.find(&[quantity, norm]))?;
        let says_h1 = || matches!(Column::named(name), Column::Error { norm, .. } if norm == "h1");
        Some(if norm == "h1" && !says_h1() { self.of_gradient(*order) } else { *order })
    }

    /// Refuses orders of names that are not in the table.
    fn validate_names(&self, columns: &[Cell]) -> anyhow::Result<()> {
        let mut known = vec![TIME.to_owned()];
        for cell in columns {
            if let Column::Error { quantity, norm } = Column::named(&cell.text) {
                known.extend([cell.text.clone(), quantity, norm]);
            }
        }
        known.retain(|it| !it.is_empty());
        if let Some((name, _)) = self.named.iter().find(|(name, _)| !known.contains(name)) {
            known.sort();
            known.dedup();
            let advice = match did_you_mean(name, known.iter().map(String::as_str)) {
                Some(meant) => format!("did you mean `{}`?", shown(meant)),
                None => format!("known are {}", shown(&known.join(", "))),
            };
            bail!(
                "`--expected-order {}=..`: there is no such norm or column; {advice}",
                shown(name)
            );
        }
        Ok(())
    }
}

/// A field of the table, and its place.
#[derive(Clone)]
struct Cell {
    text: String,
    line: u64,
    column: usize,
}

/// A table whose rows have as many fields as its header.
struct ErrorTable {
    path: String,
    header: Vec<Cell>,
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

/// Reads a table from the text of a file, and lists the columns that are no errors. Of a table with a column of methods, reads
/// the rows of one method.
///
/// # Errors
/// A text that is no such table, with the place; several methods without a choice; a method that the table lacks.
pub fn read(
    path: &Path,
    text: &str,
    orders: &ExpectedOrders,
    method: Option<&str>,
) -> anyhow::Result<(Measured, Vec<String>)> {
    let mut table = ErrorTable::parse(foreign::path(path), text)?;
    table.choose(method)?;
    orders.validate_names(&table.header)?;
    let measured = Measured { runs: table.runs()?, quantities: table.quantities(orders)? };
    Ok((measured, table.left_out()))
}

impl ErrorTable {
    fn parse(path: String, text: &str) -> anyhow::Result<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut rows = cells(text).with_context(|| format!("cannot read `{path}`"))?;
        if rows.is_empty() {
            bail!(
                "{path}:1:1: expected a header with `h` and the names of errors; the file is empty"
            );
        }
        let header = rows.remove(0);
        let columns = header.iter().map(|cell| Column::named(&cell.text)).collect();
        let table = Self { path, header, columns, rows };
        table.validate_header()?;
        table.validate_rows()?;
        Ok(table)
    }

    /// Keeps the rows of a method, and drops the column of methods.
    fn choose(&mut self, method: Option<&str>) -> anyhow::Result<()> {
        let names_methods = |cell: &Cell| cell.text.eq_ignore_ascii_case(METHOD);
        let Some(at) = self.header.iter().position(names_methods) else {
            if method.is_some() {
                bail!("`--method`: `{}` has no column `{METHOD}`", self.path);
            }
            return Ok(());
        };
        let is_number = |row: &Vec<Cell>| row[at].text.parse::<f64>().is_ok();
        if method.is_none() && self.rows.iter().all(is_number) {
            return Ok(());
        }
        let mut names: Vec<&str> = Vec::new();
        for name in self.rows.iter().map(|row| row[at].text.as_str()) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let chosen = match (method, names.as_slice()) {
            (None, [only]) => *only,
            (Some(method), all) if all.contains(&method) => method,
            (given, all) => {
                let wrong =
                    given.map_or(String::new(), |it| format!(" `{}` is none of them;", shown(it)));
                let all: Vec<_> = all.iter().map(|it| format!("`{}`", shown(it))).collect();
                bail!(
                    "{}: a table of {} methods:{wrong} choose one with `--method NAME`: {}",
                    self.place(&self.header[at]),
                    all.len(),
                    all.join(", ")
                )
            }
        };
        let chosen = chosen.to_owned();
        self.rows.retain(|row| row[at].text == chosen);
        self.rows.iter_mut().for_each(|row| {
            row.remove(at);
        });
        self.header.remove(at);
        self.columns.remove(at);
        Ok(())
    }

    fn place(&self, cell: &Cell) -> String {
        format!("{}:{}:{}", self.path, cell.line, cell.column)
    }

    fn validate_header(&self) -> anyhow::Result<()> {
        let first = &self.header[0];
        if self.header.iter().any(|cell| cell.text.parse::<f64>().is_ok()) {
            bail!(
                "{}: expected a header with `h` and the names of errors, and found a number; name the columns in the \
                 first row, without `#`",
                self.place(first)
            );
        }
        if let Some(odd) = self.header.iter().find(|it| it.text.contains(char::is_control)) {
            bail!("{}: `{}`: expected a name on one line", self.place(odd), shown(&odd.text));
        }
        for (at, cell) in self.header.iter().enumerate() {
            let before = self.header[..at].iter().zip(&self.columns);
            let is_other = self.columns[at] == Column::Other;
            let twin = before.filter(|_| !is_other).find(|(_, it)| **it == self.columns[at]);
            if let Some((twin, _)) = twin {
                bail!(
                    "{}: `{}` means what `{}` does; rename one of the columns, or leave it out",
                    self.place(cell),
                    shown(&cell.text),
                    shown(&twin.text)
                );
            }
        }
        if !self.columns.contains(&Column::CellSize) {
            bail!("{}: expected a column `h`, the cell size", self.place(first));
        }
        if !self.columns.iter().any(|it| matches!(it, Column::Error { .. })) {
            bail!("{}: expected a column of errors, such as `l2`", self.place(first));
        }
        Ok(())
    }

    fn validate_rows(&self) -> anyhow::Result<()> {
        let Some(_) = self.rows.first() else {
            let line = self.header[0].line;
            bail!("{}:{line}:1: expected a row for each run below the header", self.path);
        };
        let odd = self.rows.iter().find(|row| row.len() != self.header.len());
        odd.map_or(Ok(()), |row| {
            bail!(
                "{}: expected {} fields, as in the header, and found {}",
                self.place(&row[0]),
                self.header.len(),
                row.len()
            )
        })
    }

    /// The cells of a column, if the table has it.
    fn column(&self, wanted: &Column) -> Option<impl Iterator<Item = &Cell>> {
        let at = self.columns.iter().position(|it| it == wanted)?;
        Some(self.rows.iter().map(move |row| &row[at]))
    }

    fn runs(&self) -> anyhow::Result<Vec<RunSize>> {
        let length = |cell: &Cell| self.number(cell, "a length", "above 0", |it| it > 0.0);
        let lengths = |wanted| -> anyhow::Result<Option<Vec<f64>>> {
            self.column(wanted).map(|cells| cells.map(length).collect()).transpose()
        };
        let steps = lengths(&Column::TimeStep)?;
        let sizes = lengths(&Column::CellSize)?.unwrap_or_default().into_iter().enumerate();
        let step = |at: usize| steps.as_ref().map(|steps| steps[at]);
        Ok(sizes.map(|(at, cell_size)| RunSize { cell_size, time_step: step(at) }).collect())
    }

    fn quantities(&self, orders: &ExpectedOrders) -> anyhow::Result<Vec<Quantity>> {
        let mut quantities: Vec<Quantity> = Vec::new();
        for (column, cell) in self.columns.iter().zip(&self.header) {
            let Column::Error { quantity, norm } = column else { continue };
            let name = if quantity.is_empty() { "error" } else { quantity };
            let norm = Norm {
                name: norm.as_str().into(),
                expected: orders.of(&cell.text, quantity, norm),
                errors: self.errors(column)?,
                floors: self.floors()?,
                rounding: self.rounding(column),
                is_exact: false,
            };
            match quantities.iter_mut().find(|it| it.name == *name) {
                Some(known) => known.norms.push(norm),
                None => quantities.push(Quantity { name: name.into(), norms: vec![norm] }),
            }
        }
        Ok(quantities)
    }

    /// The errors of a column. A run stopped if a field is empty, or its number is not finite.
    fn errors(&self, column: &Column) -> anyhow::Result<Vec<Option<f64>>> {
        let error = |cell: &Cell| match cell.text.parse::<f64>() {
            Ok(number) if !number.is_finite() => Ok(None),
            _ if cell.text.is_empty() => Ok(None),
            _ => self.number(cell, "an error", "0 or above", |it| it >= 0.0).map(Some),
        };
        self.column(column).into_iter().flatten().map(error).collect()
    }

    /// Half a unit of the last digit of the longest number of a column: others may have lost zeros at their ends. Whole
    /// numbers are exact.
    fn rounding(&self, column: &Column) -> f64 {
        let places = self.column(column).into_iter().flatten().map(|cell| places(&cell.text));
        places.max().filter(|it| *it != 0).map_or(0.0, |places| 0.5 * 10f64.powi(-places))
    }

    /// A sentence about the columns that are no errors.
    fn left_out(&self) -> Vec<String> {
        let columns = self.header.iter().zip(&self.columns);
        let others = columns.filter(|(cell, it)| **it == Column::Other && !cell.text.is_empty());
        let names: Vec<_> = others.map(|(cell, _)| format!("`{}`", shown(&cell.text))).collect();
        let sentence =
            || format!("left out, because their names denote no errors: {}", names.join(", "));
        (!names.is_empty()).then(sentence).into_iter().collect()
    }

    fn floors(&self) -> anyhow::Result<Vec<f64>> {
        match self.columns.contains(&Column::Floor) {
            true => Ok(self
                .errors(&Column::Floor)?
                .into_iter()
                .map(Option::unwrap_or_default)
                .collect()),
            false => Ok(vec![0.0; self.rows.len()]),
        }
    }

    fn number(
        &self,
        cell: &Cell,
        what: &str,
        range: &str,
        fits: impl Fn(f64) -> bool,
    ) -> anyhow::Result<f64> {
        let number = cell.text.parse().ok().filter(|it: &f64| it.is_finite() && fits(*it));
        number.ok_or_else(|| {
            let (place, text) = (self.place(cell), shown(&cell.text));
            anyhow!("{place}: `{text}`: expected {what}, a finite number {range}")
        })
    }
}

/// The place of the last digit of a number, counted from the point: 4 of `1.2e-3`.
fn places(text: &str) -> i32 {
    let lower = text.to_lowercase();
    let (mantissa, exponent) = lower.split_once('e').unwrap_or((&lower, "0"));
    let places = mantissa.split_once('.').map_or(0, |(_, places)| places.len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    i32::try_from(places).unwrap_or(i32::MAX).saturating_sub(exponent)
}

/// The delimiter of fields: the first of these characters in the first line that is no comment; otherwise a blank.
fn delimiter(text: &str) -> u8 {
    let is_comment = |line: &&str| line.starts_with('#') || line.trim().is_empty();
    let header = text.lines().find(|line| !is_comment(line)).unwrap_or_default();
    *b"\t;,".iter().find(|it| header.as_bytes().contains(it)).unwrap_or(&b' ')
}

/// The fields of each row, without blanks around them.
fn cells(text: &str) -> anyhow::Result<Vec<Vec<Cell>>> {
    let delimiter = delimiter(text);
    let reader = ReaderBuilder::new()
        .delimiter(delimiter)
        .comment(Some(b'#'))
        .flexible(true)
        .has_headers(false)
        .from_reader(text.as_bytes());
    let mut rows = Vec::new();
    for record in reader.into_records() {
        let record = record?;
        let mut fields = fields(text, &record, delimiter.into());
        if delimiter == b' ' {
            fields.retain(|cell| !cell.text.is_empty());
        }
        if fields.iter().any(|cell| !cell.text.is_empty()) {
            rows.push(fields);
        }
    }
    Ok(rows)
}

/// The fields of a record. Its position is before the comments and empty lines that precede it.
fn fields(text: &str, record: &StringRecord, delimiter: char) -> Vec<Cell> {
    let (byte, first) = record.position().map_or((0, 1), |it| (it.byte() as usize, it.line()));
    let is_skipped = |line: &&str| line.is_empty() || line.starts_with('#');
    let skipped = text[byte..].lines().take_while(is_skipped).count();
    let own = text[byte..].lines().nth(skipped).unwrap_or_default();
    let starts = starts(own, delimiter).into_iter().chain(std::iter::repeat(1));
    let cell = |(field, start): (&str, usize)| {
        let column = start + field.chars().count() - field.trim_start().chars().count();
        Cell { text: field.trim().to_owned(), line: first + skipped as u64, column }
    };
    record.iter().zip(starts).map(cell).collect()
}

/// The columns at which the fields of a line start.
fn starts(line: &str, delimiter: char) -> Vec<usize> {
    let (mut starts, mut is_quoted) = (vec![1], false);
    for (at, c) in line.chars().enumerate() {
        let is_start = starts.last() == Some(&(at + 1));
        is_quoted ^= c == '"' && (is_start || is_quoted);
        if c == delimiter && !is_quoted {
            starts.push(at + 2);
        }
    }
    starts
}
