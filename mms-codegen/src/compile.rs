//! The table of contents: from a text to everything that follows from it.

use std::collections::BTreeMap;

use crate::certify::certificate::contradictions;
use crate::certify::{declared, near_zero};
use crate::culprit::culprit;
use crate::diagnostic::{self, Diagnostic};
use crate::expr::resolve::Scope;
use crate::expr::{DEFAULT_MAX_NODES, Expr, Graph, Rational, Symbol};
use crate::mechanics::boundary::{Datum, data};
use crate::mechanics::face;
use crate::mechanics::kinematics::Route;
#[cfg(feature = "defects")]
use crate::mechanics::misread;
use crate::mechanics::model::Body;
use crate::mechanics::{Derivation, Model, Response, TooLarge, derive, tangent};
use crate::pass::half_turns::half_turns;
use crate::pass::relations::Relations;
use crate::pass::substitute::substitute;
use crate::program::interpret::{Interpreter, Number, Point};
use crate::program::schedule::schedule;
use crate::program::{Bound, Op, Output, Program};
use crate::selection::{Form, Selection};
use crate::simplify::{simplify, twins};
use crate::source::{SourceId, Sources, Span};
use crate::spec::{self, Face, FieldSpec, Formula, MaterialSpec, moduli};
use crate::suggest::advice;
use crate::syntax::{self, Kind};
use crate::units;
use crate::variation::Variation;

/// The materials that come with the crate: stem and text.
pub const MATERIALS: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/materials.rs"));

/// The stem and the text of the material of that stem that comes with the crate.
pub(crate) fn shipped(stem: &str) -> Option<&'static (&'static str, &'static str)> {
    MATERIALS.iter().find(|(shipped, _)| *shipped == stem)
}

/// Reads the file of a material such as `./mine.toml`, given as the field file writes it.
pub type Loader<'a> = &'a dyn Fn(&str) -> Result<String, String>;

/// A field file, compiled.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The field file.
    pub field: FieldSpec,
    /// The file of its material.
    pub material: MaterialSpec,
    /// The texts, for messages about them.
    pub sources: Sources,
    /// The expressions.
    pub graph: Graph,
    /// The field's own formulas.
    pub model: Model,
    /// What follows from them, as it was derived.
    pub derived: Derivation,
    /// The same; what is wanted in the forms that are cheapest to compute.
    pub derivation: Derivation,
    /// What of it was wanted.
    pub selection: Selection,
    /// Which ways to compute were open.
    pub form: Form,
    /// What is wanted, scheduled.
    pub program: Program,
}

/// Why a field file does not compile.
#[derive(Clone, Debug)]
pub struct Failure {
    /// The texts.
    pub sources: Sources,
    /// Every mistake.
    pub diagnostics: Vec<Diagnostic>,
}

impl Failure {
    /// The text of every mistake, coloured for a terminal.
    pub fn styled(&self) -> String {
        diagnostic::render_styled(&self.sources, &self.diagnostics)
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&diagnostic::render(&self.sources, &self.diagnostics))
    }
}

impl std::error::Error for Failure {}

/// What of a field is compiled, and within which limits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The quantities that are wanted, and the parameters that are set or frozen.
    pub selection: Selection,
    /// How many nodes and operands the expression graph may have.
    pub max_nodes: usize,
    /// Which ways to compute are open.
    pub form: Form,
    /// Another field that is made of this one, to evaluate at extremes.
    pub variation: Variation,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            selection: Selection::default(),
            max_nodes: DEFAULT_MAX_NODES,
            form: Form::Stable,
            variation: Variation::Nothing,
        }
    }
}

impl From<Selection> for Options {
    fn from(selection: Selection) -> Self {
        Options { selection, ..Options::default() }
    }
}

/// Compiles the text of a field file, all of it, within the default limits.
///
/// `name` is the field's name (its file's stem), `path` what messages show. Every mistake of the
/// file and of its material is in the failure.
pub fn compile(name: &str, path: &str, text: &str, load: Loader<'_>) -> Result<Compiled, Failure> {
    compile_with(name, path, text, load, &Options::default())
}

