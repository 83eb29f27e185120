//! `mms list`: what there is to choose from.

use clap::Args;
use comfy_table::Table;
use comfy_table::presets::NOTHING;
use mms_codegen::materials::MATERIALS;
use mms_documents::list::{self as documents, ListedField, ListedStudy};
use mms_exact::gallery;
use mms_harness::profile;
use mms_runtime::{FormulationName, IntegratorName, ShapeName, Transfer};
use mms_spec::{Claim, FORMS, FieldSpec, PRECISIONS, StudySpec};

use super::{Outcome, print, print_json};

/// List the fields, materials and methods, and the codes whose files have a profile.
///
/// Of each field: its dimension, its material, the shape of its body, what it claims on the faces,
/// whether its body is deformed and moves at first, and what it is. `--json` tells face by face, and which closed forms and studies the file has.
#[derive(Args)]
pub struct List {
    /// Print one JSON document.
    #[arg(long)]
    json: bool,
}

impl List {
    pub fn run(self) -> anyhow::Result<Outcome> {
        let fields = gallery::fields();
        let materials: Vec<_> = MATERIALS.iter().map(|(stem, _)| *stem).collect();
        let profiles: Vec<_> = profile::names().collect();
        if self.json {
            let texts = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
            print_json(&documents::List {
                fields: fields.iter().map(document).collect(),
                materials: texts(&materials),
                shapes: texts(ShapeName::NAMES),
                integrators: texts(IntegratorName::NAMES),
                formulations: texts(FormulationName::NAMES),
                transfers: texts(Transfer::NAMES),
                precisions: texts(PRECISIONS),
                forms: texts(FORMS),
                profiles: texts(&profiles),
            })?;
            return Ok(Outcome::AsExpected);
        }
        let choices = [
            ("materials", materials.as_slice()),
            ("shapes", ShapeName::NAMES),
            ("integrators", IntegratorName::NAMES),
            ("formulations", FormulationName::NAMES),
            ("transfers", Transfer::NAMES),
            ("precisions", PRECISIONS),
            ("forms", FORMS),
            ("profiles", &profiles),
        ];
        let line = |(what, words): (&str, &[&str])| {
            format!("\n{:13} {}", format!("{what}:"), words.join(", "))
        };
        print(&format!("{}\n{}", table(&fields), choices.map(line).concat()))?;
        Ok(Outcome::AsExpected)
    }
}

/// A line per field, for a person to choose from.
fn table(fields: &[FieldSpec]) -> Table {
    let mut table = Table::new();
    table.load_style(NOTHING);
    table.set_header(["field", "dimension", "material", "body", "faces", "starts", "title"]);
    for field in fields {
        table.add_row([
            field.name.shown(),
            field.dimension.to_string(),
            field.material.model.value.shown(),
            field.domain.body.name().into(),
            claims(field),
            start(field).unwrap_or_default().into(),
            field.title.shown(),
        ]);
    }
    table
}

/// How a field starts.
fn start(field: &FieldSpec) -> Option<&'static str> {
    let materials = gallery::materials();
    let material = materials.iter().find(|it| it.name == field.material.model.value)?;
    gallery::start(field, material)
}

/// The claims of a field, each once.
fn claims(field: &FieldSpec) -> String {
    if field.domain.body.is_nothing() {
        return "numbers without claims".into();
    }
    let is_made =
        |claim: &&Claim| field.boundary.iter().any(|boundary| boundary.claim.value == **claim);
    let claims: Vec<_> = Claim::ALL.iter().filter(is_made).map(|claim| claim.name()).collect();
    claims.join(", ")
}

fn document(field: &FieldSpec) -> ListedField {
    let boundary = field.boundary.iter().map(|boundary| {
        (boundary.face.value.name().to_string(), boundary.claim.value.name().to_owned())
    });
    let checks = field.checks.iter().map(|check| check.quantity.value.name().to_owned());
    ListedField {
        name: field.name.raw().to_owned(),
        title: field.title.raw().to_owned(),
        dimension: field.dimension,
        material: field.material.model.value.raw().to_owned(),
        reference: field.reference.as_ref().map(|it| it.raw().to_owned()),
        body: field.domain.body.name().to_owned(),
        boundary: boundary.collect(),
        starts: start(field).map(str::to_owned),
        checks: checks.collect(),
        studies: field.studies.iter().map(study).collect(),
    }
}

fn study(study: &StudySpec) -> ListedStudy {
    ListedStudy {
        shape: study.shape.clone(),
        integrator: study.integrator.clone(),
        formulation: study.formulation.clone(),
        transfer: study.transfer.clone(),
        fill: study.fill.clone(),
        precision: study.precision.clone(),
        form: study.form.clone(),
        cells: study.cells.clone(),
        order: study.order,
        reason: study.reason.as_ref().map(|it| it.raw().to_owned()),
    }
}
