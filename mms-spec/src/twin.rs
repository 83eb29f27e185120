//! The rigid twin of a field, on demand: the field under a superposed rigid motion x* = Q x + d, which its file does not
//! contain. It is a test of objectivity.
//!
//! A twin is a different solution of the same equations. Claims that a rigid motion preserves stay: a free face stays free,
//! while a face at rest moves, and its displacement is prescribed. Closed forms apply to the field without the motion, and are
//! omitted.

use crate::boundary::Claim;
use crate::diagnostic::Diagnostic;
use crate::domain::{BodySpec, Polygon};
use crate::field::FieldSpec;
use crate::formula::Formula;
use crate::rigid::read_rigid;
use crate::source::Sources;
use crate::space::Space;

/// A rigid motion on top of a field.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Twin {
    /// No motion.
    #[default]
    Nothing,
    /// A motion that is large and accelerated in every way: in the time window of the field it turns by two radians, and moves
    /// the body by a few times its size. See [`Twin::text`].
    Standard,
    /// The keys of `[rigid]`, as in `rotation = "pi*t", translation = ["t", "0"]`.
    Given(String),
}

impl Twin {
    /// The keys of `[rigid]` for the motion of a field. With s the elapsed fraction of the time window, and L the length of the
    /// body along X, its outer radius, or its first edge, the standard motion is:
    ///
    /// - in one dimension the translation 3 L s^2,
    /// - in two dimensions the angle s + s^2 and the translation 3 L s, -2 L s^2,
    /// - in three dimensions the same about the axis 2, -1, 2, and L s (2 - s) along Z,
    /// - for an axisymmetric field the translation 3 L s^2 along the axis.
    ///
    /// `None` if there is no motion, or if the body or the window of the field could not be read.
    pub fn text(&self, field: &FieldSpec) -> Option<String> {
        let keys = match self {
            Twin::Nothing => return None,
            Twin::Given(keys) => keys.clone(),
            Twin::Standard => standard(field)?,
        };
        Some(keys)
    }

    /// Adds the motion to a field. Its text becomes a source of its own.
    pub fn apply(
        &self,
        sources: &mut Sources,
        field: &mut FieldSpec,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        if *self == Twin::Standard && field.is_static() {
            diagnostics.push(
                Diagnostic::error(field.material.span, "a static field has no standard twin")
                    .label("the field has no time in which it could turn")
                    .help("give a constant rotation, as in --rigid 'rotation = \"0.5\"'"),
            );
            return;
        }
        if *self == Twin::Standard && field.domain.body.is_nothing() {
            diagnostics.push(
                Diagnostic::error(
                    field.material.span,
                    "a field without a body has no standard twin",
                )
                .label("its translation is a multiple of the size of the body")
                .help("give a motion, as in --rigid 'rotation = \"pi*t\"'"),
            );
            return;
        }
        let Some(keys) = self.text(field) else { return };
        let source = sources.add("rigid", format!("rigid = {{ {keys} }}"));
        if let Some(rigid) = &field.rigid {
            diagnostics.push(
                Diagnostic::error(rigid.span, "the field has a rigid motion already")
                    .label("its own")
                    .help("remove [rigid], or ask for the field as it is"),
            );
            return;
        }
        let Some(rigid) = read_rigid(sources, source, field.space, diagnostics) else { return };
        field.rigid = Some(rigid);
        for boundary in &mut field.boundary {
            if matches!(boundary.claim.value, Claim::Fixed | Claim::Roller) {
                boundary.claim.value = Claim::Prescribed;
            }
        }
        field.checks.clear();
    }
}

fn standard(field: &FieldSpec) -> Option<String> {
    let [first, last] = field.domain.time.as_ref()?.each_ref().map(term);
    let (first, last) = (first?, last?);
    let s = match first.as_str() {
        "0" => format!("t/{last}"),
        _ => format!("(t - {first})/({last} - {first})"),
    };
    let size = match &field.domain.body {
        BodySpec::Box { lower, upper } => {
            let [lower, upper] = [lower, upper].map(|corner| corner.first().and_then(term));
            let (lower, upper) = (lower?, upper?);
            if lower == "0" { upper } else { format!("({upper} - {lower})") }
        }
        BodySpec::Round(round) => term(&round.outer)?,
        BodySpec::Polygon(polygon) => first_edge(polygon)?,
        BodySpec::Nothing => return None,
    };
    Some(match field.space {
        Space::Axisymmetric { .. } => format!(r#"translation = ["0", "3*{size}*({s})^2"]"#),
        Space::Cartesian(1) => format!(r#"translation = ["3*{size}*({s})^2"]"#),
        Space::Cartesian(2) => format!(
            r#"rotation = "{s} + ({s})^2", translation = ["3*{size}*{s}", "-2*{size}*({s})^2"]"#
        ),
        _ => format!(
            r#"rotation = {{ axis = ["2", "-1", "2"], angle = "{s} + ({s})^2" }}, translation = ["3*{size}*{s}", "-2*{size}*({s})^2", "{size}*{s}*(2 - {s})"]"#
        ),
    })
}

/// The length of the first edge.
fn first_edge(polygon: &Polygon) -> Option<String> {
    let [from, to] = polygon.vertices.first_chunk()?;
    let along = |axis: usize| Some(format!("{} - {}", term(&to[axis])?, term(&from[axis])?));
    Some(format!("hypot({}, {})", along(0)?, along(1)?))
}

/// A formula as an operand, on one line: names and numbers without parentheses. `None` if a mistake in it has been reported.
fn term(formula: &Formula) -> Option<String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let words = || formula.text.split_whitespace().collect::<Vec<_>>().join(" ");
    let operand = || match formula.text.chars().all(plain) {
        true => formula.text.clone(),
        false => format!("({})", words()),
    };
    (!formula.is_reported()).then(operand)
}