/// Compiles a part of a field, the field with some parameters fixed, or within other limits.
///
/// Mistakes of the selection are in the failure too; [`Selection::entry`] tells them apart. So is
/// what a short search finds to contradict the field: see [`contradictions`].
pub fn compile_with(
    name: &str,
    path: &str,
    text: &str,
    load: Loader<'_>,
    options: &Options,
) -> Result<Compiled, Failure> {
    let compiled = compile_unproved(name, path, text, load, options)?;
    match contradictions(&compiled) {
        found if found.is_empty() => Ok(compiled),
        diagnostics => Err(Failure { sources: compiled.sources, diagnostics }),
    }
}

/// The same without a look at what the field claims: for [`crate::certify::certificate::certify`],
/// which looks longer.
pub fn compile_unproved(
    name: &str,
    path: &str,
    text: &str,
    load: Loader<'_>,
    options: &Options,
) -> Result<Compiled, Failure> {
    let mut sources = Sources::default();
    let mut diagnostics = Vec::new();
    match phases(name, path, text, load, options, &mut sources, &mut diagnostics) {
        Some(compiled) if diagnostics.is_empty() => Ok(compiled),
        _ => Err(Failure { sources, diagnostics }),
    }
}

/// The exact value of an expression without names, such as `1e6` or `2/3`.
pub fn constant(text: &str) -> Result<Rational, Failure> {
    let mut sources = Sources::default();
    let source = sources.add("value", text);
    let span = sources.span(source, 0, text.len());
    let mut diagnostics = Vec::new();
    let mut graph = Graph::default();
    let value = syntax::parse(&Formula::plain(text, span), &mut diagnostics)
        .and_then(|ast| Scope::default().resolve(&mut graph, &ast, &mut diagnostics))
        .and_then(|value| {
            let number = graph.as_number(value).cloned();
            if number.is_none() {
                let message = "the value is not a rational number";
                diagnostics.push(Diagnostic::error(span, message).label("give its digits"));
            }
            number
        });
    value.ok_or(Failure { sources, diagnostics })
}

