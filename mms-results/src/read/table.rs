//! Tables: a header with names, and a line of numbers for each point.

use std::collections::BTreeSet;

use super::text::{Style, finish, number, with_point, without_unit};
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot, Time};

/// The most times of a table.
const MOST_TIMES: usize = 10_000;

/// The most columns of a table.
const MOST_COLUMNS: usize = 1_000_000;

/// The beginnings of comments.
const MARKS: [&str; 5] = ["#", "%", "!", "//", "**"];

/// The names of a column of times.
const TIMES: [&str; 3] = ["time", "timevalue", "time_value"];

/// Whether a column or an array of this name contains times.
pub fn is_time(name: &str) -> bool {
    // In a structure the last part of a name counts. T is a temperature.
    let last = name.rsplit(['.', '/']).next().unwrap_or(name);
    name == "t" || TIMES.iter().any(|time| last.eq_ignore_ascii_case(time))
}

/// The columns of a table.
struct TableColumns {
    columns: Vec<Array>,
    lines: Vec<usize>,
    unread: Vec<String>,
    units: Vec<(String, String)>,
}

/// A line that is neither empty nor a comment, or the header.
pub type Line<'a> = (usize, &'a str);

/// The beginning of a text in UTF-16, and the conversion of two bytes to a unit.
type Units = ([u8; 2], fn([u8; 2]) -> u16);
const UTF_16: [Units; 2] = [([0xff, 0xfe], u16::from_le_bytes), ([0xfe, 0xff], u16::from_be_bytes)];

/// Reads a table whose columns are separated by commas, tabs, semicolons or blanks.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    if let Some((_, unit)) = UTF_16.iter().find(|(mark, _)| bytes.starts_with(mark)) {
        wanted.reserve("the text", bytes.len() / 8)?;
        let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        let text: Option<String> = char::decode_utf16(units).map(Result::ok).collect();
        let is_text = |it: &String| bytes.len().is_multiple_of(2) && !it.contains('\0');
        let text = text.filter(is_text).ok_or_else(|| not_text(bytes, 0))?;
        return by_time(read(text.trim_start_matches('\u{feff}'), wanted)?);
    }
    let text = std::str::from_utf8(bytes).map_err(|error| not_text(bytes, error.valid_up_to()))?;
    by_time(read(text.trim_start_matches('\u{feff}'), wanted)?)
}

fn not_text(bytes: &[u8], at: usize) -> Mistake {
    let line = 1 + memchr::memchr_iter(b'\n', &bytes[..at]).count();
    let what = "neither text in UTF-8 nor a format that is known: expected a table with a header, VTK (.vtu, .vtp, .pvd, \
                .vtk), NumPy (.npz, .npy), MATLAB (.mat), CalculiX (.frd) or Gmsh (.msh)";
    Mistake::at(line, what)
}

