//! The profile of a code: the names of quantities in its files.
//!
//! ```toml
//! source = "the public description that this file follows"
//! points = "X"                          # or "x"; used if the points lie in the body both as X and as x
//! orders = ["11,22,33,12,23,13"]        # of symmetric tensors whose components have no names
//!
//! [quantities]                          # names of arrays, the usual one first
//! u = ["DISP", "U"]
//! sigma = "STRESS"
//! ```

use mms_spec::source::Spanned;

use crate::file::Mistakes;
use crate::table::{Reader, Value, each};

/// The rows and columns of a tensor's entries, counted from 0, in the order of an array's components.
pub type ComponentOrder = Vec<(usize, usize)>;

/// A profile; `R` is the caller's type of quantities.
#[derive(Clone, Debug)]
pub struct Profile<R> {
    /// The meaning of positions for which both readings lie in the body.
    pub points: Option<R>,
    /// The names of arrays.
    pub quantities: Vec<(R, Vec<String>)>,
    /// The orders of components.
    pub orders: Vec<ComponentOrder>,
}

/// Parses a text; messages show `path` as its path. `role` returns a quantity, or the expected names.
///
/// # Errors
/// Every mistake, at its place.
pub fn read<R>(
    path: &str,
    text: &str,
    role: &dyn Fn(&str) -> Result<R, String>,
) -> Result<Profile<R>, Mistakes> {
    let (mut reader, root) = Reader::new(path, text);
    let keys = ["source", "points", "orders", "quantities"];
    let table = reader.root(root.get_ref(), "a profile", &keys);
    if reader.text(&table, "source").is_none() && table.value("source").is_none() {
        reader.missing(
            &table,
            "source",
            "source = \"the public description that the names are from\"",
        );
    }
    let points = reader.text(&table, "points").and_then(|word| match word.value.as_str() {
        "X" | "x" => role(&word.value).ok(),
        _ => {
            reader.expect(
                word.span,
                "points",
                "\"X\", the reference position, or \"x\", the present one",
            );
            None
        }
    });
    let orders = reader.texts(&table, "orders");
    let orders = orders.iter().filter_map(|word| order(&mut reader, word)).collect();
    let quantities = match table.value("quantities") {
        Some(value) => quantities(&mut reader, value, role),
        None => Vec::new(),
    };
    let profile = Profile { points, quantities, orders };
    let Reader { sources, diagnostics, .. } = reader;
    match diagnostics.is_empty() {
        true => Ok(profile),
        false => Err(Mistakes { subject: "the profile", sources, diagnostics }),
    }
}

fn quantities<R>(
    reader: &mut Reader,
    value: &Value<'_>,
    role: &dyn Fn(&str) -> Result<R, String>,
) -> Vec<(R, Vec<String>)> {
    let expected = "a table, [quantities]";
    let entries = reader.of_value(value, "quantities", expected, |_| value.get_ref().as_table());
    let Some(entries) = entries else { return Vec::new() };
    let mut found = Vec::new();
    for (key, names) in entries.iter() {
        let listed = texts(names);
        match (role(key.get_ref()), listed) {
            (Ok(role), Some(names)) => found.push((role, names)),
            (Err(expected), _) => reader.expect(reader.span(key), key.get_ref(), &expected),
            (_, None) => {
                let expected = "the name of an array, or an array of names, the usual one first";
                reader.expect(reader.span(names), key.get_ref(), expected);
            }
        }
    }
    found
}

/// A text, or an array of texts.
fn texts(value: &Value<'_>) -> Option<Vec<String>> {
    let text = |value: &Value<'_>| value.get_ref().as_str().map(str::to_owned);
    each(value, text).or_else(|| text(value).map(|it| vec![it]))
}

/// The entries that a text such as `11,22,33,12` lists.
fn order(reader: &mut Reader, word: &Spanned<String>) -> Option<ComponentOrder> {
    let entry = |text: &str| match text.trim().as_bytes() {
        [row @ b'1'..=b'3', column @ b'1'..=b'3'] => {
            Some((usize::from(row - b'1'), usize::from(column - b'1')))
        }
        _ => None,
    };
    let found: Option<ComponentOrder> = word.value.split(',').map(entry).collect();
    if found.is_none() {
        let expected = "entries of a tensor by row and column, as in \"11,22,33,12,23,13\"";
        reader.expect(word.span, "orders", expected);
    }
    found
}
