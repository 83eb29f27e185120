//! The terms of the equations that a field may not test: one name and one sentence each.

use super::scale::{self, Scale};
use mms_spec::Face;

macro_rules! terms {
    ($($variant:ident $(($argument:ty))? $name:literal $scale:ident $means:literal,)*) => {
        /// A term of the equations, or a property of u that a method may be exact for.
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub enum Term {
            $(#[doc = concat!("Absent where ", $means, ".")] $variant $(($argument))?,)*
        }

        impl Term {
            /// The names of all kinds of terms, in a fixed order.
            pub const KINDS: &[&str] = &[$($name,)*];

            /// The kind of the term: the name without its argument.
            pub fn kind(&self) -> &'static str {
                match self { $(Term::$variant { .. } => $name,)* }
            }

            /// The meaning of the term's absence, and the untested part.
            pub fn absence(&self) -> &'static str {
                match self { $(Term::$variant { .. } => $means,)* }
            }

            /// The natural size of the term.
            pub(super) fn scale(&self) -> Scale {
                match self { $(Term::$variant { .. } => scale::$scale,)* }
            }
        }
    };
}

terms! {
    Velocity "velocity" VELOCITY "v = 0: the body is at rest",
    Acceleration "acceleration" ACCELERATION "a = 0: inertia is not tested",
    Jerk "jerk" JERK "u is at most quadratic in t: an integrator of constant acceleration is exact, and a zero error in time proves nothing",
    InitialDisplacement "initial_displacement" LENGTH "u = 0 at the first time: the start is undeformed, and a wrong first F is not seen",
    InitialVelocity "initial_velocity" VELOCITY "v = 0 at the first time: the start is at rest",
    InitialAcceleration "initial_acceleration" ACCELERATION "a = 0 at the first time: a first step of the wrong length, or of first order, is not seen",
    FinalDisplacement "final_displacement" LENGTH "u = 0 at the last time: errors then say little",
    Shear "shear" STRAIN "E_iJ = 0 for i != J",
    Rotation "rotation" STRAIN "F is symmetric: a transposed gradient is not seen",
    VolumeChange "volume_change" STRAIN "J = 1: Cauchy and Kirchhoff stress are the same, and a forgotten J is not seen",
    OutOfPlane "out_of_plane" STRAIN "H_i3 = H_3J = 0: a plane strain",
    Curvature "curvature" CURVATURE "u is linear in X, so linear shape functions represent it, and an error of 0 in space proves nothing",
    CurvatureAlongAxes "curvature_along_axes" CURVATURE "u is linear in each coordinate, so multilinear shape functions represent it, and an error of 0 in space proves nothing",
    ThirdGradient "third_gradient" THIRD_GRADIENT "u is at most quadratic in X, so quadratic shape functions represent it, and an error of 0 in space proves nothing",
    CrossTerms "cross_terms" STRESS_GRADIENT "Div P needs dP_iJ/dF_iJ alone: what couples components is not seen",
    TransposedStress "transposed_stress" STRESS_GRADIENT "Div P^T = Div P: a transposed stress gives the same b",
    UnequalModuli "unequal_moduli" STRESS "lambda = mu at F = I: a swap of the two is not seen",
    GradedModuli "graded_moduli" STRESS_GRADIENT "the moduli are the same at all X",
    GradedDensity "graded_density" DENSITY_GRADIENT "rho0 is the same at all X",
    BodyForce "body_force" ACCELERATION "b = 0: a solver that ignores it passes",
    Parameter(String) "parameter" STRESS_GRADIENT "b does not depend on it",
    Traction(Face) "traction" STRESS "P N = 0 there",
}

impl Term {
    /// The identifier: `shear`, `parameter.lambda`, `traction.x_min`.
    pub fn name(&self) -> String {
        match self {
            Term::Parameter(name) => format!("{}.{name}", self.kind()),
            Term::Traction(face) => format!("{}.{}", self.kind(), face.name()),
            _ => self.kind().to_string(),
        }
    }

    /// The name of the term in words.
    pub fn words(&self) -> String {
        match self {
            Term::Parameter(name) => format!("{} {name}", self.kind()),
            Term::Traction(face) => format!("{} on {}", self.kind(), face.name()),
            _ => self.kind().replace('_', " "),
        }
    }

    /// The terms that cannot be present without this one.
    pub(super) fn carries(&self) -> &'static [Term] {
        match self {
            Term::Velocity => {
                &[Term::Acceleration, Term::Jerk, Term::InitialVelocity, Term::InitialAcceleration]
            }
            Term::Acceleration => &[Term::Jerk, Term::InitialAcceleration],
            Term::Curvature => &[Term::CurvatureAlongAxes, Term::ThirdGradient],
            _ => &[],
        }
    }
}
