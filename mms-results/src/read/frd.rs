//! Results of CalculiX in `.frd` files, in text and in binary ("CalculiX CrunchiX GraphiX User's Manual", section "Result
//! Format"). Their nodes have the positions before the deformation.

use super::series::tell_unread;
use super::tags::Tags;
use super::text::{Numbers, Style, finish, number};
use crate::wanted::{Need, Wanted};
use crate::{Array, Cells, Mistake, Snapshot, Stored, Time};

/// Whether a file begins with a record of this format.
pub fn is_frd(bytes: &[u8]) -> bool {
    matches!(bytes.get(..6), Some(b"    1C" | b"    1U" | b"    2C"))
}

/// Types of elements, from 1 on: the number in VTK, and its nodes by their positions in the file.
const ELEMENTS: [(u8, &[usize]); 12] = [
    (12, &[0, 1, 2, 3, 4, 5, 6, 7]),
    (13, &[0, 1, 2, 3, 4, 5]),
    (10, &[0, 1, 2, 3]),
    // The file lists the nodes of upright edges before those in the upper face.
    (25, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15]),
    (26, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11]),
    (24, &[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]),
    (5, &[0, 1, 2]),
    (22, &[0, 1, 2, 3, 4, 5]),
    (9, &[0, 1, 2, 3]),
    (23, &[0, 1, 2, 3, 4, 5, 6, 7]),
    (3, &[0, 1]),
    (21, &[0, 1, 2]),
];

/// The columns of a number.
const WIDTH: usize = 12;
/// The numbers on a line.
const ON_LINE: usize = 6;

/// The number of elements for which memory is reserved at a time.
const AT_ONCE: usize = 256;

/// The most components of a block.
const MOST: usize = 1000;

/// Reads the mesh and all blocks of results; blocks of one time make a snapshot.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let mut file = File { bytes, at: 0, line: 0, wanted, unread: Vec::new() };
    let (mut tags, mut mesh, mut found) = (None, Snapshot::default(), Vec::new());
    while let Some(line) = file.next() {
        let key = line.trim_ascii_start();
        if key.starts_with(b"2C") && tags.is_none() {
            let numbers;
            (numbers, mesh.points) = file.nodes(line)?;
            let twice = |tag| file.mistake(format!("the node {tag} is there twice"));
            tags = Some((numbers.len(), Tags::of(&numbers).map_err(twice)?));
        } else if key.starts_with(b"3C") && mesh.cells.is_empty() {
            mesh.cells = file.elements(line, tags.as_ref().map(|it| &it.1))?;
        } else if key.starts_with(b"100C") {
            let Some((count, tags)) = &tags else {
                return Err(file.mistake("results before the nodes of the mesh: was it cut off?"));
            };
            file.results(line, (*count, tags), &mesh, &mut found)?;
        } else if key.starts_with(b"9999") {
            break;
        } else if !key.is_empty() && !key.starts_with(b"1") {
            let found = String::from_utf8_lossy(&key[..key.len().min(20)]).into_owned();
            return Err(file.mistake(format!("expected a block 2C, 3C or 100C, found `{found}`")));
        }
    }
    if tags.is_none() {
        return Err(Mistake::new("a file of CalculiX without nodes (2C): was it cut off?"));
    }
    if found.is_empty() {
        found.push(mesh);
    }
    tell_unread(&mut found, file.unread);
    for snapshot in &mut found {
        let mut arrays: Vec<_> =
            snapshot.points.iter_mut().chain(&mut snapshot.of_points).collect();
        let single = vec![false; arrays.len()];
        finish(&mut arrays, &single);
    }
    Ok(found)
}

/// The text in columns of a line, without blanks around it.
fn field(line: &[u8], start: usize, width: usize) -> &str {
    let line = line.get(start..).unwrap_or_default();
    std::str::from_utf8(&line[..line.len().min(width)]).unwrap_or("?").trim()
}

/// The format of the records in a block, which the end of its first line states.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    /// Text, with node numbers of this width.
    Text(usize),
    /// Binary, with numbers of this many bytes.
    Binary(usize),
}

struct File<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    wanted: &'a Wanted<'a>,
    /// Names of arrays that were not read, with their times.
    unread: Vec<(f64, String)>,
}

impl<'a> File<'a> {
    fn mistake(&self, what: impl Into<String>) -> Mistake {
        Mistake::at(self.line, what)
    }

