//! Kinematics: everything that follows from a displacement, or from its gradient alone.
//!
//! If tr H is 0 for all parameters, but not as it is written (sin 2X in one component, 2 sin X cos X in the other), one
//! component of the diagonal is written as minus the others: a large bulk modulus would multiply the rounding error. Values
//! decide whether it is 0 (`samples.rs`). Then I : F,J is omitted from the gradients of the invariants as well.

use crate::amplitude::{Amplitude, rewritten};
use crate::axisymmetric;
use crate::invariant::{
    EXCESS, FIBRE, FIRST, InvariantKind, MINORS, SECOND, SMALL_SQUARE, SMALL_TRACE, VOLUME,
};
use crate::model::Model;
use crate::samples::cancel;
use crate::tensor::{Tensor, derivative, dot};
use mms_symbolic::expr::{Expr, Graph, HALF, Rational, Symbol};
use mms_symbolic::pass::cancellation::avoid_cancellation;
use mms_symbolic::pass::factor::factor;
use mms_symbolic::pass::reduce::reduce;
use mms_symbolic::pass::relations::Relations;
use mms_symbolic::sorted::SortedMap;

/// The strain that follows from a displacement gradient H = du/dX at one point.
#[derive(Clone, Debug)]
pub struct Strain {
    /// H.
    pub gradient: Tensor,
    /// F = I + H.
    pub deformation: Tensor,
    /// J = det F.
    pub jacobian: Expr,
    /// F^-1.
    pub inverse: Tensor,
    /// C - I = H + H^T + H^T H, twice the Green-Lagrange strain.
    pub right: Tensor,
    /// B - I = H + H^T + H H^T.
    pub left: Tensor,
    /// The variables of the density, by symbol.
    pub invariants: SortedMap<Symbol, Expr>,
    /// The fibres, if the density is a function of I4.
    pub fibre: Option<Fibre>,
}

/// The input from which a strain is computed.
#[derive(Clone, Copy, Debug)]
pub enum Route<'a> {
    /// H: expressions that are small with H are computed without cancellation.
    Gradient,
    /// F: in fewer operations, and with errors of the size of eps.
    Deformation,
    /// H, with all terms that cancel at small strains separated: see [`Strain::without_cancellation`].
    Settled(Option<&'a Amplitude>),
}

/// The relations of half the angles by which a displacement rotates. These are the angles a for which cos a - 1 occurs in H: H
/// is as small as sin(a/2).
pub(super) fn half_angles(
    graph: &mut Graph,
    displacement: &[Expr],
    gradient: &Tensor,
) -> Relations {
    let stable = avoid_cancellation(graph, gradient.components());
    Relations::of_half_angles(graph, displacement, &stable)
}

/// The tensors of a strain.
struct Tensors {
    gradient: Tensor,
    deformation: Tensor,
    right: Tensor,
    left: Tensor,
}

/// The direction of fibres at one point, one component per dimension of the field.
#[derive(Clone, Debug)]
pub struct Fibre {
    /// a0, a unit vector in space.
    pub reference: Vec<Expr>,
    /// F a0, whose length is the stretch of the fibre.
    pub present: Vec<Expr>,
}

impl Strain {
    /// Computes the strain from the displacement gradient, every part reduced modulo `relations`, with the invariants of this
    /// kind of density.
    pub fn new(
        graph: &mut Graph,
        gradient: Tensor,
        kind: &InvariantKind,
        relations: &Relations,
    ) -> Self {
        let identity = Tensor::identity(graph, gradient.dimension());
        let gradient = gradient.reduce(graph, relations);
        let deformation = identity.add(graph, &gradient);
        let transposed = gradient.transpose();
        let symmetric = gradient.add(graph, &transposed);
        let square = transposed.mul(graph, &gradient);
        let right = symmetric.add(graph, &square).reduce(graph, relations);
        let square = gradient.mul(graph, &transposed);
        let left = symmetric.add(graph, &square).reduce(graph, relations);
        let volume = gradient.determinant_less_one(graph);
        let volume = reduce(graph, &[volume], relations)[0];
        let excess = match relations.is_empty() {
            true => excess_of_gradient(graph, &gradient),
            false => excess_of_strain(graph, &right, volume),
        };
        let tensors = Tensors { gradient, deformation, right, left };
        Self::of(graph, tensors, [volume, excess], kind, [relations; 2])
    }

