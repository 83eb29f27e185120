//! The phases of a compilation: read a text, transform it, derive from it, simplify, and schedule.
//!
//! Each phase has its own budget of steps ([`crate::work`]). If reading or deriving spends its budget, the text is refused. If
//! simplifying or scheduling spends its budget, the shortest form found so far is kept.

use super::{Compiled, Loader, Options};
use crate::bounds::angles::near_zero;
use crate::culprit::culprit;
use crate::declared;
use crate::materials::{MATERIALS, shipped};
use mms_mechanics::boundary::data;
#[cfg(feature = "defects")]
use mms_mechanics::faults;
use mms_mechanics::kinematics::Route;
use mms_mechanics::model::parameter_values;
use mms_mechanics::offset::about_its_place;
use mms_mechanics::output::parts;
use mms_mechanics::simplify::{simplify, twins};
use mms_mechanics::{Bound, Output, Program};
use mms_mechanics::{Derivation, Model, TooLarge, derive};
use mms_program::Op;
use mms_program::schedule::schedule;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::language::SCOPE;
use mms_spec::own::Own;
use mms_spec::source::{SourceId, Sources, Span};
use mms_spec::suggest::advice;
use mms_spec::syntax;
use mms_spec::syntax::NodeKind;
use mms_spec::units;
use mms_spec::{FieldSpec, Formula, MaterialSpec, moduli, own_quantities, settle_checks};
use mms_symbolic::expr::{DEFAULT_MAX_NODES, Expr, Graph};
use mms_symbolic::pass::half_turns::half_turns;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::whole_turns::whole_turns;
use mms_symbolic::sorted::SortedMap;

/// The budget of reading, and of deriving, in steps for each node that a graph may have: a text that needs more is refused.
const STEPS_PER_NODE: u64 = 700;

/// The budget of simplifying, and of scheduling, for each node: once it is spent, further forms are not tried.
const STEPS_OF_SIMPLIFYING: u64 = 4200;

/// A compilation in progress: the request, the texts read so far, and every mistake found.
pub(super) struct Phases<'a> {
    options: &'a Options,
    load: Loader<'a>,
    pub sources: Sources,
    pub diagnostics: Vec<Diagnostic>,
}

/// A field file and its material, read without a mistake.
struct Read {
    field: FieldSpec,
    material: MaterialSpec,
    model: Model,
}

impl<'a> Phases<'a> {
    pub fn new(options: &'a Options, load: Loader<'a>) -> Self {
        Phases { options, load, sources: Sources::default(), diagnostics: Vec::new() }
    }

    /// Runs all phases; a mistake may end them, or be found beside others.
    pub fn run(&mut self, name: &str, path: &str, text: &str) -> Option<Compiled> {
        let mut graph = Graph::with_limit(self.options.max_nodes).stopped_by(&self.options.stop);
        self.allow(&graph, STEPS_PER_NODE);
        let mut read = self.read(&mut graph, name, path, text)?;
        self.options.variation.transform(&mut graph, &mut read.model);
        about_its_place(&mut graph, &mut read.model);
        let (derived, simplest) = self.derive(&mut graph, &mut read)?;
        let simplified = simplest.is_some() && !graph.work().is_over();
        let mut derivation = simplest.unwrap_or_else(|| derived.clone());
        self.options.variation.falsify(&mut graph, &mut derivation);
        self.allow(&graph, STEPS_OF_SIMPLIFYING);
        let program = self.schedule(&mut graph, &read, &derivation)?;
        // Later work on the graph has budgets of its own.
        graph.work().allow(u64::MAX);
        let Read { field, material, model } = read;
        Some(Compiled {
            field,
            material,
            sources: self.sources.clone(),
            graph,
            model,
            derived,
            derivation,
            selection: self.options.selection.clone(),
            form: self.options.form,
            simplified,
            program,
        })
    }

    /// The quantities that a text defines.
    pub fn own_quantities(&mut self, name: &str, path: &str, text: &str) -> Vec<Own> {
        let source = self.sources.add(path, text);
        let field = mms_spec::read_field(&self.sources, source, name, &mut self.diagnostics);
        let Some(field) = field else { return Vec::new() };
        let material = self.read_material(&field);
        own_quantities(&field, material.as_ref())
    }

