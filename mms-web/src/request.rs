//! Requests, as the page writes them.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::mistake::Mistake;

/// The text of a field.
#[derive(Clone, Debug, Deserialize)]
pub struct FieldText {
    /// The field's name.
    #[serde(default = "unnamed")]
    pub name: String,
    /// The field file.
    pub text: String,
    /// The file of its material, if it has one of its own.
    #[serde(default)]
    pub material: Option<String>,
}

fn unnamed() -> String {
    "mine".into()
}

/// An attached file.
#[derive(Clone, Debug, Deserialize)]
pub struct Attached {
    /// The name, whose ending tells the format.
    pub name: String,
    /// The number of bytes, which follow the bytes of the files before it.
    pub size: usize,
}

/// The options of a judgement, as of `mms judge`.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct JudgeOptions {
    /// Whether the file is a table of errors, and no result of the field.
    pub errors: bool,
    /// h of each file; found from the files if it is empty.
    pub mesh_sizes: Vec<f64>,
    /// The time of each file, or one for all.
    pub times: Vec<f64>,
    /// Names of quantities; all that are found if it is empty.
    pub quantities: Vec<String>,
    /// The expected order; the solver's usual one if it is not given.
    pub expected_order: Option<f64>,
}

/// A request.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Request {
    /// The shipped fields and materials.
    Gallery,
    /// The JSON Schema of field files.
    Schema,
    /// A new field file, as `mms new` writes it.
    Template {
        /// The dimension of space.
        dimension: usize,
        /// A shipped material.
        material: String,
        /// The shape of the body: box or annulus.
        shape: String,
    },
    /// The output of `mms check`.
    Check(FieldText),
    /// The derivation of some quantities.
    Derivation {
        /// The field.
        #[serde(flatten)]
        field: FieldText,
        /// The names of the quantities; displacement and body force if there is none.
        #[serde(default)]
        quantities: Vec<String>,
    },
    /// All quantities at a point.
    Values {
        /// The field.
        #[serde(flatten)]
        field: FieldText,
        /// X.
        at: Vec<f64>,
        /// t.
        time: f64,
        /// Values of parameters.
        #[serde(default)]
        set: BTreeMap<String, f64>,
    },
    /// The motion of a mesh, with a quantity as colour.
    Motion {
        /// The field.
        #[serde(flatten)]
        field: FieldText,
        /// The name of the quantity.
        color: String,
        /// The number of times.
        frames: usize,
        /// Cells along each side.
        cells: usize,
    },
    /// The languages that code is written in, and the quantities.
    Targets,
    /// The code of a field in a language.
    Emit {
        /// The field.
        #[serde(flatten)]
        field: FieldText,
        /// The language.
        target: String,
        /// Names of quantities; all if there is none.
        #[serde(default)]
        quantities: Vec<String>,
    },
    /// The verdict on attached results.
    Judge {
        /// The field.
        #[serde(flatten)]
        field: FieldText,
        /// The files.
        files: Vec<Attached>,
        /// Options.
        #[serde(default)]
        options: JudgeOptions,
    },
}

/// The request, and the bytes of attached files.
pub fn split(bytes: &[u8]) -> Result<(Request, &[u8]), Mistake> {
    let short = || Mistake::of("a request is four bytes of length, a header and files");
    let (length, rest) = bytes.split_first_chunk().ok_or_else(short)?;
    let length = u32::from_le_bytes(*length) as usize;
    let (header, files) = rest.split_at_checked(length).ok_or_else(short)?;
    Ok((serde_json::from_slice(header)?, files))
}
