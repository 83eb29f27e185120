//! `mms list`: what there is to choose from.

use clap::Args;
use mms_codegen::materials::MATERIALS;
use mms_documents::list::{self as documents, ListedField, ListedStudy};
use mms_exact::gallery;
use mms_harness::profile;
use mms_report::Shown;
use mms_report::table::TextTable;
use mms_runtime::{FormulationName, IntegratorName, ShapeName, Transfer};
use mms_spec::{Claim, FORMS, FieldSpec, PRECISIONS, StudySpec};

use super::CommandOutcome;
use super::format::Printing;

/// List the names that other commands accept: fields, materials, methods, and codes whose files have a profile.
///
/// The table has, for each field, the dimension, the material, the shape of the body, the claims on the faces, whether the
/// body is deformed and moves at the start, and the title. `--json` adds the claim of each face, and the closed forms and
/// studies of the file.
#[derive(Args)]
pub struct List {
    #[command(flatten)]
    printing: Printing,
}

impl List {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        self.printing.print(&Listing::new())?;
        Ok(CommandOutcome::AsExpected)
    }
}

/// All that can be named on a command line.
struct Listing {
    fields: Vec<FieldSpec>,
    /// The words of each kind.
    words: [(&'static str, Vec<&'static str>); 8],
}

impl Listing {
    fn new() -> Self {
        let words = [
            ("materials", MATERIALS.iter().map(|(stem, _)| *stem).collect()),
            ("shapes", ShapeName::NAMES.to_vec()),
            ("integrators", IntegratorName::NAMES.to_vec()),
            ("formulations", FormulationName::NAMES.to_vec()),
            ("transfers", Transfer::NAMES.to_vec()),
            ("precisions", PRECISIONS.to_vec()),
            ("forms", FORMS.to_vec()),
            ("profiles", profile::names().collect()),
        ];
        Listing { fields: gallery::fields(), words }
    }

    /// A row for each field, to choose from.
    fn table(&self) -> TextTable {
        let header = ["field", "dimension", "material", "body", "faces", "starts", "title"];
        let mut table = TextTable::new("fields of the gallery", header);
        for field in &self.fields {
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
}

impl Shown for Listing {
    type Document = documents::List;

    fn text(&self) -> String {
        let line = |(what, words): &(&str, Vec<&str>)| {
            format!("\n{:13} {}", format!("{what}:"), words.join(", "))
        };
        format!("{}\n{}", self.table(), self.words.iter().map(line).collect::<String>())
    }

    fn tables(&self) -> Vec<TextTable> {
        let mut words = TextTable::new("words of options", ["kind", "words"]);
        for (kind, all) in &self.words {
            words.add_row([(*kind).to_owned(), all.join(", ")]);
        }
        vec![self.table(), words]
    }

    fn document(&self) -> documents::List {
        let [materials, shapes, integrators, formulations, transfers, precisions, forms, profiles] =
            self.words
                .each_ref()
                .map(|(_, words)| words.iter().map(|it| (*it).to_owned()).collect());
        documents::List {
            fields: self.fields.iter().map(document).collect(),
            materials,
            shapes,
            integrators,
            formulations,
            transfers,
            precisions,
            forms,
            profiles,
        }
    }
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
    let all = Claim::ALL.iter().chain(&[Claim::Axis]);
    let claims: Vec<_> = all.filter(is_made).map(|claim| claim.name()).collect();
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