    /// Computes a strain that may be tiny beside the rotation: all terms that cancel do so in exact numbers. The first
    /// relations are for the angles, the second for half the angles.
    pub fn without_cancellation(
        graph: &mut Graph,
        gradient: Tensor,
        kind: &InvariantKind,
        [whole, relations]: [&Relations; 2],
        amplitude: Option<&Amplitude>,
    ) -> Self {
        let identity = Tensor::identity(graph, gradient.dimension());
        // F and its inverse are of size 1.
        let plain = gradient.reduce(graph, whole);
        let deformation = identity.add(graph, &plain);
        let mend = |graph: &mut Graph, plain: &Tensor| {
            let stable = plain.avoid_cancellation(graph, relations);
            rewritten_tensor(graph, plain, &stable, amplitude)
        };
        let gradient = mend(graph, &gradient);
        let transposed = gradient.transpose();
        let symmetric = gradient.add(graph, &transposed);
        let square = transposed.mul(graph, &gradient);
        let right = symmetric.add(graph, &square);
        let right = mend(graph, &right);
        let square = gradient.mul(graph, &transposed);
        let left = symmetric.add(graph, &square);
        let left = mend(graph, &left);
        let plain = gradient.determinant_less_one(graph);
        let volume = reduce(graph, &[plain], relations);
        let volume = avoid_cancellation(graph, &volume);
        let volume = rewritten(graph, amplitude, &[plain], &volume)[0];
        // Rotations cancel in C - I and in j, but not in expressions of H.
        let excess = match relations.is_empty() {
            true => excess_of_gradient(graph, &gradient),
            false => excess_of_strain(graph, &right, volume),
        };
        let tensors = Tensors { gradient, deformation, right, left };
        Self::of(graph, tensors, [volume, excess], kind, [&Relations::default(), whole])
    }

    /// Computes the strain from F = I + H, with J its determinant and C - I = F^T F - I: fewer operations, and errors of the
    /// size of eps for any strain.
    pub fn direct(
        graph: &mut Graph,
        gradient: Tensor,
        kind: &InvariantKind,
        relations: &Relations,
    ) -> Self {
        let identity = Tensor::identity(graph, gradient.dimension());
        let gradient = gradient.reduce(graph, relations);
        let deformation = identity.add(graph, &gradient);
        let transposed = deformation.transpose();
        let minus_one = graph.number(-1);
        let minus_identity = identity.scale(graph, minus_one);
        let [right, left] =
            [(&transposed, &deformation), (&deformation, &transposed)].map(|(first, second)| {
                let product = first.mul(graph, second);
                product.add(graph, &minus_identity).reduce(graph, relations)
            });
        let determinant = deformation.determinant(graph);
        let volume = graph.add(determinant, minus_one);
        let first = right.trace(graph);
        let excess = graph.sum([(first, Rational::ONE), (volume, Rational::from(-2))]);
        let tensors = Tensors { gradient, deformation, right, left };
        Self::of(graph, tensors, [volume, excess], kind, [relations; 2])
    }

