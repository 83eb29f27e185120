//! Generated modules behind one trait, so that a property is written once for all fields.

use std::collections::BTreeMap;
use std::sync::{LazyLock, OnceLock};

use mms_codegen::Compiled;
use mms_exact::gallery::FIELDS;
use mms_mechanics::sample::{Sample, samples};
use mms_runtime::math::Real;
use mms_spec::quantity::Quantity;

/// The generated functions of one field.
pub trait Kernel {
    /// The field's name.
    const NAME: &'static str;
    /// The number of dimensions.
    const DIMENSION: usize;

    /// The components of a quantity, tensors row-major, for the default parameters.
    fn quantity<T: Real>(quantity: Quantity, time: T, point: &[T]) -> Vec<T>;
    /// rho0 at a point.
    fn density<T: Real>(point: &[T]) -> T;
    /// W of a displacement gradient at a time, row-major.
    fn material_strain_energy<T: Real>(time: T, point: &[T], gradient: &[T]) -> T;
    /// P of a displacement gradient at a time, row-major both.
    fn material_first_piola_kirchhoff<T: Real>(time: T, point: &[T], gradient: &[T]) -> Vec<T>;
    /// tau of a displacement gradient at a time, row-major both.
    fn material_kirchhoff_stress<T: Real>(time: T, point: &[T], gradient: &[T]) -> Vec<T>;
}

/// Implements [`Kernel`] with a module of the gallery.
macro_rules! kernel {
    ($module:ident) => {
        pub struct Field;

        impl crate::support::kernel::Kernel for Field {
            const NAME: &'static str = stringify!($module);
            const DIMENSION: usize = mms_gallery::$module::DIMENSION;

            fn quantity<T: mms_runtime::math::Real>(
                quantity: mms_spec::quantity::Quantity,
                time: T,
                point: &[T],
            ) -> Vec<T> {
                use mms_spec::quantity::Quantity;
                let field = mms_gallery::$module::prepare(&Default::default());
                let (at, x) =
                    (field.at_time(time), point.try_into().expect("DIMENSION components"));
                match quantity {
                    Quantity::Displacement => at.displacement(x).to_vec(),
                    Quantity::Position => at.position(x).to_vec(),
                    Quantity::Velocity => at.velocity(x).to_vec(),
                    Quantity::Acceleration => at.acceleration(x).to_vec(),
                    Quantity::DisplacementGradient => at.displacement_gradient(x).concat(),
                    Quantity::DeformationGradient => at.deformation_gradient(x).concat(),
                    Quantity::Jacobian => vec![at.jacobian(x)],
                    Quantity::RightCauchyGreen => at.right_cauchy_green(x).concat(),
                    Quantity::LeftCauchyGreen => at.left_cauchy_green(x).concat(),
                    Quantity::GreenLagrange => at.green_lagrange(x).concat(),
                    Quantity::MassDensity => vec![at.mass_density(x)],
                    Quantity::StrainEnergy => vec![at.strain_energy(x)],
                    Quantity::FirstPiolaKirchhoff => at.first_piola_kirchhoff(x).concat(),
                    Quantity::NominalStress => at.nominal_stress(x).concat(),
                    Quantity::CauchyStress => at.cauchy_stress(x).concat(),
                    Quantity::KirchhoffStress => at.kirchhoff_stress(x).concat(),
                    Quantity::DivP => at.div_p(x).to_vec(),
                    Quantity::DivSigma => at.div_sigma(x).to_vec(),
                    Quantity::BodyForce => at.body_force(x).to_vec(),
                    Quantity::BodyForceDensity => at.body_force_density(x).to_vec(),
                    Quantity::CurrentBodyForceDensity => at.current_body_force_density(x).to_vec(),
                    Quantity::Traction => {
                        let mut normal = [T::from_f64(0.0); Self::DIMENSION];
                        normal[0] = T::from_f64(1.0);
                        at.traction(x, normal).to_vec()
                    }
                    Quantity::SecondPiolaKirchhoff
                    | Quantity::Pressure
                    | Quantity::VonMises
                    | Quantity::SmallStrain
                    | Quantity::Own(_) => {
                        panic!("not every field is compiled with {}", quantity.name())
                    }
                }
            }

            fn density<T: mms_runtime::math::Real>(point: &[T]) -> T {
                let field = mms_gallery::$module::prepare(&Default::default());
                field.density(point.try_into().expect("DIMENSION components"))
            }

            fn material_strain_energy<T: mms_runtime::math::Real>(
                time: T,
                point: &[T],
                gradient: &[T],
            ) -> T {
                let field = mms_gallery::$module::prepare(&Default::default());
                let at = field.at_time(time);
                let x = point.try_into().expect("DIMENSION components");
                at.material_strain_energy(x, crate::support::kernel::rows(gradient))
            }

            fn material_first_piola_kirchhoff<T: mms_runtime::math::Real>(
                time: T,
                point: &[T],
                gradient: &[T],
            ) -> Vec<T> {
                let field = mms_gallery::$module::prepare(&Default::default());
                let at = field.at_time(time);
                let x = point.try_into().expect("DIMENSION components");
                let rows = crate::support::kernel::rows(gradient);
                at.material_first_piola_kirchhoff(x, rows).concat()
            }

            fn material_kirchhoff_stress<T: mms_runtime::math::Real>(
                time: T,
                point: &[T],
                gradient: &[T],
            ) -> Vec<T> {
                let field = mms_gallery::$module::prepare(&Default::default());
                let at = field.at_time(time);
                let x = point.try_into().expect("DIMENSION components");
                at.material_kirchhoff_stress(x, crate::support::kernel::rows(gradient)).concat()
            }
        }
    };
}

pub(crate) use kernel;

/// Row-major components as rows.
pub fn rows<T: Copy, const D: usize>(components: &[T]) -> [[T; D]; D] {
    std::array::from_fn(|row| std::array::from_fn(|column| components[row * D + column]))
}

/// The compiled text of a gallery field; each is compiled once.
pub fn compiled(name: &str) -> &'static Compiled {
    static COMPILED: LazyLock<BTreeMap<&str, OnceLock<Compiled>>> =
        LazyLock::new(|| FIELDS.iter().map(|entry| (entry.name, OnceLock::new())).collect());
    let entry = mms_exact::gallery::find(name).expect("a field of the gallery");
    COMPILED[name].get_or_init(|| entry.compile().expect("the gallery compiles"))
}

/// Points and times over a field's domain.
pub fn sample(compiled: &Compiled, count: usize) -> Vec<Sample<f64>> {
    samples(&compiled.program, &compiled.parameters::<f64>(&Default::default()), count)
}
