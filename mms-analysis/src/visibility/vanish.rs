//! For each term, the expressions that are 0 if it is absent:
//!
//! | term | expressions |
//! |---|---|
//! | motion, its start and its end | v, a, da/dt; u, v, a with t replaced by the ends of the time window |
//! | shear, rotation, volume change | off-diagonal E, F - F^T, J - 1 |
//! | shape functions that represent u | u_i,JK; u_i,JJ; u_i,JKL |
//! | cross terms | the part of dP_iJ/dH_kL u_k,LJ with kL other than iJ |
//! | transposed stress | Div P - Div P^T |
//! | unequal moduli | lambda - mu at F = I |
//! | graded moduli, density | dP_iJ/dX_J at fixed H, drho0/dX |
//! | parameter p of the material | p d(Div P)/dp, from a second derivation in which p exp(s) replaces p |
//! | traction on a face | P N, with X replaced by its projection to the face |

use super::term::Term;
use mms_codegen::compile::Compiled;
use mms_mechanics::face;
use mms_mechanics::invariant::InvariantKind;
use mms_mechanics::kinematics::Route;
use mms_mechanics::model::energy_with;
use mms_mechanics::model::parameter_values;
use mms_mechanics::tensor::dot;
use mms_mechanics::{Model, Response, TooLarge, at_rest, derive};
use mms_spec::quantity::Quantity;
use mms_spec::source::Spanned;
use mms_spec::{Face, Formula, Space};
use mms_symbolic::expr::{Expr, Function, Graph, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::pass::substitute::substitute;
use mms_symbolic::sorted::SortedMap;

/// Every term that a field of this dimension may have, with the expressions that are 0 if it is absent.
pub fn terms(graph: &mut Graph, compiled: &Compiled) -> Vec<(Term, Vec<Expr>)> {
    let mut terms = motion(graph, compiled);
    terms.extend(strain(graph, compiled));
    let stress = Stress::new(graph, compiled);
    terms.extend(stress.terms(graph));
    terms.extend(moduli(graph, compiled));
    let density = compiled.model.density;
    terms.push((Term::GradedDensity, gradient(graph, &compiled.model, &[density])));
    terms.push((Term::BodyForce, quantity(compiled, Quantity::BodyForce).to_vec()));
    terms.extend(parameters(graph, compiled));
    terms.extend(tractions(graph, compiled));
    terms
}

fn quantity(compiled: &Compiled, quantity: Quantity) -> &[Expr] {
    &compiled.derivation.quantities[&quantity]
}

/// lambda - mu = dP_11/dF_22 - dP_12/dF_12 + P_22 at F = I; a material with fibres has more than two moduli.
fn moduli(graph: &mut Graph, compiled: &Compiled) -> Option<(Term, Vec<Expr>)> {
    if matches!(compiled.model.kind, InvariantKind::Fibrous(_)) {
        return None;
    }
    let [stress, tangent] = at_rest(graph, &compiled.model);
    let place = |[i, j, k, l]: [usize; 4]| tangent[((i * 3 + j) * 3 + k) * 3 + l];
    let [lambda, mu] = [place([0, 0, 1, 1]), place([0, 1, 0, 1])];
    let terms = [(lambda, Rational::ONE), (mu, Rational::NEG_ONE), (stress[4], Rational::ONE)];
    Some((Term::UnequalModuli, vec![graph.sum(terms)]))
}

/// The gradient of a tensor of any order: the derivatives of each component along every direction are adjacent.
fn gradient(graph: &mut Graph, model: &Model, of: &[Expr]) -> Vec<Expr> {
    let plain = slopes(graph, of, model.space.coordinates());
    let Some(radius) = model.radius else { return plain };
    let turned = around(graph, radius, of).into_iter();
    plain
        .chunks(2)
        .zip(turned)
        .flat_map(|(slopes, turned)| [slopes[0], slopes[1], turned])
        .collect()
}

/// The derivatives of every expression by every coordinate: the derivatives of one expression are adjacent.
fn slopes(graph: &mut Graph, of: &[Expr], coordinates: usize) -> Vec<Expr> {
    let by_axis: Vec<Vec<Expr>> =
        (0..coordinates).map(|axis| differentiate(graph, of, Symbol::Coordinate(axis))).collect();
    (0..of.len()).flat_map(|k| by_axis.iter().map(move |column| column[k])).collect()
}

/// The derivative of a tensor around the hoop, where its basis turns: for each index R it has -T/R with theta in place of R,
/// and for each index theta T/R with R in place of theta.
fn around(graph: &mut Graph, radius: Expr, of: &[Expr]) -> Vec<Expr> {
    let order = of.len().ilog(3);
    let turned = |place: usize| {
        let of_index = |index: u32| {
            let weight = 3usize.pow(index);
            match place / weight % 3 {
                0 => Some((of[place + 2 * weight], Rational::NEG_ONE)),
                2 => Some((of[place - 2 * weight], Rational::ONE)),
                _ => None,
            }
        };
        (0..order).filter_map(of_index).collect::<Vec<_>>()
    };
    let sums: Vec<Expr> = (0..of.len()).map(|place| graph.sum(turned(place))).collect();
    sums.into_iter().map(|sum| graph.div(sum, radius)).collect()
}

/// dP_iJ/dX_K at fixed H, K fastest, with the values of H substituted. Around the hoop of an axisymmetric field everything
/// turns with the basis, except the direction of fibres, which H does not contain.
fn explicit(
    graph: &mut Graph,
    model: &Model,
    response: &[Expr],
    values: &SortedMap<Symbol, Expr>,
    through_h: [&[Expr]; 2],
) -> Vec<Expr> {
    let directions = model.space.rows();
    let by_axis: Vec<Vec<Expr>> = (0..directions)
        .map(|axis| differentiate(graph, response, Symbol::Coordinate(axis)))
        .collect();
    let all: Vec<Expr> =
        (0..response.len()).flat_map(|k| by_axis.iter().map(move |column| column[k])).collect();
    let mut explicit = substitute(graph, &all, values);
    if let (Some(radius), InvariantKind::Fibrous(_)) = (model.radius, &model.kind) {
        let stress = substitute(graph, response, values);
        for (k, whole) in around(graph, radius, &stress).into_iter().enumerate() {
            let slot = k * directions + 2;
            let through = through_h.map(|it| (it[slot], Rational::NEG_ONE));
            explicit[slot] = graph.sum(through.into_iter().chain([(whole, Rational::ONE)]));
        }
    }
    explicit
}

/// The terms in time.
fn motion(graph: &mut Graph, compiled: &Compiled) -> Vec<(Term, Vec<Expr>)> {
    let [u, v, a] = [Quantity::Displacement, Quantity::Velocity, Quantity::Acceleration]
        .map(|of| quantity(compiled, of));
    let [first, last] = compiled.model.domain.time;
    let mut at =
        |of: &[Expr], time: Expr| substitute(graph, of, &SortedMap::from([(Symbol::Time, time)]));
    let (start, end) = ([u, v, a].map(|of| at(of, first)), at(u, last));
    let [displaced, moving, accelerated] = start;
    vec![
        (Term::Velocity, v.to_vec()),
        (Term::Acceleration, a.to_vec()),
        (Term::Jerk, differentiate(graph, a, Symbol::Time)),
        (Term::InitialDisplacement, displaced),
        (Term::InitialVelocity, moving),
        (Term::InitialAcceleration, accelerated),
        (Term::FinalDisplacement, end),
    ]
}

/// The terms of the displacement gradient and its derivatives.
fn strain(graph: &mut Graph, compiled: &Compiled) -> Vec<(Term, Vec<Expr>)> {
    let dimension = compiled.field.space.rows();
    let [h, e] =
        [Quantity::DisplacementGradient, Quantity::GreenLagrange].map(|of| quantity(compiled, of));
    let one = graph.number(1);
    let volume = graph.sub(quantity(compiled, Quantity::Jacobian)[0], one);
    // Shape functions represent the components of u, even if the basis turns with the point.
    let axes = compiled.field.dimension;
    let held = match compiled.field.space {
        Space::Cartesian(_) => h.to_vec(),
        Space::Axisymmetric { .. } => {
            slopes(graph, quantity(compiled, Quantity::Displacement), axes)
        }
    };
    let second = slopes(graph, &held, axes);
    let third = slopes(graph, &second, axes);
    let mut terms = vec![
        (Term::VolumeChange, vec![volume]),
        (Term::Curvature, second.clone()),
        (Term::ThirdGradient, third),
    ];
    if dimension == 1 {
        return terms;
    }
    let place = |k: usize| (k / dimension, k % dimension);
    let above: Vec<usize> = (0..h.len()).filter(|k| place(*k).0 < place(*k).1).collect();
    let turned = above.iter().map(|k| {
        let (row, column) = place(*k);
        graph.sub(h[*k], h[column * dimension + row])
    });
    let turned = turned.collect();
    // u_i,JJ is the component J of the gradient of H_iJ.
    let along = (0..held.len()).map(|k| second[k * axes + k % axes]).collect();
    terms.push((Term::Shear, above.iter().map(|k| e[*k]).collect()));
    terms.push((Term::Rotation, turned));
    terms.push((Term::CurvatureAlongAxes, along));
    if compiled.field.dimension == 3 {
        let outside = (0..h.len()).filter(|k| place(*k).0 == 2 || place(*k).1 == 2);
        terms.push((Term::OutOfPlane, outside.map(|k| h[k]).collect()));
    }
    terms
}

/// P as a function of H and X, at the gradient of the field.
struct Stress {
    dimension: usize,
    /// dP_iJ/dX_K at fixed H, K fastest.
    explicit: Vec<Expr>,
    /// dP_iJ/dH_mN u_m,NK with mN != iJ, K fastest.
    cross: Vec<Expr>,
    /// dP_iJ/dH_mN u_m,NK with mN = iJ, K fastest.
    direct: Vec<Expr>,
}

impl Stress {
    fn new(graph: &mut Graph, compiled: &Compiled) -> Self {
        let (dimension, model) = (compiled.field.space.rows(), &compiled.model);
        let response = &compiled.derivation.responses[&Response::FirstPiolaKirchhoff];
        let h = quantity(compiled, Quantity::DisplacementGradient);
        let leaf = |k: usize| Symbol::Gradient(k / dimension, k % dimension);
        let values = h.iter().enumerate().map(|(k, value)| (leaf(k), *value)).collect();
        let second = gradient(graph, model, h);
        // tangent[mN][iJ] = dP_iJ/dH_mN
        let tangent: Vec<Vec<Expr>> = (0..h.len())
            .map(|k| {
                let slopes = differentiate(graph, response, leaf(k));
                substitute(graph, &slopes, &values)
            })
            .collect();
        let mut through = |keeps: &dyn Fn(usize, usize) -> bool| -> Vec<Expr> {
            (0..h.len() * dimension)
                .map(|slot| {
                    let (component, axis) = (slot / dimension, slot % dimension);
                    let kept = (0..h.len()).filter(|k| keeps(component, *k));
                    let pairs = kept.map(|k| (tangent[k][component], second[k * dimension + axis]));
                    let pairs: Vec<_> = pairs.collect();
                    dot(graph, pairs)
                })
                .collect()
        };
        let cross = through(&|component, k| component != k);
        let direct = through(&|component, k| component == k);
        let explicit = explicit(graph, model, response, &values, [&cross, &direct]);
        Stress { dimension, explicit, cross, direct }
    }

    fn terms(&self, graph: &mut Graph) -> Vec<(Term, Vec<Expr>)> {
        let mut terms =
            vec![(Term::GradedModuli, self.divergence(graph, &[&self.explicit], false))];
        if self.dimension > 1 {
            let all = [&self.explicit[..], &self.cross, &self.direct];
            let (divergence, transposed) =
                (self.divergence(graph, &all, false), self.divergence(graph, &all, true));
            let pairs = divergence.into_iter().zip(transposed);
            let differences = pairs.map(|(a, b)| graph.sub(a, b)).collect();
            terms.push((Term::CrossTerms, self.divergence(graph, &[&self.cross], false)));
            terms.push((Term::TransposedStress, differences));
        }
        terms
    }

    /// The divergence of P, or of its transpose, from parts of its gradient.
    fn divergence(&self, graph: &mut Graph, parts: &[&[Expr]], is_transposed: bool) -> Vec<Expr> {
        let dimension = self.dimension;
        let slot = |row: usize, axis: usize| {
            let (first, second) = if is_transposed { (axis, row) } else { (row, axis) };
            (first * dimension + second) * dimension + axis
        };
        (0..dimension)
            .map(|row| {
                let terms = (0..dimension).flat_map(|axis| {
                    parts.iter().map(move |part| (part[slot(row, axis)], Rational::ONE))
                });
                let terms: Vec<_> = terms.collect();
                graph.sum(terms)
            })
            .collect()
    }
}

/// d(Div P)/ds at s = 0, if the parameter of the material is p exp(s): p d(Div P)/dp, which is 0 if p is 0. A parameter that
/// the density uses only as a number, such as an exponent, has no such term.
fn parameters(graph: &mut Graph, compiled: &Compiled) -> Vec<(Term, Vec<Expr>)> {
    let (field, material, model) = (&compiled.field, &compiled.material, &compiled.model);
    let mut varied = model.arguments.clone();
    let mut is_varied = Vec::new();
    for (k, value) in model.arguments.iter().enumerate() {
        let leaf = graph.symbol(Symbol::Local(k));
        let factor = graph.call(Function::Exp, &[leaf]);
        varied[k] = graph.mul(*value, factor);
        is_varied.push(energy_with(graph, field, material, &varied, &model.givens).is_some());
        if !is_varied[k] {
            varied[k] = *value;
        }
    }
    let energy =
        energy_with(graph, field, material, &varied, &model.givens).unwrap_or(model.energy);
    let divergence = divergence(graph, &Model { energy, ..model.clone() });
    let (zero, count) = (graph.number(0), model.arguments.len());
    let at_rest: SortedMap<Symbol, Expr> = (0..count).map(|k| (Symbol::Local(k), zero)).collect();
    let undefined = graph.call(Function::Ln, &[zero]);
    let term = |(k, (name, _)): (usize, &(Spanned<String>, Formula))| {
        let slopes = match is_varied[k] {
            true => differentiate(graph, &divergence, Symbol::Local(k)),
            false => vec![undefined],
        };
        (Term::Parameter(name.value.clone()), substitute(graph, &slopes, &at_rest))
    };
    field.material.arguments.iter().enumerate().map(term).collect()
}

/// Div P of a model, reduced as far as possible, so that for example ln J becomes 0 if the motion is a rotation.
fn divergence(graph: &mut Graph, model: &Model) -> Vec<Expr> {
    let relations = Relations::find(graph, &model.displacement);
    let reduced = graph.attempt(|graph| derive(graph, model, &relations, Route::Gradient));
    let derivation = match reduced {
        Some(Ok(derivation)) => Ok(derivation),
        _ => derive(graph, model, &Relations::default(), Route::Gradient),
    };
    // If the graph is full, its contents are not used.
    derivation.map_or_else(
        |TooLarge(_)| Vec::new(),
        |mut derivation| derivation.quantities.remove(&Quantity::DivP).unwrap_or_default(),
    )
}

/// P N on each face; a point of the body is projected to the face.
fn tractions(graph: &mut Graph, compiled: &Compiled) -> Vec<(Term, Vec<Expr>)> {
    let (model, field) = (&compiled.model, &compiled.field);
    let values = parameter_values(graph, model, &SortedMap::new()).into_iter().enumerate();
    let values = values.map(|(index, value)| (Symbol::Parameter(index), value)).collect();
    let (body, dimension) = (&model.domain.body, field.dimension);
    let declared = Face::of(&field.domain.body, field.space);
    let faces = face::existing_faces(graph, body, declared, &values);
    let mut term = |face: Face| {
        let normal = face::normal(graph, body, dimension, face);
        let mut place = face::projection(graph, body, face);
        place.extend((0..dimension).map(Symbol::Normal).zip(normal));
        (Term::Traction(face), substitute(graph, quantity(compiled, Quantity::Traction), &place))
    };
    faces.into_iter().map(&mut term).collect()
}
