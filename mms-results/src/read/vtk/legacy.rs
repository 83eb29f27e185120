//! Legacy VTK: "VTK File Formats" (Kitware), of versions 2 to 5.

use super::super::numbers::NumberType;
use super::super::table::is_time;
use super::super::text::finish;
use super::arrays::is_before;
use super::cursor::{Cursor, decoded};
use super::structured::{Extent, Lattice, numbers};
use crate::snapshot::Section;
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot, Time};

/// The parts of the file read so far.
#[derive(Default)]
struct LegacyReader {
    snapshot: Snapshot,
    single: Vec<bool>,
    /// The section of the arrays that follow.
    of: Option<Of>,
    /// Whether the last array read belongs to points, cells or the whole, if one was read.
    last: Option<Of>,
    /// The extent of a structured grid.
    extent: Option<Extent>,
    lattice: Lattice,
    /// Coordinates along each axis, and whether they are in single precision.
    axes: Vec<Array>,
    single_axes: Vec<bool>,
}

/// The items that the numbers of an array belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Of {
    Whole,
    Points,
    Cells,
}

/// Reads a file of one grid.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Snapshot, Mistake> {
    let mut cursor = Cursor { bytes, at: 0, is_binary: false, wanted };
    let first = String::from_utf8_lossy(cursor.line());
    let version = first.rsplit(' ').find(|it| it.contains('.')).unwrap_or("");
    cursor.line();
    cursor.is_binary = match cursor.line().trim_ascii() {
        b"ASCII" => false,
        b"BINARY" => true,
        _ => return Err(cursor.mistake("expected ASCII or BINARY")),
    };
    let mut found = LegacyReader::default();
    while let Some(word) = cursor.word() {
        let part = found.part(&word.to_ascii_uppercase(), &mut cursor);
        part.map_err(|mistake| cursor.mistake(mistake.what))?;
    }
    let rows = found.snapshot.points.as_ref().map_or(0, Array::rows);
    found.snapshot.cells.validate(rows)?;
    if is_before(version, [5, 1]) {
        found.snapshot.cells.renumber_old();
    }
    found.finish();
    found.extend(wanted)?;
    Ok(found.snapshot.with_vertices_as_points())
}

impl LegacyReader {
    /// Reads the part that begins with this word.
    fn part(&mut self, word: &str, cursor: &mut Cursor<'_>) -> Result<(), Mistake> {
        match word {
            "DATASET" => match cursor.needed("a kind of grid")?.to_ascii_uppercase().as_str() {
                "UNSTRUCTURED_GRID" | "POLYDATA" | "STRUCTURED_GRID" | "STRUCTURED_POINTS"
                | "RECTILINEAR_GRID" => Ok(()),
                other => Err(Mistake::new(format!(
                    "`{other}` is not read: expected UNSTRUCTURED_GRID, POLYDATA, STRUCTURED_GRID, STRUCTURED_POINTS or \
                     RECTILINEAR_GRID"
                ))),
            },
            "DIMENSIONS" => {
                let counts = [cursor.integer()?, cursor.integer()?, cursor.integer()?];
                self.extent = Some(Extent::default().of(counts)?);
                Ok(())
            }
            "EXTENT" => {
                self.extent = Some(Extent::parse(&cursor.words::<6>()?.join(" "))?);
                Ok(())
            }
            "ORIGIN" => {
                self.lattice.origin = numbers(&cursor.words::<3>()?.join(" "))?;
                Ok(())
            }
            // This was the name in early versions.
            "SPACING" | "ASPECT_RATIO" => {
                self.lattice.spacing = numbers(&cursor.words::<3>()?.join(" "))?;
                Ok(())
            }
            "X_COORDINATES" | "Y_COORDINATES" | "Z_COORDINATES" => {
                let (rows, kind) = (cursor.integer()?, cursor.kind()?);
                self.axes.push(cursor.array(word, rows, 1, kind)?);
                self.single_axes.push(kind == NumberType::Float(4));
                Ok(())
            }
            "POINTS" => {
                let (rows, kind) = (cursor.integer()?, cursor.kind()?);
                self.snapshot.points = Some(cursor.array("Points", rows, 3, kind)?);
                self.single.insert(0, kind == NumberType::Float(4));
                Ok(())
            }
            "CELLS" => {
                let (ends, points) = cursor.lists()?;
                (self.snapshot.cells.ends, self.snapshot.cells.points) = (ends, points);
                Ok(())
            }
            "CELL_TYPES" => {
                let count = cursor.integer()?;
                let types = cursor.positions(count, NumberType::Signed(4))?.into_iter();
                let kind = |kind| u8::try_from(kind).map_err(|_| Mistake::new("no type of cells"));
                self.snapshot.cells.types = types.map(kind).collect::<Result<_, _>>()?;
                Ok(())
            }
            "VERTICES" => self.section(Section::Verts, cursor),
            "LINES" => self.section(Section::Lines, cursor),
            "POLYGONS" => self.section(Section::Polys, cursor),
            "TRIANGLE_STRIPS" => self.section(Section::Strips, cursor),
            "POINT_DATA" => self.begin(Of::Points, cursor),
            "CELL_DATA" => self.begin(Of::Cells, cursor),
            "METADATA" => {
                self.metadata(cursor);
                Ok(())
            }
            _ => self.attribute(word, cursor),
        }
    }

