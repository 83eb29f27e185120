//! The text of a field: compiled, checked, derived, emitted.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::anyhow;
use mms_check::CheckOptions;
use mms_codegen::Options;
use mms_codegen::selection::Selection;
use mms_documents::check::CheckedFile;
use mms_emit::{Subject, TARGETS, Target};
use mms_exact::template::{self, Body, Template};
use mms_exact::{Input, Source, evaluated, gallery, quantities};
use mms_mechanics::TooLarge;
use mms_show::{Document, mathml};
use mms_spec::foreign::shown;
use mms_spec::quantity::Quantity;
use serde::Serialize;

use crate::mistake::{Diagnostic, Mistake};
use crate::request::FieldText;

/// The JSON Schema of field files.
pub const SCHEMA: &str = include_str!("../../docs/field.schema.json");

/// The quantities whose derivation is shown if none is named.
const USUAL: [&str; 2] = ["displacement", "body_force_density"];

/// The level of the headings of a derivation.
const HEADING: u8 = 3;

impl FieldText {
    /// The text as a source of the compiler.
    pub fn source(&self) -> Source {
        let material = self.material.clone();
        let load = move |name: &str| {
            material.clone().ok_or_else(|| format!("the text of `{name}` was not given"))
        };
        Source::file(PathBuf::from(format!("{}.toml", self.name)), self.text.clone(), load)
    }

    /// The field, compiled without proofs.
    pub fn compiled(&self) -> Result<Input, Mistake> {
        Ok(Input::interpreted(self.source(), &Options::default())?)
    }
}

/// The shipped fields and materials.
#[derive(Serialize)]
pub struct Gallery {
    fields: Vec<Shipped>,
    materials: Vec<String>,
}

#[derive(Serialize)]
struct Shipped {
    name: &'static str,
    title: String,
    dimension: usize,
    material: String,
    text: &'static str,
    material_text: Option<&'static str>,
}

/// The shipped fields and materials, whose texts are read and not compiled.
pub fn gallery() -> Gallery {
    let fields = gallery::FIELDS.iter().zip(gallery::fields()).map(|(entry, field)| Shipped {
        name: entry.name,
        title: field.title.raw().to_owned(),
        dimension: field.dimension,
        material: field.material.model.value.raw().to_owned(),
        text: entry.text,
        material_text: entry.material,
    });
    let materials = gallery::materials().into_iter().map(|it| it.name.raw().to_owned());
    Gallery { fields: fields.collect(), materials: materials.collect() }
}

/// A new field file.
#[derive(Serialize)]
pub struct NewField {
    text: String,
}

/// Writes a new field file, as `mms new` does.
pub fn template(dimension: usize, material: &str, shape: &str) -> Result<NewField, Mistake> {
    let body = Body::of(shape).ok_or_else(|| {
        let names = Body::ALL.map(Body::name).join(" or ");
        Mistake::of(format!("no shape `{}`: expected {names}", shown(shape)))
    })?;
    let expected = if body == Body::Annulus { 2..=2 } else { 1..=3 };
    if !expected.contains(&dimension) {
        return Err(Mistake::of(format!("no {shape} has {dimension} dimensions")));
    }
    let material = template::material(material)?;
    let (name, path, schema) = ("mine", "mine.toml", None);
    let template =
        Template { name, path, dimension, body, material: &material, is_undeformed: false, schema };
    Ok(NewField { text: template.text() })
}

/// The output of `mms check` for a field.
#[derive(Serialize)]
pub struct Checked {
    /// The document of `mms check --json`, for the one file.
    document: CheckedFile,
    /// The lines of `mms check`.
    text: String,
    /// Whether every claim and closed form holds.
    passes: bool,
    /// Claims that do not hold, and warnings.
    warnings: Vec<Diagnostic>,
}

/// Checks a field.
pub fn check(field: &FieldText) -> Result<Checked, Mistake> {
    let source = field.source();
    let compiled = Arc::new(source.compile(&Options::default())?);
    let report = mms_check::check(source.name(), &compiled, CheckOptions::default());
    let told = report.objections.iter().chain(&report.warnings);
    Ok(Checked {
        text: report.lines.join("\n"),
        passes: report.passes,
        warnings: told.map(|it| Diagnostic::of(&compiled.sources, it)).collect(),
        document: report.document,
    })
}

/// The derivation of some quantities.
#[derive(Serialize)]
pub struct Derivation {
    html: String,
    /// The names of all quantities that can be derived.
    quantities: Vec<String>,
}

/// Derives some quantities, step by step, as MathML.
pub fn derive(field: &FieldText, names: &[String]) -> Result<Derivation, Mistake> {
    let input = field.compiled()?;
    let names = if names.is_empty() { USUAL.map(String::from).to_vec() } else { names.to_vec() };
    let found = quantities(&input.own_quantities(), &names)?;
    let found = input.offered(&names, found)?;
    let document = Document::new(&input.compiled, &found).map_err(|TooLarge(what)| {
        anyhow!("the {what} of the field has too many terms; ask for one quantity")
    })?;
    let all = input.compiled.quantities().map(|it| it.name().to_owned());
    Ok(Derivation { html: mathml::part(&document, HEADING), quantities: all.collect() })
}

/// The languages, and the quantities that code is written for.
#[derive(Serialize)]
pub struct Targets {
    targets: Vec<Language>,
    quantities: Vec<Named>,
}

#[derive(Serialize)]
struct Language {
    name: &'static str,
    doc: &'static str,
}

#[derive(Serialize)]
struct Named {
    name: &'static str,
    symbol: &'static str,
    doc: &'static str,
}

/// The languages, and the quantities that every field has.
pub fn targets() -> Targets {
    let language = |it: &Target| Language { name: it.name, doc: it.doc };
    let named = |it: &Quantity| Named { name: it.name(), symbol: it.symbol(), doc: it.doc() };
    Targets {
        targets: TARGETS.iter().map(language).collect(),
        quantities: Quantity::ALL.iter().map(named).collect(),
    }
}

/// The code of a field.
#[derive(Serialize)]
pub struct Emitted {
    files: Vec<Text>,
    /// The command that builds and runs the check program.
    verify: Option<String>,
}

#[derive(Serialize)]
struct Text {
    name: String,
    text: String,
}

/// Writes the code of a field in a language, with its check program.
pub fn emit(field: &FieldText, target: &str, names: &[String]) -> Result<Emitted, Mistake> {
    let target = Target::find(target)
        .ok_or_else(|| Mistake::of(format!("no target `{}`", shown(target))))?;
    let source = field.source();
    let wanted = match names {
        [] => None,
        names => Some(quantities(&source.own_quantities(), names)?.into_iter().collect()),
    };
    let selection = Selection { quantities: wanted, ..Selection::default() };
    let input = Input::new(source, &Options { selection, ..Options::default() })?;
    input.offered(names, Vec::new())?;
    let subject = Subject::new(&input.compiled);
    let bundle = (target.emit)(&subject);
    if bundle.verify.is_some() && !subject.has_values() {
        return Err(Mistake::of(
            "the field has no point in its domain where all of these quantities have a value: shrink [domain], or ask for others",
        ));
    }
    let files = bundle.files.into_iter().map(|it| Text { name: it.name, text: it.text });
    Ok(Emitted { files: files.collect(), verify: bundle.verify })
}

/// The quantities of some names, with those on request.
pub fn named(input: &Input, names: &[String]) -> anyhow::Result<Vec<Quantity>> {
    input.offered(names, evaluated(&input.own_quantities(), names)?)
}
