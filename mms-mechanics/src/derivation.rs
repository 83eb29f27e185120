//! Derives every quantity of a resolved field.

use crate::amplitude::{Amplitude, rewritten};
use crate::faults;
use crate::invariant::{InvariantKind, SUPPLIED_VOLUME};
use crate::kinematics::{Motion, Route, Strain, gradient_of, half_angles, traceless};
use crate::material::{self, Law};
use crate::model::Model;
use crate::tensor::{Tensor, dot};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Graph, HALF, Symbol};
use mms_symbolic::pass::cancellation::avoid_cancellation;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::sorted::SortedMap;

/// Functions of a displacement gradient H that the caller supplies: the material of the field for a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Response {
    /// Reference density rho0(X).
    Density,
    /// The fastest wave speed at F = I with each given field at rest, m/s.
    WaveSpeed,
    /// W(H).
    StrainEnergy,
    /// P(H) = dW/dF.
    FirstPiolaKirchhoff,
    /// P F^T at H. It is tau, except at small strain, where the updated formulation takes its divergence.
    KirchhoffStress,
    /// dP_iJ/dF_kL at H, the last index fastest. Derived on request, by [`tangent`].
    Tangent,
}

/// All quantities of a field as expressions.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// The components of each quantity, tensors row-major.
    pub quantities: SortedMap<Quantity, Vec<Expr>>,
    /// The components of each response.
    pub responses: SortedMap<Response, Vec<Expr>>,
}

/// The part that was being derived when the graph reached its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge(pub &'static str);

/// Derives every quantity of a field; the motion is simplified by `relations` between its parts.
pub fn derive(
    graph: &mut Graph,
    model: &Model,
    relations: &Relations,
    route: Route<'_>,
) -> Result<Derivation, TooLarge> {
    let law = Law::new(graph, model.energy, &model.kind);
    within_bound(graph, "stress of the material")?;
    let motion = Motion::new(graph, model, relations, route);
    within_bound(graph, "motion (velocity, acceleration, displacement gradient)")?;
    let mut quantities = kinematic_quantities(graph, model, &motion);
    quantities.extend(strain_quantities(graph, &motion.strain));
    let energy = match route {
        Route::Gradient | Route::Settled(_) => law.energy(graph, &motion.strain),
        Route::Deformation => law.typed_energy(graph, &motion.strain),
    };
    let present = Present::new(graph, &model.kind, &motion.strain);
    let facing = model.space.coordinates();
    quantities.extend(stress_quantities(graph, &law, &motion.strain, energy, &present, facing));
    within_bound(graph, "stress")?;
    let divergence = law.divergence(graph, &motion);
    within_bound(graph, "divergence of the stress")?;
    quantities.extend(balance_quantities(graph, model.density, &motion, &present, divergence));
    let own = model.own.iter();
    quantities.extend(own.map(|(own, components)| (Quantity::Own(*own), components.clone())));
    validate_directions(model, &mut quantities);
    let responses = responses(graph, &law, model);
    within_bound(graph, "body force")?;
    Ok(Derivation { quantities, responses })
}

/// Derives the quantities that vanish with the displacement or the strain, such that only the given numbers can cancel in them:
/// rotations, and functions less their value at 0, are separated in exact numbers. `None` if there is nothing to separate.
pub fn derive_without_cancellation(
    graph: &mut Graph,
    model: &Model,
    relations: &Relations,
    amplitude: Option<&Amplitude>,
) -> Result<Option<SortedMap<Quantity, Vec<Expr>>>, TooLarge> {
    let plain = factor(graph, &model.displacement);
    let gradient = gradient_of(graph, model, &plain);
    let gradient = traceless(graph, model, gradient);
    let displacement = avoid_cancellation(graph, &plain);
    let displacement = rewritten(graph, amplitude, &plain, &displacement);
    let halves = half_angles(graph, &plain, &gradient);
    let of = [relations, &halves];
    let strain = Strain::without_cancellation(graph, gradient.clone(), &model.kind, of, amplitude);
    let stable = avoid_cancellation(graph, gradient.components());
    let stable = rewritten(graph, amplitude, gradient.components(), &stable);
    let as_it_was = stable == gradient.components();
    within_bound(graph, "strain")?;
    if !halves.has_angles() && displacement == plain && as_it_was {
        return Ok(None);
    }
    let law = Law::new(graph, model.energy, &model.kind);
    let energy = law.energy(graph, &strain);
    let present = Present::new(graph, &model.kind, &strain).turned(halves.has_angles());
    let mut quantities = strain_quantities(graph, &strain);
    let facing = model.space.coordinates();
    quantities.extend(stress_quantities(graph, &law, &strain, energy, &present, facing));
    quantities.insert(Quantity::Displacement, displacement);
    quantities.insert(Quantity::DisplacementGradient, strain.gradient.components().to_vec());
    validate_directions(model, &mut quantities);
    within_bound(graph, "stress")?;
    Ok(Some(quantities))
}

