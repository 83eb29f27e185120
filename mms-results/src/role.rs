//! The quantities that arrays contain, and their names in codes.

/// The number of components of a quantity in D dimensions: 1, D, D x D, or (D (D + 1)/2)^2.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Form {
    /// One component.
    Scalar,
    /// One component for each dimension.
    Vector,
    /// A matrix.
    Tensor,
    /// A matrix that is its own transpose.
    Symmetric,
    /// A square matrix over the components of a symmetric tensor: 11, 22, 12 or 11, 22, 33, 12, 13, 23.
    Voigt,
}

/// A quantity of the field's own; its name in files is its own name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct OwnRole {
    /// The name.
    pub name: &'static str,
    /// The number of components.
    pub form: Form,
}

macro_rules! roles {
    ($($variant:ident $name:literal $symbol:literal $form:ident [$($word:literal)*] $doc:literal,)*) => {
        /// The quantity that an array contains.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum Role {
            $(#[doc = $doc] $variant,)*
            /// A quantity of the field's own, such as a given temperature.
            Own(OwnRole),
        }

        impl Role {
            /// All quantities that are not a field's own.
            pub const ALL: &[Role] = &[$(Role::$variant,)*];

            /// The identifier.
            pub fn name(self) -> &'static str {
                match self {
                    $(Role::$variant => $name,)*
                    Role::Own(own) => own.name,
                }
            }

            /// The symbol.
            pub fn symbol(self) -> &'static str {
                match self {
                    $(Role::$variant => $symbol,)*
                    Role::Own(own) => own.name,
                }
            }

            /// The number of components.
            pub fn form(self) -> Form {
                match self {
                    $(Role::$variant => Form::$form,)*
                    Role::Own(own) => own.form,
                }
            }

            /// The names in codes, in lower case without separators; a single letter is case-sensitive.
            fn words(self) -> &'static [&'static str] {
                match self {
                    $(Role::$variant => &[$($word),*],)*
                    Role::Own(_) => &[],
                }
            }
        }
    };
}

roles! {
    Reference "reference_position" "X" Vector ["X" "referencecoordinates" "initialposition" "initialcoordinates" "materialposition"]
        "Reference position X.",
    Position "position" "x" Vector ["currentposition" "presentposition" "deformedposition" "currentcoordinates"]
        "Present position x.",
    Place "place" "points" Vector ["x" "position" "positions" "pos" "points" "point" "coordinates" "coords" "coord"]
        "Positions that may be X or x.",
    Displacement "displacement" "u" Vector ["u" "U" "d" "displacements" "disp" "displ"] "Displacement u.",
    Velocity "velocity" "v" Vector ["v" "V" "velocities" "vel" "velo"] "Velocity v.",
    Acceleration "acceleration" "a" Vector ["a" "A" "accelerations" "accel" "acc"] "Acceleration a.",
    Residual "residual" "r" Vector ["r" "residuals"] "Residual of the balance of momentum, per reference volume.",
    DisplacementGradient "displacement_gradient" "H" Tensor ["H" "gradu"] "Displacement gradient H.",
    DeformationGradient "deformation_gradient" "F" Tensor ["F" "defgrad" "deformationgradients"] "Deformation gradient F.",
    Jacobian "jacobian" "J" Scalar ["J" "detf"] "J = det F.",
    RightCauchyGreen "right_cauchy_green" "C" Symmetric [] "Right Cauchy-Green tensor.",
    LeftCauchyGreen "left_cauchy_green" "B" Symmetric [] "Left Cauchy-Green tensor.",
    GreenLagrange "green_lagrange" "E" Symmetric ["E" "greenlagrangestrain" "greenstrain"] "Green-Lagrange strain E.",
    SmallStrain "strain" "strain" Symmetric ["smallstrain" "infinitesimalstrain"] "Small strain (H + H^T)/2.",
    ReferenceDensity "reference_density" "rho0" Scalar ["rho0" "initialdensity"] "Mass per reference volume, which is given to a solver.",
    MassDensity "mass_density" "rho" Scalar ["rho" "density" "massdensity"] "Mass per present volume.",
    StrainEnergy "strain_energy" "W" Scalar ["W" "strainenergydensity" "elasticenergydensity"] "Strain-energy density W.",
    FirstPiolaKirchhoff "first_piola_kirchhoff" "P" Tensor ["P" "pk1" "piola1" "firstpiola" "firstpiolakirchhoffstress"]
        "First Piola-Kirchhoff stress P.",
    CauchyStress "cauchy_stress" "sigma" Symmetric ["sigma" "cauchy" "sig"] "Cauchy stress sigma.",
    KirchhoffStress "kirchhoff_stress" "tau" Symmetric ["tau" "kirchhoff"] "Kirchhoff stress tau.",
    BodyForce "body_force" "b" Vector ["b"] "Body force b per mass.",
    SecondPiolaKirchhoff "second_piola_kirchhoff" "S" Symmetric ["S" "pk2" "piola2" "secondpiola" "secondpiolakirchhoffstress"]
        "Second Piola-Kirchhoff stress S.",
    Tangent "tangent" "DDSDDE" Voigt ["ddsdde"] "Tangent of the law: of the Jaumann rate of tau over J, by engineering shears.",
    Pressure "pressure" "p" Scalar ["p"] "Pressure.",
    VonMises "von_mises" "von_mises" Scalar ["mises" "vonmisesstress"] "Von Mises stress.",
    Traction "traction" "traction" Vector ["tractions" "surfacetraction" "boundarytraction"]
        "Traction P N, per reference area.",
    Normal "normal" "N" Vector ["N" "normals" "unitnormal" "unitnormals"] "Reference unit normal N of the boundary.",
    Volume "volume" "volume" Scalar ["vol"] "A weight: the volume of a point or cell.",
    Mass "mass" "mass" Scalar [] "A weight: the mass of a point.",
}

impl Role {
    /// The role of an identifier, a symbol, or a name in codes.
    pub fn from_name(name: &str) -> Option<Role> {
        let exact =
            Role::ALL.iter().copied().find(|role| role.name() == name || role.symbol() == name);
        exact.or_else(|| Role::called(name))
    }

    /// The role of a name in codes.
    pub(crate) fn called(name: &str) -> Option<Role> {
        let plain = plain(name);
        let is_plain = |role: &Role| {
            role.words().contains(&&*plain)
                || role.name().bytes().filter(|it| *it != b'_').eq(plain.bytes())
        };
        let is_it =
            |role: &&Role| role.words().contains(&name) || plain.len() > 1 && is_plain(role);
        Role::ALL.iter().find(is_it).copied()
    }
}

/// A name in lower case, without separators.
pub(crate) fn plain(name: &str) -> String {
    name.chars().filter(|it| it.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
