//! The field file as a whole.

use crate::balance::{BalanceSpec, balances};
use crate::boundary::{BoundarySpec, boundary};
use crate::check::{CheckSpec, ExtremeSpec, check, extremes};
use crate::defined::{own_quantities, possible_quantities};
use crate::diagnostic::Diagnostic;
use crate::document::Document;
use crate::domain::{DomainSpec, domain, one_per_dimension, reported};
use crate::foreign::Foreign;
use crate::format::{BALANCE, CHECK, DISPLACEMENT, EXTREME, FIELD, FIELD_FILE, Key, STUDY};
use crate::formula::Formula;
use crate::given::{GivenSpec, givens};
use crate::material::{MaterialUse, material_use};
use crate::names::{Names, ReservingFile};
use crate::rigid::{RigidSpec, rigid};
use crate::source::{SourceId, Sources, Span, Spanned};
use crate::space::Space;
use crate::study::{StudySpec, studies};
use crate::symbols::{LetSpec, ParameterSpec, lets, parameters};
use crate::table::{Entry, Reader, Table};

/// A field file. Vectors and tensors have exactly the components of its [`Space`]; a missing component is
/// [`Formula::is_reported`].
#[derive(Clone, Debug)]
pub struct FieldSpec {
    /// The file's stem.
    pub name: Foreign,
    /// The title, in a few words.
    pub title: Foreign,
    /// The number of coordinates of a point: 1, 2 or 3.
    pub dimension: usize,
    /// The coordinates, and the numbers of components of vectors and tensors.
    pub space: Space,
    /// The published source.
    pub reference: Option<Foreign>,
    /// The parameters, in order.
    pub parameters: Vec<ParameterSpec>,
    /// The definitions, in order.
    pub lets: Vec<LetSpec>,
    /// The given fields of the file's own, in order.
    pub givens: Vec<GivenSpec>,
    /// The displacement u(X, t); of an axisymmetric field u_R, u_Z and, if there is one, the swirl.
    pub displacement: Vec<Formula>,
    /// The material and its parameters.
    pub material: MaterialUse,
    /// The reference body and the time window.
    pub domain: DomainSpec,
    /// The claims about faces.
    pub boundary: Vec<BoundarySpec>,
    /// The further balances.
    pub balances: Vec<BalanceSpec>,
    /// The closed forms.
    pub checks: Vec<CheckSpec>,
    /// The expected orders.
    pub studies: Vec<StudySpec>,
    /// The extreme parameters.
    pub extremes: Vec<ExtremeSpec>,
    /// The rigid motion on top.
    pub rigid: Option<RigidSpec>,
    /// Formulas that lost their place because of a reported mistake, such as an excess component. They have no effect, but
    /// their syntax is checked.
    pub stray: Vec<Formula>,
    /// Reserved names that the file tries to define: a use may mean the reserved name or the definition.
    pub refused: Vec<String>,
    /// Whether part of the file could not be read: an unknown name may be a consequence.
    pub incomplete: bool,
}

impl FieldSpec {
    /// Whether nothing moves: the file has no time window.
    pub fn is_static(&self) -> bool {
        self.domain.time.is_none()
    }

    /// Every formula of the file.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        let mut all: Vec<&Formula> = Vec::new();
        for parameter in &self.parameters {
            all.push(&parameter.value);
            all.extend(parameter.range.iter().flatten());
        }
        all.extend(self.lets.iter().map(|definition| &definition.value));
        all.extend(self.givens.iter().map(|given| &given.value));
        all.extend(&self.displacement);
        all.extend(&self.material.density);
        all.extend(self.material.arguments.iter().map(|(_, value)| value));
        all.extend(self.material.givens.iter().map(|(_, value)| value));
        all.extend(self.material.fibre.iter().flatten());
        all.extend(self.domain.body.formulas());
        all.extend(self.domain.time.iter().flatten());
        all.extend(self.balances.iter().flat_map(BalanceSpec::formulas));
        for check in &self.checks {
            all.extend(check.lets.iter().map(|definition| &definition.value));
            all.extend(&check.equals);
        }
        all.extend(self.extremes.iter().flat_map(|extreme| &extreme.set).map(|(_, value)| value));
        all.extend(self.rigid.iter().flat_map(RigidSpec::formulas));
        all.extend(&self.stray);
        all.into_iter()
    }
}

