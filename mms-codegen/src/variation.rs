//! Variations of a field: another field that is made of it, to be evaluated at extremes that its own parameters do not reach,
//! or simple enough that a consistent solver errs by round-off alone.
//!
//! A variation is made before anything is differentiated, so the varied field is derived like any other: s u(X, t) if there is
//! no amplitude, u(X - s, t) for a body off the origin, another lambda/mu in the material. The claims of the field are not
//! tested, for the varied field may violate them; only the affine part has claims, u or P N on every face.

use std::ops::Range;

use mms_mechanics::derivation::Derivation;
use mms_mechanics::extent::Region;
use mms_mechanics::face::Formulas;
use mms_mechanics::largest_triangle;
use mms_mechanics::model::Model;
use mms_spec::quantity::Quantity;
use mms_spec::source::{Sources, Spanned};
use mms_spec::{Claim, FieldSpec, Formula, ParameterSpec, Space};
use mms_symbolic::expr::{Expr, Graph, HALF, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::substitute::{coordinates, substitute};
use mms_symbolic::sorted::SortedMap;

/// The change to a field.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Variation {
    /// No change.
    #[default]
    Nothing,
    /// The displacement is s u(X, t), with a new last parameter s = 1.
    Scaled,
    /// The body lies elsewhere: u(X - s, t), and its material likewise. The new last parameter s = 0 is the same along each
    /// axis; an axisymmetric field moves along Z alone.
    Shifted,
    /// The field is shifted as by `Shifted`, and its body, a box, with it.
    Moved,
    /// The affine part of the motion about the middle c of the body: u(c, t) + H(c, t) (X - c). Faces at rest then become
    /// prescribed, and free ones get their traction; closed forms are omitted.
    Affine,
    /// The material has this ratio of lambda to mu, a number as field files write it.
    Moduli(String),
    /// Each parameter of the material is multiplied by a factor of 1. The factors are new last parameters, in the order of the
    /// material's arguments, with the names of [`factor_of`].
    Factors,
    /// The body force has the other sign: a deliberate mistake. Everything else is as in the file; closed forms are omitted.
    ForceReversed,
}

/// The body force, per mass and per volume.
const FORCES: [Quantity; 3] =
    [Quantity::BodyForce, Quantity::BodyForceDensity, Quantity::CurrentBodyForceDensity];

/// The name of the factor of a parameter of the material.
pub fn factor_of(parameter: &str) -> String {
    format!("factor_of_{parameter}")
}

/// Pairs of material arguments that fix lambda/mu = r: the argument that is replaced, the one that it is computed from, and the
/// factor as a formula of r.
const PAIRS: [(&str, &str, &str); 3] =
    [("lambda", "mu", "(r)"), ("kappa", "mu", "((r) + 2/3)"), ("nu", "young", "")];

impl Variation {
    /// Checks that a field can be varied in this way, or returns what it lacks.
    pub fn fits(&self, field: &FieldSpec) -> Result<(), String> {
        match self {
            Variation::Moved if !matches!(field.domain.body, mms_spec::BodySpec::Box { .. }) => {
                let why = match &field.domain.body {
                    mms_spec::BodySpec::Round(round) => format!("{} lies about the origin", round.shape.noun),
                    mms_spec::BodySpec::Nothing => "there is none".into(),
                    _ => "only boxes are moved".into(),
                };
                Err(format!("the body is no box: {why}"))
            }
            Variation::Affine if field.space.is_axisymmetric() => {
                Err("an axisymmetric field has no affine part: its u_R/R has no value on the axis".into())
            }
            Variation::Moduli(_) if pair(field).is_none() && !has_definitions(field) => {
                Err("the material is not given by lambda and mu, kappa and mu, or young and nu, and no definition is called lambda".into())
            }
            _ => Ok(()),
        }
    }

    /// Changes formulas and parameters, before any name is resolved. Each inserted text becomes a source of its own.
    pub(crate) fn rewrite(&self, sources: &mut Sources, field: &mut FieldSpec) {
        match self {
            Variation::Nothing => {}
            Variation::Affine => give_data(field),
            Variation::Scaled => add_parameter(sources, field, "scale of u", "1"),
            Variation::Shifted | Variation::Moved => {
                add_parameter(sources, field, "shift of X", "0")
            }
            Variation::Moduli(ratio) => set_moduli(sources, field, ratio),
            Variation::Factors => set_factors(sources, field),
            Variation::ForceReversed => field.checks.clear(),
        }
    }

    /// Changes the derived quantities.
    pub(crate) fn falsify(&self, graph: &mut Graph, derivation: &mut Derivation) {
        if *self == Variation::ForceReversed {
            for quantity in FORCES {
                for component in derivation.quantities.get_mut(&quantity).into_iter().flatten() {
                    *component = graph.scale(*component, -1);
                }
            }
        }
    }

    /// Changes the meaning of the formulas.
    pub(crate) fn transform(&self, graph: &mut Graph, model: &mut Model) {
        if *self == Variation::Affine {
            return affine(graph, model);
        }
        let Some(last) = model.parameters.len().checked_sub(1) else { return };
        let parameter = graph.symbol(Symbol::Parameter(last));
        match self {
            Variation::Nothing | Variation::Affine => {}
            Variation::Moduli(_) | Variation::Factors | Variation::ForceReversed => {}
            Variation::Scaled => {
                for component in &mut model.displacement {
                    *component = graph.mul(parameter, *component);
                }
            }
            Variation::Shifted => shift(graph, model, parameter),
            Variation::Moved => {
                shift(graph, model, parameter);
                if let Region::Block(block) = &mut model.domain.body {
                    for axis in free_axes(model.space) {
                        for bound in &mut block.bounds[axis] {
                            *bound = graph.add(*bound, parameter);
                        }
                    }
                }
            }
        }
    }
}

