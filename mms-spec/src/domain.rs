//! `[domain]`: the body and the time window of a field.

use crate::boundary::Face;
use crate::diagnostic::{Diagnostic, quoted};
use crate::format::DOMAIN;
use crate::formula::Formula;
use crate::interned::interned;
use crate::language::SCOPE;
use crate::names::MAX_NAME;
use crate::source::{Span, Spanned};
use crate::space::Space;
use crate::suggest::did_you_mean;
use crate::table::{Entry, Reader, Table};
use crate::value::{plural, unknown_word};

/// The shape of the reference body.
#[derive(Clone, Debug)]
pub enum BodySpec {
    /// A box with edges along the axes.
    Box {
        /// The least coordinates, one per dimension.
        lower: Vec<Formula>,
        /// The greatest coordinates, one per dimension.
        upper: Vec<Formula>,
    },
    /// A body between two circles, cylinders or spheres around the origin, or a sector of it.
    Round(Box<Round>),
    /// A polygon in the plane.
    Polygon(Polygon),
    /// No body: the field is only evaluated, and makes no claims about faces.
    Nothing,
}

/// A body around the origin.
#[derive(Clone, Debug)]
pub struct Round {
    /// The shape.
    pub shape: &'static BodyShape,
    /// The inner radius; a disk has none.
    pub inner: Option<Formula>,
    /// The outer radius.
    pub outer: Formula,
    /// The angles between which a sector lies; without them it is a full ring.
    pub theta: Option<[Formula; 2]>,
    /// The ends of a cylinder.
    pub z: Option<[Formula; 2]>,
    /// The angles from +Z between which a part of a sphere lies; from 0 to pi without them.
    pub phi: Option<[Formula; 2]>,
}

impl Round {
    /// The pairs of bounds of the body besides the radii.
    pub fn pairs(&self) -> impl Iterator<Item = &[Formula; 2]> {
        [&self.theta, &self.z, &self.phi].into_iter().flatten()
    }

    /// All formulas.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        self.inner.iter().chain([&self.outer]).chain(self.pairs().flatten())
    }

    /// The faces that the keys define, in a fixed order.
    pub(super) fn declared(&self) -> Vec<Face> {
        [
            (Face::Inner, self.inner.is_some()),
            (Face::Outer, true),
            (Face::ThetaMin, self.theta.is_some()),
            (Face::ThetaMax, self.theta.is_some()),
            (Face::Min(2), self.z.is_some()),
            (Face::Max(2), self.z.is_some()),
            (Face::PhiMin, self.phi.is_some()),
            (Face::PhiMax, self.phi.is_some()),
        ]
        .into_iter()
        .filter_map(|(face, is_there)| is_there.then_some(face))
        .collect()
    }

    /// Whether a face has an area, judging by its key: false if the radius is written as 0, or the angle as 0 or pi.
    pub(super) fn has_area(&self, face: Face) -> bool {
        let is_axis =
            |at: usize| self.phi.as_ref().is_some_and(|phi| phi[at].text.trim() == ["0", "pi"][at]);
        match face {
            Face::Inner => !self.inner.as_ref().is_some_and(is_zero),
            Face::PhiMin => !is_axis(0),
            Face::PhiMax => !is_axis(1),
            _ => true,
        }
    }
}

/// Whether a formula is a bare 0.
pub(super) fn is_zero(formula: &Formula) -> bool {
    formula.text.trim().parse::<f64>() == Ok(0.0)
}

/// A polygon.
#[derive(Clone, Debug)]
pub struct Polygon {
    /// The vertices, in their order around it.
    pub vertices: Vec<[Formula; 2]>,
    /// The names of the edges: the first runs from the first vertex to the second.
    pub names: Vec<&'static str>,
    /// The place of the vertices in the file.
    pub span: Span,
}

/// A shape of a body: its keys in `[domain]`, and the dimension that it needs.
#[derive(Debug, PartialEq, Eq)]
pub struct BodyShape {
    /// The word for the shape in a field file.
    pub name: &'static str,
    /// The word with its article.
    pub noun: &'static str,
    /// The dimension of a field on this shape; any dimension if `None`.
    pub dimension: Option<usize>,
    /// The required keys.
    pub required: &'static [&'static str],
    /// The optional keys.
    pub optional: &'static [&'static str],
    /// The keys in words.
    has: &'static str,
}