fn read(text: &str, wanted: &Wanted<'_>) -> Result<TableColumns, Mistake> {
    let lines = text.lines().enumerate().map(|(at, line)| (at + 1, line));
    let mut lines = lines.filter(|(_, line)| !line.trim().is_empty()).peekable();
    let (mut comment, mut time) = (None, None);
    while let Some(line) = lines.next_if(|(_, line)| is_remark(line)) {
        time = time_of(line.1).or(time);
        comment = Some(line).filter(|(_, text)| is_comment(text)).or(comment);
    }
    let first = lines.peek().copied();
    let named = wanted.columns().join(",");
    let header = match first {
        Some((line, _)) if !named.is_empty() => {
            Header { line, text: &named, separator: Separator::of(&named), is_given: true }
        }
        _ => header(comment, first)?,
    };
    let is_header = |text: &str| text.trim() == header.text.trim();
    let is_named = first.is_some_and(|(_, text)| has_no_number(text)) && !named.is_empty();
    if first.is_some_and(|(_, text)| is_header(text)) || is_named {
        lines.next();
    }
    let separator = match first {
        Some((_, text)) if !named.is_empty() => Separator::of(text),
        _ => header.separator,
    };
    let mut rows = lines.clone().filter(|(_, line)| !is_remark(line));
    let Some((_, first)) = rows.next() else {
        return Err(Mistake::new("a header, and no line of numbers after it"));
    };
    let mut columns = header.columns(first, separator, wanted)?;
    let read = columns.all.iter().filter(|it| it.is_stored()).count();
    wanted.reserve("the table", read * memchr::memchr_iter(b'\n', text.as_bytes()).count())?;
    let (mut rows, mut times) = (Vec::new(), Column::new(0, TIMES[0], Need::Must));
    for (line, text) in lines {
        if is_remark(text) {
            time = time_of(text).or(time);
            continue;
        }
        // A block may begin with the header again.
        if is_header(text) {
            continue;
        }
        columns.push(line, text, separator)?;
        rows.push(line);
        if let Some(time) = time {
            times.see(line, time)?;
        }
    }
    // A column decides; comments beside it may mean something else.
    let has_column = columns.all.iter().any(|it| is_time(&it.name));
    if !has_column && !times.values.is_empty() {
        if times.values.len() < rows.len() {
            let what = "points before the first line that says their time, as in `# time = 0.1`";
            return Err(Mistake::at(rows[0], what));
        }
        columns.all.push(times);
    }
    Ok(columns.table(rows))
}

/// Reads rows separated by blanks, below a line of names.
pub fn block(names: Line<'_>, rows: &[Line<'_>], wanted: &Wanted<'_>) -> Result<Snapshot, Mistake> {
    let (line, text) = names;
    let header = Header { line, text, separator: Separator::Blanks, is_given: false };
    let first = rows.first().map_or("", |(_, text)| text);
    let mut columns = header.columns(first, Separator::Blanks, wanted)?;
    let read = columns.all.iter().filter(|it| it.is_stored()).count();
    wanted.reserve("the particles", read * rows.len())?;
    for (line, text) in rows {
        columns.push(*line, text, Separator::Blanks)?;
    }
    let lines = rows.iter().map(|(line, _)| *line).collect();
    let TableColumns { columns: of_points, lines, unread, units } = columns.table(lines);
    Ok(Snapshot { of_points, lines, unread, units, ..Snapshot::default() })
}

/// The time in a comment, as in `# time = 0.1` or `# step 5, t = 0.1`, but no clock time such as 12:30 or processor time.
fn time_of(comment: &str) -> Option<&str> {
    let breaks = |it: char| it.is_whitespace() || "=:,;#%!/*\"()".contains(it);
    let words: Vec<&str> = comment.split(breaks).filter(|it| !it.is_empty()).collect();
    let at = words.iter().position(|word| is_time(word))?;
    let is_number = |at: usize| words.get(at).is_some_and(|it| number(it).is_some());
    let is_own = at == 0 || is_number(at - 1);
    words.get(at + 1).copied().filter(|_| is_own && is_number(at + 1) && !is_number(at + 2))
}

/// Whether a line contains only names.
fn has_no_number(line: &str) -> bool {
    fields(line, Separator::of(line)).all(|it| !is_number(it))
}

/// Whether a field is a number, with a decimal point or a decimal comma.
fn is_number(text: &str) -> bool {
    number(text).is_some() || with_point(text).is_some_and(|text| number(&text).is_some())
}

/// Whether a line holds no row: a comment, or a line that says the time of the next rows, as in `TIME 0.1`.
fn is_remark(line: &str) -> bool {
    let says_time = || {
        let word = line.split(|it: char| !it.is_alphanumeric()).find(|it| !it.is_empty());
        word.is_some_and(is_time) && time_of(line).is_some()
    };
    is_comment(line) || says_time()
}

fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    MARKS.iter().any(|mark| line.starts_with(mark))
}

/// The separator between the columns of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Separator {
    Mark(u8),
    Blanks,
}

