//! The derivation of a field, as `mms show` prints it.

use mms_exact::quantities;
use mms_mechanics::TooLarge;
use mms_show::{Document, latex, mathml, text};
use pyo3::prelude::*;

use crate::mistake::mistake;
use crate::opened::Opened;

/// The quantities that are shown where none is named: the motion, and the force that makes it a solution.
const USUAL: [&str; 2] = ["displacement", "body_force_density"];

/// The derivation of some quantities, as text, in LaTeX, or as a part of a page of HTML.
pub fn show(opened: &Opened, names: &[String], format: &str) -> PyResult<String> {
    let write = match format {
        "text" => text::page,
        "latex" => latex::page,
        "html" => |document: &Document| mathml::part(document, 4),
        _ => return Err(mistake(format!("`format` is {format:?}: expected text, latex or html"))),
    };
    let usual = || USUAL.map(String::from).to_vec();
    let names = if names.is_empty() { usual() } else { names.to_vec() };
    let input = &opened.input;
    let found = quantities(&input.own_quantities(), &names)
        .and_then(|found| input.offered(&names, found))
        .map_err(|error| mistake(format!("{error:#}")))?;
    let document = Document::new(&input.compiled, &found).map_err(|TooLarge(what)| {
        let name = input.name.shown();
        mistake(format!("the {what} of `{name}` has too many terms; ask for one quantity"))
    })?;
    Ok(write(&document))
}