/// The shapes of bodies.
pub const BODIES: &[BodyShape] = &[
    BodyShape {
        name: "box",
        noun: "a box",
        dimension: None,
        required: &["lower", "upper"],
        optional: &[],
        has: "`lower` and `upper`",
    },
    BodyShape {
        name: "annulus",
        noun: "an annulus",
        dimension: Some(2),
        required: &["inner", "outer"],
        optional: &["theta"],
        has: "`inner`, `outer` and, for a sector, `theta`",
    },
    BodyShape {
        name: "disk",
        noun: "a disk",
        dimension: Some(2),
        required: &["outer"],
        optional: &["theta"],
        has: "`outer` and, for a sector, `theta`",
    },
    BodyShape {
        name: "cylinder",
        noun: "a cylinder",
        dimension: Some(3),
        required: &["inner", "outer", "z"],
        optional: &["theta"],
        has: "`inner`, `outer`, `z` and, for a sector, `theta`",
    },
    BodyShape {
        name: "sphere",
        noun: "a sphere",
        dimension: Some(3),
        required: &["inner", "outer"],
        optional: &["theta", "phi"],
        has: "`inner`, `outer` and, for a part of it, `theta` and `phi`",
    },
    BodyShape {
        name: "polygon",
        noun: "a polygon",
        dimension: Some(2),
        required: &["vertices"],
        optional: &["names"],
        has: "`vertices` and, for its edges, `names`",
    },
    BodyShape {
        name: "none",
        noun: "a field without a body",
        dimension: None,
        required: &[],
        optional: &[],
        has: "no other key than `time`",
    },
];

/// The keys of `[domain]` that define a body.
pub const BODY_KEYS: &[&str] =
    &["lower", "upper", "inner", "outer", "theta", "z", "phi", "vertices", "names"];

/// The largest number of vertices of a polygon.
pub const MAX_VERTICES: usize = 256;

impl BodyShape {
    /// The shape with this name.
    pub fn named(name: &str) -> Option<&'static BodyShape> {
        BODIES.iter().find(|shape| shape.name == name)
    }

    /// The words for all shapes.
    pub fn words() -> Vec<&'static str> {
        BODIES.iter().map(|shape| shape.name).collect()
    }
}

impl BodySpec {
    /// The word for the shape in a field file.
    pub fn name(&self) -> &'static str {
        match self {
            BodySpec::Box { .. } => "box",
            BodySpec::Round(round) => round.shape.name,
            BodySpec::Polygon(_) => "polygon",
            BodySpec::Nothing => "none",
        }
    }

    /// Whether there is no body.
    pub fn is_nothing(&self) -> bool {
        matches!(self, BodySpec::Nothing)
    }

    /// The formulas that define the body.
    pub fn formulas(&self) -> Vec<&Formula> {
        match self {
            BodySpec::Box { lower, upper } => lower.iter().chain(upper).collect(),
            BodySpec::Round(round) => round.formulas().collect(),
            BodySpec::Polygon(polygon) => polygon.vertices.iter().flatten().collect(),
            BodySpec::Nothing => Vec::new(),
        }
    }
}

/// The reference body and the time window that all claims are about.
#[derive(Clone, Debug)]
pub struct DomainSpec {
    /// The reference body.
    pub body: BodySpec,
    /// The first and the last time; none for a static field.
    pub time: Option<[Formula; 2]>,
    /// Whether the window replaces the file's: then a number is in the unit of t.
    pub is_moved: bool,
}

/// A domain without content, in place of one whose absence has been reported.
pub(super) fn reported(dimension: usize, span: Span) -> DomainSpec {
    let corner = vec![Formula::reported(span); dimension];
    let body = BodySpec::Box { lower: corner.clone(), upper: corner };
    let time = Some([Formula::reported(span), Formula::reported(span)]);
    DomainSpec { body, time, is_moved: false }
}

