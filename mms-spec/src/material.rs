//! Materials: the `[material]` table of a field, and material files.

use toml::de::DeTable;

use crate::diagnostic::{Diagnostic, quoted};
use crate::document::Document;
use crate::foreign::Foreign;
use crate::format::{self, MATERIAL, MATERIAL_FILE, MATERIAL_HEADER};
use crate::formula::Formula;
use crate::given::{MaterialGiven, material_givens};
use crate::moduli::Pair;
use crate::names::{Names, ReservingFile};
use crate::source::{SourceId, Sources, Span, Spanned};
use crate::suggest::did_you_mean;
use crate::symbols::{LetSpec, MaterialParameter, lets, material_parameters};
use crate::syntax::{self, NodeKind};
use crate::table::{Entry, Reader, Table};

/// The material of a field, and the values of its parameters.
#[derive(Clone, Debug)]
pub struct MaterialUse {
    /// A shipped material's stem, or the path of a material file; empty if it is missing, which has been reported.
    pub model: Spanned<Foreign>,
    /// The reference density rho0; a static field may have none.
    pub density: Option<Formula>,
    /// A formula for each parameter and given field of the material, in the order of the file.
    pub arguments: Vec<(Spanned<String>, Formula)>,
    /// A formula for each given field of the material; [`MaterialUse::tell_givens`] moves them here.
    pub givens: Vec<(Spanned<String>, Formula)>,
    /// The reference direction of the fibres: three components.
    pub fibre: Option<Vec<Formula>>,
    /// The `[material]` header.
    pub span: Span,
}

/// A material file.
#[derive(Clone, Debug)]
pub struct MaterialSpec {
    /// The file's stem.
    pub name: Foreign,
    /// The title, in a few words.
    pub title: Foreign,
    /// The published source.
    pub reference: Option<Foreign>,
    /// The strain-energy density W per unit reference volume.
    pub strain_energy: Formula,
    /// Whether W stays the same under rotations: false for the small strain, and if the file says so.
    pub frame_indifferent: bool,
    /// The key by which the file claims that W stays the same under rotations.
    pub claims_indifference: Option<Span>,
    /// The parameters.
    pub parameters: Vec<MaterialParameter>,
    /// The given fields.
    pub givens: Vec<MaterialGiven>,
    /// The definitions, in order.
    pub lets: Vec<LetSpec>,
    /// The pair of moduli that the field states instead of the file's own.
    pub moduli: Option<Pair>,
    /// Formulas that lost their place because of a reported mistake.
    pub stray: Vec<Formula>,
    /// Reserved names that the file tries to define: a use may mean the reserved name or the definition.
    pub refused: Vec<String>,
    /// Whether part of the file could not be read: an unknown name may be a consequence.
    pub incomplete: bool,
}

impl MaterialSpec {
    /// Every formula of the file.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        let lets = self.lets.iter().map(|definition| &definition.value);
        let rest = self.givens.iter().filter_map(|given| given.rest.as_ref());
        rest.chain(lets).chain([&self.strain_energy]).chain(&self.stray)
    }

    /// The names that a field sets: of the parameters, then of the given fields.
    pub fn names(&self) -> impl Iterator<Item = &str> + Clone {
        let parameters = self.parameters.iter().map(|parameter| parameter.name.value.as_str());
        parameters.chain(self.givens.iter().map(|given| given.name.value.as_str()))
    }

    /// The given field with this name.
    pub fn given(&self, name: &str) -> Option<&MaterialGiven> {
        self.givens.iter().find(|given| given.name.value == name)
    }

    /// The first place where the file uses one of some names.
    pub fn first_use(&self, names: &[&str]) -> Option<Spanned<String>> {
        self.formulas().find_map(|formula| {
            let ast = syntax::parse(formula, &mut Vec::new())?;
            ast.nodes.iter().find_map(|node| match &node.kind {
                NodeKind::Name(name) if names.contains(&name.as_str()) => {
                    Some(Spanned { value: name.clone(), span: node.span })
                }
                _ => None,
            })
        })
    }

    /// The first place where W uses the small strain, which changes under rotations.
    pub fn small_strain(&self) -> Option<Spanned<String>> {
        self.first_use(&["eps_trace", "eps_squared"])
    }

    /// Whether W is a function of I4: then the field states the direction of the fibres.
    pub fn has_fibres(&self) -> bool {
        self.first_use(&["I4"]).is_some()
    }
}

impl MaterialUse {
    /// Separates the given fields from the parameters, which look alike until the material is known.
    pub fn tell_givens(&mut self, material: &MaterialSpec) {
        let (givens, arguments) = std::mem::take(&mut self.arguments)
            .into_iter()
            .partition(|(name, _)| material.given(&name.value).is_some());
        (self.givens, self.arguments) = (givens, arguments);
    }

    /// A material without content, in place of one whose absence has been reported.
    pub(super) fn reported(span: Span) -> Self {
        MaterialUse {
            model: Spanned { value: Foreign::default(), span },
            density: Some(Formula::reported(span)),
            arguments: Vec::new(),
            givens: Vec::new(),
            fibre: None,
            span,
        }
    }
}

/// The path of the material file that the text of a field names, as in `model = "./mine.toml"`, for code that gathers files
/// before any is read. [`read_field`](super::read_field) reports mistakes in the text.
pub(super) fn own_material(text: &str) -> Option<String> {
    let table = DeTable::parse(text).ok()?;
    let material = table.get_ref().get("material")?.get_ref().as_table()?;
    let model = material.get("model")?.get_ref().as_str()?;
    model.ends_with(".toml").then(|| model.to_string())
}

