//! VTK in XML: "VTK XML Formats" (Kitware, VTK documentation).

use roxmltree::Node;

use super::super::Contents;
use super::super::numbers::positions;
use super::super::table::is_time;
use super::super::xml::{at, attribute, child, line};
use super::arrays::{Arrays, Format};
use super::lists;
use super::structured::{Extent, Lattice, numbers};
use crate::snapshot::Section;
use crate::wanted::Wanted;
use crate::{Array, Cells, Mistake, Snapshot, Time};

/// Reads the grid of a file, or the list of its files.
pub fn contents(
    root: Node<'_, '_>,
    appended: Option<[&[u8]; 2]>,
    wanted: &Wanted<'_>,
) -> Result<Contents, Mistake> {
    let format = &Format::of(root, appended, wanted)?;
    let kind = root.attribute("type").unwrap_or("");
    let body =
        child(root, kind).ok_or_else(|| at(root, format!("expected an element `<{kind}>`")))?;
    let one = |snapshot| Contents::Snapshots(vec![snapshot]);
    match (kind, kind.strip_prefix('P').and_then(Grid::named)) {
        ("Collection", _) => lists::times(body),
        (
            "vtkMultiBlockDataSet" | "vtkPartitionedDataSet" | "vtkPartitionedDataSetCollection",
            _,
        ) => lists::blocks(body),
        (_, Some(_)) => lists::pieces(body),
        _ => match Grid::named(kind) {
            Some(kind) => grid(root, body, kind, format).map(one),
            None => Err(at(
                root,
                format!(
                    "`{kind}` is not read: expected UnstructuredGrid, PolyData, StructuredGrid, ImageData, \
                     RectilinearGrid, or a list of such files"
                ),
            )),
        },
    }
}

/// The way in which a grid defines its points and cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Grid {
    /// Lists of points and cells.
    Listed,
    /// A list of points, and an extent.
    Structured,
    /// An origin, steps, and an extent.
    Image,
    /// Coordinates along each axis, and an extent.
    Rectilinear,
}

impl Grid {
    fn named(name: &str) -> Option<Grid> {
        Some(match name {
            "UnstructuredGrid" | "PolyData" => Grid::Listed,
            "StructuredGrid" => Grid::Structured,
            "ImageData" => Grid::Image,
            "RectilinearGrid" => Grid::Rectilinear,
            _ => return None,
        })
    }
}

fn grid(
    root: Node<'_, '_>,
    body: Node<'_, '_>,
    kind: Grid,
    format: &Format<'_>,
) -> Result<Snapshot, Mistake> {
    let pieces = body.children().filter(|it| it.has_tag_name("Piece"));
    let read = |piece| match kind {
        Grid::Listed => self::piece(piece, format),
        _ => structured(body, piece, kind, format),
    };
    let pieces = pieces.map(read).collect::<Result<Vec<_>, _>>()?;
    if pieces.is_empty() {
        return Err(at(body, "expected an element `<Piece>`"));
    }
    let time = [body, root].into_iter().find_map(|it| child(it, "FieldData"));
    let time = time.map(|data| time_of(data, format)).transpose()?.flatten();
    Ok(Snapshot { time, ..Snapshot::join(pieces)? })
}

/// The time of a file, if its field data contain one.
fn time_of(data: Node<'_, '_>, format: &Format<'_>) -> Result<Option<Time>, Mistake> {
    let named = |it: &Node<'_, '_>| it.attribute("Name").is_some_and(is_time);
    let Some(node) = data.children().filter(|it| it.has_tag_name("DataArray")).find(named) else {
        return Ok(None);
    };
    let mut arrays = Arrays::default();
    arrays.read(node, Some(1), format)?;
    arrays.finish();
    let found = arrays.all.first().filter(|array| array.values.len() == 1);
    let array = found.ok_or_else(|| at(node, "expected one time"))?;
    let value = array.values[0];
    Ok(Some(Time { value, rounding: array.stored.rounding(value) }))
}

/// Reads a piece; one without points may have arrays of any kind, and is ignored.
fn piece(piece: Node<'_, '_>, format: &Format<'_>) -> Result<Snapshot, Mistake> {
    let rows = attribute(piece, "NumberOfPoints")?;
    let none = |of: &str| attribute(piece, &format!("NumberOf{of}")) == Ok(0);
    if rows == 0 && none("Cells") && Section::ALL.iter().all(|it| none(it.name())) {
        return Ok(Snapshot::default());
    }
    let mut cells = cells(piece, format)?;
    cells.validate(rows).map_err(|mistake| Mistake { line: Some(line(piece)), ..mistake })?;
    if format.is_old {
        cells.renumber_old();
    }
    let arrays = Arrays::of(piece, [rows, cells.len()], format)?;
    match arrays.points {
        None if !cells.is_empty() => Err(without_places(piece)),
        _ => Ok(Snapshot { cells, ..arrays }.with_vertices_as_points()),
    }
}

