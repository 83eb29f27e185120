//! The text of a new field file.
//!
//! `template.toml` is one text for all field files. A line `1| ...` is for bodies of one dimension only, `23| ...` for bodies
//! of two and three, `o| ...` for the annulus, and with an `n`, as in `2n| ...`, for the neo-Hookean material only. Words such
//! as `@name@` are filled in; lists come from the lists that the reader of field files uses.

use anyhow::bail;
use mms_codegen::materials::MATERIALS;
use mms_spec::foreign::Foreign;
use mms_spec::language::FUNCTIONS;
use mms_spec::suggest::advice;
use mms_spec::{
    FILLS, FORMS, FORMULATIONS, INTEGRATORS, MaterialSpec, PRECISIONS, SHAPES, TRANSFERS,
};

use crate::gallery;

/// The text, with the lines of all variants.
const TEMPLATE: &str = include_str!("template.toml");

/// The material whose stress the closed forms in the template were derived for.
pub const NEO_HOOKEAN: &str = "neo_hookean";

/// The names that the template defines: a parameter of a material gets another one.
pub const TAKEN: &[&str] = &[
    "length",
    "inner",
    "outer",
    "amplitude",
    "period",
    "rho0",
    "A",
    "k",
    "R",
    "U",
    "w_X",
    "w_Y",
    "w_Z",
    "dU",
];

/// The shape of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Body {
    /// A box with edges along the axes.
    #[default]
    Box,
    /// The region between two circles, in the plane.
    Annulus,
}

impl Body {
    /// All shapes.
    pub const ALL: [Self; 2] = [Body::Box, Body::Annulus];

    /// The word for the shape.
    pub fn name(self) -> &'static str {
        match self {
            Body::Box => "box",
            Body::Annulus => "annulus",
        }
    }

    /// The shape in a few words.
    pub fn doc(self) -> &'static str {
        match self {
            Body::Box => "A box with edges along the axes",
            Body::Annulus => "The region between two circles, in the plane",
        }
    }

    /// The shape with this name.
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|it| it.name() == name)
    }
}

/// The choices for a new field file.
pub struct Template<'a> {
    /// The field's name.
    pub name: &'a str,
    /// The file, as the user's next commands name it.
    pub path: &'a str,
    /// The dimension of space.
    pub dimension: usize,
    /// The shape of the body; an annulus is of two dimensions.
    pub body: Body,
    /// The material.
    pub material: &'a MaterialSpec,
    /// Whether the body is undeformed and at rest at first.
    pub is_undeformed: bool,
    /// The JSON Schema of field files, relative to the file, where there is one.
    pub schema: Option<&'a str>,
}

/// The shipped material of that name.
pub fn material(name: &str) -> anyhow::Result<MaterialSpec> {
    let materials = gallery::materials();
    if let Some(material) = materials.iter().find(|material| material.name == name) {
        return Ok(material.clone());
    }
    let stems = materials.iter().map(|material| material.name.raw());
    let advice =
        advice(name, stems, |all| format!("there are {all}. One of your own is named in the file"));
    bail!("no material `{name}`; {advice}")
}

