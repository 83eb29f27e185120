//! Lists of files of VTK: at times, of pieces, and of blocks.

use roxmltree::Node;
use serde_json::Value;

use super::super::text::{Style, number, times_of};
use super::super::xml::at;
use super::super::{Contents, MOST_FILES};
use crate::Mistake;
use crate::wanted::Wanted;

/// The files of the pieces of a grid.
pub fn pieces(body: Node<'_, '_>) -> Result<Contents, Mistake> {
    let files = body.children().filter(|it| it.has_tag_name("Piece"));
    Ok(Contents::Pieces(names(files, "Source")?))
}

/// The files that elements name, without duplicates.
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
    held(files)
}

/// Refuses lists without files, and lists longer than any program writes.
fn held(files: Vec<String>) -> Result<Vec<String>, Mistake> {
    match files.len() {
        0 => Err(Mistake::new("the list has no files")),
        count if count > MOST_FILES => {
            Err(Mistake::new(format!("a list of more than {MOST_FILES} files")))
        }
        _ => Ok(files),
    }
}

/// The files of blocks at any depth; blocks without a file are empty.
pub fn blocks(body: Node<'_, '_>) -> Result<Contents, Mistake> {
    let is_one = |it: &Node<'_, '_>| it.has_tag_name("DataSet") && it.has_attribute("file");
    Ok(Contents::Blocks(names(body.descendants().filter(is_one), "file")?))
}

/// The files of a collection, by their times.
pub fn times(body: Node<'_, '_>) -> Result<Contents, Mistake> {
    let sets = || body.children().filter(|it| it.has_tag_name("DataSet"));
    let files = names(sets(), "file")?;
    let times: Vec<_> = sets().map(|it| it.attribute("timestep").unwrap_or("")).collect();
    timed(&times, files).map_err(|(which, what)| match sets().nth(which) {
        Some(node) => at(node, what),
        None => Mistake::new(what),
    })
}

/// Files with their times as written; or the index of a mistaken time, and the reason.
fn timed(times: &[&str], files: Vec<String>) -> Result<Contents, (usize, String)> {
    let time = |(which, text): (usize, &&str)| {
        let value = number(text).filter(|it| it.is_finite());
        let value = value.ok_or((which, format!("timestep `{text}`: expected a time")))?;
        let mut style = Style::default();
        style.see(text);
        Ok((value, style.stored()))
    };
    let found = times.iter().enumerate().map(time).collect::<Result<Vec<_>, _>>()?;
    let mut times: Vec<_> = times_of(&found).zip(files).collect();
    times.sort_by(|a, b| a.0.value.total_cmp(&b.0.value));
    Ok(Contents::Times(times))
}

/// The most bytes of memory for one byte of JSON: a value of three bytes needs up to eighty, while its list grows.
const OF_JSON: usize = 80;

/// Whether a text may be a list of files that ParaView reads as a series.
pub fn is_series(text: &[u8]) -> bool {
    text.starts_with(b"{")
}

/// Reads a series of ParaView: files with their times, in JSON ("ParaView Reference Manual", file series).
pub fn series(text: &[u8], wanted: &Wanted<'_>) -> Result<Contents, Mistake> {
    let wrong = |what: &str| {
        Mistake::new(format!(
            "{what}: expected a series of files, as {{\"files\": [{{\"name\": \"a.vtu\", \"time\": 0.5}}]}}"
        ))
    };
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let parse = || {
        serde_json::from_slice::<Value>(text)
            .map_err(|error| Mistake::at(error.line(), format!("not JSON: {error}")))
    };
    let found = wanted.with_reserved(text.len().saturating_mul(OF_JSON), parse)?;
    let all = found.get("files").and_then(Value::as_array);
    let all = all.ok_or_else(|| wrong("no list `files`"))?;
    let names = all.iter().map(|it| it.get("name")?.as_str().map(str::to_owned));
    let names: Option<Vec<String>> = names.collect();
    let files = held(names.ok_or_else(|| wrong("a file without a name"))?)?;
    let times: Option<Vec<String>> =
        all.iter().map(|it| Some(it.get("time")?.as_number()?.to_string())).collect();
    let times = times.ok_or_else(|| wrong("a file without a time"))?;
    let times: Vec<&str> = times.iter().map(String::as_str).collect();
    timed(&times, files).map_err(|(_, what)| Mistake::new(what))
}