/// Reads `[material]` of a field.
pub(super) fn material_use<'a>(entry: &Entry<'a>, reader: &mut Reader<'a>) -> MaterialUse {
    let Some(table) = reader.open_table(entry, "[material]") else {
        return MaterialUse::reported(reader.span(entry.value));
    };
    let own_keys = format::names(MATERIAL);
    let misspelt = misspelt_keys(&table, &own_keys, reader);
    let mut spec = MaterialUse::reported(table.span);
    let is_misspelt = |key: &str| misspelt.iter().any(|(_, meant)| *meant == key);
    if !is_misspelt("model") {
        spec.model = model(&table, reader).unwrap_or(spec.model);
    }
    if !is_misspelt("density") {
        let entry = table.get("density");
        spec.density = entry.map(|entry| reader.formula("density", entry.value));
    }
    spec.fibre = table
        .get("fibre")
        .map(|fibre| reader.formulas(&fibre, 3, "expected a direction in space: three components"));
    for Entry { key, value } in &table.entries {
        let is_argument = !own_keys.contains(&key.value.as_str());
        if is_argument && !misspelt.iter().any(|(found, _)| *found == key.value) {
            spec.arguments.push((key.clone(), reader.formula(&key.value, value)));
        }
    }
    spec
}

fn model<'a>(table: &Table<'a>, reader: &mut Reader<'a>) -> Option<Spanned<Foreign>> {
    let model = reader.required_string(table, "model")?;
    if model.value.is_empty() {
        let message =
            "`model` must be a shipped material's name, or a path such as \"./mine.toml\"";
        reader.report(Diagnostic::error(model.span, message).label("this is empty"));
    }
    Some(Spanned { value: model.value.into(), span: model.span })
}

/// Keys that would be arguments, but resemble a missing key.
fn misspelt_keys(
    table: &Table<'_>,
    own_keys: &[&'static str],
    reader: &mut Reader<'_>,
) -> Vec<(String, &'static str)> {
    let absent: Vec<_> = own_keys.iter().copied().filter(|key| table.get(key).is_none()).collect();
    let mut misspelt = Vec::new();
    for Entry { key, .. } in &table.entries {
        if own_keys.contains(&key.value.as_str()) || reader.is_incomplete() {
            continue;
        }
        let Some(meant) = did_you_mean(&key.value, absent.iter().copied()) else { continue };
        reader.report(
            Diagnostic::error(key.span, format!("unknown key {}", quoted(&key.value)))
                .label(format!("[material] needs `{meant}`"))
                .help(format!("did you mean `{meant}`?")),
        );
        misspelt.push((key.value.clone(), meant));
    }
    misspelt
}

/// Reads a material file. Returns `None` only if the file is too long to be read, or is a field file.
pub fn read_material(
    sources: &Sources,
    id: SourceId,
    name: &str,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<MaterialSpec> {
    let document = Document::parse(sources, id, diagnostics)?;
    let mut reader = Reader::new(sources, id, &document, diagnostics);
    if let Some((key, _)) = document.root.iter().find(|(key, _)| key.get_ref() == "field") {
        let span = sources.span_of(id, key);
        reader.report(
            Diagnostic::error(span, "this is a field file, not a material file")
                .label("only fields have this table")
                .help("a material file gives its `strain_energy` under [material]"),
        );
        return None;
    }
    let root = reader.root("a material file", &document.root, MATERIAL_FILE);
    let mut names = Names::new(ReservingFile::Material);
    let parameters = reader
        .names(&root, "parameters")
        .map(|table| material_parameters(&table, &mut names, &mut reader));
    let givens =
        reader.names(&root, "given").map(|table| material_givens(&table, &mut names, &mut reader));
    let definitions = reader.names(&root, "let").map(|table| lets(&table, &mut names, &mut reader));
    let mut spec = MaterialSpec {
        name: name.into(),
        title: Foreign::default(),
        reference: None,
        strain_energy: Formula::reported(root.span),
        frame_indifferent: true,
        claims_indifference: None,
        parameters: parameters.unwrap_or_default(),
        givens: givens.unwrap_or_default(),
        lets: definitions.unwrap_or_default(),
        moduli: None,
        stray: Vec::new(),
        refused: Vec::new(),
        incomplete: false,
    };
    match reader.required_table(&root, "material") {
        Some(entry) => header(&entry, &mut spec, &mut reader),
        // Without its one required table, nothing more is reported about the file.
        None => reader.lost_names = true,
    }
    (spec.stray, spec.refused) = (reader.stray, reader.refused);
    spec.incomplete = reader.lost_names;
    Some(spec)
}

fn header<'a>(entry: &Entry<'a>, spec: &mut MaterialSpec, reader: &mut Reader<'a>) {
    let Some(table) = reader.table(entry, "[material]", MATERIAL_HEADER) else { return };
    if let Some(title) = reader.required_string(&table, "title") {
        spec.title = title.value.into();
    }
    spec.reference = reader.optional_foreign(&table, "reference");
    spec.strain_energy = reader.required_formula(&table, "strain_energy");
    let claim = table.get("frame_indifferent");
    let claimed = claim.as_ref().and_then(|entry| reader.boolean(entry));
    spec.frame_indifferent = claimed.unwrap_or(true) && spec.small_strain().is_none();
    spec.claims_indifference = claim.filter(|_| claimed == Some(true)).map(|entry| entry.key.span);
}
