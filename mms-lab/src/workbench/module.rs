//! Emitted code, and the forms in which it is called.

use mms_codegen::Compiled;
use mms_codegen::rust;
use mms_mechanics::Output;
use mms_program::precision::Precision;
use mms_spec::quantity::Quantity;

use super::Workbench;

/// Emitted code that takes part, as a module of its own.
pub struct Module<'a> {
    /// The name of the module.
    pub name: &'a str,
    /// The field, or a part of it.
    pub compiled: &'a Compiled,
}

impl Module<'_> {
    /// Emits the module into the workbench.
    pub(super) fn write(&self, bench: &Workbench) -> anyhow::Result<()> {
        bench.write(&format!("{}.rs", self.name), &rust::file(self.compiled).text)
    }

    pub(super) fn dimension(&self) -> usize {
        self.compiled.field.dimension
    }

    /// The quantities that the module's program computes.
    fn quantities(&self) -> impl Iterator<Item = Quantity> {
        let outputs = &self.compiled.program.outputs;
        let known = |quantity: &Quantity| outputs.contains_key(&Output::Quantity(*quantity));
        self.compiled.quantities().filter(known)
    }
}

/// The form in which the functions of a module are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModuleForm {
    /// Point by point.
    Single,
    /// Point by point, from values kept for each point.
    SingleKept,
    /// All points at once.
    Batch,
    /// All points at once, from values kept for the points.
    BatchKept,
}

impl ModuleForm {
    /// Whether results go to columns.
    pub(super) fn is_batch(self) -> bool {
        matches!(self, ModuleForm::Batch | ModuleForm::BatchKept)
    }
}

/// A function of a module, in a precision.
pub(super) struct Call<'a> {
    pub module: &'a Module<'a>,
    pub quantity: Quantity,
    pub precision: Precision,
    pub way: ModuleForm,
}

impl<'a> Call<'a> {
    /// The calls of all quantities.
    pub fn all(
        module: &'a Module<'a>,
        precision: Precision,
        way: ModuleForm,
    ) -> impl Iterator<Item = Call<'a>> {
        module.quantities().map(move |quantity| Call { module, quantity, precision, way })
    }

    /// The name of the function.
    pub fn function(&self) -> String {
        let suffix = match self.way {
            ModuleForm::Single => "",
            ModuleForm::SingleKept => "_at",
            ModuleForm::Batch => "_batch",
            ModuleForm::BatchKept => "_batch_at",
        };
        format!("{}{suffix}", self.quantity.name())
    }

    /// The number of columns of the results.
    pub fn components(&self) -> usize {
        self.module.compiled.field.space.components(self.quantity.shape())
    }

    /// Whether the function takes normals beside positions.
    pub fn takes_normals(&self) -> bool {
        self.quantity.takes_normal()
    }
}

/// The type of a number in emitted code.
pub(super) fn scalar(precision: Precision) -> &'static str {
    match precision {
        Precision::F32 => "f32",
        Precision::F64 => "f64",
        Precision::Wide => "Double",
    }
}
