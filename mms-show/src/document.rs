//! The contents of the derivation of a field, in the order in which a person would write it. A document holds expressions and
//! names; the notations decide how they look.

use super::energy::energy_of_file;
use super::motion::{Formulas, Quantities};
use super::name::Name;
use super::reading::{Id, Reading, Role};
use super::stress;
use super::walk::{Notation, write};
use mms_analysis::visibility::Visibility;
use mms_codegen::compile::Compiled;
use mms_mechanics::Output;
use mms_mechanics::TooLarge;
use mms_mechanics::invariant::InvariantKind;
use mms_program::Stage;
use mms_spec::foreign::Foreign;
use mms_spec::quantity::Quantity;
use mms_spec::{Formula, Space};
use mms_symbolic::expr::{Expr, Graph};
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// Names of one value.
#[derive(Clone, Debug)]
pub struct Line {
    /// The left-hand side; several names if they are equal.
    pub left: Vec<Name>,
    /// The right-hand side.
    pub value: Expr,
}

/// A quantity and its components.
#[derive(Clone, Debug)]
pub struct Section {
    /// The quantity.
    pub quantity: Quantity,
    /// The number of operations of its program, by stage; stages without any are left out.
    pub operations: Vec<(Stage, usize)>,
    /// Definitions that its formulas use and that have not been listed above.
    pub whereby: Vec<Line>,
    /// The components, equal ones on one line.
    pub lines: Vec<Line>,
    /// The components one by one, row-major.
    pub components: Vec<Line>,
}

/// The material of a field.
#[derive(Clone, Debug)]
pub struct Material {
    /// The stem of its file.
    pub name: Foreign,
    /// A description in a few words.
    pub title: Foreign,
    /// The kind of invariants that W is a function of.
    pub kind: InvariantKind,
    /// W in the parameters of the material and in the invariants, after the parts that it is put
    /// together from.
    pub energy: Vec<Line>,
    /// Definitions that the arguments and the density use, and that are not definitions of the field.
    pub whereby: Vec<Line>,
    /// The values that the field gives to the parameters and the given fields of the material.
    pub arguments: Vec<Line>,
    /// The density `rho0`.
    pub density: Vec<Line>,
}

/// The quantities that lead from u to b.
pub const DERIVATION: [Quantity; 6] = [
    Quantity::Displacement,
    Quantity::DeformationGradient,
    Quantity::Jacobian,
    Quantity::FirstPiolaKirchhoff,
    Quantity::DivP,
    Quantity::BodyForce,
];

/// The derivation of a field.
pub struct Document {
    /// The name of the field.
    pub name: Foreign,
    /// A description in a few words.
    pub title: Foreign,
    /// The source of the field.
    pub reference: Option<Foreign>,
    /// The dimension of space.
    pub dimension: usize,
    /// The coordinates, and the numbers of components of vectors and tensors.
    pub space: Space,
    /// Whether the field has no time.
    pub is_static: bool,
    /// The symbols in LaTeX that parameters declare, by their names.
    pub symbols: SortedMap<String, String>,
    /// The material.
    pub material: Material,
    /// The definitions of the field file, in order.
    pub definitions: Vec<Line>,
    /// The requested quantities, in the order of derivation.
    pub sections: Vec<Section>,
    /// Faces with their claims.
    pub claims: Vec<(&'static str, &'static str)>,
    /// The terms of the equations that the field can see, if they are to be shown.
    pub visibility: Option<Visibility>,
    reading: Reading,
}

impl std::fmt::Debug for Document {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Document").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Document {
    /// The derivation of a field, restricted to the given quantities. An error if it has more terms than a graph may hold.
    pub fn new(compiled: &Compiled, asked: &[Quantity]) -> Result<Self, TooLarge> {
        let mut reading = Reading::new(compiled);
        let formulas = Formulas::new(&mut reading, compiled);
        let defined = 0..reading.entries.len();
        let mut quantities = Quantities::motion(&mut reading, compiled, &formulas);
        stress::derive(&mut reading, compiled, &formulas, &mut quantities);
        let mut listing = Listing { reading, listed: SortedSet::new(), fitted: SortedSet::new() };
        let mut definitions = Vec::new();
        for id in defined {
            definitions.extend(listing.up_to([id].into()));
        }
        let material = listing.material(compiled, &formulas);
        let asked = compiled.quantities().filter(|quantity| asked.contains(quantity));
        let sections =
            asked.map(|quantity| listing.section(compiled, &quantities, quantity)).collect();
        let reading = listing.reading;
        if reading.graph.is_exhausted() {
            return Err(TooLarge("derivation to be shown"));
        }
        let field = &compiled.field;
        let claim =
            |spec: &mms_spec::BoundarySpec| (spec.face.value.name(), spec.claim.value.name());
        Ok(Document {
            name: field.name.clone(),
            title: field.title.clone(),
            reference: field.reference.clone(),
            dimension: field.dimension,
            space: field.space,
            is_static: field.is_static(),
            symbols: field
                .parameters
                .iter()
                .filter_map(|it| Some((it.name.value.clone(), it.symbol.as_ref()?.value.clone())))
                .collect(),
            material,
            definitions,
            sections,
            claims: field.boundary.iter().map(claim).collect(),
            visibility: None,
            reading,
        })
    }

