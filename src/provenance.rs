//! Where a document is from: who made it, of what, on which machine, and how to make it again.

use std::path::Path;

use mms_codegen::{Compiled, Selection};
pub use mms_documents::provenance::{Input, Machine, Provenance};
use mms_spec::MAX_FILE;
use mms_spec::twin::Twin;

use crate::read;
use crate::shell::command;

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

/// This machine.
pub fn machine() -> Machine {
    let described = read::first(Path::new("/proc/cpuinfo"), MAX_FILE as u64);
    let described = described.unwrap_or_default();
    let described = String::from_utf8_lossy(&described);
    let name = described.lines().find_map(|line| {
        let (key, value) = line.split_once(':')?;
        (key.trim() == "model name").then(|| value.trim().to_owned())
    });
    Machine {
        processor: name.unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
        cores: std::thread::available_parallelism().map_or(1, usize::from),
    }
}

/// The origin of a document that this program computes here and now, by a command line with the name of the program.
pub fn new(kind: &str, arguments: &[String], input: Input) -> Provenance {
    Provenance {
        kind: kind.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        command: command(arguments.iter().skip(1)),
        input,
        machine: Some(machine()),
    }
}
