//! Compiles a text into everything that follows from it.
//!
//! A compilation, in the macro as elsewhere, only looks for contradictions and proves nothing. It tests each claim at 4 points
//! of its face; J <= 0, and a cut of `atan2` across which values jump, within 128 boxes and 100,000 operations each; and
//! whether `f64` computes the field at the corners of the domain and in its middle. Each contradiction is an error. Beyond
//! these places it does not test that values are finite, and it skips fields whose H has more than 2000 nodes. The selection of
//! quantities does not matter: J and the claims belong to the field.

pub mod fast_check;
mod phases;

use self::phases::Phases;
use crate::declared;
use crate::materials::shipped;
use crate::selection::{self, Selection};
use crate::variation::Variation;
use mms_mechanics::boundary::Datum;
use mms_mechanics::face;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::model::{parameter_values, set_expressions};
use mms_mechanics::resolve::Scope;
use mms_mechanics::{Derivation, Model, Response, TooLarge, requested, tangent};
use mms_mechanics::{Output, Program};
use mms_program::interpret::{Interpreter, Number, Point};
use mms_program::schedule::schedule;
use mms_spec::Form;
use mms_spec::diagnostic;
use mms_spec::diagnostic::Diagnostic;
use mms_spec::own::{Own, Part};
use mms_spec::quantity::Quantity;
use mms_spec::source::Sources;
use mms_spec::suggest::advice;
use mms_spec::syntax;
use mms_spec::units::{Unit, system};
use mms_spec::{Face, FieldSpec, Formula, MaterialSpec};
use mms_symbolic::expr::{DEFAULT_MAX_NODES, Graph, Rational};
use mms_symbolic::sorted::SortedMap;
use mms_symbolic::work::Stop;

/// The budget of the search for a cheap program of closed forms or parameters, in the steps of [`mms_symbolic::work`].
const STEPS_OF_SCHEDULE: u64 = 50_000_000;

/// Reads the file of a material such as `./mine.toml`, given as the field file writes it.
pub type Loader<'a> = &'a dyn Fn(&str) -> Result<String, String>;

/// A field file, compiled.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// The field file.
    pub field: FieldSpec,
    /// The file of its material.
    pub material: MaterialSpec,
    /// The texts, for messages.
    pub sources: Sources,
    /// The expressions.
    pub graph: Graph,
    /// The field's own formulas.
    pub model: Model,
    /// The quantities that follow from these formulas, as derived.
    pub derived: Derivation,
    /// The derivation with the wanted quantities in the forms that are cheapest to compute.
    pub derivation: Derivation,
    /// The part of the derivation that was wanted.
    pub selection: Selection,
    /// The form of computation that was requested.
    pub form: Form,
    /// Whether the search for cheaper and more exact formulas ended as usual; false if there was too much to try.
    pub simplified: bool,
    /// The scheduled program of the wanted quantities.
    pub program: Program,
}

impl Compiled {
    /// Every quantity that the field is compiled with: the quantities of every field, then those that the file defines.
    pub fn quantities(&self) -> impl Iterator<Item = Quantity> + Clone {
        let own = self.model.own.keys().map(|own| Quantity::Own(*own));
        Quantity::ALL.iter().copied().chain(own)
    }

    /// The quantity with a name or alias; includes quantities on request.
    ///
    /// # Errors
    ///
    /// The mistake, in one line, if no quantity has the name.
    pub fn quantity(&self, name: &str) -> Result<Quantity, String> {
        let own: Vec<Own> = self.model.own.keys().copied().collect();
        selection::any_quantity(&own, name)
    }

    /// Whether users may ask for a quantity: a quantity per mass needs a density, which a static field may not have.
    pub fn offers(&self, quantity: Quantity) -> bool {
        self.model.has_density || !matches!(quantity, Quantity::BodyForce | Quantity::MassDensity)
    }

    /// Whether the field is made for a solver: all quantities are wanted, and there is a density.
    pub fn is_for_a_solver(&self) -> bool {
        self.selection.is_for_a_solver() && self.model.has_density
    }

