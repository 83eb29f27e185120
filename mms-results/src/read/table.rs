//! Tables: a header with names, and a line of numbers for each point.

use csv::{ByteRecord, ReaderBuilder, Trim};

use super::text::{Style, number, settle};
use crate::{Array, Mistake, Snapshot, Time};

/// At how many times a table may be.
const MOST_TIMES: usize = 10_000;

/// What a column of times may be called.
const TIMES: [&str; 4] = ["time", "t", "timevalue", "time_value"];

/// Whether a column or an array of this name holds times.
pub fn is_time(name: &str) -> bool {
    TIMES.contains(&name.to_ascii_lowercase().as_str())
}

/// A table as it stands there.
struct Table {
    columns: Vec<Array>,
    styles: Vec<Style>,
    lines: Vec<usize>,
}

/// Reads a table whose columns are separated by commas, tabs, semicolons or spaces.
pub fn parse(bytes: &[u8]) -> Result<Vec<Snapshot>, Mistake> {
    let text = std::str::from_utf8(bytes).map_err(|error| not_text(bytes, error.valid_up_to()))?;
    let text = text.trim_start_matches('\u{feff}');
    let table = read(text)?;
    by_time(table)
}

fn not_text(bytes: &[u8], at: usize) -> Mistake {
    let line = 1 + memchr::memchr_iter(b'\n', &bytes[..at]).count();
    let what = "neither text nor a format that is known: expected a table with a header, VTK (.vtu, .vtp, .pvd, \
                .vtk) or NumPy (.npz, .npy)";
    Mistake::at(line, what)
}

fn read(text: &str) -> Result<Table, Mistake> {
    let first = text.lines().find(|line| !line.trim().is_empty()).unwrap_or("");
    let mut reader = ReaderBuilder::new()
        .delimiter(delimiter(first))
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let mut record = ByteRecord::new();
    let mut place = Lines { text, line: 1, at: 0 };
    let mut table: Option<(Table, Vec<bool>)> = None;
    while reader.read_byte_record(&mut record).map_err(|error| Mistake::new(error.to_string()))? {
        let line = place.of(record.position().map_or(0, |at| at.byte()) as usize);
        match &mut table {
            None => table = Some((header(&record, line)?, Vec::new())),
            Some((table, numeric)) => table.push(&record, line, numeric)?,
        }
    }
    let (mut table, numeric) = table.ok_or_else(|| Mistake::new("the file is empty"))?;
    if table.lines.is_empty() {
        return Err(Mistake::new("a header, and no line of numbers after it"));
    }
    table.settle(&numeric);
    Ok(table)
}

/// Counts lines from one record to the next.
struct Lines<'a> {
    text: &'a str,
    line: usize,
    at: usize,
}

impl Lines<'_> {
    /// The line of the record behind the last one; empty lines before it are passed over.
    fn of(&mut self, start: usize) -> usize {
        let rest = &self.text.as_bytes()[start..];
        let empty = rest.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        let passed = &self.text.as_bytes()[self.at..start + empty];
        self.line += memchr::memchr_iter(b'\n', passed).count();
        self.at = start + empty;
        self.line
    }
}

/// What separates columns, as the header shows it.
fn delimiter(header: &str) -> u8 {
    let separators = [b'\t', b',', b';'];
    let found = separators.into_iter().find(|it| header.as_bytes().contains(it));
    found.unwrap_or(if header.trim_matches(['#', ' ']).contains(' ') { b' ' } else { b',' })
}

fn field(record: &ByteRecord, column: usize) -> &str {
    std::str::from_utf8(&record[column]).unwrap_or("")
}