/// Reads `[domain]`.
pub(super) fn domain<'a>(entry: &Entry<'a>, space: Space, reader: &mut Reader<'a>) -> DomainSpec {
    let dimension = space.coordinates();
    let Some(table) = reader.table(entry, "[domain]", DOMAIN) else {
        return reported(dimension, reader.span(entry.value));
    };
    let shape = reader.required(&table, "shape");
    let named = shape.as_ref().and_then(|shape| word_of_shape(shape, reader));
    let shape = named.as_ref().and_then(|named| BodyShape::named(&named.value));
    let shape = shape.unwrap_or_else(|| meant(&table, dimension));
    if let (Some(named), Some(needed)) = (&named, shape.dimension)
        && needed != dimension
    {
        let noun = shape.noun;
        let message = format!("{noun} is {needed}-dimensional, but the field is {dimension}-D");
        let label = format!("needs `dimension = {needed}`");
        reader.report(Diagnostic::error(named.span, message).label(label));
    } else if let (Some(named), true) = (&named, space.is_axisymmetric() && shape.is_bent()) {
        let message = format!("{} is no body of an axisymmetric field", shape.noun);
        let label = "expected `box`, between bounds of R and Z, or `none`";
        reader.report(Diagnostic::error(named.span, message).label(label));
    }
    for key in BODY_KEYS.iter().filter(|key| !shape.has_key(key)) {
        reader.refuse(&table, key, &format!("{} has {}", shape.noun, shape.has));
    }
    let body = match shape.name {
        "box" => cuboid(&table, dimension, reader),
        "polygon" => BodySpec::Polygon(polygon(&table, reader)),
        "none" => BodySpec::Nothing,
        _ => round(&table, shape, reader),
    };
    // A lost or misspelt key is not missing.
    let is_lost = reader.is_incomplete() || table.misspelt.contains(&"time");
    let time = match table.get("time") {
        Some(time) => Some(reader.pair(&time, "expected the first and the last time")),
        None if is_lost => Some([Formula::reported(table.span), Formula::reported(table.span)]),
        None => None,
    };
    DomainSpec { body, time, is_moved: false }
}

/// The word for a shape. A word that is far from all shapes may mean a body that is out of scope.
fn word_of_shape<'a>(entry: &Entry<'a>, reader: &mut Reader<'a>) -> Option<Spanned<String>> {
    let (found, words) = (reader.string(entry)?, BodyShape::words());
    if BodyShape::named(&found.value).is_some() {
        return Some(found);
    }
    let unknown = unknown_word(&found, "shape", &words);
    let is_near = did_you_mean(&found.value, words).is_some();
    let hint = format!("other bodies and their alternatives: {SCOPE}");
    reader.report(if is_near { unknown } else { unknown.help(hint) });
    None
}

/// The shape that the keys indicate, if there is no valid word.
fn meant(table: &Table<'_>, dimension: usize) -> &'static BodyShape {
    let has = |key: &str| table.get(key).is_some();
    let name = match () {
        () if has("vertices") => "polygon",
        () if has("z") => "cylinder",
        () if has("phi") => "sphere",
        () if (has("inner") || has("outer")) && dimension == 3 => "sphere",
        () if has("inner") || has("outer") => "annulus",
        () => "box",
    };
    BodyShape::named(name).unwrap_or(&BODIES[0])
}

impl BodyShape {
    /// Whether the shape has other faces than a box.
    fn is_bent(&self) -> bool {
        !matches!(self.name, "box" | "none")
    }

    fn has_key(&self, key: &str) -> bool {
        self.required.contains(&key) || self.optional.contains(&key)
    }
}

fn cuboid<'a>(table: &Table<'a>, dimension: usize, reader: &mut Reader<'a>) -> BodySpec {
    let reason = one_per_dimension(dimension);
    BodySpec::Box {
        lower: reader.required_formulas(table, "lower", dimension, &reason),
        upper: reader.required_formulas(table, "upper", dimension, &reason),
    }
}

