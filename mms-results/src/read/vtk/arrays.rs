//! Arrays of numbers of VTK in XML: in text, in base64, or in bytes after the XML, each compressed or not.

use std::borrow::Cow;

use roxmltree::Node;

use super::super::numbers::{ByteOrder, NumberType, count};
use super::super::text::{Style, finish, number};
use super::super::xml::{at, attribute, child};
use super::base64::Encoded;
use crate::wanted::{Need, Wanted};
use crate::{Array, Mistake, Snapshot, Stored};

/// The format of the numbers of a file.
pub struct Format<'a> {
    order: ByteOrder,
    /// The type of the lengths before arrays.
    header: NumberType,
    compressor: Option<Compressor>,
    appended: Option<Encoded<'a>>,
    pub wanted: &'a Wanted<'a>,
    /// Whether Lagrange hexahedra have some nodes in an older order.
    pub is_old: bool,
}

/// The compression of the blocks of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Compressor {
    Zlib,
    Lz4,
}

impl Compressor {
    /// Unpacks a block of this unpacked length.
    fn block(self, compressed: &[u8], length: usize) -> Result<Vec<u8>, Mistake> {
        match self {
            Compressor::Zlib => {
                miniz_oxide::inflate::decompress_to_vec_zlib_with_limit(compressed, length)
                    .map_err(|error| Mistake::new(format!("not zlib: {error}")))
            }
            Compressor::Lz4 => lz4_flex::block::decompress(compressed, length)
                .map_err(|error| Mistake::new(format!("not LZ4: {error}"))),
        }
    }
}

/// Arrays of a file, and for each whether it is declared to be in single precision.
#[derive(Default)]
pub struct Arrays {
    /// The arrays read so far.
    pub all: Vec<Array>,
    single: Vec<bool>,
    unread: Vec<String>,
}