    /// The strain of these tensors, with J - 1 and i1 - 2 (J - 1). The first relations reduce the
    /// invariants, the second F^-1.
    fn of(
        graph: &mut Graph,
        Tensors { gradient, deformation, right, left }: Tensors,
        [volume, excess]: [Expr; 2],
        kind: &InvariantKind,
        [relations, of_inverse]: [&Relations; 2],
    ) -> Self {
        let mut invariants: Vec<Expr> = match kind {
            InvariantKind::Isotropic | InvariantKind::Fibrous(_) => {
                first_invariants(graph, &gradient, &right).into()
            }
            InvariantKind::SmallStrain => small_invariants(graph, &gradient).into(),
        };
        let fibre = match kind {
            InvariantKind::Fibrous(reference) => Some(Fibre::new(graph, reference, &deformation)),
            InvariantKind::Isotropic | InvariantKind::SmallStrain => None,
        };
        invariants.push(volume);
        invariants.extend(fibre.as_ref().map(|fibre| fibre.stretch(graph, &right)));
        let invariants = reduce(graph, &invariants, relations);
        let one = graph.number(1);
        let jacobian = graph.add(one, invariants[2]);
        let symbols = match kind {
            InvariantKind::Isotropic | InvariantKind::Fibrous(_) => [FIRST, SECOND, VOLUME, FIBRE],
            InvariantKind::SmallStrain => [SMALL_TRACE, SMALL_SQUARE, VOLUME, FIBRE],
        };
        let mut invariants: SortedMap<Symbol, Expr> = symbols.into_iter().zip(invariants).collect();
        let minors = right.principal_minors(graph, 2);
        invariants.extend([(EXCESS, excess), (MINORS, minors)]);
        let reciprocal = graph.power(jacobian, -1);
        let adjugate = deformation.adjugate(graph).reduce(graph, of_inverse);
        let inverse = adjugate.scale(graph, reciprocal);
        Strain { gradient, deformation, jacobian, inverse, right, left, invariants, fibre }
    }

    /// (adj F - I)/J if tr H = 0: it replaces F^-1 in contractions with traceless tensors, and is of the size of H.
    fn inverse_beside_identity(&self, graph: &mut Graph) -> Tensor {
        let minors = self.gradient.adjugate(graph);
        let rest = match self.gradient.dimension() {
            3 => {
                let minus_one = graph.number(-1);
                self.gradient.scale(graph, minus_one).add(graph, &minors)
            }
            _ => minors,
        };
        let reciprocal = graph.power(self.jacobian, -1);
        rest.scale(graph, reciprocal)
    }

    /// The small strain eps = (H + H^T)/2.
    pub fn small(&self, graph: &mut Graph) -> Tensor {
        small_strain(graph, &self.gradient)
    }
}

impl Fibre {
    fn new(graph: &mut Graph, reference: &[Expr], deformation: &Tensor) -> Self {
        Fibre { reference: reference.to_vec(), present: deformation.apply(graph, reference) }
    }

    /// I4 - 1 = a0.(C - I) a0, from C - I.
    fn stretch(&self, graph: &mut Graph, right: &Tensor) -> Expr {
        let image = right.apply(graph, &self.reference);
        dot(graph, self.reference.iter().copied().zip(image))
    }
}

fn small_strain(graph: &mut Graph, gradient: &Tensor) -> Tensor {
    let half = graph.number(HALF);
    let transposed = gradient.transpose();
    gradient.add(graph, &transposed).scale(graph, half)
}

/// tr eps and eps:eps, from H.
fn small_invariants(graph: &mut Graph, gradient: &Tensor) -> [Expr; 2] {
    let strain = small_strain(graph, gradient);
    [gradient.trace(graph), strain.contract(graph, &strain)]
}

/// I1 - 3 = tr (C - I), or |H|^2 if tr H = 0, and I2 - 3 = 2 i1 + q, from C - I and the sum q of its principal minors of two
/// rows.
fn first_invariants(graph: &mut Graph, gradient: &Tensor, right: &Tensor) -> [Expr; 2] {
    let trace = gradient.trace(graph);
    let first = match graph.is_zero(trace) {
        true => gradient.contract(graph, gradient),
        false => right.trace(graph),
    };
    let minors = right.principal_minors(graph, 2);
    [first, graph.sum([(first, Rational::from(2)), (minors, Rational::ONE)])]
}

/// i1 - 2 j = |H|^2 - 2 q(H) - 2 det H, from H: nothing cancels at small or large strains, but a rotation does not cancel
/// either.
fn excess_of_gradient(graph: &mut Graph, gradient: &Tensor) -> Expr {
    let square = gradient.contract(graph, gradient);
    let [second, third] = [2, 3].map(|rows| gradient.principal_minors(graph, rows));
    let minus_two = Rational::from(-2);
    graph.sum([(square, Rational::ONE), (second, minus_two.clone()), (third, minus_two)])
}

