//! VTK in XML: "VTK XML Formats" (Kitware, VTK documentation).

use std::borrow::Cow;

use roxmltree::{Document, Node, ParsingOptions};

use super::base64::Encoded;
use super::numbers::{Kind, Order, count, positions};
use super::table::is_time;
use super::text::{Style, number, settle, times_of};
use super::{Beside, Contents, MOST_FILES, xdmf};
use crate::snapshot::Section;
use crate::wanted::{Need, Wanted};
use crate::{Array, Cells, Mistake, Snapshot, Stored, Time};

/// How many elements a file may have: its numbers are none.
const MOST_ELEMENTS: u32 = 200_000;
/// How long a tag may be. The attributes of one are compared with each other.
const LONGEST_TAG: usize = 4096;

/// How the numbers of a file are written.
struct Format<'a> {
    order: Order,
    /// Of the lengths before arrays.
    header: Kind,
    is_compressed: bool,
    appended: Option<Encoded<'a>>,
    wanted: &'a Wanted<'a>,
}

/// Arrays of a file, and of each whether it is declared to be in single precision.
#[derive(Default)]
struct Arrays {
    all: Vec<Array>,
    single: Vec<bool>,
    unread: Vec<String>,
}

/// Reads a file: its grid, or the list of its files.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>, beside: Beside<'_>) -> Result<Contents, Mistake> {
    let (text, appended) = split(bytes);
    let text = match appended {
        Some(_) => Cow::Owned([text, b"</VTKFile>"].concat()),
        None => Cow::Borrowed(text),
    };
    let text = std::str::from_utf8(&text).map_err(|_| Mistake::new("expected XML in UTF-8"))?;
    let text = text.trim_start_matches('\u{feff}').trim_start();
    hold_tags(text.as_bytes())?;
    // XDMF has a declaration of its type, which declares nothing.
    let allow_dtd = !text.contains("<!ENTITY");
    let options =
        ParsingOptions { nodes_limit: MOST_ELEMENTS, allow_dtd, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| Mistake::at(error.pos().row as usize, format!("not XML: {error}")))?;
    let root = document.root_element();
    match root.tag_name().name() {
        "VTKFile" => contents(root, &Format::of(root, appended, wanted)?),
        "Xdmf" => xdmf::parse(root, wanted, beside).map(Contents::Snapshots),
        other => Err(Mistake::new(format!("expected `<VTKFile>` or `<Xdmf>`, found `<{other}>`"))),
    }
}

/// The XML of a file, and what stands behind it in bytes, after the tag of its element.
fn split(bytes: &[u8]) -> (&[u8], Option<[&[u8]; 2]>) {
    let Some(start) = memchr::memmem::find(bytes, b"<AppendedData") else { return (bytes, None) };
    let (text, rest) = bytes.split_at(start);
    let Some(end) = memchr::memchr(b'>', rest) else { return (bytes, None) };
    let (tag, data) = rest.split_at(end);
    let data = memchr::memchr(b'_', data).map_or(&data[..0], |at| &data[at + 1..]);
    (text, Some([tag, data]))
}

/// Refuses tags that are longer than any program writes.
fn hold_tags(text: &[u8]) -> Result<(), Mistake> {
    let mut at = 0;
    while let Some(start) = memchr::memchr(b'<', &text[at..]) {
        at += start;
        let rest = &text[at..];
        let length = match rest.starts_with(b"<!--") {
            true => memchr::memmem::find(rest, b"-->"),
            false => tag(&rest[..rest.len().min(LONGEST_TAG)]),
        };
        match length {
            Some(length) => at += length + 1,
            None if rest.len() <= LONGEST_TAG || rest.starts_with(b"<!--") => break,
            None => {
                return Err(Mistake::new(format!("a tag of more than {LONGEST_TAG} bytes")));
            }
        }
    }
    Ok(())
}

/// Where a tag ends.
fn tag(text: &[u8]) -> Option<usize> {
    let mut quote = None;
    text.iter().position(|&byte| match quote {
        Some(mark) => {
            quote = quote.filter(|_| byte != mark);
            false
        }
        None => {
            quote = matches!(byte, b'"' | b'\'').then_some(byte);
            byte == b'>'
        }
    })
}