impl Separator {
    /// The separator in a header.
    fn of(header: &str) -> Self {
        let marks = [b'\t', b',', b';'];
        match marks.into_iter().find(|it| header.as_bytes().contains(it)) {
            Some(mark) => Separator::Mark(mark),
            None => Separator::Blanks,
        }
    }
}

/// The fields of a line, without blanks around them. A separator in quotes does not count.
fn fields(line: &str, separator: Separator) -> impl Iterator<Item = &str> {
    let mut rest = Some(line);
    std::iter::from_fn(move || {
        let mut text = rest?;
        if separator == Separator::Blanks {
            text = text.trim_ascii_start();
            if text.is_empty() {
                return None;
            }
        }
        let quoted = text.trim_ascii_start().strip_prefix('"').and_then(|it| it.split_once('"'));
        let (field, behind) = match quoted {
            Some((field, behind)) => (Some(field), behind),
            None => (None, text),
        };
        let end = match separator {
            Separator::Mark(mark) => memchr::memchr(mark, behind.as_bytes()),
            Separator::Blanks => behind.bytes().position(|byte| byte.is_ascii_whitespace()),
        };
        let (own, after) = match end {
            Some(end) => (&behind[..end], Some(&behind[end + 1..])),
            None => (behind, None),
        };
        rest = after;
        Some(field.unwrap_or(own).trim())
    })
}

/// The names of columns.
struct Header<'a> {
    line: usize,
    text: &'a str,
    separator: Separator,
    /// Whether the user gave the names, and not the file.
    is_given: bool,
}

impl<'a> Header<'a> {
    /// Parses a line as a header. A `#` before it is no name.
    fn of((line, text): Line<'a>) -> Self {
        let text = if is_comment(text) {
            text.trim_start().trim_start_matches(|it| MARKS.concat().contains(it))
        } else {
            text
        };
        Header { line, text, separator: Separator::of(text), is_given: false }
    }

    fn names(&self) -> impl Iterator<Item = &'a str> {
        fields(self.text, self.separator)
    }

    /// Whether a row of this many fields fits the header: the first name may be empty because of a `#`, and an index of points
    /// may have no name.
    fn fits(&self, fields: usize) -> bool {
        let names = self.names().take(MOST_COLUMNS).count();
        names == fields
            || names + 1 == fields
            || names == fields + 1 && self.names().next() == Some("")
    }

    /// The columns of a table with this first row.
    fn columns(
        &self,
        first: &str,
        separator: Separator,
        wanted: &Wanted<'_>,
    ) -> Result<Columns, Mistake> {
        let found: Vec<&str> = fields(first, separator).take(MOST_COLUMNS + 1).collect();
        let mut names: Vec<&str> = self.names().collect();
        if names.len() > MOST_COLUMNS {
            let what = format!("{} columns; expected {MOST_COLUMNS} at most", names.len());
            return Err(Mistake::at(self.line, what));
        }
        if names.len() == found.len() + 1 && names[0].is_empty() {
            names.remove(0);
        }
        let is_longer = found.len() == names.len() + 1;
        // A separator at the end of each line makes an empty field.
        let has_end = is_longer && found.last() == Some(&"");
        let index = match found.first() {
            Some(first) if is_longer && !has_end => first.parse().ok(),
            _ => None,
        };
        if index.is_some() {
            names.insert(0, "");
        }
        let mut seen = BTreeSet::new();
        let (mut all, mut unread, mut units) = (Vec::new(), Vec::new(), Vec::new());
        // A column without a name is no quantity: programs write indices so.
        for (at, name) in names.iter().copied().enumerate().filter(|(_, name)| !name.is_empty()) {
            let (name, unit) = without_unit(name);
            units.extend(unit.map(|unit| (name.to_owned(), unit.to_owned())));
            if !seen.insert(name) {
                let what = format!("two columns are called `{name}`");
                return Err(match self.is_given {
                    true => Mistake::new(format!("`--columns`: {what}")),
                    false => Mistake::at(self.line, what),
                });
            }
            match if is_time(name) { Need::Must } else { wanted.need(name) } {
                Need::No => unread.push(name.to_owned()),
                need => all.push(Column::new(at, name, need)),
            }
        }
        let (count, is_given) = (names.len(), self.is_given);
        let (points, commas) = (None, None);
        Ok(Columns { count, is_given, has_end, index, all, unread, units, points, commas })
    }
}