impl Template<'_> {
    /// The text of the file.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for line in TEMPLATE.lines() {
            let line = match tagged(line) {
                Some((tags, line)) if self.is_meant(tags) => line,
                Some(_) => continue,
                None => line,
            };
            text.push_str(&self.filled(line));
            text.push('\n');
        }
        // If a variant has no line, the blank lines around it become neighbours.
        while text.contains("\n\n\n") {
            text = text.replace("\n\n\n", "\n\n");
        }
        text
    }

    /// Whether a line with these tags belongs in this file.
    fn is_meant(&self, tags: &str) -> bool {
        let body = match (self.body, self.dimension) {
            (Body::Annulus, _) => 'o',
            (Body::Box, 1) => '1',
            (Body::Box, 2) => '2',
            (Body::Box, _) => '3',
        };
        let is_for_body = tags == "n" || tags.contains(body);
        is_for_body && (!tags.contains('n') || self.material.name == NEO_HOOKEAN)
    }

    /// A line with its words filled in.
    fn filled(&self, line: &str) -> String {
        let Some((before, rest)) = line.split_once('@') else { return line.into() };
        let Some((word, after)) = rest.split_once('@') else { return line.into() };
        format!("{before}{}{after}", self.meaning(word))
    }

    fn meaning(&self, word: &str) -> String {
        match word {
            "schema" => self.schema_line(),
            "name" => self.name.into(),
            "path" => self.path.into(),
            "motion" => motion(self.is_undeformed).into(),
            "dimension" => self.dimension.to_string(),
            "coordinates" => ["X", "Y", "Z"][..self.dimension].join(" "),
            "functions" => FUNCTIONS.join(" "),
            "parameters" => self.parameters(),
            "arguments" => self.arguments(),
            "model" => self.material.name.raw().into(),
            "materials" => materials(),
            "shapes" => SHAPES.join(" "),
            "integrators" => INTEGRATORS.join(" "),
            "formulations" => FORMULATIONS.join(" "),
            "transfers" => TRANSFERS.join(" "),
            "fills" => FILLS.join(" "),
            "precisions" => PRECISIONS.join(" "),
            "forms" => FORMS.join(" "),
            unknown => format!("@{unknown}@"),
        }
    }

    /// The comment by which editors find the JSON Schema, or the way to it.
    fn schema_line(&self) -> String {
        match self.schema {
            Some(path) => format!("#:schema {path}"),
            None => "# Editors explain and complete the keys after `mms schema > field.schema.json`, with\n\
                     # #:schema ./field.schema.json in the first line of this file.\n\
                     #"
                .into(),
        }
    }

    /// A parameter of the field for each of the material.
    fn parameters(&self) -> String {
        let lines = self.material.parameters.iter().map(|parameter| {
            let unit = parameter.unit.as_ref().map(|unit| unit.value.as_str());
            // The motion of the template stays far from the limits of strain that a material of this value has.
            let value = if unit == Some("Pa") { "1e6" } else { "50" };
            let mut line = format!("{:<9} = {{ value = {value}", renamed(&parameter.name.value));
            for (key, text) in [("unit", unit), ("doc", parameter.doc.as_ref().map(Foreign::raw))] {
                if let Some(text) = text {
                    line.push_str(&format!(", {key} = {text:?}"));
                }
            }
            line + " }"
        });
        lines.collect::<Vec<_>>().join("\n")
    }

    fn arguments(&self) -> String {
        let lines = self.material.parameters.iter().map(|parameter| {
            let name = &parameter.name.value;
            format!("{name:<7} = \"{}\"", renamed(name))
        });
        let givens = self.material.givens.iter().map(|given| {
            let name = &given.name.value;
            let doc = given
                .doc
                .as_ref()
                .map_or_else(String::new, |doc| format!("   # {}", doc.in_a_comment()));
            format!("{name:<7} = \"0\"{doc}")
        });
        let fibre = self.material.has_fibres().then(|| "fibre   = [1, 0, 0]".to_string());
        lines.chain(givens).chain(fibre).collect::<Vec<_>>().join("\n")
    }
}

/// The time factor of the displacement.
fn motion(is_undeformed: bool) -> &'static str {
    match is_undeformed {
        true => "amplitude*(1 - cos(2*pi*t/period))/2",
        false => "amplitude*cos(2*pi*t/period)",
    }
}

/// The shipped materials, in lines of a comment.
fn materials() -> String {
    let stems: Vec<_> = MATERIALS.iter().map(|(stem, _)| *stem).collect();
    let lines: Vec<_> =
        stems.chunks(4).map(|stems| format!("#     {}", stems.join(", "))).collect();
    lines.join("\n")
}

/// The tags of a line, and the line without them.
fn tagged(line: &str) -> Option<(&str, &str)> {
    let (tags, rest) = line.split_once('|')?;
    let is_tags = !tags.is_empty() && tags.chars().all(|tag| "123on".contains(tag));
    is_tags.then(|| (tags, rest.strip_prefix(' ').unwrap_or(rest)))
}

/// A name for the field's parameter that sets a parameter of the material.
fn renamed(name: &str) -> String {
    if TAKEN.contains(&name) { format!("material_{name}") } else { name.into() }
}