fn phases(
    name: &str,
    path: &str,
    text: &str,
    load: Loader<'_>,
    options: &Options,
    sources: &mut Sources,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Compiled> {
    let selection = &options.selection;
    let mut graph = Graph::with_limit(options.max_nodes);
    let source = sources.add(path, text);
    let mut field = spec::read_field(sources, source, name, diagnostics)?;
    selection.apply(sources, &mut field, diagnostics);
    options.variation.rewrite(sources, &mut field);
    let mut material = read_material(sources, &field, load, diagnostics);
    if let Some(material) = &mut material {
        moduli::convert(sources, &field, material, diagnostics);
    }
    diagnostics.extend(units::check(sources, &field, material.as_ref()));
    let reported = diagnostics.len();
    let model = Model::resolve(&mut graph, &field, material.as_ref(), diagnostics);
    selection.explain(sources, &field, &mut diagnostics[reported..]);
    let (mut model, material) = (model?, material?);
    let specs = (&field, &material);
    let reported = diagnostics.len();
    diagnostics.extend(declared::check(&graph, &model, specs, &BTreeMap::new()));
    selection.explain(sources, &field, &mut diagnostics[reported..]);
    diagnostics.extend(rotates_unfit_material(&field, &material));
    if !diagnostics.is_empty() {
        return None;
    }
    options.variation.transform(&mut graph, &mut model);
    let derived = derive(&mut graph, &model, &Relations::default(), Route::Gradient)
        .map_err(|TooLarge(what)| diagnostics.push(too_large(&field, &graph, what)))
        .ok()?;
    #[cfg(feature = "defects")]
    let (model, derived) = match misread::moduli(&mut graph, &field, &material, &model) {
        None => (model, derived),
        Some(wrong) => {
            let of_wrong = derive(&mut graph, &wrong, &Relations::default(), Route::Gradient);
            (wrong, Derivation { responses: derived.responses, ..of_wrong.ok()? })
        }
    };
    // The force of a twin needs the motion of the field.
    let needed = |quantity| model.rigid.is_some() || selection.wants(quantity);
    let derivation = simplify(&mut graph, &model, &derived, options.form, needed);
    let (derived, derivation) = match &model.rigid {
        Some(rigid) => twins(&mut graph, rigid, [&derived, &derivation]),
        None => (derived, derivation),
    };
    let mut outputs = outputs(&mut graph, &model, &field, &derivation);
    outputs.retain(|output, _| selection.schedules(*output, &field));
    for components in outputs.values_mut() {
        *components = half_turns(&mut graph, components);
    }
    near_zero(&mut graph, &field, &model, &mut outputs);
    if graph.is_exhausted() {
        diagnostics.push(too_large(&field, &graph, "simplified form"));
        return None;
    }
    let program = schedule(&graph, &outputs);
    diagnostics.extend(unrepresentable(&field, &program));
    diagnostics.extend(selection.undefined(sources, &field, &program));
    let (sources, selection) = (sources.clone(), selection.clone());
    Some(Compiled {
        field,
        material,
        sources,
        graph,
        model,
        derived,
        derivation,
        selection,
        form: options.form,
        program,
    })
}

/// A rotation of a material that a rotation strains.
fn rotates_unfit_material(field: &FieldSpec, material: &MaterialSpec) -> Option<Diagnostic> {
    let angle = field.rigid.as_ref()?.angle().filter(|_| !material.frame_indifferent)?;
    let message = format!("`{}` cannot be rotated: it is not frame-indifferent", material.name);
    Some(
        Diagnostic::error(angle.span, message)
            .label("would strain the material")
            .help("the energy of this material changes with a rotation, W(Q F) != W(F): give a translation alone, or another material"),
    )
}

/// A constant that no double precision number is near to, if the program has one.
fn unrepresentable(field: &FieldSpec, program: &Program) -> Option<Diagnostic> {
    let infinite = |op: &Op| match op {
        Op::Constant(number) => number.to_f64().value().is_infinite(),
        _ => false,
    };
    program.instrs.iter().find(|instr| infinite(&instr.op))?;
    let (span, label) = match field.formulas().find_map(huge_number) {
        Some(span) => (span, "too large"),
        None => {
            let first = field.displacement.first();
            let span = first.map_or(field.material.span, |formula| formula.span);
            (span, "here, or in what it uses")
        }
    };
    Some(
        Diagnostic::error(span, "a constant of this field is beyond the range of double precision")
            .label(label)
            .help("numbers up to 1.797e308 can be computed with: choose other units"),
    )
}

/// Where a formula has a number that no double precision number is near to.
fn huge_number(formula: &Formula) -> Option<Span> {
    let is_huge = |kind: &Kind| match kind {
        Kind::Number(number) => number.to_f64().value().is_infinite(),
        _ => false,
    };
    let ast = syntax::parse(formula, &mut Vec::new())?;
    ast.nodes.iter().find(|node| is_huge(&node.kind)).map(|node| node.span)
}

/// The derivation of `what` filled the graph: points at the part of the file that made most of it.
fn too_large(field: &FieldSpec, graph: &Graph, what: &str) -> Diagnostic {
    let culprit = culprit(field);
    let span = match &culprit {
        Some(culprit) => culprit.span,
        None => field.displacement.first().map_or(field.material.span, |formula| formula.span),
    };
    let label = match &culprit {
        Some(culprit) => format!("most of them come from here, in {}", culprit.definition),
        None => "here, or in what it uses".into(),
    };
    let diagnostic =
        Diagnostic::error(span, format!("the {what} of this field is too large")).label(label);
    Diagnostic { help: graph.exhaustion(), ..diagnostic }
}

fn read_material(
    sources: &mut Sources,
    field: &FieldSpec,
    load: Loader<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<MaterialSpec> {
    let (source, stem) = find_material(sources, field, load, diagnostics)?;
    spec::read_material(sources, source, &stem, diagnostics)
}

fn find_material(
    sources: &mut Sources,
    field: &FieldSpec,
    load: Loader<'_>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<(SourceId, String)> {
    let model = &field.material.model;
    let shown = &model.value;
    if shown.is_empty() {
        // The missing model has been reported.
        return None;
    }
    if let Some((stem, text)) = shipped(shown) {
        return Some((sources.add(format!("materials/{stem}.toml"), *text), stem.to_string()));
    }
    if shown.ends_with(".toml") {
        return match load(shown) {
            Ok(text) => {
                let file = shown.rsplit('/').next().unwrap_or(shown);
                let stem = file.trim_end_matches(".toml").to_string();
                let field_path = &sources.get(model.span.source).path;
                Some((sources.add(beside(field_path, shown), text), stem))
            }
            Err(reason) => {
                let message = format!("cannot read the material file `{shown}`");
                diagnostics.push(
                    Diagnostic::error(model.span, message)
                        .label(reason)
                        .help("the path is relative to the field file"),
                );
                None
            }
        };
    }
    let stems = MATERIALS.iter().map(|(stem, _)| *stem);
    let diagnostic = Diagnostic::error(model.span, format!("unknown material `{shown}`"))
        .label("no such material");
    diagnostics.push(diagnostic.help(advice(shown, stems, |all| {
        format!("shipped materials: {all}; one of your own is written \"./mine.toml\"")
    })));
    None
}

/// The path of a file that is named relative to another one.
fn beside(path: &str, relative: &str) -> String {
    let relative = relative.trim_start_matches("./");
    match path.rsplit_once('/') {
        Some((folder, _)) if !relative.starts_with('/') => format!("{folder}/{relative}"),
        _ => relative.to_string(),
    }
}

fn outputs(
    graph: &mut Graph,
    model: &Model,
    field: &FieldSpec,
    derivation: &Derivation,
) -> BTreeMap<Output, Vec<Expr>> {
    let mut outputs = BTreeMap::new();
    for (quantity, components) in &derivation.quantities {
        outputs.insert(Output::Quantity(*quantity), components.clone());
    }
    for (response, components) in &derivation.responses {
        outputs.insert(Output::Response(*response), components.clone());
    }
    for ((face, datum), components) in data(graph, model, field, derivation) {
        outputs.insert(Output::Face(face, datum), components);
    }
    match &model.domain.body {
        Body::Box { lower, upper } => {
            outputs.insert(Output::Bound(Bound::Lower), lower.clone());
            outputs.insert(Output::Bound(Bound::Upper), upper.clone());
        }
        Body::Annulus { inner, outer, theta } => {
            outputs.insert(Output::Bound(Bound::Inner), vec![*inner]);
            outputs.insert(Output::Bound(Bound::Outer), vec![*outer]);
            outputs.insert(Output::Bound(Bound::Theta), theta.to_vec());
        }
    }
    outputs.insert(Output::Bound(Bound::Time), model.domain.time.to_vec());
    for (index, value) in parameter_values(graph, model, &BTreeMap::new()).into_iter().enumerate() {
        outputs.insert(Output::Parameter(index), vec![value]);
    }
    outputs
}

/// The parameters' values as constants, some of them set by the caller.
pub(crate) fn parameter_values(
    graph: &mut Graph,
    model: &Model,
    set: &BTreeMap<usize, Rational>,
) -> Vec<Expr> {
    let mut known = BTreeMap::new();
    for (index, parameter) in model.parameters.iter().enumerate() {
        let value = match set.get(&index) {
            Some(number) => graph.number(number.clone()),
            None => substitute(graph, &[parameter.default], &known)[0],
        };
        known.insert(Symbol::Parameter(index), value);
    }
    known.into_values().collect()
}

impl Compiled {
    /// The parameters' values in the order of the file; those that depend on a set one follow it.
    pub fn parameters<T: Number>(&self, set: &BTreeMap<usize, Rational>) -> Vec<T> {
        let mut graph = self.graph.clone();
        graph.make_room();
        let values = parameter_values(&mut graph, &self.model, set);
        let outputs = values
            .into_iter()
            .enumerate()
            .map(|(index, value)| (Output::Parameter(index), vec![value]))
            .collect();
        let program = schedule(&graph, &outputs);
        let interpreter = Interpreter::<T>::new(&program, &[]);
        (0..self.model.parameters.len())
            .flat_map(|index| interpreter.output(Output::Parameter(index)))
            .collect()
    }

    /// What the output was made by and of: the crate's version and a hash of the input texts.
    pub fn provenance(&self) -> String {
        format!("mms-codegen {} from input {}", env!("CARGO_PKG_VERSION"), self.input_hash())
    }

    /// What tells the input texts from others: 16 hexadecimal digits.
    pub fn input_hash(&self) -> String {
        // FNV-1a (Fowler, Noll & Vo): tells inputs apart, and is the same everywhere.
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        for byte in self.sources.texts().flat_map(str::bytes) {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
        format!("{hash:016x}")
    }

    /// Path and text of the material's file, where it is the user's own.
    pub fn own_material(&self) -> Option<(&str, &str)> {
        let model = self.field.material.model.value.as_str();
        let source = self.material.strain_energy.span.source;
        shipped(model).is_none().then(|| (model, self.sources.get(source).text.as_str()))
    }

    /// dP/dF as a function of a displacement gradient, as [`Response::Tangent`]: a program of its
    /// own, which costs nothing where it is not asked for. An error where it is too large.
    pub fn tangent(&self) -> Result<Program, TooLarge> {
        let mut graph = self.graph.clone();
        graph.make_room();
        let components = tangent(&mut graph, &self.model)?;
        let output = Output::Response(Response::Tangent);
        Ok(schedule(&graph, &BTreeMap::from([(output, components)])))
    }

    /// The face of that name; otherwise what is wrong with it, in one line.
    pub fn face(&self, name: &str) -> Result<Face, String> {
        let faces = Face::of(&self.field.domain.body, self.field.dimension);
        let names = || faces.iter().map(|face| face.name());
        faces.iter().copied().find(|face| face.name() == name).ok_or_else(|| {
            let advice = advice(name, names(), |all| format!("this body has {all}"));
            format!("no such face; {advice}")
        })
    }

    /// The outward reference unit normal of a face, as a program of its own.
    pub fn normal(&self, face: Face) -> Program {
        let mut graph = self.graph.clone();
        graph.make_room();
        let dimension = self.model.displacement.len();
        let normal = face::normal(&mut graph, &self.model.domain.body, dimension, face);
        schedule(&graph, &BTreeMap::from([(Output::Face(face, Datum::Normal), normal)]))
    }

    /// The outward reference unit normals of a face at points of it, `dimension` components each.
    pub fn normals<T: Number, P: AsRef<[T]>>(
        &self,
        face: Face,
        parameters: &[T],
        points: impl IntoIterator<Item = P>,
    ) -> Vec<Vec<T>> {
        let program = self.normal(face);
        let output = Output::Face(face, Datum::Normal);
        let mut interpreter = Interpreter::new(&program, parameters);
        let plan = interpreter.plan(&[output]);
        let normal = |point: P| {
            interpreter.set_point(&plan, Point::at(point.as_ref()));
            interpreter.output(output)
        };
        points.into_iter().map(normal).collect()
    }

    /// The quantities that have a closed form, each beside it, as one program.
    pub fn checks(&self) -> Program {
        let mut outputs = BTreeMap::new();
        for (index, check) in self.model.checks.iter().enumerate() {
            let quantity = check.quantity;
            outputs.insert(Output::Expected(index), check.equals.clone());
            outputs
                .insert(Output::Quantity(quantity), self.derivation.quantities[&quantity].clone());
        }
        schedule(&self.graph, &outputs)
    }
}
