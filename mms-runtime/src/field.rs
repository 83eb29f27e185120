//! The manufactured field: an exact motion, the body force that drives it, and its domain.

use std::fmt;

use crate::material::Material;
use crate::real::{Matrix, Real, Vector};

/// An exact solution u(X, t) of the balance of momentum rho0 a = Div P + rho0 b.
///
/// Every method works on a batch of reference positions X at one time: `out` has the length of
/// `reference`, and every entry is written.
pub trait ManufacturedField<T: Real, const D: usize>: Material<T, D> {
    /// The reference body, the time window, and the claims made about the body's faces.
    fn domain(&self) -> Domain<T, D>;

    /// u = x - X.
    fn displacement(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]);

    /// v = du/dt at fixed X.
    fn velocity(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]);

    /// a = d2u/dt2 at fixed X.
    fn acceleration(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]);

    /// b = a - Div P / rho0, per unit mass.
    fn body_force(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]);

    /// H_iJ = du_i/dX_J.
    fn displacement_gradient(&self, time: T, reference: &[Vector<T, D>], out: &mut [Matrix<T, D>]);

    /// The Kirchhoff stress whose tractions act on the faces, where the field's H is `displacement_gradient`; by default the
    /// material's stress.
    fn surface_stress(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) {
        self.kirchhoff_stress(time, reference, displacement_gradient, stress);
    }
}

/// The reference body, the time window, and the claims about the body's faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Domain<T, const D: usize> {
    /// The body in the reference configuration.
    pub body: Body<T, D>,
    /// Start and end of the time window.
    pub time: [T; 2],
    /// The condition on each face. On a face without an entry the field prescribes the displacement.
    pub faces: Vec<(Face, Condition)>,
}

impl<T, const D: usize> Domain<T, D> {
    /// The condition on `face`: the first claim about it, or else [`Condition::Prescribed`].
    pub fn condition(&self, face: Face) -> Condition {
        let claim = self.faces.iter().find(|(claimed, _)| *claimed == face);
        claim.map_or(Condition::Prescribed, |(_, condition)| *condition)
    }
}

/// The shape of a body in the reference configuration.
#[derive(Clone, Debug, PartialEq)]
pub enum Body<T, const D: usize> {
    /// An axis-aligned box.
    Box {
        /// The corner with the smallest coordinates.
        lower: Vector<T, D>,
        /// The corner with the largest coordinates.
        upper: Vector<T, D>,
    },
    /// A ring or a sector of one, centred at the origin; two dimensions.
    Annulus {
        /// Inner radius.
        inner: T,
        /// Outer radius.
        outer: T,
        /// First and last angle, in radians.
        theta: [T; 2],
    },
    /// A cylinder about the axis Z, hollow or not, or a sector of one; three dimensions.
    Cylinder {
        /// Inner radius, which may be 0.
        inner: T,
        /// Outer radius.
        outer: T,
        /// First and last angle, in radians.
        theta: [T; 2],
        /// Lower and upper end.
        z: [T; 2],
    },
    /// A sphere about the origin, hollow or not, or a part of one; three dimensions.
    Sphere {
        /// Inner radius, which may be 0.
        inner: T,
        /// Outer radius.
        outer: T,
        /// First and last angle about the axis Z, in radians.
        theta: [T; 2],
        /// First and last angle from +Z, in radians.
        phi: [T; 2],
    },
    /// A polygon; two dimensions.
    Polygon {
        /// The vertices, in order around the polygon, clockwise or counter-clockwise.
        vertices: Vec<[T; 2]>,
        /// The names of the edges, in the order of the vertices that they start from.
        names: Vec<&'static str>,
    },
    /// No body: the field is only evaluated, and no solver can run it.
    Nothing,
}

/// A face of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Face {
    /// The face of a box at the smallest coordinate of this axis (0, 1, 2).
    Min(usize),
    /// The face of a box at the largest coordinate of this axis (0, 1, 2).
    Max(usize),
    /// The inner radius.
    Inner,
    /// The outer radius.
    Outer,
    /// The first angle of a sector.
    ThetaMin,
    /// The last angle of a sector.
    ThetaMax,
    /// The first angle of a sphere from +Z.
    PhiMin,
    /// The last angle of a sphere from +Z.
    PhiMax,
    /// The edge of a polygon that starts from the vertex of that index, and its name.
    Edge(usize, &'static str),
}

impl fmt::Display for Face {
    /// The face's name in field files: `x_min`, `z_max`, `inner`, `theta_min`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let axis = |axis: usize| ["x", "y", "z"].get(axis).copied().unwrap_or("?");
        match *self {
            Face::Min(a) => write!(f, "{}_min", axis(a)),
            Face::Max(a) => write!(f, "{}_max", axis(a)),
            Face::Inner => f.write_str("inner"),
            Face::Outer => f.write_str("outer"),
            Face::ThetaMin => f.write_str("theta_min"),
            Face::ThetaMax => f.write_str("theta_max"),
            Face::PhiMin => f.write_str("phi_min"),
            Face::PhiMax => f.write_str("phi_max"),
            Face::Edge(_, name) => f.write_str(name),
        }
    }
}

/// The boundary condition on a face; N is its reference normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Condition {
    /// u = 0.
    Fixed,
    /// u.N = 0 and no tangential traction.
    Roller,
    /// P N = 0.
    Free,
    /// u given by the field.
    Prescribed,
    /// P N given by the field.
    Traction,
}

impl fmt::Display for Condition {
    /// The condition's name in field files.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Condition::Fixed => "fixed",
            Condition::Roller => "roller",
            Condition::Free => "free",
            Condition::Prescribed => "prescribed",
            Condition::Traction => "traction",
        })
    }
}
