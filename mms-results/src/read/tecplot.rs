//! ASCII files of Tecplot: zones of points, ordered or with cells ("Data Format Guide", Tecplot Inc.).

use super::text::{Numbers, Style, finish, number, without_unit};
use crate::wanted::{Need, Wanted};
use crate::{Cells, Mistake, Snapshot, Time};

/// The words with which a file may begin.
const BEGINNINGS: [&str; 4] = ["TITLE", "VARIABLES", "FILETYPE", "ZONE"];

/// Kinds of cells: the names in zones, the number in VTK, and the number of points.
const CELLS: [(&str, u8, usize); 5] = [
    ("LINESEG", 3, 2),
    ("TRIANGLE", 5, 3),
    ("QUADRILATERAL", 9, 4),
    ("TETRAHEDRON", 10, 4),
    ("BRICK", 12, 8),
];

/// The most points or cells of a zone: no text file has more.
const MOST: usize = 1 << if usize::BITS > 40 { 40 } else { 26 };

/// Whether a text begins like a file of Tecplot: a table may have a column called `zone`.
pub fn is_tecplot(text: &[u8]) -> bool {
    let line = text.split(|it| *it == b'\n').next().unwrap_or_default();
    let word = line.iter().take_while(|it| it.is_ascii_alphabetic()).map(u8::to_ascii_uppercase);
    let word: Vec<u8> = word.take(16).collect();
    BEGINNINGS.iter().any(|it| it.as_bytes() == word) && line.contains(&b'=')
}

/// Reads all zones; zones of one time are pieces of one mesh.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + memchr::memchr_iter(b'\n', &bytes[..error.valid_up_to()]).count();
        Mistake::at(line, "expected text; a binary file of Tecplot is not read: write ASCII")
    })?;
    let mut words = Words { lines: text.lines().enumerate(), line: 0, rest: "" };
    let mut names = Vec::new();
    let mut found: Vec<Snapshot> = Vec::new();
    while let Some(word) = words.next() {
        match word.to_ascii_uppercase().as_str() {
            "TITLE" | "FILETYPE" => drop((words.expect("=")?, words.value()?)),
            "VARIABLES" => {
                words.expect("=")?;
                names = words.names();
            }
            "ZONE" => {
                let zone = Zone::read(&mut words)?;
                let snapshot = zone.values(&names, &mut words, wanted)?;
                let moment = |it: &Snapshot| it.time.map(|time| time.value);
                match found.last_mut().filter(|last| moment(last) == moment(&snapshot)) {
                    Some(last) => *last = Snapshot::join(vec![std::mem::take(last), snapshot])?,
                    None => found.push(snapshot),
                }
            }
            _ => {
                let what = format!("expected TITLE, VARIABLES or ZONE, found `{word}`");
                return Err(words.mistake(what));
            }
        }
    }
    if found.is_empty() { Err(Mistake::new("a file of Tecplot without a ZONE")) } else { Ok(found) }
}

/// The words of a text: names in quotes, parts in parentheses, `=`, and texts between blanks and commas.
struct Words<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    line: usize,
    rest: &'a str,
}

impl<'a> Words<'a> {
    fn mistake(&self, what: impl Into<String>) -> Mistake {
        Mistake::at(self.line, what)
    }

    /// Skips to the next word; false at the end.
    fn is_there(&mut self) -> bool {
        loop {
            self.rest = self.rest.trim_start_matches(|it: char| it.is_whitespace() || it == ',');
            if !self.rest.is_empty() && !self.rest.starts_with('#') {
                return true;
            }
            let Some((at, line)) = self.lines.next() else { return false };
            (self.line, self.rest) = (at + 1, line);
        }
    }