impl<'a> Format<'a> {
    /// The format that the root of a file states.
    pub fn of(
        root: Node<'_, '_>,
        appended: Option<[&'a [u8]; 2]>,
        wanted: &'a Wanted<'a>,
    ) -> Result<Self, Mistake> {
        let order = match root.attribute("byte_order") {
            Some("BigEndian") => ByteOrder::Big,
            _ => ByteOrder::Little,
        };
        let header = match root.attribute("header_type") {
            Some("UInt64") => NumberType::Unsigned(8),
            None | Some("UInt32") => NumberType::Unsigned(4),
            Some(other) => {
                return Err(at(root, format!("header_type `{other}`: expected UInt32 or UInt64")));
            }
        };
        let compressor = match root.attribute("compressor") {
            None => None,
            Some("vtkZLibDataCompressor") => Some(Compressor::Zlib),
            Some("vtkLZ4DataCompressor") => Some(Compressor::Lz4),
            Some(other) => {
                let what = format!(
                    "compressed with `{other}`, which is not read: write without compression, or with \
                     vtkZLibDataCompressor or vtkLZ4DataCompressor"
                );
                return Err(at(root, what));
            }
        };
        let appended = appended.map(|[tag, data]| match memchr::memmem::find(tag, b"base64") {
            Some(_) => Encoded::Base64(letters(data), Vec::new()),
            None => Encoded::Raw(data),
        });
        let is_old = is_before(root.attribute("version").unwrap_or(""), [2, 1]);
        Ok(Format { order, header, compressor, appended, wanted, is_old })
    }
}

/// Whether a version, as 2.0, precedes another; a file without a version is old.
pub fn is_before(version: &str, other: [u32; 2]) -> bool {
    let (major, minor) = version.trim().split_once('.').unwrap_or((version, "0"));
    [major, minor].map(|it| it.trim().parse().unwrap_or(0)) < other
}

/// The leading part of bytes that is base64.
fn letters(bytes: &[u8]) -> &[u8] {
    let end = memchr::memchr(b'<', bytes).unwrap_or(bytes.len());
    bytes[..end].trim_ascii()
}

impl Arrays {
    /// Reads the places and the arrays of points and cells.
    pub fn of(
        piece: Node<'_, '_>,
        [rows, cells]: [usize; 2],
        format: &Format<'_>,
    ) -> Result<Snapshot, Mistake> {
        let mut arrays = Arrays::default();
        let points = child(piece, "Points").into_iter().flat_map(|it| it.children());
        for node in points.filter(|it| it.has_tag_name("DataArray")).take(1) {
            arrays.read(node, Some(rows), format)?;
        }
        let has_points = arrays.all.len();
        arrays.section(piece, "PointData", rows, format)?;
        let of_points = arrays.all.len();
        arrays.section(piece, "CellData", cells, format)?;
        arrays.finish();
        let Arrays { mut all, unread, .. } = arrays;
        let of_cells = all.split_off(of_points);
        let of_points = all.split_off(has_points);
        Ok(Snapshot { points: all.pop(), of_points, of_cells, unread, ..Snapshot::default() })
    }

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
                (Need::Numbers, kind) if kind.and_then(NumberType::of_xml).is_none() => {
                    self.unread.push(name.to_owned());
                }
                _ => self.read(node, Some(rows), format)?,
            }
        }
        Ok(())
    }

    /// Reads an array.
    pub fn read(
        &mut self,
        node: Node<'_, '_>,
        rows: Option<usize>,
        format: &Format<'_>,
    ) -> Result<(), Mistake> {
        let kind = node.attribute("type").unwrap_or("");
        let kind = NumberType::of_xml(kind).ok_or_else(|| {
            at(node, format!("type `{kind}`: expected one such as Float64 or Int32"))
        })?;
        let components = components(node)?;
        let name = node.attribute("Name").unwrap_or("").to_owned();
        let numbers = rows.map(|rows| count(rows, components.unwrap_or(1), kind)).transpose()?;
        let format = &Declared { format, numbers, is_open: components.is_none() };
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
        // If the number of components is not declared, it follows from the number of rows.
        let each = rows.filter(|it| *it > 0).map_or(1, |rows| values.len() / rows);
        let components = components.unwrap_or(each).max(1);
        if !format.fits(values.len()) || values.len() % components != 0 {
            let what = format!(
                "`{name}`: {} numbers, and expected {components} for each of {} points or cells",
                values.len(),
                rows.unwrap_or(0)
            );
            return Err(at(node, what));
        }
        let name_of = |at: usize| node.attribute(&*format!("ComponentName{at}")).map(str::to_owned);
        let component_names = (0..components).map_while(name_of).collect();
        self.all.push(Array { name, components, values, stored, component_names });
        self.single.push(kind == NumberType::Float(4));
        Ok(())
    }

    /// Gives arrays in text the digits of the file.
    pub fn finish(&mut self) {
        finish(&mut self.all.iter_mut().collect::<Vec<_>>(), &self.single);
    }
}

/// The most components of an array that does not declare them: as many as a tensor of four indices.
const MOST_OPEN: usize = 81;

/// An array, usually with a known number of numbers.
struct Declared<'a> {
    format: &'a Format<'a>,
    numbers: Option<usize>,
    /// Whether it may have several times as many numbers, because its components are not declared: meshio omits the components
    /// of arrays of matrices.
    is_open: bool,
}

/// The declared number of components; `None` if it is not declared.
fn components(node: Node<'_, '_>) -> Result<Option<usize>, Mistake> {
    let name = "NumberOfComponents";
    let is_declared = node.attribute(name).is_some_and(|it| !it.trim().is_empty());
    let declared = is_declared.then(|| attribute(node, name)).transpose()?;
    Ok(declared.map(|it| it.max(1)))
}

