//! The rigid twin of a field: its motion, followed by a rotation Q(t) about the origin and a translation d(t).
//!
//! ```text
//! x* = Q x + d     F* = Q F     P* = Q P     sigma* = Q sigma Q^T     Div P* = Q Div P
//! b* = Q b + Q'' x + 2 Q' v + d''
//! ```
//!
//! (Truesdell & Noll, The Non-Linear Field Theories of Mechanics, 1965, sections 17 and 19.) The motion is added to a
//! derivation that is already simplified. So a twin has the rotated stress of its field, in which no rotation has to cancel,
//! and costs the field plus the rotation. Q - I is computed from sine and cosine of half the angle, so that small angles keep
//! their digits. The formulas hold for frame-indifferent materials. Other materials are refused a rotation: those whose W is
//! written in the small strain, and those whose file does not claim indifference.

use crate::derivation::{Derivation, Response};
use crate::faults;
use crate::kinematics::total;
use crate::model::{RigidMotion, Rotation};
use crate::tensor::{Tensor, dot};
use mms_spec::quantity::Quantity;
use mms_symbolic::expr::{Expr, Function, Graph, HALF, Rational, Symbol};
use mms_symbolic::pass::differentiate::differentiate;

impl Rotation {
    /// The squared length of the axis, in space; `None` in the plane.
    pub fn axis_squared(&self, graph: &mut Graph) -> Option<Expr> {
        match self {
            Rotation::Plane { .. } => None,
            Rotation::Space { axis, .. } => Some(dot(graph, axis.map(|n| (n, n)))),
        }
    }

    /// Q - I = 2 s (c K + s K^2), with s and c the sine and cosine of half the angle and K the rotation by a quarter turn less
    /// the projection on the axis (Rodrigues 1840). At small angles nothing cancels.
    pub fn excess(&self, graph: &mut Graph) -> Tensor {
        let quarter = self.quarter_turn(graph);
        let (Rotation::Plane { angle } | Rotation::Space { angle, .. }) = self;
        let half = graph.scale(*angle, HALF);
        let (sine, cosine) =
            (graph.call(Function::Sin, &[half]), graph.call(Function::Cos, &[half]));
        let square = quarter.mul(graph, &quarter).scale(graph, sine);
        let linear = quarter.scale(graph, cosine);
        let twice = graph.scale(sine, 2);
        linear.add(graph, &square).scale(graph, twice)
    }

    /// K, the rotation by a quarter turn less the projection on the axis: in space, the cross product with the unit axis.
    pub fn quarter_turn(&self, graph: &mut Graph) -> Tensor {
        let zero = graph.number(0);
        let Rotation::Space { axis, .. } = self else {
            let (one, minus_one) = (graph.number(1), graph.number(-1));
            return Tensor::from_components(2, vec![zero, minus_one, one, zero]);
        };
        let square = dot(graph, axis.map(|n| (n, n)));
        let per_length = graph.power(square, Rational::from_parts((-1).into(), 2u8.into()));
        let [x, y, z] = axis.map(|n| graph.mul(n, per_length));
        let [minus_x, minus_y, minus_z] = [x, y, z].map(|n| graph.scale(n, -1));
        let rows = vec![zero, minus_z, y, z, zero, minus_x, minus_y, x, zero];
        Tensor::from_components(3, rows)
    }
}

impl RigidMotion {
    /// Q - I; 0 without a rotation.
    pub fn excess(&self, graph: &mut Graph) -> Tensor {
        let dimension = self.translation.len();
        match &self.rotation {
            Some(rotation) => rotation.excess(graph),
            None => Tensor::from_fn(dimension, |_, _| graph.number(0)),
        }
    }

    /// Q.
    pub fn turn(&self, graph: &mut Graph) -> Tensor {
        let excess = self.excess(graph);
        Tensor::identity(graph, excess.dimension()).add(graph, &excess)
    }

    /// The displacement of the twin, Q u + (Q - I) X + d.
    pub fn displacement(&self, graph: &mut Graph, inner: &[Expr]) -> Vec<Expr> {
        let (excess, rotation) = (self.excess(graph), self.turn(graph));
        let axes = 0..inner.len();
        let reference: Vec<Expr> =
            axes.map(|axis| graph.symbol(Symbol::Coordinate(axis))).collect();
        let (swung, turned) = (excess.apply(graph, &reference), rotation.apply(graph, inner));
        sum(graph, [&turned, &swung, &self.translation])
    }

    /// Every quantity of the twin, from the quantities of the field. The responses to a displacement gradient stay as they are.
    pub fn compose(&self, graph: &mut Graph, inner: &Derivation) -> Derivation {
        let twin = Twin::new(graph, self, inner);
        let quantities = inner
            .quantities
            .keys()
            .map(|quantity| (*quantity, twin.quantity(graph, *quantity)))
            .collect();
        Derivation { quantities, responses: inner.responses.clone() }
    }
}

