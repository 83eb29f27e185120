//! The parameters of a field's material, multiplied by factors.

use std::sync::{Arc, OnceLock};

use mms_codegen::compile::{Compiled, constant};
use mms_codegen::variation::{Variation, factor_of};
use mms_codegen::{Options, Selection};
use mms_exact::Exact;
use mms_runtime::scene::Scene;

/// A field whose material has factors; compiled on first use.
pub struct Factors<'a> {
    exact: &'a Exact,
    compiled: OnceLock<Option<Arc<Compiled>>>,
}

impl<'a> Factors<'a> {
    /// The parameters of a field's material; compiles nothing yet.
    pub fn new(exact: &'a Exact) -> Self {
        Factors { exact, compiled: OnceLock::new() }
    }

    /// The names of the parameters.
    pub fn names(&self) -> Vec<String> {
        let arguments = &self.exact.input().compiled.field.material.arguments;
        arguments.iter().map(|(name, _)| name.value.clone()).collect()
    }

    /// The field with one parameter times a factor; `None` if it cannot be compiled.
    pub fn times(&self, parameter: usize, factor: f64) -> Option<Scene<f64>> {
        let compiled = self.compiled.get_or_init(|| self.compile()).clone()?;
        let name = factor_of(self.names().get(parameter)?);
        let at = compiled.model.parameters.iter().position(|it| it.name == *name)?;
        let mut set = self.exact.set_parameters().clone();
        set.insert(at, constant(&format!("{factor:?}")).ok()?);
        mms_interpreted::scene(compiled, &set).ok()
    }

    fn compile(&self) -> Option<Arc<Compiled>> {
        let input = self.exact.input();
        let Options { selection, .. } = input.options();
        let selection = Selection { quantities: None, ..selection.clone() };
        let options =
            Options { selection, variation: Variation::Factors, ..input.options().clone() };
        Some(Arc::new(input.varied(&options).ok()?))
    }
}