/// Adds a parameter after the others, under a name that no file can have.
fn add_parameter(sources: &mut Sources, field: &mut FieldSpec, name: &str, value: &str) {
    let source = sources.add("variation", value);
    let span = sources.span(source, 0, value.len());
    field.parameters.push(ParameterSpec {
        name: Spanned { value: name.into(), span },
        value: Formula::plain(value, span),
        unit: None,
        symbol: None,
        doc: None,
        range: None,
        frozen: false,
    });
}

/// The places of two arguments of the material that fix lambda/mu, and the factor between them.
fn pair(field: &FieldSpec) -> Option<(usize, usize, &'static str)> {
    let arguments = &field.material.arguments;
    let place = |name: &str| arguments.iter().position(|(argument, _)| argument.value == name);
    PAIRS
        .iter()
        .find_map(|(replaced, other, factor)| Some((place(replaced)?, place(other)?, *factor)))
}

/// Whether the file defines lambda and, above it, mu.
fn has_definitions(field: &FieldSpec) -> bool {
    let place = |name: &str| field.lets.iter().position(|it| it.name.value == name);
    place("mu").zip(place("lambda")).is_some_and(|(mu, lambda)| mu < lambda)
}

fn set_moduli(sources: &mut Sources, field: &mut FieldSpec, ratio: &str) {
    let mut formula = |text: String| {
        let source = sources.add("variation", text.as_str());
        Formula::plain(&text, sources.span(source, 0, text.len()))
    };
    if let Some((replaced, other, factor)) = pair(field) {
        let other = &field.material.arguments[other].1.text;
        let text = match factor {
            "" => format!("({ratio})/(2*(1 + ({ratio})))"),
            factor => format!("{}*({other})", factor.replace("(r)", &format!("({ratio})"))),
        };
        field.material.arguments[replaced].1 = formula(text);
    } else if let Some(lambda) = field.lets.iter_mut().find(|it| it.name.value == "lambda") {
        lambda.value = formula(format!("({ratio})*mu"));
    }
}

fn set_factors(sources: &mut Sources, field: &mut FieldSpec) {
    for at in 0..field.material.arguments.len() {
        let (name, formula) = &field.material.arguments[at];
        let factor = factor_of(&name.value);
        let text = format!("{factor}*({})", formula.text);
        let source = sources.add("variation", text.as_str());
        field.material.arguments[at].1 = Formula::plain(&text, sources.span(source, 0, text.len()));
        add_parameter(sources, field, &factor, "1");
    }
}

/// Replaces claims about faces that the affine part does not satisfy by its data.
fn give_data(field: &mut FieldSpec) {
    for boundary in &mut field.boundary {
        let claim = &mut boundary.claim.value;
        *claim = match claim {
            Claim::Fixed | Claim::Roller | Claim::Prescribed => Claim::Prescribed,
            Claim::Free | Claim::Traction => Claim::Traction,
            Claim::Axis => Claim::Axis,
        };
    }
    field.checks.clear();
}

/// u becomes u(c) + H(c) (X - c).
fn affine(graph: &mut Graph, model: &mut Model) {
    let middle = middle(graph, model);
    let axes = || 0..middle.len();
    let there: SortedMap<_, _> =
        axes().map(|axis| (Symbol::Coordinate(axis), middle[axis])).collect();
    let mut affine = substitute(graph, &model.displacement, &there);
    for axis in axes() {
        let slopes = differentiate(graph, &model.displacement, Symbol::Coordinate(axis));
        let slopes = substitute(graph, &slopes, &there);
        let coordinate = graph.symbol(Symbol::Coordinate(axis));
        let offset = graph.sub(coordinate, middle[axis]);
        for (component, slope) in affine.iter_mut().zip(slopes) {
            let part = graph.mul(slope, offset);
            *component = graph.add(*component, part);
        }
    }
    model.displacement = affine;
}

/// The point of a body halfway between its bounds: in radius and angles if the body is round, the middle of the largest
/// triangle if it is a polygon.
fn middle(graph: &mut Graph, model: &Model) -> Vec<Expr> {
    match &model.domain.body {
        Region::Block(block) => {
            let halves: Vec<Expr> = block.bounds.iter().map(|bounds| mean(graph, bounds)).collect();
            let zero = graph.number(0);
            let at = std::array::from_fn(|axis| halves.get(axis).copied().unwrap_or(zero));
            block.system.position(&mut Formulas(graph), &at)[..halves.len()].to_vec()
        }
        Region::Polygon(vertices) => {
            let corners = largest_triangle(graph, model).map(|corner| vertices[corner]);
            (0..2).map(|axis| mean(graph, &corners.map(|corner| corner[axis]))).collect()
        }
        Region::Nothing(dimension) => {
            let half = graph.number(HALF);
            vec![half; *dimension]
        }
    }
}

fn mean(graph: &mut Graph, exprs: &[Expr]) -> Expr {
    let sum = graph.sum(exprs.iter().map(|expr| (*expr, Rational::ONE)));
    graph.scale(sum, Rational::ONE / Rational::from(exprs.len()))
}

/// The axes along which a field can be shifted: an axisymmetric one stays about its axis.
pub fn free_axes(space: Space) -> Range<usize> {
    usize::from(space.is_axisymmetric())..space.coordinates()
}

/// Replaces X by X - s everywhere.
fn shift(graph: &mut Graph, model: &mut Model, by: Expr) {
    let axes = free_axes(model.space);
    let moved = coordinates(graph, axes.map(|axis| (axis, by)), Graph::sub);
    model.map_formulas_of_x(|exprs| substitute(graph, exprs, &moved));
}
