//! The selection of quantities of a field, of values of its parameters, and of parameters that become constants.
//!
//! A selection is applied to the field as it was read, before any name is resolved. A set value replaces the file's formula,
//! and the name of a frozen parameter means its value at the defaults, not a leaf. So everything from name resolution on uses a
//! number: the graph folds it (0 ln J vanishes, and the derivation with it), assumptions about its sign hold, and a division by
//! zero is reported in the formula where it happens, with the frozen values. A value that becomes undefined only by the
//! derivation (F = 0, then 1/J) is found in the scheduled program, whose constants are evaluated in arbitrary precision.
//!
//! If `quantities` are listed, only these are scheduled and emitted: no domain, no material, no contract of the runtime.
//! Messages about the selection itself point into it: `set:1:8`, or the macro's token.

use crate::compile::Compiled;
use mms_mechanics::Response;
use mms_mechanics::{Bound, Output, Program};
use mms_program::interpret::{Interpreter, Number as _};
use mms_program::precise::Precise;
use mms_program::{Op, Value};
use mms_spec::Form;
use mms_spec::diagnostic::{Diagnostic, quoted};
use mms_spec::own::Own;
use mms_spec::quantity::Quantity;
use mms_spec::source::{Sources, Span};
use mms_spec::suggest::advice;
use mms_spec::twin::Twin;
use mms_spec::{FieldSpec, Formula, ParameterSpec};
use mms_symbolic::expr::{Rational, Symbol};
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// The wanted part of a field. The default is everything, as the file says it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// The quantities; `None` means all, and everything else that a solver needs: the body, the time window, and the material
    /// as a function of a displacement gradient.
    pub quantities: Option<SortedSet<Quantity>>,
    /// New default values: the name of a parameter and a formula, which may use the parameters above that one. Parameters that
    /// depend on it follow.
    pub set: Vec<(String, String)>,
    /// The parameters that become constants.
    pub freeze: Freeze,
    /// A rigid motion on top of the field.
    pub twin: Twin,
    /// The first and the last time, which replace the file's: formulas in the parameters.
    pub window: Option<[String; 2]>,
}

/// The parameters that become constants, at their default values. They are then no parameters of the generated code.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Freeze {
    /// No parameter.
    #[default]
    Nothing,
    /// All parameters.
    Everything,
    /// The parameters with these names.
    Only(Vec<String>),
}

/// The part of a selection that a message is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Entry {
    /// The value at this position of [`Selection::set`].
    Set(usize),
    /// The name at this position of [`Freeze::Only`].
    Freeze(usize),
    /// All frozen parameters.
    Frozen,
}

/// Finds a compiled quantity by name or alias, and refuses quantities that are derived on request. `own` are the quantities
/// that the field file defines.
///
/// # Errors
///
/// The mistake, in one line.
pub fn compiled_quantity(own: &[Own], name: &str) -> Result<Quantity, String> {
    match any_quantity(own, name)? {
        found if found.is_on_request() => Err(format!(
            "the quantity {} is not compiled; `mms eval`, `mms state` and `mms judge` derive it from cauchy_stress, \
             first_piola_kirchhoff or displacement_gradient",
            quoted(found.name())
        )),
        found => Ok(found),
    }
}

/// Finds any quantity by name or alias, including quantities that are derived on request. `own` are the quantities that the
/// field file defines.
///
/// # Errors
///
/// The mistake, in one line.
pub fn any_quantity(own: &[Own], name: &str) -> Result<Quantity, String> {
    Quantity::among(own, name).ok_or_else(|| {
        let known = Quantity::evaluated().map(|quantity| quantity.name());
        let known = known.chain(own.iter().map(|own| own.described().name.as_str()));
        let advice = advice(name, known, |all| format!("the quantities are {all}"));
        format!("unknown quantity {}; {advice}", quoted(name))
    })
}

impl Freeze {
    /// The names that the user listed.
    fn names(&self) -> &[String] {
        match self {
            Freeze::Only(names) => names,
            Freeze::Nothing | Freeze::Everything => &[],
        }
    }
}

impl Selection {
    /// Whether everything that a solver needs is wanted.
    pub fn is_for_a_solver(&self) -> bool {
        self.quantities.is_none()
    }

    /// Whether a quantity is wanted.
    pub fn wants(&self, quantity: Quantity) -> bool {
        self.quantities.as_ref().is_none_or(|wanted| wanted.contains(&quantity))
    }

    /// Whether an output is part of the program. Bounds of the domain and closed forms always are.
    pub(crate) fn schedules(&self, output: Output, field: &FieldSpec) -> bool {
        match output {
            Output::Quantity(quantity) => self.wants(quantity),
            Output::Response(_) | Output::Face(..) => self.is_for_a_solver(),
            Output::Parameter(index) => !field.parameters[index].frozen,
            Output::Bound(_) | Output::Expected(_) => true,
        }
    }

