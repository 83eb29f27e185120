//! `mms show`: the derivation, readable.

use std::collections::BTreeMap;

use anyhow::{anyhow, bail};
use clap::{Args, ValueEnum};
use mms_analysis::operations::Operations;
use mms_analysis::visibility::{POINTS, Status, Term, Visibility};
use mms_check::stability;
use mms_codegen::Compiled;
use mms_codegen::certify::certificate::reach;
use mms_codegen::certify::rest;
use mms_codegen::certify::rest::Rest;
use mms_documents::Names;
use mms_documents::show::{self as documents, AbsentTerm, OperationCounts, ShownQuantity};
use mms_exact::quantities;
use mms_mechanics::Output;
use mms_mechanics::TooLarge;
use mms_options::field::{Variant, find};
use mms_program::Stage;
use mms_show::language::Language;
use mms_show::{DERIVATION, Document, Line, Section, latex, mathml, sympy, text};
use mms_spec::diagnostic::render_styled;
use mms_spec::quantity::Quantity;
use mms_stability::resting::Material;
use mms_stability::wavelength::shortest_wavelength;

use super::{CommandOutcome, print, print_json, say};

/// Show all that follows from a field: the derivation step by step, the claims, the number of operations of each quantity,
/// and the terms of the equations that the field sees or does not see.
///
/// The last lines give the moduli at F = I, bounds of x, and the shortest wavelength of u, found on a sample.
///
/// If the material has a stress at rest (P not 0 at F = I), a warning on stderr says so; in --json, rest_stress has the
/// components.
///
/// A comma denotes a derivative: F_11,X is dF_11/dX. Long formulas are split into parts k1, k2, ..., and each part is listed
/// before its use.
#[derive(Args)]
pub struct Show {
    /// A name that `mms list` prints, or the path of a TOML file.
    field: String,
    /// The quantities to show, separated by commas; all by default.
    #[arg(long, value_name = "NAME", value_delimiter = ',')]
    quantity: Vec<String>,
    /// The output format: text for a terminal, a LaTeX document, or a page of MathML for a browser.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Print only the formulas of u, F, J, P, Div P and b, to include in a LaTeX document. They use the symbols that
    /// parameters declare. Needs --format latex, and the package amsmath in the document.
    #[arg(long, requires = "format", conflicts_with_all = ["json", "script"])]
    fragment: bool,
    #[command(flatten)]
    variant: Variant,
    /// Print one JSON document, with formulas in the language of field files.
    #[arg(long, conflicts_with = "format")]
    json: bool,
    /// Print a Python script that derives everything again with other software, and compares the values.
    #[arg(long, value_enum, conflicts_with_all = ["format", "json", "quantity"])]
    script: Option<Script>,
}

/// The system that a script uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Script {
    /// SymPy.
    Sympy,
}

/// How to write the derivation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Unicode text.
    #[default]
    Text,
    /// A LaTeX document.
    Latex,
    /// A page of MathML.
    Mathml,
}

impl Show {
    pub fn run(self) -> anyhow::Result<CommandOutcome> {
        let input = find(&self.field, &self.variant)?;
        let rest = rest::stress(&input.compiled);
        if let Some(warning) = rest.warning(&input.compiled) {
            say(render_styled(&input.compiled.sources, &[warning]));
        }
        if self.script == Some(Script::Sympy) {
            let script = sympy::script(&input.compiled).map_err(|sympy::Undefined| {
                anyhow!(
                    "`{}` has no {} points in its domain where all quantities are finite: there is nothing to compare",
                    input.name.shown(),
                    sympy::POINTS
                )
            })?;
            print(&script)?;
            return Ok(CommandOutcome::AsExpected);
        }
        if self.fragment && self.format != Format::Latex {
            bail!("`--fragment`: expected `--format latex`; text and MathML are whole pages");
        }
        let quantities = match self.quantity.as_slice() {
            [] if self.fragment => {
                let steps = input.compiled.quantities().filter(|it| DERIVATION.contains(it));
                steps.filter(|it| input.compiled.offers(*it)).collect()
            }
            [] => input.compiled.quantities().collect(),
            named => quantities(&input.own_quantities(), named)?,
        };
        let quantities = input.offered(&self.quantity, quantities)?;
        let too_large = |TooLarge(what): TooLarge| {
            anyhow!(
                "the {what} of `{}` has too many terms; ask for one --quantity",
                input.name.shown()
            )
        };
        let mut document = Document::new(&input.compiled, &quantities).map_err(too_large)?;
        // The page of all quantities ends with the terms of the equations that the field sees.
        if self.quantity.is_empty() && !self.fragment {
            document.visibility = Some(Visibility::of(&input.compiled).map_err(too_large)?);
        }
        match self.format {
            _ if self.json => print_json(&json(&input.compiled, &document, &rest))?,
            Format::Text => {
                let mut lines = vec![text::page(&document)];
                if self.quantity.is_empty() {
                    lines.extend(at_rest(&input.compiled));
                }
                print(&lines.join("\n"))?;
            }
            Format::Latex if self.fragment => print(&latex::fragment(&document))?,
            Format::Latex => print(&latex::page(&document))?,
            Format::Mathml => print(&mathml::page(&document))?,
        }
        Ok(CommandOutcome::AsExpected)
    }
}

