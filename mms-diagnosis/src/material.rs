//! The parameters of a field's material, and fields with a mistake in one of them.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use mms_runtime::ManufacturedField;
use mms_runtime::scene::Scene;

use crate::exact::Parameters;

/// The parameters of a field's material.
pub struct Material<'a> {
    /// The names of the parameters.
    pub names: Vec<String>,
    /// The field with one parameter times a factor; `None` if there is no such field.
    pub times: &'a (dyn Fn(usize, f64) -> Option<Scene<f64>> + Sync),
}

/// A field in D dimensions.
type Field<const D: usize> = Box<dyn ManufacturedField<f64, D>>;

/// Fields made so far, by the parameter and the bits of its factor.
type FieldCache<const D: usize> = HashMap<(usize, u64), Option<Arc<dyn ManufacturedField<f64, D>>>>;

/// The parameters of a material for fields in D dimensions; each field is made once.
pub struct Own<'a, const D: usize> {
    material: &'a Material<'a>,
    of: fn(Scene<f64>) -> Option<Field<D>>,
    made: Mutex<FieldCache<D>>,
}

impl<'a, const D: usize> Own<'a, D> {
    /// Wraps a material; `of` extracts the field in D dimensions from a scene.
    pub fn new(material: &'a Material<'a>, of: fn(Scene<f64>) -> Option<Field<D>>) -> Self {
        Own { material, of, made: Mutex::default() }
    }
}

impl<const D: usize> Parameters<D> for Own<'_, D> {
    fn names(&self) -> &[String] {
        &self.material.names
    }

    fn times(&self, parameter: usize, factor: f64) -> Option<Arc<dyn ManufacturedField<f64, D>>> {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        let make = || Some(Arc::from((self.of)((self.material.times)(parameter, factor)?)?));
        made.entry((parameter, factor.to_bits())).or_insert_with(make).clone()
    }
}
