//! `[[study]]`: the order of convergence that a method must show on a field.

use crate::diagnostic::Diagnostic;
use crate::foreign::Foreign;
use crate::form::Form;
use crate::source::Span;
use crate::table::{Reader, Table};
use crate::value::plural;

/// The shape functions that a study may name.
pub const SHAPES: &[&str] =
    &["linear", "ugimp", "cpgimp", "cpdi", "quadratic_bspline", "cubic_bspline"];

/// The time integrators that a study may name.
pub const INTEGRATORS: &[&str] = &["usf", "usl", "musl", "leapfrog"];

/// The formulations that a study may name.
pub const FORMULATIONS: &[&str] = &["updated", "total"];

/// The transfers that a study may name; XPIC has its order in its name.
pub const TRANSFERS: &[&str] = &["flip", "pic", "apic", "xpic2", "xpic3", "xpic4", "xpic5"];

/// The ways to fill a body with particles that a study may name.
pub const FILLS: &[&str] = &["cartesian", "fitted"];

/// The precisions that a study may name.
pub const PRECISIONS: &[&str] = &["f32", "f64"];

/// The forms of the forcing that a study may name.
pub const FORMS: &[&str] = &[Form::Stable.name(), Form::Fast.name()];

/// A method and the order it must show. A member that is `None` or empty has the command's default.
#[derive(Clone, Debug)]
pub struct StudySpec {
    /// The shape function, one of [`SHAPES`].
    pub shape: String,
    /// The time integrator, one of [`INTEGRATORS`].
    pub integrator: String,
    /// The formulation, one of [`FORMULATIONS`].
    pub formulation: Option<String>,
    /// The transfer, one of [`TRANSFERS`].
    pub transfer: Option<String>,
    /// The Courant number.
    pub courant: Option<f64>,
    /// Particles per cell and direction.
    pub particles_per_cell: Option<usize>,
    /// How the body is filled, one of [`FILLS`].
    pub fill: Option<String>,
    /// The solver's precision, one of [`PRECISIONS`].
    pub precision: Option<String>,
    /// How the field's quantities are computed, one of [`FORMS`].
    pub form: Option<String>,
    /// Cells along the longest edge on each level, coarse to fine.
    pub cells: Vec<usize>,
    /// The expected order.
    pub order: f64,
    /// The largest allowed difference of the observed order.
    pub tolerance: Option<f64>,
    /// The reason for expecting this order.
    pub reason: Option<Foreign>,
    /// The table.
    pub span: Span,
}

impl StudySpec {
    /// Whether the order belongs to this method.
    pub fn is_of(&self, shape: &str, integrator: &str, formulation: &str) -> bool {
        self.shape == shape && self.integrator == integrator && self.formulation() == formulation
    }

    fn formulation(&self) -> &str {
        self.formulation.as_deref().unwrap_or(DEFAULT_FORMULATION)
    }
}

/// The defaults of the command for choices that a study leaves open.
const DEFAULT_SHAPE: &str = "cpgimp";
const DEFAULT_INTEGRATOR: &str = "leapfrog";
const DEFAULT_FORMULATION: &str = "updated";
const DEFAULT_ORDER: f64 = 2.0;

/// Reads every `[[study]]`.
pub(super) fn studies<'a>(tables: &[Table<'a>], reader: &mut Reader<'a>) -> Vec<StudySpec> {
    let mut studies: Vec<StudySpec> = Vec::new();
    for table in tables {
        let study = study(table, reader);
        let StudySpec { shape, integrator, .. } = &study;
        let earlier =
            studies.iter().find(|earlier| earlier.is_of(shape, integrator, study.formulation()));
        if let Some(earlier) = earlier
            && (earlier.order, earlier.tolerance) != (study.order, study.tolerance)
        {
            let method = format!("`{shape}` with `{integrator}`");
            let message = format!("another study gives {method} another order or tolerance");
            let found =
                Diagnostic::error(table.span, message).label("the first one counts for both");
            reader.report(found.help("give both the same order and tolerance"));
        }
        studies.push(study);
    }
    studies
}

/// Reads one `[[study]]`.
fn study<'a>(table: &Table<'a>, reader: &mut Reader<'a>) -> StudySpec {
    let mut word = |key: &str, what: &str, words: &[&str]| {
        let entry = table.get(key)?;
        reader.word(&entry, what, words).map(|word| word.value)
    };
    let shape = word("shape", "shape function", SHAPES);
    let integrator = word("integrator", "time integrator", INTEGRATORS);
    let formulation = word("formulation", "formulation", FORMULATIONS);
    let transfer = word("transfer", "transfer", TRANSFERS);
    let fill = word("fill", "fill", FILLS);
    let precision = word("precision", "precision", PRECISIONS);
    let form = word("form", "form", FORMS);
    let mut positive = |key: &str| reader.positive(&table.get(key)?);
    let (courant, order, tolerance) =
        (positive("courant"), positive("order"), positive("tolerance"));
    let particles_per_cell = table
        .get("particles_per_cell")
        .and_then(|entry| reader.count("particles_per_cell", entry.value));
    StudySpec {
        shape: shape.unwrap_or_else(|| DEFAULT_SHAPE.into()),
        integrator: integrator.unwrap_or_else(|| DEFAULT_INTEGRATOR.into()),
        formulation,
        transfer,
        courant,
        particles_per_cell,
        fill,
        precision,
        form,
        cells: cells(table, reader).unwrap_or_default(),
        order: order.unwrap_or(DEFAULT_ORDER),
        tolerance,
        reason: reader.optional_foreign(table, "reason"),
        span: table.span,
    }
}

fn cells<'a>(table: &Table<'a>, reader: &mut Reader<'a>) -> Option<Vec<usize>> {
    let entry = table.get("cells")?;
    let Some(items) = entry.value.get_ref().as_array() else {
        reader.wrong_type("cells", entry.value, "an array of whole numbers");
        return None;
    };
    let mut cells = Vec::new();
    for item in items {
        cells.push(reader.count("cells", item)?);
    }
    let span = reader.span(entry.value);
    if cells.len() < 2 {
        let message = format!("a study needs two levels or more, found {}", cells.len());
        let label = format!("{} shows no order", plural(cells.len(), "level"));
        reader.report(Diagnostic::error(span, message).label(label));
    } else if let Some(pair) = cells.windows(2).find(|pair| pair[0] >= pair[1]) {
        let message = format!("`cells` must increase, but {} follows {}", pair[1], pair[0]);
        reader.report(Diagnostic::error(span, message).label("order the levels coarse to fine"));
    }
    Some(cells)
}
