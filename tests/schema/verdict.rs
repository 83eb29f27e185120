//! The verdicts of the reader and of the schema on a text.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{LazyLock, Mutex};

use jsonschema::Validator;
use mms_codegen::compile::compile_unproved;
use mms_codegen::{Options, Selection};
use mms_spec::format::{MATERIAL, names};
use mms_spec::names::{ReservingFile, is_identifier, reserved};
use mms_spec::quantity::Quantity;
use mms_spec::source::Sources;
use mms_spec::{read_field, read_material};
use serde_json::{Map, Value};

static FIELD_SCHEMA: LazyLock<Validator> =
    LazyLock::new(|| jsonschema::validator_for(&mms_command::schema::field()).expect("a schema"));
static MATERIAL_SCHEMA: LazyLock<Validator> = LazyLock::new(|| {
    jsonschema::validator_for(&mms_command::schema::material()).expect("a schema")
});

/// The kind of object that a file describes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Field,
    Material,
}

impl Kind {
    /// The kind of a file of the compiler's test data.
    pub fn of(path: &Path) -> Kind {
        let name = path.file_name().expect("a name").to_string_lossy();
        if name.starts_with("material_") { Kind::Material } else { Kind::Field }
    }

    /// The refusals of the schema.
    pub fn refusals(self, document: &Value) -> Vec<String> {
        let validator: &Validator = match self {
            Kind::Field => &FIELD_SCHEMA,
            Kind::Material => &MATERIAL_SCHEMA,
        };
        let refusals = validator.iter_errors(document);
        refusals.map(|error| format!("{}: {error}", error.instance_path())).collect()
    }
}

/// A TOML text as an editor passes it to a schema; `None` for a text that is not TOML.
pub fn json_of(text: &str) -> Option<Value> {
    text.parse::<toml::Table>().ok().map(|table| json(&toml::Value::Table(table)))
}

/// A TOML value in JSON, which has neither dates nor infinities. Recursive: for tests alone.
pub fn json(value: &toml::Value) -> Value {
    match value {
        toml::Value::String(text) => text.as_str().into(),
        toml::Value::Integer(number) => (*number).into(),
        toml::Value::Float(number) => (*number).into(),
        toml::Value::Boolean(flag) => (*flag).into(),
        toml::Value::Datetime(date) => date.to_string().into(),
        toml::Value::Array(items) => items.iter().map(json).collect(),
        toml::Value::Table(table) => {
            let entries = table.iter().map(|(key, value)| (key.clone(), json(value)));
            Value::Object(entries.collect::<Map<_, _>>())
        }
    }
}

/// Whether the reader finds no mistake: in form, and in the material that a field names.
pub fn reader_accepts(kind: Kind, text: &str) -> bool {
    let mut sources = Sources::default();
    let id = sources.add("x.toml", text);
    let mut diagnostics = Vec::new();
    match kind {
        Kind::Field => drop(read_field(&sources, id, "x", &mut diagnostics)),
        Kind::Material => drop(read_material(&sources, id, "x", &mut diagnostics)),
    }
    diagnostics.is_empty() && (kind == Kind::Material || material_is_right(text))
}

/// Whether the model exists and has the given parameters. This depends only on the dimension and on [material], which most
/// mistakes do not change.
fn material_is_right(text: &str) -> bool {
    static KNOWN: Mutex<BTreeMap<String, bool>> = Mutex::new(BTreeMap::new());
    let field = json_of(text).unwrap_or_default();
    let key = format!("{} {}", field["field"]["dimension"], field["material"]);
    if let Some(known) = KNOWN.lock().expect("a lock").get(&key) {
        return *known;
    }
    let found = compiler_accepts_material(text);
    KNOWN.lock().expect("a lock").insert(key, found);
    found
}

/// Whether the compiler finds no mistake in the material; it also reports many mistakes that are not of form.
fn compiler_accepts_material(text: &str) -> bool {
    let own = own_material(text);
    // The smallest selection: mistakes in the material are found before any derivation.
    let quantities = Some([Quantity::Displacement].into());
    let options = Options::from(Selection { quantities, ..Selection::default() });
    let load = |_: &str| Ok(own.clone());
    let Err(failure) = compile_unproved("x", "x.toml", text, &load, &options) else { return true };
    !failure.diagnostics.iter().any(|diagnostic| {
        let message = diagnostic.message.as_str();
        let is_missing = message.starts_with("material parameter") && message.ends_with("missing");
        is_missing
            || message.starts_with("unknown material")
            || message.starts_with("the moduli of")
            || message.ends_with("has no fibres")
            || message.ends_with("needs the direction of its fibres")
            || message.contains("is not a parameter of `")
    })
}

/// A user's own material. It has the fibres and parameters that the field gives it, as far as they are possible: the
/// schema of the field cannot check more.
fn own_material(text: &str) -> String {
    let field = json_of(text).unwrap_or_default();
    let given = field["material"].as_object().into_iter().flatten().map(|(name, _)| name.as_str());
    let is_parameter = |name: &&str| {
        !names(MATERIAL).contains(name)
            && is_identifier(name)
            && reserved(name, ReservingFile::Material).is_none()
    };
    let parameters = given.filter(is_parameter).map(|name| format!("{name} = {{}}\n"));
    let parameters: String = parameters.collect();
    let invariant = if field["material"].get("fibre").is_some() { "I4" } else { "J" };
    format!(
        "[material]\ntitle = \"own\"\nstrain_energy = \"({invariant} - 1)^2\"\n[parameters]\n{parameters}"
    )
}