/// A field, and the motion on top of it.
struct Twin<'a> {
    inner: &'a Derivation,
    /// Q - I.
    excess: Tensor,
    /// Q.
    rotation: Tensor,
    /// d.
    translation: Vec<Expr>,
    /// u* - Q u.
    displacement: Vec<Expr>,
    /// v* - Q v.
    velocity: Vec<Expr>,
    /// a* - Q a.
    acceleration: Vec<Expr>,
}

impl<'a> Twin<'a> {
    fn new(graph: &mut Graph, motion: &RigidMotion, inner: &'a Derivation) -> Self {
        let (excess, rotation) = (motion.excess(graph), motion.turn(graph));
        let [first, second] = rates(graph, excess.components())
            .map(|rate| Tensor::from_components(excess.dimension(), rate));
        let [drift, pull] = rates(graph, &motion.translation);
        let displacement = &inner.quantities[&Quantity::Displacement];
        let reference: Vec<Expr> =
            (0..displacement.len()).map(|axis| graph.symbol(Symbol::Coordinate(axis))).collect();
        let position = sum(graph, [&reference, displacement]);
        let velocity = faults::turned_velocity(graph, &inner.quantities[&Quantity::Velocity]);
        let twice: Vec<Expr> = velocity.iter().map(|rate| graph.scale(*rate, 2)).collect();
        let swung = excess.apply(graph, &reference);
        let carried = first.apply(graph, &position);
        let (turned, coriolis) = (second.apply(graph, &position), first.apply(graph, &twice));
        Twin {
            inner,
            rotation,
            translation: motion.translation.clone(),
            displacement: sum(graph, [&swung, &motion.translation]),
            velocity: sum(graph, [&carried, &drift]),
            acceleration: sum(graph, [&turned, &coriolis, &pull]),
            excess,
        }
    }

    fn quantity(&self, graph: &mut Graph, quantity: Quantity) -> Vec<Expr> {
        let inner = &self.inner.quantities[&quantity];
        match quantity {
            Quantity::Jacobian
            | Quantity::RightCauchyGreen
            | Quantity::GreenLagrange
            | Quantity::MassDensity
            | Quantity::StrainEnergy
            | Quantity::SecondPiolaKirchhoff
            | Quantity::Pressure
            | Quantity::VonMises
            | Quantity::SmallStrain
            // The names of a balance mean the motion of the twin.
            | Quantity::Own(_) => inner.clone(),
            Quantity::DivP | Quantity::DivSigma | Quantity::Traction => {
                self.rotation.apply(graph, inner)
            }
            Quantity::Position => self.turned(graph, inner, &self.translation),
            Quantity::Displacement => self.turned(graph, inner, &self.displacement),
            Quantity::Velocity => self.turned(graph, inner, &self.velocity),
            Quantity::Acceleration | Quantity::BodyForce => {
                self.turned(graph, inner, &self.acceleration)
            }
            Quantity::BodyForceDensity => {
                let density = self.inner.responses[&Response::Density][0];
                self.forced(graph, inner, density)
            }
            Quantity::CurrentBodyForceDensity => {
                let density = self.inner.quantities[&Quantity::MassDensity][0];
                self.forced(graph, inner, density)
            }
            Quantity::DeformationGradient | Quantity::FirstPiolaKirchhoff => {
                let inner = self.tensor(inner);
                self.rotation.mul(graph, &inner).components().to_vec()
            }
            Quantity::DisplacementGradient => {
                let turned = self.rotation.mul(graph, &self.tensor(inner));
                turned.add(graph, &self.excess).components().to_vec()
            }
            Quantity::NominalStress => {
                let inner = self.tensor(inner);
                inner.mul(graph, &self.rotation.transpose()).components().to_vec()
            }
            Quantity::LeftCauchyGreen | Quantity::CauchyStress | Quantity::KirchhoffStress => {
                let turned = self.rotation.mul(graph, &self.tensor(inner));
                turned.mul(graph, &self.rotation.transpose()).components().to_vec()
            }
        }
    }

    fn tensor(&self, components: &[Expr]) -> Tensor {
        Tensor::from_components(self.rotation.dimension(), components.to_vec())
    }

    /// Q f + rho (a* - Q a).
    fn forced(&self, graph: &mut Graph, force: &[Expr], density: Expr) -> Vec<Expr> {
        let apparent: Vec<Expr> =
            self.acceleration.iter().map(|a| graph.mul(density, *a)).collect();
        self.turned(graph, force, &apparent)
    }

    /// Q w + c.
    fn turned(&self, graph: &mut Graph, vector: &[Expr], carried: &[Expr]) -> Vec<Expr> {
        let turned = self.rotation.apply(graph, vector);
        sum(graph, [turned.as_slice(), carried])
    }
}

/// The first and the second derivative by time.
fn rates(graph: &mut Graph, components: &[Expr]) -> [Vec<Expr>; 2] {
    let first = differentiate(graph, components, Symbol::Time);
    let second = differentiate(graph, &first, Symbol::Time);
    [first, second]
}

/// The sum of vectors.
fn sum<const N: usize>(graph: &mut Graph, vectors: [&[Expr]; N]) -> Vec<Expr> {
    let components = 0..vectors[0].len();
    components.map(|row| total(graph, &vectors.map(|vector| vector[row]))).collect()
}