/// Reads a field file. Returns `None` only if the dimension is unknown, or the file is too long to be read.
pub fn read_field(
    sources: &Sources,
    id: SourceId,
    name: &str,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<FieldSpec> {
    let document = Document::parse(sources, id, diagnostics)?;
    let mut reader = Reader::new(sources, id, &document, diagnostics);
    if let Some(span) = material_file(&document, sources, id) {
        reader.report(
            Diagnostic::error(span, "this is a material file, not a field file")
                .label("only materials have this key")
                .help(
                    "check a field that names it under [material], as in `model = \"./mine.toml\"`",
                ),
        );
        return None;
    }
    let root = reader.root("a field file", &document.root, FIELD_FILE);
    let header = header(&root, &mut reader);
    let chosen = displacement_table(&root, &mut reader);
    let space = header.space(chosen.as_ref(), &mut reader);
    let mut names = Names::new(space.map_or(ReservingFile::Field, ReservingFile::of));
    let parameters = reader
        .names(&root, "parameters")
        .map(|table| parameters(&table, &mut names, &mut reader))
        .unwrap_or_default();
    let lets = reader
        .names(&root, "let")
        .map(|table| lets(&table, &mut names, &mut reader))
        .unwrap_or_default();
    let givens = reader
        .names(&root, "given")
        .map(|table| givens(&table, &mut names, &mut reader))
        .unwrap_or_default();
    let material = match reader.required_table(&root, "material") {
        Some(entry) => material_use(&entry, &mut reader),
        None => MaterialUse::reported(root.span),
    };
    let Some(space) = space else {
        // Without the dimension the number of bounds is unknown, but the table is required anyway.
        reader.required_table(&root, "domain");
        return None;
    };
    let dimension = space.coordinates();
    let displacement = displacement(chosen.as_ref(), space, root.span, &mut reader);
    let place = Setup::read(&root, space, &mut reader);
    validate_density(&material, &place.domain, &mut reader);
    let balances = match root.get("balance") {
        Some(entry) => {
            let tables = reader.tables(&entry, BALANCE);
            balances(&tables, space, &mut names, &mut reader)
        }
        None => Vec::new(),
    };
    let mut spec = FieldSpec {
        name: name.into(),
        title: header.title,
        dimension,
        space,
        reference: header.reference,
        parameters,
        lets,
        givens,
        displacement,
        material,
        domain: place.domain,
        boundary: place.boundary,
        balances,
        checks: Vec::new(),
        studies: Vec::new(),
        extremes: Vec::new(),
        rigid: place.rigid,
        incomplete: false,
        stray: Vec::new(),
        refused: Vec::new(),
    };
    let evidence = Evidence::read(&root, &spec, &names, &mut reader);
    refuse_studies(&evidence.studies, &spec, &mut reader);
    (spec.checks, spec.studies, spec.extremes) =
        (evidence.checks, evidence.studies, evidence.extremes);
    (spec.stray, spec.refused) = (reader.stray, reader.refused);
    spec.incomplete = reader.lost_names;
    Some(spec)
}

/// The place of `strain_energy`, if the text is a material file: it has this key and no `[field]`.
fn material_file(document: &Document<'_>, sources: &Sources, id: SourceId) -> Option<Span> {
    if document.root.get("field").is_some() {
        return None;
    }
    let material = document.root.get("material")?.get_ref().as_table()?;
    Some(sources.span_of(id, material.get("strain_energy")?))
}

/// Refuses a field that moves without a density.
fn validate_density(material: &MaterialUse, domain: &DomainSpec, reader: &mut Reader<'_>) {
    if material.density.is_some() || domain.time.is_none() || reader.is_incomplete() {
        return;
    }
    reader.report(
        Diagnostic::error(material.span, "missing key `density`")
            .label("[material] needs `density`")
            .help("only a static field, whose [domain] has no `time`, may leave it out"),
    );
}

/// Refuses studies of a field on which the solver cannot run.
fn refuse_studies(studies: &[StudySpec], field: &FieldSpec, reader: &mut Reader<'_>) {
    let Some(first) = studies.first() else { return };
    if field.space == (Space::Axisymmetric { swirl: true }) {
        reader.report(
            Diagnostic::error(first.span, "a field with a swirl has no studies")
                .label("the solver moves rings along R and Z alone")
                .help("remove [[study]], or write the field in three dimensions"),
        );
    } else if field.domain.body.is_nothing() {
        reader.report(
            Diagnostic::error(first.span, "a field without a body has no studies")
                .label("the solver has nothing to fill with particles")
                .help("remove [[study]], or give the body that the solver is to run on"),
        );
    }
}

/// `[field]`.
#[derive(Default)]
struct Header {
    title: Foreign,
    dimension: Option<Spanned<usize>>,
    coordinates: Option<Spanned<String>>,
    reference: Option<Foreign>,
}

impl Header {
    /// The space of the field; if the dimension is wrong, the number of components decides.
    fn space<'a>(&self, chosen: Option<&Table<'a>>, reader: &mut Reader<'a>) -> Option<Space> {
        let is_axisymmetric =
            self.coordinates.as_ref().is_some_and(|word| word.value == Space::WORDS[1]);
        let swirl = chosen.and_then(|table| table.get("swirl"));
        if is_axisymmetric {
            if let Some(dimension) = self.dimension.as_ref().filter(|it| it.value != 2) {
                let message = "an axisymmetric field has the coordinates R and Z";
                reader.report(
                    Diagnostic::error(dimension.span, message)
                        .label("needs `dimension = 2`")
                        .help("a displacement along the hoop is `swirl` in [displacement]"),
                );
            }
            return Some(Space::Axisymmetric { swirl: swirl.is_some() });
        }
        if let Some(table) = chosen {
            reader.refuse(table, "swirl", "needs `coordinates = \"axisymmetric\"` in [field]");
        }
        let dimension = self.dimension.as_ref().map(|it| it.value);
        let of_displacement = || chosen?.get("u").as_ref().and_then(components);
        dimension.or_else(of_displacement).map(Space::Cartesian)
    }
}