/// The names of the columns. A `#` before them is no name.
fn header(record: &ByteRecord, line: usize) -> Result<Table, Mistake> {
    let mut names: Vec<String> =
        (0..record.len()).map(|column| field(record, column).trim().to_owned()).collect();
    names[0] = names[0].trim_start_matches('#').trim().to_owned();
    if names.len() > 1 && names[0].is_empty() {
        names.remove(0);
    }
    if names.iter().all(|name| number(name).is_some()) {
        let what = "expected names of columns, as in `X,u`, and found numbers; add a header";
        return Err(Mistake::at(line, what));
    }
    for (column, name) in names.iter().enumerate() {
        if names[..column].contains(name) && !name.is_empty() {
            return Err(Mistake::at(line, format!("two columns are called `{name}`")));
        }
    }
    let styles = vec![Style::default(); names.len()];
    let column =
        |name| Array { name, components: 1, values: Vec::new(), stored: crate::Stored::Double };
    Ok(Table { columns: names.into_iter().map(column).collect(), styles, lines: Vec::new() })
}

/// Whether a word is a number as a program shows it, as in `np.float64(0.5)`: who wrote it meant a number.
fn is_wrapped(text: &str) -> bool {
    let inner = text.trim().strip_suffix(')').and_then(|it| it.split_once('('));
    inner.is_some_and(|(_, inner)| number(inner).is_some())
}

impl Table {
    /// Adds a line. Columns that begin with a word are left out, and are no longer `numeric`.
    fn push(
        &mut self,
        record: &ByteRecord,
        line: usize,
        numeric: &mut Vec<bool>,
    ) -> Result<(), Mistake> {
        let (found, columns) = (record.len(), self.columns.len());
        if found != columns {
            let what = format!(
                "{found} columns, and {columns} names in the header; separate columns by one comma, tab, semicolon \
                 or space"
            );
            return Err(Mistake::at(line, what));
        }
        if numeric.is_empty() {
            *numeric = (0..columns)
                .map(|at| number(field(record, at)).is_some() || is_wrapped(field(record, at)))
                .collect();
        }
        for column in (0..columns).filter(|&column| numeric[column]) {
            let text = field(record, column);
            let value = number(text).ok_or_else(|| {
                let name = &self.columns[column].name;
                Mistake::at(line, format!("column `{name}`: expected a number, found `{text}`"))
            })?;
            self.styles[column].see(text);
            self.columns[column].values.push(value);
        }
        self.lines.push(line);
        Ok(())
    }

    fn settle(&mut self, numeric: &[bool]) {
        let columns = std::mem::take(&mut self.columns).into_iter().zip(&self.styles).zip(numeric);
        let columns = columns.filter(|(_, numeric)| **numeric);
        self.columns =
            columns.map(|((array, style), _)| Array { stored: style.stored(), ..array }).collect();
        let single = vec![false; self.columns.len()];
        settle(&mut self.columns.iter_mut().collect::<Vec<_>>(), &single);
    }
}

/// A table as the snapshots of its times.
fn by_time(mut table: Table) -> Result<Vec<Snapshot>, Mistake> {
    let Some(column) = table.columns.iter().position(|column| is_time(&column.name)) else {
        return Ok(vec![Snapshot {
            of_points: table.columns,
            lines: table.lines,
            ..Snapshot::default()
        }]);
    };
    let times = table.columns.remove(column);
    let mut rows: Vec<usize> = (0..table.lines.len()).collect();
    rows.sort_by(|&a, &b| times.values[a].total_cmp(&times.values[b]));
    let groups: Vec<&[usize]> =
        rows.chunk_by(|&a, &b| times.values[a] == times.values[b]).collect();
    if groups.len() > MOST_TIMES {
        let what = format!(
            "{} different times in the column `{}`; expected one mesh at {MOST_TIMES} times at most",
            groups.len(),
            times.name
        );
        return Err(Mistake::new(what));
    }
    Ok(groups.into_iter().map(|rows| at_time(&table, &times, rows)).collect())
}

fn at_time(table: &Table, times: &Array, rows: &[usize]) -> Snapshot {
    let value = times.values[rows[0]];
    let part = |column: &Array| Array {
        values: rows.iter().map(|&row| column.values[row]).collect(),
        ..column.clone_without_values()
    };
    Snapshot {
        time: Some(Time { value, rounding: times.stored.rounding(value) }),
        of_points: table.columns.iter().map(part).collect(),
        lines: rows.iter().map(|&row| table.lines[row]).collect(),
        ..Snapshot::default()
    }
}