    /// Replaces all messages by one that says that the work was stopped.
    pub fn stopped(&mut self) {
        let Some(source) = self.sources.nth(0) else { return };
        let message = "the work on this field was stopped before its end";
        let start = Diagnostic::error(self.sources.span(source, 0, 0), message);
        self.diagnostics =
            vec![start.help("the caller that requested the field requested the stop")];
    }

    /// Grants a phase `steps` steps for each node that a graph may have.
    fn allow(&self, graph: &Graph, steps: u64) {
        let nodes = self.options.max_nodes.max(DEFAULT_MAX_NODES) as u64;
        graph.work().allow(steps.saturating_mul(nodes));
    }

    /// Reads the field and its material, and reports every mistake.
    fn read(&mut self, graph: &mut Graph, name: &str, path: &str, text: &str) -> Option<Read> {
        let Options { selection, variation, .. } = self.options;
        let source = self.sources.add(path, text);
        let mut field = mms_spec::read_field(&self.sources, source, name, &mut self.diagnostics)?;
        selection.apply(&mut self.sources, &mut field, &mut self.diagnostics);
        variation.rewrite(&mut self.sources, &mut field);
        let mut material = self.read_material(&field);
        let Self { sources, diagnostics, .. } = self;
        if let Some(material) = &mut material {
            field.material.tell_givens(material);
            moduli::convert(sources, &field, material, diagnostics);
        }
        let own = own_quantities(&field, material.as_ref());
        if material.is_some() {
            settle_checks(&mut field, &own, diagnostics);
        }
        diagnostics.extend(units::check(sources, &field, material.as_ref()));
        let reported = diagnostics.len();
        let model = Model::resolve(graph, &field, material.as_ref(), diagnostics);
        selection.explain(sources, &field, &mut diagnostics[reported..]);
        let (model, material) = (model?, material?);
        let specs = (&field, &material);
        let reported = diagnostics.len();
        diagnostics.extend(declared::check(graph, &model, specs, &SortedMap::new()));
        if diagnostics.is_empty() {
            diagnostics.extend(declared::extremes(graph, &model, specs));
        }
        selection.explain(sources, &field, &mut diagnostics[reported..]);
        diagnostics.extend(rotates_unfit_material(&field, &material));
        diagnostics.is_empty().then_some(Read { field, material, model })
    }

    /// Derives the quantities of the model: plainly and, if the limits of nodes and work allow it, simplified.
    fn derive(
        &mut self,
        graph: &mut Graph,
        read: &mut Read,
    ) -> Option<(Derivation, Option<Derivation>)> {
        let derived = derive(graph, &read.model, &Relations::default(), Route::Gradient)
            .map_err(|TooLarge(what)| self.diagnostics.push(too_large(&read.field, graph, what)))
            .ok()?;
        #[cfg(feature = "defects")]
        let derived = faults(graph, read, derived)?;
        let Options { selection, form, .. } = self.options;
        // The force of a rigid twin needs the motion of the field.
        let needed = |quantity| read.model.rigid.is_some() || selection.wants(quantity);
        self.allow(graph, STEPS_OF_SIMPLIFYING);
        let simplified =
            graph.attempt(|graph| simplify(graph, &read.model, &derived, *form, needed));
        Some(match &read.model.rigid {
            Some(rigid) => {
                let inner = simplified.as_ref().unwrap_or(&derived);
                let (plain, twin) = twins(graph, rigid, [&derived, inner]);
                (plain, simplified.is_some().then_some(twin))
            }
            None => (derived, simplified),
        })
    }

    /// Schedules the wanted part of a derivation as a program.
    fn schedule(
        &mut self,
        graph: &mut Graph,
        Read { field, model, .. }: &Read,
        derivation: &Derivation,
    ) -> Option<Program> {
        let selection = &self.options.selection;
        let mut outputs = outputs(graph, model, field, derivation);
        outputs.retain(|output, _| selection.schedules(*output, field));
        for components in outputs.values_mut() {
            *components = half_turns(graph, components);
        }
        near_zero(graph, field, model, &mut outputs);
        for components in outputs.values_mut() {
            *components = whole_turns(graph, components);
        }
        if graph.is_exhausted() {
            self.diagnostics.push(too_large(field, graph, "simplified form"));
            return None;
        }
        let program = schedule(graph, &outputs);
        self.diagnostics.extend(unrepresentable(field, &program));
        self.diagnostics.extend(selection.undefined(&self.sources, field, &program));
        Some(program)
    }