/// Finds the header: the first line, or, if the first line has numbers, the last comment before it with as many names.
fn header<'a>(comment: Option<Line<'a>>, first: Option<Line<'a>>) -> Result<Header<'a>, Mistake> {
    let Some(first) = first else {
        return match comment {
            Some(comment) => Ok(Header::of(comment)),
            None => Err(Mistake::new("the file is empty")),
        };
    };
    if let Some(comment) = comment.map(Header::of) {
        let has_numbers = fields(first.1, comment.separator).any(is_number);
        let found = fields(first.1, comment.separator).count();
        if has_numbers && comment.fits(found) && !comment.names().any(is_number) {
            return Ok(comment);
        }
    }
    let header = Header::of(first);
    if header.names().all(is_number) {
        let what = "expected names of columns, as in `X,u`, and found numbers; add a header, or give \
                    `--columns X,u,..` (in a campaign, `columns`)";
        return Err(Mistake::at(header.line, what));
    }
    Ok(header)
}

/// The columns that are read.
struct Columns {
    count: usize,
    /// Whether the user gave the names.
    is_given: bool,
    /// Whether a separator ends each line.
    has_end: bool,
    /// The number of the next point, if the first column counts them and has no name.
    index: Option<u64>,
    all: Vec<Column>,
    unread: Vec<String>,
    units: Vec<(String, String)>,
    /// The first lines with a decimal point and with a decimal comma.
    points: Option<usize>,
    commas: Option<usize>,
}

impl Columns {
    /// Adds a line.
    fn push(&mut self, line: usize, text: &str, separator: Separator) -> Result<(), Mistake> {
        let mut columns = self.all.iter_mut().peekable();
        let (mut found, mut wrong, mut last) = (0, None, "");
        for text in fields(text, separator) {
            if let Some(index) = self.index.as_mut().filter(|_| found == 0) {
                if text.parse() != Ok(*index) {
                    let what = format!(
                        "the first column has no name, and `{text}` where it would count the point {index}: expected a name \
                         for each column"
                    );
                    return Err(Mistake::at(line, what));
                }
                *index += 1;
            }
            if let Some(column) = columns.next_if(|it| it.at == found) {
                let with_point = with_point(text).filter(|it| number(it).is_some());
                match &with_point {
                    Some(_) => self.commas = self.commas.or(Some(line)),
                    None if text.contains('.') && number(text).is_some() => {
                        self.points = self.points.or(Some(line))
                    }
                    None => {}
                }
                wrong = wrong.or(column.see(line, with_point.as_deref().unwrap_or(text)).err());
            }
            (found, last) = (found + 1, text);
        }
        if self.has_end && found == self.count + 1 && last.is_empty() {
            found -= 1;
        }
        if found != self.count {
            let count = self.count;
            let what = match self.is_given {
                true => format!(
                    "{found} columns, and {count} names in `--columns`: expected a name for each column, also for those that \
                     hold no quantity"
                ),
                false => format!(
                    "{found} columns, and {count} names in the header; separate columns by one comma, tab or semicolon, or \
                     by blanks"
                ),
            };
            return Err(Mistake::at(line, what));
        }
        if let (Some(point), Some(comma)) = (self.points, self.commas) {
            let what = format!(
                "numbers have a decimal point in line {point} and a comma in line {comma}: expected one of the two"
            );
            return Err(Mistake::at(point.max(comma), what));
        }
        wrong.map_or(Ok(()), Err)
    }

