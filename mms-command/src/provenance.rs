//! The provenance of a document: the program, its input, the machine, and the command that reproduces it.

use mms_documents::provenance::VERSION;
pub use mms_documents::provenance::{Input, Machine, Provenance};

use mms_files::machine::processors;
use mms_files::shell::command;

/// The machine that this program runs on.
pub fn machine() -> Machine {
    Machine { processor: mms_files::machine::processor(), cores: processors() }
}

/// The origin of a document that this program computes here and now, by a command line with the name of the program.
pub fn new(kind: &str, arguments: &[String], input: Input) -> Provenance {
    Provenance {
        kind: kind.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        document_version: VERSION,
        command: command(arguments.iter().skip(1)),
        input,
        machine: Some(machine()),
    }
}