    /// Reads the names of the components of the last array, and skips its other metadata up to an empty line.
    fn metadata(&mut self, cursor: &mut Cursor<'_>) {
        // The word itself has a line of its own.
        while !cursor.line().trim_ascii().is_empty() {}
        let (mut names, mut are_names) = (Vec::new(), false);
        while !cursor.rest().is_empty() {
            match cursor.line().trim_ascii() {
                b"" => break,
                b"COMPONENT_NAMES" => are_names = true,
                line if line.starts_with(b"INFORMATION") => are_names = false,
                line if are_names => names.push(decoded(&String::from_utf8_lossy(line))),
                _ => {}
            }
        }
        let last = match self.last.take() {
            Some(Of::Points) => self.snapshot.of_points.last_mut(),
            Some(Of::Cells) => self.snapshot.of_cells.last_mut(),
            _ => None,
        };
        if let Some(array) = last {
            names.truncate(array.components);
            array.component_names = names;
        }
    }

    fn section(&mut self, section: Section, cursor: &mut Cursor<'_>) -> Result<(), Mistake> {
        let (ends, points) = cursor.lists()?;
        self.snapshot.cells.add(section, &ends, points);
        Ok(())
    }

    fn begin(&mut self, of: Of, cursor: &mut Cursor<'_>) -> Result<(), Mistake> {
        let (rows, expected) = (cursor.integer()?, self.rows(of));
        self.of = Some(of);
        match rows == expected {
            true => Ok(()),
            false => Err(Mistake::new(format!(
                "numbers of {rows} points or cells, and there are {expected}"
            ))),
        }
    }

    fn rows(&self, of: Of) -> usize {
        match of {
            Of::Whole => 0,
            Of::Points => match &self.extent {
                Some(extent) => extent.points(),
                None => self.snapshot.points.as_ref().map_or(0, Array::rows),
            },
            Of::Cells => match &self.extent {
                Some(extent) => extent.cells(),
                None => self.snapshot.cells.ends.len(),
            },
        }
    }

    /// Reads arrays of points or cells.
    fn attribute(&mut self, word: &str, cursor: &mut Cursor<'_>) -> Result<(), Mistake> {
        let name = decoded(cursor.needed("a name")?);
        self.last = None;
        let components = match word {
            "FIELD" => return self.fields(cursor),
            "COLOR_SCALARS" => {
                let (of, components) = (self.of.unwrap_or(Of::Whole), cursor.integer()?);
                return cursor.pass(self.rows(of), components, NumberType::Unsigned(1));
            }
            "GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS" => 1,
            "LOOKUP_TABLE" => {
                let rows = cursor.integer()?;
                let kind =
                    if cursor.is_binary { NumberType::Unsigned(1) } else { NumberType::Float(4) };
                return cursor.pass(rows, 4, kind);
            }
            "SCALARS" => 1,
            "VECTORS" | "NORMALS" => 3,
            "TENSORS" => 9,
            "TENSORS6" => 6,
            "TEXTURE_COORDINATES" => cursor.integer()?,
            _ => return Err(Mistake::new(format!("`{word}` is not known"))),
        };
        let kind = cursor.kind()?;
        let components = if word == "SCALARS" { self.scalars(cursor)? } else { components };
        let of = self
            .of
            .ok_or_else(|| Mistake::new("expected POINT_DATA or CELL_DATA before numbers"))?;
        if !cursor.wanted.reads(&name) {
            cursor.pass(self.rows(of), components, kind)?;
            self.snapshot.unread.push(name);
            return Ok(());
        }
        let array = cursor.array(&name, self.rows(of), components, kind)?;
        self.add(of, array, kind);
        Ok(())
    }

