//! The invariants of strain-energy densities.
//!
//! Each is stored as its departure from the undeformed state, which is computed from H without cancellation.

use mms_symbolic::expr::{Expr, Graph, Symbol};

/// i1 = I1 - 3.
pub const FIRST: Symbol = Symbol::Invariant(0);
/// i2 = I2 - 3.
pub const SECOND: Symbol = Symbol::Invariant(1);
/// j = J - 1.
pub const VOLUME: Symbol = Symbol::Invariant(2);
/// i4 = I4 - 1, of fibres.
pub const FIBRE: Symbol = Symbol::Invariant(3);
/// tr eps of the small strain eps = (H + H^T)/2.
pub const SMALL_TRACE: Symbol = Symbol::Invariant(4);
/// eps:eps.
pub const SMALL_SQUARE: Symbol = Symbol::Invariant(5);

/// k = i1 - 2 j, of second order in the strain. Densities cannot use it.
pub const EXCESS: Symbol = Symbol::Invariant(6);
/// q, the sum of the principal minors of C - I of two rows. Densities cannot use it.
pub const MINORS: Symbol = Symbol::Invariant(7);

/// j as supplied beside H by code that bounds a stress, whose bounds of J are better than H gives. Densities cannot use it.
pub const SUPPLIED_VOLUME: Symbol = Symbol::Invariant(8);

/// An invariant that densities can use.
#[derive(Clone, Copy, Debug)]
pub struct Invariant {
    /// The name of the invariant in a density.
    pub name: &'static str,
    /// The departure from the undeformed state.
    pub symbol: Symbol,
    /// The value in the undeformed state.
    pub at_identity: i32,
}

/// Every invariant; I3 is J^2.
pub const INVARIANTS: [Invariant; 6] = [
    Invariant { name: "I1", symbol: FIRST, at_identity: 3 },
    Invariant { name: "I2", symbol: SECOND, at_identity: 3 },
    Invariant { name: "J", symbol: VOLUME, at_identity: 1 },
    Invariant { name: "I4", symbol: FIBRE, at_identity: 1 },
    Invariant { name: "eps_trace", symbol: SMALL_TRACE, at_identity: 0 },
    Invariant { name: "eps_squared", symbol: SMALL_SQUARE, at_identity: 0 },
];

impl Invariant {
    /// The invariant in terms of its departure.
    pub fn value(&self, graph: &mut Graph) -> Expr {
        let (departure, constant) = (graph.symbol(self.symbol), graph.number(self.at_identity));
        graph.add(constant, departure)
    }
}

/// The invariants that the density of a material is a function of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum InvariantKind {
    /// I1, I2, I3 and J.
    Isotropic,
    /// I1, I2, I3, J and I4 = a0.C a0, of fibres in the unit reference direction a0. The vector has the components along the
    /// dimensions of the field; C - I is 0 in the others.
    Fibrous(Vec<Expr>),
    /// eps_trace and eps_squared.
    SmallStrain,
}

impl InvariantKind {
    /// The departures that are the variables of a density of this kind.
    pub fn symbols(&self) -> &'static [Symbol] {
        match self {
            InvariantKind::Isotropic => &[FIRST, SECOND, VOLUME],
            InvariantKind::Fibrous(_) => &[FIRST, SECOND, VOLUME, FIBRE],
            InvariantKind::SmallStrain => &[SMALL_TRACE, SMALL_SQUARE],
        }
    }
}