    fn next(&mut self) -> Option<&'a str> {
        if !self.is_there() {
            return None;
        }
        let text = self.rest;
        let end = match text.as_bytes()[0] {
            b'"' => text[1..].find('"').map_or(text.len(), |end| end + 2),
            b'(' => text.find(')').map_or(text.len(), |end| end + 1),
            b'=' => 1,
            _ => {
                let breaks = |it: char| it.is_whitespace() || ",=\"(#".contains(it);
                text.find(breaks).unwrap_or(text.len())
            }
        };
        let (word, rest) = text.split_at(end);
        self.rest = rest;
        Some(word)
    }

    /// The next word, without consuming it.
    fn peek(&mut self) -> Option<&'a str> {
        if !self.is_there() {
            return None;
        }
        let rest = self.rest;
        let word = self.next();
        self.rest = rest;
        word
    }

    fn expect(&mut self, word: &str) -> Result<(), Mistake> {
        match self.next() {
            Some(found) if found == word => Ok(()),
            found => {
                Err(self
                    .mistake(format!("expected `{word}`, found `{}`", found.unwrap_or("the end"))))
            }
        }
    }

    fn value(&mut self) -> Result<&'a str, Mistake> {
        self.next().ok_or_else(|| self.mistake("the file ends here: was it cut off?"))
    }

    /// Reads names in quotes, or names between blanks on one line.
    fn names(&mut self) -> Vec<String> {
        let mut names = Vec::new();
        let first = self.peek().map_or(0, |_| self.line);
        while let Some(word) = self.peek() {
            let is_quoted = word.starts_with('"');
            if !is_quoted
                && (self.line != first || BEGINNINGS.contains(&word.to_ascii_uppercase().as_str()))
            {
                break;
            }
            names.push(word.trim_matches('"').trim().to_owned());
            self.next();
        }
        names
    }

    fn number(&mut self) -> Result<&'a str, Mistake> {
        let word = self.value()?;
        match number(word) {
            Some(_) => Ok(word),
            None => Err(self.mistake(format!("expected a number, found `{word}`"))),
        }
    }
}

/// The head of a zone.
#[derive(Default)]
struct Zone {
    line: usize,
    /// Points along the axes; 0 if not stated.
    size: [usize; 3],
    points: usize,
    cells: usize,
    kind: Option<(u8, usize)>,
    is_block: bool,
    time: Option<Time>,
}

impl Zone {
    fn read(words: &mut Words<'_>) -> Result<Self, Mistake> {
        let mut zone = Zone { line: words.line, ..Zone::default() };
        // A key is a word that is no number; values begin with the first number.
        while let Some(key) = words.peek().filter(|it| number(it).is_none()) {
            let key = key.to_ascii_uppercase();
            words.next();
            words.expect("=")?;
            let value = words.value()?;
            let upper = value.trim_matches('"').to_ascii_uppercase();
            let count = || match upper.parse::<usize>() {
                Ok(count) if count <= MOST => Ok(count),
                _ => {
                    Err(words.mistake(format!("`{key}`: expected a whole number, found `{value}`")))
                }
            };
            match key.as_str() {
                "I" | "IMAX" => zone.size[0] = count()?,
                "J" | "JMAX" => zone.size[1] = count()?,
                "K" | "KMAX" => zone.size[2] = count()?,
                "N" | "NODES" => zone.points = count()?,
                "E" | "ELEMENTS" => zone.cells = count()?,
                "DATAPACKING" => zone.is_block = upper == "BLOCK",
                "F" => zone.is_block = matches!(upper.as_str(), "BLOCK" | "FEBLOCK"),
                "ZONETYPE" | "ET" => {
                    let name = upper.trim_start_matches("FE");
                    let known = CELLS.iter().find(|(it, ..)| *it == name);
                    zone.kind = known.map(|(_, kind, corners)| (*kind, *corners));
                    if zone.kind.is_none() && name != "ORDERED" {
                        let what = format!(
                            "zones of type `{value}` are not read; write one of ORDERED, FETRIANGLE, FEQUADRILATERAL, FETETRAHEDRON, FEBRICK"
                        );
                        return Err(words.mistake(what));
                    }
                }
                "SOLUTIONTIME" => {
                    let found = number(value).filter(|it| it.is_finite());
                    let value = found.ok_or_else(|| {
                        words.mistake(format!("`SOLUTIONTIME`: expected a number, found `{value}`"))
                    })?;
                    let mut style = Style::default();
                    style.see(&upper);
                    zone.time = Some(Time { value, rounding: style.stored().rounding(value) });
                }
                "VARLOCATION" if upper.contains("CELLCENTERED") => {
                    let what = "values at the middles of cells are not read from Tecplot; write them at points, or VTK";
                    return Err(words.mistake(what));
                }
                "PASSIVEVARLIST" | "VARSHARELIST" | "CONNECTIVITYSHAREZONE" => {
                    let what = format!("`{key}` is not read; write all values of each zone");
                    return Err(words.mistake(what));
                }
                _ => {}
            }
        }
        if zone.kind.is_none() {
            let along = zone.size.iter().map(|it| (*it).max(1));
            zone.points = along.fold(1, |all: usize, it| all.saturating_mul(it));
        }
        if zone.points == 0 || zone.kind.is_none() && zone.size == [0; 3] {
            return Err(Mistake::at(
                zone.line,
                "a zone that does not say how many points it has, as I=.. or N=..",
            ));
        }
        Ok(zone)
    }