    fn cut(&self) -> Mistake {
        self.mistake("the file ends within a block: was it cut off? copy or write it again")
    }

    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|it| !it.is_empty())?;
        let end = memchr::memchr(b'\n', rest).unwrap_or(rest.len());
        (self.at, self.line) = (self.at + end + 1, self.line + 1);
        Some(rest[..end].strip_suffix(b"\r").unwrap_or(&rest[..end]))
    }

    /// The next line of a block.
    fn record(&mut self) -> Result<&'a [u8], Mistake> {
        self.next().ok_or_else(|| self.cut())
    }

    /// Reads `count` items of `each` bytes from a binary block.
    fn binary(&mut self, count: usize, each: usize) -> Result<&'a [u8], Mistake> {
        let length = count.checked_mul(each).ok_or_else(|| self.cut())?;
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let data = rest.get(..length).ok_or_else(|| self.cut())?;
        self.at += length;
        Ok(data)
    }

    /// The stated number of rows of a block, if there is one, and their format, which is written from column `from` on.
    fn head(&self, line: &[u8], from: usize) -> Result<(Option<usize>, Form), Mistake> {
        let count = field(line, 24, WIDTH);
        let count = match count {
            "" => None,
            _ => Some(count.parse().map_err(|_| {
                self.mistake(format!("expected how many rows the block has, found `{count}`"))
            })?),
        };
        let flag = field(line, from, usize::MAX).rsplit(' ').next().unwrap_or_default();
        let form = match flag {
            "1" => Form::Text(10),
            "2" => Form::Binary(4),
            "3" => Form::Binary(8),
            _ => Form::Text(5),
        };
        match (count, form) {
            (None, Form::Binary(_)) => Err(self.mistake("a block in binary without its length")),
            found => Ok(found),
        }
    }

    /// Refuses a block whose number of rows is not the stated one.
    fn validate_rows(&self, said: Option<usize>, rows: usize) -> Result<(), Mistake> {
        match said {
            Some(count) if count != rows => {
                Err(self.mistake(format!("{rows} rows in a block that says it has {count}")))
            }
            _ => Ok(()),
        }
    }

    /// Reads a whole number from text.
    fn whole(&self, line: &[u8], start: usize, width: usize) -> Result<u64, Mistake> {
        let text = field(line, start, width);
        text.parse().map_err(|_| self.mistake(format!("expected a whole number, found `{text}`")))
    }

    /// Reads the numbers of nodes, and `width` numbers for each.
    fn rows(&mut self, said: Option<usize>, form: Form, width: usize) -> Result<Rows, Mistake> {
        let (mut tags, mut numbers) = (Vec::new(), Numbers::default());
        let columns = match form {
            Form::Text(columns) => columns,
            Form::Binary(bytes) => {
                let count = said.unwrap_or(0);
                let data = self.binary(count, 4 + bytes * width)?;
                self.wanted.reserve("the file", count * (1 + width))?;
                numbers.values.reserve_exact(count * width);
                for row in data.chunks_exact(4 + bytes * width) {
                    tags.push(tag(row));
                    numbers.values.extend(row[4..].chunks_exact(bytes).map(real));
                }
                let stored = if bytes == 4 { Stored::Single } else { Stored::Double };
                return Ok(Rows { tags, numbers, binary: Some(stored) });
            }
        };
        loop {
            let mut line = self.record()?;
            match line.get(..3) {
                Some(b" -1") => tags.push(self.whole(line, 3, columns)?),
                Some(b" -3") => break,
                _ => return Err(self.mistake("expected a record -1 of a node, or -3")),
            }
            for at in 0..width {
                if at > 0 && at % ON_LINE == 0 {
                    line = self.record()?;
                    if !line.starts_with(b" -2") {
                        return Err(self.mistake("expected a record -2 with more numbers"));
                    }
                }
                let text = field(line, 3 + columns + WIDTH * (at % ON_LINE), WIDTH);
                if text.is_empty() && self.at >= self.bytes.len() {
                    return Err(self.cut());
                }
                numbers.push(text, self.wanted).map_err(|it| self.mistake(it.what))?;
            }
        }
        self.validate_rows(said, tags.len())?;
        Ok(Rows { tags, numbers, binary: None })
    }

    fn nodes(&mut self, line: &[u8]) -> Result<(Vec<u64>, Option<Array>), Mistake> {
        let (said, form) = self.head(line, 36)?;
        let Rows { tags, numbers, binary } = self.rows(said, form, 3)?;
        let points = numbers.into_array("reference_position", 3);
        Ok((tags, Some(Array { stored: binary.unwrap_or(points.stored), ..points })))
    }

    fn elements(&mut self, line: &[u8], tags: Option<&Tags>) -> Result<Cells, Mistake> {
        let (said, form) = self.head(line, 36)?;
        let mut cells = Cells::default();
        let mut nodes = Vec::new();
        for count in 0.. {
            let kind = match form {
                Form::Binary(_) if said == Some(count) => break,
                Form::Binary(_) => tag(&self.binary(4, 4)?[4..]),
                Form::Text(columns) => {
                    let line = self.record()?;
                    match line.get(..3) {
                        Some(b" -3") => {
                            self.validate_rows(said, count)?;
                            break;
                        }
                        Some(b" -1") => self.whole(line, 3 + columns, 5)?,
                        _ => return Err(self.mistake("expected a record -1 of an element, or -3")),
                    }
                }
            };
            let found = kind.checked_sub(1).and_then(|it| ELEMENTS.get(it as usize));
            let (kind, order) = found
                .ok_or_else(|| self.mistake(format!("elements of type {kind} are not known")))?;
            nodes.clear();
            match form {
                Form::Binary(_) => {
                    nodes.extend(self.binary(order.len(), 4)?.chunks_exact(4).map(tag));
                }
                Form::Text(columns) => {
                    while nodes.len() < order.len() {
                        let line = self.record()?.trim_ascii_end();
                        let on_line = line.len().saturating_sub(3).div_ceil(columns);
                        let more = on_line.min(order.len() - nodes.len());
                        if !line.starts_with(b" -2") || more == 0 {
                            return Err(self.mistake("expected a record -2 with nodes"));
                        }
                        for at in 0..more {
                            nodes.push(self.whole(line, 3 + columns * at, columns)?);
                        }
                    }
                }
            }
            if count % AT_ONCE == 0 {
                self.wanted.reserve("the elements", AT_ONCE * order.len())?;
            }
            for place in *order {
                let node = nodes[*place];
                let point = tags.and_then(|it| it.place(node));
                let expected =
                    || self.mistake(format!("an element has the node {node}, which is not there"));
                cells.points.push(point.ok_or_else(expected)?);
            }
            cells.types.push(*kind);
            cells.ends.push(cells.points.len());
        }
        Ok(cells)
    }

    /// Reads a block of results into the snapshot of its time.
    fn results(
        &mut self,
        line: &[u8],
        nodes: (usize, &Tags),
        mesh: &Snapshot,
        found: &mut Vec<Snapshot>,
    ) -> Result<(), Mistake> {
        let (said, form) = self.head(line, 63)?;
        let text = field(line, 12, WIDTH);
        let value = number(text).filter(|it| it.is_finite());
        let value =
            value.ok_or_else(|| self.mistake(format!("expected a time, found `{text}`")))?;
        let vibrates = match field(line, 56, 2) {
            "2" => Some("of a frequency, which are no displacements at a time"),
            "4" => Some("of buckling or of a kind that its user named"),
            _ => None,
        };
        let mut style = Style::default();
        style.see(text);
        let time = Time { value, rounding: style.stored().rounding(value) };
        let line = self.record()?;
        if !line.starts_with(b" -4") {
            return Err(self.mistake("expected a record -4 with the name of the results"));
        }
        let (name, entities) = (field(line, 5, 8), self.whole(line, 13, 5)?);
        if entities > MOST as u64 {
            return Err(self
                .mistake(format!("`{name}` has {entities} components; expected {MOST} at most")));
        }
        let columns = self.columns(name, entities)?;
        let need = |it: &String| self.wanted.need(it);
        let is_must = columns.iter().any(|it| need(it) == Need::Must);
        let mut names = columns.clone();
        names.dedup();
        if is_must && let Some(kind) = vibrates {
            let what =
                format!("`{name}` is {kind}: write results of a step in time, or of a static step");
            return Err(self.mistake(what));
        }
        let before = found.last().filter(|it| it.time == Some(time));
        let is_before = |names: &[String]| {
            before.is_some_and(|it| it.of_points.iter().any(|it| names.contains(&it.name)))
        };
        let real = name.strip_suffix('I').unwrap_or_default();
        if is_before(&[real.to_owned()]) {
            let what = format!(
                "`{name}` is the imaginary part of `{real}`: results of a vibration are not read"
            );
            return Err(self.mistake(what));
        }
        let unread = names.iter().filter(|it| vibrates.is_some() || !self.wanted.reads(it));
        self.unread.extend(unread.map(|it| (value, it.clone())));
        if !columns.iter().any(|it| self.wanted.reads(it)) || vibrates.is_some() {
            return match form {
                Form::Binary(bytes) => {
                    self.binary(said.unwrap_or(0), 4 + bytes * columns.len()).map(drop)
                }
                Form::Text(_) => loop {
                    if self.record()?.starts_with(b" -3") {
                        break Ok(());
                    }
                },
            };
        }
        let rows = self.rows(said, form, columns.len())?;
        let misfit = match is_before(&names) {
            true => Some("is there twice at one time".into()),
            false => rows.misfit(nodes),
        };
        if let Some(what) = misfit {
            if is_must {
                return Err(self.mistake(format!("`{name}` {what}")));
            }
            self.unread.extend(names.into_iter().map(|it| (value, it)));
            return Ok(());
        }
        if before.is_none() {
            let numbers = mesh.points.as_ref().map_or(0, |it| it.values.len());
            self.wanted.reserve("the mesh", numbers + mesh.cells.points.len())?;
            found.push(Snapshot { time: Some(time), ..mesh.clone() });
        }
        names.retain(|it| self.wanted.reads(it));
        let arrays = rows.arrays(&columns, &names, nodes.1);
        if let Some(snapshot) = found.last_mut() {
            snapshot.of_points.extend(arrays);
        }
        Ok(())
    }

    /// The name of the array of each column: a vector is one array, a tensor one array per entry.
    fn columns(&mut self, name: &str, entities: u64) -> Result<Vec<String>, Mistake> {
        let mut columns = Vec::new();
        for _ in 0..entities {
            let line = self.record()?;
            if !line.starts_with(b" -5") {
                return Err(
                    self.mistake(format!("expected a record -5 with a component of `{name}`"))
                );
            }
            // The file declares this component, the length of a vector, without storing it: viewers compute it.
            if field(line, 33, 5) == "1" {
                continue;
            }
            let axis = |text: &str| ["", "X", "Y", "Z"].get(text.parse::<usize>().ok()?).copied();
            columns.push(match field(line, 18, 5) {
                "2" | "12" => name.to_owned(),
                "4" => {
                    let axes = [23, 28].map(|at| axis(field(line, at, 5)).unwrap_or_default());
                    format!("{name}_{}", axes.concat())
                }
                _ if entities == 1 => name.to_owned(),
                _ => format!("{name}_{}", field(line, 5, 8)),
            });
        }
        match columns.is_empty() {
            true => Err(self.mistake(format!("`{name}` has no components"))),
            false => Ok(columns),
        }
    }
}

