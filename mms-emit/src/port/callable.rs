//! The functions of an emitted field: one list for every language.

use mms_codegen::compile::Compiled;
use mms_mechanics::Response;
use mms_mechanics::boundary::Datum;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::{Bound, Output, Program};
use mms_program::Op;
use mms_spec::Space;
use mms_spec::quantity::{Quantity, Shape};
use mms_symbolic::expr::Symbol;

/// A function of an emitted field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Callable {
    /// The name, without a prefix.
    pub name: String,
    /// The output of the program that the function returns.
    pub output: Output,
    /// One sentence on the output.
    pub doc: String,
    /// The unit, in the units of the field's parameters; SI units if they have none.
    pub unit: String,
    /// Scalar, vector or tensor; `None` for a list of another length.
    pub shape: Option<Shape>,
    /// The names of its components, rows first.
    pub components: Vec<String>,
    /// Whether the function depends on time.
    pub time: bool,
    /// The inputs at a point: coordinates, normal or gradient.
    pub inputs: Vec<Symbol>,
    /// The coordinates of the field.
    pub space: Space,
}

impl Callable {
    /// Whether the output is a quantity that the field file defines.
    pub fn is_own(&self) -> bool {
        matches!(self.output, Output::Quantity(Quantity::Own(_)))
    }

    /// Whether the function is evaluated at points.
    pub fn is_of_points(&self) -> bool {
        !self.inputs.is_empty()
    }

    /// One of three words: for a function of no point, of points, or of points and a time.
    pub fn owner<'a>(&self, [alone, field, now]: [&'a str; 3]) -> &'a str {
        match (self.is_of_points(), self.time) {
            (false, _) => alone,
            (true, false) => field,
            (true, true) => now,
        }
    }

    /// Whether the function returns one number, and not a list.
    pub fn is_scalar(&self) -> bool {
        self.shape == Some(Shape::Scalar)
    }

    /// The documentation in every language: the output, its shape and its unit.
    pub fn documentation(&self) -> String {
        let rows = self.space.rows();
        let shape = match (self.shape, self.components.len()) {
            (Some(Shape::Scalar), _) => "Scalar".into(),
            (Some(Shape::Tensor), _) => format!("Tensor, {rows}x{rows}, by rows"),
            (Some(Shape::Vector), count) => format!("Vector of {count}"),
            (None, 1) => "1 number".into(),
            (None, count) => format!("{count} numbers"),
        };
        match self.unit.as_str() {
            "" => format!("{} {shape}.", self.doc),
            unit => format!("{} {shape}. Unit: {unit}.", self.doc),
        }
    }

    /// The inputs at a point as arrays: X, N or H, each with its number of components.
    pub fn arrays(&self) -> Vec<(&'static str, usize)> {
        let mut arrays: Vec<(&'static str, usize)> = Vec::new();
        for symbol in &self.inputs {
            let name = match symbol {
                Symbol::Normal(_) => "N",
                Symbol::Gradient(..) => "H",
                _ => "X",
            };
            match arrays.iter_mut().find(|(known, _)| *known == name) {
                Some((_, count)) => *count += 1,
                None => arrays.push((name, 1)),
            }
        }
        arrays
    }

    /// The indices of the inputs among t, X, N and H of a point.
    pub fn columns(&self) -> Vec<usize> {
        let dimension = self.space.coordinates();
        let first = |array: &str| match array {
            "N" => 1 + dimension,
            "H" => 1 + 2 * dimension,
            _ => 1,
        };
        let arrays = self.arrays().into_iter();
        arrays.flat_map(|(array, count)| first(array)..first(array) + count).collect()
    }

    /// Whether the function has no inputs except coordinates and time, like functions of input files.
    pub fn is_of_places(&self) -> bool {
        self.inputs.iter().all(|symbol| matches!(symbol, Symbol::Coordinate(_)))
    }

    /// The suffixes that distinguish the components after the name, rows first: nothing, `_1`, `_12`.
    pub fn suffixes(&self) -> Vec<String> {
        let rows = self.space.rows();
        match self.shape {
            Some(Shape::Scalar) => vec![String::new()],
            Some(Shape::Tensor) => {
                (1..=rows).flat_map(|i| (1..=rows).map(move |j| format!("_{i}{j}"))).collect()
            }
            Some(Shape::Vector) | None => {
                (1..=self.components.len()).map(|i| format!("_{i}")).collect()
            }
        }
    }

    /// The names of the inputs at a point.
    pub fn input_names(&self) -> Vec<String> {
        self.inputs.iter().map(|symbol| input(self.space, *symbol)).collect()
    }
}