    /// Refuses a quantity that the field does not offer.
    ///
    /// # Errors
    /// The quantity, and another one to ask for.
    pub fn validate_offered(&self, quantity: Quantity) -> Result<(), String> {
        match self.offers(quantity) {
            true => Ok(()),
            false => Err(format!(
                "`{}` gives no density, and {} needs one; body_force_density is the force per reference volume",
                self.field.name.shown(),
                quantity.name()
            )),
        }
    }
}

/// The reason why a field file does not compile.
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

/// The part of a field to compile, and the limits of the compilation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The quantities that are wanted, and the parameters that are set or frozen.
    pub selection: Selection,
    /// The largest number of nodes and operands of the expression graph.
    pub max_nodes: usize,
    /// The form of computation.
    pub form: Form,
    /// The variation of this field to compile, for evaluation at extremes.
    pub variation: Variation,
    /// Ends all work on the field, compilation, proofs and comparisons, when another thread requests it.
    pub stop: Stop,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            selection: Selection::default(),
            max_nodes: DEFAULT_MAX_NODES,
            form: Form::Stable,
            variation: Variation::Nothing,
            stop: Stop::default(),
        }
    }
}

impl From<Selection> for Options {
    fn from(selection: Selection) -> Self {
        Options { selection, ..Options::default() }
    }
}

/// Compiles the text of a field file without a search for contradictions: see [`compile_with`](crate::compile_with), and
/// [`certify`](crate::certify::certificate::certify), which searches longer.
pub fn compile_unproved(
    name: &str,
    path: &str,
    text: &str,
    load: Loader<'_>,
    options: &Options,
) -> Result<Compiled, Failure> {
    let mut phases = Phases::new(options, load);
    let compiled = phases.run(name, path, text);
    if options.stop.is_asked() {
        phases.stopped();
    }
    match compiled {
        Some(compiled) if phases.diagnostics.is_empty() => Ok(compiled),
        _ => Err(Failure { sources: phases.sources, diagnostics: phases.diagnostics }),
    }
}