impl<'a> Format<'a> {
    fn of(
        root: Node<'_, '_>,
        appended: Option<[&'a [u8]; 2]>,
        wanted: &'a Wanted<'a>,
    ) -> Result<Self, Mistake> {
        let order = match root.attribute("byte_order") {
            Some("BigEndian") => Order::Big,
            _ => Order::Little,
        };
        let header = match root.attribute("header_type") {
            Some("UInt64") => Kind::Unsigned(8),
            None | Some("UInt32") => Kind::Unsigned(4),
            Some(other) => {
                return Err(at(root, format!("header_type `{other}`: expected UInt32 or UInt64")));
            }
        };
        let is_compressed = match root.attribute("compressor") {
            None => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                let what = format!(
                    "compressed with `{other}`, which is not read: write without compression, or with \
                     vtkZLibDataCompressor"
                );
                return Err(at(root, what));
            }
        };
        let appended = appended.map(|[tag, data]| match memchr::memmem::find(tag, b"base64") {
            Some(_) => Encoded::Base64(letters(data), Vec::new()),
            None => Encoded::Raw(data),
        });
        Ok(Format { order, header, is_compressed, appended, wanted })
    }
}

/// What is base64 of these bytes.
fn letters(bytes: &[u8]) -> &[u8] {
    let end = memchr::memchr(b'<', bytes).unwrap_or(bytes.len());
    bytes[..end].trim_ascii()
}

/// A mistake at the line of an element.
pub(super) fn at(node: Node<'_, '_>, what: impl Into<String>) -> Mistake {
    Mistake::at(line(node), what)
}

fn line(node: Node<'_, '_>) -> usize {
    node.document().text_pos_at(node.range().start).row as usize
}

pub(super) fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|child| child.has_tag_name(name))
}

fn contents(root: Node<'_, '_>, format: &Format<'_>) -> Result<Contents, Mistake> {
    let kind = root.attribute("type").unwrap_or("");
    let body =
        child(root, kind).ok_or_else(|| at(root, format!("expected an element `<{kind}>`")))?;
    match kind {
        "Collection" => times(body),
        "PUnstructuredGrid" | "PPolyData" => {
            let files = body.children().filter(|it| it.has_tag_name("Piece"));
            Ok(Contents::Pieces(names(files, "Source")?))
        }
        "UnstructuredGrid" | "PolyData" => {
            grid(root, body, format).map(|it| Contents::Snapshots(vec![it]))
        }
        other => Err(at(
            root,
            format!(
                "`{other}` is not read: expected UnstructuredGrid or PolyData, or a list of such files; ParaView \
                 turns it into one with `Append Datasets`"
            ),
        )),
    }
}

/// The files that elements name, each once.
fn names<'a, 'b: 'a>(
    nodes: impl Iterator<Item = Node<'a, 'b>>,
    attribute: &str,
) -> Result<Vec<String>, Mistake> {
    let mut files = Vec::new();
    let mut seen = std::collections::BTreeSet::new();
    for node in nodes {
        let file = node.attribute(attribute);
        let file = file.ok_or_else(|| at(node, format!("expected an attribute `{attribute}`")))?;
        if !seen.insert(file) {
            return Err(at(node, format!("the file `{file}` is listed twice")));
        }
        files.push(file.to_owned());
    }
    match files.len() {
        0 => Err(Mistake::new("the list has no files")),
        count if count > MOST_FILES => {
            Err(Mistake::new(format!("a list of more than {MOST_FILES} files")))
        }
        _ => Ok(files),
    }
}

fn times(body: Node<'_, '_>) -> Result<Contents, Mistake> {
    let sets = || body.children().filter(|it| it.has_tag_name("DataSet"));
    let files = names(sets(), "file")?;
    let time = |node: Node<'_, '_>| {
        let text = node.attribute("timestep").unwrap_or("");
        let value = number(text).filter(|it| it.is_finite());
        let value = value.ok_or_else(|| at(node, format!("timestep `{text}`: expected a time")))?;
        let mut style = Style::default();
        style.see(text);
        Ok((value, style.stored()))
    };
    let found = sets().map(time).collect::<Result<Vec<_>, Mistake>>()?;
    let mut times: Vec<_> = times_of(&found).zip(files).collect();
    times.sort_by(|a, b| a.0.value.total_cmp(&b.0.value));
    Ok(Contents::Times(times))
}

fn grid(root: Node<'_, '_>, body: Node<'_, '_>, format: &Format<'_>) -> Result<Snapshot, Mistake> {
    let pieces = body.children().filter(|it| it.has_tag_name("Piece"));
    let pieces = pieces.map(|piece| self::piece(piece, format)).collect::<Result<Vec<_>, _>>()?;
    if pieces.is_empty() {
        return Err(at(body, "expected an element `<Piece>`"));
    }
    let time = [body, root].into_iter().find_map(|it| child(it, "FieldData"));
    let time = time.map(|data| time_of(data, format)).transpose()?.flatten();
    Ok(Snapshot { time, ..Snapshot::join(pieces)? })
}