/// The argument that supplies a leaf.
pub fn input(space: Space, symbol: Symbol) -> String {
    match symbol {
        Symbol::Coordinate(axis) => space.axes()[axis].into(),
        Symbol::Time => "t".into(),
        Symbol::Normal(axis) => format!("N{}", axis + 1),
        Symbol::Gradient(row, column) => format!("H{}{}", row + 1, column + 1),
        Symbol::Parameter(_) | Symbol::Invariant(_) | Symbol::Local(_) => {
            unreachable!("a member of the parameters, or gone after derivation")
        }
    }
}

/// The functions of a field: its domain, its material unless only quantities are selected, quantities in the order of
/// derivation, and prescribed values on faces.
pub fn callables(compiled: &Compiled) -> Vec<Callable> {
    let wanted = |callable: &Callable| match callable.output {
        Output::Bound(Bound::Space) => false,
        Output::Bound(Bound::Time) if compiled.field.is_static() => false,
        Output::Quantity(quantity) if !compiled.offers(quantity) => false,
        Output::Response(Response::Density | Response::WaveSpeed)
            if !compiled.model.has_density =>
        {
            false
        }
        output => compiled.program.outputs.contains_key(&output),
    };
    let mut all: Vec<Callable> = Bound::ALL.iter().map(|it| bound(*it, compiled)).collect();
    all.extend(RESPONSES.iter().map(|it| response(*it, compiled)));
    all.extend(compiled.quantities().map(|it| quantity(it, compiled)));
    all.extend(compiled.program.outputs.keys().filter_map(|output| match *output {
        Output::Face(face, datum) => Some(on_face(face.name(), datum, *output, compiled)),
        _ => None,
    }));
    all.retain(wanted);
    all
}

const RESPONSES: [Response; 5] = [
    Response::Density,
    Response::WaveSpeed,
    Response::StrainEnergy,
    Response::FirstPiolaKirchhoff,
    Response::KirchhoffStress,
];

fn bound(bound: Bound, compiled: &Compiled) -> Callable {
    let (symbol, doc, unit) = match bound {
        Bound::Lower => ("lower", "Least reference coordinates of the body.", "m"),
        Bound::Upper => ("upper", "Greatest reference coordinates of the body.", "m"),
        Bound::Inner => ("inner", "Inner radius of the body.", "m"),
        Bound::Outer => ("outer", "Outer radius of the body.", "m"),
        Bound::Theta => ("theta", "First and last angle of the body.", "1"),
        Bound::Z => ("z_end", "Lower and upper end of the body.", "m"),
        Bound::Phi => ("phi", "First and last angle of the body from +Z.", "1"),
        Bound::Vertices => ("vertex", "Vertices of the body, X and Y one after another.", "m"),
        Bound::Space => ("space", "As many zeros as space has dimensions.", "1"),
        Bound::Time => ("t", "First and last time of what the field claims.", "s"),
    };
    let output = Output::Bound(bound);
    let count = compiled.program.outputs.get(&output).map_or(0, Vec::len);
    let shape = matches!(bound, Bound::Inner | Bound::Outer).then_some(Shape::Scalar);
    Callable {
        name: bound.name().into(),
        output,
        doc: doc.into(),
        unit: compiled.unit(unit),
        shape,
        components: match shape {
            Some(_) => vec![symbol.into()],
            None => (1..=count).map(|index| format!("{symbol}{index}")).collect(),
        },
        time: false,
        inputs: Vec::new(),
        space: compiled.field.space,
    }
}

