//! The definition of each quantity, as a person writes it: declared once, set by every notation.

use mms_mechanics::invariant::InvariantKind;
use mms_spec::own::Described;
use mms_spec::own::Part::{Flux, Gradient, NormalFlux, Rate, Residual, Source, Value};
use mms_spec::quantity::Quantity;

/// A part of a relation between vectors and tensors.
#[derive(Clone, Copy, Debug)]
pub enum Part {
    /// A vector or tensor.
    Tensor(&'static str),
    /// A scalar.
    Scalar(&'static str),
    /// `=`, `+`, `-` or `,`.
    Sign(&'static str),
    /// An operator with a name: det, Div.
    Word(&'static str),
    /// A tensor with its inverse or transpose taken: `-1` or `T`.
    Raised(&'static str, &'static str),
    /// A component, by its indices.
    Component(&'static str, &'static str),
    /// A function of some arguments.
    Function(&'static str, &'static [Part]),
    /// A partial derivative.
    Partial(&'static Part, &'static Part),
    /// One thing over another.
    Over(&'static [Part], &'static [Part]),
}

use Part::{Component, Function, Over, Partial, Raised, Scalar, Sign, Tensor, Word};

const EQUALS: Part = Sign("=");
const MINUS: Part = Sign("-");
const RHO: Part = Scalar("rho");
const RHO0: Part = Scalar("rho0");
const COMMA: Part = Sign(",");
const INVARIANTS: &[Part] = &[Scalar("I1"), COMMA, Scalar("I2"), COMMA, Scalar("J")];
const OF_FIBRES: &[Part] =
    &[Scalar("I1"), COMMA, Scalar("I2"), COMMA, Scalar("J"), COMMA, Scalar("I4")];
const SMALL: &[Part] = &[Tensor("epsilon")];
const ARGUMENTS: &[Part] = &[Tensor("X"), COMMA, Scalar("t")];

/// The definition of a quantity, for a density of that kind, of a field that moves or is static.
pub fn relation(quantity: Quantity, kind: &InvariantKind, is_static: bool) -> Vec<Part> {
    match quantity {
        Quantity::Own(own) => of_own(own.described(), is_static),
        quantity => of_every_field(quantity, kind, is_static).to_vec(),
    }
}

/// The definition of a quantity that the field file defines.
fn of_own(own: &'static Described, is_static: bool) -> Vec<Part> {
    let left = Scalar(&own.symbol);
    match own.part {
        Value => vec![left, EQUALS, Function(&own.symbol, arguments(is_static))],
        Gradient => vec![Word("Grad"), Scalar(&own.of)],
        Rate => vec![left, EQUALS, Word("d"), Scalar(&own.of), Sign("/"), Word("d"), Scalar("t")],
        Source => {
            vec![left, EQUALS, Word("d(storage)/dt"), Sign("+"), Word("Div"), Tensor("Q")]
        }
        Flux => vec![left, EQUALS, Tensor("Q")],
        NormalFlux => vec![left, EQUALS, Tensor("Q"), Tensor("N")],
        Residual => vec![left],
    }
}

fn arguments(is_static: bool) -> &'static [Part] {
    if is_static { &ARGUMENTS[..1] } else { ARGUMENTS }
}

fn of_every_field(quantity: Quantity, kind: &InvariantKind, is_static: bool) -> &'static [Part] {
    if let (InvariantKind::SmallStrain, Some(relation)) = (kind, of_small_strain(quantity)) {
        return relation;
    }
    match quantity {
        Quantity::Displacement if is_static => {
            &[Tensor("u"), EQUALS, Function("u", &[Tensor("X")])]
        }
        Quantity::Displacement => &[Tensor("u"), EQUALS, Function("u", ARGUMENTS)],
        Quantity::Position => &[Tensor("x"), EQUALS, Tensor("X"), Sign("+"), Tensor("u")],
        Quantity::Velocity => &[Tensor("v"), EQUALS, Partial(&Tensor("u"), &Scalar("t"))],
        Quantity::Acceleration => &[Tensor("a"), EQUALS, Partial(&Tensor("v"), &Scalar("t"))],
        Quantity::DisplacementGradient => {
            &[Tensor("H"), EQUALS, Partial(&Tensor("u"), &Tensor("X"))]
        }
        Quantity::DeformationGradient => {
            &[Tensor("F"), EQUALS, Tensor("I"), Sign("+"), Tensor("H")]
        }
        Quantity::Jacobian => &[Scalar("J"), EQUALS, Word("det"), Tensor("F")],
        Quantity::RightCauchyGreen => &[Tensor("C"), EQUALS, Raised("F", "T"), Tensor("F")],
        Quantity::LeftCauchyGreen => &[Tensor("B"), EQUALS, Tensor("F"), Raised("F", "T")],
        Quantity::GreenLagrange => {
            &[Scalar("2"), Tensor("E"), EQUALS, Tensor("C"), MINUS, Tensor("I")]
        }
        Quantity::MassDensity => &[RHO, EQUALS, Over(&[RHO0], &[Scalar("J")])],
        Quantity::StrainEnergy => match kind {
            InvariantKind::Isotropic => &[Scalar("W"), EQUALS, Function("W", INVARIANTS)],
            InvariantKind::Fibrous(_) => &[Scalar("W"), EQUALS, Function("W", OF_FIBRES)],
            InvariantKind::SmallStrain => &[Scalar("W"), EQUALS, Function("W", SMALL)],
        },
        Quantity::FirstPiolaKirchhoff => {
            &[Tensor("P"), EQUALS, Partial(&Scalar("W"), &Tensor("F"))]
        }
        Quantity::NominalStress => {
            &[Raised("P", "T"), EQUALS, Scalar("J"), Raised("F", "-1"), Tensor("sigma")]
        }
        Quantity::CauchyStress => {
            &[Tensor("sigma"), EQUALS, Over(&[Tensor("P"), Raised("F", "T")], &[Scalar("J")])]
        }
        Quantity::KirchhoffStress => &[Tensor("tau"), EQUALS, Tensor("P"), Raised("F", "T")],
        Quantity::DivP => &[
            Word("Div"),
            Tensor("P"),
            EQUALS,
            Partial(&Component("P", "iJ"), &Component("X", "J")),
        ],
        Quantity::DivSigma => &[
            Word("div"),
            Tensor("sigma"),
            EQUALS,
            Over(&[Word("Div"), Tensor("P")], &[Scalar("J")]),
        ],
        Quantity::BodyForce => {
            &[Tensor("b"), EQUALS, Tensor("a"), MINUS, Over(&[Word("Div"), Tensor("P")], &[RHO0])]
        }
        Quantity::BodyForceDensity => {
            &[RHO0, Tensor("b"), EQUALS, RHO0, Tensor("a"), MINUS, Word("Div"), Tensor("P")]
        }
        Quantity::CurrentBodyForceDensity => {
            &[RHO, Tensor("b"), EQUALS, Over(&[RHO0, Tensor("b")], &[Scalar("J")])]
        }
        Quantity::Traction => &[Tensor("T"), EQUALS, Tensor("P"), Tensor("N")],
        Quantity::SecondPiolaKirchhoff => &[Tensor("S"), EQUALS, Raised("F", "-1"), Tensor("P")],
        Quantity::Pressure => {
            &[Scalar("p"), EQUALS, MINUS, Over(&[Word("tr"), Tensor("sigma")], &[Scalar("3")])]
        }
        Quantity::SmallStrain => {
            &[Scalar("2"), Tensor("epsilon"), EQUALS, Tensor("H"), Sign("+"), Raised("H", "T")]
        }
        Quantity::VonMises => &[Word("von Mises"), EQUALS, Function("f", &[Tensor("sigma")])],
        Quantity::Own(_) => &[],
    }
}

/// The relations of the small strain, which has one stress and one configuration.
fn of_small_strain(quantity: Quantity) -> Option<&'static [Part]> {
    Some(match quantity {
        Quantity::MassDensity => &[RHO, EQUALS, RHO0],
        Quantity::NominalStress => &[Raised("P", "T"), EQUALS, Tensor("P")],
        Quantity::CauchyStress => &[Tensor("sigma"), EQUALS, Tensor("P")],
        Quantity::KirchhoffStress => &[Tensor("tau"), EQUALS, Tensor("P")],
        Quantity::SecondPiolaKirchhoff => &[Tensor("S"), EQUALS, Tensor("P")],
        Quantity::DivSigma => &[Word("div"), Tensor("sigma"), EQUALS, Word("Div"), Tensor("P")],
        Quantity::CurrentBodyForceDensity => &[RHO, Tensor("b"), EQUALS, RHO0, Tensor("b")],
        _ => return None,
    })
}

/// The layout of the parts of a relation in a notation.
pub(super) trait Setting {
    /// A letter or word: `is_bold` for a vector or tensor.
    fn letter(&self, word: &str, is_bold: bool) -> String;
    /// A sign between two parts.
    fn sign(&self, sign: &str) -> String;
    /// An operator with a name.
    fn operator(&self, word: &str) -> String;
    /// Something with its inverse or transpose taken.
    fn raised(&self, base: &str, mark: &str) -> String;
    /// Something with indices.
    fn lowered(&self, base: &str, indices: &str) -> String;
    /// A function of arguments.
    fn applied(&self, function: &str, arguments: &str) -> String;
    /// A partial derivative by one or more variables, each with how many times.
    fn derivative(&self, of: &str, by: &[(String, usize)]) -> String;
    /// One thing over another.
    fn over(&self, above: &str, below: &str) -> String;
    /// Parts side by side.
    fn row(&self, parts: &[String]) -> String;

    /// A relation; parts are nested no deeper than the table above nests them.
    fn relation(&self, parts: &[Part]) -> String {
        let set: Vec<_> = parts.iter().map(|part| self.part(part)).collect();
        self.row(&set)
    }

    /// One part of a relation.
    fn part(&self, part: &Part) -> String {
        match part {
            Tensor(word) => self.letter(word, true),
            Scalar(word) => self.letter(word, false),
            Sign(sign) => self.sign(sign),
            Word(word) => self.operator(word),
            Raised(word, mark) => self.raised(&self.letter(word, true), mark),
            Component(word, indices) => self.lowered(&self.letter(word, false), indices),
            Function(word, arguments) => {
                let function = self.letter(word, *word != "W");
                self.applied(&function, &self.relation(arguments))
            }
            Partial(of, by) => self.derivative(&self.part(of), &[(self.part(by), 1)]),
            Over(above, below) => self.over(&self.relation(above), &self.relation(below)),
        }
    }
}
