//! The input of a document: the field, its variant and its parameters.

use mms_codegen::{Compiled, Selection};
use mms_documents::provenance::Input;
use mms_spec::twin::Twin;

/// The input of a field with a selection and parameters.
pub fn input(field: &str, selection: &Selection, set: &[String], compiled: &Compiled) -> Input {
    let rigid = match &selection.twin {
        Twin::Nothing => None,
        Twin::Standard => Some(String::new()),
        Twin::Given(keys) => Some(keys.clone()),
    };
    let (window, hash) = (selection.window.clone(), compiled.input_hash());
    Input { field: Some(field.into()), rigid, window, set: set.to_vec(), hash }
}

/// The rigid motion of an input.
pub fn twin(input: &Input) -> Twin {
    match input.rigid.as_deref() {
        None => Twin::Nothing,
        Some("") => Twin::Standard,
        Some(keys) => Twin::Given(keys.into()),
    }
}
