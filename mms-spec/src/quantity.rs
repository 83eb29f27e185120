//! The glossary of quantities: one identifier, one symbol, one shape each, in every target.

use crate::own::{Own, Part};

/// The number of components of a quantity: [`Space::components`](crate::Space::components).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One component.
    Scalar,
    /// One component per direction.
    Vector,
    /// One component per pair of directions, row-major.
    Tensor,
}

macro_rules! quantities {
    (
        compiled { $($compiled:ident,)* }
        on_request { $($requested:ident,)* }
        $($variant:ident $name:literal $symbol:literal $shape:ident $unit:literal $doc:literal,)*
    ) => {
        /// A quantity that follows from a displacement field and that a user can request.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Quantity {
            $(#[doc = $doc] $variant,)*
            /// A quantity that the field file defines: of a given field, or of a balance.
            Own(Own),
        }

        impl Quantity {
            /// Every quantity that a field is compiled with, in the order of derivation.
            pub const ALL: &[Quantity] = &[$(Quantity::$compiled,)*];

            /// The quantities that follow from the others by a few operations, and that no solver needs: they are derived on
            /// request, so that compiled fields do not contain them.
            pub const ON_REQUEST: &[Quantity] = &[$(Quantity::$requested,)*];

            /// The glossary's identifier, used in every target, in JSON and on the command line.
            pub fn name(self) -> &'static str {
                match self {
                    $(Quantity::$variant => $name,)*
                    Quantity::Own(own) => &own.described().name,
                }
            }

            /// The mathematical symbol.
            pub fn symbol(self) -> &'static str {
                match self {
                    $(Quantity::$variant => $symbol,)*
                    Quantity::Own(own) => &own.described().symbol,
                }
            }

            /// Scalar, vector or tensor.
            pub fn shape(self) -> Shape {
                match self {
                    $(Quantity::$variant => Shape::$shape,)*
                    Quantity::Own(own) => own.part.shape(),
                }
            }

            /// The SI unit, where the field's own units are SI.
            pub fn unit(self) -> &'static str {
                match self {
                    $(Quantity::$variant => $unit,)*
                    Quantity::Own(own) => &own.described().unit,
                }
            }

            /// The description, in one sentence.
            pub fn doc(self) -> &'static str {
                match self {
                    $(Quantity::$variant => $doc,)*
                    Quantity::Own(own) => &own.described().doc,
                }
            }
        }
    };
}

quantities! {
    compiled {
        Displacement, Position, Velocity, Acceleration, DisplacementGradient, DeformationGradient, Jacobian,
        RightCauchyGreen, LeftCauchyGreen, GreenLagrange, MassDensity, StrainEnergy, FirstPiolaKirchhoff,
        NominalStress, CauchyStress, KirchhoffStress, DivP, DivSigma, BodyForce, BodyForceDensity,
        CurrentBodyForceDensity, Traction,
    }
    on_request { SecondPiolaKirchhoff, Pressure, VonMises, SmallStrain, }
    Displacement "displacement" "u" Vector "m" "Displacement u(X, t).",
    Position "position" "x" Vector "m" "Current position x = X + u.",
    Velocity "velocity" "v" Vector "m/s" "Velocity v = du/dt at fixed X.",
    Acceleration "acceleration" "a" Vector "m/s^2" "Acceleration a = d2u/dt2 at fixed X.",
    DisplacementGradient "displacement_gradient" "H" Tensor "1" "Displacement gradient H_iJ = du_i/dX_J.",
    DeformationGradient "deformation_gradient" "F" Tensor "1" "Deformation gradient F = I + H.",
    Jacobian "jacobian" "J" Scalar "1" "Jacobian J = det F.",
    RightCauchyGreen "right_cauchy_green" "C" Tensor "1" "Right Cauchy-Green tensor C = F^T F.",
    LeftCauchyGreen "left_cauchy_green" "B" Tensor "1" "Left Cauchy-Green tensor B = F F^T.",
    GreenLagrange "green_lagrange" "E" Tensor "1" "Green-Lagrange strain E = (C - I)/2.",
    MassDensity "mass_density" "rho" Scalar "kg/m^3" "Mass per unit current volume rho = rho0/J.",
    StrainEnergy "strain_energy" "W" Scalar "Pa" "Strain-energy density W per unit reference volume.",
    FirstPiolaKirchhoff "first_piola_kirchhoff" "P" Tensor "Pa" "First Piola-Kirchhoff stress P_iJ = dW/dF_iJ.",
    NominalStress "nominal_stress" "PT" Tensor "Pa" "Nominal stress P^T = J F^-1 sigma.",
    CauchyStress "cauchy_stress" "sigma" Tensor "Pa" "Cauchy stress sigma = P F^T / J.",
    KirchhoffStress "kirchhoff_stress" "tau" Tensor "Pa" "Kirchhoff stress tau = P F^T.",
    DivP "div_p" "div_p" Vector "Pa/m" "Material divergence (Div P)_i = dP_iJ/dX_J.",
    DivSigma "div_sigma" "div_sigma" Vector "Pa/m" "Spatial divergence (div sigma)_i = dsigma_ij/dx_j = (Div P)_i / J.",
    BodyForce "body_force" "b" Vector "m/s^2" "Body force per unit mass b = a - Div P / rho0.",
    BodyForceDensity "body_force_density" "rho0_b" Vector "N/m^3" "Body force per unit reference volume rho0 b.",
    CurrentBodyForceDensity "current_body_force_density" "rho_b" Vector "N/m^3" "Body force per unit current volume rho b = rho0 b / J.",
    Traction "traction" "T" Vector "Pa" "Traction P N on reference area, for the reference unit normal N.",
    SecondPiolaKirchhoff "second_piola_kirchhoff" "S" Tensor "Pa" "Second Piola-Kirchhoff stress S = F^-1 P.",
    Pressure "pressure" "p" Scalar "Pa" "Pressure p = -tr(sigma)/3, the stress out of the plane included.",
    SmallStrain "strain" "strain" Tensor "1" "Small strain eps = (H + H^T)/2.",
    VonMises "von_mises" "von_mises" Scalar "Pa" "Von Mises stress sqrt(3/2 s:s) of the deviator s of sigma in three dimensions.",
}