    fn values(
        &self,
        names: &[String],
        words: &mut Words<'_>,
        wanted: &Wanted<'_>,
    ) -> Result<Snapshot, Mistake> {
        if names.is_empty() {
            return Err(Mistake::at(self.line, "a zone without VARIABLES before it"));
        }
        let mut snapshot = Snapshot { time: self.time, ..Snapshot::default() };
        let mut columns: Vec<Option<Numbers>> = Vec::new();
        let named: Vec<_> = names.iter().map(|name| without_unit(name)).collect();
        let names: Vec<String> = named.iter().map(|(name, _)| (*name).to_owned()).collect();
        let units =
            named.iter().filter_map(|(name, unit)| Some(((*name).to_owned(), (*unit)?.to_owned())));
        snapshot.units = units.collect();
        for (at, name) in names.iter().enumerate() {
            if names[..at].contains(name) {
                return Err(Mistake::at(self.line, format!("two variables are called `{name}`")));
            }
            let is_read = !matches!(wanted.need(name), Need::No | Need::Sound);
            columns.push(is_read.then(Default::default));
            if !is_read {
                snapshot.unread.push(name.clone());
            }
        }
        let mut see = |words: &mut Words<'_>, variable: usize| -> Result<(), Mistake> {
            let text = words.number()?;
            if let Some(column) = &mut columns[variable] {
                column.push(text, wanted)?;
            }
            Ok(())
        };
        let all = (0..self.points).flat_map(|point| (0..names.len()).map(move |it| (point, it)));
        if self.is_block {
            for variable in 0..names.len() {
                for _ in 0..self.points {
                    see(words, variable)?;
                }
            }
        } else {
            for (_, variable) in all {
                see(words, variable)?;
                if variable == 0 {
                    snapshot.lines.push(words.line);
                }
            }
        }
        for (name, column) in names.iter().zip(columns) {
            snapshot.of_points.extend(column.map(|it| it.into_array(name, 1)));
        }
        let single = vec![false; snapshot.of_points.len()];
        finish(&mut snapshot.of_points.iter_mut().collect::<Vec<_>>(), &single);
        snapshot.cells = match self.kind {
            Some(kind) => self.listed(kind, words)?,
            None => ordered(self.size),
        };
        Ok(snapshot)
    }

    /// Reads the cells after the values, by numbers of points from 1.
    fn listed(
        &self,
        (kind, corners): (u8, usize),
        words: &mut Words<'_>,
    ) -> Result<Cells, Mistake> {
        let mut cells = Cells::default();
        for _ in 0..self.cells {
            for _ in 0..corners {
                let word = words.value()?;
                match word.parse::<usize>() {
                    Ok(point) if (1..=self.points).contains(&point) => cells.points.push(point - 1),
                    _ => {
                        let what =
                            format!("expected a point from 1 to {}, found `{word}`", self.points);
                        return Err(words.mistake(what));
                    }
                }
            }
            cells.types.push(kind);
            cells.ends.push(cells.points.len());
        }
        Ok(cells)
    }
}

/// The cells between ordered points in two and three dimensions; none along a line, whose points may be particles.
pub fn ordered(size: [usize; 3]) -> Cells {
    let [i, j, k] = size.map(|it| it.max(1));
    let mut cells = Cells::default();
    if i < 2 || j < 2 {
        return cells;
    }
    for layer in 0..(k - 1).max(1) {
        for row in 0..j - 1 {
            for column in 0..i - 1 {
                let at = (layer * j + row) * i + column;
                let face = [at, at + 1, at + i + 1, at + i];
                cells.points.extend(face);
                if k > 1 {
                    cells.points.extend(face.map(|it| it + i * j));
                }
                cells.types.push(if k > 1 { 12 } else { 9 });
                cells.ends.push(cells.points.len());
            }
        }
    }
    cells
}