fn without_places(piece: Node<'_, '_>) -> Mistake {
    at(piece, "expected an element `<Points>` with the places of the points of its cells")
}

/// Reads a piece of a grid with an extent. Without arrays nothing confirms that it is as large as its extent.
fn structured(
    body: Node<'_, '_>,
    piece: Node<'_, '_>,
    kind: Grid,
    format: &Format<'_>,
) -> Result<Snapshot, Mistake> {
    let here = |mistake: Mistake| at(piece, mistake.what);
    let extent = piece.attribute("Extent").or_else(|| body.attribute("WholeExtent"));
    let extent = Extent::parse(extent.unwrap_or("")).map_err(here)?;
    if extent.points() == 0 {
        return Ok(Snapshot::default());
    }
    let mut found = Arrays::of(piece, [extent.points(), extent.cells()], format)?;
    let has_arrays = !found.of_points.is_empty() || !found.of_cells.is_empty();
    match kind {
        Grid::Image if has_arrays => {
            let places =
                lattice(body).map_err(|it| at(body, it.what))?.places(&extent, format.wanted);
            found.points = Some(places.map_err(here)?);
        }
        Grid::Rectilinear if has_arrays => {
            found.points = Some(rectilinear(piece, &extent, format)?);
        }
        Grid::Structured if found.points.is_none() => return Err(without_places(piece)),
        _ => {}
    }
    if found.points.is_some() {
        found.cells = extent.mesh(format.wanted).map_err(here)?;
    }
    Ok(found)
}

/// The origin, the steps and the directions of the axes of an image.
fn lattice(body: Node<'_, '_>) -> Result<Lattice, Mistake> {
    let usual = Lattice::default();
    Ok(Lattice {
        origin: body.attribute("Origin").map_or(Ok(usual.origin), numbers)?,
        spacing: body.attribute("Spacing").map_or(Ok(usual.spacing), numbers)?,
        direction: body.attribute("Direction").map_or(Ok(usual.direction), numbers)?,
    })
}

/// The places of points from their coordinates along each axis.
fn rectilinear(
    piece: Node<'_, '_>,
    extent: &Extent,
    format: &Format<'_>,
) -> Result<Array, Mistake> {
    let nodes = child(piece, "Coordinates").into_iter().flat_map(|it| it.children());
    let mut arrays = Arrays::default();
    for (node, rows) in nodes.filter(|it| it.has_tag_name("DataArray")).zip(extent.counts()) {
        arrays.read(node, Some(rows), format)?;
    }
    arrays.finish();
    let all: [Array; 3] = arrays.all.try_into().map_err(|_| {
        at(piece, "expected an element `<Coordinates>` with an array along each of three axes")
    })?;
    extent.along(&all, format.wanted).map_err(|mistake| at(piece, mistake.what))
}

/// The number in an attribute, if the attribute exists.
fn declared(node: Node<'_, '_>, name: &str) -> Result<Option<usize>, Mistake> {
    node.attribute(name).map(|_| attribute(node, name)).transpose()
}

fn cells(piece: Node<'_, '_>, format: &Format<'_>) -> Result<Cells, Mistake> {
    if let Some(node) = child(piece, "Cells") {
        let count = declared(piece, "NumberOfCells")?;
        let (ends, points) = lists(node, count, format)?;
        let types = integers(node, "types", count, format)?.into_iter();
        let kind = |kind: usize| {
            u8::try_from(kind).map_err(|_| at(node, format!("no type of cells: {kind}")))
        };
        return Ok(Cells { types: types.map(kind).collect::<Result<_, _>>()?, points, ends });
    }
    let mut cells = Cells::default();
    for section in Section::ALL {
        let Some(node) = child(piece, section.name()) else { continue };
        let count = declared(piece, &format!("NumberOf{}", section.name()))?;
        let (ends, points) = lists(node, count, format)?;
        cells.add(section, &ends, points);
    }
    Ok(cells)
}

/// The ends of cells, and their points: as many as the last end states.
fn lists(
    node: Node<'_, '_>,
    count: Option<usize>,
    format: &Format<'_>,
) -> Result<(Vec<usize>, Vec<usize>), Mistake> {
    let ends = integers(node, "offsets", count, format)?;
    let points = ends.last().copied().unwrap_or(0);
    let points = integers(node, "connectivity", Some(points), format)?;
    Ok((ends, points))
}

/// The array of this name as positions; `None` if it does not exist.
fn integers(
    node: Node<'_, '_>,
    name: &str,
    count: Option<usize>,
    format: &Format<'_>,
) -> Result<Vec<usize>, Mistake> {
    let named = |it: &Node<'_, '_>| it.attribute("Name") == Some(name);
    let Some(node) = node.children().find(named) else { return Ok(Vec::new()) };
    let mut arrays = Arrays::default();
    arrays.read(node, count, format)?;
    let values = arrays.all.pop().map(|array| array.values).unwrap_or_default();
    positions(values).map_err(|mistake| at(node, mistake.what))
}