/// The time of a file, if its data of the whole have one.
fn time_of(data: Node<'_, '_>, format: &Format<'_>) -> Result<Option<Time>, Mistake> {
    let named = |it: &Node<'_, '_>| it.attribute("Name").is_some_and(is_time);
    let Some(node) = data.children().filter(|it| it.has_tag_name("DataArray")).find(named) else {
        return Ok(None);
    };
    let mut arrays = Arrays::default();
    arrays.read(node, Some(1), format)?;
    arrays.settle();
    let found = arrays.all.first().filter(|array| array.values.len() == 1);
    let array = found.ok_or_else(|| at(node, "expected one time"))?;
    let value = array.values[0];
    Ok(Some(Time { value, rounding: array.stored.rounding(value) }))
}

fn piece(piece: Node<'_, '_>, format: &Format<'_>) -> Result<Snapshot, Mistake> {
    let rows = attribute(piece, "NumberOfPoints")?;
    let cells = cells(piece, format)?;
    cells.hold(rows).map_err(|mistake| Mistake { line: Some(line(piece)), ..mistake })?;
    let mut arrays = Arrays::default();
    let points = child(piece, "Points").into_iter().flat_map(|it| it.children());
    for node in points.filter(|it| it.has_tag_name("DataArray")).take(1) {
        arrays.read(node, Some(rows), format)?;
    }
    let has_points = arrays.all.len();
    if has_points == 0 && !cells.is_empty() {
        return Err(at(
            piece,
            "expected an element `<Points>` with the places of the points of its cells",
        ));
    }
    arrays.section(piece, "PointData", rows, format)?;
    let of_points = arrays.all.len();
    arrays.section(piece, "CellData", cells.len(), format)?;
    arrays.settle();
    let Arrays { mut all, unread, .. } = arrays;
    let of_cells = all.split_off(of_points);
    let of_points = all.split_off(has_points);
    Ok(Snapshot { points: all.pop(), cells, of_points, of_cells, unread, ..Snapshot::default() })
}

/// An attribute that is a number; 0 where there is none.
fn attribute(node: Node<'_, '_>, name: &str) -> Result<usize, Mistake> {
    let text = node.attribute(name).unwrap_or("0").trim();
    let wrong = || at(node, format!("{name}=\"{text}\": expected a whole number"));
    text.parse().map_err(|_| wrong())
}

/// How many there are, as an attribute declares it, if it does.
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

/// Where so many cells end, and their points: as many as the last end says.
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

/// The array of that name as positions; none where it is not there.
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

impl Arrays {
    /// Reads the arrays of points or of cells.
    fn section(
        &mut self,
        piece: Node<'_, '_>,
        name: &str,
        rows: usize,
        format: &Format<'_>,
    ) -> Result<(), Mistake> {
        let Some(section) = child(piece, name) else { return Ok(()) };
        let is_array = |it: &Node<'_, '_>| it.has_tag_name("DataArray") || it.has_tag_name("Array");
        for node in section.children().filter(is_array) {
            let name = node.attribute("Name").unwrap_or("");
            match (format.wanted.need(name), node.attribute("type")) {
                (Need::Must, Some("String")) => {
                    return Err(at(node, format!("`{name}`: expected numbers, found words")));
                }
                (Need::No | Need::Sound, _) | (_, Some("String")) => {
                    self.unread.push(name.to_owned());
                }
                _ => self.read(node, Some(rows), format)?,
            }
        }
        Ok(())
    }

    /// Reads an array.
    fn read(
        &mut self,
        node: Node<'_, '_>,
        rows: Option<usize>,
        format: &Format<'_>,
    ) -> Result<(), Mistake> {
        let kind = node.attribute("type").unwrap_or("");
        let kind = Kind::of_xml(kind).ok_or_else(|| {
            at(node, format!("type `{kind}`: expected one such as Float64 or Int32"))
        })?;
        let components = attribute(node, "NumberOfComponents")?.max(1);
        let expected = rows.map(|rows| count(rows, components, kind)).transpose()?;
        let name = node.attribute("Name").unwrap_or("").to_owned();
        let format = &Declared { format, numbers: expected };
        let found = match node.attribute("format") {
            None | Some("ascii") => format.ascii(node, kind),
            Some("binary") => {
                let text = node.text().unwrap_or("").as_bytes();
                let clean: Vec<u8>;
                let text = match text.trim_ascii() {
                    text if text.iter().any(u8::is_ascii_whitespace) => {
                        clean =
                            text.iter().copied().filter(|it| !it.is_ascii_whitespace()).collect();
                        &clean
                    }
                    text => text,
                };
                format.decode(Encoded::Base64(text, Vec::new()), kind)
            }
            Some("appended") => format.appended_at(attribute(node, "offset")?, kind),
            Some(other) => {
                Err(Mistake::new(format!("format `{other}`: expected ascii, binary or appended")))
            }
        };
        let (values, stored) =
            found.map_err(|mistake| at(node, format!("`{name}`: {}", mistake.what)))?;
        if expected.is_some_and(|expected| expected != values.len())
            || values.len() % components != 0
        {
            let what = format!(
                "`{name}`: {} numbers, and expected {components} for each of {} points or cells",
                values.len(),
                rows.unwrap_or(0)
            );
            return Err(at(node, what));
        }
        self.all.push(Array { name, components, values, stored });
        self.single.push(kind == Kind::Float(4));
        Ok(())
    }

