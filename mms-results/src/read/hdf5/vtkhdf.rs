//! VTKHDF: "VTKHDF File Format" (Kitware, VTK documentation), versions 1 and 2.

use mms_hdf5::Set;

use super::super::tecplot::ordered;
use super::{File, MOST_TIMES};
use crate::snapshot::Section;
use crate::{Array, Cells, Mistake, Snapshot, Time};

/// The group that contains all data.
const ROOT: &str = "VTKHDF";

/// The groups of the sections of a surface.
const SECTIONS: [(Section, &str); 4] = [
    (Section::Verts, "Vertices"),
    (Section::Lines, "Lines"),
    (Section::Polys, "Polygons"),
    (Section::Strips, "Strips"),
];

/// Whether a file is in VTKHDF format.
pub fn is_vtk(file: &File<'_>) -> bool {
    file.word(ROOT, "Type").is_some()
}

/// Reads a file: one snapshot for each of its steps.
pub fn parse(file: &File<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let kind = file.word(ROOT, "Type").unwrap_or_default();
    let steps = Steps::of(file)?;
    match kind.as_str() {
        "UnstructuredGrid" => Grid::of(file, &steps, &[(None, ROOT.into())])?.snapshots(&steps),
        "PolyData" => {
            let group =
                |(section, name): (Section, &str)| (Some(section), format!("{ROOT}/{name}"));
            Grid::of(file, &steps, &SECTIONS.map(group))?.snapshots(&steps)
        }
        "ImageData" => image(file, &steps),
        other => Err(Mistake::new(format!(
            "`{other}` of VTKHDF is not read: expected UnstructuredGrid, PolyData or ImageData; ParaView turns it into one \
             with `Merge Blocks`"
        ))),
    }
}

/// The steps of a file; without times, a single state.
struct Steps<'a> {
    file: &'a File<'a>,
    times: Vec<Time>,
}

impl<'a> Steps<'a> {
    fn of(file: &'a File<'a>) -> Result<Self, Mistake> {
        let set = |path: &str| file.store.set(&format!("{ROOT}/{path}"));
        let own = set("FieldData/TimeValue").filter(|it| it.count() == Some(1));
        let set = set("Steps/Values").or(own);
        let times = set.map(|it| file.times(&it)).transpose()?.unwrap_or_default();
        Ok(Steps { file, times })
    }

    /// The number of states.
    fn count(&self) -> usize {
        self.times.len().max(1)
    }

    /// Numbers of each step; `None` if there are no steps, or no such array.
    fn offsets(&self, name: &str) -> Result<Option<Offsets>, Mistake> {
        let path = format!("{ROOT}/Steps/{name}");
        let set = if self.times.is_empty() { None } else { self.file.store.set(&path) };
        let Some(set) = set else { return Ok(None) };
        let columns = set.shape.get(1).copied().unwrap_or(1);
        let numbers = self.file.positions(&path)?;
        match columns > 0 && numbers.len() / columns >= self.times.len() {
            true => Ok(Some(Offsets { numbers, columns })),
            false => Err(Mistake::new(format!("`{path}` has no number for each of the steps"))),
        }
    }
}

/// The beginnings of steps: a row for each, with a column for each section of a surface.
struct Offsets {
    numbers: Vec<usize>,
    columns: usize,
}

/// The beginning of a step.
fn offset(offsets: &Option<Offsets>, step: usize, column: usize) -> usize {
    let Some(Offsets { numbers, columns }) = offsets else { return 0 };
    numbers[step * columns + column.min(columns - 1)]
}

/// The numbers of points or cells at all steps, and the beginning of each step along the first axis.
struct Data {
    array: Array,
    /// The numbers of one place along the first axis.
    stride: usize,
    offsets: Option<Offsets>,
}

/// The arrays of points or of cells, and the names of arrays that are not read.
fn data(
    steps: &Steps<'_>,
    group: &str,
    sets: &[Set],
    unread: &mut Vec<String>,
) -> Result<Vec<Data>, Mistake> {
    let (file, inside) = (steps.file, format!("{ROOT}/{group}/"));
    let mut all = Vec::new();
    for set in sets {
        let Some(name) = set.path.strip_prefix(&inside) else { continue };
        match file.wanted(set, name)? {
            None => unread.push(name.to_owned()),
            Some(array) => {
                let stride = set.stride();
                let offsets = steps.offsets(&format!("{group}Offsets/{name}"))?;
                all.push(Data { array, stride, offsets });
            }
        }
    }
    Ok(all)
}

/// A part of some numbers, which must exist.
fn part<T: Copy>(what: &str, all: &[T], start: usize, count: usize) -> Result<Vec<T>, Mistake> {
    let found = all.get(start..).and_then(|it| it.get(..count));
    let beyond = || {
        Mistake::new(format!(
            "`{what}` has {} numbers, and a step needs {count} from {start} on",
            all.len()
        ))
    };
    found.map(<[T]>::to_vec).ok_or_else(beyond)
}

/// A product of counts and places; a product that overflows is larger than any array.
fn times(a: usize, b: usize) -> usize {
    a.saturating_mul(b)
}