/// i1 - 2 j = (i1 j - 2 (q + det A))/(2 + j) with A = C - I and q its principal minors of two rows,
/// since 2 j + j^2 = det C - 1 = i1 + q + det A. It is as exact as A and j are, and does not cancel
/// at a large change of volume, where i1 + q + det A is of the size of J^2.
fn excess_of_strain(graph: &mut Graph, right: &Tensor, volume: Expr) -> Expr {
    let first = right.trace(graph);
    let [second, third] = [2, 3].map(|rows| right.principal_minors(graph, rows));
    let crossed = graph.mul(first, volume);
    let minus_two = Rational::from(-2);
    let numerator =
        graph.sum([(crossed, Rational::ONE), (second, minus_two.clone()), (third, minus_two)]);
    let two = graph.number(2);
    let denominator = graph.add(two, volume);
    graph.div(numerator, denominator)
}

/// The motion that follows from a displacement u(X, t).
#[derive(Clone, Debug)]
pub struct Motion {
    /// u.
    pub displacement: Vec<Expr>,
    /// v = du/dt at fixed X.
    pub velocity: Vec<Expr>,
    /// a = dv/dt at fixed X.
    pub acceleration: Vec<Expr>,
    /// H and its strain.
    pub strain: Strain,
    /// d2u_i / dX_J dX_K as one matrix per i.
    pub second_gradient: Vec<Tensor>,
    /// (ln J),J = F^-1_Kk u_k,KJ.
    pub log_volume_gradient: Vec<Expr>,
    /// The gradients of the variables of the density, by symbol.
    pub invariant_gradients: SortedMap<Symbol, Vec<Expr>>,
    /// a0_K,J, if there are fibres.
    pub fibre_gradient: Option<Tensor>,
    /// The number of reference coordinates: scalars have no slope along further directions.
    coordinates: usize,
}

impl Motion {
    /// Computes the motion from the displacement, simplified by `relations` between its parts.
    ///
    /// With relations the invariants are short, and their gradients are computed as derivatives; without them the gradients are
    /// computed by tensor algebra, which shares the second gradient of u.
    pub fn new(graph: &mut Graph, model: &Model, relations: &Relations, route: Route<'_>) -> Self {
        let kind = &model.kind;
        let displacement = factor(graph, &model.displacement);
        let velocity = derivative(graph, &displacement, Symbol::Time);
        let acceleration = derivative(graph, &velocity, Symbol::Time);
        let gradient = gradient_of(graph, model, &displacement);
        let gradient = traceless(graph, model, gradient);
        let second_gradient = second_gradient_of(graph, model, &gradient);
        let strain = match route {
            Route::Gradient => Strain::new(graph, gradient, kind, relations),
            Route::Deformation => Strain::direct(graph, gradient, kind, relations),
            Route::Settled(amplitude) => {
                let halves = half_angles(graph, &displacement, &gradient);
                Strain::without_cancellation(graph, gradient, kind, [relations, &halves], amplitude)
            }
        };
        let fibre_gradient = match kind {
            InvariantKind::Fibrous(direction) => Some(gradient_of(graph, model, direction)),
            InvariantKind::Isotropic | InvariantKind::SmallStrain => None,
        };
        let amplitude = match route {
            Route::Settled(amplitude) => amplitude,
            Route::Gradient | Route::Deformation => None,
        };
        let [velocity, acceleration] =
            [velocity, acceleration].map(|rate| rewritten(graph, amplitude, &rate, &rate));
        let second_gradient: Vec<Tensor> = (second_gradient.iter())
            .map(|second| rewritten_tensor(graph, second, second, amplitude))
            .collect();
        let mut motion = Motion {
            displacement,
            velocity,
            acceleration,
            strain,
            second_gradient,
            log_volume_gradient: Vec::new(),
            invariant_gradients: SortedMap::new(),
            fibre_gradient,
            coordinates: model.space.coordinates(),
        };
        if !relations.is_empty() && !matches!(route, Route::Settled(_)) {
            motion.differentiate_invariants(graph, relations);
        } else if *kind == InvariantKind::SmallStrain {
            motion.contract_small_strain(graph);
        } else {
            motion.contract_invariants(graph);
            motion.contract_fibre(graph);
        }
        motion
    }