    /// The part of the selection that a message of the compiler is about, if it is not about a file.
    pub fn entry(&self, span: Span) -> Option<Entry> {
        // The field file is the first source; the entries are the next ones.
        let position = span.source.index().checked_sub(1)?;
        if position < self.set.len() {
            return Some(Entry::Set(position));
        }
        if self.freeze == Freeze::Nothing || span.source.index() > self.frozen_source() {
            return None;
        }
        let last = span.source.index() == self.frozen_source();
        Some(if last { Entry::Frozen } else { Entry::Freeze(position - self.set.len()) })
    }

    /// The position of the text that names all frozen parameters.
    fn frozen_source(&self) -> usize {
        1 + self.set.len() + self.freeze.names().len()
    }

    /// Replaces the file's values by the chosen ones, marks frozen parameters, and adds the rigid motion. The texts of the
    /// entries become sources of their own, directly after the field file.
    pub(crate) fn apply(
        &self,
        sources: &mut Sources,
        field: &mut FieldSpec,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        self.apply_values(sources, field, diagnostics);
        if self.window.is_some() && field.is_static() {
            diagnostics.push(
                Diagnostic::error(field.material.span, "a static field has no time window")
                    .label("the field has no time"),
            );
        } else if let Some(window) = &self.window {
            field.domain.time = Some(moved(sources, window));
            field.domain.is_moved = true;
        }
        self.twin.apply(sources, field, diagnostics);
    }

    fn apply_values(
        &self,
        sources: &mut Sources,
        field: &mut FieldSpec,
        diagnostics: &mut Vec<Diagnostic>,
    ) {
        let mut seen = SortedSet::new();
        for (name, value) in &self.set {
            let source = sources.add("set", format!("{name} = {value}"));
            let span = sources.span(source, 0, name.len());
            let Some(index) = find(field, name, span, diagnostics) else { continue };
            if !seen.insert(index) {
                diagnostics.push(twice(span, name, "set"));
            }
            let start = name.len() + " = ".len();
            let span = sources.span(source, start, start + value.len());
            field.parameters[index].value = Formula::plain(value, span);
        }
        if self.freeze == Freeze::Nothing {
            return;
        }
        for name in self.freeze.names() {
            let source = sources.add("freeze", name.as_str());
            let span = sources.span(source, 0, name.len());
            let Some(index) = find(field, name, span, diagnostics) else { continue };
            if field.parameters[index].frozen {
                diagnostics.push(twice(span, name, "frozen"));
            }
            field.parameters[index].frozen = true;
        }
        if self.freeze == Freeze::Everything {
            field.parameters.iter_mut().for_each(|parameter| parameter.frozen = true);
        }
        let all = frozen(field).map(|parameter| parameter.name.value.as_str());
        let all = all.collect::<Vec<_>>().join(", ");
        sources.add("freeze", all);
    }

    /// Adds the frozen values to messages about the field: the file does not show them.
    pub(crate) fn explain(
        &self,
        sources: &Sources,
        field: &FieldSpec,
        diagnostics: &mut [Diagnostic],
    ) {
        let all: Vec<&ParameterSpec> = frozen(field).collect();
        if all.is_empty() {
            return;
        }
        for diagnostic in diagnostics {
            if self.entry(diagnostic.span).is_some() {
                continue;
            }
            let text = sources.slice(diagnostic.span);
            let named = |parameter: &&&ParameterSpec| mentions(text, &parameter.name.value);
            let mut about: Vec<_> = all.iter().filter(named).collect();
            if about.is_empty() {
                about = all.iter().collect();
            }
            let values: Vec<_> = about
                .iter()
                .map(|parameter| (&parameter.name.value, &parameter.value.text))
                .map(|(name, value)| quoted(&format!("{name} = {value}")))
                .collect();
            diagnostic.help.push(format!("frozen: {}", values.join(", ")));
        }
    }

    /// A value that the frozen parameters leave undefined, such as 1/0, if the program has one.
    pub(crate) fn undefined(
        &self,
        sources: &Sources,
        field: &FieldSpec,
        program: &Program,
    ) -> Option<Diagnostic> {
        frozen(field).next()?;
        let value = undefined_constant(program)?;
        let output = program.outputs.keys().find(|output| program.needed(&[**output])[value])?;
        let what = output_name(*output);
        let source = sources.nth(self.frozen_source())?;
        let span = sources.span(source, 0, usize::MAX);
        Some(
            Diagnostic::error(span, format!("the {what} is not defined with these values"))
                .label("constants")
                .help("a division by zero, or a root or logarithm outside its domain: choose other values, or freeze fewer parameters"),
        )
    }
}