/// The cells of an unstructured grid, or of a section of a surface, in all pieces of all steps.
struct Connected {
    section: Option<Section>,
    /// The numbers of cells, and of points of cells, in each piece.
    counts: [Vec<usize>; 2],
    ends: Vec<usize>,
    points: Vec<usize>,
    types: Vec<usize>,
    cell_offsets: Option<Offsets>,
    point_offsets: Option<Offsets>,
}

/// A grid at all steps.
struct Grid<'a> {
    file: &'a File<'a>,
    /// The number of points in each piece.
    counts: Vec<usize>,
    points: Array,
    connected: Vec<Connected>,
    of_points: Vec<Data>,
    of_cells: Vec<Data>,
    unread: Vec<String>,
    first_parts: Option<Offsets>,
    parts: Option<Offsets>,
    point_offsets: Option<Offsets>,
}

impl<'a> Grid<'a> {
    fn of(
        file: &'a File<'a>,
        steps: &Steps<'_>,
        groups: &[(Option<Section>, String)],
    ) -> Result<Self, Mistake> {
        let mut connected = Vec::new();
        for (section, group) in groups {
            let positions = |name: &str| file.positions(&format!("{group}/{name}"));
            let types = if section.is_none() { positions("Types")? } else { Vec::new() };
            connected.push(Connected {
                section: *section,
                counts: [positions("NumberOfCells")?, positions("NumberOfConnectivityIds")?],
                ends: positions("Offsets")?,
                points: positions("Connectivity")?,
                types,
                cell_offsets: steps.offsets("CellOffsets")?,
                point_offsets: steps.offsets("ConnectivityIdOffsets")?,
            });
        }
        let (sets, mut unread) = (file.store.sets().map_err(Mistake::new)?, Vec::new());
        Ok(Grid {
            file,
            counts: file.positions(&format!("{ROOT}/NumberOfPoints"))?,
            points: Array { name: "Points".into(), ..file.at(&format!("{ROOT}/Points"))? },
            connected,
            of_points: data(steps, "PointData", &sets, &mut unread)?,
            of_cells: data(steps, "CellData", &sets, &mut unread)?,
            unread,
            first_parts: steps.offsets("PartOffsets")?,
            parts: steps.offsets("NumberOfParts")?,
            point_offsets: steps.offsets("PointOffsets")?,
        })
    }

    fn snapshots(&self, steps: &Steps<'_>) -> Result<Vec<Snapshot>, Mistake> {
        let mut all = Vec::new();
        for step in 0..steps.count() {
            let time = steps.times.get(step).copied();
            all.push(Snapshot { time, ..self.at(step)? });
        }
        Ok(all)
    }

    /// The pieces of a step, joined.
    fn at(&self, step: usize) -> Result<Snapshot, Mistake> {
        let start = |offsets: &Option<Offsets>, column| offset(offsets, step, column);
        let first = start(&self.first_parts, 0);
        let parts = match &self.parts {
            Some(_) => start(&self.parts, 0),
            // Without numbers of parts, a step has one piece if `PartOffsets` exists, otherwise all pieces.
            None if self.first_parts.is_some() => 1,
            None => self.counts.len(),
        };
        let counts = part("NumberOfPoints", &self.counts, first, parts)?;
        let mut point = start(&self.point_offsets, 0);
        let mut cells: Vec<[usize; 3]> = Vec::new();
        for (column, it) in self.connected.iter().enumerate() {
            let cell = start(&it.cell_offsets, column);
            cells.push([cell, cell.saturating_add(first), start(&it.point_offsets, column)]);
        }
        let begins = |all: &[Data]| -> Vec<usize> {
            all.iter().map(|it| times(start(&it.offsets, 0), it.stride)).collect()
        };
        let mut begins = [begins(&self.of_points), begins(&self.of_cells)];
        let mut pieces = Vec::new();
        for (at, rows) in counts.into_iter().enumerate() {
            let mut piece = Snapshot { unread: self.unread.clone(), ..Snapshot::default() };
            let size = self.points.components;
            let own = part("Points", &self.points.values, times(point, size), times(rows, size))?;
            piece.points = Some(Array { values: own, ..self.points.clone_without_values() });
            point = point.saturating_add(rows);
            for (it, begin) in self.connected.iter().zip(&mut cells) {
                it.add(first.saturating_add(at), begin, &mut piece.cells)?;
            }
            piece.cells.validate(rows)?;
            let count = piece.cells.len();
            piece.of_points = cut(&self.of_points, &mut begins[0], rows)?;
            piece.of_cells = cut(&self.of_cells, &mut begins[1], count)?;
            let arrays = piece.points.iter().chain(&piece.of_points).chain(&piece.of_cells);
            let numbers: usize = arrays.map(|it| it.values.len()).sum();
            self.file.wanted.reserve("a step", numbers + piece.cells.points.len() + 2 * count)?;
            pieces.push(piece);
        }
        Snapshot::join(pieces)
    }
}