fn round<'a>(table: &Table<'a>, shape: &'static BodyShape, reader: &mut Reader<'a>) -> BodySpec {
    let is_required = |key: &str| shape.required.contains(&key);
    let inner = is_required("inner").then(|| reader.required_formula(table, "inner"));
    let outer = reader.required_formula(table, "outer");
    let mut pair = |key: &str, reason: &str| match table.get(key).filter(|_| shape.has_key(key)) {
        Some(entry) => Some(reader.pair(&entry, reason)),
        None if is_required(key) => {
            let mut ends = reader.required_formulas(table, key, 2, reason).into_iter();
            Some(std::array::from_fn(|_| {
                ends.next().unwrap_or_else(|| Formula::reported(table.span))
            }))
        }
        None => None,
    };
    let angles = "expected the first and the last angle";
    let (theta, phi) = (pair("theta", angles), pair("phi", angles));
    let z = pair("z", "expected the lower and the upper end");
    BodySpec::Round(Box::new(Round { shape, inner, outer, theta, z, phi }))
}

fn polygon<'a>(table: &Table<'a>, reader: &mut Reader<'a>) -> Polygon {
    let entry = reader.required(table, "vertices");
    let span = entry.as_ref().map_or(table.span, |entry| reader.span(entry.value));
    let read = entry.and_then(|entry| reader.pairs(&entry, "vertices"));
    let is_known = read.is_some();
    let vertices = read.unwrap_or_default();
    let count = vertices.len();
    if is_known && !(3..=MAX_VERTICES).contains(&count) {
        let message = format!("a polygon of {}", plural_vertices(count));
        let label = format!("expected from 3 to {MAX_VERTICES}");
        reader.report(Diagnostic::error(span, message).label(label));
    }
    let usual = || (1..=count).map(|number| interned(&format!("edge_{number}"))).collect();
    let names = match table.get("names") {
        Some(entry) => edges(&entry, is_known.then_some(count), reader).unwrap_or_else(usual),
        None => usual(),
    };
    Polygon { vertices, names, span }
}

fn plural_vertices(count: usize) -> String {
    if count == 1 { "1 vertex".into() } else { format!("{count} vertices") }
}

/// The names of edges, if they are all different and as many as the edges.
fn edges<'a>(
    entry: &Entry<'a>,
    count: Option<usize>,
    reader: &mut Reader<'a>,
) -> Option<Vec<&'static str>> {
    let names = reader.strings(entry)?;
    if let Some(count) = count.filter(|count| *count != names.len()) {
        let message = format!("`names` has {}, expected {count}", plural(names.len(), "name"));
        let label =
            "a polygon has as many edges as vertices; the first runs from the first to the second";
        reader.report(Diagnostic::error(reader.span(entry.value), message).label(label));
        return None;
    }
    let mut known: Vec<&'static str> = Vec::new();
    for name in &names {
        let text = name.value.as_str();
        let is_lower = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        let is_name = text.starts_with(|c: char| c.is_ascii_lowercase())
            && text.chars().all(is_lower)
            && text.len() <= MAX_NAME;
        let shown = quoted(text);
        let wrong = match () {
            () if !is_name => Some((
                format!("{shown} is no name of an edge"),
                "expected a small letter, then small letters, digits and `_`",
            )),
            () if known.contains(&text) => {
                Some((format!("the name {shown} is given to two edges"), "choose another name"))
            }
            () => None,
        };
        match wrong {
            Some((message, label)) => {
                reader.report(Diagnostic::error(name.span, message).label(label));
                return None;
            }
            None => known.push(interned(text)),
        }
    }
    Some(known)
}

/// The reason for the number of coordinates of a point, for messages.
pub(super) fn one_per_dimension(dimension: usize) -> String {
    format!("a {dimension}-D field has {}", plural(dimension, "component"))
}

/// The reason for the number of components of a vector, for messages.
pub(super) fn one_per_direction(space: Space) -> String {
    match space {
        Space::Cartesian(dimension) => one_per_dimension(dimension),
        Space::Axisymmetric { swirl } => {
            let others = if swirl { "R, Z and theta" } else { "R and Z" };
            format!("a vector of this field has the components {others}")
        }
    }
}
