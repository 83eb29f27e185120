//! Files `.msh` of Gmsh, of versions 2 and 4 ("Gmsh Reference Manual", section "File formats").
//!
//! In each view that it adds to a file, Gmsh writes the mesh again.

use memchr::memmem;

use super::gmsh_mesh::{Mesh, element};
use super::numbers::{ByteOrder, NumberType};
use super::text::{Numbers, number};
use crate::wanted::Wanted;
use crate::{Array, Mistake, Snapshot, Stored};

/// The beginning of a file.
pub const MARK: &[u8] = b"$MeshFormat";

/// The most components, and the most tags of a view or an element.
const MOST: usize = 1000;

/// The parts of a mesh that numbers may belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    Nodes,
    Elements,
}

/// A view at one time: numbers of nodes or of elements, by their tags.
pub struct View {
    pub of: Of,
    /// The time, as an array of one number.
    pub time: Array,
    pub step: i64,
    pub tags: Vec<u64>,
    pub array: Array,
}

/// Reads the mesh and all wanted views; views of one time make a snapshot.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>) -> Result<Vec<Snapshot>, Mistake> {
    let mut file = File { bytes, at: 0, format: Format::default(), wanted };
    let (mut mesh, mut views, mut unread) = (Mesh::default(), Vec::new(), Vec::new());
    while let Some(word) = file.word() {
        let Some(section) = word.strip_prefix('$') else {
            return Err(file.mistake(format!("expected a section, as `$Nodes`, found `{word}`")));
        };
        file.end_line();
        let of = match section {
            "NodeData" => Some(Of::Nodes),
            "ElementData" => Some(Of::Elements),
            _ => None,
        };
        let is_read = match section {
            "Nodes" => file.nodes(&mut mesh).map(|()| true)?,
            "Elements" => file.elements(&mut mesh).map(|()| true)?,
            "MeshFormat" => file.format(&mut mesh).map(|()| false)?,
            // Element data at the nodes of each element belong to no point.
            "NodeData" | "ElementData" | "ElementNodeData" => {
                let head = file.head()?;
                let is_wanted = wanted.reads(&head.name) && of.is_some();
                if !is_wanted {
                    unread.push((head.time.values[0], head.name.clone()));
                }
                // An unwanted view also shows which nodes and elements belong to the body.
                match of.map(|of| file.view(of, head, is_wanted)) {
                    Some(Ok(view)) => {
                        views.push(view);
                        true
                    }
                    Some(Err(mistake)) if is_wanted => return Err(mistake),
                    _ => false,
                }
            }
            _ => false,
        };
        file.end(section, is_read)?;
    }
    mesh.snapshots(views, unread, wanted)
}

/// The content of `$MeshFormat`.
#[derive(Clone, Copy)]
struct Format {
    /// 20, 40 or 41.
    version: u32,
    is_binary: bool,
    order: ByteOrder,
    /// The bytes of a count in binary.
    size: usize,
}

impl Default for Format {
    fn default() -> Self {
        Format { version: 41, is_binary: false, order: ByteOrder::Little, size: 8 }
    }
}

struct File<'a> {
    bytes: &'a [u8],
    at: usize,
    format: Format,
    wanted: &'a Wanted<'a>,
}

impl<'a> File<'a> {
    fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// A mistake at the current place: at a line if the file is text.
    fn mistake(&self, what: impl Into<String>) -> Mistake {
        let before = &self.bytes[..self.at.min(self.bytes.len())];
        match self.format.is_binary {
            true => Mistake::new(what),
            false => Mistake::at(1 + memchr::memchr_iter(b'\n', before).count(), what),
        }
    }

    fn cut(&self) -> Mistake {
        self.mistake("the file ends within a section: was it cut off? copy or write it again")
    }