impl Quantity {
    /// The quantities that a point and a time determine; a traction also needs the normal of a boundary.
    pub fn pointwise() -> impl Iterator<Item = Quantity> {
        Self::ALL.iter().copied().filter(|quantity| *quantity != Quantity::Traction)
    }

    /// All quantities that can be evaluated at a point and a time, including those on request.
    pub fn evaluated() -> impl Iterator<Item = Quantity> + Clone {
        Self::ALL.iter().chain(Self::ON_REQUEST).copied()
    }

    /// The description for a material of the small strain, which has one stress and one configuration.
    pub fn doc_at_small_strain(self) -> &'static str {
        match self {
            Quantity::MassDensity => "Mass per unit volume rho = rho0, at small strain.",
            Quantity::NominalStress => "Nominal stress P^T = P, at small strain.",
            Quantity::CauchyStress => "Cauchy stress sigma = P, at small strain.",
            Quantity::KirchhoffStress => "Kirchhoff stress tau = P, at small strain.",
            Quantity::SecondPiolaKirchhoff => {
                "Second Piola-Kirchhoff stress S = P, at small strain."
            }
            Quantity::DivSigma => "Divergence div sigma = Div P, at small strain.",
            Quantity::CurrentBodyForceDensity => {
                "Body force per unit volume rho b = rho0 b, at small strain."
            }
            other => other.doc(),
        }
    }

    /// Whether the quantity depends on a unit normal N beside X and t.
    pub fn takes_normal(self) -> bool {
        match self {
            Quantity::Traction => true,
            Quantity::Own(own) => own.part == Part::NormalFlux,
            _ => false,
        }
    }

    /// Whether the quantity is derived on request.
    pub fn is_on_request(self) -> bool {
        Self::ON_REQUEST.contains(&self)
    }

    /// The quantity with this identifier, or with one of the accepted aliases `u x v a H F J C B E rho P PK1 S PK2 p sigma b W`
    /// (`div_p` and `div_sigma` are both).
    pub fn from_name(name: &str) -> Option<Quantity> {
        let name = match name {
            "PK1" => "P",
            "PK2" => "S",
            other => other,
        };
        Self::evaluated().find(|quantity| {
            quantity.name() == name || (ALIASED.contains(&name) && quantity.symbol() == name)
        })
    }

    /// The quantity with a name or alias in a field that defines quantities of its own: if it has a given field `p`, `p` means
    /// that.
    pub fn among(own: &[Own], name: &str) -> Option<Quantity> {
        let own = own.iter().find(|own| own.name == name);
        own.map(|own| Quantity::Own(*own)).or_else(|| Self::from_name(name))
    }

    /// Whether the name means a quantity in every field, so that no file may define it. `p` does not: a given field may have
    /// this name.
    pub fn reserves(name: &str) -> bool {
        name != "p" && Self::from_name(name).is_some()
    }
}

/// The symbols that are accepted instead of identifiers.
const ALIASED: &[&str] =
    &["u", "x", "v", "a", "H", "F", "J", "C", "B", "E", "rho", "P", "S", "p", "sigma", "b", "W"];
