//! A rigid motion on top of a field: `[rigid]`, or its keys on their own.

use crate::diagnostic::Diagnostic;
use crate::document::Document;
use crate::domain::one_per_dimension;
use crate::format::{RIGID, RIGID_ALONE, ROTATION};
use crate::formula::Formula;
use crate::source::{SourceId, Sources, Span};
use crate::space::Space;
use crate::table::{Entry, Reader};

/// A prescribed rigid motion on top of the field: x -> Q x + d.
#[derive(Clone, Debug)]
pub struct RigidSpec {
    /// The rotation Q(t).
    pub rotation: Option<Rotation>,
    /// The translation d(t), one component per coordinate.
    pub translation: Option<Vec<Formula>>,
    /// The table.
    pub span: Span,
}

/// A rotation around the origin.
#[derive(Clone, Debug)]
pub enum Rotation {
    /// In the plane, by an angle.
    Plane(Formula),
    /// In space, around an axis.
    Space {
        /// The three components of the axis; its length does not matter.
        axis: Vec<Formula>,
        /// The angle.
        angle: Formula,
    },
}

impl RigidSpec {
    /// The formulas of the rotation, then of the translation.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        let rotation: &[Formula] = match &self.rotation {
            Some(Rotation::Space { axis, .. }) => axis,
            _ => &[],
        };
        rotation.iter().chain(self.angle()).chain(self.translation.iter().flatten())
    }

    /// The angle of the rotation.
    pub fn angle(&self) -> Option<&Formula> {
        match &self.rotation {
            Some(Rotation::Plane(angle) | Rotation::Space { angle, .. }) => Some(angle),
            None => None,
        }
    }
}

/// Reads a text with the single key `rigid` and its table: a motion that is in no field file.
pub fn read_rigid(
    sources: &Sources,
    id: SourceId,
    space: Space,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<RigidSpec> {
    let document = Document::parse(sources, id, diagnostics)?;
    let mut reader = Reader::new(sources, id, &document, diagnostics);
    let root = reader.root("a rigid motion", &document.root, RIGID_ALONE);
    let entry = root.get("rigid")?;
    rigid(&entry, space, &mut reader)
}

/// Reads `[rigid]`.
pub(super) fn rigid<'a>(
    entry: &Entry<'a>,
    space: Space,
    reader: &mut Reader<'a>,
) -> Option<RigidSpec> {
    let dimension = space.coordinates();
    let table = reader.table(entry, "[rigid]", RIGID)?;
    if table.entries.is_empty() {
        let message = "a rigid motion needs a `rotation`, a `translation` or both";
        reader.report(Diagnostic::error(table.span, message).label("this one has neither"));
    }
    let rotation = table.get("rotation").and_then(|entry| rotation(&entry, space, reader));
    let translation = table
        .get("translation")
        .map(|entry| reader.formulas(&entry, dimension, &one_per_dimension(dimension)));
    Some(RigidSpec { rotation, translation, span: table.span })
}

fn rotation<'a>(entry: &Entry<'a>, space: Space, reader: &mut Reader<'a>) -> Option<Rotation> {
    match space {
        Space::Axisymmetric { .. } => {
            let message = "an axisymmetric field cannot rotate";
            reader.report(
                Diagnostic::error(entry.key.span, message)
                    .label("a rigid motion of it is a translation along the axis")
                    .help("give `translation = [\"0\", \"...\"]`; a swirl turns the body about its axis"),
            );
            None
        }
        Space::Cartesian(1) => {
            let message = "a 1-dimensional field cannot rotate";
            reader.report(
                Diagnostic::error(entry.key.span, message)
                    .label("needs `dimension = 2` or `dimension = 3`"),
            );
            None
        }
        Space::Cartesian(2) => Some(Rotation::Plane(reader.formula("rotation", entry.value))),
        Space::Cartesian(_) => space_rotation(entry, reader),
    }
}

fn space_rotation<'a>(entry: &Entry<'a>, reader: &mut Reader<'a>) -> Option<Rotation> {
    if !entry.value.get_ref().is_table() {
        let instead = r#"write rotation = { axis = ["0", "0", "1"], angle = "..." }"#;
        let expected = "a table with its `axis` and `angle`";
        reader.wrong_type_because("rotation", entry.value, expected, Some(instead.into()));
        return None;
    }
    let table = reader.table(entry, "the rotation", ROTATION)?;
    let axis = reader.required_formulas(&table, "axis", 3, "expected three components");
    let angle = reader.required_formula(&table, "angle");
    Some(Rotation::Space { axis, angle })
}