/// The quantities that the text of a field file defines, read without deriving anything; mistakes are not reported.
pub fn own_quantities(name: &str, path: &str, text: &str, load: Loader<'_>) -> Vec<Own> {
    Phases::new(&Options::default(), load).own_quantities(name, path, text)
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

impl Compiled {
    /// Checks that the field allows these values of its parameters, by position: each within its range, a body and a time
    /// window that are not empty, a positive density, an elastic material.
    ///
    /// # Errors
    ///
    /// The mistake, with the place of the violated condition in the file.
    pub fn accepts(&self, set: &SortedMap<usize, Rational>) -> Result<(), Failure> {
        let mut graph = self.graph.clone();
        graph.make_room();
        let set = set_expressions(&mut graph, set);
        let diagnostics = declared::check(&graph, &self.model, (&self.field, &self.material), &set);
        if diagnostics.is_empty() {
            return Ok(());
        }
        Err(Failure { sources: self.sources.clone(), diagnostics })
    }

    /// The parameters' values in the order of the file; a parameter that depends on a set one follows it.
    pub fn parameters<T: Number>(&self, set: &SortedMap<usize, Rational>) -> Vec<T> {
        let mut graph = self.graph.clone();
        graph.make_room();
        let set = set_expressions(&mut graph, set);
        let values = parameter_values(&mut graph, &self.model, &set);
        graph.work().allow(STEPS_OF_SCHEDULE);
        let outputs = values
            .into_iter()
            .enumerate()
            .map(|(index, value)| (Output::Parameter(index), vec![value]))
            .collect();
        let program = schedule(&graph, &outputs);
        let interpreter = Interpreter::<T, _>::new(&program, &[]);
        (0..self.model.parameters.len())
            .flat_map(|index| interpreter.output(Output::Parameter(index)))
            .collect()
    }

    /// The origin of the output: the crate's version and a hash of the input texts.
    pub fn provenance(&self) -> String {
        format!("mms-codegen {} from input {}", env!("CARGO_PKG_VERSION"), self.input_hash())
    }

    /// A hash of the input texts: 16 hexadecimal digits.
    pub fn input_hash(&self) -> String {
        self.sources.hash()
    }

    /// One sentence about a quantity of this field: at small strain there is one stress and one configuration.
    pub fn doc(&self, quantity: Quantity) -> &'static str {
        match self.model.kind {
            _ if quantity == Quantity::Displacement && self.field.is_static() => {
                "Displacement u(X)."
            }
            InvariantKind::SmallStrain => quantity.doc_at_small_strain(),
            InvariantKind::Isotropic | InvariantKind::Fibrous(_) => quantity.doc(),
        }
    }

    /// Converts an SI unit to the field's own system of units, found from the units of its parameters.
    pub fn unit(&self, si: &str) -> String {
        let units = self.model.parameters.iter().filter_map(|it| Unit::known(it.unit.as_deref()?));
        let own = system::own(&units.collect::<Vec<_>>(), si);
        own.unwrap_or_else(|| "unit of the field's own system".into())
    }

    /// The unit of a quantity in the field's own system; empty for a quantity of the file without a stated unit.
    pub fn unit_of(&self, quantity: Quantity) -> String {
        let unit = quantity.unit();
        let Quantity::Own(own) = quantity else { return self.unit(unit) };
        match own.part {
            Part::Gradient => over(unit, "/m", &self.unit("m")),
            Part::Rate => over(unit, "/s", &self.unit("s")),
            _ => unit.to_owned(),
        }
    }

    /// Path and text of the material's file, if it is the user's own.
    pub fn own_material(&self) -> Option<(&str, &str)> {
        let model = self.field.material.model.value.raw();
        let source = self.material.strain_energy.span.source;
        shipped(model).is_none().then(|| (model, self.sources.get(source).text.as_str()))
    }

    /// dP/dF as a function of a displacement gradient, as [`Response::Tangent`]: a separate program, which costs nothing unless
    /// requested. An error if it is too large.
    pub fn tangent(&self) -> Result<Program, TooLarge> {
        let mut graph = self.graph.clone();
        graph.make_room();
        let components = tangent(&mut graph, &self.model)?;
        let output = Output::Response(Response::Tangent);
        Ok(schedule(&graph, &SortedMap::from([(output, components)])))
    }

    /// A quantity on request at a point and a time: a separate program, which costs nothing unless requested. An error if it is
    /// too large.
    pub fn on_request(&self, quantity: Quantity) -> Result<Program, TooLarge> {
        let mut graph = self.graph.clone();
        graph.make_room();
        let components = requested(&mut graph, &self.model, &self.derivation, quantity)?;
        Ok(schedule(&graph, &SortedMap::from([(Output::Quantity(quantity), components)])))
    }

    /// The face of that name, or the mistake in one line.
    pub fn face(&self, name: &str) -> Result<Face, String> {
        let faces = Face::of(&self.field.domain.body, self.field.space);
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
        let dimension = self.field.dimension;
        let normal = face::normal(&mut graph, &self.model.domain.body, dimension, face);
        schedule(&graph, &SortedMap::from([(Output::Face(face, Datum::Normal), normal)]))
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

    /// The quantities that have a closed form, each followed by it, as one program.
    pub fn checks(&self) -> Program {
        let mut outputs = SortedMap::new();
        for (index, check) in self.model.checks.iter().enumerate() {
            let quantity = check.quantity;
            outputs.insert(Output::Expected(index), check.equals.clone());
            outputs
                .insert(Output::Quantity(quantity), self.derivation.quantities[&quantity].clone());
        }
        let graph = self.graph.clone();
        graph.work().allow(STEPS_OF_SCHEDULE);
        schedule(&graph, &outputs)
    }
}

/// Replaces an SI unit at the end of a unit by another one.
fn over(unit: &str, si: &str, own: &str) -> String {
    unit.strip_suffix(si).map_or_else(String::new, |whole| format!("{whole}/{own}"))
}