    fn differentiate_invariants(&mut self, graph: &mut Graph, relations: &Relations) {
        let dimension = self.displacement.len();
        let (symbols, invariants): (Vec<Symbol>, Vec<Expr>) = self
            .strain
            .invariants
            .iter()
            .filter(|(symbol, _)| ![EXCESS, MINORS].contains(symbol))
            .map(|(symbol, value)| (*symbol, *value))
            .unzip();
        let slopes: Vec<Vec<Expr>> = (0..dimension)
            .map(|axis| {
                let slopes = derivative(graph, &invariants, Symbol::Coordinate(axis));
                reduce(graph, &slopes, relations)
            })
            .collect();
        let gradients = symbols.into_iter().enumerate().map(|(invariant, symbol)| {
            (symbol, slopes.iter().map(|slope| slope[invariant]).collect())
        });
        self.invariant_gradients = gradients.collect();
        let jacobian = self.strain.jacobian;
        let volume = &self.invariant_gradients[&VOLUME];
        self.log_volume_gradient = volume.iter().map(|slope| graph.div(*slope, jacobian)).collect();
    }

    /// I1,J = 2 F : F,J; I2,J = 2 (I1 F - F C) : F,J; J,J = J F^-T : F,J. If tr H = 0, I : F,J is omitted.
    fn contract_invariants(&mut self, graph: &mut Graph) {
        let strain = &self.strain;
        let identity = Tensor::identity(graph, self.displacement.len());
        let (three, two, minus_one) = (graph.number(3), graph.number(2), graph.number(-1));
        let trace = strain.gradient.trace(graph);
        let (stretch, right, first, inverse) = if graph.is_zero(trace) {
            let first = graph.add(strain.invariants[&FIRST], two);
            let inverse = strain.inverse_beside_identity(graph);
            (strain.gradient.clone(), strain.right.clone(), first, inverse)
        } else {
            let right = identity.add(graph, &strain.right);
            let first = graph.add(strain.invariants[&FIRST], three);
            (strain.deformation.clone(), right, first, strain.inverse.clone())
        };
        let cubic = strain.deformation.mul(graph, &right);
        let scaled = stretch.scale(graph, first);
        let second = cubic.scale(graph, minus_one).add(graph, &scaled);
        let mut twice = |with: &Tensor| -> Vec<Expr> {
            let half = self.contract_second_gradient(graph, with);
            half.into_iter().map(|component| graph.scale(component, 2)).collect()
        };
        let (first, second) = (twice(&stretch), twice(&second));
        let transposed = inverse.transpose();
        let log_volume = self.contract_second_gradient(graph, &transposed);
        let volume = log_volume.iter().map(|slope| graph.mul(strain.jacobian, *slope)).collect();
        self.log_volume_gradient = log_volume;
        self.invariant_gradients =
            SortedMap::from([(FIRST, first), (SECOND, second), (VOLUME, volume)]);
    }

    /// I4,J = 2 (F a0)_m a0_K u_m,KJ + 2 ((C - I) a0)_K a0_K,J.
    fn contract_fibre(&mut self, graph: &mut Graph) {
        let (Some(fibre), Some(turning)) = (&self.strain.fibre, &self.fibre_gradient) else {
            return;
        };
        let dimension = fibre.reference.len();
        let stretching = Tensor::outer(graph, &fibre.present, &fibre.reference);
        let stretching = self.contract_second_gradient(graph, &stretching);
        let image = self.strain.right.apply(graph, &fibre.reference);
        let mut gradient: Vec<Expr> = (0..dimension)
            .map(|axis| {
                let pairs =
                    image.iter().enumerate().map(|(k, image)| (*image, turning.at(k, axis)));
                let turned = dot(graph, pairs);
                let half = graph.add(stretching[axis], turned);
                graph.scale(half, 2)
            })
            .collect();
        gradient[self.coordinates..].fill(graph.number(0));
        self.invariant_gradients.insert(FIBRE, gradient);
    }

    /// (tr eps),J = u_K,KJ and (eps:eps),J = 2 eps_mK u_m,KJ.
    fn contract_small_strain(&mut self, graph: &mut Graph) {
        let identity = Tensor::identity(graph, self.displacement.len());
        let trace = self.contract_second_gradient(graph, &identity);
        let strain = self.strain.small(graph);
        let half = self.contract_second_gradient(graph, &strain);
        let square = half.into_iter().map(|component| graph.scale(component, 2)).collect();
        self.invariant_gradients = SortedMap::from([(SMALL_TRACE, trace), (SMALL_SQUARE, square)]);
    }

