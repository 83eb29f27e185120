//! The abilities of a solver.

use mms_spec::BodyShape;
use mms_spec::diagnostic::{Diagnostic, quoted};
use mms_spec::source::Spanned;
use mms_spec::suggest::advice;

use crate::table::{Reader, Table};

/// The abilities that a campaign file states for its solver, under the key `can`. The solver lacks all others.
#[derive(Clone, Debug, PartialEq)]
pub struct Capabilities {
    /// The dimensions, 1 to 3.
    pub dimensions: Vec<usize>,
    /// The laws, by the names of materials; by default neo-Hookean.
    pub materials: Vec<String>,
    /// The shapes of bodies, some of `BODIES`; by default boxes.
    pub bodies: Vec<String>,
    /// Whether it supports tractions on faces.
    pub tractions: bool,
    /// Whether faces can have a prescribed motion.
    pub moving_walls: bool,
    /// Whether it can start with v other than 0.
    pub start_moving: bool,
    /// Whether it can start with u other than 0.
    pub start_deformed: bool,
    /// Whether moduli or the density may depend on X.
    pub graded: bool,
    /// Whether it solves in R and Z, on bodies of revolution.
    pub axisymmetric: bool,
    /// Whether bodies can move, which is the default; otherwise all is at rest.
    pub dynamics: bool,
}

const KEYS: &[&str] = &[
    "dimensions",
    "materials",
    "bodies",
    "loads",
    "moving_walls",
    "start_moving",
    "start_deformed",
    "graded",
    "axisymmetric",
    "dynamics",
];

/// The loads that a solver may state.
const LOADS: &[&str] = &["traction"];

pub(crate) fn read(reader: &mut Reader, table: &Table<'_>) -> Option<Capabilities> {
    let value = table.value("can")?;
    let expected = "a table, as in { dimensions = [2] }";
    let table = reader.table(value, "can", expected, ("`can`", KEYS))?;
    let words = |reader: &mut Reader, key: &str, known: &[&str]| {
        let found = reader.texts(&table, key);
        found.iter().for_each(|word| validate_word(reader, key, word, known));
        found.into_iter().map(|word| word.value).collect::<Vec<_>>()
    };
    let bodies = words(reader, "bodies", &BodyShape::words());
    let loads = words(reader, "loads", LOADS);
    let materials = reader.texts(&table, "materials");
    let materials: Vec<_> = materials.into_iter().map(|word| word.value).collect();
    let or = |words: Vec<String>, usual: &str| {
        if words.is_empty() { vec![usual.to_owned()] } else { words }
    };
    let is_dimension = |it: f64| [1.0, 2.0, 3.0].contains(&it);
    let dimensions =
        reader.numbers(&table, "dimensions", "some of 1, 2 and 3, as in [2]", is_dimension);
    if table.value("dimensions").is_none() {
        reader.missing(&table, "dimensions", "dimensions = [2]");
    }
    Some(Capabilities {
        dimensions: dimensions.unwrap_or_default().into_iter().map(|it| it as usize).collect(),
        materials: or(materials, "neo_hookean"),
        bodies: or(bodies, "box"),
        tractions: !loads.is_empty(),
        moving_walls: reader.flag(&table, "moving_walls", false),
        start_moving: reader.flag(&table, "start_moving", false),
        start_deformed: reader.flag(&table, "start_deformed", false),
        graded: reader.flag(&table, "graded", false),
        axisymmetric: reader.flag(&table, "axisymmetric", false),
        dynamics: reader.flag(&table, "dynamics", true),
    })
}

/// Refuses a word that is not a known one.
pub(crate) fn validate_word(
    reader: &mut Reader,
    key: &str,
    word: &Spanned<String>,
    known: &[&str],
) {
    if known.contains(&word.value.as_str()) {
        return;
    }
    let help = advice(&word.value, known.iter().copied(), |all| format!("expected one of {all}"));
    let message = format!("`{key}`: no {}", quoted(&word.value));
    reader.report(Diagnostic::error(word.span, message).label("unknown").help(help));
}