    /// The next word of a text; `None` at the end.
    fn word(&mut self) -> Option<&'a str> {
        let rest = self.rest().trim_ascii_start();
        self.at = self.bytes.len() - rest.len();
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += end;
        (end > 0).then(|| std::str::from_utf8(&rest[..end]).unwrap_or("?"))
    }

    /// Skips to the end of the line.
    fn end_line(&mut self) {
        let rest = self.rest();
        self.at += memchr::memchr(b'\n', rest).map_or(rest.len(), |it| it + 1);
    }

    fn parsed<T: std::str::FromStr>(&mut self, what: &str) -> Result<T, Mistake> {
        let word = self.word().ok_or_else(|| self.cut())?;
        word.parse().map_err(|_| self.mistake(format!("expected {what}, found `{word}`")))
    }

    /// Reads a count that is text even in binary files.
    fn count(&mut self) -> Result<usize, Mistake> {
        let count = self.parsed("how many there are")?;
        if self.format.is_binary {
            self.end_line();
        }
        Ok(count)
    }

    /// Reads `length` bytes.
    fn raw(&mut self, length: usize) -> Result<&'a [u8], Mistake> {
        let data = self.rest().get(..length).ok_or_else(|| self.cut())?;
        self.at += length;
        Ok(data)
    }

    /// Reads an integer, of `bytes` bytes in binary.
    fn whole(&mut self, bytes: usize) -> Result<i64, Mistake> {
        if !self.format.is_binary {
            return self.parsed("a whole number");
        }
        let order = self.format.order;
        Ok(match *self.raw(bytes)? {
            [a, b, c, d] if order == ByteOrder::Little => i32::from_le_bytes([a, b, c, d]).into(),
            [a, b, c, d] => i32::from_be_bytes([a, b, c, d]).into(),
            ref data => {
                let data = *data.first_chunk().ok_or_else(|| self.cut())?;
                if order == ByteOrder::Little {
                    i64::from_le_bytes(data)
                } else {
                    i64::from_be_bytes(data)
                }
            }
        })
    }

    /// Reads a count of rows, each with some integers of 4 bytes and some numbers; refuses more rows than the file can contain.
    fn size(&mut self, integers: usize, numbers: usize) -> Result<usize, Mistake> {
        let count = if self.format.version < 40 {
            self.count()? as i64
        } else {
            self.whole(self.format.size)?
        };
        self.held(count, integers, numbers)
    }

    /// Reads the number of blocks in a section of format 4, from its first numbers.
    fn blocks(&mut self) -> Result<usize, Mistake> {
        let Format { version, size, .. } = self.format;
        let blocks = self.size(3, 0)?;
        let _all = self.whole(size)?;
        if version == 41 {
            let _least_and_most = [self.whole(size)?, self.whole(size)?];
        }
        Ok(blocks)
    }

    fn held(&self, count: i64, integers: usize, numbers: usize) -> Result<usize, Mistake> {
        let each = if self.format.is_binary {
            4 * integers + 8 * numbers
        } else {
            2 * (integers + numbers)
        };
        let is_there = |it: &usize| it.checked_mul(each).is_some_and(|it| it <= self.rest().len());
        usize::try_from(count).ok().filter(is_there).ok_or_else(|| {
            let what = format!(
                "a section that says it has {count} rows, and the file ends before: was it cut off?"
            );
            self.mistake(what)
        })
    }

    /// Reads `count` numbers.
    fn numbers(&mut self, count: usize, to: &mut Numbers) -> Result<(), Mistake> {
        if self.format.is_binary {
            let data = self.raw(count.saturating_mul(8))?;
            to.values.extend(NumberType::Float(8).read(data, self.format.order));
            return Ok(());
        }
        for _ in 0..count {
            let word = self.word().ok_or_else(|| self.cut())?;
            // This is how meshio writes numbers with NumPy 2.
            let bare = word.strip_prefix("np.float64(").and_then(|it| it.strip_suffix(')'));
            to.push(bare.unwrap_or(word), self.wanted).map_err(|it| self.mistake(it.what))?;
        }
        Ok(())
    }

    /// Skips to the end of a section.
    fn end(&mut self, section: &str, is_read: bool) -> Result<(), Mistake> {
        let end = format!("$End{section}");
        if is_read {
            return match self.word() {
                Some(word) if word == end => Ok(()),
                None => Err(self.cut()),
                Some(_) => {
                    Err(self
                        .mistake(format!("more in `${section}` than it says: expected `{end}`")))
                }
            };
        }
        let found = memmem::find(self.rest(), end.as_bytes()).ok_or_else(|| self.cut())?;
        self.at += found + end.len();
        Ok(())
    }

    fn format(&mut self, mesh: &mut Mesh) -> Result<(), Mistake> {
        self.format.is_binary = false;
        let version: f64 = self.parsed("a version")?;
        let [form, size] = [self.parsed::<usize>("0 or 1")?, self.parsed("the bytes of a number")?];
        let version = match version {
            2.0..3.0 => 20,
            4.0 => 40,
            4.1 => 41,
            other => {
                let what = format!(
                    "version {other} of Gmsh's format is not read; write 4.1, as with `Mesh.MshFileVersion = 4.1`"
                );
                return Err(self.mistake(what));
            }
        };
        if form > 1 || ![4, 8].contains(&size) {
            return Err(self.mistake(format!(
                "expected text (0) or binary (1) with 4 or 8 bytes, found {form} and {size}"
            )));
        }
        mesh.is_binary = form == 1;
        self.format = Format { version, size, is_binary: form == 1, ..self.format };
        if form == 1 {
            self.end_line();
            self.format.order = match *self.raw(4)? {
                [1, 0, 0, 0] => ByteOrder::Little,
                [0, 0, 0, 1] => ByteOrder::Big,
                _ => {
                    return Err(
                        self.mistake("expected the integer 1 behind the format: is it damaged?")
                    );
                }
            };
        }
        Ok(())
    }

    fn nodes(&mut self, mesh: &mut Mesh) -> Result<(), Mistake> {
        let Format { version, is_binary, size, .. } = self.format;
        let had = mesh.tags.len();
        if version == 20 {
            let count = self.size(1, 3)?;
            self.wanted.reserve("the nodes", count)?;
            for _ in 0..count {
                mesh.tags.push(self.whole(4)? as u64);
                self.coordinates(3, 0, mesh)?;
            }
            return mesh.unite_nodes(had).map_err(|what| self.mistake(what));
        }
        let blocks = self.blocks()?;
        for _ in 0..blocks {
            let [first, second, is_parametric] = [self.whole(4)?, self.whole(4)?, self.whole(4)?];
            let dimension = if version == 41 { first } else { second };
            let more = if is_parametric == 1 { dimension.clamp(0, 3) as usize } else { 0 };
            let count = self.size(1, 3)?;
            self.wanted.reserve("the nodes", count)?;
            if version == 40 {
                for _ in 0..count {
                    mesh.tags.push(self.whole(4)? as u64);
                    self.coordinates(3, more, mesh)?;
                }
                continue;
            }
            for _ in 0..count {
                mesh.tags.push(self.whole(size)? as u64);
            }
            match more {
                0 if is_binary => self.coordinates(3 * count, 0, mesh)?,
                _ => (0..count).try_for_each(|_| self.coordinates(3, more, mesh))?,
            }
        }
        mesh.unite_nodes(had).map_err(|what| self.mistake(what))
    }

    /// Reads coordinates, and skips `more` parameters after them.
    fn coordinates(&mut self, count: usize, more: usize, mesh: &mut Mesh) -> Result<(), Mistake> {
        if self.format.is_binary {
            self.wanted.reserve("the nodes", count)?;
        }
        self.numbers(count, &mut mesh.places)?;
        self.pass(more)
    }

    /// Skips `count` numbers.
    fn pass(&mut self, count: usize) -> Result<(), Mistake> {
        if self.format.is_binary {
            return self.raw(8 * count).map(drop);
        }
        (0..count).try_for_each(|_| self.word().map(drop).ok_or_else(|| self.cut()))
    }

    fn elements(&mut self, mesh: &mut Mesh) -> Result<(), Mistake> {
        let Format { version, is_binary, .. } = self.format;
        let had = mesh.len();
        if version == 20 {
            let mut left = self.size(3, 0)?;
            while left > 0 {
                // In text each element has its own head, after its number.
                let tag = if is_binary { None } else { Some(self.whole(4)? as u64) };
                let kind = self.whole(4)?;
                let count = if is_binary { self.whole(4)? } else { 1 };
                let tags = self.whole(4)?;
                let tags = usize::try_from(tags).ok().filter(|it| *it <= MOST);
                let tags = tags.ok_or_else(|| self.mistake("an element with too many tags"))?;
                let count = self.held(count, 1, 0)?;
                if count == 0 || count > left {
                    return Err(
                        self.mistake(format!("expected {left} more elements, found {count}"))
                    );
                }
                left -= count;
                self.block(mesh, kind, count, tag, tags)?;
            }
        } else {
            let blocks = self.blocks()?;
            for _ in 0..blocks {
                let [_, _, kind] = [self.whole(4)?, self.whole(4)?, self.whole(4)?];
                let count = self.size(2, 0)?;
                self.block(mesh, kind, count, None, 0)?;
            }
        }
        mesh.unite_elements(had).map_err(|what| self.mistake(what))
    }

    /// Reads elements of one type: for each its tag, if it is not known, further tags, and its nodes.
    fn block(
        &mut self,
        mesh: &mut Mesh,
        kind: i64,
        count: usize,
        tag: Option<u64>,
        others: usize,
    ) -> Result<(), Mistake> {
        let size = if self.format.version == 41 { self.format.size } else { 4 };
        let kind = element(kind).ok_or_else(|| {
            self.mistake(format!(
                "elements of Gmsh's type {kind} are not read; write elements of order 1 to 5, prisms and pyramids of order 1 or 2"
            ))
        })?;
        let each = kind.nodes + others + 1 - usize::from(tag.is_some());
        let count = self.held(count as i64, each, 0)?;
        self.wanted.reserve("the elements", count.saturating_mul(kind.nodes + 3))?;
        let mut nodes = Vec::with_capacity(kind.nodes);
        for _ in 0..count {
            let tag = match tag {
                Some(tag) => tag,
                None => self.whole(size)? as u64,
            };
            for _ in 0..others {
                self.whole(4)?;
            }
            nodes.clear();
            for _ in 0..kind.nodes {
                nodes.push(self.whole(size)? as u64);
            }
            mesh.add(tag, kind, &nodes);
        }
        Ok(())
    }

    /// Reads the lines before the numbers of a view.
    fn head(&mut self) -> Result<Head, Mistake> {
        let strings: usize = self.parsed("how many texts there are")?;
        self.end_line();
        let mut name = String::new();
        for at in 0..strings.min(MOST) {
            let start = self.at;
            self.end_line();
            if at == 0 {
                let line = String::from_utf8_lossy(&self.bytes[start..self.at]);
                name = line.trim().trim_matches('"').to_owned();
            }
        }
        let reals: usize = self.parsed("how many numbers there are")?;
        let mut time = Numbers::default();
        for at in 0..reals.min(MOST) {
            let word = self.word().ok_or_else(|| self.cut())?;
            if at == 0 {
                let expected = || self.mistake(format!("expected a time, found `{word}`"));
                number(word).filter(|it| it.is_finite()).ok_or_else(expected)?;
                time.push(word, self.wanted)?;
            }
        }
        if time.values.is_empty() {
            time.push("0", self.wanted)?;
        }
        let integers: usize = self.parsed("how many integers there are")?;
        let mut known = [0, 1, 0];
        for at in 0..integers.min(MOST) {
            let value = self.parsed::<i64>("a whole number")?;
            if let Some(known) = known.get_mut(at) {
                *known = value;
            }
        }
        self.end_line();
        let [step, components, rows] = known;
        Ok(Head { name, time: self.array("", 1, time), step, components, rows })
    }

    /// Makes an array; its numbers are doubles if the file is binary.
    fn array(&self, name: &str, components: usize, numbers: Numbers) -> Array {
        let array = numbers.into_array(name, components);
        let stored = if self.format.is_binary { Stored::Double } else { array.stored };
        Array { stored, ..array }
    }

    /// Reads the tags of a view at a time, and its numbers if they are wanted.
    fn view(&mut self, of: Of, head: Head, is_wanted: bool) -> Result<View, Mistake> {
        let Head { name, time, step, components, rows } = head;
        let components = usize::try_from(components).ok().filter(|it| (1..=MOST).contains(it));
        let components = components
            .ok_or_else(|| self.mistake(format!("`{name}`: expected how many numbers each has")))?;
        let rows = self.held(rows, 1, components)?;
        self.wanted.reserve(&format!("`{name}`"), rows)?;
        if self.format.is_binary && is_wanted {
            self.wanted.reserve(&format!("`{name}`"), rows * components)?;
        }
        let (mut tags, mut numbers) = (Vec::with_capacity(rows), Numbers::default());
        for _ in 0..rows {
            tags.push(self.whole(4)? as u64);
            match is_wanted {
                true => self.numbers(components, &mut numbers)?,
                false => self.pass(components)?,
            }
        }
        Ok(View { of, time, step, tags, array: self.array(&name, components, numbers) })
    }
}

/// The lines before the numbers of a view.
struct Head {
    name: String,
    time: Array,
    step: i64,
    components: i64,
    rows: i64,
}