impl Declared<'_> {
    /// Whether the array may have this many numbers.
    fn fits(&self, numbers: usize) -> bool {
        match self.numbers {
            None => true,
            Some(rows) if self.is_open && rows > 0 => {
                numbers.is_multiple_of(rows) && (1..=MOST_OPEN).contains(&(numbers / rows))
            }
            Some(expected) => numbers == expected,
        }
    }

    /// Reserves memory for the array.
    fn take(&self, numbers: usize) -> Result<(), Mistake> {
        self.format.wanted.reserve("it", numbers)
    }

    /// Reads the numbers of an array in text.
    fn ascii(&self, node: Node<'_, '_>, kind: NumberType) -> Result<(Vec<f64>, Stored), Mistake> {
        let text = node.text().unwrap_or("");
        let most = self.numbers.filter(|_| !self.is_open).unwrap_or(usize::MAX);
        self.take(most.min(text.len() / 2))?;
        let mut style = Style::default();
        let value = |text: &str| {
            style.see(text);
            number(text).ok_or_else(|| Mistake::new(format!("expected a number, found `{text}`")))
        };
        let values = text.split_ascii_whitespace().map(value).collect::<Result<Vec<_>, _>>()?;
        Ok((values, if kind.stored() == Stored::Whole { Stored::Whole } else { style.stored() }))
    }

    fn appended_at(&self, offset: usize, kind: NumberType) -> Result<(Vec<f64>, Stored), Mistake> {
        let beyond = || Mistake::new(format!("offset {offset}: beyond the appended data"));
        let encoded = match self.format.appended.as_ref().ok_or_else(beyond)? {
            Encoded::Raw(bytes) => Encoded::Raw(bytes.get(offset..).ok_or_else(beyond)?),
            Encoded::Base64(text, _) => {
                Encoded::Base64(text.get(offset..).ok_or_else(beyond)?, Vec::new())
            }
        };
        self.decode(encoded, kind)
    }

    fn decode(
        &self,
        mut encoded: Encoded<'_>,
        kind: NumberType,
    ) -> Result<(Vec<f64>, Stored), Mistake> {
        let format = self.format;
        let bytes = match format.compressor {
            Some(compressor) => Cow::Owned(self.inflate(&mut encoded, kind, compressor)?),
            None => {
                let length = encoded.integer(format.header, format.order)?;
                self.reserve_declared(length, kind)?;
                encoded.take(length)?
            }
        };
        if bytes.len() % kind.bytes() != 0 {
            return Err(Mistake::new("its bytes end within a number"));
        }
        Ok((kind.read(&bytes, format.order), kind.stored()))
    }

    /// Refuses bytes if their number is not the declared one, or there is not enough memory.
    fn reserve_declared(&self, bytes: usize, kind: NumberType) -> Result<(), Mistake> {
        if !self.fits(bytes / kind.bytes()) {
            let expected = self.numbers.unwrap_or(0).saturating_mul(kind.bytes());
            return Err(Mistake::new(format!("{bytes} bytes of numbers, and expected {expected}")));
        }
        self.take(bytes / kind.bytes())
    }

    /// Reads separately compressed blocks. Before them are their number, their length, the length of the last if it differs,
    /// and their compressed lengths.
    fn inflate(
        &self,
        encoded: &mut Encoded<'_>,
        kind: NumberType,
        compressor: Compressor,
    ) -> Result<Vec<u8>, Mistake> {
        let Format { header, order, .. } = *self.format;
        let mut integer = || encoded.integer(header, order);
        let [blocks, length, last] = [integer()?, integer()?, integer()?];
        let before = if last > 0 { blocks.saturating_sub(1) } else { blocks };
        self.reserve_declared(before.saturating_mul(length).saturating_add(last), kind)?;
        let table = encoded.take(blocks.saturating_mul(header.bytes()))?;
        let mut bytes = Vec::new();
        for (block, compressed) in header.read(&table, order).into_iter().enumerate() {
            let compressed = encoded.take(compressed as usize)?;
            let length = if block + 1 == blocks && last > 0 { last } else { length };
            bytes.extend(compressor.block(&compressed, length)?);
        }
        Ok(bytes)
    }
}