    /// d2u_i / dX_J dX_J.
    pub fn laplacian(&self, graph: &mut Graph) -> Vec<Expr> {
        self.second_gradient.iter().map(|second| second.trace(graph)).collect()
    }

    /// A_mK d2u_m / dX_K dX_J for every J: half the gradient of a scalar whose derivative is A. It is 0 around the hoop of an
    /// axisymmetric field.
    pub fn contract_second_gradient(&self, graph: &mut Graph, with: &Tensor) -> Vec<Expr> {
        let dimension = self.displacement.len();
        let mut slopes: Vec<Expr> = (0..self.coordinates)
            .map(|axis| {
                let pairs = (0..dimension * dimension).map(|k| {
                    let (row, column) = (k / dimension, k % dimension);
                    (with.at(row, column), self.second_gradient[row].at(column, axis))
                });
                dot(graph, pairs)
            })
            .collect();
        slopes.resize(dimension, graph.number(0));
        slopes
    }
}

/// Rewrites H such that its trace is 0 as written if it is 0 for all parameters: the trace is multiplied by moduli that may be
/// large.
pub(super) fn traceless(graph: &mut Graph, model: &Model, gradient: Tensor) -> Tensor {
    let dimension = gradient.dimension();
    let diagonal: Vec<Expr> = (0..dimension).map(|axis| gradient.at(axis, axis)).collect();
    let trace = gradient.trace(graph);
    if graph.is_zero(trace) || !cancel(graph, model, &diagonal) {
        return gradient;
    }
    let size = |axis: &usize| graph.reachable(&[gradient.at(*axis, *axis)]).len();
    let last = (0..dimension).max_by_key(size).unwrap_or_default();
    let others = (0..dimension).filter(|axis| *axis != last);
    let others = others.map(|axis| (gradient.at(axis, axis), Rational::from(-1)));
    let rest = graph.sum(others.collect::<Vec<_>>());
    Tensor::from_fn(dimension, |row, column| match (row, column) == (last, last) {
        true => rest,
        false => gradient.at(row, column),
    })
}

/// A tensor whose components keep their digits: a lossy component is replaced, see [`Amplitude::rewrite`].
fn rewritten_tensor(
    graph: &mut Graph,
    plain: &Tensor,
    stable: &Tensor,
    amplitude: Option<&Amplitude>,
) -> Tensor {
    let rewritten = rewritten(graph, amplitude, plain.components(), stable.components());
    Tensor::from_components(stable.dimension(), rewritten)
}

/// A_K,J of a vector field A.
pub fn gradient_of(graph: &mut Graph, model: &Model, vector: &[Expr]) -> Tensor {
    if let Some(radius) = model.radius {
        return axisymmetric::gradient(graph, radius, vector);
    }
    let columns: Vec<Vec<Expr>> =
        (0..vector.len()).map(|axis| derivative(graph, vector, Symbol::Coordinate(axis))).collect();
    Tensor::from_fn(vector.len(), |row, column| columns[column][row])
}

/// H_iJ,K of the gradient of a vector field, as one matrix for each i.
fn second_gradient_of(graph: &mut Graph, model: &Model, gradient: &Tensor) -> Vec<Tensor> {
    if let Some(radius) = model.radius {
        return axisymmetric::second_gradient(graph, radius, gradient);
    }
    let dimension = gradient.dimension();
    (0..dimension)
        .map(|component| {
            let row: Vec<Expr> = (0..dimension).map(|axis| gradient.at(component, axis)).collect();
            let second: Vec<Vec<Expr>> = (0..dimension)
                .map(|axis| derivative(graph, &row, Symbol::Coordinate(axis)))
                .collect();
            Tensor::from_fn(dimension, |j, k| second[k][j])
        })
        .collect()
}

/// The sum of expressions.
pub(super) fn total(graph: &mut Graph, terms: &[Expr]) -> Expr {
    graph.sum(terms.iter().map(|term| (*term, Rational::ONE)))
}
