//! The field whose errors are measured, and its variants.

use std::cell::RefCell;
use std::sync::Arc;

use super::regime::Case;
use mms_codegen::compile::{Compiled, Failure, Options};
use mms_codegen::variation::Variation;
use mms_spec::Form;
use mms_spec::quantity::Quantity;
use mms_spec::twin::Twin;
use mms_symbolic::sorted::{SortedMap, SortedSet};

/// Compiles a field with some options, even if its claims are not proved.
pub type Compile<'a> = &'a dyn Fn(&Options) -> Result<Compiled, Failure>;

/// The key of a compiled variant of a field.
type Key = (Variation, Option<usize>, Form);

/// A field, and a cache of its variants.
pub(super) struct Variants<'a> {
    compile: Compile<'a>,
    options: Options,
    /// The field in the stable form, without a rigid motion on top.
    plain: Compiled,
    variants: RefCell<SortedMap<Key, Arc<Compiled>>>,
}

impl<'a> Variants<'a> {
    /// Compiles the field with these options, whose quantities and form are ignored.
    pub fn new(
        compile: Compile<'a>,
        options: &Options,
        quantities: &[Quantity],
    ) -> Result<Self, Failure> {
        let always = [Quantity::Displacement, Quantity::Jacobian];
        let mut options = options.clone();
        options.selection.quantities =
            Some(SortedSet::from_iter(quantities.iter().copied().chain(always)));
        let mut still = options.clone();
        still.selection.twin = Twin::Nothing;
        still.form = Form::Stable;
        let plain = compile(&still)?;
        Ok(Variants { compile, options, plain, variants: RefCell::default() })
    }

    /// The field in the stable form, without a rigid motion that was put on top.
    pub fn plain(&self) -> &Compiled {
        &self.plain
    }

    /// A variant of the plain field.
    pub fn variant(&self, variation: &Variation) -> Result<Compiled, String> {
        let mut options = self.options.clone();
        options.selection.twin = Twin::Nothing;
        options.form = Form::Stable;
        options.variation = variation.clone();
        (self.compile)(&options).map_err(|failure| first_line(&failure))
    }

    /// The program of a case, in a form.
    pub fn of_case(&self, case: &Case, form: Form) -> Result<Arc<Compiled>, String> {
        let key = (case.variation.clone(), case.extreme, form);
        if let Some(compiled) = self.variants.borrow().get(&key) {
            return Ok(compiled.clone());
        }
        let mut options = self.options.clone();
        options.form = form;
        options.variation = case.variation.clone();
        if let Some(extreme) = case.extreme.and_then(|index| self.plain.field.extremes.get(index)) {
            let set = &mut options.selection.set;
            set.retain(|(name, _)| !extreme.set.iter().any(|(other, _)| other.value == *name));
            let values = extreme.set.iter();
            set.extend(values.map(|(name, value)| (name.value.clone(), value.text.clone())));
        }
        let compiled = (self.compile)(&options).map_err(|failure| first_line(&failure))?;
        let compiled = Arc::new(compiled);
        self.variants.borrow_mut().insert(key, compiled.clone());
        Ok(compiled)
    }
}

/// The first error, in one line.
pub(super) fn first_line(failure: &Failure) -> String {
    let first = failure.diagnostics.first();
    first.map_or_else(
        || "it does not compile".into(),
        |diagnostic| {
            let label = diagnostic.label.as_str();
            let message = diagnostic.message.as_str();
            if label.is_empty() { message.into() } else { format!("{message}: {label}") }
        },
    )
}
