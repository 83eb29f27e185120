//! Files in XML, VTK and XDMF: their elements, and the bytes that VTK appends.

use std::borrow::Cow;

use roxmltree::{Document, Node, ParsingOptions};

use super::{Beside, Contents, vtk, xdmf};
use crate::Mistake;
use crate::wanted::Wanted;

/// The most elements of a file, not counting its numbers.
const MOST_ELEMENTS: u32 = 200_000;
/// The longest tag. Its attributes are compared with each other.
const LONGEST_TAG: usize = 4096;

/// The bytes at the beginning of a file that are searched for its first element.
const FIRST: usize = 4096;

/// Whether a file begins with an element of XDMF.
pub fn is_xdmf(text: &[u8]) -> bool {
    memchr::memmem::find(&text[..text.len().min(FIRST)], b"<Xdmf").is_some()
}

/// Reads a file of VTK or XDMF.
pub fn parse(bytes: &[u8], wanted: &Wanted<'_>, beside: Beside<'_>) -> Result<Contents, Mistake> {
    let (text, appended) = split(bytes);
    let text = match appended {
        Some(_) => Cow::Owned([text, b"</VTKFile>"].concat()),
        None => Cow::Borrowed(text),
    };
    let text = std::str::from_utf8(&text).map_err(|_| Mistake::new("expected XML in UTF-8"))?;
    let text = text.trim_start_matches('\u{feff}').trim_start();
    validate_tags(text.as_bytes())?;
    // XDMF has a document type declaration, which declares nothing.
    let allow_dtd = !text.contains("<!ENTITY");
    let options =
        ParsingOptions { nodes_limit: MOST_ELEMENTS, allow_dtd, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| Mistake::at(error.pos().row as usize, format!("not XML: {error}")))?;
    let root = document.root_element();
    match root.tag_name().name() {
        "VTKFile" => vtk::xml::contents(root, appended, wanted),
        "Xdmf" => xdmf::parse(root, wanted, beside).map(Contents::Snapshots),
        other => Err(Mistake::new(format!("expected `<VTKFile>` or `<Xdmf>`, found `<{other}>`"))),
    }
}

/// Splits a file into its XML, and the tag and the appended bytes.
fn split(bytes: &[u8]) -> (&[u8], Option<[&[u8]; 2]>) {
    let Some(start) = memchr::memmem::find(bytes, b"<AppendedData") else { return (bytes, None) };
    let (text, rest) = bytes.split_at(start);
    let Some(end) = memchr::memchr(b'>', rest) else { return (bytes, None) };
    let (tag, data) = rest.split_at(end);
    let data = memchr::memchr(b'_', data).map_or(&data[..0], |at| &data[at + 1..]);
    (text, Some([tag, data]))
}

/// Refuses tags longer than any program writes.
fn validate_tags(text: &[u8]) -> Result<(), Mistake> {
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

/// The end of a tag.
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

/// A mistake at the line of an element.
pub fn at(node: Node<'_, '_>, what: impl Into<String>) -> Mistake {
    Mistake::at(line(node), what)
}

/// The line of an element.
pub fn line(node: Node<'_, '_>) -> usize {
    node.document().text_pos_at(node.range().start).row as usize
}

/// The first element of that name in another one.
pub fn child<'a, 'b>(node: Node<'a, 'b>, name: &str) -> Option<Node<'a, 'b>> {
    node.children().find(|child| child.has_tag_name(name))
}

/// The number in an attribute; 0 if there is no attribute.
pub fn attribute(node: Node<'_, '_>, name: &str) -> Result<usize, Mistake> {
    let text = node.attribute(name).unwrap_or("0").trim();
    let wrong = || at(node, format!("{name}=\"{text}\": expected a whole number"));
    text.parse().map_err(|_| wrong())
}