    fn table(self, lines: Vec<usize>) -> TableColumns {
        let Columns { all, mut unread, units, .. } = self;
        let (read, rest): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|it| it.is_stored() && it.word.is_none());
        unread.extend(rest.into_iter().map(|it| it.name));
        let array = |Column { name, values, style, .. }| {
            let style: Style = style;
            Array { name, components: 1, values, stored: style.stored(), ..Array::default() }
        };
        let mut columns: Vec<Array> = read.into_iter().map(array).collect();
        let single = vec![false; columns.len()];
        finish(&mut columns.iter_mut().collect::<Vec<_>>(), &single);
        TableColumns { columns, lines, unread, units }
    }
}

/// A column that is read.
struct Column {
    /// The position among all columns.
    at: usize,
    name: String,
    need: Need,
    values: Vec<f64>,
    style: Style,
    has_numbers: bool,
    /// The first word in it, and its line.
    word: Option<(usize, String)>,
}

impl Column {
    fn new(at: usize, name: &str, need: Need) -> Self {
        let (values, style) = (Vec::new(), Style::default());
        Column { at, name: name.into(), need, values, style, has_numbers: false, word: None }
    }

    fn is_stored(&self) -> bool {
        self.need != Need::Sound
    }

    /// Reads one more field.
    ///
    /// # Errors
    /// A word where numbers must be, or where other rows have numbers.
    fn see(&mut self, line: usize, text: &str) -> Result<(), Mistake> {
        match number(text) {
            Some(value) => {
                self.has_numbers = true;
                if self.is_stored() && self.word.is_none() {
                    self.style.see(text);
                    self.values.push(value);
                }
            }
            None if self.word.is_none() => self.word = Some((line, text.to_owned())),
            None => {}
        }
        match &self.word {
            Some((line, word)) if self.has_numbers || self.need == Need::Must => {
                Err(self.expected_number(*line, word))
            }
            _ => Ok(()),
        }
    }

    fn expected_number(&self, line: usize, word: &str) -> Mistake {
        let found = if word.is_empty() { "nothing".into() } else { format!("`{word}`") };
        let what = format!("column `{}`: expected a number, found {found}", self.name);
        Mistake::at(line, what)
    }
}

/// Splits a table into the snapshots of its times.
fn by_time(mut table: TableColumns) -> Result<Vec<Snapshot>, Mistake> {
    let Some(column) = table.columns.iter().position(|column| is_time(&column.name)) else {
        let TableColumns { columns: of_points, lines, unread, units } = table;
        return Ok(vec![Snapshot { of_points, lines, unread, units, ..Snapshot::default() }]);
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
    validate_whole(&groups, &table.lines)?;
    Ok(groups.into_iter().map(|rows| at_time(&table, &times, rows)).collect())
}

/// Refuses a table whose last time has fewer rows than every other one: it was cut off.
fn validate_whole(groups: &[&[usize]], lines: &[usize]) -> Result<(), Mistake> {
    let last = groups.iter().position(|rows| rows.last() == Some(&(lines.len() - 1)));
    let others = |last: usize| {
        groups.iter().enumerate().filter(move |(at, _)| *at != last).map(|(_, rows)| rows.len())
    };
    let Some((last, each)) = last.and_then(|last| Some((last, others(last).next()?))) else {
        return Ok(());
    };
    let found = groups[last].len();
    if found >= each || others(last).any(|other| other != each) {
        return Ok(());
    }
    let what = format!(
        "the table ends after {found} points of a time, and every other time has {each}: was it cut off? write it again"
    );
    Err(Mistake::at(lines[lines.len() - 1], what))
}

fn at_time(table: &TableColumns, times: &Array, rows: &[usize]) -> Snapshot {
    let value = times.values[rows[0]];
    let part = |column: &Array| Array {
        values: rows.iter().map(|&row| column.values[row]).collect(),
        ..column.clone_without_values()
    };
    Snapshot {
        time: Some(Time { value, rounding: times.stored.rounding(value) }),
        of_points: table.columns.iter().map(part).collect(),
        lines: rows.iter().map(|&row| table.lines[row]).collect(),
        unread: table.unread.clone(),
        units: table.units.clone(),
        ..Snapshot::default()
    }
}