/// The rows of a piece, of each array.
fn cut(all: &[Data], begins: &mut [usize], rows: usize) -> Result<Vec<Array>, Mistake> {
    let mut found = Vec::new();
    for (data, begin) in all.iter().zip(begins) {
        let numbers = times(rows, data.array.components);
        let values = part(&data.array.name, &data.array.values, *begin, numbers)?;
        *begin = begin.saturating_add(numbers);
        found.push(Array { values, ..data.array.clone_without_values() });
    }
    Ok(found)
}

impl Connected {
    /// Adds the cells of a piece; moves `begin` to the next one, in cells, ends and points.
    fn add(&self, piece: usize, begin: &mut [usize; 3], cells: &mut Cells) -> Result<(), Mistake> {
        let count = |which: usize, name: &str| {
            let found = self.counts[which].get(piece).copied();
            found.ok_or_else(|| {
                Mistake::new(format!("`{name}` has no number for the piece {piece}"))
            })
        };
        let (count, ids) = (count(0, "NumberOfCells")?, count(1, "NumberOfConnectivityIds")?);
        // The first end is the beginning of the first cell.
        let ends = part("Offsets", &self.ends, begin[1], count.saturating_add(1))?;
        let points = part("Connectivity", &self.points, begin[2], ids)?;
        match self.section {
            Some(section) => cells.add(section, &ends[1..], points),
            None => {
                for kind in part("Types", &self.types, begin[0], count)? {
                    let kind = u8::try_from(kind);
                    cells.types.push(kind.map_err(|_| Mistake::new("no type of cells"))?);
                }
                cells.ends.extend(&ends[1..]);
                cells.points.extend(points);
            }
        }
        let moves = [count, count + 1, ids];
        begin.iter_mut().zip(moves).for_each(|(it, by)| *it = it.saturating_add(by));
        Ok(())
    }
}

/// Reads evenly spaced points, with the cells between them.
fn image(file: &File<'_>, steps: &Steps<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let numbers =
        |name: &str, count: usize| file.numbers(ROOT, name).filter(|it| it.len() == count);
    let extent =
        numbers("WholeExtent", 6).ok_or_else(|| Mistake::new("expected a `WholeExtent`"))?;
    let origin = numbers("Origin", 3).unwrap_or_else(|| vec![0.0; 3]);
    let spacing = numbers("Spacing", 3).unwrap_or_else(|| vec![1.0; 3]);
    let turn = numbers("Direction", 9).unwrap_or_else(|| vec![1., 0., 0., 0., 1., 0., 0., 0., 1.]);
    let size = [0, 1, 2].map(|it| (extent[2 * it + 1] - extent[2 * it] + 1.0).max(0.0) as usize);
    let rows = size.iter().fold(1, |all, it| times(all, *it));
    // A few bytes may declare any number of points; a file with data for them is longer.
    if rows == 0 || rows as u64 > file.store.left() / 8 {
        return Err(Mistake::new(format!("{rows} points: the file has other numbers of them")));
    }
    file.wanted.reserve("the points of the image", times(rows, 3 + 10))?;
    let at = |axis: usize, index: usize| spacing[axis] * (extent[2 * axis] + index as f64);
    let place = |row: usize| {
        let [i, j] = [row % size[0], row / size[0] % size[1]];
        let local = [at(0, i), at(1, j), at(2, row / (size[0] * size[1]))];
        [0, 1, 2].map(|axis| {
            let turned: f64 = (0..3).map(|it| turn[3 * axis + it] * local[it]).sum();
            origin[axis] + turned
        })
    };
    let values = (0..rows).flat_map(place).collect();
    let points = Array { name: "Points".into(), components: 3, values, ..Array::default() };
    let (sets, mut unread) = (file.store.sets().map_err(Mistake::new)?, Vec::new());
    let of_points = data(steps, "PointData", &sets, &mut unread)?;
    let of_cells = data(steps, "CellData", &sets, &mut unread)?;
    let whole =
        Snapshot { points: Some(points), cells: ordered(size), unread, ..Snapshot::default() };
    let (cells, mut all) = (whole.cells.len(), file.repeated(whole, &steps.times)?);
    let steps = all.len().min(MOST_TIMES);
    for (step, snapshot) in all.iter_mut().enumerate() {
        let cut = |all: &[Data], rows: usize| {
            let each = all.iter().map(|data| {
                let components = data.array.values.len() / times(rows, steps).max(1);
                let numbers = times(rows, components);
                let begin = match &data.offsets {
                    Some(_) => times(offset(&data.offsets, step, 0), data.stride),
                    None => times(step, numbers),
                };
                let values = part(&data.array.name, &data.array.values, begin, numbers)?;
                match components {
                    0 => Err(Mistake::new(format!("`{}` does not fit its grid", data.array.name))),
                    _ => Ok(Array { values, components, ..data.array.clone_without_values() }),
                }
            });
            each.collect::<Result<Vec<_>, _>>()
        };
        (snapshot.of_points, snapshot.of_cells) = (cut(&of_points, rows)?, cut(&of_cells, cells)?);
    }
    Ok(all)
}