/// Truncates vectors to the components that the field has: without a swirl the hoop component is 0.
fn validate_directions(model: &Model, quantities: &mut SortedMap<Quantity, Vec<Expr>>) {
    for (quantity, components) in quantities.iter_mut() {
        components.truncate(model.space.components(quantity.shape()));
    }
}

pub(crate) fn within_bound(graph: &Graph, what: &'static str) -> Result<(), TooLarge> {
    if graph.is_exhausted() { Err(TooLarge(what)) } else { Ok(()) }
}

/// u, x = X + u, v, a, H, F and J.
fn kinematic_quantities(
    graph: &mut Graph,
    model: &Model,
    motion: &Motion,
) -> SortedMap<Quantity, Vec<Expr>> {
    let strain = &motion.strain;
    let displacement = motion.displacement.iter().enumerate();
    let position = displacement
        .map(|(axis, component)| match axis < model.space.coordinates() {
            true => {
                let reference = graph.symbol(Symbol::Coordinate(axis));
                graph.add(reference, *component)
            }
            false => *component,
        })
        .collect();
    SortedMap::from([
        (Quantity::Displacement, motion.displacement.clone()),
        (Quantity::Position, position),
        (Quantity::Velocity, motion.velocity.clone()),
        (Quantity::Acceleration, motion.acceleration.clone()),
        (Quantity::DisplacementGradient, strain.gradient.components().to_vec()),
        (Quantity::DeformationGradient, strain.deformation.components().to_vec()),
        (Quantity::Jacobian, vec![strain.jacobian]),
    ])
}

/// C, B and E = (C - I)/2. E is computed from H, so that small strains do not cancel.
fn strain_quantities(graph: &mut Graph, strain: &Strain) -> SortedMap<Quantity, Vec<Expr>> {
    let identity = Tensor::identity(graph, strain.gradient.dimension());
    let right = identity.add(graph, &strain.right);
    let left = identity.add(graph, &strain.left);
    let half = graph.number(HALF);
    let lagrange = strain.right.scale(graph, half);
    SortedMap::from([
        (Quantity::RightCauchyGreen, right.components().to_vec()),
        (Quantity::LeftCauchyGreen, left.components().to_vec()),
        (Quantity::GreenLagrange, lagrange.components().to_vec()),
    ])
}

/// The present configuration: F and J, which carry stresses and densities to it.
///
/// The small strain does not distinguish it from the reference configuration: F is I and J is 1 here, so that there is one
/// stress. The updated formulation takes the divergence of [`Response::KirchhoffStress`], P F^T.
pub(super) struct Present {
    /// F.
    pub deformation: Tensor,
    /// 1/J.
    pub per_volume: Expr,
    /// Whether tau is computed as P F^T instead of from B - I. B - I needs no inverse, but turns with a rotation and grows,
    /// while the rotation cancels in C - I.
    by_first: bool,
}

impl Present {
    pub fn new(graph: &mut Graph, kind: &InvariantKind, strain: &Strain) -> Self {
        if *kind == InvariantKind::SmallStrain {
            let deformation = Tensor::identity(graph, strain.gradient.dimension());
            return Present { deformation, per_volume: graph.number(1), by_first: true };
        }
        let per_volume = graph.power(strain.jacobian, -1);
        Present { deformation: strain.deformation.clone(), per_volume, by_first: false }
    }

    fn turned(self, is_turned: bool) -> Self {
        Present { by_first: self.by_first || is_turned, ..self }
    }
}