    /// The graph of all values.
    pub fn graph(&self) -> &Graph {
        &self.reading.graph
    }

    /// Whether a line equates a name with itself.
    pub fn is_identity(&self, line: &Line) -> bool {
        let value = self.reading.identifier(line.value);
        line.left.iter().all(|name| value.as_deref() == Some(&name.identifier()))
    }

    /// A value in a notation.
    pub fn formula(&self, value: Expr, notation: &dyn Notation) -> String {
        write(&self.reading.graph, value, &self.reading, notation)
    }
}

/// The list of definitions: each comes before its first use, and only once.
struct Listing {
    reading: Reading,
    listed: SortedSet<Id>,
    /// Entries whose formulas fit on a line.
    fitted: SortedSet<Id>,
}

impl Listing {
    fn material(&mut self, compiled: &Compiled, formulas: &Formulas) -> Material {
        let spec = &compiled.field.material;
        let energy = energy_of_file(&mut self.reading, compiled);
        let mut whereby = Vec::new();
        let mut line = |listing: &mut Self, name: &str, formula: &Formula| {
            let value = formulas.read_alone(&mut listing.reading, formula)?;
            let mut lines = listing.alone(name, value);
            let last = lines.pop();
            whereby.extend(lines);
            last
        };
        let arguments = spec.arguments.iter().chain(&spec.givens);
        let arguments =
            arguments.filter_map(|(name, formula)| line(self, &name.value, formula)).collect();
        let density = spec.density.as_ref().and_then(|it| line(self, "rho0", it));
        let density = density.into_iter().collect();
        Material {
            name: spec.model.value.clone(),
            title: compiled.material.title.clone(),
            kind: compiled.model.kind.clone(),
            energy: energy.map(|energy| self.alone("W", energy)).unwrap_or_default(),
            whereby,
            arguments,
            density,
        }
    }

    /// The line of something that is no entry, after the lines that it uses.
    fn alone(&mut self, name: &str, value: Expr) -> Vec<Line> {
        let value = self.reading.abbreviated(&[value])[0];
        let mut lines = self.up_to(self.reading.entries_in(value));
        lines.push(Line { left: vec![Name::plain(name)], value });
        lines
    }

    fn section(
        &mut self,
        compiled: &Compiled,
        quantities: &Quantities,
        quantity: Quantity,
    ) -> Section {
        let ids = quantities.ids(quantity);
        self.fit(ids);
        let used: SortedSet<Id> = ids
            .iter()
            .flat_map(|id| self.reading.entries_in(self.reading.entries[*id].shown))
            .collect();
        let whereby = self.up_to(used);
        self.listed.extend(ids.iter().copied());
        let components: Vec<Line> = ids.iter().map(|id| self.line(*id)).collect();
        let counts = compiled.program.operations(&[Output::Quantity(quantity)]);
        let operations = Stage::ALL.iter().map(|stage| (*stage, counts[stage]));
        Section {
            quantity,
            operations: operations.filter(|(_, count)| *count != 0).collect(),
            whereby,
            lines: grouped(&components),
            components,
        }
    }

    /// Shortens the formulas of entries that belong together.
    fn fit(&mut self, ids: &[Id]) {
        let new: Vec<Id> = ids.iter().copied().filter(|id| self.fitted.insert(*id)).collect();
        let shown: Vec<Expr> = new.iter().map(|id| self.reading.entries[*id].shown).collect();
        let fitting = self.reading.abbreviated(&shown);
        for (id, shown) in new.into_iter().zip(fitting) {
            self.reading.entries[id].shown = shown;
        }
    }

    /// The lines of these entries and of all that they use, as far as they have not been listed.
    fn up_to(&mut self, wanted: SortedSet<Id>) -> Vec<Line> {
        let mut lines = Vec::new();
        let mut open: Vec<(Id, bool)> = wanted.into_iter().rev().map(|id| (id, false)).collect();
        while let Some((id, is_ready)) = open.pop() {
            if is_ready {
                lines.push(self.line(id));
                continue;
            }
            if self.reading.entries[id].role == Role::Given || !self.listed.insert(id) {
                continue;
            }
            self.fit(&[id]);
            open.push((id, true));
            let used = self.reading.entries_in(self.reading.entries[id].shown);
            open.extend(used.into_iter().rev().map(|id| (id, false)));
        }
        lines
    }

    fn line(&self, id: Id) -> Line {
        let entry = &self.reading.entries[id];
        Line { left: vec![entry.name.clone()], value: entry.shown }
    }
}

/// Lines of one value as one line, in the order of the first.
fn grouped(lines: &[Line]) -> Vec<Line> {
    let mut places = SortedMap::<Expr, usize>::new();
    let mut grouped: Vec<Line> = Vec::new();
    for line in lines {
        match places.get(&line.value) {
            Some(place) => grouped[*place].left.extend(line.left.iter().cloned()),
            None => {
                places.insert(line.value, grouped.len());
                grouped.push(line.clone());
            }
        }
    }
    grouped
}