    /// The number of components of scalars; skips the name of their colour table.
    fn scalars(&self, cursor: &mut Cursor<'_>) -> Result<usize, Mistake> {
        let before = cursor.at;
        let line = cursor.line();
        let components = std::str::from_utf8(line).unwrap_or("").trim().parse();
        let after = cursor.at;
        if cursor.word() == Some("LOOKUP_TABLE") {
            cursor.needed("a name")?;
            return Ok(components.unwrap_or(1));
        }
        // An array begins after the end of the line before it.
        cursor.at = if cursor.is_binary { before.max(after - 1) } else { after };
        Ok(components.unwrap_or(1))
    }

    fn fields(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Mistake> {
        let of = self.of.unwrap_or(Of::Whole);
        for _ in 0..cursor.integer()? {
            let mut name = cursor.needed("a name")?;
            if name == "METADATA" {
                self.part(name, cursor)?;
                name = cursor.needed("a name")?;
            }
            let name = &decoded(name);
            self.last = None;
            let (components, rows) = (cursor.integer()?, cursor.integer()?);
            let is_words = cursor.passes_words(components.saturating_mul(rows))?;
            if is_words && of != Of::Whole && cursor.wanted.need(name) == Need::Must {
                return Err(Mistake::new(format!("`{name}`: expected numbers, found words")));
            }
            let is_needed = if of == Of::Whole { is_time(name) } else { cursor.wanted.reads(name) };
            if is_words || !is_needed {
                if !is_words {
                    let kind = cursor.kind()?;
                    cursor.pass(rows, components, kind)?;
                }
                if of != Of::Whole {
                    self.snapshot.unread.push(name.to_owned());
                }
                continue;
            }
            let kind = cursor.kind()?;
            let array = cursor.array(name, rows, components, kind)?;
            if of != Of::Whole && array.rows() != self.rows(of) {
                return Err(Mistake::new(format!(
                    "`{name}` has {rows} rows, and expected {}",
                    self.rows(of)
                )));
            }
            self.add(of, array, kind);
        }
        Ok(())
    }

    fn add(&mut self, of: Of, array: Array, kind: NumberType) {
        self.last = Some(of);
        match of {
            Of::Whole => self.time(&array),
            Of::Points => {
                let before = self.snapshot.of_cells.len();
                self.single.insert(self.single.len() - before, kind == NumberType::Float(4));
                self.snapshot.of_points.push(array);
            }
            Of::Cells => {
                self.single.push(kind == NumberType::Float(4));
                self.snapshot.of_cells.push(array);
            }
        }
    }

    fn time(&mut self, array: &Array) {
        if let ([value], true) = (array.values.as_slice(), is_time(&array.name)) {
            self.snapshot.time = Some(Time { value: *value, rounding: array.rounding() });
        }
    }

    /// Makes the points and the cells of a structured grid. Without arrays nothing confirms that it is as large as its extent.
    fn extend(&mut self, wanted: &Wanted<'_>) -> Result<(), Mistake> {
        let Some(extent) = self.extent else { return Ok(()) };
        let Snapshot { points, of_points, of_cells, cells, .. } = &mut self.snapshot;
        if points.is_none() && of_points.is_empty() && of_cells.is_empty() {
            return Ok(());
        }
        let axes = std::mem::take(&mut self.axes);
        let places = match (points.take(), <[Array; 3]>::try_from(axes)) {
            (Some(points), _) if points.rows() == extent.points() => points,
            (Some(points), _) => {
                return Err(Mistake::new(format!(
                    "{} points, and expected {} by the dimensions of the grid",
                    points.rows(),
                    extent.points()
                )));
            }
            (None, Ok(axes)) => extent.along(&axes, wanted)?,
            (None, Err(axes)) if axes.is_empty() => self.lattice.places(&extent, wanted)?,
            _ => return Err(Mistake::new("expected coordinates along each of three axes")),
        };
        *points = Some(places);
        *cells = extent.mesh(wanted)?;
        Ok(())
    }

    fn finish(&mut self) {
        let Snapshot { points, of_points, of_cells, .. } = &mut self.snapshot;
        let all = points.iter_mut().chain(of_points).chain(of_cells).chain(&mut self.axes);
        finish(&mut all.collect::<Vec<_>>(), &[&*self.single, &self.single_axes].concat());
    }
}