fn response(response: Response, compiled: &Compiled) -> Callable {
    let space = compiled.field.space;
    let (name, symbol, doc, unit, shape) = match response {
        Response::Density => {
            ("density", "rho0", "Reference density rho0(X).", "kg/m^3", Shape::Scalar)
        }
        Response::WaveSpeed => (
            "wave_speed",
            "c",
            "Fastest wave speed at X in the undeformed state.",
            "m/s",
            Shape::Scalar,
        ),
        Response::StrainEnergy => (
            "material_strain_energy",
            "W",
            "Strain-energy density W of the material at X, of the displacement gradient H.",
            "Pa",
            Shape::Scalar,
        ),
        Response::FirstPiolaKirchhoff => (
            "material_first_piola_kirchhoff",
            "P",
            "First Piola-Kirchhoff stress P = dW/dF of the material at X, of the displacement gradient H.",
            "Pa",
            Shape::Tensor,
        ),
        Response::KirchhoffStress => (
            "material_kirchhoff_stress",
            "tau",
            match compiled.model.kind {
                InvariantKind::SmallStrain => {
                    "P F^T of the material at X, of the displacement gradient H, for an updated formulation: no stress at small strain."
                }
                InvariantKind::Isotropic | InvariantKind::Fibrous(_) => {
                    "Kirchhoff stress tau = P F^T of the material at X, of the displacement gradient H."
                }
            },
            "Pa",
            Shape::Tensor,
        ),
        Response::Tangent => unreachable!("derived where it is needed"),
    };
    let strained = !matches!(response, Response::Density | Response::WaveSpeed);
    let mut inputs = coordinates(space);
    if strained {
        let rows = 0..space.rows();
        inputs.extend(rows.flat_map(|i| (0..space.rows()).map(move |j| Symbol::Gradient(i, j))));
    }
    let output = Output::Response(response);
    Callable {
        name: name.into(),
        output,
        doc: doc.into(),
        unit: compiled.unit(unit),
        shape: Some(shape),
        components: components(symbol, shape, space),
        time: changes_with_time(&compiled.program, output),
        inputs,
        space,
    }
}

fn quantity(quantity: Quantity, compiled: &Compiled) -> Callable {
    let space = compiled.field.space;
    let mut inputs = coordinates(space);
    if quantity.takes_normal() {
        inputs.extend((0..space.coordinates()).map(Symbol::Normal));
    }
    // A symbol of the user's file may be a word of the language.
    let symbol = match quantity {
        Quantity::Own(_) => "value",
        _ => quantity.symbol(),
    };
    Callable {
        name: quantity.name().into(),
        output: Output::Quantity(quantity),
        doc: compiled.doc(quantity).into(),
        unit: compiled.unit_of(quantity),
        shape: Some(quantity.shape()),
        components: components(symbol, quantity.shape(), space),
        time: true,
        inputs,
        space,
    }
}

/// Whether an output of a program depends on time.
fn changes_with_time(program: &Program, output: Output) -> bool {
    let mut needed = program.instrs.iter().zip(program.needed(&[output]));
    needed.any(|(instr, needed)| needed && matches!(instr.op, Op::Input(Symbol::Time)))
}

fn on_face(face: &str, datum: Datum, output: Output, compiled: &Compiled) -> Callable {
    let space = compiled.field.space;
    let mut components = components("", Shape::Vector, space);
    // No face has a normal along the hoop.
    if datum == Datum::Normal {
        components.truncate(space.coordinates());
    }
    let (what, symbol, unit) = match datum {
        Datum::Normal => ("Outward reference unit normal N", "N", "1"),
        Datum::Displacement => {
            (compiled.doc(Quantity::Displacement).trim_end_matches('.'), "u", "m")
        }
        Datum::Traction => ("Traction P N on reference area", "T", "Pa"),
    };
    Callable {
        name: format!("{face}_{}", datum.name()),
        output,
        doc: format!("{what} on the face {face}, at a point of it."),
        unit: compiled.unit(unit),
        shape: Some(Shape::Vector),
        components: components.into_iter().map(|it| format!("{symbol}{it}")).collect(),
        time: true,
        inputs: coordinates(space),
        space,
    }
}

fn coordinates(space: Space) -> Vec<Symbol> {
    (0..space.coordinates()).map(Symbol::Coordinate).collect()
}

fn components(symbol: &str, shape: Shape, space: Space) -> Vec<String> {
    let rows = space.rows();
    match shape {
        Shape::Scalar => vec![symbol.into()],
        Shape::Vector => (1..=space.vector()).map(|i| format!("{symbol}{i}")).collect(),
        Shape::Tensor => {
            (1..=rows).flat_map(|i| (1..=rows).map(move |j| format!("{symbol}{i}{j}"))).collect()
        }
    }
}