    fn read_material(&mut self, field: &FieldSpec) -> Option<MaterialSpec> {
        let (source, stem) = self.find_material(field)?;
        mms_spec::read_material(&self.sources, source, &stem, &mut self.diagnostics)
    }

    fn find_material(&mut self, field: &FieldSpec) -> Option<(SourceId, String)> {
        let Self { load, sources, diagnostics, .. } = self;
        let model = &field.material.model;
        let path = model.value.raw();
        if path.is_empty() {
            // The missing model has been reported.
            return None;
        }
        if let Some((stem, text)) = shipped(path) {
            return Some((sources.add(format!("materials/{stem}.toml"), *text), stem.to_string()));
        }
        if path.ends_with(".toml") {
            return match load(path) {
                Ok(text) => {
                    let file = path.rsplit('/').next().unwrap_or(path);
                    let stem = file.trim_end_matches(".toml").to_string();
                    let field_path = &sources.get(model.span.source).path;
                    Some((sources.add(beside(field_path.raw(), path), text), stem))
                }
                Err(reason) => {
                    let message =
                        format!("cannot read the material file `{}`", model.value.shown());
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
        let diagnostic =
            Diagnostic::error(model.span, format!("unknown material `{}`", model.value.shown()))
                .label("no such material");
        diagnostics.push(diagnostic.help(advice(path, stems, |all| {
            format!("shipped materials: {all}; one of your own is written \"./mine.toml\": {SCOPE}")
        })));
        None
    }
}

/// Derives the field with the wrong moduli of a deliberate mistake; the responses that a solver uses keep the right ones.
#[cfg(feature = "defects")]
fn faults(graph: &mut Graph, read: &mut Read, derived: Derivation) -> Option<Derivation> {
    let Read { field, material, model } = read;
    let Some(wrong) = faults::moduli(graph, field, material, model) else {
        return Some(derived);
    };
    let of_wrong = derive(graph, &wrong, &Relations::default(), Route::Gradient).ok()?;
    *model = wrong;
    Some(Derivation { responses: derived.responses, ..of_wrong })
}

/// Refuses a rotation of a material whose energy changes under rotations.
fn rotates_unfit_material(field: &FieldSpec, material: &MaterialSpec) -> Option<Diagnostic> {
    let angle = field.rigid.as_ref()?.angle().filter(|_| !material.frame_indifferent)?;
    let message =
        format!("`{}` cannot be rotated: it is not frame-indifferent", material.name.shown());
    Some(
        Diagnostic::error(angle.span, message)
            .label("would strain the material")
            .help("the energy of this material changes with a rotation, W(Q F) != W(F): give a translation alone, or another material"),
    )
}

/// A constant outside the range of double precision, if the program has one.
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

/// The place of a number in a formula that is outside the range of double precision.
fn huge_number(formula: &Formula) -> Option<Span> {
    let is_huge = |kind: &NodeKind| match kind {
        NodeKind::Number(number) => number.to_f64().value().is_infinite(),
        _ => false,
    };
    let ast = syntax::parse(formula, &mut Vec::new())?;
    ast.nodes.iter().find(|node| is_huge(&node.kind)).map(|node| node.span)
}

/// The message that the derivation of `what` filled the graph; it points at the part of the file that made most of it.
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

/// The path of a file that is written relative to another one.
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
) -> SortedMap<Output, Vec<Expr>> {
    let mut outputs = SortedMap::new();
    for (quantity, components) in &derivation.quantities {
        outputs.insert(Output::Quantity(*quantity), components.clone());
    }
    for (response, components) in &derivation.responses {
        outputs.insert(Output::Response(*response), components.clone());
    }
    for ((face, datum), components) in data(graph, model, field, derivation) {
        outputs.insert(Output::Face(face, datum), components);
    }
    let zero = graph.number(0);
    for (bound, values) in parts(&model.domain.body, zero) {
        outputs.insert(Output::Bound(bound), values);
    }
    outputs.insert(Output::Bound(Bound::Time), model.domain.time.to_vec());
    for (index, value) in parameter_values(graph, model, &SortedMap::new()).into_iter().enumerate()
    {
        outputs.insert(Output::Parameter(index), vec![value]);
    }
    outputs
}