/// The material at rest and the extent of the motion, below a heading.
fn at_rest(compiled: &Compiled) -> Vec<String> {
    let mut lines = vec![String::new(), "at rest and in motion".into()];
    lines.extend(Material::of(compiled).as_ref().map(stability::at_rest));
    if !compiled.field.domain.body.is_nothing() {
        lines.push(stability::extent(
            &reach(compiled),
            compiled.field.space,
            shortest_wavelength(compiled),
        ));
    }
    lines
}

fn json(compiled: &Compiled, document: &Document, rest: &Rest) -> documents::Show {
    let section = |section: &Section| {
        (section.quantity.name().to_owned(), quantity(compiled, document, section))
    };
    let claims = document.claims.iter().map(|(face, claim)| (face.to_string(), claim.to_string()));
    let material = &document.material;
    let definitions = [&document.definitions[..], &material.whereby[..]];
    let density = material.density.first();
    let at_rest = Material::of(compiled);
    documents::Show {
        field: document.name.raw().to_owned(),
        title: document.title.raw().to_owned(),
        dimension: document.dimension,
        reference: document.reference.as_ref().map(|it| it.raw().to_owned()),
        material: material.name.raw().to_owned(),
        strain_energy: compiled.material.strain_energy.text.to_string(),
        material_parameters: formulas(document, &material.arguments).collect(),
        rest_stress: rest.stress().map(<[f64]>::to_vec),
        moduli_at_rest: stability::moduli(at_rest.as_ref()),
        transverse_moduli_at_rest: stability::transverse(at_rest.as_ref()),
        extent: reach(compiled),
        shortest_wavelength: shortest_wavelength(compiled),
        density: density.map(|line| document.formula(line.value, &Language)),
        definitions: definitions.iter().flat_map(|lines| formulas(document, lines)).collect(),
        boundary: claims.collect(),
        quantities: document.sections.iter().map(section).collect(),
        operations: together(compiled, document),
        visibility: document.visibility.as_ref().map(visibility),
    }
}

fn visibility(visibility: &Visibility) -> documents::Visibility {
    let names = |status| -> Vec<String> { visibility.with(status).map(Term::name).collect() };
    let how = |status| if status == Status::Zero { "zero" } else { "negligible" };
    let absent = visibility.findings.iter().filter(|(_, status)| status.is_absent());
    let absent = absent.map(|(term, status)| AbsentTerm {
        term: term.name(),
        how: how(*status).to_owned(),
        means: term.absence().to_owned(),
    });
    documents::Visibility {
        present: names(Status::Present),
        absent: absent.collect(),
        undecided: names(Status::Undecided),
        points: POINTS,
        span: visibility.span().map(|it| it.name().to_owned()),
        exact_in_time: visibility.is_exact_in_time(),
        symmetric_gradient: visibility.has_symmetric_gradient(),
    }
}

/// The operations of all quantities that are shown.
fn together(compiled: &Compiled, document: &Document) -> OperationCounts {
    let shown: Vec<_> = document.sections.iter().map(|section| section.quantity).collect();
    let operations = Operations::of(compiled, &shown);
    let by_stage = Stage::ALL.map(|stage| (stage.name(), operations.by_stage[&stage]));
    OperationCounts {
        before: operations.before,
        after: operations.after,
        by_stage: BTreeMap::from(by_stage).into_iter().collect(),
        by_kind: BTreeMap::from_iter(operations.by_kind).into_iter().collect(),
    }
}

fn quantity(compiled: &Compiled, document: &Document, section: &Section) -> ShownQuantity {
    let components = section.components.iter();
    let formula = components.clone().map(|line| document.formula(line.value, &Language));
    let symbols = components.flat_map(|line| &line.left).map(|name| name.identifier());
    ShownQuantity {
        symbols: symbols.collect(),
        r#where: formulas(document, &section.whereby).collect(),
        formula: formula.collect(),
        operations: operations(compiled, section.quantity),
    }
}

/// Names and their formulas, in the order in which they are needed.
fn formulas(document: &Document, lines: &[Line]) -> impl Iterator<Item = (String, String)> {
    lines.iter().flat_map(|line| {
        let formula = document.formula(line.value, &Language);
        line.left.iter().map(move |name| (name.identifier(), formula.clone()))
    })
}

fn operations(compiled: &Compiled, quantity: Quantity) -> Names<usize> {
    let counts = compiled.program.operations(&[Output::Quantity(quantity)]);
    let total: usize = counts.values().sum();
    let stages = Stage::ALL.map(|stage| (stage.name(), counts[&stage]));
    [("total", total)].into_iter().chain(stages).collect()
}