impl Compiled {
    /// The selection, in lines without a full stop; none if it is everything.
    pub fn selected(&self) -> Vec<String> {
        let value = |index: usize| {
            let parameter = &self.model.parameters[index];
            let value = self.graph.print(parameter.default, &self.model.names);
            format!("{} = {value}", parameter.name)
        };
        let mut lines = Vec::new();
        if self.form != Form::default() {
            lines.push(format!("Form: {}", self.form.name()));
        }
        if let Some(quantities) = &self.selection.quantities {
            let names: Vec<_> = quantities.iter().map(|quantity| quantity.name()).collect();
            lines.push(format!("Quantities: {}", names.join(", ")));
        }
        let window = self.selection.window.iter();
        lines.extend(window.map(|[from, to]| format!("Time window: {from} to {to}")));
        lines.extend(
            self.selection.twin.text(&self.field).map(|keys| format!("Rigid motion: {keys}")),
        );
        let parameters = || self.field.parameters.iter().enumerate();
        let set = |name: &str| self.selection.set.iter().any(|(set, _)| set == name);
        let set: Vec<_> = parameters()
            .filter(|(_, parameter)| set(&parameter.name.value) && !parameter.frozen)
            .map(|(index, _)| value(index))
            .collect();
        let frozen: Vec<_> = parameters()
            .filter(|(_, parameter)| parameter.frozen)
            .map(|(index, _)| value(index))
            .collect();
        for (what, values) in [("Changed defaults", set), ("Constants", frozen)] {
            if !values.is_empty() {
                lines.push(format!("{what}: {}", values.join(", ")));
            }
        }
        lines
    }
}

/// The formulas of a time window, which become a source of their own.
fn moved(sources: &mut Sources, [from, to]: &[String; 2]) -> [Formula; 2] {
    let source = sources.add("window", format!("{from},{to}"));
    let formula = |text: &String, start: usize| {
        Formula::plain(text, sources.span(source, start, start + text.len()))
    };
    [formula(from, 0), formula(to, from.len() + 1)]
}

/// The parameters that become constants.
fn frozen(field: &FieldSpec) -> impl Iterator<Item = &ParameterSpec> {
    field.parameters.iter().filter(|parameter| parameter.frozen)
}

/// The position of a parameter, or a message that there is none of that name.
fn find(
    field: &FieldSpec,
    name: &str,
    span: Span,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<usize> {
    let known = field.parameters.iter().map(|parameter| parameter.name.value.as_str());
    let index = known.clone().position(|known| known == name);
    if index.is_none() && !field.incomplete {
        let message = format!("no parameter {}", quoted(name));
        let diagnostic = Diagnostic::error(span, message).label("not a parameter of this field");
        diagnostics.push(diagnostic.help(advice(name, known, |all| match all {
            "" => "the field has no parameters".into(),
            _ => format!("the field's parameters are {all}"),
        })));
    }
    index
}

fn twice(span: Span, name: &str, what: &str) -> Diagnostic {
    Diagnostic::error(span, format!("{} is {what} twice", quoted(name)))
        .label("the second time")
        .help("name each parameter once")
}

/// Whether a formula uses a name.
fn mentions(formula: &str, name: &str) -> bool {
    let part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    formula.split(|c| !part(c)).any(|word| word == name)
}

/// The first constant instruction whose value is not a number.
fn undefined_constant(program: &Program) -> Option<usize> {
    let mut constants = Vec::<Value>::new();
    let mut constant = vec![false; program.instrs.len()];
    for (index, instr) in program.instrs.iter().enumerate() {
        constant[index] = !matches!(instr.op, Op::Input(_))
            && instr.op.operands().all(|operand| constant[operand.index()]);
        if constant[index] {
            constants.push(Value(index as u32));
        }
    }
    let outputs = SortedMap::from([((), constants.clone())]);
    let program = mms_program::Program { instrs: program.instrs.clone(), outputs };
    // The values of instructions that depend on a parameter are ignored.
    let any = vec![Precise::from_rational(&Rational::ONE); parameter_count(&program)];
    let values = Interpreter::new(&program, &any).output(());
    let undefined = values.iter().position(|value| !value.is_defined())?;
    Some(constants[undefined].index())
}

/// One more than the largest position of a parameter that a program reads.
fn parameter_count(program: &mms_program::Program<()>) -> usize {
    let positions = program.instrs.iter().map(|instr| match instr.op {
        Op::Input(Symbol::Parameter(index)) => index + 1,
        _ => 0,
    });
    positions.max().unwrap_or(0)
}

/// The name of an output in a message.
fn output_name(output: Output) -> &'static str {
    match output {
        Output::Quantity(quantity) => quantity.name(),
        Output::Response(Response::Density) => "density",
        Output::Response(Response::WaveSpeed) => "fastest wave speed",
        Output::Response(_) => "stress of the material",
        Output::Bound(Bound::Time) => "time window",
        Output::Bound(_) => "body",
        Output::Parameter(_) => "default of a parameter",
        Output::Expected(_) => "closed form",
        Output::Face(_, datum) => datum.name(),
    }
}