/// Reads an integer of four bytes: the number of a node, or a type.
fn tag(bytes: &[u8]) -> u64 {
    bytes.first_chunk().map_or(0, |it| u64::from(u32::from_le_bytes(*it)))
}

/// Reads a number of four or eight bytes.
fn real(bytes: &[u8]) -> f64 {
    match *bytes {
        [a, b, c, d] => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => bytes.first_chunk().map_or(0.0, |it| f64::from_le_bytes(*it)),
    }
}

/// Nodes by their numbers, and the numbers at each node.
struct Rows {
    tags: Vec<u64>,
    numbers: Numbers,
    /// The precision, if the block was binary.
    binary: Option<Stored>,
}

impl Rows {
    /// Explains why the rows do not belong to all nodes; `None` if they do.
    fn misfit(&self, (count, nodes): (usize, &Tags)) -> Option<String> {
        if let Some(tag) = self.tags.iter().find(|it| nodes.place(**it).is_none()) {
            return Some(format!("has the node {tag}, which is not there"));
        }
        let mut is_there = vec![false; count];
        self.tags.iter().filter_map(|it| nodes.place(*it)).for_each(|at| is_there[at] = true);
        let lacking = is_there.iter().filter(|it| !**it).count();
        if lacking > 0 {
            return Some(format!(
                "is not there for {lacking} of {count} nodes: write it without `NSET`, for all nodes"
            ));
        }
        (self.tags.len() > count).then(|| "has two rows for a node".into())
    }

    /// Makes arrays of these names, in the order of the nodes.
    fn arrays(self, columns: &[String], names: &[String], nodes: &Tags) -> Vec<Array> {
        let Rows { tags, numbers, binary } = self;
        let stored = binary.unwrap_or(numbers.style.stored());
        let array = |name: &String| {
            let own: Vec<usize> = (0..columns.len()).filter(|it| columns[*it] == *name).collect();
            let mut values = vec![0.0; tags.len() * own.len()];
            for (tag, row) in tags.iter().zip(numbers.values.chunks_exact(columns.len())) {
                if let Some(at) = nodes.place(*tag) {
                    let to = &mut values[at * own.len()..][..own.len()];
                    to.iter_mut().zip(&own).for_each(|(to, column)| *to = row[*column]);
                }
            }
            Array { name: name.clone(), components: own.len(), values, stored, ..Array::default() }
        };
        names.iter().map(array).collect()
    }
}
