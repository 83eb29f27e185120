//! Where a document is from: who made it, of what, on which machine, and how to make it again.

use std::path::Path;

use mms_codegen::{Compiled, Selection};
use mms_spec::MAX_FILE;
use mms_spec::twin::Twin;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::read;
use crate::shell::command;

/// The key `provenance` of a document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// The subcommand that made the document: what kind of result it is.
    pub kind: String,
    /// The version of `mms`.
    pub version: String,
    /// What to type to make it again.
    pub command: String,
    /// What was computed with.
    pub input: Input,
    /// Where; nothing on a page that is the same everywhere.
    pub machine: Option<Machine>,
}

/// What a result is of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Input {
    /// A gallery name or a path to a TOML file, as it was given; nothing, if it is of several fields.
    pub field: Option<String>,
    /// The rigid motion on top, as `--rigid` takes it; empty for the standard one.
    pub rigid: Option<String>,
    /// The time window, where it is not that of the file.
    pub window: Option<[String; 2]>,
    /// Parameters that were set.
    pub set: Vec<String>,
    /// What tells the texts of field and material from others.
    pub hash: String,
}

impl Input {
    /// A field, taken in some way.
    pub fn new(field: &str, selection: &Selection, set: &[String], compiled: &Compiled) -> Self {
        let rigid = match &selection.twin {
            Twin::Nothing => None,
            Twin::Standard => Some(String::new()),
            Twin::Given(keys) => Some(keys.clone()),
        };
        let (window, hash) = (selection.window.clone(), compiled.input_hash());
        Self { field: Some(field.into()), rigid, window, set: set.to_vec(), hash }
    }

    /// The motion on top of the field.
    pub fn twin(&self) -> Twin {
        match self.rigid.as_deref() {
            None => Twin::Nothing,
            Some("") => Twin::Standard,
            Some(keys) => Twin::Given(keys.into()),
        }
    }
}

/// What computed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// The name of the processor; of its architecture, where it does not tell.
    pub processor: String,
    /// How many of its cores there are for this program.
    pub cores: usize,
}

impl Machine {
    /// This one.
    pub fn this() -> Self {
        let described = read::first(Path::new("/proc/cpuinfo"), MAX_FILE as u64);
        let described = described.unwrap_or_default();
        let described = String::from_utf8_lossy(&described);
        let name = described.lines().find_map(|line| {
            let (key, value) = line.split_once(':')?;
            (key.trim() == "model name").then(|| value.trim().to_owned())
        });
        Self {
            processor: name.unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
        }
    }
}

impl Provenance {
    /// Of what this program computes here and now, by a command line, program included.
    pub fn new(kind: &str, arguments: &[String], input: Input) -> Self {
        Self {
            kind: kind.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            command: command(arguments.iter().skip(1)),
            input,
            machine: Some(Machine::this()),
        }
    }

    /// A document, and below it where it is from.
    pub fn sign(&self, mut document: Value) -> Value {
        if let Value::Object(keys) = &mut document {
            keys.insert("provenance".to_owned(), serde_json::json!(self));
        }
        document
    }
}
