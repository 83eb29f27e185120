//! An elastic block: a field of the gallery, by default without its loads.

use std::ops::MulAssign;

use mms_runtime::column::Matrices;
use mms_runtime::column::PACK;
use mms_runtime::scene::Scene;
use mms_runtime::{Condition, Domain, ManufacturedField, Material, Matrix, Real, Vector};

/// A field of the gallery as a block.
#[derive(Clone, Copy)]
pub struct Body {
    /// The name of the field.
    pub field: &'static str,
    /// Whether the field's body force acts, with the conditions of its faces. Otherwise there is no force, and all faces
    /// are free.
    pub forced: bool,
}

impl Body {
    /// A block without loads.
    pub fn free(field: &'static str) -> Self {
        Self { field, forced: false }
    }
}

/// The part of the field's motion that a block without force starts with: so small that particles stay in their cells,
/// which hat functions need.
const SHARE: f64 = 0.01;

/// A scene of `D` dimensions.
pub trait Of<T, const D: usize>: Sized {
    /// Finds a field by its name.
    fn find(name: &str) -> Option<Box<dyn ManufacturedField<T, D>>>;
}

macro_rules! of {
    ($($float:ident $member:ident: $($dimension:literal $variant:ident),*;)*) => {
        $($(impl Of<$float, $dimension> for Scene<$float> {
            fn find(name: &str) -> Option<Box<dyn ManufacturedField<$float, $dimension>>> {
                let compiled = mms_exact::gallery::find(name)?.compile().ok()?;
                let values = compiled.parameters::<$float>(&Default::default());
                match (mms_gallery::find(name)?.$member)(&values)? {
                    Scene::$variant(field) => Some(field),
                    _ => None,
                }
            }
        })*)*
    };
}

of! {
    f32 single: 2 Plane, 3 Space;
    f64 double: 2 Plane, 3 Space;
}

/// A block of `D` dimensions.
pub struct Block<T, const D: usize> {
    field: Box<dyn ManufacturedField<T, D>>,
    forced: bool,
}

impl<T: Real, const D: usize> Block<T, D> {
    /// The block of a field.
    pub fn new(body: &Body) -> Self
    where
        Scene<T>: Of<T, D>,
    {
        let field = Scene::<T>::find(body.field);
        let field = field.unwrap_or_else(|| panic!("no field `{}` of that dimension", body.field));
        Self { field, forced: body.forced }
    }

    fn weaken<V: MulAssign<T>>(&self, values: &mut [V]) {
        if !self.forced {
            values.iter_mut().for_each(|value| *value *= T::of(SHARE));
        }
    }
}

impl<T: Real, const D: usize> Material<T, D> for Block<T, D> {
    fn density(&self, reference: &[Vector<T, D>], density: &mut [T]) {
        self.field.density(reference, density);
    }

    fn wave_speed(&self, reference: &[Vector<T, D>], speed: &mut [T]) {
        self.field.wave_speed(reference, speed);
    }

    fn kirchhoff_stress(
        &self,
        time: T,
        reference: &[Vector<T, D>],
        displacement_gradient: &[Matrix<T, D>],
        stress: &mut [Matrix<T, D>],
    ) {
        self.field.kirchhoff_stress(time, reference, displacement_gradient, stress);
    }

    fn kirchhoff_stress_of_packs(
        &self,
        time: T,
        reference: &[[Vector<T, D>; PACK]],
        displacement_gradient: &[Matrices<T, D>],
        stress: &mut [Matrices<T, D>],
    ) {
        self.field.kirchhoff_stress_of_packs(time, reference, displacement_gradient, stress);
    }
}

impl<T: Real, const D: usize> ManufacturedField<T, D> for Block<T, D> {
    fn domain(&self) -> Domain<T, D> {
        let mut domain = self.field.domain();
        if !self.forced {
            domain.faces.iter_mut().for_each(|(_, condition)| *condition = Condition::Free);
        }
        domain
    }

    fn displacement(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.field.displacement(time, reference, out);
        self.weaken(out);
    }

    fn velocity(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.field.velocity(time, reference, out);
        self.weaken(out);
    }

    fn acceleration(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        self.field.acceleration(time, reference, out);
    }

    fn body_force(&self, time: T, reference: &[Vector<T, D>], out: &mut [Vector<T, D>]) {
        if self.forced {
            self.field.body_force(time, reference, out);
        } else {
            out.fill(Vector::zeros());
        }
    }

    fn displacement_gradient(&self, time: T, reference: &[Vector<T, D>], out: &mut [Matrix<T, D>]) {
        self.field.displacement_gradient(time, reference, out);
        self.weaken(out);
    }
}