    fn settle(&mut self) {
        settle(&mut self.all.iter_mut().collect::<Vec<_>>(), &self.single);
    }
}

/// An array of which it is known, as a rule, how many numbers it has.
struct Declared<'a> {
    format: &'a Format<'a>,
    numbers: Option<usize>,
}

impl Declared<'_> {
    /// Takes room for the array.
    fn take(&self, numbers: usize) -> Result<(), Mistake> {
        self.format.wanted.take("it", numbers)
    }

    /// The numbers of an array in text.
    fn ascii(&self, node: Node<'_, '_>, kind: Kind) -> Result<(Vec<f64>, Stored), Mistake> {
        let text = node.text().unwrap_or("");
        self.take(self.numbers.unwrap_or(usize::MAX).min(text.len() / 2))?;
        let mut style = Style::default();
        let value = |text: &str| {
            style.see(text);
            number(text).ok_or_else(|| Mistake::new(format!("expected a number, found `{text}`")))
        };
        let values = text.split_ascii_whitespace().map(value).collect::<Result<Vec<_>, _>>()?;
        Ok((values, if kind.stored() == Stored::Whole { Stored::Whole } else { style.stored() }))
    }

    fn appended_at(&self, offset: usize, kind: Kind) -> Result<(Vec<f64>, Stored), Mistake> {
        let beyond = || Mistake::new(format!("offset {offset}: beyond the appended data"));
        let encoded = match self.format.appended.as_ref().ok_or_else(beyond)? {
            Encoded::Raw(bytes) => Encoded::Raw(bytes.get(offset..).ok_or_else(beyond)?),
            Encoded::Base64(text, _) => {
                Encoded::Base64(text.get(offset..).ok_or_else(beyond)?, Vec::new())
            }
        };
        self.decode(encoded, kind)
    }

    fn decode(&self, mut encoded: Encoded<'_>, kind: Kind) -> Result<(Vec<f64>, Stored), Mistake> {
        let format = self.format;
        let bytes = match format.is_compressed {
            true => Cow::Owned(self.inflate(&mut encoded, kind)?),
            false => {
                let length = encoded.integer(format.header, format.order)?;
                self.hold(length, kind)?;
                encoded.take(length)?
            }
        };
        if bytes.len() % kind.bytes() != 0 {
            return Err(Mistake::new("its length is not that of whole numbers"));
        }
        Ok((kind.read(&bytes, format.order), kind.stored()))
    }

    /// Refuses so many bytes where another number of them is declared, or where there is no room for them.
    fn hold(&self, bytes: usize, kind: Kind) -> Result<(), Mistake> {
        if let Some(expected) = self.numbers.map(|numbers| numbers.saturating_mul(kind.bytes()))
            && bytes != expected
        {
            return Err(Mistake::new(format!("{bytes} bytes of numbers, and expected {expected}")));
        }
        self.take(bytes / kind.bytes())
    }

    /// Blocks of bytes, each compressed for itself: how many, their length, that of the last if it is another, and the
    /// lengths to which they were compressed.
    fn inflate(&self, encoded: &mut Encoded<'_>, kind: Kind) -> Result<Vec<u8>, Mistake> {
        let Format { header, order, .. } = *self.format;
        let mut integer = || encoded.integer(header, order);
        let [blocks, length, last] = [integer()?, integer()?, integer()?];
        let before = if last > 0 { blocks.saturating_sub(1) } else { blocks };
        self.hold(before.saturating_mul(length).saturating_add(last), kind)?;
        let table = encoded.take(blocks.saturating_mul(header.bytes()))?;
        let mut bytes = Vec::new();
        for (block, compressed) in header.read(&table, order).into_iter().enumerate() {
            let compressed = encoded.take(compressed as usize)?;
            let length = if block + 1 == blocks && last > 0 { last } else { length };
            let block =
                miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(&compressed, length);
            bytes.extend(block.map_err(|error| Mistake::new(format!("not zlib: {error}")))?);
        }
        Ok(bytes)
    }
}