fn header<'a>(root: &Table<'a>, reader: &mut Reader<'a>) -> Header {
    let table = reader
        .required_table(root, "field")
        .and_then(|entry| reader.table(&entry, "[field]", FIELD));
    let Some(table) = table else { return Header::default() };
    Header {
        title: reader
            .required_string(&table, "title")
            .map_or_else(Foreign::default, |title| title.value.into()),
        dimension: reader.required(&table, "dimension").and_then(|entry| dimension(&entry, reader)),
        coordinates: table
            .get("coordinates")
            .and_then(|entry| reader.word(&entry, "coordinates", &Space::WORDS)),
        reference: reader.optional_foreign(&table, "reference"),
    }
}

fn dimension<'a>(entry: &Entry<'a>, reader: &mut Reader<'a>) -> Option<Spanned<usize>> {
    let found = entry.value.get_ref().as_integer().map(|digits| digits.as_str());
    let span = reader.span(entry.value);
    let number = match found {
        Some("1") => Some(1),
        Some("2") => Some(2),
        Some("3") => Some(3),
        Some(_) if !reader.is_damaged(entry.value) => {
            let diagnostic = Diagnostic::error(span, "`dimension` must be 1, 2 or 3");
            reader.report(diagnostic.label("a field is defined on a line, in a plane or in space"));
            None
        }
        _ => {
            reader.wrong_type("dimension", entry.value, "1, 2 or 3");
            None
        }
    };
    number.map(|value| Spanned { value, span })
}

fn displacement_table<'a>(root: &Table<'a>, reader: &mut Reader<'a>) -> Option<Table<'a>> {
    let entry = reader.required_table(root, "displacement")?;
    reader.table(&entry, "[displacement]", DISPLACEMENT)
}

/// The components of u, then the swirl if the field has one.
fn displacement<'a>(
    table: Option<&Table<'a>>,
    space: Space,
    root: Span,
    reader: &mut Reader<'a>,
) -> Vec<Formula> {
    let dimension = space.coordinates();
    let entry = table.and_then(|table| reader.required(table, "u"));
    let mut components = match entry {
        Some(entry) => reader.formulas(&entry, dimension, &one_per_dimension(dimension)),
        None => vec![Formula::reported(root); dimension],
    };
    let swirl = table.filter(|_| space.is_axisymmetric()).and_then(|table| table.get("swirl"));
    components.extend(swirl.map(|entry| reader.formula("swirl", entry.value)));
    components
}

fn components(entry: &Entry<'_>) -> Option<usize> {
    let count = entry.value.get_ref().as_array()?.len();
    (1..=3).contains(&count).then_some(count)
}

/// The tables `[domain]`, `[boundary]` and `[rigid]`.
struct Setup {
    domain: DomainSpec,
    boundary: Vec<BoundarySpec>,
    rigid: Option<RigidSpec>,
}

impl Setup {
    fn read<'a>(root: &Table<'a>, space: Space, reader: &mut Reader<'a>) -> Self {
        let dimension = space.coordinates();
        let entry = reader.required_table(root, "domain");
        let read = entry.map(|entry| domain(&entry, space, reader));
        let boundary = root
            .get("boundary")
            .map(|entry| {
                let body = read.as_ref().map(|domain| &domain.body);
                boundary(&entry, body, space, reader)
            })
            .unwrap_or_default();
        let rigid = root.get("rigid").and_then(|entry| rigid(&entry, space, reader));
        Setup { domain: read.unwrap_or_else(|| reported(dimension, root.span)), boundary, rigid }
    }
}

/// The tables `[[check]]`, `[[study]]` and `[[extreme]]`.
struct Evidence {
    checks: Vec<CheckSpec>,
    studies: Vec<StudySpec>,
    extremes: Vec<ExtremeSpec>,
}

impl Evidence {
    fn read<'a>(
        root: &Table<'a>,
        field: &FieldSpec,
        names: &Names,
        reader: &mut Reader<'a>,
    ) -> Self {
        let (space, possible, known) =
            (field.space, possible_quantities(field), own_quantities(field, None));
        let parameters = field.parameters.iter().map(|parameter| parameter.name.value.as_str());
        let parameters: Vec<&str> = parameters.collect();
        let mut tables = |key: &str, keys: &[Key]| match root.get(key) {
            Some(entry) => reader.tables(&entry, keys),
            None => Vec::new(),
        };
        let (checks, study, extreme) =
            (tables("check", CHECK), tables("study", STUDY), tables("extreme", EXTREME));
        Evidence {
            checks: checks
                .iter()
                .filter_map(|table| check(table, (space, [&possible, &known]), names, reader))
                .collect(),
            studies: studies(&study, reader),
            extremes: extremes(&extreme, &parameters, reader),
        }
    }
}