/// W, P, P^T, sigma = tau/J, tau and P N, with the components of N that are `facing` somewhere: no normal has a hoop component.
fn stress_quantities(
    graph: &mut Graph,
    law: &Law,
    strain: &Strain,
    energy: Expr,
    present: &Present,
    facing: usize,
) -> SortedMap<Quantity, Vec<Expr>> {
    let first = law.first_piola_kirchhoff(graph, strain);
    let kirchhoff = match present.by_first {
        true => first.mul(graph, &present.deformation.transpose()),
        false => law.kirchhoff(graph, strain),
    };
    let cauchy = kirchhoff.scale(graph, present.per_volume);
    let dimension = first.dimension();
    let traction = (0..dimension)
        .map(|row| {
            let pairs: Vec<_> = (0..facing)
                .map(|axis| (first.at(row, axis), graph.symbol(Symbol::Normal(axis))))
                .collect();
            dot(graph, pairs)
        })
        .collect();
    SortedMap::from([
        (Quantity::StrainEnergy, vec![energy]),
        (Quantity::FirstPiolaKirchhoff, first.components().to_vec()),
        (Quantity::NominalStress, first.transpose().components().to_vec()),
        (Quantity::CauchyStress, cauchy.components().to_vec()),
        (Quantity::KirchhoffStress, kirchhoff.components().to_vec()),
        (Quantity::Traction, traction),
    ])
}

/// rho = rho0 / J, div sigma = Div P / J by the Piola identity (Bonet & Wood, Nonlinear Continuum
/// Mechanics for Finite Element Analysis, 2008, chapter 5), b = a - Div P / rho0, rho0 b = rho0 a -
/// Div P, and rho b = rho0 b / J.
fn balance_quantities(
    graph: &mut Graph,
    density: Expr,
    motion: &Motion,
    present: &Present,
    divergence: Vec<Expr>,
) -> SortedMap<Quantity, Vec<Expr>> {
    let stretched = graph.power(motion.strain.jacobian, -1);
    let mut body_force = Vec::new();
    let mut body_force_density = Vec::new();
    for (acceleration, divergence) in motion.acceleration.iter().zip(&divergence) {
        let specific = graph.div(*divergence, density);
        let force = graph.sub(*acceleration, specific);
        let balance = [*acceleration, *divergence];
        body_force.push(faults::body_force(graph, force, balance, [density, stretched]));
        let inertia = graph.mul(density, *acceleration);
        body_force_density.push(graph.sub(inertia, *divergence));
    }
    let mut current = |reference: &[Expr]| -> Vec<Expr> {
        reference.iter().map(|component| graph.mul(present.per_volume, *component)).collect()
    };
    SortedMap::from([
        (Quantity::MassDensity, current(&[density])),
        (Quantity::DivSigma, current(&divergence)),
        (Quantity::CurrentBodyForceDensity, current(&body_force_density)),
        (Quantity::DivP, divergence),
        (Quantity::BodyForce, body_force),
        (Quantity::BodyForceDensity, body_force_density),
    ])
}

/// The strain of a displacement gradient that the caller supplies.
fn supplied(graph: &mut Graph, model: &Model) -> Strain {
    // J - 1 as a leaf of its own; only bounds replace the expression in H by it.
    graph.symbol(SUPPLIED_VOLUME);
    let dimension = model.displacement.len();
    let gradient =
        Tensor::from_fn(dimension, |row, column| graph.symbol(Symbol::Gradient(row, column)));
    Strain::new(graph, gradient, &model.kind, &Relations::default())
}

fn responses(graph: &mut Graph, law: &Law, model: &Model) -> SortedMap<Response, Vec<Expr>> {
    let strain = supplied(graph, model);
    let modulus = match model.rest_energy == model.energy {
        true => law.fastest_modulus(graph, &model.kind),
        false => {
            Law::new(graph, model.rest_energy, &model.kind).fastest_modulus(graph, &model.kind)
        }
    };
    let squared_speed = graph.div(modulus, model.density);
    let speed = graph.power(squared_speed, HALF);
    SortedMap::from([
        (Response::Density, vec![model.density]),
        (Response::WaveSpeed, vec![speed]),
        (Response::StrainEnergy, vec![law.energy(graph, &strain)]),
        (
            Response::FirstPiolaKirchhoff,
            law.first_piola_kirchhoff(graph, &strain).components().to_vec(),
        ),
        (Response::KirchhoffStress, law.kirchhoff(graph, &strain).components().to_vec()),
    ])
}

/// The components of [`Response::Tangent`].
pub fn tangent(graph: &mut Graph, model: &Model) -> Result<Vec<Expr>, TooLarge> {
    let strain = supplied(graph, model);
    let tangent = material::tangent(graph, model.energy, &model.kind, &strain);
    within_bound(graph, "tangent of the stress")?;
    Ok(tangent)
}
